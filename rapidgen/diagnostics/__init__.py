"""Findings for users: code, place, reason and help, and their rendering."""

from rapidgen.diagnostics.model import (
    Diagnostic,
    DiagnosticError,
    Label,
    Severity,
    Span,
    error,
    refusal,
    suggest,
)
from rapidgen.diagnostics.render import Format, as_data, render

__all__ = [
    "Diagnostic",
    "DiagnosticError",
    "Format",
    "Label",
    "Severity",
    "Span",
    "as_data",
    "error",
    "refusal",
    "render",
    "suggest",
]
