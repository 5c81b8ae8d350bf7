"""AsyncRobot against our own driver, both on the virtual clock: nothing waits in real time."""

import asyncio
import functools

import numpy as np
import pytest
from test_virtual import wiggle

from rapidgen.client import (
    AsyncCell,
    AsyncRobot,
    ConnectionFailed,
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    NotReady,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.client.address import Address
from rapidgen.config import load_config, shipped_names
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.testing.asyncio_clock import run
from rapidgen.wire.simple_message.spec import Reason, TrajectoryState, TriState


@functools.cache
def system_of(name, **overrides):
    config = load_config(name, overrides=overrides)
    return config, make_system(config, build(config))


def booted(name="irb120", *, seed=0, **overrides):
    config, system = system_of(name, **overrides)
    controller = VirtualController(system, config.groups, seed=seed)
    controller.run_for(2.0)
    return controller, config


def robot_of(config, group=None, **options):
    chosen = group or config.groups[0]
    address = Address("controller", chosen.ports.motion, chosen.ports.state)
    return AsyncRobot(config, address=address, group=chosen.name, **options)


PATH = Trajectory.from_points([[0.0] * 6, [0.2] * 6, [0.1, 0, 0, 0, 0, 0.3]], seconds=1.0)


def test_executes_in_simulated_time():
    controller, config = booted()

    async def main():
        async with robot_of(config) as robot:
            with robot.recording() as recording:
                result = await (await robot.execute(PATH)).result()
            return result, recording

    with controller:
        result, recording = run(controller, main())
    assert result.deviation < 1e-4
    assert 1.9 < result.seconds < 3.5
    # 10 Hz, on the dot: the state server keeps its schedule
    assert np.diff(recording.times) == pytest.approx(0.1, abs=0.02)


@pytest.mark.parametrize("name", shipped_names())
def test_every_robot_kind_moves(name):
    controller, config = booted(name)

    async def main():
        for group in config.groups:
            async with robot_of(config, group) as robot:
                path = wiggle(robot)
                with robot.recording() as recording:
                    result = await (await robot.execute(path)).result()
                assert result.deviation < 1e-3
                reached = np.ptp(recording.positions, axis=0)
                assert np.allclose(reached, np.ptp(path.positions, axis=0), atol=0.02)

    with controller:
        run(controller, main())


def test_the_driver_refuses_what_the_client_would_not_send():
    """The client's checks taken away: the driver has its own, and says which."""
    controller, config = booted()

    async def main():
        async with robot_of(config) as robot:
            check = robot._core.check
            for column, value, reason in ((2, 9.0, "JOINT_LIMIT"), (0, float("nan"), "NOT_FINITE")):
                made = check(PATH)
                made.wire[1, column] = value
                robot._core.check = lambda *_, made=made: made
                with pytest.raises(TrajectoryRefused) as error:
                    await robot.execute(PATH)
                assert error.value.reason is Reason[reason]
                assert (error.value.point, error.value.joint) == (1, column + 1)
            robot._core.check = check
            assert (await (await robot.execute(PATH)).result()).deviation < 1e-3

    with controller:
        run(controller, main())


def test_too_many_points_are_refused_before_they_are_sent():
    controller, config = booted(**{"trajectory.capacity": 20})

    async def main():
        async with robot_of(config) as robot:
            still = Trajectory.from_points([[0.0] * 6] * 21, seconds=0.2)
            with pytest.raises(InvalidTrajectory, match="holds 20"):
                await robot.execute(still)

    with controller:
        run(controller, main())


def test_same_seed_same_story():
    def story(seed):
        controller, config = booted(seed=seed)

        async def main():
            async with robot_of(config) as robot:
                await (await robot.execute(PATH)).result()
                return robot.messages

        with controller:
            return run(controller, main())

    assert story(3) == story(3)


@pytest.mark.parametrize("after", [0.001, 0.05, 0.3, 0.9, 1.5, 1.99])
def test_stopped_at_any_moment_it_stands_on_the_path(after):
    controller, config = booted()

    async def main():
        async with robot_of(config) as robot:
            execution = await robot.execute(PATH)
            await asyncio.sleep(after)
            state = await robot.stop()
            assert state.status.in_motion is not TriState.TRUE
            with pytest.raises(MotionStopped):
                await execution.result()
            stood = (await robot.next_state()).joints
            await asyncio.sleep(1)
            assert robot.state.joints == stood
            back = Trajectory.from_points([stood, [0.0] * 6], seconds=3)
            assert (await (await robot.execute(back)).result()).deviation < 1e-3
            return stood

    with controller:
        stood = np.array(run(controller, main()))
    # all joints go alike on the first segment
    if after < 0.9:
        assert np.ptp(stood) < 1e-3


@pytest.mark.parametrize(
    ("event", "reason"),
    [
        (lambda c: c.set_e_stop(True), Reason.EMERGENCY_STOP),
        (lambda c: c.set_motors(False), Reason.MOTORS_OFF),
    ],
)
def test_ended_by_the_controller(event, reason):
    controller, config = booted()

    async def main():
        async with robot_of(config) as robot:
            execution = await robot.execute(PATH)
            await asyncio.sleep(0.5)
            event(controller)
            with pytest.raises(MotionFailed) as error:
                await execution.result()
            assert error.value.reason is reason
            assert execution.progress.state is TrajectoryState.FAILED
            with pytest.raises(NotReady):
                await robot.execute(PATH)
            stood = (await robot.next_state()).joints
            await asyncio.sleep(5)
            assert robot.state.joints == stood
            assert (await robot.stop()).joints == stood

    with controller:
        run(controller, main())


def test_nobody_listens():
    controller, config = booted()

    async def main():
        with pytest.raises(ConnectionFailed):
            await AsyncRobot(config, address=Address("controller", 5, 6)).connect()

    with controller:
        run(controller, main())


def test_two_arms_start_together():
    controller, config = booted("irb14000")

    async def main():
        robots = {g.name: robot_of(config, g) for g in config.groups}
        async with AsyncCell(robots) as cell:
            paths = {}
            for name, robot in robots.items():
                here = np.array(robot.state.joints)
                paths[name] = Trajectory.from_points([here, here + 0.05], seconds=1.0)
            results = await (await cell.execute(paths)).result()
            ends = [result.state.time for result in results.values()]
            assert abs(ends[0] - ends[1]) < 0.3

    with controller:
        run(controller, main())


@pytest.mark.parametrize("seconds", [0.0, 4.0])
def test_a_single_point_is_gone_to_from_anywhere(seconds):
    controller, config = booted()
    goal = [0.4, 0.2, -0.2, 0.0, 0.5, -1.0]

    async def main():
        async with robot_of(config) as robot:
            result = await (await robot.execute(Trajectory([seconds], [goal]))).result()
            assert result.deviation < 1e-4
            return result.seconds

    with controller:
        taken = run(controller, main())
    # at a tenth of the axis speeds, or in the time that was given
    assert taken > max(seconds, 0.3) - 0.1
