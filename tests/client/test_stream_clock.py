"""AsyncRobot streams to a scripted driver on a simulated clock: long ones, and exact times."""

import asyncio
import itertools
import tracemalloc
from collections import deque
from contextlib import contextmanager, suppress

import numpy as np
import pytest
from both_clients import Simulated
from driven import complaints, driven, wave
from fake_stream import DONE, StreamModel
from simulated_clock import SimulatedDriver, SimulatedLoop

from rapidgen.client import (
    AsyncRobot,
    ConnectionLost,
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotReady,
    RobotTimeout,
    Timeouts,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.client.core import checks as checks_module
from rapidgen.wire.simple_message import spec
from rapidgen.wire.simple_message.spec import Feature, Reason, TrajectoryState

NOT_IN_TIME = 195901
"""Event of the virtual controller: a move took longer than was programmed."""


@contextmanager
def streamed(*, control=True, timeouts=None, state_period=0.1, pace=1, latencies=None, **options):
    """A connected robot, under the calls of a Robot, and its driver."""
    driver = SimulatedDriver(
        StreamModel(**options), control=control, state_period=state_period, pace=pace
    )
    driver.latencies = latencies or {}
    target = AsyncRobot("127.0.0.1", timeouts=timeouts)
    with Simulated(target, SimulatedLoop(driver)) as robot:
        yield robot, driver


@pytest.fixture(params=[streamed, driven], ids=["scripted", "ours"])
def carried(request):
    """The same with a scripted driver and with our own on the virtual controller."""
    return request.param


def test_append_single_point_is_sent():
    with streamed() as (robot, _), robot.stream() as stream:
        for time, joints in wave(30):
            stream.append(time, joints)
        assert stream.total == 30
        with pytest.raises(InvalidTrajectory):
            stream.append(9.0, 0.5)
        with pytest.raises(InvalidTrajectory):
            stream.append("soon", [0.0] * 6)


def test_it_starves_stands_and_goes_on(carried):
    with carried() as (robot, peer):
        points = list(wave(40))
        stream = robot.stream()
        stream.append(*zip(*points[:20], strict=True))
        state = robot.wait_until(lambda s: s.trajectory is TrajectoryState.STARVED, 20)
        assert stream.progress.state is TrajectoryState.STARVED
        assert stream.progress.reached == 20
        assert state.joints == pytest.approx(points[19][1], abs=1e-6)
        assert stream.starved == 1
        assert any("ran out of points at point 20" in text for _, text in robot.messages)
        # less than the driver's start threshold: it waits for more, or for FLUSH
        stream.append(*zip(*points[20:22], strict=True))
        robot.sleep(3)
        assert stream.progress.state is TrajectoryState.STARVED
        stream.flush()
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.MOVING, 1)
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.STARVED, 10)
        stream.append(*zip(*points[22:], strict=True))
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.MOVING, 1)
        result = stream.result()
        assert (result.points, result.starved) == (40, 2)
        assert result.deviation < 1e-5
        # a controlled stop on the path: no corner path failure
        assert not complaints(peer)


def test_pause_resume_and_speed(carried):
    with carried() as (robot, peer):
        stream = robot.stream()
        stream.append(*zip(*wave(100), strict=True))
        robot.sleep(2)
        robot.pause()
        state = robot.wait_until(lambda s: s.trajectory is TrajectoryState.PAUSED, 5)
        robot.sleep(20)
        held = robot.state.joints
        assert held == pytest.approx(state.joints, abs=0.02)
        # however long the pause is: no time-out
        waiting = stream.later.result()
        robot.sleep(600)
        assert robot.state.joints == held
        assert not waiting.done()
        began = robot.time()
        robot.resume()
        robot.set_speed(50)
        result = waiting.result()
        assert result.points == 100
        assert result.deviation < 1e-5
        assert robot.time() - began == pytest.approx(2 * 8, abs=1)
        assert {event.code for event in complaints(peer)} <= {NOT_IN_TIME}
        with pytest.raises(ValueError, match="1 to 100"):
            robot.set_speed(0)


def test_a_client_that_dies_is_missed(carried):
    with carried(timeouts=Timeouts(heartbeat=1)) as (robot, _):
        stream = robot.stream()
        stream.append(*zip(*wave(100), strict=True))
        robot.sleep(2)
        # as a process that was frozen: its timers do not run, its kernel keeps the connections
        robot._runner._timer.cancel()
        robot._runner._pump, pump = lambda: None, robot._runner._pump
        robot.sleep(3)
        here = robot.state
        assert not here.is_moving
        assert here.trajectory is TrajectoryState.FAILED
        robot._runner._pump = pump
        with pytest.raises(MotionFailed, match="client") as error:
            stream.result()
        assert error.value.reason is Reason.CLIENT_LOST
        assert robot.state.joints == here.joints


def test_a_hundred_thousand_points():
    count = 100_000

    with streamed(state_period=0.5) as (robot, driver):
        with robot.stream() as stream:
            stream.extend(wave(count))
        result = stream.result()
    model = driver.model
    assert model.reached == result.points == count
    assert model.state == DONE
    assert result.starved == 0
    assert result.mode == "stream"
    assert result.deviation < 1e-6
    # without a stall: it took the time of its points and no more
    assert result.seconds == pytest.approx(0.1 * count, abs=2.0)
    assert model.most_waiting <= model.ring
    # 30 points a message but for a few
    assert np.mean(model.sizes) > 28
    requested = [q for _, q in wave(count)]
    executed = [q for _, q in model.executed]
    assert np.abs(np.array(executed) - np.array(requested)).max() <= 0.5e-6 + 1e-12
    # nothing adds up: the durations of all points give the time of the last
    assert sum(round(d * 1e6) for d, _ in model.executed) == round(0.1 * count * 1e6)


def test_a_stream_without_end_needs_no_more_memory_the_longer_it_is():
    with streamed() as (robot, driver):
        driver.model.keep = False
        driver.log = deque(maxlen=10)
        points, marks = wave(), []
        tracemalloc.start()
        stream = robot.stream()
        for _ in range(4):
            stream.extend(itertools.islice(points, 1500))
            marks.append(tracemalloc.get_traced_memory()[0])
        tracemalloc.stop()
        stream.cancel()
    # 3,000 points kept would be more than 500,000 bytes
    assert abs(marks[-1] - marks[1]) < 100_000


def test_motion_begins_before_the_last_point_was_made():
    with streamed() as (robot, driver):
        seen = []

        def points():
            for n, (t, q) in enumerate(wave(3000)):
                seen.append((n, driver.model.reached))
                yield t, q

        with robot.stream() as stream:
            stream.extend(points())
        first = next(n for n, reached in seen if reached)
        first, ahead = first, max(n - reached for n, reached in seen)
    # what the client makes ahead is bounded by the ring and a few batches
    assert first <= driver.model.ring + 4 * 30
    assert ahead <= driver.model.ring + 4 * 30


def test_indices_wrap(monkeypatch):
    # 2^23 points would take too long: fewer bits, the same arithmetic
    import fake_stream

    from rapidgen.client.core import stream as module
    from rapidgen.wire.simple_message import numpy_codec

    for place in (module, numpy_codec):
        monkeypatch.setattr(place, "INDEX_WRAP", 512)
    monkeypatch.setattr(fake_stream, "WRAP", 512)

    with streamed() as (robot, driver):
        with robot.stream() as stream:
            stream.extend(wave(3000))
            progress = stream.progress
        progress, result = progress, stream.result()
    assert result.points == 3000
    assert 2700 < progress.reached <= progress.planned <= progress.received <= 3000
    assert driver.model.reached == 3000


def test_unwrapping():
    from rapidgen.client.core.stream import unwrapped

    wrap = spec.INDEX_WRAP
    assert unwrapped(5, 3) == 5
    assert unwrapped(3, 5) == 3
    assert unwrapped(2, wrap - 1) == wrap + 2
    assert unwrapped(wrap - 2, 3 * wrap + 1) == 3 * wrap - 2


def test_a_ring_that_holds_less_than_the_driver_likes_to_have():
    with streamed(preload=60.0, ring=100) as (robot, driver):
        with robot.stream() as stream:
            stream.extend(wave(1000))
        result = stream.result()
    assert (result.points, result.starved) == (1000, 0)
    # the end and the order to start, and no other question
    assert driver.model.sizes.count(0) <= 2


def test_times_are_put_on_the_grid_and_not_durations():
    step = 0.1000004

    with streamed() as (robot, driver), robot.stream() as stream:
        stream.extend(itertools.islice(wave(step=step), 1000))
    durations = [d for d, _ in driver.model.executed]
    # the first is that of the way to where the robot stands
    assert sum(round(d * 1e6) for d in durations[1:]) == round(999 * step * 1e6)
    assert {round(d * 1e6) for d in durations[1:]} == {100_000, 100_001}


def test_no_segment_gets_shorter_than_the_driver_takes_by_rounding():
    with streamed() as (robot, driver), robot.stream() as stream:
        stream.append([0.0, 0.1000006, 0.2000004], [[0.0] * 6] * 3)
    assert [round(d * 1e6) for d, _ in driver.model.executed] == [100_000, 100_001, 100_000]


def test_points_that_are_read_after_the_stop_do_not_move_it():
    with streamed() as (robot, driver):
        # The control server is quick, the motion server has not read the first points yet.
        driver.latencies[driver.MOTION] = 0.3
        stream = robot.stream()
        first = stream.later.append([0, 1], [[0.0] * 6, [0.1] * 6])
        robot.sleep(0.01)
        robot.stop()
        with suppress(MotionStopped, TrajectoryRefused):
            first.result()
        robot.sleep(5)
        ports = [port for _, port, number in driver.log if number == 11]
        assert ports == [driver.CONTROL, driver.MOTION]
    assert driver.model.state == TrajectoryState.STOPPED
    assert driver.model.executed == []


def test_a_lost_control_connection_is_missed_by_the_controller():
    with streamed() as (robot, _):
        filling = robot.stream().later.extend(wave())
        robot.sleep(5)
        control = next(
            link for port, link in robot._runner._by_port.items() if port.name == "CONTROL"
        )
        control.transport.close()
        with pytest.raises(MotionFailed, match="client") as error:
            filling.result()
        assert error.value.reason is Reason.CLIENT_LOST


def test_a_controller_that_takes_no_heartbeat():
    with streamed() as (robot, driver):
        driver.model.refuse_control = int(Reason.NOT_ALLOWED)
        with robot.stream() as stream:
            stream.append([0, 10], [[0.0] * 6, [0.1] * 6])
        requested = [number for _, port, number in driver.log if number == 1306]
    assert len(requested) == 1


def test_who_sees_nothing_sends_no_heartbeat_either():
    with streamed() as (robot, driver):
        stream = robot.stream()
        stream.append(*zip(*wave(100), strict=True))
        robot.sleep(2)
        # No STOP gets through, and no state comes.
        driver.model.control, hear = (
            lambda number, data: b"" if number == 11 else hear(number, data),
            driver.model.control,
        )
        driver.model.halt, halt = lambda *_: None, driver.model.halt
        state = next(link for port, link in robot._runner._by_port.items() if port.name == "STATE")
        state.transport.close()
        robot.sleep(0.2)
        assert driver.model.state == TrajectoryState.MOVING
        driver.model.halt = halt
        robot.sleep(2.5)
        driver.model.advance(driver.loop.time())
        assert driver.model.reason == Reason.CLIENT_LOST
        driver.model.control = hear


def test_append_invalid_point_is_rejected_and_stream_continues():
    with streamed() as (robot, driver):
        with robot.stream() as stream:
            stream.append([0.0, 0.2], [[0.0] * 6, [0.01] * 6])
            for times, joint, code in (
                ([0.3, 0.4], [9.0] * 6, "RG614"),
                ([0.2, 0.4], [0.0] * 6, "RG612"),
                ([0.25, 0.4], [0.01] * 6, "RG618"),
                ([0.3, float("nan")], [0.0] * 6, "RG613"),
                ([0.3, 0.4], [2.9] * 6, "RG615"),
                ([0.3, 2500.0], [0.01] * 6, "RG623"),
            ):
                with pytest.raises(InvalidTrajectory) as error:
                    stream.append(times, [[0.01] * 6, joint])
                assert {d.code for d in error.value.diagnostics} >= {code}
                if code in ("RG614", "RG615"):
                    # points have their numbers in the stream
                    assert "point 3" in str(error.value)
            stream.append([0.4], [[0.02] * 6])
        result = stream.result()
    assert result.points == 3
    assert [d for d, _ in driver.model.executed] == [0.1, 0.2, 0.2]


@pytest.mark.parametrize("far", [True, False])
def test_the_first_point_is_where_the_robot_stands(far):
    with streamed() as (robot, driver):
        with pytest.raises(InvalidTrajectory, match="does not start"):
            robot.stream().append([0.0], [[0.5 if far else 0.02] * 6])
        # no motion was started
        with robot.stream() as stream:
            stream.append([0.0, 1.0], [[0.0] * 6, [0.1] * 6])
    assert driver.model.trajectory == 1


def test_one_message_with_the_state_of_before_is_not_believed():
    # it does not move before the end has come
    with streamed(preload=60.0) as (robot, driver):
        stream = robot.stream()
        progress, report = driver.model.progress, []

        def stale():
            # put together of two tasks' data: this trajectory's number, the state of another
            data = progress()
            if driver.model.reached == 0 and not report:
                report.append(data)
                return data[:20] + DONE.to_bytes(4, "little") + data[24:]
            return data

        driver.model.progress = stale
        stream.append([0, 10], [[0.0] * 6, [0.1] * 6])
        robot.sleep(0.5)
        assert report
        assert not stream.is_over
        assert stream.result().seconds > 9


@pytest.mark.parametrize("control", [True, False])
def test_stop_and_what_stands(control):
    with streamed(control=control) as (robot, driver):
        stream = robot.stream()
        filling = stream.later.extend(wave())
        robot.sleep(30)
        requested = driver.loop.time()
        state = robot.stop()
        with pytest.raises(MotionStopped) as error:
            filling.result()
        assert error.value.reason is Reason.STOPPED
        with pytest.raises(MotionStopped):
            stream.append([1e6], [[0.0] * 6])
        assert stream.stopped_position == pytest.approx(state.joints)
        stops = [(t, port) for t, port, number in driver.log if number == 11]
        assert stops[0] == (pytest.approx(requested + 0.001), driver.CONTROL if control else 11000)
        # and the next one
        with robot.stream() as stream:
            stream.append([0, 1], [state.joints, state.joints])
    assert driver.model.trajectory == 2
    # no frame of the stopped stream after the STOP
    first = next(n for n, (_, _, number) in enumerate(driver.log) if number == 11)
    after = [entry for entry in driver.log[first + 1 :] if entry[2] == 1302]
    assert len(after) == 1 + (after[0][0] != after[-1][0])


def test_an_exception_in_the_block_stops_the_robot():
    with streamed() as (robot, driver):

        def fail(stream):
            with stream:
                stream.append([0, 5], [[0.0] * 6, [0.1] * 6])
                stream.flush()
                robot.sleep(1)
                raise ZeroDivisionError

        stream = robot.stream()
        with pytest.raises(ZeroDivisionError):
            fail(stream)
        assert stream.is_over
    assert driver.model.state == TrajectoryState.STOPPED


def test_heartbeats_come_while_it_moves_and_end_with_it():
    with streamed(timeouts=Timeouts(heartbeat=2)) as (robot, driver):
        with robot.stream() as stream:
            stream.append([0, 10], [[0.0] * 6, [0.1] * 6])
        robot.sleep(5)
        beats = driver.model.heartbeats
    assert beats[-1] == 0
    assert set(beats[:-1]) == {2}
    # every half second, on a clock of 0.1 s
    assert 15 <= len(beats) <= 25


@pytest.mark.parametrize(("pace", "slack"), [(1, 1), (10, 3)])
def test_heartbeat_timeout_scales_with_simulation_rate(pace, slack):
    """As long as a controller would wait is a moment on a clock that runs ten times as fast."""

    with streamed(timeouts=Timeouts(heartbeat=2), pace=pace) as (robot, driver):
        with robot.stream() as stream:
            stream.append([0, 2], [[0.0] * 6, [0.1] * 6])
        stream.result()
        # no heartbeat is asked for before the pace is known
        first = next(time for time, _, number in driver.log if number == 1306)
        first, beats = first, [beat for beat in driver.model.heartbeats if beat]
    assert first > 0.4
    assert beats == pytest.approx([2 * pace * slack] * len(beats), rel=0.01)


def test_heartbeats_come_with_a_download_too_and_not_without_a_motion():
    with streamed() as (robot, driver):
        robot.sleep(10)
        assert not driver.model.heartbeats
        stream = robot.stream()
        stream.append([0, 1], [[0.0] * 6, [0.1] * 6])
        driver.model.control(1306, b"\0\0\0\0")
        stream.result()


def test_heartbeats_disabled_are_not_sent():
    with streamed(timeouts=Timeouts(heartbeat=0)) as (robot, driver):
        with robot.stream() as stream:
            stream.append([0, 3], [[0.0] * 6, [0.1] * 6])
        assert driver.model.heartbeats == []


@pytest.mark.parametrize(
    ("port", "period"),
    [(SimulatedDriver.CONTROL, 0.1), (SimulatedDriver.STATE, 0.9)],
    ids=["control", "state"],
)
def test_a_busy_machine_that_answers_late_is_no_other_driver(port, period):
    with streamed(latencies={port: 2.0}, state_period=period) as (robot, _):
        assert Feature.CONTROL in robot.driver.features
        assert robot.driver.cannot == ()


@pytest.mark.parametrize(("period", "seconds"), [(0.1, 1.0), (0.9, 2.7), (4.0, 6.0)])
def test_a_driver_that_never_answers_is_a_plain_one(period, seconds):
    """After 1 s and four states, and 5 s more at most."""
    with streamed(latencies={SimulatedDriver.STATE: 1e6}, state_period=period) as (robot, driver):
        assert robot.driver.hello is None
        assert driver.loop.time() == pytest.approx(seconds, abs=0.05)


def test_a_control_port_that_falls_silent_stops_the_motion():
    with streamed() as (robot, driver):
        stream = robot.stream()
        filling = stream.later.extend(wave())
        robot.sleep(5)
        driver.model.control = lambda *_: b""
        driver.model.heartbeat_until = None
        with pytest.raises(RobotTimeout, match="control port"):
            filling.result()
        robot.sleep(0.5)
    # the motion port is there
    assert driver.model.state == TrajectoryState.STOPPED
    assert any(port == 11000 for _, port, number in driver.log if number == 11)


def test_lost_connection_without_waiter_stops_motion():
    with streamed() as (robot, driver):
        stream = robot.stream()
        stream.append(*zip(*wave(100), strict=True))
        robot.sleep(2)
        state = next(link for port, link in robot._runner._by_port.items() if port.name == "STATE")
        state.transport.close()
        robot.sleep(0.5)
        assert driver.model.state == TrajectoryState.STOPPED
        with pytest.raises(ConnectionLost):
            stream.result()


def test_a_long_trajectory_is_streamed_and_a_short_one_is_not():
    with streamed() as (robot, driver):
        short = Trajectory.from_points([[0.0] * 6] * 128, seconds=0.1)
        assert robot.mode_for(short) == "download"
        long = Trajectory.from_points([[0.0] * 6] * 5000, seconds=0.1)
        robot.check(long)
        execution = robot.execute(long)
        assert execution.mode == "stream"
        # 1,000 are the most that the driver holds as a whole
        with pytest.raises(NotReady):
            robot.execute(long, mode="download")
        began = driver.model.reached
        result = execution.result()
        assert execution.trajectory.positions.shape == (5000, 6)
        with pytest.raises(InvalidTrajectory, match="holds 1000"):
            robot.execute(long, mode="download")
    assert began < 128
    assert result.points == 5000
    assert result.mode == "stream"


@pytest.mark.parametrize(
    ("points", "mode"),
    [(100, None), (5000, None), (100, "download"), (100, "stream"), (0, "append")],
)
def test_a_trajectory_is_checked_once(monkeypatch, points, mode):
    checks, finite = [], checks_module._finite
    monkeypatch.setattr(checks_module, "_finite", lambda *a: checks.append(a) or finite(*a))

    with streamed() as (robot, _):
        if mode == "append":
            robot.stream().append([0, 1], [[0.0] * 6] * 2)
        else:
            robot.execute(Trajectory.from_points([[0.0] * 6] * points, seconds=0.1), mode=mode)
        robot.stop()
    assert len(checks) == 1


def test_stream_stopped_by_another_client_ends():
    with streamed() as (robot, driver):
        filling = robot.stream().later.extend(wave())
        robot.sleep(5)
        driver.model.halt(TrajectoryState.STOPPED, Reason.STOPPED)
        with pytest.raises(MotionStopped, match="another request"):
            filling.result()


def test_cancelling_an_append_stops_the_robot():
    with streamed() as (robot, driver):
        filling = robot.stream().later.extend(wave())
        robot.sleep(5)
        filling.cancel()
        with pytest.raises(asyncio.CancelledError):
            filling.result()
        robot.sleep(0.5)
    assert driver.model.state == TrajectoryState.STOPPED
