"""Data that a run keeps: backups, foreign files, manifest; clean-up."""

from dataclasses import replace
from datetime import datetime, timezone

from rapidgen import __version__
from rapidgen._json import Members
from rapidgen.deploy.cfg import keyed, remember
from rapidgen.deploy.driver_set import DriverSet, SetFile, digest
from rapidgen.deploy.file_operations import FileOperations, delete, delete_folder, names, write
from rapidgen.deploy.plan import Plan
from rapidgen.deploy.state_folder import (
    KEPT,
    FileRecord,
    Manifest,
    StoredSet,
    encode,
    manifest_json,
    read_backup,
)
from rapidgen.deploy.transports.transport import Transport, parent, read_or_none


def back_up(work: FileOperations, number: int) -> None:
    """Back up foreign files for `uninstall`, and the whole current set.

    The set includes local changes.
    """
    plan, had = work.plan, work.plan.had
    if plan.wanted is None:
        return
    for record, data in foreign_files(plan):
        work.say(f"keeping a copy of {record.path}")
        write(work, f"{work.folder}/backup/{record.stored}", data)
    if had is None:
        return
    folder = f"{work.folder}/backup/{number}"
    work.say(f"backup {number}")
    by_path = {c.path: c.before for c in plan.changes if c.kind != "syspar"}
    records = []
    for index, record in enumerate(had.files):
        if record.path in by_path:
            result = by_path[record.path]
        else:
            result = read_or_none(work.transport, work.home + record.path)
        if result is not None:
            name = f"{index}.bin"
            write(work, f"{folder}/{name}", result)
            records.append(replace(record, sha256=digest(result), size=len(result), stored=name))
    retained = replace(had, files=tuple(records), history=())
    write(work, f"{folder}/backup.json", encode(manifest_json(retained)))


def foreign_files(plan: Plan) -> list[tuple[FileRecord, bytes]]:
    """Return foreign files to keep.

    They are replaced, or taken over as equal; cfg files from before our first instance are
    included.
    """
    count = plan.copies
    result: list[tuple[FileRecord, bytes]] = []
    for change in plan.changes:
        if change.foreign and change.before is not None:
            retained = plan.origin.get(change.path)
            if retained is not None and retained.sha256 == digest(change.before):
                continue  # it was restored once, and is unchanged since
            record = FileRecord(
                change.path,
                digest(change.before),
                len(change.before),
                change.kind,
                stored=f"origin/{count + len(result)}.bin",
            )
            result.append((record, change.before))
    return result


def new_manifest(plan: Plan, desired: DriverSet, number: int) -> Manifest:
    """Return the manifest for the end of the run."""
    had = plan.had
    files = tuple(FileRecord(f.path, f.sha256, len(f.data), f.kind, f.tasks) for f in desired.files)
    history = had.history if had else ()
    undone = plan.repair and had is not None and had.files == files
    if had is not None and not undone:
        history = (*history, StoredSet(number, had.time, had.name, had.build_id))[-KEPT:]
    origin = {**plan.origin, **{record.path: record for record, _ in foreign_files(plan)}}
    before: Members = dict(plan.cfg_before)
    if plan.cfg_present:
        before = remember(keyed(desired.cfg), keyed(plan.cfg_present), before, plan.cfg_ours)
    return Manifest(
        number,
        now(),
        desired.name,
        desired.build_id,
        desired.robotware,
        files,
        tuple(origin.values()),
        history,
        before,
        {"written_by": __version__, **desired.generated},
    )


def backup_set(transport: Transport, home: str, number: int) -> DriverSet:
    """Return the set of backup `number`. Raises DiagnosticError RG528."""
    manifest, files = read_backup(transport, home, number)
    return DriverSet(
        manifest.name,
        manifest.build_id,
        manifest.robotware,
        tuple(
            SetFile(r.path, files[r.path], "cfg" if r.kind == "cfg" else "module", r.tasks)
            for r in manifest.files
        ),
        manifest.generated,
    )


def delete_backups(work: FileOperations, *, keep: frozenset[str]) -> None:
    """Delete all backups except those named."""
    folder = f"{work.folder}/backup"
    for name in sorted(names(work.transport, folder) - keep):
        delete_backup(work, name)
    if not keep:
        delete_folder(work, folder)


def delete_backup(work: FileOperations, name: str) -> None:
    """Delete one backup, `backup.json` first: without it the rest is ignored."""
    folder = f"{work.folder}/backup/{name}"
    for member in sorted(names(work.transport, folder), key=lambda n: n != "backup.json"):
        delete(work, f"{folder}/{member}")
    delete_folder(work, folder)


def delete_empty_folders(work: FileOperations) -> None:
    """Delete folders of removed files that are empty, the deepest first.

    Never HOME or SYSPAR. An interrupted run may have deleted the files already: the sets before and
    after it list them.
    """
    journal = work.plan.state.journal
    sets = [work.plan.had, *((journal.old, journal.new) if journal else ())]
    paths = [c.where for c in work.plan.changes if c.kind != "syspar"]
    paths += [work.home + record.path for known in filter(None, sets) for record in known.files]
    folders: set[str] = set()
    for path in paths:
        place = parent(path)
        while place and place + "/" != work.home:
            folders.add(place)
            place = parent(place)
    for folder in sorted(folders, key=len, reverse=True):
        delete_folder(work, folder)


def now() -> str:
    """Return UTC, to the second."""
    return datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
