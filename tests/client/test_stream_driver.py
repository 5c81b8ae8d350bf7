"""Streams, pause, signals and events of our own driver, on the virtual clock."""

import numpy as np
import pytest
from driven import complaints, driven, robot_of, wave, wiggle

from rapidgen.client import (
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotSupported,
    RequestRefused,
    Timeouts,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.client.address import Address
from rapidgen.client.core import checks as client_checks
from rapidgen.client.flows import control
from rapidgen.config import load_config
from rapidgen.system.model import SignalSpec
from rapidgen.wire.simple_message.spec import EventType, Feature, Reason, TrajectoryState


def test_what_the_driver_can():
    with driven() as (robot, _):
        assert Feature.STREAMING | Feature.CONTROL in robot.driver.features
        assert robot.driver.cannot == ()


def test_a_stream_is_executed_point_for_point():
    with driven() as (robot, controller):
        with robot.recording() as recording, robot.stream() as stream:
            stream.extend(wave(300))
        result = stream.result()
        assert (result.points, result.mode, result.starved) == (300, "stream", 0)
        assert result.deviation < 1e-5
        assert result.seconds == pytest.approx(result.planned_seconds, abs=1.0)
        assert not complaints(controller)
    # Where the robot was seen, all joints go alike along the wave; nowhere else.
    seen = recording.positions
    assert np.ptp(seen, axis=1).max() < 1e-3
    assert -0.301 < seen.min() < -0.0
    assert 0.29 < seen.max() < 0.301


def test_motion_begins_at_once_however_long_the_trajectory():
    def begins(points, mode):
        with driven() as (robot, _):
            path = Trajectory(*map(np.array, zip(*wave(points), strict=True)))
            requested = robot.time()
            execution = robot.execute(path, mode=mode)
            state = robot.wait_until(lambda s: s.is_moving, 60)
            robot.stop()
            with pytest.raises(MotionStopped):
                execution.result()
            return state.time - requested

    short, long = begins(150, "stream"), begins(1000, "stream")
    assert long == pytest.approx(short, abs=0.1)
    assert long < begins(1000, "download") / 2


def test_a_fault_that_only_the_driver_finds(monkeypatch):
    with driven() as (robot, _):
        points = list(wave(200))
        points[120][1][2] = 9.0
        stream = robot.stream()
        for rule in ("_limits", "_speeds"):
            monkeypatch.setattr(client_checks, rule, lambda _: [])
        monkeypatch.setattr(client_checks, "quantised", lambda wire, group: wire)
        stream.extend(points)
        with pytest.raises(MotionFailed, match="point 120, joint_3: a joint is outside") as error:
            stream.result()
        assert (error.value.point, error.value.joint) == (120, 3)
        assert error.value.reason is Reason.JOINT_LIMIT
        assert error.value.reached == 120
        assert robot.next_state().joints == pytest.approx(points[119][1], abs=1e-5)
        # at the very first points nothing moves
        here = robot.state.joints
        bad = [here, (*here[:2], 9.0, *here[3:])]
        with pytest.raises(MotionFailed) as error:
            robot.stream().append([0, 1], bad)
        assert error.value.point == 1
        monkeypatch.undo()
        with robot.stream() as stream:
            stream.append([0, 1], [here, here])


@pytest.mark.parametrize("seconds", [0.3, 1.0, 7.77])
def test_stop_at_any_moment(seconds):
    with driven() as (robot, _):
        stream = robot.stream()
        filling = stream.later.extend(wave())
        robot.sleep(seconds)
        state = robot.stop()
        with pytest.raises(MotionStopped) as error:
            filling.result()
        assert error.value.reason is Reason.STOPPED
        robot.sleep(1)
        stood = robot.state.joints
        assert stood == pytest.approx(state.joints, abs=1e-4)
        assert stream.stopped_position == pytest.approx(stood, abs=1e-4)
        # on the path, along which all joints go alike
        assert np.ptp(stood) < 1e-3
        with robot.stream() as stream:
            stream.append([0, 1], [stood, stood])


def test_stop_after_first_points_stops():
    with driven() as (robot, _):
        stream = robot.stream()
        first = stream.later.append(*zip(*wave(30), strict=True))
        robot.sleep(0)
        robot.stop()

        def end():
            first.result()
            stream.result()

        with pytest.raises((MotionStopped, TrajectoryRefused)):
            end()
        here = robot.state.joints
        robot.sleep(5)
        assert robot.state.joints == here


def test_heartbeats_end_with_the_motion():
    with driven(timeouts=Timeouts(heartbeat=0.5)) as (robot, _):
        result = robot.execute(Trajectory(*[[0, 3], [[0.0] * 6, [0.1] * 6]])).result()
        assert result.mode == "download"
        robot.sleep(10)
        path = Trajectory([0, 3], [[0.1] * 6, [0.0] * 6])
        robot.execute(path).result()
        with pytest.raises(RequestRefused) as error:
            robot.set_speed(50)
        assert error.value.reason is Reason.IDLE


def test_a_download_is_paused_too():
    with driven() as (robot, _):
        execution = robot.execute(Trajectory([0, 5], [[0.0] * 6, [0.3] * 6]))
        robot.sleep(2)
        robot.pause()
        robot.sleep(60)
        assert not execution.is_over
        assert execution.progress.state is TrajectoryState.PAUSED
        robot.resume()
        assert execution.result().deviation < 1e-5


def test_signals_are_read_and_written(monkeypatch):
    overrides = {
        "signals.missing": {"kind": "AO", "access": "write"},
        "signals.gripper": {"kind": "DO", "access": "write"},
        "signals.present": {"kind": "DI"},
    }

    cell = [SignalSpec("gripper", "DO"), SignalSpec("present", "DI")]
    with driven(overrides=overrides, signals=cell) as (robot, controller):
        assert robot.read_signal("gripper") == 0
        assert robot.write_signal("gripper", 1) == 1
        assert controller.signals["gripper"] == 1
        assert robot.read_signal(2) == 0
        with pytest.raises(NotSupported, match="reading only"):
            robot.write_signal("present", 1)
        monkeypatch.setattr(control, "_index", lambda core, which, writes: which)
        for signal, value, reason in (
            (0, 1, Reason.NO_SIGNAL),
            (1, 0.5, Reason.BAD_VALUE),
            (2, 1, Reason.READ_ONLY),
            (3, 1, Reason.NO_SIGNAL),
        ):
            with pytest.raises(RequestRefused) as error:
                robot.write_signal(signal, value)
            assert error.value.reason is reason


def test_events_and_feedback():
    with driven(feedback=True) as (robot, controller):
        feedback = robot.next_feedback()
        again = robot.next_feedback()
        assert again.time - feedback.time == pytest.approx(0.1, abs=0.03)
        execution = robot.execute(Trajectory([0, 5], [[0.0] * 6, [0.3] * 6]))
        robot.sleep(2)
        moving = robot.next_feedback()
        assert moving.velocity == pytest.approx([0.06] * 6, abs=0.01)
        controller.set_e_stop(True)
        with pytest.raises(MotionFailed) as error:
            execution.result()
        assert error.value.reason is Reason.EMERGENCY_STOP
        robot.sleep(2)
        assert robot.events
        assert {event.type for event in robot.events} <= set(EventType)
        report = {event.code for event in robot.events}
        assert report & {event.code for event in controller.log}


def test_two_arms_stream_each_for_itself():
    with driven("irb14000") as (first, _):
        second = first.open_another(
            robot_of(load_config("irb14000"), load_config("irb14000").groups[1])
        )
        second.connect()
        streams, fillings = [], []
        for robot in (first, second):
            here = np.array(robot.state.joints)
            points = [(n * 0.1, here + 0.05 * np.sin(n * 0.05)) for n in range(200)]
            streams.append(robot.stream())
            fillings.append(streams[-1].later.extend(points))
        for filling in fillings:
            filling.result()
        assert max(stream.result().deviation for stream in streams) < 1e-3
        second.close()


def test_no_control_port():
    with driven(overrides={"ports.control": 0}) as (robot, _):
        assert Feature.CONTROL not in robot.driver.features
        with pytest.raises(NotSupported, match="no control port"):
            robot.pause()
        with robot.stream() as stream:
            stream.extend(wave(50))
        robot.stop()


def test_a_newer_client_ends_a_motion_by_a_sound_order_and_by_nothing_before():
    with driven() as (first, _):
        filling = first.stream().later.extend(wave())
        first.sleep(5)
        second = first.open_another(robot_of(load_config("irb120")))
        second.connect()
        far = Trajectory([0, 1], [[0.0] * 6, [9.0] * 6])
        with pytest.raises(InvalidTrajectory):
            second.execute(far)
        first.sleep(3)
        assert not filling.done()
        assert first.state.is_moving
        second.execute(wiggle(second)).result()
        with pytest.raises(Exception, match=r"lost|another|client") as error:
            filling.result()
        assert error.value.diagnostics
        state = second.wait_until(lambda s: not s.is_moving, 5)
        first.sleep(2)
        assert second.next_state().joints == pytest.approx(state.joints, abs=1e-4)
        second.close()


def test_a_socket_of_another_robot_is_not_taken_for_the_control_port():
    first, second = load_config("irb14000").groups
    address = Address("controller", first.ports.motion, first.ports.state, second.ports.control)
    with driven("irb14000", address=address) as (robot, _):
        assert any("another driver" in text for text in robot.driver.cannot)
