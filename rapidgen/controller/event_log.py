"""Event log with warnings of recovered errors, formatted on demand.

Every error recovered by a handler leaves a warning with its own number [K §7.5]. Programs that
rely on RETRY and TRYNEXT cause thousands per second; the log keeps the last ones.
"""

import re
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rapidgen.diagnostics import Span
from rapidgen.machine.event_log import Event, EventLog, EventType, TimeSource
from rapidgen.machine.event_table import ERROR_CODES, KINDS, RAPID_ERROR
from rapidgen.runtime.errors import RapidError, error_name
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.calls import location

_AXIS = re.compile(r"\brax_(\d)")


@dataclass(frozen=True, slots=True)
class _Handled:
    """An error that a handler dealt with; `place` is a file and line of the compiled program."""

    now: int
    task: RapidTask
    number: int
    text: str
    place: tuple[str, int] | None

    def event(self, sequence: int) -> Event:
        where = location(self.task.program.codes, *self.place) if self.place is not None else None
        reference = where.reference if where is not None else ""
        name = error_name(self.number)
        code, arguments = error_event(self.task, name, self.text, reference)
        kind = KINDS[code]
        return Event(
            sequence,
            self.now * 1e-9,
            code,
            EventType.WARNING,
            kind.title,
            (kind.filled(arguments), *filter(None, (name, self.text))),
            self.task.name,
            arguments,
            where.span if where is not None else None,
        )


def error_event(
    task: RapidTask, name: str, text: str, reference: str
) -> tuple[int, tuple[str, ...]]:
    """Return number and arguments of the event of a RAPID error.

    The arguments are those of saved logs, as far as they are known.
    """
    code = ERROR_CODES.get(name, RAPID_ERROR)
    match code:
        case 40165 | 40168:
            return code, (task.name, text or name)
        case 40706:
            return code, (task.name, reference, text, name)
        case 194199:
            return code, (task.name, reference, name, text)
    return code, (task.name, reference, name)


def reach_arguments(task: RapidTask, text: str) -> tuple[str, str]:
    """Return the arguments of event 50050: number of the axis, and mechanical unit."""
    axis = _AXIS.search(text)
    group = task.controller.motion.of_task(task.name)
    unit = group.config.mechanical_unit if group is not None else ""
    return axis[1] if axis else "", unit


class ControllerLog(EventLog):
    """An EventLog that makes up the events of handled errors when they are needed."""

    def __init__(self, clock: TimeSource, *, capacity: int = 1000) -> None:
        super().__init__(clock, capacity=capacity)
        self._handled: deque[_Handled] = deque(maxlen=capacity)
        self._dropped = 0

    def recovered(self, task: RapidTask, error: RapidError, place: tuple[str, int] | None) -> None:
        """Note that a handler dealt with an error."""
        if len(self._handled) == self._handled.maxlen:
            self._dropped += 1
        self._handled.append(_Handled(self._clock.now, task, error.number, error.text, place))
        if self._listeners:
            self._catch_up()

    def _catch_up(self) -> None:
        self._sequence += self._dropped
        self._dropped = 0
        while self._handled:
            self._sequence += 1
            event = self._handled.popleft().event(self._sequence)
            self._events.append(event)
            for listener in tuple(self._listeners):
                listener(event)

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
        self._catch_up()
        return super().add(type, code, title, texts, task, arguments, span)

    def subscribe(self, listener: Callable[[Event], None]) -> Callable[[], None]:
        """Call `listener` for each new event; the returned function ends that."""
        self._catch_up()
        return super().subscribe(listener)

    def since(self, sequence: int = 0) -> list[Event]:
        """Events that are newer than the given sequence number and still kept, oldest first."""
        self._catch_up()
        return super().since(sequence)

    def clear(self) -> None:
        """Forget all events; sequence numbers go on."""
        self._catch_up()
        super().clear()

    def __iter__(self) -> Iterator[Event]:
        self._catch_up()
        return super().__iter__()

    def __len__(self) -> int:
        self._catch_up()
        return super().__len__()
