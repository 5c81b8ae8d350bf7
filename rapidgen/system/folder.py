"""A generated folder: manifest.json, SYS.cfg, EIO.cfg and HOME (docs/develop/architecture.md)."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen._json import Json, Members, items, members, text, whole
from rapidgen.diagnostics import DiagnosticError, Span, refusal
from rapidgen.system.cfg import CfgText, parse_cfg
from rapidgen.system.interpret import (
    crosses_of,
    events_of,
    groups_of,
    inputs_of,
    modules_of,
    outputs_of,
    signals_of,
    tasks_of,
)
from rapidgen.system.loading import Origin, load_entries
from rapidgen.system.model import System
from rapidgen.system.paths import inside, read_limited

MANIFEST = "manifest.json"
FORMAT = 1


def read_manifest(folder: Path) -> Members:
    """manifest.json of a generated folder.

    Raises DiagnosticError: RG704 (no such file), RG711 (not a manifest, or of a later format).
    """
    path = inside(folder, MANIFEST)
    try:
        manifest: Json = json.loads(read_limited(path))
    except (ValueError, RecursionError) as fault:
        raise _bad(path, f"it is not JSON: {fault}") from fault
    if not isinstance(manifest, dict) or not isinstance(manifest.get("format"), int):
        raise _bad(path, "it has no format number")
    if manifest["format"] != FORMAT:
        raise _bad(path, f"its format is {manifest['format']}, this rapidgen reads {FORMAT}")
    ware = manifest.get("robotware")
    if not (isinstance(ware, list) and len(ware) == 2 and all(isinstance(n, int) for n in ware)):
        raise _bad(path, "'robotware' is not a pair of numbers")
    for key, kind in (("name", str), ("build_id", str), ("files", list), ("lines", dict)):
        if not isinstance(manifest.get(key), kind):
            raise _bad(path, f"'{key}' is missing or has the wrong type")
    return manifest


def read_folder(folder: Path | str) -> System:
    """The system that a generated folder describes; an edited module is taken as it is.

    Raises DiagnosticError RG701..RG711 for a folder that is damaged or hostile.
    """
    folder = Path(folder)
    manifest = read_manifest(folder)
    sys_cfg = _cfg(folder, "SYS.cfg")
    eio_cfg = _cfg(folder, "EIO.cfg")
    home = inside(folder, "HOME")
    origins = _origins(folder, manifest)
    entries = modules_of(sys_cfg)
    tasks = tuple(
        replace(task, modules=load_entries(task, entries, home, (), sys_cfg.path, None, origins))
        for task in tasks_of(sys_cfg)
    )
    major, minor = map(whole, items(manifest["robotware"]))
    return System(
        name=text(manifest["name"]),
        tasks=tasks,
        signals=signals_of(eio_cfg),
        outputs=outputs_of(eio_cfg),
        inputs=inputs_of(eio_cfg),
        cross=crosses_of(eio_cfg),
        events=events_of(sys_cfg),
        groups=groups_of(sys_cfg),
        robotware=(major, minor),
        home=home,
        build_id=text(manifest["build_id"]),
    )


def _cfg(folder: Path, name: str) -> CfgText:
    path = inside(folder, name)
    return parse_cfg(read_limited(path), path=str(path))


def _origins(folder: Path, manifest: Members) -> dict[str, Origin]:
    """Line maps by file name; a file that was edited since has none that could be trusted."""
    digests = {
        entry.get("path"): entry.get("sha256")
        for entry in items(manifest["files"])
        if isinstance(entry, dict)
    }
    origins: dict[str, Origin] = {}
    for relative, lines in members(manifest["lines"]).items():
        path = inside(folder, relative)
        if not path.is_file() or not isinstance(lines, list):
            continue
        data = read_limited(path)
        if hashlib.sha256(data).hexdigest() != digests.get(relative):
            continue
        try:
            runs = [(whole(a), text(b), whole(c)) for a, b, c in map(items, lines)]
            origins[relative] = expand_lines(runs, data.count(b"\n"))
        except (TypeError, ValueError) as fault:
            raise _bad(folder / MANIFEST, f"the line map of {relative} is damaged") from fault
    return origins


def expand_lines(runs: Sequence[tuple[int, str, int]], count: int) -> Origin:
    """One entry a line; the manifest names only the first line of each run."""
    ends = [line for line, _, _ in runs[1:]] + [count + 1]
    return tuple(
        (line, template, start + line - first)
        for (first, template, start), end in zip(runs, ends, strict=True)
        for line in range(first, end)
    )


def _bad(path: Path, label: str) -> DiagnosticError:
    return refusal(
        "RG711",
        Span(str(path), 1, 1),
        "manifest.json is not one that rapidgen wrote",
        "build the folder again with 'rapidgen build'",
        label=label,
    )


def is_generated(folder: Path) -> bool:
    """Whether `folder` looks like one that `rapidgen build` wrote."""
    return (folder / MANIFEST).is_file()
