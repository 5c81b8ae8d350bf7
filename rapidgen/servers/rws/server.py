"""RWS server on a port: aiohttp before the application.

The application answers on the controller's thread. RWS 1.0 is plain HTTP, 2.0 is HTTPS with a
certificate that the controller signed itself.
"""

import asyncio
import logging
from collections.abc import Callable
from itertools import count

from aiohttp import WSCloseCode, WSMsgType, web

from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.aiohttp_thread import WebThread
from rapidgen.servers.rws.application import RwsApplication, is_foreign
from rapidgen.servers.rws.certificate import Certificate, self_signed
from rapidgen.servers.rws.context import Accounts
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
    server = _Server(RwsApplication(runner, generation, accounts, strict=strict), certificate)
    server.start(host, port)
    user, password = next(iter(accounts.users.items()))
    fingerprint = certificate.fingerprint if certificate else ""
    return Service(host, server.port, user, password, fingerprint, server.stop)


class _Server:
    """One port, and the thread with its loop."""

    def __init__(self, application: RwsApplication, certificate: Certificate | None) -> None:
        self._application = application
        self._certificate = certificate
        self._connections = count(1)
        self._numbers: dict[asyncio.BaseTransport, int] = {}
        self._pending: set[asyncio.Future[HttpResponse]] = set()
        self._thread = WebThread(self._app())
        application.context.runner.on_restart.append(self._restarting)

    def _app(self) -> web.Application:
        app = web.Application(client_max_size=LARGEST_BODY)
        app.router.add_get("/poll/{number}", self._poll)
        app.router.add_route("*", "/{path:.*}", self._request)
        return app

    # -- the thread ------------------------------------------------------------------------------

    def start(self, host: str, port: int) -> None:
        """Open the port. Raises DiagnosticError RG561."""
        context = self._certificate.context() if self._certificate else None
        try:
            self._thread.start("rws", host, port, context)
        except OSError as error:
            raise in_use(host, port, error) from error

    @property
    def port(self) -> int:
        """The port number."""
        return self._thread.port

    def stop(self) -> None:
        """Close the port and every connection; a second call does nothing."""
        self._thread.stop(self._close)

    async def _close(self) -> None:
        self._give_up()

    def _restarting(self) -> None:
        self._thread.soon(self._give_up)

    def _give_up(self) -> None:
        """Abandon open requests, since the controller restarts."""
        for future in tuple(self._pending):
            if not future.done():
                future.set_result(_RESTARTING)

    # -- requests --------------------------------------------------------------------------------

    async def _request(self, request: web.Request) -> web.Response:
        try:
            body = await request.read()
        except web.HTTPRequestEntityTooLarge:
            return web.Response(status=413)
        got = self._received(request, body)
        reply = await self._on_controller(lambda: self._application.handle(got))
        # Without the query and the body: they may hold confidential data.
        _LOG.debug("%s %s: %d", request.method, request.path, reply.status)
        return _response(reply)

    def _received(self, request: web.Request, body: bytes = b"") -> HttpRequest:
        transport = request.transport
        number = 0
        if transport is not None:
            number = self._numbers.get(transport, 0) or next(self._connections)
            self._numbers[transport] = number
            for gone in [t for t in self._numbers if t.is_closing()]:
                del self._numbers[gone]
        headers = {name.lower(): value for name, value in request.headers.items()}
        return HttpRequest(request.method, request.raw_path, headers, body, number)

    async def _on_controller(self, function: Callable[[], HttpResponse]) -> HttpResponse:
        """Run a function on the controller's thread; 503 while it restarts."""
        future: asyncio.Future[HttpResponse] = self._thread.loop.create_future()

        def settle(reply: HttpResponse) -> None:
            if not future.done():
                future.set_result(reply)

        def run() -> None:
            reply = HttpResponse(500)
            try:
                reply = function()
            finally:
                self._thread.soon(lambda: settle(reply))

        self._pending.add(future)
        try:
            if not self._application.context.runner.post(run):
                return _RESTARTING
            return await future
        finally:
            self._pending.discard(future)

    # -- websockets ------------------------------------------------------------------------------

    async def _poll(self, request: web.Request) -> web.StreamResponse:
        number = request.match_info["number"]
        got = self._received(request)
        protocol = PROTOCOLS[self._application.generation]
        asked = [p.strip() for p in got.headers.get("sec-websocket-protocol", "").split(",")]
        if got.headers.get("upgrade", "").lower() != "websocket" or protocol not in asked:
            return web.Response(status=400)
        if is_foreign(got):
            return web.Response(status=403)
        events: asyncio.Queue[bytes | None] = asyncio.Queue()

        def send(event: bytes | None) -> None:
            self._thread.soon(lambda: events.put_nowait(event))

        def listen() -> HttpResponse:
            session = self._application.session_of(got)
            if session is None:
                return HttpResponse(403)
            try:
                group = self._application.groups.find(number, session)
                self._application.groups.listen(group, send, lambda: send(None))
            except RequestDenied as refused:
                return HttpResponse(refused.status)
            return HttpResponse(101)

        reply = await self._on_controller(listen)
        if reply.status != 101:
            return _response(reply)
        socket = web.WebSocketResponse(
            protocols=(protocol,),
            autoping=self._application.is_one,
            autoclose=True,
            max_msg_size=4096,
        )
        await socket.prepare(request)
        both = {
            asyncio.ensure_future(self._send(socket, events)),
            asyncio.ensure_future(self._hear(socket)),
        }
        try:
            done, _ = await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            codes = [task.result() for task in done if task.exception() is None]
        finally:
            # No other task may read or write during the close.
            for task in both:
                task.cancel()
            await asyncio.gather(*both, return_exceptions=True)
            self._application.context.runner.post(
                lambda: self._application.groups.leave(number, send)
            )
        await socket.close(code=codes[0] if codes else WSCloseCode.GOING_AWAY)
        return socket

    async def _send(
        self, socket: web.WebSocketResponse, events: "asyncio.Queue[bytes | None]"
    ) -> WSCloseCode:
        """Send events until they end or exceed the limit; return the close code."""
        while (event := await events.get()) is not None and events.qsize() <= _UNREAD:
            await socket.send_str(event.decode())
        return WSCloseCode.GOING_AWAY

    async def _hear(self, socket: web.WebSocketResponse) -> WSCloseCode:
        """RWS 2.0: disconnect a client that sends; ignore pings [VC 7.21]."""
        async for message in socket:
            if message.type in (WSMsgType.TEXT, WSMsgType.BINARY) and not self._application.is_one:
                return WSCloseCode.POLICY_VIOLATION
        return WSCloseCode.OK


def _response(reply: HttpResponse) -> web.Response:
    response = web.Response(status=reply.status, body=reply.body or None)
    for name, value in reply.headers:
        response.headers.add(name, value)
    return response
