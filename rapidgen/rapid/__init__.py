"""RAPID: text, tokens, tree, checked program, formatted text."""

from typing import TYPE_CHECKING

from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.syntax.parser import parse

if TYPE_CHECKING:
    from rapidgen.rapid.checks import check
    from rapidgen.rapid.syntax.format import format_source

__all__ = ["Dialect", "check", "format_source", "parse"]


def __getattr__(name: str) -> object:
    """Import checker and formatter on demand: most users only parse."""
    if name == "check":
        from rapidgen.rapid.checks import check

        return check
    if name == "format_source":
        from rapidgen.rapid.syntax.format import format_source

        return format_source
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
