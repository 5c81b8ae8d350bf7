"""Settings combine any two answers; failures name their assumptions."""

import json
from collections.abc import Mapping
from dataclasses import fields
from itertools import combinations, product

import pytest

from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid.switches import NOT_THE_DRIVERS, Switches
from rapidgen.verification.case import SuiteCase
from rapidgen.verification.covering_array import covering
from rapidgen.verification.minimization import minimal_assumptions, smallest
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.settings import (
    FIGURES,
    NEEDED,
    Setting,
    assumed,
    assumption_text,
    possible,
    questions,
    rows,
)


def answers(texts):
    """What a row assumes, defaults included."""
    chosen = dict(text.split("=") for text in texts)
    return {
        n: chosen.get(n, assumption_text(n, own[0]).partition("=")[2])
        for n, own in questions().items()
    }


def missing(array, strength=2):
    """Combinations of answers that no row has, from the questions themselves."""
    requested = {
        n: [assumption_text(n, a).partition("=")[2] for a in own] for n, own in questions().items()
    }
    result = {
        tuple(zip(names, met, strict=True))
        for names in combinations(requested, strength)
        for met in product(*(requested[name] for name in names))
    }
    for texts in array:
        result -= set(combinations(answers(texts).items(), strength))
    return result


def test_any_two_answers_meet():
    array = list(rows().values())
    assert missing(array) == set()
    assert missing(array[:-1]) != set()
    assert len(array) <= 20


def test_the_default_comes_first():
    name, texts = next(iter(rows().items()))
    assert (name, texts) == ("", ())
    assert assumed(texts) == Setting()


def test_each_answer_alone_and_the_default_alone():
    assert missing(rows(1).values(), strength=1) == set()
    assert list(rows(0)) == [""]


@pytest.mark.parametrize(
    ("left_out", "in_time"),
    [("", False), ("schedule=pers", True), ("costs=4.0", True), ("planning_lead=0.02", True)],
)
def test_corner_may_be_late_only_on_slow_random_controllers(left_out, in_time):
    texts = {"schedule=pers", "costs=4.0", "planning_lead=0.02"} - {left_out}
    assert assumed(sorted(texts)).corners_in_time is in_time


@pytest.mark.parametrize("strength", [2, 3])
def test_an_array_covers_and_is_always_the_same(strength):
    factors: Mapping[str, str] = {"a": "xy", "b": "xyz", "c": "xy", "d": "wxyz", "e": "xy"}
    array = covering(factors, strength)
    assert array == covering(factors, strength)
    met = {result for row in array for result in combinations(row.items(), strength)}
    wanted = {
        tuple(zip(names, values, strict=True))
        for names in combinations(factors, strength)
        for values in product(*(factors[name] for name in names))
    }
    assert met == wanted
    assert len(array) < 2 * 4 * 3 * (2 if strength == 3 else 1)


def test_every_switch_is_asked_or_left_out_by_name():
    """A switch that is added later cannot be forgotten; only a figure has to be chosen."""
    switches = [*fields(Switches), *fields(MotionSettings)]
    names = [switch.name for switch in switches]
    assert len(names) == len(set(names))
    left_out = NEEDED | NOT_THE_DRIVERS
    assert left_out | set(FIGURES) <= set(names)
    for switch in switches:
        choice = isinstance(switch.default, bool | str)
        assert (switch.name in questions()) == (
            switch.name in FIGURES or (choice and switch.name not in left_out)
        )


@pytest.mark.parametrize("name", questions())
def test_an_assumption_is_made(name):
    """Every answer makes another setting, and the first one the default."""
    texts = [assumption_text(name, answer) for answer in questions()[name]]
    result = [assumed([text]) for text in texts]
    assert result[0] == Setting()
    assert all(a != b for a, b in combinations(result, 2))


@pytest.mark.parametrize("texts", ["setle=0.2", "settle=0.3", "settle", "seed=x", ","])
def test_unknown_assumption_is_reported(texts, capsys):
    assert main(["test", "irb120", "--assume", texts]) == 2
    assert "RG804" in capsys.readouterr().err


@pytest.mark.parametrize("guilty", [{"s7"}, {"s0", "s19"}, {"s3", "s4"}, {"s1", "s9", "s17"}])
def test_the_smallest_part_is_found(guilty):
    tried = []

    def breaks(part):
        tried.append(part)
        return guilty <= set(part)

    assert set(smallest([f"s{n}" for n in range(20)], breaks)) == guilty
    assert len(tried) < 120


def test_explanation_of_one_row_explains_others():
    tried = []

    def breaks(part):
        tried.append(part)
        return {"a", "b"} <= set(part)

    result = minimal_assumptions({"1": "abcd", "2": "fbga", "3": "ba"}, breaks)
    assert {name: set(part) for name, part in result.items()} == {key: {"a", "b"} for key in "123"}
    before = len(tried)
    minimal_assumptions({"1": "abcd"}, breaks)
    assert len(tried) == 2 * before


def _a_pair_breaks(bench):
    if bench.setting.motion.settle > 0 and bench.setting.dialect.for_loop == "tested":
        raise CheckFailed("it did not hold")


@pytest.fixture
def made_up(monkeypatch):
    case = SuiteCase("made-up", "a pair of assumptions breaks it", "made up", _a_pair_breaks)
    monkeypatch.setattr("rapidgen.verification.suite.CASES", (case,))
    monkeypatch.setattr("rapidgen.verification.suite_runner.CASES", (case,))
    hostile = ("costs=4.0", "settle=0.2", "for_loop=tested")
    array = {"": (), "pairs 1": hostile, "pairs 2": ("for_loop=tested", "seed=2")}
    monkeypatch.setattr("rapidgen.verification.suite_runner.rows", lambda strength: array)
    return ["test", "irb120", "--case", "made-up", "--jobs", "1"]


def test_a_break_names_the_pair(made_up, capsys, tmp_path):
    assert main([*made_up, "--json", "--junit", str(tmp_path / "r.xml")]) == 1
    report = json.loads(capsys.readouterr().out)
    (broken,) = [outcome for outcome in report["outcomes"] if not outcome["passed"]]
    assert broken["setting"] == "pairs 1"
    assert set(broken["blamed"]) == {"settle=0.2", "for_loop=tested"}
    assert set(broken["blamed"]) < set(report["settings"]["pairs 1"])
    assert "for_loop=tested" in (tmp_path / "r.xml").read_text(encoding="utf-8")
    assert not report["passed"]


def test_a_setting_can_be_asked_for_again(made_up, capsys):
    assert main([*made_up, "--assume", "settle=0.2"]) == 0
    assert main([*made_up, "--assume", "settle=0.2,for_loop=tested"]) == 1
    assert "made-up [as asked]: it did not hold" in capsys.readouterr().out


@pytest.mark.parametrize(("costs", "slowness"), [("0.25", 1.0), ("1.0", 1.0), ("4.0", 4.0)])
def test_time_limits_scale_up_with_slowness(costs, slowness):
    setting = assumed([f"costs={costs}"])
    assert setting.slowness == slowness
    assert setting.latest_interrupt == pytest.approx(0.03)


def test_assumption_without_support_is_not_named_as_cause():
    """A driver with a ceiling needs CalcRobT in its background task."""
    row = {"one": ("calc_in_background=false", "settle=0.2")}
    assert possible(load_config("irb120"), row) == row
    assert possible(load_config("irb14000"), row) == {"one": ("settle=0.2",)}
