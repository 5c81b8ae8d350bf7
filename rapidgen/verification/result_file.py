"""Results of a campaign in a JSON lines file, which a run can resume.

The lines are in the order of the work.
"""

import hashlib
import json
import platform
from functools import cache
from pathlib import Path

import numpy as np

import rapidgen
from rapidgen._compat import Self
from rapidgen._data import data_folder
from rapidgen._json import Json, members, text
from rapidgen.diagnostics import DiagnosticError, refusal


class Results:
    """Known results by key; each new one is written immediately.

    The first line identifies the work. Without a path, results are not saved.
    """

    def __init__(self, path: Path | None, of: str, *, resume: bool = False) -> None:
        """Create a file, or resume one.

        Raises DiagnosticError RG805, OSError.
        """
        self._known: dict[str, Json] = {}
        self._file = None
        if path is None:
            return
        # An incomplete last line does not count.
        data = path.read_bytes() if path.exists() else b""
        complete = data[: data.rfind(b"\n") + 1]
        if complete and not resume:
            help = "go on with them by --resume, or name another file"
            raise _refused(path, "has results already", help)
        if complete:
            self._read(path, complete, of)
        self._file = path.open("r+b" if path.exists() else "wb")
        self._file.truncate(len(complete))
        self._file.seek(len(complete))
        if not complete:
            self._write({"results_of": of})

    def _read(self, path: Path, data: bytes, of: str) -> None:
        try:
            first, *remaining = (members(json.loads(line)) for line in data.splitlines())
            if text(first["results_of"]) != of:
                help = "name another file: the driver or rapidgen itself is not what it was"
                raise _refused(path, "has results of something else", help)
            self._known = {text(row["key"]): row["result"] for row in remaining}
        except (ValueError, TypeError, KeyError) as fault:
            what = "is no file of results"
            raise _refused(path, what, "name another file, or one that does not exist") from fault

    def known(self, key: str) -> Json:
        """Return a known result, or None."""
        return self._known.get(key)

    def add(self, key: str, result: Json) -> None:
        """Save a result unless its key is known."""
        if key not in self._known:
            self._write({"key": key, "result": result})

    def _write(self, row: dict[str, Json]) -> None:
        if self._file is not None:
            self._file.write(json.dumps(row, separators=(",", ":")).encode() + b"\n")
            self._file.flush()

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _refused(path: Path, what: str, help: str) -> DiagnosticError:
    return refusal("RG805", None, f"{path} {what}", help)


# -- identity of a build ---------------------------------------------------------------------------

LEFT_OUT = ("__pycache__", "_data")


@cache
def identity() -> str:
    """Return 16 hexadecimal digits over program text, data and dependencies."""
    digest = hashlib.sha256(f"{platform.python_version()} {np.__version__}".encode())
    package = Path(rapidgen.__file__).parent
    for folder in (package, data_folder("templates"), data_folder("robots")):
        for path in sorted(folder.rglob("*")):
            parts = path.relative_to(folder).parts
            hidden = any(part in LEFT_OUT or part.startswith(".") for part in parts)
            if not hidden and path.is_file():
                data = path.read_bytes()
                digest.update(f"{'/'.join(parts)} {len(data)}\n".encode() + data)
    return digest.hexdigest()[:16]
