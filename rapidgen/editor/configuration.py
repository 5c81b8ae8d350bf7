"""rapidgen's YAML files in an editor, and the kinds of documents beside RAPID.

A YAML document is ours if its keys at the left are all keys of a configuration, and it has at least
one that decides: `model`, `joints`, `groups`, `urdf`. Its findings are those of `rapidgen check`,
with the text of the editor in place of the file's; completion and hover come from the JSON schema.

Places in YAML are found by indentation alone, because a document under edit is seldom valid.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Final, Literal, cast

from rapidgen._json import Json, Members
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span
from rapidgen.editor.documents import is_file
from rapidgen.system.project import PROJECT_FILE

FileKind = Literal["rapid", "yaml", "cfg", "toml", ""]
_DECIDING: Final = frozenset(("model", "joints", "groups", "urdf"))
_KEY: Final = re.compile(r"^(\s*(?:-\s+)?)([\w-]+)\s*:(?:\s|$)")
_TOP_KEY: Final = re.compile(r"^([\w-]+)\s*:", re.MULTILINE)
_PATH: Final = re.compile(r"^(\s*(?:-\s+)?(?:urdf|file|mesh|xacro|base|cell)\s*:\s*)([^\s#{\[]+)")
_MOST: Final = 1_000_000
"""Characters of a document that is looked at."""


def kind_of(path: str, language: str) -> FileKind:
    """Return what a document is, by its name and the editor's language."""
    name = path.casefold()
    if name.endswith((".yaml", ".yml")):
        return "yaml"
    if Path(path).name == PROJECT_FILE:
        return "toml"
    if name.endswith(".cfg"):
        return "cfg" if Path(path).parent.name.upper() == "SYSPAR" else ""
    return "rapid" if language == "rapid" else ""


def is_configuration(text: str) -> bool:
    """Return True for the text of a configuration of rapidgen."""
    if len(text) > _MOST:
        return False
    keys = set(_TOP_KEY.findall(text))
    return bool(keys & _DECIDING) and keys <= _schema_keys()


@cache
def _schema() -> Members:
    """Return the JSON schema; pydantic is loaded when the first configuration is opened."""
    from rapidgen.config.schema_reference import json_schema

    return json_schema()


def _schema_keys() -> frozenset[str]:
    return frozenset(cast(Members, _schema()["properties"]))


def findings(path: str, text: str, kind: FileKind) -> list[Diagnostic]:
    """Return the findings of a YAML, TOML or cfg document; none for files that are not ours."""
    try:
        if kind == "cfg":
            from rapidgen.system.cfg import parse_cfg

            parse_cfg(text, path=path)
            return []
        if kind == "toml":
            from rapidgen.editor import project_file

            return project_file.findings(path, text)
        if kind != "yaml" or not is_configuration(text):
            return []
        return _of_configuration(path, text)
    except DiagnosticError as fault:
        return _here(path, fault.diagnostics)


def _of_configuration(path: str, text: str) -> list[Diagnostic]:
    from rapidgen.config.load import load_config
    from rapidgen.generate import build

    content = text.encode("utf-8", "surrogatepass")
    model = load_config(Path(path), content=content)
    found = list(model.diagnostics)
    try:
        build(model)
    except DiagnosticError as fault:
        found += fault.diagnostics
    return _here(path, found)


def _here(path: str, found: "list[Diagnostic] | tuple[Diagnostic, ...]") -> list[Diagnostic]:
    """Return findings with places in the document; others stand at its head.

    The reader of configurations gives paths relative to the working folder.
    """
    real = Path(path).absolute() if is_file(path) else Path(path)
    result = []
    for d in found:
        span = d.span
        if span is None:
            result.append(replace(d, span=Span(path, 1, 1)))
        elif span.path == path or Path(span.path).absolute() == real:
            result.append(replace(d, span=replace(span, path=path)))
        else:
            note = f"{span.path}, line {span.line}"
            result.append(replace(d, span=Span(path, 1, 1), notes=(*d.notes, note)))
    return result


# -- places in YAML ------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Key:
    """A key or word of a file, as an editor shows it."""

    name: str
    text: str
    """What it means and takes, as Markdown."""
    insert: str = ""
    """What completion writes; empty: the name."""


def keys_at(text: str, line: int, column: int) -> tuple[list[Key], int]:
    """Return the keys that are possible at a line and column, and the column of the typed word.

    Without keys for a place of a value.
    """
    lines = text.splitlines()
    current = lines[line - 1][: column - 1] if line <= len(lines) else ""
    word = re.search(r"[\w-]*$", current)
    start = word.start() if word is not None else len(current)
    head = current[:start]
    if head.strip() not in ("", "-"):
        return [], start + 1
    parent = _path_above(lines[: line - 1], len(head.replace("-", " ")))
    node = _node(parent)
    properties = node.get("properties") if node is not None else None
    if not isinstance(properties, dict):
        return [], start + 1
    return [_key(name, value) for name, value in properties.items()], start + 1


def key_at(text: str, line: int, column: int) -> tuple[Key, Span] | None:
    """Return the key at a line and column with its place; None for other places."""
    lines = text.splitlines()
    match = _KEY.match(lines[line - 1]) if line <= len(lines) else None
    if match is None or not match.start(2) < column <= match.end(2) + 1:
        return None
    parent = _path_above(lines[: line - 1], len(match[1]))
    node = _node(parent)
    properties = node.get("properties") if node is not None else None
    value = properties.get(match[2]) if isinstance(properties, dict) else None
    if value is None:
        return None
    span = Span("", line, match.start(2) + 1, line, match.end(2) + 1)
    return _key(match[2], value), span


def _path_above(lines: list[str], indent: int) -> list[str]:
    """Return the keys above a line that begins at an indentation, the outermost first."""
    path: list[str] = []
    for line in reversed(lines):
        match = _KEY.match(line)
        if match is None:
            continue
        depth = len(match[1])
        if depth < indent:
            path.insert(0, match[2])
            indent = depth
        if indent == 0:
            break
    return path


def _node(path: list[str]) -> Members | None:
    """Return the part of the schema for a path of keys; names of a user's own are patterns."""
    node: Json = _schema()
    for name in path:
        node = _resolved(node)
        if not isinstance(node, dict):
            return None
        properties, patterns = node.get("properties"), node.get("patternProperties")
        if isinstance(properties, dict) and name in properties:
            node = properties[name]
        elif isinstance(patterns, dict) and patterns:
            node = next(iter(patterns.values()))
        else:
            node = node.get("additionalProperties")
        if isinstance(_resolved(node), dict) and "items" in cast(Members, _resolved(node)):
            node = cast(Members, _resolved(node))["items"]
    node = _resolved(node)
    return node if isinstance(node, dict) else None


def _resolved(node: Json) -> Json:
    """Follow references, and the first alternative that is an object."""
    for _ in range(8):
        if not isinstance(node, dict):
            return node
        reference = node.get("$ref")
        if isinstance(reference, str):
            parts = cast(Members, _schema()["$defs"])
            node = parts.get(reference.rpartition("/")[2])
            continue
        options = node.get("anyOf")
        if not isinstance(options, list):
            return node
        known = [option for option in map(_resolved, options) if isinstance(option, dict)]
        node = next((o for o in known if "properties" in o or "items" in o), known[0])
    return node


def _key(name: str, value: Json) -> Key:
    node = _resolved(value)
    data = value if isinstance(value, dict) else {}
    lines = [str(data.get("description", ""))]
    resolved = node if isinstance(node, dict) else {}
    choices = resolved.get("enum")
    if isinstance(choices, list):
        lines.append("One of " + ", ".join(f"`{choice}`" for choice in choices) + ".")
    elif isinstance(resolved.get("type"), str):
        lines.append(f"Type: {resolved['type']}.")
    default = data.get("default")
    if default not in (None, "", [], {}) and not isinstance(default, dict | list):
        lines.append(f"Default: `{default}`.")
    insert = f"{name}:" if "properties" in resolved else f"{name}: "
    return Key(name, "  \n".join(filter(None, lines)), insert)


# -- links ---------------------------------------------------------------------------------------


def links(path: str, text: str) -> Iterator[tuple[Span, str]]:
    """Yield the places of file names in a configuration, with the existing files."""
    if not is_file(path) or not is_configuration(text):
        return
    folder = Path(path).parent
    for number, line in enumerate(text.splitlines(), 1):
        match = _PATH.match(line)
        if match is None:
            continue
        name = match[2].strip("\"'")
        target = folder / name
        if name and target.is_file():
            start = match.start(2) + 1
            yield Span(path, number, start, number, start + len(match[2])), str(target)
