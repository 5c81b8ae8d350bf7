"""Circular imports and untyped code stay below their limits, and the counting works."""

import pytest

from tests.docs.figures import FIGURES, classes, words
from tests.docs.tree import circles, imports, modules, package_of


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.what)
def test_figure_is_within_its_limit(figure):
    worst = [f"{size:.4g} {where}" for size, where in sorted(figure.found(), reverse=True)[:10]]
    assert figure.value() <= figure.limit, worst


def test_circles_are_found():
    assert circles({"a": ["b"], "b": ["c"], "c": ["a", "d"], "d": [], "e": ["f"], "f": ["e"]}) == [
        ["a", "b", "c"],
        ["e", "f"],
    ]


def test_words_and_classes_are_counted():
    assert len(words("class")) > 500
    assert len(classes()) > 300
    assert "rapidgen.config.model" in imports()["rapidgen.config.load"]
    assert {package_of(name) for name in modules()} >= {"", "axes", "cli", "wire"}
