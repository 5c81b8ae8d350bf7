"""Signals end what serves, whatever it is at when they come."""

import os
import signal
import sys
import threading
from contextlib import nullcontext
from types import SimpleNamespace

import pytest

from rapidgen.cli import sim, view
from rapidgen.controller.booting import load_target
from rapidgen.controller.cabinet import Cabinet


def after_lines(count, then):
    """A tracer of functions that are called from now on; `then` once so many lines are reached."""

    def traced(frame, event, argument):
        nonlocal count
        if event == "line":
            count -= 1
            if count == 0:
                sys.settrace(None)
                then()
        return traced

    return traced


@pytest.mark.timeout(60)
def test_view_ends_by_a_signal_as_it_begins_to_wait(monkeypatch):
    def come():
        signal.raise_signal(signal.SIGTERM)

    closed = []
    page = SimpleNamespace(url="", close=lambda: closed.append(sys.settrace(None)))
    monkeypatch.setattr("rapidgen.view.server.serve_page", lambda *_: page)
    for line in range(1, 16):
        monkeypatch.setattr(
            view.typer, "echo", lambda _, n=line: sys.settrace(after_lines(n, come))
        )
        later = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGTERM))
        later.start()  # where so many lines are not reached
        before = signal.getsignal(signal.SIGTERM)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # comes it late, it is nothing
        try:
            assert view._serve(None, "127.0.0.1", 0, {}) == 0
        finally:
            later.cancel()
            later.join()
            signal.signal(signal.SIGTERM, before)
    assert len(closed) == 15


@pytest.mark.timeout(60)
@pytest.mark.parametrize("locked", [False, True])
def test_sim_ends_by_a_signal_during_a_restart(tmp_path, locked):
    path = tmp_path / "m.mod"
    path.write_text("MODULE m\n PROC main()\n  WaitTime 100;\n ENDPROC\nENDMODULE\n")
    found = load_target([path])
    with Cabinet.boot(found, clock="real") as cabinet:

        def come():
            with cabinet._lock if locked else nullcontext():
                signal.raise_signal(signal.SIGTERM)

        cabinet.on_restart.append(come)
        cabinet.ask_restart()
        assert sim._serve(cabinet, found, "127.0.0.1", 1.0, {}) == 0
        assert cabinet.restarts == 1
