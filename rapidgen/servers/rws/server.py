"""RWS server on a port: aiohttp before the application.

aiohttp reads requests, writes responses and carries websockets. The application answers on the
controller's thread. RWS 1.0 is plain HTTP, 2.0 is HTTPS with a certificate that the controller
signed itself.
"""

import asyncio
import logging
from collections.abc import Callable
from functools import partial
from itertools import count
from weakref import WeakKeyDictionary

from aiohttp import WSCloseCode, WSMsgType, web

from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.aiohttp_thread import WebThread
from rapidgen.servers.rws.application import Accounts, RwsApplication, is_foreign
from rapidgen.servers.rws.certificate import self_signed
from rapidgen.servers.rws.messages import HttpRequest, HttpResponse, RequestDenied
from rapidgen.servers.service import Service, in_use, loopback
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.events import PROTOCOLS

_LOG = logging.getLogger("rapidgen.servers")

KNOWN = "robotics"
"""The default password of controllers."""
LARGEST_BODY = 64 * 1024 * 1024
_RESTARTING = HttpResponse(503, (("Retry-After", "1"),))
_UNREAD = 1000
"""Events that may wait for a client that does not read."""


def serve_rws(
    runner: ControllerRunner,
    generation: Generation,
    host: str = "127.0.0.1",
    port: int = 0,
    accounts: Accounts | None = None,
    *,
    strict: bool = True,
) -> Service:
    """Serve Robot Web Services of a controller in a thread.

    Without accounts ABB's own, which are public, are valid: on loopback only. `host_key` of the
    handle is the certificate's fingerprint. Raises DiagnosticError RG560 (not loopback), RG561.
    """
    if accounts is None or KNOWN in accounts.users.values():
        host = loopback(host)
    accounts = accounts or Accounts({"Default User": KNOWN, "Admin": KNOWN})
    certificate = None if generation is Generation.ONE else self_signed(host)
    server = _Server(RwsApplication(runner, generation, accounts, strict=strict))
    try:
        server.thread.start("rws", host, port, certificate.context() if certificate else None)
    except OSError as error:
        raise in_use(host, port, error) from error
    user, password = next(iter(accounts.users.items()))
    fingerprint = certificate.fingerprint if certificate else ""
    return Service(host, server.thread.port, user, password, fingerprint, server.stop)


class _Server:
    """One port, and the thread with its loop."""

    def __init__(self, app: RwsApplication) -> None:
        self._app = app
        self._made = count(1)
        self._connections: WeakKeyDictionary[asyncio.Transport, int] = WeakKeyDictionary()
        self._pending: set[asyncio.Future[HttpResponse]] = set()
        site = web.Application(client_max_size=LARGEST_BODY)
        site.router.add_get("/poll/{number}", self._poll)
        site.router.add_route("*", "/{path:.*}", self._request)
        self.thread = WebThread(site)
        app.runner.on_restart.append(lambda: self.thread.soon(self._give_up))

    def stop(self) -> None:
        """Close the port and every connection; a second call does nothing."""

        async def give_up() -> None:
            self._give_up()

        self.thread.stop(give_up)

    def _give_up(self) -> None:
        """Abandon open requests, since the controller restarts or the server stops."""
        for future in self._pending:
            _settle(future, _RESTARTING)

    # -- requests --------------------------------------------------------------------------------

    async def _request(self, request: web.Request) -> web.Response:
        try:
            body = await request.read()
        except web.HTTPRequestEntityTooLarge:
            return web.Response(status=413)
        http = self._received(request, body)
        reply = await self._on_controller(lambda: self._app.handle(http))
        # Without the query and the body: they may hold confidential data.
        _LOG.debug("%s %s: %d", request.method, request.path, reply.status)
        return _response(reply)

    def _received(self, request: web.Request, body: bytes = b"") -> HttpRequest:
        transport, number = request.transport, 0
        if transport is not None:
            number = self._connections.get(transport) or next(self._made)
            self._connections[transport] = number
        headers = {name.lower(): value for name, value in request.headers.items()}
        # aiohttp's cookies cost 0.1 ms of CPU a request, a quarter of all.
        parts = (part.strip().partition("=") for part in headers.get("cookie", "").split(";"))
        cookies = {name: value for name, _, value in parts}
        return HttpRequest(request.method, request.raw_path, headers, body, cookies, number)

    async def _on_controller(self, function: Callable[[], HttpResponse]) -> HttpResponse:
        """Run a function on the controller's thread; 503 while it restarts."""
        future: asyncio.Future[HttpResponse] = self.thread.loop.create_future()

        def run() -> None:
            reply = HttpResponse(500)
            try:
                reply = function()
            finally:
                self.thread.soon(partial(_settle, future, reply))

        self._pending.add(future)
        try:
            if not self._app.runner.post(run):
                return _RESTARTING
            return await future
        finally:
            self._pending.discard(future)

    # -- websockets ------------------------------------------------------------------------------

    async def _poll(self, request: web.Request) -> web.StreamResponse:
        """Open the websocket of a subscription; it carries events until one side ends it."""
        http, number = self._received(request), request.match_info["number"]
        app, protocol = self._app, PROTOCOLS[self._app.generation]
        offered = [p.strip() for p in http.headers.get("sec-websocket-protocol", "").split(",")]
        if http.headers.get("upgrade", "").lower() != "websocket" or protocol not in offered:
            return web.Response(status=400)
        if is_foreign(http):
            return web.Response(status=403)
        events: asyncio.Queue[bytes | None] = asyncio.Queue(_UNREAD)

        def put(event: bytes | None) -> None:
            try:
                events.put_nowait(event)
            except asyncio.QueueFull:
                # The client does not read; it would not read the end of the websocket either.
                if request.transport is not None:
                    request.transport.abort()

        def send(event: bytes | None) -> None:
            self.thread.soon(partial(put, event))

        def listen() -> HttpResponse:
            session = app.session_of(http)
            if session is None:
                return HttpResponse(403)
            try:
                app.groups.listen(number, session, send)
            except RequestDenied as denied:
                return HttpResponse(denied.status)
            return HttpResponse(101)

        reply = await self._on_controller(listen)
        if reply.status != 101:
            return _response(reply)
        socket = web.WebSocketResponse(
            protocols=(protocol,), autoping=app.is_one, max_msg_size=4096
        )
        await socket.prepare(request)
        both = {
            asyncio.ensure_future(_send(socket, events)),
            asyncio.ensure_future(_hear(socket, may_send=app.is_one)),
        }
        try:
            done, _ = await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            codes = [task.result() for task in done if task.exception() is None]
        finally:
            # No other task may read or write during the close.
            for task in both:
                task.cancel()
            await asyncio.gather(*both, return_exceptions=True)
            app.runner.post(lambda: app.groups.leave(number, send))
        await socket.close(code=codes[0] if codes else WSCloseCode.GOING_AWAY)
        return socket


async def _send(
    socket: web.WebSocketResponse, events: "asyncio.Queue[bytes | None]"
) -> WSCloseCode:
    """Send events until they end; return the close code."""
    while (event := await events.get()) is not None:
        await socket.send_str(event.decode())
    return WSCloseCode.GOING_AWAY


async def _hear(socket: web.WebSocketResponse, *, may_send: bool) -> WSCloseCode:
    """Wait for the end; RWS 2.0 disconnects a client that sends and ignores pings [VC 7.21]."""
    async for message in socket:
        if message.type in (WSMsgType.TEXT, WSMsgType.BINARY) and not may_send:
            return WSCloseCode.POLICY_VIOLATION
    return WSCloseCode.OK


def _settle(future: "asyncio.Future[HttpResponse]", reply: HttpResponse) -> None:
    if not future.done():
        future.set_result(reply)


def _response(reply: HttpResponse) -> web.Response:
    response = web.Response(status=reply.status, headers=reply.headers, body=reply.body or None)
    for name, value in reply.cookies.items():
        # A page of another server that runs in the same browser must not use the session.
        cookie = f"{name}={value}; path=/; httponly; samesite=strict"
        response.headers.add("Set-Cookie", cookie)
    return response
