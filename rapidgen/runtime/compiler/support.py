"""Functions that compiled code calls: arithmetic, references, loops.

NAMESPACE lists their names in generated code. Fast paths come first in every function: whole
numbers are Python ints, and the common case avoids attribute look-ups. Dialect variants
(`div_floor`, `mod_strict`, `count_tested`) replace the entry in the namespace of a program.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NoReturn

from rapidgen.machine.io import SignalCondition
from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.numbers import EXACT, MAX_STRING, single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import (
    Orient,
    PersistentCell,
    Pos,
    Record,
    Ref,
    Type,
    Value,
    ValueRef,
    assign_array,
    copy_value,
)


def fail(error: str, name: str = "") -> NoReturn:
    """Raise a RAPID error in the place of an expression.

    `name` is the missing object.
    """
    raise RapidError(error, name)


def whole_number(value: float) -> int:
    """Return an operand of DIV, MOD or an index as int.

    ERR_NOTINTVAL: it is not whole [K §12].
    """
    if value.__class__ is int:
        return value
    if value != value or value in (float("inf"), float("-inf")) or value != int(value):
        raise RapidError("ERR_NOTINTVAL")
    return int(value)


def div(left: float, right: float) -> int:
    """Compute DIV, truncated towards zero."""
    a, b = whole_number(left), whole_number(right)
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def div_floor(left: float, right: float) -> int:
    """Compute DIV, rounded towards minus infinity (dialect)."""
    return whole_number(left) // whole_number(right)


def mod(left: float, right: float) -> int:
    """Compute MOD with the sign of the left operand.

    The right operand must not be negative [K §3.11].
    """
    a, b = whole_number(left), whole_number(right)
    if b < 0:
        raise RapidError("ERR_NEGARG")
    remainder = abs(a) % b
    return remainder if a >= 0 else -remainder


def mod_floor(left: float, right: float) -> int:
    """Compute MOD with the sign of the right operand (dialect)."""
    a, b = whole_number(left), whole_number(right)
    if b < 0:
        raise RapidError("ERR_NEGARG")
    return a % b


def mod_strict(left: float, right: float) -> int:
    """Compute MOD of operands that must not be negative (dialect)."""
    if left < 0:
        raise RapidError("ERR_NEGARG")
    return mod(left, right)


def concat(left: str, right: str) -> str:
    """Join strings, at most 80 characters [S4 overview 4-28]."""
    joined = left + right
    if len(joined) > MAX_STRING:
        raise RapidError("ERR_STRTOOLNG")
    return joined


def pos_add(a: Value, b: Value) -> Value:
    """Compute pos + pos."""
    return Pos(single(a.x + b.x), single(a.y + b.y), single(a.z + b.z))


def pos_subtract(a: Value, b: Value) -> Value:
    """Compute pos - pos."""
    return Pos(single(a.x - b.x), single(a.y - b.y), single(a.z - b.z))


def pos_negate(a: Value) -> Value:
    """Compute -pos."""
    return Pos(-a.x, -a.y, -a.z)


def pos_scale(a: Value, k: float) -> Value:
    """Compute pos * num."""
    return Pos(single(a.x * k), single(a.y * k), single(a.z * k))


def pos_divide(a: Value, k: float) -> Value:
    """Compute pos / num. ERR_DIVZERO."""
    return Pos(single(a.x / k), single(a.y / k), single(a.z / k))


def pos_cross(a: Value, b: Value) -> Value:
    """Compute pos * pos, the cross product [S4 overview 4-26]."""
    return Pos(
        single(a.y * b.z - a.z * b.y), single(a.z * b.x - a.x * b.z), single(a.x * b.y - a.y * b.x)
    )


def orient_multiply(a: Value, b: Value) -> Value:
    """Compute orient * orient: first b, then a in a's frame."""
    return Orient(
        single(a.q1 * b.q1 - a.q2 * b.q2 - a.q3 * b.q3 - a.q4 * b.q4),
        single(a.q1 * b.q2 + a.q2 * b.q1 + a.q3 * b.q4 - a.q4 * b.q3),
        single(a.q1 * b.q3 - a.q2 * b.q4 + a.q3 * b.q1 + a.q4 * b.q2),
        single(a.q1 * b.q4 + a.q2 * b.q3 - a.q3 * b.q2 + a.q4 * b.q1),
    )


def _at(text: str, position: float) -> int:
    """Return a position as an index from 0.

    ERR_OUTOFBND: outside the text [S4 StrFind].
    """
    place = int(position)
    if place != position or not 1 <= place <= len(text):
        raise RapidError("ERR_OUTOFBND")
    return place - 1


def part_of(text: str, position: float, length: float) -> str:
    """StrPart: return a part, or raise ERR_OUTOFBND [S4 StrPart]."""
    start = position - 1
    end = start + length
    if start.__class__ is end.__class__ is int and 0 <= start <= end <= len(text) > start:
        return text[start:end]
    start = _at(text, position)
    if length != int(length) or length < 0 or start + length > len(text):
        raise RapidError("ERR_OUTOFBND")
    return text[start : start + int(length)]


def _search_at(text: str, position: float) -> int:
    """Return the start of a search as an index from 0.

    It may be just after the text (`Switches.find_past_end`).
    """
    return len(text) if position == len(text) + 1 else _at(text, position)


def find_text(text: str, position: float, pattern: str) -> int:
    """StrMatch, and StrFind for one character.

    Returns length + 1 without a match.
    """
    start = position - 1
    if start.__class__ is not int or not 0 <= start < len(text):
        start = _search_at(text, position)
    result = text.find(pattern, start)
    return result + 1 if result >= 0 else len(text) + 1


def find_set(text: str, position: float, characters: str) -> int:
    """StrFind: return the first position with one of the characters."""
    for place in range(_search_at(text, position), len(text)):
        if text[place] in characters:
            return place + 1
    return len(text) + 1


# -- loops ---------------------------------------------------------------------------------------


def _as_int(value: float) -> float:
    if value.__class__ is float and abs(value) <= EXACT and value == int(value):
        return int(value)
    return value


def count_steps(start: float, end: float, step: float | None) -> Iterable[float]:
    """Return the values of a FOR variable [K §4.15].

    There is at least one pass. Without STEP the loop may count down.
    """
    start = _as_int(start)
    if step is None:
        step = 1 if start <= end else -1
    step = _as_int(step)
    if start.__class__ is int and step.__class__ is int and end == end and step:
        if (end - start) * step <= 0:
            return (start,)
        last = int(end // 1) if step > 0 else -int(-end // 1)
        return range(start, last + (1 if step > 0 else -1), step)
    return _float_steps(start, end, step, first=True)


def count_tested(start: float, end: float, step: float | None) -> Iterable[float]:
    """Return the values of a FOR that tests the first pass (dialect)."""
    step = 1 if step is None else step
    return _float_steps(_as_int(start), end, _as_int(step), first=False)


def _float_steps(start: float, end: float, step: float, *, first: bool) -> Iterator[float]:
    value = start
    low, high = min(start, end), max(start, end)
    if first:
        yield value
        value = single(value + step)
        while low <= value <= high:
            yield value
            value = single(value + step)
    else:
        while value <= end if step >= 0 else value >= end:
            yield value
            value = single(value + step)


# -- references ----------------------------------------------------------------------------------


class GlobalRef(Ref):
    """A reference to module data by name."""

    __slots__ = ("key", "space")

    def __init__(
        self, space: dict[str, Value], key: str, type: Type, dims: tuple[int, ...], name: str
    ) -> None:
        super().__init__(type, dims, name)
        self.space = space
        self.key = key

    @property
    def v(self) -> Value:
        """The value."""
        return self.space[self.key]

    @v.setter
    def v(self, value: Value) -> None:
        self.space[self.key] = value


class ItemRef(Ref):
    """A reference to an array element.

    The constructor raises ERR_OUTOFBND, not the later access.
    """

    __slots__ = ("array", "index")

    def __init__(
        self,
        array: dict[int, Value],
        index: int,
        type: Type,
        name: str,
        cell: PersistentCell | None = None,
    ) -> None:
        super().__init__(type, (), name, complete=False, cell=cell)
        array[index]
        self.array = array
        self.index = index

    @property
    def v(self) -> Value:
        """The value."""
        return self.array[self.index]

    @v.setter
    def v(self, value: Value) -> None:
        self.array[self.index] = value


class MemberRef(Ref):
    """A reference to a record component."""

    __slots__ = ("attribute", "record")

    def __init__(
        self,
        record: Record,
        attribute: str,
        type: Type,
        name: str,
        cell: PersistentCell | None = None,
    ) -> None:
        super().__init__(type, (), name, complete=False, cell=cell)
        self.record = record
        self.attribute = attribute

    @property
    def v(self) -> Value:
        """The value."""
        return getattr(self.record, self.attribute)

    @v.setter
    def v(self, value: Value) -> None:
        setattr(self.record, self.attribute, value)


def as_variable(ref: Value) -> Value:
    """Return an INOUT parameter as VAR.

    ERR_ARGNOTVAR: it is a PERS [K §5.1].
    """
    if ref is not None and ref.cell is not None:
        raise RapidError("ERR_ARGNOTVAR")
    return ref


def as_persistent(ref: Value) -> Value:
    """Return an INOUT parameter as PERS.

    ERR_ARGNOTPER: it is a variable [K §5.1].
    """
    if ref is not None and ref.cell is None:
        raise RapidError("ERR_ARGNOTPER")
    return ref


def present(value: Value) -> Value:
    """Return the value of an optional parameter.

    ERR_NOTPRES: it is absent [K §5.1].
    """
    if value is None:
        raise RapidError("ERR_NOTPRES")
    return value


def array_size(array: Value, number: float) -> int:
    """Return Dim(array, number) [K §11]."""
    if array.__class__ is not dict:
        raise RapidError("ERR_NOTARR")
    if number not in (1, 2, 3):
        raise RapidError("ERR_ILLDIM")
    for _ in range(int(number) - 1):
        array = array[1]
        if array.__class__ is not dict:
            raise RapidError("ERR_ILLDIM")
    return len(array)


def only_one(value: Value, *others: Value) -> Value:
    """Return a conditional argument if its alternatives are absent.

    ERR_ARGDUPCND: two are present [K §3.10].
    """
    if value is not None and any(other is not None for other in others):
        raise RapidError("ERR_ARGDUPCND")
    return value


def part(
    value: Value,
    type: Type,
    name: str,
    cell: PersistentCell | None = None,
    dims: tuple[int, ...] = (),
) -> ValueRef:
    """Return a reference to a record or array inside a datum."""
    box = ValueRef(value, type, dims, name)
    box.whole = False
    box.cell = cell
    return box


@dataclass(slots=True)
class LateArgument:
    """An argument whose parameter is known only at the call."""

    name: str | None
    read: Callable[[], Value] | None
    """By value; None for a switch."""
    refer: Callable[[], Value] | None
    type: Type | None = None
    itself: Callable[[], Value] | None = None
    """The object itself, for VAR parameters of record, array and non-value types."""
    required: bool = False
    """Named without a backslash."""

    @property
    def kind(self) -> str:
        """Kind of the argument, as in a call of a known routine."""
        if self.name is None or self.required:
            return "required"
        return "switch" if self.read is None else "optional"


@dataclass(slots=True)
class Condition:
    """The condition of WaitUntil, evaluated repeatedly."""

    look: Callable[[], bool]
    watched: tuple[WaitSet, ...]
    """Persistents and signals in it."""
    cost: int
    reads: Callable[[], tuple[tuple[str, Value], ...]]
    """Names in it, and what they are worth now."""
    signals: Callable[[], tuple[SignalCondition, ...]]
    """Comparisons of signals, with which it may hold."""
    calls: bool = False
    """It calls a function of the program."""

    def __call__(self) -> bool:
        return self.look()


NAMESPACE: dict[str, Callable[..., Value]] = {
    "FAIL": fail,
    "RND": single,
    "DIV": div,
    "MOD": mod,
    "CAT": concat,
    "PADD": pos_add,
    "PSUB": pos_subtract,
    "PNEG": pos_negate,
    "PMUL": pos_scale,
    "PDIV": pos_divide,
    "PCROSS": pos_cross,
    "QMUL": orient_multiply,
    "STEPS": count_steps,
    "PARTOF": part_of,
    "FIND1": find_text,
    "FINDSET": find_set,
    "ITEM": ItemRef,
    "MEMBER": MemberRef,
    "ASVAR": as_variable,
    "ASPERS": as_persistent,
    "PRESENT": present,
    "DIM": array_size,
    "COPY": copy_value,
    "ASSIGN": assign_array,
    "ONLY_ONE": only_one,
    "BOX": ValueRef,
    "PART": part,
    "LATE": LateArgument,
    "CONDITION": Condition,
    "AWAITED": SignalCondition,
}
"""Names that compiled code finds among its globals."""
