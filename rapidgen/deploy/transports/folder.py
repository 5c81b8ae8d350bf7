"""dir:// - a folder on this machine.

A mounted disk, a backup, a virtual controller's HOME.
"""

import errno
import os
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from rapidgen._reading import OutsideFolder, TooLarge, read_foreign
from rapidgen.deploy.secrets import Credentials
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import (
    FILE_LIMIT,
    LISTING_LIMIT,
    Entry,
    TransportCapabilities,
    TransportFault,
    safe,
)


class FolderTransport:
    """Files below `root`. A link that leads out of it is refused."""

    services = None
    reach = TransportCapabilities(
        rename="rename over the old file (atomic), with fsync",
        writes_cfg=True,
        unseen=("a folder shows files only: whether a controller has read them is not seen",),
    )

    def __init__(self, root: Path) -> None:
        """Raises TransportFault (RG506) when there is no such folder."""
        self.shown = f"dir://{root}"
        if not root.is_dir():
            raise TransportFault("missing", f"there is no folder {root}")
        self._root = root.resolve()

    def entries(self, folder: str) -> tuple[Entry, ...]:
        with _faults(folder):
            result = []
            with os.scandir(self._real(folder)) as entries:
                for entry in entries:
                    is_folder = entry.is_dir()
                    size = None if is_folder else entry.stat(follow_symlinks=False).st_size
                    result.append(Entry(entry.name, size, is_folder))
                    if len(result) > LISTING_LIMIT:
                        raise TransportFault("garbled", f"too many files in {folder or 'HOME'}")
        return tuple(sorted(result, key=lambda e: e.name))

    def read(self, path: str) -> bytes:
        with _faults(path):
            return read_foreign(self._root / safe(path), FILE_LIMIT, below=self._root)

    def write(self, path: str, data: bytes) -> None:
        with _faults(path), _open_to_write(self._real(safe(path))) as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())

    def rename(self, old: str, new: str) -> None:
        with _faults(old):
            target = self._entry(new)
            self._entry(old).replace(target)
            _sync(target.parent)

    def delete(self, path: str) -> None:
        with _faults(path):
            entry = self._entry(path)
            entry.unlink()
            _sync(entry.parent)

    def make_folder(self, path: str) -> None:
        with _faults(path):
            self._real(safe(path)).mkdir(parents=True, exist_ok=True)

    def delete_folder(self, path: str) -> None:
        with _faults(path):
            self._entry(path).rmdir()

    def free(self) -> int | None:
        return shutil.disk_usage(self._root).free

    def close(self) -> None:
        pass

    def _real(self, path: str) -> Path:
        """Return the file of a path, links followed."""
        real = (self._root / path).resolve()
        if not real.is_relative_to(self._root):
            raise TransportFault("outside", f"{path} is a link that leads out of {self._root}")
        return real

    def _entry(self, path: str) -> Path:
        """Return the name itself: a link at the end is not followed."""
        head, _, tail = safe(path).rpartition("/")
        return self._real(head) / tail


def open_folder(target: Target, _login: Credentials, _timeout: float) -> FolderTransport:
    """Open the folder of a URL. Raises TransportFault (RG506)."""
    return FolderTransport(Path(target.path))


def _open_to_write(path: Path) -> BinaryIO:
    """Open an empty regular file; refuse a pipe or a device of that name."""
    flags = os.O_WRONLY | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY
    file = open(os.open(path, flags, 0o666), "wb")  # noqa: SIM115 - the caller closes it
    try:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", str(path))
        file.truncate()
    except OSError:
        file.close()
        raise
    return file


def _sync(folder: Path) -> None:
    """Make a rename survive a power failure."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def _faults(path: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        place = f"{path or 'the folder'}: {error.strerror or error}"
        if isinstance(error, OutsideFolder):
            raise TransportFault("outside", place) from error
        if isinstance(error, TooLarge):
            raise TransportFault("garbled", place) from error
        if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise TransportFault("full", place) from error
        if error.errno in (errno.ENOENT, errno.ENOTDIR):
            raise TransportFault("missing", place) from error
        raise TransportFault("denied", place) from error
