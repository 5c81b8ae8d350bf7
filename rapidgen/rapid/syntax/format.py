"""Formatted RAPID text."""

import re
from collections import Counter
from collections.abc import Sequence
from typing import Final, overload

from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.rapid.syntax import lexer
from rapidgen.rapid.syntax.lexer import HOLDER, KEYWORDS
from rapidgen.rapid.syntax.nodes import (
    Argument,
    For,
    FunctionCall,
    If,
    LateCall,
    Module,
    Parameter,
    RecordDeclaration,
    RoutineDeclaration,
    Statement,
    Test,
    Unary,
    While,
)
from rapidgen.rapid.syntax.parser import parse
from rapidgen.rapid.syntax.walk import walk

# -- Line starts -----------------------------------------------------------------------------------
#
# Which tokens start a line of formatted text, and how deep it is indented.


def line_starts(module: Module) -> dict[int, int]:
    """Return the indentation of each token that starts a line."""
    starts = {module.first: 0, module.last: 0}
    for declaration in module.declarations:
        starts[declaration.first] = 1
        if isinstance(declaration, RecordDeclaration):
            for component in declaration.components:
                starts[component.first] = 2
            starts[declaration.last] = 1
        elif isinstance(declaration, RoutineDeclaration):
            _routine(declaration, starts)
    return starts


def _routine(node: RoutineDeclaration, starts: dict[int, int]) -> None:
    starts[node.last] = 1
    for datum in node.data:
        starts[datum.first] = 2
    _statements(node.body, 2, starts)
    for handler in (node.backward, node.error, node.undo):
        if handler is not None:
            starts[handler.first] = 1
            _statements(handler.body, 2, starts)


def _statements(body: Sequence[Statement], level: int, starts: dict[int, int]) -> None:
    for node in body:
        starts[node.first] = level
        if isinstance(node, If):
            for branch in node.branches:
                starts[branch.first] = level
                _statements(branch.body, level + 1, starts)
            if node.otherwise is not None:
                starts[node.branches[-1].last + 1] = level
                _statements(node.otherwise, level + 1, starts)
            starts[node.last] = level
        elif isinstance(node, For | While):
            _statements(node.body, level + 1, starts)
            starts[node.last] = level
        elif isinstance(node, Test):
            for case in node.cases:
                starts[case.first] = level
                _statements(case.body, level + 1, starts)
            if node.default is not None:
                default = node.cases[-1].last + 1 if node.cases else node.subject.last + 1
                starts[default] = level
                _statements(node.default, level + 1, starts)
            starts[node.last] = level


# -- Format ----------------------------------------------------------------------------------------
#
# RAPID text in ABB's style: keywords in upper case, four spaces per level, one statement per line.
#
# Only blanks and the case of reserved words change; tokens, comments and the tree do not. Line
# breaks inside a statement, the encoding and the line ends of the file remain.


INDENT: Final = "    "
_NO_SPACE_BEFORE: Final = frozenset((",", ";", ")", "]", "}", ":", "?", ".", "{"))
_NO_SPACE_AFTER: Final = frozenset(("(", "[", "{", ".", "\\", "?"))
_LINE_END: Final = re.compile(r"\r\n|\r|\n")


@overload
def format_source(source: str, *, path: str | None = None) -> str: ...


@overload
def format_source(source: bytes, *, path: str | None = None) -> bytes: ...


def format_source(source: str | bytes, *, path: str | None = None) -> str | bytes:
    """Return the module in ABB's style; bytes keep their encoding.

    Raises DiagnosticError with the parser's findings for a wrong text.
    """
    module = parse(source, path=path)
    unfit = [d for d in module.diagnostics if d.severity is Severity.ERROR or not module.name]
    if unfit:
        raise DiagnosticError(unfit, exit_code=1)
    text = format_module(module)
    return text if isinstance(source, str) else text.encode(module.source.encoding)


def format_module(module: Module) -> str:
    """Return the text of a module without errors, in ABB's style."""
    text = module.source.text
    ends = Counter(_LINE_END.findall(text))
    line_end = max(ends, key=lambda end: ends[end]) if ends else "\n"
    return line_end.join(_Writer(module).lines()) + line_end


class _Writer:
    """Puts tokens and comments on lines."""

    def __init__(self, module: Module) -> None:
        self.module = module
        self.source = module.source
        self.kinds = lexer.Kinds()
        self.end = module.last + 1
        self.starts = line_starts(module)
        self.tight_before: set[int] = set()
        self.tight_after: set[int] = set()
        self.in_aggregate = 0
        self._marks()
        self.out: list[str] = []
        self.line = ""

    def _marks(self) -> None:
        """Find places where the tree decides on a blank."""
        for node in walk(self.module):
            if isinstance(node, Unary):
                if node.operator != "NOT":
                    self.tight_after.add(node.first)
            elif isinstance(node, FunctionCall):
                self.tight_before.add(node.first + 1)
            elif isinstance(node, Argument):
                self._argument(node)
            elif isinstance(node, LateCall):
                self.tight_after.add(node.first)
                self.tight_before.add(node.procedure.last + 1)
            elif isinstance(node, Parameter):
                self.tight_before.update(range(node.name_token + 1, node.last + 1))
        for routine in self.module.routines:
            self.tight_before.add(routine.name_token + 1)
        self.tight_before.add(2)  # MODULE name(

    def _argument(self, node: Argument) -> None:
        assign = node.first + (2 if node.kind == "optional" else 1)
        named = node.kind == "optional" or (node.kind == "required" and node.name is not None)
        if named:
            self.tight_before.add(assign)
            self.tight_after.add(assign)

    def lines(self) -> list[str]:
        """Return all lines of the formatted text, without line ends."""
        self._lead()
        # Text after ENDMODULE is not part of the module and stays unchanged.
        tokens, gaps = self.source.tokens[: self.end], self.source.gaps
        level, continued = 0, False
        for i, token in enumerate(tokens):
            kind = self.kinds[token]
            current = self.starts.get(i)
            if current is not None:
                level, continued = current, False
                self._flush()
                self.line = INDENT * level
            elif not self.line:
                continued = True
                self.line = INDENT * (level + 1)
            elif i > 0 and self._spaced(i):
                self.line += " "
            self.line += token.upper() if kind in KEYWORDS or kind is HOLDER else token
            if kind == "[":
                self.in_aggregate += 1
            elif kind == "]":
                self.in_aggregate -= 1
            self._gap(i, gaps[i], level + 1 if continued else level)
        self._flush()
        if self.end < len(self.source.tokens):
            self.out += _LINE_END.split(self.source.text[self.source.starts[self.end] :])
        while self.out and not self.out[-1].strip():
            self.out.pop()
        return self.out

    def _lead(self) -> None:
        """Write header and comments before the first token."""
        lines = _LINE_END.split(self.source.lead)[:-1] if self.source.lead else []
        in_header = False
        for line in lines:
            stripped = line.rstrip()
            bare = stripped.strip()
            if bare.startswith("%%%"):
                in_header = not in_header
                self.out.append(bare)
            elif in_header:
                self.out.append(stripped)
            elif bare or (self.out and self.out[-1]):
                self.out.append(bare)

    def _flush(self) -> None:
        if self.line:
            self.out.append(self.line.rstrip())
            self.line = ""

    def _gap(self, i: int, gap: str, level: int) -> None:
        """Write comments and line breaks between token i and the next."""
        parts = _LINE_END.split(gap)
        following = self.starts.get(i + 1)
        trailing = parts[0].strip()
        if trailing:
            self.line += " " + trailing.rstrip()
        if len(parts) == 1 and not trailing:
            return
        inside = following is None and i + 1 < self.end
        self._flush()
        if inside:
            level = self._statement_level(i) + 1
        elif following is not None:
            level = self._comment_level(i, following)
        else:
            level = 0
        for part in parts[1:-1]:
            bare = part.strip()
            if bare:
                self.out.append(INDENT * level + bare)
            elif not inside and self.out and self.out[-1]:
                self.out.append("")
        if parts[-1].strip():  # a comment that the end of the file ends
            self.out.append(INDENT * level + parts[-1].strip())

    def _statement_level(self, i: int) -> int:
        while i not in self.starts:
            i -= 1
        return self.starts[i]

    def _comment_level(self, i: int, following: int) -> int:
        """Return the level of a comment before token i.

        Comments before an END belong to the block that it ends.
        """
        kind = self.kinds[self.source.tokens[i + 1]]
        ends = kind.startswith("END") or kind in ("ELSE", "ELSEIF", "CASE", "DEFAULT")
        if not ends:
            return following
        before = self._statement_level(i)
        return max(following, before) if kind in ("CASE", "DEFAULT") else following + 1

    def _spaced(self, i: int) -> bool:
        """Return True for a blank between token i - 1 and i on one line."""
        if i in self.tight_before or i - 1 in self.tight_after:
            return False
        before, current = self.source.tokens[i - 1], self.source.tokens[i]
        if before in _NO_SPACE_AFTER or current in _NO_SPACE_BEFORE:
            return False
        return not (before == "," and self.in_aggregate)
