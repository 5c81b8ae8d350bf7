"""Clients dropped without `close()`, and clients in a forked process.

The runners of both clients keep their connections in an object of their own, which a finalizer
closes. Threads, callbacks and transports hold only weak references to a runner.
"""

import os
import warnings
from typing import Protocol
from weakref import WeakSet


class Forkable(Protocol):
    """A client with connections that a forked process must not use."""

    def forked(self) -> None:
        """Drop all connections without a byte to the peer."""


_CLIENTS: WeakSet[Forkable] = WeakSet()


def drop_in_child(client: Forkable) -> None:
    """Call `forked` of a client in every process forked from this one.

    An inherited connection would stay open after the parent's end, and the driver would not notice
    that its client has died.
    """
    _CLIENTS.add(client)


def _after_fork() -> None:
    for client in tuple(_CLIENTS):
        client.forked()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def warn_unclosed(where: str, *, stopped: bool = False) -> None:
    """Warn of a client that was dropped while it was connected.

    `stopped`: its motion was stopped. Python hides a ResourceWarning by default, so the user would
    not learn why the robot is at rest.
    """
    help = "call `close()`, or use a `with` block"
    if stopped:
        text = f"the client of {where} was dropped without close(), and its motion stopped: {help}"
        warnings.warn(text, RuntimeWarning, stacklevel=3)
    else:
        text = f"the client of {where} was dropped without close(): {help}"
        warnings.warn(text, ResourceWarning, stacklevel=3)
