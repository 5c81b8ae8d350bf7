"""Downloads, stops and cells with our own driver, on the virtual clock."""

import numpy as np
import pytest
from driven import booted, driven, robot_of, wiggle

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
from rapidgen.testing.asyncio_clock import run
from rapidgen.wire.simple_message.spec import Reason, TrajectoryState, TriState

PATH = Trajectory.from_points([[0.0] * 6, [0.2] * 6, [0.1, 0, 0, 0, 0, 0.3]], seconds=1.0)


def test_executes_in_simulated_time():
    with driven() as (robot, _), robot.recording() as recording:
        result = robot.execute(PATH).result()
    assert result.deviation < 1e-4
    assert 1.9 < result.seconds < 3.5
    # 10 Hz, on the dot: the state server keeps its schedule
    assert np.diff(recording.times) == pytest.approx(0.1, abs=0.02)


@pytest.mark.parametrize("name", shipped_names())
def test_every_robot_kind_moves(name):
    for group in range(len(load_config(name).groups)):
        with driven(name, group=group) as (robot, _):
            path = wiggle(robot)
            with robot.recording() as recording:
                result = robot.execute(path).result()
            assert result.deviation < 1e-3
            reached = np.ptp(recording.positions, axis=0)
            assert np.allclose(reached, np.ptp(path.positions, axis=0), atol=0.02)


def test_the_driver_refuses_what_the_client_would_not_send():
    """The client's checks taken away: the driver has its own, and says which."""
    with driven() as (robot, _):
        check = robot._core.check
        for column, value, reason in ((2, 9.0, "JOINT_LIMIT"), (0, float("nan"), "NOT_FINITE")):
            made = check(PATH)
            made.wire[1, column] = value
            robot._core.check = lambda *_, made=made: made
            with pytest.raises(TrajectoryRefused) as error:
                robot.execute(PATH)
            assert error.value.reason is Reason[reason]
            assert (error.value.point, error.value.joint) == (1, column + 1)
        robot._core.check = check
        assert robot.execute(PATH).result().deviation < 1e-3


def test_too_many_points_are_refused_before_they_are_sent():
    with driven(overrides={"trajectory.capacity": 20}) as (robot, _):
        still = Trajectory.from_points([[0.0] * 6] * 21, seconds=0.2)
        with pytest.raises(InvalidTrajectory, match="holds 20"):
            robot.execute(still)


def test_same_seed_gives_same_run():
    def random_run(seed):
        with driven(seed=seed) as (robot, _):
            robot.execute(PATH).result()
            return robot.messages

    assert random_run(3) == random_run(3)


@pytest.mark.parametrize("after", [0.001, 0.05, 0.3, 0.9, 1.5, 1.99])
def test_stopped_at_any_moment_it_stands_on_the_path(after):
    with driven() as (robot, _):
        execution = robot.execute(PATH)
        robot.sleep(after)
        state = robot.stop()
        assert state.status.in_motion is not TriState.TRUE
        with pytest.raises(MotionStopped):
            execution.result()
        stood = robot.next_state().joints
        robot.sleep(1)
        assert robot.state.joints == stood
        back = Trajectory.from_points([stood, [0.0] * 6], seconds=3)
        assert robot.execute(back).result().deviation < 1e-3
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
    with driven() as (robot, controller):
        execution = robot.execute(PATH)
        robot.sleep(0.5)
        event(controller)
        with pytest.raises(MotionFailed) as error:
            execution.result()
        assert error.value.reason is reason
        assert execution.progress.state is TrajectoryState.FAILED
        with pytest.raises(NotReady):
            robot.execute(PATH)
        stood = robot.next_state().joints
        robot.sleep(5)
        assert robot.state.joints == stood
        assert robot.stop().joints == stood


def test_connect_without_server_fails():
    with driven() as (robot, _), pytest.raises(ConnectionFailed):
        robot.open_another(AsyncRobot("irb120", address=Address("controller", 5, 6))).connect()


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
def test_a_single_point_begins_where_the_robot_stands(seconds):
    far = [0.4, 0.2, -0.2, 0.0, 0.5, -1.0]
    with driven() as (robot, _):
        with pytest.raises(TrajectoryRefused, match="too far from where the robot stands"):
            robot.execute(Trajectory([seconds], [far])).result()
        near = [0.001] * 6
        result = robot.execute(Trajectory([seconds], [near])).result()
    assert result.deviation < 1e-4
    # at a tenth of the axis speeds, or in the time that was given
    assert result.seconds > seconds - 0.1
