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


_GUIDED = 50_453


def common(task: Task, group: MotionGroup, arguments: Arguments) -> dict[str, Value]:
    """Return the parameters common to all moves to a robtarget.

    Without a `Zone` argument (searches) the move ends in a stop point.
    """
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
    """Return a joint move to a robtarget.

    Without `checked` the nearest configuration applies.
    """
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
    """Return a linear move, or a circular one through `CirPoint`."""
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
    """Return the move with its time in synchronised movement.

    A move without synchronisation does not change. FatalError: \\ID is missing in synchronised
    movement.
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
# A move instruction creates a move, synchronises it with the moves of other robots, and appends it
# to the path.
#
# An inferred robot cannot reach every target. Robot, tool and table are assumptions, so an
# unreachable target or configuration says more about the inference than about the program. The move
# then goes to the same target by joint interpolation in the nearest configuration. If no posture
# reaches the target, the robot does not move, but the events of the move occur.
# `MotionSystem.on_missed` reports each case. A robot chosen by the user stops the program, as on a
# controller, except at its first move, which begins in an assumed position.


Maker: TypeAlias = Callable[[Task, Arguments, tuple[PathEvent, ...]], tuple[MotionGroup, Move]]
"""joint_move or cartesian_move."""
MISSING_STORE_PATH = 41_739
_PLACES = frozenset(map(errnum, ("ERR_OUTSIDE_REACH", "ERR_ROBLIMIT")))
_STOPS = frozenset((NOT_COMPATIBLE, SINGULARITY, CIRCLE_UNCERTAIN))


def order(
    task: Task, arguments: Arguments, make: Maker, events: tuple[PathEvent, ...] = ()
) -> MotionGroup:
    """Execute a move instruction and return the group that moves.

    Raises the errors of the planner.
    """
    try:
        return _put(task, arguments, *make(task, arguments, events))
    except (MotionFault, RapidError, FatalError) as raised:
        fault = in_rapid(raised) if isinstance(raised, MotionFault) else raised
        motion, group = task.controller.motion, moving_group(task)
        on_missed = motion.on_missed
        # The first move begins in an assumed position, also that of a known robot.
        is_assumed = motion.is_any_robot or group.name not in motion.moved
        if on_missed is None or not is_assumed or not _is_of_place(fault):
            raise fault from raised
        how = "by its axes, in the nearest configuration"
        if not _goes_by_its_axes(task, arguments, events):
            if not motion.is_any_robot:
                raise fault from raised
            how = "not at all"
            stay = JointMove(
                target=group.path_target, events=events, **common(task, group, arguments)
            )
            _put(task, arguments, group, stay)
    place = here(task)
    at = place() if place is not None else None
    file = f"{Path(at.span.path).name}:{at.span.line}" if isinstance(at, Location) else task.name
    on_missed(file, how)
    return group


def _put(task: Task, arguments: Arguments, group: MotionGroup, move: Move) -> MotionGroup:
    _start(task, group, move, arguments.get("ID"))
    return group


def _start(task: Task, group: MotionGroup, move: Move, identity: float | None) -> None:
    """Append a move to the path.

    A move of a trap or an error handler joins the path that it interrupted. Controllers execute it,
    with a warning unless StorePath came before.
    """
    if (task.in_trap or task.errors.handler_level) and group.path_level == 1:
        place = here(task)
        at = place() if place is not None else None
        if isinstance(at, Location):
            arguments = (task.name, at.instruction, "StorePath", at.reference)
            task.controller.log.record(MISSING_STORE_PATH, *arguments, task=task.name, span=at.span)
    if task.controller.egm.guides(group):
        # Between EGMRun \\NoWaitCond and EGMWaitCond [ros-industrial/abb_libegm, issue 110].
        raise FatalError(_GUIDED, "Move not allowed", f"{group.name} is guided by EGM")
    group.move(task, together(task, group, move, identity))
    task.controller.motion.moved.add(group.name)


def _goes_by_its_axes(task: Task, arguments: Arguments, events: tuple[PathEvent, ...]) -> bool:
    """Return True if a target is reachable by joint interpolation only.

    False for joint targets.
    """
    if "ToPoint" not in arguments:
        return False
    try:
        _put(task, arguments, *joint_move(task, arguments, events, checked=False))
    except (MotionFault, RapidError, FatalError):
        return False
    return True


def _is_of_place(fault: RapidError | FatalError) -> bool:
    """Return True if a fault concerns the target, not the instruction."""
    if isinstance(fault, RapidError):
        return fault.number in _PLACES
    return fault.event in _STOPS


def bind(
    name: str,
    make: Maker,
    events_of: Callable[[Task, Arguments], tuple[PathEvent, ...]] = lambda _task, _given: (),
) -> None:
    """Bind a move instruction to functions for its move and events."""

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
    """Move all axes to a jointtarget."""
    order(task, arguments, absolute_move)


def absolute_move(
    task: Task, arguments: Arguments, _events: tuple[PathEvent, ...] = ()
) -> tuple[MotionGroup, Move]:
    """Return a joint move to a jointtarget.

    The program displacement has no effect here; offsets of external axes do (S4 datasys
    2-MoveAbsJ-3).
    """
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
    """Move external axes only.

    Robot axes stay at the end of the path, and only the speeds of external axes apply.
    """
    group, move, _ = external_move(task, arguments)
    _start(task, group, move, arguments["ID"])


def external_move(task: Task, arguments: Arguments) -> tuple[MotionGroup, JointMove, Offsets]:
    """Return a move of external axes, and the offsets that apply."""
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
    """Return a joint move; without `Zone` (searches) to a stop point."""
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
    """Return the event that sets an output.

    It occurs in the middle of the corner, or on arrival at a stop point.
    """
    signal, value = arguments["Signal"].signal, arguments["Value"]
    expected = fitting(signal, arguments["Dvalue"] if value is None else value)
    io = task.controller.io
    return (PathEvent(MeasuredFrom.MIDDLE, 0.0, lambda: io.set(signal, expected)),)


def _calling(task: Task, arguments: Arguments) -> tuple[PathEvent]:
    """Return the event that calls a procedure.

    The procedure runs at the task's next statement, as a trap does, and never inside a trap.
    """
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
