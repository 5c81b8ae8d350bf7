"""The cache of a shipped model equals its file."""

import json
import sys

import pytest

from rapidgen.config import load_config, model_cache, shipped_names
from rapidgen.config.model_cache import shipped_groups


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A place of its own for what is kept."""
    monkeypatch.setattr(model_cache, "_FOLDER", tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    (tmp_path / "code.py").write_text("1")
    return tmp_path / "__pycache__"


@pytest.mark.parametrize("name", shipped_names())
def test_the_groups_are_those_of_the_file_made_and_kept(folder, name):
    groups = load_config(name).groups
    assert shipped_groups(name) == groups
    assert [path.name.split(".")[0] for path in folder.iterdir()] == [name]
    assert shipped_groups(name) == groups


def kept(folder):
    (path,) = folder.iterdir()
    return path


@pytest.mark.parametrize("change", ["model", "code"])
def test_another_file_or_other_code_makes_it_anew(folder, monkeypatch, tmp_path, change):
    shipped_groups("irb120")
    result = json.loads(kept(folder).read_text())
    result["groups"][0]["name"] = "kept"
    kept(folder).write_text(json.dumps(result))
    assert shipped_groups("irb120")[0].name == "kept"
    if change == "code":
        (tmp_path / "code.py").write_text("12")
    else:
        changed = tmp_path / "irb120.yaml"
        changed.write_bytes(model_cache.find_shipped("irb120").read_bytes() + b"\n")
        monkeypatch.setattr(model_cache, "find_shipped", lambda _: changed)
    assert shipped_groups("irb120")[0].name == "rob1"


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"key": 1'])
def test_a_damaged_one_is_made_anew(folder, text):
    shipped_groups("irb120")
    kept(folder).write_text(text)
    assert shipped_groups("irb120")[0].name == "rob1"
    assert kept(folder).read_text() != text


def test_nothing_is_written_where_python_writes_nothing(folder, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    assert shipped_groups("irb120")[0].name == "rob1"
    assert not folder.exists()
