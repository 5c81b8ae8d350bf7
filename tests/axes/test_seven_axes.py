"""YuMi's arms against RobotStudio: poses, arm angles, and robtargets of public programs.

The ten postures are those of unit_tests/compare_to_robotstudio.m of rpiRobotics/yumi-ik: joints in
the order of the chain, flange (mm) and its roll, pitch, yaw, arm angles about z and y (deg).
"""

import math
import random

import pytest

from rapidgen.axes import frames
from rapidgen.axes.arm_angle import ArmAngle
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.reach_errors import unreached
from rapidgen.config import load_config

# fmt: off
ROBOTSTUDIO = [
    ([0] * 7, (341.5, 0, 598), (0, 90, 0), 0, 90),
    ([20] * 7, (292.46, 234.73, 348.75), (148.67, 16.13, 175.45), 6.86, 105.54),
    ([30] * 7, (165.49, 290.86, 255.37), (157.34, -19.80, -175.99), 14.50, 99.26),
    ([-40] * 7, (-219.17, 12.62, 796.12), (13.67, -3.39, -152.29), 106.67, 15.68),
    ([-80] * 7, (-126.60, 499.23, 441.88), (5.30, 17.08, 34.27), 99.01, -26),
    ([104, -31, 1, -18, -55, 117, 69], (32.02, 91.43, 763.94), (157.59, 43.43, 170.70),
     19.58, -165.56),
    ([162, 1, -23, -88, 241, 98, -44], (45.84, 32.22, 846.74), (-98.58, 43.30, -76.21),
     80.07, -131.03),
    ([-20, -139, -144, 77, -263, 128, -104], (-47.12, -136.89, 270.77), (-106.88, -60.36, 122.56),
     139.68, -15.92),
    ([67, -142, 121, 78, -38, 113, -194], (-100.23, 3.25, 338.01), (43.05, -59.81, 44.29),
     -146.69, 119.74),
    ([-58, -138, -35, 70, -283, 133, 207], (-123.66, 141.01, 425.04), (-118.25, -37.89, -10.09),
     165.86, 50.38),
]
# fmt: on
HOME = (0, -130, 30, 0, 40, 0)
"""Axes 1 to 6 of both arms; axis 7 is +-135. Public programs have the target below."""
PLACE, TURN = (-9.578368507, 182.609892723, 198.627808149), (
    0.066010726, 0.842420918, -0.111214912, 0.523068661,
)  # fmt: skip
ARM_ANGLE = 101.964427132


def single():
    return Kinematics.of(load_config("irb14050").groups[0])


def posture_of(arm, chain_order):
    names = [link.joint for link in arm.group.chain if link.joint]
    by_name = dict(zip(names, chain_order, strict=True))
    return tuple(math.radians(by_name[joint.name]) for joint in arm.group.joints)


@pytest.mark.parametrize("row", ROBOTSTUDIO)
def test_a_posture_in_robotstudio(row):
    joints, place, rpy, _, _ = row
    position, q = single().forward(posture_of(single(), joints))
    assert [v * 1000 for v in position] == pytest.approx(place, abs=0.006)
    assert frames.angle_between(q, frames.from_rpy(*map(math.radians, rpy))) < math.radians(0.01)


@pytest.mark.parametrize("row", ROBOTSTUDIO)
def test_an_arm_angle_in_robotstudio(row):
    joints, _, _, about_z, about_y = row
    arm = single()
    axes = arm.arm.search(posture_of(arm, joints), complete=True).lines(
        [math.radians(v) for v in joints]
    )[1]
    for reference, angle in (((0.0, 0.0, 1.0), about_z), ((0.0, 1.0, 0.0), about_y)):
        off = math.degrees(ArmAngle(reference).of(axes)) - angle
        assert math.remainder(off, 360) == pytest.approx(0, abs=0.011)


@pytest.mark.parametrize(("name", "side"), [("rob_l", 1), ("rob_r", -1)])
def test_the_home_target_of_public_programs(name, side):
    group = next(g for g in load_config("irb14000").groups if g.name == name)
    arm = Kinematics.of(group)
    home = tuple(math.radians(v) for v in (*HOME, 135 * side))
    position, q = arm.forward(home)
    w, x, y, z = TURN
    x_, y_, z_ = PLACE
    assert [v * 1000 for v in position] == pytest.approx((x_, side * y_, z_), abs=2e-3)
    assert frames.angle_between(q, frames.normalise((w, side * x, y, side * z))) < 1e-5
    assert math.degrees(arm.arm.arm_angle(home)) == pytest.approx(side * ARM_ANGLE, abs=2e-4)
    from_afar = tuple(v + 0.3 for v in home)
    target = (
        (x_ / 1000, side * y_ / 1000, z_ / 1000),
        frames.normalise((w, side * x, y, side * z)),
    )
    match = next(arm.at_arm_angle(target, math.radians(side * ARM_ANGLE), from_afar))
    assert match == pytest.approx(home, abs=1e-4)


def test_pose_reached_only_with_another_arm_angle_is_reported():
    """An axis that stays within its range is no reason."""
    arm = Kinematics.of(load_config("irb14000").groups[0])
    start = (0.0,) * 7
    pose = ((0.35, 0.2, 0.2), (0.0, 0.0, 1.0, 0.0))
    assert arm.solutions(pose, start)
    assert next(arm.at_arm_angle(pose, 0.0, start), None) is None
    within = "the flange can be at [350.0, 200.0, 200.0] mm within the axis ranges"
    reached, why = unreached(arm, pose, start, 0.0)
    assert (reached, f"{within}, but not with an arm angle (eax_a) of 0.0 deg" in why) == (
        True,
        True,
    )
    reached, why = unreached(arm, pose, start)
    assert (reached, f"{within}, but not from the posture" in why) == (True, True)


def test_a_pose_with_its_arm_angle_is_found_from_afar():
    arm = single()
    draw = random.Random(3)
    start = tuple((j.lower + j.upper) / 2 for j in arm.group.joints)
    for _ in range(15):
        posture = tuple(draw.uniform(j.lower, j.upper) for j in arm.group.joints)
        pose, angle = arm.forward(posture), arm.arm.arm_angle(posture)
        match = next(arm.at_arm_angle(pose, angle, start))
        assert max(map(abs, frames.error(arm.forward(match), pose))) < 1e-7
        assert math.remainder(arm.arm.arm_angle(match) - angle, 2 * math.pi) == pytest.approx(
            0, abs=1e-7
        )
