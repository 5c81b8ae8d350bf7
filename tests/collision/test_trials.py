"""Trials against dense samples, in `make test-long`; the tools run more of them."""

import pytest

from tools import collision_programs, collision_trials


@pytest.mark.long
def test_no_contact_with_a_thin_plate_is_missed(capsys):
    assert collision_trials.main(1000, 5) == 0
    assert ", 0 missed, " in capsys.readouterr().out


@pytest.mark.long
def test_no_pair_is_missed_in_random_programs(capsys):
    assert collision_programs.main(50, 5) == 0
    assert ": 0 missed, " in capsys.readouterr().out
