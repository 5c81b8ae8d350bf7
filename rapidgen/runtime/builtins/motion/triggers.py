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


def _where(arguments: Arguments) -> tuple[MeasuredFrom, float]:
    """The place, and m from there or (\\Time) s. ERR_ARGVALERR: negative."""
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
    """The argument that there is of several alternatives."""
    return next((arguments[name] for name in names if arguments[name] is not None), None)


def _output(task: Task, arguments: Arguments) -> Callable[[], None]:
    """Sets an output; inhibited, 0 or the given value is written (S4 datasys 2-TriggIO-4).

    ERR_AO_LIM, ERR_GO_LIM: the value does not fit the signal.
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
    """An output at a place."""
    where = _where(arguments)
    arguments["TriggData"].set(*where, _output(task, arguments))


@by_name("TriggEquip")
def trigg_equip(task: Task, _name: str, arguments: Arguments) -> None:
    """An output at a place, earlier by the equipment's lag (negative: later)."""
    where = _where(arguments)
    arguments["TriggData"].set(*where, _output(task, arguments), arguments["EquipLag"])


@by_name("TriggInt")
def trigg_int(task: Task, _name: str, arguments: Arguments) -> None:
    """An interrupt at a place. ERR_UNKINO: not connected."""
    where = _where(arguments)
    ordered = task.interrupts.find(arguments["Interrupt"].get())

    def act() -> None:
        if not _inhibited(arguments):
            task.interrupts.happen(ordered)

    arguments["TriggData"].set(*where, act)


@by_name("TriggCheckIO")
def trigg_check_io(task: Task, _name: str, arguments: Arguments) -> None:
    """Looks at a signal at a place; when the relation does not hold, an interrupt (and a stop)."""
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
    """The events that an instruction names. FatalError: a triggdata without one."""
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
