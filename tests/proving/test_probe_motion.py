"""The moving probe, run on the virtual controller, tells how that one's motion is switched."""

import re
from dataclasses import replace

import pytest

from rapidgen._data import data_folder
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.machine.operator import Answer
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid import check, parse

PROBE = data_folder("templates") / "ROS_probe_motion.mod"
ASKED = {
    "zero_length": ("skip", "wait"),
    "refresh_timed": (True, False),
    "stop_waits": (False, True),
    "cleared_move": ("return", "hang"),
    "range_error": ("recoverable", "fatal"),
}

# A move that never returns ends the questions.
BASE = MotionSettings(cleared_move="return")


def run(settings, consent="Yes"):
    """Lines on the pendant, and axis 6 over time."""
    lines, places = [], []
    answers = [Answer(consent)]
    robots = load_config("irb120").groups
    with VirtualController.from_files([PROBE], robots=robots, answers=answers) as controller:
        controller.motion.settings = settings
        controller.operator.subscribe(lambda _task, text: lines.append(text))
        for _ in range(90):
            controller.run_for(0.5)
            places.append(controller.motion.group("rob1").positions()[5])
        if controller.task("T_ROB1").state == "error":
            assert lines[-1].startswith("! If the program stops now: ")
            lines.append(lines[-1].rpartition(": ")[2])
    return lines, places


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in ASKED.items() for value in values]
)
def test_an_answer_is_the_switch(name, value):
    settings = replace(BASE, **{name: value})
    lines, places = run(settings)
    told = dict(re.findall(r"^(\w+)=(\w+)$", "\n".join(lines), re.MULTILINE))
    wanted = {asked: str(getattr(settings, asked)).lower() for asked in ASKED}
    if value == "hang":
        # Nothing can be asked any more when a move never returns.
        del wanted["range_error"]
    assert {key: told[key].lower() for key in wanted} == wanted
    assert max(places) < 0.19
    assert min(places) > -0.01


@pytest.mark.parametrize("lead", [0.05, 0.2])
def test_the_planning_lead_is_told(lead):
    lines, _ = run(replace(MotionSettings(), planning_lead=lead, ramp_time=0.0))
    (line,) = [line for line in lines if "before its point" in line]
    assert float(re.search(r"[\d.]+", line)[0]) == pytest.approx(lead, abs=0.12)


def test_without_consent_nothing_moves():
    lines, places = run(MotionSettings(), consent="No")
    assert lines == []
    assert set(places) == {0.0}


def test_the_probe_is_clean_rapid(tmp_path):
    module = parse(PROBE.read_bytes(), path=str(PROBE))
    assert not module.diagnostics
    assert not list(check([module]))
    assert main(["probe", "--moving", "--output", str(tmp_path / "p.mod")]) == 0
    assert (tmp_path / "p.mod").read_bytes() == PROBE.read_bytes()
