"""Set of files for a controller, made from a generated folder."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from rapidgen._json import Json, items
from rapidgen._reading import read_foreign
from rapidgen.deploy.transports.transport import FILE_LIMIT, TransportFault, safe
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.system import CfgText, parse_cfg, read_manifest
from rapidgen.system.paths import read_limited

Kind = Literal["module", "cfg"]

STATE = "rapidgen_deploy"
"""Folder in HOME for a deployment (no dot: some FTP servers hide those)."""

NEW, FENCE = ".rg-new", ".rg-fence"
"""Suffixes of staged files."""

INCOMPLETE = b"incomplete--"
"""Placeholder of BUILD_ID in a fence: as long, and different from all."""


@dataclass(frozen=True, slots=True)
class SetFile:
    """One file for the controller; `path` is relative to HOME."""

    path: str
    data: bytes
    kind: Kind
    tasks: tuple[str, ...] = ()

    @property
    def sha256(self) -> str:
        return digest(self.data)


@dataclass(frozen=True, slots=True)
class DriverSet:
    """A complete driver: modules and cfg files, in the order of writing."""

    name: str
    build_id: str
    robotware: tuple[int, int]
    files: tuple[SetFile, ...]
    generated: Mapping[str, Json] = field(default_factory=dict)
    """manifest.json of the generated folder without its line map."""

    @property
    def cfg(self) -> tuple[CfgText, ...]:
        """The cfg files, parsed. Raises DiagnosticError RG701, RG702."""
        return tuple(parse_cfg(f.data, path=f.path) for f in self.files if f.kind == "cfg")

    def blocking_modules(self) -> dict[str, bytes]:
        """Return modules that make every motion group refuse to move.

        They are the smallest set that reaches every task, with a BUILD_ID that differs from all
        others: ROS_common compares them when a task starts. Path to bytes.
        """
        chosen: dict[str, bytes] = {}
        reached: set[str] = set()
        modules = [f for f in self.files if f.kind == "module" and self.build_id.encode() in f.data]
        for file in sorted(modules, key=lambda f: (-len(f.tasks), f.path)):
            if not set(file.tasks) <= reached:
                reached |= set(file.tasks)
                chosen[file.path] = file.data.replace(self.build_id.encode(), INCOMPLETE)
        return chosen


def digest(data: bytes) -> str:
    """Return sha256 in hex."""
    return hashlib.sha256(data).hexdigest()


def from_files(files: Mapping[str, bytes], *, source: str = "the build") -> DriverSet:
    """Return the set of a generated folder's files.

    Keys are as in manifest.json, which is included. Raises DiagnosticError RG530 if files and
    manifest do not belong together.
    """
    try:
        manifest = json.loads(files["manifest.json"])
        desired = []
        for entry in manifest["files"]:
            path, kind = str(entry["path"]), str(entry["kind"])
            if kind not in ("module", "cfg"):
                continue
            data = files[path]
            if digest(data) != entry["sha256"]:
                raise _bad(f"{path} of {source} does not match its manifest", "build it again")
            where = path.removeprefix("HOME/") if kind == "module" else f"{STATE}/{path}"
            tasks = tuple(str(task) for task in entry.get("task") or ())
            desired.append(
                SetFile(safe(where), data, "module" if kind == "module" else "cfg", tasks)
            )
        first, second = manifest["robotware"]
        result = DriverSet(
            str(manifest["name"]),
            str(manifest["build_id"]),
            (int(first), int(second)),
            tuple(desired),
            {key: value for key, value in manifest.items() if key != "lines"},
        )
    except TransportFault as fault:
        raise _bad(fault.diagnostics[0].message, "module paths stay inside HOME") from None
    except (KeyError, TypeError, ValueError, RecursionError) as cause:
        raise _bad(f"the manifest of {source} is damaged: {cause!r}", "build it again") from None
    uncovered = {t for f in desired for t in f.tasks} - {
        t for f in desired if f.path in result.blocking_modules() for t in f.tasks
    }
    if uncovered or not result.build_id:
        raise _bad(
            f"no module of {', '.join(sorted(uncovered)) or 'the driver'} carries BUILD_ID",
            "build it with this rapidgen: a deployment that is cut must leave modules that refuse",
        )
    return result


def from_folder(folder: Path) -> DriverSet:
    """Return the set of a generated folder.

    Raises DiagnosticError RG530, RG704, RG711.
    """
    manifest = read_manifest(folder)
    files = {"manifest.json": read_limited(folder / "manifest.json", below=folder)}
    for entry in items(manifest["files"]):
        path = str(entry.get("path")) if isinstance(entry, dict) else ""
        try:
            files[path] = read_foreign(folder / safe(path), FILE_LIMIT, below=folder)
        except TransportFault as fault:
            raise _bad(fault.diagnostics[0].message, "build it again") from None
        except OSError as cause:
            raise _bad(f"{path} of {folder}: {cause.strerror}", "build it again") from cause
    return from_files(files, source=str(folder))


def _bad(message: str, help: str) -> DiagnosticError:
    return refusal("RG530", None, message, help)
