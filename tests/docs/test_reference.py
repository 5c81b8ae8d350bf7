"""The reference of the client: each public name once, each method under a task."""

import inspect
import re
from collections import Counter
from importlib import import_module
from pathlib import Path

import pytest

import rapidgen.client as client
from rapidgen.client import egm
from rapidgen.controller import VirtualController

PAGES = Path(__file__).parents[2] / "docs" / "reference" / "client"
TEXT = "\n".join(page.read_text(encoding="utf-8") for page in sorted(PAGES.glob("*.md")))
ENTRIES = Counter(
    re.findall(r"^\.\. (?:auto|py:)\w+:: (?:rapidgen\.client\.(?:egm\.)?)?(\S+)", TEXT, re.M)
)
BY_TASK = ["Robot", "Controller", "Trajectory", "Program", "Pose", "Execution", "Stream"]


@pytest.mark.parametrize("name", sorted({*client.__all__, *egm.__all__} - {"AsyncController"}))
def test_public_name_has_one_entry(name):
    assert ENTRIES[name] == 1


@pytest.mark.parametrize("name", BY_TASK)
def test_public_methods_are_listed_by_task(name):
    kind = getattr(client, name)
    inherited = {"count", "index"} if issubclass(kind, tuple) else set()
    public = {member for member in dir(kind) if not member.startswith("_")} - inherited
    listed = {entry.partition(".")[2] for entry in ENTRIES if entry.startswith(f"{name}.")}
    assert listed == public


@pytest.mark.parametrize("name", ["config", "controller", "generate", "rapid"])
def test_package_has_an_entry_for_each_public_name(name):
    page = (PAGES.parent / f"{name}.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\.\. auto(?:class|function|exception):: (?:\S+\.)?(\w+)$", page, re.M)
    assert set(import_module(f"rapidgen.{name}").__all__) <= set(listed)


def test_virtual_controller_methods_are_listed_by_task():
    page = (PAGES.parent / "controller.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\.\. auto\w+:: VirtualController\.(\w+)$", page, re.M)
    public = {member for member in dir(VirtualController) if not member.startswith("_")}
    assert sorted(listed) == sorted(public)


def test_asynchronous_methods_are_those_of_the_other_class():
    for one in ("Robot", "Execution", "ProgramRun", "Stream"):
        other = getattr(client, f"Async{one}")
        names = {e.partition(".")[2] for e in ENTRIES if e.startswith(f"{one}.")}
        assert {n for n in names if inspect.getattr_static(other, n, None) is not None} == {
            e.partition(".")[2] for e in ENTRIES if e.startswith(f"Async{one}.")
        }
