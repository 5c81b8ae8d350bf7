"""Move instructions."""

from collections.abc import Callable
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import TypeAlias

from rapidgen.axes.kinematics import Posture
from rapidgen.machine.scheduler import SyncMoveGroup
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import (
    FINE,
    CartesianMove,
    JointMove,
    MeasuredFrom,
    Move,
    MoveFrames,
    MoveSpeed,
    PathEvent,
)
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.positions import check_loads
from rapidgen.runtime.builtins.motion.targets import (
    Offsets,
    carrier_of,
    configuration_of,
    data_of,
    dwell_of,
    external_posture,
    frame,
    geometry_of,
    here,
    joints_for,
    moving_group,
    speed_of,
    target_of,
    time_of,
    zone_of,
)
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import FatalError, Location, RapidError, errnum
from rapidgen.runtime.motion_interface import (
    CIRCLE_UNCERTAIN,
    NO_OFFSETS,
    NOT_ALLOWED,
    NOT_COMPATIBLE,
    OUT_OF_RANGE,
    SINGULARITY,
    in_rapid,
    planned,
)
from rapidgen.runtime.registry import Arguments, by_name
from rapidgen.runtime.task.interrupts import Interrupt
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value

# -- Requests --------------------------------------------------------------------------------------
#
# Move instructions to robtargets: one place where RAPID's arguments become a Move.


def common(task: Task, group: MotionGroup, arguments: Arguments) -> dict[str, Value]:
    """What every move to a robtarget has. Without a `Zone` (searches) it ends in a stop point."""
    tool = arguments["Tool"].get()
    work_object = arguments["WObj"].get() if arguments["WObj"] is not None else None
    carrier = carrier_of(group, tool, work_object)
    check_loads(task, group, arguments)
    data_of(task, group).use(tool, work_object)
    group.planner.tool = carrier.tool
    stop = arguments.get("Inpos")
    return {
        "speed": speed_of(arguments["Speed"], arguments.get("V"), group.modal),
        "zone": zone_of(arguments["Zone"], arguments.get("Z"), stop)
        if "Zone" in arguments
        else FINE,
        "time": time_of(arguments["T"], group),
        "concurrent": bool(arguments.get("Conc")),
        "dwell": dwell_of(stop),
        "carrier": carrier,
        "place": here(task),
    }


def joint_move(
    task: Task, arguments: Arguments, events: tuple[PathEvent, ...] = (), *, checked: bool = True
) -> tuple[MotionGroup, Move]:
    """To a robtarget with all axes together; not `checked`: in the nearest configuration."""
    group = moving_group(task)
    kinematics = geometry_of(group)
    shared = common(task, group, arguments)
    target = arguments["ToPoint"]
    near = external_posture(group, target.extax, data_of(task, group).external_offset)
    flange = shared["carrier"].at(near).flange(frame(target))
    expected = configuration_of(target.robconf) if checked and group.modal.check_joint else None
    check = group.settings.configuration_check
    posture = joints_for(kinematics, flange, near, expected, check, group.path_target)
    return group, JointMove(target=posture, events=events, **shared)


def cartesian_move(
    task: Task, arguments: Arguments, events: tuple[PathEvent, ...] = ()
) -> tuple[MotionGroup, Move]:
    """To a robtarget on a line, or on the circle through `CirPoint`."""
    group = moving_group(task)
    kinematics = geometry_of(group)
    shared = common(task, group, arguments)
    target, via = arguments["ToPoint"], arguments.get("CirPoint")
    expected = configuration_of(target.robconf) if group.modal.check_linear else None
    external = external_posture(group, target.extax, data_of(task, group).external_offset)
    if kinematics.seventh >= 0:
        # The seventh axis goes straight to where it is at the end, with the arm angle there.
        flange = shared["carrier"].at(external).flange(frame(target))
        check, ends = group.settings.configuration_check, group.path_target
        external = joints_for(kinematics, flange, external, expected, check, ends)
    return group, CartesianMove(
        target=frame(target),
        external=external,
        via=None if via is None else frame(via),
        wanted=expected,
        singularities=group.modal.singularities,
        circle=group.modal.circle,
        events=events,
        **shared,
    )


# -- Synchronised moves ----------------------------------------------------------------------------
#
# Synchronised movement: moves of several robots with one \ID begin and end together.
#
# Between SyncMoveOn and SyncMoveOff a move waits until every task of the list has come to the one
# of its \ID; all then take the time of the longest [mem: MultiMove is in no public source].


def together(task: Task, group: MotionGroup, move: Move, identity: float | None) -> Move:
    """The move with the time that it takes in synchronised movement; else as it is.

    FatalError: \\ID is missing in synchronised movement.
    """
    data = data_of(task, group)
    if not data.partners or data.suspended:
        return move
    if identity is None:
        raise FatalError(NOT_ALLOWED, "\\ID is missing", "between SyncMoveOn and SyncMoveOff")
    gatherings = task.controller.meetings.moves
    point, own = (data.partners, identity), task.name.lower()
    gathering = gatherings.setdefault(point, SyncMoveGroup())
    gathering.times[own] = group.whole_time(move)
    if gathering.times.keys() == data.partners:
        gathering.longest = max(gathering.times.values())
        del gatherings[point]
        gathering.changed.notify()
    else:
        try:
            task.wait_for(
                lambda: gathering.longest is not None,
                on=(gathering.changed,),
                why=lambda: (
                    f"waits for a move \\ID:={identity} of "
                    f"{', '.join(sorted(data.partners - gathering.times.keys()))}"
                ),
            )
        finally:
            if gathering.longest is None:
                del gathering.times[own]
    return replace(move, time=gathering.longest) if gathering.longest else move


# -- Path ------------------------------------------------------------------------------------------
#
# A move is made, joined with those of other robots, and put on the path.
#
# A guessed robot does not come everywhere. With robot, tool and table made up, a place out of reach
# or in another configuration says more of the guess than of the program: the move then goes to the
# same place with all axes together, in the nearest configuration, and where no posture reaches it
# the robot stays, and what the move does on its way is done there. Each is told
# (`MotionSystem.on_missed`). A robot that somebody chose stops the program, as controllers do.


Maker: TypeAlias = Callable[[Task, Arguments, tuple[PathEvent, ...]], tuple[MotionGroup, Move]]
"""joint_move or cartesian_move."""
_PLACES = frozenset(map(errnum, ("ERR_OUTSIDE_REACH", "ERR_ROBLIMIT")))
_STOPS = frozenset((NOT_COMPATIBLE, OUT_OF_RANGE, SINGULARITY, CIRCLE_UNCERTAIN))


def order(
    task: Task, arguments: Arguments, make: Maker, events: tuple[PathEvent, ...] = ()
) -> MotionGroup:
    """Execute a move instruction; the group that moves. Raises what the planner refuses."""
    try:
        return _put(task, arguments, *make(task, arguments, events))
    except (MotionFault, RapidError, FatalError) as raised:
        fault = in_rapid(raised) if isinstance(raised, MotionFault) else raised
        if task.controller.motion.on_missed is None or not _is_of_place(fault):
            raise fault from raised
    group, how = moving_group(task), "by its axes, in the nearest configuration"
    if not _goes_by_its_axes(task, arguments, events):
        how = "not at all"
        stay = JointMove(target=group.path_target, events=events, **common(task, group, arguments))
        _put(task, arguments, group, stay)
    place = here(task)
    at = place() if place is not None else None
    file = f"{Path(at.span.path).name}:{at.span.line}" if isinstance(at, Location) else task.name
    task.controller.motion.on_missed(file, how)
    return group


def _put(task: Task, arguments: Arguments, group: MotionGroup, move: Move) -> MotionGroup:
    group.move(task, together(task, group, move, arguments.get("ID")))
    return group


def _goes_by_its_axes(task: Task, arguments: Arguments, events: tuple[PathEvent, ...]) -> bool:
    """Whether a target is reached that way; one of axes is not."""
    if "ToPoint" not in arguments:
        return False
    try:
        _put(task, arguments, *joint_move(task, arguments, events, checked=False))
    except (MotionFault, RapidError, FatalError):
        return False
    return True


def _is_of_place(fault: RapidError | FatalError) -> bool:
    """Whether it is about where the robot can come, and not about the way of asking."""
    if isinstance(fault, RapidError):
        return fault.number in _PLACES
    return fault.event in _STOPS


def bind(
    name: str,
    make: Maker,
    events_of: Callable[[Task, Arguments], tuple[PathEvent, ...]] = lambda _task, _given: (),
) -> None:
    """Bind a move instruction to what makes its move and its events on the path."""

    @by_name(name, cost="move")
    def execute(task: Task, _name: str, arguments: Arguments) -> None:
        order(task, arguments, make, events_of(task, arguments))


# -- Move instructions -----------------------------------------------------------------------------
#
# Move instructions: MoveAbsJ, MoveExtJ, MoveJ, MoveL, MoveC and their forms with a signal or
# a procedure.
#
# Those to a robtarget differ in way and events only: they are bound by name at the end.
#
# Sources: 3HAC050917 (RobotWare 6) for arguments; S4 datasys 2-MoveAbsJ, 2-MoveL, 2-MoveC,
# 2-MoveLDO and 2-MoveLSync for behaviour.


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
