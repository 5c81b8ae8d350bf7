"""Users, grants, remote writing in manual mode; the end of a session."""

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
def logout(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """End the session; what it held is free, but RobotWare 8's write access."""
    office.end_session(asked.session)
    return show(title="logout")


@serves(ops.REGISTER_USER)
def register(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Say who it is, for others to read."""
    session = asked.session
    session.alias = asked.form.get("username", "")
    session.application = asked.form.get("application", "")
    session.location = asked.form.get("location", "")
    return RwsResponse(201)


@serves(ops.USERS)
def users(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Who is logged in: one entry a session, in RWS 2.0 one a user [code: abb-rws-client]; of the
    class it is known that `user` is in it, the rest is [mem]."""
    sessions: dict[object, Session] = {}
    for session in office.sessions():
        sessions.setdefault(session.number if asked.is_one else session.user, session)
    found = [
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
    return show(*found, collection=True)


@serves(ops.SET_LOCALE)
def set_locale(office: "RwsContext", asked: RwsRequest) -> None:
    """Local users press the enabling device within 5 s, which nobody does here."""
    if asked.field("type", ("local", "remote")) == "local":
        raise RequestDenied(403, "E_REJECT", "no enabling device is pressed", -2)


@serves(ops.IMPERSONATE)
def impersonate(office: "RwsContext", asked: RwsRequest) -> None:
    """Act as another session's user, by its number."""
    number = asked.field("uid")
    for other in office.sessions():
        if str(other.number) == number:
            if office.login.granted(other.user) - office.login.granted(asked.session.user):
                raise RequestDenied(403, "E_UAS_REJECT", f"user {number} may do more", -757)
            asked.session.user = other.user
            return
    raise RequestDenied(400, "E_INVALIDARG", f"no user {number}")


@serves(ops.ALL_GRANTS)
def all_grants(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """All grants that there are."""
    names = ("grantname", "description")
    found = (Item("uas-grant", g, dict.fromkeys(names, g)) for g in sorted(GRANTS))
    return show(*found, collection=True)


@serves(ops.PASSWORD_CHANGE)
def password_change(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether this user may change the password: nobody may, here."""
    return show(Item("uas-password-change-allow", "allow", {"password-change-allow": "false"}))


@serves(ops.LOGIN_INFO)
def login_info(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Who is logged in."""
    return show(Item("user-login-info", asked.session.user, {"name": asked.session.user}))


def _grants(office: "RwsContext", asked: RwsRequest) -> list[str]:
    return sorted(office.login.granted(asked.session.user))


@serves(ops.GRANTS)
def grants(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What this user may do."""
    if asked.is_one:
        return show(*(Item("user-grant", g) for g in _grants(office, asked)), collection=True)
    found = (Item("uas-grant", g, {"grantname": g}) for g in _grants(office, asked))
    return show(*found, collection=True)


@serves(ops.GRANT_EXISTS)
def grant_exists(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether this user may do one thing."""
    wanted = asked.query.get("grant", "")
    told = "true" if wanted in _grants(office, asked) else "false"
    return show(Item("user-grant-status", wanted, {"status": told}))


@serves(ops.RETCODE)
def retcode(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """What a code means; without one, all of them."""
    if "code" not in asked.query:
        found = [
            Item("err-desc", str(code), {"name": name, "code": str(code)})
            for code, name in NAMES.items()
        ]
        return show(*found, collection=True)
    try:
        code = int(asked.query.get("code", ""))
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", "code") from error
    name = name_of(code)
    severity = "Error" if code < 0 else "Success"
    told = {"name": name, "code": str(code), "severity": severity, "description": name}
    return show(Item("err-desc", str(code), told))


# -- RMMP: remote writing in manual mode ----------------------------------------------------------


@serves(ops.ASK_RMMP)
def ask_rmmp(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Ask the pendant's user for the right to write in manual mode."""
    _no_rmmp_on_8(office)
    wanted = asked.field("privilege", ("modify", "exec"))
    privilege: Privilege = "exec" if wanted == "exec" else "modify"
    if office.controller.mode != "auto" and not office.masters.manual.ask(asked.session, privilege):
        raise RequestDenied(
            403, "E_RESOURCE_HELD", "another session asks for it, or has it", -4_502
        )
    return RwsResponse(202)


@serves(ops.CANCEL_RMMP)
def cancel_rmmp(office: "RwsContext", asked: RwsRequest) -> None:
    """Ask no more, or give it back."""
    _no_rmmp_on_8(office)
    office.masters.manual.cancel(asked.session)


@serves(ops.RMMP)
def rmmp(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
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
def poll_rmmp(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Whether it was granted; keeps the question on the pendant. In automatic mode it need not be.

    PENDING and GRANTED are ABB's words [code: abb_robot_client], those for a refusal are ours.
    """
    _no_rmmp_on_8(office)
    manual = office.masters.manual
    manual.keep(asked.session)
    state = "GRANTED" if office.controller.mode == "auto" else manual.state(asked.session)
    told = {"code": str(CODES[_POLLED[state]]), "status": state}
    return show(Item("user-rmmp-poll", "poll", told))


@serves(ops.GRANT_RMMP)
def grant_rmmp(office: "RwsContext", asked: RwsRequest) -> None:
    """A local user's answer to a request: nobody is local here."""
    asked.field("uid")
    asked.field("privilege", ("modify", "exec", "deny"))
    raise RequestDenied(403, "E_REJECT", "only a local user grants", -2)


def _no_rmmp_on_8(office: "RwsContext") -> None:
    if office.generation is Generation.EIGHT:
        raise RequestDenied(500, "E_UNEXPECTED", "RMMP")
