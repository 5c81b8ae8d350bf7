"""Settings of the HTTP library: TLS, logins, failures.

httpx2's digest is right where others' are not: blanks in users, `;value` and `$` in paths. The
environment's proxies are ignored, redirects are not followed.
"""

import ssl
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypedDict, TypeVar

import httpx2
from websockets.typing import Subprotocol

from rapidgen.client.errors import ConnectionFailed, ConnectionLost, RobotError
from rapidgen.client.rws.core import RateLimiter, RwsCore
from rapidgen.client.rws.effects import Exchange, LogIn, Response, UseEndpoint
from rapidgen.client.unclosed import drop_in_child
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


class RequestOptions(TypedDict):
    """Arguments of a request."""

    method: str
    url: str
    headers: dict[str, str]
    content: bytes | None
    auth: httpx2.Auth | None


Http = TypeVar("Http", httpx2.Client, httpx2.AsyncClient)


@dataclass(slots=True, eq=False)
class Session(Generic[Http]):
    """Session at a controller, apart from the runner that its user may drop."""

    where: str
    client: Http | None = None
    base: str = ""
    auth: httpx2.Auth | None = None


class RwsRunner(Generic[Http]):
    """What both runners of flows share: the session, and its pace of requests."""

    def __init__(self, core: RwsCore, timeout: float, session: Session[Http]) -> None:
        self._core = core
        self._timeout = timeout
        self._limiter = RateLimiter()
        self._session: Session[Http] = session
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the session in a forked process; it stays the parent's."""
        self._session.client = None
        self._core.forked()

    def _use(self, effect: UseEndpoint, make_client: Callable[..., Http]) -> None:
        session = self._session
        scheme = "https" if effect.certificate else "http"
        session.base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
        session.auth = None
        session.client = make_client(
            verify=pinned_tls(effect.certificate) if effect.certificate else True,
            trust_env=False,
            timeout=self._timeout,
            follow_redirects=False,
        )

    def _drop_cookies(self) -> None:
        if self._session.client is not None:
            self._session.client.cookies.clear()

    def _request(self, effect: Exchange) -> RequestOptions:
        return RequestOptions(
            method=effect.method,
            url=self._session.base + effect.target,
            headers=dict(effect.headers),
            content=effect.body or None,
            auth=self._session.auth,
        )

    def _websocket(self, path: str, *, threads: bool = False) -> tuple[str, "SocketOptions"]:
        """Return address and options of a websocket of this session."""
        assert self._session.client is not None
        address = self._session.base.replace("http", "ws", 1) + path
        return address, socket_options(self._core, self._session.client.cookies, threads=threads)


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
