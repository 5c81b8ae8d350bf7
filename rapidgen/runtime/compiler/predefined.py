"""Predefined types, data and routines as symbols, from the signature data."""

from functools import cache

from rapidgen.rapid.builtins import signatures
from rapidgen.runtime.compiler.evaluate import build
from rapidgen.runtime.compiler.symbols import Data, Routine, formal
from rapidgen.runtime.registry import bound
from rapidgen.runtime.values import TYPES, Type, Value, make_record, register_type


class Opaque:
    """A datum of a predefined type about which nothing more is known here."""

    __slots__ = ("type", "value")

    def __init__(self, type: str) -> None:
        self.type = type
        self.value: Value = None


def unknown_type(name: str) -> Type:
    """A type that nothing at hand declares: data of it are kept, and only handed on."""
    return Type(name.lower(), "nonvalue", (), lambda: Opaque(name))


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
    result: Type | None = find_type(name.lower())
    if result is None:
        raise LookupError(f"the signature data use an unknown type {name}")
    return result


@cache
def datum(key: str) -> Data | None:
    """How a predefined datum is kept, by lower-case name: an atomic constant in the code."""
    result = signatures.constant(key)
    if result is None:
        return None
    kind = _needed(result.type)
    if result.kind == "PERS":
        return Data(result.name, "PERS", kind, (), "cell", f"p_{key}")
    readonly = result.readonly
    if readonly and kind.kind != "record":
        return Data(
            result.name, "CONST", kind, (), "inline", "", value=value(key), readonly=readonly
        )
    return Data(result.name, result.kind, kind, (), "global", f"p_{key}", readonly=readonly)


def value(key: str) -> Value:
    """The value that a predefined datum has at first."""
    result = signatures.predefined()[key]
    return build(_needed(result.type), result.value)


@cache
def routine(name: str) -> Routine | None:
    """A built-in routine by lower-case name; `missing` when nothing is bound to it."""
    signature = signatures.routine(name)
    if signature is None:
        return None
    parameters = tuple(
        formal(p, None if p.type.lower() in ("anytype", "switch") else _needed(p.type))
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
        missing=binding is None and name not in signatures.marked("inline"),
        lazy=signature.marks.get("lazy", ()),
    )
