"""Both clients against our own driver, executed by the virtual controller over real sockets.

Time runs 10 times as fast there, so a driver's 10 Hz come as 100 Hz. What needs no socket is in
`test_virtual_clock`.
"""

from contextlib import ExitStack

import numpy as np
import pytest
from driven import wiggle

from rapidgen.client import Cell, InvalidTrajectory, MotionStopped, NotSupported, Robot, Trajectory
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.wire.simple_message.spec import Feature, TrajectoryState

SPEED = 10


@pytest.fixture
def boot():
    """Boots a configuration; gives it and the address of each group."""
    with ExitStack() as running:

        def make(name, *overrides):
            config = load_config(name, overrides=overrides)
            system = make_system(config, build(config))
            controller = running.enter_context(
                VirtualController(system, config.groups, clock="real", speed=SPEED, ports="auto")
            )
            controller.start()
            return config, {g.name: controller.address(g.name, timeout=60) for g in config.groups}

        yield make


def test_a_robot_moves(boot, client):
    config, addresses = boot("irb120")
    with client(config, address=addresses["rob1"]) as robot:
        assert robot.driver.is_rapidgen
        assert Feature.PROGRESS in robot.driver.features
        path = wiggle(robot)
        with robot.recording() as recording:
            execution = robot.execute(path)
            result = execution.result(60)
        assert (result.points, result.mode) == (4, "download")
        assert result.deviation < 1e-3
        assert execution.progress.state is TrajectoryState.DONE
        reached = np.ptp(recording.positions, axis=0)
        assert np.allclose(reached, np.ptp(path.positions, axis=0), atol=0.02)


def test_a_driver_of_the_basic_profile(boot, client):
    config, addresses = boot("irb120", "profile=basic")
    with client(config, address=addresses["rob1"]) as robot:
        assert robot.driver.features == Feature.PROGRESS
        assert Feature.STREAMING not in robot.driver.features
        path = wiggle(robot)
        execution = robot.execute(path)
        assert (execution.result(60).points, execution.result(60).mode) == (4, "download")
        # Slow: it must not be over before STOP comes.
        execution = robot.execute(Trajectory(path.times * 100, path.positions))
        robot.stop()
        with pytest.raises(MotionStopped):
            execution.result(60)
        with pytest.raises(NotSupported):
            robot.execute(path, mode="stream")


def test_a_stream(boot, client):
    config, addresses = boot("irb120")
    with client(config, address=addresses["rob1"]) as robot:
        assert robot.driver.cannot == ()
        with robot.stream() as stream:
            stream.extend((n * 0.1, [0.3 * np.sin(n * 0.02)] * 6) for n in range(400))
        result = stream.result()
        assert (result.points, result.mode) == (400, "stream")
        assert result.deviation < 1e-5
        stream = robot.stream()
        here = np.array(result.state.joints)
        stream.append(np.arange(8) * 30, [here - 0.05 * n for n in range(8)])
        robot.wait_until(lambda s: s.is_moving, 60)
        robot.pause()
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.PAUSED, 60)
        robot.resume()
        state = robot.stop()
        assert stream.stopped_position == pytest.approx(state.joints, abs=1e-4)
        with pytest.raises(MotionStopped):
            stream.result()


def test_both_arms_of_a_cell(boot, patient):
    config, addresses = boot("irb14000")
    robots = {
        name: Robot(config, address=address, group=name, timeouts=patient())
        for name, address in addresses.items()
    }
    assert len(robots) == 2
    with Cell(robots) as cell:
        paths = {name: wiggle(robot) for name, robot in robots.items()}
        results = cell.execute(paths).result(60)
        assert set(results) == set(robots)
        # one arm is asked for the impossible: nothing of the other is sent
        first, second = robots
        bad = Trajectory.from_points([[9.0] * 7], seconds=1)
        with pytest.raises(InvalidTrajectory):
            cell.execute({first: paths[first], second: bad})
        # one arm is stopped on its way: so is the other
        slow = {name: path.scaled(0.02) for name, path in paths.items()}
        in_progress = cell.execute(slow)
        robots[first].stop()
        with pytest.raises(MotionStopped):
            in_progress.result(60)
        for robot in robots.values():
            robot.wait_until(lambda s: not s.is_moving, 60)
