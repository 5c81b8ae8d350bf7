"""Users, grants, remote writing in manual mode, logout."""

from typing import TYPE_CHECKING

from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.rmmp import Privilege
from rapidgen.servers.rws.routing import serves
from rapidgen.servers.rws.sessions import Session
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.codes import CODES, NAMES, name_of
from rapidgen.wire.rws.grants import GRANTS

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


@serves(ops.LOGOUT)
def logout(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """End the session and its masterships, except RobotWare 8's write access."""
    context.end_session(request.session)
    return show(title="logout")


@serves(ops.REGISTER_USER)
def register(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Register a name that others can read."""
    session = request.session
    session.alias = request.form.get("username", "")
    session.application = request.form.get("application", "")
    session.location = request.form.get("location", "")
    return RwsResponse(201)


@serves(ops.USERS)
def users(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the users logged in.

    One entry a session, in RWS 2.0 one a user [code: abb-rws-client]; the class is known to hold
    `user`, the rest is [mem].
    """
    sessions: dict[object, Session] = {}
    for session in context.sessions():
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
def set_locale(context: "RwsContext", request: RwsRequest) -> None:
    """Set the locale.

    Local users press the enabling device within 5 s; there are none here.
    """
    if request.field("type", ("local", "remote")) == "local":
        raise RequestDenied(403, "E_REJECT", "no enabling device is pressed", -2)


@serves(ops.IMPERSONATE)
def impersonate(context: "RwsContext", request: RwsRequest) -> None:
    """Act as another session's user, by its number."""
    number = request.field("uid")
    for other in context.sessions():
        if str(other.number) == number:
            if context.login.granted(other.user) - context.login.granted(request.session.user):
                raise RequestDenied(403, "E_UAS_REJECT", f"user {number} may do more", -757)
            request.session.user = other.user
            return
    raise RequestDenied(400, "E_INVALIDARG", f"no user {number}")


@serves(ops.ALL_GRANTS)
def all_grants(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return all grants."""
    names = ("grantname", "description")
    result = (Item("uas-grant", g, dict.fromkeys(names, g)) for g in sorted(GRANTS))
    return show(*result, collection=True)


@serves(ops.PASSWORD_CHANGE)
def password_change(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether this user may change the password: never here."""
    return show(Item("uas-password-change-allow", "allow", {"password-change-allow": "false"}))


@serves(ops.LOGIN_INFO)
def login_info(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the user logged in."""
    return show(Item("user-login-info", request.session.user, {"name": request.session.user}))


def _grants(context: "RwsContext", request: RwsRequest) -> list[str]:
    return sorted(context.login.granted(request.session.user))


@serves(ops.GRANTS)
def grants(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the grants of this user."""
    if request.is_one:
        return show(*(Item("user-grant", g) for g in _grants(context, request)), collection=True)
    result = (Item("uas-grant", g, {"grantname": g}) for g in _grants(context, request))
    return show(*result, collection=True)


@serves(ops.GRANT_EXISTS)
def grant_exists(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether this user has one grant."""
    requested = request.query.get("grant", "")
    notify = "true" if requested in _grants(context, request) else "false"
    return show(Item("user-grant-status", requested, {"status": notify}))


@serves(ops.RETCODE)
def retcode(context: "RwsContext", request: RwsRequest) -> RwsResponse:
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
def ask_rmmp(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Ask the pendant's user for the right to write in manual mode."""
    _no_rmmp_on_8(context)
    requested = request.field("privilege", ("modify", "exec"))
    privilege: Privilege = "exec" if requested == "exec" else "modify"
    if context.controller.mode != "auto" and not context.masters.manual.ask(
        request.session, privilege
    ):
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "another session asks for it, or has it", -4_502
        )
    return RwsResponse(202)


@serves(ops.CANCEL_RMMP)
def cancel_rmmp(context: "RwsContext", request: RwsRequest) -> None:
    """Cancel the request, or release the privilege."""
    _no_rmmp_on_8(context)
    context.masters.manual.cancel(request.session)


@serves(ops.RMMP)
def rmmp(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the holder of remote writing, or its applicant."""
    _no_rmmp_on_8(context)
    manual = context.masters.manual
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
def poll_rmmp(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the state of the request, which keeps the prompt open.

    In automatic mode no grant is needed. PENDING and GRANTED are ABB's words [code:
    abb_robot_client], those for a refusal are ours.
    """
    _no_rmmp_on_8(context)
    manual = context.masters.manual
    manual.keep(request.session)
    state = "GRANTED" if context.controller.mode == "auto" else manual.state(request.session)
    notify = {"code": str(CODES[_POLLED[state]]), "status": state}
    return show(Item("user-rmmp-poll", "poll", notify))


@serves(ops.GRANT_RMMP)
def grant_rmmp(context: "RwsContext", request: RwsRequest) -> None:
    """Refuse a local user's answer: no user is local here."""
    request.field("uid")
    request.field("privilege", ("modify", "exec", "deny"))
    raise RequestDenied(403, "E_REJECT", "only a local user grants", -2)


def _no_rmmp_on_8(context: "RwsContext") -> None:
    if context.generation is Generation.EIGHT:
        raise RequestDenied(500, "E_UNEXPECTED", "RMMP")
