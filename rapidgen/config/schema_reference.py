"""JSON schema, and the tables of docs/start/configuration.md."""

import dataclasses
import json
import re
import types
import typing
from typing import Any

from rapidgen._json import Members
from rapidgen.config import cell, schema, zones
from rapidgen.config.rules import Hint, Rule

SECTIONS = (
    schema.ConfigurationKeys,
    schema.ControllerKeys,
    schema.GroupKeys,
    schema.JointKeys,
    schema.UrdfKeys,
    schema.ChainStepKeys,
    schema.ToolKeys,
    schema.WorkObjectKeys,
    schema.FrameKeys,
    schema.LoadKeys,
    schema.PortsKeys,
    schema.EgmKeys,
    schema.TrajectoryKeys,
    schema.StateKeys,
    schema.NetworkKeys,
    schema.SignalKeys,
)
CELL_SECTIONS = (
    cell.CellKeys,
    cell.CellRobotKeys,
    cell.CellSignalKeys,
    cell.ReactionKeys,
    cell.CameraKeys,
    cell.SeenKeys,
    cell.ForceKeys,
    cell.ThingKeys,
    cell.ShapeKeys,
    cell.RoundKeys,
    cell.CellToolKeys,
    cell.CollisionKeys,
    cell.AllowedKeys,
    zones.ZoneKeys,
    zones.ZoneBoxKeys,
    zones.ZoneCylinderKeys,
    zones.ZoneSphereKeys,
    cell.AttachKeys,
)


def json_schema() -> Members:
    """Return the JSON schema (2020-12) of a configuration file.

    Group keys are allowed at the top.
    """
    made = _schema_of(SECTIONS, "rapidgen configuration")
    group = made["$defs"]["GroupKeys"]["properties"]
    made["properties"] = {**group, **made["properties"]}
    return made


def cell_schema() -> Members:
    """Return the JSON schema (2020-12) of a cell file."""
    return _schema_of(CELL_SECTIONS, "rapidgen cell")


def _schema_of(sections: tuple[type, ...], title: str) -> dict[str, Any]:
    """Return the schema of `sections`, the top of the file first."""
    from pydantic import TypeAdapter

    written = json.dumps(TypeAdapter(sections[0]).json_schema())
    made = json.loads(re.sub(r"\b(\w+Keys)\b", lambda result: _shown(result[0]), written))
    parts = {_shown(sections[0].__name__): made, **made["$defs"]}
    for section in sections:
        # pydantic drops the words next to a reference to another part.
        for key in dataclasses.fields(section):
            value = parts[_shown(section.__name__)]["properties"][key.name]
            value.setdefault("description", _doc(key.type))
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        **{key: value for key, value in made.items() if key != "title"},
    }


def _shown(name: str) -> str:
    """Return the editor's name of a part: without the class suffix."""
    return name if name == schema.GroupKeys.__name__ else name.removesuffix("Keys")


def reference(sections: tuple[type, ...] = SECTIONS) -> str:
    """Return Markdown tables of every key, in the order of `sections`."""
    return "\n".join(_section(part) for part in sections)


def _section(part: type) -> str:
    title = _key_of(part)
    text = (part.__doc__ or "").strip()
    lines = [f"### {title}", "", " ".join(text.split()), "", "| key | value | default | |"]
    lines.append("|---|---|---|---|")
    for field in dataclasses.fields(part):
        lines.append(
            f"| `{field.name}` | {_type(field.type)} | {_default(field)} | {_doc(field.type)} |"
        )
    return "\n".join([*lines, ""])


def _key_of(part: type) -> str:
    names = {
        schema.ConfigurationKeys: "top of the file",
        cell.CellKeys: "top of the file",
        cell.CellRobotKeys: "`robots.TASK`",
        cell.CellSignalKeys: "`signals.NAME`",
        cell.ReactionKeys: "`devices.NAME` (a list of these)",
        cell.CameraKeys: "`cameras.NAME`",
        cell.SeenKeys: "`cameras.NAME.images` (a list of lists of these)",
        cell.ForceKeys: "`force`",
        cell.ThingKeys: "`things.NAME`",
        cell.ShapeKeys: "`tools.NAME.shapes` (a list of these)",
        cell.RoundKeys: "`cylinder` and `capsule`",
        cell.CellToolKeys: "`tools.NAME`",
        cell.CollisionKeys: "`collision`",
        cell.AllowedKeys: "`collision.pairs.NAME - NAME`",
        zones.ZoneKeys: "`zones.NAME`",
        zones.ZoneBoxKeys: "`zones.NAME.box`",
        zones.ZoneCylinderKeys: "`zones.NAME.cylinder`",
        zones.ZoneSphereKeys: "`zones.NAME.sphere`",
        cell.AttachKeys: "`attach` (a list of these)",
        schema.GroupKeys: "`groups.NAME`",
        schema.JointKeys: "`joints.NAME`",
        schema.ChainStepKeys: "`chain` (a list of these)",
        schema.FrameKeys: "frames",
        schema.LoadKeys: "`tool.load`",
        schema.SignalKeys: "`signals.NAME`",
        schema.DatumKeys: "`data.MODULE:NAME`",
        schema.WorkObjectKeys: "`work_object`",
    }
    return names.get(part, f"`{_shown(part.__name__).lower()}`")


def _rules(hint: Hint) -> tuple[Rule, ...]:
    if typing.get_origin(hint) is typing.Annotated:
        first, *rules = typing.get_args(hint)
        return (*_rules(first), *(rule for rule in rules if isinstance(rule, Rule)))
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return tuple(rule for option in typing.get_args(hint) for rule in _rules(option))
    return ()


def _doc(hint: Hint) -> str:
    return next((rule.doc for rule in reversed(_rules(hint)) if rule.doc), "")


def _type(hint: Hint) -> str:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is typing.Annotated:
        name = _type(arguments[0])
        return ", ".join([name, *(_bounds(r) for r in arguments[1:] if _bounds(r))])
    if origin in (typing.Union, types.UnionType):
        return " or ".join(_type(a) for a in arguments if a is not type(None))
    if origin is typing.Literal:
        return " ".join(f"`{a}`" for a in arguments)
    if origin is list:
        return f"list of {_type(arguments[0])}"
    if origin is dict:
        return f"{_type(arguments[0])}: {_type(arguments[1])}"
    if hint is Any:
        return "version"
    names: dict[Hint, str] = {
        str: "text",
        int: "whole number",
        float: "number",
        bool: "`true` `false`",
    }
    return names.get(hint, "see below")


def _bounds(rule: Rule) -> str:
    parts = []
    for name, sign in (("gt", ">"), ("ge", "≥"), ("lt", "<"), ("le", "≤")):
        bound = getattr(rule, name)
        if bound is not None:
            parts.append(f"{sign} {bound:g}")
    if rule.min_length is not None and rule.min_length == rule.max_length:
        parts.append(f"{rule.min_length} entries")
    if rule.pattern:
        parts.append(schema.FORMS[rule.pattern][0])
    return " and ".join(parts)


def _default(field: "dataclasses.Field[object]") -> str:
    if field.default is not dataclasses.MISSING:
        value = field.default
    elif field.default_factory is not dataclasses.MISSING:
        value = field.default_factory()
    else:
        return "required"
    if isinstance(value, tuple):  # a version
        return f"`{value[0]}.{value[1]}`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if value in (None, "", [], {}) or dataclasses.is_dataclass(value):
        return ""
    return f"`{value}`"
