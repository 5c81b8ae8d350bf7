"""The figures of the tree do not get worse, and the functions that count them can count."""

import pytest

from tests.docs.figures import FIGURES, classes, files, words
from tests.docs.tree import circles, imports, modules, room


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.what)
def test_no_figure_gets_worse(figure):
    worst = [f"{size:.4g} {where}" for size, where in sorted(figure.found(), reverse=True)[:10]]
    assert figure.value() <= figure.limit, worst


def test_no_limit_is_below_its_target():
    assert [
        figure.what for figure in FIGURES if figure.target and figure.limit < figure.target
    ] == []


def test_circles_are_found():
    assert circles({"a": ["b"], "b": ["c"], "c": ["a", "d"], "d": [], "e": ["f"], "f": ["e"]}) == [
        ["a", "b", "c"],
        ["e", "f"],
    ]


def test_words_classes_and_files_are_counted():
    assert len(words("class$")) > 500
    assert len(classes()) > 300
    assert files()[-1][0] <= 1
    assert "rapidgen.config.model" in imports()["rapidgen.config.load"]
    assert {room(name) for name in modules()} >= {"", "axes", "cli", "wire"}
