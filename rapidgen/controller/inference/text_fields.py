"""Texts of a made-up partner: fields in the order in which a routine cuts them out of what it has
received.

`StrToVal(StrPart(said, 1, at - 1), x)` is a number; what it is compared with tells which one, and
what a piece of text is compared with, its words. A field at a fixed place stands there.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.controller.inference.binary_messages import last
from rapidgen.rapid.binding import RoutineScope, Scope, constant
from rapidgen.rapid.binding.expressions import declared_type
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk

_BOUNDS: Final = frozenset(("<", ">", "<=", ">="))
_LONGEST: Final = 80


@dataclass(frozen=True, slots=True)
class TextField:
    """A piece of a text: what it may be, and where it stands (from 0; -1: behind the last one) with
    how many characters (0: as many as it has)."""

    values: tuple[str, ...]
    place: int = -1
    length: int = 0


def texts(layout: Sequence[TextField], marker: str) -> Iterator[str]:
    """With the first value of each field, then with the others of one field after the other."""
    first = [field.values[0] for field in layout]
    rows = [first]
    for k, field in enumerate(layout):
        rows += [[*first[:k], value, *first[k + 1 :]] for value in field.values[1:]]
    for row in rows:
        text = ""
        for field, value in zip(layout, row, strict=True):
            if field.place >= 0:
                text = text[: field.place].ljust(field.place, marker)
            elif text:
                text += "" if text.endswith(marker) else marker
            complete = (
                value.rjust(field.length, "0") if value.isdigit() else value.ljust(field.length)
            )
            text += complete[: field.length or None]
        yield text + marker


def layouts(nodes: Iterable[tuple[n.Node, Scope]]) -> Iterator[tuple[TextField, ...]]:
    """What each routine cuts out, where that is more than one field."""
    result: dict[int, dict[str, tuple[int, int, bool]]] = {}
    compared: dict[str, dict[str, None]] = {}
    bounds: dict[str, list[float]] = {}
    became: dict[str, str] = {}
    for node, scope in nodes:
        for whom, value, is_bound in _tested(node, scope):
            if is_bound and not isinstance(value, str):
                bounds.setdefault(whom, []).append(value)
            else:
                displayed = value if isinstance(value, str) else f"{value:g}"
                compared.setdefault(whom, {})[displayed] = None
        target, source = _kept(node)
        cut = None if source is None else next(filter(_is_cut, walk(source)), None)
        if isinstance(cut, n.FunctionCall) and target is not None:
            is_text = declared_type(target, scope) == "string"
            if isinstance(scope, RoutineScope):
                row = result.setdefault(id(scope.node), {})
                row.setdefault(last(target), (*_where(cut, scope), is_text))
        elif isinstance(source, n.Name) and target is not None:
            became[source.name.casefold()] = last(target)
    for fields in result.values():
        if len(fields) > 1:
            yield tuple(
                TextField(_values(name, became, compared, bounds, is_text=is_text), place, length)
                for name, (place, length, is_text) in fields.items()
            )


def _values(
    name: str,
    became: Mapping[str, str],
    compared: Mapping[str, Mapping[str, None]],
    bounds: Mapping[str, Sequence[float]],
    *,
    is_text: bool,
) -> tuple[str, ...]:
    known = (*compared.get(name, ()), *compared.get(became.get(name, ""), ()))
    if known:
        return known
    ends = bounds.get(name, bounds.get(became.get(name, ""), ()))
    if ends:
        return (f"{round((min(ends) + max(ends)) / 2)}",)
    return ("x",) if is_text and name not in became else ("1",)


def _tested(node: n.Node, scope: Scope) -> Iterator[tuple[str, str | float, bool]]:
    """A name, what it is compared with, and whether that only bounds it."""
    if isinstance(node, n.Binary) and (node.operator in _BOUNDS or node.operator in ("=", "<>")):
        rows = [(node.left, node.right), (node.right, node.left)]
    elif isinstance(node, n.Test):
        rows = [(node.subject, value) for case in node.cases for value in case.values]
    else:
        return
    for one, other in rows:
        value = constant(other, scope)
        if last(one) and isinstance(value, str | int | float) and not isinstance(value, bool):
            is_bound = isinstance(node, n.Binary) and node.operator in _BOUNDS
            yield last(one), value, is_bound


def _kept(node: n.Node) -> tuple[n.Expression | None, n.Expression | None]:
    """Where a node keeps a piece of a text, and the piece."""
    if isinstance(node, n.Assignment) and last(node.target):
        inside = node.value
        # StrToVal gives whether it is a value, and keeps it elsewhere.
        tells = isinstance(inside, n.FunctionCall) and inside.name.lower() == "strtoval"
        return (None, None) if tells else (node.target, inside)
    if isinstance(node, n.FunctionCall) and node.name.lower() == "strtoval":
        given = [a.value for a in node.arguments]
        if len(given) > 1 and given[1] is not None and last(given[1]):
            return given[1], given[0]
    return None, None


def _is_cut(node: n.Node) -> bool:
    return isinstance(node, n.FunctionCall) and node.name.lower() == "strpart"


def _where(cut: n.FunctionCall, scope: Scope) -> tuple[int, int]:
    given = [constant(a.value, scope) if a.value is not None else None for a in cut.arguments]
    place, length = (given[1], given[2]) if len(given) > 2 else (None, None)
    if not isinstance(place, int | float) or not isinstance(length, int | float):
        return -1, 0
    is_there = 0 < place <= _LONGEST and 0 < length <= _LONGEST
    return (int(place) - 1, int(length)) if is_there else (-1, 0)
