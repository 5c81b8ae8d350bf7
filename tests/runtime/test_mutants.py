"""Conformance programs are red for defects: a sample; all in
tools/conformance_mutants_runtime.py."""

from dataclasses import replace

import pytest

from tools.mutation.runtime import BROAD, FAILED, PASSED, Campaign, all_files, outcome

FILES = {file.program.name: file for file in all_files()}
SAMPLE = [FILES[name] for name in ("goto", "for_counts")]


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    result = Campaign(SAMPLE, SAMPLE, BROAD)
    result.search()
    return result


def test_each_file_of_a_sample_is_red_for_a_mutant(campaign: Campaign) -> None:
    assert campaign.left == []
    for file, (mutant, _) in campaign.shown.items():
        assert (outcome(file), outcome(file, mutant)) == (PASSED, FAILED)


def test_changed_expectation_fails() -> None:
    goto = SAMPLE[0].program
    other = replace(goto, text=goto.text.replace("! expect: ", "! expect: not ", 1))
    assert outcome(replace(SAMPLE[0], program=other)) == FAILED
