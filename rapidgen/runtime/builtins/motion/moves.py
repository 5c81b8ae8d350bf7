"""Move instructions: MoveAbsJ, MoveExtJ, MoveJ, MoveL, MoveC and their forms with a signal or
a procedure.

Those to a robtarget differ in way and events only: they are bound by name at the end.

Sources: 3HAC050917 (RobotWare 6) for arguments; S4 datasys 2-MoveAbsJ, 2-MoveL, 2-MoveC,
2-MoveLDO and 2-MoveLSync for behaviour.
"""

from dataclasses import replace
from math import inf

from rapidgen.motion.moves import Carrier, From, JointMove, PathEvent
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.access import data_of, here, moving_group
from rapidgen.runtime.builtins.motion.arguments import (
    dwell_of,
    speed_of,
    target_of,
    time_of,
    zone_of,
)
from rapidgen.runtime.builtins.motion.request import MoveArguments, bind, cartesian_move, joint_move
from rapidgen.runtime.builtins.motion.targets import carrier_of
from rapidgen.runtime.builtins.motion.together import together
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.motion_faults import planned
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.robot_data import NO_OFFSETS
from rapidgen.runtime.task.interrupts import Interrupt
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value


@builtin("MoveAbsJ", cost="move")
@planned
def move_abs_j(
    task: Task,
    concurrent: bool | None,
    to: Value,
    identity: float | None,
    no_offsets: bool | None,
    speed: Value,
    tcp_speed: float | None,
    time: float | None,
    zone: Value,
    radius: float | None,
    stop: Value,
    tool: Ref,
    work_object: Ref | None,
    _load: Ref | None,
) -> None:
    """Displacement does not count here, offsets of external axes do (S4 datasys 2-MoveAbsJ-3)."""
    group = moving_group(task)
    modal = group.modal
    data = data_of(task, group)
    offsets = NO_OFFSETS if no_offsets else data.external_offset
    tool_data = tool.get()
    object_data = work_object.get() if work_object is not None else None
    carrier = Carrier()
    if group.kinematics is not None:
        carrier = carrier_of(group, tool_data, object_data)
    data.use(tool_data, object_data)
    group.planner.tool = carrier.tool
    move = JointMove(
        target=group.with_active(target_of(to, group.map, group.path_target, offsets)),
        speed=speed_of(speed, tcp_speed, modal),
        zone=zone_of(zone, radius, stop),
        time=time_of(time, modal),
        concurrent=bool(concurrent),
        dwell=dwell_of(stop),
        carrier=carrier,
        place=here(task),
    )
    group.move(task, together(task, group, move, identity))


@builtin("MoveExtJ", cost="move")
@planned
def move_ext_j(
    task: Task,
    concurrent: bool | None,
    to: Value,
    identity: float | None,
    use_offsets: bool | None,
    speed: Value,
    time: float | None,
    zone: Value,
    stop: Value,
) -> None:
    """Robot axes stay where the path ends, and only the speeds of external axes count."""
    group = moving_group(task)
    modal = group.modal
    ends = group.path_target
    offsets = data_of(task, group).external_offset if use_offsets else NO_OFFSETS
    target = target_of(to, group.map, ends, offsets)
    target = group.with_active(
        tuple(
            new if joint.axis.startswith("eax") else old
            for joint, new, old in zip(group.config.joints, target, ends, strict=True)
        )
    )
    move = JointMove(
        target=target,
        speed=replace(speed_of(speed, None, modal), tcp=inf, orientation=inf),
        zone=zone_of(zone, None, stop),
        time=time_of(time, modal),
        concurrent=bool(concurrent),
        dwell=dwell_of(stop),
        place=here(task),
    )
    group.move(task, together(task, group, move, identity))


# -- with a signal, or a procedure, in the middle of the corner ---------------------------------


def _setting(task: Task, given: MoveArguments) -> tuple[PathEvent]:
    """The output changes in the middle of the corner, at a stop point on arrival."""
    signal, value = given["Signal"].signal, given["Value"]
    wanted = fitting(signal, given["Dvalue"] if value is None else value)
    io = task.controller.io
    return (PathEvent(From.MIDDLE, 0.0, lambda: io.set(signal, wanted)),)


def _calling(task: Task, given: MoveArguments) -> tuple[PathEvent]:
    """The procedure runs when the task next attends, as a trap would; not inside a trap."""
    name = given["ProcName"]
    routine = task.program.find_routine(None, name.lower())
    if not isinstance(routine, Routine) or routine.kind != "PROC":
        raise RapidError("ERR_REFUNKPRC", name)

    def call() -> None:
        task.interrupts.queue.append((Interrupt(0, routine), None))
        task.kick()

    return (PathEvent(From.MIDDLE, 0.0, call),)


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
