"""Event log with warnings of recovered errors, formatted on demand.

Every error recovered by a handler leaves a warning [K §7.5]. Programs that rely on RETRY and
TRYNEXT cause thousands per second; the log keeps the last ones.
"""

from collections import deque
from collections.abc import Callable, Iterator

from rapidgen.machine.event_log import Event, EventLog, EventType, TimeSource
from rapidgen.runtime.errors import error_name

RECOVERED = 40_199


class ControllerLog(EventLog):
    """An EventLog that creates events of recovered errors on demand."""

    def __init__(self, clock: TimeSource, *, capacity: int = 1000) -> None:
        super().__init__(clock, capacity=capacity)
        self._recovered: deque[tuple[int, str, int, str]] = deque(maxlen=capacity)
        self._dropped = 0

    def recovered(self, task: str, number: int, text: str) -> None:
        """Record an error recovered by a handler."""
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
        """Call `listener` for each new event; the result ends that."""
        self._catch_up()
        return super().subscribe(listener)

    def since(self, sequence: int = 0) -> list[Event]:
        """Return stored events after a sequence number, oldest first."""
        self._catch_up()
        return super().since(sequence)

    def clear(self) -> None:
        """Remove all events; sequence numbers continue."""
        self._catch_up()
        super().clear()

    def __iter__(self) -> Iterator[Event]:
        self._catch_up()
        return super().__iter__()

    def __len__(self) -> int:
        self._catch_up()
        return super().__len__()
