"""Online plan: cfg, modules in memory, a restart.

It is made from one snapshot.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rapidgen._json import Json, Members
from rapidgen.client.rws import RwsError
from rapidgen.deploy.cfg import (
    CfgChange,
    instance_from,
    is_delivered,
    is_unconfirmed,
)
from rapidgen.deploy.driver_set import DriverSet
from rapidgen.deploy.manual_steps import ManualStep
from rapidgen.deploy.online.snapshot import SECTIONS, ControllerSnapshot, Row
from rapidgen.deploy.other_driver import MODULE
from rapidgen.deploy.tasks import MAIN
from rapidgen.system import CfgText, Instance, Section, write_cfg
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.grants import missing, needed

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

_GRANTED = ", or Grant when it asks whether rapidgen may write"
_OR_GRANT = {Generation.ONE: _GRANTED, Generation.TWO: _GRANTED}
BY_SERVICES = "web services"
"""Texts of the automatic steps."""


@dataclass(frozen=True, slots=True)
class AttributeChange:
    """New attributes of one instance; `old` ones are recorded."""

    domain: str
    section: str
    title: str
    new: Mapping[str, str]
    old: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class MemoryModule:
    """A module in a task; `path` is the file below HOME to load, if any."""

    task: str
    module: str
    path: str = ""
    why: str = ""

    @property
    def shown(self) -> str:
        return f"{self.task}/{self.module}"


@dataclass(frozen=True, slots=True)
class OnlinePlan:
    """Complete online plan, for the controller with this `id`."""

    id: str
    shown: str
    delete: tuple[Row, ...] = ()
    """Deleted instances."""
    again: tuple[Row, ...] = ()
    """Those that are restored with changes."""
    change: tuple[AttributeChange, ...] = ()
    load: tuple[CfgText, ...] = ()
    """Files to load with `add`: signals before instances that name them."""
    optional: tuple[CfgText, ...] = ()
    """Instances that a controller may refuse; loaded only with the others."""
    clash: tuple[MemoryModule, ...] = ()
    """Foreign modules in conflict with ours; `--overwrite` unloads them."""
    unload: tuple[MemoryModule, ...] = ()
    replace: tuple[MemoryModule, ...] = ()
    """Modules of NORMAL tasks, which a restart would not change."""
    restore: tuple[MemoryModule, ...] = ()
    """Saved modules that are restored."""
    restart: bool = False
    """True if a change takes effect only after a restart."""
    symbols: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Symbol of BUILD_ID in each task."""
    started: tuple[str, ...] = ()
    """Running background tasks: a change of memory stops them."""
    owned: tuple[str, ...] = ()
    """Those that a deployment added."""
    silent: tuple[str, ...] = ()
    """Stopped background tasks of the driver, after a killed run."""
    pointers: tuple[str, ...] = ()
    """Foreign NORMAL tasks.

    If single pointers cannot be set, theirs are set too.
    """
    mains: tuple[tuple[str, str], ...] = ()
    """NORMAL tasks whose `main` is ours, with its module."""
    running: bool = False
    mode: str = ""
    orphans: tuple[str, ...] = ()
    """Background tasks without cfg, which a restart ends."""
    grants: frozenset[str] = frozenset()
    """Grants of the user; empty if the controller reports none."""

    @property
    def touches_cfg(self) -> bool:
        return bool(self.delete or self.again or self.change or self.load)

    @property
    def touches_memory(self) -> bool:
        return bool(self.clash or self.unload or self.replace or self.restore)

    @property
    def is_empty(self) -> bool:
        return not (self.touches_cfg or self.touches_memory or self.restart)

    def lacking(self, generation: Generation, *, restart: bool) -> tuple[str, ...]:
        """Return the grants that the plan needs and the user lacks."""
        if not self.grants or any("FULL_ACCESS" in grant for grant in self.grants):
            return ()
        desired = [ops.READ_FILE, ops.WRITE_FILE, ops.BACKUP]
        if self.touches_cfg:
            desired += [ops.CFG_DELETE, ops.CFG_SET, ops.CFG_LOAD]
        if self.touches_memory:
            desired += [ops.LOAD_MODULE, ops.POINTER_TO_ROUTINE, ops.SAVE_MODULE]
            desired += [ops.STOP] if self.started else []
        if self.restart and restart:
            desired += [ops.RESTART, *([ops.POINTER_TO_ROUTINE] if self.mains else [])]
        result = (g for one in desired for g in missing(needed(one, generation), self.grants))
        return tuple(dict.fromkeys(result))

    @property
    def fingerprint(self) -> Members:
        """Return the state for which the plan holds, without execution."""
        text: Members = {
            "id": self.id,
            "delete": [r.name for r in (*self.delete, *self.again)],
            "change": [[c.section, c.title, dict(c.new)] for c in self.change],
            "load": [write_cfg(t) for t in (*self.load, *self.optional)],
            "restart": self.restart,
        }
        for name in ("clash", "unload", "replace", "restore"):
            text[name] = [m.shown for m in getattr(self, name)]
        return text


def make_live_plan(
    view: ControllerSnapshot,
    cfg: Sequence[CfgChange],
    desired: DriverSet | None,
    old: Mapping[str, tuple[str, ...]],
    own_files: frozenset[str],
    before: Mapping[str, Json],
    symbols: Mapping[str, tuple[str, ...]],
    conflict: tuple[MemoryModule, ...],
    restore: tuple[MemoryModule, ...],
) -> OnlinePlan:
    """Make an online plan.

    `old`: modules of earlier sets with their tasks; `own_files` and `before` as in a plan.
    """
    rows = {row.name: row for row in view.rows}
    delete, again, change = [], [], []
    for one in cfg:
        name = f"{one.domain} {one.key}".casefold()
        if one.action == "remove":
            delete.append(rows[name])
        elif (
            one.action == "change"
            and name in own_files
            and before.get(name) is None
            and not is_delivered(rows[name].section, rows[name].instance)
        ):
            again.append(rows[name])
        elif one.action in ("change", "restore"):
            new = before[name] if one.action == "restore" else None
            instance = instance_from(new) if new is not None else _wanted(desired, name)
            change.append(_change(rows[name], instance))
    load = _loads(cfg, desired, frozenset(row.name for row in again))
    replace, unload = _memory(view, desired, old)
    needed = {task.casefold() for f in desired.files for task in f.tasks} if desired else set()
    running = {f"sys cab_tasks {t.name.casefold()}" for t in view.tasks}
    stale = bool(running & own_files - rows.keys())
    background = [t for t in view.tasks if t.kind != "normal" and t.execution == "started"]
    if desired is not None:
        # A NORMAL task gets its modules while stopped, if no other task runs.
        hot = set() if background else _loaded_whole(desired, replace)
        stale = stale or any(view.builds.get(t) != desired.build_id for t in needed - hot)
    known = needed | {t.casefold() for names in old.values() for t in names}
    # Only a restart starts them, also if all modules are the wanted ones.
    silent = tuple(
        t.name
        for t in view.tasks
        if t.kind != "normal" and t.execution != "started" and t.name.casefold() in needed
    )
    needful = [t for t in load if not is_unconfirmed(t)]
    return OnlinePlan(
        view.id,
        view.shown,
        _dependents_first(delete),
        _dependents_first(again),
        tuple(change),
        tuple(needful),
        tuple(t for t in load if is_unconfirmed(t)),
        conflict,
        unload,
        replace,
        restore,
        bool(delete or again or change or needful or stale or silent or view.orphans),
        dict(symbols),
        tuple(t.name for t in background),
        tuple(t.name for t in background if t.name.casefold() in known),
        silent,
        tuple(t.name for t in view.tasks if t.kind == "normal" and t.name.casefold() not in known),
        _mains(view, desired),
        view.running,
        view.mode,
        view.orphans,
        view.grants,
    )


def find_clashes(
    services: "Controller",
    view: ControllerSnapshot,
    desired: DriverSet | None,
    old: Mapping[str, tuple[str, ...]],
) -> tuple[MemoryModule, ...]:
    """Return foreign modules with a name of ours, or another `main`.

    They are in the driver's tasks. Raises RobotError.
    """
    result = []
    for task, names in view.modules.items():
        own, main = set(), False
        for file in desired.files if desired else ():
            if task in (t.casefold() for t in file.tasks):
                own.add(_module_name(file.data).casefold())
                main = main or MAIN.search(file.data) is not None
        earlier = {m.casefold() for m, t in old.items() if task in map(str.casefold, t)}
        for name in names:
            low = name.casefold()
            if low in earlier:
                continue
            if low in own:
                result.append(MemoryModule(task.upper(), name, why="has a name of ours"))
            elif main and has_main(services, task, name):
                result.append(MemoryModule(task.upper(), name, why="has a main, too"))
    real = {t.name.casefold(): t.name for t in view.tasks}
    return tuple(MemoryModule(real[m.task.casefold()], m.module, why=m.why) for m in result)


def _by_task(modules: Sequence[MemoryModule]) -> list[tuple[str, str, bool]]:
    """Join modules of one task and reason.

    Returns the text, the reason, and whether there are several.
    """
    result: dict[tuple[str, str], list[str]] = {}
    for module in modules:
        result.setdefault((module.task, module.why), []).append(module.module)
    return [(f"{t}/{', '.join(names)}", w, len(names) > 1) for (t, w), names in result.items()]


def live_steps(
    live: OnlinePlan, verb: str, host: str, generation: Generation
) -> tuple[ManualStep, ...]:
    """Return the steps of a plan: by web services, and by people."""
    by = BY_SERVICES
    gone = Counter(row.domain for row in (*live.delete, *live.again))
    steps = [
        ManualStep(by, f"delete {count} instances of {domain}") for domain, count in gone.items()
    ]
    steps += [
        ManualStep(by, f"set {c.section} {c.title}: {_words(c.new)} (was {_words(c.old)})")
        for c in live.change
    ]
    for text in (*live.load, *(live.optional if live.touches_cfg else ())):
        count = sum(len(s.instances) for s in text.sections)
        steps.append(ManualStep(by, f"load {count} instances of {text.domain} by add"))
    for displayed, why, several in _by_task(live.clash):
        which = "each of which" if several else "which"
        steps.append(ManualStep(by, f"save and unload {displayed}, {which} {why} (--overwrite)"))
    steps += [ManualStep(by, f"unload {displayed}") for displayed, *_ in _by_task(live.unload)]
    if live.replace:
        names = ", ".join(m.shown for m in live.replace)
        steps.append(ManualStep(by, f"load anew: {names}"))
    for displayed, _, several in _by_task(live.restore):
        saved = "they were" if several else "it was"
        steps.append(ManualStep(by, f"load {displayed} again, as {saved} saved"))
    if live.is_empty:
        return tuple(steps)
    if live.mode != "AUTO":
        what = f"automatic mode (it is {live.mode or 'unknown'})"
        steps.append(ManualStep("pendant", f"{what}{_OR_GRANT.get(generation, '')}"))
    lacking = live.lacking(generation, restart=True)
    if lacking:
        steps.append(ManualStep("you", f"give the user {', '.join(lacking)} in RobotStudio"))
    if live.running:
        what = f"stop the program: `rapidgen stop-program {host}`"
        steps.append(ManualStep("you", what, stops_motion=True))
    if live.restart:
        others = sorted(set(live.started) - set(live.owned))
        adjacent = f"; it stops {', '.join(others)}, too" if others else ""
        adjacent += (
            f"; it starts {', '.join(live.silent)}, which are stopped" if live.silent else ""
        )
        what = f"a warm start: --restart does it, or menu > Restart{adjacent}"
        steps.append(ManualStep("you", what, stops_motion=True))
    if verb != "uninstall":
        what = f"motors on and start, at the robot or by `rapidgen start-program {host}`"
        if live.mains and not live.restart and not live.touches_memory:
            what += "; program pointer to main first"
        steps.append(ManualStep("you", what))
    return tuple(steps)


def _words(attributes: Mapping[str, str]) -> str:
    return ", ".join(f"{k} {v or '(empty)'}" for k, v in attributes.items())


def _wanted(desired: DriverSet | None, name: str) -> Instance:
    for text in desired.cfg if desired else ():
        for section in text.sections:
            for instance in section.instances:
                if Row(text.domain, section.name, "", instance).name == name:
                    return instance
    raise KeyError(name)


def _change(row: Row, new: Instance) -> AttributeChange:
    def plain(instance: Instance) -> dict[str, str]:
        # A flag is true or absent.
        return {
            a.name: " ".join(map(str, a.values)) if a.values else "true"
            for a in instance.attributes
        }

    before, after = plain(row.instance), plain(new)
    names = [n for n in {**before, **after} if before.get(n) != after.get(n)]
    flags = {a.name for i in (row.instance, new) for a in i.attributes if not a.values}

    def values(of: dict[str, str]) -> dict[str, str]:
        return {n: of.get(n, "false" if n in flags else "") for n in names}

    return AttributeChange(row.domain, row.section, row.title, values(after), values(before))


def _dependents_first(rows: list[Row]) -> tuple[Row, ...]:
    """Order deletions: outputs before signals, modules before tasks."""
    order = [section for _, section in SECTIONS]

    def place(row: Row) -> int:
        return -order.index(row.section) if row.section in order else 0

    return tuple(sorted(rows, key=place))


def _loads(
    cfg: Sequence[CfgChange], desired: DriverSet | None, gone: frozenset[str]
) -> list[CfgText]:
    new = {f"{c.domain} {c.key}".casefold() for c in cfg if c.action == "add"} | gone
    result = []
    for text in sorted(desired.cfg if desired else (), key=lambda t: (is_unconfirmed(t), t.path)):
        sections = [
            Section(
                s.name,
                tuple(i for i in s.instances if Row(text.domain, s.name, "", i).name in new),
            )
            for s in text.sections
        ]
        retained = tuple(s for s in sections if s.instances)
        if retained:
            result.append(CfgText(text.domain, text.version, retained, text.path))
    return result


def _memory(
    view: ControllerSnapshot, desired: DriverSet | None, old: Mapping[str, tuple[str, ...]]
) -> tuple[tuple[MemoryModule, ...], tuple[MemoryModule, ...]]:
    """Return modules of NORMAL tasks to load anew, and those to unload."""
    replace, unload = [], []
    for task, names in view.modules.items():
        if not view.normal(task):
            continue
        real = next(t.name for t in view.tasks if t.name.casefold() == task)
        lying = {n.casefold() for n in names}
        own = set()
        for file in desired.files if desired else ():
            if file.kind != "module" or real not in file.tasks:
                continue
            module = _module_name(file.data)
            own.add(module.casefold())
            stale = desired is not None and view.builds.get(task) != desired.build_id
            if stale and module.casefold() in lying:
                replace.append(MemoryModule(real, module, file.path))
        for module, tasks in old.items():
            low = module.casefold()
            if real in tasks and low in lying and low not in own:
                unload.append(MemoryModule(real, module))
    return tuple(replace), tuple(unload)


def _loaded_whole(desired: DriverSet, replace: Sequence[MemoryModule]) -> set[str]:
    """Return tasks, in lower case, whose modules are all loaded anew."""
    coming = {m.shown.casefold() for m in replace}
    missing = {
        task.casefold()
        for file in desired.files
        for task in file.tasks
        if file.kind == "module" and f"{task}/{_module_name(file.data)}".casefold() not in coming
    }
    return {m.task.casefold() for m in replace} - missing


def _mains(view: ControllerSnapshot, desired: DriverSet | None) -> tuple[tuple[str, str], ...]:
    result: dict[str, str] = {}
    for file in desired.files if desired else ():
        if file.kind == "module" and MAIN.search(file.data):
            result |= {task: _module_name(file.data) for task in file.tasks if view.normal(task)}
    return tuple(result.items())


def _module_name(data: bytes) -> str:
    match = MODULE.search(data)
    return match[1].decode("latin-1") if match else ""


def has_main(services: "Controller", task: str, module: str) -> bool:
    """True if a module in a task declares a main. Raises RobotError."""
    try:
        text = services.module_text(task, module)
    except RwsError as error:
        if error.status < 500:
            raise
        return False  # encoded: it cannot be read [VC 7.21]
    return MAIN.search(text.encode("latin-1", "replace")) is not None
