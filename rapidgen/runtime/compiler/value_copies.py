"""Python that stores, passes and returns values: rounded to IEEE single, or copied.

Rounding splits at 24 bits (Veltkamp), which is exact inside the normal range; what may leave it is
tested, and NaN takes the slow way, too.
"""

from rapidgen.rapid.numbers import EXACT
from rapidgen.runtime.compiler.context import CompiledExpression
from rapidgen.runtime.values import Type

_LARGEST = "3.4028234663852886e+38"
_SMALLEST = "1.1754943508222875e-38"
"""Below it a single has fewer digits."""


def rounded(e: CompiledExpression, kind: Type) -> str:
    """Code of `e` as a num that is stored, passed or returned: rounded where it has to be."""
    if kind.kind != "num" or e.exact:
        return e.code
    if e.whole and e.range is not None and e.range[0] >= -EXACT and e.range[1] <= EXACT:
        return e.code
    if e.whole:
        return f"(_x if -{EXACT} <= (_x := {e.code}) <= {EXACT} else RND(_x))"
    if e.risky:
        split = f"(_t := (_y := {e.code}) * 536870913.0) - (_t - _y)"
        return f"(_x if {_normal(f'(_x := {split})')} else RND(_y))"
    return f"((_t := (_y := {e.code}) * 536870913.0) - (_t - _y))"


def store_lines(target: str, e: CompiledExpression, kind: Type, *, keep: bool = False) -> list[str]:
    """Statements that store `e` in a simple Python target, rounded.

    Rounding splits at 24 bits (Veltkamp), which is exact inside the normal range; what may
    leave it is tested, and NaN takes the slow way, too.
    """
    if kind.kind != "num" or e.exact:
        return [f"{target} = {e.code}"]
    if e.whole:
        low, high = e.range if e.range is not None else (-EXACT - 1, EXACT + 1)
        if low >= -EXACT and high <= EXACT:
            return [f"{target} = {e.code}"]
        held = "_x" if keep and e.risky else target
        inside = f"{held} <= {EXACT}" if low >= -EXACT else f"-{EXACT} <= {held} <= {EXACT}"
        lines = [f"{held} = {e.code}", f"if not {inside}: {held} = RND({held})"]
        return lines if held == target else [*lines, f"{target} = {held}"]
    if not e.risky:
        return [f"{target} = (_t := (_y := {e.code}) * 536870913.0) - (_t - _y)"]
    # A failing store leaves the target as it was; without ERROR nobody sees a local again.
    held = "_x" if keep else target
    lines = [
        f"{held} = (_t := (_y := {e.code}) * 536870913.0) - (_t - _y)",
        f"if not ({_normal(held)}): {held} = RND(_y)",
    ]
    if keep:
        lines.append(f"{target} = {held}")
    return lines


def by_value(e: CompiledExpression, kind: Type) -> str:
    """Code of a value that the receiver may keep: rounded, or copied."""
    if e.dims or kind.kind == "record":
        if e.fresh:
            return e.code
        return f"COPY({e.code})" if e.dims else f"{e.code}.copy()"
    return rounded(e, kind)


def _normal(code: str) -> str:
    """Test whether a rounded value is a normal single, or 0; evaluates `code` first and once."""
    name = "_x" if ":=" in code else code
    return (
        f"{_SMALLEST} <= {code} <= {_LARGEST} or -{_LARGEST} <= {name} <= -{_SMALLEST}"
        f" or {name} == 0"
    )
