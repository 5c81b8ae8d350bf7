"""Parts of a module that a syntax error makes unreliable.

The parser continues behind an error, so that most of a tree stands while its text is edited. What
it says is certain for the rest of the module: an error inside a routine concerns that routine
alone, and an error between declarations concerns the text up to the next one. Names in these parts
may be declared or used there, and nothing can be said about them.
"""

from bisect import bisect_right
from dataclasses import dataclass
from typing import Final

from rapidgen.diagnostics import Diagnostic, Severity, Span
from rapidgen.rapid.syntax.lexer import NAME, Kinds
from rapidgen.rapid.syntax.nodes import Module, RoutineDeclaration
from rapidgen.rapid.syntax.source import Source

_HARMLESS: Final = frozenset(("RG213", "RG215", "RG216", "RG220"))
"""Errors of the text whose tree can be checked nevertheless."""
_UNREAD: Final = "RG217"
"""Text behind the module, which is not in the tree."""


@dataclass(frozen=True, slots=True, eq=False)
class Damage:
    """Parts of a module with syntax errors."""

    routines: frozenset[RoutineDeclaration] = frozenset()
    """Routines whose statements are not all in the tree."""
    ranges: tuple[tuple[int, int], ...] = ()
    """First and last tokens of all parts with errors, in order."""
    names: frozenset[str] = frozenset()
    """Lower-case names in these parts."""
    is_whole: bool = False
    """Declarations of the module are missing in the tree, and their names are unknown."""

    def covers(self, token: int) -> bool:
        """Return True if a token lies in a part with errors."""
        return any(first <= token <= last for first, last in self.ranges)


_NONE: Final = Damage()


def damage_of(module: Module) -> Damage:
    """Return the parts of a module that its syntax errors concern."""
    faults = [d for d in module.diagnostics if _is_fault(d)]
    is_whole = not module.name or any(d.code == _UNREAD for d in module.diagnostics)
    if not faults:
        return Damage(is_whole=True) if is_whole else _NONE
    routines: set[RoutineDeclaration] = set()
    ranges: set[tuple[int, int]] = set()
    for fault in faults:
        # An end that is missing is reported where the outer block ends, which may be the head of
        # the next routine; the label tells which block it is.
        span = fault.related[0].span if fault.code == "RG202" and fault.related else fault.span
        if span is None:
            continue
        token = _token_at(module.source, span)
        routine = _routine_with(module, token)
        if routine is None:
            ranges.add(_gap_around(module, token))
            continue
        routines.add(routine)
        ranges.add((routine.first, routine.last))
    ordered = tuple(sorted(ranges))
    return Damage(frozenset(routines), ordered, _names(module, ordered), is_whole)


def _is_fault(d: Diagnostic) -> bool:
    return d.severity is Severity.ERROR and d.code not in _HARMLESS


def _token_at(source: Source, span: Span) -> int:
    """Return the index of the token at or before a place."""
    at = bisect_right(source.starts, source.offset(span.line, span.column)) - 1
    return max(0, at)


def _routine_with(module: Module, token: int) -> RoutineDeclaration | None:
    for routine in module.routines:
        if routine.first <= token <= routine.last:
            return routine
    return None


def _gap_around(module: Module, token: int) -> tuple[int, int]:
    """Return the tokens between the declarations around a token, with the one that has it."""
    first, last = module.first, len(module.source.tokens) - 1
    for declaration in module.declarations:
        if declaration.last < token:
            first = max(first, declaration.last + 1)
        elif declaration.first > token:
            last = min(last, declaration.first - 1)
    return first, last


def _names(module: Module, ranges: tuple[tuple[int, int], ...]) -> frozenset[str]:
    kinds, tokens = Kinds(), module.source.tokens
    result: set[str] = set()
    for first, last in ranges:
        result.update(t.lower() for t in set(tokens[first : last + 1]) if kinds[t] is NAME)
    return frozenset(result)
