"""Mastership of RobotWare 6 and 7; stations and write access of 8.

Stations are RobotWare 8's control stations.
"""

import re
from typing import TYPE_CHECKING

from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_GUID = re.compile(r"\{[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}")


# -- mastership ----------------------------------------------------------------------------------


def _gone(context: "RwsContext") -> None:
    if context.generation is Generation.EIGHT:
        raise RequestDenied(
            410, "E_NOTIMPL", "mastership is gone: write access of a control station"
        )


@serves(ops.MASTERSHIPS)
def masterships(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the domains."""
    _gone(context)
    return show(*(Item("msh-resource-li", d) for d in context.masters.domains), collection=True)


@serves(ops.MASTERSHIP)
def mastership(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the holder of a domain."""
    _gone(context)
    domain = request.names["domain"]
    if domain not in context.masters.domains:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    holder = context.masters.holders.get(domain)
    mine = holder is request.session
    notify = {
        "uid": str(holder.number if holder else 0),
        "application": holder.application if holder else "",
        "alias": (holder.alias or holder.user) if holder else "",
        "location": holder.location if holder else "",
        "mastershipheldbyme": "TRUE" if mine else "FALSE",
        "mastership": "remote" if holder else "nomaster",
    }
    return show(Item("msh-resource", domain, notify))


@serves(ops.REQUEST, ops.REQUEST_ALL, ops.REQUEST_PLAIN)
def request(context: "RwsContext", asked: RwsRequest) -> None:
    """Take one domain, or all of them."""
    _gone(context)
    context.masters.need_mode(asked.session)
    for domain in _named(context, asked):
        context.masters.request(asked.session, domain)


@serves(ops.RELEASE, ops.RELEASE_ALL)
def release(context: "RwsContext", request: RwsRequest) -> None:
    """Release one domain, or all."""
    _gone(context)
    for domain in _named(context, request):
        context.masters.release(request.session, domain)


@serves(ops.REQUEST_WITH_ID)
def request_with_id(context: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Take a domain; its number releases it from another session."""
    request(context, asked)
    domain = asked.names["domain"]
    return show(Item("msh-resource", domain, {"mastership-id": str(asked.session.number)}))


@serves(ops.RELEASE_WITH_ID)
def release_with_id(context: "RwsContext", request: RwsRequest) -> None:
    """Release a domain by the number of its holder."""
    _gone(context)
    number, domain = request.field("mastershipid"), request.names["domain"]
    holder = context.masters.holders.get(domain)
    if holder is None or str(holder.number) != number:
        raise RequestDenied(403, "E_RESOURCE_NOT_HELD", f"mastership of {domain} is not held", -1)
    context.masters.release(holder, domain)


@serves(ops.WATCHDOG)
def watchdog(context: "RwsContext", request: RwsRequest) -> None:
    """Keep the session alive, as every request does."""
    _gone(context)


def _named(context: "RwsContext", request: RwsRequest) -> tuple[str, ...]:
    domain = request.names.get("domain")
    return (domain,) if domain else context.masters.domains


# -- RobotWare 8 ---------------------------------------------------------------------------------


@serves(ops.STATION_REGISTER)
def register_station(context: "RwsContext", request: RwsRequest) -> None:
    """Add the session to a control station; its id is in braces."""
    guid = request.field("control-station-id")
    if not _GUID.fullmatch(guid):
        raise RequestDenied(400, "E_INVALIDARG", "control-station-id", -20_103)
    request.field("pincode")
    context.masters.stations[guid] = request.field("control-station-name")
    request.session.station = guid


@serves(ops.STATION_TYPE)
def station_type(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the type of this session's control station."""
    notify = {"control-station-type": "remote" if request.session.station else "none"}
    return show(Item("controlstation-type", "type", notify))


@serves(ops.STATION_ID)
def station_id(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the id of this session's control station."""
    return show(Item("control-station", "id", {"control-station-Id": request.session.station}))


@serves(ops.LOCAL_STATION)
def local_station(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether a pendant is connected: never here."""
    notify = {"local-control-station-isconnected": "false"}
    return show(Item("controlstation-local-isconnected", "isconnected", notify))


@serves(ops.WRITE_ACCESS)
def write_access(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the control station with write access."""
    masters = context.masters
    notify = {
        "control-station-write-access-held": "true" if masters.station else "false",
        "held-by-control-station-Id": masters.station,
        "held-by-control-station-name": masters.stations.get(masters.station, ""),
        "control-station-external-control-enabled": "true",
    }
    return show(Item("controlstation-write-access-status", "status", notify))


@serves(ops.WRITE_REQUEST)
def request_write(context: "RwsContext", request: RwsRequest) -> None:
    """Take write access."""
    masters, station = context.masters, request.session.station
    if not station:
        raise RequestDenied(403, "E_REJECT", "Session is not part of a Control Station", -20_107)
    if masters.station not in ("", station):
        raise RequestDenied(403, "E_WRITE_ACCESS_TAKEN", "write access is taken", -20_109)
    masters.station = station


@serves(ops.WRITE_RELEASE)
def release_write(context: "RwsContext", request: RwsRequest) -> None:
    """Release write access."""
    masters, station = context.masters, request.session.station
    if not station or masters.station != station:
        raise RequestDenied(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
    masters.station = ""


@serves(ops.MOTION_ALLOWED)
def motion_allowed(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether a start may move a robot."""
    notify = {"is-enabled": "true" if context.masters.motion_allowed else "false"}
    return show(Item("controstation-allow-motion-control", "allowmotioncontrol", notify))


@serves(ops.ALLOW_MOTION)
def allow_motion(context: "RwsContext", request: RwsRequest) -> None:
    """Permit a start to move a robot."""
    context.masters.need(request, "motion")
    notify = request.field("allow-motion-control", ("true", "false"))
    context.masters.motion_allowed = notify == "true"
