"""The probe, run on the virtual controller, tells how that one is switched."""

from dataclasses import replace

import pytest

from rapidgen._data import data_folder
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.rapid import check, parse
from rapidgen.rapid.switches import Switches, parse_switches

PROBE = data_folder("templates") / "ROS_probe.mod"
ASKED = {
    "num_rounding": ("store", "operation"),
    "dnum_whole": ("52", "53"),
    "for_loop": ("kernel", "tested"),
    "integer_division": ("truncate", "floor"),
    "negative_mod": ("allow", "error"),
    "wait_until": ("polled", "event"),
    "unpack_ulint": ("exact", "single", "error"),
    "unpack_beyond": ("error", "zero"),
    "pack_beyond": ("zero", "error"),
    "find_behind": ("none", "error"),
    "byte_to_str": ("character", "code"),
    "axis_limits_told": (True, False),
    "alias_by_name": (True, False),
    "unhandled_error": ("propagate", "stop"),
}


def answers(dialect):
    lines = []
    robots = load_config("irb120").groups
    with VirtualController.from_files(
        [PROBE], robots=robots, dialect=dialect, cycle="once"
    ) as controller:
        controller.operator.subscribe(lambda _task, text: lines.append(text))
        controller.run(max_time=60)
        state = controller.task("T_ROB1").state
    if state == "error":
        assert lines[-1].startswith("! If the program stops now: ")
        lines.append(lines[-1].rpartition(": ")[2])
    return ",".join(line for line in lines if not line.startswith("!"))


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in ASKED.items() for value in values]
)
def test_an_answer_is_the_switch(name, value):
    set_so = replace(Switches(), **{name: value})
    told = parse_switches(answers(set_so))
    assert {n: getattr(told, n) for n in ASKED} == {n: getattr(set_so, n) for n in ASKED}


def test_the_probe_is_clean_rapid(tmp_path):
    module = parse(PROBE.read_bytes(), path=str(PROBE))
    assert not module.diagnostics
    assert main(["probe", "--output", str(tmp_path / "p.mod")]) == 0
    assert (tmp_path / "p.mod").read_bytes() == PROBE.read_bytes()
    assert main(["check", str(tmp_path / "p.mod")]) == 0
    assert main(["probe", "--output", str(tmp_path / "nowhere" / "p.mod")]) == 2


def test_the_checker_finds_nothing():
    assert not list(check([parse(PROBE.read_bytes(), path=str(PROBE))]))
