"""The exploration finds what drivers in use get wrong, and nothing where nothing is wrong."""

import io
import re
from dataclasses import replace

import pytest

from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import with_module
from rapidgen.proving.explore import STEPS, explore
from rapidgen.rapid import check, parse
from tests.proving.defective import CAPACITY, DEFECTS, FOLDER, small_driver, with_defect

SIX_AXES = load_config("irb120")
SMALL = replace(SIX_AXES, trajectory=replace(SIX_AXES.trajectory, capacity=CAPACITY))
SYMPTOMS = {
    "R1": "that nothing disturbed ended",
    "R5": "set free, and got MoveAbsJ of the old trajectory",
    "R7a": "",
    "R7b": "",
    "R12": "",
}


# Of what a history must be made to meet a defect; `benchmarks/exploration.py` finds them among all.
STEP = {
    "R1": "over-capacity",
    "R5": "stopped",
    "R7a": "interrupted",
    "R7b": "stopped",
    "R12": "vanishes",
}


@pytest.mark.parametrize("defect", DEFECTS)
def test_a_known_defect_is_found(defect):
    system = small_driver(defect)
    for seed in range(300):
        finding = explore(SMALL, system, seed, only=(STEP[defect],)).finding
        if finding is not None:
            break
    assert finding is not None
    assert SYMPTOMS[defect] in finding.detail
    if defect.startswith("R7"):
        assert "WaitTestAndSet lock" in "\n".join(finding.log)
        assert ("pp-to-main" in finding.plan) == (defect == "R7a")


@pytest.mark.parametrize(
    ("seed", "told"), [(0, "while nothing disturbs it: length"), (6, "length")]
)
def test_bytes_that_are_no_message_are_a_finding(seed, told):
    """Also where they come before a history begins: to whoever looks what the driver executes."""
    system = make_system(SIX_AXES, build(SIX_AXES))
    modules = [module for task in system.tasks for module in task.modules]
    sends = next(module for module in modules if module.name == "ROS_socket")
    broken = sends.data.replace(
        b"SocketSend client", b"PackRawBytes 1, data, 1 \\IntX:=DINT;\n        SocketSend client"
    )
    system = with_module(system, sends.path, broken)
    finding = explore(SIX_AXES, system, seed, only=("stopped",)).finding
    assert finding is not None
    assert finding.detail.startswith(told)


def test_nothing_is_found_without_a_defect():
    system = small_driver()
    assert [explore(SMALL, system, seed).finding for seed in range(40)] == [None] * 40


@pytest.mark.parametrize("defect", ["", *DEFECTS])
def test_the_small_driver_is_rapid(defect):
    texts = {
        path.name: with_defect(path.read_text(encoding="ascii"), defect)
        for path in FOLDER.glob("*.[ms]*")
    }
    modules = [parse(text.encode(), path=name) for name, text in texts.items()]
    assert not list(check(modules))
    plain = {path.name: path.read_text(encoding="ascii") for path in FOLDER.glob("*.[ms]*")}
    assert (texts != plain) == bool(defect)


@pytest.mark.parametrize("seed", [3, 4, 5])
def test_a_schedule_is_the_same_when_it_is_traced(seed):
    system = make_system(SIX_AXES, build(SIX_AXES))
    story = io.StringIO()
    traced = explore(SIX_AXES, system, seed, trace=story)
    assert traced == explore(SIX_AXES, system, seed)
    assert re.search(r" T_ROB1 +ROS_motion/", story.getvalue())


def test_every_step_alone_leaves_a_good_driver_good():
    system = make_system(SIX_AXES, build(SIX_AXES))
    for name in STEPS:
        assert explore(SIX_AXES, system, 5, only=(name,)).finding is None, name


def test_replay_tells_the_story(tmp_path, capsys):
    trace = tmp_path / "trace.txt"
    assert main(["test", "irb120", "--replay", "3", "--trace", str(trace)]) == 0
    out = capsys.readouterr().out
    assert "connect" in out
    assert "seed 3: the invariant held" in out
    assert "ROS_motionServer/" in trace.read_text(encoding="utf-8")
    assert main(["test", "irb120", "--replay", "3", "--trace", str(tmp_path / "no" / "f")]) == 2
    assert "RG803" in capsys.readouterr().err
