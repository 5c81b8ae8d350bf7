"""Predefined types, data and routines as symbols, from the signature data."""

from functools import cache

from rapidgen.rapid.builtins import signatures
from rapidgen.runtime.compiler.symbols import Data, Parameter, Routine
from rapidgen.runtime.registry import bound
from rapidgen.runtime.values import TYPES, Type, Value, make_record, register_type, single

COMPILED = frozenset(
    {
        "present",
        "dim",
        "abs",
        "strlen",
        "strpart",
        "strfind",
        "strmatch",
        "ispers",
        "isvar",
        "argname",
    }
)
"""Built-ins that the compiler turns into code: see inline.py."""


class Opaque:
    """A datum of a predefined type about which nothing more is known here."""

    __slots__ = ("type", "value")

    def __init__(self, type: str) -> None:
        self.type = type
        self.value: Value = None


@cache
def find_type(name: str) -> Type | None:
    """A predefined type by lower-case name, aliases resolved."""
    base = signatures.alias(name)
    if base is not None:
        return _needed(base)
    bound("")  # loading the built-ins registers their types
    known = TYPES.get(name)
    if known is not None:
        return known
    record = signatures.record(name)
    if record is not None:
        components = [(c, _needed(t)) for t, c in record.components]
        made: Type = make_record(record.name, components).rapid_type
        TYPES[name] = made
        return made
    kind = signatures.type_class(name)
    if kind is None:
        return None
    return register_type(
        name, lambda: Opaque(name), "semivalue" if kind == "semivalue" else "nonvalue"
    )


def _needed(name: str) -> Type:
    found: Type | None = find_type(name.lower())
    if found is None:
        raise LookupError(f"the signature data use an unknown type {name}")
    return found


def build(kind: Type, value: Value) -> Value:
    """A value of the signature data (nested tuples) as a RAPID value."""
    if value is None:
        return kind.default()
    if isinstance(value, tuple):
        assert kind.make is not None
        return kind.make(*[build(t, v) for (_, t), v in zip(kind.components, value, strict=True)])
    if kind.kind == "num":
        return single(value)
    return value


@cache
def constant(name: str) -> Data | None:
    """A predefined constant that stands in the code, by lower-case name."""
    datum = signatures.constant(name)
    if datum is None or datum.kind != "CONST":
        return None
    kind = _needed(datum.type)
    value = build(kind, datum.value)
    if kind.kind == "record":
        return None
    return Data(datum.name, "CONST", kind, (), "inline", "", value=value, readonly=True)


@cache
def routine(name: str) -> Routine | None:
    """A built-in routine by lower-case name; `missing` when nothing is bound to it."""
    signature = signatures.routine(name)
    if signature is None:
        return None
    parameters = tuple(
        Parameter(
            p.name,
            p.mode,
            None if p.type.lower() in ("anytype", "switch") else _needed(p.type),
            p.type,
            p.dimensions,
            p.optional,
            p.group,
            p.type.lower() == "switch",
        )
        for p in signature.parameters
    )
    binding = bound(name)
    return Routine(
        signature.name,
        signature.kind,
        _needed(signature.type) if signature.type else None,
        parameters,
        f"B_{name}",
        builtin=binding,
        missing=binding is None and name not in COMPILED,
        type_name=signature.type or "",
    )
