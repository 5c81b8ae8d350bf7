"""Set single values in the text of a configuration; all other characters stay.

Comments, order and layout belong to the user, so the text is not written anew: a value is replaced
in its place, and a new key comes before the first key of its mapping.
"""

import re
from collections.abc import Sequence

from rapidgen.config.yaml_text import Scalar, yaml_flow, yaml_text
from rapidgen.config.yaml_tree import MappingNode, Node, ScalarNode, parse
from rapidgen.diagnostics import Span

KeyPath = Sequence[str]
_LINE_END = re.compile("\r\n|[\n\r\x85\u2028\u2029]")


class CannotEdit(Exception):
    """The text has a form in which the value cannot be set; the text says which."""


def set_value(text: str, path: KeyPath, value: Scalar, displayed: str = "") -> str:
    """Return the text with a value at a path of keys; missing mappings are made.

    Raises CannotEdit, and DiagnosticError for a text that is no YAML.
    """
    root, _ = parse(text, displayed)
    if isinstance(root, ScalarNode) and root.value is None:
        root = MappingNode({}, Span(displayed, 1, 1))
    if not isinstance(root, MappingNode):
        raise CannotEdit("the text is no mapping")
    node = root
    for depth, key in enumerate(path):
        entry = node.entries.get(key)
        rest = path[depth + 1 :]
        if entry is None:
            if node is root and text[_offset(text, node.span) :][:1] != "{":
                return _append(text, key, rest, value)
            return _insert(text, node, key, _nested(rest, value))
        place, below = entry
        if isinstance(below, MappingNode) and rest:
            node = below
            continue
        if isinstance(below, ScalarNode) and (not rest or below.value is None):
            return _replace(text, place, below, _nested(rest, value))
        raise CannotEdit(f"the value of '{key}' is no {'mapping' if rest else 'scalar'}")
    raise CannotEdit("no key to set")


def _nested(path: KeyPath, value: Scalar) -> str:
    """Return a value below keys, in one line."""
    text = yaml_flow(value)
    for key in reversed(path):
        text = f"{{{yaml_text(key)}: {text}}}"
    return text


def _append(text: str, key: str, rest: KeyPath, value: Scalar) -> str:
    """Add a key behind all others of the text, with the next one below it."""
    if text.rstrip().endswith("..."):
        raise CannotEdit("the text ends with '...'")
    end = _newline(text)
    below = f" {_nested(rest, value)}"
    if len(rest) > 1:
        below = f"{end}  {yaml_text(rest[0])}: {_nested(rest[1:], value)}"
    before = text if not text or text.endswith(end) else text + end
    return f"{before}{yaml_text(key)}:{below}{end}"


def _insert(text: str, node: MappingNode, key: str, value: str) -> str:
    """Add a key before the first one of a mapping."""
    written = f"{yaml_text(key)}: {value}"
    begin = _offset(text, node.span)
    if text[begin : begin + 1] == "{":
        between = ", " if node.entries else ""
        return text[: begin + 1] + written + between + text[begin + 1 :]
    first, _ = next(iter(node.entries.values()))
    begin = _offset(text, first)
    return f"{text[:begin]}{written}{_newline(text)}{' ' * (first.column - 1)}{text[begin:]}"


def _replace(text: str, key: Span, node: Node, value: str) -> str:
    """Put a value in the place of a scalar."""
    span = node.span
    begin, end = _offset(text, span), _offset(text, Span("", span.end_line, span.end_column))
    if begin < _offset(text, key):
        raise CannotEdit("the value is an alias")
    if begin == end:  # a key without a value
        begin = end = text.index(":", _offset(text, Span("", key.end_line, key.end_column))) + 1
        value = f" {value}"
    return text[:begin] + value + text[end:]


def _newline(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def _offset(text: str, span: Span) -> int:
    """Return the place of a span in the text; lines end as YAML ends them."""
    starts = [0, *(match.end() for match in _LINE_END.finditer(text))]
    return starts[min(span.line, len(starts)) - 1] + span.column - 1
