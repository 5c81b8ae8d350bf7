"""A few of the random programs of campaign.py, and that it notices what it looks for."""

import pytest

from rapidgen.motion import pieces
from tools import motion_campaign as campaign


@pytest.mark.parametrize("seed", range(60))
def test_joint_programs(seed):
    kind = "flat" if seed % 2 else "joint"
    assert campaign.run(seed, kind, campaign.RAMPS[seed % 4]).faults == ()


@pytest.mark.parametrize("seed", range(40))
def test_programs_with_stops_by_the_brakes(seed):
    assert campaign.run(seed, "brakes", campaign.RAMPS[seed % 4]).faults == ()


@pytest.mark.parametrize("seed", range(30))
def test_cartesian_programs(seed):
    assert campaign.run(seed, "cartesian", campaign.RAMPS[seed % 4]).faults == ()


@pytest.mark.parametrize(
    ("seed", "kind", "ramp"),
    [
        (804, "joint", 0.05),  # a corner so sharp that the ramp made it take minutes
        (5221, "flat", 0.05),  # a new move in the nanosecond in which the plan stands
        (1046, "brakes", 0.0),  # a path cleared twice while the robot was off it
        (1284, "brakes", 0.05),
        (7292, "brakes", 0.2),  # the brakes pulled in the last ramp before a stop point
    ],
)
def test_programs_that_campaigns_found(seed, kind, ramp):
    assert campaign.run(seed, kind, ramp).faults == ()


def test_a_short_campaign(capsys):
    assert campaign.main(4, 1000) == 0
    assert "4 programs" in capsys.readouterr().out


def test_accelerations_above_the_limit_are_noticed(monkeypatch, capsys):
    monkeypatch.setattr(pieces.AxisLimits, "accelerations", lambda _self, _posture: (50.0,) * 6)
    assert campaign.main(60, 0) == 1
    assert "of the limit" in capsys.readouterr().out
