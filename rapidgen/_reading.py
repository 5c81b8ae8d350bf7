"""Reading of foreign files: regular, of limited size, inside a folder.

Every file of foreign origin is read here: a configuration, a description and its meshes, cfg and
modules, a backup, a manifest, a plan, a journal, a recording. Reading does not wait for a named
pipe, a socket or a device, and a link does not lead out of the folder, even if it is created while
the file is being opened.
"""

import errno
import functools
import operator
import os
import stat
from io import BufferedReader
from types import ModuleType

StrPath = str | os.PathLike[str]


def _flags(*names: str) -> int:
    """Return the flags that the operating system has; Windows lacks most of them."""
    return functools.reduce(operator.or_, (getattr(os, name, 0) for name in names))


_FLAGS = _flags("O_RDONLY", "O_NONBLOCK", "O_CLOEXEC", "O_NOCTTY", "O_BINARY", "O_NOINHERIT")
_NO_LINK = _flags("O_NOFOLLOW")
# Only Linux has O_PATH, which needs no right to list a folder.
_STEP = _flags("O_PATH", "O_DIRECTORY", "O_CLOEXEC")
_BY_FOLDER = bool(_NO_LINK) and os.open in os.supports_dir_fd
"""Files can be opened relative to an open folder, without following a link."""
_PART = 1 << 20
"""Bytes of one read.

The limit may be far larger than the file.
"""


class NotRegular(OSError):
    """A folder, named pipe, socket or device."""


class TooLarge(OSError):
    """A file that has more bytes than the limit."""


class OutsideFolder(OSError):
    """A path, or a link on it, that leads out of its folder."""


def read_foreign(path: StrPath, limit: int, *, below: StrPath | None = None) -> bytes:
    """Read a regular file of at most `limit` bytes.

    `below`: the folder that must contain the file, links followed. Raises OSError, with the reason
    in `strerror`: NotRegular, TooLarge, OutsideFolder, or the system's own.
    """
    with open_foreign(path, limit, below=below) as file:
        data = bytearray()
        # `file.read` returns None instead of raising OSError if no data is available (/proc/kmsg).
        while part := os.read(file.fileno(), _PART):
            data += part
            if len(data) > limit:  # it has grown, or is one of /proc, which have no size
                raise _too_large(path, limit)
    return bytes(data)


def open_foreign(
    path: StrPath, limit: int | None = None, *, below: StrPath | None = None
) -> BufferedReader:
    """Open a regular file, as `read_foreign`, to read it in parts."""
    name = os.fspath(path)
    try:
        descriptor = _open(name) if below is None else _open_below(name, os.fspath(below))
    except ValueError as fault:  # a NUL in the name
        raise OSError(errno.EINVAL, str(fault), name) from None
    try:
        status = os.fstat(descriptor)
        _check_regular(status, name)
        if limit is not None and status.st_size > limit:
            raise _too_large(name, limit)
    except OSError:
        os.close(descriptor)
        raise
    return open(descriptor, "rb")


def _open(path: str, folder: int | None = None) -> int:
    # Opening a device can have effects, so its type is checked first. A file that replaces it in
    # between is opened without waiting, and `fstat` of the descriptor rejects it.
    if folder is None:
        _check_regular(os.stat(path), path)
        return os.open(path, _FLAGS)
    _check_regular(os.stat(path, dir_fd=folder, follow_symlinks=False), path)
    return os.open(path, _FLAGS | _NO_LINK, dir_fd=folder)


def _open_below(path: str, below: str) -> int:
    root = os.path.realpath(below)
    real = os.path.realpath(path)
    if not is_within(real, root):
        raise OutsideFolder(errno.EPERM, f"it lies outside of {below}", path)
    if not _BY_FOLDER:
        return _open_checked(real, root, below)
    # The real path has no links: a link on it was created after `realpath`, and O_NOFOLLOW rejects
    # it.
    *folders, name = os.path.relpath(real, root).split(os.sep)
    current = os.open(root, _STEP)
    try:
        for folder in folders:
            inner = os.open(folder, _STEP | _NO_LINK, dir_fd=current)
            os.close(current)
            current = inner
        return _open(name, current)
    finally:
        os.close(current)


def _open_checked(real: str, root: str, below: str) -> int:
    """Open a path without links, on a system that cannot open files relative to a folder."""
    descriptor = _open(real)
    if not is_within(os.path.realpath(real), root):  # a link came in between
        os.close(descriptor)
        raise OutsideFolder(errno.EPERM, f"it lies outside of {below}", real)
    return descriptor


def is_within(path: str, folder: str, *, paths: ModuleType = os.path) -> bool:
    """Return True if a path is a folder or lies in it, both absolute and without links.

    `paths`: posixpath or ntpath. On Windows, paths on different drives have no common part.
    """
    try:
        common = paths.commonpath((folder, path))
    except ValueError:
        return False
    return bool(paths.normcase(common) == paths.normcase(folder))


def _check_regular(status: os.stat_result, path: StrPath) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise NotRegular(errno.EISDIR, "it is a folder", os.fspath(path))
    if not stat.S_ISREG(status.st_mode):
        raise NotRegular(errno.EINVAL, "it is no regular file", os.fspath(path))


def _too_large(path: StrPath, limit: int) -> TooLarge:
    return TooLarge(errno.EFBIG, f"it is larger than {limit:,} bytes", os.fspath(path))
