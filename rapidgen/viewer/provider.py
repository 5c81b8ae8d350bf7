"""Interface of the page's state providers and request handlers.

A provider belongs to the thread of its subject. Everything of it is called there.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Protocol, TypeAlias

from rapidgen.viewer.messages import Request, ToPage

Handler: TypeAlias = Callable[[Request], str]
"""Executes a request and returns a text, usually empty.

RequestRejected: it is not executed.
"""


class RequestRejected(Exception):
    """A request that is not executed; the text says why."""


class StateProvider(Protocol):
    """One aspect of the page."""

    def whole(self) -> Iterable[ToPage]:
        """Return the complete state for a new viewer."""

    def changes(self) -> Iterable[ToPage]:
        """Return the changes since the last call, about thirty times a second."""

    def handlers(self) -> Mapping[type, Handler]:
        """Return the handlers of requests, by their class."""


class Subject(Protocol):
    """A simulation, a robot or a recording, as the server sees it."""

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function on the subject's thread; False: not possible now."""

    def aspects(self) -> tuple[StateProvider, ...]:
        """Current providers, the scene's first; others after a restart."""
