"""Streams, pause, signals, events: AsyncRobot against our own driver, on the virtual clock."""

import asyncio
import itertools
from dataclasses import replace

import numpy as np
import pytest
from test_virtual_clock import booted, robot_of

from rapidgen.client import (
    AsyncRobot,
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
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.system.model import SignalSpec
from rapidgen.testing.asyncio_clock import run
from rapidgen.wire.simple_message.spec import EventType, Feature, Reason, TrajectoryState

NOT_IN_TIME = 59901
"""Event of the virtual controller: a move took longer than was programmed."""


def wave(count=None, step=0.1, speed=0.02):
    for n in itertools.count() if count is None else range(count):
        yield n * step, [0.3 * np.sin(n * speed)] * 6


def with_robot(main, *, name="irb120", overrides=None, signals=(), **options):
    """What `main(robot, controller)` gives."""
    if overrides:
        config = load_config(name, overrides=overrides)
        system = make_system(config, build(config))
        # Signals of the cell are the controller's own, no part of the driver.
        system = replace(system, signals=(*system.signals, *signals))
        controller = VirtualController(system, config.groups)
        controller.run_for(2.0)
    else:
        controller, config = booted(name)

    async def call():
        async with robot_of(config, **options) as robot:
            return await main(robot, controller)

    with controller:
        return run(controller, call())


def complaints(controller):
    return [event for event in controller.log if event.type.name != "INFO"]


def test_what_the_driver_can():
    async def main(robot, controller):
        assert Feature.STREAMING | Feature.CONTROL in robot.driver.features
        assert robot.driver.cannot == ()

    with_robot(main)


def test_a_stream_is_executed_point_for_point():
    async def main(robot, controller):
        with robot.recording() as recording:
            async with robot.stream() as stream:
                await stream.extend(wave(300))
        result = await stream.result()
        assert (result.points, result.way, result.starved) == (300, "stream", 0)
        assert result.deviation < 1e-5
        assert result.seconds == pytest.approx(result.planned_seconds, abs=1.0)
        assert not complaints(controller)
        return recording

    recording = with_robot(main)
    # Where the robot was seen, all joints go alike along the wave; nowhere else.
    seen = recording.positions
    assert np.ptp(seen, axis=1).max() < 1e-3
    assert -0.301 < seen.min() < -0.0
    assert 0.29 < seen.max() < 0.301


def test_motion_begins_at_once_however_long_the_trajectory():
    def begins(points, way):
        async def main(robot, controller):
            path = Trajectory(*map(np.array, zip(*wave(points), strict=True)))
            asked = asyncio.get_running_loop().time()
            execution = await robot.execute(path, way=way)
            state = await robot.wait_until(lambda s: s.is_moving, 60)
            await robot.stop()
            with pytest.raises(MotionStopped):
                await execution.result()
            return state.time - asked

        return with_robot(main)

    short, long = begins(150, "stream"), begins(1000, "stream")
    assert long == pytest.approx(short, abs=0.1)
    assert long < begins(1000, "download") / 2


def test_starved_and_going_on():
    async def main(robot, controller):
        points = list(wave(60))
        stream = robot.stream()
        await stream.append(*zip(*points[:30], strict=True))
        state = await robot.wait_until(lambda s: s.trajectory is TrajectoryState.STARVED, 20)
        assert state.joints == pytest.approx(points[29][1], abs=1e-5)
        assert stream.progress.reached == 30
        await stream.append(*zip(*points[30:], strict=True))
        result = await stream.result()
        assert (result.points, result.starved) == (60, 1)
        assert result.deviation < 1e-5
        # a controlled stop on the path: no corner path failure
        assert not complaints(controller)

    with_robot(main)


def test_a_fault_that_only_the_driver_finds(monkeypatch):
    def unchecked(ordered, group, wire, durations, start, before):
        return []

    async def main(robot, controller):
        points = list(wave(200))
        points[120][1][2] = 9.0
        stream = robot.stream()
        monkeypatch.setattr(client_checks, "_content", unchecked)
        monkeypatch.setattr(client_checks, "on_the_grid", lambda wire, group: wire)
        await stream.extend(points)
        with pytest.raises(MotionFailed, match="point 120, joint_3: a joint is outside") as error:
            await stream.result()
        assert (error.value.point, error.value.joint) == (120, 3)
        assert error.value.reason is Reason.JOINT_LIMIT
        assert error.value.reached == 120
        assert (await robot.next_state()).joints == pytest.approx(points[119][1], abs=1e-5)
        # at the very first points nothing moves
        here = robot.state.joints
        bad = [here, (*here[:2], 9.0, *here[3:])]
        with pytest.raises(MotionFailed) as error:
            await robot.stream().append([0, 1], bad)
        assert error.value.point == 1
        monkeypatch.undo()
        async with robot.stream() as stream:
            await stream.append([0, 1], [here, here])

    with_robot(main)


@pytest.mark.parametrize("seconds", [0.3, 1.0, 7.77])
def test_stop_at_any_moment(seconds):
    async def main(robot, controller):
        stream = robot.stream()
        filling = asyncio.ensure_future(stream.extend(wave()))
        await asyncio.sleep(seconds)
        state = await robot.stop()
        with pytest.raises(MotionStopped) as error:
            await filling
        assert error.value.reason is Reason.STOPPED
        await asyncio.sleep(1)
        stood = robot.state.joints
        assert stood == pytest.approx(state.joints, abs=1e-4)
        assert stream.stopped_position == pytest.approx(stood, abs=1e-4)
        # on the path, along which all joints go alike
        assert np.ptp(stood) < 1e-3
        async with robot.stream() as stream:
            await stream.append([0, 1], [stood, stood])

    with_robot(main)


def test_stop_right_behind_the_first_points_stops():
    async def main(robot, controller):
        stream = robot.stream()
        first = asyncio.ensure_future(stream.append(*zip(*wave(30), strict=True)))
        await asyncio.sleep(0)
        await robot.stop()

        async def end():
            await first
            await stream.result()

        with pytest.raises((MotionStopped, TrajectoryRefused)):
            await end()
        here = robot.state.joints
        await asyncio.sleep(5)
        assert robot.state.joints == here

    with_robot(main)


def test_pause_resume_and_speed():
    async def main(robot, controller):
        stream = robot.stream()
        await stream.append(*zip(*wave(100), strict=True))
        await asyncio.sleep(2)
        await robot.pause()
        state = await robot.wait_until(lambda s: s.trajectory is TrajectoryState.PAUSED, 5)
        await asyncio.sleep(20)
        assert robot.state.joints == pytest.approx(state.joints, abs=0.02)
        held = robot.state.joints
        await asyncio.sleep(20)
        assert robot.state.joints == held
        await robot.resume()
        await robot.set_speed(50)
        began = asyncio.get_running_loop().time()
        result = await stream.result()
        took = asyncio.get_running_loop().time() - began
        assert result.points == 100
        assert result.deviation < 1e-5
        assert 14 < took < 20
        assert {event.code for event in complaints(controller)} <= {NOT_IN_TIME}
        with pytest.raises(RequestRefused) as error:
            await robot.set_speed(50)
        assert error.value.reason is Reason.IDLE

    with_robot(main)


def test_a_client_that_freezes_is_missed():
    async def main(robot, controller):
        stream = robot.stream()
        await stream.append(*zip(*wave(100), strict=True))
        await asyncio.sleep(2)
        robot._carrier._timer.cancel()
        pump, robot._carrier._pump = robot._carrier._pump, lambda: None
        await asyncio.sleep(3)
        here = robot.state
        assert not here.is_moving
        robot._carrier._pump = pump
        with pytest.raises(MotionFailed) as error:
            await stream.result()
        assert error.value.reason is Reason.CLIENT_LOST
        assert robot.state.joints == here.joints

    with_robot(main, timeouts=Timeouts(heartbeat=1))


def test_heartbeats_end_with_the_motion():
    async def main(robot, controller):
        result = await (await robot.execute(Trajectory(*[[0, 3], [[0.0] * 6, [0.1] * 6]]))).result()
        assert result.way == "download"
        await asyncio.sleep(10)
        path = Trajectory([0, 3], [[0.1] * 6, [0.0] * 6])
        await (await robot.execute(path)).result()

    with_robot(main, timeouts=Timeouts(heartbeat=0.5))


def test_a_download_is_paused_too():
    async def main(robot, controller):
        execution = await robot.execute(Trajectory([0, 5], [[0.0] * 6, [0.3] * 6]))
        await asyncio.sleep(2)
        await robot.pause()
        await asyncio.sleep(60)
        assert not execution.is_over
        assert execution.progress.state is TrajectoryState.PAUSED
        await robot.resume()
        assert (await execution.result()).deviation < 1e-5

    with_robot(main)


def test_signals_are_read_and_written(monkeypatch):
    overrides = {
        "signals.missing": {"kind": "AO", "access": "write"},
        "signals.gripper": {"kind": "DO", "access": "write"},
        "signals.present": {"kind": "DI"},
    }

    async def main(robot, controller):
        assert await robot.read_signal("gripper") == 0
        assert await robot.write_signal("gripper", 1) == 1
        assert controller.signals["gripper"] == 1
        assert await robot.read_signal(2) == 0
        with pytest.raises(NotSupported, match="reading only"):
            await robot.write_signal("present", 1)
        monkeypatch.setattr(control, "_index", lambda core, which, writes: which)
        for signal, value, reason in (
            (0, 1, Reason.NO_SIGNAL),
            (1, 0.5, Reason.BAD_VALUE),
            (2, 1, Reason.READ_ONLY),
            (3, 1, Reason.NO_SIGNAL),
        ):
            with pytest.raises(RequestRefused) as error:
                await robot.write_signal(signal, value)
            assert error.value.reason is reason

    cell = [SignalSpec("gripper", "DO"), SignalSpec("present", "DI")]
    with_robot(main, overrides=overrides, signals=cell)


def test_events_and_feedback():
    async def main(robot, controller):
        feedback = await robot.next_feedback()
        again = await robot.next_feedback()
        assert again.time - feedback.time == pytest.approx(0.1, abs=0.03)
        execution = await robot.execute(Trajectory([0, 5], [[0.0] * 6, [0.3] * 6]))
        await asyncio.sleep(2)
        moving = await robot.next_feedback()
        assert moving.velocity == pytest.approx([0.06] * 6, abs=0.01)
        controller.set_e_stop(True)
        with pytest.raises(MotionFailed) as error:
            await execution.result()
        assert error.value.reason is Reason.EMERGENCY_STOP
        await asyncio.sleep(2)
        assert robot.events
        assert {event.type for event in robot.events} <= set(EventType)
        told = {event.code for event in robot.events}
        assert told & {event.code for event in controller.log}

    with_robot(main, feedback=True)


def test_two_arms_stream_each_for_itself():
    controller, config = booted("irb14000")

    async def main():
        robots = [robot_of(config, group) for group in config.groups]
        for robot in robots:
            await robot.connect()

        async def swing(robot):
            here = np.array(robot.state.joints)
            async with robot.stream() as stream:
                await stream.extend((n * 0.1, here + 0.05 * np.sin(n * 0.05)) for n in range(200))
            return (await stream.result()).deviation

        assert max(await asyncio.gather(*map(swing, robots))) < 1e-3
        for robot in robots:
            await robot.close()

    with controller:
        run(controller, main())


def test_no_control_port():
    async def main(robot, controller):
        assert Feature.CONTROL not in robot.driver.features
        with pytest.raises(NotSupported, match="no control port"):
            await robot.pause()
        async with robot.stream() as stream:
            await stream.extend(wave(50))
        await robot.stop()

    with_robot(main, overrides={"ports.control": 0})


def test_a_newer_client_takes_the_motion_port_and_the_stream_ends():
    controller, config = booted()

    async def main():
        first, second = robot_of(config), robot_of(config)
        await first.connect()
        filling = asyncio.ensure_future(first.stream().extend(wave()))
        await asyncio.sleep(5)
        await second.connect()
        with pytest.raises(Exception, match=r"lost|another|client") as error:
            await filling
        assert error.value.diagnostics
        state = await second.wait_until(lambda s: not s.is_moving, 5)
        await asyncio.sleep(2)
        assert (await second.next_state()).joints == pytest.approx(state.joints, abs=1e-4)
        await second.close()
        await first.close()

    with controller:
        run(controller, main())


def test_a_socket_of_another_robot_is_not_taken_for_the_control_port():
    controller, config = booted("irb14000")
    first, second = config.groups

    async def main():
        address = Address("controller", first.ports.motion, first.ports.state, second.ports.control)
        async with AsyncRobot(config, address=address, group=first.name) as robot:
            assert any("another driver" in text for text in robot.driver.cannot)

    with controller:
        run(controller, main())
