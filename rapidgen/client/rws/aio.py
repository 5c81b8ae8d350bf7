"""`AsyncController`: the same surface on asyncio."""

import asyncio
import ssl
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Self, TypeVar

import httpx2

from rapidgen.client.rws.core import Pace, RwsCore
from rapidgen.client.rws.effects import (
    Effect,
    Exchange,
    Flow,
    Forget,
    LogIn,
    LookAtCertificate,
    Pause,
    Response,
    Settle,
    resume,
)
from rapidgen.client.rws.flows import connecting, holding
from rapidgen.client.rws.surface import ControllerSurface
from rapidgen.client.rws.transport import (
    auth_of,
    no_verification,
    not_reached,
    pinned,
    response_of,
)

T = TypeVar("T")


class Awaiting:
    """Carries out flows on the caller's loop, one after the other."""

    def __init__(self, core: RwsCore, timeout: float) -> None:
        self._core = core
        self._timeout = timeout
        self._lock = asyncio.Lock()
        self._pace = Pace()
        self._client: httpx2.AsyncClient | None = None
        self._base = ""
        self._auth: httpx2.Auth | None = None

    async def run(self, flow: Flow[T]) -> T:
        """The outcome of a flow. What an effect raises is thrown into it."""
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
            case LookAtCertificate():
                return await self._look(effect.port)
            case Settle():
                await self.close()
                scheme = "https" if effect.certificate else "http"
                self._base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
                verify = pinned(effect.certificate) if effect.certificate else True
                self._auth = None
                self._client = httpx2.AsyncClient(
                    verify=verify, trust_env=False, timeout=self._timeout, follow_redirects=False
                )
            case LogIn():
                self._auth = auth_of(effect, self._core)
            case Forget():
                if self._client is not None:
                    self._client.cookies.clear()
        return Response(0)

    async def _exchange(self, effect: Exchange) -> Response:
        assert self._client is not None
        await asyncio.sleep(self._pace.reserve(time.monotonic()))
        for left in (1, 0):
            try:
                answer = await self._client.request(
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

    async def _look(self, port: int) -> Response:
        try:
            async with asyncio.timeout(self._timeout):
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

    async def close(self) -> None:
        """Close all connections."""
        if self._client is not None:
            await self._client.aclose()
            self._client = None


class AsyncController(ControllerSurface[Awaiting]):
    """A controller over Robot Web Services, on asyncio: as `Controller`, and every method is
    awaited."""

    _carrier_type = Awaiting

    async def connect(self) -> Self:
        """Connect and log in."""
        await self._carrier.run(connecting.connect(self._core))
        return self

    async def close(self) -> None:
        """Give back what is held, log out, close."""
        await self._carrier.run(connecting.close(self._core))
        await self._carrier.close()

    @asynccontextmanager
    async def mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> AsyncIterator[Self]:
        """Hold mastership of `rapid`, `cfg` or `motion` for a block. Raises Held (RG654)."""
        await self.take_mastership(domain, wait=wait)
        try:
            yield self
        finally:
            await self._carrier.run(holding.give(self._core, domain))

    async def __aenter__(self) -> Self:
        return await self.connect()

    async def __aexit__(self, *_: object) -> None:
        await self.close()
