"""Parsing suspends the collector for growing trees, not for garbage."""

import gc
import weakref

import pytest

from rapidgen.rapid import parse
from rapidgen.rapid.syntax import parser


class Cycle:
    def __init__(self):
        self.itself = self


@pytest.fixture
def small(monkeypatch):
    """A collector that looks through everything after some hundred tokens."""
    monkeypatch.setattr(parser._COLLECTOR, "LEAST", 300)
    monkeypatch.setattr(parser._COLLECTOR, "limit", 300)
    monkeypatch.setattr(parser._COLLECTOR, "promoted", 0)


def test_repeated_parse_releases_memory(small):
    gc.collect()
    gone = weakref.ref(Cycle())
    for _ in range(100):
        parse("MODULE m\n  VAR num x := 1;\nENDMODULE\n")
        if gone() is None:
            return
    raise AssertionError("a cycle outlived a hundred modules")


def test_disabled_collector_stays_disabled(small):
    gc.disable()
    try:
        gone = weakref.ref(Cycle())
        for _ in range(100):
            parse("MODULE m\n  VAR num x := 1;\nENDMODULE\n")
        assert gone() is not None
        assert not gc.isenabled()
    finally:
        gc.enable()
