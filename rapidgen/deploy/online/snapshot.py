"""Snapshot of a controller: identity, cfg, tasks and their memory.

Reads only. The controller reports instances with all attributes, including defaults; only
attributes that we have ever written are compared.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rapidgen.client.rws import RwsError
from rapidgen.client.rws.model import CfgInstance, TaskState
from rapidgen.deploy.cfg import Keyed, shown_key
from rapidgen.deploy.driver_set import DriverSet
from rapidgen.deploy.other_driver import MODULE
from rapidgen.system import Attribute, CfgText, Instance, Section

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

SECTIONS = (
    ("SYS", "CAB_TASKS"),
    ("SYS", "CAB_TASK_MODULES"),
    ("SYS", "CAB_EXEC_HOOKS"),
    ("EIO", "EIO_SIGNAL"),
    ("EIO", "SYSSIG_OUT"),
)
"""Sections that reveal another driver, a clash or a missing task.

An instance that names another one comes after it.
"""
_NONE = ("E_CFG_DOMAIN_INVALID", "E_CFG_TYPE_INVALID", "E_CFG_INSTANCE_INVALID")


@dataclass(frozen=True, slots=True)
class Row:
    """An instance of the controller, and the controller's name of it."""

    domain: str
    section: str
    title: str
    instance: Instance

    @property
    def name(self) -> str:
        """Name in plans and manifests, without case."""
        return f"{self.domain} {self.section} {shown_key(self.section, self.instance)}".casefold()


@dataclass(frozen=True, slots=True)
class ControllerSnapshot:
    """Snapshot of a controller."""

    id: str
    shown: str
    robotware: str
    mode: str
    state: str
    running: bool
    """True if the program of the NORMAL tasks runs."""
    tasks: tuple[TaskState, ...]
    rows: tuple[Row, ...]
    modules: Mapping[str, tuple[str, ...]]
    """Modules in memory of the given tasks, by lower-case task name."""
    builds: Mapping[str, str]
    """BUILD_ID in memory of those tasks; empty if there is none."""
    grants: frozenset[str] = frozenset()
    """Grants of the user by UAS name; empty if the controller reports none."""

    @property
    def orphans(self) -> tuple[str, ...]:
        """Background tasks without cfg, which exist until a restart."""
        rows = {r.title.casefold() for r in self.rows if r.section == "CAB_TASKS"}
        background = (t.name for t in self.tasks if t.kind != "normal")
        return tuple(n for n in background if rows and n.casefold() not in rows)

    @property
    def texts(self) -> tuple[CfgText, ...]:
        """The cfg as files, one a domain."""
        result = []
        for domain in dict.fromkeys(row.domain for row in self.rows):
            rows = [row for row in self.rows if row.domain == domain]
            sections = tuple(
                Section(name, tuple(r.instance for r in rows if r.section == name))
                for name in dict.fromkeys(r.section for r in rows)
            )
            result.append(CfgText(domain, None, sections, f"{domain} of {self.shown}"))
        return tuple(result)

    def normal(self, task: str) -> bool:
        """True if a task keeps its modules over a restart."""
        return any(t.kind == "normal" and t.name.casefold() == task.casefold() for t in self.tasks)


def look(
    services: "Controller",
    references: Keyed,
    tasks: Iterable[str],
    symbols: Mapping[str, tuple[str, ...]],
) -> ControllerSnapshot:
    """Read the snapshot.

    `references` are the instances that we write or have written, `tasks` those whose memory
    matters, `symbols` the place of BUILD_ID in each (`MODULE/NAME`). Raises RobotError.
    """
    who, panel = services.identity(), services.panel()
    there = services.tasks()
    known = {t.name.casefold(): t.name for t in there}
    own = [known[t.casefold()] for t in dict.fromkeys(tasks) if t.casefold() in known]
    normal = {t.name for t in there if t.kind == "normal"}
    kind = "virtual, " if who.is_virtual else ""
    return ControllerSnapshot(
        who.id,
        f"{who.name} ({kind}RobotWare {who.robotware})",
        who.robotware,
        panel.mode,
        panel.state,
        services.execution().running,
        there,
        tuple(_rows(services, references)),
        {t.casefold(): tuple(m.name for m in services.modules(t)) for t in own},
        {
            # An interruption may leave old and new modules in the memory that a restart keeps.
            # Others are read from files, except the one whose file was missing at that moment: the
            # one that is switched last and loaded first.
            t.casefold(): build_in(services, t, _some(symbols.get(t, ()), complete=t in normal))
            for t in own
        },
        services.grants(),
    )


def _some(symbols: Sequence[str], *, complete: bool) -> Sequence[str]:
    return symbols if complete or len(symbols) < 3 else (symbols[0], symbols[-1])


def build_in(services: "Controller", task: str, symbols: Sequence[str]) -> str:
    """Return BUILD_ID in a task's memory.

    Empty if there is none, or if its modules differ. Raises RobotError.
    """
    result: set[str] = set()
    for symbol in symbols:
        try:
            value = services.symbol(f"{task}/{symbol}")
        except RwsError as error:
            if error.status >= 500:
                raise
            value = ""
        result.add(value if isinstance(value, str) else "")
    return result.pop() if len(result) == 1 else ""


def build_symbols(desired: DriverSet) -> dict[str, tuple[str, ...]]:
    """Return `MODULE/NAME` of each module with a BUILD_ID, by task."""
    declared = rf'^\s*(?:LOCAL\s+)?CONST\s+string\s+(\w+)\s*:=\s*"{re.escape(desired.build_id)}"'
    pattern = re.compile(declared.encode(), re.M | re.I)
    result: dict[str, tuple[str, ...]] = {}
    for file in desired.files:
        module, name = MODULE.search(file.data), pattern.search(file.data)
        if file.kind == "module" and module and name:
            symbol = f"{module[1].decode()}/{name[1].decode()}"
            for task in file.tasks:
                result[task] = (*result.get(task, ()), symbol)
    return result


def _rows(services: "Controller", references: Keyed) -> Iterator[Row]:
    desired = [(domain, section) for domain, section, _ in references]
    for domain, section in dict.fromkeys([*SECTIONS, *desired]):
        known = [i for key, i in references.items() if key[:2] == (domain, section)]
        try:
            result = services.cfg_instances(domain, section)
        except RwsError as error:
            if error.symbol not in _NONE and error.status != 404:
                raise
            continue
        for one in result:
            yield Row(domain, section, one.name, _instance(section, one, known))


def _instance(section: str, text: CfgInstance, known: Sequence[Instance]) -> Instance:
    for reference in known:
        seen = _through(text, reference)
        if shown_key(section, seen).casefold() == shown_key(section, reference).casefold():
            return seen
    # A default that no plan set: empty and false mean nothing.
    given = [(k, v) for k, v in text.attributes.items() if v and v.lower() != "false"]
    return Instance(tuple(_attribute(k, v, flag=v.lower() == "true") for k, v in given))


def _through(text: CfgInstance, reference: Instance) -> Instance:
    """Return the attributes of a reference."""
    values = {name.casefold(): value for name, value in text.attributes.items()}
    result = []
    for attribute in reference.attributes:
        value = values.get(attribute.name.casefold())
        flag = not attribute.values
        if value is not None and not (flag and value.lower() != "true"):
            result.append(_attribute(attribute.name, value, flag=flag))
    return Instance(tuple(result))


def _attribute(name: str, value: str, *, flag: bool) -> Attribute:
    return Attribute(name) if flag else Attribute(name, (value,))
