"""Convert cfg instances to parts of the system model.

cfg_writer.py converts them back. Attribute names and their defaults are those of cfg files of real
controllers; the ones that are only remembered are marked [mem].
"""

import re
from dataclasses import dataclass, replace
from typing import Final, Literal, cast, get_args

from rapidgen.diagnostics import DiagnosticError, Span, refusal, suggest
from rapidgen.system.cfg import CfgText, Instance
from rapidgen.system.model import (
    ArcSignals,
    CrossConnection,
    EventRoutine,
    MechanicalUnitGroup,
    QueueSpec,
    SignalSpec,
    SignalType,
    System,
    SystemInput,
    SystemOutput,
    TaskSpec,
    TaskType,
    TrustLevel,
    UdpDevice,
)

# [mem] The file has "None" where the pendant shows NoSafety.
_TRUST_TEXT: dict[str, str] = {"NONE": "NoSafety", "NOSAFETY": "NoSafety"}
_MAX_ACTORS = 5
_MAX_BIT = 1 << 16
"""Maximum bit of a device; a larger map is invalid."""
DEFAULT_QUEUE = QueueSpec()


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
        """True if `task` loads this file.

        Every task sees a shared module.
        """
        return (
            self.all_tasks
            or self.shared
            or (self.all_motion_tasks and task.motion)
            or any(name.casefold() == task.name.casefold() for name in self.tasks)
        )


MAX_TASKS = 200
MAX_MODULES = 2_000
"""Far more than a controller takes: 20 tasks."""


def tasks_of(cfg: CfgText) -> tuple[TaskSpec, ...]:
    """Return CAB_TASKS in order, without modules.

    Raises RG708 for a fault in one, or too many.
    """
    result = []
    for instance in _few(cfg, "CAB_TASKS", MAX_TASKS):
        name = _name(cfg, instance)
        kind = _word(cfg, instance, "Type", instance.text("Type") or "SEMISTATIC", TaskType)
        trust = instance.text("TrustLevel") or "SysFail"
        trust = _TRUST_TEXT.get(trust.upper(), trust)
        result.append(
            TaskSpec(
                name,
                cast(TaskType, kind),
                cast(TrustLevel, _word(cfg, instance, "TrustLevel", trust, TrustLevel)),
                instance.text("Entry") or "main",
                instance.flag("MotionTask"),
                instance.text("UseMechanicalUnitGroup"),
                queue=QueueSpec(
                    instance.text("RmqType").upper() != "NONE",
                    int(instance.number("RmqMaxMsgSize")) or DEFAULT_QUEUE.max_size,
                    int(instance.number("RmqMaxNoOfMsg")) or DEFAULT_QUEUE.max_messages,
                ),
            )
        )
    return tuple(result)


def modules_of(cfg: CfgText) -> tuple[ModuleEntry, ...]:
    """Return CAB_TASK_MODULES in order, which is the order of loading.

    Raises RG708 for too many.
    """
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
        for instance in _few(cfg, "CAB_TASK_MODULES", MAX_MODULES)
    )


def events_of(cfg: CfgText) -> tuple[EventRoutine, ...]:
    """Return CAB_EXEC_HOOKS in order."""
    return tuple(
        EventRoutine(
            instance.text("Routine"),
            instance.text("Shelf"),
            instance.text("Task"),
            instance.flag("AllMotionTask") or instance.flag("AllMotionTasks"),
            instance.flag("AllTask"),
            int(instance.number("SeqNo")),
        )
        for instance in cfg.instances("CAB_EXEC_HOOKS")
    )


def groups_of(cfg: CfgText) -> tuple[MechanicalUnitGroup, ...]:
    """Return MECHANICAL_UNIT_GROUP in order."""
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
    """Return EIO_SIGNAL in order.

    The device is `-Device` on RobotWare 6, `-Unit` on 5.
    """
    result = []
    for instance in cfg.instances("EIO_SIGNAL"):
        kind = _word(cfg, instance, "SignalType", instance.text("SignalType"), SignalType)
        bits = _bits(instance.text("DeviceMap") or instance.text("UnitMap"))
        result.append(
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
    return tuple(result)


def outputs_of(*cfgs: CfgText) -> tuple[SystemOutput, ...]:
    """Return SYSSIG_OUT in order.

    In EIO with -Signal, on RobotWare 7 in SYS with -Name.
    """
    return tuple(
        SystemOutput(
            instance.text("Status"),
            instance.text("Signal") or instance.text("Name"),
            instance.text("Arg1"),
            instance.text("Arg2"),
        )
        for cfg in cfgs
        for instance in cfg.instances("SYSSIG_OUT")
    )


def inputs_of(*cfgs: CfgText) -> tuple[SystemInput, ...]:
    """Return SYSSIG_IN in order, from the domain of SYSSIG_OUT."""
    return tuple(
        SystemInput(
            instance.text("Action"),
            instance.text("Signal") or instance.text("Name"),
            instance.text("Arg1"),
            instance.text("Arg7"),
        )
        for cfg in cfgs
        for instance in cfg.instances("SYSSIG_IN")
    )


def crosses_of(cfg: CfgText) -> tuple[CrossConnection, ...]:
    """Return EIO_CROSS in order: up to five actors."""
    result = []
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
        result.append(
            CrossConnection(
                instance.text("Name"), instance.text("Res"), tuple(actors), tuple(operators[:-1])
            )
        )
    return tuple(result)


def _few(cfg: CfgText, section: str, limit: int) -> list[Instance]:
    """Return the instances of a section, limited in number.

    Processing each of them takes time.
    """
    result = list(cfg.instances(section))
    if len(result) > limit:
        raise _fault(cfg, result[limit], f"{section} has more than {limit:,} instances")
    return result


def _name(cfg: CfgText, instance: Instance) -> str:
    name = instance.text("Name")
    if not name:
        raise _fault(cfg, instance, "the instance has no -Name")
    return name


def _word(cfg: CfgText, instance: Instance, attribute: str, word: str, kind: object) -> str:
    """Return `word` in the spelling of the Literal type `kind`."""
    known = {str(value).casefold(): str(value) for value in get_args(kind)}
    match = known.get(word.casefold())
    if match is None:
        raise _fault(
            cfg,
            instance,
            f"-{attribute} '{word}' is not one of {', '.join(known.values())}",
            suggest(word, list(known.values())),
        )
    return match


def _bits(mapped: str) -> tuple[int, ...]:
    """Return the bits of a map such as `0-7` or `0-3,8`.

    The first one is least significant [mem].
    """
    if not re.fullmatch(r"[\d\s,-]+", mapped):
        return ()
    result: list[int] = []
    for part in mapped.split(","):
        ends = [int(end) for end in part.split("-") if end.strip()]
        if ends and max(ends) < _MAX_BIT:
            step = 1 if ends[-1] >= ends[0] else -1
            result += range(ends[0], ends[-1] + step, step)
    return tuple(result)


def _fault(cfg: CfgText, instance: Instance, label: str, help: str = "") -> DiagnosticError:
    return refusal(
        "RG708",
        Span(cfg.path, max(instance.line, 1), 1),
        "an instance in a cfg file cannot be understood",
        help,
        label=label,
    )


def with_cfg(system: System, sys: CfgText, eio: CfgText) -> System:
    """Return `system` with signals, event routines and unit groups."""
    return replace(
        system,
        signals=signals_of(eio),
        outputs=outputs_of(eio, sys),
        inputs=inputs_of(eio, sys),
        cross=crosses_of(eio),
        events=events_of(sys),
        groups=groups_of(sys),
    )


def udp_devices_of(sio: CfgText) -> tuple[UdpDevice, ...]:
    """Return UDPUC devices of SIO.

    COM_TRP of type UDPUC, whose address is spelt with one d, and UDPUC_HOST, whose default port is
    6510 [cfg: MCUBE 6.03, rparak 6.x, GoFa 7.6; manual 3HAC073318].
    """
    rows = [row for row in sio.instances("COM_TRP") if row.text("Type").upper() == "UDPUC"]
    rows += sio.instances("UDPUC_HOST")
    return tuple(
        UdpDevice(
            row.text("Name"),
            row.text("RemoteAdress") or row.text("RemoteAddress"),
            int(row.number("RemotePortNumber", 6510)),
        )
        for row in rows
    )


# -- arc welding equipment -------------------------------------------------------------------------
# ARC_EQUIP_IO_DI, _DO, _AO and _GO, as PROC.cfg files of public add-ins have them
# [code zwj12/AddInPackages].

_SECTIONS: Final = ("ARC_EQUIP_IO_DI", "ARC_EQUIP_IO_DO", "ARC_EQUIP_IO_AO", "ARC_EQUIP_IO_GO")


def arc_signals(proc: CfgText) -> tuple[ArcSignals, ...]:
    """Return the equipment by instance; an empty name is no signal."""
    result: dict[str, list[tuple[str, str]]] = {}
    for section in _SECTIONS:
        for instance in proc.instances(section):
            names = result.setdefault(instance.text("name"), [])
            names += [
                (attribute.name, str(attribute.values[0]))
                for attribute in instance.attributes
                if attribute.name.lower() != "name" and attribute.values and attribute.values[0]
            ]
    return tuple(ArcSignals(name, tuple(names)) for name, names in result.items())
