"""docs/rapid/runtime-rules.md names existing tests and all programs."""

import re
from dataclasses import fields
from pathlib import Path

from rapidgen.rapid.switches import NOT_THE_DRIVERS, Switches
from tests.rapid_programs import read_all

TESTS = Path(__file__).parents[1]
TEXT = (TESTS.parent / "docs" / "rapid" / "runtime-rules.md").read_text("utf-8")
ROWS = re.findall(
    r"^\| ([A-Z]*[\d.]*[A-Z]?-[^|]*) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", TEXT, re.MULTILINE
)
PROGRAMS = {
    program.below(TESTS)
    for folder in ("runtime/conformance", "runtime/builtins/conformance")
    for program in read_all(TESTS / folder)
}
OF_THE_LANGUAGE = {program.below(TESTS) for program in read_all(TESTS / "rapid/conformance")}
NAMED = {name for *_, held in ROWS for name in re.findall(r"`([^`]+)`", held)}


def exists(name: str) -> bool:
    if name in PROGRAMS | OF_THE_LANGUAGE:
        return True
    file, _, test = name.partition("::")
    path = TESTS / file
    return path.is_file() and (not test or f"def {test}(" in path.read_text("utf-8"))


def test_rules_have_existing_tests() -> None:
    assert len(ROWS) > 180
    assert sorted(name for name in NAMED if not exists(name)) == []


def test_every_program_holds_a_rule() -> None:
    assert sorted(PROGRAMS - NAMED) == []


def test_every_number_is_there_once() -> None:
    numbers = [number for row in ROWS for number in row[0].split()]
    assert len(numbers) == len(set(numbers))
    themes: dict[str, list[int]] = {}
    for number in numbers:
        theme, _, place = number.rpartition("-")
        themes.setdefault(theme, []).append(int(place))
    for theme, places in themes.items():
        assert sorted(places) == list(range(1, len(places) + 1)), theme


def test_every_switch_is_documented_with_its_values() -> None:
    page = (TESTS.parent / "docs" / "rapid" / "switches.md").read_text("utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| (`[^|]+) \| [^|]+ \|$", page, re.MULTILINE))
    for field in fields(Switches):
        default = field.default
        values = (
            [str(default).lower(), str(not default).lower()]
            if isinstance(default, bool)
            else [default, *(v for v in field.type.__args__ if v != default)]
        )
        assert rows[field.name].replace("`", "").split(", ") == values, field.name
    assert {f.name for f in fields(Switches)} >= NOT_THE_DRIVERS
