"""Steps of one run: verified writing, switching, deleting.

Switching uses what the server supports.
"""

import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Literal

from rapidgen.deploy.driver_set import STATE
from rapidgen.deploy.plan import Plan
from rapidgen.deploy.transports.transport import Transport, TransportFault, parent, read_or_none

_LOG = logging.getLogger("rapidgen.deploy")

Rename = Literal["replace", "move", "none"]
"""rename() replaces an existing file, only takes a free name, or fails."""

Say = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class FileOperations:
    """Data that every part of one run needs."""

    transport: Transport
    plan: Plan
    mode: Rename
    say: Say
    made: set[str] = field(default_factory=set)
    """Folders that are known to exist."""
    given_up: Callable[[], bool] = lambda: False
    """True if the user wants to end.

    Checked only while an end leaves everything unchanged.
    """

    @property
    def home(self) -> str:
        return self.plan.layout.home

    @property
    def folder(self) -> str:
        """The state folder."""
        return self.home + STATE


def write(work: FileOperations, path: str, data: bytes) -> None:
    """Write a file and read it back; try once more if it differs.

    Raises TransportFault RG526 if it differs again.
    """
    folder = parent(path)
    if folder and folder not in work.made:
        work.transport.make_folder(folder)
        work.made.add(folder)
    for _ in range(2):
        work.transport.write(path, data)
        if read_or_none(work.transport, path) == data:
            _LOG.info("%s: wrote %s, %d bytes", work.plan.target, path, len(data))
            return
    raise differs(path)


def swap(work: FileOperations, where: str, suffix: str, data: bytes, *, exists: bool) -> None:
    """Move a staged file into place by the smallest available step."""
    if work.mode == "none":
        write(work, where, data)
        return
    if work.mode == "move" and exists:
        delete(work, where)
    work.transport.rename(where + suffix, where)
    _LOG.info("%s: switched %s", work.plan.target, where)


def delete(work: FileOperations, path: str) -> None:
    """Delete a file that may be missing."""
    try:
        work.transport.delete(path)
        _LOG.info("%s: deleted %s", work.plan.target, path)
    except TransportFault as fault:
        if fault.kind != "missing":
            raise


def delete_all(work: FileOperations, paths: Iterable[str]) -> None:
    """Delete the existing files among these; one listing a folder."""
    folders: dict[str, list[str]] = {}
    for path in paths:
        folders.setdefault(parent(path), []).append(path)
    for folder, members in folders.items():
        there = names(work.transport, folder)
        for path in members:
            if path.rpartition("/")[2] in there:
                delete(work, path)


def delete_folder(work: FileOperations, folder: str) -> None:
    """Delete a folder if it is empty; keep one that cannot be deleted."""
    try:
        if not work.transport.entries(folder):
            work.transport.delete_folder(folder)
            work.made.discard(folder)
    except TransportFault as fault:
        if fault.kind in ("lost", "garbled"):
            raise


def names(transport: Transport, folder: str) -> frozenset[str]:
    """Return names in a folder; none if it is missing."""
    try:
        return frozenset(e.name for e in transport.entries(folder))
    except TransportFault as fault:
        if fault.kind != "missing":
            raise
        return frozenset()


def probe(transport: Transport, folder: str) -> Rename:
    """Test rename() on two temporary files and remove them."""
    one, two = f"{folder}/probe.one", f"{folder}/probe.two"
    try:
        transport.write(one, b"new")
        transport.write(two, b"old")
        if _renames(transport, one, two):
            return "replace"
        if two.rpartition("/")[2] in names(transport, folder):
            transport.delete(two)
        return "move" if _renames(transport, one, two) else "none"
    finally:
        _forget(transport, folder, ("probe.one", "probe.two"))


def _renames(transport: Transport, old: str, new: str) -> bool:
    try:
        transport.rename(old, new)
    except TransportFault as fault:
        if fault.kind in ("lost", "garbled"):
            raise
        return False
    return read_or_none(transport, new) == b"new"


def _forget(transport: Transport, folder: str, members: tuple[str, ...]) -> None:
    """Delete as far as possible: the next probe overwrites the rest."""
    try:
        for name in sorted(names(transport, folder) & set(members)):
            transport.delete(f"{folder}/{name}")
    except TransportFault:
        return


def check_not_interrupted(work: FileOperations) -> None:
    """Raise TransportFault RG545 if the user has interrupted the run."""
    if work.given_up():
        raise TransportFault(
            "denied",
            f"{work.plan.target}: interrupted before any file was switched, all is as it was",
            code="RG545",
            help="run the same command again",
        )


def differs(path: str) -> TransportFault:
    """Return RG526: the read data differ from the written ones."""
    return TransportFault(
        "denied",
        f"{path} reads back otherwise than it was written",
        code="RG526",
        help="the connection or the disk damages data: check both, then run again",
    )
