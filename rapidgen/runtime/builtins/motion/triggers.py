"""Events at places of a move: TriggIO, TriggInt, TriggEquip, TriggCheckIO and TriggL, J, C.

Sources: S4 datasys 2-TriggIO, 2-TriggInt, 2-TriggEquip, 2-TriggL; 3HAC050917 for arguments.
A distance counts from the end (\\Start: the beginning) of the move, \\Time in s before the end.
"""

from collections.abc import Callable
from dataclasses import dataclass
from operator import eq, ge, gt, le, lt, ne

from rapidgen.motion.moves import From, PathEvent
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.access import group_of
from rapidgen.runtime.builtins.motion.path import MOVE_TASK
from rapidgen.runtime.builtins.motion.request import MoveArguments, bind, cartesian_move, joint_move
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_faults import NOT_ALLOWED, NOT_SIMULATED
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value, register_type


@dataclass(slots=True)
class TriggData:
    """A triggdata: an event that TriggIO or a relative has prepared, and that TriggL fires."""

    event: PathEvent | None = None

    def set(self, where: From, amount: float, act: Callable[[], None], lag: float = 0.0) -> None:
        """Prepare: `amount` m or s, see PathEvent."""
        self.event = PathEvent(where, amount, act, lag)

    def take(self, event: PathEvent | None) -> None:
        """The same event as another one, or none."""
        self.event = event


register_type("triggdata", TriggData)

_RELATIONS = {1: lt, 2: le, 3: eq, 4: ne, 5: ge, 6: gt}
"""opnum [mem]"""


def _where(distance: float, start: bool | None, time: bool | None) -> tuple[From, float]:
    if distance < 0:
        raise RapidError("ERR_ARGVALERR", f"Distance {distance:g}")
    if time:
        return From.BEFORE_END, distance
    return (From.START if start else From.END), distance / 1000


def _inhibited(inhibit: Ref | None) -> bool:
    return inhibit is not None and bool(inhibit.get())


def _output(
    task: Task,
    signals: tuple[AnySignal | None, AnySignal | None, AnySignal | None],
    values: tuple[float | None, float | None],
    delay: float,
    inhibit: Ref | None,
    instead: Ref | None,
) -> Callable[[], None]:
    """Sets an output; inhibited, 0 or the given value is written (S4 datasys 2-TriggIO-4).

    ERR_AO_LIM, ERR_GO_LIM: the value does not fit the signal.
    """
    chosen = next((s for s in signals if s is not None), None)
    value = next((v for v in values if v is not None), 0.0)
    if chosen is None:
        raise FatalError(NOT_SIMULATED, "Process events are not simulated", "\\ProcID")
    signal = chosen.signal
    fitting(signal, value)
    io = task.controller.io

    def act() -> None:
        wanted = value
        if _inhibited(inhibit):
            wanted = instead.get() if instead is not None else 0.0
        io.set(signal, wanted, delay=delay)

    return act


@builtin("TriggIO")
def trigg_io(
    task: Task,
    data: TriggData,
    distance: float,
    start: bool | None,
    _next: bool | None,
    time: bool | None,
    digital: AnySignal | None,
    group: AnySignal | None,
    analogue: AnySignal | None,
    _process: float | None,
    value: float | None,
    large: float | None,
    delay: float | None,
    inhibit: Ref | None,
    instead: Ref | None,
    _mode: float | None,
) -> None:
    """An output at a place."""
    where, amount = _where(distance, start, time)
    act = _output(task, (digital, group, analogue), (value, large), delay or 0.0, inhibit, instead)
    data.set(where, amount, act)


@builtin("TriggEquip")
def trigg_equip(
    task: Task,
    data: TriggData,
    distance: float,
    start: bool | None,
    _next: bool | None,
    lag: float,
    digital: AnySignal | None,
    group: AnySignal | None,
    analogue: AnySignal | None,
    _process: float | None,
    value: float | None,
    large: float | None,
    inhibit: Ref | None,
    instead: Ref | None,
    _mode: float | None,
) -> None:
    """An output at a place, earlier by the equipment's lag (negative: later)."""
    where, amount = _where(distance, start, None)
    act = _output(task, (digital, group, analogue), (value, large), 0.0, inhibit, instead)
    data.set(where, amount, act, lag)


@builtin("TriggInt")
def trigg_int(
    task: Task,
    data: TriggData,
    distance: float,
    start: bool | None,
    _next: bool | None,
    time: bool | None,
    interrupt: Ref,
    inhibit: Ref | None,
    _mode: float | None,
) -> None:
    """An interrupt at a place. ERR_UNKINO: not connected."""
    where, amount = _where(distance, start, time)
    ordered = task.interrupts.find(interrupt.get())

    def act() -> None:
        if not _inhibited(inhibit):
            task.interrupts.happen(ordered)

    data.set(where, amount, act)


@builtin("TriggCheckIO")
def trigg_check_io(
    task: Task,
    data: TriggData,
    distance: float,
    start: bool | None,
    _next: bool | None,
    time: bool | None,
    signal: Value,
    relation: float,
    value: float | None,
    large: float | None,
    stop: bool | None,
    interrupt: Ref,
    inhibit: Ref | None,
    _mode: float | None,
) -> None:
    """Looks at a signal at a place; when the relation does not hold, an interrupt (and a stop)."""
    where, amount = _where(distance, start, time)
    ordered = task.interrupts.find(interrupt.get())
    compare = _RELATIONS.get(int(relation))
    if compare is None:
        raise RapidError("ERR_ARGVALERR", f"relation {relation:g}")
    wanted = value if value is not None else large or 0.0
    watched = signal.get() if isinstance(signal, Ref) else signal
    group = group_of(task)

    def act() -> None:
        if _inhibited(inhibit) or compare(watched.value, wanted):
            return
        if stop:
            group.stop(MOVE_TASK)
        task.interrupts.happen(ordered)

    data.set(where, amount, act)


def _prepared(_task: Task, given: MoveArguments) -> tuple[PathEvent, ...]:
    array = given["TriggArray"]
    if array is not None:
        held = array.get() if isinstance(array, Ref) else array
        data = list(held.values())
    else:
        data = [given[name] for name in ("Trigg_1", *(f"T{k}" for k in range(2, 9)))]
    found = []
    for one in data:
        if one is None:
            continue
        if one.event is None:
            raise FatalError(NOT_ALLOWED, "triggdata is not defined")
        found.append(one.event)
    return tuple(found)


_DATA: dict[str, Callable[..., Value]] = {
    "TriggDataReset": lambda _task, data: data.take(None),
    # Later changes of the first one leave the other alone.
    "TriggDataCopy": lambda _task, source, destination: destination.take(source.event),
    "TriggDataValid": lambda _task, data: data.event is not None,
}
builtins(_DATA)
bind("TriggL", cartesian_move, _prepared)
bind("TriggC", cartesian_move, _prepared)
bind("TriggJ", joint_move, _prepared)  # distances are approximate, as on a controller
