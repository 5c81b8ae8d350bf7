"""Types as texts, and what the operators make of them [K §2.17, 3.11].

A type is the lower-case name behind aliases, with `{*}`, `{*,*}` or `{*,*,*}` behind it for
arrays: `num`, `robtarget{*}`. None stands for a type that is not known.
"""

from typing import Final

NUMBER: Final = "number"
"""A number that may still become num or dnum: a literal, or sums of literals."""
AGGREGATE: Final = "aggregate"
NUMERIC: Final = frozenset((NUMBER, "num", "dnum"))
ATOMIC: Final = frozenset(("num", "dnum", "bool", "string"))
"""What surely has no components; of some installed types they are not known."""
LOGICAL: Final = frozenset(("AND", "OR", "XOR", "NOT"))
EQUALITY: Final = frozenset(("=", "<>"))
RELATIONS: Final = frozenset(("<", "<=", ">", ">="))


def array(base: str, degree: int) -> str:
    """The type of an array of `base`."""
    return base + "{" + ",".join("*" * degree) + "}" if degree else base


def degree(type_name: str) -> int:
    """Dimensions of a type."""
    return type_name.count("*")


def element(type_name: str) -> str:
    """Type of an element of an array type, the type itself when it is no array."""
    return type_name.partition("{")[0]


def equal(left: str, right: str) -> bool:
    """Whether types are equal; a literal number is what its partner is."""
    if left == right:
        return True
    if left == NUMBER:
        return right in NUMERIC
    return right == NUMBER and left in NUMERIC


def arithmetic(operator: str, left: str, right: str) -> str | None:
    """Type of `left operator right`, or None when the operator does not take these."""
    if left in NUMERIC and right in NUMERIC:
        if not equal(left, right):
            return None
        return right if left == NUMBER else left
    if operator in ("+", "-") and left == right == "pos":
        return "pos"
    if operator == "+" and left == right == "string":
        return "string"
    if operator == "*":
        if left == right and left in ("pos", "orient"):
            return left
        if "pos" in (left, right) and {left, right} & {NUMBER, "num"}:
            return "pos"
    if operator == "/" and left == "pos" and right in (NUMBER, "num"):
        return "pos"  # in no manual; programs of running cells have it [backup]
    return None
