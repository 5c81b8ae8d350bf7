"""Streams, control port and further state messages, over real sockets."""

import dataclasses
import struct
import threading

import numpy as np
import pytest
from driven import wave
from fake_controller import frame
from fake_stream import StreamModel

from rapidgen.client import (
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotReady,
    NotSupported,
    RequestRefused,
    RobotTimeout,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.config import load_config
from rapidgen.config.model import ExposedSignal
from rapidgen.wire.simple_message.spec import EventType, Reason, TrajectoryState

SPEED = 40
"""The scripted robot plays so many times faster than asked."""


def streams(**options):
    model = StreamModel(**{"speed": SPEED, **options})
    return {"stream": model, "control": True}


def test_streams_to_the_end(connected):
    with connected(**streams()) as (robot, controller):
        assert "accept points" not in str(robot.driver.cannot)
        with robot.stream() as stream:
            assert stream.mode is None
            stream.extend(wave(600))
            assert stream.mode == "stream"
            assert (stream.total, stream.time) == (600, pytest.approx(59.9))
        result = stream.result()
        assert (result.points, result.mode) == (600, "stream")
        assert result.deviation < 1e-5
        assert stream.is_over
        assert stream.progress.fraction == 1.0
        assert stream.stopped_position == pytest.approx(result.state.joints)
    executed = [q for _, q in controller.script.stream.executed]
    requested = [q for _, q in wave(600)]
    assert np.array(executed) == pytest.approx(np.array(requested), abs=1e-6)


def test_nothing_appended_is_nothing_done(connected):
    with connected(**streams()) as (robot, controller):
        with robot.stream() as stream:
            stream.append([], np.zeros((0, 6)))
        with pytest.raises(InvalidTrajectory, match="no points"):
            stream.result()
    assert controller.script.stream.batches == 0


def test_columns_go_by_name(connected):
    names = [f"joint_{n}" for n in (6, 5, 4, 3, 2, 1)]
    with connected(**streams()) as (robot, controller):
        with robot.stream(names) as stream:
            stream.append([0, 1], [[0] * 6, [0.6, 0.5, 0.4, 0.3, 0.2, 0.1]])
        with pytest.raises(InvalidTrajectory, match="no joint 'elbow'"):
            robot.stream(["elbow", *names[1:]]).append([0], [[0] * 6])
    assert controller.script.stream.position == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])


def test_refused_at_the_first_points_nothing_moves(connected):
    with connected(**streams(start_fault=Reason.NOT_ALLOWED)) as (robot, controller):
        stream = robot.stream()
        with pytest.raises(TrajectoryRefused, match="may not move this robot") as error:
            stream.append([0, 1], [[0.0] * 6, [0.1] * 6])
        assert error.value.reason is Reason.NOT_ALLOWED
        assert stream.progress.state is TrajectoryState.REFUSED
        with pytest.raises(TrajectoryRefused):
            stream.result()
        controller.script.stream.start_fault = 0
        with robot.stream() as stream:
            stream.append([0, 1], [[0.0] * 6, [0.1] * 6])


@pytest.mark.parametrize("point", [0, 7, 250])
def test_refused_on_the_way_it_ends_in_order_and_says_which(connected, point):
    with connected(**streams(point_fault=(point, Reason.JOINT_LIMIT, 3))) as (robot, controller):
        stream = robot.stream()
        kind = MotionFailed if point else TrajectoryRefused
        with pytest.raises(kind, match=rf"at point {point}, joint_3: .* outside its") as error:
            stream.extend(wave())
        assert (error.value.point, error.value.joint) == (point, 3)
        assert error.value.reason is Reason.JOINT_LIMIT
        assert error.value.reached == (point or None)
        assert stream.is_over
        assert stream.progress.state.name == ("FAILED" if point else "REFUSED")
    executed = controller.script.stream.executed
    assert len(executed) == point
    if point:
        assert error.value.states[-1].joints == pytest.approx(executed[-1][1])


def test_stop_from_another_thread(connected):
    with connected(**streams(speed=1)) as (robot, controller):
        stream = robot.stream()
        failed = []

        def fill():
            try:
                stream.extend(wave())
            except MotionStopped as error:
                failed.append(error)

        filling = threading.Thread(target=fill)
        filling.start()
        robot.wait_until(lambda s: s.is_moving, 60)
        state = robot.stop()
        filling.join(60)
        assert failed[0].reason is Reason.STOPPED
        # the controller's own word, by the control port
        assert stream.stopped_position == pytest.approx(controller.script.stream.position)
        assert state.joints == pytest.approx(controller.script.stream.position, abs=1e-6)
        assert robot._core.motion.stopped_joints is not None


def test_closing_stops_a_stream(connected):
    report = pytest.warns(RuntimeWarning, match="was stopped")
    with report, connected(**streams(speed=1)) as (robot, controller):
        robot.stream().append([0, 10], [[0.0] * 6, [0.1] * 6])
    assert controller.script.stream.state == TrajectoryState.STOPPED


def test_only_one_motion_at_a_time(connected):
    with connected(**streams(speed=1)) as (robot, _):
        robot.stream().append([0, 10], [[0.0] * 6, [0.1] * 6])
        with pytest.raises(NotReady, match="is active"):
            robot.stream().append([0, 10], [[0.0] * 6, [0.1] * 6])
        with pytest.raises(NotReady, match="is active"):
            robot.execute(Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=1))
        robot.stop()


def test_a_stream_that_has_ended_takes_nothing(connected):
    with connected(**streams()) as (robot, _):
        stream = robot.stream()
        stream.append([0, 1], [[0.0] * 6, [0.1] * 6])
        stream.end()
        stream.end()
        with pytest.raises(InvalidTrajectory, match="RG624"):
            stream.append([2], [[0.1] * 6])
        assert stream.result().points == 2


def test_a_driver_that_does_not_stream_gets_the_points_at_the_end(connected):
    with connected(capacity=50) as (robot, controller):
        assert any("accept points during a motion" in text for text in robot.driver.cannot)
        stream = robot.stream()
        stream.append([0.0, 0.1], [[0.0] * 6, [0.01] * 6])
        stream.flush()
        assert stream.mode == "download"
        assert stream.progress.total == 2
        with pytest.raises(InvalidTrajectory, match="point 2"):
            stream.append([0.2], [[9.0] * 6])
        stream.append([0.2], [[0.02] * 6])
        with pytest.raises(InvalidTrajectory, match="does not stream, holds 50"):
            stream.append(np.arange(3, 51) * 0.1, np.full((48, 6), 0.02))
        assert controller.points == []
        result = stream.result()
        assert (result.points, result.mode) == (3, "download")
        assert [d for _, d in controller.points] == pytest.approx([0.1, 0.1, 0.1])
        for what in (
            lambda: robot.stream(fallback=False).append([0], [[0.02] * 6]),
            lambda: robot.execute(Trajectory([0, 1], [[0.02] * 6] * 2), mode="stream"),
            robot.pause,
            lambda: robot.read_signal(0),
            lambda: robot.next_feedback(),
        ):
            with pytest.raises(NotSupported, match="RG624"):
                what()


def test_execute_tells_the_way(connected):
    short = Trajectory.from_points([[0.0] * 6, [0.01] * 6], seconds=0.1)
    long = Trajectory.from_points([[0.01 * (n > 30)] * 6 for n in range(100)], seconds=0.1)
    with connected(**streams(ring=64)) as (robot, _):
        execution = robot.execute(long)
        assert execution.mode == "stream"
        assert execution.planned_seconds == pytest.approx(10)
        assert execution.result().mode == "stream"
        execution = robot.execute(short.reversed(), mode="stream")
        assert execution.result().points == 2
        assert execution.trajectory.names == robot.group.names


def test_what_no_number_of_a_stream_holds_is_downloaded(connected):
    path = Trajectory(np.arange(70) * 2200.0, np.zeros((70, 6)))
    with connected(**streams(ring=64), capacity=1000) as (robot, _):
        assert robot.mode_for(path) == "download"
        with pytest.raises(InvalidTrajectory, match="RG623"):
            robot.execute(path, mode="stream")


def test_pause_speed_and_signals(fake, client, comes):
    controller = fake(**streams(speed=1))
    model = controller.script.stream
    with client(controller.address) as robot:
        stream = robot.stream()
        stream.append([0, 30], [[0.0] * 6, [0.3] * 6])
        robot.pause()
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.PAUSED, 60)
        assert comes(lambda: stream.progress.state is TrajectoryState.PAUSED)
        robot.resume()
        robot.set_speed(25)
        assert model.override == 0.25
        assert robot.read_signal(1) == 5.0
        assert robot.write_signal(0, 2.5) == 2.5
        assert model.signals[0] == 2.5
        with pytest.raises(RequestRefused, match="does not have this signal") as error:
            robot.read_signal(7)
        assert error.value.reason is Reason.NO_SIGNAL
        model.refuse_control = int(Reason.IDLE)
        with pytest.raises(RequestRefused, match="no trajectory is under way"):
            robot.pause()
        stream.cancel()


def test_signals_have_names_and_rights(fake, client):
    config = load_config("irb120")
    signals = (ExposedSignal("gripper", "DO", "write"), ExposedSignal("pressure", "AI", "read"))
    config = dataclasses.replace(config, signals=signals)
    controller = fake(**streams(), mapping=_mapping(config))
    with client(config, address=controller.address) as robot:
        assert robot.write_signal("gripper", 1) == 1.0
        assert robot.read_signal("pressure") == 5.0
        with pytest.raises(NotSupported, match="reading only"):
            robot.write_signal("pressure", 1)
        with pytest.raises(NotSupported, match="no signal 'griper'"):
            robot.read_signal("griper")


def _mapping(config):
    from rapidgen.client.core.group import Group

    return Group.of(config, config.groups[0]).mapping


def test_a_control_port_of_another_driver_is_left_alone(connected):
    with connected(**streams(), foreign_control=True) as (robot, controller):
        assert any("another driver answers" in text for text in robot.driver.cannot)
        with pytest.raises(NotSupported, match="another driver"):
            robot.pause()
        with robot.stream() as stream:
            stream.append([0, 1], [[0.0] * 6, [0.1] * 6])
        robot.stop()
        assert controller.script.stream.heartbeats == []


def test_stream_without_control_port_moves(fake, client):
    controller = fake(**streams())
    # Left out, it would follow from two ports that are by chance two apart.
    address = controller.address.rpartition(",")[0] + ",0"
    with client(address) as robot:
        assert any("the control port of" in text for text in robot.driver.cannot)
        with robot.stream() as stream:
            stream.append([0, 1], [[0.0] * 6, [0.1] * 6])


@pytest.mark.parametrize("received", [True, False])
def test_stop_goes_over_both_ports_and_one_of_them_may_be_silent(connected, received, comes):
    script = {**streams(speed=1), "control_hears_stop": received}
    with connected(**script, hasty={} if received else {"stop": 3}) as (robot, controller):
        stream = robot.stream()
        stream.append([0, 30], [[0.0] * 6, [0.3] * 6])
        robot.stop()
        assert comes(lambda: len(controller.stops) == (2 if received else 1))
        assert stream.stopped_position is not None
        with pytest.raises(MotionStopped):
            stream.result()


def test_replies_get_lost(connected, comes):
    with connected(**streams(lose_replies_from=5), hasty={"reply": 0.5}) as (robot, controller):
        with pytest.raises(RobotTimeout, match="did not answer a batch"):
            robot.stream().extend(wave())
        assert comes(lambda: controller.script.stream.state == TrajectoryState.STOPPED)


def test_events(connected, comes):
    with connected() as (robot, controller):
        data = struct.pack("<3i240s", 5, 24, 3, b"Corner path failure")
        strange = struct.pack("<3i240s", 1, 10, 9, b"?")
        missed = struct.pack("<3i240s", 0, 7, 2, b"")
        controller.extra = b"".join(frame(1308, 1, 0, report) for report in (data, strange, missed))
        assert comes(lambda: len(robot.events) == 3)
        first, second, third = robot.events
        assert str(third) == "7 events were dropped"
        assert str(first) == "50024 Corner path failure"
        assert first.type is EventType.ERROR
        assert second.type is EventType.ERROR, "of an unknown type"
        assert robot.next_event(60, after=first) == second
        with pytest.raises(RobotTimeout, match="no event"):
            robot.next_event(0.05)


def test_feedback(fake, client, comes):
    controller = fake()

    def report(time):
        pad = [0.0] * 4
        joints, rates = [0.1] * 6, [0.2] * 6
        return frame(15, 1, 0, struct.pack("<2if30f", 0, 7, time, *joints, *pad, *rates, *pad,
                                           *[0.0] * 10))  # fmt: skip

    with client(controller.address, feedback=True) as robot:
        controller.extra = report(999.5)
        assert comes(lambda: robot._core.state_port.feedbacks == 1)
        controller.repeated = report(0.5)
        feedback = robot.next_feedback()
        # where the wire's clock began again, this one goes on
        assert feedback.time == pytest.approx(1000.5)
        assert feedback.joints == pytest.approx([0.1] * 6)
        assert feedback.velocity == pytest.approx([0.2] * 6)
        assert feedback.names == robot.group.names
        controller.repeated = b""
        seen = robot.next_state().number
        robot.wait_until(lambda state: state.number > seen + 1, timeout=60)
        with pytest.raises(RobotTimeout):
            robot.next_feedback(0.05)


def test_the_limits_of_the_controller_count_where_they_are_narrower(fake, client):
    config = load_config("irb120")
    controller = fake(**streams(), mapping=_mapping(config))
    with client("irb120", address=controller.address) as robot:
        # the scripted driver tells 3 rad for all
        assert robot.group.joints[5].upper == pytest.approx(3.0)
        assert robot.group.joints[1].upper == config.groups[0].joints[1].upper
        assert robot.group.joints[1].upper < 3.0
