"""Joint map: URDF values, controller values, RAPID's degrees and mm."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.config.model import Joint


def joint(axis, kind="revolute", **more):
    return Joint(f"j_{axis}", axis, kind, -3.0, 3.0, 1.0, 1.0, **more)


COUPLED = JointMap((joint("rax_1"), joint("rax_2", sign=-1, offset=0.2), joint("rax_3")), 1.0)
YUMI = JointMap(tuple(joint(a) for a in ("rax_1", "rax_2", "eax_a", "rax_3")))
TRACK = JointMap((joint("rax_1"), joint("eax_a", "prismatic"), joint("eax_b")))


def test_axis_3_of_a_parallel_rod_robot_is_the_sum_with_axis_2():
    # abb_driver [code]: rax_3 = J3 + J2, back J3 = rax_3 - rax_2
    plain = JointMap((joint("rax_2"), joint("rax_3")), 1.0)
    assert plain.to_controller((0.3, 0.5)) == pytest.approx((0.3, 0.8))
    assert plain.to_urdf((0.3, 0.8)) == pytest.approx((0.3, 0.5))


def test_sign_and_offset_come_before_the_coupling():
    assert COUPLED.to_controller((1.0, 0.5, 0.4)) == pytest.approx((1.0, -0.3, 0.1))
    assert COUPLED.rates_to_controller((1.0, 0.5, 0.4)) == pytest.approx((1.0, -0.5, -0.1))


@given(st.tuples(*[st.floats(-10, 10)] * 3))
def test_both_ways_are_inverse(values):
    assert COUPLED.to_urdf(COUPLED.to_controller(values)) == pytest.approx(values)
    assert COUPLED.rates_to_urdf(COUPLED.rates_to_controller(values)) == pytest.approx(values)


def test_rapid_values_are_degrees_and_millimetres_in_their_slots():
    robax, extax = TRACK.to_rapid((math.pi, 1.5, -math.pi / 2))
    assert robax == pytest.approx((180.0, 0, 0, 0, 0, 0))
    assert extax[:2] == pytest.approx((1500.0, -90.0))
    assert extax[2:] == (ABSENT,) * 4


def test_seventh_yumi_axis_is_external_in_wire_order():
    robax, extax = YUMI.to_rapid((0.1, 0.2, 0.3, 0.4))
    assert robax[:3] == pytest.approx([math.degrees(v) for v in (0.1, 0.2, 0.4)])
    assert extax[0] == pytest.approx(math.degrees(0.3))


@given(st.tuples(*[st.floats(-6, 6)] * 3))
def test_rapid_and_back(values):
    assert TRACK.from_rapid(*TRACK.to_rapid(values)) == pytest.approx(values)


def test_an_axis_without_value_takes_the_default_or_is_named():
    absent = (ABSENT,) * 6
    assert TRACK.from_rapid((90, 0, 0, 0, 0, 0), absent, (0, 0.7, 0.2))[1:] == (0.7, 0.2)
    with pytest.raises(ValueError, match="eax_a"):
        TRACK.from_rapid((90, 0, 0, 0, 0, 0), absent)
