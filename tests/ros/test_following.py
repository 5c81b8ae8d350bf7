"""Goals on the virtual clock, against our own driver: how each ends, and where the robot is then.

What a goal means is joint_trajectory_controller's (control_msgs/action/FollowJointTrajectory);
the rows in which ROS 1 nodes lied or hung are named at their test.
"""

import asyncio
from dataclasses import replace

import numpy as np
import pytest
from ready import NAMES, goal, station

from rapidgen.client import Trajectory
from rapidgen.ros.goal_execution import ActiveGoal, GoalFeedback, Policy, _violation
from rapidgen.ros.goals import Code, Defaults, FinalStatus, Goal, Point, Tolerance, ValidatedGoal

THERE = goal(0.0, 0.1, 0.2)
APPROACH = Policy(replace="approach")


def test_a_path_longer_than_the_ring_of_the_driver():
    rows = [0.2 * (1 - np.cos(n * 0.05)) for n in range(500)]
    with station() as s:
        outcome = s.outcome(goal(*rows, seconds=0.1))
        assert outcome.status is FinalStatus.SUCCEEDED, outcome.text
        assert s.joints == pytest.approx([rows[-1]] * 6, abs=1e-4)


@pytest.mark.parametrize("mode", ["manual_reduced", "manual_full"])
def test_manual_mode_moves_while_the_enabling_device_is_held(mode):
    with station() as s:
        s.controller.set_mode(mode)
        s.controller.set_motors(True)
        s.controller.start_program()
        s.controller.run_for(2.0)
        assert s.outcome(goal(0.0, 0.05, seconds=2.0)).status is FinalStatus.SUCCEEDED


def test_joints_of_a_coupled_model_are_those_of_its_urdf():
    """Axis 3 of the controller is joint 3 and joint 2: `J23_coupled` of abb_driver."""
    with station(name="irb2400") as s:
        requested = goal(0.0, [0.0, 0.4, -0.3, 0.0, 0.0, 0.0], seconds=2.0)
        assert s.outcome(requested).status is FinalStatus.SUCCEEDED
        assert s.joints[:3] == pytest.approx([0.0, 0.4, 0.1], abs=1e-4)
        assert s.robot.state.joints[2] == pytest.approx(-0.3, abs=1e-4)
        far = s.outcome(goal(s.robot.state.joints, [0.0, 1.0, 0.6, 0.0, 0.0, 0.0], seconds=4.0))
        assert (far.status, far.code) == (FinalStatus.ABORTED, Code.INVALID_GOAL)


def test_joints_of_a_track_and_a_positioner():
    with station(name="irb120_track") as s:
        names, here = s.robot.group.names, s.robot.state.joints
        target = {"track": 0.5, "positioner": 1.0}
        row = [target.get(name, 0.1) for name in names]
        requested = goal(here, row, seconds=4.0, names=names)
        assert s.outcome(requested).status is FinalStatus.SUCCEEDED
        assert s.robot.state.joints == pytest.approx(row, abs=1e-3)


def test_succeeded_only_where_the_controller_is_done():
    with station() as s:
        outcome = s.outcome(THERE)
        assert outcome.status is FinalStatus.SUCCEEDED
        assert outcome.code is Code.SUCCESSFUL
        assert s.stands
        assert s.joints == pytest.approx([0.2] * 6, abs=1e-4)
        assert len(s.fed) > 10
        assert s.fed[-1].names == NAMES
        times = [fed.time for fed in s.fed]
        assert times == sorted(times)


def test_names_in_any_order():
    with station() as s:
        rows = [[0.0] * 6, [0.1, 0.2, -0.1, 0.3, 0.05, -0.2]]
        backwards = goal(*(row[::-1] for row in rows), names=NAMES[::-1])
        assert s.outcome(backwards).status is FinalStatus.SUCCEEDED
        assert s.joints == pytest.approx(rows[1], abs=1e-4)


@pytest.mark.parametrize(
    ("requested", "help"),
    [
        (goal(0.0, 1.0, seconds=0.15), "joint_limits.yaml"),
        (goal(0.1, 0.2), "replace: approach"),
        (goal(0.0, 0.0, 0.0, 0.0, seconds=0.05), "dense: resample"),
    ],
)
def test_a_refusal_says_what_to_do_in_words_of_ros(requested, help):
    with station() as s:
        text = s.outcome(requested).text
        assert help in text
        assert "`Trajectory" not in text


@pytest.mark.parametrize(
    ("requested", "code", "text"),
    [
        (goal(0.0, names=NAMES[:5]), Code.INVALID_JOINTS, "missing: joint_6"),
        (goal(0.0, 0.1, names=(*NAMES[:5], "elbow")), Code.INVALID_JOINTS, "unknown: elbow"),
        (goal(0.0, names=(*NAMES, "joint_1")), Code.INVALID_JOINTS, "twice: joint_1"),
        (goal(), Code.INVALID_GOAL, "no points"),
        (goal(0.0, float("nan")), Code.INVALID_GOAL, "no numbers"),
        (goal(0.0, 0.1, has_multi_dof=True), Code.INVALID_GOAL, "multi_dof"),
        (goal(0.0, 0.1, 0.2, seconds=0.0), Code.INVALID_GOAL, "does not increase at point 1"),
        (goal(0.0, [0.1] * 5), Code.INVALID_GOAL, "point 1 has 5 positions for 6 joints"),
        # What a ROS-Industrial action answers with SUCCEEDED: a closed path that is refused.
        (goal(0.0, 9.0, 0.0), Code.INVALID_GOAL, "outside its limits at point 1"),
        (goal(0.0, 0.001, 0.0, seconds=0.05), Code.INVALID_GOAL, "shorter than the path planner"),
        (goal(0.0, 0.001, 0.002, 0.0, seconds=0.02), Code.INVALID_GOAL, "and 1 more"),
        (goal(0.0, 1.0, seconds=0.1), Code.INVALID_GOAL, "too fast"),
        (goal(0.5, 0.6), Code.INVALID_GOAL, "start"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_refused_is_aborted_with_a_reason_and_nothing_moves(requested, code, text):
    with station() as s:
        outcome = s.outcome(requested)
        assert (outcome.status, outcome.code) == (FinalStatus.ABORTED, code)
        assert text in outcome.text
        assert s.joints == pytest.approx([0.0] * 6, abs=1e-9)
        assert s.outcome(THERE).status is FinalStatus.SUCCEEDED


def test_end_velocity_is_refused_and_effort_is_noted():
    last = Point(1.0, [0.1] * 6, velocities=[0.0, 0, 0, 0.2, 0, 0])
    moving = replace(THERE, points=[Point(0.0, [0.0] * 6, velocities=[0.0] * 6), last])
    pushed = replace(THERE, points=[replace(point, effort=[1.0] * 6) for point in THERE.points])
    with station() as s:
        refused = s.outcome(moving)
        assert refused.code is Code.INVALID_GOAL
        assert "joint_4 0.2" in refused.text
        done = s.outcome(pushed)
        assert done.status is FinalStatus.SUCCEEDED
        assert "effort was ignored" in done.text
        assert any("effort" in note for note in s.notes)


def test_a_stamp_in_the_future_is_waited_for():
    with station() as s:
        start = s.loop.time() + 3.0
        requested = replace(THERE, stamp=start)
        began = []
        s.follower._robot.execute = _noting(s, s.robot.execute, began)
        assert s.outcome(requested).status is FinalStatus.SUCCEEDED
        assert began == [pytest.approx(start, abs=1e-6)]


def _noting(s, execute, began):
    def noted(trajectory):
        began.append(s.loop.time())
        return execute(trajectory)

    return noted


def test_a_stamp_in_the_past_is_refused_and_one_under_way_is_not():
    with station() as s:
        late = s.outcome(replace(THERE, stamp=s.loop.time() - 0.5))
        assert (late.status, late.code) == (FinalStatus.ABORTED, Code.OLD_HEADER_TIMESTAMP)
        assert s.joints == pytest.approx([0.0] * 6, abs=1e-9)
        assert s.outcome(replace(THERE, stamp=s.loop.time() - 0.1)).status is FinalStatus.SUCCEEDED


@pytest.mark.parametrize("after", [0.0, 0.05, 0.4, 1.2])
def test_cancel_ends_when_the_robot_stands(after):
    with station() as s:
        under = ActiveGoal()
        outcome = s.run(_after(s, after, s.follow(goal(0.0, 0.5, 1.0), under), under.cancel))
        assert outcome.status is FinalStatus.CANCELED
        assert s.stands
        stood = s.joints
        assert stood.max() < 1.0
        s.controller.run_for(2.0)
        assert s.joints == pytest.approx(stood, abs=1e-9)


async def _after(s, seconds, following, act):
    under = asyncio.ensure_future(following)
    await asyncio.sleep(0)
    await asyncio.sleep(seconds)
    act()
    return await under


def test_cancel_before_the_stamp():
    with station() as s:
        requested = replace(THERE, stamp=s.loop.time() + 5)
        under = ActiveGoal()
        outcome = s.run(_after(s, 1.0, s.follow(requested, under), under.cancel))
        assert outcome.status is FinalStatus.CANCELED
        assert s.joints == pytest.approx([0.0] * 6, abs=1e-9)


def test_goal_cancelled_before_start_is_not_sent():
    with station() as s:
        under = ActiveGoal()
        under.cancel()
        assert s.run(s.follow(goal(0.0, 0.5), under)).status is FinalStatus.CANCELED
        assert s.joints == pytest.approx([0.0] * 6, abs=1e-9)


def test_a_second_goal_is_refused_and_the_first_goes_on():
    with station() as s:
        first, second = s.run(_two(s, THERE, goal(0.2, 0.0)))
        assert first.status is FinalStatus.SUCCEEDED
        assert second.status is FinalStatus.ABORTED
        assert "another goal" in second.text
        assert s.joints == pytest.approx([0.2] * 6, abs=1e-4)


async def _two(s, one, other):
    first = asyncio.ensure_future(s.follow(one))
    await asyncio.sleep(1.0)
    second = await s.follow(other)
    return await first, second


def test_second_goal_with_replace_policy_replaces():
    with station(APPROACH) as s:
        first, second = s.run(_two(s, goal(0.0, 0.5, 1.0), goal(0.0, 0.3)))
        assert first.status is FinalStatus.ABORTED
        assert "replaced" in first.text
        assert second.status is FinalStatus.SUCCEEDED
        assert "prepended" in second.text
        assert s.joints == pytest.approx([0.3] * 6, abs=1e-4)


def test_dense_points_with_resample_policy_are_resampled():
    rows = [0.2 * np.sin(n * 0.05) for n in range(41)]
    dense = goal(*rows, seconds=0.03)
    with station() as s:
        assert "shorter" in s.outcome(dense).text
    with station(Policy(dense="resample")) as s:
        outcome = s.outcome(dense)
        assert outcome.status is FinalStatus.SUCCEEDED
        assert "off by up to" in outcome.text
        assert s.joints == pytest.approx([rows[-1]] * 6, abs=1e-4)


def test_the_rest_that_a_planner_leaves_at_the_end():
    """As MoveIt's time-optimal parametrisation samples: every 0.1 s, and what is left."""
    times = [*np.arange(21) * 0.1, 2.03]
    points = [Point(t, [0.15 * (1 - np.cos(np.pi * t / 2.03))] * 6) for t in times]
    with station() as s:
        outcome = s.outcome(replace(THERE, points=points))
        assert outcome.status is FinalStatus.SUCCEEDED
        assert "last segment of 0.030 s was extended to 0.1 s" in outcome.text
        assert s.joints == pytest.approx([0.3] * 6, abs=1e-4)


# e-stop, program stop: an action of ROS 1 stays ACTIVE for ever.
@pytest.mark.parametrize(
    ("fault", "text"),
    [
        (lambda c: c.set_e_stop(True), "emergency stop"),
        (lambda c: c.stop_program(), "stopped"),
        (lambda c: c.set_mode("manual_reduced"), ""),
    ],
)
def test_what_the_controller_ends_is_aborted_and_the_next_goal_runs(fault, text):
    with station() as s:
        outcome = s.run(_after(s, 1.0, s.follow(goal(0.0, 0.5, 1.0)), lambda: fault(s.controller)))
        assert outcome.status is FinalStatus.ABORTED
        assert outcome.code is Code.PATH_TOLERANCE_VIOLATED
        assert text in outcome.text
        s.controller.run_for(1.0)
        assert s.stands


@pytest.mark.parametrize("after", [0.1, 0.5])
def test_a_client_that_was_held_up_reads_before_it_calls_the_robot_silent(after):
    """A busy machine: replies of both ports arrive after the same pause.

    In any order.
    """

    async def held_up(s):
        following = asyncio.ensure_future(s.follow(goal(0.0, 0.2)))
        await asyncio.sleep(after)
        s.controller.run_for(2.5)
        return await following

    with station() as s:
        outcome = s.run(held_up(s))
        assert outcome.status is FinalStatus.SUCCEEDED, outcome.text


def test_a_controller_that_is_gone_aborts():
    with station() as s:
        outcome = s.run(_after(s, 1.0, s.follow(goal(0.0, 0.5, 1.0)), s.controller.power_loss))
        assert outcome.status is FinalStatus.ABORTED


@pytest.mark.parametrize("cancelled", [False, True])
@pytest.mark.parametrize("after", [0.0, 0.03, 0.08])
def test_a_link_that_is_lost_while_a_goal_is_sent_leaves_open_whether_it_moves(after, cancelled):
    """-1 says that the robot has not moved, which is unknown here.

    It is unknown after a lost STOP too.
    """
    requested, under = goal(*(0.01 * n for n in range(50)), seconds=0.2), ActiveGoal()
    with station() as s:

        def fault():
            s.controller.power_loss()
            if cancelled:
                under.cancel()

        outcome = s.run(_after(s, after, s.follow(requested, under), fault))
        assert (outcome.status, outcome.code) == (FinalStatus.ABORTED, Code.PATH_TOLERANCE_VIOLATED)
        assert ("STOP" if cancelled else "connection") in outcome.text


def test_a_link_that_is_lost_before_the_stamp_aborts_at_once():
    with station() as s:
        began = s.loop.time()
        requested = replace(THERE, stamp=began + 600.0)
        outcome = s.run(_after(s, 1.0, s.follow(requested), s.controller.power_loss))
        # Nothing was sent: nothing can have moved.
        assert (outcome.status, outcome.code) == (FinalStatus.ABORTED, Code.INVALID_GOAL)
        assert "connection" in outcome.text
        assert s.loop.time() - began < 60.0


@pytest.mark.parametrize(
    "points",
    [
        [Point(2.0, [0.3] * 6)],
        [Point(2.0, [0.3] * 6), Point(3.0, [0.4] * 6)],
    ],
    ids=["one point", "two points"],
)
def test_a_first_point_with_a_time_is_gone_to_in_that_time(points):
    """joint_trajectory_controller interpolates from where the robot is to the first point."""
    path = [Tolerance(name, position=0.1) for name in NAMES]
    requested = Goal(NAMES, points, path_tolerance=path)
    with station() as s:
        began = s.loop.time()
        outcome = s.outcome(requested)
        assert outcome.status is FinalStatus.SUCCEEDED
        assert "from the robot's position" in outcome.text
        assert s.joints == pytest.approx(points[-1].positions, abs=1e-4)
        assert s.loop.time() - began == pytest.approx(points[-1].time, abs=0.5)
        assert max(np.abs(fed.error).max() for fed in s.fed) < 0.1


def test_a_first_point_with_a_time_that_is_too_short_is_refused():
    with station() as s:
        outcome = s.outcome(Goal(NAMES, [Point(0.2, [1.0] * 6)]))
        assert (outcome.status, outcome.code) == (FinalStatus.ABORTED, Code.INVALID_GOAL)
        assert "too fast" in outcome.text
        assert s.joints == pytest.approx([0.0] * 6, abs=1e-9)


def test_path_tolerance_holds_where_the_first_feedback_comes_late():
    """A client that is delayed after the acceptance has not seen the start."""
    path = [Tolerance(name, position=0.05) for name in NAMES]
    with station() as s:
        s.run(s.robot.next_feedback())
        hear, execute, held = s.robot.next_feedback, s.robot.execute, []

        async def in_use(trajectory):
            execution = await execute(trajectory)
            held.append(0.45)
            return execution

        async def held_up(timeout=None):
            if held:
                await asyncio.sleep(held.pop())
            return await hear(timeout)

        s.robot.execute, s.robot.next_feedback = in_use, held_up
        requested = replace(goal(0.0, 0.4, 0.8), path_tolerance=path)
        outcome = s.outcome(requested)
        assert outcome.status is FinalStatus.SUCCEEDED, outcome.text


def test_path_tolerance_is_against_the_controllers_time():
    wide = replace(THERE, path_tolerance=[Tolerance("joint_1", position=0.15)])
    with station() as s:
        assert s.outcome(wide).status is FinalStatus.SUCCEEDED
    with station() as s:
        # A stop from outside is the largest deviation from the path.
        s.controller.run_for(0.1)
        tight = replace(goal(0.0, 0.5, 1.0), path_tolerance=[Tolerance("joint_1", position=1e-4)])
        slow = s.run(_after(s, 0.6, s.follow(tight), lambda: s.slow_down(0.1)))
        assert (slow.status, slow.code) == (FinalStatus.ABORTED, Code.PATH_TOLERANCE_VIOLATED)
        assert "joint_1" in slow.text
        assert s.stands


def test_goal_time_counts_the_override_that_was_asked_for():
    timed = replace(goal(0.0, 0.2), goal_time_tolerance=1.0)
    with station() as s:
        under = s.follow(timed)

        async def slower():
            following = asyncio.ensure_future(under)
            await asyncio.sleep(0.4)
            await s.robot.set_speed(20)
            return await following

        assert s.run(slower()).status is FinalStatus.SUCCEEDED
    with station() as s:
        late = s.run(_after(s, 0.4, s.follow(timed), lambda: s.slow_down(0.05)))
        assert (late.status, late.code) == (FinalStatus.ABORTED, Code.GOAL_TOLERANCE_VIOLATED)
        assert "s were allowed" in late.text
        assert s.stands


@pytest.mark.parametrize(
    ("tolerance", "text"),
    [
        (Tolerance("joint_1", position=-2.0), "-1 for none"),
        (Tolerance("joint_1", velocity=float("nan")), "velocity"),
        (Tolerance("elbow", position=0.1), "not a joint here"),
    ],
)
def test_tolerances_that_mean_nothing_are_refused(tolerance, text):
    with station() as s:
        outcome = s.outcome(replace(THERE, path_tolerance=[tolerance]))
        assert outcome.code is Code.INVALID_GOAL
        assert text in outcome.text or "-1 for none" in outcome.text


def test_goal_tolerance_of_the_user_counts():
    strict = Policy(defaults=Defaults(goal=1e-12))
    with station(strict) as s:
        outcome = s.outcome(THERE)
        assert (outcome.status, outcome.code) == (FinalStatus.ABORTED, Code.GOAL_TOLERANCE_VIOLATED)
        none = replace(THERE, points=goal(0.2, 0.1).points)
        none = replace(none, goal_tolerance=[Tolerance(n, position=-1.0) for n in NAMES])
        assert s.outcome(none).status is FinalStatus.SUCCEEDED


POINTS = Trajectory([0.0, 1.0, 2.0, 3.0], [[0.0], [0.4], [1.2], [1.2]], ["a"])
"""At 0.4, then at 0.8 rad/s, then it stands."""


@pytest.mark.parametrize(
    ("time", "actual", "velocity", "window", "violated"),
    [
        # Where it was to be at any moment of the window, the earliest as well as the latest.
        (0.5, 0.2, 0.4, 0.0, None),
        (0.5, 0.18, 0.4, 0.1, None),
        (0.5, 0.22, 0.4, 0.1, None),
        (0.5, 0.14, 0.4, 0.1, "a was 0.0200 off its path 0.50 s after the start, and 0.01"),
        (0.5, 0.26, 0.4, 0.1, "a was 0.0200 off its path"),
        (0.5, 0.2, 0.6, 0.1, "velocity of a was 0.2000 off its path"),
        (1.05, 0.44, 0.4, 0.1, None),
        (1.05, 0.44, 0.8, 0.1, None),
        (1.05, 0.44, 0.6, 0.1, "velocity of a was 0.2000"),
        # After its end for as long as is allowed, plus the window.
        (3.6, 1.2, 0.0, 0.2, None),
        (3.8, 1.2, 0.0, 0.2, "not at the goal 0.80 s after its time, and 0.5 s were allowed"),
    ],
)
def test_a_sample_is_compared_with_all_that_was_asked_for_within_its_window(
    time, actual, velocity, window, violated
):
    allowed = [np.array([value]) for value in (0.01, 0.1, 0.0, 0.0)]
    requested = ValidatedGoal(POINTS, None, None, *allowed, goal_time=0.5)
    none = np.zeros(1)
    fed = GoalFeedback(("a",), time, none, none, np.array([actual]), np.array([velocity]))
    result = _violation(requested, fed, window)
    assert (result is None) == (violated is None)
    if result is not None:
        assert violated in result.text
