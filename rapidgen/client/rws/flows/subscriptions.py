"""Subscriptions and the events of their messages."""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from urllib.parse import unquote

from rapidgen.client.errors import RobotError
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.errors import NotRws
from rapidgen.client.rws.flows.connect import connect
from rapidgen.client.rws.flows.jobs import wait_ready
from rapidgen.client.rws.flows.rapid import symbol_text
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import ResourceEvent
from rapidgen.client.rws.topics import Topic
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws import xhtml
from rapidgen.wire.rws.bodies import Item, Unreadable
from rapidgen.wire.rws.events import WantedResource, read_events, read_opened, write_wanted

_TWINS = ("rap-data",)
"""Class of an item that repeats an event."""


@dataclass(frozen=True, slots=True)
class SubscriptionGroup:
    """A subscription: its group, its websocket path, and current values."""

    group: str
    path: str
    events: tuple[ResourceEvent, ...]


def subscribe(core: RwsCore, topics: Sequence[Topic]) -> Flow[SubscriptionGroup]:
    """Subscribe to topics. Raises RwsError (RG650), NotRws (RG653)."""
    yield from connect(core)
    requested = [
        WantedResource(topic.resource(core.generation), topic.priority) for topic in topics
    ]
    _, response = yield from ask(core, ops.SUBSCRIBE, form=write_wanted(requested))
    try:
        body = xhtml.read(response.body)
        group, path = read_opened(body, response.headers.get("location", ""))
    except ValueError as error:
        raise NotRws.because("RG653", f"{core.where} returns no subscription: {error}") from error
    events = yield from _events(core, topics, body.items)
    return SubscriptionGroup(group, path, events)


def again(core: RwsCore, topics: Sequence[Topic], wait: float) -> Flow[SubscriptionGroup]:
    """Subscribe again after a lost connection or a restart."""
    yield from wait_ready(core, wait=wait)
    return (yield from subscribe(core, topics))


def unsubscribe(core: RwsCore, group: str) -> Flow[None]:
    """End a subscription; harmless if the group has ended."""
    if core.connected:
        with suppress(RobotError):
            yield from ask(core, ops.UNSUBSCRIBE, {"group": group}, accepted=(404,))


def events_of(
    core: RwsCore, topics: Sequence[Topic], message: bytes
) -> Flow[tuple[ResourceEvent, ...]]:
    """Return the events of a message; read values that it only links to."""
    try:
        items = read_events(message)
    except Unreadable as error:
        raise NotRws.because("RG653", f"{core.where} sent an invalid event: {error}") from error
    return (yield from _events(core, topics, items))


def _events(
    core: RwsCore, topics: Sequence[Topic], items: Iterable[Item]
) -> Flow[tuple[ResourceEvent, ...]]:
    result = []
    by_path = {_path(t.resource(core.generation)): t for t in topics}
    for item in items:
        topic = by_path.get(_path(item.links.get("self", "")))
        if item.kind in _TWINS:
            continue
        name = topic.name if topic is not None else item.title
        if item.kind == "rap-ui-ev":
            name = "dialogs"  # recognised by its class: it has no link [code: OmniCore App SDK]
        if item.kind == "elog-message-ev":
            value = item.text("seqnum") or item.links.get("self", "").rpartition("/")[2]
            domain = item.links.get("self", "").split("/")[-2:][0]
            name = f"log {domain}"
        elif item.kind == "dipc-msg-ev":
            value = item.text("dipc-data")
        elif item.fields:
            value = next(iter(item.fields.values()))
        elif topic is not None and topic.operation is ops.SYMBOL:
            value = yield from symbol_text(core, topic.name)
        else:
            value = ""
        result.append(ResourceEvent(name, item.kind, value))
    return tuple(result)


def _path(text: str) -> str:
    return unquote(text.partition(";")[0]).rstrip("/").lower()
