"""`Controller`: Robot Web Services from the caller's thread."""

import socket
import ssl
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
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


class Blocking:
    """Carries out flows by the caller's thread; requests of several threads go one by one."""

    def __init__(self, core: RwsCore, timeout: float) -> None:
        self._core = core
        self._timeout = timeout
        self._lock = threading.RLock()
        self._pace = Pace()
        self._client: httpx2.Client | None = None
        self._base = ""
        self._auth: httpx2.Auth | None = None

    def run(self, flow: Flow[T]) -> T:
        """The outcome of a flow. What an effect raises is thrown into it."""
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
            case LookAtCertificate():
                return self._look(effect.port)
            case Settle():
                self._settle(effect)
            case LogIn():
                self._auth = auth_of(effect, self._core)
            case Forget():
                self._forget()
        return Response(0)

    def _settle(self, effect: Settle) -> None:
        self.close()
        scheme = "https" if effect.certificate else "http"
        self._base = f"{scheme}://{self._core.address.netloc}:{effect.port}"
        verify = pinned(effect.certificate) if effect.certificate else True
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

    def close(self) -> None:
        """Close all connections."""
        if self._client is not None:
            self._client.close()
            self._client = None


class Controller(ControllerSurface[Blocking]):
    """A controller over Robot Web Services.

    `address` is `rws://HOST[:PORT]`, `rwss://HOST[:PORT]` or a bare host; which generation is
    there is found out. Connected at the first call, closed by `close()` or the end of a `with`
    block: mastership is given back, the session logged out. A certificate that is not known yet
    is shown to `confirm(where, fingerprint)`, or must be `fingerprint`. All methods may be called
    from any thread.
    """

    _carrier_type = Blocking

    def connect(self) -> Self:
        """Connect and log in.

        Raises ConnectionFailed, LoginFailed (RG651, RG652), NotRws (RG653).
        """
        self._carrier.run(connecting.connect(self._core))
        return self

    def close(self) -> None:
        """Give back what is held, log out, close."""
        self._carrier.run(connecting.close(self._core))
        self._carrier.close()

    @contextmanager
    def mastership(self, domain: str = "rapid", *, wait: float = 0.0) -> Iterator[Self]:
        """Hold mastership of `rapid`, `cfg` or `motion` for a block. Raises Held (RG654)."""
        self.take_mastership(domain, wait=wait)
        try:
            yield self
        finally:
            self._carrier.run(holding.give(self._core, domain))

    def __enter__(self) -> Self:
        return self.connect()

    def __exit__(self, *_: object) -> None:
        self.close()
