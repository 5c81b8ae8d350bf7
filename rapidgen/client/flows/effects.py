"""What a flow may ask of the client that runs it: the steps between the client's decisions.

A flow is a generator: it yields what it needs (a connection, bytes sent, a wait) and is resumed
with the outcome: `Wait` gives whether the condition came true in time; a failed `Open` or
`Send` is thrown in as RobotError. When the caller is interrupted (Ctrl-C, cancellation) the
interruption is thrown in; flows that wait for a motion answer it with a STOP.
"""

from asyncio import CancelledError
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import TypeVar

from rapidgen.client.core.motion import CommandedMotion
from rapidgen.client.errors import RobotError
from rapidgen.wire.simple_message.spec import Port

T = TypeVar("T")
INTERRUPTIONS = (KeyboardInterrupt, CancelledError)


@dataclass(frozen=True, slots=True)
class Open:
    """Open a connection."""

    port: Port
    timeout: float


@dataclass(frozen=True, slots=True)
class Send:
    """Send bytes. Points of a `motion` are cut short, by MotionStopped, once somebody asked it to
    stop."""

    port: Port
    data: bytes
    timeout: float
    motion: CommandedMotion | None = None

    @property
    def is_stopped(self) -> bool:
        """Whether these points must not be sent any more."""
        return self.motion is not None and self.motion.stopping


@dataclass(frozen=True, slots=True)
class SendAtOnce:
    """Send a frame on several connections, ahead of whatever is being sent there, at the next frame
    boundary. None of them waits for another; `failures` receives why one could not take it."""

    ports: tuple[Port, ...]
    data: bytes
    timeout: float
    failures: dict[Port, RobotError] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Wait:
    """Wait until the condition holds; it is looked at after each message."""

    until: Callable[[], bool]
    timeout: float


@dataclass(frozen=True, slots=True)
class Close:
    """Close a connection that is of no use."""

    port: Port


@dataclass(frozen=True, slots=True)
class HangUp:
    """Close all connections."""


Effect = Open | Send | SendAtOnce | Wait | Close | HangUp
Flow = Generator[Effect, bool | None, T]
