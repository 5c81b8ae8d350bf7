"""Where the moves of a program go, as far as that can be told without running it: the targets and
axes that its modules declare or write out, in the work objects that the moves name."""

from collections.abc import Iterator
from dataclasses import dataclass

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.rapid.binding import (
    DataSymbol,
    ModuleScope,
    NotConstant,
    Scope,
    constant,
    evaluate,
    match,
)
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.binding.symbols import RoutineSymbol
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk


@dataclass(frozen=True, slots=True)
class MoveTarget:
    """What one move goes to: the TCP in the world (m), or axes as RAPID's robax and extax (deg,
    mm)."""

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
    """What the moves of a module go to, in the order of its lines.

    `roughly`: what Offs and RelTool shift by something that cannot be told is where it was.
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
    """What one call goes to; None where it is no move, or its target is not known before."""
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
        return None  # The place is where another robot holds the part, or there is none.
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
    """The initial value of a datum, or what stands there; of `Offs` with constants the place.
    Empty: it cannot be told."""
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
