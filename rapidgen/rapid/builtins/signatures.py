"""Every built-in routine, type, constant and datum, as data.

`builtins/*.rapid` hold them in RAPID's own declaration syntax and this module reads them with
the parser, on demand and once. Sources: 3HAC050917 (RobotWare 6) for the arguments, [K §11-12]
for what belongs to the language, public code for names.

Marks behind a header: `!since 6.10`, `!until 7.0` (RobotWare versions that have it) and `!open`
(the name is certain, its arguments are not known well enough to check). Alternatives of
*required* parameters (`VAR signaldi Signal | PERS bool PersBool`) exist in built-ins only, and so
does an optional one in place of a required one (`string Message | \\string MsgArray{*}`).
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Final, Literal

from rapidgen.rapid.syntax import lexer
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    AliasDeclaration,
    BoolLiteral,
    DataDeclaration,
    DataKind,
    Expression,
    NumberLiteral,
    Parameter,
    RecordDeclaration,
    StringLiteral,
    Unary,
)
from rapidgen.rapid.syntax.parser import ModuleParser

TypeClass = Literal["value", "nonvalue", "semivalue"]
Version = tuple[int, int]
Value = float | bool | str | tuple["Value", ...] | None

_ROUTINE_FILES: Final = ("communication", "io", "motion", "options", "tasks", "values")
_HEADER: Final = re.compile(
    r"^(PROC|FUNC (\w+)) (\w+)(\(.*?\))(?:[ ]+!([^\n]*))?$", re.MULTILINE | re.DOTALL
)
_CLASSES: Final = re.compile(r"^!(value|nonvalue|semivalue) (.*)$", re.MULTILINE)
_NAMES: Final = re.compile(r"^!(procedures|functions|types|values) (.*)$", re.MULTILINE)
_MARK: Final = re.compile(r"(since|until) (\d+)\.(\d+)|(open)")


@dataclass(frozen=True, slots=True)
class Signature:
    """A built-in routine.

    `parameters` are in the order of the call. Of parameters with the same `group` >= 0 at most
    one has an argument, and exactly one when they are required (then it is the one whose mode
    and type the argument fits). `checked` is False where the arguments are not known.
    """

    name: str
    kind: Literal["PROC", "FUNC"]
    type: str | None
    parameters: tuple[Parameter, ...]
    since: Version | None = None
    until: Version | None = None
    checked: bool = True


@dataclass(frozen=True, slots=True)
class Record:
    """A predefined record: (type, name) of each component in order."""

    name: str
    components: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Predefined:
    """A predefined constant, persistent or variable.

    `value` is a float (int when whole), bool, str or nested tuples; None = the type's default.
    """

    name: str
    kind: DataKind
    type: str
    value: Value


def _read(name: str) -> str:
    return (files("rapidgen.rapid") / "builtins" / f"{name}.rapid").read_text("utf-8")


@cache
def _headers() -> dict[str, tuple[str, str | None, str, str | None]]:
    """Lower-case name to (name, type, parameters as text, marks)."""
    found: dict[str, tuple[str, str | None, str, str | None]] = {}
    for file in _ROUTINE_FILES:
        for _, type_name, name, parameters, marks in _HEADER.findall(_read(file)):
            found[name.lower()] = (name, type_name or None, parameters, marks or None)
    return found


@cache
def routine(name: str) -> Signature | None:
    """The built-in PROC or FUNC of that name (any case), or None."""
    header = _headers().get(name.lower())
    if header is None:
        return None
    proper, type_name, text, marks = header
    tokens = lexer.tokenize(text, f"<{proper}>", "utf-8", radix=False)
    parameters, _ = ModuleParser(tokens, builtin=True).parameters(1)
    since: Version | None = None
    until: Version | None = None
    checked = True
    for word, major, minor, is_open in _MARK.findall(marks or ""):
        if is_open:
            checked = False
        elif word == "since":
            since = int(major), int(minor)
        else:
            until = int(major), int(minor)
    kind: Literal["PROC", "FUNC"] = "FUNC" if type_name else "PROC"
    return Signature(proper, kind, type_name, tuple(parameters), since, until, checked)


@cache
def routines() -> Mapping[str, Signature]:
    """All built-in routines by lower-case name."""
    found = {name: routine(name) for name in _headers()}
    return MappingProxyType({name: s for name, s in found.items() if s is not None})


def routine_names() -> tuple[str, ...]:
    """Names of all built-in routines, without reading their parameters."""
    return tuple(header[0] for header in _headers().values())


@cache
def option_names(kind: Literal["procedures", "functions", "types", "values"]) -> frozenset[str]:
    """Lower-case names that options and add-ins have; nothing more is known of them."""
    found = _NAMES.findall(_read("names"))
    return frozenset(name.lower() for of, names in found if of == kind for name in names.split())


@dataclass(frozen=True, slots=True)
class _Types:
    classes: Mapping[str, TypeClass]
    names: Mapping[str, str]
    aliases: Mapping[str, str]
    records: Mapping[str, Record]


def _declarations(
    text: str,
) -> list[RecordDeclaration | AliasDeclaration | DataDeclaration]:
    tokens = lexer.tokenize(
        f"MODULE builtins\n{text}\nENDMODULE", "<builtins>", "utf-8", radix=False
    )
    _, _, found, _ = ModuleParser(tokens, builtin=True).module()
    return [
        d for d in found if isinstance(d, RecordDeclaration | AliasDeclaration | DataDeclaration)
    ]


@cache
def _types() -> _Types:
    text = _read("types")
    classes: dict[str, TypeClass] = {}
    names: dict[str, str] = {}
    aliases: dict[str, str] = {}
    records: dict[str, Record] = {}
    for kind, listed in _CLASSES.findall(text):
        for name in listed.split():
            classes[name] = kind
            names[name] = name
    for declaration in _declarations(text):
        key = declaration.name.lower()
        names[key] = declaration.name
        classes[key] = "value"
        if isinstance(declaration, AliasDeclaration):
            aliases[key] = declaration.type
        elif isinstance(declaration, RecordDeclaration):
            components = tuple((c.type, c.name) for c in declaration.components)
            records[key] = Record(declaration.name, components)
    return _Types(classes, names, aliases, records)


def type_class(name: str) -> TypeClass | None:
    """Value class of a predefined type (any case), or None when there is no such type."""
    return _types().classes.get(name.lower())


def type_names() -> tuple[str, ...]:
    """Names of all predefined types."""
    return tuple(_types().names.values())


def alias(name: str) -> str | None:
    """Base type of a predefined alias (`errnum` -> `num`), or None."""
    return _types().aliases.get(name.lower())


def aliases() -> Mapping[str, str]:
    """All predefined aliases: lower-case name to base type."""
    return _types().aliases


def record(name: str) -> Record | None:
    """The predefined record of that name (any case), or None."""
    return _types().records.get(name.lower())


def records() -> Mapping[str, Record]:
    """All predefined records by lower-case name."""
    return _types().records


@cache
def predefined() -> Mapping[str, Predefined]:
    """All predefined constants, persistents and variables by lower-case name."""
    found: dict[str, Predefined] = {}
    for declaration in _declarations(_read("constants") + _read("data")):
        if isinstance(declaration, DataDeclaration):
            value = None if declaration.initial is None else _value(declaration.initial)
            found[declaration.name.lower()] = Predefined(
                declaration.name, declaration.kind, declaration.type, value
            )
    return MappingProxyType(found)


def constant(name: str) -> Predefined | None:
    """The predefined constant, persistent or variable of that name (any case), or None."""
    return predefined().get(name.lower())


def _value(node: Expression) -> Value:
    if isinstance(node, NumberLiteral | BoolLiteral | StringLiteral):
        return node.value
    if isinstance(node, Unary) and isinstance(node.operand, NumberLiteral):
        return -node.operand.value
    if isinstance(node, Aggregate):
        return tuple(_value(member) for member in node.members)
    raise AssertionError(f"builtins hold literals only, not {type(node).__name__}")
