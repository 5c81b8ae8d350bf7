"""Another driver on the controller, and its conflicting cfg instances.

They have to be deleted before ours is loaded. abb_driver's modules have names of ours (ROS_common,
ROS_socket, ROS_messages, ROS_motion, ...), and three of them are loaded into every task [backup
6.06 with abb_driver: `-AllTask`]. It is not documented which of two modules of one name a task
gets; if both declare its data the result is 40160 and a task that does not run [VC 6.15]. The same
holds for a driver that was copied there manually. Its files are never changed.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rapidgen.deploy.cfg import Keyed, attributes_text, keyed, name_of, shown_key
from rapidgen.deploy.driver_set import STATE
from rapidgen.deploy.transports.transport import Transport, TransportFault, read_or_none, safe
from rapidgen.system import CfgText, Instance, Section

MODULE = re.compile(rb"^\s*MODULE\s+([A-Za-z]\w*)", re.I | re.M)
_PROC = re.compile(rb"^\s*(?:LOCAL\s+)?PROC\s+([A-Za-z]\w*)", re.I | re.M)
_OLD = re.compile(r"ROS_(common|socket|messages|motion|motionServer|stateServer)(_\w+)?", re.I)
"""Modules of abb_driver; with two arms they carry suffixes [backup 6.06]."""
_ENDINGS = ("mod", "sys", "modx", "sysx", "prg")


@dataclass(frozen=True, slots=True)
class ForeignInstance:
    """One instance of the other driver."""

    domain: str
    section: str
    instance: Instance

    @property
    def shown(self) -> str:
        """Its name in plans, with its tasks unless there is only one."""
        every = [a for a in self.instance.attributes if a.name.casefold().startswith("all")]
        name = shown_key(self.section, self.instance)
        return f"{self.section} {name} {attributes_text(every)}".strip()


@dataclass(frozen=True, slots=True)
class OtherDriver:
    """Another driver.

    Without `instances` only its files are visible: loaded cfg is not.
    """

    instances: tuple[ForeignInstance, ...]
    files: tuple[str, ...]
    """Paths in HOME."""

    def texts(self, present: Sequence[CfgText]) -> tuple[CfgText, ...]:
        """Return cfg files that restore the other driver's instances."""
        result = []
        for text in present:
            own = [n for n in self.instances if n.domain == text.domain]
            names = list(dict.fromkeys(n.section for n in own))
            sections = tuple(
                Section(name, tuple(n.instance for n in own if n.section == name)) for name in names
            )
            if sections:
                result.append(replace(text, sections=sections))
        return tuple(result)


@dataclass(frozen=True, slots=True)
class OwnContents:
    """Our names: modules with tasks, cfg instances, and paths in HOME."""

    modules: dict[str, frozenset[str]]
    instances: frozenset[str]
    paths: frozenset[str]
    tasks: frozenset[str] = frozenset()
    """Background tasks that no deployment has added yet, without case.

    An existing one with a module of its own is foreign.
    """


def find_other_driver(
    transport: Transport, home: str, present: Sequence[CfgText], own: OwnContents
) -> OtherDriver | None:
    """Return the other driver, if there is one.

    `present` is empty if loaded cfg is not visible. Raises TransportFault.
    """
    if not present:
        lying = _files(transport, home, own)
        return OtherDriver((), lying) if lying else None
    there = {k: i for k, i in keyed(present).items() if name_of(k) not in own.instances}
    rows = [i for k, i in there.items() if k[1] == "CAB_TASK_MODULES"]
    sources = {i.text("File"): _source(transport, home, i.text("File")) for i in rows}
    out = [i for i in rows if _is_other(i, sources[i.text("File")], own)]
    if not out:
        return None
    tasks = _tasks(there, rows, out)
    routines = {
        name.decode("latin-1").casefold()
        for row in out
        for name in _PROC.findall(sources[row.text("File")] or b"")
    }
    instances = [
        ForeignInstance(domain, section, instance)
        for (domain, section, _), instance in there.items()
        if (section == "CAB_TASK_MODULES" and instance in out)
        or (section == "CAB_TASKS" and instance.text("Name").casefold() in tasks)
        or (
            section == "CAB_EXEC_HOOKS"
            and (
                instance.text("Task").casefold() in tasks
                or instance.text("Routine").casefold() in routines
            )
        )
    ]
    files = [_path(row.text("File")) for row in out if sources[row.text("File")] is not None]
    return OtherDriver(tuple(instances), tuple(dict.fromkeys(files)))


def in_memory(transport: Transport, modules: dict[str, frozenset[str]]) -> tuple[str, ...]:
    """Return modules of a backup's programs with names of ours.

    They are in RAPID/TASKn/PROGMOD or SYSMOD. They were in the tasks' memory when the backup was
    made [backup 6.06], and it restores them, not the files in HOME. Raises TransportFault.
    """
    result = []
    for folder in _folders(transport, "", "rapid"):
        for task in _folders(transport, folder, "task"):
            for kind in _folders(transport, task, ""):
                for entry in transport.entries(kind):
                    stem = entry.name.rpartition(".")[0].casefold()
                    if stem in modules and entry.folder is not True:
                        result.append(f"{kind}/{entry.name}")
    return tuple(result)


def _folders(transport: Transport, place: str, beginning: str) -> list[str]:
    return [
        f"{place}/{entry.name}".lstrip("/")
        for entry in transport.entries(place)
        if entry.folder is not False and entry.name.casefold().startswith(beginning)
    ]


def _is_other(row: Instance, source: bytes | None, own: OwnContents) -> bool:
    """True if a row of CAB_TASK_MODULES belongs to another driver.

    It loads abb_driver, a name of ours into a task of ours, or anything into a task that shares
    only its name with ours.
    """
    match = MODULE.search(source or b"")
    stem = row.text("File").replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
    name = match[1].decode("latin-1") if match else row.text("ModName") or stem
    if _OLD.fullmatch(name) or _OLD.fullmatch(stem):
        return True
    if row.text("Task").casefold() in own.tasks:
        return True
    tasks = own.modules.get(name.casefold(), frozenset())
    return bool(tasks) and (not row.text("Task") or row.text("Task").casefold() in tasks)


def _tasks(there: Keyed, rows: list[Instance], out: list[Instance]) -> frozenset[str]:
    """Return background tasks without other modules by name."""
    retained = {r.text("Task").casefold() for r in rows if r not in out}
    gone = {r.text("Task").casefold() for r in out} - retained - {""}
    motion = {
        i.text("Name").casefold()
        for k, i in there.items()
        if k[1] == "CAB_TASKS" and i.flag("MotionTask")
    }
    return frozenset(gone - motion)


def _files(transport: Transport, home: str, own: OwnContents) -> tuple[str, ...]:
    """Return foreign modules in HOME with a name of ours or abb_driver's.

    Folders of HOME are included: abb_driver's page says HOME:/ROS, other places are possible.
    """
    result = []
    top = transport.entries(home.rstrip("/"))
    folders = [e.name for e in top if e.folder or (e.folder is None and "." not in e.name)]
    for folder in ("", *(name for name in folders if name != STATE)):
        for name in _names(transport, home + folder) if folder else (e.name for e in top):
            path = f"{folder}/{name}".lstrip("/")
            stem, _, suffix = name.rpartition(".")
            if suffix.casefold() not in _ENDINGS or path in own.paths:
                continue
            if stem.casefold() in own.modules or _OLD.fullmatch(stem):
                result.append(path)
    return tuple(result)


def _names(transport: Transport, folder: str) -> tuple[str, ...]:
    """Return names in a possible folder; some servers do not report it."""
    try:
        return tuple(entry.name for entry in transport.entries(folder))
    except TransportFault as fault:
        if fault.kind in ("lost", "garbled"):
            raise
        return ()


def _source(transport: Transport, home: str, file: str) -> bytes | None:
    """Return the module's text if it is in HOME and readable."""
    path = _path(file)
    try:
        return read_or_none(transport, home + safe(path)) if path else None
    except TransportFault as fault:
        if fault.kind in ("lost", "garbled"):
            raise
        return None


def _path(file: str) -> str:
    head, _, remaining = file.replace("\\", "/").partition(":")
    return remaining.strip("/") if head.casefold() == "home" else ""
