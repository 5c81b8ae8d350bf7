"""`Controller`: Robot Web Services on the caller's thread."""

import os
import socket
import ssl
import threading
import time
import weakref
from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from typing import TypeVar

import httpx2
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.sync.client import ClientConnection
from websockets.sync.client import connect as connect_socket

from rapidgen._compat import Self
from rapidgen.client.errors import ConnectionLost, RobotTimeout
from rapidgen.client.rws.api import RESTART_TIMEOUT, ControllerApi
from rapidgen.client.rws.core import RateLimiter, RwsCore
from rapidgen.client.rws.effects import (
    DropConnections,
    Effect,
    Exchange,
    FetchCertificate,
    Flow,
    LogIn,
    Pause,
    Response,
    UseEndpoint,
    resume,
)
from rapidgen.client.rws.errors import Busy
from rapidgen.client.rws.flows import connect as connecting
from rapidgen.client.rws.flows import mastership as holding
from rapidgen.client.rws.flows import subscriptions
from rapidgen.client.rws.model import ResourceEvent
from rapidgen.client.rws.topics import Topic
from rapidgen.client.rws.transport import (
    LOGOUT,
    LOGOUT_HEADERS,
    LOGOUT_TIMEOUT,
    auth_of,
    forked,
    no_verification,
    not_reached,
    pinned_tls,
    response_of,
    socket_options,
)
from rapidgen.client.unclosed import drop_in_child, warn_unclosed

T = TypeVar("T")


@dataclass(slots=True, eq=False)
class _Session:
    """Session at a controller, apart from the runner that its user may drop."""

    where: str
    client: httpx2.Client | None = None
    base: str = ""
    auth: httpx2.Auth | None = None

    def close_dropped(self) -> None:
        """Log out without waiting, with a warning: a session keeps its mastership for 5 min."""
        client, self.client = self.client, None
        if client is None:
            return
        if threading.main_thread().is_alive():
            name = f"rapidgen logout {self.where}"
            threading.Thread(target=self._log_out, args=(client,), name=name, daemon=True).start()
        else:
            # No thread starts while the interpreter ends.
            self._log_out(client)
        warn_unclosed(self.where)

    def _log_out(self, client: httpx2.Client) -> None:
        url = self.base + LOGOUT
        with suppress(httpx2.HTTPError):
            client.get(url, headers=LOGOUT_HEADERS, auth=self.auth, timeout=LOGOUT_TIMEOUT)
        client.close()


class RwsSyncRunner:
    """Runner of flows on the caller's thread, one request at a time."""

    def __init__(self, core: RwsCore, timeout: float) -> None:
        self._core = core
        self._timeout = timeout
        self._lock = threading.RLock()
        self._pace = RateLimiter()
        self._session = _Session(str(core.address))
        weakref.finalize(self, self._session.close_dropped)
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the session in a forked process; it stays the parent's."""
        # A thread that the child does not have may hold the old locks.
        self._lock = threading.RLock()
        self._session.client = None
        self._core.forked()

    def run(self, flow: Flow[T]) -> T:
        """Return the outcome of a flow.

        An exception of an effect is thrown into it.
        """
        with self._lock:
            try:
                return self._carry_out(flow)
            finally:
                if not self._core.connected:
                    self.close()

    def _carry_out(self, flow: Flow[T]) -> T:
        outcome: Response | None = None
        failure: BaseException | None = None
        while True:
            try:
                effect = resume(flow, outcome, failure)
            except StopIteration as end:
                value: T = end.value
                return value
            outcome, failure = Response(0), None
            try:
                outcome = self._perform(effect)
            except BaseException as raised:  # noqa: BLE001 - the flow cleans up and raises it
                failure = raised

    def _perform(self, effect: Effect) -> Response:
        match effect:
            case Exchange():
                return self._exchange(effect)
            case Pause():
                time.sleep(effect.seconds)
            case FetchCertificate():
                return self._look(effect.port)
            case UseEndpoint():
                self._settle(effect)
            case LogIn():
                self._session.auth = auth_of(effect, self._core)
            case DropConnections():
                self._forget()
        return Response(0)

    def _settle(self, effect: UseEndpoint) -> None:
        self.close()
        scheme = "https" if effect.certificate else "http"
        self._session.base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
        verify = pinned_tls(effect.certificate) if effect.certificate else True
        self._session.auth = None
        self._session.client = httpx2.Client(
            verify=verify, trust_env=False, timeout=self._timeout, follow_redirects=False
        )

    def _forget(self) -> None:
        if self._session.client is not None:
            self._session.client.cookies.clear()

    def _exchange(self, effect: Exchange) -> Response:
        session = self._session
        assert session.client is not None
        time.sleep(self._pace.reserve(time.monotonic()))
        for left in (1, 0):
            try:
                answer = session.client.request(
                    effect.method,
                    session.base + effect.target,
                    headers=dict(effect.headers),
                    content=effect.body or None,
                    auth=session.auth,
                )
            except httpx2.HTTPError as error:
                if left and effect.repeat and not isinstance(error, httpx2.TimeoutException):
                    continue
                raise not_reached(self._core, error, self._timeout) from error
            return response_of(answer)
        raise AssertionError

    def _look(self, port: int) -> Response:
        try:
            with socket.create_connection((self._core.address.host, port), self._timeout) as raw:
                try:
                    with no_verification().wrap_socket(raw) as tls:
                        return Response(200, body=tls.getpeercert(True) or b"")
                except (ssl.SSLError, ConnectionResetError):
                    return Response(0)
        except OSError as error:
            raise not_reached(self._core, error, self._timeout) from error

    def open_socket(self, path: str, stack: ExitStack) -> ClientConnection:
        """Open a websocket of this session, closed with the stack.

        Pings are off: RWS 2.0 disconnects a client that sends.
        """
        session = self._session
        assert session.client is not None
        try:
            return stack.enter_context(
                connect_socket(
                    session.base.replace("http", "ws", 1) + path,
                    **socket_options(self._core, session.client.cookies, threads=True),
                    open_timeout=self._timeout,
                )
            )
        except (OSError, WebSocketException) as error:
            raise not_reached(self._core, error, self._timeout) from error

    def close(self) -> None:
        """Close all connections."""
        if self._session.client is not None:
            self._session.client.close()
            self._session.client = None


class Subscription:
    """Events of topics, the current values first.

    Survives a restart of the controller. `with controller.subscribe(topics.execution()) as events:
    for event in events: ...`
    """

    def __init__(self, carrier: RwsSyncRunner, core: RwsCore, chosen: tuple[Topic, ...]) -> None:
        self._carrier = carrier
        self._core = core
        self._topics = chosen
        self._waiting: deque[ResourceEvent] = deque()
        self._socket: ClientConnection | None = None
        self._group = ""
        self._stack = ExitStack()
        self._process = os.getpid()
        self._sockets: list[ClientConnection] = []
        """The open websocket, for the finalizer; its thread holds it, too."""
        weakref.finalize(self, _close_dropped, str(core.address), self._sockets)
        self._open(subscriptions.subscribe(core, chosen))

    def _open(self, flow: Flow[subscriptions.SubscriptionGroup]) -> None:
        opened = self._carrier.run(flow)
        self._group = opened.group
        self._waiting.extend(opened.events)
        self._stack.close()
        self._socket = self._carrier.open_socket(opened.path, self._stack)
        self._sockets[:] = [self._socket]

    def next(self, timeout: float | None = None) -> ResourceEvent:
        """Return the next event. Raises RobotTimeout (RG602)."""
        if os.getpid() != self._process:
            raise forked()
        until = None if timeout is None else time.monotonic() + timeout
        while not self._waiting:
            left = None if until is None else until - time.monotonic()
            assert self._socket is not None
            try:
                message = self._socket.recv(left)
            except TimeoutError as error:
                raise RobotTimeout.because("RG602", f"no event within {timeout:g} s") from error
            except (ConnectionClosed, OSError):
                self._again()
                continue
            data = message.encode() if isinstance(message, str) else message
            self._waiting.extend(
                self._carrier.run(subscriptions.events_of(self._core, self._topics, data))
            )
        return self._waiting.popleft()

    def _again(self) -> None:
        """Reopen the websocket until the restarted controller keeps it open."""
        until = time.monotonic() + RESTART_TIMEOUT
        while True:
            try:
                return self._open(subscriptions.again(self._core, self._topics, RESTART_TIMEOUT))
            except (ConnectionLost, Busy):
                if time.monotonic() >= until:
                    raise
                self._carrier.run(subscriptions.unsubscribe(self._core, self._group))

    def close(self) -> None:
        """End the subscription."""
        self._sockets.clear()
        if os.getpid() != self._process:
            # The websocket is the parent's.
            self._socket = None
        if self._socket is not None:
            self._carrier.run(subscriptions.unsubscribe(self._core, self._group))
            self._stack.close()
            self._socket = None

    def __iter__(self) -> Iterator[ResourceEvent]:
        while self._socket is not None:
            yield self.next()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _close_dropped(where: str, sockets: list[ClientConnection]) -> None:
    for each in sockets:
        # The thread of the websocket ends; a closing handshake would wait for the controller.
        with suppress(OSError):
            each.socket.shutdown(socket.SHUT_RDWR)
        warn_unclosed(where)


class Controller(ControllerApi[RwsSyncRunner]):
    """A controller over Robot Web Services.

    `address` is `rws://HOST[:PORT]`, `rwss://HOST[:PORT]` or a bare host; the client detects the
    generation. It connects at the first call; `close()` or the end of a `with` block releases
    mastership and logs out. An unknown certificate is shown to `confirm(where, fingerprint)`, or
    must be `fingerprint`. All methods may be called from any thread.
    """

    _carrier_type = RwsSyncRunner

    def connect(self) -> Self:
        """Connect and log in.

        Raises ConnectionFailed, LoginFailed (RG651, RG652), NotRws (RG653).
        """
        self._carrier.run(connecting.connect(self._core))
        return self

    def close(self) -> None:
        """Release mastership, log out, and close."""
        self._carrier.run(connecting.close(self._core))
        self._carrier.close()

    @contextmanager
    def mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> Iterator[Self]:
        """Hold mastership of `rapid`, `cfg` or `motion` for a block.

        Raises Held (RG654).
        """
        self.take_mastership(domain, wait=wait)
        try:
            yield self
        finally:
            self._carrier.run(holding.give(self._core, domain))

    def subscribe(self, *topics: Topic) -> Subscription:
        """Subscribe to topics: an iterator of events.

        Topics are made by `rapidgen.client.rws.topics`. At most 64 signals and persistents; a
        second subscription is the last one of a session.
        """
        return Subscription(self._carrier, self._core, topics)

    def __enter__(self) -> Self:
        return self.connect()

    def __exit__(self, *_: object) -> None:
        self.close()
