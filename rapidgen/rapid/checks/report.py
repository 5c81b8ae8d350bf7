"""Findings of the checker: places, severities, and what is said about unknown names."""

from collections.abc import Iterable
from typing import Final, Literal

from rapidgen.diagnostics import Diagnostic, Label, Severity
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.checks.given import Given, closest
from rapidgen.rapid.checks.symbols import DATA, ROUTINES, TYPES, Scope, Symbol
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    DataDeclaration,
    Module,
    Node,
    Parameter,
    RecordDeclaration,
    RoutineDeclaration,
)

_Options = Literal["procedures", "functions", "types", "values", ""]
_ROLES: Final[dict[str, tuple[str, frozenset[str], _Options]]] = {
    "procedure": ("RG301", ROUTINES, "procedures"),
    "function": ("RG301", ROUTINES, "functions"),
    "trap": ("RG301", ROUTINES, ""),
    "type": ("RG303", TYPES, "types"),
    "datum": ("RG302", DATA, "values"),
}
"""Code, kinds of symbols that fit, and the names of options that may be there or not."""


class Reporter:
    """Collects what is found in one module."""

    def __init__(self, scope: Scope, given: Given) -> None:
        self.scope = scope
        self.given = given
        self.source = scope.module.source
        self.locals: dict[str, Symbol] = {}
        self.found: list[Diagnostic] = []
        self._unknown: set[tuple[str, str]] = set()

    def report(
        self,
        code: str,
        message: str,
        node: Node | int,
        *,
        label: str = "",
        help: str = "",
        notes: tuple[str, ...] = (),
        related: tuple[Label, ...] = (),
        severity: Severity = Severity.ERROR,
    ) -> None:
        """Add a finding at a node or a token."""
        first, last = (node, node) if isinstance(node, int) else (node.first, node.last)
        span = self.source.span(first, last)
        self.found.append(Diagnostic(code, severity, message, span, label, help, notes, related))

    def warn(
        self, code: str, message: str, node: Node | int, *, label: str = "", help: str = ""
    ) -> None:
        """Add a warning."""
        self.report(code, message, node, label=label, help=help, severity=Severity.WARNING)

    def find(self, name: str) -> Symbol | None:
        """What a name means here; it counts as used."""
        symbol = self.locals.get(name.lower()) or self.scope.find(name)
        if symbol is not None:
            symbol.used = True
        return symbol

    def declared(self, symbol: Symbol) -> tuple[Label, ...]:
        """A label at the declaration of a symbol, where it has a place."""
        node = symbol.node
        if node is None:
            return ()
        module = node if isinstance(node, Module) else None
        owner = symbol.module.module if symbol.module else self.scope.module
        source = module.source if module else owner.source
        if isinstance(node, DataDeclaration | Parameter | RoutineDeclaration):
            at = node.name_token
        elif isinstance(node, RecordDeclaration | AliasDeclaration):
            at = node.first
        else:
            at = 0
        if at >= len(source.tokens):
            return ()
        return (Label(source.span(at, at), f"'{symbol.name}' is declared here"),)

    def unknown(self, role: str, name: str, node: Node | int, *, certain: bool) -> None:
        """A name that nothing declares: an error where it is `certain` that nothing can.

        Elsewhere only a name that looks like a slip is worth a warning. Once a name.
        """
        code, kinds, options = _ROLES[role]
        key = (role, name.lower())
        if name == "<ID>" or key in self._unknown or key[1] in self.scope.world.elsewhere:
            return
        if options and key[1] in signatures.option_names(options):
            return
        self._unknown.add(key)
        likely = closest(name, self._candidates(kinds))
        help = f"did you mean '{likely}'?" if likely else ""
        if certain:
            self.report(code, f"there is no {role} '{name}'", node, label="not declared", help=help)
        elif likely or self.given.judges_routines:
            self.warn(
                code,
                f"no {role} '{name}' is declared here or built in",
                node,
                help=help,
            )

    def _candidates(self, kinds: frozenset[str]) -> Iterable[str]:
        for symbols in (
            self.locals,
            self.scope.own,
            self.scope.globals,
            self.scope.world.installed,
        ):
            for symbol in symbols.values():
                if symbol.kind in kinds:
                    yield symbol.name
        if kinds is ROUTINES:
            yield from signatures.routine_names()
        elif kinds is TYPES:
            yield from signatures.type_names()
        else:
            for datum in signatures.predefined().values():
                yield datum.name
