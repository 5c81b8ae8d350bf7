"""Flows as methods: one signature and docstring for both clients.

A client whose carrier waits for a flow's outcome returns it; a client whose carrier is asynchronous
returns a coroutine.
"""

import inspect
from collections.abc import Callable, Coroutine, Generator
from functools import update_wrapper
from typing import ParamSpec, Protocol, TypeVar, cast, get_args, overload

from rapidgen._compat import Never

P = ParamSpec("P")
T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class _Blocking(Protocol):
    # This flow yields no effect, so its carrier may send any outcome.
    def run(self, flow: Generator[Never, object, T], /) -> T: ...


class _Awaited(Protocol):
    def run(self, flow: Generator[Never, object, T], /) -> Coroutine[None, None, T]: ...


class _OfBlocking(Protocol):
    @property
    def _carrier(self) -> _Blocking: ...


class _OfAwaited(Protocol):
    @property
    def _carrier(self) -> _Awaited: ...


class Method(Protocol[P, T_co]):
    """A flow as a method for type checkers: its outcome or an awaitable."""

    @overload
    def __get__(self, owner: _OfBlocking, kind: type) -> Callable[P, T_co]: ...
    @overload
    def __get__(
        self, owner: _OfAwaited, kind: type
    ) -> Callable[P, Coroutine[None, None, T_co]]: ...


def method(
    flow: Callable[..., Generator[object, Never, T]], subject: Callable[[_OfBlocking], object]
) -> Method[P, T]:
    """Return a method that runs `flow` for its client's `subject`."""

    def run(self: _OfBlocking, *args: P.args, **options: P.kwargs) -> T:
        steps = cast("Generator[Never, object, T]", flow(subject(self), *args, **options))
        return self._carrier.run(steps)

    report = inspect.signature(flow)
    first, *others = report.parameters.values()
    signature = report.replace(
        parameters=[first.replace(name="self", annotation=first.empty), *others],
        return_annotation=get_args(report.return_annotation)[-1],
    )
    update_wrapper(run, flow).__dict__["__signature__"] = signature
    return cast("Method[P, T]", run)
