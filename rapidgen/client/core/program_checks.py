"""Validation of a program against a robot, before a byte is sent.

The rules:

1. Instructions are checked in order, each from the position at the end of the one before. A faulty
   move does not change that position, so later findings may follow from it.
2. A joint move needs an end within the limits; its path needs no check. The slowest axis, and the
   programmed speed of the TCP, give its least duration.
3. A line or circle is sampled every `_STEP` m and `_TURN` rad of the TCP, or closer. Each sample is
   solved on the branch of the one before, while external axes move evenly to their end. A sample
   without a solution within the limits is an error.
4. An axis that turns by more than `_JUMP` rad between two samples passes a singularity: a warning
   if the program allows singularities, else an error.
5. The end of a line or circle has the given configuration, unless the program allows others.
6. An axis that cannot follow the programmed speed lengthens the duration; a warning gives the share
   of the speed that remains.
7. The robot stops, in no zone, before an instruction without motion and before another tool or work
   object. A note says so.
8. `program_stationary` checks signals, waits, tools by values and calls.

The result goes onto the wire: each instruction with the joints at its end, by which the driver
repeats the check.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, isfinite, radians

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Posture
from rapidgen.axes.limits import LimitFault, outside
from rapidgen.axes.path_shapes import LARGEST_ARC, Arc, Line, arc_through
from rapidgen.client.core import program_stationary as standing
from rapidgen.client.core.frames import Frames
from rapidgen.client.core.group import Group
from rapidgen.client.core.program_state import ProgramTraversal, operands, unit, within
from rapidgen.client.errors import InvalidProgram
from rapidgen.client.program import (
    Program,
    ProgramStep,
    Speed,
    Zone,
)
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Diagnostic, Severity, Span, error, suggest
from rapidgen.wire.simple_message import instructions
from rapidgen.wire.simple_message.spec import Instruction

_STEP, _TURN = 0.02, 0.1
"""m and rad of the TCP between two samples of a path."""
_JUMP = 0.6
"""rad of an axis between two samples; a larger step is a singularity."""
_FASTEST, _TURNING, _WIDEST = 10.0, radians(10_000), 1.0
"""Limits of the driver: m/s, rad/s, and m or rad."""
_MOVES = frozenset(
    (Instruction.MOVE_ABSJ, Instruction.MOVE_J, Instruction.MOVE_L, Instruction.MOVE_C)
)
_Way = Line | Arc
_LARGEST = LARGEST_ARC - radians(0.5)
"""Limit of arcs, rad.

The driver rejects arcs over 240 degrees, and its points are whole micrometres.
"""


def require_program(value: object) -> None:
    """Raise InvalidProgram for other types."""
    if not isinstance(value, Program):
        help = (
            "`robot.execute(trajectory)` executes a trajectory"
            if isinstance(value, Trajectory)
            else "`Program().move_joints(joints).move_linear(pose)` is one"
        )
        raise InvalidProgram.because(
            "RG670", f"expected a Program, got {type(value).__name__}", help
        )


@dataclass(frozen=True, slots=True)
class CheckedProgram:
    """Data to send: the words of each instruction.

    The first instruction follows the position where the program begins.
    """

    program: Program
    instructions: list[list[int]]
    seconds: list[float]
    """Minimum duration of each instruction, s."""
    postures: list[Posture]
    """Position at the start, and at the end of each instruction."""
    notes: tuple[Diagnostic, ...]
    path: tuple[tuple[int, Posture], ...] = ()
    """Samples of the path, each with its instruction: ends of joint moves, nodes of others."""

    @property
    def goal(self) -> Posture:
        """Position at the end of the program."""
        return self.postures[-1]


def check_program(
    program: Program,
    group: Group,
    *,
    start: Sequence[float],
    most: int,
    spans: Sequence[Span] = (),
) -> CheckedProgram:
    """Check a whole program.

    `start` are the axis values of the current position, `most` is the largest number of
    instructions, `spans` are their places in the file that they were read from. Raises
    InvalidProgram with all faults.
    """
    walk = ProgramTraversal(group, tuple(start[: len(group.names)]), spans)
    postures = [walk.here]
    if not program.steps:
        raise InvalidProgram.because("RG619", "the program has no instructions", "add one")
    if len(program) > most:
        raise InvalidProgram.because(
            "RG617",
            f"{len(program)} instructions, the driver's ring holds {most}",
            "`mode='stream'`: the rest is sent while the robot moves",
        )
    values: list[list[int]] = []
    seconds: list[float] = []
    last: ProgramStep | None = None
    for walk.index, step in enumerate(program.steps):
        if step.speed != (last.speed if last else None):
            _speed(walk, step.speed)
        if step.zone != (last.zone if last else None):
            _zone(walk, step.zone)
        before, walk.chosen = walk.chosen, _frames(walk, step)
        begin = walk.here
        walk.arguments = []
        operands, duration = _MAKERS[step.kind](walk, step)
        postures.append(walk.here)
        marks = standing.marks(walk, step)
        seconds.append(duration)
        if last is not None and not last.zone.stops:
            _stopped(walk, last, step, before != walk.chosen)
        if not _failed(walk):
            chosen = walk.chosen if walk.chosen != before else None
            values.append(_words(step, last, operands, chosen, marks, walk.arguments))
            if not values[1:]:
                values[0] = [*instructions.fixed(begin), *values[0]]
        last = step
    if _failed(walk):
        raise InvalidProgram(walk.found)
    return CheckedProgram(program, values, seconds, postures, tuple(walk.found), tuple(walk.path))


def _failed(walk: ProgramTraversal) -> bool:
    return any(d.severity is Severity.ERROR for d in walk.found)


def _words(
    step: ProgramStep,
    last: ProgramStep | None,
    operands: Sequence[float],
    chosen: tuple[int, int] | None,
    marks: Sequence[Sequence[float]],
    arguments: Sequence[float | bool | str | tuple[float, ...]],
) -> list[int]:
    return instructions.instruction(
        step.kind,
        operands,
        speed=step.speed.words if last is None or last.speed != step.speed else None,
        zone=step.zone.words if last is None or last.zone != step.zone else None,
        frames=chosen,
        signals=marks,
        arguments=arguments,
    )


def _frames(walk: ProgramTraversal, step: ProgramStep) -> tuple[int, int]:
    """Numbers of tool and work object."""
    geometry = walk.group.geometry
    result: list[int] = []
    for what, name, known in (
        ("tool", step.tool, geometry.tools if geometry else ()),
        ("work object", step.work_object, geometry.work_objects if geometry else ()),
    ):
        names = [each for each, _ in known]
        if not isinstance(name, str):
            # An instruction before this one did it; its fault is already reported.
            if walk.own[len(result)] is None:
                return walk.chosen
            result.append(len(names))
            continue
        if name and name not in names:
            walk.say(
                "RG670",
                f"the configuration has no {what} '{name}'",
                suggest(name, names) or f"it has: {', '.join(names) or 'none'}",
            )
            return walk.chosen
        result.append(names.index(name) if name else 0)
    return result[0], result[1]


def _stopped(walk: ProgramTraversal, last: ProgramStep, step: ProgramStep, changed: bool) -> None:
    """Note that the robot stops although a zone was given."""
    why = "another tool or work object is next" if changed else "the next one does not move"
    if last.kind in _MOVES and (changed or step.kind not in _MOVES):
        place = f"instruction {walk.index - 1}: the robot stops there, in no zone: {why}"
        at = walk.spans[walk.index - 1] if walk.spans else None
        walk.found.append(error("RG674", at, place, severity=Severity.INFO))


def _speed(walk: ProgramTraversal, speed: Speed) -> None:
    limits = (_FASTEST, _TURNING, _FASTEST, _TURNING)
    if not all(0 < value <= most for value, most in zip(speed.words, limits, strict=True)):
        walk.say(
            "RG670", f"{speed} is outside the speeds that a robot accepts", "m/s and rad/s, above 0"
        )


def _zone(walk: ProgramTraversal, zone: Zone) -> None:
    if not all(0 <= value <= _WIDEST for value in zone.words[1:]):
        walk.say("RG670", f"{zone} is outside the zones that a robot accepts", "m and rad, 0 to 1")


# -- moves ----------------------------------------------------------------------------------------


def _to_joints(walk: ProgramTraversal, step: ProgramStep) -> standing.Checked:
    group = walk.group
    if len(step.joints) != len(group.names) or not all(map(isfinite, step.joints)):
        walk.say(
            "RG670",
            f"{list(step.joints)} are not joints of this robot",
            f"numbers, rad and m, of {', '.join(group.names)}",
        )
        return (), 0.0
    target = group.map.to_controller(step.joints)
    within(walk, target)
    return target, _go(walk, target, step)


def _joint_move(walk: ProgramTraversal, step: ProgramStep) -> standing.Checked:
    pose, near, robot = _target(walk, step)
    if pose is None or robot is None:
        return (), 0.0
    result = robot.postures(pose, near, step.configuration)
    if not result:
        _unreached(walk, robot, pose, near, step)
        return (), 0.0
    return operands(pose, result[0]), _go(walk, result[0], step)


def _line(walk: ProgramTraversal, step: ProgramStep) -> standing.Checked:
    pose, near, robot = _target(walk, step)
    if pose is None or robot is None:
        return (), 0.0
    way = Line(robot.pose(walk.here), pose)
    seconds = _along(walk, step, robot, way, near)
    return operands(pose, walk.here), seconds


def _circle(walk: ProgramTraversal, step: ProgramStep) -> standing.Checked:
    pose, near, robot = _target(walk, step)
    via = unit(walk, step.via)
    if pose is None or via is None or robot is None:
        return (), 0.0
    way = arc_through(robot.pose(walk.here), via, pose)
    if way is None or way.sweep > _LARGEST:
        walk.say(
            "RG672",
            "the three points make no circle"
            if way is None
            else "the circle is longer than 239.5 degrees: 240 at most, and points are rounded",
            "points 0.1 mm apart and more, the others 1 degree as seen from the first; two circles "
            "for a long one",
        )
        return (), 0.0
    seconds = _along(walk, step, robot, way, near)
    return (*via[0], *via[1], *operands(pose, walk.here)), seconds


_MAKERS: dict[Instruction, Callable[[ProgramTraversal, ProgramStep], standing.Checked]] = {
    Instruction.MOVE_ABSJ: _to_joints,
    Instruction.MOVE_J: _joint_move,
    Instruction.MOVE_L: _line,
    Instruction.MOVE_C: _circle,
    Instruction.WAIT: standing.wait,
    Instruction.WAIT_SIGNAL: standing.wait_signal,
    Instruction.SET: standing.set_signal,
    Instruction.CALL: standing.call,
    Instruction.SETTINGS: standing.settings,
    Instruction.TOOL: standing.own_frame,
    Instruction.WORK_OBJECT: standing.own_frame,
}


def _target(
    walk: ProgramTraversal, step: ProgramStep
) -> tuple[Pose | None, Posture, Frames | None]:
    """Return pose, external axes at the end, and geometry of an instruction."""
    names = walk.group.names
    values = list(walk.group.map.to_urdf(walk.here))
    for name, value in step.external:
        joint = names.index(name) if name in names else -1
        if joint < 0 or not walk.group.joints[joint].axis.startswith("eax") or not isfinite(value):
            outer = [j.name for j in walk.group.joints if j.axis.startswith("eax")]
            walk.say(
                "RG670",
                f"no external axis '{name}' can be at {value}",
                suggest(name, outer) or f"external axes: {', '.join(outer) or 'none'}",
            )
            return None, walk.here, None
        values[joint] = value
    pose = unit(walk, step.pose)
    return pose, walk.group.map.to_controller(values), walk.frames


def _unreached(
    walk: ProgramTraversal, robot: Frames, pose: Pose, near: Posture, step: ProgramStep
) -> None:
    if step.configuration is not None and robot.postures(pose, near):
        others = sorted({robot.kinematics.configuration(p) for p in robot.postures(pose, near)})
        walk.say(
            "RG671",
            f"the pose is not reached with configuration {list(step.configuration)}",
            f"there are {', '.join(str(list(other)) for other in others[:4])}",
        )
    else:
        walk.say(
            "RG671",
            f"the pose is not reached; {robot.why_not(pose, near)}",
            "poses are in m, of the tool in the work object",
        )


def _go(walk: ProgramTraversal, target: Posture, step: ProgramStep) -> float:
    """Move to this position; return the minimum duration in s."""
    pairs = zip(walk.group.joints, walk.here, target, strict=True)
    seconds = max(abs(b - a) / joint.speed for joint, a, b in pairs)
    geometry = walk.geometry
    robot = geometry.frames(*walk.chosen) if geometry is not None else None
    if robot is not None:
        start, end = robot.pose(walk.here), robot.pose(target)
        seconds = max(seconds, frames.distance(start[0], end[0]) / max(step.speed.tcp, 1e-9))
    walk.here = target
    walk.path.append((walk.index, target))
    return seconds


def _along(
    walk: ProgramTraversal, step: ProgramStep, robot: Frames, way: _Way, outer: Posture
) -> float:
    """Follow a TCP path on the current branch; return its least duration in s."""
    speed = step.speed
    seconds = max(way.length / speed.tcp, way.angle / speed.orientation, 1e-4)
    count = max(2, ceil(way.length / _STEP), ceil(way.angle / _TURN))
    begin, nodes = walk.here, [walk.here]
    for number in range(1, count + 1):
        fraction = number / count
        # External axes move evenly to their end; the arm stays on its branch.
        near = tuple(
            a + (b - a) * fraction if joint.axis.startswith("eax") else current
            for joint, a, b, current in zip(walk.group.joints, begin, outer, nodes[-1], strict=True)
        )
        posture = robot.follow((way.position(fraction), way.orientation(fraction)), near)
        beyond = outside(walk.group.joints, posture) if posture is not None else []
        if posture is None or beyond:
            end = way.position(1.0), way.orientation(1.0)
            _left(walk, step, robot, end, outer, fraction, beyond)
            return seconds
        jumps = [
            (abs(b - a), joint)
            for joint, a, b in zip(walk.group.joints, nodes[-1], posture, strict=True)
            if joint.kind == "revolute"
        ]
        most, joint = max(jumps, key=lambda jump: jump[0], default=(0.0, walk.group.joints[0]))
        if most > _JUMP:
            walk.say(
                "RG672",
                f"the path passes a singularity after {fraction:.0%}: {joint.name} would turn "
                f"{most:.2f} rad at once",
                "" if walk.singular else "use another path, joints, or `allow(singularities=True)`",
                severity=Severity.WARNING if walk.singular else Severity.ERROR,
            )
            if not walk.singular:
                return seconds
        nodes.append(posture)
    walk.here = nodes[-1]
    walk.path += ((walk.index, node) for node in nodes[1:])
    if (
        step.configuration is not None
        and not walk.any_posture
        and not robot.kinematics.matches(walk.here, step.configuration)
    ):
        walk.say(
            "RG671",
            f"the path ends in configuration {list(robot.kinematics.configuration(walk.here))}, "
            f"not {list(step.configuration)}",
        )
    return max(seconds, _slowed(walk, nodes, seconds))


def _left(
    walk: ProgramTraversal,
    step: ProgramStep,
    robot: Frames,
    pose: Pose,
    outer: Posture,
    fraction: float,
    beyond: Sequence[LimitFault],
) -> None:
    """Report where a path leaves the reach, or that its end is out of reach."""
    if not robot.postures(pose, outer):
        _unreached(walk, robot, pose, outer, step)
        return
    why = f": {beyond[0]}" if beyond else ""
    walk.say(
        "RG672",
        f"the path leaves the robot's reach after {fraction:.0%}{why}",
        "the robot reaches its end: use another path, or `move_to` with all axes",
    )


def _slowed(walk: ProgramTraversal, nodes: Sequence[Posture], seconds: float) -> float:
    """Return the duration of a path in s; warn if axes limit the speed."""
    spacing = seconds / (len(nodes) - 1)
    slowest = 1.0
    worst = walk.group.joints[0]
    for a, b in pairwise(nodes):
        for joint, from_value, to_value in zip(walk.group.joints, a, b, strict=True):
            factor = abs(to_value - from_value) / (joint.speed * spacing)
            if factor > slowest:
                slowest, worst = factor, joint
    if slowest > 1.0:
        walk.say(
            "RG673",
            f"{worst.name} is too slow for this speed: the robot moves at {1 / slowest:.0%} of it",
            severity=Severity.WARNING,
        )
    return seconds * slowest
