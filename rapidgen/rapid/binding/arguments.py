"""Which argument goes to which parameter [K §3.10, 5.1].

Arguments and parameters are walked together, because they have the same order:

* `value` goes to the next required parameter behind the last one that got an argument; of
  required alternatives (built-ins only) to the one that it fits, else to the first.
* `Par:=value` goes to the required parameter of that name; `\\Opt:=value`, `\\Switch` and
  `\\Opt?par` to the optional one. An argument may not name a parameter that stands before one
  that has an argument already.
* Of alternatives (`\\A | \\B`) one may have an argument; of conditional ones run time decides.
* Every required parameter gets an argument, of required alternatives one of them.
* A reference parameter takes a datum that is held as its mode says (`may_pass`).

What breaks these rules is said as data: the checker makes diagnostics of it, the compiler
refuses the routine, and a late call fails with ERR_CALLPROC.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Final, Generic, Literal, Protocol, TypeVar

from rapidgen.rapid.binding.names import NUMBER, DataSymbol
from rapidgen.rapid.syntax.nodes import Mode


class Formal(Protocol):
    """What matching asks of a parameter; `nodes.Parameter` has it."""

    @property
    def name(self) -> str:
        """In any case."""

    @property
    def optional(self) -> bool:
        """Whether it may be left out, or is named by a backslash."""

    @property
    def group(self) -> int:
        """Number of its alternatives, -1 without."""


class Actual(Protocol):
    """What matching asks of an argument; `nodes.Argument` has it."""

    @property
    def kind(self) -> str:
        """`required`, `optional`, `switch` or `conditional`."""

    @property
    def name(self) -> str | None:
        """The parameter's, where it is written."""


A = TypeVar("A", bound=Actual)


class ArgumentFault(Enum):
    """How an argument can break the rules."""

    SURPLUS = "no required parameter is left for it"
    UNKNOWN = "no parameter of this sort has the name"
    TWICE = "its parameter has an argument"
    ORDER = "its parameter stands before one that has an argument"
    EXCLUSIVE = "an alternative of its parameter has an argument"


@dataclass(slots=True)
class Pairing(Generic[A]):
    """One argument, the index of its parameter (-1: none), and what is wrong with it."""

    argument: A
    parameter: int
    misfits: tuple[ArgumentFault, ...] = ()
    rival: A | None = None
    """With EXCLUSIVE: the argument of the alternative."""


@dataclass(slots=True)
class Matching(Generic[A]):
    """The arguments of a call in their order, and the required parameters that got none."""

    pairs: list[Pairing[A]]
    missing: list[int]

    def in_order(self, count: int) -> list[A | None]:
        """Argument of each of `count` parameters, None where there is none; the last one wins."""
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

    `fitting` is asked which of several required alternatives (indices of parameters) an argument
    means; see `first_fit`.
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
    """Of alternatives the first that has the type `result` exactly; else the first.

    `types` are those of the alternatives. A literal number means the first.
    """
    if result is not None and result != NUMBER:
        for k, expected in zip(alternatives, types, strict=True):
            if expected == result:
                return k
    return alternatives[0]


Held = Literal["VAR", "PERS", "either", "read-only"]


def held_as(datum: DataSymbol) -> Held:
    """How a datum is held: `either` is known at run time only, of an INOUT parameter."""
    if datum.readonly:
        return "read-only"
    if datum.kind == "PARAMETER":
        return "either" if datum.mode == "INOUT" else "PERS" if datum.mode == "PERS" else "VAR"
    return "PERS" if datum.kind == "PERS" else "VAR"


def may_pass(datum: DataSymbol, mode: Mode) -> bool:
    """Whether a datum may be the argument of a parameter of a mode, as far as is known [K §5.1]."""
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
    """Required parameters from `k` on that are alternatives of parameter `k`."""
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
