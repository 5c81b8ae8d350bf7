"""Generated folder: manifest.json, SYS.cfg, EIO.cfg and HOME.

See docs/reference/driver.md.
"""

import hashlib
import json
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen._json import Json, Members, items, members, text, whole
from rapidgen.diagnostics import Diagnostic
from rapidgen.system.backup import backup_cfg, read_backup
from rapidgen.system.build_loading import (
    BaseController,
    additions,
    bad_manifest,
    delivered,
    of_backup,
    onto,
)
from rapidgen.system.cfg_reader import ModuleEntry
from rapidgen.system.loading import Origin, load_entries
from rapidgen.system.model import ModuleFile, System, TaskSpec
from rapidgen.system.paths import inside, is_there, read_limited

MANIFEST = "manifest.json"
FORMAT = 1


def read_manifest(folder: Path) -> Members:
    """Read manifest.json of a generated folder.

    Raises DiagnosticError: RG704 (no such file), RG711 (not a manifest, or of a later format).
    """
    path = inside(folder, MANIFEST)
    try:
        manifest: Json = json.loads(read_limited(path))
    except (ValueError, RecursionError) as fault:
        raise bad_manifest(path, f"it is not JSON: {fault}") from fault
    if not isinstance(manifest, dict) or not isinstance(manifest.get("format"), int):
        raise bad_manifest(path, "it has no format number")
    if manifest["format"] != FORMAT:
        raise bad_manifest(
            path, f"its format is {manifest['format']}, this rapidgen reads {FORMAT}"
        )
    ware = manifest.get("robotware")
    if not (isinstance(ware, list) and len(ware) == 2 and all(isinstance(n, int) for n in ware)):
        raise bad_manifest(path, "'robotware' is not a pair of numbers")
    for key, kind in (("name", str), ("build_id", str), ("files", list), ("lines", dict)):
        if not isinstance(manifest.get(key), kind):
            raise bad_manifest(path, f"'{key}' is missing or has the wrong type")
    return manifest


def read_folder(
    folder: Path | str,
    backup: Path | str | None = None,
    *,
    without: Collection[str] = (),
    open_words: bool = True,
    notes: list[Diagnostic] | None = None,
) -> System:
    """Return the controller of a generated folder.

    Its cfg files are loaded onto a delivered controller of its release, or onto the one of
    `backup`. An edited module is taken as it is.

    `without` names cfg files that are not loaded; one that the manifest calls optional may be
    rejected, which `notes` report. `open_words`: as `cfg_loading.add`.

    Raises DiagnosticError: RG701..RG711 for a folder that is damaged or hostile, RG712 for an
    invalid backup, RG720..RG723 for a cfg file that a controller rejects.
    """
    folder = Path(folder)
    manifest = read_manifest(folder)
    collected: list[Diagnostic] = [] if notes is None else notes
    home = inside(folder, "HOME")
    origins = _origins(folder, manifest)

    def load(
        task: TaskSpec, entries: tuple[ModuleEntry, ...], cfg_path: str
    ) -> tuple[ModuleFile, ...]:
        return load_entries(task, entries, home, task.modules, cfg_path, None, origins)

    paths = {
        text(entry["path"]): inside(folder, text(entry["path"]))
        for entry in map(members, items(manifest["files"]))
        if entry["kind"] == "cfg"
    }
    texts = {path: read_limited(place) for path, place in paths.items()}
    source = additions(manifest, texts, without, folder)
    system = onto(
        _under(manifest, backup, collected), source, load, open_words=open_words, notes=collected
    )
    return replace(
        system,
        name=text(manifest["name"]),
        build_id=text(manifest["build_id"]),
        home=home,
        home_below=system.home,
    )


def _under(manifest: Members, backup: Path | str | None, notes: list[Diagnostic]) -> BaseController:
    if backup is None:
        return delivered(manifest)
    system = read_backup(backup, notes=notes)
    return of_backup(backup_cfg(Path(backup), system.robotware, notes), system)


def _origins(folder: Path, manifest: Members) -> dict[str, Origin]:
    """Return line maps by file name; none for an edited file."""
    digests = {
        entry.get("path"): entry.get("sha256")
        for entry in items(manifest["files"])
        if isinstance(entry, dict)
    }
    origins: dict[str, Origin] = {}
    for relative, lines in members(manifest["lines"]).items():
        path = inside(folder, relative)
        if not is_there(path) or not isinstance(lines, list):
            continue
        data = read_limited(path)
        if hashlib.sha256(data).hexdigest() != digests.get(relative):
            continue
        try:
            runs = [(whole(a), text(b), whole(c)) for a, b, c in map(items, lines)]
            origins[relative] = expand_lines(runs, data.count(b"\n"))
        except (TypeError, ValueError) as fault:
            raise bad_manifest(
                folder / MANIFEST, f"the line map of {relative} is damaged"
            ) from fault
    return origins


def expand_lines(runs: Sequence[tuple[int, str, int]], count: int) -> Origin:
    """Return one entry a line; the manifest has one for each run."""
    ends = [line for line, _, _ in runs[1:]] + [count + 1]
    return tuple(
        (line, template, start + line - first)
        for (first, template, start), end in zip(runs, ends, strict=True)
        for line in range(first, end)
    )


def is_generated(folder: Path) -> bool:
    """True if `folder` looks like one that `rapidgen build` wrote."""
    return is_there(folder / MANIFEST)
