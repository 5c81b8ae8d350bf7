"""Event log: ABB's domains, numbers and types in one ring buffer.

An event's code is domain * 10000 + number. Domains and types are those of the controller's log (1
information, 2 warning, 3 error); titles and texts here are ours.
"""

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol


class Domain(IntEnum):
    """Event log domains; the number is the ten-thousands of an event's code."""

    COMMON = 0
    OPERATIONAL = 1
    SYSTEM = 2
    HARDWARE = 3
    PROGRAM = 4
    MOTION = 5
    OPERATOR = 6
    IO = 7
    USER = 8
    SAFETY = 9
    INTERNAL = 10
    PROCESS = 11
    CONFIGURATION = 12
    PAINT = 13


class EventType(IntEnum):
    """Severity of an event."""

    INFO = 1
    WARNING = 2
    ERROR = 3


@dataclass(frozen=True, slots=True)
class Event:
    """An entry; `time` is the controller's in s, `texts` are its lines."""

    sequence: int
    time: float
    code: int
    type: EventType
    title: str
    texts: tuple[str, ...] = ()
    task: str = ""

    @property
    def domain(self) -> Domain:
        """Domain of the code."""
        return Domain(self.code // 10_000)

    def __str__(self) -> str:
        where = f" [{self.task}]" if self.task else ""
        lines = "".join(f"\n    {text}" for text in self.texts if text)
        return (
            f"{self.time:10.3f} {self.type.name.lower():7} {self.code}{where} {self.title}{lines}"
        )


class TimeSource(Protocol):
    """A source of time: the scheduler."""

    @property
    def now(self) -> int:
        """Nanoseconds since the controller started."""


class EventLog:
    """The last `capacity` events, with listeners for new ones.

    A listener runs on the controller's thread, at the time of the event.
    """

    def __init__(self, clock: TimeSource, *, capacity: int = 1000) -> None:
        self._clock = clock
        self._events: deque[Event] = deque(maxlen=capacity)
        self._listeners: list[Callable[[Event], None]] = []
        self._sequence = 0

    def write(self, code: int, type: EventType, title: str, *texts: str, task: str = "") -> Event:
        """Add an event and return it."""
        self._sequence += 1
        event = Event(self._sequence, self._clock.now * 1e-9, code, type, title, tuple(texts), task)
        self._events.append(event)
        for listener in tuple(self._listeners):
            listener(event)
        return event

    def info(self, code: int, title: str, *texts: str, task: str = "") -> Event:
        """Add an event of type information."""
        return self.write(code, EventType.INFO, title, *texts, task=task)

    def warning(self, code: int, title: str, *texts: str, task: str = "") -> Event:
        """Add an event of type warning."""
        return self.write(code, EventType.WARNING, title, *texts, task=task)

    def error(self, code: int, title: str, *texts: str, task: str = "") -> Event:
        """Add an event of type error."""
        return self.write(code, EventType.ERROR, title, *texts, task=task)

    def subscribe(self, listener: Callable[[Event], None]) -> Callable[[], None]:
        """Call `listener` for each new event; the result ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def since(self, sequence: int = 0) -> list[Event]:
        """Return stored events after a sequence number, oldest first."""
        return [event for event in self._events if event.sequence > sequence]

    def clear(self) -> None:
        """Remove all events; sequence numbers continue."""
        self._events.clear()

    def __iter__(self) -> Iterator[Event]:
        return iter(tuple(self._events))

    def __len__(self) -> int:
        return len(self._events)
