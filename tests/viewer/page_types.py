"""The page's message types, made of the schema: `python -m tests.viewer.page_types` writes them."""

from pathlib import Path

from pydantic import TypeAdapter

from rapidgen.viewer.messages import Answer, PageRequest, Request, ToPage

TARGET = Path(__file__).parents[2] / "rapidgen" / "viewer" / "page" / "src" / "messages.ts"
_HEAD = (
    "// Made of rapidgen/viewer/messages.py by `python -m tests.viewer.page_types`; do not edit.\n"
)


def made() -> str:
    """The text of messages.ts."""
    complete = TypeAdapter(ToPage | PageRequest | Answer).json_schema(mode="serialization")["$defs"]
    parts = [_HEAD, *(_interface(name, complete[name]) for name in sorted(complete))]
    parts += [_union("ToPage", ToPage), _union("Request", Request)]
    return "\n".join(parts)


def _union(name: str, union: object) -> str:
    return f"export type {name} = {' | '.join(sorted(t.__name__ for t in union.__args__))};\n"


def _interface(name: str, schema: dict) -> str:
    about = " ".join(schema.get("description", "").split())
    fields = "".join(
        f"  readonly {key}: {_type(value)};\n" for key, value in schema["properties"].items()
    )
    return f"/** {about} */\nexport interface {name} {{\n{fields}}}\n"


def _type(schema: dict) -> str:
    if "$ref" in schema:
        return schema["$ref"].rpartition("/")[2]
    if "const" in schema:
        return f'"{schema["const"]}"'
    if "enum" in schema:
        return " | ".join(f'"{value}"' for value in schema["enum"])
    for key in ("anyOf", "oneOf"):
        if key in schema:
            return " | ".join(map(_type, schema[key]))
    match schema["type"]:
        case "array" if "prefixItems" in schema:
            return f"readonly [{', '.join(map(_type, schema['prefixItems']))}]"
        case "array":
            inner = _type(schema["items"])
            return f"readonly ({inner})[]" if " " in inner else f"readonly {inner}[]"
        case "object":
            return f"Readonly<Record<string, {_type(schema['additionalProperties'])}>>"
        case "integer" | "number":
            return "number"
        case other:
            return other


if __name__ == "__main__":
    TARGET.write_text(made())
