"""Values of expressions that are known before the program runs."""

import struct
from collections.abc import Callable
from math import isfinite
from typing import Final

from rapidgen.rapid.checks.symbols import Symbol
from rapidgen.rapid.syntax.nodes import (
    Binary,
    BoolLiteral,
    DataDeclaration,
    Expression,
    Name,
    NumberLiteral,
    Parenthesis,
    StringLiteral,
    Unary,
)

MAX_STRING: Final = 80
"""Characters of a string [K §2.13]."""
MAX_RAW_BYTES: Final = 1024
MAX_SINGLE: Final = 3.4028235677973366e38
"""The first value that single precision cannot hold any more."""
_MAX_DEPTH: Final = 20

Constant = float | bool | str


def constant(
    node: Expression, find: Callable[[str], Symbol | None], depth: int = 0
) -> Constant | None:
    """Value of a constant expression, or None where it is not known."""
    if isinstance(node, NumberLiteral):
        return node.value if isfinite(node.value) else None
    if isinstance(node, StringLiteral | BoolLiteral):
        return node.value
    if depth > _MAX_DEPTH:
        return None
    if isinstance(node, Parenthesis):
        return constant(node.inner, find, depth + 1)
    if isinstance(node, Unary):
        value = constant(node.operand, find, depth + 1)
        if node.operator == "NOT":
            return not value if isinstance(value, bool) else None
        if isinstance(value, bool) or not isinstance(value, int | float):
            return None
        return -value if node.operator == "-" else value
    if isinstance(node, Name):
        symbol = find(node.name)
        if symbol is None or symbol.kind != "CONST":
            return None
        declared = symbol.node
        if isinstance(declared, DataDeclaration) and declared.initial is not None:
            inside = symbol.module.find if symbol.module else find
            return constant(declared.initial, inside, depth + 1)
        return None
    if isinstance(node, Binary):
        left = constant(node.left, find, depth + 1)
        right = constant(node.right, find, depth + 1)
        return _combined(node.operator, left, right)
    return None


def _combined(operator: str, left: Constant | None, right: Constant | None) -> Constant | None:
    if isinstance(left, str) and isinstance(right, str):
        return left + right if operator == "+" else None
    if isinstance(left, bool | str | None) or isinstance(right, bool | str | None):
        return None
    try:
        if operator == "+":
            value = left + right
        elif operator == "-":
            value = left - right
        elif operator == "*":
            value = left * right
        elif operator == "/" and right:
            value = left / right
        else:
            return None
        return value if isfinite(value) else None
    except OverflowError:  # a whole number that no float holds
        return None


def is_single(value: float) -> bool:
    """Whether single precision holds the value at all."""
    return -MAX_SINGLE < value < MAX_SINGLE


def is_exact_single(value: int) -> bool:
    """Whether single precision holds a whole number exactly."""
    if not is_single(value):
        return False
    rounded: float = struct.unpack("<f", struct.pack("<f", float(value)))[0]
    return int(rounded) == value
