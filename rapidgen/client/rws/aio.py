"""`AsyncController`: the controller client for asyncio."""

import asyncio
import os
import ssl
import time
import weakref
from collections import deque
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from dataclasses import dataclass
from typing import TypeVar

import httpx2
from websockets.asyncio.client import ClientConnection
from websockets.asyncio.client import connect as connect_socket
from websockets.exceptions import ConnectionClosed, WebSocketException

from rapidgen._compat import Self
from rapidgen.client import deadline
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
_LOGOUTS: set[asyncio.Task[None]] = set()
"""Logouts of dropped clients: a loop holds its tasks weakly."""


@dataclass(slots=True, eq=False)
class _Session:
    """Session at a controller, apart from the runner that its user may drop."""

    where: str
    loop: asyncio.AbstractEventLoop | None = None
    """The loop of the last call."""
    client: httpx2.AsyncClient | None = None
    base: str = ""
    auth: httpx2.Auth | None = None

    def close_dropped(self) -> None:
        """Log out on the loop, with a warning: a session keeps its mastership for 5 min."""
        client, self.client = self.client, None
        if client is None or self.loop is None:
            return
        # A closed loop sends nothing; asyncio closes its sockets.
        with suppress(RuntimeError):
            self.loop.call_soon_threadsafe(self._begin_logout, client)
        warn_unclosed(self.where)

    def _begin_logout(self, client: httpx2.AsyncClient) -> None:
        assert self.loop is not None
        task = self.loop.create_task(self._log_out(client))
        _LOGOUTS.add(task)
        task.add_done_callback(_LOGOUTS.discard)

    async def _log_out(self, client: httpx2.AsyncClient) -> None:
        url = self.base + LOGOUT
        with suppress(httpx2.HTTPError):
            await client.get(url, headers=LOGOUT_HEADERS, auth=self.auth, timeout=LOGOUT_TIMEOUT)
        await client.aclose()


class RwsAsyncRunner:
    """Runner of flows on the caller's loop, one after another."""

    def __init__(self, core: RwsCore, timeout: float) -> None:
        self._core = core
        self._timeout = timeout
        self._lock = asyncio.Lock()
        self._pace = RateLimiter()
        self._session = _Session(str(core.address))
        weakref.finalize(self, self._session.close_dropped)
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the session in a forked process; it stays the parent's."""
        self._lock = asyncio.Lock()
        self._session.client = None
        self._core.forked()

    async def run(self, flow: Flow[T]) -> T:
        """Return the outcome of a flow.

        An exception of an effect is thrown into it.
        """
        self._session.loop = asyncio.get_running_loop()
        async with self._lock:
            try:
                return await self._carry_out(flow)
            finally:
                if not self._core.connected:
                    await self.close()

    async def _carry_out(self, flow: Flow[T]) -> T:
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
                outcome = await self._perform(effect)
            except BaseException as raised:  # noqa: BLE001 - the flow cleans up and raises it
                failure = raised

    async def _perform(self, effect: Effect) -> Response:
        match effect:
            case Exchange():
                return await self._exchange(effect)
            case Pause():
                await asyncio.sleep(effect.seconds)
            case FetchCertificate():
                return await self._look(effect.port)
            case UseEndpoint():
                await self.close()
                scheme = "https" if effect.certificate else "http"
                self._session.base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
                verify = pinned_tls(effect.certificate) if effect.certificate else True
                self._session.auth = None
                self._session.client = httpx2.AsyncClient(
                    verify=verify, trust_env=False, timeout=self._timeout, follow_redirects=False
                )
            case LogIn():
                self._session.auth = auth_of(effect, self._core)
            case DropConnections():
                if self._session.client is not None:
                    self._session.client.cookies.clear()
        return Response(0)

    async def _exchange(self, effect: Exchange) -> Response:
        session = self._session
        assert session.client is not None
        await asyncio.sleep(self._pace.reserve(time.monotonic()))
        for left in (1, 0):
            try:
                answer = await session.client.request(
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

    async def _look(self, port: int) -> Response:
        try:
            async with deadline.timeout(self._timeout):
                _, writer = await asyncio.open_connection(
                    self._core.address.host, port, ssl=no_verification()
                )
        except (ssl.SSLError, ConnectionResetError):
            return Response(0)
        except OSError as error:
            raise not_reached(self._core, error, self._timeout) from error
        try:
            return Response(200, body=writer.get_extra_info("ssl_object").getpeercert(True))
        finally:
            writer.close()

    async def open_socket(self, path: str, stack: AsyncExitStack) -> ClientConnection:
        """Open a websocket of this session, closed with the stack.

        Pings are off: RWS 2.0 disconnects a client that sends.
        """
        session = self._session
        assert session.client is not None
        try:
            return await stack.enter_async_context(
                connect_socket(
                    session.base.replace("http", "ws", 1) + path,
                    **socket_options(self._core, session.client.cookies),
                    open_timeout=self._timeout,
                )
            )
        except (OSError, WebSocketException) as error:
            raise not_reached(self._core, error, self._timeout) from error

    async def close(self) -> None:
        """Close all connections."""
        if self._session.client is not None:
            await self._session.client.aclose()
            self._session.client = None


class AsyncSubscription:
    """Events of topics, the current values first.

    Survives a restart of the controller. `async with controller.subscribe(topics.execution()) as
    events: async for event in events: ...`
    """

    def __init__(self, carrier: RwsAsyncRunner, core: RwsCore, chosen: tuple[Topic, ...]) -> None:
        self._carrier = carrier
        self._core = core
        self._topics = chosen
        self._waiting: deque[ResourceEvent] = deque()
        self._socket: ClientConnection | None = None
        self._group = ""
        self._stack = AsyncExitStack()
        self._process = os.getpid()

    async def _open(self, flow: Flow[subscriptions.SubscriptionGroup]) -> None:
        opened = await self._carrier.run(flow)
        self._group = opened.group
        self._waiting.extend(opened.events)
        await self._stack.aclose()
        self._socket = await self._carrier.open_socket(opened.path, self._stack)

    async def next(self, timeout: float | None = None) -> ResourceEvent:
        """Return the next event. Raises RobotTimeout (RG602)."""
        if os.getpid() != self._process:
            raise forked()
        try:
            async with deadline.timeout(timeout):
                while not self._waiting:
                    await self._hear()
        except TimeoutError as error:
            raise RobotTimeout.because("RG602", f"no event within {timeout:g} s") from error
        return self._waiting.popleft()

    async def _hear(self) -> None:
        assert self._socket is not None
        try:
            message = await self._socket.recv()
        except (ConnectionClosed, ConnectionError):
            await self._again()
            return
        data = message.encode() if isinstance(message, str) else message
        self._waiting.extend(
            await self._carrier.run(subscriptions.events_of(self._core, self._topics, data))
        )

    async def _again(self) -> None:
        """Reopen the websocket until the restarted controller keeps it open."""
        until = time.monotonic() + RESTART_TIMEOUT
        while True:
            try:
                return await self._open(
                    subscriptions.again(self._core, self._topics, RESTART_TIMEOUT)
                )
            except (ConnectionLost, Busy):
                if time.monotonic() >= until:
                    raise
                await self._carrier.run(subscriptions.unsubscribe(self._core, self._group))

    async def close(self) -> None:
        """End the subscription."""
        if os.getpid() != self._process:
            # The websocket is the parent's.
            self._socket = None
        if self._socket is not None:
            await self._carrier.run(subscriptions.unsubscribe(self._core, self._group))
            await self._stack.aclose()
            self._socket = None

    async def __aiter__(self) -> AsyncIterator[ResourceEvent]:
        while self._socket is not None:
            yield await self.next()

    async def __aenter__(self) -> Self:
        await self._open(subscriptions.subscribe(self._core, self._topics))
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()


class AsyncController(ControllerApi[RwsAsyncRunner]):
    """A controller over Robot Web Services, on asyncio.

    As `Controller`, with awaitable methods.
    """

    _carrier_type = RwsAsyncRunner

    async def connect(self) -> Self:
        """Connect and log in."""
        await self._carrier.run(connecting.connect(self._core))
        return self

    async def close(self) -> None:
        """Release mastership, log out, and close."""
        await self._carrier.run(connecting.close(self._core))
        await self._carrier.close()

    @asynccontextmanager
    async def mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> AsyncIterator[Self]:
        """Hold mastership of `rapid`, `cfg` or `motion` for a block.

        Raises Held (RG654).
        """
        await self.take_mastership(domain, wait=wait)
        try:
            yield self
        finally:
            await self._carrier.run(holding.give(self._core, domain))

    def subscribe(self, *topics: Topic) -> AsyncSubscription:
        """Subscribe to topics within `async with`: an iterator of events."""
        return AsyncSubscription(self._carrier, self._core, topics)

    async def __aenter__(self) -> Self:
        return await self.connect()

    async def __aexit__(self, *_: object) -> None:
        await self.close()
