"""Effects: requests of a flow to the client that runs it.

A flow is a generator that makes the decisions of one call, common to both clients. It yields an
effect (a connection, bytes to send, a wait) and is resumed with the outcome. The rules:

1. A flow does no I/O and calls no clock except the core's. Between two effects it runs without
   interruption, under the lock of the sync client or in one step of the loop, so it sees a
   consistent core.
2. `Wait` returns whether the condition became true in time. The client tests it after each message,
   so a condition that becomes false again may be missed.
3. A failed `Open` or `Send` is thrown in as RobotError.
4. An interruption of the caller (Ctrl-C, cancellation) is thrown in at the current effect. Flows
   that wait for a motion react to it with a STOP, and raise it when the robot is at rest.
5. `SendAtOnce` overtakes points that another flow is sending: those end at the next frame boundary.
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
    """Send bytes.

    Points of a `motion` are cut short by MotionStopped once a stop was requested.
    """

    port: Port
    data: bytes
    timeout: float
    motion: CommandedMotion | None = None


@dataclass(frozen=True, slots=True)
class SendAtOnce:
    """Send a frame on several connections at the next frame boundary.

    It precedes all queued frames, and no connection waits for another; `failures` receives the
    reason why one did not accept it.
    """

    ports: tuple[Port, ...]
    data: bytes
    timeout: float
    failures: dict[Port, RobotError] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Wait:
    """Wait until the condition holds; it is checked after each message."""

    until: Callable[[], bool]
    timeout: float


@dataclass(frozen=True, slots=True)
class Close:
    """Close a useless connection."""

    port: Port


@dataclass(frozen=True, slots=True)
class CloseAll:
    """Close all connections."""


Effect = Open | Send | SendAtOnce | Wait | Close | CloseAll
Flow = Generator[Effect, bool | None, T]
