"""RAPID message queues: RMQFindSlot to IRMQMessage.

See `rapidgen/runtime/queues.py` for the queues. Sources: 3HAC16581-1's arguments and error names
[manual]. Without \\TimeOut, RMQReadWait waits without limit; the switch `queue_timeout` limits
RMQSendWait.
"""

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.queues import Message, MessageBox, Queue, QueueSystem, Slot
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.signals import target_of, value_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, RmqHeader, copy_value, dimensions

_DEFAULT_TIME = 60.0
_WAIT_MAX = 9_999_999


def _queues(task: Task) -> QueueSystem:
    return task.controller.queues


def _own(task: Task) -> Queue:
    return _queues(task).queue(task.name)


def _message(task: Task, argument: object, user: float | None) -> Message:
    value, kind = value_of(argument)
    name = QueueSystem.slot_name(task.name)
    return Message(kind, dimensions(value), copy_value(value), name, user or 0)


@builtin("RMQFindSlot", cost="string")
def rmq_find_slot(task: Task, slot: Slot, name: str) -> None:
    """Find the queue of a name.

    ERR_RMQ_NAME: no such task, or its RmqType is None.
    """
    for other in task.controller.rapid_tasks.values():
        if QueueSystem.slot_name(other.name).lower() == name.lower() and other.spec.queue.open:
            slot.name = QueueSystem.slot_name(other.name)
            return
    raise RapidError("ERR_RMQ_NAME", name)


@builtin("RMQGetSlotName", cost="string")
def rmq_get_slot_name(_task: Task, slot: Slot) -> str:
    """Return the name of a queue.

    ERR_RMQ_INVALID: RMQFindSlot has not set the slot.
    """
    if not slot.name:
        raise RapidError("ERR_RMQ_INVALID")
    return slot.name


@builtin("RMQSendMessage", cost="string")
def rmq_send_message(task: Task, slot: Slot, argument: object, user: float | None) -> None:
    """Send a value without waiting."""
    _queues(task).send(slot.name, _message(task, argument, user))


@builtin("RMQSendWait", cost="string")
def rmq_send_wait(
    task: Task,
    slot: Slot,
    argument: object,
    user: float | None,
    box: MessageBox,
    expected: object,
    timeout: float | None,
) -> None:
    """Send a value and wait for an answer of a type from the same queue."""
    value, kind = value_of(expected)
    dims = dimensions(value)
    own = _own(task)
    _queues(task).send(slot.name, _message(task, argument, user))

    def answer() -> Message | None:
        for message in own.messages:
            if message.sender == slot.name and message.is_a(kind, dims):
                return message
        return None

    default_timeout = _DEFAULT_TIME if task.controller.dialect.queue_timeout else None
    if not task.wait_for(
        lambda: answer() is not None,
        on=(own.changed,),
        timeout=_time(timeout, default_timeout),
        why=lambda: f"RMQSendWait waits for an answer of {slot.name}",
    ):
        raise RapidError("ERR_RMQ_TIMEOUT")
    result = answer()
    assert result is not None
    own.messages.remove(result)
    box.message = result


def _time(timeout: float | None, default: float | None) -> float | None:
    if timeout is None:
        return default
    return None if timeout >= _WAIT_MAX else timeout


@builtin("RMQGetMessage", cost="string")
def rmq_get_message(task: Task, box: MessageBox) -> None:
    """Remove and return the first message, or raise ERR_RMQ_NOMSG."""
    messages = _own(task).messages
    if not messages:
        raise RapidError("ERR_RMQ_NOMSG")
    box.message = messages.popleft()


@builtin("RMQReadWait", cost="string")
def rmq_read_wait(task: Task, box: MessageBox, timeout: float | None) -> None:
    """Wait for a message."""
    own = _own(task)
    if not task.wait_for(
        lambda: bool(own.messages),
        on=(own.changed,),
        timeout=_time(timeout, None),
        why=lambda: "RMQReadWait waits for a message",
    ):
        raise RapidError("ERR_RMQ_TIMEOUT")
    box.message = own.messages.popleft()


def _held(box: MessageBox) -> Message:
    if box.message is None:
        raise RapidError("ERR_RMQ_INVMSG")
    return box.message


@builtin("RMQGetMsgHeader", cost="string")
def rmq_get_msg_header(
    _task: Task, box: MessageBox, header: Ref | None, sender: Slot | None, user: Ref | None
) -> None:
    """Type and dimensions, sender and user number of a message."""
    message = _held(box)
    if header is not None:
        sizes = (*message.dims, 0, 0, 0)[:3]
        header.set(RmqHeader(message.type.name, len(message.dims), *sizes))
    if sender is not None:
        sender.name = message.sender
    if user is not None:
        user.set(message.user)


@builtin("RMQGetMsgData", cost="string")
def rmq_get_msg_data(_task: Task, box: MessageBox, argument: object) -> None:
    """Return the value of a message, or raise ERR_RMQ_VALUE or ERR_RMQ_DIM."""
    message, target = _held(box), target_of(argument)
    if message.type.name != target.type.name:
        raise RapidError("ERR_RMQ_VALUE", f"the message is a {message.type.name}")
    if message.dims != target.dims:
        raise RapidError("ERR_RMQ_DIM")
    target.set(copy_value(message.value))


@builtin("RMQEmptyQueue", cost="string")
def rmq_empty_queue(task: Task) -> None:
    """Discard all messages."""
    _own(task).messages.clear()


@builtin("IRMQMessage", cost="string")
def i_rmq_message(task: Task, argument: object, interrupt: Ref) -> None:
    """Order an interrupt for messages of a type."""
    value, kind = value_of(argument)
    order = task.interrupts.order(interrupt.get(), single=False, safe=False)
    own = _own(task)
    entry = (kind, dimensions(value), lambda: task.interrupts.happen(order))
    own.orders.append(entry)
    order.cancel.append(lambda: own.orders.remove(entry))
