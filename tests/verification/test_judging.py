"""Mutants are judged by the cases that reach them, in forks."""

import os
import signal
from dataclasses import replace
from functools import partial

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.rapid import parse
from rapidgen.verification.campaign import Campaign, Limits
from rapidgen.verification.result_file import Results
from rapidgen.verification.suite import CASES
from rapidgen.verification.testbench import with_module
from rapidgen.verification.worker_pool import ForkFailed, LocalPool, each, run_in_fork
from tools.mutation.driver import Mutant, mutants
from tools.mutation.judging import (
    Judge,
    Learned,
    Learning,
    Noticed,
    Question,
    grounds,
    judged,
    verdicts,
)

SIX_AXES = load_config("irb120")
SYSTEM = make_system(SIX_AXES, build(SIX_AXES))
FEW = [case for case in CASES if case.name in ("ping", "stop-answered", "whole-trajectory")]


@pytest.fixture(scope="module")
def given():
    return grounds(SIX_AXES, SYSTEM, FEW, partial(LocalPool, jobs=1))


@pytest.fixture(scope="module")
def judge(given):
    judge = Judge(given)
    yield judge
    judge.close()


def file_of(name):
    return next(m for t in SYSTEM.tasks for m in t.modules if m.name == name)


def changed(name, old, new):
    file = file_of(name)
    at = file.data.index(old)
    line = file.data.count(b"\n", 0, at) + 1
    return Mutant(file.path, line, line, "", file.data.replace(old, new, 1))


def test_a_mutant_is_noticed_by_a_case_that_reaches_it(judge):
    mutant = changed("ROS_motion", b"MoveAbsJ point.target \\NoEOffs", b"WaitTime 0;!")
    assert [case.name for case in judge.concerned(mutant, Learned())] == ["whole-trajectory"]
    verdict = judge.judge(Question(mutant))
    assert verdict.by == "whole-trajectory"
    assert len(verdict.tried) == 1


def test_a_mutant_that_no_case_reaches_survives(judge):
    mutant = changed("ROS_motion", b"fault := ROS_REASON_INTERNAL;", b"fault := 1;")
    assert judge.concerned(mutant, Learned()) == []
    assert judge.judge(Question(mutant)).by == ""


def test_a_mutant_that_cannot_be_loaded_is_noticed(judge):
    mutant = changed("ROS_motion", b"ENDMODULE", b"")
    assert judge.judge(Question(mutant)).by == "(not loaded)"


def test_a_case_that_does_not_hold_at_all_judges_nothing():
    file = file_of("ROS_motion")
    text = file.data.replace(b"MoveAbsJ point.target", b"MoveAbsJ ROS_none.target")
    with pytest.raises(ValueError, match="does not hold"):
        grounds(SIX_AXES, with_module(SYSTEM, file.path, text), FEW, partial(LocalPool, jobs=1))


def test_mutant_is_judged_at_its_enclosing_statement():
    file = file_of("ROS_motion")
    lines = file.data.decode().splitlines()
    for mutant in mutants(file.data, file.path):
        assert mutant.statement <= mutant.line
        if mutant.statement:
            assert not lines[mutant.statement - 1].lstrip().startswith(("ELSE", "!", "PROC"))


def test_a_fork_answers_raises_or_fails():
    assert run_in_fork(lambda: [1, "two"]) == [1, "two"]
    with pytest.raises(KeyError, match="lost"):
        run_in_fork(lambda: {}["lost"])
    with pytest.raises(ForkFailed):
        run_in_fork(lambda: os.kill(os.getpid(), signal.SIGKILL))


def test_a_case_that_noticed_a_neighbour_is_tried_first(judge):
    mutant = Mutant("untouched", 20, 0, "", b"")
    learning = Learning([case.name for case in FEW])
    last = judge.concerned(mutant, learning.about(mutant))[-1].name
    learning.learn(Noticed(mutant.path, mutant.line, "(not loaded)"))
    learning.learn(Noticed(mutant.path, mutant.line + 2, f"{last} (hangs)"))
    assert judge.concerned(mutant, learning.about(mutant))[0].name == last
    assert learning.about(replace(mutant, line=90)) == Learned({}, {last: 1})


def test_cases_left_out_by_the_budget_are_counted(judge):
    mutant = changed("ROS_server", b"ROS_partial_bytes := 0;\n        RETURN", b"RETURN")
    every = replace(mutant, statement=0)
    assert judge.judge(Question(every, budget=0)).left == len(FEW)


def test_a_case_that_did_not_notice_it_before_is_not_tried_again(judge):
    mutant = changed(
        "ROS_server",
        b"IF ROS_partial_bytes > 0 OR bytes_left",
        b"IF ROS_partial_bytes >= 0 OR bytes_left",
    )
    every = replace(mutant, statement=0)
    names = tuple(case.name for case in judge.concerned(every, Learned()))
    assert judge.judge(Question(every, budget=0, already=names[:1])).left == len(FEW) - 1
    assert judge.judge(Question(every, already=names)).tried == ()


def test_case_is_tried_again_under_another_setting(judge, given):
    mutant = changed("ROS_server", b"ROS_partial_bytes := 0;\n        RETURN", b"RETURN")
    every = replace(mutant, statement=0)
    names = tuple(case.name for case in judge.concerned(every, Learned()))
    other = Judge(replace(given, row=" [pairs 3]", kept=[]))
    assert other.judge(Question(every, budget=0, already=names)).left == len(names)
    other.close()


def test_a_bound_that_is_set_to_itself_is_no_mutant():
    data = b"""MODULE m
    PROC p()
        VAR num a;
        VAR num b;

        IF a < b a := b;
        IF a < b b := a;
    ENDPROC
ENDMODULE
"""
    assert [m.line for m in mutants(data, "m.mod") if m.change == "< -> <="] == [7]


def test_verdicts_after_interruption_are_equal(given, tmp_path):
    file = file_of("ROS_server")
    some = list(mutants(file.data, file.path))[:24:3]

    def judge_all(path, jobs, *, resume=False):
        work = verdicts([Question(m) for m in some], Learning(given.cases), str)
        with (
            Results(path, "mutants", resume=resume) as results,
            LocalPool(replace(given, kept=[]), jobs) as workers,
        ):
            campaign = Campaign(workers, results, Limits(), None)
            return [replace(verdict, elapsed=0) for verdict in campaign.run(work)]

    complete, two = tmp_path / "one.jsonl", tmp_path / "two.jsonl"
    result = judge_all(complete, 1)
    assert {v.by for v in result} > {""}
    assert [(v.path, v.line) for v in result] == [(m.path, m.line) for m in some]
    two.write_bytes(b"".join(complete.read_bytes().splitlines(keepends=True)[:4]))
    assert judge_all(two, 2, resume=True) == result
    assert two.read_bytes() == complete.read_bytes()


def test_a_worker_with_another_checkout_is_refused(given):
    other = replace(given, text="of another state", kept=[])
    with LocalPool(other, 1) as workers, pytest.raises(RuntimeError, match="checkout"):
        list(each(workers, [Question(Mutant("ROS_motion.mod", 1, 0, "", b""))], judged))


def test_a_mutant_differs_in_one_place_and_is_still_rapid():
    data = file_of("ROS_motion").data
    result = list(mutants(data, "ROS_motion.mod"))
    assert len(result) > 60
    assert all(mutant.text != data for mutant in result)
    for mutant in result[::10]:
        assert not parse(mutant.text).diagnostics, mutant.change
