"""Field rules of the configuration's schema, and their validator.

The schema consists of plain dataclasses. Loading needs only pydantic-core, whose schema `core`
builds itself: importing and building full pydantic models would take as long as the rest of a
build. `rapidgen schema` lets pydantic read the same classes, through the two hooks of `Rule`.
"""

import dataclasses
import types
import typing
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

CoreSchema = dict[str, Any]
Hint: TypeAlias = object
"""A type as an annotation holds it: a class, or one of typing's forms."""

_LARGEST = 1e6
"""Maximum angle, length, speed or acceleration of a robot (deg, mm, kg, s); a num holds such a
figure to a tenth [K §2.13].
"""

_LEAVES: dict[Hint, CoreSchema] = {
    str: {"type": "str", "strict": True},
    int: {"type": "int", "strict": True},
    float: {
        "type": "float",
        "strict": True,
        "allow_inf_nan": False,
        "ge": -_LARGEST,
        "le": _LARGEST,
    },
    bool: {"type": "bool", "strict": True},
}
_BOUNDS = ("gt", "ge", "lt", "le", "min_length", "max_length", "pattern")


@dataclass(frozen=True, slots=True)
class Rule:
    """Meaning (`doc`) and allowed values of a field."""

    doc: str = ""
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None
    min_length: int | None = None
    max_length: int | None = None
    pattern: str | None = None
    before: Callable[[object], object] | None = None
    """Converts the file's value; raises ValueError."""
    json: CoreSchema | None = None
    """JSON schema of the input of `before`."""

    def apply(self, schema: CoreSchema) -> CoreSchema:
        """Return the core schema narrowed by this rule."""
        if schema["type"] == "nullable":
            return {**schema, "schema": self.apply(schema["schema"])}
        value = {name: getattr(self, name) for name in _BOUNDS}
        schema = {**schema, **{k: v for k, v in value.items() if v is not None}}
        if self.before:
            return {
                "type": "function-before",
                "function": {"type": "no-info", "function": self.before},
                "schema": schema,
            }
        return schema

    def __get_pydantic_core_schema__(
        self, source: object, handler: Callable[[object], CoreSchema]
    ) -> CoreSchema:
        return self.apply(handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: Callable[[CoreSchema], CoreSchema]
    ) -> CoreSchema:
        made = dict(self.json) if self.json else handler(schema)
        return {**made, "description": self.doc} if self.doc else made


def core(hint: Hint) -> CoreSchema:
    """Return the core schema of a type that the configuration uses."""
    if hint is Any:
        return {"type": "any"}
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is typing.Annotated:
        schema = core(arguments[0])
        for rule in arguments[1:]:
            schema = rule.apply(schema)
        return schema
    if origin in (typing.Union, types.UnionType):
        choices = [core(a) for a in arguments if a is not type(None)]
        made = choices[0] if len(choices) == 1 else {"type": "union", "choices": choices}
        return {"type": "nullable", "schema": made} if type(None) in arguments else made
    if origin is typing.Literal:
        return {"type": "literal", "expected": list(arguments)}
    if origin is list:
        return {"type": "list", "items_schema": core(arguments[0]), "strict": True}
    if origin is dict:
        keys, values = arguments
        return {
            "type": "dict",
            "keys_schema": core(keys),
            "values_schema": core(values),
            "strict": True,
        }
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        return _dataclass(hint)
    return dict(_LEAVES[hint])


def _dataclass(cls: type) -> CoreSchema:
    fields = dataclasses.fields(cls)
    return {
        "type": "dataclass",
        "cls": cls,
        "fields": [f.name for f in fields],
        "frozen": True,
        "schema": {
            "type": "dataclass-args",
            "dataclass_name": cls.__name__,
            "extra_behavior": "forbid",
            "fields": [
                {"type": "dataclass-field", "name": f.name, "schema": _with_default(f)}
                for f in fields
            ],
        },
    }


def _with_default(field: "dataclasses.Field[object]") -> CoreSchema:
    schema = core(field.type)
    if field.default is not dataclasses.MISSING:
        return {"type": "default", "schema": schema, "default": field.default}
    if field.default_factory is not dataclasses.MISSING:
        return {"type": "default", "schema": schema, "default_factory": field.default_factory}
    return schema
