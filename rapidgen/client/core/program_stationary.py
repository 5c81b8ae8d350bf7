"""Validation of instructions for a robot at rest.

Signals, waits, tools by values and routines.
"""

from collections.abc import Sequence
from math import isfinite
from typing import cast

from rapidgen.axes.kinematics import Posture
from rapidgen.client.core.program_state import ProgramTraversal, operands, unit, within
from rapidgen.client.core.user_frames import own_tool, own_work_object
from rapidgen.client.errors import InvalidProgram
from rapidgen.client.pose import pose_of
from rapidgen.client.program import (
    Argument,
    ProgramStep,
    Trigger,
    UserTool,
    UserWorkObject,
)
from rapidgen.config.model import RoutineParameter
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message.spec import FIXED_LIMIT, LONGEST_TEXT, Instruction

_FARTHEST = 10.0
"""Limit of a trigger's place, m or s."""
_LARGEST = 3.4e38
"""Largest value of a RAPID num."""
_LONGEST = 2000.0
"""Limit of a wait, s."""
Checked = tuple[Sequence[float], float]
"""Operands of an instruction, and its minimum duration in s."""


def _signal(walk: ProgramTraversal, name: str, value: float, *, sets: bool) -> int:
    """Return the number of a signal; report wrong access or value."""
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
        walk.say("RG670", f"signal '{name}' is analogue: waiting for its value is not supported")
    return names.index(name)


def marks(walk: ProgramTraversal, step: ProgramStep) -> list[tuple[float, ...]]:
    """Return the words of the signals on a path."""
    by_joints = step.kind in (Instruction.MOVE_ABSJ, Instruction.MOVE_J)
    if step.triggers and by_joints and walk.group.map.two_sided:
        walk.say(
            "RG670",
            "a SCARA sets no signals on the path of a joint move: their instruction takes a pose, "
            "whose configuration does not say on which side of it the arm is",
            "`move_linear`, or `set` after the move",
        )
    return [_mark(walk, trigger) for trigger in step.triggers]


def _mark(walk: ProgramTraversal, trigger: Trigger) -> tuple[float, ...]:
    """Return the words of a signal on a path."""
    number = _signal(walk, trigger.signal, trigger.value, sets=True)
    if not (isfinite(trigger.place) and 0 <= trigger.place <= _FARTHEST):
        walk.say("RG670", f"signal '{trigger.signal}' at {trigger.place:g}", "m or s, 0 to 10")
    return number, trigger.value, trigger.kind, trigger.place


def wait(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    return (_seconds(walk, step),), step.seconds


def wait_signal(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    number = _signal(walk, step.signal, step.value, sets=False)
    return (number, step.value, _seconds(walk, step)), step.seconds


def settings(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    walk.singular, walk.any_posture = bool(int(step.value) & 1), bool(int(step.value) & 2)
    return (step.value,), 0.0


def own_frame(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    geometry, own = walk.group.geometry, step.own
    if geometry is None:
        walk.say(
            "RG671",
            "poses of this robot are unknown, and a tool or work object needs them",
            "connect with a configuration that has the robot's chain",
        )
        return (), 0.0
    try:
        if isinstance(own, UserTool):
            values, pose = own_tool(own)
            walk.own = pose, walk.own[1]
        else:
            values, pose = own_work_object(cast("UserWorkObject", own))
            walk.own = walk.own[0], pose
    except (ValueError, TypeError, InvalidProgram) as wrong:
        walk.say("RG670", str(wrong))
        return (), 0.0
    walk.geometry = geometry.owning(*walk.own)
    return values, 0.0


def set_signal(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    return (_signal(walk, step.signal, step.value, sets=True), step.value), 0.0


def call(walk: ProgramTraversal, step: ProgramStep) -> Checked:
    names = [routine.name for routine in walk.group.routines]
    if step.routine not in names:
        walk.say(
            "RG670",
            f"the configuration has no routine '{step.routine}'",
            suggest(step.routine, names) or f"it has: {', '.join(names) or 'none'}",
        )
        return (), 0.0
    number = names.index(step.routine)
    expected = walk.group.routines[number].parameters
    if len(expected) != len(step.arguments):
        given = f"{len(step.arguments)} of {len(expected)} parameters"
        walk.say("RG670", f"routine '{step.routine}' is called with {given}")
    walk.arguments = [
        _of_routine(walk, step, parameter, value)
        for parameter, value in zip(expected, step.arguments, strict=False)
    ]
    return (number, _seconds(walk, step)), 0.0


def _of_routine(
    walk: ProgramTraversal, step: ProgramStep, parameter: RoutineParameter, value: Argument
) -> float | bool | str | tuple[float, ...]:
    """Return an argument as it goes onto the wire; a target as its operands."""
    joints = _joints_of(walk, value) if parameter.type == "jointtarget" else None
    if joints is not None:
        within(walk, joints)
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


def _joints_of(walk: ProgramTraversal, value: Argument) -> Posture | None:
    """Return axis values of this robot's joints."""
    if isinstance(value, Sequence) and len(value) == len(walk.group.names):
        joints = [v for v in value if isinstance(v, float | int) and isfinite(v)]
        return walk.group.map.to_controller(joints) if len(joints) == len(value) else None
    return None


def _reached(
    walk: ProgramTraversal, parameter: RoutineParameter, value: Argument
) -> tuple[float, ...] | float:
    """Return a pose with the joints that reach it, nearest to the position."""
    try:
        pose = unit(walk, pose_of(value))
    except InvalidProgram as error:
        walk.say("RG670", f"{parameter.name}: {error.diagnostics[0].message}")
        return 0.0
    robot = walk.frames
    if pose is None or robot is None:
        return 0.0
    result = robot.postures(pose, walk.here)
    if not result:
        walk.say("RG671", f"{parameter.name} is not reached; {robot.why_not(pose, walk.here)}")
        return 0.0
    return operands(pose, result[0])


def fits(kind: str, value: float | bool | str) -> bool:
    """True if a value has a RAPID type: num, bool or string."""
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


def _seconds(walk: ProgramTraversal, step: ProgramStep) -> float:
    if not 0 <= step.seconds <= _LONGEST:
        walk.say("RG670", f"a wait of {step.seconds:g} s", f"0 to {_LONGEST:g} s")
        return 0.0
    return step.seconds
