"""Workers of a Dask scheduler: equal results, none lost with a worker."""

import os
import re
import signal
import subprocess
import sys

import pytest

from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.verification.suite_runner import run_suite
from rapidgen.verification.worker_pool import each
from tests.verification.test_campaigns import FEW, comparable, double

pytest.importorskip("distributed")

from rapidgen.verification.cluster import Cluster, rejection_reason

SIX_AXES = load_config("irb120")


def dask(*values):
    """A command of Dask, and its first line that names an address."""
    command = [sys.executable, "-m", "dask", *values, "--no-dashboard"]
    process = subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
    )
    for line in process.stderr:
        match = re.search(r"(?:Scheduler|worker) at: +(tcp://\S+)", line)
        if match:
            return process, match[1]
    raise AssertionError("it has ended")


def ended(process):
    process.kill()
    process.stderr.close()
    process.wait()


@pytest.fixture(scope="module")
def scheduler():
    process, address = dask("scheduler", "--host", "127.0.0.1", "--port", "0")
    yield address
    ended(process)


@pytest.fixture
def hired(scheduler):
    """Starts workers; they end with the test."""
    processes = []

    def hire(count):
        for _ in range(count):
            values = ("worker", scheduler, "--nthreads", "1", "--no-nanny")
            processes.append(dask(*values)[0])
        return processes

    yield hire
    for process in processes:
        ended(process)


def ends_its_worker_once(path, number):
    """The third piece kills the Dask worker that has it, with its engine."""
    if number == 2 and not path.exists():
        path.write_text("", encoding="ascii")
        os.kill(os.getppid(), signal.SIGKILL)
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def ends_its_engine_once(path, number):
    if number == 2 and not path.exists():
        path.write_text("", encoding="ascii")
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def test_the_results_are_those_of_this_machine(scheduler, hired, tmp_path):
    hired(2)
    message = []
    here, target = tmp_path / "here.jsonl", tmp_path / "there.jsonl"
    result = [
        run_suite(SIX_AXES, jobs=2, only=FEW, strength=0, results=here),
        run_suite(
            SIX_AXES,
            hire=lambda driver: Cluster(scheduler, driver, message.append),
            only=FEW,
            strength=0,
            results=target,
        ),
    ]
    assert comparable(result[0]) == comparable(result[1])
    assert here.read_bytes() == target.read_bytes()
    assert message == []


def test_schedules_are_those_of_this_machine(scheduler, hired, tmp_path):
    hired(2)
    here, target = tmp_path / "here.jsonl", tmp_path / "there.jsonl"
    run_suite(SIX_AXES, seeds=4, jobs=1, cases=False, strength=0, results=here)
    run_suite(
        SIX_AXES,
        seeds=4,
        strength=0,
        hire=lambda driver: Cluster(scheduler, driver, print),
        cases=False,
        results=target,
    )
    assert target.read_bytes() == here.read_bytes()


@pytest.mark.parametrize("function", [ends_its_worker_once, ends_its_engine_once])
def test_a_worker_that_is_killed_in_the_middle_loses_nothing(scheduler, hired, tmp_path, function):
    hired(2)
    message = []
    with Cluster(scheduler, tmp_path / "was-killed", message.append) as workers:
        assert list(each(workers, range(12), function)) == list(range(12))
    assert (tmp_path / "was-killed").exists()
    assert any("was lost: its items are done again" in line for line in message)


def test_a_worker_that_comes_later_works_too(scheduler, hired):
    hired(1)
    message = []
    with Cluster(scheduler, None, message.append) as workers:
        before = list(each(workers, range(4), double))
        (first,) = hired(1)[:1]
        first.kill()
        assert list(each(workers, range(4), double)) == before == [0, 2, 4, 6]


def test_a_worker_of_another_build_is_refused(scheduler, hired, monkeypatch, capsys):
    assert "not another" in rejection_reason("another", "key", b"")
    hired(1)
    monkeypatch.setattr("rapidgen.verification.cluster.identity", lambda: "another")
    with pytest.raises(DiagnosticError, match="no worker can be used: its rapidgen is"):
        Cluster(scheduler, None, print)
    assert main(["test", "irb120", "--quick", "--case", "ping", "--cluster", scheduler]) == 2
    error = capsys.readouterr().err
    assert "RG808" in error
    assert "is refused: its rapidgen is" in error


def test_a_cluster_without_workers_is_refused(scheduler, monkeypatch):
    monkeypatch.setattr("rapidgen.verification.cluster.CONNECTS", 1)
    with pytest.raises(DiagnosticError, match="it has none"):
        Cluster(scheduler, None, print)


def test_address_without_scheduler_is_refused(monkeypatch, capsys):
    monkeypatch.setattr("rapidgen.verification.cluster.CONNECTS", 0.5)
    values = ["test", "irb120", "--quick", "--case", "ping", "--cluster", "tcp://127.0.0.1:1"]
    assert main(values) == 2
    assert "RG808" in capsys.readouterr().err


def test_without_the_extra_it_is_named(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "rapidgen.verification.cluster")
    assert main(["test", "irb120", "--quick", "--cluster", "tcp://127.0.0.1:1"]) == 2
    error = capsys.readouterr().err
    assert "RG905" in error
    assert "rapidgen[cluster]" in error
