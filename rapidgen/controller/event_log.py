"""The event log with warnings of handled errors, which are written only when somebody looks.

Every error that a handler deals with leaves a warning [K §7.5]; programs that live on RETRY and
TRYNEXT make thousands a second, of which the log keeps the last.
"""

from collections import deque
from collections.abc import Callable, Iterator

from rapidgen.machine.log import Event, EventLog, EventType, TimeSource
from rapidgen.runtime.errors import error_name

HANDLED = 40_199


class ControllerLog(EventLog):
    """An EventLog that makes up the events of handled errors when they are needed."""

    def __init__(self, clock: TimeSource, *, capacity: int = 1000) -> None:
        super().__init__(clock, capacity=capacity)
        self._handled: deque[tuple[int, str, int, str]] = deque(maxlen=capacity)
        self._dropped = 0

    def handled(self, task: str, number: int, text: str) -> None:
        """Note that a handler dealt with an error."""
        if self._listeners:
            self.warning(HANDLED, "Handled error", error_name(number), text, task=task)
            return
        if len(self._handled) == self._handled.maxlen:
            self._dropped += 1
        self._handled.append((self._clock.now, task, number, text))

    def _flush(self) -> None:
        self._sequence += self._dropped
        self._dropped = 0
        while self._handled:
            now, task, number, text = self._handled.popleft()
            self._sequence += 1
            self._events.append(
                Event(
                    self._sequence,
                    now * 1e-9,
                    HANDLED,
                    EventType.WARNING,
                    "Handled error",
                    (error_name(number), text),
                    task,
                )
            )

    def write(self, code: int, type: EventType, title: str, *texts: str, task: str = "") -> Event:
        """Add an event and return it."""
        self._flush()
        return super().write(code, type, title, *texts, task=task)

    def subscribe(self, listener: Callable[[Event], None]) -> Callable[[], None]:
        """Call `listener` for each new event; the returned function ends that."""
        self._flush()
        return super().subscribe(listener)

    def since(self, sequence: int = 0) -> list[Event]:
        """Events that are newer than the given sequence number and still kept, oldest first."""
        self._flush()
        return super().since(sequence)

    def clear(self) -> None:
        """Forget all events; sequence numbers go on."""
        self._flush()
        super().clear()

    def __iter__(self) -> Iterator[Event]:
        self._flush()
        return super().__iter__()

    def __len__(self) -> int:
        self._flush()
        return super().__len__()
