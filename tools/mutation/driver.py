"""Mutants of a RAPID module: one small defect each, from fixed operators.

The share of them that the suite detects measures the suite. There is no selection: every place in a
routine that fits an operator is a mutant, equivalent ones included.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, fields

from rapidgen.controller.tracing import STATEMENTS
from rapidgen.rapid import parse
from rapidgen.rapid.numbers import single
from rapidgen.rapid.syntax.nodes import (
    Assignment,
    Branch,
    CompactIf,
    Connect,
    Module,
    Node,
    NumberLiteral,
    ProcedureCall,
    Raise,
    Retry,
    TryNext,
    While,
)

_SWAPS = {
    "<": "<=",
    "<=": "<",
    ">": ">=",
    ">=": ">",
    "=": "<>",
    "<>": "=",
    "+": "-",
    "-": "+",
    "*": "/",
    "/": "*",
    "AND": "OR",
    "OR": "AND",
    "TRUE": "FALSE",
    "FALSE": "TRUE",
}
# Texts for the operator or the log change no behaviour that a client or robot could detect.
_TALK = frozenset({"tpwrite", "tperase", "errwrite", "skipwarn"})
# `IF a < b a := b;` gives the same result at equality with either relation.
_BOUND = re.compile(r"IF (.+) (<=?|>=?) (.+) \1 := \3;?")


@dataclass(frozen=True, slots=True)
class Mutant:
    """One changed text of a module file.

    `line` is its line, `statement` the first line of the statement around it (0: none, as in a
    declaration); `change` describes the change.
    """

    path: str
    line: int
    statement: int
    change: str
    text: bytes


def mutants(data: bytes, path: str) -> Iterator[Mutant]:
    """Yield all mutants of a module's text, by place and operator.

    Operators: a relation, an arithmetic or logical operator or a truth value swapped; a number one
    larger; a condition negated; a simple statement left out.
    """
    module = parse(data, path=path)
    source = module.source

    around = _statements(module)
    same_at_equality = set()

    def mutant(start: int, end: int, new: str, change: str, token: int) -> Mutant:
        text = source.text[:start] + new + source.text[end:]
        line = source.position(start)[0]
        return Mutant(path, line, around.get(token, 0), change, text.encode(source.encoding))

    def of(node: Node) -> tuple[int, int]:
        return source.starts[node.first], source.starts[node.last] + len(source.tokens[node.last])

    for node in _inside_routines(module):
        start, end = of(node)
        if isinstance(node, NumberLiteral):
            more = f"{node.value + 1:.9g}"
            # A num that is too large to add one would not change.
            if single(float(more)) != single(node.value):
                yield mutant(start, end, more, f"{node.text} -> {more}", node.first)
        elif isinstance(node, Branch | While | CompactIf):
            first, last = of(node.condition)
            inner = source.text[first:last]
            token = node.condition.first
            yield mutant(first, last, f"(NOT ({inner}))", f"condition negated: {inner}", token)
        if isinstance(node, CompactIf) and (bound := _BOUND.fullmatch(source.text[start:end])):
            same_at_equality.add(start + bound.start(2))
        if isinstance(node, Assignment | ProcedureCall | Connect | Raise | Retry | TryNext):
            if isinstance(node, ProcedureCall) and node.name.casefold() in _TALK:
                continue
            change = f"left out: {source.text[start:end]}"
            yield mutant(start, end, _nothing(module, node), change, node.first)
    for first, last in _bodies(module):
        for token in range(first, last + 1):
            word = source.tokens[token]
            swapped = _SWAPS.get(word.upper())
            at = source.starts[token]
            if swapped is None or at in same_at_equality:
                continue
            if not _is_sign(source.tokens, token):
                yield mutant(at, at + len(word), swapped, f"{word} -> {swapped}", token)


def _statements(module: Module) -> dict[int, int]:
    """Return the first line of the innermost statement of each token."""
    result: dict[int, int] = {}
    for node in _inside_routines(module):
        # Outer statements come first, so inner ones overwrite.
        if isinstance(node, STATEMENTS):
            line = module.source.line(node.first)
            result.update(dict.fromkeys(range(node.first, node.last + 1), line))
    return result


def _nothing(module: Module, node: Node) -> str:
    # A compact IF needs a statement: an assignment to itself would have effects, so RAPID's fastest
    # no-operation replaces it.
    before = module.source.tokens[node.first - 1] if node.first else ""
    return "" if before in (";", ":", "THEN", "DO", "ELSE") else "WaitTime 0;"


def _is_sign(tokens: list[str], token: int) -> bool:
    if tokens[token] not in "+-":
        return False
    before = tokens[token - 1]
    return before in ("(", "[", ",", ":=", "=", "<", ">", "<=", ">=", "<>") or before.isupper()


def _bodies(module: Module) -> Iterator[tuple[int, int]]:
    for routine in module.routines:
        yield routine.first, routine.last


def _inside_routines(module: Module) -> Iterator[Node]:
    for routine in module.routines:
        yield from _walk(routine)


def _walk(node: Node) -> Iterator[Node]:
    yield node
    for field in fields(node):
        value = getattr(node, field.name)
        if isinstance(value, Node):
            yield from _walk(value)
        elif isinstance(value, list):
            for item in value:
                if isinstance(item, Node):
                    yield from _walk(item)
