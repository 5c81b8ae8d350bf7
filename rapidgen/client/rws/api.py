"""What `Controller` and `AsyncController` have in common."""

from collections.abc import Callable
from pathlib import Path
from typing import Generic, TypeVar

from rapidgen.client.rws import known_certificates
from rapidgen.client.rws.address import parse_address
from rapidgen.client.rws.core import Login, RwsCore
from rapidgen.wire.rws.bodies import Generation

RESTART_TIMEOUT = 180.0
"""s for which a subscription waits for a restarting controller."""


R = TypeVar("R")


class ControllerApi(Generic[R]):
    """A controller over Robot Web Services: what needs no request."""

    _runner_type: Callable[[RwsCore, float], R]

    def __init__(
        self,
        address: str,
        *,
        user: str = "Default User",
        password: str = "",
        fingerprint: str = "",
        confirm: Callable[[str, str], bool] | None = None,
        pin_file: Path | None = None,
        timeout: float = 10.0,
    ) -> None:
        self._core = RwsCore(
            parse_address(address),
            Login(user, password),
            fingerprint,
            pin_file or known_certificates.default_file(),
            confirm,
        )
        self._runner = self._runner_type(self._core, timeout)

    @property
    def generation(self) -> Generation:
        """RWS 1.0, 2.0, or 2.0 of RobotWare 8; known after connecting."""
        return self._core.generation

    @property
    def where(self) -> str:
        """Host and port of the connection."""
        return self._core.where

    @property
    def requests(self) -> int:
        """Number of requests sent so far."""
        return self._core.requests
