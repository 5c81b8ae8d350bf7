"""What goes where: tasks, their modules, and the System that SYS.cfg and EIO.cfg are written from.

The structure (one reader, one supervisor, one state server and the motion task for each motion
group) and its reasons are in docs/use/driver.md.
"""

from dataclasses import dataclass, replace

from rapidgen.config.model import GroupConfig, Joint, RobotConfig
from rapidgen.system import (
    Attribute,
    CfgText,
    EventRoutine,
    Instance,
    MechanicalUnitGroup,
    ModuleFile,
    Section,
    SignalSpec,
    System,
    SystemOutput,
    TaskSpec,
)
from rapidgen.system.model import TaskType

COMMON, LIMITS = "ROS_common", "ROS_limits"
MESSAGES, SOCKET = "ROS_messages", "ROS_socket"


@dataclass(frozen=True, slots=True)
class TaskRole:
    """One task of a motion group; the motion task's name is the group's own."""

    name: str
    task: str
    modules: tuple[str, ...]
    """In loading order: what a module uses comes before it."""


ROLES = (
    TaskRole("motion", "", (COMMON, "ROS_motion")),
    TaskRole(
        "motion_server",
        "T_ROS_RECV",
        (
            COMMON,
            LIMITS,
            MESSAGES,
            SOCKET,
            "ROS_acceptance",
            "ROS_download",
            "ROS_stream",
            "ROS_motionServer",
        ),
    ),
    TaskRole("supervisor", "T_ROS_SUP", (COMMON, "ROS_supervisor")),
    TaskRole("control", "T_ROS_CONTROL", (COMMON, LIMITS, MESSAGES, SOCKET, "ROS_control")),
    TaskRole("state", "T_ROS_STATE", (COMMON, LIMITS, MESSAGES, SOCKET, "ROS_stateServer")),
)
SYSTEM_MODULES = (COMMON, LIMITS, MESSAGES, SOCKET)


def roles(group: GroupConfig) -> tuple[TaskRole, ...]:
    """The tasks of a group: without a control port there is no control server."""
    return tuple(role for role in ROLES if group.ports.control or role.name != "control")


def modules(group: GroupConfig) -> tuple[str, ...]:
    """Modules of a group, each once: those that several tasks load first."""
    return tuple(dict.fromkeys((*SYSTEM_MODULES, *(m for r in roles(group) for m in r.modules))))


@dataclass(frozen=True, slots=True)
class StatusSignal:
    """A virtual output that shows a status of the controller to RAPID.

    `function` is the RAPID function (without ROS_) that reads it. `per_group`: of one motion
    task or mechanical unit.
    """

    base: str
    status: str
    function: str
    text: str
    argument: str = ""

    @property
    def per_group(self) -> bool:
        """Whether every motion group has one of its own."""
        return bool(self.argument)


# The names are abb_driver's, so that a controller that ran it keeps its signals. [mem] marks
# statuses whose cfg spelling is remembered only: the generated README says so.
STATUS_SIGNALS = (
    StatusSignal("signalMotorOn", "MotOnState", "motors_on", "Are the motors on?"),
    StatusSignal("signalRobotEStop", "EmStop", "emergency_stop", "Is an emergency stop active?"),
    StatusSignal(
        "signalExecutionError",
        "Error",
        "controller_error",
        "Has the controller stopped with an error?",
    ),
    StatusSignal(
        "signalRobotNotMoving",
        "MechUnitNotMoving",
        "standing",
        "Does the robot stand?",
        argument="unit",
    ),
    StatusSignal(
        "signalRosMotionTaskExecuting",
        "TaskExecuting",
        "executing",
        "Is the program of the motion task running?",
        argument="task",
    ),
)


def suffix(config: RobotConfig, group: GroupConfig) -> str:
    """What tells names of this group from those of the others: nothing when it is the only one."""
    if len(config.groups) == 1:
        return ""
    return f"_{config.groups.index(group) + 1}"


def task_name(config: RobotConfig, group: GroupConfig, role: TaskRole) -> str:
    """Name of the task that plays `role` for a group."""
    return (role.task + suffix(config, group)) if role.task else group.task


def module_file(config: RobotConfig, group: GroupConfig, module: str) -> str:
    """Path of a module below HOME. Groups have a folder each: their PERS differ in name."""
    kind = "sys" if module in SYSTEM_MODULES else "mod"
    ending = f"{kind}x" if config.robotware[0] >= 7 else kind
    return f"ROS{suffix(config, group)}/{module}.{ending}"


def signal_name(config: RobotConfig, group: GroupConfig, signal: StatusSignal) -> str:
    """Name of a status signal, for a group where it has its own."""
    return signal.base + (suffix(config, group) if signal.per_group else "")


def make_system(config: RobotConfig, build_id: str) -> System:
    """The tasks with empty modules (`target` tells their files), signals and event routines."""
    return System(
        name=config.name,
        tasks=tuple(_task(config, group, role) for group in config.groups for role in roles(group)),
        signals=_signals(config),
        outputs=_outputs(config),
        events=tuple(
            EventRoutine(routine, event, group.task)
            for group in config.groups
            for event, routine in (
                ("POWER_ON", "ROS_on_power"),
                ("START", "ROS_on_start"),
                ("RESTART", "ROS_on_start"),
                ("STOP", "ROS_on_stop"),
                ("QSTOP", "ROS_on_stop"),
            )
        )
        + _restarts(config),
        groups=_unit_groups(config),
        robotware=config.robotware,
        build_id=build_id,
    )


def _restarts(config: RobotConfig) -> tuple[EventRoutine, ...]:
    """Who takes messages has to know when it was stopped, where the program stops it, too."""
    if not config.commissioning:
        return ()
    return tuple(
        EventRoutine("ROS_on_restart", event, task_name(config, group, role))
        for group in config.groups
        for role in roles(group)
        if role.name in ("motion_server", "control")
        for event in ("START", "RESTART")
    )


def with_data(system: System, files: dict[str, ModuleFile]) -> System:
    """`system` with the modules that were rendered, by their HOME: path."""
    return replace(
        system,
        tasks=tuple(
            replace(task, modules=tuple(files[m.target] for m in task.modules))
            for task in system.tasks
        ),
    )


def unit_group(group: GroupConfig) -> str:
    """Name of the mechanical unit group as controllers have it: rob1 of ROB_1, rob_L of ROB_L."""
    head, _, tail = group.mechanical_unit.partition("_")
    return f"{head.lower()}{tail}" if tail.isdigit() else f"{head.lower()}_{tail}".rstrip("_")


def arm(group: GroupConfig, joint: Joint) -> str:
    """Name of the ARM in the controller's MOC that holds the limits of a joint, empty: not known.

    Robot axes have the unit's name and their number, also the seventh axis of a YuMi arm [code]:
    rob1_1, rob_R_7. The arm of an external axis has its unit's name (backups of controllers), as
    far as each unit has one axis.
    """
    kind, _, letter = joint.axis.partition("_")
    if kind == "rax":
        return f"{unit_group(group)}_{letter}"
    if not group.external_units:
        return f"{unit_group(group)}_{7 + 'abcdef'.index(letter)}"
    external = [j for j in group.joints if j.axis.startswith("eax_")]
    if len(external) != len(group.external_units):
        return ""
    return group.external_units[external.index(joint)]


def sio_cfg() -> CfgText:
    """The SIO domain of RobotWare 7: its firewall lets RAPID's sockets through.

    [mem] Section and attributes are remembered, not seen; the generated README says so.
    """
    rule = Instance((Attribute("Name", ("RapidSockets",)), Attribute("EnablePublic")))
    return CfgText("SIO", (7, 0), (Section("FIREWALL_MANAGER", (rule,)),))


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
        # A state server that dies takes nothing with it; without reader or supervisor the
        # robot must not go on.
        trust="SysFail" if motion else "NoSafety" if role.name == "state" else "SysStop",
        entry="main",
        motion=motion,
        mechanical_unit_group=unit_group(group),
        modules=modules,
    )


def _signals(config: RobotConfig) -> tuple[SignalSpec, ...]:
    found: dict[str, SignalSpec] = {}
    for group in config.groups:
        for signal in STATUS_SIGNALS:
            name = signal_name(config, group, signal)
            found.setdefault(name, SignalSpec(name, "DO", "ReadOnly"))
    return tuple(found.values())


def _outputs(config: RobotConfig) -> tuple[SystemOutput, ...]:
    found: dict[str, SystemOutput] = {}
    for group in config.groups:
        arguments = {"": "", "unit": group.mechanical_unit, "task": group.task}
        for signal in STATUS_SIGNALS:
            name = signal_name(config, group, signal)
            found.setdefault(name, SystemOutput(signal.status, name, arguments[signal.argument]))
    return tuple(found.values())


def _unit_groups(config: RobotConfig) -> tuple[MechanicalUnitGroup, ...]:
    """Groups as MultiMove wants them; a controller with one robot has its own already."""
    if len(config.groups) == 1 and not config.groups[0].external_units:
        return ()
    return tuple(
        MechanicalUnitGroup(
            unit_group(group),
            group.mechanical_unit,
            group.external_units,
            f"motion_planner_{n}",
        )
        for n, group in enumerate(config.groups, 1)
    )
