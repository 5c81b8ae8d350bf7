"""Results of a campaign in a file, JSON lines in the order of the work: it can go on there."""

import json
from pathlib import Path

from rapidgen._compat import Self
from rapidgen._json import Json, members, text
from rapidgen.diagnostics import DiagnosticError, refusal


class Results:
    """What is known already, by key; what is added is in the file at once.

    The first line says what the results are of. Without a path everything is forgotten.
    """

    def __init__(self, path: Path | None, of: str, *, resume: bool = False) -> None:
        """Begin a file, or go on with it. Raises DiagnosticError RG805, OSError."""
        self._known: dict[str, Json] = {}
        self._file = None
        if path is None:
            return
        # A line that was not written to its end is as good as none.
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
        """A result that is there already; None: it is not."""
        return self._known.get(key)

    def add(self, key: str, result: Json) -> None:
        """Keep a result, unless it is there."""
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
