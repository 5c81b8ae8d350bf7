"""Robot of a foreign program."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.axes import frames
from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.config import shipped_names
from rapidgen.config.model import GroupConfig
from rapidgen.config.model_cache import shipped_groups
from rapidgen.config.variant_group import group_of
from rapidgen.config.variant_library import variants
from rapidgen.rapid import Dialect
from rapidgen.rapid.binding import (
    DataSymbol,
    ModuleScope,
    NotConstant,
    Scope,
    TaskScope,
    constant,
    evaluate,
    match,
)
from rapidgen.rapid.binding.names import RoutineSymbol, called
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.module_trees import tree_of
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system.model import System

# -- Move targets ----------------------------------------------------------------------------------
#
# Targets of a program's moves, as far as known before execution: declared or literal targets and
# axes, in the work objects of the moves.


@dataclass(frozen=True, slots=True)
class MoveTarget:
    """Target of a move: the TCP in the world (m), or axes.

    Axes are RAPID's robax and extax (deg, mm).
    """

    name: str
    """Of the datum; empty for what is written out."""
    line: int
    tool: Pose
    """The TCP in the flange."""
    place: Pose | None = None
    configuration: AxisConfiguration = (0, 0, 0, 0)
    external: tuple[float, ...] = ()
    axes: tuple[float, ...] = ()


def move_targets(module: ModuleScope, *, roughly: bool = False) -> Iterator[MoveTarget]:
    """Iterate over targets of a module's moves, in the order of lines.

    `roughly`: an unknown shift of Offs or RelTool is ignored.
    """
    for routine in module.tree.routines:
        scope = module.routine(routine)
        for node in walk(routine):
            symbol = called(scope.find(node.name)) if isinstance(node, n.ProcedureCall) else None
            if isinstance(node, n.ProcedureCall) and isinstance(symbol, RoutineSymbol):
                line = module.tree.source.line(node.first)
                result = _meant(node, symbol, scope, line, roughly)
                if result is not None:
                    yield result


def _meant(
    node: n.ProcedureCall, symbol: RoutineSymbol, scope: Scope, line: int, roughly: bool
) -> MoveTarget | None:
    """Return the target of a call.

    None: not a move, or a target that is unknown before execution.
    """
    parameters = symbol.parameters or ()
    names = [p.name.lower() for p in parameters]
    if symbol.module is not None or not {"topoint", "tojointpos"} & {*names}:
        return None
    given = {
        names[pair.parameter]: pair.argument.value
        for pair in match(parameters, node.arguments, lambda _, ways: ways[0]).pairs
        if pair.parameter >= 0
    }
    tool = _declared(given.get("tool"), scope, "tooldata")
    carried = _frame(tool[1]) if tool else frames.IDENTITY
    point = given.get("topoint") or given.get("tojointpos")
    name = point.name if isinstance(point, n.Name) else ""
    target = _declared(given.get("topoint"), scope, "robtarget", roughly)
    if not target:
        axes = _declared(given.get("tojointpos"), scope, "jointtarget")
        if not axes:
            return None
        return MoveTarget(name, line, carried, external=_numbers(axes[1]), axes=_numbers(axes[0]))
    wobj = _declared(given.get("wobj"), scope, "wobjdata")
    held = (tool and not tool[0]) or (wobj and wobj[0])
    if held or not any(_numbers(target[1])):
        return None  # Another robot holds the part, or the position is unknown.
    pose = _pose(*target[:2])
    if wobj:
        pose = frames.compose(frames.compose(_frame(wobj[3]), _frame(wobj[4])), pose)
    cf1, cf4, cf6, cfx = map(int, _numbers(target[2]))
    return MoveTarget(name, line, carried, pose, (cf1, cf4, cf6, cfx), _numbers(target[3]))


def _numbers(value: Value) -> tuple[float, ...]:
    parts = value if isinstance(value, tuple) else ()
    return tuple(part for part in parts if isinstance(part, int | float))


def _frame(value: Value) -> Pose:
    place, turn = value if isinstance(value, tuple) else ((), ())
    return _pose(place, turn)


def _pose(place: Value, turn: Value) -> Pose:
    x, y, z = (value / 1000 for value in _numbers(place))
    w, i, j, k = _numbers(turn)
    turned = (w, i, j, k) if any((w, i, j, k)) else (1.0, 0.0, 0.0, 0.0)
    return (x, y, z), frames.normalise(turned)


def _declared(
    node: n.Expression | None, scope: Scope, kind: str, roughly: bool = False
) -> tuple[Value, ...]:
    """Return the initial value of a datum, or a literal.

    `Offs` with constants is evaluated. Empty: unknown.
    """
    if isinstance(node, n.FunctionCall) and node.name.lower() in ("offs", "reltool"):
        first, *remaining = (argument.value for argument in node.arguments)
        base = _declared(first, scope, kind, roughly)
        offsets = [constant(v, scope) for v in remaining if v is not None]
        report = node.name.lower() == "offs" and all(isinstance(v, int | float) for v in offsets)
        if not base or not report:
            return base if roughly else ()
        places = zip(_numbers(base[0]), _numbers(tuple(v or 0 for v in offsets)), strict=True)
        return (tuple(a + b for a, b in places), *base[1:])
    symbol = scope.find(node.name) if isinstance(node, n.Name) else None
    result: Value = ()
    try:
        if isinstance(symbol, DataSymbol) and symbol.initial is not None:
            inside = symbol.module if symbol.routine is None and symbol.module else scope
            result = evaluate(symbol.initial, inside, kind)
        elif isinstance(node, n.Aggregate):
            result = evaluate(node, scope, kind)
    except NotConstant:
        return ()
    return result if isinstance(result, tuple) else ()


# -- Robot model -----------------------------------------------------------------------------------
#
# The robot that a program without a controller seems to be written for: that which reaches its
# targets, in the configurations that they name and with the tools and work objects that it
# declares.


_MOST: Final = 24
"""Targets that are tried."""
_UNUSED: Final = 8e9
_ARM: Final = 0.9
"""m that an arm of seven axes reaches; a value of eax_a farther out is of an external axis."""
_SEVEN_AXES: Final = "irb14000"
_ORIGIN: Final = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class FlangeTarget:
    """A required flange pose (m) with a configuration; or axes.

    Axes are RAPID's robax and extax (deg, mm).
    """

    flange: Pose | None
    configuration: AxisConfiguration = (0, 0, 0, 0)
    arm_angle: float | None = None
    """Possible arm angle in eax_a of a seven-axis arm; None: not one."""
    axes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class RobotCandidate:
    """A model, and the number of targets that it reaches."""

    model: str
    reached: int
    targets: int


def infer_robot_model(system: System, default: str) -> RobotCandidate | None:
    """Return the first model that reaches most targets of `system`.

    Candidates are `default`, the shipped models and known variants. None: the programs have no
    known target.
    """
    result = list(dict.fromkeys(aims(system)))
    tried = result[:: 1 + len(result) // _MOST]
    if not tried:
        return None
    # Programs of other tools set axes that a robot does not have to 0.
    if all(aim.arm_angle is not None for aim in tried) and any(aim.arm_angle for aim in tried):
        return RobotCandidate(_SEVEN_AXES, len(tried), len(tried))
    best: RobotCandidate | None = None
    for name, group in _candidates(default):
        reached = _reached(group, tried)
        if best is None or reached > best.reached:
            best = RobotCandidate(name, reached, len(tried))
        if reached == len(tried):
            break
    return best


def _candidates(default: str) -> Iterator[tuple[str, GroupConfig]]:
    for name in dict.fromkeys((default, *shipped_names())):
        if name != _SEVEN_AXES:
            yield name, shipped_groups(name)[0]
    for variant in variants():
        group = None if variant.model else group_of(variant)
        if group is not None:
            yield variant.name, group


def _reached(group: GroupConfig, tried: Sequence[FlangeTarget]) -> int:
    kinematics = Kinematics.of(group)
    if kinematics is None or not kinematics.is_closed_form:
        return 0
    near = usual_start(group)
    return sum(1 for aim in tried if _reaches(group, kinematics, aim, near))


def _reaches(
    group: GroupConfig, kinematics: Kinematics, aim: FlangeTarget, near: tuple[float, ...]
) -> bool:
    if aim.flange is not None:
        result = kinematics.solutions(aim.flange, near, aim.configuration)
        return kinematics.fitting(result, aim.configuration, "turn") is not None
    # Additional axes are ignored: they keep their position.
    expected = JointMap.of(group).from_rapid(aim.axes, (ABSENT,) * 6, near)
    return all(
        joint.lower - 1e-6 <= value <= joint.upper + 1e-6
        for joint, value in zip(group.joints, expected, strict=True)
        if joint.axis.startswith("rax")
    )


def aims(system: System) -> Iterator[FlangeTarget]:
    """Iterate over flange targets of all tasks, known before execution."""
    for spec in system.tasks:
        task = TaskScope()
        dialect = Dialect(system.robotware, some=not system.is_robotware_known)
        scopes = [task.add(tree_of(f, dialect)) for f in spec.modules]
        for scope in scopes:
            yield from map(_aim, move_targets(scope, roughly=True))


def _aim(result: MoveTarget) -> FlangeTarget:
    if result.place is None:
        return FlangeTarget(None, axes=result.axes)
    flange = frames.compose(result.place, frames.invert(result.tool))
    eax_a = result.external[0]
    near = abs(eax_a) < _UNUSED and frames.distance(result.place[0], _ORIGIN) < _ARM
    return FlangeTarget(flange, result.configuration, eax_a if near else None)
