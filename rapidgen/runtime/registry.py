"""Registry of the Python functions of RAPID's built-in routines.

`@builtin("SocketSend", cost="socket")` binds a function that is called `function(task,
*arguments)`, with one positional argument for each parameter of the signature in order: the value
for IN, a `values.Ref` for VAR, INOUT, PERS and REF of value types (the object itself for non-value
types and signals), None for an absent optional parameter, True for a present switch. A parameter of
type `anytype` is always a Ref. Array arguments by mode IN are the dict itself: the function must
not change it.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal, TypeAlias, TypeVar

from rapidgen.rapid.builtins.signatures import routine
from rapidgen.runtime.values import Value

Arguments: TypeAlias = Mapping[str, Value]
"""By the names of the parameters; None: left out."""
Cost: TypeAlias = Literal["call", "string", "socket", "move"]
COSTS: dict[Cost, int] = {"call": 5_000, "string": 50_000, "socket": 500_000, "move": 1_000_000}
"""Nanoseconds of the reference cost model, in addition to the cost of the statement."""


@dataclass(frozen=True, slots=True)
class Builtin:
    """A bound built-in.

    A `pure` function depends on its arguments only: it never waits, causes no event and reads
    neither clock nor task. Its calls cost less real time.
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
    """Bind a table of functions that are single expressions."""
    for name, function in functions.items():
        builtin(name, cost=cost, pure=pure)(function)


def by_name(*names: str, cost: Cost = "call") -> Callable[[_Function], _Function]:
    """Bind `function(task, name, arguments)` to several built-ins."""

    def bind(function: _Function) -> _Function:
        for name in names:
            builtin(name, cost=cost)(_named(name, function))
        return function

    return bind


def _named(name: str, function: Callable[..., Value]) -> Callable[..., Value]:
    def call(task: object, *arguments: Value) -> Value:
        return function(task, name, dict(zip(_parameters(name), arguments, strict=True)))

    return call


@cache
def _parameters(name: str) -> tuple[str, ...]:
    signature = routine(name)
    assert signature is not None
    return tuple(parameter.name for parameter in signature.parameters)


def bound(name: str) -> Builtin | None:
    """Return the binding of a built-in (any case), None without one."""
    _load()
    return _BOUND.get(name.lower())


def bound_names() -> list[str]:
    """Return the names of all bound built-ins, sorted."""
    _load()
    return sorted(b.name for b in _BOUND.values())


@cache
def _load() -> None:
    package = importlib.import_module("rapidgen.runtime.builtins")
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
