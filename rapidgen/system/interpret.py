"""Between cfg instances and the system model, in both directions.

Attribute names and their defaults are those of cfg files of real controllers; the ones that
are only remembered are marked [mem].
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, cast, get_args

from rapidgen.diagnostics import DiagnosticError, Span, refusal, suggest
from rapidgen.system.cfg import Attribute, CfgText, Instance, Scalar, Section
from rapidgen.system.model import (
    CrossConnection,
    EventRoutine,
    MechanicalUnitGroup,
    ModuleFile,
    QueueSpec,
    SignalSpec,
    SignalType,
    System,
    SystemInput,
    SystemOutput,
    TaskSpec,
    TaskType,
    TrustLevel,
)

# [mem] The file says "None" where the pendant shows NoSafety.
_TRUST_TEXT: dict[str, str] = {"NONE": "NoSafety", "NOSAFETY": "NoSafety"}
_MAX_ACTORS = 5
_MAX_BIT = 1 << 16
"""Bits of a device; a map beyond is no map."""
_QUEUE = QueueSpec()


@dataclass(frozen=True, slots=True)
class ModuleEntry:
    """One CAB_TASK_MODULES instance: a file and the tasks that load it."""

    file: str
    tasks: tuple[str, ...] = ()
    shared: bool = False
    all_tasks: bool = False
    all_motion_tasks: bool = False
    line: int = 0
    installed: bool = False

    def loads_into(self, task: TaskSpec) -> bool:
        """Whether `task` loads this file (a shared module is seen by every task)."""
        return (
            self.all_tasks
            or self.shared
            or (self.all_motion_tasks and task.motion)
            or any(name.casefold() == task.name.casefold() for name in self.tasks)
        )


# -- text to model -------------------------------------------------------------------------


def tasks_of(cfg: CfgText) -> tuple[TaskSpec, ...]:
    """CAB_TASKS in order, without modules. Raises RG708 for a fault in one."""
    found = []
    for instance in cfg.instances("CAB_TASKS"):
        name = _name(cfg, instance)
        kind = _word(cfg, instance, "Type", instance.text("Type") or "SEMISTATIC", TaskType)
        trust = instance.text("TrustLevel") or "SysFail"
        trust = _TRUST_TEXT.get(trust.upper(), trust)
        found.append(
            TaskSpec(
                name,
                cast(TaskType, kind),
                cast(TrustLevel, _word(cfg, instance, "TrustLevel", trust, TrustLevel)),
                instance.text("Entry") or "main",
                instance.flag("MotionTask"),
                instance.text("UseMechanicalUnitGroup"),
                queue=QueueSpec(
                    instance.text("RmqType").upper() != "NONE",
                    int(instance.number("RmqMaxMsgSize")) or _QUEUE.max_size,
                    int(instance.number("RmqMaxNoOfMsg")) or _QUEUE.max_messages,
                ),
            )
        )
    return tuple(found)


def modules_of(cfg: CfgText) -> tuple[ModuleEntry, ...]:
    """CAB_TASK_MODULES in order, which is the order of loading."""
    return tuple(
        ModuleEntry(
            instance.text("File"),
            tuple(
                str(value)
                for attribute in instance.attributes
                if attribute.name.casefold() == "task"
                for value in attribute.values
            ),
            instance.flag("Shared"),
            instance.flag("AllTask"),
            instance.flag("AllMotionTask"),
            instance.line,
            instance.flag("Install"),
        )
        for instance in cfg.instances("CAB_TASK_MODULES")
    )


def events_of(cfg: CfgText) -> tuple[EventRoutine, ...]:
    """CAB_EXEC_HOOKS in order."""
    return tuple(
        EventRoutine(
            instance.text("Routine"),
            instance.text("Shelf"),
            instance.text("Task"),
            instance.flag("AllMotionTask") or instance.flag("AllMotionTasks"),
        )
        for instance in cfg.instances("CAB_EXEC_HOOKS")
    )


def groups_of(cfg: CfgText) -> tuple[MechanicalUnitGroup, ...]:
    """MECHANICAL_UNIT_GROUP in order."""
    return tuple(
        MechanicalUnitGroup(
            _name(cfg, instance),
            instance.text("Robot"),
            tuple(
                str(attribute.values[0])
                for attribute in instance.attributes
                if attribute.name.casefold().startswith("mechanicalunit_") and attribute.values
            ),
            instance.text("UseMotionPlanner"),
        )
        for instance in cfg.instances("MECHANICAL_UNIT_GROUP")
    )


def signals_of(cfg: CfgText) -> tuple[SignalSpec, ...]:
    """EIO_SIGNAL in order (`-Device` on RobotWare 6, `-Unit` on 5)."""
    found = []
    for instance in cfg.instances("EIO_SIGNAL"):
        kind = _word(cfg, instance, "SignalType", instance.text("SignalType"), SignalType)
        bits = _bits(instance.text("DeviceMap") or instance.text("UnitMap"))
        found.append(
            SignalSpec(
                _name(cfg, instance),
                cast(SignalType, kind),
                instance.text("Access") or "Default",
                instance.number("Default"),
                instance.text("Device") or instance.text("Unit"),
                int(instance.number("Size")) or len(bits) or 1 if kind in ("GI", "GO") else 1,
                bits,
                instance.number("MinLog"),
                instance.number("MaxLog"),
            )
        )
    return tuple(found)


def outputs_of(cfg: CfgText) -> tuple[SystemOutput, ...]:
    """SYSSIG_OUT in order; the argument is `-Arg2` (a task) or else `-Arg1`."""
    return tuple(
        SystemOutput(
            instance.text("Status"),
            instance.text("Signal"),
            instance.text("Arg2") or instance.text("Arg1"),
        )
        for instance in cfg.instances("SYSSIG_OUT")
    )


def inputs_of(cfg: CfgText) -> tuple[SystemInput, ...]:
    """SYSSIG_IN in order."""
    return tuple(
        SystemInput(instance.text("Action"), instance.text("Signal"), instance.text("Arg1"))
        for instance in cfg.instances("SYSSIG_IN")
    )


def crosses_of(cfg: CfgText) -> tuple[CrossConnection, ...]:
    """EIO_CROSS in order: up to five actors."""
    found = []
    for instance in cfg.instances("EIO_CROSS"):
        actors = []
        operators: list[Literal["AND", "OR"]] = []
        for n in range(1, _MAX_ACTORS + 1):
            if not instance.text(f"Act{n}"):
                break
            actors.append((instance.text(f"Act{n}"), instance.flag(f"Act{n}_invert")))
            operators.append("OR" if instance.text(f"Oper{n}").upper() == "OR" else "AND")
        if not instance.text("Res") or not actors:
            raise _fault(cfg, instance, "a cross connection needs -Res and -Act1")
        found.append(
            CrossConnection(
                instance.text("Name"), instance.text("Res"), tuple(actors), tuple(operators[:-1])
            )
        )
    return tuple(found)


# -- model to text -------------------------------------------------------------------------


def sys_cfg(system: System) -> CfgText:
    """The SYS domain: tasks, their modules, event routines and mechanical unit groups."""
    modules: dict[str, list[str]] = {}
    files: dict[str, ModuleFile] = {}
    for task in system.tasks:
        for module in task.modules:
            if module.target:
                modules.setdefault(module.target, []).append(task.name)
                files[module.target] = module
    sections = [
        _section("CAB_TASKS", map(_task, system.tasks)),
        _section(
            "CAB_TASK_MODULES",
            (
                instance
                for target, tasks in modules.items()
                for instance in _module(files[target], tasks)
            ),
        ),
        _section(
            "CAB_EXEC_HOOKS",
            (
                _instance(
                    ("Routine", e.routine),
                    ("Shelf", e.event),
                    *((("Task", e.task),) if e.task else ()),
                    *((("AllMotionTask",),) if e.all_motion_tasks else ()),
                )
                for e in system.events
            ),
        ),
        _section("MECHANICAL_UNIT_GROUP", map(_unit_group, system.groups)),
    ]
    return CfgText("SYS", (system.robotware[0], 0), tuple(s for s in sections if s.instances))


def eio_cfg(system: System) -> CfgText:
    """The EIO domain: signals, system outputs and inputs, cross connections."""
    unit = "Unit" if system.robotware[0] <= 5 else "Device"
    sections = [
        _section("EIO_SIGNAL", (_signal(signal, unit) for signal in system.signals)),
        _section(
            "SYSSIG_OUT",
            (
                _instance(
                    ("Status", o.status),
                    ("Signal", o.signal),
                    *((("Arg2", o.argument),) if o.argument else ()),
                )
                for o in system.outputs
            ),
        ),
        _section(
            "SYSSIG_IN",
            (
                _instance(
                    ("Action", i.action),
                    ("Signal", i.signal),
                    *((("Arg1", i.argument),) if i.argument else ()),
                )
                for i in system.inputs
            ),
        ),
        _section("EIO_CROSS", map(_cross, system.cross)),
    ]
    minor = 1 if system.robotware[0] == 6 else 0
    return CfgText("EIO", (system.robotware[0], minor), tuple(s for s in sections if s.instances))


def _task(task: TaskSpec) -> Instance:
    attributes: list[tuple[str, *tuple[Scalar, ...]]] = [("Name", task.name)]
    if task.type != "SEMISTATIC":
        attributes.append(("Type", task.type))
    attributes.append(("BindRef", 0))
    attributes.append(("Entry", task.entry))
    if task.mechanical_unit_group:
        attributes.append(("UseMechanicalUnitGroup", task.mechanical_unit_group))
    if task.trust != "SysFail":
        attributes.append(("TrustLevel", "None" if task.trust == "NoSafety" else task.trust))
    if task.motion:
        attributes.append(("MotionTask",))
    if not task.queue.open:
        attributes.append(("RmqType", "None"))
    if task.queue.max_size != _QUEUE.max_size:
        attributes.append(("RmqMaxMsgSize", task.queue.max_size))
    if task.queue.max_messages != _QUEUE.max_messages:
        attributes.append(("RmqMaxNoOfMsg", task.queue.max_messages))
    return _instance(*attributes)


def _module(file: ModuleFile, tasks: Iterable[str]) -> list[Instance]:
    """One instance for each task, but one for all of a shared module."""
    head = (("File", file.target), ("ModName", file.name))
    built_in = (("Install",),) if file.installed else ()
    if file.shared:
        return [_instance(*head, ("Shared",), *built_in)]
    return [_instance(*head, ("Task", task), *built_in) for task in tasks]


def _unit_group(group: MechanicalUnitGroup) -> Instance:
    return _instance(
        ("Name", group.name),
        *((("Robot", group.robot),) if group.robot else ()),
        *((f"MechanicalUnit_{n}", unit) for n, unit in enumerate(group.units, 1)),
        *((("UseMotionPlanner", group.planner),) if group.planner else ()),
    )


def _signal(signal: SignalSpec, unit: str) -> Instance:
    attributes: list[tuple[str, *tuple[Scalar, ...]]] = [
        ("Name", signal.name),
        ("SignalType", signal.type),
    ]
    if signal.device:
        attributes.append((unit, signal.device))
    if signal.bits:
        attributes.append((f"{unit}Map", ",".join(map(str, signal.bits))))
    if signal.type in ("GI", "GO"):
        attributes.append(("Size", signal.size))
    if signal.access != "Default":
        attributes.append(("Access", signal.access))
    if signal.default:
        whole = int(signal.default)
        attributes.append(("Default", whole if whole == signal.default else signal.default))
    if signal.low or signal.high:
        attributes += [("MinLog", signal.low), ("MaxLog", signal.high)]
    return _instance(*attributes)


def _cross(cross: CrossConnection) -> Instance:
    attributes: list[tuple[str, *tuple[Scalar, ...]]] = []
    if cross.name:
        attributes.append(("Name", cross.name))
    attributes.append(("Res", cross.result))
    for n, (signal, inverted) in enumerate(cross.actors, 1):
        attributes.append((f"Act{n}", signal))
        if inverted:
            attributes.append((f"Act{n}_invert",))
        if n <= len(cross.operators):
            attributes.append((f"Oper{n}", cross.operators[n - 1]))
    return _instance(*attributes)


def _section(name: str, instances: Iterable[Instance]) -> Section:
    return Section(name, tuple(instances))


def _instance(*attributes: tuple[str, *tuple[Scalar, ...]]) -> Instance:
    return Instance(
        tuple(Attribute(name, values) for name, *rest in attributes for values in (tuple(rest),))
    )


# -- faults --------------------------------------------------------------------------------


def _name(cfg: CfgText, instance: Instance) -> str:
    name = instance.text("Name")
    if not name:
        raise _fault(cfg, instance, "the instance has no -Name")
    return name


def _word(cfg: CfgText, instance: Instance, attribute: str, word: str, kind: object) -> str:
    """`word` in the spelling of the Literal type `kind`."""
    known = {str(value).casefold(): str(value) for value in get_args(kind)}
    found = known.get(word.casefold())
    if found is None:
        raise _fault(
            cfg,
            instance,
            f"-{attribute} '{word}' is none of {', '.join(known.values())}",
            suggest(word, list(known.values())),
        )
    return found


def _bits(mapped: str) -> tuple[int, ...]:
    """Bits in a map such as `0-7` or `0-3,8`, the first one least significant [mem]."""
    if not re.fullmatch(r"[\d\s,-]+", mapped):
        return ()
    found: list[int] = []
    for part in mapped.split(","):
        ends = [int(end) for end in part.split("-") if end.strip()]
        if ends and max(ends) < _MAX_BIT:
            step = 1 if ends[-1] >= ends[0] else -1
            found += range(ends[0], ends[-1] + step, step)
    return tuple(found)


def _fault(cfg: CfgText, instance: Instance, label: str, help: str = "") -> DiagnosticError:
    return refusal(
        "RG708",
        Span(cfg.path, max(instance.line, 1), 1),
        "an instance in a cfg file cannot be understood",
        help,
        label=label,
    )
