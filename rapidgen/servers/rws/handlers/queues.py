"""Message queues (DIPC) of clients, and RMQ_<task> of the tasks.

A message to a task is `type;value` [doc: PC SDK, RAPID message queue], as one from a task is;
between clients it is any text of at most 444 bytes.
"""

from collections.abc import Callable

from rapidgen.runtime.compiler.link import find_type
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.queues import Message
from rapidgen.runtime.text import NotALiteral, parse_value
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.client_queue import MESSAGE_KINDS, ClientQueue, ClientText
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.subscriptions import EventSource, Notify, Topic, subscribable
from rapidgen.system.model import QueueSpec
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

LARGEST = 444
"""Largest message [RWS manual], bytes."""
_OF_A_TASK = "rmq_"


def find(app: RwsApplication, name: str) -> ClientQueue:
    """Return a client's queue. RequestDenied: there is none."""
    match = app.queues.get(name.lower())
    if match is None:
        raise RequestDenied(404, "E_INVALIDSLOTID", f"no queue {name}")
    return match


def _slot(name: str) -> str:
    return str(sum(name.lower().encode()) % 1000 + 100)


def _item(kind: str, queue: ClientQueue) -> Item:
    notify = {
        "queue-name": queue.name,
        "queue-size": str(queue.queue.spec.max_messages),
        "queue-max-msg-size": str(queue.queue.spec.max_size),
        "queue-slot-id": _slot(queue.name),
    }
    return Item(kind, queue.name, notify)


@serves(ops.QUEUES)
def get_queues(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the queues of clients."""
    result = (_item("dipc-queue-li", queue) for queue in app.queues.values())
    return show(*result, collection=True)


@serves(ops.QUEUE)
def get_queue(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one queue of a client."""
    return show(_item("dipc-queue", find(app, request.names["queue"])))


@serves(ops.CREATE_QUEUE)
def create(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Create a queue of this client; it ends with the session."""
    name = request.field("dipc-queue-name")
    size = whole("dipc-queue-size", request.field("dipc-queue-size"), 1, 10_000)
    largest = whole("dipc-max-msg-size", request.field("dipc-max-msg-size"), 1, LARGEST)
    spec = QueueSpec(max_messages=size, max_size=largest)
    if not name or "/" in name:
        raise RequestDenied(400, "E_INVALIDARG", f"dipc-queue-name: {name}")
    try:
        made = ClientQueue(name, app.controller.queues.open(name, spec))
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", f"queue {name} exists") from error
    app.queues[name.lower()] = made
    request.session.on_end.append(lambda: _close(app, made))
    return RwsResponse(201)


def _close(app: RwsApplication, queue: ClientQueue) -> None:
    if app.queues.get(queue.name.lower()) is queue:
        del app.queues[queue.name.lower()]
        app.controller.queues.close(queue.name)


@serves(ops.DELETE_QUEUE)
def delete(app: RwsApplication, request: RwsRequest) -> None:
    """Delete a queue."""
    _close(app, find(app, request.names["queue"]))


@serves(ops.SEND_MESSAGE)
def send(app: RwsApplication, request: RwsRequest) -> None:
    """Put a message into a queue of a client or a task.

    The task's program receives it.
    """
    name, data = request.names["queue"], request.field("dipc-data")
    if not request.is_one:
        request.field("dipc-userdef")  # 400 without it [VC 7.21]
    user, command = request.form.get("dipc-userdef", "0"), request.form.get("dipc-cmd", "0")
    sender = request.form.get("dipc-src-queue-name", "")
    if len(data.encode()) > LARGEST:
        raise RequestDenied(400, "E_BUFFER_OVERFLOW", f"{len(data)} characters")
    if name.lower().startswith(_OF_A_TASK):
        _to_task(app, name, data, sender, user)
        return
    queue = find(app, name)
    if len(queue) >= queue.queue.spec.max_messages:
        raise RequestDenied(400, "E_QUEUEFULL", name)
    kind = MESSAGE_KINDS[request.form.get("dipc-msgtype", "1") != "0"]
    queue.texts.append(ClientText(sender, data, command, user, kind))
    queue.queue.changed.notify()


def _to_task(app: RwsApplication, name: str, data: str, sender: str, user: str) -> None:
    kind, _, literal = data.partition(";")
    result = find_type(kind.strip().lower())
    queue = app.controller.queues.named(name)
    if queue is None or not queue.spec.open:
        raise RequestDenied(404, "E_INVALIDSLOTID", f"no queue {name}")
    try:
        if result is None or not result.is_value:
            raise RequestDenied(400, "E_INVALIDARG", f"no type {kind}")
        value = parse_value(literal, result, (), escaped=True)
        number = whole("dipc-userdef", user or "0")
        app.controller.queues.send(name, Message(result, (), value, sender, float(number)))
    except (NotALiteral, ValueError) as error:
        raise RequestDenied(400, "E_INVALIDARG", f"no message {data}") from error
    except RapidError as error:
        full = error.name == "ERR_RMQ_FULL"
        raise RequestDenied(400, "E_QUEUEFULL" if full else "E_INVALIDARG", error.name) from error


@serves(ops.READ_MESSAGE)
def read(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """Remove and return the first message.

    Without one the answer is an empty list, or 204.
    """
    queue = find(app, request.names["queue"])
    notify = taken(queue)
    if notify is None:
        return show() if request.is_one else None
    return show(Item(request.kind("dipc-read-li", "dipc-read"), queue.name, notify))


def taken(queue: ClientQueue) -> dict[str, str] | None:
    """Remove and return the data of the first message; None without one."""
    result = queue.take()
    if result is None:
        return None
    return {
        "queue-name": queue.name,
        "queue-size": str(queue.queue.spec.max_messages),
        "queue-sid": _slot(queue.name),
        "queue-did": _slot(result.sender),
        "dipc-msgtype": result.kind,
        "dipc-cmd": result.command,
        "dipc-data": result.data,
        "dipc-userdef": result.user,
    }


@subscribable("/rw/dipc/(?P<queue>[^/]+)", "", "nomessage")
def queue_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Messages of a client's queue, which an event takes; `nomessage` leaves them there."""
    queue = find(app, topic.names["queue"])

    def watch(notify: Notify) -> Callable[[], None]:
        def look() -> None:
            if topic.suffix:
                notify(Item("dipc-msg-ev", "msg", {}, {"self": topic.text}))
                return
            while (fields := taken(queue)) is not None:  # those from before, too
                notify(Item("dipc-msg-ev", "msg", fields, {"self": topic.text}))

        queue.queue.changed.add(look)
        return lambda: queue.queue.changed.remove(look)

    return EventSource(lambda: Item("dipc-msg-ev"), watch, has_state=False)
