"""Findings for users: code, place, reason and help, and their rendering."""

from rapidgen.diagnostics.model import (
    Diagnostic,
    DiagnosticError,
    Edit,
    Fix,
    Label,
    Severity,
    Span,
    Tag,
    apply_edits,
    error,
    refusal,
    replacement,
    suggest,
)
from rapidgen.diagnostics.render import Format, as_data, render

__all__ = [
    "Diagnostic",
    "DiagnosticError",
    "Edit",
    "Fix",
    "Format",
    "Label",
    "Severity",
    "Span",
    "Tag",
    "apply_edits",
    "as_data",
    "error",
    "refusal",
    "render",
    "replacement",
    "suggest",
]
