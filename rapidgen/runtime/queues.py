"""RAPID message queues: one for each task, reached by the name RMQ_<task>.

Limits are those of the task's configuration (RmqMaxNoOfMsg, RmqMaxMsgSize). A message whose type
has an interrupt ordered in the receiving task goes to its trap, any other one waits to be read.
"""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from rapidgen.machine.scheduler import WaitSet
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.text import literal_text
from rapidgen.runtime.values import Type, Value, register_type
from rapidgen.system.model import QueueSpec, TaskSpec


@dataclass(frozen=True, slots=True)
class Message:
    """What travels: a value by copy, its type, and who sent it."""

    type: Type
    dims: tuple[int, ...]
    value: Value
    sender: str
    user: float

    def is_a(self, type_: Type, dims: tuple[int, ...]) -> bool:
        """Whether the message is of a type; records are compared by name."""
        return self.type.name == type_.name and self.dims == dims


class MessageBox:
    """An `rmqmessage`."""

    __slots__ = ("message",)

    def __init__(self) -> None:
        self.message: Message | None = None


class Slot:
    """An `rmqslot`: the name of a queue, or nothing."""

    __slots__ = ("name",)

    def __init__(self) -> None:
        self.name = ""


register_type("rmqmessage", MessageBox)
register_type("rmqslot", Slot)


@dataclass(slots=True, eq=False)
class Queue:
    """Messages of one task."""

    spec: QueueSpec = field(default_factory=QueueSpec)
    messages: deque[Message] = field(default_factory=deque)
    orders: list[tuple[Type, tuple[int, ...], Callable[[], None]]] = field(default_factory=list)
    """Interrupts by type: (type, dimensions, what to do)."""
    changed: WaitSet = field(default_factory=WaitSet)


class QueueSystem:
    """The queues of one controller."""

    def __init__(self, tasks: Iterable[TaskSpec] = ()) -> None:
        self._queues = {self.slot_name(t.name).lower(): Queue(t.queue) for t in tasks}

    @staticmethod
    def slot_name(task: str) -> str:
        """Name of a task's queue."""
        return f"RMQ_{task}"

    def queue(self, task: str) -> Queue:
        """Queue of a task."""
        return self._queues.setdefault(self.slot_name(task).lower(), Queue())

    def named(self, slot: str) -> Queue | None:
        """The queue of a name; None: there is none."""
        return self._queues.get(slot.lower())

    def open(self, slot: str, spec: QueueSpec) -> Queue:
        """A queue of somebody outside, whom tasks can answer. ValueError: the name is taken."""
        if slot.lower() in self._queues:
            raise ValueError(slot)
        queue = self._queues[slot.lower()] = Queue(spec)
        return queue

    def close(self, slot: str) -> None:
        """No more of a queue that was opened."""
        self._queues.pop(slot.lower(), None)

    def send(self, slot: str, message: Message) -> None:
        """Put a message into a queue; ERR_RMQ_INVALID, ERR_RMQ_MSGSIZE, ERR_RMQ_FULL."""
        if not slot:
            raise RapidError("ERR_RMQ_INVALID")
        queue = self._queues.setdefault(slot.lower(), Queue())
        if len(literal_text(message.value, message.type)) > queue.spec.max_size:
            raise RapidError("ERR_RMQ_MSGSIZE")
        if len(queue.messages) >= queue.spec.max_messages:
            raise RapidError("ERR_RMQ_FULL", slot)
        queue.messages.append(message)
        for type_, dims, fire in queue.orders:
            if message.is_a(type_, dims):
                fire()
        queue.changed.notify()
