"""The driver's RAPID data and interrupts as a description of its state.

A message that leaves them as they were has not changed what the driver does next: RAPID has no
other memory, besides program pointers and sockets.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import PersistentCell, Record, Value

Datum: TypeAlias = tuple[str, str, str]
"""Task, module and name, in lower case; of a PERS the task is empty."""

_WITHOUT_VALUE = frozenset({"rawbytes", "clock", "socketdev", "intnum", "trapdata"})
"""Types of buffers and handles: they differ after each use."""
_OF_RECEIVED_BYTES = frozenset({"ros_frame_at", "next_byte", "bytes_left"})
"""Places in the bytes received last: they are set before each use."""
_LONGEST = 32
"""Longest array that is compared. Longer ones hold points, and counters tell how many."""


@dataclass(frozen=True, slots=True)
class _Place:
    datum: Datum
    space: dict[str, Value]
    code: str

    def value(self) -> Value:
        """Return a copy of the present value."""
        value = self.space[self.code]
        return _frozen(value.v if isinstance(value, PersistentCell) else value)


@dataclass(frozen=True, slots=True)
class _Interrupts:
    datum: Datum
    task: Task

    def value(self) -> Value:
        """Return the traps that are connected."""
        connected = self.task.interrupts.connected.values()
        return tuple(sorted(interrupt.trap.name for interrupt in connected))


@dataclass(frozen=True, slots=True)
class DriverData:
    """Data that are constant in a state, and their values."""

    places: tuple[_Place | _Interrupts, ...]
    values: tuple[Value, ...]

    def now(self) -> "DriverData":
        """Return the same data with their present values."""
        return DriverData(self.places, tuple(place.value() for place in self.places))

    def changed(self) -> list[Datum]:
        """Return the data that have other values now."""
        pairs = zip(self.places, self.values, strict=True)
        return [place.datum for place, value in pairs if place.value() != value]

    def without(self, data: Iterable[Datum]) -> "DriverData":
        """Return the same without data that vary within the state."""
        left_out = frozenset(data)
        pairs = zip(self.places, self.values, strict=True)
        kept = [(place, value) for place, value in pairs if place.datum not in left_out]
        return DriverData(tuple(p for p, _ in kept), tuple(v for _, v in kept))


def driver_data(tasks: Iterable[Task]) -> DriverData:
    """Return all VAR and PERS of the tasks' modules, with their present values."""
    places = tuple(dict(place for task in tasks for place in _places(task)).values())
    return DriverData(places, tuple(place.value() for place in places))


def _places(task: Task) -> Iterator[tuple[object, _Place | _Interrupts]]:
    """Yield each datum with a key: tasks share the cell of a PERS."""
    program = task.program
    yield task.name, _Interrupts((task.name, "", "interrupts"), task)
    for module_name, module in program.modules.items():
        for name, declared in module.declarations.items():
            data = program.find_data(module, name)
            if data is None or data.storage == "inline" or data.kind == "CONST":
                continue
            type = declared.type.lower()
            if type in _WITHOUT_VALUE or type.startswith("signal"):
                continue
            if name in _OF_RECEIVED_BYTES or any(size > _LONGEST for size in data.dims):
                continue
            value = program.space[data.code]
            if isinstance(value, PersistentCell):
                yield id(value), _Place(("", module_name, name), program.space, data.code)
            else:
                datum = (task.name, module_name, name)
                yield datum, _Place(datum, program.space, data.code)


def _frozen(value: Value) -> Value:
    if isinstance(value, Record):
        return tuple(map(_frozen, value.values()))
    if isinstance(value, dict):
        return tuple(map(_frozen, value.values()))
    return value
