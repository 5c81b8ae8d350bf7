"""Connection flows: identify, trust, log in, and close."""

import hashlib
import socket

from rapidgen.client.errors import ConnectionFailed, RobotError
from rapidgen.client.rws import known_certificates
from rapidgen.client.rws.core import APPLICATION, RwsCore
from rapidgen.client.rws.effects import (
    DropConnections,
    Exchange,
    FetchCertificate,
    Flow,
    LogIn,
    Response,
    T,
    UseEndpoint,
)
from rapidgen.client.rws.errors import Busy, LoginFailed, NotRws
from rapidgen.client.rws.flows.request import ask
from rapidgen.wire.rws import media
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, whole

_FIRST = "/rw/system"


def connect(core: RwsCore) -> Flow[None]:
    """Identify the controller and log in; a second call does nothing."""
    if core.connected:
        return
    core.check_login()
    challenge = yield from _reach(core)
    if challenge.startswith("digest"):
        core.generation = Generation.ONE
        yield LogIn("digest")
    elif challenge.startswith("basic"):
        if not core.certificate:
            raise LoginFailed.because(
                "RG651",
                f"{core.where} requests the password in clear over plain HTTP",
                "Robot Web Services 2.0 use TLS: use rwss://, and check which server answers there",
            )
        core.generation = Generation.TWO
        yield LogIn("basic")
    else:
        raise _no_rws(core)
    body, _ = yield from ask(core, ops.SYSTEM)
    item = body.first("sys-system") or body.first("sys-system-li")
    if item is None:
        raise _no_rws(core)
    core.robotware, core.system = item.text("rwversion"), item.text("name")
    if core.generation is Generation.TWO and whole(core.robotware.partition(".")[0]) >= 8:
        core.generation = Generation.EIGHT
    core.connected = True
    core.tell(f"logged in as {core.user}: '{core.system}', RobotWare {core.robotware}")
    yield from ask(
        core,
        ops.REGISTER_USER,
        form={
            "username": core.user,
            "application": APPLICATION,
            "location": socket.gethostname(),
            "ulocale": "remote",
        },
        accepted=(400, 403, 404, 405, 409),
    )


def connected(core: RwsCore, flow: Flow[T]) -> Flow[T]:
    """Run a flow on a connected controller."""
    yield from connect(core)
    return (yield from flow)


def _reach(core: RwsCore) -> Flow[str]:
    """Choose TLS, or plain HTTP if the port does not speak TLS.

    Returns the type of login.
    """
    address = core.address
    core.port = address.port or 443
    plain: ConnectionFailed | None = None
    try:
        seen = yield FetchCertificate(core.port)
    except ConnectionFailed as failed:
        if address.tls_only or address.port:
            raise
        seen, plain = Response(0), failed
    if seen.status:
        yield from _trust(core, seen.body)
        yield UseEndpoint(core.port, seen.body)
    else:
        trusted = core.fingerprint or known_certificates.known(core.pins, core.where)
        if address.tls_only or trusted:
            raise LoginFailed.because(
                "RG652",
                f"{core.where} does not speak TLS",
                "this controller was met with a certificate before: who answers there now?"
                if trusted
                else "use rws:// for a controller with RobotWare 6",
            )
        core.port = address.port or 80
        yield UseEndpoint(core.port)
    headers = {"Accept": media.HAL} if seen.status else {}
    try:
        answer = yield Exchange("GET", _FIRST, headers, repeat=True)
    except ConnectionFailed as failed:
        raise (plain or failed) from failed
    if answer.status == 503:  # it restarts, or has no session left
        raise Busy.because("RG656", f"{core.where} is busy: it answers 503", "try again soon")
    if answer.status != 401:
        raise _no_rws(core)
    return answer.headers.get("www-authenticate", "").lower()


def _trust(core: RwsCore, certificate: bytes) -> Flow[None]:
    """Check the certificate before a password is sent."""
    fingerprint = hashlib.sha256(certificate).hexdigest()
    requested = known_certificates.plain(core.fingerprint) or known_certificates.known(
        core.pins, core.where
    )
    core.certificate = certificate
    if requested == fingerprint:
        if core.fingerprint:
            known_certificates.remember(core.pins, core.where, fingerprint)
        return
    if requested:
        raise LoginFailed.because(
            "RG652",
            f"the certificate of {core.where} is another one than before",
            "was the controller installed anew, or does another machine answer? If it is right, "
            f"add --fingerprint {fingerprint}",
            f"known: {known_certificates.shown(requested)}",
            f"there: {known_certificates.shown(fingerprint)}",
        )
    if core.confirm is None or not core.confirm(core.where, known_certificates.shown(fingerprint)):
        raise LoginFailed.because(
            "RG652",
            f"the certificate of {core.where} is not confirmed; no password was sent",
            "compare it with the controller's and add `--fingerprint ...` (`fingerprint=`)",
            f"there: {known_certificates.shown(fingerprint)}",
        )
    known_certificates.remember(core.pins, core.where, fingerprint)
    yield from ()


def _no_rws(core: RwsCore) -> NotRws:
    return NotRws.because(
        "RG653",
        f"{core.where} answers, and does not speak Robot Web Services",
        "is this the controller's own port, and are web services on in its firewall settings?",
    )


def close(core: RwsCore) -> Flow[None]:
    """Release mastership, log out, and close; harmless if nothing is open."""
    if core.connected:
        try:
            if core.generation is Generation.EIGHT and core.held:
                yield from ask(core, ops.WRITE_RELEASE, accepted=(403,))
            yield from ask(core, ops.LOGOUT)
        except RobotError:
            pass  # the session has ended already, and with it its mastership
    core.held.clear()
    core.connected = False
    yield DropConnections()
