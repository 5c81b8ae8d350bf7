"""Message queues (DIPC): those of clients, and RMQ_<task> of the tasks."""

from rapidgen.client.errors import RobotTimeout
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow, Pause
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import QueueMessage
from rapidgen.wire.rws import operations as ops

_LOOK = 0.2
"""s between two checks of a queue."""
_COMMAND = "111"
"""Value that public clients send [code: abb_robot_client, abb-rws-client]."""


def queues(core: RwsCore) -> Flow[tuple[str, ...]]:
    """Return the names of the clients' queues."""
    body, _ = yield from ask(core, ops.QUEUES)
    return tuple(item.text("queue-name") or item.title for item in body.all("dipc-queue-li"))


def make_queue(core: RwsCore, name: str, *, size: int = 10, largest: int = 444) -> Flow[None]:
    """Create a queue of `size` messages of `largest` bytes."""
    form = {
        "dipc-queue-name": name,
        "dipc-queue-size": str(size),
        "dipc-max-msg-size": str(largest),
    }
    yield from ask(core, ops.CREATE_QUEUE, form=form)


def delete_queue(core: RwsCore, name: str) -> Flow[None]:
    """Delete a queue."""
    yield from ask(core, ops.DELETE_QUEUE, {"queue": name})


def send_message(
    core: RwsCore, queue: str, data: str, *, sender: str = "", user: int = 0
) -> Flow[None]:
    """Put a message into a queue."""
    form = {
        "dipc-src-queue-name": sender,
        "dipc-cmd": _COMMAND,
        "dipc-userdef": str(user),
        "dipc-msgtype": "1",
        "dipc-data": data,
    }
    yield from ask(core, ops.SEND_MESSAGE, {"queue": queue}, form)


def receive_message(core: RwsCore, queue: str, *, wait: float = 0.0) -> Flow[QueueMessage]:
    """Remove and return the first message of a queue of this session."""
    until = core.clock() + wait
    while True:
        body, _ = yield from ask(core, ops.READ_MESSAGE, {"queue": queue})
        result = body.all("dipc-read-li", "dipc-read")
        if result:
            return QueueMessage(result[0].text("dipc-data"), result[0].whole("dipc-userdef"))
        if core.clock() >= until:
            raise RobotTimeout.because("RG602", f"no message in {queue} within {wait:g} s")
        yield Pause(min(_LOOK, until - core.clock()))
