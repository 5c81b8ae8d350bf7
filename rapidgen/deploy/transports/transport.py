"""Interface of transports: file operations on one controller.

Every transport is a folder of files with relative POSIX paths. A server's answers are not trusted:
sizes, times and names are bounded, and every failure is a `TransportFault`. Functions beyond files
are in its `services`.
"""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

from rapidgen.diagnostics import DiagnosticError, error, refusal

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

FILE_LIMIT = 8 * 1024 * 1024
"""Largest file that is read from a controller.

A RAPID module of 8 MB is refused elsewhere too.
"""
LISTING_LIMIT = 20_000
"""Largest number of names in one folder."""

Kind = Literal["missing", "denied", "unsupported", "full", "lost", "garbled", "login", "outside"]

_CODES: dict[Kind, tuple[str, str]] = {
    "missing": ("RG506", "look at the folder in the URL: it is HOME of the controller"),
    "denied": ("RG506", "give this user the right to write there, or name another folder"),
    "unsupported": ("RG506", "use another transport, or a server that knows this command"),
    "full": ("RG507", "free space on the controller's disk (old backups, logs), then run again"),
    "lost": ("RG505", "run the same command again: it finishes or undoes the interrupted run"),
    "garbled": ("RG504", "look whether this is the controller's server, then run again"),
    "login": ("RG502", "check user and password (`rapidgen deploy --help` lists the sources)"),
    "outside": ("RG508", "paths stay inside the folder that the URL names"),
}

_SEGMENT = re.compile(r"[A-Za-z0-9_$(){}\[\]@#%&+=,;!~'. -]{1,120}")


class TransportFault(DiagnosticError):
    """A failed file operation.

    `kind` is for the code, the diagnostic for the user.
    """

    def __init__(self, kind: Kind, message: str, *, help: str = "", code: str = "") -> None:
        known, help_text = _CODES[kind]
        super().__init__(error(code or known, None, message, help or help_text), exit_code=1)
        self.kind = kind


@dataclass(frozen=True, slots=True)
class Entry:
    """A name in a folder.

    `size` and `folder` are None if the listing does not have them.
    """

    name: str
    size: int | None = None
    folder: bool | None = None


@dataclass(frozen=True, slots=True)
class TransportCapabilities:
    """Capabilities of a transport. Every plan shows the lines of `unseen`."""

    rename: str
    """Description of the switch."""
    writes_cfg: bool
    """True if the next start reads SYSPAR next to HOME.

    That is a backup or a virtual controller.
    """
    unseen: tuple[str, ...]


class Transport(Protocol):
    """Files of one controller.

    Paths are relative to the folder of the URL ('' is that folder). Every method raises
    TransportFault.
    """

    reach: TransportCapabilities
    shown: str
    """The URL as it may be shown: without secrets."""

    @property
    def services(self) -> "Controller | None":
        """Web services of the same controller; None if there are only files."""

    def entries(self, folder: str) -> tuple[Entry, ...]:
        """List a folder; kind 'missing' if there is none."""

    def read(self, path: str) -> bytes:
        """Read a whole file; kind 'missing' if there is none."""

    def write(self, path: str, data: bytes) -> None:
        """Create or overwrite a file.

        Not atomic: an interruption leaves a part of it.
        """

    def rename(self, old: str, new: str) -> None:
        """Rename, over an existing file if the server can, else 'denied'."""

    def delete(self, path: str) -> None:
        """Delete a file; kind 'missing' if there is none."""

    def make_folder(self, path: str) -> None:
        """Create a folder unless it exists."""

    def delete_folder(self, path: str) -> None:
        """Delete an empty folder."""

    def free(self) -> int | None:
        """Free bytes on the disk, or None if unknown."""

    def close(self) -> None:
        """End the connection; never raises."""


def refused(code: str, message: str, help: str = "") -> DiagnosticError:
    """Return a refusal by the controller's state, without a place in a text.

    Exit code 1.
    """
    return refusal(code, None, message, help, exit_code=1)


def safe(path: str) -> str:
    """Return `path` if it is plain and stays inside.

    Raises TransportFault 'outside' (RG508) otherwise: `..`, absolute, drives, control characters.
    """
    parts = path.split("/")
    plain = all(_SEGMENT.fullmatch(part) and part.strip(". ") for part in parts)
    if not plain or len(path) > 240:
        raise TransportFault("outside", f"not a path inside the controller's folder: {path!r}")
    return path


def parent(path: str) -> str:
    """Return the folder of a path; '' is the root."""
    return path.rpartition("/")[0]


def read_or_none(transport: Transport, path: str) -> bytes | None:
    """Return the file, or None if there is none."""
    try:
        return transport.read(path)
    except TransportFault as fault:
        if fault.kind != "missing":
            raise
        return None
