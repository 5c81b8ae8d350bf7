"""Effects of a flow over Robot Web Services."""

from asyncio import CancelledError
from collections.abc import Generator, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeVar

T = TypeVar("T")
INTERRUPTIONS = (KeyboardInterrupt, CancelledError)


@dataclass(frozen=True, slots=True)
class Response:
    """A response. Names of headers are in lower case."""

    status: int
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request, answered by a Response.

    `repeat`: it may be sent again on another connection.
    """

    method: str
    target: str
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""
    repeat: bool = False


@dataclass(frozen=True, slots=True)
class FetchCertificate:
    """Make a TLS handshake only; the body of its Response is the certificate.

    The certificate is DER. Status 0 means that the port does not speak TLS.
    """

    port: int


@dataclass(frozen=True, slots=True)
class UseEndpoint:
    """Use this port from now on.

    `certificate` (DER) is the only one that is accepted.
    """

    port: int
    certificate: bytes = b""


@dataclass(frozen=True, slots=True)
class LogIn:
    """Log in with these credentials from now on.

    Basic is used over TLS only.
    """

    way: Literal["digest", "basic"]


@dataclass(frozen=True, slots=True)
class DropConnections:
    """Drop cookies and connections, at a restart or at the end."""


@dataclass(frozen=True, slots=True)
class Pause:
    """Wait s."""

    seconds: float


Effect = Exchange | FetchCertificate | UseEndpoint | LogIn | DropConnections | Pause
Flow = Generator[Effect, Response, T]
"""Flow of effects, resumed with Responses.

Effects without a response resume it with an empty one.
"""


def resume(flow: Flow[T], outcome: Response | None, failure: BaseException | None) -> Effect:
    """Return the next effect of a flow.

    It starts (None), or resumes after an outcome or a failure.
    """
    if failure is not None:
        return flow.throw(failure)
    return next(flow) if outcome is None else flow.send(outcome)
