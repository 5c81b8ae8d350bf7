"""RAPID values as Python objects: types, records, arrays, references.

num and dnum are float, or int when known whole; bool and string are Python's. A record is an
instance of a slotted class, made once per record type; an array is a dict from 1. A variable of
record or array type keeps one object: assignment writes into it, so that passing the object is
passing by reference.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from keyword import iskeyword
from numbers import Real
from typing import Any, Literal, TypeAlias

from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.numbers import MAX_STRING, is_single, single
from rapidgen.runtime.errors import RapidError

Value: TypeAlias = Any
"""A RAPID value: float, int, bool, str, a record, an array, or the object of a non-value type."""
Kind: TypeAlias = Literal["num", "dnum", "bool", "string", "record", "nonvalue", "semivalue"]
ATOMIC = frozenset({"num", "dnum", "bool", "string"})
"""Kinds of values without parts."""


@dataclass(frozen=True, slots=True, eq=False)
class Type:
    """A RAPID type, aliases resolved: an `errnum` is a `num` (K §2.17)."""

    name: str
    """Lower case; of an alias its base."""
    kind: Kind
    components: tuple[tuple[str, "Type"], ...] = ()
    """Of a record, names in lower case."""
    make: Callable[[], Value] | None = None
    """Makes a fresh datum with its initial value (record, nonvalue, semivalue)."""

    def default(self) -> Value:
        """Return the value of an uninitialised datum [K §2.22]."""
        if self.make is not None:
            return self.make()
        return {"num": 0, "dnum": 0, "bool": False, "string": ""}[self.kind]

    def component(self, name: str) -> "Type | None":
        """Return the type of a component, by lower-case name."""
        for own, kind in self.components:
            if own == name:
                return kind
        return None

    @property
    def is_value(self) -> bool:
        """True if it can be assigned and compared [K §2.16]."""
        if self.kind == "record":
            return all(t.is_value for _, t in self.components)
        return self.kind not in ("nonvalue", "semivalue")


class Record:
    """Base of all record classes; components are attributes.

    See `attribute` for their names.
    """

    __slots__ = ()
    fields: tuple[str, ...] = ()
    """Attribute names in order."""
    rapid_type: Type

    copy: Callable[[], Value]
    """A deep copy."""
    assign: Callable[[Value], None]
    """Takes over every component of another instance, by value."""

    def values(self) -> tuple[Value, ...]:
        """Return the components in order."""
        return tuple(getattr(self, name) for name in self.fields)

    def __repr__(self) -> str:
        inside = ", ".join(f"{n}={getattr(self, n)!r}" for n in self.fields)
        return f"{type(self).__name__}({inside})"


_TAKEN = frozenset({"fields", "rapid_type", "copy", "assign", "values"})


def attribute(component: str) -> str:
    """Return the Python attribute of a record's component."""
    name = component.lower()
    return name + "_" if iskeyword(name) or name in _TAKEN else name


NUM = Type("num", "num")
DNUM = Type("dnum", "dnum")
BOOL = Type("bool", "bool")
STRING = Type("string", "string")


def make_record(name: str, components: Sequence[tuple[str, Type]]) -> type[Value]:
    """Return a record class with the given components.

    Its `Type` is the class attribute `rapid_type`. The constructor takes components by position;
    missing ones get their default value.
    """
    fields = tuple(attribute(component) for component, _ in components)
    kinds = [kind for _, kind in components]
    inner = {f for f, t in zip(fields, kinds, strict=True) if t.kind == "record"}
    start = [f"T[{i}].make()" if t.make else repr(t.default()) for i, t in enumerate(kinds)]
    lines = [
        "class cls(Record):",
        f"    __slots__ = fields = {fields!r}",
        "    __hash__ = None",
        f"    def __init__(self, {', '.join(f'a{i}=None' for i in range(len(fields)))}):",
        "        pass",
        *(f"        self.{f} = {start[i]} if a{i} is None else a{i}" for i, f in enumerate(fields)),
        "    def copy(self):",
        "        n = new(cls)",
        *(f"        n.{f} = self.{f}{'.copy()' if f in inner else ''}" for f in fields),
        "        return n",
        "    def assign(self, o):",
        "        pass",
        *(
            f"        self.{f}.assign(o.{f})" if f in inner else f"        self.{f} = o.{f}"
            for f in fields
        ),
        "    def __eq__(self, o):",
        f"        return {' and '.join(f'self.{f} == o.{f}' for f in fields) or True}",
        "    def __ne__(self, o):",
        f"        return {' or '.join(f'self.{f} != o.{f}' for f in fields) or False}",
    ]
    scope: dict[str, Value] = {"Record": Record, "new": object.__new__, "T": kinds}
    exec("\n".join(lines), scope)
    cls: type[Value] = scope["cls"]
    cls.__module__, cls.__name__, cls.__qualname__ = __name__, name, name
    named = tuple((c.lower(), t) for (c, t) in components)
    cls.rapid_type = Type(name.lower(), "record", named, cls)
    return cls


# -- predefined records: classes of what rapid/builtins/types.rapid declares ---------------------


def _predefined(name: str) -> type[Value]:
    declared = signatures.records()[name.lower()]
    cls = make_record(name, [(c, TYPES[signatures.alias(t) or t]) for t, c in declared.components])
    TYPES[name.lower()] = cls.rapid_type
    return cls


TYPES: dict[str, Type] = {"num": NUM, "dnum": DNUM, "bool": BOOL, "string": STRING}
"""Predefined types by lower-case name. Aliases of num and others are in the signature data."""

Pos = _predefined("Pos")
Orient = _predefined("Orient")
Pose = _predefined("Pose")
ConfData = _predefined("ConfData")
RobJoint = _predefined("RobJoint")
ExtJoint = _predefined("ExtJoint")
JointTarget = _predefined("JointTarget")
RobTarget = _predefined("RobTarget")
SpeedData = _predefined("SpeedData")
ZoneData = _predefined("ZoneData")
InposData = _predefined("InposData")
StopPointData = _predefined("StopPointData")
LoadData = _predefined("LoadData")
ToolData = _predefined("ToolData")
WobjData = _predefined("WobjData")
ProgDisp = _predefined("ProgDisp")
EgmMinMax = _predefined("Egm_MinMax")
Tasks = _predefined("Tasks")
ListItem = _predefined("ListItem")
RmqHeader = _predefined("RmqHeader")


def register_type(name: str, make: Callable[[], Value], kind: Kind = "nonvalue") -> Type:
    """Register the Python class of a type without values.

    An example is `socketdev`.
    """
    saved = Type(name.lower(), kind, (), make)
    TYPES[name.lower()] = saved
    return saved


# -- arrays --------------------------------------------------------------------------------------


def make_array(dims: Sequence[int], element: Callable[[], Value]) -> dict[int, Value]:
    """Return an array of the given sizes, `{1: ..}`, nested by dimension."""
    if len(dims) == 1:
        return {i: element() for i in range(1, dims[0] + 1)}
    return {i: make_array(dims[1:], element) for i in range(1, dims[0] + 1)}


def dimensions(value: Value, degree: int = 3) -> tuple[int, ...]:
    """Return the sizes of an array value, `()` for other values."""
    sizes = []
    while value.__class__ is dict and degree:
        sizes.append(len(value))
        value, degree = value[1], degree - 1
    return tuple(sizes)


def copy_value(value: Value) -> Value:
    """Return a copy: records and arrays deeply, atoms as they are."""
    if value.__class__ is dict:
        first = value[1]
        if first.__class__ is dict or isinstance(first, Record):
            return {i: copy_value(v) for i, v in value.items()}
        return value.copy()
    return value.copy() if isinstance(value, Record) else value


def assign_array(target: dict[int, Value], value: dict[int, Value]) -> None:
    """Write every element of `value` into `target`.

    The elements of `target` keep their identity.
    """
    if target is value:
        return
    if len(target) != len(value):
        raise RapidError("ERR_NOTEQDIM")
    first = target[1]
    if first.__class__ is dict:
        for i, part in target.items():
            assign_array(part, value[i])
    elif isinstance(first, Record):
        for i, record in target.items():
            record.assign(value[i])
    else:
        target.update(value)


# -- values that come from outside ---------------------------------------------------------------

_WANTED = {
    "num": "a number up to 3.4E+38",
    "dnum": "a number",
    "bool": "True or False",
    "string": f"a text of at most {MAX_STRING} characters of Latin-1",
}


def misfit(value: Value, type: Type, dims: tuple[int, ...] = ()) -> str:
    """Return the expected value if `value` does not fit a datum.

    The value comes from Python tests. "" means that it fits.
    """
    if dims:
        size, *inner = dims
        if value.__class__ is not dict or list(value) != list(range(1, size + 1)):
            elements = "{1: ...}" if size == 1 else f"{{1: ..., {size}: ...}}"
            return f"an array of {size}, {elements}, not {_short(value)}"
        return next((w for v in value.values() if (w := misfit(v, type, tuple(inner)))), "")
    if type.kind == "record":
        if isinstance(value, Record) and value.rapid_type is type:
            parts = zip(value.values(), type.components, strict=True)
            return next((w for v, (_, kind) in parts if (w := misfit(v, kind))), "")
        fields = ", ".join(name for name, _ in type.components)
        return f"a {type.name} ({fields}), not {_short(value)}: change a copy() of what is there"
    if not type.is_value:
        return f"nothing: the program alone handles a {type.name}"
    return "" if _fits(value, type.kind) else f"{_WANTED[type.kind]}, not {_short(value)}"


def _fits(value: Value, kind: Kind) -> bool:
    if kind == "string":
        text = isinstance(value, str) and len(value) <= MAX_STRING
        return text and max(map(ord, value), default=0) <= 0xFF
    if not isinstance(value, Real):
        return False
    if kind == "bool":
        return value in (0, 1)
    return kind == "dnum" or not math.isfinite(value) or is_single(float(value))


def _short(value: Value) -> str:
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


# -- references and cells ------------------------------------------------------------------------


class PersistentCell(WaitSet):
    """A PERS: its value and its watchers, the list `w`.

    With `variable` it is a VAR that all tasks share, of a shared module [K §14.2].
    """

    __slots__ = ("_variable", "dims", "name", "type", "v")

    def __init__(
        self,
        name: str,
        type: Type,
        dims: tuple[int, ...],
        value: Value,
        *,
        variable: bool = False,
    ) -> None:
        super().__init__()
        self._variable = variable
        self.name = name
        self.type = type
        self.dims = dims
        self.v = value

    @property
    def cell(self) -> "PersistentCell | None":
        """The cell itself: built-ins accept a cell as a `Ref`.

        None denotes a variable.
        """
        return None if self._variable else self

    @property
    def whole(self) -> bool:
        """True: a cell is a whole PERS."""
        return True

    def get(self) -> Value:
        """Return the current value itself, not a copy."""
        return self.v

    def set(self, value: Value) -> None:
        """Store a copy of a value, and wake IPers, WaitUntil and waiters."""
        store(self, value)
        if self.w:
            self.notify()


class Ref:
    """A datum that a built-in or a VAR parameter may read and write.

    `v` reads and writes without rounding. `get()` and `set()` are for built-ins: `set` rounds a
    num, copies records and arrays, limits a string and wakes the watchers of a PERS.
    """

    __slots__ = ("cell", "dims", "name", "type", "whole")
    v: Value

    def __init__(
        self,
        type: Type,
        dims: tuple[int, ...] = (),
        name: str = "",
        *,
        complete: bool = True,
        cell: PersistentCell | None = None,
    ) -> None:
        self.type = type
        self.dims = dims
        self.name = name
        """Name of the whole datum at its origin, for ArgName."""
        self.whole = complete
        """False for an element or a component."""
        self.cell = cell
        """The cell when it is (part of) a PERS."""

    def get(self) -> Value:
        """Return the current value itself, not a copy."""
        return self.v

    def set(self, value: Value) -> None:
        """Store a value."""
        store(self, value)
        if self.cell is not None and self.cell.w:
            self.cell.notify()


class ValueRef(Ref):
    """A Ref with its own value: a routine's variable passed by reference."""

    __slots__ = ("v",)

    def __init__(
        self, value: Value, type: Type, dims: tuple[int, ...] = (), name: str = ""
    ) -> None:
        super().__init__(type, dims, name)
        self.v = value


def store(target: "Ref | PersistentCell", value: Value) -> None:
    """Store a value of a built-in: rounded, limited, copied."""
    kind = target.type.kind
    if target.dims:
        if len(target.dims) > 1 or target.type.kind != "num":
            assign_array(target.v, value)
        else:
            assign_array(target.v, {i: single(v) for i, v in value.items()})
    elif kind == "num":
        target.v = single(value)
    elif kind == "string":
        if len(value) > MAX_STRING:
            raise RapidError("ERR_STRTOOLNG")
        target.v = value
    elif kind == "record":
        target.v.assign(value)
    else:
        target.v = value
