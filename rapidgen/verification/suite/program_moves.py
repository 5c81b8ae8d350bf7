"""Moves of programs: paths and times, postures, circles, frames, zones and speeds."""

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import astuple, replace

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose, Vector
from rapidgen.config.model import Placement
from rapidgen.motion.settings import MotionSettings
from rapidgen.runtime.builtins.motion.targets import data_of
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.runtime.values import Value
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call
from rapidgen.verification.messages import RawInstruction, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.path_deviation import farthest, movement, points
from rapidgen.verification.position_checks import Position, changed, distance, inward
from rapidgen.verification.program_steps import (
    Ended,
    Followed,
    Go,
    More,
    No,
    Program,
    Reached,
    Since,
    StoodAt,
    Stops,
    instruction,
    ordered_moves,
    right,
)
from rapidgen.verification.raw_programs import (
    BEGIN,
    END,
    Item,
    Programmer,
    RawMove,
    bent,
    by_hand,
    called,
    computes,
    orders,
    reached,
)
from rapidgen.verification.steps import Moving, Pass, Rest, Run, Step, generated
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.suite.speed import aside, asks_as_it_begins
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

ABSJ, MOVE_J = RawInstruction.MOVE_ABSJ, RawInstruction.MOVE_J
MOVE_L, MOVE_C = RawInstruction.MOVE_L, RawInstruction.MOVE_C
TOOL, WORK_OBJECT = RawInstruction.TOOL, RawInstruction.WORK_OBJECT
NO_CIRCLE, NO_FRAME = RawReason.NO_CIRCLE, RawReason.NO_FRAME
BAD_VALUE, POSE_MISMATCH = RawReason.BAD_VALUE, RawReason.POSE_MISMATCH
_LATER = 0.005
"""Share of its time by which a program may differ from RAPID."""
_SAME = 1e-5
"""m by which the TCP may leave the path of the same program in RAPID."""


def joint_move(move: RawMove, zone: float | None = None) -> RawMove:
    """Return the move to the same place as a move of joints."""
    return replace(move, kind=ABSJ, pose=None, zone=zone)


def to_pose(bench: Bench, move: RawMove, kind: RawInstruction) -> RawMove:
    """Return the move to the same place as a move to its pose."""
    return replace(move, kind=kind, pose=reached(bench, move.joints))


# -- paths and postures ------------------------------------------------------------------------


@case("program-like-rapid", "a program moves as the same one written in RAPID", once=True)
def _like_rapid(bench: Bench) -> None:
    """Execute on the same path and in the same time, without more stop points."""
    client, chance = Programmer(bench), random.Random(7)
    for _ in range(6):
        program_matches_rapid(client, bench, orders(bench, 8, chance))
    program_matches_rapid(client, bench, _turning(bench))


def _turning(bench: Bench) -> list[RawMove]:
    """Return moves whose duration depends on rotation or external axes."""
    first = orders(bench, 1, random.Random(8))[0]
    speed = min(0.5, bench.group.tcp_speed_limit)
    away = _turned(bench, first.joints, 0.4)
    slow = RawMove(ABSJ, away, None, speed=speed, turn=0.2, linear=0.03)
    if not computes(bench):
        return [first, slow]
    back = replace(slow, joints=_turned(bench, first.joints, 0.1))
    return [first, slow, to_pose(bench, back, MOVE_L)]


def _turned(bench: Bench, place: Position, angle: float) -> Position:
    """Return a position with the last and external axes moved by so much."""
    last = max(joint.axis for joint in bench.group.joints if joint.axis.startswith("rax"))
    return tuple(
        inward(joint, value, angle if joint.kind == "revolute" else 0.1)
        if joint.axis == last or joint.axis.startswith("eax")
        else value
        for joint, value in zip(bench.group.joints, place, strict=True)
    )


class MotionDiffers(CheckFailed):
    """A program moved differently than the same one in RAPID."""


def program_matches_rapid(
    client: Programmer,
    bench: Bench,
    program: list[RawMove],
    other: Bench | None = None,
    hand: list[RawMove] | None = None,
) -> None:
    """Compare a program with the same one in RAPID.

    Raises MotionDiffers, and CheckFailed as a check does.

    `other`: a new controller from `called`. `hand`: the RAPID program, if it differs.
    """
    home, since = bench.position, bench.now
    client.takes("a program", program)
    mine = _moved(bench, program, since)
    with other or bench.second_controller(called(bench.config, bench.group.task)) as other:
        by_hand(other, hand or program)
        other.motion_group.jump(home)
        theirs = _moved(other, program, 0.5)
    later, same = _LATER, _SAME
    if bench.setting.motion != MotionSettings():
        # If a robot settles, or its moves are planned just before the corner, the millisecond of
        # the next order decides how it is made; a stop there would take longer.
        later, same = 4 * later, 200 * same
    if abs(mine[0] - theirs[0]) > later * theirs[0]:
        raise MotionDiffers(
            f"a program took {mine[0]:.3f} s, {theirs[0]:.3f} s when written in RAPID"
        )
    paths = points(bench, mine[1]), points(bench, theirs[1])
    for one, path in (paths, paths[::-1]):
        far = farthest(one, path)
        if far > same:
            raise MotionDiffers(
                f"a program is {far * 1000:.3f} mm off the way of the same in RAPID"
            )


def _moved(bench: Bench, program: list[RawMove], since: float) -> tuple[float, list[Position]]:
    """Return s of movement and the positions until the robot stands."""
    bench.wait_until_at(program[-1].joints, 60)
    bench.run(0.3)
    return movement([sample for sample in bench.track if sample[0] >= since])


@case("program-configurations", "a program reaches its poses in the postures that it says")
@generated
def _configurations(bench: Bench) -> Iterator[Step]:
    """Move between configurations; earlier instructions have no influence."""
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    middle = bent(bench)
    target = RawMove(ABSJ, middle, None, zone=None)
    yield Go([target])
    for n, joint in enumerate(bench.group.joints):
        if joint.kind == "revolute" and joint.lower < -middle[n] < joint.upper:
            for place in (changed(middle, n, -middle[n]), middle):
                move = to_pose(bench, replace(target, joints=place), MOVE_J)
                yield Go([move], f"axis {n + 1} on its other side", then=0.5)


@case("program-arm-side", "a pose is reached on the side of the arm that is asked for", once=True)
@generated
def _arm_side(bench: Bench) -> Iterator[Step]:
    """Use poses with two postures of one configuration, the other one nearer."""
    geometry = bench.motion_group.kinematics
    if geometry is None or not computes(bench):
        raise NotApplicable("the driver computes no poses")
    middle = bent(bench)
    requested = (0.9, -middle[1], *middle[2:])
    alike = geometry.configuration(requested)
    move = to_pose(bench, RawMove(ABSJ, requested, None, zone=None), MOVE_J)
    for other in geometry.solutions(geometry.forward(requested), requested):
        if distance(other, requested) < 0.1 or geometry.configuration(other) != alike:
            continue
        place = tuple(round(value, 6) for value in other)
        yield Go([RawMove(ABSJ, place, None, zone=None)], "another posture", then=0.5)
        yield Go([move], "the posture that is asked for", then=0.5)


# -- circles -----------------------------------------------------------------------------------


@case("program-circles", "three points that make no circle, or too much of one, are refused")
@generated
def _circles(bench: Bench) -> Iterator[Step]:
    """Check circles from the start, after a move, in another frame, and across batches.

    Source: [REF MoveC, Limitations].
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    one, two, three = (joint_move(o, o.zone) for o in orders(bench, 3, random.Random(71)))
    yield Go([replace(one, zone=None)], then=0.5)
    line = to_pose(bench, one, MOVE_L)
    for before, start in (((), one), ((two, three), three), ((three, line), line)):
        for fits, what, circle in _with_end(bench, start, two):
            yield _answered(fits, [*before, circle], what)
    # The work object changes: the pose before a circle changes with it.
    given = _object(0.1)
    frame, first = _placement(given), bench.group.work_object.user_frame
    origin = frames.compose(
        frames.invert((frame.position, frame.orientation)), (first.position, first.orientation)
    )
    begin = replace(to_pose(bench, two, MOVE_L), frames=(0, 0))
    *_, (_, what, short), (_, too, long) = _with_end(bench, two, three)
    for fits, why, circle in ((True, what, short), (False, too, long)):
        assert circle.pose is not None
        assert circle.via is not None
        pose, via = (frames.compose(origin, place) for place in (circle.pose, circle.via))
        own = (0, 1 + len(bench.group.work_objects))
        seen = replace(circle, pose=pose, via=via, frames=own)
        yield _answered(fits, [begin, instruction(WORK_OBJECT, *given), seen], why)
    yield from (Rest(0.5), Program([replace(two, zone=None)], flags=BEGIN), Reached(two.joints))
    *_, (_, what, circle) = _with_end(bench, two, three)
    yield from (More([circle], 1, No(NO_CIRCLE, 1), END), Rest(0.5))


def _answered(fits: bool, items: Sequence[Item], what: str) -> Step:
    """Return the step of a program whose last circle is right or not; nothing moves."""
    return right(items, what) if fits else Program(items, No(NO_CIRCLE, len(items) - 1), what)


def _with_end(bench: Bench, start: RawMove, end: RawMove) -> Iterator[tuple[bool, str, RawMove]]:
    """Yield circles between two moves: valid or not, label, circle."""
    (first, turned), last = reached(bench, start.joints), reached(bench, end.joints)
    path = frames.subtract(last[0], first)
    chord, along = frames.norm(path), frames.unit(path)
    # Any direction across it.
    across = frames.unit(
        frames.cross(along, (0.0, 0.0, 1.0) if abs(along[2]) < 0.9 else (1.0, 0.0, 0.0))
    )

    def at(share: float, height: float) -> RawMove:
        aside = frames.add(frames.scale(path, share), frames.scale(across, height))
        return replace(end, kind=MOVE_C, pose=last, via=(frames.add(first, aside), turned))

    yield True, "half a circle", at(0.5, chord / 2)
    for far in (0.09e-3, 0.11e-3):
        yield far > 1e-4, f"a point {far} m from the beginning", at(0.0, far)
    # A point so close to the end is nearly on a line, too.
    for far in (0.09e-3, 0.018 * chord):
        yield far > 1e-4, f"a point {far} m from the end", at(1.0, far)
    for angle in (0.98, 1.02):
        height = chord / 2 * math.tan(math.radians(angle))
        yield angle > 1, f"two points seen {angle} degrees apart", at(0.5, height)
    yield False, "a point of the line, beyond its end", at(1.5, 0.0)
    up: Vector = frames.add(first, (0.0, 0.0, 0.05))
    round_trip = replace(at(0.0, 0.0), joints=start.joints, pose=(first, turned), via=(up, turned))
    yield False, "a circle that ends where it begins", round_trip
    for degrees in (239, 241):
        # The ratio of chord and height of a circle that turns so far.
        ratio = 2 * math.tan(math.radians((360 - degrees) / 4))
        yield degrees <= 240, f"{degrees} degrees", at(0.5, chord / ratio)


# -- tools and work objects --------------------------------------------------------------------


@case("program-tools", "a program moves other tools in other work objects")
@generated
def _tools(bench: Bench) -> Iterator[Step]:
    """Use each configured tool.

    A pose of another tool is rejected. The right pose is reached, with a stop point before its
    first move.
    """
    first, *more = orders(bench, 6, random.Random(24))
    tools = (bench.group.tool, *bench.group.tools)
    objects = (bench.group.work_object, *bench.group.work_objects)
    yield Go([first])
    for absent in (
        *((len(tools) + n, 0) for n in range(2)),
        *((0, len(objects) + n) for n in range(2)),
    ):
        yield Program([replace(first, frames=absent)], No(NO_FRAME), f"frames {absent}")
    pairs = [(t, o) for t in range(len(tools)) for o in range(len(objects))]
    if not computes(bench) or len(pairs) == 1:
        return
    for tool, wobj in pairs:
        own = [
            replace(
                move,
                kind=MOVE_L,
                pose=_seen(bench, move.joints, tools[tool].frame, objects[wobj].user_frame),
                frames=(tool, wobj),
            )
            for move in more[:3]
        ]
        another = (tool, wobj) != (0, 0)
        if another:
            yield Program([replace(own[0], frames=(0, 0))], No(POSE_MISMATCH), f"{tool}, {wobj}")
        # The motion ends where it started.
        yield from (Since(), Program([more[3], *own]), Moving(), Reached(own[-1].joints))
        yield Followed([more[3].joints, *(move.joints for move in own)])
        if another:
            yield StoodAt(more[3].joints)


def _seen(bench: Bench, joints: Position, tool: Placement, wobj: Placement) -> Pose:
    """Return the pose of joints, in m, with other frames."""
    geometry = bench.motion_group.kinematics
    assert geometry is not None
    tip = frames.compose(geometry.forward(joints), (tool.position, tool.orientation))
    pose = frames.compose(frames.invert((wobj.position, wobj.orientation)), tip)
    (x, y, z), (a, b, c, d) = ([round(value, 6) for value in part] for part in pose)
    return (x, y, z), (a, b, c, d)


def _tool(away: float, mass: float) -> list[float]:
    """Return operands of TOOL at a distance, turned by half a turn."""
    return [0.01, 0.0, away, 0.0, 1.0, 0.0, 0.0, 0.0, 0.01, away, 0, 1, 0, 0, mass, 0.1, 0.2, 0.3]


def _object(away: float) -> list[float]:
    """Return operands of WORK_OBJECT.

    The object frame is at a distance from the turned user frame.
    """
    return [away, 0.02, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, away, 1.0, 0.0, 0.0, 0.0]


def _placement(values: Sequence[float]) -> Placement:
    """Return the frame of operands; the two frames of a work object are multiplied."""
    (x, y, z, a, b, c, d), second = values[:7], values[7:]
    pose: Pose = (x, y, z), (a, b, c, d)
    if len(second) == 7:
        (x, y, z, a, b, c, d) = second
        pose = frames.compose(pose, ((x, y, z), (a, b, c, d)))
    return Placement(*pose)


_TURN = (1.0, 0.0, 0.0, 0.0)
_FAR, _DEEP = (100.0, 0.0, 0.0, *_TURN), (0.0, -100.0, 0.0, *_TURN)
_LARGEST = (
    (TOOL, (*_FAR, *_DEEP, 2000.0, 2000.0, 2000.0, 2000.0)),
    (TOOL, (*_DEEP, *_FAR, 1e-6, 0.0, 0.0, 0.0)),
    (WORK_OBJECT, (*_FAR, *_DEEP)),
)
"""Operands at the allowed maximum."""
_WRONG = (
    *((TOOL, at, 101.0) for at in (0, 1, 2, 7, 8, 9)),
    *((TOOL, at, 2.0) for at in (4, 11)),
    *((TOOL, 14, mass) for mass in (0.0, -1.0, 2001.0)),
    *((TOOL, at, value) for at in (15, 16, 17) for value in (-0.1, 2001.0)),
    *((WORK_OBJECT, at, 101.0) for at in (0, 7)),
)
"""Invalid operands: frames too far, quaternions too long, masses, moments."""


@case("program-own-frames", "a program gives a tool and a work object by values")
@generated
def _own(bench: Bench) -> Iterator[Step]:
    """Use own frames only for later poses, never during an earlier move."""
    tools, objects = 1 + len(bench.group.tools), 1 + len(bench.group.work_objects)
    before, after, wobj = _tool(0.05, 2.0), _tool(-0.02, 0.25), _object(0.1)
    given = {TOOL: before, WORK_OBJECT: wobj}
    if bench.motion_group.kinematics is None:
        for kind, values in given.items():
            yield Program([instruction(kind, *values)], No(RawReason.NO_INSTRUCTION))
        return
    for kind, at, value in _WRONG:
        wrong = instruction(kind, *changed(tuple(given[kind]), at, value))
        yield Program([wrong], No(BAD_VALUE), f"{kind.name}: {value} at {at}")
    for kind, largest in _LARGEST:
        yield from (Program([instruction(kind, *largest)]), Pass(0.5))
    first, second, third = orders(bench, 4, random.Random(31))[1:]
    here = replace(joint_move(first, first.zone), joints=bench.position)
    new_tool, new_object = instruction(TOOL, *before), instruction(WORK_OBJECT, *wobj)
    # Values that no program gave; a tool is no work object.
    for own, items in (((tools, 0), []), ((0, objects), []), ((0, objects), [new_tool])):
        yield Program([*items, replace(here, frames=own)], No(NO_FRAME, len(items)))
    if not computes(bench):
        return
    path = [
        replace(
            move,
            kind=MOVE_L,
            zone=0.01,
            frames=(tools, objects),
            pose=_seen(bench, move.joints, _placement(values), _placement(wobj)),
        )
        for move, values in ((first, before), (second, before), (third, after))
    ]
    then = instruction(TOOL, *after)
    yield Program([then, new_object, path[0]], No(POSE_MISMATCH, 2), "a pose of another tool")
    # To where the robot cannot continue on a line.
    yield from (Go([replace(here, joints=first.joints)]), Since())
    yield Program([new_tool, new_object, path[0], path[1], then, path[2]])
    yield from (Moving(), _ToolIs(before), Reached(third.joints), _ToolIs(after))
    yield from (Followed([second.joints, third.joints]), StoodAt(second.joints))
    yield Program([path[2]], No(NO_FRAME), "values of a program that is over")


class _ToolIs:
    """The motion task has the tool of these operands."""

    def __init__(self, values: Sequence[float]) -> None:
        self._values = values

    def play(self, run: Run) -> None:
        """Compare in mm, kg and quaternion parts."""
        bench, values = run.bench, self._values
        tool: Value = bench.controller.task(bench.group.task)["ROS_execution:ROS_own_tool"]
        frame, load = tool.tframe, tool.tload
        moments = load.ix, load.iy, load.iz
        has = (frame.trans.z, frame.rot.q2, load.cog.z, load.aom.q2, load.mass, *moments)
        expected = (1000 * values[2], values[4], 1000 * values[9], values[11], *values[14:])
        if not all(abs(a - b) < 1e-3 for a, b in zip(has, expected, strict=True)):
            raise CheckFailed(f"the tool is {has}, not {expected}")


# -- zones and speeds --------------------------------------------------------------------------


def _nearby(bench: Bench) -> list[RawMove]:
    """Return moves nearby; a case begins at the end of the first one."""
    return orders(bench, 9, random.Random(61))


@case("program-zones", "a move is passed through its zone unless something needs a stop")
@generated
def _zones(bench: Bench) -> Iterator[Step]:
    """Check zones of circles and lines, and stop points before waits and tools."""
    path = _nearby(bench)
    yield Go(path[:1])
    one, two, *others = (replace(joint_move(o, 0.002), frames=(0, 0)) for o in path[1:])
    wait = instruction(RawInstruction.WAIT, 0.1)
    yield Stops([one, two, replace(one, zone=None), two, wait, one], [0, 0, 1, 1, 1])
    if computes(bench) and len(bench.group.joints) >= 6:
        line, circle = to_pose(bench, others[0], MOVE_L), to_pose(bench, others[1], MOVE_C)
        assert line.pose is not None
        assert circle.pose is not None
        circle = replace(circle, via=aside(line.pose, circle.pose))
        yield Stops([two, line, circle, one, two], [0, 0, 0, 0, 1])
    if bench.motion_group.kinematics is not None:
        tool, wobj = 1 + len(bench.group.tools), 1 + len(bench.group.work_objects)
        # An object of its own once, a tool of its own twice.
        own = [replace(one, frames=f) for f in ((0, wobj), (tool, wobj), (tool, wobj))]
        given = instruction(TOOL, *_tool(0.05, 2.0)), instruction(WORK_OBJECT, *_object(0.1))
        yield Stops([*given, one, two, *own, one], [0, 1, 1, 0, 1, 1])
        yield Stops([*given, one, own[1]], [1, 1])
    if computes(bench):
        # The configured frames apply again.
        yield Go([to_pose(bench, path[0], MOVE_J)])


@case("program-speeds", "a slower program is slower in each of its speeds", needs="control")
def _speeds(bench: Bench) -> None:
    """Scale all speeds by the same share: TCP, rotation, external axes."""
    client, control, (first, *path) = Programmer(bench), bench.control(), _nearby(bench)
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    program = [replace(joint_move(o, 0.002), frames=(0, 0)) for o in path[:3]]
    for percent in (100.0, 40.0):
        if percent < 100:
            asks_as_it_begins(bench, control, percent)
        with ordered_moves(bench) as moves:
            client.takes("a program", program)
            bench.wait_until_moving()
            bench.wait_until_at(program[-1].joints, 90)
        for order, move in zip(program, moves, strict=True):
            expected = [percent / 100 * value for value in order.speeds]
            for one, other in zip(astuple(move.speed), expected, strict=True):
                if abs(one - other) > 0.002 * other:
                    raise CheckFailed(
                        f"at SPEED {percent:g} {expected} is wanted, not {move.speed}"
                    )
        bench.run(0.5)


_SLIGHTLY = math.sin(0.0005), math.cos(0.0005)
_DISPLACED: tuple[Pose, ...] = (
    ((5e-5, 0.0, 0.0), IDENTITY[1]),
    (IDENTITY[0], (_SLIGHTLY[1], _SLIGHTLY[0], 0.0, 0.0)),
    (IDENTITY[0], (_SLIGHTLY[1], 0.0, _SLIGHTLY[0], 0.0)),
    (IDENTITY[0], (_SLIGHTLY[1], 0.0, 0.0, _SLIGHTLY[0])),
    IDENTITY,
)
"""0.05 mm, a milliradian about each axis; the last one with an offset of external axes."""


@case("program-displaced-late", "a displacement after the program was accepted")
@generated
def _displaced_late(bench: Bench) -> Iterator[Step]:
    """Displace the program late: the first pose ends it without motion.

    Even a small displacement counts. Joint targets are not affected.
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    start, one, *_ = _nearby(bench)
    modal, over = bench.motion_group.modal, halt_timeout(bench)
    data = data_of(bench.rapid_task("ROS_motion"), bench.motion_group)
    yield Go([start])
    joints = joint_move(one)
    move = to_pose(bench, joints, MOVE_J)
    failed = Ended(POSE_MISMATCH, state=RawTrajectoryState.FAILED)
    for displacement in _DISPLACED:

        def displace(to: Pose = displacement) -> None:
            modal.displacement = to
            if to == IDENTITY:
                data.external_offset = (0.0, 5.0, 0.0, 0.0, 0.0, 0.0)

        # While the motion task prepares the program.
        at_call(bench, "ROS_motion", "ConfJ", 1, displace)
        yield from (Program([move], what=f"displaced by {displacement}"), Rest(over), failed)
        if displacement is _DISPLACED[0]:
            yield from (Go([joints], then=over), Go([replace(joints, joints=start.joints)]))
            yield Pass(over)
        modal.displacement, data.external_offset = IDENTITY, NO_OFFSETS
    yield Go([move], "a pose that is displaced no more", then=over)
    yield Ended(RawReason.NONE, state=RawTrajectoryState.DONE)
