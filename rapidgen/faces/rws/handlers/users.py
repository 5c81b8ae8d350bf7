"""Users, grants, mastership, write access; the end of a session."""

import re
from typing import TYPE_CHECKING

from rapidgen.faces.rws.asking import Denied, RwsRequest, Served, show
from rapidgen.faces.rws.rmmp import Privilege
from rapidgen.faces.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.codes import CODES, name_of

if TYPE_CHECKING:
    from rapidgen.faces.rws.office import Office

_GUID = re.compile(r"\{[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}")


@serves(ops.LOGOUT)
def logout(office: "Office", asked: RwsRequest) -> Served:
    """End the session; what it held is free, but RobotWare 8's write access."""
    office.end_session(asked.session)
    return show(title="logout")


@serves(ops.REGISTER_USER)
def register(office: "Office", asked: RwsRequest) -> Served:
    """Say who it is, for others to read."""
    session = asked.session
    session.alias = asked.form.get("username", "")
    session.application = asked.form.get("application", "")
    session.location = asked.form.get("location", "")
    return Served(201)


@serves(ops.LOGIN_INFO)
def login_info(office: "Office", asked: RwsRequest) -> Served:
    """Who is logged in."""
    return show(Item("user-login-info", asked.session.user, {"name": asked.session.user}))


def _grants(office: "Office", asked: RwsRequest) -> list[str]:
    return sorted(office.login.granted(asked.session.user))


@serves(ops.GRANTS)
def grants(office: "Office", asked: RwsRequest) -> Served:
    """What this user may do."""
    if asked.is_one:
        return show(*(Item("user-grant", g) for g in _grants(office, asked)), collection=True)
    found = (Item("uas-grant", g, {"grantname": g}) for g in _grants(office, asked))
    return show(*found, collection=True)


@serves(ops.GRANT_EXISTS)
def grant_exists(office: "Office", asked: RwsRequest) -> Served:
    """Whether this user may do one thing."""
    wanted = asked.query.get("grant", "")
    told = "true" if wanted in _grants(office, asked) else "false"
    return show(Item("user-grant-status", wanted, {"status": told}))


@serves(ops.RETCODE)
def retcode(office: "Office", asked: RwsRequest) -> Served:
    """What a code means."""
    try:
        code = int(asked.query.get("code", ""))
    except ValueError as error:
        raise Denied(400, "E_INVALIDARG", "code") from error
    name = name_of(code)
    severity = "Error" if code < 0 else "Success"
    told = {"name": name, "code": str(code), "severity": severity, "description": name}
    return show(Item("err-desc", str(code), told))


# -- RMMP: remote writing in manual mode ----------------------------------------------------------


@serves(ops.ASK_RMMP)
def ask_rmmp(office: "Office", asked: RwsRequest) -> Served:
    """Ask the pendant's user for the right to write in manual mode."""
    _no_rmmp_on_8(office)
    wanted = asked.field("privilege", ("modify", "exec"))
    privilege: Privilege = "exec" if wanted == "exec" else "modify"
    if office.controller.mode != "auto" and not office.masters.manual.ask(asked.session, privilege):
        raise Denied(403, "E_RESOURCE_HELD", "another session asks for it, or has it", -4_502)
    return Served(202)


@serves(ops.CANCEL_RMMP)
def cancel_rmmp(office: "Office", asked: RwsRequest) -> None:
    """Ask no more, or give it back."""
    _no_rmmp_on_8(office)
    office.masters.manual.cancel(asked.session)


@serves(ops.RMMP)
def rmmp(office: "Office", asked: RwsRequest) -> Served:
    """Who may write in manual mode, or asks for it."""
    _no_rmmp_on_8(office)
    manual = office.masters.manual
    who = manual.session
    told = {
        "userid": str(who.number if who else 0),
        "alias": (who.alias or who.user) if who else "",
        "location": who.location if who else "",
        "application": who.application if who else "",
        "privilege": ("" if manual.granted else "pending ") + manual.privilege if who else "none",
        "rmmpheldbyme": "true" if manual.has(asked.session, "modify") else "false",
    }
    return show(Item("user-rmmp", "rmmp", told))


_POLLED = {
    "PENDING": "SYS_CTRL_S_PENDING", "GRANTED": "SYS_CTRL_S_GRANTED", "DENIED": "E_REJECT",
    "TIMEOUT": "E_TIMEOUT", "NONE": "E_NO_DATA",
}  # fmt: skip


@serves(ops.RMMP_POLL)
def poll_rmmp(office: "Office", asked: RwsRequest) -> Served:
    """Whether it was granted; keeps the question on the pendant. In automatic mode it need not be.

    PENDING and GRANTED are ABB's words [code: abb_robot_client], those for a refusal are ours.
    """
    _no_rmmp_on_8(office)
    manual = office.masters.manual
    manual.keep(asked.session)
    state = "GRANTED" if office.controller.mode == "auto" else manual.state(asked.session)
    told = {"code": str(CODES[_POLLED[state]]), "status": state}
    return show(Item("user-rmmp-poll", "poll", told))


def _no_rmmp_on_8(office: "Office") -> None:
    if office.generation is Generation.EIGHT:
        raise Denied(500, "E_UNEXPECTED", "RMMP")


# -- mastership ----------------------------------------------------------------------------------


def _gone(office: "Office") -> None:
    if office.generation is Generation.EIGHT:
        raise Denied(410, "E_NOTIMPL", "mastership is gone: write access of a control station")


@serves(ops.MASTERSHIPS)
def masterships(office: "Office", asked: RwsRequest) -> Served:
    """The domains."""
    _gone(office)
    return show(*(Item("msh-resource-li", d) for d in office.masters.domains), collection=True)


@serves(ops.MASTERSHIP)
def mastership(office: "Office", asked: RwsRequest) -> Served:
    """Who has a domain."""
    _gone(office)
    domain = asked.names["domain"]
    if domain not in office.masters.domains:
        raise Denied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
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
def request(office: "Office", asked: RwsRequest) -> None:
    """Take one domain, or all of them."""
    _gone(office)
    office.masters.need_mode(asked.session)
    for domain in _named(office, asked):
        office.masters.request(asked.session, domain)


@serves(ops.RELEASE, ops.RELEASE_ALL)
def release(office: "Office", asked: RwsRequest) -> None:
    """Give one domain back, or all of them."""
    _gone(office)
    for domain in _named(office, asked):
        office.masters.release(asked.session, domain)


def _named(office: "Office", asked: RwsRequest) -> tuple[str, ...]:
    domain = asked.names.get("domain")
    return (domain,) if domain else office.masters.domains


# -- RobotWare 8 ---------------------------------------------------------------------------------


@serves(ops.STATION_REGISTER)
def register_station(office: "Office", asked: RwsRequest) -> None:
    """The session becomes part of a control station; its id stands in braces."""
    guid = asked.field("control-station-id")
    if not _GUID.fullmatch(guid):
        raise Denied(400, "E_INVALIDARG", "control-station-id", -20_103)
    asked.field("pincode")
    office.masters.stations[guid] = asked.field("control-station-name")
    asked.session.station = guid


@serves(ops.WRITE_ACCESS)
def write_access(office: "Office", asked: RwsRequest) -> Served:
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
def request_write(office: "Office", asked: RwsRequest) -> None:
    """Take write access."""
    masters, station = office.masters, asked.session.station
    if not station:
        raise Denied(403, "E_REJECT", "Session is not part of a Control Station", -20_107)
    if masters.station not in ("", station):
        raise Denied(403, "E_WRITE_ACCESS_TAKEN", "write access is taken", -20_109)
    masters.station = station


@serves(ops.WRITE_RELEASE)
def release_write(office: "Office", asked: RwsRequest) -> None:
    """Give write access back."""
    masters, station = office.masters, asked.session.station
    if not station or masters.station != station:
        raise Denied(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
    masters.station = ""


@serves(ops.MOTION_ALLOWED)
def motion_allowed(office: "Office", asked: RwsRequest) -> Served:
    """Whether a start may move something."""
    told = {"is-enabled": "true" if office.masters.motion_allowed else "false"}
    return show(Item("controstation-allow-motion-control", "allowmotioncontrol", told))


@serves(ops.ALLOW_MOTION)
def allow_motion(office: "Office", asked: RwsRequest) -> None:
    """Let a start move something."""
    office.masters.need(asked, "motion")
    told = asked.field("allow-motion-control", ("true", "false"))
    office.masters.motion_allowed = told == "true"
