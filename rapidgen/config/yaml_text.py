"""Texts in YAML that is written: who reads it as YAML 1.1 or 1.2 reads the same text."""

import json
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

Scalar: TypeAlias = str | int | float | bool

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_/.-]*")
_WORDS = frozenset(["y", "n", "yes", "no", "on", "off", "true", "false", "null"])
"""What one of the two takes for something else than a text."""
_ESCAPED = {'"': '\\"', "\\": "\\\\"}


def yaml_text(text: str) -> str:
    """A text as a key or a value: plain where it stays a text so, else in double quotes."""
    if _PLAIN.fullmatch(text) and text.lower() not in _WORDS:
        return text
    return '"' + "".join(map(_escaped, text)) + '"'


def yaml_flow(value: Scalar | Sequence[Scalar] | Mapping[str, Scalar]) -> str:
    """Scalars, a list or a mapping of them, in one line."""
    if isinstance(value, str):
        return yaml_text(value)
    if isinstance(value, Mapping):
        pairs = (f"{yaml_text(key)}: {yaml_flow(one)}" for key, one in value.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(yaml_flow, value)) + "]"
    return json.dumps(value)


def _escaped(character: str) -> str:
    if character in _ESCAPED:
        return _ESCAPED[character]
    # Not the surrogates of JSON: YAML reads each of them as a character.
    return character if character.isprintable() else f"\\U{ord(character):08x}"
