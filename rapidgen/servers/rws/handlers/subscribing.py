"""Subscriptions asked for over HTTP; what is told goes over a websocket."""

from typing import TYPE_CHECKING

from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource, read_wanted, write_opened

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext
    from rapidgen.servers.rws.subscriptions import EventGroup


def _wanted(asked: RwsRequest) -> list[WantedResource]:
    try:
        return read_wanted(asked.pairs)
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error


def _opened(
    office: "RwsContext", asked: RwsRequest, group: "EventGroup", status: int
) -> RwsResponse:
    poll = f"{'ws' if asked.is_one else 'wss'}://{asked.host}/poll/{group.number}"
    body = write_opened(group.number, poll, office.groups.initial(group))
    kind = "application/xhtml+xml" if asked.is_one else "application/xhtml+xml;v=2.0"
    return RwsResponse(status, data=body, headers=(("Location", poll), ("Content-Type", kind)))


@serves(ops.SUBSCRIBE)
def subscribe(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """A new group; the body is XHTML whatever was asked for."""
    return _opened(office, asked, office.groups.begin(asked, _wanted(asked)), 201)


@serves(ops.ADD_SUBSCRIPTION)
def add(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """More resources for a group."""
    group = office.groups.find(asked.names["group"], asked.session)
    office.groups.add(asked, group, _wanted(asked))
    return _opened(office, asked, group, 200)


@serves(ops.UNSUBSCRIBE)
def unsubscribe(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Watch no more."""
    office.groups.end(office.groups.find(asked.names["group"], asked.session))
    return RwsResponse(200)


@serves(ops.UNSUBSCRIBE_ONE)
def unsubscribe_one(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """One resource less."""
    group = office.groups.find(asked.names["group"], asked.session)
    suffix = f";{asked.suffix}" if asked.suffix else ""
    office.groups.remove(group, f"/{asked.names['resource']}{suffix}")
    return RwsResponse(200)


@serves(ops.SUBSCRIPTIONS)
def get_groups(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Groups of this session."""
    own = office.groups.of(asked.session)
    items = (Item("sub-group-li", str(g.number), {}, {"self": str(g.number)}) for g in own)
    return show(*items, collection=True)


@serves(ops.SUBSCRIPTION)
def get_group(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What a group of this session watches."""
    group = office.groups.find(asked.names["group"], asked.session)
    found = (
        Item("sub-resource-li", w.wanted.resource, {"priority": str(w.wanted.priority)})
        for w in group.watches
    )
    return show(*found, collection=True)
