"""Modules and declarations [K §2.11-2.24, 5, 9]; `parse` is the entry."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from rapidgen.diagnostics import Diagnostic, Label, Severity, error
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.syntax import errors, lexer, text
from rapidgen.rapid.syntax.blocks import Blocks
from rapidgen.rapid.syntax.data import DATA, MODULE_STOPS, DataParser
from rapidgen.rapid.syntax.errors import ParseAborted, SyntaxFault
from rapidgen.rapid.syntax.expressions import ExpressionParser
from rapidgen.rapid.syntax.lexer import EOF, HOLDER, NAME, Tokens
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    Component,
    Declaration,
    Module,
    PlaceholderDeclaration,
    RecordDeclaration,
    RoutineDeclaration,
    Scope,
)
from rapidgen.rapid.syntax.routines import ROUTINES, RoutineParser
from rapidgen.rapid.syntax.source import Source

_ATTRIBUTES: Final = ("SYSMODULE", "NOVIEW", "NOSTEPIN", "VIEWONLY", "READONLY")
_EXCLUDED: Final = (
    ("NOVIEW", "NOSTEPIN"),
    ("NOVIEW", "VIEWONLY"),
    ("NOVIEW", "READONLY"),
    ("VIEWONLY", "READONLY"),
)
_HANDLERS: Final = ("ERROR", "UNDO", "BACKWARD")
_RANK: Final = {"type": 0, "datum": 1, "routine": 2}
_DECLARATION_HOLDERS: Final = {"<TDN>": "type", "<DDN>": "datum", "<RDN>": "routine"}


class ModuleParser:
    """Parser of one module; `builtin`: headers of predefined routines."""

    def __init__(self, tokens: Tokens, *, builtin: bool = False) -> None:
        expressions = self.expressions = ExpressionParser(tokens)
        self.data = DataParser(expressions, builtin=builtin)
        self.routines = RoutineParser(expressions, Blocks(expressions), self.data)
        self.source = tokens.source
        self.kinds = expressions.kinds
        self.texts = expressions.texts
        self.open = expressions.open
        self.fault = expressions.fault
        self.report = expressions.report
        self.identifier = expressions.identifier

    # -- module --------------------------------------------------------------------------

    def module(self) -> tuple[str, tuple[str, ...], list[Declaration], int]:
        """Return name, attributes, declarations and last token of a module."""
        kinds = self.kinds
        declarations: list[Declaration] = []
        i = 0
        if kinds[0] != "MODULE":
            self.report(text.no_module(self.source, kinds))
            if "MODULE" not in kinds:
                return "", (), declarations, self._last()
            i = kinds.index("MODULE")
        self.open.append(("MODULE", i))
        name = ""
        attributes: tuple[str, ...] = ()
        try:
            name = self.identifier(i + 1, "the name of the module")
            attributes, i = self._attributes(i + 2)
        except SyntaxFault as result:
            self.fault(result)
            i = result.at
            while kinds[i] not in MODULE_STOPS:
                i += 1
        i = self._declarations(i, declarations)
        if kinds[i] == "ENDMODULE":
            self.open.pop()
            self._after_module(i + 1)
            return name, attributes, declarations, i
        self.fault(SyntaxFault(i, "ENDMODULE"))
        return name, attributes, declarations, self._last()

    def _last(self) -> int:
        return max(0, len(self.texts) - 1)

    def _after_module(self, i: int) -> None:
        """Report text after the module [K §9].

        K derives modules and leaves open what a file may contain.
        """
        if self.kinds[i] is EOF:
            return
        again = self.kinds[i] == "MODULE"
        self.report(
            error(
                "RG217",
                errors.place(self.source, i),
                "a second module in one file: it is not read"
                if again
                else "the text after ENDMODULE is not read",
                "give each module a file of its own" if again else "remove it",
                label="not read from here on",
                notes=("no manual describes the effect on a controller [K §9, 9.1]",),
                severity=Severity.WARNING,
            )
        )

    def _attributes(self, i: int) -> tuple[tuple[str, ...], int]:
        """Parse attributes; return the index after them [K §9.1]."""
        kinds = self.kinds
        if kinds[i] != "(":
            return (), i
        result: list[str] = []
        while True:
            i += 1
            if kinds[i] not in _ATTRIBUTES:
                raise SyntaxFault(i, "SYSMODULE, NOVIEW, NOSTEPIN, VIEWONLY or READONLY")
            result.append(kinds[i])
            self._attribute_rules(i, result)
            i += 1
            if kinds[i] == ")":
                return tuple(result), i + 1
            if kinds[i] != ",":
                raise SyntaxFault(i, "',' or ')'")

    def _attribute_rules(self, i: int, result: list[str]) -> None:
        new, before = result[-1], result[:-1]
        if new in before:
            fault = f"the attribute {new} is given twice"
        elif any({new, other} == set(pair) for other in before for pair in _EXCLUDED):
            other = next(o for o in before for pair in _EXCLUDED if {new, o} == set(pair))
            fault = f"the attributes {other} and {new} exclude each other"
        elif before and _ATTRIBUTES.index(new) < _ATTRIBUTES.index(before[-1]):
            fault = f"{new} precedes {before[-1]}"
        else:
            return
        self.report(
            error(
                "RG215",
                errors.place(self.source, i),
                fault,
                "the order is SYSMODULE, NOVIEW, NOSTEPIN, VIEWONLY, READONLY",
                notes=("module attributes [K §9.1]",),
            )
        )

    def _declarations(self, i: int, result: list[Declaration]) -> int:
        """Parse all declarations; return the index of the end."""
        kinds = self.kinds
        rank = 0
        while True:
            kind = kinds[i]
            start = i
            declaration: Declaration
            try:
                if kind in DATA:
                    new = 1
                    declaration = self.data.data_declaration(i)
                elif kind in ROUTINES:
                    new = 2
                    declaration = self.routines.routine(i, i, "")
                elif kind == "LOCAL" or kind == "TASK":
                    declaration, new = self._scoped(i, kind)
                elif kind == "RECORD":
                    new = 0
                    declaration = self._record(i, i, "")
                elif kind == "ALIAS":
                    new = 0
                    declaration = self._alias(i, i, "")
                elif kind == "ENDMODULE" or kind == "MODULE" or kind is EOF:
                    return i
                elif kind is HOLDER and self.texts[i].upper() in _DECLARATION_HOLDERS:
                    holder = self.texts[i].upper()
                    new = _RANK[_DECLARATION_HOLDERS[holder]]
                    declaration = PlaceholderDeclaration(i, i, holder)
                elif kind in _HANDLERS and result and isinstance(result[-1], RoutineDeclaration):
                    self._handler_outside(i, result[-1])
                    i = self._next_declaration(i, i)
                    continue
                else:
                    raise SyntaxFault(i, "a declaration or ENDMODULE")
            except SyntaxFault as fault:
                del self.open[1:]
                self.fault(fault)
                i = self._next_declaration(start, fault.at)
                continue
            if new < rank:
                self._out_of_order(declaration, new, rank)
            else:
                rank = new
            result.append(declaration)
            i = declaration.last + 1

    def _handler_outside(self, i: int, routine: RoutineDeclaration) -> None:
        """Report a handler behind the end of the routine before it."""
        source, end = self.source, self.texts[routine.last].upper()
        self.report(
            error(
                "RG216",
                errors.place(source, i),
                f"this {self.kinds[i]} handler is behind the {end} of '{routine.name}'",
                f"take out the {end} before it: a handler is the last part of its routine",
                notes=("handlers of a routine [K §5.3-5.5]",),
                related=(Label(source.span(routine.last, routine.last), "ends here"),),
            )
        )

    def _next_declaration(self, start: int, at: int) -> int:
        kinds = self.kinds
        if at == start and kinds[at] not in ("ENDMODULE", "MODULE", EOF):
            at += 1
        while kinds[at] not in MODULE_STOPS:
            if kinds[at] is HOLDER and self.texts[at].upper() in _DECLARATION_HOLDERS:
                break
            at += 1
        return at

    def _out_of_order(self, declaration: Declaration, new: int, rank: int) -> None:
        what = ("type definition", "data declaration")[new]
        after = ("", "data", "routines")[rank]
        self.report(
            error(
                "RG213",
                self.source.span(declaration.first, declaration.first),
                f"a {what} follows {after}",
                "order a module: RECORD and ALIAS, then data, then routines",
                label=f"{what}s come before {after}",
                notes=("order inside a module [K §5, 9.1]",),
            )
        )

    def _scoped(self, i: int, scope: str) -> tuple[Declaration, int]:
        """Parse a declaration after LOCAL or TASK; return its rank."""
        kind = self.kinds[i + 1]
        if kind in ("VAR", "PERS") or (kind == "CONST" and scope == "LOCAL"):
            return self.data.data_declaration(i), 1
        if scope == "LOCAL":
            if kind in ROUTINES:
                return self.routines.routine(i, i + 1, "LOCAL"), 2
            if kind == "RECORD":
                return self._record(i, i + 1, "LOCAL"), 0
            if kind == "ALIAS":
                return self._alias(i, i + 1, "LOCAL"), 0
            raise SyntaxFault(i + 1, "VAR, PERS, CONST, PROC, FUNC, TRAP, RECORD or ALIAS")
        raise SyntaxFault(i + 1, "VAR or PERS", "only VAR and PERS can belong to a task")

    # -- types and data ------------------------------------------------------------------

    def _record(self, first: int, i: int, scope: Scope) -> RecordDeclaration:
        kinds, texts = self.kinds, self.texts
        name = self.identifier(i + 1, "the name of the record")
        self.open.append(("RECORD", i))
        components: list[Component] = []
        at = i + 2
        while kinds[at] != "ENDRECORD":
            try:
                if kinds[at] is not NAME:
                    self.identifier(at, "a component (type and name) or ENDRECORD")
                name_here = self.identifier(at + 1, "the name of the component")
                end = at + 2
                if kinds[end] == "{":
                    help = "a component cannot be an array [K §2.14]"
                    self.fault(SyntaxFault(end, "';'", help))
                    end = self._after_braces(end)
                end = self.data.semicolon_here(end, "';'")
                components.append(Component(at, end, texts[at], name_here))
                at = end + 1
            except SyntaxFault as result:
                self.fault(result)
                at = result.at
                while kinds[at] != ";" and kinds[at] not in MODULE_STOPS | {"ENDRECORD"}:
                    at += 1
                if kinds[at] in MODULE_STOPS:
                    self.open.pop()
                    return RecordDeclaration(first, at - 1, scope, name, components)
                at += kinds[at] == ";"
        self.open.pop()
        if not components:
            self.fault(SyntaxFault(at, "a component", "a record has at least one [K §2.14]"))
        return RecordDeclaration(first, at, scope, name, components)

    def _after_braces(self, i: int) -> int:
        """Return the index after the braces at i, if they are closed."""
        at = i
        while self.kinds[at] not in MODULE_STOPS and self.kinds[at] not in ("ENDRECORD", ";"):
            if self.kinds[at] == "}":
                return at + 1
            at += 1
        return at

    def _alias(self, first: int, i: int, scope: Scope) -> AliasDeclaration:
        type_name = self.identifier(i + 1, "the name of a type")
        name = self.identifier(i + 2, "the name of the alias")
        end = self.data.semicolon_here(i + 3, "';'")
        return AliasDeclaration(first, end, scope, type_name, name)


class _Collector:
    """Suspends garbage collection while a tree grows.

    Collections would cost more than the parse. Afterwards the tree moves to the oldest generation
    at once: traversing its nodes at the next young collection would cost a third of the parse,
    without result. This bypasses Python's own trigger for the oldest generation, so this class
    triggers it after as many new tokens as the generation has objects.
    """

    LEAST = 1_000_000
    FEW = 2_000
    """Tokens of a small text, whose tree is not moved: counting frozen objects traverses them."""

    def __init__(self) -> None:
        self.promoted = 0
        self.limit = self.LEAST

    @contextmanager
    def paused(self) -> Iterator[None]:
        running, before = gc.isenabled(), self.promoted
        gc.disable()
        try:
            yield
        finally:
            if running:
                if self.promoted - before > self.FEW and gc.get_freeze_count() == 0:
                    gc.freeze()
                    gc.unfreeze()
                gc.enable()
        if running and self.promoted > self.limit:
            self.promoted = 0
            gc.collect()
            self.limit = max(self.LEAST, len(gc.get_objects()))


_COLLECTOR = _Collector()


def parse(
    source: str | bytes, *, path: str | None = None, dialect: Dialect | None = None
) -> Module:
    """Return the tree of one module; never raises for wrong text.

    See `Module.diagnostics`. `path` is for messages only. `dialect` defaults to RobotWare 6.
    """
    name = path or "<text>"
    refused = text.refuse(source, name)
    if refused:
        return _empty(refused, name)
    dialect = dialect or Dialect()
    encoding = "utf-8"
    if isinstance(source, bytes):
        source, encoding = lexer.decode(source, dialect.encoding)
    with _COLLECTOR.paused():
        tokens = lexer.tokenize(source, name, encoding, radix=dialect.has_radix)
        _COLLECTOR.promoted += len(tokens.source.tokens)
        parser = ModuleParser(tokens)
        return _run(parser, tokens)


def _run(parser: ModuleParser, tokens: Tokens) -> Module:
    module_name = ""
    attributes: tuple[str, ...] = ()
    declarations: list[Declaration] = []
    last = max(0, len(tokens.source.tokens) - 1)
    try:
        for finding in text.spellings(tokens):
            parser.report(finding)
        module_name, attributes, declarations, last = parser.module()
    except ParseAborted as reason:
        if reason.diagnostic.code == "RG214":
            parser.expressions.diagnostics.append(reason.diagnostic)
        else:
            parser.expressions.diagnostics[:] = [reason.diagnostic]
    result = sorted(parser.expressions.diagnostics, key=_position)
    return Module(0, last, module_name, attributes, declarations, tokens.source, result)


def _position(diagnostic: Diagnostic) -> tuple[int, int]:
    span = diagnostic.span
    return (span.line, span.column) if span else (0, 0)


def _empty(diagnostic: Diagnostic, path: str) -> Module:
    return Module(0, 0, "", (), [], Source("", path, "utf-8"), [diagnostic])
