"""Matching of arguments to parameters [K §3.10, 5.1].

Arguments and parameters are traversed together, because they have the same order:

* `value` goes to the next required parameter after the last one with an argument; of required
  alternatives (built-ins only) to the one with the same type, else to the first.
* `Par:=value` goes to the required parameter of that name; `\\Opt:=value`, `\\Switch` and
  `\\Opt?par` to the optional one. An argument may not name a parameter before one that has an
  argument already.
* Of alternatives (`\\A | \\B`) one may have an argument; run time decides on conditional ones.
* Every required parameter gets an argument, of required alternatives one of them.
* A reference parameter takes a datum whose storage permits its mode (`may_pass`).

Violations are data: the checker makes diagnostics of them, the compiler rejects the routine, and a
late call fails with ERR_CALLPROC.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Final, Generic, Literal, Protocol, TypeVar

from rapidgen.rapid.binding.names import NUMBER, DataSymbol
from rapidgen.rapid.syntax.nodes import Mode


class Formal(Protocol):
    """Properties of a parameter for matching, see `nodes.Parameter`."""

    @property
    def name(self) -> str:
        """Name in any case."""

    @property
    def optional(self) -> bool:
        """True if it may be absent, or is named by a backslash."""

    @property
    def group(self) -> int:
        """Number of its alternatives, -1 without."""


class Actual(Protocol):
    """Properties of an argument for matching, see `nodes.Argument`."""

    @property
    def kind(self) -> str:
        """`required`, `optional`, `switch` or `conditional`."""

    @property
    def name(self) -> str | None:
        """Name of the parameter, if written."""


A = TypeVar("A", bound=Actual)


class ArgumentFault(Enum):
    """Violations of the rules by an argument."""

    SURPLUS = "no required parameter is left for it"
    UNKNOWN = "no parameter of this sort has the name"
    TWICE = "its parameter has an argument"
    ORDER = "its parameter precedes one that has an argument"
    EXCLUSIVE = "an alternative of its parameter has an argument"


@dataclass(slots=True)
class Pairing(Generic[A]):
    """An argument, its parameter's index (-1: none) and its faults."""

    argument: A
    parameter: int
    misfits: tuple[ArgumentFault, ...] = ()
    rival: A | None = None
    """With EXCLUSIVE: the argument of the alternative."""


@dataclass(slots=True)
class Matching(Generic[A]):
    """Arguments of a call, and required parameters without an argument."""

    pairs: list[Pairing[A]]
    missing: list[int]

    def in_order(self, count: int) -> list[A | None]:
        """Return the argument of each of `count` parameters.

        None marks a missing argument; of several the last one counts.
        """
        result: list[A | None] = [None] * count
        for pair in self.pairs:
            if pair.parameter >= 0:
                result[pair.parameter] = pair.argument
        return result


_NO_MISFIT: Final[tuple[ArgumentFault, ...]] = ()


def match(
    parameters: Sequence[Formal], arguments: Sequence[A], fitting: Callable[[A, Sequence[int]], int]
) -> Matching[A]:
    """Match the arguments of a call to the parameters of its routine.

    `fitting` selects one of several required alternatives (indices of parameters) for an argument;
    see `first_fit`.
    """
    at = 0
    in_use: dict[int, A] = {}
    given: set[int] = set()
    pairs: list[Pairing[A]] = []
    for argument in arguments:
        if argument.name is None and argument.kind == "required":
            k = _next_required(parameters, at, in_use)
            if k < 0:
                pairs.append(Pairing(argument, -1, (ArgumentFault.SURPLUS,)))
                continue
            group = parameters[k].group
            if group >= 0:
                k = fitting(argument, _alternatives(parameters, k))
        else:
            k = _named(parameters, argument)
            if k < 0:
                pairs.append(Pairing(argument, -1, (ArgumentFault.UNKNOWN,)))
                continue
        pair = Pairing(argument, k)
        pairs.append(pair)
        if k < at:
            pair.misfits = (ArgumentFault.TWICE if k in given else ArgumentFault.ORDER,)
        group = parameters[k].group
        if group >= 0:
            rival = in_use.get(group)
            in_use[group] = argument
            if rival is not None and "conditional" not in (rival.kind, argument.kind):
                pair.misfits += (ArgumentFault.EXCLUSIVE,)
                pair.rival = rival
        given.add(k)
        at = max(at, k + 1)
    missing = [
        k
        for k, p in enumerate(parameters)
        if not p.optional and k not in given and p.group not in in_use
    ]
    return Matching(pairs, missing)


def first_fit(result: str | None, alternatives: Sequence[int], types: Sequence[str | None]) -> int:
    """Return the first alternative of exactly the type `result`.

    Without one it is the first alternative, also for a literal number. `types` are those of the
    alternatives.
    """
    if result is not None and result != NUMBER:
        for k, expected in zip(alternatives, types, strict=True):
            if expected == result:
                return k
    return alternatives[0]


Held = Literal["VAR", "PERS", "either", "read-only"]


def held_as(datum: DataSymbol) -> Held:
    """Return the storage of a datum.

    `either`: known at run time only, for an INOUT parameter.
    """
    if datum.readonly:
        return "read-only"
    if datum.kind == "PARAMETER":
        return "either" if datum.mode == "INOUT" else "PERS" if datum.mode == "PERS" else "VAR"
    return "PERS" if datum.kind == "PERS" else "VAR"


def may_pass(datum: DataSymbol, mode: Mode) -> bool:
    """Return True if a mode permits a datum, as far as known [K §5.1]."""
    held = held_as(datum)
    if mode in ("", "REF"):
        return True
    return held in ("either", mode) or (mode == "INOUT" and held != "read-only")


def _next_required(parameters: Sequence[Formal], at: int, in_use: dict[int, A]) -> int:
    for k in range(at, len(parameters)):
        parameter = parameters[k]
        if not parameter.optional and not (parameter.group >= 0 and parameter.group in in_use):
            return k
    return -1


def _alternatives(parameters: Sequence[Formal], k: int) -> list[int]:
    """Return required alternatives of parameter `k`, from `k` on."""
    group = parameters[k].group
    return [
        other
        for other in range(k, len(parameters))
        if parameters[other].group == group and not parameters[other].optional
    ]


def _named(parameters: Sequence[Formal], argument: Actual) -> int:
    name = (argument.name or "").lower()
    optional = argument.kind != "required"
    for k, parameter in enumerate(parameters):
        if parameter.name.lower() == name and parameter.optional == optional:
            return k
    return -1
