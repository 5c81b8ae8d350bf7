"""Layout of tasks and modules, and the System for the cfg files.

docs/develop/driver-design.md gives the structure (one reader, one supervisor, one state server and
the motion task for each motion group) and its reasons.
"""

from dataclasses import dataclass, replace

from rapidgen.config.model import GroupConfig, Joint, RobotConfig
from rapidgen.generate.status import STATUS_SIGNALS, StatusSignal
from rapidgen.system import (
    EventRoutine,
    ModuleFile,
    SignalSpec,
    System,
    SystemOutput,
    TaskSpec,
)
from rapidgen.system.model import TaskType

COMMON, SERVER = "ROS_common", "ROS_server"
STREAM, PROGRAMS, EXECUTION = "ROS_stream", "ROS_programs", "ROS_execution"
EGM = "ROS_egm"
ZONES = "ROS_zones"

OF_FULL = (STREAM, PROGRAMS, EXECUTION)
"""Modules that the profile `basic` lacks."""


@dataclass(frozen=True, slots=True)
class TaskRole:
    """One task of a motion group; the group gives the motion task's name."""

    name: str
    task: str
    modules: tuple[str, ...]
    """In loading order: a module comes after those that it uses."""


ROLES = (
    TaskRole("motion", "", (COMMON, EXECUTION, EGM, ZONES, "ROS_motion")),
    TaskRole("motion_server", "T_ROS_RECV", (COMMON, SERVER, PROGRAMS, STREAM, "ROS_motionServer")),
    TaskRole("supervisor", "T_ROS_SUP", (COMMON, "ROS_supervisor")),
    TaskRole("control", "T_ROS_CONTROL", (COMMON, SERVER, "ROS_control")),
    TaskRole("state", "T_ROS_STATE", (COMMON, SERVER, "ROS_stateServer")),
)
SYSTEM_MODULES = (COMMON, SERVER, ZONES)


def roles(config: RobotConfig, group: GroupConfig) -> tuple[TaskRole, ...]:
    """Return the tasks of a group, with the modules of its profile and options."""
    left_out = () if config.profile == "full" else OF_FULL
    if group.egm is None:
        left_out = (*left_out, EGM)
    if not group.world_zones:
        left_out = (*left_out, ZONES)
    return tuple(
        replace(role, modules=tuple(m for m in role.modules if m not in left_out))
        for role in ROLES
        if role.name != "control" or group.ports.control
    )


def modules(config: RobotConfig, group: GroupConfig) -> tuple[str, ...]:
    """Return the modules of a group, each once; shared ones come first."""
    used = dict.fromkeys(m for role in roles(config, group) for m in role.modules)
    return (
        *(m for m in SYSTEM_MODULES if m in used),
        *(m for m in used if m not in SYSTEM_MODULES),
    )


FOLDER = "rapidgen"
"""Folder of the modules in HOME: one that no other driver uses."""
EVENT_ORDER = 50
"""-SeqNo of the driver's event routines: a cell's own may come before them, and after."""


def suffix(config: RobotConfig, group: GroupConfig) -> str:
    """Return the suffix of this group's names; empty for a single group."""
    if len(config.groups) == 1:
        return ""
    return f"_{config.groups.index(group) + 1}"


def task_name(config: RobotConfig, group: GroupConfig, role: TaskRole) -> str:
    """Return the name of the task with `role` in a group."""
    return (role.task + suffix(config, group)) if role.task else group.task


def module_file(config: RobotConfig, group: GroupConfig, module: str) -> str:
    """Return the path of a module below HOME.

    Groups have a folder each: their PERS differ in name.
    """
    kind = "sys" if module in SYSTEM_MODULES else "mod"
    ending = f"{kind}x" if config.robotware[0] >= 7 else kind
    folder = FOLDER if len(config.groups) == 1 else f"{FOLDER}/{group.name}"
    return f"{folder}/{module}.{ending}"


def signal_name(config: RobotConfig, group: GroupConfig, signal: StatusSignal) -> str:
    """Return the name of a status signal, with the group's suffix if needed."""
    return signal.base + (suffix(config, group) if signal.of else "")


def open_signals(config: RobotConfig) -> frozenset[str]:
    """Return status signals without a confirmed system output.

    No file of this RobotWare had it.
    """
    return frozenset(
        signal_name(config, group, signal)
        for group in config.groups
        for signal in STATUS_SIGNALS
        if signal.is_open(config.robotware[0])
    )


def make_system(config: RobotConfig, build_id: str) -> System:
    """Return tasks with empty modules, signals and event routines.

    `target` gives the files of the modules.
    """
    return System(
        name=config.name,
        tasks=tuple(
            # As on a controller: its own motion tasks come first, then the added tasks.
            sorted(
                (
                    _task(config, group, role)
                    for group in config.groups
                    for role in roles(config, group)
                ),
                key=lambda task: not task.motion,
            )
        ),
        signals=_signals(config),
        outputs=_outputs(config),
        events=tuple(
            EventRoutine(routine, event, group.task, order=EVENT_ORDER)
            for group in config.groups
            for event, routine in (
                ("POWER_ON", "ROS_on_power"),
                ("START", "ROS_on_start"),
                ("RESTART", "ROS_on_continue"),
                ("STOP", "ROS_on_stop"),
                ("QSTOP", "ROS_on_stop"),
            )
        )
        + _zones(config)
        + _restarts(config),
        robotware=config.robotware,
        build_id=build_id,
    )


def _zones(config: RobotConfig) -> tuple[EventRoutine, ...]:
    """Return the event routines that define World Zones."""
    return tuple(
        EventRoutine("ROS_define_zones", "POWER_ON", group.task, order=EVENT_ORDER)
        for group in config.groups
        if group.world_zones
    )


def _restarts(config: RobotConfig) -> tuple[EventRoutine, ...]:
    """Return event routines for tasks that receive messages.

    They must know when they were stopped, also where the program stops them.
    """
    if not config.commissioning:
        return ()
    return tuple(
        EventRoutine("ROS_on_restart", event, task_name(config, group, role), order=EVENT_ORDER)
        for group in config.groups
        for role in roles(config, group)
        if role.name in ("motion_server", "control")
        for event in ("START", "RESTART")
    )


def unit_group(group: GroupConfig) -> str:
    """Return the usual name of a mechanical unit group.

    rob1 of ROB_1, rob_l of ROB_L.
    """
    return _robot(group).lower()


def _robot(group: GroupConfig) -> str:
    """Return the prefix of a robot's ARM names.

    rob1 of ROB_1, rob_L of ROB_L.
    """
    head, _, tail = group.mechanical_unit.partition("_")
    return f"{head.lower()}{tail}" if tail.isdigit() else f"{head.lower()}_{tail}".rstrip("_")


def arm(group: GroupConfig, joint: Joint) -> str:
    """Return the ARM in the controller's MOC with a joint's limits.

    Empty: not known. Robot axes have the unit's name and their number, also the seventh axis of a
    YuMi arm [code]: rob1_1, rob_R_7. The arm of an external axis has its unit's name (backups of
    controllers), as far as each unit has one axis.
    """
    kind, _, letter = joint.axis.partition("_")
    if kind == "rax":
        return f"{_robot(group)}_{letter}"
    if not group.external_units:
        return f"{_robot(group)}_{7 + 'abcdef'.index(letter)}"
    external = [j for j in group.joints if j.axis.startswith("eax_")]
    if len(external) != len(group.external_units):
        return ""
    return group.external_units[external.index(joint)]


def _task(config: RobotConfig, group: GroupConfig, role: TaskRole) -> TaskSpec:
    motion = not role.task
    background: TaskType = "NORMAL" if config.commissioning else "SEMISTATIC"
    modules = tuple(
        ModuleFile(module, "", b"", f"HOME:/{module_file(config, group, module)}")
        for module in role.modules
    )
    return TaskSpec(
        name=task_name(config, group, role),
        type="NORMAL" if motion else background,
        # A state server that ends affects no other task; without reader or supervisor the robot
        # must not continue.
        trust="SysFail" if motion else "NoSafety" if role.name == "state" else "SysStop",
        entry="main",
        motion=motion,
        mechanical_unit_group=(
            (group.unit_group or unit_group(group)) if is_multimove(config) else ""
        ),
        modules=modules,
    )


def is_multimove(config: RobotConfig) -> bool:
    """True if the controller has mechanical unit groups that tasks name."""
    return config.multimove or len(config.groups) > 1


def _signals(config: RobotConfig) -> tuple[SignalSpec, ...]:
    # Levels in files for a signal without a device that a system output drives: a backup of 6.13, a
    # file that ABB ships for 7.
    access = "All" if config.robotware[0] >= 7 else "ReadOnly"
    names = (
        signal_name(config, group, signal) for group in config.groups for signal in STATUS_SIGNALS
    )
    return tuple(SignalSpec(name, "DO", access) for name in dict.fromkeys(names))


def _outputs(config: RobotConfig) -> tuple[SystemOutput, ...]:
    result: dict[str, SystemOutput] = {}
    for group in config.groups:
        for signal in STATUS_SIGNALS:
            name = signal_name(config, group, signal)
            output = SystemOutput(
                signal.status(config.robotware[0]),
                name,
                unit=group.mechanical_unit if signal.of == "unit" else "",
                task=group.task if signal.of == "task" else "",
            )
            result.setdefault(name, output)
    return tuple(result.values())
