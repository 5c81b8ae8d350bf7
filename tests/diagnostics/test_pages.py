"""Every code in use has a page with both examples, and vice versa."""

import re
from pathlib import Path

import pytest

import rapidgen
from rapidgen.diagnostics.pages import codes, page, title

PACKAGE = Path(rapidgen.__file__).parent
FILES = sorted((PACKAGE / "diagnostics" / "pages").glob("*.md"))


def used_codes():
    result = {}
    for path in PACKAGE.rglob("*.py"):
        for code in re.findall(r"[\"'](RG\d{3,4})[\"']", path.read_text(encoding="utf-8")):
            result.setdefault(code, path)
    return result


def test_every_used_code_has_a_page():
    missing = {
        code: str(path.relative_to(PACKAGE))
        for code, path in used_codes().items()
        if code not in codes()
    }
    assert not missing


def test_no_page_is_without_a_use():
    assert not set(codes()) - set(used_codes())


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_file_has_the_codes_of_its_range_in_order_and_once(path):
    first, last = re.match(r"RG(\d{3})-(\d{3})-", path.name).groups()
    found = re.findall(r"^# RG(\d+)", path.read_text(encoding="utf-8"), re.MULTILINE)
    assert found == sorted({code for code in found if first <= code <= last})


def test_every_code_is_in_one_file():
    text = "".join(path.read_text(encoding="utf-8") for path in FILES)
    assert re.findall(r"^# (RG\d+)", text, re.MULTILINE) == codes()


@pytest.mark.parametrize("code", codes())
def test_a_page_has_a_title_a_reason_and_both_examples(code):
    text = page(code)
    assert re.match(rf"# {code}: \S", text)
    assert title(code)
    head, bad, good = re.split(r"^## (?:Bad|Good)$", text, flags=re.MULTILINE)
    assert len(head.split("\n", 1)[1].strip()) > 40
    for example in (bad, good):
        assert re.search(r"```\w+\n.+?\n```", example, re.DOTALL), text
