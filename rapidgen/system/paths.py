"""Read untrusted folders: no file outside, no endless file."""

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from rapidgen._reading import NotRegular, OutsideFolder, TooLarge, read_foreign
from rapidgen.diagnostics import refusal

MAX_FILE = 8 * 1024 * 1024
MAX_FILES = 20_000
MODULE_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")


def read_limited(path: Path, *, below: Path | None = None) -> bytes:
    """Return a regular file's bytes.

    `below`: the folder that must contain it, links followed. Raises DiagnosticError: RG704 (cannot
    be read), RG705 (too large or not a regular file), RG706 (a link that leaves the folder).
    """
    try:
        return read_foreign(path, MAX_FILE, below=below)
    except (NotRegular, TooLarge) as fault:
        raise refusal(
            "RG705",
            None,
            f"{path} is not a regular file of at most {MAX_FILE // 2**20} MB",
            "a RAPID module or cfg file is far smaller: is it the right file?",
        ) from fault
    except OutsideFolder as fault:
        raise refusal(
            "RG706",
            None,
            f"'{path}' is a link that leaves {below}",
            "files of a system lie inside its own folder",
        ) from fault
    except OSError as fault:
        help = "give the path of a file or folder that exists and may be read"
        raise refusal("RG704", None, f"cannot read {path}: {fault.strerror}", help) from fault


def is_there(path: Path) -> bool:
    """True for a file, or for a pipe or device, which `read_limited` rejects."""
    return os.path.exists(path) and not os.path.isdir(path)


def inside(root: Path, relative: str) -> Path:
    """Return the file `relative` under `root`, found without case.

    The separator is `/` or `\\`. Raises DiagnosticError RG706 when the path leaves `root`, also
    through a symbolic link. The file need not exist.
    """
    parts = PurePosixPath(relative.replace("\\", "/")).parts
    if any(part in ("..", "/") or ":" in part or "\0" in part for part in parts):
        raise refusal(
            "RG706",
            None,
            f"the path '{relative}' leaves {root}",
            "files of a system lie inside its own folder",
        )
    path = root
    for part in parts:
        path = _entry(path, part)
    # A loop of links has no target; reading it reports that.
    if not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(root)):
        raise refusal(
            "RG706",
            None,
            f"'{relative}' is a link that leaves {root}",
            "files of a system lie inside its own folder",
        )
    return path


def home_file(home: Path, target: str) -> Path:
    """Return the file of `HOME:/x` (or `HOME:x`) in the folder for HOME:."""
    head, _, remaining = target.partition(":")
    if head.strip().upper() != "HOME" or not remaining:
        raise refusal(
            "RG707",
            None,
            f"'{target}' does not lie on HOME:",
            "only files of HOME: can be read from a folder",
        )
    return inside(home, remaining.lstrip("/\\"))


def module_files(folder: Path) -> Iterator[Path]:
    """Yield the module files of a folder, sorted without case.

    macOS leaves a ._NAME next to a file that it copies, which is no module. Raises DiagnosticError:
    RG705 (too many entries), RG706 (a link that leaves the folder).
    """
    if not folder.is_dir():
        return
    names = sorted(os.listdir(folder), key=str.casefold)
    if len(names) > MAX_FILES:
        raise refusal("RG705", None, f"{folder} holds more than {MAX_FILES} files")
    for name in names:
        if name.casefold().endswith(MODULE_SUFFIXES) and not name.startswith("._"):
            yield inside(folder, name)


def _entry(folder: Path, name: str) -> Path:
    """Return `name` in `folder`, found without case.

    Controllers compare names without case, most file systems do not.
    """
    exact = folder / name
    # Not Path.exists: it raises for a name that is too long.
    if not os.path.exists(exact) and folder.is_dir():
        for entry in os.listdir(folder):
            if entry.casefold() == name.casefold():
                return folder / entry
    return exact
