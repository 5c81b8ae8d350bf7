"""Subscriptions over HTTP; a websocket carries their events."""

from typing import TYPE_CHECKING

from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource, read_wanted, write_opened

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext
    from rapidgen.servers.rws.subscriptions import EventGroup


def _wanted(request: RwsRequest) -> list[WantedResource]:
    try:
        return read_wanted(request.pairs)
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error


def _opened(
    context: "RwsContext", request: RwsRequest, group: "EventGroup", status: int
) -> RwsResponse:
    poll = f"{'ws' if request.is_one else 'wss'}://{request.host}/poll/{group.number}"
    body = write_opened(group.number, poll, context.groups.initial(group))
    kind = "application/xhtml+xml" if request.is_one else "application/xhtml+xml;v=2.0"
    return RwsResponse(status, data=body, headers=(("Location", poll), ("Content-Type", kind)))


@serves(ops.SUBSCRIBE)
def subscribe(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Create a group; the body is XHTML for any accepted type."""
    return _opened(context, request, context.groups.begin(request, _wanted(request)), 201)


@serves(ops.ADD_SUBSCRIPTION)
def add(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Add resources to a group."""
    group = context.groups.find(request.names["group"], request.session)
    context.groups.add(request, group, _wanted(request))
    return _opened(context, request, group, 200)


@serves(ops.UNSUBSCRIBE)
def unsubscribe(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """End a group."""
    context.groups.end(context.groups.find(request.names["group"], request.session))
    return RwsResponse(200)


@serves(ops.UNSUBSCRIBE_ONE)
def unsubscribe_one(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Remove one resource."""
    group = context.groups.find(request.names["group"], request.session)
    suffix = f";{request.suffix}" if request.suffix else ""
    context.groups.remove(group, f"/{request.names['resource']}{suffix}")
    return RwsResponse(200)


@serves(ops.SUBSCRIPTIONS)
def get_groups(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return groups of this session."""
    own = context.groups.of(request.session)
    items = (Item("sub-group-li", str(g.number), {}, {"self": str(g.number)}) for g in own)
    return show(*items, collection=True)


@serves(ops.SUBSCRIPTION)
def get_group(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the resources of a group of this session."""
    group = context.groups.find(request.names["group"], request.session)
    result = (
        Item("sub-resource-li", w.wanted.resource, {"priority": str(w.wanted.priority)})
        for w in group.watches
    )
    return show(*result, collection=True)
