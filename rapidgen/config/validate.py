"""Validate the schema: pydantic's findings become diagnostics.

Codes RG005..RG007. A faulty part is removed and the rest is validated again, so that one fault in a
file does not hide those that only a later step can see.
"""

import dataclasses
import types
import typing
from dataclasses import dataclass, field
from functools import cache
from typing import TypeVar

from pydantic_core import ErrorDetails, SchemaValidator, ValidationError

from rapidgen._json import Json, items, members
from rapidgen.config.layers import group_names
from rapidgen.config.rules import Hint, core
from rapidgen.config.schema import FORMS, GROUP_KEYS, TOP_KEYS, ConfigurationKeys
from rapidgen.config.yaml_tree import MappingNode, place_of, to_python
from rapidgen.diagnostics import Diagnostic, error, suggest

Path = tuple[str | int, ...]
_MOST_ADVISED = 200
"""Maximum number of findings with advice; more are never shown."""
_SCHEMA = "`rapidgen schema{}` has all keys, and what each takes"
T = TypeVar("T")


@dataclass(slots=True)
class Validated:
    """The valid part of a configuration; `removed` are the faulty paths."""

    configuration: ConfigurationKeys
    found: list[Diagnostic] = field(default_factory=list)
    removed: set[Path] = field(default_factory=set)


def validate(root: MappingNode) -> Validated:
    """Validate a canonical tree."""
    return Validated(*valid_subset(root, ConfigurationKeys))


def valid_subset(root: MappingNode, kind: type[T]) -> tuple[T, list[Diagnostic], set[Path]]:
    """Return the valid part of a tree as `kind`, faults, removed paths."""
    data = to_python(root)
    validator = SchemaValidator(core(kind))
    findings: list[Diagnostic] = []
    removed: set[Path] = set()
    while True:
        try:
            return validator.validate_python(data), findings, removed
        except ValidationError as fault:
            faults = fault.errors(include_url=False, include_context=True)
        paths: set[Path] = set()
        for item in faults:
            path, is_key = _real_path(data, item["loc"])
            if item["type"] == "missing":
                # A removed faulty part is not a second fault.
                if item["loc"] not in removed:
                    findings.append(_missing(root, item["loc"]))
                path = path if len(path) < len(item["loc"]) else path[:-1]
            elif path not in paths:
                # Further findings are only counted: a search for similar names would take long.
                advise = len(findings) < _MOST_ADVISED
                findings.append(_translate(root, kind, path, is_key, item, advise))
            paths.add(path)
        removed |= paths
        for path in sorted(paths, key=len, reverse=True):
            _remove(data, path)


def _real_path(data: Json, loc: tuple[str | int, ...]) -> tuple[Path, bool]:
    """Return the part of `loc` that is a path in the data.

    Unions and keys add parts of their own.
    """
    node = data
    path: list[str | int] = []
    for part in loc:
        try:
            node = _part(node, part)
        except (KeyError, IndexError, TypeError):
            break
        path.append(part)
    return tuple(path), loc[-1] == "[key]"


def _part(node: Json, part: str | int) -> Json:
    return items(node)[part] if isinstance(part, int) else members(node)[part]


def _remove(data: Json, path: Path) -> None:
    *parents, last = path
    for part in parents:
        try:
            data = _part(data, part)
        except (KeyError, IndexError, TypeError):
            return  # an outer part is already removed
    if isinstance(data, dict):
        data.pop(str(last), None)
    elif isinstance(data, list):
        # An element of a list cannot be missing: the whole list is removed.
        data.clear()


def shown(root: MappingNode, path: Path) -> str:
    """Return a path as users write it: the only group's keys are at the top."""
    if len(path) > 2 and path[0] == "groups" and len(group_names(root)) == 1:
        path = path[2:]
    return ".".join(str(part) for part in path)


def _missing(root: MappingNode, loc: Path) -> Diagnostic:
    key, _ = place_of(root, loc[:-1])
    return error(
        "RG007",
        key,
        f"'{shown(root, loc[:-1])}' lacks '{loc[-1]}'",
        f"add `{loc[-1]}:`",
        label="here",
    )


def _translate(
    root: MappingNode, kind: type, path: Path, is_key: bool, item: ErrorDetails, advise: bool
) -> Diagnostic:
    key, value = place_of(root, path)
    schema = _SCHEMA.format("" if kind is ConfigurationKeys else " --cell")
    if item["type"] == "unexpected_keyword_argument":
        known = _keys_at(kind, path[:-1])
        meant = ""
        if advise:
            elsewhere = _belongs(str(path[-1]), path[:-1]) if kind is ConfigurationKeys else ""
            meant = elsewhere or suggest(str(path[-1]), known)
        where = f" in '{shown(root, path[:-1])}'" if len(path) > 1 else ""
        return error(
            "RG005",
            key,
            f"unknown key '{_short(path[-1])}'{where}",
            meant or (f"known here: {', '.join(known)}" if len(known) < 25 else schema),
            label="not a key of this file" if len(path) == 1 else "not a key here",
        )
    return error(
        "RG006",
        key if is_key else value,
        f"'{shown(root, path)}': {_reason(item, is_key)}",
        _form(item)[1] if item["type"] == "string_pattern_mismatch" else schema,
        label=_input(item),
    )


def _form(item: ErrorDetails) -> tuple[str, str]:
    """Return a pattern's meaning in words, and its allowed parts."""
    return FORMS[item["ctx"]["pattern"]]


def _short(value: object) -> str:
    """Return a value of the file as a message shows it."""
    text = str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _input(item: ErrorDetails) -> str:
    value = item.get("input")
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return "a list"
    return ""


def _reason(item: ErrorDetails, is_key: bool) -> str:
    kind, context = item["type"], item.get("ctx", {})
    value = item.get("input")
    fixed = {
        "float_type": "must be a number",
        "int_type": "must be a whole number",
        "bool_type": "must be true or false (YAML 1.2: `yes` and `on` are texts)",
        "string_type": "must be a text",
        "list_type": "must be a list",
        "dict_type": "must be a mapping",
        "dataclass_type": "must be a mapping",
        "finite_number": "must be a finite number",
    }
    if kind in fixed:
        tail = f", not '{_short(value)}'" if isinstance(value, str) else ""
        return fixed[kind] + tail
    if kind == "literal_error":
        words = [w.strip("'") for w in context["expected"].replace(" or ", ", ").split(", ")]
        meant = suggest(str(value), words)
        listed = ", ".join(words)
        return f"'{_short(value)}' is not one of {listed}" + (f"; {meant}" if meant else "")
    bounds = {
        "greater_than": ("gt", "more than"),
        "greater_than_equal": ("ge", "at least"),
        "less_than": ("lt", "less than"),
        "less_than_equal": ("le", "at most"),
    }
    if kind in bounds:
        name, phrase = bounds[kind]
        return f"must be {phrase} {context[name]:g}, not {_short(value)}"
    if kind in ("too_short", "too_long"):
        bound = context["min_length" if kind == "too_short" else "max_length"]
        phrase = "at least" if kind == "too_short" else "at most"
        return f"must have {phrase} {bound} entries, not {context['actual_length']}"
    if kind == "string_pattern_mismatch":
        what = "this name" if is_key else "the text"
        return f"{what} must be {_form(item)[0]}"
    if kind == "value_error":
        return str(context["error"])
    return str(item["msg"])


@cache
def _keys_at(kind: type, path: Path) -> tuple[str, ...]:
    """Return the schema's keys at a path of the canonical tree."""
    if not path and kind is ConfigurationKeys:
        return tuple(dict.fromkeys((*TOP_KEYS, *GROUP_KEYS)))
    hint: Hint = kind
    for part in path:
        hint = _step(hint, part)
    model = _model(hint)
    return tuple(f.name for f in dataclasses.fields(model)) if model else ()


_POINT_LIMIT = ("max_points", "point_limit", "max_traj_length")
"""Other names of the limit; the last in abb_driver (ROS_common, MAX_TRAJ_LENGTH)."""


def _belongs(name: str, value: Path) -> str:
    """Return the correct path of a key; empty if unknown or ambiguous."""
    if name.lower() in _POINT_LIMIT:
        return "the limit of points is `capacity:` in `trajectory:`"
    if value and name in TOP_KEYS:
        return f"`{name}:` belongs at the top of the file"
    if value and name in GROUP_KEYS:
        return f"`{name}:` belongs in a group, or at the top with a single group"
    sections = [at for at in TOP_KEYS if at != "groups" and at not in value]
    there = [at for at in sections if name in _keys_at(ConfigurationKeys, (at,))]
    return f"`{name}:` belongs in `{there[0]}:`" if len(there) == 1 else ""


def _model(hint: Hint) -> type | None:
    for option in _options(hint):
        if isinstance(option, type) and dataclasses.is_dataclass(option):
            return option
    return None


def _options(hint: Hint) -> tuple[Hint, ...]:
    if typing.get_origin(hint) is typing.Annotated:
        return _options(typing.get_args(hint)[0])
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return typing.get_args(hint)
    return (hint,)


def _step(hint: Hint, part: str | int) -> Hint:
    model = _model(hint)
    if model:
        return next((f.type for f in dataclasses.fields(model) if f.name == part), None)
    for option in _options(hint):
        if typing.get_origin(option) is dict:
            return typing.get_args(option)[1]
        if typing.get_origin(option) is list:
            return typing.get_args(option)[0]
    return None
