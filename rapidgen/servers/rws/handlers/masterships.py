"""Mastership of RobotWare 6 and 7, control stations and write access of RobotWare 8."""

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


def _gone(office: "RwsContext") -> None:
    if office.generation is Generation.EIGHT:
        raise RequestDenied(
            410, "E_NOTIMPL", "mastership is gone: write access of a control station"
        )


@serves(ops.MASTERSHIPS)
def masterships(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """The domains."""
    _gone(office)
    return show(*(Item("msh-resource-li", d) for d in office.masters.domains), collection=True)


@serves(ops.MASTERSHIP)
def mastership(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Who has a domain."""
    _gone(office)
    domain = asked.names["domain"]
    if domain not in office.masters.domains:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    holder = office.masters.holders.get(domain)
    mine = holder is asked.session
    told = {
        "uid": str(holder.number if holder else 0),
        "application": holder.application if holder else "",
        "alias": (holder.alias or holder.user) if holder else "",
        "location": holder.location if holder else "",
        "mastershipheldbyme": "TRUE" if mine else "FALSE",
        "mastership": "remote" if holder else "nomaster",
    }
    return show(Item("msh-resource", domain, told))


@serves(ops.REQUEST, ops.REQUEST_ALL, ops.REQUEST_PLAIN)
def request(office: "RwsContext", asked: RwsRequest) -> None:
    """Take one domain, or all of them."""
    _gone(office)
    office.masters.need_mode(asked.session)
    for domain in _named(office, asked):
        office.masters.request(asked.session, domain)


@serves(ops.RELEASE, ops.RELEASE_ALL)
def release(office: "RwsContext", asked: RwsRequest) -> None:
    """Give one domain back, or all of them."""
    _gone(office)
    for domain in _named(office, asked):
        office.masters.release(asked.session, domain)


@serves(ops.REQUEST_WITH_ID)
def request_with_id(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Take a domain; the number is for giving it back from another session."""
    request(office, asked)
    domain = asked.names["domain"]
    return show(Item("msh-resource", domain, {"mastership-id": str(asked.session.number)}))


@serves(ops.RELEASE_WITH_ID)
def release_with_id(office: "RwsContext", asked: RwsRequest) -> None:
    """Give a domain back by the number of who has it."""
    _gone(office)
    number, domain = asked.field("mastershipid"), asked.names["domain"]
    holder = office.masters.holders.get(domain)
    if holder is None or str(holder.number) != number:
        raise RequestDenied(403, "E_RESOURCE_NOT_HELD", f"mastership of {domain} is not held", -1)
    office.masters.release(holder, domain)


@serves(ops.WATCHDOG)
def watchdog(office: "RwsContext", asked: RwsRequest) -> None:
    """The session is there still: every request says so."""
    _gone(office)


def _named(office: "RwsContext", asked: RwsRequest) -> tuple[str, ...]:
    domain = asked.names.get("domain")
    return (domain,) if domain else office.masters.domains


# -- RobotWare 8 ---------------------------------------------------------------------------------


@serves(ops.STATION_REGISTER)
def register_station(office: "RwsContext", asked: RwsRequest) -> None:
    """The session becomes part of a control station; its id stands in braces."""
    guid = asked.field("control-station-id")
    if not _GUID.fullmatch(guid):
        raise RequestDenied(400, "E_INVALIDARG", "control-station-id", -20_103)
    asked.field("pincode")
    office.masters.stations[guid] = asked.field("control-station-name")
    asked.session.station = guid


@serves(ops.STATION_TYPE)
def station_type(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What kind of control station this session is of."""
    told = {"control-station-type": "remote" if asked.session.station else "none"}
    return show(Item("controlstation-type", "type", told))


@serves(ops.STATION_ID)
def station_id(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Which control station this session is of."""
    return show(Item("control-station", "id", {"control-station-Id": asked.session.station}))


@serves(ops.LOCAL_STATION)
def local_station(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether a pendant is there: none is, here."""
    told = {"local-control-station-isconnected": "false"}
    return show(Item("controlstation-local-isconnected", "isconnected", told))


@serves(ops.WRITE_ACCESS)
def write_access(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Which control station may write."""
    masters = office.masters
    told = {
        "control-station-write-access-held": "true" if masters.station else "false",
        "held-by-control-station-Id": masters.station,
        "held-by-control-station-name": masters.stations.get(masters.station, ""),
        "control-station-external-control-enabled": "true",
    }
    return show(Item("controlstation-write-access-status", "status", told))


@serves(ops.WRITE_REQUEST)
def request_write(office: "RwsContext", asked: RwsRequest) -> None:
    """Take write access."""
    masters, station = office.masters, asked.session.station
    if not station:
        raise RequestDenied(403, "E_REJECT", "Session is not part of a Control Station", -20_107)
    if masters.station not in ("", station):
        raise RequestDenied(403, "E_WRITE_ACCESS_TAKEN", "write access is taken", -20_109)
    masters.station = station


@serves(ops.WRITE_RELEASE)
def release_write(office: "RwsContext", asked: RwsRequest) -> None:
    """Give write access back."""
    masters, station = office.masters, asked.session.station
    if not station or masters.station != station:
        raise RequestDenied(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
    masters.station = ""


@serves(ops.MOTION_ALLOWED)
def motion_allowed(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether a start may move something."""
    told = {"is-enabled": "true" if office.masters.motion_allowed else "false"}
    return show(Item("controstation-allow-motion-control", "allowmotioncontrol", told))


@serves(ops.ALLOW_MOTION)
def allow_motion(office: "RwsContext", asked: RwsRequest) -> None:
    """Let a start move something."""
    office.masters.need(asked, "motion")
    told = asked.field("allow-motion-control", ("true", "false"))
    office.masters.motion_allowed = told == "true"
