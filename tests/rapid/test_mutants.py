"""Conformance files are red for defects: a sample; all in benchmarks/conformance_mutants.py."""

from dataclasses import replace

import pytest

from tests.rapid.campaign import BROAD, Campaign
from tests.rapid.conformance_files import all_files
from tests.rapid.mutants import NoProgram, of_builtins, of_functions, of_tables

SAMPLE = all_files()[::40]


def campaign(files):
    found = Campaign(files, [*SAMPLE[1:], *files], 10)
    found.builtins()
    found.functions()
    found.broader(BROAD)
    found.functions()
    return found


def test_each_file_of_a_sample_is_red_for_a_mutant():
    found = campaign(SAMPLE[1:])
    assert len(found.shown) == len(SAMPLE) - 1
    assert [file.path.name for file in SAMPLE if file.found() != file.expected] == []


def test_a_file_that_shows_nothing_is_told():
    empty = replace(SAMPLE[0], text="MODULE Demo\nENDMODULE\n")
    assert campaign([empty]).left == [empty]


@pytest.mark.parametrize("kind", [of_functions, of_tables, of_builtins])
def test_a_mutant_is_taken_back(kind):
    found = kind()
    chosen = [mutant for k, mutant in enumerate(found) if k % 97 == 0][:8]
    for mutant in chosen:
        try:
            with mutant.made():
                pass
        except NoProgram:
            continue
    assert [file.path.name for file in SAMPLE if file.found() != file.expected] == []
