"""Streaming topics on the virtual clock, without ROS: what moves the robot, and what does not."""

import asyncio

import numpy as np
import pytest
from ready import goal
from streamed import AT_REST, EGM, NAMES, streamed

from rapidgen.ros.goals import FinalStatus

STEP = 0.004
ZERO = (0.0,) * 6


def only(value, joint=0):
    return tuple(value if i == joint else 0.0 for i in range(6))


def tcp(s):
    return np.array(s.streamer._twist.tcp(s.joints)[0])


def sent(s):
    """References of the states so far (n, 6)."""
    return np.array(s.references)


def test_twist_moves_the_tcp_and_ends_with_its_messages():
    """The robot stops 0.1 s after the last message, with what braking takes."""

    async def use(s):
        down = (0, 0, -0.02, 0, 0, 0)
        await s.every(0.02, 1.5, lambda: s.twist(*down))
        begin, place = s.loop.time(), tcp(s)
        await s.every(0.02, 1.0, lambda: s.twist(*down))
        passed, moved = s.loop.time() - begin, tcp(s) - place
        assert abs(moved[2] + 0.02 * passed) < 5e-4
        assert np.abs(moved[:2]).max() < 2e-4
        last, count = s.loop.time(), len(s.references)
        await s.at_rest()
        assert s.loop.time() - last < 0.8
        # What is sent stands 0.1 s after the last message, and the time of braking.
        after = sent(s)[count:]
        stands = np.flatnonzero(np.abs(np.diff(after, axis=0)).max(axis=1) < 1e-9)[0] * STEP
        assert 0.07 < stands < 0.15
        # An old stamp neither moves it nor prolongs anything, and is reported.
        rest = s.joints
        s.twist(*down, stamp=s.loop.time() - 0.3)
        s.twist(0, 0, 1.0, 0, 0, 0)
        await asyncio.sleep(0.5)
        assert np.abs(s.joints - rest).max() < AT_REST
        assert [report.code for report in s.reports] == ["RG694", "RG680"]

    streamed(use)


def test_velocities_end_with_their_messages_and_a_stop_needs_a_pause():
    async def use(s):
        # Too fast for the share of the speeds that the node may use.
        await s.every(0.02, 1.0, lambda: s.velocities(*only(0.2)))
        assert 0.05 < s.joints[0] < 0.25
        await s.every(0.02, 0.1, lambda: s.velocities(*only(3.0)))
        assert s.reports[-1].code == "RG680"
        await s.at_rest()
        moving = asyncio.ensure_future(s.every(0.02, 1.5, lambda: s.velocities(*only(-0.2))))
        await asyncio.sleep(0.5)
        await s.link.stop()
        stood = s.joints
        await moving
        assert np.abs(s.joints - stood).max() < 1e-3
        assert s.reports[-1].code == "RG696"
        # After a pause they move it again.
        await asyncio.sleep(0.6)
        moving = asyncio.ensure_future(s.every(0.02, 2.0, lambda: s.velocities(*only(-0.1))))
        await asyncio.sleep(1.5)
        assert s.joints[0] < stood[0] - 0.02
        # A stop of another client ends the session, too.
        await s.robot.stop()
        await moving
        await asyncio.sleep(1.0)
        ended = next(report for report in s.reports if report.code == "RG697")
        assert "STOPPED" in ended.text

    streamed(use)


def test_trajectories_replace_each_other_smoothly():
    """Position and speed stay continuous, as with joint_trajectory_controller."""

    async def use(s):
        s.trajectory((0.0, ZERO), (2.0, only(0.4)))
        await s.open()
        await asyncio.sleep(1.0)
        s.trajectory((1.0, only(0.1, 1), only(0.0)), (1.6, only(0.15, 1), ZERO))
        await asyncio.sleep(0.4)
        s.trajectory((0.5, only(0.2, 1)[:3] + (0.0,) * 3), names=NAMES[:3])
        await asyncio.sleep(2.0)
        speeds = np.diff(sent(s), axis=0) / STEP
        limits = np.array(s.streamer._twist.envelope.acceleration)
        assert (np.abs(np.diff(speeds, axis=0)) <= limits * STEP * 1.001).all()
        assert np.abs(np.array(sent(s)[-1]) - only(0.15, 1)).max() < 1e-9
        assert [report.code for report in s.reports] == ["RG694"]
        assert "missing: joint_4" in s.reports[0].text
        # An empty one holds in the middle.
        s.trajectory((1.0, only(0.4)))
        await asyncio.sleep(0.5)
        s.trajectory()
        rest = await s.at_rest()
        assert 0.02 < rest[0] < 0.35

    streamed(use)


def servo(s, window, joint=0, speed=0.1, period=0.02, ahead=0.1):
    """A message of MoveIt Servo: a window of 0.2 s, from 0.1 s before now.

    [moveit2: moveit_servo/src/utils/common.cpp, updateSlidingWindow, composeTrajectoryMessage]
    """
    now = s.loop.time()
    last = window[-1][1][joint] if window else s.joints[joint]
    window[:] = [row for row in window if row[0] >= now - ahead]
    window.append((now + ahead, only(last + speed * period, joint), only(speed, joint)))
    if len(window) < 3:
        return
    first = window[0][0]
    s.trajectory(*((at - first, q, v) for at, q, v in window[:-1]), stamp=first)


def test_messages_of_servo_are_followed_and_end():
    async def use(s):
        window = []
        await s.every(0.02, 2.0, lambda: servo(s, window))
        assert not s.reports, s.reports
        begin = s.joints[0]
        await s.every(0.02, 1.0, lambda: servo(s, window))
        assert abs(s.joints[0] - begin - 0.1) < 5e-3
        await asyncio.sleep(0.1)
        end = window[-1][1][0]
        rest = await s.at_rest()
        assert abs(rest[0] - end) < 0.01
        # As positions in a Float64MultiArray, which have no speeds: even, and no overshoot.
        count = len(s.references)
        goals = iter(np.arange(rest[0], rest[0] + 0.1, 0.1 * 0.034))
        await s.every(0.034, 0.95, lambda: s.positions(*only(next(goals))))
        moved = sent(s)[count:, 0]
        speeds = np.diff(moved)[60:180] / STEP
        assert 0.05 < speeds.min() <= speeds.max() < 0.15
        assert moved.max() <= rest[0] + 0.1

    streamed(use)


def test_goals_have_priority_and_silence_moves_nothing():
    async def use(s):
        # Repeating the held position opens no session.
        await s.every(0.1, 0.5, lambda: s.positions(*ZERO))
        assert not s.streamer.is_open
        executed = s.goal(goal(0.0, 0.2, seconds=2.0))
        await asyncio.sleep(0.5)
        moving = asyncio.ensure_future(s.every(0.05, 3.0, lambda: s.velocities(*only(0.1))))
        assert (await executed).status is FinalStatus.SUCCEEDED
        await moving
        # The commands went on after the goal: they move nothing before they have paused.
        assert np.abs(s.joints - 0.2).max() < 1e-3
        assert "a goal is executed" in s.reports[0].text
        assert not s.streamer.is_open
        await asyncio.sleep(0.6)
        moving = asyncio.ensure_future(s.every(0.05, 1.5, lambda: s.velocities(*only(0.1))))
        await s.open()
        await asyncio.sleep(0.5)
        refused = await s.goal(goal(0.2, 0.3))
        assert refused.status is FinalStatus.ABORTED
        assert "commands of a topic move the robot" in refused.text
        await moving
        rest = await s.at_rest()
        # The session stands: a goal ends it.
        done = await s.goal(goal(rest, rest + 0.05))
        assert done.status is FinalStatus.SUCCEEDED, done

    streamed(use)


def test_preempt_ends_the_goal():
    async def use(s):
        executed = s.goal(goal(0.0, 0.4, seconds=4.0))
        await asyncio.sleep(1.0)
        moving = asyncio.ensure_future(s.every(0.05, 2.0, lambda: s.velocities(*only(-0.1))))
        outcome = await executed
        assert outcome.status is FinalStatus.ABORTED
        assert "replaced by a command of a topic" in outcome.text
        place = s.joints[0]
        await moving
        assert s.joints[0] < place - 0.02
        # Idle sessions end by themselves.
        await asyncio.sleep(3.0)
        assert not s.streamer.is_open

    streamed(use, preempt=True, idle=1.0)


def test_twist_stops_before_the_end_of_a_range():
    async def use(s):
        down = (0, 0, -0.05, 0, 0, 0)
        await s.every(0.02, 5.0, lambda: s.twist(*down))
        upper = s.streamer._twist.envelope.upper[2]
        assert upper - 0.01 < sent(s)[:, 2].max() < upper
        assert s.reports[0].code == "RG698"
        assert "by joint_3" in s.reports[0].text

    streamed(use, overrides=["joints.joint_3.upper=5"])


def test_without_egm_the_first_command_says_so():
    async def use(s):
        for _ in range(10):
            s.twist(0, 0, 0.01, 0, 0, 0)
        assert [report.code for report in s.reports] == ["RG695"]
        assert "`egm:`" in s.reports[0].text

    streamed(use, name="irb120")


def test_delayed_commands_are_slow_and_say_how_late_they_are():
    """Without EGM they go over the client's stream: 50 mm/s at most (issue text)."""

    async def use(s):
        places = []
        for _ in range(200):
            s.velocities(*only(0.5))
            await asyncio.sleep(0.02)
            places.append(tcp(s))
        speeds = np.linalg.norm(np.diff(places[::10], axis=0), axis=1) / 0.2
        assert 0.03 < speeds.max() < 0.0505
        rest = await s.at_rest()
        assert rest[0] > 0.1
        delays = [report for report in s.record.reports if "late, as measured" in report.text]
        assert 0.3 < float(delays[-1].text.split()[3]) < 1.5
        # A twist above the limit is ignored; a stop ends everything.
        s.twist(0, 0, -0.1, 0, 0, 0)
        assert s.reports[-1].code == "RG680"
        moving = asyncio.ensure_future(s.every(0.02, 2.0, lambda: s.velocities(*only(-0.1))))
        await asyncio.sleep(1.5)
        await s.link.stop()
        stood = s.joints
        await moving
        assert np.abs(s.joints - stood).max() < 1e-3
        # A goal follows.
        done = await s.goal(goal(stood, stood + 0.05))
        assert done.status is FinalStatus.SUCCEEDED, done

    streamed(use, name="irb120", allow_delayed=True)


@pytest.mark.parametrize(("name", "allowed"), [(EGM, False), ("irb120", True)])
def test_emergency_stop_is_the_reason_and_moves_nothing_afterwards(name, allowed):
    async def use(s):
        s.controller.set_e_stop(True)
        await asyncio.sleep(0.5)
        await s.every(0.05, 2.0, lambda: s.velocities(*only(0.1)))
        assert np.array_equal(s.joints, ZERO)
        assert "an emergency stop is active" in s.reports[0].text
        assert not s.streamer.is_open

    streamed(use, name=name, allow_delayed=allowed)
