"""The exploration finds known defects, and none in a correct driver."""

import io
import re
from dataclasses import replace
from functools import partial

import pytest

from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.controller.faults import FaultPlan
from rapidgen.generate import build, make_system
from rapidgen.machine.network.fault_injection import NetworkRule
from rapidgen.rapid import check, parse
from rapidgen.verification.bench_pool import BenchPool
from rapidgen.verification.minimization import smaller
from rapidgen.verification.model import Counterexample
from rapidgen.verification.schedule import Disturbance, TaskSchedule, drawn, named
from rapidgen.verification.schedule_exploration import STEPS, ScheduleResult, explore, ground_of
from rapidgen.verification.schedule_selection import ScheduleSelector
from rapidgen.verification.settings import Setting
from rapidgen.verification.suite_runner import DriverUnderTest, minimised, schedule
from rapidgen.verification.testbench import Bench, with_module
from rapidgen.viewer.recording.reader import RecordingFile
from rapidgen.viewer.recording.writer import record
from tests.verification.defective import CAPACITY, DEFECTS, FOLDER, small_driver, with_defect

SIX_AXES = load_config("irb120")
SMALL = replace(SIX_AXES, trajectory=replace(SIX_AXES.trajectory, capacity=CAPACITY))
SYMPTOMS = {
    "R1": "that nothing disturbed ended",
    "R5": "set free, and got MoveAbsJ of the old trajectory",
    "R7a": "",
    "R7b": "",
    "R12": "",
}


@pytest.mark.parametrize("defect", DEFECTS)
def test_a_known_defect_is_found_soon(defect):
    """Also `tools/exploration.py`: how soon in the median of many campaigns."""
    system = small_driver(defect)
    guide = ScheduleSelector(ground_of(SMALL, system))
    for number in range(30):
        finding = guide.take(explore(SMALL, system, guide.name(number))).finding
        if finding is not None:
            break
    assert finding is not None
    assert SYMPTOMS[defect] in finding.detail
    if defect.startswith("R7"):
        assert "WaitTestAndSet lock" in "\n".join(finding.log)
        assert ("pp-to-main" in finding.plan) == (defect == "R7a")


RESULTS = [ScheduleResult("", "", None, ((n, n + 1),) if n % 3 else ()) for n in range(60)]


def names_of(guide, *, late):
    """What a guide names when results are heard as late, or as early, as may be."""
    names, pending = [], []
    for number, result in enumerate(RESULTS):
        while pending and (not late or number - len(pending) < guide.needs(number)):
            guide.take(pending.pop(0))
        names.append(guide.name(number))
        pending.append(result)
    return names


def test_selector_with_any_number_of_runs_names_the_same():
    ground = ground_of(SMALL, small_driver())
    early = names_of(ScheduleSelector(ground), late=False)
    assert early == names_of(ScheduleSelector(ground), late=True)
    assert len(set(early)) == len(RESULTS)
    assert any("~" in name for name in early)
    assert names_of(ScheduleSelector(ground, first=1), late=False) != early


@pytest.mark.parametrize("text", ["17", "17~4~2", "17~4/steps=1,3", "0/steps=/turns/calm"])
def test_the_name_of_a_schedule_is_its_name(text):
    assert str(named(text)) == text


@pytest.mark.parametrize("text", ["", "x", "17~", "17/steps", "17/calm/turns", "-1"])
def test_a_schedule_without_a_name_is_refused(text, capsys):
    assert main(["test", "irb120", f"--replay={text}"]) == 2
    assert "RG807" in capsys.readouterr().err


def test_remaining_steps_of_a_schedule_are_drawn_as_before():
    ground = ground_of(SMALL, small_driver())
    complete, part = drawn(named("17~4"), ground), drawn(named("17~4/steps=1/turns/calm"), ground)
    assert part.steps == complete.steps[1:2]
    assert (part.order, part.network, part.seed) == ("turns", "good", complete.seed)


@pytest.mark.parametrize(
    ("seed", "reply"), [("0", "while nothing disturbs it: length"), ("7", "length")]
)
def test_bytes_that_are_no_message_are_a_finding(seed, reply):
    """Also before a history begins, while the driver's statements are recorded."""
    system = make_system(SIX_AXES, build(SIX_AXES))
    modules = [module for task in system.tasks for module in task.modules]
    sends = next(module for module in modules if module.name == "ROS_server")
    broken = sends.data.replace(
        b"SocketSend client", b"PackRawBytes 1, data, 1 \\IntX:=DINT;\n        SocketSend client"
    )
    system = with_module(system, sends.path, broken)
    finding = explore(SIX_AXES, system, seed, only=("stopped",)).finding
    assert finding is not None
    assert finding.detail.startswith(reply)


def test_nothing_is_found_without_a_defect():
    system = small_driver()
    assert [explore(SMALL, system, str(seed)).finding for seed in range(40)] == [None] * 40


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


@pytest.mark.parametrize("seed", ["3", "4~1", "5/steps=0,2/turns/calm"])
def test_a_schedule_is_the_same_when_it_is_traced_and_recorded(seed, tmp_path):
    system = make_system(SIX_AXES, build(SIX_AXES))
    story, path = io.StringIO(), tmp_path / "story.mcap"
    watched = explore(SIX_AXES, system, seed, trace=story, record=partial(record, path=path))
    reply = io.StringIO()
    assert watched == explore(SIX_AXES, system, seed, trace=reply)
    assert story.getvalue() == reply.getvalue()
    assert watched == explore(SIX_AXES, system, seed)
    assert re.search(r" T_ROB1 +ROS_motion/", story.getvalue())
    with RecordingFile(path) as recording:
        assert recording.end > 1


# In turns, at random, at every PERS, under priorities; over each kind of network.
@pytest.mark.parametrize("name", ["3/turns", "0", "2", "5", "7"])
def test_copy_of_a_pooled_controller_behaves_as_a_booted_one(name):
    driver = DriverUnderTest(SIX_AXES, make_system(SIX_AXES, build(SIX_AXES)))
    alone = explore(SIX_AXES, driver.system, name)
    for other in ("9", name, name):
        result = schedule(driver, other)
    assert result == replace(alone, plan="")


def test_pool_serves_settings_with_other_seed_and_network_only():
    system, fresh = small_driver(), BenchPool()
    slow = FaultPlan(network=(NetworkRule("delay", 11000, "in", seconds=0.1),))
    saved, other = Setting(seed=1), Setting(seed=2, faults=slow)
    fresh.keep(SMALL, system, saved)
    with fresh.take(SMALL, system, other) as bench, Bench(SMALL, system, other) as booted:
        assert bench.setting == booted.setting
        assert bench.controller.scheduler.seed == 2
        first = fresh.take(SMALL, system, saved)
        second = fresh.take(SMALL, system, replace(saved, switch_at_pers=True))
        with first, second:
            assert first.controller is not bench.controller
            assert second.controller.options.switching


STOPS_LATE = Disturbance("controlled", "STOP over the control port", None, "8")
LEAVES, IN_E_STOP = (
    Disturbance("vanishes", "", None, "107"),
    Disturbance("interrupted", "e-stop", None, "107"),
)


@pytest.mark.parametrize(
    "plan",
    [
        # A download that is on its way for longer than the STOP over the control port.
        TaskSchedule(
            (Disturbance("stopped", "STOP", None, "a"), STOPS_LATE), "turns", "delay", "0"
        ),
        # A client behind one that is gone without a word, whose data is read after Start.
        TaskSchedule((LEAVES, IN_E_STOP), "turns", "good", "107"),
    ],
)
def test_late_result_was_requested_late(plan, monkeypatch):
    monkeypatch.setattr(
        "rapidgen.verification.schedule_exploration.drawn", lambda name, ground: plan
    )
    system = make_system(SIX_AXES, build(SIX_AXES))
    assert explore(SIX_AXES, system, "0").finding is None


def test_every_step_alone_leaves_a_good_driver_good():
    system = make_system(SIX_AXES, build(SIX_AXES))
    for name in STEPS:
        assert explore(SIX_AXES, system, "5", only=(name,)).finding is None, name


def test_replay_prints_the_log(tmp_path, capsys):
    trace, recording = tmp_path / "trace.txt", tmp_path / "story.mcap"
    files = ["--trace", str(trace), "--record", str(recording)]
    assert main(["test", "irb120", "--replay", "3", *files]) == 0
    out = capsys.readouterr().out
    assert "connect" in out
    assert "schedule 3: invariant not violated" in out
    assert "ROS_motionServer/" in trace.read_text(encoding="utf-8")
    with RecordingFile(recording) as opened:
        assert opened.end > 1
    for option in ("--trace", "--record"):
        assert main(["test", "irb120", "--replay", "3", option, str(tmp_path / "no" / "f")]) == 2
        assert "RG803" in capsys.readouterr().err


def test_schedule_is_minimized_while_the_same_check_fails():
    def run(tried):
        steps = tried.steps if tried.steps is not None else (0, 1, 2, 3)
        if not {1, 3} <= set(steps):
            return Counterexample(str(tried), "something else", "") if 1 in steps else None
        # It needs the order in which tasks ran, and comes at another time in each.
        return (
            None if tried.turns else Counterexample(str(tried), f"at {len(steps)}.5 s it moved", "")
        )

    complete = run(named("7~2"))
    assert smaller(named("7~2"), 4, complete, run) == Counterexample(
        "7~2/steps=1,3/calm", "at 2.5 s it moved", ""
    )


def test_a_race_in_its_smallest_schedule_is_still_there():
    driver = DriverUnderTest(SMALL, small_driver("R7a"))
    guide = ScheduleSelector(ground_of(SMALL, driver.system))
    names = (guide.name(number) for number in range(8))
    result = (explore(SMALL, driver.system, name).finding for name in names)
    finding = next(one for one in result if one is not None)
    least = minimised(driver, finding)
    assert len(named(least.schedule).steps) == 2
    assert named(least.schedule).turns
    assert explore(SMALL, driver.system, least.schedule).finding == least
