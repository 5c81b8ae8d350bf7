"""Settings of the HTTP library: TLS, logins, failures.

httpx2's digest is right where others' are not: blanks in users, `;value` and `$` in paths. The
environment's proxies are ignored, redirects are not followed.
"""

import ssl
from typing import TypedDict

import httpx2
from websockets.typing import Subprotocol

from rapidgen.client.errors import ConnectionFailed, ConnectionLost, RobotError
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import LogIn, Response
from rapidgen.wire.rws import media
from rapidgen.wire.rws.events import PROTOCOLS
from rapidgen.wire.rws.xhtml import LARGEST

LOGOUT = "/logout"
LOGOUT_HEADERS = {"Accept": media.HAL}
LOGOUT_TIMEOUT = 2.0
"""s for which a dropped client waits for the end of its session."""
_NO_CHECK_TIME = 0x200000
"""X509_V_FLAG_NO_CHECK_TIME: a confirmed certificate may have expired."""


def pinned_tls(certificate: bytes) -> ssl.SSLContext:
    """TLS that accepts this certificate (DER) and no other."""
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_flags |= ssl.VERIFY_X509_PARTIAL_CHAIN | ssl.VerifyFlags(_NO_CHECK_TIME)
    context.load_verify_locations(cadata=certificate)
    return context


def no_verification() -> ssl.SSLContext:
    """TLS context to read a certificate; no data is sent over it."""
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context


def auth_of(effect: LogIn, core: RwsCore) -> httpx2.Auth:
    """Return the login object of the requested type."""
    if effect.way == "digest":
        return httpx2.DigestAuth(core.user, core.login.password)
    assert core.certificate, "a password in clear is sent over TLS only"
    return httpx2.BasicAuth(core.user, core.login.password)


class SocketOptions(TypedDict):
    """Options of a websocket."""

    subprotocols: list[Subprotocol]
    additional_headers: dict[str, str]
    ssl: ssl.SSLContext | None
    proxy: None
    ping_interval: None
    max_size: int


def socket_options(
    core: RwsCore, cookies: httpx2.Cookies, *, threads: bool = False
) -> SocketOptions:
    """Return options of a websocket of the session with these cookies.

    Proxies and pings are off. `threads`: one thread reads while another writes. The tickets that
    TLS 1.3 sends after its handshake need a read, during which a concurrent write can be lost and
    the connection hangs, about once in a thousand: TLS 1.2 has no tickets.
    """
    context = pinned_tls(core.certificate) if core.certificate else None
    if context is not None and threads:
        context.maximum_version = ssl.TLSVersion.TLSv1_2
    return SocketOptions(
        subprotocols=[Subprotocol(PROTOCOLS[core.generation])],
        additional_headers={"Cookie": "; ".join(f"{k}={v}" for k, v in cookies.items())},
        ssl=context,
        proxy=None,
        ping_interval=None,
        max_size=LARGEST,
    )


def forked() -> ConnectionLost:
    """Return the error of a subscription in a process that was forked from its owner's."""
    return ConnectionLost.because(
        "RG602",
        "the subscription belongs to the process from which this one was forked",
        "subscribe in this process",
    )


def response_of(answer: httpx2.Response) -> Response:
    """Return an httpx response as data."""
    headers = {name.lower(): value for name, value in answer.headers.items()}
    return Response(answer.status_code, headers, answer.content)


def not_reached(core: RwsCore, error: Exception, timeout: float) -> RobotError:
    """Return the error of a failed or lost connection."""
    if isinstance(error, (httpx2.TimeoutException, TimeoutError)):
        message = f"no answer from {core.where} within {timeout:g} s"
    else:
        message = f"cannot reach {core.where}: {str(error).lower() or type(error).__name__}"
    kind = ConnectionLost if core.connected else ConnectionFailed
    return kind.because(
        "RG601", message, "is the controller on, and are web services on in its firewall settings?"
    )
