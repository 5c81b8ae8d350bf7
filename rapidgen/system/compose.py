"""From the system model to cfg text, as interpret.py reads it."""

from collections.abc import Iterable

from rapidgen.system.cfg import Attribute, CfgText, Instance, Scalar, Section
from rapidgen.system.interpret import DEFAULT_QUEUE
from rapidgen.system.model import (
    CrossConnection,
    MechanicalUnitGroup,
    ModuleFile,
    SignalSpec,
    System,
    TaskSpec,
)


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
    if task.queue.max_size != DEFAULT_QUEUE.max_size:
        attributes.append(("RmqMaxMsgSize", task.queue.max_size))
    if task.queue.max_messages != DEFAULT_QUEUE.max_messages:
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
