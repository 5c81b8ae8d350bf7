"""Findings of the checker: places, severities and unknown names."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Final, Literal

from rapidgen.diagnostics import Diagnostic, Fix, Label, Severity, Span, Tag, error, replacement
from rapidgen.rapid.binding import (
    DATA,
    ROUTINES,
    TYPES,
    DataSymbol,
    ModuleScope,
    RoutineScope,
    RoutineSymbol,
    Scope,
    Symbol,
)
from rapidgen.rapid.binding.names import AGGREGATE, element, equal
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.checks.context import CheckContext, closest
from rapidgen.rapid.syntax.nodes import DataDeclaration, Node, Parameter, RoutineDeclaration

_Options = Literal["procedures", "functions", "types", "values", ""]
_ROLES: Final[dict[str, tuple[str, frozenset[str], _Options]]] = {
    "procedure": ("RG301", ROUTINES, "procedures"),
    "function": ("RG301", ROUTINES, "functions"),
    "trap": ("RG301", ROUTINES, ""),
    "type": ("RG303", TYPES, "types"),
    "datum": ("RG302", DATA, "values"),
}
"""Code, kinds of symbols that fit, and the names of options that may be there or not."""
_MAY_COME: Final = {
    "RG301": "another module may bring them, or an option or add-in of RobotWare",
    "RG302": "they may be signals or mechanical units of the configuration, or data of another"
    " module",
    "RG303": "another module may bring them, or an option or add-in of RobotWare",
}
"""Sources of names that the input does not declare."""
HARDWARE: Final = frozenset(
    ("signaldi", "signaldo", "signalgi", "signalgo", "signalai", "signalao", "mecunit", "taskid")
)
"""Types whose objects the configuration installs."""
_OF_SIGNALS: Final = frozenset((None, "num", "dnum", "number", "anytype"))
"""Expected types of an expression in which a signal may stand."""
_LISTED: Final = 8
"""Unknown names that a note shows."""
_LABELLED: Final = 200
"""Unknown names whose places a note has."""


class Findings:
    """Findings in one module, and the uses of its names."""

    def __init__(self, module: ModuleScope, given: CheckContext) -> None:
        self.module = module
        self.given = given
        self.here: Scope = module
        """Where names are looked up: the module, or the routine or loop that is looked at."""
        self.used: set[Symbol] = set()
        self.found: list[Diagnostic] = []
        self._unknown: set[tuple[str, str]] = set()
        self._elsewhere: dict[str, list[tuple[str, Node | int]]] = {}
        """Names that may be declared elsewhere, with their type where it is known, by code."""

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
        fixes: tuple[Fix, ...] = (),
        tags: tuple[Tag, ...] = (),
    ) -> None:
        """Add a finding at a node or a token."""
        first, last = (node, node) if isinstance(node, int) else (node.first, node.last)
        span = self.module.tree.source.span(first, last)
        self.found.append(
            error(
                code,
                span,
                message,
                help,
                label=label,
                notes=notes,
                related=related,
                severity=severity,
                fixes=fixes,
                tags=tags,
            )
        )

    def warn(
        self,
        code: str,
        message: str,
        node: Node | int,
        *,
        label: str = "",
        help: str = "",
        fixes: tuple[Fix, ...] = (),
    ) -> None:
        """Add a warning."""
        severity = Severity.WARNING
        self.report(code, message, node, label=label, help=help, severity=severity, fixes=fixes)

    def remark(
        self,
        code: str,
        message: str,
        node: Node | int,
        *,
        help: str = "",
        fixes: tuple[Fix, ...] = (),
    ) -> None:
        """Add what is no fault, but superfluous: a warning of a strict check, else a note."""
        severity = Severity.WARNING if self.given.strict else Severity.INFO
        tags = (Tag.UNNECESSARY,)
        self.report(code, message, node, help=help, severity=severity, fixes=fixes, tags=tags)

    def spelling(self, likely: str, token: int) -> tuple[Fix, ...]:
        """Return the fix of a name that is probably misspelled; none without a likely name."""
        if not likely:
            return ()
        return replacement(f"Change to '{likely}'", self._span(token), likely)

    def removal(self, title: str, node: Node, *, is_safe: bool = False) -> tuple[Fix, ...]:
        """Return the fix that takes out a declaration, with its line if it has one alone.

        A declaration that shares its lines with others or with a comment leaves those.
        """
        source = self.module.tree.source
        span = source.span(node.first, node.last)
        start = source.offset(span.line, 1)
        end = source.offset(span.end_line + 1, 1)
        before = source.text[start : source.starts[node.first]]
        after = source.text[source.offset(span.end_line, span.end_column) : end]
        if not before.strip() and not after.strip():
            span = Span(span.path, span.line, 1, *source.position(end))
        return replacement(title, span, "", is_safe=is_safe)

    def add_warnings(self, judge: Callable[[], None], note: str) -> None:
        """Add the findings of a check as warnings.

        They are faults that only execution meets.
        """
        marker = len(self.found)
        judge()
        known, more = self.found[:marker], self.found[marker:]
        self.found = known + [
            replace(d, severity=Severity.WARNING, notes=(note,))
            for d in more
            if not any(d.code == k.code and d.span == k.span for k in known)
        ]

    def find(self, name: str) -> Symbol | None:
        """Return the symbol of a name and count it as used."""
        symbol = self.here.find(name)
        if symbol is not None:
            self.used.add(symbol)
        return symbol

    @property
    def locals(self) -> dict[str, DataSymbol]:
        """Parameters, data and loop variables by lower-case name."""
        return self.here.names if isinstance(self.here, RoutineScope) else {}

    def declared(self, symbol: Symbol) -> tuple[Label, ...]:
        """Return a label at the declaration of a symbol, if it has a place."""
        if symbol.node is None or symbol.module is None or symbol.kind == "LOOP":
            return ()
        source = symbol.module.tree.source
        named = isinstance(symbol, DataSymbol | RoutineSymbol)
        at = symbol.token if named else symbol.node.first
        if at >= len(source.tokens):
            return ()
        return (Label(source.span(at, at), f"'{symbol.name}' is declared here"),)

    def unknown(self, role: str, name: str, node: Node | int, expected: str | None = None) -> None:
        """Report an undeclared name, once per name.

        It is an error if the input is complete. Otherwise a name that looks like a typing error
        gives a warning, another one an entry in the module's note (`note_other_scopes`). `expected`
        is the type of a datum.
        """
        code, kinds, options = _ROLES[role]
        key = (role, name.lower())
        if name == "<ID>" or key in self._unknown or key[1] in self.given.elsewhere:
            return
        if options and key[1] in signatures.option_names(options):
            return
        self._unknown.add(key)
        inside = self._data_of_routine(name) if role == "datum" else None
        likely = "" if inside else closest(name, self._candidates(kinds, expected))
        help = f"did you mean '{likely}'?" if likely else ""
        fixes = self.spelling(likely, node if isinstance(node, int) else node.first)
        if inside is not None:
            routine, token = inside
            self.report(
                code,
                f"'{name}' is declared in '{routine.name}': other routines cannot use it",
                node,
                label="not declared here",
                help="declare it at the head of the module, or pass it as an argument",
                related=(Label(self._span(token), f"declared in '{routine.name}'"),),
                severity=Severity.ERROR if self.given.is_complete else Severity.WARNING,
            )
        elif self.given.is_complete and self._is_declared_by_programs(expected):
            self.report(
                code,
                f"there is no {role} '{name}'",
                node,
                label="not declared",
                help=help or self._strict_help(role, expected),
                fixes=fixes,
            )
        elif likely and expected not in HARDWARE:
            message = f"no {role} '{name}' is declared here or built in"
            self.warn(code, message, node, help=help, fixes=fixes)
        else:
            known = role if role in ("function", "trap") else expected
            is_reported = f"{name} ({known})" if known not in (None, "anytype") else name
            self._elsewhere.setdefault(code, []).append((is_reported, node))

    def _data_of_routine(self, name: str) -> tuple[RoutineDeclaration, int] | None:
        """Return the first routine with a datum or parameter of a name, and its token."""
        folded = name.lower()
        for routine in self.module.tree.routines:
            data: list[Parameter | DataDeclaration] = [*routine.parameters, *routine.data]
            for datum in data:
                if datum.name.lower() == folded:
                    return routine, datum.name_token
        return None

    def _span(self, token: int) -> Span:
        return self.module.tree.source.span(token, token)

    def _is_declared_by_programs(self, expected: str | None) -> bool:
        """Return True if the given input declares objects of a type, if anything does.

        Only MOC.cfg declares mechanical units, which the checker does not read.
        """
        return expected != "mecunit" and (self.given.configured or expected not in HARDWARE)

    def _strict_help(self, role: str, expected: str | None) -> str:
        """Return where to declare a name that only a strict check requires."""
        if not self.given.strict:
            return ""
        if role == "datum" and not self.given.configured and expected in _OF_SIGNALS:
            return "declare it; for a signal, load its EIO.cfg (`cfg` in rapidgen.toml)"
        return "declare it, or add the module that does"

    def note_other_scopes(self) -> None:
        """Add notes of names that other modules or the system may declare."""
        for code, names in self._elsewhere.items():
            listed = [name for name, _ in names]
            more = f" and {len(listed) - _LISTED} more" if len(listed) > _LISTED else ""
            self.report(
                code,
                f"not declared here: {', '.join(listed[:_LISTED])}{more}",
                names[0][1],
                notes=(_MAY_COME[code],),
                related=self._further(names),
                severity=Severity.INFO,
            )

    def _further(self, names: list[tuple[str, Node | int]]) -> tuple[Label, ...]:
        """Return a label at each name but the first, which the note marks itself.

        They have no text: editors show them, a terminal does not.
        """
        nodes = [node for _, node in names[1:_LABELLED]]
        tokens = [node if isinstance(node, int) else node.first for node in nodes]
        return tuple(Label(self._span(token), "") for token in tokens)

    def _candidates(self, kinds: frozenset[str], expected: str | None) -> Iterable[str]:
        """Return names for a suggestion; data must have the expected type."""
        task = self.module.task
        for symbols in (
            self.locals,
            self.module.own,
            task.globals,
            task.installed,
            task.configured,
        ):
            for symbol in symbols.values():
                if symbol.kind in kinds and _fits(self.module.type_of(symbol), expected):
                    yield symbol.name
        if kinds is ROUTINES:
            yield from signatures.routine_names()
        elif kinds is TYPES:
            yield from signatures.type_names()
        else:
            for datum in signatures.predefined().values():
                if _fits(self.module.base(datum.type), expected):
                    yield datum.name


def _fits(result: str | None, expected: str | None) -> bool:
    """Return True if a datum fits the type `expected`, or one is unknown."""
    if result is None or expected is None or expected in ("anytype", AGGREGATE):
        return True
    return equal(element(result), element(expected))
