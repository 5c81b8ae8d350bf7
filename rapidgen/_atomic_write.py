"""Atomic replacement of one file.

A full disk or Ctrl-C leaves the earlier content.
"""

import os
import stat
from pathlib import Path


def write_whole(path: Path, data: bytes) -> None:
    """Write `data` to a temporary file and rename it to `path`.

    The rights of an existing file are kept. A link stays and its target is replaced; a pipe or a
    device is written to. Raises OSError that names `path`.
    """
    target = Path(os.path.realpath(path))
    try:
        before = _status(target)
        if before is not None and not stat.S_ISREG(before.st_mode):
            target.write_bytes(data)
        else:
            _replace(target, data, before)
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise


def check_writable(path: Path) -> None:
    """Check before long work that a result can be written; leave no file.

    Raises OSError.
    """
    is_new = not path.exists()
    path.open("ab").close()
    if is_new:
        path.unlink()


def _status(target: Path) -> os.stat_result | None:
    try:
        return os.stat(target)
    except FileNotFoundError:
        return None


def _replace(target: Path, data: bytes, before: os.stat_result | None) -> None:
    fresh = target.parent / f".rapidgen-{os.urandom(8).hex()}"
    descriptor = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    try:
        with open(descriptor, "wb") as file:
            file.write(data)
        if before is not None:
            fresh.chmod(stat.S_IMODE(before.st_mode))
        fresh.replace(target)
    finally:
        fresh.unlink(missing_ok=True)
