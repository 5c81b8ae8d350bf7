"""Axis ranges."""

import math

from rapidgen.axes.limits import check_limits, outside
from rapidgen.config.model import Joint

JOINTS = (
    Joint("a", "rax_1", "revolute", -1.0, 1.0, 1.0, 1.0),
    Joint("b", "eax_a", "prismatic", 0.0, 2.0, 1.0, 1.0),
)


def test_both_ends_belong_to_the_range():
    assert outside(JOINTS, (1.0, 0.0)) == []
    assert outside(JOINTS, (-1.0 - 5e-7, 2.0)) == []  # what degrees in float32 lose


def test_nan_and_infinity_are_outside():
    assert [f.joint.name for f in outside(JOINTS, (math.nan, math.inf))] == ["a", "b"]


def test_a_fault_says_axis_value_and_range_in_rapid_units():
    (fault,) = check_limits(JOINTS, [(0.0, 1.0), (0.0, 2.1)])
    assert fault.point == 1
    assert str(fault) == "eax_a (b) = 2100.000 mm, range 0 to 2000 mm"
