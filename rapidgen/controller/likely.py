"""The robot that a program without a controller seems to be written for: that which reaches its
targets, in the configurations that they name and with the tools and work objects that it declares.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config import shipped_names
from rapidgen.config.compiled import shipped_groups
from rapidgen.config.library import variants
from rapidgen.config.model import GroupConfig
from rapidgen.config.of_variant import group_of
from rapidgen.controller.starts import usual_start
from rapidgen.rapid import Dialect, parse
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
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.binding.symbols import RoutineSymbol
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system.model import System

_MOST: Final = 24
"""Targets that are tried."""
_UNUSED: Final = 8e9
_ARM: Final = 0.9
"""m that an arm of seven axes reaches; a value of eax_a farther out is of an external axis."""
_SEVEN_AXES: Final = "irb14000"
_ORIGIN: Final = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Aim:
    """Where a program wants the flange (m), in what configuration; or its axes, as RAPID's
    robax (deg, mm)."""

    flange: Pose | None
    configuration: AxisConfiguration = (0, 0, 0, 0)
    seventh: bool = False
    axes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Likely:
    """A model, and how many of the targets it reaches."""

    model: str
    reached: int
    targets: int


def likely(system: System, default: str) -> Likely | None:
    """The first model that reaches most of what the programs of `system` aim at: `default`, the
    shipped ones, known variants. None: they aim at nothing that can be told."""
    found = list(dict.fromkeys(aims(system)))
    tried = found[:: 1 + len(found) // _MOST]
    if not tried:
        return None
    if all(aim.seventh for aim in tried):
        return Likely(_SEVEN_AXES, len(tried), len(tried))
    best: Likely | None = None
    for name, group in _candidates(default):
        reached = _reached(group, tried)
        if best is None or reached > best.reached:
            best = Likely(name, reached, len(tried))
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


def _reached(group: GroupConfig, tried: Sequence[Aim]) -> int:
    kinematics = Kinematics.of(group)
    if kinematics is None or not kinematics.is_closed_form:
        return 0
    near = usual_start(group)
    return sum(1 for aim in tried if _reaches(group, kinematics, aim, near))


def _reaches(group: GroupConfig, kinematics: Kinematics, aim: Aim, near: tuple[float, ...]) -> bool:
    if aim.flange is not None:
        found = kinematics.solutions(aim.flange, near)
        return kinematics.fitting(found, aim.configuration, "turn") is not None
    wanted = JointMap.of(group).from_rapid(aim.axes, ())
    return all(
        joint.lower - 1e-6 <= value <= joint.upper + 1e-6
        for joint, value in zip(group.joints, wanted, strict=False)
        if joint.axis.startswith("rax")
    )


def aims(system: System) -> Iterator[Aim]:
    """What the moves of all tasks aim at, where that can be told without running them."""
    for spec in system.tasks:
        task = TaskScope()
        dialect = Dialect(system.robotware)
        scopes = [task.add(parse(f.data, path=f.path, dialect=dialect)) for f in spec.modules]
        for scope in scopes:
            yield from _of_module(scope)


def _of_module(module: ModuleScope) -> Iterator[Aim]:
    for routine in module.tree.routines:
        scope = module.routine(routine)
        for node in walk(routine):
            symbol = called(scope.find(node.name)) if isinstance(node, n.ProcedureCall) else None
            if isinstance(node, n.ProcedureCall) and isinstance(symbol, RoutineSymbol):
                aim = _aim(node, symbol, scope)
                if aim is not None:
                    yield aim


def _aim(node: n.ProcedureCall, symbol: RoutineSymbol, scope: Scope) -> Aim | None:
    """What one call aims at; None where it is no move, or its target is not known before."""
    parameters = symbol.parameters or ()
    if symbol.module is not None or "topoint" not in (p.name.lower() for p in parameters):
        return None
    given = {
        parameters[pair.parameter].name.lower(): pair.argument.value
        for pair in match(parameters, node.arguments, lambda _, ways: ways[0]).pairs
        if pair.parameter >= 0
    }
    target = _declared(given.get("topoint"), scope, "robtarget")
    if not target:
        axes = _declared(given.get("tojointpos"), scope, "jointtarget")
        return Aim(None, axes=_numbers(axes[0])) if axes else None
    tool = _declared(given.get("tool"), scope, "tooldata")
    wobj = _declared(given.get("wobj"), scope, "wobjdata")
    held = (tool and not tool[0]) or (wobj and wobj[0])
    if held or not any(_numbers(target[1])):
        return None  # The place is where another robot holds the part, or there is none.
    pose = _pose(*target[:2])
    if wobj:
        pose = frames.compose(frames.compose(_frame(wobj[3]), _frame(wobj[4])), pose)
    if tool:
        pose = frames.compose(pose, frames.invert(_frame(tool[1])))
    cf1, cf4, cf6, cfx = map(int, _numbers(target[2]))
    seventh = abs(_numbers(target[3])[0]) < _UNUSED and frames.distance(pose[0], _ORIGIN) < _ARM
    return Aim(pose, (cf1, cf4, cf6, cfx), seventh)


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


def _declared(node: n.Expression | None, scope: Scope, kind: str) -> tuple[Value, ...]:
    """The initial value of a datum, or what stands there; of `Offs` with constants the place.
    Empty: it cannot be told."""
    if isinstance(node, n.FunctionCall) and node.name.lower() == "offs":
        first, *rest = (argument.value for argument in node.arguments)
        base = _declared(first, scope, kind)
        offsets = [constant(v, scope) for v in rest if v is not None]
        if not base or not all(isinstance(v, int | float) for v in offsets):
            return ()
        places = zip(_numbers(base[0]), _numbers(tuple(v or 0 for v in offsets)), strict=True)
        return (tuple(a + b for a, b in places), *base[1:])
    symbol = scope.find(node.name) if isinstance(node, n.Name) else None
    found: Value = ()
    try:
        if isinstance(symbol, DataSymbol) and symbol.initial is not None:
            inside = symbol.module if symbol.routine is None and symbol.module else scope
            found = evaluate(symbol.initial, inside, kind)
        elif isinstance(node, n.Aggregate):
            found = evaluate(node, scope, kind)
    except NotConstant:
        return ()
    return found if isinstance(found, tuple) else ()
