"""RAPID: text, tokens, tree, checked program, formatted text."""

from rapidgen.rapid.checker import check
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.formatter import format_source
from rapidgen.rapid.parser import parse

__all__ = ["Dialect", "check", "format_source", "parse"]
