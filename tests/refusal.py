"""What a call that has to be refused says."""

import pytest

from rapidgen.diagnostics import DiagnosticError


def refusal(action, *arguments, **options) -> DiagnosticError:
    """The DiagnosticError that a call raises; the test fails when it goes through."""
    with pytest.raises(DiagnosticError) as caught:
        action(*arguments, **options)
    return caught.value


def refused(action, *arguments, **options) -> list[str]:
    """The codes of what a call is refused for."""
    return [d.code for d in refusal(action, *arguments, **options).diagnostics]
