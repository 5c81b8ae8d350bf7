"""Web server of the page: aiohttp in a thread.

It moves bytes; the broadcaster makes the messages. Files are those that existed at the start, by
name: no path of a request reaches the disk.
"""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Final

from aiohttp import WSMsgType, web

from rapidgen.diagnostics import refusal
from rapidgen.servers.aiohttp_thread import WebThread
from rapidgen.viewer.auth import HEADERS, TokenAuth, is_readable
from rapidgen.viewer.broadcaster import Broadcaster, MessageBatch
from rapidgen.viewer.page_connection import PageConnection, text_frame
from rapidgen.viewer.provider import Subject

_LOG = logging.getLogger("rapidgen.viewer")

ASSETS = Path(__file__).resolve().parent / "assets"
_TYPES: Final = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
}
LOOKS: Final = 1 / 30
"""s between two updates."""
_LARGEST: Final = 1_048_576
UNANSWERED: Final = 8
"""Requests of one viewer that may wait for their answers.

Further ones stay in its connection.
"""
Answer = Callable[[web.Request], Awaitable[web.StreamResponse]]


@dataclass(frozen=True, slots=True)
class Page:
    """A running server of the page."""

    url: str
    """Address with the token: it permits viewing."""
    _stop: Callable[[], None] = field(repr=False)
    renew: Callable[[], None] = field(repr=False)
    """Replace the subject; to be called on its thread."""

    def close(self) -> None:
        """Close the port and every connection; a second call does nothing."""
        self._stop()


def serve_page(
    watched: Subject,
    host: str = "127.0.0.1",
    port: int = 0,
    files: Mapping[str, bytes] = MappingProxyType({}),
) -> Page:
    """Serve the page of a subject.

    `files` are the meshes, for admitted viewers. DiagnosticError RG920 (not built), RG921 (port),
    RG922 (token).
    """
    server = _Server(watched, _assets(), files)
    server.start(host, port)
    displayed = "127.0.0.1" if host == "0.0.0.0" else host
    return Page(
        f"http://{displayed}:{server.port}/#token={server.door.token}",
        server.stop,
        server.hub.renew,
    )


def _assets() -> dict[str, tuple[bytes, str]]:
    result = {}
    if ASSETS.is_dir():
        for path in ASSETS.iterdir():
            if path.suffix in _TYPES:
                result[path.name] = (path.read_bytes(), _TYPES[path.suffix])
    if "index.html" not in result:
        raise refusal(
            "RG920",
            None,
            "the page has not been built",
            "in a checkout, `make page` builds it; a wheel has it",
            exit_code=1,
        )
    return result


class _Server:
    """One port, and the thread with its loop."""

    def __init__(
        self, watched: Subject, assets: dict[str, tuple[bytes, str]], files: Mapping[str, bytes]
    ) -> None:
        self.hub = Broadcaster(watched, self._tell)
        self.door = TokenAuth()
        self._watched = watched
        self._assets = assets
        self._files = files
        self._viewers: dict[PageConnection, web.WebSocketResponse] = {}
        self._looked = True
        app = web.Application(middlewares=[self._guarded], client_max_size=65_536)
        app.router.add_get("/", self._asset)
        app.router.add_get("/session", self._admitted)
        app.router.add_post("/session", self._enter)
        app.router.add_get("/link", self._link)
        app.router.add_get("/files/{name}", self._file)
        app.router.add_get("/{name}", self._asset)
        self._thread = WebThread(app)

    # -- the thread ------------------------------------------------------------------------------

    def start(self, host: str, port: int) -> None:
        """Open the port and start the updates."""
        try:
            self._thread.start("view", host, port)
        except OSError as error:
            raise refusal(
                "RG921",
                None,
                f"cannot serve the page at {host}:{port}: {error.strerror or error}",
                "name another port with `--view-port`, or 0 for any free one",
                exit_code=1,
            ) from error
        self.hub.renew()
        self._thread.soon(self._look)

    @property
    def port(self) -> int:
        """The port number."""
        return self._thread.port

    def stop(self) -> None:
        """Close the port; a second call does nothing."""
        self._thread.stop(self._close)

    async def _close(self) -> None:
        for socket in tuple(self._viewers.values()):
            await socket.close()

    def _look(self) -> None:
        """Request an update if there is a viewer and none is pending."""
        self._thread.loop.call_later(LOOKS, self._look)
        if not self._viewers or not self._looked:
            return
        self._looked = False

        def now() -> None:
            try:
                self.hub.look()
            finally:
                self._looked = True

        if not self._watched.post(now):
            self._looked = True

    # -- requests --------------------------------------------------------------------------------

    @web.middleware
    async def _guarded(self, request: web.Request, handler: Answer) -> web.StreamResponse:
        if not is_readable(request):
            return web.Response(status=400, headers=HEADERS)
        if not self.door.addressed(request, self.port):
            return web.Response(status=421, headers=HEADERS)
        try:
            response = await handler(request)
        except web.HTTPException as refused:
            return web.Response(status=refused.status, headers=HEADERS)
        if not response.prepared:
            response.headers.update(HEADERS)
        return response

    async def _asset(self, request: web.Request) -> web.Response:
        match = self._assets.get(request.match_info.get("name", "index.html"))
        if match is None:
            return web.Response(status=404)
        return web.Response(body=match[0], content_type=match[1], charset="utf-8")

    async def _file(self, request: web.Request) -> web.Response:
        if not self.door.admitted(request, self.port):
            return web.Response(status=403)
        match = self._files.get(request.match_info["name"])
        if match is None:
            return web.Response(status=404)
        return web.Response(body=match, content_type="application/octet-stream")

    async def _admitted(self, request: web.Request) -> web.Response:
        return web.Response(status=204 if self.door.admitted(request, self.port) else 403)

    async def _enter(self, request: web.Request) -> web.Response:
        response = web.Response(status=204)
        try:
            given = (await request.text()).encode()
        except (LookupError, ValueError):
            # An unknown charset, or bytes that it does not have.
            return web.Response(status=400)
        good = self.door.own(request) and self.door.enter(given, response, self.port)
        return response if good else web.Response(status=403)

    async def _link(self, request: web.Request) -> web.StreamResponse:
        if not (self.door.own(request) and self.door.admitted(request, self.port)):
            return web.Response(status=403)
        socket = web.WebSocketResponse(max_msg_size=_LARGEST, heartbeat=20, compress=False)
        await socket.prepare(request)
        assert isinstance(request.transport, asyncio.Transport)
        viewer = PageConnection(request.transport)

        def join() -> None:
            self._thread.soon(partial(self._begin, viewer, self.hub.join()))

        # Unread data fill the connection, so that a flooding viewer only blocks itself.
        places = asyncio.Semaphore(UNANSWERED)

        def answer(frame: bytes) -> None:
            places.release()
            viewer.send(frame)

        def ask(text: str) -> None:
            self._thread.soon(partial(answer, text_frame(self.hub.ask(text).data)))

        self._viewers[viewer] = socket
        _LOG.info("a page looks: %d now", len(self._viewers))
        self._watched.post(join)
        try:
            async for message in socket:
                if message.type is WSMsgType.TEXT:
                    await places.acquire()
                    if not self._watched.post(partial(ask, message.data)):
                        places.release()
        finally:
            del self._viewers[viewer]
            viewer.close()
            _LOG.info("a page has disconnected: %d now", len(self._viewers))
        return socket

    def _begin(self, viewer: PageConnection, complete: MessageBatch) -> None:
        viewer.send(text_frame(complete.data))
        viewer.knows = True

    def _tell(self, batch: MessageBatch) -> None:
        self._thread.soon(partial(self._broadcast, text_frame(batch.data), batch.passing))

    def _broadcast(self, frame: bytes, passing: bool) -> None:
        for viewer in self._viewers:
            if viewer.knows:
                viewer.send(frame, passing=passing)
