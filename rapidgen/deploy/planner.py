"""Making of a plan: the controller's state compared with the wanted set."""

import difflib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace

from rapidgen._json import Members
from rapidgen.deploy.cfg import compare, is_unconfirmed, keyed, name_of
from rapidgen.deploy.driver_set import FENCE, NEW, DriverSet, digest
from rapidgen.deploy.manifest_recovery import copies, recovered_manifest
from rapidgen.deploy.manual_steps import CFG_FIRST, other_driver_steps, steps_of
from rapidgen.deploy.online.plan import OnlinePlan, find_clashes, live_steps, make_live_plan
from rapidgen.deploy.online.program_memory import saved
from rapidgen.deploy.online.snapshot import ControllerSnapshot, build_symbols, look
from rapidgen.deploy.other_driver import (
    MODULE,
    OtherDriver,
    OwnContents,
    find_other_driver,
    in_memory,
)
from rapidgen.deploy.plan import (
    DAMAGED,
    Action,
    Conflict,
    FileChange,
    Layout,
    Plan,
    Verb,
    lines_of,
)
from rapidgen.deploy.state_folder import (
    FileRecord,
    Manifest,
    StateFolder,
    next_copy,
    read_kept,
    read_state,
)
from rapidgen.deploy.syspar import read_syspar, syspar_changes
from rapidgen.deploy.tasks import check_complete, entry_steps
from rapidgen.deploy.transports.transport import Transport, read_or_none, refused
from rapidgen.diagnostics import DiagnosticError
from rapidgen.system import CfgText, parse_cfg


def make_plan(
    transport: Transport,
    desired: DriverSet | None,
    *,
    verb: Verb = "deploy",
    loaded: tuple[CfgText, ...] = (),
) -> Plan:
    """Read the controller and plan the changes to `desired`.

    `desired` None: the state before the first deployment. `loaded` is a backup's loaded cfg, for a
    transport that cannot read it. Raises TransportFault; DiagnosticError RG524 (another robot's
    driver), RG525 (RobotWare), RG529 (nothing deployed), RG531 (the manifest on the controller is
    damaged), RG538 (no such motion task), RG539 (a task is left out).
    """
    layout = find_layout(transport)
    state = read_state(transport, layout.home)
    damaged = ""
    if state.damaged and not (state.switching and state.journal):
        damaged = state.damaged
        if desired is None or state.later:
            raise refused("RG531", damaged, "" if state.later else DAMAGED)
        state = replace(state, manifest=recovered_manifest(transport, layout.home, desired))
    base = _base(transport, layout.home, state)
    had = base.had
    nothing = desired is None and had is None and not base.interrupted
    if nothing and transport.services is None:
        raise _nothing_there(transport)
    carried = state.carried(had, repair=base.repair)
    if desired is not None and carried and carried != desired.name:
        raise refused(
            "RG524",
            f"{transport.shown} carries the driver of {carried!r}, not of {desired.name!r}",
            f"check the URL; to replace it, `rapidgen uninstall {carried} --to ...` first",
        )
    changes = _file_changes(transport, layout, base, desired)
    syspar = read_syspar(transport, layout.syspar)
    texts = tuple(f.text for f in syspar) or loaded
    old_cfg = _old_cfg(changes)
    services = transport.services
    view, symbols = None, {}
    old = {
        r.path.rpartition("/")[2].partition(".")[0]: r.tasks
        for r in base.records.values()
        if r.kind == "module"
    }
    if services is not None:
        symbols = build_symbols(desired) if desired is not None else {}
        references = keyed((*old_cfg, *(desired.cfg if desired else ())))
        view = look(services, references, _tasks(desired, old), symbols)
        texts = view.texts
        if nothing and not view.orphans:
            raise _nothing_there(transport)
        _check_release(view, desired, transport.shown)
    _check_robotware(texts, desired, transport.shown)
    wanted_cfg = desired.cfg if desired else ()
    seen = bool(syspar) and transport.reach.writes_cfg
    if seen:
        # A system that starts from these files has no user who could omit a row.
        wanted_cfg = tuple(text for text in wanted_cfg if not is_unconfirmed(text))
    present = texts if texts or view else old_cfg
    own_files = frozenset([*map(name_of, keyed(old_cfg)), *base.cfg_before])
    cfg = compare(keyed(wanted_cfg), keyed(present), own_files, base.cfg_before)
    neighbour: OtherDriver | None = None
    restored: tuple[str, ...] = ()
    if desired is not None and verb == "deploy":
        neighbour = _neighbour(transport, layout, texts, desired, own_files, frozenset(base.known))
        if layout.syspar:
            restored = in_memory(transport, _names(desired))
    originals = {
        r.path: data if data is not None and digest(data) == r.sha256 else None
        for r in base.origin.values()
        if seen and r.kind == "syspar"
        for data in [read_kept(transport, layout.home, r)]
    }
    for change in (
        syspar_changes(layout.syspar, syspar, wanted_cfg, own_files, base.cfg_before, originals)
        if seen
        else ()
    ):
        action: Action = "add" if change.before is None else "change"
        if change.after is None:
            action = "remove"
        changes.append(
            FileChange(
                change.path,
                change.path,
                action,
                "syspar",
                before=change.before,
                after=change.after,
                foreign=change.foreign,
            )
        )
    modules = [c for c in changes if c.kind == "module" and c.action != "same"]
    live = None
    if services is not None and view is not None:
        live = make_live_plan(
            view, cfg, desired, old, own_files, base.cfg_before, symbols,
            find_clashes(services, view, desired, old),
            saved(transport, layout.home, view) if desired is None else (),
        )  # fmt: skip
        steps = live_steps(live, verb, transport.shown, services.generation)
    else:
        steps = steps_of(
            [(c.path, c.tasks) for c in modules if c.after is not None],
            cfg,
            wanted_cfg,
            old_cfg,
            gone=any(c.after is None for c in modules),
            written=seen,
        )
    if desired is not None:
        if verb == "deploy":
            check_complete(desired, cfg)
        steps = (*entry_steps(desired, texts, transport.shown), *steps)
    if neighbour is not None:
        steps = other_driver_steps(neighbour)
    elif desired is None and not seen and live is None and any(c.action == "remove" for c in cfg):
        steps = (CFG_FIRST, *steps)
    unseen = list(transport.reach.unseen)
    if live is not None:
        pass  # all of it was requested
    elif loaded and not syspar:
        unseen.append("loaded cfg is taken from the backup; later changes are not visible")
    elif not seen and desired is not None:
        unseen.append(
            "cfg instances are compared with the last deployment"
            if had is not None
            else "cfg instances are assumed missing: loaded cfg is not visible"
        )
        unseen.append(f"whether this is RobotWare {_ware(desired.robotware)}: not seen")
    print_of = [(c.where, digest(c.before) if c.before is not None else "") for c in changes]
    return Plan(
        verb,
        transport.shown,
        desired.name if desired else carried,
        desired.build_id if desired else "",
        desired.robotware if desired else (had.robotware if had else (0, 0)),
        tuple(changes),
        cfg,
        seen,
        steps,
        tuple(unseen),
        transport.reach.rename,
        base.interrupted,
        digest(json.dumps([state.digest, sorted(print_of), *_live_print(live)]).encode()),
        layout,
        state,
        had,
        desired,
        base.repair,
        base.origin,
        base.cfg_before,
        texts,
        own_files,
        neighbour,
        restored,
        damaged,
        copies(transport, layout.home) if damaged else next_copy(base.origin.values()),
        live,
    )


def _nothing_there(transport: Transport) -> DiagnosticError:
    return refused(
        "RG529",
        f"{transport.shown}: no deployment of rapidgen is there",
        "check the URL; `rapidgen doctor` shows the files there",
    )


def find_layout(transport: Transport) -> Layout:
    """Return HOME itself, or a system folder that contains HOME.

    The latter is a backup or a virtual controller.
    """
    # Of two names that differ in case the upper-case one counts.
    result = sorted((e.name for e in transport.entries("") if e.folder is not False), reverse=True)
    names = {name.casefold(): name for name in result}
    home, syspar = names.get("home", ""), names.get("syspar", "")
    # A folder `home` alone may be any folder; next to SYSPAR it is that of a copied backup.
    if not home or (home != "HOME" and not syspar):
        return Layout("", "")
    return Layout(f"{home}/", f"{syspar}/" if syspar else "")


@dataclass(frozen=True, slots=True)
class _Base:
    """Files that count as ours, after any interruption."""

    had: Manifest | None
    records: dict[str, FileRecord]
    known: dict[str, set[str]]
    origin: dict[str, FileRecord]
    cfg_before: Members
    interrupted: str
    repair: bool
    pieces: dict[str, list[bytes]]
    """Staged contents by path.

    Without rename an interruption leaves a partial file.
    """

    def owns(self, path: str, data: bytes) -> bool:
        """True if a deployment wrote these contents, also partially."""
        known = digest(data) in self.known.get(path, ())
        return known or any(piece.startswith(data) for piece in self.pieces.get(path, ()))


def _base(transport: Transport, home: str, state: StateFolder) -> _Base:
    had, journal = state.manifest, state.journal
    interrupted, repair = "", False
    if journal is not None:
        done = had is None and not state.damaged
        if journal.new is not None:
            done = had is not None and had.id == journal.id
        if done:
            interrupted = f"{journal.verb} {journal.id} is done, its notes are still there"
        elif state.switching:
            interrupted = f"{journal.verb} {journal.id} was cut while it switched files"
            had, repair = journal.old, True
        else:
            interrupted = f"{journal.verb} {journal.id} was cut before it changed anything"
    elif state.switching:
        interrupted = "a deployment was interrupted, and its journal is lost"
    elif state.litter:
        interrupted = "a deployment was cut before it began"
    manifests = [had, journal.new if journal is not None and repair else None]
    known = {p: set(h) for p, h in journal.known.items()} if journal and repair else {}
    records: dict[str, FileRecord] = {}
    origin: dict[str, FileRecord] = {}
    before: Members = {}
    for manifest in filter(None, manifests):
        origin |= {r.path: r for r in manifest.origin}
        before = {**{k.casefold(): v for k, v in manifest.cfg_before.items()}, **before}
        for record in manifest.files:
            records.setdefault(record.path, record)
            known.setdefault(record.path, set()).add(record.sha256)
    pieces: dict[str, list[bytes]] = {}
    for staged in journal.staged if journal is not None and repair else ():
        data = read_or_none(transport, staged)
        if data is not None:
            path = staged.removeprefix(home).removesuffix(NEW).removesuffix(FENCE)
            pieces.setdefault(path, []).append(data)
    return _Base(had, records, known, origin, before, interrupted, repair, pieces)


def _file_changes(
    transport: Transport, layout: Layout, base: _Base, desired: DriverSet | None
) -> list[FileChange]:
    changes: list[FileChange] = []
    conflict: Conflict
    for file in desired.files if desired else ():
        where = layout.home + file.path
        current = read_or_none(transport, where)
        own_files = base.known.get(file.path)
        action: Action = "add" if current is None else "change"
        conflict = ""
        note = ""
        if current == file.data:
            action = "same"
        elif current is not None and own_files is None:
            conflict = "foreign"
        elif current is not None and not base.owns(file.path, current):
            conflict = "edited"
            note = _edited_lines(base.records.get(file.path), current, file.data)
        foreign = current is not None and own_files is None
        changes.append(
            FileChange(
                file.path,
                where,
                action,
                file.kind,
                file.tasks,
                current,
                file.data,
                conflict,
                foreign,
                note,
            )
        )
    written = {c.path for c in changes}
    for path in base.known:
        if path in written:
            continue
        where = layout.home + path
        current = read_or_none(transport, where)
        record, after = base.records.get(path), None
        conflict, note = "", ""
        if path in base.origin:
            after = read_kept(transport, layout.home, base.origin[path])
            if after is None or digest(after) != base.origin[path].sha256:
                conflict, note = "kept", "damaged" if after is not None else "gone"
        if current == after:
            continue
        if not conflict and current is not None and not base.owns(path, current):
            conflict = "edited"
        changes.append(
            FileChange(
                path,
                where,
                "remove" if after is None else "restore",
                record.kind if record else "module",
                record.tasks if record else (),
                current,
                after,
                conflict,
                note=note,
            )
        )
    return changes


def _live_print(live: OnlinePlan | None) -> list[Members]:
    return [live.fingerprint] if live is not None else []


def _tasks(desired: DriverSet | None, old: Mapping[str, tuple[str, ...]]) -> list[str]:
    names = [task for file in (desired.files if desired else ()) for task in file.tasks]
    return list(dict.fromkeys([*names, *(task for tasks in old.values() for task in tasks)]))


def _check_release(view: ControllerSnapshot, desired: DriverSet | None, target: str) -> None:
    """Raise RG525; a build for RobotWare 7 is for 8 too."""
    major = view.robotware.partition(".")[0]
    if desired is None or not major.isdecimal():
        return
    if min(int(major), 7) != min(desired.robotware[0], 7):
        raise _other_release(target, view.robotware, desired)


def _neighbour(
    transport: Transport,
    layout: Layout,
    texts: tuple[CfgText, ...],
    desired: DriverSet,
    own_files: frozenset[str],
    known: frozenset[str],
) -> OtherDriver | None:
    modules = _names(desired)
    instances = own_files | frozenset(map(name_of, keyed(desired.cfg)))
    paths = known | {file.path for file in desired.files}
    tasks = frozenset(
        instance.text("Name").casefold()
        for key, instance in keyed(desired.cfg).items()
        if key[1] == "CAB_TASKS"
        and not instance.flag("MotionTask")
        and name_of(key) not in own_files
    )
    return find_other_driver(
        transport, layout.home, texts, OwnContents(modules, instances, paths, tasks)
    )


def _names(desired: DriverSet | None) -> dict[str, frozenset[str]]:
    """Our module names with the tasks that load them, without case."""
    return {
        match[1].decode("latin-1").casefold(): frozenset(task.casefold() for task in file.tasks)
        for file in (desired.files if desired else ())
        if file.kind == "module" and (match := MODULE.search(file.data))
    }


def _edited_lines(record: FileRecord | None, current: bytes, pristine: bytes) -> str:
    """Return the lines of a local change.

    Known if the deployed file equals the wanted one.
    """
    if record is None or record.sha256 != digest(pristine):
        return ""
    matcher = difflib.SequenceMatcher(None, lines_of(pristine), lines_of(current), autojunk=False)
    spots = [(k + 1, max(m, k + 1)) for tag, _, _, k, m in matcher.get_opcodes() if tag != "equal"]
    text = [str(a) if a == b else f"{a}-{b}" for a, b in spots]
    return f"lines {', '.join(text[:5])}{', ...' if len(text) > 5 else ''}" if text else ""


def _old_cfg(changes: list[FileChange]) -> tuple[CfgText, ...]:
    """Return current cfg files of the last deployment.

    An unreadable one counts as missing.
    """
    result = []
    for change in changes:
        if change.kind == "cfg" and change.before is not None:
            try:
                result.append(parse_cfg(change.before, path=change.path))
            except DiagnosticError:
                continue
    return tuple(result)


def _check_robotware(texts: tuple[CfgText, ...], desired: DriverSet | None, target: str) -> None:
    for text in texts:
        if desired is None or text.version is None:
            continue
        main, _ = text.version
        if main != desired.robotware[0]:
            raise _other_release(target, f"{main} ({text.path})", desired)


def _other_release(target: str, findings: str, desired: DriverSet) -> DiagnosticError:
    return refused(
        "RG525",
        f"{target} runs RobotWare {findings}, the driver is built for {_ware(desired.robotware)}",
        f"set `robotware: {findings[0]}` in the configuration and build again",
    )


def _ware(robotware: tuple[int, int]) -> str:
    return f"{robotware[0]}.{robotware[1]:02d}"
