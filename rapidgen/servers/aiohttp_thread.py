"""An aiohttp application on a port, in a thread with its own loop."""

import asyncio
import logging
import ssl
import threading
from collections.abc import Awaitable, Callable
from contextlib import suppress

from aiohttp import web
from aiohttp.http_exceptions import HttpProcessingError

_LOG = logging.getLogger("aiohttp.rapidgen")


def _is_own(record: logging.LogRecord) -> bool:
    """False for a request that is no HTTP: its sender gets 400, the user no traceback."""
    return not (record.exc_info and isinstance(record.exc_info[1], HttpProcessingError))


_LOG.addFilter(_is_own)


class WebThread:
    """Thread of one application; `port` is known after the start."""

    def __init__(self, app: web.Application) -> None:
        self.loop = asyncio.new_event_loop()
        self.port = 0
        self._runner = web.AppRunner(app, access_log=None, logger=_LOG, shutdown_timeout=0.05)
        self._thread: threading.Thread | None = None

    def start(self, name: str, host: str, port: int, context: ssl.SSLContext | None = None) -> None:
        """Open the port, with TLS if there is a context.

        Raises OSError if the port is not available; then all is closed.
        """
        try:
            self.loop.run_until_complete(self._open(host, port, context))
        except OSError:
            self.loop.run_until_complete(self._runner.cleanup())
            self.loop.close()
            raise
        self._thread = threading.Thread(
            target=self.loop.run_forever, name=f"{name}:{self.port}", daemon=True
        )
        self._thread.start()

    async def _open(self, host: str, port: int, context: ssl.SSLContext | None) -> None:
        await self._runner.setup()
        await web.TCPSite(self._runner, host, port, ssl_context=context).start()
        self.port = self._runner.addresses[0][1]

    def stop(self, first: Callable[[], Awaitable[None]]) -> None:
        """Close the port and every connection after `first`.

        A second call does nothing.
        """
        thread, self._thread = self._thread, None
        if thread is None:
            return
        asyncio.run_coroutine_threadsafe(self._close(first), self.loop).result()
        self.loop.call_soon_threadsafe(self.loop.stop)
        thread.join()
        self.loop.close()

    async def _close(self, first: Callable[[], Awaitable[None]]) -> None:
        await first()
        server = self._runner.server
        open_ones = [c.transport for c in server.connections] if server is not None else []
        await self._runner.cleanup()
        # A client that does not answer the end of TLS would keep its socket open, so the loop is
        # closed.
        for transport in filter(None, open_ones):
            # AttributeError: Python 3.11.2 (Debian 12), if TLS is closed twice.
            with suppress(AttributeError):
                transport.abort()
        await asyncio.sleep(0)

    def soon(self, function: Callable[[], object]) -> None:
        """Run a function on the loop; ignore it if the loop is closed."""
        with suppress(RuntimeError):
            self.loop.call_soon_threadsafe(function)
