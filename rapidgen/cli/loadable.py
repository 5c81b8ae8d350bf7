"""What `run` and `sim` refuse before anything is executed."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.system.model import System


def refuse_unloadable(system: "System") -> None:
    """Refuse what no controller loads; names that nothing declares are found when reached.

    Warnings are `rapidgen check`'s business. Raises DiagnosticError with all errors.
    """
    from rapidgen.diagnostics import DiagnosticError, Severity
    from rapidgen.rapid import check

    errors = [d for d in check(system, gaps=True) if d.severity is Severity.ERROR]
    if errors:
        raise DiagnosticError(errors)
