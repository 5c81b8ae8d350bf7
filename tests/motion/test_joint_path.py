"""Joint moves: times, look-ahead, corners, stops. Sources: S4 overview chapter 5, S4 datasys."""

import math

import numpy as np
import pytest

from rapidgen.machine.scheduler import S
from rapidgen.motion import MotionSettings
from rapidgen.motion.events import CORNER_PATH_FAILURE, TIME_NOT_MET
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.group import MotionGroup

MS = 1_000_000


def at_rest(cell, *degrees):
    wanted = [*degrees, *[0.0] * (6 - len(degrees))]
    return np.degrees(cell.group.positions()) == pytest.approx(wanted, abs=1e-9)


def test_time_includes_the_ramps(cell, joint):
    ends = []

    def program(task):
        cell.group.move(task, joint(30, 20, time=1.5))
        ends.append(task.scheduler.now / S)

    cell.run(program)
    assert ends[0] == pytest.approx(1.5, abs=1e-6)
    assert at_rest(cell, 30, 20)


def test_a_trajectory_takes_the_sum_of_its_times(cell, joint):
    """Different speeds in every segment: the corners keep time."""
    ends = []

    def program(task):
        for k, time in enumerate((0.5, 0.3, 0.6, 0.2, 0.5)):
            task.charge(MS)
            cell.group.move(task, joint(8 * (k + 1), 5 * k, z=10 if k < 4 else 0, time=time))
        ends.append(task.scheduler.now / S)

    cell.run(program)
    assert ends[0] == pytest.approx(2.1 + 0.001, abs=0.002)
    assert cell.events(TIME_NOT_MET) == 0
    assert cell.shares()[1] < 1.001


def test_a_time_that_cannot_be_kept_is_reported(cell, joint):
    cell.run(lambda task: cell.group.move(task, joint(90, time=0.1)))
    assert cell.events(TIME_NOT_MET) == 1
    speed, acceleration = cell.shares()
    assert speed <= 1 + 1e-6
    assert acceleration <= 1 + 1e-3


def test_the_axis_that_needs_most_of_its_speed_sets_the_time(cell, joint):
    # 250 deg/s for axis 1, 320 for axis 4 (S4 overview p.5-11)
    cell.run(lambda task: cell.group.move(task, joint(100, 0, 0, 100, tcp=1000)))
    speeds = np.degrees(np.abs(np.diff(cell.path, axis=0)).max(axis=0) / 0.002)
    assert speeds[0] == pytest.approx(250, rel=1e-6)
    assert speeds[3] == pytest.approx(250, rel=1e-6)


def test_the_program_runs_ahead_by_the_planning_lead_and_waits_at_fine(cell, joint):
    """S4 overview p.5-25: about 0.1 s before the zone; a stop point holds it."""
    returned = []

    def program(task):
        cell.group.move(task, joint(20, z=10, time=1.0))
        returned.append(task.scheduler.now / S)
        cell.group.move(task, joint(40, z=0, time=1.0))
        returned.append(task.scheduler.now / S)

    cell.run(program)
    assert 0.7 < returned[0] < 0.9
    assert returned[1] == pytest.approx(2.0, abs=1e-3)
    assert cell.events(CORNER_PATH_FAILURE) == 0


def test_no_successor_in_time_is_a_corner_path_failure(cell, joint):
    # S4 overview p.5-19, IRC5 intro p.30
    def program(task):
        cell.group.move(task, joint(20, z=10, time=1.0))
        task.sleep(0.5)
        cell.group.move(task, joint(40, time=1.0))

    cell.run(program)
    assert cell.events(CORNER_PATH_FAILURE) == 1
    standing = np.abs(np.diff(cell.path[:, 0])) < 1e-12
    reached = np.abs(np.degrees(cell.path[1:, 0]) - 20) < 1e-6
    assert (standing & reached).any()
    assert at_rest(cell, 40)


def test_a_corner_is_the_parabola_of_its_zone(make_cell, joint):
    """Entry and exit at one radius, tangents along both moves, nothing outside the triangle.

    Without smoothing, which rounds it further, and with a parabola of the whole zone.
    """
    cell = make_cell(settings=MotionSettings(lever=1.0, ramp_time=0.0, corner_size=1.0))
    cell.group.planner.kinematics = None  # a lever of 1 m: zones in mm are thousandths of a rad

    def program(task):
        cell.group.move(task, joint(math.degrees(0.5), 0, z=100, tcp=0.5))
        cell.group.move(task, joint(math.degrees(0.5), math.degrees(0.5), tcp=0.5))

    cell.run(program, period=0.001)
    path = cell.path[:, :2]
    off = path[(path[:, 0] < 0.5 - 1e-9) & (path[:, 1] > 1e-9)]
    assert off[:, 0].min() == pytest.approx(0.4, abs=1e-3)
    assert off[:, 1].max() == pytest.approx(0.1, abs=1e-3)
    u, v = (0.5 - off[:, 0]) / 0.1, off[:, 1] / 0.1
    assert np.sqrt(u) + np.sqrt(v) == pytest.approx(1.0, abs=1e-6)


def test_a_zone_never_exceeds_half_of_the_shorter_move(make_cell, joint):
    cell = make_cell(settings=MotionSettings(ramp_time=0.0, corner_size=1.0))
    cell.group.planner.kinematics = None

    def program(task):
        cell.group.move(task, joint(math.degrees(0.5), 0, z=200, tcp=0.5))
        cell.group.move(task, joint(math.degrees(0.5), math.degrees(0.1), z=200, tcp=0.5))
        cell.group.move(task, joint(math.degrees(0.6), math.degrees(0.1), tcp=0.5))

    cell.run(program, period=0.001)
    path = cell.path[:, :2]
    left = path[path[:, 1] > 1e-9][0]
    assert left[0] == pytest.approx(0.45, abs=2e-3)


def test_stop_start_and_is_standing(cell, joint):
    group = cell.group
    stood = []
    cell.at(0.5, lambda: group.stop("move task"))
    cell.at(0.8, lambda: stood.append((group.is_standing, group.positions())))
    cell.at(1.5, lambda: stood.append((group.is_standing, group.positions())))
    cell.at(1.6, lambda: group.start("move task"))
    cell.run(lambda task: group.move(task, joint(60, 30, time=1.2)))
    assert stood[0][0]
    assert stood[0] == stood[1]
    assert at_rest(cell, 60, 30)
    line = cell.path[:, 1] / 30 - cell.path[:, 0] / 60
    assert np.abs(line).max() < 1e-9
    assert cell.shares()[1] <= 1.001


def _stop(group):
    group.stop("move task")


@pytest.mark.parametrize("end", [_stop, MotionGroup.clear_path])
def test_a_stop_holds_at_a_missed_corner(make_cell, joint, end):
    """Also while the robot comes to rest there, when nothing moves any more as planned."""
    ends = []
    for milliseconds in range(930, 1130, 10):
        cell = make_cell()

        def program(task, group=cell.group):
            group.move(task, joint(20, z=10, time=1.0))
            task.sleep(0.12)
            group.move(task, joint(40, time=1.0))

        cell.at(milliseconds / 1000, lambda group=cell.group: end(group))
        cell.start(program)
        cell.sample(lambda: False, limit=1.5)
        assert cell.events(CORNER_PATH_FAILURE) == 1
        assert cell.group.is_standing
        ends.append(math.degrees(cell.group.positions()[0]))
    assert max(ends) < 22
    assert ends == sorted(ends)


@pytest.mark.parametrize("end", [_stop, MotionGroup.clear_path])
def test_a_stop_holds_for_a_robot_that_has_not_come_to_rest_from_another(make_cell, joint, end):
    for milliseconds in range(40, 140, 10):
        cell = make_cell()
        group = cell.group
        cell.at(0.5, lambda group=group: group.stop("x"))
        cell.at(0.5 + milliseconds / 1000, lambda group=group: group.start("x"))
        cell.at(0.51 + milliseconds / 1000, lambda group=group: end(group))
        cell.start(lambda task, group=group: group.move(task, joint(60, time=1.2)))
        cell.sample(lambda: False, limit=1.2)
        assert group.is_standing
        assert math.degrees(group.positions()[0]) < 30


def test_a_quick_stop_is_shorter_and_stays_on_the_path(make_cell, joint):
    way = []
    for quick in (False, True):
        cell = make_cell(settings=MotionSettings(ramp_time=0.0))
        group = cell.group
        cell.at(0.5, lambda group=group, quick=quick: group.stop("x", quick=quick))
        cell.at(0.5, lambda group=group: way.append(group.positions()[0]))
        cell.at(1.5, lambda group=group: way.append(group.positions()[0]))
        cell.at(1.6, lambda group=group: group.start("x"))
        cell.run(lambda task, group=group: group.move(task, joint(60, 30, time=1.2)))
        assert np.abs(cell.path[:, 1] * 2 - cell.path[:, 0]).max() < 1e-9
    assert way[3] - way[2] == pytest.approx((way[1] - way[0]) / 2, rel=1e-6)


def test_stop_clear_start_at_once_leaves_the_robot_where_it_comes_to_rest(make_cell, joint):
    """abb_driver [code] calls StopMove, ClearPath, StartMove without waiting."""
    cell = make_cell(settings=MotionSettings(cleared_move="return"))
    group = cell.group

    def abort():
        group.stop("move task")
        group.clear_path()
        group.start("move task")

    cell.at(0.5, abort)
    finished = []

    def program(task):
        group.move(task, joint(60, time=1.2))
        finished.append(task.scheduler.now / S)
        group.move(task, joint(0, time=2.0))

    cell.run(program)
    assert finished == [0.5]  # the move is gone; the next one starts from where the stop ends
    assert at_rest(cell, 0)
    assert np.degrees(cell.path[:, 0]).max() < 40
    assert cell.shares()[1] <= 1.001


def test_a_cleared_move_hangs(cell, joint):
    # Nantaphat-Yoktaworn/node-red-contrib-abb-gofa, RobotWare 7.21
    group = cell.group
    cell.at(0.5, group.clear_path)
    task = cell.start(lambda task: group.move(task, joint(60, time=1.2)))
    cell.sample(lambda: False, limit=3.0)
    assert task.alive


def test_moves_wait_while_a_stop_is_active(cell, joint):
    group = cell.group
    group.stop("other task")
    cell.at(1.0, lambda: group.start("other task"))
    cell.run(lambda task: group.move(task, joint(10, time=0.5)))
    assert cell.times[-1] / S == pytest.approx(1.5, abs=0.003)


def test_every_stop_must_be_taken_back(cell, joint):
    group = cell.group
    group.stop("move task")
    group.stop("other task")
    cell.at(0.5, lambda: group.start("move task"))
    cell.at(1.0, lambda: group.start("other task"))
    cell.run(lambda task: group.move(task, joint(10, time=0.5)))
    assert cell.times[-1] / S == pytest.approx(1.5, abs=0.003)


def test_override_scales_the_speed_at_any_time(cell, joint):
    group = cell.group

    def half():
        group.override = 0.5

    cell.at(0.0, half)
    cell.run(lambda task: group.move(task, joint(30, time=2.0)))
    assert cell.times[-1] / S == pytest.approx(4.0, rel=0.03)
    assert cell.shares()[1] <= 1.001


def test_override_zero_holds_and_goes_on(cell, joint):
    group = cell.group

    def override(value):
        group.override = value

    cell.at(0.5, lambda: override(0.0))
    cell.at(2.0, lambda: override(1.0))
    cell.run(lambda task: group.move(task, joint(30, time=1.0)))
    assert 2.4 < cell.times[-1] / S < 2.8
    assert at_rest(cell, 30)


def test_manual_mode_limits_the_tcp(cell, joint):
    cell.group.reduced = True
    cell.run(lambda task: cell.group.move(task, joint(90, tcp=5.0)))
    places = np.array([cell.group.kinematics.forward(tuple(q))[0] for q in cell.path])
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / 0.002
    assert speeds.max() <= 0.25 * 1.01
    assert speeds.max() > 0.24


def test_concurrent_moves_return_at_once_but_five_at_most(cell, joint):
    # S4 datasys 2-MoveJ-1
    refused = []

    def program(task):
        for k in range(5):
            cell.group.move(task, joint(k + 1, z=1, time=0.5, concurrent=True))
        assert task.scheduler.now == 0
        with pytest.raises(MotionFault) as fault:
            cell.group.move(task, joint(9, concurrent=True))
        refused.append(fault.value.refusal)
        cell.group.move(task, joint(6, time=0.5))

    cell.run(program)
    assert refused == [FaultReason.TOO_MANY_CONCURRENT]
    assert at_rest(cell, 6)


def test_a_target_outside_the_range_moves_nothing(make_cell, joint):
    cell = make_cell()

    def program(task):
        with pytest.raises(MotionFault) as fault:
            cell.group.move(task, joint(166))
        assert fault.value.refusal is FaultReason.OUT_OF_RANGE

    cell.run(program)
    assert at_rest(cell, 0)


def test_a_move_to_where_the_path_ends_takes_no_time(make_cell, joint):
    for choice, expected in (("skip", 1.0), ("wait", 1.5)):
        cell = make_cell(settings=MotionSettings(zero_length=choice))

        def program(task, cell=cell):
            cell.group.move(task, joint(10, time=1.0))
            cell.group.move(task, joint(10, time=0.5))

        cell.run(program)
        assert cell.times[-1] / S == pytest.approx(expected, abs=0.003)


def test_a_stop_point_on_a_fly_by_end_waits_there(cell, joint):
    def program(task):
        cell.group.move(task, joint(10, z=10, time=1.0))
        cell.group.move(task, joint(10))
        assert cell.group.is_standing

    cell.run(program)
    assert at_rest(cell, 10)
    assert cell.events(CORNER_PATH_FAILURE) == 0


def test_dense_points_keep_moving(cell, joint):
    """10 ms segments: the queue is as deep as the lead asks for, nothing stops."""
    ends = []

    def program(task):
        for k in range(100):
            task.charge(MS)
            degrees = 20 * (1 - math.cos(math.pi * (k + 1) / 100))
            cell.group.move(task, joint(degrees, z=1 if k < 99 else 0, time=0.01))
        ends.append(task.scheduler.now / S)

    cell.run(program)
    assert cell.events(CORNER_PATH_FAILURE) == 0
    assert ends[0] == pytest.approx(1.0, abs=0.1)
    speeds = np.abs(np.diff(cell.path[:, 0]))[20:-20]
    assert speeds.min() > 0


def test_an_idle_robot_costs_no_events(cell, joint):
    cell.run(lambda task: cell.group.move(task, joint(10, time=1.0)))
    assert cell.scheduler.next_event() is None


def test_the_measured_position_follows_by_the_servo_lag(make_cell, joint):
    cell = make_cell(settings=MotionSettings(servo_lag=0.05))
    commanded = []
    cell.at(0.5, lambda: commanded.append(cell.group.commanded()))
    cell.at(0.55, lambda: commanded.append(cell.group.positions()))
    cell.at(0.6, lambda: cell.group.stop("x"))
    cell.at(0.9, lambda: cell.group.start("x"))
    cell.run(lambda task: cell.group.move(task, joint(60, time=1.2)))
    assert commanded[0] == pytest.approx(commanded[1], abs=1e-9)


def test_reset_forgets_path_stops_and_settings(make_cell, joint):
    cell = make_cell(settings=MotionSettings(cleared_move="return"))
    group = cell.group
    group.stop("move task")
    group.modal.speed_override = 0.3
    task = cell.start(lambda task: group.move(task, joint(30, time=1.0)))
    cell.scheduler.advance(until=S)
    group.reset()
    cell.scheduler.advance(until=2 * S)
    assert not task.alive
    assert group.stop_reasons == ()
    assert group.modal.speed_override == 1.0
    assert at_rest(cell, 0)


def test_a_stop_point_waits_for_the_settling_time_from_the_first_move_on(make_cell, joint):
    cell = make_cell(settings=MotionSettings(settle=0.2))
    finished = []

    def program(task):
        for degrees in (10, 20):
            cell.group.move(task, joint(degrees))
            finished.append((task.scheduler.now - cell.group.motion.end) / S)

    cell.run(program)
    assert finished == pytest.approx([0.2, 0.2], abs=1e-6)
