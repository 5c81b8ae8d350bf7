"""Every built-in routine, type, constant and datum, as data.

`builtins/*.rapid` contain them in RAPID's declaration syntax; this module reads them with the
parser, on demand and once. Sources: 3HAC050917 (RobotWare 6) for the arguments, [K §11-12] for
parts of the language, public code for names.

Marks after a header add to its parameters:

    !since 6.10  !until 7.0   RobotWare versions that have it: from the first, before the second
    !came 7.0 UTF8Encoding    that version added the argument
    !went 7.0 ASCII           that version removed the argument
    !open                     the name is certain, the arguments are too uncertain for a check
    !ends                     it never returns
    !steps                    it changes the number in its first argument in place
    !inline                   the compiler emits code for it: small, or about the program itself
    !inplace                  it uses its arguments in place, without references
    !whole                    it returns a whole number from 0
    !lazy Cond                it evaluates this argument repeatedly
    !index FromIndex          the index of a byte in raw data

Lines next to declarations: `!readonly ERRNO` names data that a program cannot write, `!writable
vmax` constants that it can. `!newer accdata finepramp` names the last components of a record, which
values of older releases do not have. `!partly partdata` names a record with substitute names for
components that are not public. Only built-ins have alternatives of *required* parameters (`VAR
signaldi Signal | PERS bool PersBool`), or an optional one in place of a required one (`string
Message | \\string MsgArray{*}`).
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
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
Value = float | bool | str | tuple["Value", ...]
"""A RAPID value that is known before the run: records and arrays are tuples."""

_WITHOUT_ROUTINES: Final = frozenset(("constants", "data", "names", "types"))
_OF_OPTIONS: Final = frozenset(
    ("arc", "bullseye", "options", "production", "smartgripper", "touch", "zones")
)
"""Files of what only some controllers have."""
_FOLDER: Final = Path(__file__).parent
_HEADER: Final = re.compile(
    r"^(PROC|FUNC (\w+)) (\w+)(\(.*?\))(?:[ ]+!([^\n]*))?$", re.MULTILINE | re.DOTALL
)
_CLASSES: Final = re.compile(r"^!(value|nonvalue|semivalue) (.*)$", re.MULTILINE)
_DECLARATION: Final = re.compile(
    r"^(?:RECORD\b.*?^ENDRECORD$|(?:ALIAS|CONST|PERS|VAR)\b[^;]*;|!(?:\w+value|partly) [^\n]*$)",
    re.MULTILINE | re.DOTALL,
)
_NAMES: Final = re.compile(r"^!(procedures|functions|types|values) (.*)$", re.MULTILINE)
_MARKS: Final = frozenset(
    (
        *("since", "until", "came", "went", "open", "ends", "steps", "inline", "inplace", "whole"),
        *("lazy", "index"),
    )
)
_DECLARED: Final = re.compile(r"(?:PROC|FUNC \w+|RECORD|ALIAS \w+|(?:CONST|PERS|VAR) \w+) (\w+)")
_READ_ONLY: Final = re.compile(r"^!readonly (.*)$", re.MULTILINE)
_WRITABLE: Final = re.compile(r"^!writable (.*)$", re.MULTILINE)
_PARTLY: Final = re.compile(r"^!partly (.*)$", re.MULTILINE)
_NEWER: Final = re.compile(r"^!newer (\w+) (.*)$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Signature:
    """A built-in routine.

    `parameters` are in the order of the call. Of parameters with the same `group` >= 0 at most one
    has an argument, and exactly one if they are required (the one whose mode and type the argument
    fits).
    """

    name: str
    kind: Literal["PROC", "FUNC"]
    type: str | None
    parameters: tuple[Parameter, ...]
    since: Version | None = None
    until: Version | None = None
    marks: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Marks after the header: each mark with the lower-case names after it."""
    everywhere: bool = True
    """True if every controller has it, whatever its release and options."""

    def argument_version(self, marker: Literal["came", "went"], name: str) -> Version | None:
        """Return the RobotWare version of an argument's addition or removal.

        None: it has always existed.
        """
        words = self.marks.get(marker, ())
        return _version(words) if name.lower() in words[1:] else None

    @property
    def checked(self) -> bool:
        """True if its arguments are known."""
        return "open" not in self.marks


@dataclass(frozen=True, slots=True)
class PredefinedRecord:
    """A predefined record: (type, name) of each component in order."""

    name: str
    components: tuple[tuple[str, str], ...]
    newer: int = 0
    """So many of the last components are missing in values that older releases saved."""
    partly: bool = False
    """Some components have names of ours: the real ones are not public."""


@dataclass(frozen=True, slots=True)
class Predefined:
    """A predefined constant, persistent or variable.

    `value` is a number (int if whole), bool, str or nested tuples; None means the type's default.
    """

    name: str
    kind: DataKind
    type: str
    value: Value | None
    readonly: bool
    """No program can write it."""


def _read(name: str) -> str:
    return (_FOLDER / f"{name}.rapid").read_text("utf-8")


@cache
def _themes() -> tuple[str, ...]:
    """Return the files with routines; a file may also have types and data."""
    result = _FOLDER.iterdir()
    names = sorted(file.name for file in result if file.name.endswith(".rapid"))
    return tuple(n for name in names if (n := name.removesuffix(".rapid")) not in _WITHOUT_ROUTINES)


@cache
def _headers() -> dict[str, tuple[str, str | None, str, str | None, bool]]:
    """Return (name, type, parameters, marks, option) by lower-case name.

    Parameters and marks are text; `option` is True for routines of an option.
    """
    result: dict[str, tuple[str, str | None, str, str | None, bool]] = {}
    for file in _themes():
        of_option = file in _OF_OPTIONS
        for _, type_name, name, parameters, marks in _HEADER.findall(_read(file)):
            result[name.lower()] = (name, type_name or None, parameters, marks or None, of_option)
    return result


@cache
def routine(name: str) -> Signature | None:
    """Return the built-in PROC or FUNC of a name (any case), or None."""
    header = _headers().get(name.lower())
    if header is None:
        return None
    proper, type_name, text, marks, of_option = header
    tokens = lexer.tokenize(text, f"<{proper}>", "utf-8", radix=False)
    parameters, _ = ModuleParser(tokens, builtin=True).data.parameters(1)
    known = _marks(marks or "")
    since, until = (_version(known.pop(keyword, ())) for keyword in ("since", "until"))
    kind: Literal["PROC", "FUNC"] = "FUNC" if type_name else "PROC"
    everywhere = not of_option and since is None
    return Signature(proper, kind, type_name, tuple(parameters), since, until, known, everywhere)


def _marks(text: str) -> dict[str, tuple[str, ...]]:
    """Return each mark with the text up to the next one."""
    result: dict[str, tuple[str, ...]] = {}
    last = ""
    for keyword in text.split():
        if keyword in _MARKS:
            last = keyword
            result[keyword] = ()
        else:
            result[last] += (keyword.lower(),)
    return result


def _version(words: Sequence[str]) -> Version | None:
    if not words:
        return None
    major, _, minor = words[0].partition(".")
    return int(major), int(minor)


@cache
def marked(marker: str) -> frozenset[str]:
    """Return lower-case names of built-in routines with a mark."""
    headers = _headers().items()
    return frozenset(name for name, header in headers if marker in _marks(header[3] or ""))


@cache
def routines() -> Mapping[str, Signature]:
    """Return all built-in routines by lower-case name."""
    result = {name: routine(name) for name in _headers()}
    return MappingProxyType({name: s for name, s in result.items() if s is not None})


def routine_names() -> tuple[str, ...]:
    """Return the names of all built-in routines.

    It does not parse their parameters.
    """
    return tuple(header[0] for header in _headers().values())


@cache
def option_names(kind: Literal["procedures", "functions", "types", "values"]) -> frozenset[str]:
    """Return lower-case names of options and add-ins without details."""
    result = _NAMES.findall(_read("names"))
    return frozenset(name.lower() for of, names in result if of == kind for name in names.split())


@dataclass(frozen=True, slots=True)
class _Types:
    classes: Mapping[str, TypeClass]
    names: Mapping[str, str]
    aliases: Mapping[str, str]
    records: Mapping[str, PredefinedRecord]


@cache
def _declared() -> str:
    """Return declarations of types and data in the files of families."""
    return "\n".join(result for name in _themes() for result in _DECLARATION.findall(_read(name)))


def _declarations(text: str) -> list[RecordDeclaration | AliasDeclaration | DataDeclaration]:
    tokens = lexer.tokenize(
        f"MODULE builtins\n{text}\nENDMODULE", "<builtins>", "utf-8", radix=False
    )
    _, _, result, _ = ModuleParser(tokens, builtin=True).module()
    return [
        d for d in result if isinstance(d, RecordDeclaration | AliasDeclaration | DataDeclaration)
    ]


@cache
def _types() -> _Types:
    text = _read("types") + _declared()
    classes: dict[str, TypeClass] = {}
    names: dict[str, str] = {}
    aliases: dict[str, str] = {}
    records: dict[str, PredefinedRecord] = {}
    newer = {name: len(listed.split()) for name, listed in _NEWER.findall(text)}
    partly = {name for listed in _PARTLY.findall(text) for name in listed.split()}
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
            records[key] = PredefinedRecord(
                declaration.name, components, newer.get(key, 0), key in partly
            )
    return _Types(classes, names, aliases, records)


def type_class(name: str) -> TypeClass | None:
    """Return the value class of a predefined type, or None."""
    return _types().classes.get(name.lower())


def type_names() -> tuple[str, ...]:
    """Return the names of all predefined types."""
    return tuple(_types().names.values())


def alias(name: str) -> str | None:
    """Return the base type of a predefined alias, or None.

    Example: `errnum` -> `num`.
    """
    return _types().aliases.get(name.lower())


def aliases() -> Mapping[str, str]:
    """Return all predefined aliases: lower-case name to base type."""
    return _types().aliases


def record(name: str) -> PredefinedRecord | None:
    """Return the predefined record of a name (any case), or None."""
    return _types().records.get(name.lower())


def records() -> Mapping[str, PredefinedRecord]:
    """Return all predefined records by lower-case name."""
    return _types().records


@cache
def predefined() -> Mapping[str, Predefined]:
    """Return all predefined data by lower-case name."""
    result: dict[str, Predefined] = {}
    text = _read("constants") + _read("data") + _declared()
    read_only, writable = (
        {name for names in listed.findall(text) for name in names.split()}
        for listed in (_READ_ONLY, _WRITABLE)
    )
    for d in _declarations(text):
        if isinstance(d, DataDeclaration):
            value = None if d.initial is None else _value(d.initial)
            readonly = d.name not in writable if d.kind == "CONST" else d.name in read_only
            result[d.name.lower()] = Predefined(d.name, d.kind, d.type, value, readonly)
    return MappingProxyType(result)


def constant(name: str) -> Predefined | None:
    """Return the predefined datum of a name (any case), or None."""
    return predefined().get(name.lower())


def _value(node: Expression) -> Value:
    if isinstance(node, NumberLiteral | BoolLiteral | StringLiteral):
        return node.value
    if isinstance(node, Unary) and isinstance(node.operand, NumberLiteral):
        return -node.operand.value
    if isinstance(node, Aggregate):
        return tuple(_value(member) for member in node.members)
    raise AssertionError(f"builtins hold literals only, not {type(node).__name__}")


# -- places and descriptions ---------------------------------------------------------------------


@cache
def _places() -> Mapping[str, tuple[Path, int, int, int]]:
    """Return file, line, column and length of each declared name, by the lower-case name."""
    result: dict[str, tuple[Path, int, int, int]] = {}
    for path in sorted(_FOLDER.glob("*.rapid")):
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            match = _DECLARED.match(line)
            if match is not None:
                at = (path, number, match.start(1) + 1, len(match[1]))
                result.setdefault(match[1].lower(), at)
    return result


def place(name: str) -> tuple[Path, int, int, int] | None:
    """Return file, line, column (from 1) and length of the name in its header; None: no header."""
    return _places().get(name.lower())


@dataclass(frozen=True, slots=True)
class Description:
    """Description of a built-in name for editors; fields without a source are empty.

    Releases are in the marks of routines, and here for types. Sources of options: the README of
    public programs and their backups, and ABB's file for externally guided motion.
    """

    text: str = ""
    """One sentence."""
    example: str = ""
    """Statements, or a declaration."""
    since: Version | None = None
    option: str = ""
    """Number and name of the option for IRC5 that contains it."""


_NOTHING: Final = Description()


@cache
def _descriptions() -> Mapping[str, Description]:
    """Return the description of built-in names, by the lower-case name.

    In the file a line `name: sentence` may have an example below it, with spaces before it.
    `!since version: names` and `!option name: names` stand at its head.
    """
    result: dict[str, Description] = {}
    since: dict[str, Version | None] = {}
    option: dict[str, str] = {}
    last = ""
    for line in (_FOLDER / "descriptions.txt").read_text("utf-8").splitlines():
        name, _, text = line.partition(": ")
        if line.startswith("!since "):
            since.update(dict.fromkeys(text.lower().split(), _version(name.split()[1:])))
        elif line.startswith("!option "):
            option.update(dict.fromkeys(text.lower().split(), name.partition(" ")[2]))
        elif line.startswith(" "):
            result[last] = replace(result[last], example=line.strip())
        else:
            last = name.lower()
            result[last] = Description(text, "", since.get(last), option.get(last, ""))
    return result


def described(name: str) -> Description:
    """Return what is known about a built-in name (any case); nothing for other names."""
    return _descriptions().get(name.lower(), _NOTHING)


def description(name: str) -> str:
    """Return one sentence about a built-in routine, type or datum; empty if there is none."""
    return described(name).text
