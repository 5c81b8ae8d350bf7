"""A program against a robot: every fault at once, before a byte is sent.

Each move is followed from where the one before ends. What comes out is what goes onto the wire: the
joints at the end of each instruction, by which the driver checks it once more.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, isfinite, radians, sqrt
from typing import cast

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Posture
from rapidgen.axes.limits import LimitFault, outside
from rapidgen.axes.shapes import LARGEST_ARC, Arc, Line, arc_through
from rapidgen.client.core.frames import Frames
from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidProgram
from rapidgen.client.program import Argument, Program, ProgramStep, Speed, Trigger, Zone, pose_of
from rapidgen.client.trajectory import Trajectory
from rapidgen.config.model import OwnParameter
from rapidgen.diagnostics import Diagnostic, Severity, error, suggest
from rapidgen.wire.simple_message import instructions
from rapidgen.wire.simple_message.spec import FIXED_LIMIT, LONGEST_TEXT, Instruction

_STEP, _TURN = 0.02, 0.1
"""m and rad of the TCP between two looks at a way."""
_JUMP = 0.6
"""rad that an axis turns between two looks, at most: more is a singularity."""
_UNIT = 1e-3
"""A quaternion's length may be off by so much."""
_FASTEST, _TURNING, _WIDEST = 10.0, radians(10_000), 1.0
"""m/s, rad/s and m or rad that the driver takes, at most."""
_LARGEST = 3.4e38
"""Of a RAPID num."""
_LONGEST = 2000.0
"""s of a wait."""
_MOVES = frozenset(
    (Instruction.MOVE_ABSJ, Instruction.MOVE_J, Instruction.MOVE_L, Instruction.MOVE_C)
)
_Way = Line | Arc


def require_program(given: object) -> None:
    """Raise InvalidProgram for anything else."""
    if not isinstance(given, Program):
        mend = (
            "`robot.execute(trajectory)` executes a trajectory"
            if isinstance(given, Trajectory)
            else "`Program().move_joints(joints).move_linear(pose)` is one"
        )
        raise InvalidProgram.because(
            "RG670", f"this takes a Program, and was given {type(given).__name__}", mend
        )


@dataclass(frozen=True, slots=True)
class CheckedProgram:
    """What is sent: the words of each instruction, the first behind where the program begins."""

    program: Program
    instructions: list[list[int]]
    seconds: list[float]
    """Of each instruction, at least."""
    goal: Posture
    notes: tuple[Diagnostic, ...]


class _Walk:
    """The way through a program: where the robot is, and what was found."""

    def __init__(self, group: Group, start: Posture) -> None:
        self.group = group
        self.here = start
        self.index = 0
        self.singular = self.any_posture = False
        """Whether singularities and other configurations are allowed."""
        self.chosen = (0, 0)
        """Numbers of the tool and of the work object."""
        self.found: list[Diagnostic] = []
        self.arguments: list[float | bool | str | tuple[float, ...]] = []
        """Of the routine that is called, as they go onto the wire."""

    def say(
        self, code: str, message: str, mend: str = "", *, severity: Severity = Severity.ERROR
    ) -> None:
        """A finding about the instruction at hand."""
        place = f"instruction {self.index}: "
        self.found.append(error(code, None, place + message, mend, severity=severity))

    @property
    def frames(self) -> Frames | None:
        """The robot's geometry with tool and work object; told where it is missing."""
        geometry = self.group.geometry
        found = geometry.frames(*self.chosen) if geometry is not None else None
        if found is None:
            self.say(
                "RG671",
                "the joints of this pose are not known",
                "connect with a configuration that has the robot's chain, its tool and its work "
                "object",
            )
        return found


def check_program(
    program: Program, group: Group, *, start: Sequence[float], most: int
) -> CheckedProgram:
    """Check everything; `start` are the axis values of where the robot stands, `most` is how many
    instructions there may be.

    Raises InvalidProgram with all faults.
    """
    walk = _Walk(group, tuple(start[: len(group.names)]))
    if not program.steps:
        raise InvalidProgram.because("RG619", "the program has no instructions", "add one")
    if len(program) > most:
        raise InvalidProgram.because(
            "RG617",
            f"{len(program)} instructions, the driver's ring holds {most}",
            "`way='stream'`: the rest is sent while the robot moves",
        )
    words: list[list[int]] = []
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
        marks = [_mark(walk, trigger) for trigger in step.triggers]
        seconds.append(duration)
        if last is not None and not last.zone.stops:
            _stopped(walk, last, step, before != walk.chosen)
        if not _failed(walk):
            chosen = walk.chosen if walk.chosen != before else None
            words.append(_words(step, last, operands, chosen, marks, walk.arguments))
            if not words[1:]:
                words[0] = [*instructions.fixed(begin), *words[0]]
        last = step
    if _failed(walk):
        raise InvalidProgram(walk.found)
    return CheckedProgram(program, words, seconds, walk.here, tuple(walk.found))


def _failed(walk: _Walk) -> bool:
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


def _frames(walk: _Walk, step: ProgramStep) -> tuple[int, int]:
    """Numbers of tool and work object."""
    geometry = walk.group.geometry
    found = []
    for what, name, known in (
        ("tool", step.tool, geometry.tools if geometry else ()),
        ("work object", step.work_object, geometry.work_objects if geometry else ()),
    ):
        names = [each for each, _ in known]
        if name and name not in names:
            walk.say(
                "RG670",
                f"the configuration has no {what} '{name}'",
                suggest(name, names) or f"it has: {', '.join(names) or 'none'}",
            )
            return walk.chosen
        found.append(names.index(name) if name else 0)
    return found[0], found[1]


def _stopped(walk: _Walk, last: ProgramStep, step: ProgramStep, changed: bool) -> None:
    """Say where the robot stops though a zone was given."""
    why = "another tool or work object is next" if changed else "the next one does not move"
    if last.kind in _MOVES and (changed or step.kind not in _MOVES):
        place = f"instruction {walk.index - 1}: the robot stops there, in no zone: {why}"
        walk.found.append(error("RG674", None, place, severity=Severity.INFO))


# -- signals and waits ----------------------------------------------------------------------------


def _signal(walk: _Walk, name: str, value: float, *, sets: bool) -> int:
    """The number of a signal; told where it cannot be set or have this value."""
    signals = walk.group.signals
    names = [signal.name for signal in signals]
    if name not in names:
        walk.say(
            "RG670",
            f"the configuration exposes no signal '{name}'",
            suggest(name, names) or f"it exposes: {', '.join(names) or 'none'}",
        )
        return 0
    signal = signals[names.index(name)]
    if sets and signal.access != "write":
        walk.say("RG670", f"signal '{name}' is exposed for reading only", "`access: write`")
    digital = signal.kind[0] == "D" and value not in (0, 1)
    group = signal.kind[0] == "G" and not (value >= 0 and value == int(value))
    if digital or group or not abs(value) <= FIXED_LIMIT:
        walk.say("RG670", f"signal '{name}' ({signal.kind}) cannot be {value:g}")
    if not sets and signal.kind[0] == "A":
        walk.say("RG670", f"signal '{name}' is analogue: nobody waits for a value of it")
    return names.index(name)


def _mark(walk: _Walk, trigger: Trigger) -> tuple[float, ...]:
    """The words of a signal on the way."""
    number = _signal(walk, trigger.signal, trigger.value, sets=True)
    if not (isfinite(trigger.place) and 0 <= trigger.place <= _WIDEST * 10):
        walk.say("RG670", f"signal '{trigger.signal}' at {trigger.place:g}", "m or s, 0 to 10")
    return number, trigger.value, trigger.kind, trigger.place


def _wait(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    return (_seconds(walk, step),), step.seconds


def _wait_signal(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    number = _signal(walk, step.signal, step.value, sets=False)
    return (number, step.value, _seconds(walk, step)), step.seconds


def _settings(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    walk.singular, walk.any_posture = bool(int(step.value) & 1), bool(int(step.value) & 2)
    return (step.value,), 0.0


def _set(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    return (_signal(walk, step.signal, step.value, sets=True), step.value), 0.0


def _call(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    names = [routine.name for routine in walk.group.routines]
    if step.routine not in names:
        walk.say(
            "RG670",
            f"the configuration has no routine '{step.routine}'",
            suggest(step.routine, names) or f"it has: {', '.join(names) or 'none'}",
        )
        return (), 0.0
    number = names.index(step.routine)
    wanted = walk.group.routines[number].parameters
    if len(wanted) != len(step.arguments):
        given = f"{len(step.arguments)} of {len(wanted)} parameters"
        walk.say("RG670", f"routine '{step.routine}' is called with {given}")
    walk.arguments = [
        _of_routine(walk, step, parameter, value)
        for parameter, value in zip(wanted, step.arguments, strict=False)
    ]
    return (number, _seconds(walk, step)), 0.0


def _of_routine(
    walk: _Walk, step: ProgramStep, parameter: OwnParameter, value: Argument
) -> float | bool | str | tuple[float, ...]:
    """An argument as it goes onto the wire: of a target its operands."""
    joints = _joints_of(walk, value) if parameter.type == "jointtarget" else None
    if joints is not None:
        _within(walk, joints)
        return joints
    if parameter.type == "robtarget" and isinstance(value, Sequence) and len(value) == 2:
        return _reached(walk, parameter, value)
    if not isinstance(value, float | int | str) or not fits(parameter.type, value):
        walk.say(
            "RG670",
            f"{parameter.name} of '{step.routine}' is a {parameter.type}, not {value!r}",
            "a finite number, True or False, a text of at most 80 characters, a pose, or joints",
        )
        return 0.0
    return value


def _joints_of(walk: _Walk, value: Argument) -> Posture | None:
    """Axis values of what are joints of this robot."""
    if isinstance(value, Sequence) and len(value) == len(walk.group.names):
        joints = [v for v in value if isinstance(v, float | int) and isfinite(v)]
        return walk.group.map.to_controller(joints) if len(joints) == len(value) else None
    return None


def _reached(walk: _Walk, parameter: OwnParameter, value: Argument) -> tuple[float, ...] | float:
    """A pose with the joints that reach it, nearest to where the robot is."""
    try:
        pose = _unit(walk, pose_of(cast("Pose", value)))
    except InvalidProgram as error:
        walk.say("RG670", f"{parameter.name}: {error}")
        return 0.0
    robot = walk.frames
    if pose is None or robot is None:
        return 0.0
    found = robot.postures(pose, walk.here)
    if not found:
        walk.say("RG671", f"{parameter.name} is not reached; {robot.why_not(pose, walk.here)}")
        return 0.0
    return _operands(pose, found[0])


def fits(kind: str, value: float | bool | str) -> bool:
    """Whether a value is one of a RAPID type: num, bool or string."""
    if kind == "string":
        return (
            isinstance(value, str)
            and len(value) <= LONGEST_TEXT
            and value.isprintable()
            and (max(map(ord, value), default=0) < 256)
        )
    if kind == "bool":
        return isinstance(value, bool)
    if kind != "num" or isinstance(value, bool | str):
        return False
    return abs(value) <= _LARGEST


def _seconds(walk: _Walk, step: ProgramStep) -> float:
    if not 0 <= step.seconds <= _LONGEST:
        walk.say("RG670", f"a wait of {step.seconds:g} s", f"0 to {_LONGEST:g} s")
        return 0.0
    return step.seconds


def _speed(walk: _Walk, speed: Speed) -> None:
    limits = (_FASTEST, _TURNING, _FASTEST, _TURNING)
    if not all(0 < value <= most for value, most in zip(speed.words, limits, strict=True)):
        walk.say("RG670", f"{speed} is outside what a robot is asked", "m/s and rad/s, above 0")


def _zone(walk: _Walk, zone: Zone) -> None:
    if not all(0 <= value <= _WIDEST for value in zone.words[1:]):
        walk.say("RG670", f"{zone} is outside what a robot is asked", "m and rad, 0 to 1")


# -- moves ----------------------------------------------------------------------------------------


def _to_joints(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    group = walk.group
    if len(step.joints) != len(group.names) or not all(map(isfinite, step.joints)):
        walk.say(
            "RG670",
            f"{list(step.joints)} are no joints of this robot",
            f"numbers, rad and m, of {', '.join(group.names)}",
        )
        return (), 0.0
    target = group.map.to_controller(step.joints)
    _within(walk, target)
    return target, _go(walk, target, step)


def _joint_move(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    pose, near, robot = _target(walk, step)
    if pose is None or robot is None:
        return (), 0.0
    found = robot.postures(pose, near, step.configuration)
    if not found:
        _unreached(walk, robot, pose, near, step)
        return (), 0.0
    return _operands(pose, found[0]), _go(walk, found[0], step)


def _line(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    pose, near, robot = _target(walk, step)
    if pose is None or robot is None:
        return (), 0.0
    way = Line(robot.pose(walk.here), pose)
    seconds = _along(walk, step, robot, way, near)
    return _operands(pose, walk.here), seconds


def _circle(walk: _Walk, step: ProgramStep) -> tuple[Sequence[float], float]:
    pose, near, robot = _target(walk, step)
    via = _unit(walk, step.via)
    if pose is None or via is None or robot is None:
        return (), 0.0
    way = arc_through(robot.pose(walk.here), via, pose)
    if way is None or way.sweep > LARGEST_ARC:
        walk.say(
            "RG672",
            "the three points make no circle"
            if way is None
            else "the circle is longer than 240 degrees",
            "points at least 0.1 mm apart and not in a line; two circles for a long one",
        )
        return (), 0.0
    seconds = _along(walk, step, robot, way, near)
    return (*via[0], *via[1], *_operands(pose, walk.here)), seconds


_MAKERS: dict[Instruction, Callable[[_Walk, ProgramStep], tuple[Sequence[float], float]]] = {
    Instruction.MOVE_ABSJ: _to_joints,
    Instruction.MOVE_J: _joint_move,
    Instruction.MOVE_L: _line,
    Instruction.MOVE_C: _circle,
    Instruction.WAIT: _wait,
    Instruction.WAIT_SIGNAL: _wait_signal,
    Instruction.SET: _set,
    Instruction.CALL: _call,
    Instruction.SETTINGS: _settings,
}


def _operands(pose: Pose, posture: Posture) -> tuple[float, ...]:
    return (*pose[0], *pose[1], *posture)


def _target(walk: _Walk, step: ProgramStep) -> tuple[Pose | None, Posture, Frames | None]:
    """The pose of an instruction, where the external axes are at its end, and the geometry."""
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
    pose = _unit(walk, step.pose)
    return pose, walk.group.map.to_controller(values), walk.frames


def _unit(walk: _Walk, pose: Pose | None) -> Pose | None:
    """A pose with a quaternion of length 1."""
    if pose is None or not all(isfinite(value) for part in pose for value in part):
        walk.say("RG670", f"{pose} is no pose", "finite numbers")
        return None
    size = sqrt(sum(value * value for value in pose[1]))
    if abs(size - 1) > _UNIT:
        walk.say(
            "RG670",
            f"the quaternion {pose[1]} has the length {size:.4g}",
            "unit quaternions, the scalar first (w, x, y, z)",
        )
        return None
    return pose[0], frames.normalise(pose[1])


def _unreached(walk: _Walk, robot: Frames, pose: Pose, near: Posture, step: ProgramStep) -> None:
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


def _within(walk: _Walk, posture: Posture) -> bool:
    faults: list[LimitFault] = outside(walk.group.joints, posture)
    for fault in faults[:1]:
        walk.say("RG614", str(fault))
    return not faults


def _go(walk: _Walk, target: Posture, step: ProgramStep) -> float:
    """Be there; seconds that it takes, at least."""
    pairs = zip(walk.group.joints, walk.here, target, strict=True)
    seconds = max(abs(b - a) / joint.speed for joint, a, b in pairs)
    geometry = walk.group.geometry
    robot = geometry.frames(*walk.chosen) if geometry is not None else None
    if robot is not None:
        start, end = robot.pose(walk.here), robot.pose(target)
        seconds = max(seconds, frames.distance(start[0], end[0]) / max(step.speed.tcp, 1e-9))
    walk.here = target
    return seconds


def _along(walk: _Walk, step: ProgramStep, robot: Frames, way: _Way, outer: Posture) -> float:
    """Follow a way of the TCP on the branch where the robot is; seconds that it takes, at least."""
    speed = step.speed
    seconds = max(way.length / speed.tcp, way.angle / speed.orientation, 1e-4)
    count = max(2, ceil(way.length / _STEP), ceil(way.angle / _TURN))
    begin, nodes = walk.here, [walk.here]
    for number in range(1, count + 1):
        share = number / count
        near = tuple(
            a + (b - a) * share if joint.axis.startswith("eax") else here
            for joint, a, b, here in zip(walk.group.joints, begin, outer, nodes[-1], strict=True)
        )
        posture = robot.follow((way.position(share), way.orientation(share)), near)
        if posture is None:
            walk.say("RG672", f"the way leaves the robot's reach after {share:.0%}")
            return seconds
        if not _within(walk, posture):
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
                f"the way passes a singularity after {share:.0%}: {joint.name} would turn "
                f"{most:.2f} rad at once",
                "" if walk.singular else "another way, joints, or `allow(singularities=True)`",
                severity=Severity.WARNING if walk.singular else Severity.ERROR,
            )
            if not walk.singular:
                return seconds
        nodes.append(posture)
    walk.here = nodes[-1]
    if (
        step.configuration is not None
        and not walk.any_posture
        and not robot.kinematics.matches(walk.here, step.configuration)
    ):
        walk.say(
            "RG671",
            f"the way ends in configuration {list(robot.kinematics.configuration(walk.here))}, "
            f"not {list(step.configuration)}",
        )
    return max(seconds, _slowed(walk, nodes, seconds))


def _slowed(walk: _Walk, nodes: Sequence[Posture], seconds: float) -> float:
    """s that the axes need for a way; told when they need more than was asked."""
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
            f"{worst.name} is too slow for this speed: the robot goes at {1 / slowest:.0%} of it",
            severity=Severity.WARNING,
        )
    return seconds * slowest
