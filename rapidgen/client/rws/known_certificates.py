"""Known certificates of controllers: one `HOST:PORT SHA256` per line.

Controllers sign their certificates themselves, so no authority vouches for them: only the first one
that the user has confirmed is accepted afterwards.
"""

import os
from pathlib import Path

from rapidgen._atomic_write import write_whole
from rapidgen._reading import read_foreign

_LARGEST = 1_000_000
"""Largest size of the list, bytes."""


def default_file() -> Path:
    """Path of the user's list."""
    base = os.environ.get("XDG_STATE_HOME") or str(Path.home() / ".local" / "state")
    return Path(base) / "rapidgen" / "known_controllers"


def known(file: Path, where: str) -> str:
    """The fingerprint of a controller, or an empty text."""
    try:
        text = read_foreign(file, _LARGEST).decode()
    except FileNotFoundError:
        return ""
    for line in text.splitlines():
        name, _, fingerprint = line.partition(" ")
        if name == where:
            return fingerprint.strip()
    return ""


def remember(file: Path, where: str, fingerprint: str) -> None:
    """Store a fingerprint, replacing an older one."""
    lines = read_foreign(file, _LARGEST).decode().splitlines() if file.exists() else []
    lines = [line for line in lines if line.partition(" ")[0] != where]
    file.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    write_whole(file, "".join(f"{x}\n" for x in [*lines, f"{where} {fingerprint}"]).encode())


def shown(fingerprint: str) -> str:
    """Format a fingerprint for comparison: pairs of upper-case digits."""
    upper = fingerprint.upper()
    return ":".join(upper[i : i + 2] for i in range(0, len(upper), 2))


def plain(fingerprint: str) -> str:
    """Parse a fingerprint in any usual spelling."""
    return fingerprint.lower().removeprefix("sha256:").replace(":", "").strip()
