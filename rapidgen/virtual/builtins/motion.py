"""Move instructions: MoveAbsJ, MoveExtJ, MoveJ, MoveL, MoveC and their DO and Sync forms.

Sources: 3HAC050917 (RobotWare 6) for arguments; S4 datasys 2-MoveAbsJ, 2-MoveL, 2-MoveC,
2-MoveLDO and 2-MoveLSync for behaviour.
"""

from dataclasses import replace
from math import inf
from typing import Any, TypeAlias

from rapidgen.virtual.compiler.symbols import Routine
from rapidgen.virtual.errors import RapidError
from rapidgen.virtual.interrupts import Interrupt
from rapidgen.virtual.io import AnySignal
from rapidgen.virtual.motion.access import here, moving_group
from rapidgen.virtual.motion.arguments import dwell_of, speed_of, target_of, time_of, zone_of
from rapidgen.virtual.motion.moves import Carrier, From, JointMove, PathEvent
from rapidgen.virtual.motion.request import Request
from rapidgen.virtual.motion.targets import carrier_of
from rapidgen.virtual.registry import builtin
from rapidgen.virtual.task import Task
from rapidgen.virtual.values import Ref

Data: TypeAlias = Any
_NO_OFFSETS = (0.0,) * 6


@builtin("MoveAbsJ", cost="move")
def move_abs_j(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    no_offsets: bool | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    zone: Data,
    radius: float | None,
    stop: Data,
    tool: Ref,
    work_object: Ref | None,
    _load: Ref | None,
) -> None:
    """Displacement does not count here, offsets of external axes do (S4 datasys 2-MoveAbsJ-3)."""
    group = moving_group(task)
    modal = group.modal
    offsets = _NO_OFFSETS if no_offsets else modal.external_offset
    tool_data = tool.get()
    object_data = work_object.get() if work_object is not None else None
    carrier = Carrier()
    if group.kinematics is not None:
        carrier = carrier_of(group, tool_data, object_data)
    group.use(tool_data, object_data)
    group.move(
        task,
        JointMove(
            target=group.with_active(target_of(to, group.map, group.path_target, offsets)),
            speed=speed_of(speed, tcp_speed, modal),
            zone=zone_of(zone, radius, stop),
            time=time_of(time, modal),
            concurrent=bool(concurrent),
            dwell=dwell_of(stop),
            carrier=carrier,
            place=here(task),
        ),
    )


@builtin("MoveExtJ", cost="move")
def move_ext_j(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    use_offsets: bool | None,
    speed: Data,
    time: float | None,
    zone: Data,
    stop: Data,
) -> None:
    """Robot axes stay where the path ends, and only the speeds of external axes count."""
    group = moving_group(task)
    modal = group.modal
    ends = group.path_target
    target = target_of(to, group.map, ends, modal.external_offset if use_offsets else _NO_OFFSETS)
    target = group.with_active(
        tuple(
            new if joint.axis.startswith("eax") else old
            for joint, new, old in zip(group.config.joints, target, ends, strict=True)
        )
    )
    group.move(
        task,
        JointMove(
            target=target,
            speed=replace(speed_of(speed, None, modal), tcp=inf, orientation=inf),
            zone=zone_of(zone, None, stop),
            time=time_of(time, modal),
            concurrent=bool(concurrent),
            dwell=dwell_of(stop),
            place=here(task),
        ),
    )


@builtin("MoveJ", cost="move")
def move_j(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    zone: Data,
    radius: float | None,
    stop: Data,
    tool: Ref,
    work_object: Ref | None,
    _load: Ref | None,
) -> None:
    """To a robtarget, all axes together."""
    request = Request(
        speed=speed,
        tool=tool,
        zone=zone,
        work_object=work_object,
        tcp_speed=tcp_speed,
        time=time,
        radius=radius,
        stop=stop,
        concurrent=concurrent,
    )
    group, move = request.joint(task, to)
    group.move(task, move)


@builtin("MoveL", cost="move")
def move_l(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    zone: Data,
    radius: float | None,
    stop: Data,
    tool: Ref,
    work_object: Ref | None,
    _correction: bool | None,
    _load: Ref | None,
) -> None:
    """The TCP on a straight line."""
    move_c(
        task, concurrent, None, to, _identity, speed, tcp_speed, time, zone, radius, stop, tool,
        work_object, _correction, _load,
    )  # fmt: skip


@builtin("MoveC", cost="move")
def move_c(
    task: Task,
    concurrent: bool | None,
    via: Data,
    to: Data,
    _identity: float | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    zone: Data,
    radius: float | None,
    stop: Data,
    tool: Ref,
    work_object: Ref | None,
    _correction: bool | None,
    _load: Ref | None,
) -> None:
    """The TCP on the circle through `via`; without it on a line."""
    request = Request(
        speed=speed,
        tool=tool,
        zone=zone,
        work_object=work_object,
        tcp_speed=tcp_speed,
        time=time,
        radius=radius,
        stop=stop,
        concurrent=concurrent,
    )
    group, move = request.cartesian(task, to, via)
    group.move(task, move)


# -- with a signal, or a procedure, in the middle of the corner ---------------------------------


def _setting(task: Task, signal: AnySignal, value: float) -> PathEvent:
    """The output changes in the middle of the corner, at a stop point on arrival."""
    if value not in (0, 1):
        raise RapidError("ERR_ARGVALERR", f"{signal.signal.name} to {value:g}")
    io = task.controller.io
    return PathEvent(From.MIDDLE, 0.0, lambda: io.set(signal.signal, value))


def _calling(task: Task, name: str) -> PathEvent:
    """The procedure runs when the task next attends, as a trap would; not inside a trap."""
    routine = task.program.globals.get(name.lower())
    if not isinstance(routine, Routine) or routine.kind != "PROC":
        raise RapidError("ERR_REFUNKPRC", name)

    def call() -> None:
        task.interrupts.queue.append((Interrupt(0, routine), None))
        task.kick()

    return PathEvent(From.MIDDLE, 0.0, call)


def _with_event(task: Task, to: Data, via: Data, *, linear: bool, request: Request) -> None:
    group, move = request.cartesian(task, to, via) if linear else request.joint(task, to)
    group.move(task, move)


@builtin("MoveJDO", cost="move")
def move_j_do(
    task: Task,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    signal: AnySignal,
    value: float,
    _load: Ref | None,
) -> None:
    """MoveJ that sets a digital output in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_setting(task, signal, value),),
    )  # fmt: skip
    _with_event(task, to, None, linear=False, request=request)


@builtin("MoveLDO", cost="move")
def move_l_do(
    task: Task,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    signal: AnySignal,
    value: float,
    _load: Ref | None,
) -> None:
    """MoveL that sets a digital output in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_setting(task, signal, value),),
    )  # fmt: skip
    _with_event(task, to, None, linear=True, request=request)


@builtin("MoveCDO", cost="move")
def move_c_do(
    task: Task,
    via: Data,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    signal: AnySignal,
    value: float,
    _load: Ref | None,
) -> None:
    """MoveC that sets a digital output in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_setting(task, signal, value),),
    )  # fmt: skip
    _with_event(task, to, via, linear=True, request=request)


@builtin("MoveJSync", cost="move")
def move_j_sync(
    task: Task,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    procedure: str,
    _load: Ref | None,
) -> None:
    """MoveJ that calls a procedure in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_calling(task, procedure),),
    )  # fmt: skip
    _with_event(task, to, None, linear=False, request=request)


@builtin("MoveLSync", cost="move")
def move_l_sync(
    task: Task,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    procedure: str,
    _load: Ref | None,
) -> None:
    """MoveL that calls a procedure in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_calling(task, procedure),),
    )  # fmt: skip
    _with_event(task, to, None, linear=True, request=request)


@builtin("MoveCSync", cost="move")
def move_c_sync(
    task: Task,
    via: Data,
    to: Data,
    _identity: float | None,
    speed: Data,
    time: float | None,
    zone: Data,
    tool: Ref,
    work_object: Ref | None,
    procedure: str,
    _load: Ref | None,
) -> None:
    """MoveC that calls a procedure in the corner."""
    request = Request(
        speed=speed, tool=tool, zone=zone, work_object=work_object, time=time,
        events=(_calling(task, procedure),),
    )  # fmt: skip
    _with_event(task, to, via, linear=True, request=request)
