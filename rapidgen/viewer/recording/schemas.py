"""JSON schemas of a recording's channels, for readers of MCAP.

Foxglove and Lichtblick accept plain schemas only: every field has a type, arrays have one type of
items, objects their properties. They reject references, unions and tuples, and the whole channel
with them [parseJsonSchema in their mcap-support]. This module simplifies Pydantic's schemas.
"""

from collections.abc import Iterable

from pydantic import BaseModel

from rapidgen._json import Json, Members, items, members, text


def plain_schema(kind: type[BaseModel], signals: Iterable[str] = ()) -> Members:
    """Return the schema of a message; `values` of signals have their names."""
    complete: Members = kind.model_json_schema()
    made = _plain(complete, members(complete.get("$defs", {})))
    if "values" in members(made["properties"]):
        numbers: Members = {name: {"type": "number"} for name in signals}
        members(made["properties"])["values"] = {"type": "object", "properties": numbers}
    return made


def _plain(schema: Members, definitions: Members) -> Members:
    def inner(part: Json) -> Members:
        return _plain(members(part), definitions)

    if "$ref" in schema:
        return inner(definitions[text(schema["$ref"]).rpartition("/")[2]])
    if "anyOf" in schema:
        # A field that may be absent is null then.
        return inner(next(o for o in items(schema["anyOf"]) if members(o).get("type") != "null"))
    made: Members = {key: schema[key] for key in ("type", "description", "enum") if key in schema}
    if made["type"] == "object":
        own = members(schema.get("properties", {}))
        made["properties"] = {name: inner(part) for name, part in own.items()}
    if made["type"] == "array":
        # Numbers of a frame are separate columns of the same type.
        several = items(schema.get("prefixItems", []))
        made["items"] = inner(several[0] if several else schema["items"])
    return made
