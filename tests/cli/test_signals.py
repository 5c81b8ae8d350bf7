"""Signals end what serves, whatever it is at when they come and whichever thread gets them."""

import signal
import sys
import threading
from types import SimpleNamespace

import pytest

from rapidgen.cli import observation, sim
from rapidgen.controller.boot_targets import load_target
from rapidgen.controller.runner import ControllerRunner

PROGRAM = "MODULE m\n PROC main()\n  WaitTime 100;\n ENDPROC\nENDMODULE\n"


@pytest.fixture(autouse=True)
def spared():
    """A signal that comes too late is nothing."""
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGTERM, before)


def come():
    """To the thread that calls it."""
    signal.raise_signal(signal.SIGTERM)


def after_lines(count):
    """A tracer of functions called from now on: it comes once so many lines are reached."""

    def traced(frame, event, argument):
        nonlocal count
        if event == "line":
            count -= 1
            if count == 0:
                sys.settrace(None)
                come()
        return traced

    return traced


@pytest.fixture
def viewed(monkeypatch):
    """Serves nothing; what to call once it has said that it is ready."""

    def serve(then):
        page = SimpleNamespace(url="", close=lambda: sys.settrace(None))
        monkeypatch.setattr("rapidgen.viewer.server.serve_page", lambda *_: page)
        monkeypatch.setattr(observation.typer, "echo", lambda _: then())
        return observation._serve(None, "127.0.0.1", 0, {})

    return serve


@pytest.mark.timeout(60, method="thread")
@pytest.mark.parametrize("line", range(1, 13))
def test_view_ends_by_a_signal_as_it_begins_to_wait(viewed, line):
    other = threading.Timer(0.2, come)  # where there are fewer lines until it waits

    def begin():
        other.start()
        sys.settrace(after_lines(line))

    assert viewed(begin) == 0
    other.cancel()
    other.join()


@pytest.mark.timeout(60, method="thread")
def test_view_ends_by_a_signal_that_another_thread_gets(viewed):
    other = threading.Timer(0.05, come)
    assert viewed(other.start) == 0
    other.join()


@pytest.fixture
def runner(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(PROGRAM)
    result = load_target([path])
    with ControllerRunner.boot(result, clock="real") as runner:
        runner.serve = lambda: sim._serve(runner, result, "127.0.0.1", 1.0, {})
        yield runner


@pytest.mark.timeout(60, method="thread")
def test_sim_ends_by_a_signal_during_a_restart(runner):
    runner.on_restart.append(come)
    runner.ask_restart()
    assert runner.serve() == 0
    assert runner.restarts == 1


@pytest.mark.timeout(60, method="thread")
def test_sim_ends_by_a_signal_that_another_thread_gets(runner, monkeypatch):
    other = threading.Timer(0.05, come)

    def echo(text, **_):
        if str(text).startswith("ready"):
            other.start()

    monkeypatch.setattr(sim.typer, "echo", echo)
    assert runner.serve() == 0
    other.join()
