"""Work is done once, in order, by any worker, and resumes."""

import io
import json
import os
import signal
from dataclasses import replace

import pytest

from rapidgen.cli.app import main
from rapidgen.cli.terminal import Bars
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.verification.campaign import Limits
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import changed
from rapidgen.verification.raw_programs import in_rapid
from rapidgen.verification.report import as_json
from rapidgen.verification.result_file import Results
from rapidgen.verification.suite_runner import run_suite
from rapidgen.verification.worker_pool import (
    CachedResult,
    Call,
    LocalPool,
    WorkersLost,
    each,
    in_order,
    run_in_fork,
)

SIX_AXES = load_config("irb120")
FEW = ("ping", "hello", "single-point")


def double(_context, number):
    return 2 * number


def killed_once(path, number):
    """The third piece ends the first worker that has it."""
    if number == 2 and not path.exists():
        path.write_text("", encoding="ascii")
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def killed(_context, number):
    if number == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def fails(_context, number):
    if number == 1:
        raise ValueError("of the second")
    return number


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_results_with_any_worker_are_in_order(jobs):
    with LocalPool(None, jobs) as workers:
        assert list(each(workers, range(20), double)) == list(range(0, 40, 2))


def test_a_worker_that_is_killed_loses_nothing(tmp_path):
    with LocalPool(tmp_path / "was-killed", 2) as workers:
        assert list(each(workers, range(12), killed_once)) == list(range(12))
        assert len(workers.processes()) == 2
    assert (tmp_path / "was-killed").exists()


def test_idle_worker_that_is_killed_is_replaced():
    with LocalPool(None, 1) as workers:
        (process,) = workers.processes()
        os.kill(process, signal.SIGKILL)
        assert list(each(workers, range(3), double)) == [0, 2, 4]


def test_a_piece_that_ends_every_worker_ends_the_work():
    with LocalPool(None, 2) as workers, pytest.raises(WorkersLost, match="3 workers ended with 1"):
        list(each(workers, range(3), killed))


def test_exception_of_an_item_is_raised_with_its_traceback():
    with LocalPool(None, 2) as workers, pytest.raises(ValueError, match="of the second") as raised:
        list(each(workers, range(3), fails))
    assert "in fails" in str(raised.value.__cause__)
    with pytest.raises(ValueError, match="of the second") as raised:
        run_in_fork(lambda: run_in_fork(lambda: fails(None, 1)))
    assert "in fails" in str(raised.value.__cause__)


def test_a_piece_may_depend_on_the_results_before_it():
    accepted = []

    def make(number):
        assert len(accepted) >= max(0, number - 3)
        return CachedResult(number) if number % 4 == 0 else Call(number, double, number)

    with LocalPool(None, 2) as workers:
        for result in in_order(workers, 20, make, lambda number: number - 3):
            accepted.append(result)
    assert accepted == [n if n % 4 == 0 else 2 * n for n in range(20)]


def test_workers_end_with_their_parent():
    """Also when that is killed: no process of it stays."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        workers = LocalPool(None, 2)
        os.write(writing, json.dumps(workers.processes()).encode())
        os.kill(os.getpid(), signal.SIGKILL)
    os.waitpid(child, 0)
    os.close(writing)
    processes = json.loads(os.read(reading, 1000))
    # The pipe's other end is closed when the last of them has gone.
    assert os.read(reading, 1) == b""
    os.close(reading)
    assert len(processes) == 2


def comparable(report):
    """A report without what was measured."""
    result = as_json(report)
    del result["elapsed"]
    for outcome in result["outcomes"]:
        del outcome["elapsed"]
    return result


def test_results_after_interruption_with_other_workers_are_equal(tmp_path):
    files = []
    for jobs in (1, 2):
        path = tmp_path / f"{jobs}.jsonl"
        report = run_suite(SIX_AXES, jobs=jobs, only=FEW, strength=0, results=path)
        assert len(report.outcomes) == 3
        files.append(path.read_bytes())
    assert files[0] == files[1]
    lines = files[0].splitlines(keepends=True)
    broken_off = tmp_path / "broken-off.jsonl"
    broken_off.write_bytes(b"".join(lines[:2]) + lines[2][:40])
    again = run_suite(SIX_AXES, jobs=1, only=FEW, strength=0, results=broken_off, resume=True)
    assert broken_off.read_bytes() == files[0]
    assert comparable(again) == comparable(report)


def test_schedules_and_programs_do_not_depend_on_workers(tmp_path):
    result = [
        run_suite(
            SIX_AXES,
            seeds=10,
            programs=2,
            jobs=jobs,
            cases=False,
            strength=0,
            results=tmp_path / f"{jobs}.jsonl",
        )
        for jobs in (1, 3)
    ]
    assert comparable(result[0]) == comparable(result[1])
    assert result[0].curve[-1][1] > 20
    assert result[0].programs == 2
    assert (tmp_path / "1.jsonl").read_bytes() == (tmp_path / "3.jsonl").read_bytes()


def test_a_budget_that_is_over_leaves_the_rest(tmp_path):
    report = run_suite(SIX_AXES, jobs=1, only=FEW, strength=0, limits=Limits(budget=0))
    assert (report.outcomes, report.left, report.passed) == ([], 3, True)


def test_the_first_failure_ends_it(tmp_path, monkeypatch, capsys):
    values = ["test", "irb120", "--quick", "--stop-on-failure", "--json", "--jobs", "1"]
    names = ("ping", "hello", "single-point")
    monkeypatch.setattr("rapidgen.verification.testbench.Bench.assert_healthy", _ill)
    assert main([*values, *(word for name in names for word in ("--case", name))]) == 1
    result = json.loads(capsys.readouterr().out)
    assert [outcome["passed"] for outcome in result["outcomes"]] == [False]
    assert result["left"] == 2


def _slower(bench, program):
    return in_rapid(bench, [replace(order, speed=order.speed / 2) for order in program])


def _elsewhere(bench, program):
    first, *remaining = program
    return in_rapid(bench, [replace(first, joints=changed(first.joints, 1, 0.3149)), *remaining])


@pytest.mark.parametrize(
    ("otherwise", "expected"),
    [(_slower, "s when written in RAPID"), (_elsewhere, "mm off the way of the same in RAPID")],
)
def test_a_program_that_moves_otherwise_is_found_and_replayed(
    monkeypatch, capsys, otherwise, expected
):
    monkeypatch.setattr("rapidgen.verification.raw_programs.in_rapid", otherwise)
    values = ["test", "irb120", "--case", "hello", "--quick", "--seeds", "0", "--programs", "1"]
    assert main([*values, "--jobs", "1"]) == 1
    printed = capsys.readouterr().out
    assert expected in printed
    assert "rapidgen test irb120 --replay program/0 --record replay.mcap" in printed
    assert main(["test", "irb120", "--replay", "program/0"]) == 1
    assert expected in capsys.readouterr().out
    monkeypatch.undo()
    assert main(["test", "irb120", "--replay", "program/0"]) == 0


def test_a_basic_driver_takes_no_programs(capsys):
    basic = "robots/examples/irb120_basic-rw6.yaml"
    assert main(["test", basic, "--programs", "1"]) == 2
    assert "RG810" in capsys.readouterr().err


def _ill(bench):
    raise CheckFailed("it is ill")


def test_item_that_ends_its_workers_is_reported(monkeypatch, capsys):
    monkeypatch.setattr("rapidgen.verification.testbench.Bench.compile", _ends)
    assert main(["test", "irb120", "--quick", "--case", "ping", "--jobs", "1"]) == 2
    assert "RG809" in capsys.readouterr().err


def _ends(bench):
    os.kill(os.getpid(), signal.SIGKILL)


def test_results_of_something_else_are_not_gone_on_with(tmp_path):
    path = tmp_path / "results.jsonl"
    with Results(path, "this") as results:
        results.add("one", [1, 2])
    with pytest.raises(DiagnosticError, match="has results already"):
        Results(path, "this")
    with pytest.raises(DiagnosticError, match="of something else"):
        Results(path, "that", resume=True)
    with Results(path, "this", resume=True) as results:
        assert results.known("one") == [1, 2]
        assert results.known("two") is None
    for text in ("no json\n", "[]\n", '{"results_of": "this"}\n{"key": 1}\n'):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(DiagnosticError, match="is no file of results"):
            Results(path, "this", resume=True)
        assert path.read_text(encoding="utf-8") == text


@pytest.mark.parametrize(
    ("values", "code"),
    [
        (["--budget", "30"], "RG806"),
        (["--budget", "soon"], "RG806"),
        (["--resume"], "RG805"),
        (["--results", "no/such/folder"], "RG803"),
    ],
)
def test_limits_that_are_none_are_refused(values, code, capsys):
    assert main(["test", "irb120", "--quick", "--case", "ping", *values]) == 2
    assert code in capsys.readouterr().err


def test_a_pipe_gets_a_line_every_ten_seconds():
    now, stream = [0.0], io.StringIO()
    with Bars(stream, lambda: now[0]) as step:
        for done in range(1, 25):
            now[0] += 1.0
            step("schedules", done, 1024)
    assert stream.getvalue().splitlines() == [
        "schedules: 10 of 1024, 1 per second, 16 min 54 s left",
        "schedules: 20 of 1024, 1 per second, 16 min 44 s left",
    ]
