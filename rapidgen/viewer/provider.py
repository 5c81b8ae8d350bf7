"""The seam of the page: what one aspect of it tells, and what may be asked of it.

An aspect belongs to the thread of what is watched. Everything of it is called there.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Protocol, TypeAlias

from rapidgen.viewer.messages import Request, ToPage

Handler: TypeAlias = Callable[[Request], str]
"""Carries a request out; its text, empty in general, goes back. Declined: it is not."""


class RequestRejected(Exception):
    """What was asked for is not done; the text says why."""


class StateProvider(Protocol):
    """One aspect of the page."""

    def whole(self) -> Iterable[ToPage]:
        """Everything that a viewer who comes now has to know."""

    def changes(self) -> Iterable[ToPage]:
        """What is new since the last call; called some thirty times a second."""

    def handlers(self) -> Mapping[type, Handler]:
        """What carries out requests, by their class."""


class Subject(Protocol):
    """A simulation, a robot or a recording, seen by the server."""

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function on the thread of what is watched; False: not now."""

    def aspects(self) -> tuple[StateProvider, ...]:
        """The aspects of now, the scene's first; others after a restart."""
