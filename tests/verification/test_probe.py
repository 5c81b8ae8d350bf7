"""The probe on the virtual controller reports its switches."""

from dataclasses import replace
from functools import partial

import pytest

from rapidgen._data import data_folder
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.rapid import check, parse
from rapidgen.rapid.switches import Switches
from rapidgen.verification.settings import assumption_choices, assumption_text
from tests.verification.probing import answers, asked

PROBE = data_folder("templates") / "ROS_probe.mod"
TEXT = PROBE.read_text(encoding="ascii")
TEXT = PROBE.read_text(encoding="ascii")
# Only a task that moves no robot can be asked these.
AFTER = ("calc_in_background", "data_of_tasks")
ASKED = tuple(name for name in asked(TEXT) if name not in AFTER)
CASES = [
    (n, value) for n, own in assumption_choices(Switches()).items() if n in ASKED for value in own
]


def run(path, dialect):
    """Lines on the pendant, and whether an error stopped the program."""
    lines = []
    robots = load_config("irb120").groups
    with VirtualController.from_files(
        [path], robots=robots, dialect=dialect, cycle="once"
    ) as controller:
        controller.operator.subscribe(lambda _task, text: lines.append(text))
        controller.run(max_time=60)
        return lines, controller.task("T_ROB1").state == "error"


@pytest.mark.parametrize(("name", "value"), CASES)
def test_an_answer_is_the_switch(name, value, tmp_path):
    set_so = replace(Switches(), **{name: value})
    reply = answers(TEXT, tmp_path / PROBE.name, partial(run, dialect=set_so))
    assert len(reply) == len(ASKED)
    assert set(reply) == {assumption_text(asked, getattr(set_so, asked)) for asked in ASKED}


@pytest.mark.parametrize("value", [True, False])
@pytest.mark.parametrize("name", AFTER)
def test_probe_questions_of_a_task_without_robot(name, value, tmp_path):
    path = tmp_path / PROBE.name
    path.write_text(TEXT, encoding="ascii")
    lines = []
    with VirtualController.from_files(
        {"T_ROB1": [path], "T_BACK": [path]},
        robots=load_config("irb120").groups,
        dialect=replace(Switches(), **{name: value}),
        cycle="once",
    ) as controller:
        controller.operator.subscribe(lambda _task, text: lines.append(text))
        controller.run(max_time=60)
    assert assumption_text(name, value) in lines


def test_it_asks():
    assert {"dnum_whole", "unhandled_error", "argument_error", "unpack_ulint"} <= set(ASKED)


def test_the_probe_is_clean_rapid(tmp_path):
    module = parse(PROBE.read_bytes(), path=str(PROBE))
    assert not module.diagnostics
    assert main(["probe", "--output", str(tmp_path / "p.mod")]) == 0
    assert (tmp_path / "p.mod").read_bytes() == PROBE.read_bytes()
    assert main(["check", str(tmp_path / "p.mod")]) == 0
    assert main(["probe", "--output", str(tmp_path / "nowhere" / "p.mod")]) == 2


def test_the_checker_finds_nothing():
    assert not list(check([parse(PROBE.read_bytes(), path=str(PROBE))]))
