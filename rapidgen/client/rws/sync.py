"""`Controller`: Robot Web Services on the caller's thread."""

import socket
import ssl
import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
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
    auth_of,
    no_verification,
    not_reached,
    pinned_tls,
    response_of,
    socket_options,
)

T = TypeVar("T")


class RwsSyncRunner:
    """Runner of flows on the caller's thread, one request at a time."""

    def __init__(self, core: RwsCore, timeout: float) -> None:
        self._core = core
        self._timeout = timeout
        self._lock = threading.RLock()
        self._pace = RateLimiter()
        self._client: httpx2.Client | None = None
        self._base = ""
        self._auth: httpx2.Auth | None = None

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
                self._auth = auth_of(effect, self._core)
            case DropConnections():
                self._forget()
        return Response(0)

    def _settle(self, effect: UseEndpoint) -> None:
        self.close()
        scheme = "https" if effect.certificate else "http"
        self._base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
        verify = pinned_tls(effect.certificate) if effect.certificate else True
        self._auth = None
        self._client = httpx2.Client(
            verify=verify, trust_env=False, timeout=self._timeout, follow_redirects=False
        )

    def _forget(self) -> None:
        if self._client is not None:
            self._client.cookies.clear()

    def _exchange(self, effect: Exchange) -> Response:
        assert self._client is not None
        time.sleep(self._pace.reserve(time.monotonic()))
        for left in (1, 0):
            try:
                answer = self._client.request(
                    effect.method,
                    self._base + effect.target,
                    headers=dict(effect.headers),
                    content=effect.body or None,
                    auth=self._auth,
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
        assert self._client is not None
        try:
            return stack.enter_context(
                connect_socket(
                    self._base.replace("http", "ws", 1) + path,
                    **socket_options(self._core, self._client.cookies, threads=True),
                    open_timeout=self._timeout,
                )
            )
        except (OSError, WebSocketException) as error:
            raise not_reached(self._core, error, self._timeout) from error

    def close(self) -> None:
        """Close all connections."""
        if self._client is not None:
            self._client.close()
            self._client = None


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
        self._open(subscriptions.subscribe(core, chosen))

    def _open(self, flow: Flow[subscriptions.SubscriptionGroup]) -> None:
        opened = self._carrier.run(flow)
        self._group = opened.group
        self._waiting.extend(opened.events)
        self._stack.close()
        self._socket = self._carrier.open_socket(opened.path, self._stack)

    def next(self, timeout: float | None = None) -> ResourceEvent:
        """Return the next event. Raises RobotTimeout (RG602)."""
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
