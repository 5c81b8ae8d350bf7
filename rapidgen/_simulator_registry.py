"""Simulators of this user that run now: what each serves, in a file that it holds locked.

The lock goes with its process, however that ends; a file that nobody holds is of one that ended
without a word. Others on this machine cannot put a file there: the folder is the user's own.
"""

import fcntl
import json
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Simulator:
    """One that runs: `addresses` by group as HOST:MOTION,STATE[,CONTROL]."""

    name: str
    pid: int
    addresses: Mapping[str, str]


def folder() -> str:
    """Where the files lie: below XDG_RUNTIME_DIR, else below the folder for temporary files."""
    base = os.environ.get("XDG_RUNTIME_DIR")
    if base and os.path.isdir(base):
        return os.path.join(base, "rapidgen")
    return os.path.join(tempfile.gettempdir(), f"rapidgen-{os.getuid()}")


@contextmanager
def published(simulator: Simulator) -> Iterator[bool]:
    """Tell of a simulator while the block runs; False: there is no place that is the user's own."""
    own = folder()
    if not _is_own(own, make=True):
        yield False
        return
    path = os.path.join(own, f"sim-{simulator.pid}-{simulator.name.replace(os.sep, '_')}.json")
    text = {
        "name": simulator.name,
        "pid": simulator.pid,
        "addresses": dict(simulator.addresses),
    }
    fresh = os.path.join(own, f"new-{simulator.pid}")
    with open(fresh, "w", encoding="utf-8") as file:
        # Locked and whole before it has its name: one that nobody holds is taken for left behind.
        fcntl.flock(file, fcntl.LOCK_EX)
        json.dump(text, file)
        file.flush()
        os.rename(fresh, path)
        try:
            yield True
        finally:
            os.unlink(path)


def running() -> tuple[list[Simulator], list[str]]:
    """Simulators that run, the oldest first, and the files of those that ended without a word.

    Those files are removed.
    """
    own = folder()
    if not _is_own(own, make=False):
        return [], []
    result, left = [], []
    names = sorted(os.listdir(own), key=lambda name: _made(os.path.join(own, name)))
    for name in names:
        path = os.path.join(own, name)
        if not name.startswith("sim-"):
            continue
        try:
            with open(path, encoding="utf-8") as file:
                if _is_held(file.fileno()):
                    result.append(_read(json.load(file)))
                else:
                    os.unlink(path)
                    left.append(path)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            # It ended, or wrote, this very moment.
            continue
    return result, left


def _read(text: dict[str, object]) -> Simulator:
    addresses = text["addresses"]
    if not isinstance(addresses, dict):
        raise ValueError(addresses)
    return Simulator(
        str(text["name"]),
        int(str(text["pid"])),
        {str(group): str(address) for group, address in addresses.items()},
    )


def _is_held(handle: int) -> bool:
    try:
        fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    return False


def _made(path: str) -> float:
    try:
        return os.stat(path).st_mtime
    except OSError:
        return 0.0


def _is_own(path: str, *, make: bool) -> bool:
    """Whether a folder is this user's, and nobody else may write there."""
    if make:
        try:
            os.mkdir(path, 0o700)
        except FileExistsError:
            pass
        except OSError:
            return False
    try:
        status = os.lstat(path)
    except OSError:
        return False
    mine = stat.S_ISDIR(status.st_mode) and status.st_uid == os.getuid()
    return mine and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
