"""The event log with warnings of recovered errors, which are written only when somebody looks.

Every error that a handler deals with leaves a warning [K §7.5]; programs that live on RETRY and
TRYNEXT make thousands a second, of which the log keeps the last.
"""

from collections import deque
from collections.abc import Callable, Iterator

from rapidgen.machine.event_log import Event, EventLog, EventType, TimeSource
from rapidgen.runtime.errors import error_name

RECOVERED = 40_199


class ControllerLog(EventLog):
    """An EventLog that makes up the events of recovered errors when they are needed."""

    def __init__(self, clock: TimeSource, *, capacity: int = 1000) -> None:
        super().__init__(clock, capacity=capacity)
        self._recovered: deque[tuple[int, str, int, str]] = deque(maxlen=capacity)
        self._dropped = 0

    def recovered(self, task: str, number: int, text: str) -> None:
        """Note that a handler dealt with an error."""
        if self._listeners:
            self.warning(RECOVERED, "Handled error", error_name(number), text, task=task)
            return
        if len(self._recovered) == self._recovered.maxlen:
            self._dropped += 1
        self._recovered.append((self._clock.now, task, number, text))

    def _catch_up(self) -> None:
        self._sequence += self._dropped
        self._dropped = 0
        while self._recovered:
            now, task, number, text = self._recovered.popleft()
            self._sequence += 1
            self._events.append(
                Event(
                    self._sequence,
                    now * 1e-9,
                    RECOVERED,
                    EventType.WARNING,
                    "Handled error",
                    (error_name(number), text),
                    task,
                )
            )

    def write(self, code: int, type: EventType, title: str, *texts: str, task: str = "") -> Event:
        """Add an event and return it."""
        self._catch_up()
        return super().write(code, type, title, *texts, task=task)

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
