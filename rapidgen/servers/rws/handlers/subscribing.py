"""Subscriptions over HTTP; a websocket carries their events."""

from typing import TYPE_CHECKING

from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource, read_wanted, write_opened

if TYPE_CHECKING:
    from rapidgen.servers.rws.subscriptions import EventGroup


def _wanted(request: RwsRequest) -> list[WantedResource]:
    try:
        return read_wanted(request.pairs)
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error


def _opened(
    app: RwsApplication, request: RwsRequest, group: "EventGroup", status: int
) -> RwsResponse:
    poll = f"{'ws' if request.is_one else 'wss'}://{request.host}/poll/{group.number}"
    body = write_opened(group.number, poll, app.groups.initial(group))
    kind = "application/xhtml+xml" if request.is_one else "application/xhtml+xml;v=2.0"
    return RwsResponse(status, data=body, headers=(("Location", poll), ("Content-Type", kind)))


@serves(ops.SUBSCRIBE)
def subscribe(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Create a group; the body is XHTML for any accepted type."""
    return _opened(app, request, app.groups.begin(request, _wanted(request)), 201)


@serves(ops.ADD_SUBSCRIPTION)
def add(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Add resources to a group."""
    group = app.groups.find(request.names["group"], request.session)
    app.groups.add(request, group, _wanted(request))
    return _opened(app, request, group, 200)


@serves(ops.UNSUBSCRIBE)
def unsubscribe(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """End a group."""
    app.groups.end(app.groups.find(request.names["group"], request.session))
    return RwsResponse(200)


@serves(ops.UNSUBSCRIBE_ONE)
def unsubscribe_one(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Remove one resource."""
    group = app.groups.find(request.names["group"], request.session)
    suffix = f";{request.suffix}" if request.suffix else ""
    app.groups.remove(group, f"/{request.names['resource']}{suffix}")
    return RwsResponse(200)


@serves(ops.SUBSCRIPTIONS)
def get_groups(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return groups of this session."""
    own = app.groups.of(request.session)
    items = (Item("sub-group-li", str(g.number), {}, {"self": str(g.number)}) for g in own)
    return show(*items, collection=True)


@serves(ops.SUBSCRIPTION)
def get_group(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the resources of a group of this session."""
    group = app.groups.find(request.names["group"], request.session)
    result = (
        Item("sub-resource-li", w.wanted.resource, {"priority": str(w.wanted.priority)})
        for w in group.watches
    )
    return show(*result, collection=True)
