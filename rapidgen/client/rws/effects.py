"""What a flow over Robot Web Services may ask of the client that runs it."""

from asyncio import CancelledError
from collections.abc import Generator, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeVar

T = TypeVar("T")
INTERRUPTIONS = (KeyboardInterrupt, CancelledError)


@dataclass(frozen=True, slots=True)
class Response:
    """An answer. Names of headers are in lower case."""

    status: int
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request, answered by a Response. `repeat`: it may be sent again on another connection."""

    method: str
    target: str
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""
    repeat: bool = False


@dataclass(frozen=True, slots=True)
class FetchCertificate:
    """Shake hands over TLS and nothing else; its Response has the certificate (DER) as body.

    A status of 0 means that nobody speaks TLS there.
    """

    port: int


@dataclass(frozen=True, slots=True)
class UseEndpoint:
    """From now on talk to this port; `certificate` (DER) is the only one that is accepted."""

    port: int
    certificate: bytes = b""


@dataclass(frozen=True, slots=True)
class LogIn:
    """From now on log in so. Basic is asked for over TLS only."""

    way: Literal["digest", "basic"]


@dataclass(frozen=True, slots=True)
class DropConnections:
    """Drop cookies and connections: the controller has restarted, or this is the end."""


@dataclass(frozen=True, slots=True)
class Pause:
    """Let s pass."""

    seconds: float


Effect = Exchange | FetchCertificate | UseEndpoint | LogIn | DropConnections | Pause
Flow = Generator[Effect, Response, T]
"""A flow is resumed with a Response; of effects that have none with an empty one."""


def resume(flow: Flow[T], outcome: Response | None, failure: BaseException | None) -> Effect:
    """The next effect of a flow: at its beginning (None), after an outcome, or after a failure."""
    if failure is not None:
        return flow.throw(failure)
    return next(flow) if outcome is None else flow.send(outcome)
