"""A generated folder: manifest.json, SYS.cfg, EIO.cfg and HOME (docs/develop/architecture.md)."""

import hashlib
import json
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen._json import Json, Members, items, members, text, whole
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, refusal
from rapidgen.system.adding import Addition, add
from rapidgen.system.backup import backup_cfg, read_backup
from rapidgen.system.base import Robot, base_system
from rapidgen.system.cfg import parse_cfg
from rapidgen.system.controller_cfg import ControllerCfg
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


def read_folder(
    folder: Path | str,
    backup: Path | str | None = None,
    *,
    without: Collection[str] = (),
    open_words: bool = False,
    notes: list[Diagnostic] | None = None,
) -> System:
    """The controller that a generated folder makes: its cfg files loaded onto a delivered
    controller of its release, or onto the one of `backup`. An edited module is taken as it is.

    `without` names cfg files that are not loaded; one that the manifest calls optional may be
    refused, which `notes` tell. `open_words`: as `adding.add`.

    Raises DiagnosticError: RG701..RG711 for a folder that is damaged or hostile, RG712 for a
    backup that is none, RG720..RG723 for a cfg file that no controller loads.
    """
    folder = Path(folder)
    manifest = read_manifest(folder)
    collected: list[Diagnostic] = [] if notes is None else notes
    under, base = _under(manifest, backup, collected)
    given = files = _additions(folder, manifest, without)
    if any(task.motion for text in given for task in tasks_of(text.file)):
        # A folder that describes its motion tasks itself is a whole controller.
        under, base = System("", ()), _bare(base, given)
        given = ()
    loaded = add(base, given, open_words=open_words)
    if loaded.faults:
        raise DiagnosticError(loaded.faults)
    collected += loaded.notes
    home = inside(folder, "HOME")
    origins = _origins(folder, manifest)
    own = [text.file for text in files if text.file.domain == "SYS"]
    entries = tuple(entry for text in own for entry in modules_of(text))
    sys_path = own[0].path if own else ""
    there = {task.name.casefold(): task.modules for task in under.tasks}
    sys, eio = loaded.cfg.domain("SYS"), loaded.cfg.domain("EIO")
    tasks = []
    for task in tasks_of(sys):
        before = there.get(task.name.casefold(), ())
        modules = load_entries(task, entries, home, before, sys_path, None, origins)
        tasks.append(replace(task, modules=modules))
    return System(
        name=text(manifest["name"]),
        tasks=tuple(tasks),
        signals=signals_of(eio),
        outputs=outputs_of(eio, sys),
        inputs=inputs_of(eio, sys),
        cross=crosses_of(eio),
        events=events_of(sys),
        groups=groups_of(sys),
        robotware=base.robotware,
        home=home,
        build_id=text(manifest["build_id"]),
    )


def _bare(base: ControllerCfg, given: Collection[Addition]) -> ControllerCfg:
    cfg = ControllerCfg(base.robotware, ())
    for addition in given:
        cfg = cfg.plus(addition.file)
    return cfg


def _under(
    manifest: Members, backup: Path | str | None, notes: list[Diagnostic]
) -> tuple[System, ControllerCfg]:
    """What the folder is loaded onto, as a system and as cfg."""
    if backup is not None:
        system = read_backup(backup, notes=notes)
        return system, backup_cfg(Path(backup), system.robotware, notes)
    base = delivered(manifest)
    return System("", tasks_of(base.domain("SYS"))), base


def delivered(manifest: Members) -> ControllerCfg:
    """A controller as it is delivered, for what a manifest tells of it.

    Raises DiagnosticError RG711.
    """
    try:
        configuration = members(manifest["configuration"])
        robots = []
        for group in map(members, items(configuration["groups"])):
            further = [text(unit) for unit in items(group["external_units"])]
            further += [text(members(one)["unit"]) for one in items(group.get("positioners") or [])]
            unit = text(group["mechanical_unit"])
            robots.append(Robot(text(group["task"]), unit, tuple(dict.fromkeys(further))))
        header = {
            text(domain): (whole(major), whole(minor))
            for domain, major, minor in map(items, items(configuration.get("cfg_header") or []))
        }
        major, minor = map(whole, items(manifest["robotware"]))
        multimove = bool(configuration.get("multimove"))
        return base_system((major, minor), robots, multimove=multimove, digits=header)
    except (KeyError, TypeError, ValueError) as fault:
        label = "its 'configuration' does not tell the robots"
        raise _bad(Path(MANIFEST), label) from fault


def _additions(folder: Path, manifest: Members, without: Collection[str]) -> tuple[Addition, ...]:
    """The folder's cfg files in the order of the manifest."""
    optional = {str(name) for name in items(manifest.get("optional") or [])}
    found = []
    for entry in items(manifest["files"]):
        name = text(entry["path"]) if isinstance(entry, dict) and entry["kind"] == "cfg" else ""
        if not name or name in without:
            continue
        path = inside(folder, name)
        data = read_limited(path)
        file = parse_cfg(data, path=str(path))
        # Services of the firewall exist on a delivered controller: they are set, not added.
        found.append(Addition(file, name in optional, file.domain == "SIO", data.isascii()))
    return tuple(found)


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
