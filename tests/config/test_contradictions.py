"""Contradictions between a configuration and its known arm."""

import math
import re

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError, Severity
from tests.config.drawing import BASE, arm, drawn, errors, only, robot


@pytest.mark.parametrize("head", ["model: crb15000", ""])
def test_18_an_axis_that_is_drawn_the_other_way_round(check, head):
    text = drawn("crb15000", turned=["rax_3"], mirrored=["rax_3"], name_of="x")
    fault = only("RG048", check(text, head=head))
    config, result = check(text, pasted(fault), head=head)
    assert not errors(result)
    third = config.groups[0].joints[2]
    assert third.sign == -1
    assert math.degrees(third.lower) == pytest.approx(-225)
    at = config.groups[0]
    posture, known = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6), load_config("crb15000").groups[0]
    for mine, theirs in zip(*(Kinematics.of(g).forward(posture) for g in (at, known)), strict=True):
        assert mine == pytest.approx(theirs)


def pasted(fault):
    """The lines that a finding prints."""
    return fault.help[fault.help.index("joints:") :]


def test_18_a_range_that_is_mirrored_while_the_axis_is_not(check):
    text = drawn("irb120", mirrored=["rax_3"])
    fault = only("RG048", check(text))
    config, result = check(text, pasted(fault))
    assert not errors(result)
    assert math.degrees(config.groups[0].joints[2].lower) == pytest.approx(-110)
    # With the model its range counts.
    config, result = check(text, head="model: irb120")
    assert result["RG049"].severity is Severity.WARNING
    assert math.degrees(config.groups[0].joints[2].lower) == pytest.approx(-110)


def test_18_a_sign_that_turns_a_models_axis(tmp_path):
    (tmp_path / "cell.yaml").write_text("model: irb120\njoints: {joint_3: {sign: -1}}\n")
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "cell.yaml")
    (fault,) = caught.value.diagnostics
    assert fault.code == "RG048"
    assert fault.span.line == 2


@pytest.mark.parametrize(("model", "given"), [("irb120", 1), ("irb2400", 0)])
def test_17_a_coupling_that_is_not_the_models(tmp_path, model, given):
    (tmp_path / "cell.yaml").write_text(f"model: {model}\ncoupling: {given}\n")
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "cell.yaml")
    (fault,) = caught.value.diagnostics
    assert (fault.code, fault.span.line) == ("RG047", 2)
    (tmp_path / "cell.yaml").write_text(f"model: {model}\n{fault.help}\n")
    assert load_config(tmp_path / "cell.yaml").groups[0].coupling == 1 - given


def test_17_a_serial_arm_is_known_by_its_shape(check):
    fault = only("RG047", check(drawn("irb1200", name_of="x"), "coupling: 1"))
    assert "IRB 1200-5/0.9 has the coupling 0" in fault.message


def test_17_a_lever_arm_is_known_by_its_shape(check):
    text = drawn("irb2400", name_of="x")
    fault = only("RG047", check(text))
    config, result = check(text, "coupling: 1")
    assert "coupling: 1" in fault.help
    assert not errors(result)
    assert config.groups[0].coupling == 1


@pytest.mark.parametrize(
    ("model", "other", "off"), [("irb120", "irb1200", "211.4"), ("irb6640", "irb6700", "255.0")]
)
def test_19_the_dimensions_of_another_variant(check, model, other, off):
    fault = only("RG055", check(drawn(other), head=f"model: {model}"))
    assert f"{off} mm off, rax_5 most" in fault.message


def test_19_ranges_that_differ_from_the_model(check):
    text = drawn("irb120").replace('lower="-2.87', 'lower="-1.87')
    config, result = check(text, head="model: irb120")
    assert result["RG049"].severity is Severity.WARNING
    assert "known -165..165 deg" in result["RG049"].message
    assert math.degrees(config.groups[0].joints[0].lower) == pytest.approx(-165)


def test_19_a_speed_beyond_the_known_one(check):
    speed = load_config("irb120").groups[0].joints[5].speed
    _, result = check(drawn("irb120").replace(f'velocity="{speed}"', 'velocity="9"'))
    assert result["RG049"].severity is Severity.WARNING
    assert "speed 515.7 deg/s, known 420" in result["RG049"].message


@pytest.mark.parametrize(
    "lines",
    [
        {1: "rax_1", 3: "rax_3"},  # a gap
        {n: f"rax_{n}" for n in (1, 2, 3, 4, 5)},
        {n: f"rax_{n}" for n in (1, 2, 3, 6)},  # no palletiser: joints 4 and 5 move
        {n: f"rax_{n}" for n in (1, 2, 3, 4)},  # no SCARA: axis 3 turns
    ],
)
def test_20_an_axis_of_the_arm_without_a_joint(check, lines):
    ignored = [f"joint_{n}" for n in range(1, 7) if n not in lines]
    joints = "joints:\n" + "\n".join(f"  joint_{n}: {{axis: {a}}}" for n, a in lines.items())
    urdf = f"  ignore_joints: [{', '.join(ignored)}]"
    fault = only("RG021", check(drawn("irb120"), joints, urdf=urdf))
    config, result = check(drawn("irb120"), f"{joints}\n{keep_line(fault)}", urdf=urdf)
    assert not errors(result)
    assert len(config.groups[0].kept) == len(ignored)


def keep_line(fault):
    return re.search(r"held_axes: \[.*?\]", fault.help)[0]


def test_20_an_external_axis_inside_of_a_six_axis_arm(check):
    names = ["a", "b", "c", "x", "d", "e", "f"]
    axes = ["rax_1", "rax_2", "rax_3", "eax_a", "rax_4", "rax_5", "rax_6"]
    lines = "\n".join(f"  {n}: {{axis: {a}}}" for n, a in zip(names, axes, strict=True))
    fault = only("RG046", check(robot(BASE, arm(names)), f"joints:\n{lines}"))
    assert "only eax_a of a seven-axis arm is part of it" in fault.message
    last = lines.replace("eax_a", "rax_9").replace("rax_4", "eax_a").replace("rax_9", "rax_4")
    assert errors(check(robot(BASE, arm(names)), f"joints:\n{last}")[1]) == ["RG046"]


def test_20_a_seventh_joint_of_the_arm_cannot_be_left_out(check):
    names = ["a", "b", "x", "c", "d", "e", "f"]
    lines = "\n".join(f"  {n}: {{axis: rax_{i}}}" for i, n in enumerate("abcdef", 1))
    text = robot(BASE, arm(names))
    only("RG021", check(text, f"joints:\n{lines}", urdf="  ignore_joints: [x]"))


def test_20_a_group_without_a_robot(tmp_path):
    (tmp_path / "cell.yaml").write_text(
        "joints: {turn: {axis: eax_a, lower: -90, upper: 90, speed: 9}}\n"
    )
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "cell.yaml")
    assert [d.code for d in caught.value.diagnostics] == ["RG021"]


@pytest.mark.parametrize("keep", ["[eax_a]", "[rax_6]", "[rax_9]", "{rax_5: on}", "rax_5"])
def test_20_invalid_held_axes_are_reported(tmp_path, keep):
    (tmp_path / "cell.yaml").write_text(f"model: irb120\nheld_axes: {keep}\n")
    with pytest.raises(DiagnosticError) as caught:
        load_config(tmp_path / "cell.yaml")
    assert {d.code for d in caught.value.diagnostics} <= {"RG006", "RG021"}


def test_end_turned_against_the_flange_is_reported(check):
    text = drawn("irb120", name_of="x")
    start = text.rindex("rpy=")
    turned = text[:start] + re.sub('rpy="[^"]*"', 'rpy="0 0 0"', text[start:], count=1)
    for description, messages in ((text, False), (turned, True)):
        made, result = check(description)
        assert made
        assert ("RG055" in result) is messages
    assert "the end is turned by 90 deg from its flange" in result["RG055"].message
