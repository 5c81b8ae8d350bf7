"""Functions posted by other threads to a real clock run at once."""

import selectors

from rapidgen.machine import scheduler as module
from rapidgen.machine.scheduler import Scheduler

MINUTE = 60_000_000_000


def test_post_during_selector_creation_runs(monkeypatch):
    scheduler, came = Scheduler(clock="real", speed=60), []

    def made():
        scheduler.post(lambda: came.append(scheduler.now))
        return selectors.SelectSelector()

    monkeypatch.setattr(module.selectors, "DefaultSelector", made)
    assert scheduler.advance(MINUTE, lambda: bool(came)) == "stop"
    assert came[0] < MINUTE
    scheduler.close()


def test_posting_to_a_full_pipe_neither_fails_nor_loses_anything():
    scheduler, came = Scheduler(clock="real", speed=60), []
    assert scheduler.selector
    # More than a pipe can store, 65,536 bytes on Linux, without a reader.
    for number in range(70_000):
        scheduler.post(lambda number=number: came.append(number))
    assert scheduler.advance(MINUTE, lambda: len(came) == 70_000) == "stop"
    assert came == list(range(70_000))
    scheduler.close()
