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
from rapidgen.diagnostics.render import Format, render

__all__ = [
    "Diagnostic",
    "DiagnosticError",
    "Format",
    "Label",
    "Severity",
    "Span",
    "error",
    "refusal",
    "render",
    "suggest",
]
