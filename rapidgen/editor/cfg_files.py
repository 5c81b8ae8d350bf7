"""cfg files of a controller in an editor: what a type, an attribute and a word mean.

Descriptions are in `system/cfg_descriptions.txt`, defaults and words in `system/cfg_defaults.py`
and `system/cfg_schema.py`, each with its source. An attribute that they do not have has no
description; completion offers only attributes that are described or in the schema.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from rapidgen.diagnostics import Span
from rapidgen.editor.configuration import Key

if TYPE_CHECKING:
    from rapidgen.system import cfg_schema as schema

_HEADER: Final = re.compile(r"\s*\ufeff?([A-Za-z]+):CFG_1\.0:(\d+)?")
_SECTION: Final = re.compile(r"^\s*(?:[A-Za-z]\w*\s*=\s*)?([A-Za-z]\w*):\s*$")
_ATTRIBUTE: Final = re.compile(r"(?:^|(?<=\s))-([A-Za-z_]\w*)(?=\s|\\|$)")
_VALUE: Final = re.compile(r'-([A-Za-z_]\w*)\s+"([^"]*)("?)')
_QUOTED: Final = re.compile(r'"[^"]*"?')
_NAMED: Final = re.compile(r'-[Nn]ame\s+"([^"]{1,64})"')
_TITLE: Final = re.compile(r"\[(\w+) (\w+)\] (.*)")
_ROW: Final = re.compile(r"(\w+)(?: \[([^\]]+)\])?(?: \(([^)]+)\))?: (.*)")
_COUNTED: Final = re.compile(r"(.*?)(\d+)(\w*)")
_USE: Final = re.compile(r"use_([a-z_]+?)(?:_\d)?")
"""Attributes with the name of an instance of another type, in all of MOC [backups]."""
_MOST: Final = 1_000_000
"""Characters of a file that is looked at."""


@dataclass(frozen=True, slots=True)
class Attribute:
    """An attribute of a type of instances."""

    name: str
    text: str
    unit: str = ""
    range: str = ""


@dataclass(frozen=True, slots=True)
class InstanceType:
    """A type of instances: its text and its attributes by lower-case name."""

    domain: str
    name: str
    text: str
    attributes: dict[str, Attribute] = field(default_factory=dict)


@cache
def _types() -> dict[tuple[str, str], InstanceType]:
    """Return the described types by domain and name, in upper case."""
    import rapidgen.system

    result: dict[tuple[str, str], InstanceType] = {}
    present = InstanceType("", "", "")
    path = Path(rapidgen.system.__file__).with_name("cfg_descriptions.txt")
    for line in path.read_text("utf-8").splitlines():
        title, row = _TITLE.fullmatch(line), _ROW.fullmatch(line)
        if title is not None:
            present = InstanceType(title[1], title[2], title[3])
            result[title[1], title[2]] = present
        elif row is not None:
            name, unit, limits, text = row.groups()
            present.attributes[name.lower()] = Attribute(name, text, unit or "", limits or "")
    # RobotWare 7 has the system signals in SYS.
    for name in ("SYSSIG_OUT", "SYSSIG_IN"):
        result["SYS", name] = InstanceType("SYS", name, *_of(result["EIO", name]))
    return result


def _of(kind: InstanceType) -> tuple[str, dict[str, Attribute]]:
    named = Attribute("Name", kind.attributes["signal"].text.partition(". RobotWare 7")[0] + ".")
    others = {key: a for key, a in kind.attributes.items() if key != "signal"}
    return kind.text, {"name": named, **others}


def _attribute(kind: InstanceType, name: str) -> Attribute | None:
    """Return an attribute; of a numbered one, such as `use_joint_4`, that with the first number."""
    key = name.lower()
    match = _COUNTED.fullmatch(key)
    numbered = [f"{match[1]}{n}{match[3]}" for n in "01"] if match is not None else []
    return next((kind.attributes[k] for k in (key, *numbered) if k in kind.attributes), None)


# -- places --------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Place:
    """Domain, main release (0: unknown) and section of a line; the lines of its instance."""

    domain: str
    release: int
    section: str
    instance: Sequence[str]
    sections: frozenset[str]
    """All sections of the file."""


def _place(lines: Sequence[str], number: int) -> _Place:
    """Return the place of a line (from 0)."""
    head = next((_HEADER.match(line) for line in lines[:20] if line.strip()), None)
    domain = head[1].upper() if head is not None else ""
    release = int(head[2] or 0) if head is not None else 0
    section = next(
        (m[1].upper() for line in reversed(lines[: number + 1]) if (m := _SECTION.match(line))), ""
    )
    first = last = number
    while first > 0 and lines[first - 1].rstrip().endswith("\\"):
        first -= 1
    while last + 1 < len(lines) and lines[last].rstrip().endswith("\\"):
        last += 1
    sections = frozenset(m[1].upper() for line in lines if (m := _SECTION.match(line)))
    return _Place(domain, release, section, lines[first : last + 1], sections)


def _lines(text: str) -> list[str]:
    return text.splitlines() if len(text) <= _MOST else []


def key_at(text: str, line: int, column: int) -> tuple[Key, Span] | None:
    """Return the type, attribute or word at a line and column with its place; None elsewhere."""
    lines = _lines(text)
    if line > len(lines):
        return None
    current = lines[line - 1]
    place = _place(lines, line - 1)
    kind = _types().get((place.domain, place.section))
    title = _SECTION.match(current)
    if title is not None:
        start, end = title.span(1)
        if kind is None or not start < column <= end + 1:
            return None
        return Key(kind.name, f"{kind.domain}: {kind.text}"), _span(line, start, end)
    for match in _ATTRIBUTE.finditer(_without_values(current)):
        if match.start() < column <= match.end() + 1:
            key = _key(place, kind, match[1])
            return (key, _span(line, match.start(), match.end())) if key is not None else None
    for value in _VALUE.finditer(current):
        if value.start(2) < column <= value.end(2) + 1:
            word = _words(place, value[1]).get(value[2].casefold())
            if word is None:
                return None
            return Key(word[0], word[1]), _span(line, *value.span(2))
    return None


def _span(line: int, start: int, end: int) -> Span:
    return Span("", line, start + 1, line, end + 1)


def _without_values(line: str) -> str:
    """Return a line in which quoted texts are blank."""
    return _QUOTED.sub(lambda match: " " * len(match[0]), line)


def _key(place: _Place, kind: InstanceType | None, name: str) -> Key | None:
    """Return an attribute with its text, unit, range, words and default; None if all is unknown."""
    from rapidgen.system.cfg_defaults import default_of

    known = _attribute(kind, name) if kind is not None else None
    lines = [known.text] if known is not None else _by_convention(place, name)
    if known is not None and known.unit:
        lines.append(f"Unit: {known.unit}.")
    if known is not None and known.range:
        lines.append(f"Range: {known.range}.")
    words = _words(place, name)
    if words:
        lines.append("One of " + ", ".join(f"`{word}`" for word, _ in words.values()) + ".")
    default = default_of(place.domain, place.section, name)
    if default is not None and default.value != "":
        lines.append(f"Default: `{default.value}` (source: {default.source}).")
    if not lines:
        return None
    # Controllers write names in the case that the file has; the file's own is kept.
    return Key(name, "  \n".join([f"Attribute of {place.section}.", *lines]), insert=f"-{name} ")


def _by_convention(place: _Place, name: str) -> list[str]:
    """Return what the name of an attribute says: `name`, and in MOC `use_arm` and its kind."""
    if name.lower() == "name":
        return ["Name of the instance."]
    match = _USE.fullmatch(name.lower()) if place.domain == "MOC" else None
    if match is not None and match[1].upper() in place.sections:
        return [f"Name of the {match[1].upper()} that this instance uses."]
    return []


def _words(place: _Place, attribute: str) -> dict[str, tuple[str, str]]:
    """Return the words of an attribute and what they mean, by the word without case."""
    from rapidgen.system import cfg_schema as schema

    key = (place.section, attribute.lower())
    plain: dict[tuple[str, str], Sequence[str]] = {
        ("CAB_TASKS", "type"): schema.TASK_TYPES,
        ("CAB_TASKS", "trustlevel"): schema.TRUST_LEVELS,
        ("CAB_EXEC_HOOKS", "shelf"): schema.SHELVES,
        ("EIO_SIGNAL", "signaltype"): ("DI", "DO", "GI", "GO", "AI", "AO"),
        **{("EIO_CROSS", f"oper{n}"): ("AND", "OR") for n in range(1, 5)},
    }
    if key in plain:
        return {word.casefold(): (word, "") for word in plain[key]}
    table = {
        ("SYSSIG_OUT", "status"): schema.OUTPUTS_7 if place.release >= 7 else schema.OUTPUTS_TO_6,
        ("SYSSIG_IN", "action"): schema.INPUTS,
    }.get(key, {})
    return {word: (row.name, _of_signal(place, row)) for word, row in table.items()}


def _of_signal(place: _Place, row: "schema.SystemSignal") -> str:
    outputs = place.section == "SYSSIG_OUT"
    named = {"unit": "mechanical unit", "task": "task", "": ""}[row.argument]
    where = {"unit": "Arg1" if outputs else "Arg6", "task": "Arg2" if outputs else "Arg7"}
    text = f"Takes a {row.kind}."
    if named:
        text += f" The {named} is in `-{where[row.argument]}`"
        text += ", which is necessary." if row.needed else "."
    return text


# -- completion ----------------------------------------------------------------------------------


def keys_at(text: str, line: int, column: int) -> tuple[list[Key], int]:
    """Return attributes, words or types for a place, and the column where the typed word begins."""
    lines = _lines(text)
    current = lines[line - 1] if line <= len(lines) else ""
    before = current[: column - 1]
    place = _place(lines, line - 1) if line <= len(lines) else _place([*lines, ""], len(lines))
    open_value = next((m for m in _VALUE.finditer(before) if not m[3]), None)
    if open_value is not None:
        words = _words(place, open_value[1]).values()
        return [Key(word, meaning) for word, meaning in words], open_value.start(2) + 1
    word = re.search(r"-?\w*$", before)
    start = word.start() if word is not None else len(before)
    if before[:start].count('"') % 2:
        return [], start + 1
    kind = _types().get((place.domain, place.section))
    typed = before[start:]
    result = []
    if typed.startswith("-") or before[:start].strip() or "\\" in "".join(place.instance[:-1]):
        given = {
            name.lower()
            for one in place.instance
            for name in _ATTRIBUTE.findall(_without_values(one))
        } - {typed[1:].lower()}
        names = {a.name for a in kind.attributes.values()} if kind is not None else set()
        result = [
            key for n in sorted(names) if n.lower() not in given and (key := _key(place, kind, n))
        ]
    elif not before[:start].strip():
        types = (k for (domain, _), k in _types().items() if domain == place.domain)
        result = [Key(k.name, k.text, insert=f"{k.name}:\n") for k in types]
        if kind is not None and before:
            names = {a.name for a in kind.attributes.values()}
            result += [key for n in sorted(names) if (key := _key(place, kind, n))]
    return result, start + 1


# -- instances -----------------------------------------------------------------------------------


def instances(text: str) -> Iterator[tuple[str, str, int]]:
    """Yield section, name and line of all named instances of a cfg text."""
    section = ""
    for number, line in enumerate(_lines(text), 1):
        match = _SECTION.match(line)
        if match is not None:
            section = match[1]
            continue
        named = _NAMED.search(line)
        if named is not None and section:
            yield section, named[1], number


def installed_place(root: str, name: str) -> Span | None:
    """Return where the cfg files of a backup declare a signal or mechanical unit."""
    folder = Path(root) / "SYSPAR"
    for file in ("EIO.cfg", "MOC.cfg", "SYS.cfg"):
        path = folder / file
        try:
            text = path.read_bytes()[:_MOST].decode("latin-1")
        except OSError:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            match = _NAMED.search(line)
            if match is not None and match[1].casefold() == name.casefold():
                start = match.start(1) + 1
                return Span(str(path), number, start, number, start + len(name))
    return None
