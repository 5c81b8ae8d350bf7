"""Configuration data of each arm family, from postures by the rule of the manual.

S4 datasys 1-confdata: quarter 0 is 0 to 90 degrees, 1 is 90 to 180, -1 is 0 to -90, and so on over
several turns. cfx: the table of 3HAC050917 (wrist centre behind axis 1: 4, behind the lower arm: 2,
axis 5 negative: 1). The expected values are read off by hand from the angles (deg).
"""

from math import degrees, radians

import pytest

from rapidgen.axes.configuration import FAMILIES, configuration_data, family_of
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import ABSENT
from rapidgen.config import load_config


def arm(model, number=0):
    """Return the kinematics of a shipped model."""
    return Kinematics.of(load_config(model).groups[number])


def data(model, axes, number=0):
    """Return the data of a posture in deg (mm for sliding axes)."""
    own = arm(model, number)
    joints = own.group.joints
    posture = [
        v / 1000 if j.kind == "prismatic" else radians(v) for j, v in zip(joints, axes, strict=True)
    ]
    return configuration_data(own, tuple(posture))


SERIAL = [
    ((10, 10, 10, 10, 10, 10), (0, 0, 0, 0)),
    ((-10, 10, 10, 100, 10, -100), (-1, 1, -2, 0)),
    ((100, 10, 10, -100, -10, 200), (1, -2, 2, 1)),
    ((-100, 10, 10, -150, -10, -300), (-2, -2, -4, 1)),
    # Leaning back: the wrist centre is behind axis 1, the elbow as at zero.
    ((10, -100, 10, 10, 10, 10), (0, 0, 0, 4)),
    ((10, -100, 10, 10, -10, 380), (0, 0, 4, 5)),
]


@pytest.mark.parametrize(("axes", "expected"), SERIAL)
def test_serial_arm_has_quarters_and_cfx_of_the_manual(axes, expected):
    result = data("irb120", axes)
    assert result.configuration == expected
    assert result.external == (ABSENT,) * 6
    assert result.has_evidence


def test_parallel_rod_arm_has_no_cfx():
    result = data("irb2400", (10, -60, 20, 100, -10, -100))
    assert result.configuration == (0, 1, -2, 0)
    assert not result.has_evidence


def test_palletiser_and_scara_have_quarters_of_their_own_axes():
    assert data("irb460", (-10, 10, 10, 100)).configuration == (-1, 0, 1, 0)
    assert data("irb910sc", (100, 10, -50, -100)).configuration == (1, -2, 0, 0)


def test_seven_axis_target_has_the_arm_angle_and_centred_quarters():
    own = arm("irb14000")
    posture = tuple(
        {
            "rax_1": radians(-50), "rax_2": radians(-130), "rax_3": radians(30),
            "rax_4": radians(40), "rax_5": radians(40), "rax_6": 0.0, "eax_a": radians(135),
        }[joint.axis]
        for joint in own.group.joints
    )  # fmt: skip
    result = configuration_data(own, posture)
    assert result.configuration == (-1, 0, 0, 4)
    assert result.external[0] == pytest.approx(degrees(own.arm.arm_angle(posture)))
    assert result.external[1:] == (ABSENT,) * 5


def test_track_is_an_external_axis_in_mm():
    own = arm("irb120_track")
    posture = tuple(0.25 if j.kind == "prismatic" else 0.1 for j in own.group.joints)
    assert configuration_data(own, posture).external[0] == pytest.approx(250.0)


@pytest.mark.parametrize(
    ("model", "kind"),
    [
        ("irb6640", "serial"),
        ("crb15000", "serial"),
        ("irb2400", "parallel rod"),
        ("irb14050", "seven axes"),
        ("irb660", "palletiser"),
        ("irb910sc", "SCARA"),
        ("irb5400", "other"),
    ],
)
def test_family_follows_from_the_axes(model, kind):
    assert family_of(arm(model)).name == kind


def test_evidence_needs_200_pairs():
    assert all(family.has_evidence == (family.pairs >= 200) for family in FAMILIES)
