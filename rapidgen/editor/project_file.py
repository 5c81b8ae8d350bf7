"""The project file rapidgen.toml in an editor: findings, keys and values.

The document is seldom valid TOML while it is edited, so places are found by lines and brackets.
"""

import re
from functools import cache
from pathlib import Path
from typing import Final, cast

from rapidgen._json import Members
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span
from rapidgen.editor.configuration import Key
from rapidgen.system.project import project_schema, read_project

_KEY: Final = re.compile(r"\s*([\w-]+)\s*(=?)")
_TABLE: Final = re.compile(r"\s*\[\s*([\w-]+)\s*\]")
_TEXT: Final = re.compile(r"\"(?:[^\"\\]|\\.)*\"?|'[^']*'?|#.*")
_CODE: Final = re.compile(r"RG\d{3}")
_ARRAY: Final = "array"


def findings(path: str, text: str) -> list[Diagnostic]:
    """Return the faults of a project file with the editor's text."""
    try:
        read_project(Path(path), text.encode("utf-8", "surrogatepass"))
    except DiagnosticError as fault:
        return list(fault.diagnostics)
    return []


def key_at(text: str, line: int, column: int) -> tuple[Key, Span] | None:
    """Return the key, or the code of findings, at a line and column with its place."""
    lines = text.splitlines()
    if line > len(lines):
        return None
    current = lines[line - 1]
    key, table = _open_key(lines, line, len(current))
    if key == "ignore":
        for code in _CODE.finditer(current):
            if code.start() < column <= code.end() + 1 and code[0] in _codes():
                return _codes()[code[0]], _span(line, *code.span())
    match = _TABLE.match(current) or _KEY.match(current)
    is_inside = table and _TABLE.match(current) is None
    if match is None or is_inside or not match.start(1) < column <= match.end(1) + 1:
        return None
    known = _keys().get(match[1])
    return (known, _span(line, *match.span(1))) if known is not None else None


def keys_at(text: str, line: int, column: int) -> tuple[list[Key], int]:
    """Return keys, or values of a key, and the column where the typed word begins."""
    lines = text.splitlines()
    before = (lines[line - 1] if line <= len(lines) else "")[: column - 1]
    word = re.search(r"[\w-]*$", before)
    start = word.start() if word is not None else len(before)
    key, table = _open_key(lines, line, start)
    if key == "ignore":
        quoted = before[:start].endswith(('"', "'"))
        codes = _codes().values()
        return [Key(c.name, c.text, insert=c.name if quoted else f'"{c.name}"') for c in codes], (
            start + 1
        )
    if key == "strict":
        return [Key(word, "", insert=word) for word in ("true", "false")], start + 1
    if key or table or before[:start].strip():
        return [], start + 1
    given = {m[1] for other in lines if (m := _KEY.match(other)) is not None and m[2]}
    return [known for name, known in _keys().items() if name not in given], start + 1


def _open_key(lines: list[str], line: int, column: int) -> tuple[str, str]:
    """Return the key whose value a place (column from 0) is in, and the table; empty: none."""
    key = table = ""
    depth = 0
    for number, whole in enumerate(lines[:line], 1):
        bare = _TEXT.sub(lambda match: " " * len(match[0]), whole)
        bare = bare[:column] if number == line else bare
        if depth <= 0:
            key, depth = "", 0
            header = _TABLE.match(bare)
            if header is not None:
                table = header[1]
                continue
            match = _KEY.match(bare)
            key = match[1] if match is not None and match[2] else ""
        depth += sum(bare.count(c) for c in "[{") - sum(bare.count(c) for c in "]}")
    return key, table


def _span(line: int, start: int, end: int) -> Span:
    return Span("", line, start + 1, line, end + 1)


@cache
def _keys() -> dict[str, Key]:
    result = {}
    for name, value in cast(Members, project_schema()["properties"]).items():
        data = cast(Members, value)
        lines = [str(data["description"]), f"Type: {data['type']}."]
        examples = data.get("examples")
        example = str(examples[0]) if isinstance(examples, list) else ""
        lines.append(f"Example: `{name} = {example}`")
        insert = f"{name} = []" if data["type"] == _ARRAY else f"{name} = "
        result[name] = Key(name, "  \n".join(lines), insert=insert)
    return result


@cache
def _codes() -> dict[str, Key]:
    from rapidgen.diagnostics.pages import codes, title

    return {code: Key(code, title(code)) for code in codes()}
