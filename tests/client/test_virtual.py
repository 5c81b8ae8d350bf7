"""The client against our own driver, executed by the virtual controller over real sockets.

Time runs 10 times as fast there, so a driver's 10 Hz come as 100 Hz.
"""

import asyncio
import threading
import time

import numpy as np
import pytest

from rapidgen.client import (
    AsyncRobot,
    Cell,
    InvalidTrajectory,
    MotionFailed,
    MotionStopped,
    Robot,
    Timeouts,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.client.address import Address
from rapidgen.config import load_config, shipped_names
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.wire.simple_message.spec import Feature, Reason, TrajectoryState, TriState

SPEED = 10
PATIENT = Timeouts(state=20, ready=10, silence=20, send=20, reply=20, stop=20, heartbeat=10)
"""This machine may have more to do."""


@pytest.fixture
def boot():
    """Boots a configuration; gives it and the address of each group."""
    controllers = []

    def make(name, **overrides):
        config = load_config(name, overrides=overrides)
        controller = VirtualController(
            make_system(config, build(config)),
            config.groups,
            clock="real",
            speed=SPEED,
            ports="auto",
        )
        controllers.append(controller)
        wanted = {
            p for g in config.groups for p in (g.ports.motion, g.ports.state, g.ports.control)
        }
        controller.start()
        end, event = time.monotonic() + 20, threading.Event()
        while not wanted <= set(controller.call(lambda: dict(controller.network.listeners))):
            assert time.monotonic() < end
            event.wait(0.005)
        at = {port: place[1] for port, place in controller.network.listeners.items()}
        addresses = {
            group.name: Address(
                "127.0.0.1",
                at[group.ports.motion],
                at[group.ports.state],
                at[group.ports.control],
            )
            for group in config.groups
        }
        return controller, config, addresses

    yield make
    for controller in controllers:
        controller.close()


def wiggle(robot, size=0.05):
    """From where the robot stands, a little way and back, inside all limits."""
    group = robot.group
    here = np.array(robot.state.joints)
    wire = group.to_wire(here[None])[0]
    middle = np.array([(joint.lower + joint.upper) / 2 for joint in group.joints])
    step = np.where(wire > middle, -size, size)
    matrix = np.array([group.map.to_urdf(wire + k * step) for k in (0, 1, 0.5, 0)])
    return Trajectory.from_points(matrix, seconds=1.0, names=group.names).timed(group, 0.5)


@pytest.mark.parametrize("name", shipped_names())
def test_every_robot_kind_moves(boot, name):
    _, config, addresses = boot(name)
    for group, address in addresses.items():
        with Robot(config, address=address, group=group, timeouts=PATIENT) as robot:
            assert robot.driver.is_rapidgen
            assert Feature.PROGRESS in robot.driver.features
            path = wiggle(robot)
            with robot.recording() as recording:
                result = robot.execute(path).result(30)
            assert result.deviation < 1e-3
            reached = np.ptp(recording.positions, axis=0)
            assert np.allclose(reached, np.ptp(path.positions, axis=0), atol=0.02)


def test_async_client(boot):
    _, config, addresses = boot("irb120")

    async def run():
        async with AsyncRobot(
            config, address=addresses[config.groups[0].name], timeouts=PATIENT
        ) as robot:
            execution = await robot.execute(wiggle(robot))
            seen = []
            async for state in robot.states():
                seen.append(state.joints)
                if execution.is_over:
                    break
            assert (await execution.result()).points == 4
            assert len(set(seen)) > 1
            assert execution.progress.state is TrajectoryState.DONE

    asyncio.run(run())


def test_a_stream(boot):
    _, config, addresses = boot("irb120")
    with Robot(config, address=addresses[config.groups[0].name], timeouts=PATIENT) as robot:
        assert robot.driver.cannot == ()
        with robot.stream() as stream:
            stream.extend((n * 0.1, [0.3 * np.sin(n * 0.02)] * 6) for n in range(400))
        result = stream.result()
        assert (result.points, result.way, result.starved) == (400, "stream", 0)
        assert result.deviation < 1e-5
        stream = robot.stream()
        here = np.array(result.state.joints)
        stream.append([0, 20], [here, here - 0.2])
        robot.wait_until(lambda s: abs(s.joints[0] - here[0]) > 0.05, 10)
        robot.pause()
        robot.wait_until(lambda s: s.trajectory is TrajectoryState.PAUSED, 5)
        robot.resume()
        state = robot.stop()
        assert stream.stopped_position == pytest.approx(state.joints, abs=1e-4)
        with pytest.raises(MotionStopped):
            stream.result()


def test_stop_and_go_on(boot):
    _, config, addresses = boot("irb120")
    with Robot(config, address=addresses[config.groups[0].name], timeouts=PATIENT) as robot:
        path = Trajectory.from_points([[0.0] * 6, [0.5] * 6], seconds=10)
        execution = robot.execute(path)
        robot.wait_until(lambda s: s.joints[0] > 0.05, timeout=10)
        state = robot.stop()
        assert 0.05 < state.joints[0] < 0.45
        with pytest.raises(MotionStopped):
            execution.result()
        assert robot.next_state().joints == pytest.approx(state.joints, abs=1e-4)
        back = Trajectory.from_points([state.joints, [0.0] * 6], seconds=3)
        assert robot.execute(back).result(20).deviation < 1e-3


def test_the_driver_refuses_what_the_client_would_not_send(boot):
    """The client's checks taken away: the driver has its own, and says which."""
    _, config, addresses = boot("irb120")
    with Robot(config, address=addresses[config.groups[0].name], timeouts=PATIENT) as robot:
        path = Trajectory.from_points([[0.0] * 6, [0.1] * 6, [0.2] * 6], seconds=1)
        check = robot._core.check
        for column, value, reason in ((2, 9.0, "JOINT_LIMIT"), (0, float("nan"), "NOT_FINITE")):
            made = check(path)
            made.wire[1, column] = value
            robot._core.check = lambda *_, made=made: made
            with pytest.raises(TrajectoryRefused) as error:
                robot.execute(path)
            assert error.value.reason is Reason[reason]
            assert (error.value.point, error.value.joint) == (1, column + 1)
        robot._core.check = check
        assert robot.execute(path).result(20).deviation < 1e-3


def test_too_many_points_are_refused_before_they_are_sent(boot):
    _, config, addresses = boot("irb120", **{"trajectory.capacity": 20})
    with Robot(config, address=addresses[config.groups[0].name], timeouts=PATIENT) as robot:
        still = Trajectory.from_points([[0.0] * 6] * 21, seconds=0.2)
        with pytest.raises(InvalidTrajectory, match="holds 20"):
            robot.execute(still)


def test_emergency_stop_while_moving(boot):
    controller, config, addresses = boot("irb120")
    with Robot(config, address=addresses[config.groups[0].name], timeouts=PATIENT) as robot:
        execution = robot.execute(Trajectory.from_points([[0.0] * 6, [0.5] * 6], seconds=10))
        robot.wait_until(lambda s: s.joints[0] > 0.05, timeout=10)
        controller.call(lambda: controller.set_e_stop(True))
        with pytest.raises(MotionFailed) as error:
            execution.result(10)
        assert error.value.reason is not None
        before = robot.wait_until(lambda s: s.status.e_stopped is TriState.TRUE, 5)
        after = robot.wait_until(lambda s: s.number > before.number + 50, 5)
        again = robot.wait_until(lambda s: s.number > after.number + 20, 5)
        assert again.joints == after.joints
        assert after.joints[0] < 0.45
        assert robot.stop().joints == after.joints


def test_both_arms_of_a_cell(boot):
    _, config, addresses = boot("irb14000")
    robots = {
        name: Robot(config, address=address, group=name, timeouts=PATIENT)
        for name, address in addresses.items()
    }
    assert len(robots) == 2
    with Cell(robots) as cell:
        paths = {name: wiggle(robot) for name, robot in robots.items()}
        results = cell.execute(paths).result(30)
        assert set(results) == set(robots)
        # one arm is asked for the impossible: nothing of the other is sent
        first, second = robots
        bad = Trajectory.from_points([[9.0] * 7], seconds=1)
        with pytest.raises(InvalidTrajectory):
            cell.execute({first: paths[first], second: bad})
        # one arm is stopped on its way: so is the other
        slow = {name: path.scaled(0.1) for name, path in paths.items()}
        under_way = cell.execute(slow)
        robots[first].stop()
        with pytest.raises(MotionStopped):
            under_way.result(30)
        for robot in robots.values():
            robot.wait_until(lambda s: not s.is_moving, 5)
