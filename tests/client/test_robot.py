"""Both clients against a scripted controller: everything it can do, right and wrong."""

import asyncio
import contextlib
import gc
import socket
import threading
import weakref
from types import SimpleNamespace

import pytest
from both_clients import Blocking
from fake_controller import joint_frame, status_frame
from fake_stream import StreamModel

from rapidgen.client import (
    AsyncRobot,
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotReady,
    ProtocolError,
    Robot,
    RobotError,
    RobotTimeout,
    StopFailed,
    Trajectory,
    TrajectoryRefused,
    deadline,
)
from rapidgen.client.address import Address
from rapidgen.client.flows.effects import Send
from rapidgen.client.sync_runner import Connection, Reader
from rapidgen.wire.simple_message.spec import Mode, Port, Reason, TrajectoryState, TriState

GOAL = [0.2, 0.1, 0.0, -0.1, 0.0, 0.3]
PATH = Trajectory.from_points([[0.0] * 6, [0.1] * 6, GOAL], seconds=0.1)
LONG = Trajectory.from_points([[0.0] * 6, [0.1] * 6, GOAL], seconds=2.0)
LOOP = Trajectory.from_points([[0.0] * 6, [0.1] * 6, [0.0] * 6], seconds=0.6)
"""A thread of a busy machine may be held up for half of it."""


@pytest.fixture(params=[True, False], ids=["rapidgen", "plain"])
def rapidgen(request):
    return request.param


def test_connects_and_tells_the_state(connected, rapidgen):
    with connected(rapidgen=rapidgen) as (robot, controller):
        assert robot.driver.is_rapidgen is rapidgen
        assert bool(robot.driver.version) is rapidgen
        state = robot.next_state()
        assert state.joints == (0.0,) * 6
        assert state["joint_6"] == 0.0
        assert state.status.mode is Mode.AUTO
        assert state.status.drives is TriState.TRUE
        assert not state.is_moving
        assert state.age >= 0
        later = robot.wait_until(lambda s: s.number >= state.number + 20, timeout=60)
        assert later.rate > 0
    # A plain driver received HELLO once and was not disturbed by it.
    assert controller.hellos == 1


def test_executes_to_the_end(connected, rapidgen):
    with connected(rapidgen=rapidgen) as (robot, controller):
        execution = robot.execute(PATH)
        result = execution.result()
        assert result.points == 3
        assert result.deviation < 1e-6
        assert result.seconds > 0
        assert execution.progress.state is TrajectoryState.DONE
        assert execution.progress.fraction == 1.0
        assert execution.stopped_position == pytest.approx(GOAL)
        assert [frame[2] for frame in controller.frames] == [-1, 1, -3]
        assert [frame[1] for frame in controller.frames] == [1, 1, 2]
        # durations belong to this trajectory alone
        assert [duration for _, duration in controller.points] == pytest.approx([0.1, 0.1, 0.1])
        robot.execute(PATH.reversed()).result()
        assert [duration for _, duration in controller.points] == pytest.approx([0.1, 0.1, 0.1])


def test_a_loop_is_not_done_before_it_was_run(connected, rapidgen):
    # A path that ends where it begins
    with connected(rapidgen=rapidgen) as (robot, _):
        assert robot.execute(LOOP).result().seconds > 0.6


def test_a_driver_that_never_says_moving_is_judged_by_time_too(connected):
    with connected(rapidgen=False, status={"in_motion": 0}) as (robot, _):
        assert robot.execute(LOOP).result().seconds > 0.6


def test_a_robot_that_never_moves_has_not_arrived(connected):
    with connected(rapidgen=False, moves=False) as (robot, _):
        with pytest.raises(MotionFailed, match="never moved") as error:
            robot.execute(LOOP).result()
        assert error.value.states
        assert error.value.messages


def test_stop_while_moving(connected, rapidgen):
    with connected(rapidgen=rapidgen) as (robot, controller):
        execution = robot.execute(Trajectory.from_points(LONG.positions, seconds=60.0))
        robot.wait_until(lambda s: s.joints[0] > 0.0005, timeout=50)
        state = robot.stop()
        assert not state.is_moving
        assert 0.0005 < state.joints[0] < 0.1
        with pytest.raises(MotionStopped) as error:
            execution.result()
        assert error.value.reason is Reason.STOPPED
        assert execution.is_over
        assert len(controller.stops) == 1
        assert robot.next_state().joints == pytest.approx(execution.stopped_position)
        # and the robot takes the next one
        robot.execute(Trajectory.from_points([state.joints, [0.0] * 6], seconds=0.2)).result()


def test_cancel_is_stop_and_nothing_after_the_end(connected):
    with connected() as (robot, controller):
        execution = robot.execute(LONG)
        state = execution.cancel()
        assert execution.stopped_position == state.joints
        execution.cancel()
        assert len(controller.stops) == 1


def test_closing_stops_what_moves(connected):
    with pytest.warns(RuntimeWarning, match="was stopped"), connected() as (robot, controller):
        robot.execute(LONG)
    assert len(controller.stops) == 1


def test_closing_says_that_it_could_not_stop_and_closes_all_the_same(fake, client, comes):
    controller = fake()
    with pytest.raises(StopFailed), client(controller.address, hasty={"stop": 0.3}) as robot:  # noqa: PT012
        robot.execute(LONG)
        controller.script.answer_stop = False
    assert not robot.is_connected
    assert comes(lambda: not controller._clients)


def test_refusal_tells_reason_point_and_joint(connected):
    with connected(refuse=(4, 1, 3)) as (robot, controller):
        with pytest.raises(TrajectoryRefused, match="joint_3") as error:
            robot.execute(PATH)
        assert (error.value.reason, error.value.point) == (Reason.JOINT_LIMIT, 1)
        assert any("Refused" in text for _, text in error.value.messages)
        controller.script.refuse = None
        robot.execute(PATH).result()


def test_refusal_without_a_reason(fake, client):
    robot_in = client(fake(rapidgen=False, bare_failure=True).address)
    with robot_in as robot, pytest.raises(TrajectoryRefused, match="no reason"):
        robot.execute(PATH)


def test_failure_on_the_way(connected):
    with connected(ends_at=0.6) as (robot, _):
        execution = robot.execute(PATH)
        with pytest.raises(MotionFailed, match="while moving") as error:
            execution.result()
        assert error.value.reason is Reason.MOTION_ERROR
        assert error.value.reached == 2


def test_failure_on_the_way_of_a_plain_driver(connected):
    with connected(rapidgen=False, ends_at=0.6) as (robot, _):
        execution = robot.execute(PATH)
        with pytest.raises(MotionFailed, match="stands elsewhere"):
            execution.result()


@pytest.mark.parametrize(
    "status", [{"e_stopped": 1}, {"drives": 0}, {"possible": 0}], ids=lambda s: next(iter(s))
)
def test_a_robot_that_cannot_move_gets_nothing(connected, status):
    with connected(status=status) as (robot, controller), pytest.raises(NotReady):
        robot.execute(PATH)
    assert controller.frames == []


def test_emergency_stop_on_the_way_of_a_plain_driver(connected):
    with connected(rapidgen=False) as (robot, controller):
        execution = robot.execute(LONG)
        controller.script.status = {"e_stopped": 1, "drives": 0}
        with pytest.raises(MotionFailed, match="emergency stop"):
            execution.result()


def test_an_invalid_trajectory_sends_nothing(connected):
    far = Trajectory.from_points([[0.5] * 6, [9.0] * 6], seconds=0.01)
    with connected() as (robot, controller):
        with pytest.raises(InvalidTrajectory) as error:
            robot.execute(far)
        assert {"RG614", "RG615", "RG616", "RG618"} <= {d.code for d in error.value.diagnostics}
    assert controller.frames == []


@pytest.mark.parametrize("target", ["irb120", None])
def test_a_plain_driver_gets_at_most_100_points(fake, client, target):
    # Also with a larger capacity in the configuration: the driver may be abb_driver.
    controller = fake(rapidgen=False)
    points = Trajectory.from_points([[0.0] * 6] * 101, seconds=0.1)
    options = {"address": controller.address} if target else {}
    robot_in = client(target or controller.address, **options)
    with robot_in as robot, pytest.raises(InvalidTrajectory, match="holds 100"):
        robot.execute(points)
    assert controller.frames == []


def test_one_trajectory_at_a_time(connected):
    with connected() as (robot, _):
        execution = robot.execute(LONG)
        with pytest.raises(NotReady, match="is active"):
            robot.execute(PATH)
        execution.cancel()


@pytest.mark.parametrize("chop", [1, 3, 7, 60])
def test_split_and_merged_segments(connected, chop):
    with connected(chop=chop, merge=1 + chop % 3) as (robot, _):
        robot.execute(PATH).result()


def test_late_reply(connected):
    with connected(end_delay=0.3) as (robot, _):
        robot.execute(PATH).result()


def test_missing_reply_to_the_end(connected, comes):
    with connected(answer_end=False, hasty={"reply": 0.3}) as (robot, controller):
        with pytest.raises(RobotTimeout, match="did not answer"):
            robot.execute(PATH)
        # It may be moving: it was stopped.
        assert comes(lambda: controller.stops)


def test_missing_reply_to_stop(fake, client):
    robot_in = client(fake(answer_stop=False).address, hasty={"stop": 0.3})
    with robot_in as robot, pytest.raises(StopFailed, match="did not answer"):
        robot.stop()


@pytest.mark.parametrize("control", [True, False])
def test_a_controller_that_cannot_stop(fake, client, control):
    robot_in = client(fake(stop_code=2, control=control, stream=StreamModel()).address)
    with robot_in as robot, pytest.raises(StopFailed, match="could not stop"):
        robot.stop()


def test_a_stop_that_is_not_seen(connected):
    with connected(coasts=True, hasty={"stop": 2}) as (robot, controller):
        robot.execute(LONG)
        robot.wait_until(lambda s: s.is_moving, timeout=60)
        with pytest.raises(StopFailed, match="not observed at rest"):
            robot.stop()
        controller.script.coasts = False
        robot.stop()


def test_silence_during_a_motion_stops_it(connected, comes):
    with connected(silent_after=0.1, hasty={"silence": 1.5}) as (robot, controller):
        execution = robot.execute(LONG)
        with pytest.raises(RobotTimeout, match="no state"):
            execution.result()
        assert comes(lambda: controller.stops)


def test_lost_connection_during_a_motion(connected, rapidgen, comes):
    with connected(rapidgen=rapidgen) as (robot, controller):
        execution = robot.execute(LONG)
        controller.drop("state")
        with pytest.raises(ConnectionLost, match="state port") as error:
            execution.result()
        assert error.value.states
        assert not robot.is_connected
        assert comes(lambda: controller.stops), "blind: it was stopped"
        with pytest.raises(ConnectionLost):
            robot.execute(PATH)


def test_reconnect_sends_no_motion(connected, comes):
    with connected(reconnect=3.0) as (robot, controller):
        execution = robot.execute(LONG)
        controller.drop()
        with pytest.raises(ConnectionLost):
            execution.result()
        assert comes(lambda: not robot._core.state_open)
        sent = [frame for frame in controller.frames if frame[2] != -4]
        assert robot.next_state().joints
        assert robot.is_connected
        assert [frame for frame in controller.frames if frame[2] != -4] == sent
        controller._halt()
        state = robot.wait_until(lambda s: not s.is_moving, timeout=60)
        robot.execute(Trajectory.from_points([state.joints, [0.0] * 6], seconds=0.1)).result()


def test_connect_without_driver_fails(client):
    # Bound, so that no other process gets it, and not listened on.
    with socket.socket() as accepted:
        accepted.bind(("127.0.0.1", 0))
        port = accepted.getsockname()[1]
        with pytest.raises(ConnectionFailed, match="refused"):
            client(f"127.0.0.1:{port},{port}").__enter__()


def test_connected_but_silent(fake, client):
    controller = fake(merge=10**9)
    with pytest.raises(RobotTimeout, match="no joints and status"):
        client(controller.address, hasty={"state": 0.3}).__enter__()


STATES = joint_frame([0.0] * 6) + status_frame()


@pytest.mark.parametrize("cut", range(0, len(STATES), 5))
def test_closed_at_every_byte(fake, client, cut):
    with pytest.raises((ConnectionLost, RobotTimeout)):
        client(fake(raw_state=STATES[:cut]).address).__enter__()


@pytest.mark.parametrize("length", [-1, 0, 11, 1021, 2**31 - 1])
def test_wrong_lengths(fake, client, length):
    raw = joint_frame([0.0] * 6) + length.to_bytes(4, "little", signed=True) + b"GET / HTTP"
    with pytest.raises(ProtocolError, match="does not speak") as error:
        client(fake(raw_state=raw).address).__enter__()
    assert error.value.messages


def test_unknown_messages_are_skipped(fake, client):
    controller = fake(state_period=0.5)  # few others, so that it is kept for long
    controller._hello_unchanged = controller._hello
    controller._hello = lambda: (
        status_frame()[:-4].replace(b"\x28\0\0\0\x0d", b"\x24\0\0\0\x63")
        + controller._hello_unchanged()
    )
    with client(controller.address) as robot:
        assert robot.driver.is_rapidgen
        assert any("type 99" in text for _, text in robot.messages)


def test_another_version(fake, client):
    with pytest.raises(IncompatibleDriver, match="version 9"):
        client(fake(protocol=9).address).__enter__()


def test_another_joint_map(fake, client):
    controller = fake(mapping="ffffffffffff")
    with pytest.raises(IncompatibleDriver, match="joint map"):
        client("irb120", address=controller.address).__enter__()


def test_a_configuration_names_the_joints(fake, client):
    with client("irb120", address=fake(rapidgen=False).address) as robot:
        assert robot.state.names == robot.group.names
        assert len(robot.state.by_name) == 6


def test_stop_from_another_thread_while_sending(fake, patient, comes):
    controller = fake(capacity=300_000, read_bytes=68, read_pause=0.002)
    points = Trajectory.from_points([[0.0] * 6] * 200_000, seconds=0.1)
    failed = []

    def send():
        try:
            robot.execute(points)
        except RobotError as error:
            failed.append(error)

    # The scripted controller takes its time to read what the kernel already has.
    with Robot(controller.address, timeouts=patient()) as robot:
        sender = threading.Thread(target=send)
        sender.start()
        assert comes(lambda: len(controller.frames) > 5)
        # The fake reads so slowly that STOP waits for the data in the scheduler.
        controller.script.read_pause = 0.0
        controller.script.read_bytes = 65536
        robot.stop()
        sender.join(60)
        assert isinstance(failed[0], MotionStopped)
    sequences = [frame[2] for frame in controller.frames]
    assert sequences[-1] == -4
    assert -3 not in sequences
    # whole frames only, none left out
    assert sequences[:-1] == [-1, *range(1, len(sequences) - 1)]


def test_trajectory_that_was_not_sent_is_freed(fake, patient, comes):
    """A motion, its error and its traceback hold each other."""
    controller = fake(capacity=300_000, read_bytes=68, read_pause=0.002)
    points = Trajectory.from_points([[0.0] * 6] * 200_000, seconds=0.1)

    def send():
        with contextlib.suppress(MotionStopped):
            robot.execute(points)

    with Robot(controller.address, timeouts=patient()) as robot:
        gc.disable()
        try:
            sender = threading.Thread(target=send)
            sender.start()
            assert comes(lambda: len(controller.frames) > 5)
            motion = weakref.ref(robot._core.motion)
            controller.script.read_pause, controller.script.read_bytes = 0.0, 65536
            robot.stop()
            sender.join(60)
            robot._core.motion = None
            assert motion() is None
        finally:
            gc.enable()


def test_stopped_motion_sends_no_further_frame():
    motion = SimpleNamespace(stopping=True)
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = Address("127.0.0.1", server.getsockname()[1])
        connection = Connection(address, Port.MOTION, 1.0)
        peer, _ = server.accept()
        with pytest.raises(MotionStopped):
            connection.send(Send(Port.MOTION, b"x" * 680, 1.0, motion))
        connection.close()
        assert peer.recv(100) == b""
        peer.close()


@pytest.mark.parametrize("mode", ["download", "stream"])
def test_ctrl_c_stops_the_robot(fake, patient, monkeypatch, comes, mode):
    controller = fake(stream=StreamModel() if mode == "stream" else None)
    with Robot(controller.address, timeouts=patient()) as robot:
        execution = robot.execute(LONG, mode=mode)
        wait = robot._runner.guard.wait

        def interrupt(timeout=None):
            monkeypatch.setattr(robot._runner.guard, "wait", wait)
            raise KeyboardInterrupt

        monkeypatch.setattr(robot._runner.guard, "wait", interrupt)
        with pytest.raises(KeyboardInterrupt):
            execution.result()
        assert comes(lambda: controller.stops)


@pytest.mark.parametrize("mode", ["download", "stream"])
@pytest.mark.parametrize("place", ["_pump", "_perform"])
def test_ctrl_c_between_two_waits_stops_the_robot(fake, patient, monkeypatch, comes, place, mode):
    controller = fake(stream=StreamModel() if mode == "stream" else None)
    with Robot(controller.address, timeouts=patient()) as robot:
        execution = robot.execute(LONG, mode=mode)
        goes_on = getattr(robot._runner, place)

        def interrupt(*arguments):
            if threading.current_thread() is not threading.main_thread():
                return goes_on(*arguments)
            monkeypatch.setattr(robot._runner, place, goes_on)
            raise KeyboardInterrupt

        monkeypatch.setattr(robot._runner, place, interrupt)
        with pytest.raises(KeyboardInterrupt):
            execution.result()
        assert comes(lambda: controller.stops)


def test_what_a_condition_raises_is_no_end_of_the_call(connected):
    """A condition of the caller's own is asked where flows are carried out."""
    with connected() as (robot, _), pytest.raises((StopIteration, RuntimeError)):
        robot.wait_until(lambda state: next(iter(())), 60)


def test_cancelling_a_coroutine_stops_the_robot(fake, patient):
    controller = fake()

    async def run():
        async with AsyncRobot(controller.address, timeouts=patient()) as robot:
            execution = await robot.execute(LONG)
            with pytest.raises(TimeoutError):
                async with deadline.timeout(0.05):
                    await execution.result()
            await robot.wait_until(lambda s: not s.is_moving, 60)

    asyncio.run(run())
    assert len(controller.stops) == 1


def test_stop_without_a_connection(fake, client):
    controller = fake()
    robot = client(controller.address)
    try:
        assert robot.stop() is None
        assert len(controller.stops) == 1
    finally:
        robot.close()
        if isinstance(robot, Blocking):
            robot.end()


def test_recording(connected, tmp_path, comes):
    with connected() as (robot, _):
        with robot.recording() as recording:
            robot.execute(PATH).result()
            assert comes(lambda: len(recording) > 5)
        recording.to_csv(tmp_path / "r.csv")
    again = Trajectory.from_csv(tmp_path / "r.csv")
    assert again.names == robot.group.names
    assert again.positions[-1].tolist() == pytest.approx(GOAL)


def test_connection_that_comes_with_the_end_is_closed():
    class Owner:
        core = SimpleNamespace(is_busy=False, tick=0.1)

    owner = Owner()
    reader = Reader(owner, "test")
    reader._change = lambda: None  # the end comes before it looks
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1]
        connection = Connection(Address("127.0.0.1", number, number), Port.MOTION, 5)
        reader.add(connection)
        reader.close()
        assert connection.socket.fileno() == -1
