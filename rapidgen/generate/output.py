"""The generated folder: create in memory, compare, write atomically."""

import hashlib
import json
import logging
import os
import shutil
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from rapidgen._json import Json, Members, items
from rapidgen._reading import read_foreign
from rapidgen.diagnostics import DiagnosticError, refusal

_LOG = logging.getLogger("rapidgen.generate")

MANIFEST = "manifest.json"
MAX_COMPARED = 16 * 1024 * 1024


@dataclass(frozen=True, slots=True)
class OutputFile:
    """One file; `path` is relative with `/`. `tasks` are those that load it."""

    path: str
    data: bytes
    kind: str
    tasks: tuple[str, ...] = ()
    lines: tuple[tuple[int, str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Output:
    """Everything that one build writes, in the order of writing; the manifest is last."""

    name: str
    build_id: str
    files: tuple[OutputFile, ...]


@dataclass(frozen=True, slots=True)
class Change:
    """A changed file: `old` is None when new, `new` None when removed."""

    path: str
    old: bytes | None
    new: bytes | None


def manifest_file(files: list[OutputFile], head: Members) -> OutputFile:
    """Return manifest.json for `files`; `head` has the members before the list of files.

    The files are listed in the order in which they must be written, the manifest itself last.
    `lines` maps RAPID lines to template lines: path -> [rapid line, template, template line].
    """
    manifest: Members = {
        **head,
        "files": [
            {
                "path": f.path,
                "sha256": hashlib.sha256(f.data).hexdigest(),
                "size": len(f.data),
                "task": list(f.tasks),
                "kind": f.kind,
            }
            for f in files
        ],
        "lines": {f.path: [list(entry) for entry in f.lines] for f in files if f.lines},
    }
    rows = []
    for key, value in manifest.items():
        if key in ("files", "lines", "groups"):
            rows.append(f'  "{key}": {_rows(value)}')
        else:
            rows.append(f'  "{key}": {json.dumps(value, ensure_ascii=True)}')
    text = "{\n" + ",\n".join(rows) + "\n}\n"
    return OutputFile(MANIFEST, text.encode("ascii"), "manifest")


def _rows(value: Json) -> str:
    """Return a list or an object with one member a line.

    This is easy to read and compare.
    """
    if isinstance(value, dict):
        rows = [
            f"    {json.dumps(k)}: {json.dumps(v, ensure_ascii=True)}" for k, v in value.items()
        ]
        return "{\n" + ",\n".join(rows) + "\n  }" if rows else "{}"
    rows = [f"    {json.dumps(v, ensure_ascii=True)}" for v in items(value)]
    return "[\n" + ",\n".join(rows) + "\n  ]" if rows else "[]"


def compare(output: Output, folder: Path) -> list[Change]:
    """Return what `write` would change in `folder`, which need not exist."""
    new = {f.path: f.data for f in output.files}
    old = _read(folder)
    return [
        Change(path, old.get(path), new.get(path))
        for path in sorted(new.keys() | old.keys())
        if old.get(path) != new.get(path)
    ]


def write(output: Output, folder: Path) -> None:
    """Replace `folder` by the output completely, or not at all.

    Raises DiagnosticError: RG102 (the folder holds other files), RG103 (it cannot be written).
    """
    if folder.exists():
        _refuse_foreign(folder, output)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        # A sibling is on the same file system and can be renamed into place.
        scratch = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    except OSError as fault:
        raise _unwritable(folder, fault) from fault
    try:
        fresh = scratch / "new"
        for file in output.files:
            path = fresh / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(file.data)
        if folder.exists():
            os.rename(folder, scratch / "old")
        os.rename(fresh, folder)
        _LOG.info("%s: %d files, build %s", folder, len(output.files), output.build_id)
    except OSError as fault:
        if not folder.exists() and (scratch / "old").exists():
            os.rename(scratch / "old", folder)
        raise _unwritable(folder, fault) from fault
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _refuse_foreign(folder: Path, output: Output) -> None:
    """Report RG102 if `folder` has files that no build wrote."""
    if not _is_ours(folder):
        raise _foreign(
            f"{folder} was not made by rapidgen and is not empty",
            "name another folder with -o, or remove this one yourself",
        )
    ours = {file.path for file in output.files} | _built(folder)
    others = sorted(
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_symlink() or not path.is_dir()
    )
    others = [path for path in others if path not in ours]
    if others:
        more = f" and {len(others) - 3} more" if len(others) > 3 else ""
        raise _foreign(
            f"{folder} holds files that no build put there: {', '.join(others[:3])}{more}",
            "move them to another place: a build replaces the folder as a whole",
        )


def _built(folder: Path) -> set[str]:
    """Return the files that the manifest lists; none if unreadable."""
    try:
        listed = json.loads(read_foreign(folder / MANIFEST, MAX_COMPARED, below=folder))["files"]
        return {str(entry["path"]) for entry in listed}
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return set()


def _foreign(message: str, help: str) -> DiagnosticError:
    return refusal("RG102", None, message, help)


def _is_ours(folder: Path) -> bool:
    if not folder.is_dir() or folder.is_symlink():
        return False
    return (folder / MANIFEST).is_file() or not any(folder.iterdir())


def _read(folder: Path) -> dict[str, bytes]:
    result = {}
    if folder.is_dir() and _is_ours(folder):
        for path in sorted(folder.rglob("*")):
            with suppress(OSError):  # not a regular file, or not written by a build
                data = read_foreign(path, MAX_COMPARED, below=folder)
                result[path.relative_to(folder).as_posix()] = data
    return result


def _unwritable(folder: Path, fault: OSError) -> DiagnosticError:
    return refusal(
        "RG103",
        None,
        f"cannot write {folder}: {fault.strerror}",
        "what was there before is untouched",
        exit_code=1,
    )
