"""docs/develop/architecture.md is the tree: its picture, and what it says to be where."""

import re

import pytest

from tests.docs import life
from tests.docs.picture import PICTURE, draw, layers, says
from tests.docs.tree import PACKAGE, ROOT, modules

PAGE = (ROOT / "docs" / "develop" / "architecture.md").read_text(encoding="utf-8")
PLACE = re.compile(r"`((?:rapidgen|templates|tests|robots)/[\w/.]+)`(?:: `(\w+)`)?")
RECIPES = (ROOT / "docs" / "develop" / "recipes.md").read_text(encoding="utf-8")
PLACES = sorted({place for place in PLACE.findall(PAGE + RECIPES) if "<" not in place[0]})


def test_the_picture_is_the_tree():
    assert PICTURE.on_the_page() == draw(), "python -m tests.docs.picture"


def test_the_life_of_a_trajectory_is_what_happens():
    assert life.PICTURE.on_the_page() == life.draw(), "python -m tests.docs.life"


def test_the_contract_has_every_room():
    rooms = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert {name for layer in layers() for name in layer} == rooms


def test_every_folder_says_what_it_is():
    folders = [name for name, path in modules().items() if path.name == "__init__.py"]
    assert [name for name in folders if len(says(name)) < 20] == []


@pytest.mark.parametrize(("path", "name"), PLACES, ids=lambda part: part)
def test_what_is_said_to_be_somewhere_is_there(path, name):
    assert (ROOT / path).exists(), path
    if name:
        text = (ROOT / path).read_text(encoding="utf-8")
        declared = rf"^\s*(async )?(def|class|(LOCAL )?(PROC|FUNC \w+)) {name}\b"
        assert re.search(declared, text, re.MULTILINE), (path, name)


def test_every_room_has_a_chapter():
    chapters = " ".join(re.findall(r"^### (.+)$", PAGE, re.MULTILINE))
    assert [name for layer in layers() for name in layer if name not in chapters] == []
    assert len(PLACES) > 40


def test_there_is_a_recipe_for_what_is_added_most():
    titles = re.findall(r"^## An? (.+)$", RECIPES, re.MULTILINE)
    wanted = ("built-in", "message", "verb", "robot", "transport", "face", "diagnostic")
    assert [word for word in wanted if not any(title.startswith(word) for title in titles)] == []


def test_every_file_that_a_chapter_names_is_there():
    missing = []
    chapters = re.findall(r"^### ([a-z, ]+)\n\n(.*?)(?=^##)", PAGE, re.MULTILINE | re.DOTALL)
    for title, text in chapters:
        rooms = [PACKAGE / room for room in title.split(", ")]
        for named in re.findall(r"`([\w/]+\.py|[\w/]+/)`", text):
            result = [path for room in rooms for path in room.rglob(named)]
            missing += [(title, named)] * (not result and not (ROOT / named).exists())
    assert len(chapters) > 10
    assert missing == []
