"""Every finding that a user sees: code, place, reason and mend, and how it is shown."""

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
