"""Optional packages and the extras of rapidgen that install them."""

from collections.abc import Iterator
from contextlib import contextmanager

from rapidgen.diagnostics import Diagnostic, error

EXTRAS = {
    "aiohttp": "web",
    "coal": "collision",
    "distributed": "cluster",
    "google": "egm",
    "httpx2": "web",
    "matplotlib": "plot",
    "mcap": "recording",
    "websockets": "web",
    "zstandard": "recording",
}
"""Extras by import name, as in pyproject.toml (a test compares them)."""
_DISTRIBUTIONS = {"google": "protobuf"}
"""Names of distributions that differ from the import name."""


def missing(fault: ModuleNotFoundError) -> Diagnostic | None:
    """Return RG905 for an import that an extra provides; None for others."""
    package = (fault.name or "").partition(".")[0]
    if package not in EXTRAS:
        return None
    return error(
        "RG905",
        None,
        f"this needs {_DISTRIBUTIONS.get(package, package)}, which is not installed",
        f"pip install 'rapidgen[{EXTRAS[package]}]', or 'rapidgen[all]'",
    )


@contextmanager
def named() -> Iterator[None]:
    """Add the extra's name to a failed import.

    It stays a ModuleNotFoundError.
    """
    try:
        yield
    except ModuleNotFoundError as fault:
        result = missing(fault)
        if result is None:
            raise
        text = f"{result.message}: {result.help}"
        raise ModuleNotFoundError(text, name=fault.name) from None
