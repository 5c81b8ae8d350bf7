"""Conformance programs fail for defects: a sample.

All are in tools/conformance_mutants.py.
"""

import gc
import signal
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest

from tests.rapid.conformance_files import all_files
from tools.mutation import conformance as trials
from tools.mutation.conformance import BROAD, Campaign
from tools.mutation.front_end import NoProgram, of_builtins, of_functions, of_tables

SAMPLE = all_files()[::40]


def campaign(files):
    result = Campaign(files, [*SAMPLE[1:], *files], 10)
    result.builtins()
    result.functions()
    result.broader(BROAD)
    result.functions()
    return result


def test_each_file_of_a_sample_is_red_for_a_mutant():
    result = campaign(SAMPLE[1:])
    assert len(result.shown) == len(SAMPLE) - 1
    assert [file.name for file in SAMPLE if file.found() != file.expected] == []


def test_ineffective_file_is_reported():
    empty = replace(SAMPLE[0], program=replace(SAMPLE[0].program, text="MODULE Demo\nENDMODULE\n"))
    assert campaign([empty]).left == [empty]


@pytest.mark.parametrize("kind", [of_functions, of_tables, of_builtins])
def test_a_mutant_is_taken_back(kind):
    result = kind()
    chosen = [mutant for k, mutant in enumerate(result) if k % 97 == 0][:8]
    for mutant in chosen:
        try:
            with mutant.made():
                pass
        except NoProgram:
            continue
    assert [file.name for file in SAMPLE if file.found() != file.expected] == []


def busy(*seconds):
    """A file with given CPU times per trial and its declared findings."""
    left = list(seconds)

    def result():
        end = time.process_time() + left.pop(0)
        while time.process_time() < end:
            pass
        return "as announced"

    return SimpleNamespace(found=result, expected="as announced")


def test_delayed_file_does_not_hang(monkeypatch):
    monkeypatch.setattr(trials, "SECONDS", (0.05, 60.0))
    assert trials.fails(busy(0.2, 0)) is False


def test_hanging_file_is_neither_passed_nor_failed(monkeypatch):
    monkeypatch.setattr(trials, "SECONDS", (0.02, 0.04))
    assert trials.fails(busy(60, 60)) is None


def test_timeout_during_judgement_is_ignored(monkeypatch):
    def late(which, *seconds):
        setitimer(which, *seconds)
        if not seconds[0]:
            signal.raise_signal(signal.SIGVTALRM)

    setitimer = signal.setitimer
    before = signal.getsignal(signal.SIGVTALRM), gc.isenabled(), gc.callbacks[:]
    monkeypatch.setattr(signal, "setitimer", late)
    assert trials.fails(busy(0)) is False
    assert (signal.getsignal(signal.SIGVTALRM), gc.isenabled(), gc.callbacks[:]) == before
