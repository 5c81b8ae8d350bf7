"""State and decisions of a client of Robot Web Services, without I/O."""

import logging
import socket
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from uuid import NAMESPACE_DNS, uuid5

from rapidgen.client.errors import NotSupported
from rapidgen.client.rws.address import RwsAddress
from rapidgen.client.rws.errors import LoginFailed
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.operations import Route, RwsOperation

_LOG = logging.getLogger("rapidgen.client")
RATE = 18
"""Requests in a second: RWS 1.0 answers 503 above 20 [RWS manual]."""
APPLICATION = "rapidgen"


class RateLimiter:
    """Schedule of requests: at most RATE in any second."""

    def __init__(self, rate: int = RATE) -> None:
        self._sent: deque[float] = deque(maxlen=rate)

    def reserve(self, now: float) -> float:
        """Reserve the next turn; return the s until it."""
        turn = now
        if len(self._sent) == self._sent.maxlen:
            turn = max(now, self._sent[0] + 1.0)
        self._sent.append(turn)
        return turn - now


@dataclass(frozen=True, slots=True)
class Login:
    """Credentials of a login; its text hides the password."""

    user: str = "Default User"
    password: str = field(default="", repr=False)


@dataclass(slots=True)
class RwsCore:
    """State of one client."""

    address: RwsAddress
    login: Login
    fingerprint: str = ""
    """Confirmed certificate; empty: use the list of known ones."""
    pins: Path = Path()
    confirm: Callable[[str, str], bool] | None = None
    """Question to the user about (host:port, fingerprint).

    None: no user to ask.
    """
    generation: Generation = Generation.ONE
    port: int = 0
    certificate: bytes = b""
    connected: bool = False
    robotware: str = ""
    system: str = ""
    """Name of the connected system."""
    held: dict[str, int] = field(default_factory=dict)
    """Domains of mastership of this session, with their counts."""
    requests: int = 0
    clock: Callable[[], float] = time.monotonic
    """Clock of waits, s."""

    def forked(self) -> None:
        """Forget the session, which belongs to the parent process."""
        self.connected = False
        self.held.clear()

    @property
    def where(self) -> str:
        """Host and port, for messages and the list of certificates."""
        return f"{self.address.netloc}:{self.port or self.address.port or 443}"

    @property
    def user(self) -> str:
        """Name of the user."""
        return self.address.user or self.login.user

    @property
    def station(self) -> str:
        """Id of this machine as a control station of RobotWare 8.

        It is constant, so that a later session can release write access of an earlier one.
        """
        return f"{{{str(uuid5(NAMESPACE_DNS, f'{APPLICATION}.{socket.gethostname()}')).upper()}}}"

    def tell(self, text: str, level: int = logging.INFO) -> None:
        """Log a message, which never has a body or a login."""
        _LOG.log(level, "%s: %s", self.where, text)

    def check_login(self) -> None:
        """Refuse before a byte is sent. Raises LoginFailed (RG651)."""
        if not self.login.password:
            raise LoginFailed.because(
                "RG651",
                f"there is no password for {self.user} at {self.address}",
                "give it: `password=`, RAPIDGEN_PASSWORD, or --secrets FILE; nothing was sent",
            )

    def route(self, operation: RwsOperation) -> Route:
        """Return this controller's spelling of an operation.

        Raises NotSupported (RG659).
        """
        result = operation.route(self.generation)
        if result is None:
            raise NotSupported.because(
                "RG659", f"RobotWare {self.robotware or '?'} has no equivalent of {operation.two}"
            )
        return result
