"""Write texts as YAML that YAML 1.1 and 1.2 read alike."""

import json
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

Scalar: TypeAlias = str | int | float | bool

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_/.-]*")
_WORDS = frozenset(["y", "n", "yes", "no", "on", "off", "true", "false", "null"])
"""Words that YAML 1.1 or 1.2 does not read as a text."""
_ESCAPED = {'"': '\\"', "\\": "\\\\"}


def yaml_text(text: str) -> str:
    """Return a text as a key or a value, quoted if necessary."""
    if _PLAIN.fullmatch(text) and text.lower() not in _WORDS:
        return text
    return '"' + "".join(map(_escaped, text)) + '"'


def yaml_flow(value: Scalar | Sequence[Scalar] | Mapping[str, Scalar]) -> str:
    """Return scalars, or a list or mapping of them, in one line."""
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
