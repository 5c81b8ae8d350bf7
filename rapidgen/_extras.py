"""Optional packages and the extras of rapidgen that install them."""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error

EXTRAS = {
    "aiohttp": "web",
    "coal": "collision",
    "distributed": "cluster",
    "google": "egm",
    "httpx2": "web",
    "lxml": "urdf",
    "matplotlib": "plot",
    "mcap": "recording",
    "trimesh": "urdf",
    "websockets": "web",
    "xacro": "urdf",
    "yourdfpy": "urdf",
    "zstandard": "recording",
}
"""Extras by import name, as in pyproject.toml (a test compares them)."""
_DISTRIBUTIONS = {"google": "protobuf"}
"""Names of distributions that differ from the import name."""


def missing(fault: ModuleNotFoundError) -> Diagnostic | None:
    """Return RG905 for an import that an extra provides; None for others."""
    package = (fault.name or "").partition(".")[0]
    return _lacking(package, None) if package in EXTRAS else None


def require(extra: str, place: Span | None) -> None:
    """Check that the packages of an extra are installed, without importing them.

    Raises DiagnosticError (RG905) with the place that needs them.
    """
    for package, name in EXTRAS.items():
        if name == extra and find_spec(package) is None:
            raise DiagnosticError([_lacking(package, place)])


def _lacking(package: str, place: Span | None) -> Diagnostic:
    return error(
        "RG905",
        place,
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
