"""Execution of a plan, safe against interruption.

An interruption at any point leaves the old set, the new set, or a state that the driver rejects.
Order: journal, backup, every new file written next to its old one and read back; then the mark
`switching`, the fence (a module of each task with a BUILD_ID that no other has, so that the driver
accepts no trajectory), the files, the fence's own files, everything read back once more, the
manifest, and last the journal's end. Before `switching` exists, no old file is changed.
"""

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import replace

from rapidgen.deploy.driver_set import FENCE, NEW, DriverSet, SetFile, digest
from rapidgen.deploy.file_operations import (
    FileOperations,
    Say,
    check_not_interrupted,
    delete,
    delete_all,
    delete_folder,
    differs,
    names,
    probe,
    swap,
    write,
)
from rapidgen.deploy.online.apply import (
    OnlineOptions,
    OnlineRun,
    after_files,
    before_files,
    check,
    writing,
)
from rapidgen.deploy.online.plan import MemoryModule
from rapidgen.deploy.other_driver import OtherDriver
from rapidgen.deploy.plan import DAMAGED, FileChange, Plan
from rapidgen.deploy.planner import make_plan
from rapidgen.deploy.retention import (
    back_up,
    delete_backup,
    delete_backups,
    delete_empty_folders,
    new_manifest,
    now,
)
from rapidgen.deploy.state_folder import Journal, encode, journal_json, manifest_json
from rapidgen.deploy.transports.transport import Transport, TransportFault, read_or_none, refused
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error


def apply(
    transport: Transport,
    plan: Plan,
    *,
    overwrite: bool = False,
    live: OnlineOptions | None = None,
    say: Say = lambda _: None,
    given_up: Callable[[], bool] = lambda: False,
) -> None:
    """Execute exactly what `plan` says; do nothing if it is empty.

    `live` is for web services. `given_up` is checked until files are switched: then the controller
    stays as it was (RG545).

    Raises DiagnosticError: RG520, RG521, RG528, RG531, RG534, RG535, RG537, RG541 (conflicts),
    RG522, RG540 (the controller changed, or is another one), RG527, RG543 (interrupted), RG542
    (wrong state), RG544 (not what was deployed); TransportFault before that: then no old file was
    changed.
    """
    conflicts = conflicts_of(plan, overwrite=overwrite)
    if conflicts:
        raise DiagnosticError(conflicts, exit_code=1)
    run = None
    if transport.services is not None and plan.live is not None:
        work = FileOperations(transport, plan, "none", say, given_up=given_up)
        run = OnlineRun(transport.services, work, plan.live, live or OnlineOptions())
        check(run)
    now_there = make_plan(transport, plan.wanted, verb=plan.verb, loaded=plan.cfg_present)
    if now_there.fingerprint != plan.fingerprint:
        raise moved_on(plan.target)
    if run is not None:
        before_files(run)
    if not plan.files_match:
        with writing(run) if run is not None else nullcontext():
            _apply_files(transport, plan, say, given_up)
    if run is not None:
        after_files(run)


def _apply_files(transport: Transport, plan: Plan, say: Say, given_up: Callable[[], bool]) -> None:
    work = replace(_begin(transport, plan, say), given_up=given_up)
    if plan.interrupted:
        _clean(work)
    if not plan.repair and not plan.is_stale and all(c.action == "same" for c in plan.changes):
        _finish(work, None)
        return
    journal = _prepare(work)
    try:
        _hold(work, journal)
    except TransportFault:
        # Another run may use files of the same names until it ends.
        if not names(transport, work.folder) & {"journal.a", "journal.b", "switching"}:
            delete_all(work, journal.staged)
        raise
    try:
        write(work, f"{work.folder}/switching", b"old files are being replaced: see the journal\n")
        _switch(work)
        _verify(work)
        _hold(work, journal)
        _finish(work, journal)
    except TransportFault as fault:
        raise _cut(plan, fault) from fault


def conflicts_of(plan: Plan, *, overwrite: bool = False) -> list[Diagnostic]:
    """Return all conflicts of a plan.

    `overwrite` resolves only RG520, RG521, RG528 and RG531.
    """
    findings = [] if overwrite else [_conflict(change) for change in plan.conflicts]
    if plan.damaged and not overwrite:
        findings.insert(0, error("RG531", None, plan.damaged, DAMAGED))
    if plan.neighbour is not None:
        findings.append(_other_driver_error(plan, plan.neighbour))
    if plan.in_memory:
        findings.append(
            error(
                "RG537",
                None,
                f"{plan.target} is a backup that holds {len(plan.in_memory)} modules with names of "
                "ours as its programs: it would restore those",
                "delete them from the backup (its HOME and SYSPAR load ours), or deploy to HOME of "
                "the controller itself",
                notes=plan.in_memory,
            )
        )
    if plan.live is not None and plan.live.clash and not overwrite:
        findings += [_in_the_way(module) for module in plan.live.clash]
    findings += [
        error(
            "RG535",
            None,
            f"{change.key.partition(' ')[2]} is {change.note}",
            "rename the signal on the controller, or in the files that use it",
        )
        for change in plan.cfg
        if change.action == "clash"
    ]
    return findings


def _in_the_way(module: MemoryModule) -> Diagnostic:
    return error(
        "RG541",
        None,
        f"{module.shown} is loaded, and {module.why}",
        "unload it, or --overwrite: it is saved with its persistents, and `rapidgen uninstall` "
        "loads it again",
    )


def _other_driver_error(plan: Plan, other: OtherDriver) -> Diagnostic:
    help = "its modules have names of ours, and both serve the same ports: " + "; ".join(
        f"({n}) {step.what}" for n, step in enumerate(plan.steps, 1)
    )
    if other.instances:
        return error(
            "RG534",
            None,
            f"another driver is loaded on {plan.target}, abb_driver or an earlier one",
            help,
            notes=tuple(f"{n.domain}: {n.shown}" for n in other.instances),
        )
    return error(
        "RG534",
        None,
        f"another driver is in {plan.target}, and loaded cfg is not visible",
        "if it is not loaded, show it with a backup of the controller: --backup FOLDER; else "
        + help,
        notes=tuple(f"HOME:/{path}" for path in other.files),
    )


def moved_on(target: str) -> DiagnosticError:
    """Return RG522."""
    return refused(
        "RG522",
        f"{target} has changed since it was planned",
        "plan again, and look at what has changed",
    )


def _begin(transport: Transport, plan: Plan, say: Say) -> FileOperations:
    """Create the state folder; check rename and free disk space."""
    folder = FileOperations(transport, plan, "none", say).folder
    try:
        transport.make_folder(folder)
        work = FileOperations(transport, plan, probe(transport, folder), say, {folder})
        needed = sum(len(c.before or b"") + 2 * len(c.after or b"") for c in plan.changes)
        free = transport.free()
        if free is not None and free < needed:
            raise TransportFault("full", f"{plan.target}: {free} bytes free, {needed} needed")
    except TransportFault as fault:
        if fault.kind not in ("lost", "garbled") and not plan.state.present:
            delete_folder(FileOperations(transport, plan, "none", say), folder)
        raise
    return work


def _prepare(work: FileOperations) -> Journal:
    """Write journal, backup and staged files; remove all on a refusal."""
    plan, old = work.plan, work.plan.state.journal
    number = old.id if old and plan.repair else 1 + (plan.had.id if plan.had else 0)
    known = {p: set(hashes) for p, hashes in (old.known if old and plan.repair else {}).items()}
    fences = _fences(work)
    staged: dict[str, bytes] = {}
    for change in plan.changes:
        fence = fences.get(change.path) if change.kind != "syspar" else None
        if fence is not None:
            staged[change.where + FENCE] = fence
        if change.after is not None and (fence is not None or change.action != "same"):
            staged[change.where + NEW] = change.after
        if change.kind != "syspar":
            contents = [d for d in (change.before, change.after, fence) if d is not None]
            known.setdefault(change.path, set()).update(map(digest, contents))
    journal = Journal(
        number,
        1 + (old.attempt if old else 0),
        plan.verb,
        now(),
        plan.had,
        new_manifest(plan, plan.wanted, number) if plan.wanted else None,
        {path: tuple(sorted(hashes)) for path, hashes in known.items()},
        tuple(staged),
    )
    _write_journal(work, journal)
    # Only now, as the new journal knows the contents that explain the old staged files.
    delete_all(work, (path for path in (old.staged if old else ()) if path not in staged))
    try:
        if not plan.repair:
            back_up(work, number)
        for path, data in staged.items():
            check_not_interrupted(work)
            write(work, path, data)
        check_not_interrupted(work)
    except TransportFault as fault:
        if not plan.repair and fault.kind not in ("lost", "garbled"):
            _undo_preparation(work, journal)
        raise
    return journal


def _switch(work: FileOperations) -> None:
    """Put the fence in, remove the old set's key modules, switch, remove it."""
    plan = work.plan
    fences = _fences(work)
    fenced = [c for c in plan.changes if c.path in fences and c.kind != "syspar"]
    for change in fenced:
        if change.before != fences[change.path]:
            exists = change.before is not None
            swap(work, change.where, FENCE, fences[change.path], exists=exists)
    first = _old_fences(plan)
    gone = [c for c in plan.changes if c.after is None and c.before is not None]
    for change in sorted(gone, key=lambda c: c.path not in first):
        work.say(f"removing {change.shown}")
        delete(work, change.where)
    remaining = [c for c in plan.changes if c.after is not None and c.action != "same"]
    remaining = [c for c in remaining if c not in fenced]
    # SYSPAR before the cfg file that lists our instances in it.
    for change in sorted(remaining, key=lambda c: c.kind != "syspar"):
        work.say(f"switching {change.shown}")
        swap(work, change.where, NEW, change.after or b"", exists=change.before is not None)
    for change in fenced:
        work.say(f"switching {change.shown}")
        swap(work, change.where, NEW, change.after or b"", exists=True)


def _fences(work: FileOperations) -> dict[str, bytes]:
    """Return fences of the new set; none if the switch is one atomic rename."""
    steps = [c for c in work.plan.changes if c.action != "same" and c.kind != "cfg"]
    if work.plan.wanted is None or not steps or (work.mode == "replace" and len(steps) == 1):
        return {}
    return work.plan.wanted.blocking_modules()


def _old_fences(plan: Plan) -> frozenset[str]:
    """Return modules without which no task of the old set loads.

    They are removed first.
    """
    if plan.had is None:
        return frozenset()
    files = [
        SetFile(c.path, c.before, "module", c.tasks)
        for c in plan.changes
        if c.kind == "module" and c.before is not None
    ]
    old = DriverSet(plan.had.name, plan.had.build_id, plan.had.robotware, tuple(files))
    return frozenset(old.blocking_modules())


def _verify(work: FileOperations) -> None:
    """Read all files back once more, in place."""
    for change in work.plan.changes:
        if read_or_none(work.transport, change.where) != change.after:
            raise differs(change.shown)


def _finish(work: FileOperations, journal: Journal | None) -> None:
    """Write the manifest, then end the journal.

    Without a journal only the notes are cleared.
    """
    folder = work.folder
    present = names(work.transport, folder)
    if journal is not None and journal.new is not None:
        data = encode(manifest_json(journal.new))
        path = f"{folder}/manifest.json"
        if work.mode != "none":
            write(work, path + NEW, data)
        swap(work, path, NEW, data, exists="manifest.json" in present)
    elif work.plan.wanted is None and "manifest.json" in present:
        delete(work, f"{folder}/manifest.json")
    delete_all(work, [*(journal.staged if journal else ()), f"{folder}/manifest.json{NEW}"])
    if work.plan.wanted is None:
        delete_backups(work, keep=frozenset())
    elif journal is not None and journal.new is not None:
        retained = (str(past.id) for past in journal.new.history)
        delete_backups(work, keep=frozenset({"origin", *retained}))
    delete_empty_folders(work)
    for name in ("switching", "journal.a", "journal.b"):
        delete_all(work, [f"{folder}/{name}"])
    if work.plan.wanted is None:
        delete_folder(work, folder)


def _clean(work: FileOperations) -> None:
    """Remove files of an interrupted run; the plan has those it switched."""
    journal = work.plan.state.journal
    if work.plan.repair:
        return
    staged = journal.staged if journal is not None else ()
    if work.plan.state.switching and journal is None:
        # Two runs overlapped: no journal lists the files that one of them staged.
        staged = tuple(c.where + suffix for c in work.plan.changes for suffix in (NEW, FENCE))
    delete_all(work, [*staged, f"{work.folder}/manifest.json{NEW}"])
    finished = journal is not None and work.plan.had is not None and work.plan.had.id == journal.id
    delete_all(work, [f"{work.folder}/switching"])
    if journal is not None and journal.new is not None and not finished:
        delete_backup(work, str(journal.id))
        if work.plan.had is None:
            delete_backup(work, "origin")
    delete_all(work, [f"{work.folder}/journal.a", f"{work.folder}/journal.b"])


def _undo_preparation(work: FileOperations, journal: Journal) -> None:
    """Undo the preparation as far as possible.

    The journal names the remaining files, and the next run removes them.
    """
    try:
        delete_all(work, journal.staged)
        if work.plan.wanted is not None:
            delete_backup(work, str(journal.id))
            if work.plan.had is None:
                delete_backup(work, "origin")
        delete_all(work, [f"{work.folder}/journal.a", f"{work.folder}/journal.b"])
        if work.plan.had is None:
            delete_folder(work, f"{work.folder}/backup")
            delete_empty_folders(work)
            delete_folder(work, work.folder)
    except TransportFault:
        return


def _write_journal(work: FileOperations, journal: Journal) -> None:
    """Write the journal into its unused file, then delete the other.

    So one of them is always complete.
    """
    current = work.plan.state.journal_file
    write(work, _journal_path(work), encode(journal_json(journal)))
    if current:
        delete_all(work, [f"{work.folder}/{current}"])


def _journal_path(work: FileOperations) -> str:
    name = "journal.b" if work.plan.state.journal_file == "journal.a" else "journal.a"
    return f"{work.folder}/{name}"


def _hold(work: FileOperations, journal: Journal) -> None:
    """Check that this run's journal exists.

    Another run deletes or overwrites it. Raises TransportFault RG522.
    """
    if read_or_none(work.transport, _journal_path(work)) != encode(journal_json(journal)):
        raise TransportFault(
            "denied",
            f"{work.plan.target}: another deployment interfered",
            code="RG522",
            help="find out whose it is, let it end, then plan again",
        )


def _cut(plan: Plan, fault: TransportFault) -> DiagnosticError:
    return DiagnosticError(
        [
            *fault.diagnostics,
            error(
                "RG527",
                None,
                f"{plan.verb} of {plan.target} was cut while it switched files",
                f"run `rapidgen {plan.verb}` again to finish, or `rapidgen rollback` to undo",
                notes=(
                    "the files there are the old set, the new set, or a set that refuses to move",
                ),
            ),
        ],
        exit_code=1,
    )


def _conflict(change: FileChange) -> Diagnostic:
    if change.conflict == "kept":
        return error(
            "RG528",
            None,
            f"{change.shown}: {change.doubt}",
            "--overwrite continues without it: the driver's file is deleted without a replacement"
            if change.after is None
            else "--overwrite restores the content of the copy: look at the file afterwards",
        )
    if change.conflict == "foreign":
        return error(
            "RG521",
            None,
            f"{change.shown} exists already, and rapidgen did not create it",
            "rename or remove it, or --overwrite: a copy stays on the controller, and "
            "`rapidgen uninstall` restores it",
        )
    return error(
        "RG520",
        None,
        f"{change.shown} was changed locally since the last deployment",
        "take the edit over into the configuration, or --overwrite: a copy stays in the backup",
        notes=(change.note,) if change.note else (),
    )
