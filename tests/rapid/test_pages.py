"""Examples of the diagnostics' pages: only the bad one gives the code."""

import re

import pytest

from rapidgen.diagnostics.pages import codes, page
from rapidgen.rapid import check

EXAMPLE = re.compile(r"```rapid\n(.*?)```", re.DOTALL)
PAGES = [
    (code, *EXAMPLE.findall(page(code)))
    for code in codes()
    if code.startswith(("RG2", "RG3")) and EXAMPLE.search(page(code))
]


def test_most_pages_have_examples_in_rapid():
    assert len(PAGES) > 40


@pytest.mark.parametrize(("code", "bad", "good"), PAGES, ids=[p[0] for p in PAGES])
def test_bad_example_gives_only_its_code(code, bad, good):
    findings = check(bad, path="bad.mod")
    assert {d.code for d in findings} == {code}, [f"{d.code} {d.message}" for d in findings]


@pytest.mark.parametrize(("code", "bad", "good"), PAGES, ids=[p[0] for p in PAGES])
def test_good_example_is_clean(code, bad, good):
    assert check(good, path="good.mod") == []
