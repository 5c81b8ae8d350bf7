"""Accelerations: measured, given, or by the class of the robot."""

import math
import re

import pytest

from rapidgen.config import load_config
from rapidgen.config.accelerations import usual_time
from rapidgen.diagnostics import DiagnosticError
from rapidgen.motion.accelerations import duration_error_band, of_posture


def times(config):
    return [joint.speed / joint.acceleration for joint in load_config(config).groups[0].joints]


def test_defaults_by_class():
    assert times("irb120") == pytest.approx([0.1] * 3 + [0.07] * 3)
    assert times("irb6700") == pytest.approx([0.25] * 3 + [0.07] * 3)
    assert 0.1 < usual_time("rax_1", 1.5) < 0.2
    assert usual_time("eax_a", 1.0) == 0.25


def test_given_time_and_acceleration(tmp_path):
    path = tmp_path / "own.yaml"
    own = "acceleration_time: 0.5\njoints: {joint_1: {acceleration: 1000}}\n"
    path.write_text(f"name: own\nmodel: irb120\n{own}")
    assert times(path) == pytest.approx([0.25] + [0.5] * 5)


def test_time_of_one_axis_replaces_its_acceleration(tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text("name: own\nmodel: irb1200\njoints: {joint_1: {acceleration_time: 0.5}}\n")
    group = load_config(path).groups[0]
    assert group.joints[0].speed / group.joints[0].acceleration == pytest.approx(0.5)
    assert [inertia.axis for inertia in group.inertias] == ["rax_2"]


def test_decelerations_of_stops(tmp_path):
    path = tmp_path / "own.yaml"
    own = "joints: {joint_1: {brake_deceleration: 900, stop_deceleration: 500}}\n"
    path.write_text(f"name: own\nmodel: irb120\n{own}")
    first, second, *_ = load_config(path).groups[0].joints
    given = math.degrees(first.brake_deceleration), math.degrees(first.stop_deceleration)
    assert given == pytest.approx((900, 500))
    assert (second.brake_deceleration, second.stop_deceleration) == (0, 0)


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        ("acceleration: 900, acceleration_time: 0.2", "both acceleration and acceleration_time"),
        ("acceleration_time: 0", "at least 0.01, not 0"),
        ("acceleration_time: 200", "at most 2.5, not 200"),
        ("brake_deceleration: 16", "16 deg/s²: 250 deg/s are braked in 15.6 s"),
        ("stop_deceleration: -500", "at least 0.001, not -500"),
    ],
)
def test_impossible_figures_of_an_axis_are_rejected(tmp_path, keys, text):
    path = tmp_path / "own.yaml"
    path.write_text(f"name: own\nmodel: irb120\njoints: {{joint_1: {{{keys}}}}}\n")
    with pytest.raises(DiagnosticError, match=re.escape(text)):
        load_config(path)


def test_impossible_inertia_is_rejected(tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text("name: own\nmodel: irb120\ninertias: {rax_1: {most: 8, constant: 0.001}}\n")
    with pytest.raises(DiagnosticError, match=r"8 deg/s²: 250 deg/s are reached in 31\.2 s"):
        load_config(path)


def test_measured_accelerations_depend_on_the_posture():
    """Medians of 308 postures: 433, 285, 592 deg/s² (the published table), times 1.1."""
    group = load_config("irb6640_180_255").groups[0]
    assert "Robot_Acceleration_Identification" in group.acceleration_source
    accelerations = of_posture(group)
    near, far = (0, -0.5, -0.5, 0, 0, 0), (0, 1.2, -0.5, 0, 0, 0)
    assert accelerations(near)[0] > 2 * accelerations(far)[0]
    middle = accelerations((0, 0.2, -0.5, 0, 0, 0))
    assert math.degrees(middle[0]) == pytest.approx(1.1 * 433, rel=0.3)
    assert math.degrees(middle[1]) == pytest.approx(1.1 * 285, rel=0.2)


def test_own_acceleration_replaces_the_inertia(tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text("name: own\nmodel: irb1200\njoints: {joint_1: {acceleration: 1000}}\n")
    group = load_config(path).groups[0]
    assert [inertia.axis for inertia in group.inertias] == ["rax_2"]
    assert of_posture(group)((0.0,) * 6)[0] == pytest.approx(math.radians(1000))


@pytest.mark.parametrize("value", ["0", "-100", "7", "1e9"])
def test_impossible_accelerations_are_rejected(tmp_path, value):
    path = tmp_path / "own.yaml"
    path.write_text(f"name: own\nmodel: irb120\njoints: {{joint_1: {{acceleration: {value}}}}}\n")
    with pytest.raises(DiagnosticError) as fault:
        load_config(path)
    assert value.rstrip("9") in str(fault.value) or "deg/s²" in str(fault.value)


def test_error_band_of_durations():
    """Wider where accelerations are estimated; the figures are those of error_bands.py."""
    measured = duration_error_band(load_config("irb1200").groups[0])
    assert measured == (True, 0.03)
    assert duration_error_band(load_config("irb120").groups[0]) == (False, 0.16)
