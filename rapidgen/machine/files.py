"""Disks of a controller: HOME:, TEMP:, RAMDISK: as folders of one folder.

Paths cannot leave it: a path is split as text, `..` never leaves its device, and the target of a
link must be inside. Names are compared without case if the exact name is missing, as on the
controller's disks.
"""

import errno
import os
import re
import shutil
import tempfile
import weakref
from contextlib import suppress
from pathlib import Path
from typing import IO

from rapidgen._compat import StrEnum
from rapidgen._reading import NotRegular, TooLarge, open_foreign
from rapidgen.diagnostics import refusal

_DEVICES = {
    "home:": "HOME",
    "temp:": "TEMP",
    "ramdisk:": "RAMDISK",
    "ram1disk:": "RAMDISK",
    "backup:": "BACKUP",
    "usb:": "USB",
    "flp1:": "FLP1",
    "release:": "RELEASE",
}
_OUTSIDE = re.compile(r"[a-z]\w{0,15}:", re.ASCII)
CAPACITY = 256 * 1024 * 1024
"""Bytes that a controller's programs may write in all; then the disk is full."""
LARGEST_COPY = 1_000_000_000
"""Bytes of a folder that is copied onto a disk."""
_LONGEST_NAME = 255
"""Bytes of a file's name."""
MAX_OPEN = 64
"""Files and folders of one controller that may be open at a time."""


class DiskReason(StrEnum):
    """Reason for the rejection by a disk."""

    NO_ACCESS = "no access"
    TOO_MANY_OPEN = "too many open files"


class DiskFault(Exception):
    """A rejection by a disk; the text explains it."""

    def __init__(self, reason: DiskReason, text: str = "") -> None:
        super().__init__(text or reason.value)
        self.reason = reason


class IODevice:
    """An iodev of a program: an open file, or none."""

    __slots__ = ("binary", "file", "path", "readable", "writable")

    def __init__(self) -> None:
        self.file: IO[bytes] | None = None
        self.path = Path()
        self.binary = False
        self.readable = False
        self.writable = False


class Directory:
    """A dir of a program: the remaining names, or None."""

    __slots__ = ("names",)

    def __init__(self) -> None:
        self.names: list[str] | None = None


_SCRATCH: dict[Path, int] = {}
"""Scratch folders that are there, and the process that made each: a fork inherits them."""


def _remove(folder: Path) -> None:
    """Remove a scratch folder.

    A forked copy of the creating process keeps it.
    """
    if _SCRATCH.pop(folder, None) == os.getpid():
        shutil.rmtree(folder, ignore_errors=True)


def remove_scratch_folders() -> None:
    """Remove scratch folders before an end by `os._exit`."""
    for folder in tuple(_SCRATCH):
        _remove(folder)


class FileSystem:
    """Disks of one controller in `folder`, or in a scratch folder.

    The scratch folder is made on demand, because few drivers access a file; `close`, or the end of
    the process, removes it. HOME: starts as a copy of `home`, over one of `home_below`; links,
    pipes and devices are left out. DiagnosticError RG705: they are too large.
    """

    def __init__(
        self,
        folder: Path | None = None,
        *,
        home: Path | None = None,
        home_below: Path | None = None,
    ) -> None:
        self._free = CAPACITY
        self.inferred: list[str] | None = None
        """Disks outside the controller that are inferred as empty folders; None: there are none."""
        self._open: dict[IODevice | Directory, str] = {}
        self._scratch: weakref.finalize[[Path], FileSystem] | None = None
        self._folder = None if folder is None else _with_devices(folder)
        for source in filter(None, (home_below, home)):
            try:
                copy_files(source, self.folder / "HOME")
            except TooLarge as fault:
                help = (
                    "remove files that the robot's programs do not need, or choose another folder"
                )
                raise refusal("RG705", None, f"{source}: {fault.strerror}", help) from fault

    @property
    def folder(self) -> Path:
        """The folder of the devices."""
        if self._folder is None:
            self._folder = _with_devices(Path(tempfile.mkdtemp(prefix="rapidgen-")))
            _SCRATCH[self._folder] = os.getpid()
            self._scratch = weakref.finalize(self, _remove, self._folder)
        return self._folder

    def close(self) -> None:
        """Close every file and remove a scratch folder."""
        for device in tuple(self._open):
            self.release(device)
        if self._scratch is not None:
            self._scratch()

    def path(self, text: str, file: str = "") -> Path:
        """Return the file of a path; relative paths are in HOME:.

        `file` is appended. DiskFault NO_ACCESS: no disk, or outside of it.
        """
        if file:
            text = text.rstrip("/\\") + "/" + file if not text.endswith(":") else text + file
        device, remaining = _split(text)
        folder = _DEVICES.get(device) or self._inferred(device)
        if folder is None or "\0" in remaining:
            raise DiskFault(DiskReason.NO_ACCESS, f"no disk for '{text}'")
        place = self.folder / folder
        for part in remaining.replace("\\", "/").split("/"):
            if part in ("", "."):
                continue
            if part == "..":
                if place == self.folder / folder:
                    raise DiskFault(DiskReason.NO_ACCESS, f"'{text}' leads out of {device.upper()}")
                place = place.parent
            else:
                place = _find(place, part)
        if not self._inside(place):
            raise DiskFault(DiskReason.NO_ACCESS, f"'{text}' leads out of the controller")
        return place

    def _inferred(self, device: str) -> str | None:
        """Return the folder of a disk outside the controller, such as C: of a computer."""
        if self.inferred is None or _OUTSIDE.fullmatch(device) is None:
            return None
        if device not in self.inferred:
            self.inferred.append(device)
        folder = f"OUTSIDE_{device[:-1].upper()}"
        (self.folder / folder).mkdir(exist_ok=True)
        return folder

    def _inside(self, place: Path) -> bool:
        """Return True if a path is inside the folder after all links.

        A loop of links is outside.
        """
        if len(os.fsencode(place.name)) > _LONGEST_NAME:
            return False
        try:
            place.stat()
        except OSError as error:
            # `resolve` does not report a loop from Python 3.13 on, and raises before.
            if error.errno == errno.ELOOP:
                return False
        return place.resolve().is_relative_to(self.folder)

    def hold(self, device: IODevice | Directory, task: str) -> None:
        """Register an open file or folder. DiskFault TOO_MANY_OPEN."""
        if len(self._open) >= MAX_OPEN:
            raise DiskFault(DiskReason.TOO_MANY_OPEN, f"{MAX_OPEN} files are open")
        self._open[device] = task

    def release(self, device: IODevice | Directory) -> None:
        """Close a file or folder; ignore a closed one."""
        self._open.pop(device, None)
        if isinstance(device, Directory):
            device.names = None
        elif device.file is not None:
            device.file.close()
            device.file = None

    def close_task(self, task: str) -> None:
        """Close the open files of a task (PP to main or routine, restart)."""
        for device in [d for d, owner in self._open.items() if owner == task]:
            self.release(device)

    def spend(self, count: int) -> None:
        """Account for written bytes. DiskFault NO_ACCESS: the disk is full."""
        if count > self._free:
            raise DiskFault(DiskReason.NO_ACCESS, "the disk is full")
        self._free -= count

    @property
    def free_space(self) -> int:
        """Number of bytes that can still be written."""
        return self._free


def _with_devices(folder: Path) -> Path:
    for name in dict.fromkeys(_DEVICES.values()):
        (folder / name).mkdir(parents=True, exist_ok=True)
    return folder.resolve()


def _split(text: str) -> tuple[str, str]:
    start, colon, remaining = text.partition(":")
    if colon and "/" not in start and "\\" not in start:
        return start.lower() + ":", remaining
    if text.startswith(("/", "\\")):
        return "", text
    return "home:", text


def _find(folder: Path, name: str) -> Path:
    exact = folder / name
    if os.path.lexists(exact) or not folder.is_dir():
        return exact
    expected = name.casefold()
    for entry in sorted(os.listdir(folder)):
        if entry.casefold() == expected:
            return folder / entry
    return exact


def copy_files(source: Path, target: Path, *, without: Path | None = None) -> None:
    """Copy folders and regular files of `source` into `target`.

    Links, pipes, devices and the folder `without` are left out. Raises OSError, and TooLarge for
    more bytes than `LARGEST_COPY`.
    """
    free_space = LARGEST_COPY
    target.mkdir(parents=True, exist_ok=True)
    for place, folders, files in os.walk(source, onerror=_raise):
        folders[:] = [
            name
            for name in folders
            if not os.path.islink(os.path.join(place, name)) and Path(place, name) != without
        ]
        current = target / os.path.relpath(place, source)
        for name in folders:
            (current / name).mkdir(exist_ok=True)
        for name in files:
            path = Path(place, name)
            if path.is_symlink():
                continue
            with suppress(NotRegular), open_foreign(path, below=source) as file:
                free_space -= os.fstat(file.fileno()).st_size
                if free_space < 0:
                    reason = f"it holds more than {LARGEST_COPY:,} bytes"
                    raise TooLarge(errno.EFBIG, reason, str(source))
                with (current / name).open("wb") as copy:
                    shutil.copyfileobj(file, copy)
                shutil.copystat(path, current / name)


def _raise(fault: OSError) -> None:
    raise fault
