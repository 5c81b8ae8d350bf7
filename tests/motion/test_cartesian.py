"""Lines, circles and their corners. Sources: S4 overview p.5-11..5-19, S4 datasys 1-zonedata."""

import math

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.path_shapes import arc_through
from rapidgen.machine.scheduler import S
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.moves import CartesianMove, MoveFrames, MoveSpeed, Singularities
from tests.motion.cell import PLANNED, Cell, zone

HOME = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)
TOOL = ((0.02, 0.0, 0.15), (1.0, 0.0, 0.0, 0.0))


@pytest.fixture
def robot(make_cell):
    cell = make_cell(settings=PLANNED)
    cell.group.jump(HOME)
    return cell


@pytest.fixture
def linear(robot, zones):
    """A linear move relative to the pose at HOME: m, and a turn about the tool's z in rad."""
    start = robot.group.kinematics.forward(HOME)

    def make(x, y, z, *, turn=0.0, zone=0, tcp=0.2, via=None, tool=None, **more):
        carrier = MoveFrames(tool=tool) if tool else MoveFrames()
        base = carrier.pose(start)
        target = (
            frames.add(base[0], (x, y, z)),
            frames.multiply(base[1], frames.about((0.0, 0.0, 1.0), turn)),
        )
        if via is not None:
            via = (frames.add(base[0], via), base[1])
        speed = MoveSpeed(tcp, **{k: more.pop(k) for k in ("orientation",) if k in more})
        return CartesianMove(
            target=target, external=HOME, via=via, speed=speed, zone=zones(zone),
            carrier=carrier, **more,
        )  # fmt: skip

    return make


def tcp(cell, tool=None):
    """Positions relative to the TCP at HOME, and orientations."""
    carrier = MoveFrames(tool=tool) if tool else MoveFrames()
    own = cell.group.kinematics
    start = carrier.pose(own.forward(HOME))[0]
    poses = [carrier.pose(own.forward(tuple(q))) for q in cell.path]
    return np.array([p[0] for p in poses]) - np.array(start), [p[1] for p in poses]


def test_a_line_is_straight_at_constant_speed_and_turns_evenly(robot, linear):
    robot.run(lambda task: robot.group.move(task, linear(0.0, 0.1, 0.05, turn=0.5, tool=TOOL)))
    places, turns = tcp(robot, TOOL)
    length = math.hypot(0.1, 0.05)
    along = places @ np.array([0, 0.1, 0.05]) / length
    off = places - np.outer(along / length, [0, 0.1, 0.05])
    assert np.abs(off).max() < 1e-8
    assert places[-1] == pytest.approx([0, 0.1, 0.05], abs=1e-8)
    speeds = np.diff(along) / 0.002
    assert speeds.max() == pytest.approx(0.2, rel=1e-3)
    angles = np.array([frames.angle_between(turns[0], q) for q in turns])
    assert angles == pytest.approx(0.5 * along / length, abs=1e-6)
    assert robot.shares()[1] < 1.05


def test_the_slowest_part_sets_the_time(robot, linear):
    # S4 datasys 1-speeddata-1: 0.5 rad at 0.1 rad/s beats 100 mm at 1 m/s
    robot.run(
        lambda task: robot.group.move(task, linear(0, 0.1, 0, turn=0.5, tcp=1.0, orientation=0.1))
    )
    assert robot.times[-1] / S == pytest.approx(5.0, abs=0.15)


def test_pure_reorientation_turns_at_its_own_speed(robot, linear):
    robot.run(lambda task: robot.group.move(task, linear(0, 0, 0, turn=0.6, orientation=0.3)))
    places, _ = tcp(robot)
    assert np.abs(places).max() < 1e-8
    assert robot.times[-1] / S == pytest.approx(2.0, abs=0.1)


def test_time_is_kept_on_a_line(robot, linear):
    robot.run(lambda task: robot.group.move(task, linear(0, 0.1, 0, time=0.8)))
    assert robot.times[-1] / S == pytest.approx(0.8, abs=0.01)


def test_a_circle_keeps_radius_plane_and_relative_orientation(robot, linear):
    robot.run(
        lambda task: robot.group.move(task, linear(0, 0.1, 0.0, via=(0.0, 0.05, 0.05), tcp=0.1))
    )
    places, _ = tcp(robot)
    assert np.linalg.norm(places - [0, 0.05, 0], axis=1) == pytest.approx(0.05, abs=1e-7)
    assert np.abs(places[:, 0]).max() < 1e-8
    assert places[:, 2].max() == pytest.approx(0.05, abs=1e-5)
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / 0.002
    assert speeds.max() == pytest.approx(0.1, rel=1e-3)


@pytest.mark.parametrize("height", [0.0499, 0.05, 0.0501])
def test_one_orientation_at_all_three_points_stays(robot, linear, height):
    """The orientation at the circle point chooses the way round, also at half a circle."""
    robot.run(
        lambda task: robot.group.move(task, linear(0, 0.1, 0.0, via=(0.0, 0.05, height), tcp=0.1))
    )
    _, turns = tcp(robot)
    assert max(frames.angle_between(turns[0], q) for q in turns) < 1e-6


def test_an_orientation_that_turns_with_the_path(robot, zones):
    """A quarter circle to a pose turned by the same quarter: constant relative to the path."""
    own = robot.group.kinematics
    start = own.forward(HOME)
    centre = frames.add(start[0], (0.0, 0.05, 0.0))

    def on_circle(angle):
        q = frames.about((1.0, 0.0, 0.0), -angle)
        arm = frames.rotate(q, (0.0, -0.05, 0.0))
        return frames.add(centre, arm), frames.multiply(q, start[1])

    move = CartesianMove(
        target=on_circle(math.pi / 2), via=on_circle(math.pi / 4), external=HOME,
        speed=MoveSpeed(0.1), zone=zones(0),
    )  # fmt: skip
    robot.run(lambda task: robot.group.move(task, move))
    for posture in robot.path[::50]:
        place, q = own.forward(tuple(posture))
        arm = frames.subtract(place, centre)
        angle = math.atan2(arm[2], -arm[1])
        assert frames.angle_between(q, on_circle(angle)[1]) < 1e-5


@pytest.mark.parametrize(
    ("via", "end"),
    [((0, 0.15, 0.0), (0, 0.1, 0.0)), ((0, 0.00005, 0.0), (0, 0.1, 0.0))],
)
def test_three_points_that_make_no_circle(robot, linear, via, end):
    def program(task):
        with pytest.raises(MotionFault) as fault:
            robot.group.move(task, linear(*end, via=via))
        assert fault.value.refusal is FaultReason.NO_CIRCLE

    robot.run(program)


@pytest.mark.parametrize("height", [0.0, 2e-6, 5e-5])
def test_a_circle_through_nearly_straight_points(robot, linear, height):
    """RobotStudio drives them, as does a real robot (rapidgen.motion.cartesian)."""
    robot.run(lambda task: robot.group.move(task, linear(0, 0.1, 0.0, via=(0.0, 0.05, height))))
    places, _ = tcp(robot)
    assert places[-1] == pytest.approx((0.0, 0.1, 0.0), abs=1e-6)
    assert places[:, 2].max() == pytest.approx(height, abs=3e-6)


@pytest.mark.parametrize(("degrees", "makes_one"), [(0.98, False), (1.02, True)])
def test_two_points_are_a_degree_apart_as_the_first_sees_them(degrees, makes_one):
    """A limit of MoveC in ABB's reference, as RobotComponents' path generator names it."""
    height = 0.05 * math.tan(math.radians(degrees))
    start, via, end = (
        ((0.0, y, z), frames.UNIT) for y, z in ((0.0, 0.0), (0.05, height), (0.1, 0.0))
    )
    assert (arc_through(start, via, end) is not None) == makes_one


def test_more_than_240_degrees_are_two_instructions(robot, linear):
    def program(task):
        with pytest.raises(MotionFault) as fault:
            robot.group.move(task, linear(0, 0.01, 0.0, via=(0.0, 0.005, 0.08)))
        assert fault.value.refusal is FaultReason.CIRCLE_TOO_LONG

    robot.run(program)


def test_a_corner_is_the_parabola_of_the_tcp_zone(robot, linear):
    def program(task):
        robot.group.move(task, linear(0, 0.1, 0, zone=30))
        robot.group.move(task, linear(0, 0.1, 0.1))

    robot.run(program, period=0.001)
    places, _ = tcp(robot)
    inside = places[(places[:, 1] < 0.1 - 1e-7) & (places[:, 2] > 1e-7)]
    assert inside[:, 1].min() == pytest.approx(0.07, abs=5e-4)
    assert inside[:, 2].max() == pytest.approx(0.03, abs=5e-4)
    u, v = (0.1 - inside[:, 1]) / 0.03, inside[:, 2] / 0.03
    assert np.sqrt(u) + np.sqrt(v) == pytest.approx(1.0, abs=1e-4)


def test_different_speeds_do_not_change_the_corner(robot, linear):
    def program(task):
        robot.group.move(task, linear(0, 0.1, 0, zone=30, tcp=0.05))
        robot.group.move(task, linear(0, 0.1, 0.1, tcp=0.3))

    robot.run(program, period=0.001)
    places, _ = tcp(robot)
    inside = places[(places[:, 1] < 0.1 - 1e-7) & (places[:, 2] > 1e-7)]
    u, v = (0.1 - inside[:, 1]) / 0.03, inside[:, 2] / 0.03
    assert np.sqrt(u) + np.sqrt(v) == pytest.approx(1.0, abs=1e-4)


def test_reorientation_begins_at_the_extended_zone(robot, linear):
    """S4 datasys 1-zonedata: 100 mm, z20 with 30 mm for orientation, large zone_ori."""

    def program(task):
        robot.group.move(task, linear(0, 0.1, 0, zone=20))
        robot.group.move(task, linear(0, 0.1, 0.1, turn=0.1))

    robot.run(program, period=0.001)
    places, turns = tcp(robot)
    turned = np.array([frames.angle_between(turns[0], q) for q in turns])
    first = places[np.argmax(turned > 1e-6)]
    assert first[1] == pytest.approx(0.07, abs=2e-3)
    assert abs(first[2]) < 1e-7  # while the TCP is still on the first line


def test_a_large_turn_shrinks_the_tcp_zone(robot, linear):
    """S4 datasys 1-zonedata-4: 200 mm, z60 (9 deg), 60 deg turn: both zones are 15 %."""

    def program(task):
        robot.group.move(task, linear(0, 0.12, 0, zone=60))
        robot.group.move(task, linear(0, 0.12, 0.12, turn=math.radians(60)))

    robot.run(program, period=0.001)
    places, _ = tcp(robot)
    inside = places[(places[:, 1] < 0.12 - 1e-7) & (places[:, 2] > 1e-7)]
    # zone_ori of the fixture: 60 mm * 2.6 rad/m = 0.156 rad of 1.047 rad, of 120 mm
    assert inside[:, 1].min() == pytest.approx(0.12 * (1 - 0.156 / 1.0472), abs=1e-3)


def test_no_corner_between_motion_and_pure_reorientation(robot, linear):
    # S4 overview p.5-17
    def program(task):
        robot.group.move(task, linear(0, 0.1, 0, zone=30))
        robot.group.move(task, linear(0, 0.1, 0, turn=0.5))

    robot.run(program)
    places, _ = tcp(robot)
    assert np.abs(places[:, [0, 2]]).max() < 1e-7
    assert places[:, 1].max() == pytest.approx(0.1, abs=1e-7)


def test_joint_and_linear_moves_meet_in_a_smooth_corner(robot, linear, joint):
    def program(task):
        robot.group.move(task, linear(0, 0.1, 0, zone=30))
        robot.group.move(task, joint(20, 20, 10, 10, 30, z=30))
        robot.group.move(task, linear(0, 0, 0.05))

    robot.run(program)
    speed, acceleration = robot.shares()
    assert speed <= 1.001
    assert acceleration <= 1.1
    moving = np.abs(np.diff(robot.path, axis=0)).max(axis=1)[50:-100]
    assert moving.min() > 0  # it did not stop at the points


def test_a_stop_at_any_time_stays_on_the_line(robot, linear):
    group = robot.group
    for k in range(6):
        robot.at(0.1 + 0.3 * k, lambda: group.stop("x"))
        robot.at(0.25 + 0.3 * k, lambda: group.start("x"))
    robot.run(lambda task: group.move(task, linear(0, 0.1, 0.1, turn=0.3)))
    places, _ = tcp(robot)
    assert np.abs(places[:, 1] - places[:, 2]).max() < 1e-7
    assert robot.shares()[1] < 1.05


def test_a_stationary_tool_moves_the_object(robot, zones):
    """S4 overview p.5-8: the path is that of the tool in the held object."""
    group = robot.group
    own = group.kinematics
    fixed = ((0.5, 0.1, 0.6), (1.0, 0.0, 0.0, 0.0))
    carrier = MoveFrames(tool=fixed, object=TOOL, stationary=True)
    start = carrier.pose(own.forward(HOME))
    target = (frames.add(start[0], (0.02, 0.03, 0.0)), start[1])
    move = CartesianMove(
        target=target, external=HOME, speed=MoveSpeed(0.1), zone=zones(0), carrier=carrier
    )
    robot.run(lambda task: group.move(task, move))
    poses = [carrier.pose(own.forward(tuple(q))) for q in robot.path]
    places = np.array([p[0] for p in poses]) - np.array(start[0])
    assert places[-1] == pytest.approx([0.02, 0.03, 0.0], abs=1e-8)
    assert np.abs(places[:, 0] * 3 - places[:, 1] * 2).max() < 1e-7


def test_out_of_reach_and_out_of_range_are_errors_before_motion(robot, linear):
    result = []

    def program(task):
        for target in ((1.0, 0, 0), (-0.3, 0.05, -0.2)):
            with pytest.raises(MotionFault) as fault:
                robot.group.move(task, linear(*target))
            result.append(fault.value.refusal)

    robot.run(program)
    assert result == [FaultReason.OUT_OF_REACH, FaultReason.OUT_OF_RANGE]
    assert robot.group.positions() == HOME


def test_a_line_through_the_wrist_singularity(make_cell, zones):
    cell = make_cell(settings=PLANNED)
    group = cell.group
    group.jump((0.3, 0.0, 0.0, 0.4, 0.4, 0.0))
    own = group.kinematics
    opposite = own.forward((0.3, 0.0, 0.0, 0.4, -0.4, 0.0))
    move = CartesianMove(
        target=opposite, external=group.positions(), speed=MoveSpeed(0.1), zone=zones(0)
    )

    def program(task):
        with pytest.raises(MotionFault) as fault:
            group.move(task, move)
        assert fault.value.refusal is FaultReason.SINGULARITY

    cell.run(program)


def test_with_sing_area_wrist_the_line_goes_through_the_singularity(make_cell, zones):
    """S4 datasys 2-SingArea: wrist axes straight in joint space, TCP on the line."""
    cell = make_cell(settings=PLANNED)
    group = cell.group
    group.jump((0.3, 0.0, 0.0, 0.4, 0.4, 0.0))
    own = group.kinematics
    start, end = (own.forward((0.3, 0.0, 0.0, 0.4, a5, 0.0)) for a5 in (0.4, -0.4))
    move = CartesianMove(
        target=end,
        external=group.positions(),
        speed=MoveSpeed(0.1),
        zone=zones(0),
        singularities=Singularities.WRIST,
    )
    cell.run(lambda task: group.move(task, move))
    places = np.array([own.forward(tuple(q))[0] for q in cell.path]) - np.array(start[0])
    line = np.array(end[0]) - np.array(start[0])
    off = places - np.outer(places @ line / (line @ line), line)
    assert np.abs(off).max() < 1e-7
    assert places[-1] == pytest.approx(line, abs=1e-7)
    assert frames.angle_between(own.forward(group.positions())[1], end[1]) < 1e-6
    wrist = cell.path[:, 4]
    assert (np.diff(wrist) <= 1e-12).all()
    assert cell.shares()[1] < 1.1


def test_a_line_that_ends_in_another_configuration(robot, linear):
    def program(task):
        with pytest.raises(MotionFault) as fault:
            robot.group.move(task, linear(0, 0.1, 0, wanted=(0, 0, 0, 1)))
        assert fault.value.refusal is FaultReason.CONFIGURATION
        robot.group.move(task, linear(0, 0.1, 0, wanted=(0, 0, 0, 0)))

    robot.run(program)


def test_robots_without_a_closed_form_go_straight_too(make_cell, zones):
    cell = make_cell("crb15000", PLANNED)
    group = cell.group
    home = (0.1, 0.2, 0.3, 0.2, 0.7, 0.1)
    group.jump(home)
    own = group.kinematics
    start = own.forward(home)
    move = CartesianMove(
        target=(frames.add(start[0], (0.0, 0.05, 0.05)), start[1]),
        external=home, speed=MoveSpeed(0.2), zone=zones(0),
    )  # fmt: skip
    cell.run(lambda task: group.move(task, move), period=0.01)
    places = np.array([own.forward(tuple(q))[0] for q in cell.path]) - np.array(start[0])
    assert places[-1] == pytest.approx([0, 0.05, 0.05], abs=1e-7)
    assert np.abs(places[:, 1] - places[:, 2]).max() < 1e-7


def test_a_track_moves_with_the_tcp_on_its_line(make_cell, zones):
    cell = make_cell("irb120_track", PLANNED)
    group = cell.group
    axes = [j.axis for j in group.config.joints]
    home = tuple(0.5 if a == "rax_5" else 0.0 for a in axes)
    group.jump(home)
    track = axes.index("eax_a")
    start = group.kinematics.forward(home)
    external = tuple(0.3 if i == track else v for i, v in enumerate(home))
    move = CartesianMove(
        target=(frames.add(start[0], (0.3, 0.05, 0.0)), start[1]),
        external=external, speed=MoveSpeed(0.2), zone=zones(0),
    )  # fmt: skip
    cell.run(lambda task: group.move(task, move), period=0.01)
    places = np.array([group.kinematics.forward(tuple(q))[0] for q in cell.path])
    line = places - np.array(start[0])
    assert cell.path[-1, track] == pytest.approx(0.3)
    assert np.abs(line[:, 1] * 6 - line[:, 0]).max() < 1e-7
    assert cell.path[:, track] * 0.05 / 0.3 == pytest.approx(line[:, 1], abs=1e-7)


@pytest.mark.parametrize("length", [0.0002, 0.001, 0.0029])
@pytest.mark.parametrize("size", [0.3, 1])
def test_short_lines_are_straight_and_pass_their_points(length, size):
    """Axes that go straight over a short line leave it by less than 2 um, corners included."""
    cell = Cell("irb120", PLANNED)
    home = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)
    cell.group.jump(home)
    kinematics = cell.group.geometry()
    start = kinematics.forward(home)
    count = 60

    def program(task):
        for k in range(1, count + 1):
            target = frames.add(start[0], (0.0, length * k, -0.5 * length * k)), start[1]
            end = zone(size if k < count else 0)
            cell.group.move(
                task,
                CartesianMove(target=target, external=home, speed=MoveSpeed(0.1), zone=end),
            )

    cell.run(program)
    way = frames.unit((0.0, 1.0, -0.5))
    places = [kinematics.forward(tuple(q)) for q in cell.path[::7]]
    for place, turn in places:
        offset = frames.subtract(place, start[0])
        along = frames.dot(offset, way)
        assert frames.norm(frames.subtract(offset, frames.scale(way, along))) < 2e-6
        assert frames.angle_between(turn, start[1]) < 5e-6
    assert max(cell.shares()) < 1.001
