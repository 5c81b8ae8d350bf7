"""The moving probe on the virtual controller reports its motion switches."""

import re
from dataclasses import asdict, replace
from functools import partial

import pytest

from rapidgen._data import data_folder
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.machine.operator import Answer
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid import check, parse
from rapidgen.rapid.switches import Switches
from rapidgen.verification.settings import assumed, assumption_choices, assumption_text
from tests.verification.probing import answers, asked

PROBE = data_folder("templates") / "ROS_probe_motion.mod"
TEXT = PROBE.read_text(encoding="ascii")
ASKED = asked(TEXT)
CHOICES = assumption_choices(MotionSettings()) | assumption_choices(Switches())
CASES = [(n, value) for n, own in CHOICES.items() if n in ASKED for value in own]


def run(path, settings, places, consent="Yes", dialect=None):
    """Lines on the pendant, and whether an error stopped the program; axis 6 goes to `places`."""
    lines = []
    robots = load_config("irb120").groups
    with VirtualController.from_files(
        [path], robots=robots, answers=[Answer(consent)], dialect=dialect
    ) as it:
        it.motion.settings = settings
        it.operator.subscribe(lambda _task, text: lines.append(text))
        for _ in range(180):
            it.run_for(0.5)
            places.append(it.motion.group("rob1").positions()[5])
        return lines, it.task("T_ROB1").state == "error"


@pytest.mark.parametrize(("name", "value"), CASES)
def test_an_answer_is_the_switch(name, value, tmp_path):
    setting, places = assumed([assumption_text(name, value)]), []
    ask = partial(run, settings=setting.motion, places=places, dialect=setting.dialect)
    reply = answers(TEXT, tmp_path / PROBE.name, ask)
    assert len(reply) == len(ASKED)
    chosen = asdict(setting.motion) | asdict(setting.dialect)
    assert set(reply) == {assumption_text(asks, chosen[asks]) for asks in ASKED}
    assert max(places) < 0.19
    assert min(places) > -0.01


def test_it_asks():
    wanted = {"cleared_move", "stop_move_reset", "zero_length", "unreachable_target"}
    wanted |= {"refresh_timed", "refresh_lasts", "refresh_standing", "velset_timed"}
    assert wanted <= set(ASKED)


@pytest.mark.parametrize("lead", [0.05, 0.2])
def test_planning_lead_is_reported(lead):
    lines, _ = run(PROBE, replace(MotionSettings(), planning_lead=lead, ramp_time=0.0), [])
    (line,) = [line for line in lines if "before its point" in line]
    assert float(re.search(r"[\d.]+", line)[0]) == pytest.approx(lead, abs=0.12)


def test_without_consent_nothing_moves():
    places = []
    assert run(PROBE, MotionSettings(), places, consent="No") == ([], False)
    assert set(places) == {0.0}


def test_the_probe_is_clean_rapid(tmp_path):
    module = parse(PROBE.read_bytes(), path=str(PROBE))
    assert not module.diagnostics
    assert not list(check([module]))
    assert main(["probe", "--moving", "--output", str(tmp_path / "p.mod")]) == 0
    assert (tmp_path / "p.mod").read_bytes() == PROBE.read_bytes()
