"""Move instructions: MoveAbsJ, MoveExtJ, MoveJ, MoveL, MoveC and their forms with a signal or
a procedure.

Those to a robtarget differ in way and events only: they are bound by name at the end.

Sources: 3HAC050917 (RobotWare 6) for arguments; S4 datasys 2-MoveAbsJ, 2-MoveL, 2-MoveC,
2-MoveLDO and 2-MoveLSync for behaviour.
"""

from dataclasses import replace
from math import inf

from rapidgen.axes.kinematics import Posture
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import (
    FINE,
    JointMove,
    MeasuredFrom,
    Move,
    MoveFrames,
    MoveSpeed,
    PathEvent,
)
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.arguments import (
    Offsets,
    dwell_of,
    speed_of,
    target_of,
    time_of,
    zone_of,
)
from rapidgen.runtime.builtins.motion.cartesian_request import cartesian_move, joint_move
from rapidgen.runtime.builtins.motion.enqueue import bind, order
from rapidgen.runtime.builtins.motion.loads import check_loads
from rapidgen.runtime.builtins.motion.synchronised_moves import together
from rapidgen.runtime.builtins.motion.targets import carrier_of
from rapidgen.runtime.builtins.motion.task_group import data_of, here, moving_group
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.motion_faults import planned
from rapidgen.runtime.registry import Arguments, by_name
from rapidgen.runtime.robot_data import NO_OFFSETS
from rapidgen.runtime.task.interrupts import Interrupt
from rapidgen.runtime.task.task import Task


@by_name("MoveAbsJ", cost="move")
def move_abs_j(task: Task, _name: str, arguments: Arguments) -> None:
    """All axes to where a jointtarget says."""
    order(task, arguments, absolute_move)


def absolute_move(
    task: Task, arguments: Arguments, _events: tuple[PathEvent, ...] = ()
) -> tuple[MotionGroup, Move]:
    """Displacement does not count here, offsets of external axes do (S4 datasys 2-MoveAbsJ-3)."""
    group = moving_group(task)
    modal, data = group.modal, data_of(task, group)
    offsets = NO_OFFSETS if arguments["NoEOffs"] else data.external_offset
    tool = arguments["Tool"].get()
    work_object = arguments["WObj"].get() if arguments["WObj"] is not None else None
    carrier = MoveFrames()
    if group.kinematics is not None:
        carrier = carrier_of(group, tool, work_object)
    check_loads(task, group, arguments)
    data.use(tool, work_object)
    group.planner.tool = carrier.tool
    target = target_of(arguments["ToJointPos"], group.map, group.path_target, offsets)
    speed = speed_of(arguments["Speed"], arguments["V"], modal)
    return group, _joint_move(task, group, arguments, group.with_active(target), speed, carrier)


@by_name("MoveExtJ", cost="move")
@planned
def move_ext_j(task: Task, _name: str, arguments: Arguments) -> None:
    """Robot axes stay where the path ends, and only the speeds of external axes count."""
    group, move, _ = external_move(task, arguments)
    group.move(task, together(task, group, move, arguments["ID"]))


def external_move(task: Task, arguments: Arguments) -> tuple[MotionGroup, JointMove, Offsets]:
    """A move of external axes alone, and the offsets that it heeds."""
    group = moving_group(task)
    ends = group.path_target
    offsets = data_of(task, group).external_offset if arguments["UseEOffs"] else NO_OFFSETS
    target = target_of(arguments["ToJointPos"], group.map, ends, offsets)
    target = group.with_active(
        tuple(
            new if joint.axis.startswith("eax") else old
            for joint, new, old in zip(group.config.joints, target, ends, strict=True)
        )
    )
    speed = replace(speed_of(arguments["Speed"], None, group.modal), tcp=inf, orientation=inf)
    return group, _joint_move(task, group, arguments, target, speed, MoveFrames()), offsets


def _joint_move(
    task: Task,
    group: MotionGroup,
    arguments: Arguments,
    target: Posture,
    speed: MoveSpeed,
    carrier: MoveFrames,
) -> JointMove:
    """Without a `Zone` (searches) it ends in a stop point."""
    stop = arguments.get("Inpos")
    return JointMove(
        target=target,
        speed=speed,
        zone=zone_of(arguments["Zone"], arguments.get("Z"), stop) if "Zone" in arguments else FINE,
        time=time_of(arguments["T"], group),
        concurrent=bool(arguments.get("Conc")),
        dwell=dwell_of(stop),
        carrier=carrier,
        place=here(task),
    )


# -- with a signal, or a procedure, in the middle of the corner ---------------------------------


def _setting(task: Task, arguments: Arguments) -> tuple[PathEvent]:
    """The output changes in the middle of the corner, at a stop point on arrival."""
    signal, value = arguments["Signal"].signal, arguments["Value"]
    expected = fitting(signal, arguments["Dvalue"] if value is None else value)
    io = task.controller.io
    return (PathEvent(MeasuredFrom.MIDDLE, 0.0, lambda: io.set(signal, expected)),)


def _calling(task: Task, arguments: Arguments) -> tuple[PathEvent]:
    """The procedure runs when the task next attends, as a trap would; not inside a trap."""
    name = arguments["ProcName"]
    routine = task.program.find_routine(None, name.lower())
    if not isinstance(routine, Routine) or routine.kind != "PROC":
        raise RapidError("ERR_REFUNKPRC", name)

    def call() -> None:
        task.interrupts.queue.append((Interrupt(0, routine), None))
        task.wake_at_next_statement()

    return (PathEvent(MeasuredFrom.MIDDLE, 0.0, call),)


bind("MoveJ", joint_move)
bind("MoveL", cartesian_move)
bind("MoveC", cartesian_move)
for _kind in ("DO", "AO", "GO"):
    bind(f"MoveJ{_kind}", joint_move, _setting)
    bind(f"MoveL{_kind}", cartesian_move, _setting)
    bind(f"MoveC{_kind}", cartesian_move, _setting)
bind("MoveJSync", joint_move, _calling)
bind("MoveLSync", cartesian_move, _calling)
bind("MoveCSync", cartesian_move, _calling)
