"""Users, grants, masterships, remote writing in manual mode, logout."""

import re

from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.mastership import Privilege
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, Session, show
from rapidgen.servers.rws.subscriptions import EventSource, Topic, new_values, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.codes import CODES, NAMES, name_of
from rapidgen.wire.rws.grants import GRANTS


@serves(ops.LOGOUT)
def logout(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """End the session and its masterships, except RobotWare 8's write access."""
    app.sessions.end(request.session)
    return show(title="logout")


@serves(ops.REGISTER_USER)
def register(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Register a name that others can read."""
    session = request.session
    session.alias = request.form.get("username", "")
    session.application = request.form.get("application", "")
    session.location = request.form.get("location", "")
    return RwsResponse(201)


@serves(ops.USERS)
def users(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the users logged in.

    One entry a session, in RWS 2.0 one a user [code: abb-rws-client]; the class is known to hold
    `user`, the rest is [mem].
    """
    sessions: dict[object, Session] = {}
    for session in app.sessions.all():
        sessions.setdefault(session.number if request.is_one else session.user, session)
    result = [
        Item(
            "user-li",
            session.user,
            {
                "uid": str(session.number),
                "alias": session.alias or session.user,
                "application": session.application,
                "location": session.location,
                "ulocale": "remote",
            },
        )
        for session in sessions.values()
    ]
    return show(*result, collection=True)


@serves(ops.SET_LOCALE)
def set_locale(app: RwsApplication, request: RwsRequest) -> None:
    """Set the locale.

    Local users press the enabling device within 5 s; there are none here.
    """
    if request.field("type", ("local", "remote")) == "local":
        raise RequestDenied(403, "E_REJECT", "no enabling device is pressed", -2)


@serves(ops.IMPERSONATE)
def impersonate(app: RwsApplication, request: RwsRequest) -> None:
    """Act as another session's user, by its number."""
    number = request.field("uid")
    for other in app.sessions.all():
        if str(other.number) == number:
            if app.accounts.granted(other.user) - app.accounts.granted(request.session.user):
                raise RequestDenied(403, "E_UAS_REJECT", f"user {number} may do more", -757)
            request.session.user = other.user
            return
    raise RequestDenied(400, "E_INVALIDARG", f"no user {number}")


@serves(ops.ALL_GRANTS)
def all_grants(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return all grants."""
    names = ("grantname", "description")
    result = (Item("uas-grant", g, dict.fromkeys(names, g)) for g in sorted(GRANTS))
    return show(*result, collection=True)


@serves(ops.PASSWORD_CHANGE)
def password_change(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether this user may change the password: never here."""
    return show(Item("uas-password-change-allow", "allow", {"password-change-allow": "false"}))


@serves(ops.LOGIN_INFO)
def login_info(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the user logged in."""
    return show(Item("user-login-info", request.session.user, {"name": request.session.user}))


def _grants(app: RwsApplication, request: RwsRequest) -> list[str]:
    return sorted(app.accounts.granted(request.session.user))


@serves(ops.GRANTS)
def grants(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the grants of this user."""
    if request.is_one:
        return show(*(Item("user-grant", g) for g in _grants(app, request)), collection=True)
    result = (Item("uas-grant", g, {"grantname": g}) for g in _grants(app, request))
    return show(*result, collection=True)


@serves(ops.GRANT_EXISTS)
def grant_exists(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether this user has one grant."""
    requested = request.query.get("grant", "")
    notify = "true" if requested in _grants(app, request) else "false"
    return show(Item("user-grant-status", requested, {"status": notify}))


@serves(ops.RETCODE)
def retcode(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the meaning of a code, or of all codes."""
    if "code" not in request.query:
        result = [
            Item("err-desc", str(code), {"name": name, "code": str(code)})
            for code, name in NAMES.items()
        ]
        return show(*result, collection=True)
    try:
        code = int(request.query.get("code", ""))
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", "code") from error
    name = name_of(code)
    severity = "Error" if code < 0 else "Success"
    notify = {"name": name, "code": str(code), "severity": severity, "description": name}
    return show(Item("err-desc", str(code), notify))


# -- RMMP: remote writing in manual mode ----------------------------------------------------------


@serves(ops.ASK_RMMP)
def ask_rmmp(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Ask the pendant's user for the right to write in manual mode."""
    _no_rmmp_on_8(app)
    requested = request.field("privilege", ("modify", "exec"))
    privilege: Privilege = "exec" if requested == "exec" else "modify"
    if app.controller.mode != "auto" and not app.masterships.manual.ask(request.session, privilege):
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "another session asks for it, or has it", -4_502
        )
    return RwsResponse(202)


@serves(ops.CANCEL_RMMP)
def cancel_rmmp(app: RwsApplication, request: RwsRequest) -> None:
    """Cancel the request, or release the privilege."""
    _no_rmmp_on_8(app)
    app.masterships.manual.cancel(request.session)


@serves(ops.RMMP)
def rmmp(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the holder of remote writing, or its applicant."""
    _no_rmmp_on_8(app)
    manual = app.masterships.manual
    who = manual.session
    notify = {
        "userid": str(who.number if who else 0),
        "alias": (who.alias or who.user) if who else "",
        "location": who.location if who else "",
        "application": who.application if who else "",
        "privilege": ("" if manual.granted else "pending ") + manual.privilege if who else "none",
        "rmmpheldbyme": "true" if manual.has(request.session, "modify") else "false",
    }
    return show(Item("user-rmmp", "rmmp", notify))


_POLLED = {
    "PENDING": "SYS_CTRL_S_PENDING", "GRANTED": "SYS_CTRL_S_GRANTED", "DENIED": "E_REJECT",
    "TIMEOUT": "E_TIMEOUT", "NONE": "E_NO_DATA",
}  # fmt: skip


@serves(ops.RMMP_POLL)
def poll_rmmp(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the state of the request, which keeps the prompt open.

    In automatic mode no grant is needed. PENDING and GRANTED are ABB's words [code:
    abb_robot_client], those for a refusal are ours.
    """
    _no_rmmp_on_8(app)
    manual = app.masterships.manual
    manual.keep(request.session)
    state = "GRANTED" if app.controller.mode == "auto" else manual.state(request.session)
    notify = {"code": str(CODES[_POLLED[state]]), "status": state}
    return show(Item("user-rmmp-poll", "poll", notify))


@serves(ops.GRANT_RMMP)
def grant_rmmp(app: RwsApplication, request: RwsRequest) -> None:
    """Refuse a local user's answer: no user is local here."""
    request.field("uid")
    request.field("privilege", ("modify", "exec", "deny"))
    raise RequestDenied(403, "E_REJECT", "only a local user grants", -2)


def _no_rmmp_on_8(app: RwsApplication) -> None:
    if app.generation is Generation.EIGHT:
        raise RequestDenied(500, "E_UNEXPECTED", "RMMP")


# -- mastership ------------------------------------------------------------------------------------

_GUID = re.compile(r"\{[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}")


# -- mastership ----------------------------------------------------------------------------------


def _gone(app: RwsApplication) -> None:
    if app.generation is Generation.EIGHT:
        raise RequestDenied(
            410, "E_NOTIMPL", "mastership is gone: write access of a control station"
        )


@serves(ops.MASTERSHIPS)
def masterships(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the domains."""
    _gone(app)
    return show(*(Item("msh-resource-li", d) for d in app.masterships.domains), collection=True)


@serves(ops.MASTERSHIP)
def mastership(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the holder of a domain."""
    _gone(app)
    domain = request.names["domain"]
    if domain not in app.masterships.domains:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    holder = app.masterships.holders.get(domain)
    mine = holder is request.session
    notify = {**_holder(holder), "mastershipheldbyme": "TRUE" if mine else "FALSE"}
    return show(Item("msh-resource", domain, notify))


def _holder(holder: Session | None) -> dict[str, str]:
    """Return the fields of a domain's holder."""
    return {
        "uid": str(holder.number if holder else 0),
        "application": holder.application if holder else "",
        "alias": (holder.alias or holder.user) if holder else "",
        "location": holder.location if holder else "",
        "mastership": "remote" if holder else "nomaster",
    }


@serves(ops.REQUEST, ops.REQUEST_ALL, ops.REQUEST_PLAIN)
def request(app: RwsApplication, asked: RwsRequest) -> None:
    """Take one domain, or all of them."""
    _gone(app)
    app.masterships.need_mode(asked.session)
    for domain in _named(app, asked):
        app.masterships.request(asked.session, domain)


@serves(ops.RELEASE, ops.RELEASE_ALL)
def release(app: RwsApplication, request: RwsRequest) -> None:
    """Release one domain, or all."""
    _gone(app)
    for domain in _named(app, request):
        app.masterships.release(request.session, domain)


@serves(ops.REQUEST_WITH_ID)
def request_with_id(app: RwsApplication, asked: RwsRequest) -> RwsResponse:
    """Take a domain; its number releases it from another session."""
    request(app, asked)
    domain = asked.names["domain"]
    return show(Item("msh-resource", domain, {"mastership-id": str(asked.session.number)}))


@serves(ops.RELEASE_WITH_ID)
def release_with_id(app: RwsApplication, request: RwsRequest) -> None:
    """Release a domain by the number of its holder."""
    _gone(app)
    number, domain = request.field("mastershipid"), request.names["domain"]
    holder = app.masterships.holders.get(domain)
    if holder is None or str(holder.number) != number:
        raise RequestDenied(403, "E_RESOURCE_NOT_HELD", f"mastership of {domain} is not held", -1)
    app.masterships.release(holder, domain)


@serves(ops.WATCHDOG)
def watchdog(app: RwsApplication, request: RwsRequest) -> None:
    """Keep the session alive, as every request does."""
    _gone(app)


def _named(app: RwsApplication, request: RwsRequest) -> tuple[str, ...]:
    domain = request.names.get("domain")
    return (domain,) if domain else app.masterships.domains


# -- RobotWare 8 ---------------------------------------------------------------------------------


@serves(ops.STATION_REGISTER)
def register_station(app: RwsApplication, request: RwsRequest) -> None:
    """Add the session to a control station; its id is in braces."""
    guid = request.field("control-station-id")
    if not _GUID.fullmatch(guid):
        raise RequestDenied(400, "E_INVALIDARG", "control-station-id", -20_103)
    request.field("pincode")
    app.masterships.stations[guid] = request.field("control-station-name")
    request.session.station = guid


@serves(ops.STATION_TYPE)
def station_type(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the type of this session's control station."""
    notify = {"control-station-type": "remote" if request.session.station else "none"}
    return show(Item("controlstation-type", "type", notify))


@serves(ops.STATION_ID)
def station_id(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the id of this session's control station."""
    return show(Item("control-station", "id", {"control-station-Id": request.session.station}))


@serves(ops.LOCAL_STATION)
def local_station(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether a pendant is connected: never here."""
    notify = {"local-control-station-isconnected": "false"}
    return show(Item("controlstation-local-isconnected", "isconnected", notify))


@serves(ops.WRITE_ACCESS)
def write_access(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the control station with write access."""
    masters = app.masterships
    notify = {
        "control-station-write-access-held": "true" if masters.station else "false",
        "held-by-control-station-Id": masters.station,
        "held-by-control-station-name": masters.stations.get(masters.station, ""),
        "control-station-external-control-enabled": "true",
    }
    return show(Item("controlstation-write-access-status", "status", notify))


@serves(ops.WRITE_REQUEST)
def request_write(app: RwsApplication, request: RwsRequest) -> None:
    """Take write access."""
    masters, station = app.masterships, request.session.station
    if not station:
        raise RequestDenied(403, "E_REJECT", "Session is not part of a Control Station", -20_107)
    if masters.station not in ("", station):
        raise RequestDenied(403, "E_WRITE_ACCESS_TAKEN", "write access is taken", -20_109)
    masters.station = station


@serves(ops.WRITE_RELEASE)
def release_write(app: RwsApplication, request: RwsRequest) -> None:
    """Release write access."""
    masters, station = app.masterships, request.session.station
    if not station or masters.station != station:
        raise RequestDenied(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
    masters.station = ""


@serves(ops.MOTION_ALLOWED)
def motion_allowed(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether a start may move a robot."""
    notify = {"is-enabled": "true" if app.masterships.motion_allowed else "false"}
    return show(Item("controstation-allow-motion-control", "allowmotioncontrol", notify))


@serves(ops.ALLOW_MOTION)
def allow_motion(app: RwsApplication, request: RwsRequest) -> None:
    """Permit a start to move a robot."""
    app.masterships.need(request, "motion")
    notify = request.field("allow-motion-control", ("true", "false"))
    app.masterships.motion_allowed = notify == "true"


@subscribable("/rw/mastership/(?P<domain>[^/]+)")
def mastership_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Holders of a domain."""
    masters, domain = app.masterships, topic.names["domain"]
    if domain not in masters.domains:
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {topic.text}")

    def item() -> Item:
        holder = masters.holders.get(domain)
        fields = {"holdmastership": "TRUE" if holder else "FALSE", **_holder(holder)}
        return Item("msh-resource-value", domain, fields, {"self": topic.text})

    return new_values(masters.changed, lambda: masters.holders.get(domain), item)
