"""Where Python functions meet the names of RAPID's built-in routines.

`@builtin("SocketSend", cost="socket")` binds a function that is called
`function(task, *arguments)`, one positional argument for each parameter of the signature in
order: the value for IN, a `values.Ref` for VAR, INOUT, PERS and REF of value types (the object
itself for non-value types and signals), None for an absent optional parameter, True for a
present switch. A parameter of type `anytype` always comes as a Ref. Array arguments by mode IN
are the dict itself: do not change it.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal, TypeAlias, TypeVar

from rapidgen.runtime.values import Value

Cost: TypeAlias = Literal["call", "string", "socket", "move"]
COSTS: dict[Cost, int] = {"call": 5_000, "string": 50_000, "socket": 500_000, "move": 1_000_000}
"""Nanoseconds of the reference cost model, on top of the statement's own."""


@dataclass(frozen=True, slots=True)
class Builtin:
    """A bound built-in.

    `pure` promises: result and errors depend on the arguments alone, it never waits, makes no
    event and does not look at the clock or the task. Such calls cost less of real time.
    """

    name: str
    function: Callable[..., Value]
    cost: Cost
    pure: bool


_Function = TypeVar("_Function", bound=Callable[..., Value])
_BOUND: dict[str, Builtin] = {}


def builtin(
    name: str, *, cost: Cost = "call", pure: bool = False
) -> Callable[[_Function], _Function]:
    """Bind the decorated function to the built-in routine `name`."""

    def bind(function: _Function) -> _Function:
        key = name.lower()
        if key in _BOUND:
            raise ValueError(f"built-in {name} is bound twice")
        _BOUND[key] = Builtin(name, function, cost, pure)
        return function

    return bind


def builtins(
    functions: Mapping[str, Callable[..., Value]], *, cost: Cost = "call", pure: bool = False
) -> None:
    """Bind a table of functions, each of which says in one expression what its built-in does."""
    for name, function in functions.items():
        builtin(name, cost=cost, pure=pure)(function)


def bound(name: str) -> Builtin | None:
    """The binding of a built-in (any case), or None when there is none."""
    _load()
    return _BOUND.get(name.lower())


def bound_names() -> list[str]:
    """Names of all bound built-ins, sorted."""
    _load()
    return sorted(b.name for b in _BOUND.values())


@cache
def _load() -> None:
    package = importlib.import_module("rapidgen.runtime.builtins")
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
