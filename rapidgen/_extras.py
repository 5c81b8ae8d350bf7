"""What only some installations have: which extra of rapidgen brings a package."""

from collections.abc import Iterator
from contextlib import contextmanager

from rapidgen.diagnostics import Diagnostic, error

EXTRAS = {
    "aiohttp": "web",
    "distributed": "cluster",
    "httpx2": "web",
    "matplotlib": "plot",
    "mcap": "recording",
    "websockets": "web",
    "zstandard": "recording",
}
"""By the name that is imported; pyproject.toml has the same (a test compares)."""


def missing(fault: ModuleNotFoundError) -> Diagnostic | None:
    """RG905 for an import that an extra would have satisfied; None for any other."""
    package = (fault.name or "").partition(".")[0]
    if package not in EXTRAS:
        return None
    return error(
        "RG905",
        None,
        f"this needs {package}, which is not installed",
        f"pip install 'rapidgen[{EXTRAS[package]}]', or 'rapidgen[all]'",
    )


@contextmanager
def named() -> Iterator[None]:
    """Let an import that fails for want of an extra say which; still a ModuleNotFoundError."""
    try:
        yield
    except ModuleNotFoundError as fault:
        result = missing(fault)
        if result is None:
            raise
        text = f"{result.message}: {result.help}"
        raise ModuleNotFoundError(text, name=fault.name) from None
