"""One source of the schema: loading, editors and docs agree."""

import re
from pathlib import Path

import pytest
from pydantic import TypeAdapter, ValidationError
from pydantic_core import SchemaValidator
from pydantic_core import ValidationError as CoreError

from rapidgen.config import load_config, shipped_names
from rapidgen.config.registry import find_shipped
from rapidgen.config.rules import core
from rapidgen.config.schema import GROUP_KEYS, TOP_KEYS, ConfigurationKeys
from rapidgen.config.schema_reference import json_schema, reference
from rapidgen.config.yaml_tree import parse, to_python

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "robots" / "examples").glob("*.yaml"))


def test_the_reference_page_is_the_schemas():
    page = (ROOT / "docs" / "start" / "configuration.md").read_text(encoding="utf-8")
    assert page.endswith(reference()), "python -m tests.docs.configuration_keys"


def test_every_key_has_words_and_is_in_the_json_schema():
    schema = json_schema()
    assert set(schema["properties"]) == {*TOP_KEYS, *GROUP_KEYS}
    assert schema["additionalProperties"] is False
    for name, part in [("top", schema), *schema["$defs"].items()]:
        for key, value in part["properties"].items():
            assert value.get("description"), f"{name}.{key}"


def test_the_json_schema_refuses_a_misspelt_key_in_every_part():
    for name, part in json_schema()["$defs"].items():
        assert part["additionalProperties"] is False, name


def test_yaml_in_the_documentation_loads(tmp_path):
    (tmp_path / "urdf").mkdir()
    (tmp_path / "cell").mkdir()
    for page in ("start/configuration.md", "start/robots.md"):
        text = (ROOT / "docs" / page).read_text(encoding="utf-8")
        for block in re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
            block = block.replace("../urdf/", str(ROOT / "robots" / "urdf") + "/")
            block = block.replace("yumi.urdf", str(ROOT / "robots" / "urdf" / "irb14000.urdf"))
            block = block.replace("yumi_link_7", "tool0")
            path = tmp_path / "cell" / "cell.yaml"
            path.write_text(block)
            assert load_config(path).groups, block


VALUES = [
    {},
    {"name": "a"},
    {"name": "9a"},
    {"name": ""},
    {"name": 3},
    {"controller": {"robotware": "6.10"}},
    {"controller": {"robotware": "4"}},
    {"controller": {"type": "irc6"}},
    {"controller": None},
    {"controller": []},
    {"groups": {"a": {"ports": {"motion": 1024}}}},
    {"groups": {"a": {"ports": {"motion": 65536}}}},
    {"groups": {"A": {}}},
    {"groups": {"a": {"joints": {"j": {"axis": "rax_7"}}}}},
    {"groups": {"a": {"joints": {"j": {"sign": -1, "speed": 0}}}}},
    {"groups": {"a": {"chain": [{"xyz": [1, 2]}]}}},
    {"groups": {"a": {"chain": [{"xyz": [1, 2, 3], "follows": {"j": 1}}]}}},
    {"groups": {"a": {"coupling": 2}}},
    {"groups": {"a": {"source": {"colour": "x"}}}},
    {"groups": {"a": {"urdf": {}}}},
    {"groups": {"a": {"urdf": {"file": "x", "args": {"a": True, "b": 1, "c": "d"}}}}},
    {"signals": {"s": {"kind": "DO"}}},
    {"signals": {"s": {"kind": "XX"}}},
    {"trajectory": {"capacity": 2}},
    {"trajectory": {"capacity": 1}},
    {"network": {"bind": "wan"}},
    {"unknown": 1},
]


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_pydantic_and_the_loader_judge_alike(value):
    """The loader builds its validator without pydantic's own (slow) classes."""
    try:
        TypeAdapter(ConfigurationKeys).validate_python(value)
        by_pydantic = True
    except ValidationError:
        by_pydantic = False
    try:
        SchemaValidator(core(ConfigurationKeys)).validate_python(value)
        by_loader = True
    except CoreError:
        by_loader = False
    # The loader is the stricter of the two: it does not turn 3 into "3" or "3" into 3.
    assert by_loader == by_pydantic


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_examples_fit_the_schema(path):
    data = to_python(parse(path.read_text(encoding="utf-8"), path.name)[0])
    known = set(json_schema()["properties"])
    assert set(data) <= known
    assert load_config(path).name == path.stem


@pytest.mark.parametrize("name", shipped_names())
def test_shipped_files_have_groups_only_if_needed(name):
    data = to_python(parse(find_shipped(name).read_text(encoding="utf-8"), name)[0])
    assert data["description"]
    assert data["generations"]
    assert len(data.get("groups", {})) != 1
