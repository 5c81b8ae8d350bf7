"""RAPID message queues: one per task, with the name RMQ_<task>.

The configuration of the task sets the limits (RmqMaxNoOfMsg, RmqMaxMsgSize). A message goes to a
trap if the receiving task has ordered an interrupt for its type. Other messages wait to be read.
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
    """A message: a copied value, its type, and its sender."""

    type: Type
    dims: tuple[int, ...]
    value: Value
    sender: str
    user: float

    def is_a(self, type_: Type, dims: tuple[int, ...]) -> bool:
        """Return True if the message has a type; records compare by name."""
        return self.type.name == type_.name and self.dims == dims


class MessageBox:
    """An `rmqmessage`."""

    __slots__ = ("message",)

    def __init__(self) -> None:
        self.message: Message | None = None


class Slot:
    """An `rmqslot`: the name of a queue, or empty."""

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
        """Return the name of a task's queue."""
        return f"RMQ_{task}"

    def queue(self, task: str) -> Queue:
        """Return the queue of a task."""
        return self._queues.setdefault(self.slot_name(task).lower(), Queue())

    def named(self, slot: str) -> Queue | None:
        """Return the queue of a name, None if unknown."""
        return self._queues.get(slot.lower())

    def open(self, slot: str, spec: QueueSpec) -> Queue:
        """Open a queue of an external client, to which tasks can answer.

        ValueError: the name is in use.
        """
        if slot.lower() in self._queues:
            raise ValueError(slot)
        queue = self._queues[slot.lower()] = Queue(spec)
        return queue

    def close(self, slot: str) -> None:
        """Close the queue of an external client."""
        self._queues.pop(slot.lower(), None)

    def send(self, slot: str, message: Message) -> None:
        """Put a message into a queue.

        Raises ERR_RMQ_INVALID, ERR_RMQ_MSGSIZE or ERR_RMQ_FULL.
        """
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
