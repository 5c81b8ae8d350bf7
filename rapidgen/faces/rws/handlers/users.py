"""Users, grants, mastership, write access; the end of a session."""

import re
from typing import TYPE_CHECKING

from rapidgen.faces.rws.asking import Answer, Asked, Refused, show
from rapidgen.faces.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.codes import name_of

if TYPE_CHECKING:
    from rapidgen.faces.rws.desk import Desk

GRANTS = (
    "UAS_FULL_ACCESS", "UAS_CFG_WRITE", "UAS_BACKUP", "UAS_RAPID_EDIT", "UAS_RAPID_EXECUTE",
    "UAS_IO_WRITE", "UAS_RAPID_LOADPROGRAM", "UAS_SPEED_DECREASE",
    "UAS_CONTROLLER_PROPERTIES_WRITE",
)  # fmt: skip
_GUID = re.compile(r"\{[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}")


@serves(ops.LOGOUT)
def logout(desk: "Desk", asked: Asked) -> Answer:
    """End the session; what it held is free, but RobotWare 8's write access."""
    desk.sessions.end(asked.session)
    return show(title="logout")


@serves(ops.REGISTER_USER)
def register(desk: "Desk", asked: Asked) -> Answer:
    """Say who it is, for others to read."""
    session = asked.session
    session.alias = asked.form.get("username", "")
    session.application = asked.form.get("application", "")
    session.location = asked.form.get("location", "")
    return Answer(201)


@serves(ops.LOGIN_INFO)
def login_info(desk: "Desk", asked: Asked) -> Answer:
    """Who is logged in."""
    return show(Item("user-login-info", asked.session.user, {"name": asked.session.user}))


def _grants(desk: "Desk", asked: Asked) -> list[str]:
    denied = desk.login.denied if asked.session.user == "Default User" else frozenset[str]()
    return [grant for grant in GRANTS if grant not in denied]


@serves(ops.GRANTS)
def grants(desk: "Desk", asked: Asked) -> Answer:
    """What this user may do."""
    if asked.is_one:
        return show(*(Item("user-grant", g) for g in _grants(desk, asked)), collection=True)
    found = (Item("uas-grant", g, {"grantname": g}) for g in _grants(desk, asked))
    return show(*found, collection=True)


@serves(ops.GRANT_EXISTS)
def grant_exists(desk: "Desk", asked: Asked) -> Answer:
    """Whether this user may do one thing."""
    wanted = asked.query.get("grant", "")
    told = "true" if wanted in _grants(desk, asked) else "false"
    return show(Item("user-grant-status", wanted, {"status": told}))


@serves(ops.RETCODE)
def retcode(desk: "Desk", asked: Asked) -> Answer:
    """What a code means."""
    try:
        code = int(asked.query.get("code", ""))
    except ValueError as error:
        raise Refused(400, "E_INVALIDARG", "code") from error
    name = name_of(code)
    severity = "Error" if code < 0 else "Success"
    told = {"name": name, "code": str(code), "severity": severity, "description": name}
    return show(Item("err-desc", str(code), told))


# -- RMMP: asked for, and nobody is there to grant it ---------------------------------------------


@serves(ops.ASK_RMMP)
def ask_rmmp(desk: "Desk", asked: Asked) -> Answer:
    """Ask the pendant's user for the right to write in manual mode."""
    _no_rmmp_on_8(desk)
    asked.field("privilege", ("modify", "exec"))
    return Answer(202)


@serves(ops.CANCEL_RMMP)
def cancel_rmmp(desk: "Desk", asked: Asked) -> None:
    """Ask no more."""
    _no_rmmp_on_8(desk)


@serves(ops.RMMP)
def rmmp(desk: "Desk", asked: Asked) -> Answer:
    """Who may write in manual mode: nobody."""
    _no_rmmp_on_8(desk)
    told = {"userid": "0", "alias": "", "location": "", "application": "", "privilege": "none"}
    return show(Item("user-rmmp", "rmmp", {**told, "rmmpheldbyme": "false"}))


@serves(ops.RMMP_POLL)
def poll_rmmp(desk: "Desk", asked: Asked) -> Answer:
    """Whether it was granted: in automatic mode it need not be."""
    _no_rmmp_on_8(desk)
    granted = desk.controller.mode == "auto"
    told = {"code": "0", "status": "GRANTED" if granted else "PENDING"}
    return show(Item("user-rmmp-poll", "poll", told))


def _no_rmmp_on_8(desk: "Desk") -> None:
    if desk.generation is Generation.EIGHT:
        raise Refused(500, "E_UNEXPECTED", "RMMP")


# -- mastership ----------------------------------------------------------------------------------


def _gone(desk: "Desk") -> None:
    if desk.generation is Generation.EIGHT:
        raise Refused(410, "E_NOTIMPL", "mastership is gone: write access of a control station")


@serves(ops.MASTERSHIPS)
def masterships(desk: "Desk", asked: Asked) -> Answer:
    """The domains."""
    _gone(desk)
    return show(*(Item("msh-resource-li", d) for d in desk.masters.domains), collection=True)


@serves(ops.MASTERSHIP)
def mastership(desk: "Desk", asked: Asked) -> Answer:
    """Who has a domain."""
    _gone(desk)
    domain = asked.names["domain"]
    if domain not in desk.masters.domains:
        raise Refused(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    holder = desk.masters.holders.get(domain)
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
def request(desk: "Desk", asked: Asked) -> None:
    """Take one domain, or all of them."""
    _gone(desk)
    desk.masters.need_mode()
    for domain in _named(desk, asked):
        desk.masters.request(asked.session, domain)


@serves(ops.RELEASE, ops.RELEASE_ALL)
def release(desk: "Desk", asked: Asked) -> None:
    """Give one domain back, or all of them."""
    _gone(desk)
    for domain in _named(desk, asked):
        desk.masters.release(asked.session, domain)


def _named(desk: "Desk", asked: Asked) -> tuple[str, ...]:
    domain = asked.names.get("domain")
    return (domain,) if domain else desk.masters.domains


# -- RobotWare 8 ---------------------------------------------------------------------------------


@serves(ops.STATION_REGISTER)
def register_station(desk: "Desk", asked: Asked) -> None:
    """The session becomes part of a control station; its id stands in braces."""
    guid = asked.field("control-station-id")
    if not _GUID.fullmatch(guid):
        raise Refused(400, "E_INVALIDARG", "control-station-id", -20_103)
    asked.field("pincode")
    desk.masters.stations[guid] = asked.field("control-station-name")
    asked.session.station = guid


@serves(ops.WRITE_ACCESS)
def write_access(desk: "Desk", asked: Asked) -> Answer:
    """Which control station may write."""
    masters = desk.masters
    told = {
        "control-station-write-access-held": "true" if masters.station else "false",
        "held-by-control-station-Id": masters.station,
        "held-by-control-station-name": masters.stations.get(masters.station, ""),
        "control-station-external-control-enabled": "true",
    }
    return show(Item("controlstation-write-access-status", "status", told))


@serves(ops.WRITE_REQUEST)
def request_write(desk: "Desk", asked: Asked) -> None:
    """Take write access."""
    masters, station = desk.masters, asked.session.station
    if not station:
        raise Refused(403, "E_REJECT", "Session is not part of a Control Station", -20_107)
    if masters.station not in ("", station):
        raise Refused(403, "E_WRITE_ACCESS_TAKEN", "write access is taken", -20_109)
    masters.station = station


@serves(ops.WRITE_RELEASE)
def release_write(desk: "Desk", asked: Asked) -> None:
    """Give write access back."""
    masters, station = desk.masters, asked.session.station
    if not station or masters.station != station:
        raise Refused(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
    masters.station = ""


@serves(ops.MOTION_ALLOWED)
def motion_allowed(desk: "Desk", asked: Asked) -> Answer:
    """Whether a start may move something."""
    told = {"is-enabled": "true" if desk.masters.motion_allowed else "false"}
    return show(Item("controstation-allow-motion-control", "allowmotioncontrol", told))


@serves(ops.ALLOW_MOTION)
def allow_motion(desk: "Desk", asked: Asked) -> None:
    """Let a start move something."""
    desk.masters.need(asked, "motion")
    told = asked.field("allow-motion-control", ("true", "false"))
    desk.masters.motion_allowed = told == "true"
