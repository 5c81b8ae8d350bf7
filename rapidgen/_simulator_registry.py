"""Registry of this user's running simulators, one locked file each.

The lock ends with its process, in whatever way; an unlocked file belongs to a simulator that was
killed. Other users of this machine cannot add a file: the folder is the user's own. A system
without such locks (Windows) has no registry: no simulator is registered, and none is found.
"""

import json
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Simulator:
    """A running simulator.

    `addresses` are HOST:MOTION,STATE[,CONTROL] by group; `web_services` is the address of its Robot
    Web Services and `fingerprint` that of their certificate, both empty without.
    """

    name: str
    pid: int
    addresses: Mapping[str, str]
    web_services: str = ""
    fingerprint: str = ""


def folder() -> str:
    """Return the registry's folder.

    It is below XDG_RUNTIME_DIR, else below the folder for temporary files.
    """
    base = os.environ.get("XDG_RUNTIME_DIR")
    if base and os.path.isdir(base):
        return os.path.join(base, "rapidgen")
    return os.path.join(tempfile.gettempdir(), f"rapidgen-{os.getuid()}")


@contextmanager
def published(simulator: Simulator) -> Iterator[bool]:
    """Register a simulator while the block runs.

    False: this user has no private folder.
    """
    own = folder() if _has_locks() else ""
    if not own or not _is_own(own, make=True):
        yield False
        return
    import fcntl

    path = os.path.join(own, f"sim-{simulator.pid}-{simulator.name.replace(os.sep, '_')}.json")
    text = {
        "name": simulator.name,
        "pid": simulator.pid,
        "addresses": dict(simulator.addresses),
        "web_services": simulator.web_services,
        "fingerprint": simulator.fingerprint,
    }
    fresh = os.path.join(own, f"new-{simulator.pid}")
    with open(fresh, "w", encoding="utf-8") as file:
        # The file is complete and locked before it is renamed: an unlocked one counts as abandoned.
        fcntl.flock(file, fcntl.LOCK_EX)
        json.dump(text, file)
        file.flush()
        os.rename(fresh, path)
        try:
            yield True
        finally:
            os.unlink(path)


def running() -> tuple[list[Simulator], list[str]]:
    """Return running simulators, the oldest first, and abandoned files.

    Those files are removed.
    """
    own = folder() if _has_locks() else ""
    if not own or not _is_own(own, make=False):
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
        str(text.get("web_services", "")),
        str(text.get("fingerprint", "")),
    )


def _has_locks() -> bool:
    from importlib.util import find_spec

    return find_spec("fcntl") is not None


def _is_held(handle: int) -> bool:
    import fcntl

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
    """True if a folder is this user's and no other user may write there."""
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
