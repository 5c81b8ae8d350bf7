"""Event log: ABB's domains, numbers and types in one ring buffer.

An event's code is domain * 10000 + number. Domains and types are those of the controller's log (1
information, 2 warning, 3 error); titles and texts here are ours.
"""

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol

from rapidgen.diagnostics import Span
from rapidgen.machine.event_table import KINDS, Domain, domain_of


class EventType(IntEnum):
    """Severity of an event."""

    INFO = 1
    WARNING = 2
    ERROR = 3


_TYPES = {"I": EventType.INFO, "W": EventType.WARNING, "E": EventType.ERROR}


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
    arguments: tuple[str, ...] = ()
    """As a controller gives them, in its order."""
    span: Span | None = None
    """Where it is in the source of the program."""

    @property
    def domain(self) -> Domain:
        """The domain that the code belongs to."""
        return domain_of(self.code)

    @property
    def number(self) -> int:
        """The code without its domain, as RAPID has it (ReadErrData, IError)."""
        return self.code - 10_000 * self.domain

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
        return self.add(type, code, title, tuple(texts), task)

    def add(
        self,
        type: EventType,
        code: int,
        title: str,
        texts: tuple[str, ...],
        task: str = "",
        arguments: tuple[str, ...] = (),
        span: Span | None = None,
    ) -> Event:
        """Add an event with all its parts and return it."""
        self._sequence += 1
        now = self._clock.now * 1e-9
        event = Event(self._sequence, now, code, type, title, texts, task, arguments, span)
        self._events.append(event)
        for listener in tuple(self._listeners):
            listener(event)
        return event

    def record(
        self,
        code: int,
        *arguments: str,
        task: str = "",
        type: EventType | None = None,
        texts: tuple[str, ...] = (),
        span: Span | None = None,
    ) -> Event:
        """Add an event of the event table and return it.

        `type` is for numbers that have more than one. `texts` follow the table's text.
        """
        kind = KINDS[code]
        return self.add(
            type or _TYPES[kind.types[0]],
            code,
            kind.title,
            (kind.filled(arguments), *texts),
            task,
            arguments,
            span,
        )

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
