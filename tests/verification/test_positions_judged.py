"""Checks on positions: good runs pass, and each kind of bad one fails."""

import pytest

from rapidgen.machine.event_log import EventType
from rapidgen.verification import position_checks
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.settings import assumed
from tests.verification.made_up import PATH, A, B, C, D, along, check_fails

# -- positions ------------------------------------------------------------------------------------


def test_a_distance_is_that_of_the_axis_that_is_farthest():
    assert position_checks.distance((0.0, 1.0, 2.0), (0.5, 1.0, 1.0)) == 1.0
    assert position_checks.distance(A, A) == 0
    with pytest.raises(ValueError, match="longer"):
        position_checks.distance((0.0,), A)


@pytest.mark.parametrize(
    ("seen", "wanted"),
    [
        (A, 0.0),
        ((0.5, 0.0), 0.0),
        (B, 0.0),
        # Beside the way, behind its end, before its beginning.
        ((0.5, 0.2), 0.2),
        ((0.5, -0.2), 0.2),
        ((1.3, 0.0), 0.3),
        ((-0.3, 0.1), 0.3),
    ],
)
def test_how_far_off_a_way_a_position_is(seen, wanted):
    assert position_checks.off(seen, A, B) == pytest.approx(wanted)
    assert position_checks.off(seen, B, A) == pytest.approx(wanted)


def test_off_a_way_of_no_length_is_off_the_place():
    assert position_checks.off((0.3, 0.4), A, A) == 0.4


# -- path, order, prefix --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "seen",
    [
        [],
        along(A),
        along(A, B, C),
        # A prefix: it ended early, on the way or at a point.
        along(A, B),
        along(A, (0.4, 0.0)),
        # The corner is cut, no farther than it may be.
        along(A, (0.96, 0.0), (1.0, 0.04), C),
    ],
)
def test_a_prefix_of_the_path_is_followed(seen):
    position_checks.on_path(seen, PATH, corner=0.05)


@pytest.mark.parametrize(
    "seen",
    [
        # Off it, straight from first to last point, and beyond the commanded end.
        along(A, (0.5, 0.1), B),
        along(A, C),
        along(A, B, (1.2, 0.0)),
        along(A, B, C, D),
        # Against its order: back over a point that it had passed, and the whole of it.
        along(A, B, C, B, A),
        along(C, B, A),
        # A corner that is cut too far.
        along(A, (0.7, 0.0), (1.0, 0.3), C),
        # One sample alone.
        [*along(A, B), (1.0, (1.0, -0.06)), (1.1, B)],
    ],
)
def test_track_off_the_path_prefix_is_detected(seen):
    with check_fails("rad off what was asked"):
        position_checks.on_path(seen, PATH, corner=0.05)


def test_a_point_that_is_left_out_is_seen():
    path = [A, (0.5, 0.5), B]
    position_checks.on_path(along(*path), path)
    with check_fails("off what was asked"):
        position_checks.on_path(along(A, B), path)


def test_track_is_checked_from_a_given_time(bench):
    points = bench.wave(4)
    link = bench.motion()
    since = bench.now
    link.send(bench.download(points))
    bench.wait_until_at(points[-1][0])
    bench.followed([p for p, _ in points], since=since)
    other = [(p[0] + 0.1, *p[1:]) for p, _ in points]
    with check_fails("off what was asked"):
        bench.followed(other, since=since)
    bench.followed(other, since=bench.now + 1)
    # The record is of that robot: where it was at each time, first and last place included.
    assert bench.track_at(since) == points[0][0]
    assert position_checks.distance(bench.track[-1][1], points[-1][0]) < position_checks.SETTLED
    assert len([t for t, _ in bench.track if t > since]) > 100


# -- stillness ------------------------------------------------------------------------------------


def test_standing_robot_is_still():
    position_checks.still([], A, "")
    position_checks.still([(0.0, A), (1.0, (0.00009, 0.0))], A, "")


@pytest.mark.parametrize("place", [(0.0002, 0.0), (0.0, -0.0002), B])
def test_one_that_was_elsewhere_for_a_moment_is_not(place):
    with check_fails("the robot moved at 1.000 s: it was stopped"):
        position_checks.still([(0.0, A), (1.0, place), (1.004, A)], A, "it was stopped")


def test_a_robot_that_moves_does_not_stay(bench):
    bench.assert_at_rest(1, "no client asked for motion")
    points = bench.wave(3)
    back = [(p, 0.4) for p, _ in points[-2::-1]]
    bench.motion().send(bench.download([*points, *back]))
    # It is where it was when the time is over: what counts is what happened meanwhile.
    with check_fails("no client asked for motion"):
        bench.assert_at_rest(5, "no client asked for motion")
    assert position_checks.distance(bench.position, points[0][0]) < position_checks.SETTLED
    bench.assert_at_rest(5, "its trajectory is over")


def test_waiting_robot_is_distinguished_from_moving(bench):
    assert bench.standing
    with check_fails("the robot begins to move: not within 0.5 s"):
        bench.wait_until_moving(0.5)
    points = bench.wave(4)
    bench.motion().send(bench.download(points))
    bench.wait_until_moving()
    assert not bench.standing
    with check_fails("comes to rest"):
        bench.wait_until_standing(0.5)
    with check_fails("reaches the last point"):
        bench.wait_until_at(points[0][0], 3)
    bench.wait_until_at(points[-1][0])
    # Rest is a tenth of a second of it.
    since = bench.now
    bench.wait_until_standing()
    assert bench.now - since >= 0.1


# -- a trajectory, whole, in time, without a complaint --------------------------------------------


def test_a_trajectory_that_is_not_executed_is_seen(bench):
    bench.assert_moves_through(bench.motion(), bench.wave(3))
    bench.controller.perform("stop")
    with check_fails("reaches the last point"):
        bench.assert_moves_through(bench.motion(), bench.wave(3))


def test_one_that_takes_too_long_is_seen(bench):
    link, points = bench.motion(), bench.wave(6)
    slower = bench.download([(p, 4 * d) for p, d in points])
    bench.download = lambda _points: slower
    with check_fails("2.00 s of motion took 8"):
        bench.assert_moves_through(link, points)


def test_one_that_is_executed_on_another_way_is_seen(bench):
    link, points = bench.motion(), bench.wave(6)
    target = points[-1][0]
    elsewhere = bench.download(
        [points[0], (position_checks.changed(target, 0, -0.2), 1.0), (target, 1.0)]
    )
    bench.download = lambda _points: elsewhere
    with check_fails("off what was asked"):
        bench.assert_moves_through(link, points)


def test_one_of_which_the_controller_complains_is_seen(bench):
    complains(bench, 50_024)
    with check_fails("complains of the motion"):
        bench.assert_moves_through(bench.motion(), bench.wave(6))


def test_late_corner_is_excused_only_with_random_task_order(bench):
    bench.setting = assumed(["schedule=random", "costs=4.0", "planning_lead=0.02"])
    complains(bench, 50_024)
    bench.assert_moves_through(bench.motion(), bench.wave(6))
    complains(bench, 50_078)
    with check_fails("complains of the motion"):
        bench.assert_moves_through(bench.motion(), bench.wave(6))


def complains(bench, code):
    """An event of a motion's that is about to be under way."""
    bench.controller.scheduler.after(
        500_000_000,
        lambda: bench.controller.log.write(code, EventType.WARNING, "Corner path failure"),
    )


def test_a_task_that_has_ended_is_not_healthy(bench):
    bench.assert_healthy()
    fails(bench, "ROS_motion", "WaitTime", "ERR_OUTOFBND", 9)
    fails(bench, "ROS_supervisor", "OpMode", "ERR_OUTOFBND")
    bench.run(1)
    with check_fails("T_ROS_SUP ended with an error"):
        bench.assert_healthy()
