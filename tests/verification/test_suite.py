"""The suite passes for every kind of robot, and detects defects."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rapidgen import __version__
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.diagnostics import refusal
from rapidgen.generate import build, make_system
from rapidgen.verification.model import CaseResult, CheckFailed, SuiteResult
from rapidgen.verification.report import slowest, write_html
from rapidgen.verification.schedule_exploration import explore
from rapidgen.verification.settings import Setting, assumed, rows, settings
from rapidgen.verification.suite import CASES
from rapidgen.verification.suite_runner import Starter, run_suite
from rapidgen.verification.testbench import Bench, with_module

KINDS = ("irb2400", "irb14000", "irb120_track", "irb910sc", "irb460")
SIX_AXES = load_config("irb120")
BY_NAME = {case.name: case for case in CASES}
# What depends on the joints of a robot ...
OF_THE_ROBOT = (
    "whole-trajectory",
    "at-the-limits",
    "outside-limits",
    "start-too-far",
    "padding",
    "limits-as-told",
    "first-of-all",
    "stream-joints",
    "away-from-zero",
    "stop-on-path",
    "e-stop",
    "corners",
    "largest-corner",
    "resting-corner",
)
# ... and what depends on when which task runs, and on what is assumed about controllers.
OF_THE_CONTROLLER = (
    "whole-trajectory",
    "hole",
    "stop-on-path",
    "stop-any-moment",
    "superseded",
    "leaves-moving",
    "newest-takes-over",
    "program-stop",
    "stop-pp-to-main",
    "power-loss",
    "not-executing",
)


# What the smallest configuration has not.
NOT_OF_SIX_AXES = (
    "batch-full-ring",
    "program-without-signals",
    "two-groups",
    "data-reading-fails",
    "routine-missing",
    "routine-results",
    "routine-alone",
    "routine-targets",
    "slowed-down",
    "strangers",
    "tcp-too-fast",
    "tcp-arc",
    "tcp-turns",
    "tcp-recorded",
)


def broken(config, names, setting=None, untried=()):
    """What did not hold, of the named cases, or was not tried and is not known to be so."""
    starter = Starter(config, make_system(config, build(config)), setting or Setting())
    result = failed(starter, names, untried)
    starter.close()
    return result


def failed(starter, names, untried=()):
    """The same on a controller that has booted."""
    outcomes = [starter.attempt(BY_NAME[name]) for name in names]
    assert {o.case for o in outcomes if o.untried} == set(untried)
    return {outcome.case: outcome.detail for outcome in outcomes if not outcome.passed}


# What takes seconds of CPU each: tests of their own, which long_tests.txt may name.
COSTLY = (
    "stop-every-statement",
    "progress-every-statement",
    "wire-stop-every-statement",
    "half-files",
    "stale-data",
    "state-for-hours",
    "counters-wrap",
    "instructions-fail",
    "full-capacity",
    "idle-client",
    "mixed-builds",
    "stream",
)


@pytest.fixture(scope="module")
def six_axes():
    """A controller with the driver of one robot; each case begins in a copy of its process."""
    starter = Starter(SIX_AXES, make_system(SIX_AXES, build(SIX_AXES)), Setting())
    yield starter
    starter.close()


GROUPS = [group for group in dict.fromkeys(case.group for case in CASES) if group != "guiding"]
"""Sessions of guidance need `egm:` in the configuration: test_guidance.py."""


@pytest.mark.parametrize("group", GROUPS)
def test_everything_holds_for_six_axes(six_axes, group):
    names = [case.name for case in CASES if case.group == group and case.name not in COSTLY]
    untried = [name for name in names if name in NOT_OF_SIX_AXES]
    assert failed(six_axes, names, untried=untried) == {}


@pytest.mark.parametrize("name", COSTLY)
def test_a_costly_case_holds_for_six_axes(six_axes, name):
    assert failed(six_axes, [name]) == {}


@pytest.mark.parametrize("name", KINDS)
def test_joint_cases_pass_for_every_robot_kind(name):
    # Its arms have a ceiling that is too low for large corners.
    untried = ("largest-corner",) if name == "irb14000" else ()
    assert broken(load_config(name), OF_THE_ROBOT, untried=untried) == {}


@pytest.mark.parametrize("texts", [texts for texts in rows().values() if texts])
def test_it_holds_whatever_is_assumed(texts):
    assert broken(SIX_AXES, OF_THE_CONTROLLER, assumed(texts)) == {}


def test_no_schedule_breaks_the_invariant():
    report = run_suite(load_config("irb120"), seeds=12, jobs=1, only=(), strength=0, cases=False)
    assert report.schedules == 12
    assert report.findings == []


def generated():
    config = load_config("irb120")
    return config, make_system(config, build(config))


def patched(system, module, old, new):
    file = next(m for t in system.tasks for m in t.modules if m.name == module)
    assert file.data.count(old.encode()) == 1, f"{module} no longer has: {old}"
    return with_module(system, file.path, file.data.replace(old.encode(), new.encode()))


DEFECTS = {
    # The sequence check of the motion server, left out.
    "hole": (
        "ROS_motionServer",
        "ELSEIF sequence = ROS_point_count OR sequence = ROS_SEQ_END OR ROS_point_count = 0 THEN",
        "ELSEIF TRUE THEN",
    ),
    "too-many-points": (
        "ROS_motionServer",
        "ROS_refuse_download ROS_REASON_CAPACITY, ROS_point_count, sequence = ROS_SEQ_END;",
        "",
    ),
    "padding": (
        "ROS_motionServer",
        "IF NOT (padding = 0) ROS_set_fault 100 * 8",
        "IF FALSE ROS_set_fault 100 * 8",
    ),
    "newest-takes-over": (
        "ROS_motionServer",
        "is_taken_over := (silence >= TAKEOVER_DELAY);",
        "is_taken_over := FALSE;",
    ),
    "leaves-moving": (
        "ROS_motionServer",
        "IF NOT (is_taken_over AND ROS_is_active()) ROS_end_trajectory ROS_REASON_CLIENT_LOST;",
        "",
    ),
    # The event routines count no stop of the program.
    "order-before-stop": (
        "ROS_common",
        "ROS_program_stops := ROS_next_count(ROS_program_stops);",
        "",
    ),
    # What waits behind a client counts as new when it is read.
    "waiting-before-stop": (
        "ROS_motionServer",
        "IF ROS_peek(newcomer) = 0 stops_before_newcomer := stops;",
        "stops_before_newcomer := stops;",
    ),
    # Bytes that are still unread count as sent after STOP.
    "unread-before-stop": (
        "ROS_motionServer",
        "IF ROS_peek(client) = 0 ROS_stops_before := stops;",
        "ROS_stops_before := stops;",
    ),
    "power-loss-after-stop": (
        "ROS_supervisor",
        "ROS_start_clock clock_wakeup;\n        ROS_start",
        "ROS_start",
    ),
    "task-ends-moving": (
        "ROS_common",
        "RETURN unchanged >= ROS_MAX_MISSED_COUNTS;",
        "RETURN FALSE;",
    ),
    "speed-keeps-own": (
        "ROS_motion",
        "program_percent := program_refresh();",
        "program_percent := 100;",
    ),
}


@pytest.mark.parametrize("name", DEFECTS)
def test_case_with_its_defect_fails(name):
    config, system = generated()
    bench = Bench(config, patched(system, *DEFECTS[name]))
    with pytest.raises(CheckFailed):
        BY_NAME[name].prove(bench)
    bench.close()


def test_the_exploration_replays_exactly():
    config, system = generated()
    logs = []
    for _ in range(2):
        bench_log = explore(config, system, "5")
        logs.append(bench_log)
    assert logs[0] == logs[1]


def test_command_writes_reports_and_names_failures(tmp_path, capsys):
    junit, html = tmp_path / "r.xml", tmp_path / "r.html"
    values = ["test", "irb120", "--quick", "--jobs", "1", "--case", "whole-trajectory"]
    assert main([*values, "--junit", str(junit), "--html", str(html)]) == 0
    assert "): passed, in " in capsys.readouterr().out
    suite = ElementTree.parse(junit).getroot()[0]
    assert suite.get("failures") == "0"
    page = html.read_text(encoding="utf-8")
    assert "<svg" in page
    assert f"rapidgen {__version__} · Python " in page
    assert '<input id="search" type="search"' in page
    assert '<summary>compatible: <span class="ok">1 of 1 held</span>' in page
    assert main(["test", "irb120", "--case", "whole-trajectry"]) == 2
    assert "whole-trajectory" in capsys.readouterr().err


def test_a_group_is_open_where_one_did_not_hold(tmp_path):
    outcomes = [
        CaseResult("fine", "A", "holds", "", True, elapsed=1.0),
        CaseResult("fine", "A", "holds", "", True, setting="other", elapsed=3.0),
        CaseResult("poor", "B", "does not", "", False, "because", elapsed=2.0),
    ]
    report = SuiteResult("cell", "0123456789ab", outcomes)
    write_html(report, tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert re.findall(r'<details class="group"(.*?)><summary>(\w)', page) == [
        ("", "A"),
        (" open", "B"),
    ]
    assert slowest(report, 1) == [("fine", 4.0, 2)]


def test_the_cases_are_listed(capsys):
    assert main(["test", "irb120", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "  hello " in "\n".join(lines)
    assert main(["test", "irb120", "--list", "--json"]) == 0
    reply = json.loads(capsys.readouterr().out)
    assert [case["case"] for case in reply] == [case.name for case in CASES]
    assert len(lines) == len(reply) + len({case["group"] for case in reply})


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_interrupted_run_reports_its_results(jobs, monkeypatch, capsys):
    def interrupted(bars, what, done, total):
        if done == 1:
            raise KeyboardInterrupt

    monkeypatch.setattr("rapidgen.cli.terminal.Bars._step", interrupted)
    values = ["--case", "hello", "--case", "single-point", "--quick", "--jobs", jobs, "--json"]
    assert main(["test", "irb120", *values]) == 130
    reply = json.loads(capsys.readouterr().out)
    assert [outcome["passed"] for outcome in reply["outcomes"]] == [True]
    assert (reply["broken_off"], reply["passed"]) == (True, False)


def test_the_table_of_faults_names_cases_that_exist():
    page = Path(__file__).parents[2] / "docs" / "use" / "test-driver.md"
    text = page.read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\d+) \| .+? \| (.+?) \|$", text, re.MULTILINE)
    assert [int(number) for number, _ in rows] == list(range(1, 26))
    for number, cases in rows:
        named = re.findall(r"(?<![`\w-])[a-z0-9]+(?:-[a-z0-9]+)*", cases.split(" (")[0])
        known = [name for name in named if name in BY_NAME]
        assert (known and known == named) or "every case" in cases, f"fault {number}: {cases}"


def test_every_case_has_a_name_of_its_own():
    assert len(BY_NAME) == len(CASES)


def test_every_robot_has_settings_for_its_groups():
    assert "rob_r" in settings(load_config("irb14000"), rows(0))


EXAMPLES = sorted((Path(__file__).parents[2] / "robots" / "examples").glob("*.yaml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_can_be_proven(path, capsys):
    """One commissions, one has a main of its own, one several groups."""
    values = ["test", str(path), "--quick", "--case", "ping", "--case", "sent-meanwhile"]
    assert main([*values, "--jobs", "1"]) == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "case", "values"),
    [
        # Its axes accelerate slowly.
        ("irb460-rw7", "one-place", ()),
        # A ceiling of the TCP, and a zone whose parts are not as 2 to 3.
        ("irb2400-rw5", "unknown-corner", ()),
        ("irb2400-rw5", "e-stop-at-speed", ()),
        # A TCP too slow to get off its path.
        ("crb15000-rw7", "e-stop-at-speed", ()),
        ("irb120-rw6", "another-program", ("--set", "main=own")),
        ("irb120-rw6", "program-prefix", ("--set", "commissioning=true")),
        ("irb120-rw6", "own-main", ("--set", "commissioning=true")),
    ],
)
def test_a_case_holds_on_robots_and_configurations_unlike_others(name, case, values, capsys):
    path = next(str(path) for path in EXAMPLES if path.stem == name)
    values = ["test", path, "--quick", "--jobs", "1", "--case", case, *values]
    assert main(values) == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    ("override", "case", "why"),
    [
        ("commissioning=true", "not-executing", "while commissioning, background tasks stop"),
        ("ports.control=0", "program-paused", "there is no control port"),
        ("profile=basic", "stream", "the profile is basic"),
        ("name=cell", "two-groups", "there is one group"),
    ],
)
def test_case_that_does_not_apply_is_not_counted_as_passed(override, case, why, tmp_path, capsys):
    report = tmp_path / "r.xml"
    values = ["test", "irb120", "--set", override, "--quick", "--jobs", "1", "--case"]
    assert main([*values, case, "--junit", str(report)]) == 2
    reply = capsys.readouterr()
    assert "RG811" in reply.err
    assert why in reply.err
    assert "passed" not in reply.out
    assert not report.exists()
    assert main([*values, case, "--case", "ping", "--junit", str(report)]) == 0
    reply = capsys.readouterr().out
    assert f"not applicable: {why}" in reply
    assert re.findall(r"^ (\w+) +(\d+) +(\d+)", reply, re.MULTILINE) == [("compatible", "1", "1")]
    suite = ElementTree.parse(report).getroot()[0]
    assert (suite.get("skipped"), len(suite.findall("testcase/skipped"))) == ("1", 1)


def test_configuration_fault_in_a_worker_is_a_diagnostic(monkeypatch, capsys):
    def at_fault(system, _config):
        raise refusal("RG402", None, "no main", "write one")

    monkeypatch.setattr("rapidgen.verification.suite_runner.in_its_cell", at_fault)
    values = ["test", "irb120", "--set", "main=own", "--quick", "--case", "ping", "--jobs", "2"]
    assert main(values) == 2
    assert "RG402" in capsys.readouterr().err
