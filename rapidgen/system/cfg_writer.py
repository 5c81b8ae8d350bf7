"""Convert the system model to cfg text, as cfg_reader.py reads it."""

from collections.abc import Iterable
from typing import TypeAlias

from rapidgen._compat import Unpack
from rapidgen.system.cfg import Attribute, CfgText, Instance, Scalar, Section
from rapidgen.system.cfg_reader import DEFAULT_QUEUE
from rapidgen.system.model import (
    CrossConnection,
    EventRoutine,
    MechanicalUnitGroup,
    ModuleFile,
    SignalSpec,
    System,
    TaskSpec,
)
from rapidgen.system.releases import digits

_Row: TypeAlias = tuple[str, Unpack[tuple[Scalar, ...]]]
"""An attribute's name and its values."""

SIGNALS_IN_SYS = 7
"""RobotWare from which SYSSIG_OUT and SYSSIG_IN are in SYS instead of EIO."""


def sys_cfg(system: System, *, on_top: bool = False) -> CfgText:
    """Return the SYS domain: tasks, modules, event routines, unit groups.

    From RobotWare 7 on it also has system outputs and inputs (files that ABB ships). `on_top`: to
    be loaded into a controller, which has its own motion tasks and mechanical units.
    """
    modules: dict[str, list[str]] = {}
    files: dict[str, ModuleFile] = {}
    for task in system.tasks:
        for module in task.modules:
            if module.target:
                modules.setdefault(module.target, []).append(task.name)
                files[module.target] = module
    tasks = (task for task in system.tasks if not (on_top and task.motion))
    sections = [
        *(_system_signals(system, "Name") if system.robotware[0] >= SIGNALS_IN_SYS else ()),
        _section("CAB_TASKS", map(_task, tasks)),
        _section(
            "CAB_TASK_MODULES",
            (
                instance
                for target, tasks in modules.items()
                for instance in _module(files[target], tasks)
            ),
        ),
        _section("CAB_EXEC_HOOKS", map(_event, system.events)),
        _section("MECHANICAL_UNIT_GROUP", () if on_top else map(_unit_group, system.groups)),
    ]
    return _text("SYS", system, sections)


def eio_cfg(system: System) -> CfgText:
    """Return the EIO domain: signals, system I/O, cross connections.

    System outputs and inputs are here up to RobotWare 6.
    """
    unit = "Unit" if system.robotware[0] <= 5 else "Device"
    sections = [
        _section("EIO_SIGNAL", (_signal(signal, unit) for signal in system.signals)),
        *(_system_signals(system, "Signal") if system.robotware[0] < SIGNALS_IN_SYS else ()),
        _section("EIO_CROSS", map(_cross, system.cross)),
    ]
    return _text("EIO", system, sections)


def _text(domain: str, system: System, sections: Iterable[Section]) -> CfgText:
    version = digits(domain, system.robotware)
    return CfgText(domain, version, tuple(s for s in sections if s.instances))


def _system_signals(system: System, key: str) -> Iterable[Section]:
    """Return SYSSIG_OUT and SYSSIG_IN.

    `key` is the attribute with the signal's name.
    """
    outputs = (
        _instance(
            ("Status", o.status),
            (key, o.signal),
            *((("Arg1", o.unit),) if o.unit else ()),
            *((("Arg2", o.task),) if o.task else ()),
        )
        for o in system.outputs
    )
    inputs = (
        _instance(
            (key, i.signal),
            ("Action", i.action),
            *((("Arg1", i.argument),) if i.argument else ()),
            *((("Arg7", i.task),) if i.task else ()),
        )
        for i in system.inputs
    )
    return _section("SYSSIG_OUT", outputs), _section("SYSSIG_IN", inputs)


def _event(event: EventRoutine) -> Instance:
    return _instance(
        ("Routine", event.routine),
        ("Shelf", event.event),
        *((("Task", event.task),) if event.task else ()),
        *((("AllTask",),) if event.all_tasks else ()),
        *((("AllMotionTask",),) if event.all_motion_tasks else ()),
        *((("SeqNo", event.order),) if event.order else ()),
    )


def _task(task: TaskSpec) -> Instance:
    attributes: list[_Row] = [("Name", task.name)]
    if task.type != "SEMISTATIC":
        attributes.append(("Type", task.type))
    if task.entry.casefold() != "main":
        attributes.append(("Entry", task.entry))
    if task.mechanical_unit_group:
        attributes.append(("UseMechanicalUnitGroup", task.mechanical_unit_group))
    if task.trust != "SysFail":
        attributes.append(("TrustLevel", "None" if task.trust == "NoSafety" else task.trust))
    if task.motion:
        attributes.append(("MotionTask",))
    if not task.queue.open:
        attributes.append(("RmqType", "None"))
    if task.queue.max_size != DEFAULT_QUEUE.max_size:
        attributes.append(("RmqMaxMsgSize", task.queue.max_size))
    if task.queue.max_messages != DEFAULT_QUEUE.max_messages:
        attributes.append(("RmqMaxNoOfMsg", task.queue.max_messages))
    return _instance(*attributes)


def _module(file: ModuleFile, tasks: Iterable[str]) -> list[Instance]:
    """Return one instance for each task, but one for all of a shared module."""
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
    attributes: list[_Row] = [
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
        complete = int(signal.default)
        attributes.append(("Default", complete if complete == signal.default else signal.default))
    if signal.low or signal.high:
        attributes += [("MinLog", signal.low), ("MaxLog", signal.high)]
    return _instance(*attributes)


def _cross(cross: CrossConnection) -> Instance:
    attributes: list[_Row] = []
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


def _instance(*attributes: _Row) -> Instance:
    return Instance(
        tuple(
            Attribute(name, values)
            for name, *remaining in attributes
            for values in (tuple(remaining),)
        )
    )
