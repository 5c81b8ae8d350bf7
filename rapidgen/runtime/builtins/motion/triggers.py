"""Moves with events: triggers and arc welding."""

from collections.abc import Callable
from dataclasses import dataclass
from operator import eq, ge, gt, le, lt, ne

from rapidgen.machine.arc_equipment import REFERENCES, ArcEquipment
from rapidgen.machine.scheduler import S
from rapidgen.motion.moves import MeasuredFrom, PathEvent
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.moves import (
    bind,
    cartesian_move,
    joint_move,
    move_abs_j,
    move_ext_j,
    order,
)
from rapidgen.runtime.builtins.motion.path import MOVE_TASK
from rapidgen.runtime.builtins.motion.targets import data_of, group_of, moving_group
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import NOT_ALLOWED, NOT_SIMULATED, planned
from rapidgen.runtime.registry import Arguments, builtins, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value, register_type

# -- Triggers --------------------------------------------------------------------------------------
#
# Events at places of a move: TriggIO, TriggInt, TriggEquip, TriggCheckIO and TriggL, J, C.
#
# Sources: S4 datasys 2-TriggIO, 2-TriggInt, 2-TriggEquip, 2-TriggL; 3HAC050917 for arguments.
# A distance counts from the end (\Start: the beginning) of the move, \Time in s before the end.


@dataclass(slots=True)
class TriggData:
    """A triggdata: an event prepared by TriggIO, fired by TriggL."""

    event: PathEvent | None = None

    def set(
        self, where: MeasuredFrom, amount: float, act: Callable[[], None], lag: float = 0.0
    ) -> None:
        """Prepare the event; `amount` is in m or s, see PathEvent."""
        self.event = PathEvent(where, amount, act, lag)

    def take(self, event: PathEvent | None) -> None:
        """Copy the event of another triggdata, or none."""
        self.event = event


register_type("triggdata", TriggData)

_RELATIONS = {1: lt, 2: le, 3: eq, 4: ne, 5: ge, 6: gt}
"""opnum [mem]"""


def _where(arguments: Arguments) -> tuple[MeasuredFrom, float]:
    """Return the reference of a place, and m or (\\Time) s from it.

    ERR_ARGVALERR: negative.
    """
    distance = arguments["Distance"]
    if distance < 0:
        raise RapidError("ERR_ARGVALERR", f"Distance {distance:g}")
    if arguments.get("Time"):
        return MeasuredFrom.BEFORE_END, distance
    return (MeasuredFrom.START if arguments["Start"] else MeasuredFrom.END), distance / 1000


def _inhibited(arguments: Arguments) -> bool:
    inhibit = arguments["Inhib"]
    return inhibit is not None and bool(inhibit.get())


def _first(arguments: Arguments, *names: str) -> Value:
    """Return the one present argument of several alternatives."""
    return next((arguments[name] for name in names if arguments[name] is not None), None)


def _output(task: Task, arguments: Arguments) -> Callable[[], None]:
    """Return a function that sets an output.

    While inhibited, it writes 0 or the given value (S4 datasys 2-TriggIO-4). Raises ERR_AO_LIM or
    ERR_GO_LIM if the signal cannot represent the value.
    """
    chosen = _first(arguments, "DOp", "GOp", "AOp")
    value = _first(arguments, "SetValue", "SetDvalue") or 0.0
    if chosen is None:
        raise FatalError(NOT_SIMULATED, "Process events are not simulated", "\\ProcID")
    signal, instead = chosen.signal, arguments["InhibSetValue"]
    fitting(signal, value)
    io, delay = task.controller.io, arguments.get("DODelay") or 0.0

    def act() -> None:
        expected = value
        if _inhibited(arguments):
            expected = instead.get() if instead is not None else 0.0
        io.set(signal, expected, delay=delay)

    return act


@by_name("TriggIO")
def trigg_io(task: Task, _name: str, arguments: Arguments) -> None:
    """Prepare an output at a place."""
    where = _where(arguments)
    arguments["TriggData"].set(*where, _output(task, arguments))


@by_name("TriggEquip")
def trigg_equip(task: Task, _name: str, arguments: Arguments) -> None:
    """Prepare an output earlier by the equipment's lag.

    A negative lag means later.
    """
    where = _where(arguments)
    arguments["TriggData"].set(*where, _output(task, arguments), arguments["EquipLag"])


@by_name("TriggInt")
def trigg_int(task: Task, _name: str, arguments: Arguments) -> None:
    """Prepare an interrupt at a place. ERR_UNKINO: not connected."""
    where = _where(arguments)
    ordered = task.interrupts.find(arguments["Interrupt"].get())

    def act() -> None:
        if not _inhibited(arguments):
            task.interrupts.happen(ordered)

    arguments["TriggData"].set(*where, act)


@by_name("TriggCheckIO")
def trigg_check_io(task: Task, _name: str, arguments: Arguments) -> None:
    """Prepare a check of a signal at a place.

    If the relation is false, an interrupt occurs (and a stop).
    """
    where = _where(arguments)
    ordered = task.interrupts.find(arguments["Interrupt"].get())
    relation, signal = arguments["Relation"], arguments["Signal"]
    compare = _RELATIONS.get(int(relation))
    if compare is None:
        raise RapidError("ERR_ARGVALERR", f"relation {relation:g}")
    expected = _first(arguments, "CheckValue", "CheckDvalue") or 0.0
    watched = signal.get() if isinstance(signal, Ref) else signal
    group = group_of(task)

    def act() -> None:
        if _inhibited(arguments) or compare(watched.value, expected):
            return
        if arguments["StopMove"]:
            group.stop(MOVE_TASK)
        task.interrupts.happen(ordered)

    arguments["TriggData"].set(*where, act)


def prepared(_task: Task, arguments: Arguments, first: str = "Trigg_1") -> tuple[PathEvent, ...]:
    """Return the events of an instruction. FatalError: not prepared."""
    array = arguments.get("TriggArray")
    if array is not None:
        held = array.get() if isinstance(array, Ref) else array
        data = list(held.values())
    else:
        data = [arguments.get(name) for name in (first, *(f"T{k}" for k in range(2, 9)))]
    result = []
    for one in data:
        if one is None:
            continue
        if one.event is None:
            raise FatalError(NOT_ALLOWED, "triggdata is not defined")
        result.append(one.event)
    return tuple(result)


_DATA: dict[str, Callable[..., Value]] = {
    "TriggDataReset": lambda _task, data: data.take(None),
    # Later changes of the first one leave the other alone.
    "TriggDataCopy": lambda _task, source, destination: destination.take(source.event),
    "TriggDataValid": lambda _task, data: data.event is not None,
}
builtins(_DATA)
bind("TriggL", cartesian_move, prepared)
bind("TriggC", cartesian_move, prepared)
bind("TriggJ", joint_move, prepared)  # distances are approximate, as on a controller


# -- Arc welding -----------------------------------------------------------------------------------
#
# Arc welding: ArcLStart, ArcL, ArcLEnd, ArcCStart, ArcC, ArcCEnd, and moves between welds.
#
# Source: [manual] 3HAC050988 for phases and arguments, otherwise [mem]. The argument Speed applies
# on the way to a start, weld_speed of welddata during a weld. In stop points the robot waits for
# the phases of seamdata; in fly-by points the arc changes in the middle of the corner. Weaving,
# tracking and heating have no effect here; the event log says so.


_ON_SEAM = "on a seam"


def _equipment(task: Task) -> ArcEquipment:
    return task.controller.arcs[task.name]


def _data(task: Task, arc: Value) -> dict[str, float]:
    """Return arcdata by component.

    Raises ERR_AO_LIM or ERR_GO_LIM if the cell's signals cannot represent a value.
    """
    result = dict(zip(arc.fields, arc.values(), strict=True))
    for use, component in REFERENCES.items():
        signal = _equipment(task).signal(use)
        if signal is not None:
            fitting(signal, result[component])
    return result


@by_name("ArcLStart", "ArcL", "ArcLEnd", "ArcCStart", "ArcC", "ArcCEnd", cost="move")
@planned
def weld(task: Task, name: str, arguments: Arguments) -> None:
    """Weld a line or circle. ERR_ARGVALERR: weld_speed is 0."""
    arc, seam = _equipment(task), arguments["Seam"]
    data = _data(task, arguments["Weld"].main_arc)
    begins, ends = name.endswith("Start"), name.endswith("End")
    welds = not arc.inhibited
    _tell_what_is_left_out(task, arguments)
    # The program passes a start in a corner before the robot does.
    on_seam = data_of(task, moving_group(task)).extra
    if welds and not begins and not on_seam.get(_ON_SEAM):
        _ignite(task, seam, data, 0.0)
    on_seam[_ON_SEAM] = welds and not ends
    stops = arguments["Zone"].finep or arguments["Inpos"] is not None
    events = list(prepared(task, arguments, first="T1"))
    opened: list[int] = []

    def open_gas() -> None:
        opened.append(task.scheduler.now)
        arc.set_gas(True)

    if welds and begins:
        events.append(PathEvent(MeasuredFrom.BEFORE_END, seam.purge_time, open_gas))
        if not stops:
            events.append(PathEvent(MeasuredFrom.MIDDLE, 0.0, lambda: _burn(arc, data)))
    elif welds:
        events.append(PathEvent(MeasuredFrom.START, 0.0, lambda: arc.refer(data)))
        if ends and not stops:
            events.append(PathEvent(MeasuredFrom.MIDDLE, 0.0, arc.put_out))
    at_weld_speed = welds and not begins
    speed = {"V": arguments["Weld"].weld_speed if at_weld_speed else None, "T": arguments["Time"]}
    order(task, {**arguments, **speed}, cartesian_move, tuple(events))
    if welds and stops and begins:
        since = (task.scheduler.now - opened[0]) / S if opened else 0.0
        _ignite(task, seam, data, since)
    elif welds and stops and ends:
        _finish(task, seam)


def _burn(arc: ArcEquipment, data: dict[str, float]) -> None:
    arc.set_gas(True)
    arc.refer(data)
    arc.set_arc(True)


def _ignite(task: Task, seam: Value, data: dict[str, float], purged: float) -> None:
    """Purge, apply gas preflow and ignite the arc at standstill.

    `purged` seconds of the purge are already over.
    """
    group_of(task).wait_standing(task)
    arc = _equipment(task)
    arc.set_gas(True)
    _stand(task, max(0.0, seam.purge_time - purged) + seam.preflow_time)
    arc.refer(_data(task, seam.ign_arc) if any(seam.ign_arc.values()) else data)
    arc.set_arc(True)
    _stand(task, seam.ign_move_delay)
    arc.refer(data)


def _finish(task: Task, seam: Value) -> None:
    """Cool, fill the crater, burn back, roll back and apply post-flow.

    The robot stands still meanwhile.
    """
    arc = _equipment(task)
    if seam.cool_time > 0:
        arc.set_arc(False)
        _stand(task, seam.cool_time)
    if seam.fill_time > 0:
        arc.refer(_data(task, seam.fill_arc))
        arc.set_arc(True)
        _stand(task, seam.fill_time)
    if seam.bback_time > 0:
        arc.refer(_data(task, seam.bback_arc))
        arc.stop_feeding()
        _stand(task, seam.bback_time)
    arc.set_arc(False)
    _stand(task, seam.rback_time + seam.postflow_time)
    arc.set_gas(False)


def _stand(task: Task, seconds: float) -> None:
    if seconds > 0:
        task.sleep(seconds)


def _tell_what_is_left_out(task: Task, arguments: Arguments) -> None:
    seam, weave, track = arguments["Seam"], arguments["Weave"], arguments["Track"]
    for target, text in (
        (weave is not None and weave.weave_shape != 0, "weaving"),
        (track is not None and track.track_system != 0, "tracking"),
        (seam.heat_speed > 0 and (seam.heat_time > 0 or seam.heat_distance > 0), "heating"),
    ):
        notice = f"{text} is not simulated: the tool goes along the seam at its speed"
        if target and not any(
            e.code == NOT_SIMULATED and notice in e.texts and e.task == task.name
            for e in task.controller.log
        ):
            task.controller.log.info(NOT_SIMULATED, "Arc welding", notice, task=task.name)


by_name("ArcMoveAbsJ", cost="move")(move_abs_j)
by_name("ArcMoveExtJ", cost="move")(move_ext_j)
bind("ArcMoveJ", joint_move)
bind("ArcMoveL", cartesian_move)
bind("ArcMoveC", cartesian_move)
