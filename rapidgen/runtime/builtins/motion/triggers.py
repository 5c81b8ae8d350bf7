"""Events at places of a move: TriggIO, TriggInt, TriggEquip, TriggCheckIO and TriggL, J, C.

Sources: S4 datasys 2-TriggIO, 2-TriggInt, 2-TriggEquip, 2-TriggL; 3HAC050917 for arguments.
A distance counts from the end (\\Start: the beginning) of the move, \\Time in s before the end.
"""

from collections.abc import Callable
from dataclasses import dataclass
from operator import eq, ge, gt, le, lt, ne

from rapidgen.motion.moves import MeasuredFrom, PathEvent
from rapidgen.runtime.builtins.io import fitting
from rapidgen.runtime.builtins.motion.cartesian_request import cartesian_move, joint_move
from rapidgen.runtime.builtins.motion.enqueue import bind
from rapidgen.runtime.builtins.motion.path import MOVE_TASK
from rapidgen.runtime.builtins.motion.task_group import group_of
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_faults import NOT_ALLOWED, NOT_SIMULATED
from rapidgen.runtime.registry import Arguments, builtins, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value, register_type


@dataclass(slots=True)
class TriggData:
    """A triggdata: an event that TriggIO or a relative has prepared, and that TriggL fires."""

    event: PathEvent | None = None

    def set(
        self, where: MeasuredFrom, amount: float, act: Callable[[], None], lag: float = 0.0
    ) -> None:
        """Prepare: `amount` m or s, see PathEvent."""
        self.event = PathEvent(where, amount, act, lag)

    def take(self, event: PathEvent | None) -> None:
        """The same event as another one, or none."""
        self.event = event


register_type("triggdata", TriggData)

_RELATIONS = {1: lt, 2: le, 3: eq, 4: ne, 5: ge, 6: gt}
"""opnum [mem]"""


def _where(given: Arguments) -> tuple[MeasuredFrom, float]:
    """The place, and m from there or (\\Time) s. ERR_ARGVALERR: negative."""
    distance = given["Distance"]
    if distance < 0:
        raise RapidError("ERR_ARGVALERR", f"Distance {distance:g}")
    if given.get("Time"):
        return MeasuredFrom.BEFORE_END, distance
    return (MeasuredFrom.START if given["Start"] else MeasuredFrom.END), distance / 1000


def _inhibited(given: Arguments) -> bool:
    inhibit = given["Inhib"]
    return inhibit is not None and bool(inhibit.get())


def _first(given: Arguments, *names: str) -> Value:
    """The argument that there is of several alternatives."""
    return next((given[name] for name in names if given[name] is not None), None)


def _output(task: Task, given: Arguments) -> Callable[[], None]:
    """Sets an output; inhibited, 0 or the given value is written (S4 datasys 2-TriggIO-4).

    ERR_AO_LIM, ERR_GO_LIM: the value does not fit the signal.
    """
    chosen = _first(given, "DOp", "GOp", "AOp")
    value = _first(given, "SetValue", "SetDvalue") or 0.0
    if chosen is None:
        raise FatalError(NOT_SIMULATED, "Process events are not simulated", "\\ProcID")
    signal, instead = chosen.signal, given["InhibSetValue"]
    fitting(signal, value)
    io, delay = task.controller.io, given.get("DODelay") or 0.0

    def act() -> None:
        wanted = value
        if _inhibited(given):
            wanted = instead.get() if instead is not None else 0.0
        io.set(signal, wanted, delay=delay)

    return act


@by_name("TriggIO")
def trigg_io(task: Task, _name: str, given: Arguments) -> None:
    """An output at a place."""
    where = _where(given)
    given["TriggData"].set(*where, _output(task, given))


@by_name("TriggEquip")
def trigg_equip(task: Task, _name: str, given: Arguments) -> None:
    """An output at a place, earlier by the equipment's lag (negative: later)."""
    where = _where(given)
    given["TriggData"].set(*where, _output(task, given), given["EquipLag"])


@by_name("TriggInt")
def trigg_int(task: Task, _name: str, given: Arguments) -> None:
    """An interrupt at a place. ERR_UNKINO: not connected."""
    where = _where(given)
    ordered = task.interrupts.find(given["Interrupt"].get())

    def act() -> None:
        if not _inhibited(given):
            task.interrupts.happen(ordered)

    given["TriggData"].set(*where, act)


@by_name("TriggCheckIO")
def trigg_check_io(task: Task, _name: str, given: Arguments) -> None:
    """Looks at a signal at a place; when the relation does not hold, an interrupt (and a stop)."""
    where = _where(given)
    ordered = task.interrupts.find(given["Interrupt"].get())
    relation, signal = given["Relation"], given["Signal"]
    compare = _RELATIONS.get(int(relation))
    if compare is None:
        raise RapidError("ERR_ARGVALERR", f"relation {relation:g}")
    wanted = _first(given, "CheckValue", "CheckDvalue") or 0.0
    watched = signal.get() if isinstance(signal, Ref) else signal
    group = group_of(task)

    def act() -> None:
        if _inhibited(given) or compare(watched.value, wanted):
            return
        if given["StopMove"]:
            group.stop(MOVE_TASK)
        task.interrupts.happen(ordered)

    given["TriggData"].set(*where, act)


def prepared(_task: Task, given: Arguments, first: str = "Trigg_1") -> tuple[PathEvent, ...]:
    """The events that an instruction names. FatalError: a triggdata without one."""
    array = given.get("TriggArray")
    if array is not None:
        held = array.get() if isinstance(array, Ref) else array
        data = list(held.values())
    else:
        data = [given.get(name) for name in (first, *(f"T{k}" for k in range(2, 9)))]
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
bind("TriggL", cartesian_move, prepared)
bind("TriggC", cartesian_move, prepared)
bind("TriggJ", joint_move, prepared)  # distances are approximate, as on a controller
