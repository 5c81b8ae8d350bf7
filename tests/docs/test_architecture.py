"""docs/develop/architecture.md describes the tree: its pictures, and the places that it names."""

import re

import pytest

from tests.docs import life
from tests.docs.picture import PICTURE, draw, layers, says
from tests.docs.tree import PACKAGE, ROOT, modules

PAGE = (ROOT / "docs" / "develop" / "architecture.md").read_text(encoding="utf-8")
PLACE = re.compile(r"`((?:rapidgen|templates|tests|robots)/[\w/.]+)`(?:: `(\w+)`)?")
WHERE, RECIPES = (
    "\n".join(p.read_text(encoding="utf-8") for p in sorted((ROOT / "docs" / "develop").glob(name)))
    for name in ("where-is.md", "recipes*.md")
)
PLACES = sorted({place for place in PLACE.findall(PAGE + WHERE + RECIPES) if "<" not in place[0]})


def test_package_list_matches_tree():
    assert PICTURE.on_the_page() == draw(), "python -m tests.docs.picture"


def test_trajectory_walk_matches_run():
    assert life.PICTURE.on_the_page() == life.draw(), "python -m tests.docs.life"


def test_contract_has_every_package():
    packages = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert {name for layer in layers() for name in layer} == packages


def test_every_folder_has_docstring():
    folders = [name for name, path in modules().items() if path.name == "__init__.py"]
    assert [name for name in folders if len(says(name)) < 20] == []


@pytest.mark.parametrize(("path", "name"), PLACES, ids=lambda part: part)
def test_named_place_exists(path, name):
    assert (ROOT / path).exists(), path
    if name:
        text = (ROOT / path).read_text(encoding="utf-8")
        declared = rf"^\s*(async )?(def|class|(LOCAL )?(PROC|FUNC \w+)) {name}\b"
        assert re.search(declared, text, re.MULTILINE), (path, name)


def test_places_are_named():
    assert len(PLACES) > 40


def test_recipes_cover_common_additions():
    titles = re.findall(r"^## An? (.+)$", RECIPES, re.MULTILINE)
    wanted = (
        "built-in",
        "RobotWare switch",
        "configuration key",
        "behaviour of the driver",
        "page of the documentation",
        "message",
        "command",
        "robot",
        "transport",
        "server",
        "diagnostic",
    )
    assert [word for word in wanted if not any(title.startswith(word) for title in titles)] == []
