"""A pose with its posture's configuration is reached from any start.

A target that CRobT gave is not refused on the way back.
"""

import math
import random

import pytest

from rapidgen.axes import frames
from rapidgen.axes.arm_angle import ArmAngle
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config

FULL_TURN = 2 * math.pi


def back(arm, posture, here):
    """A posture with the pose, the configuration and the arm angle of `posture`, from `here`."""
    pose, wanted = arm.forward(posture), arm.configuration(posture)
    if arm.seventh < 0:
        return arm.fitting(arm.solutions(pose, here, wanted), wanted, "turn")
    result = arm.at_arm_angle(pose, arm.arm.arm_angle(posture), here)
    return next((one for one in result if arm.misfit(one, wanted) == 0.0), None)


@pytest.mark.parametrize("robot", ["irb120", "irb5400", "crb15000", "irb14000", "irb14050"])
def test_a_posture_is_found_again_from_anywhere(robot):
    draw = random.Random(7)
    for group in load_config(robot).groups:
        arm = Kinematics.of(group)
        for _ in range(12):
            posture, here = (
                tuple(draw.uniform(j.lower, j.upper) for j in group.joints) for _ in "ab"
            )
            result = back(arm, posture, here)
            assert result is not None, posture
            assert arm.misfit(result, arm.configuration(posture)) == 0.0
            pose = arm.forward(posture)
            assert frames.error(arm.forward(result), pose) == pytest.approx((0.0,) * 6, abs=1e-6)
            if arm.seventh >= 0:
                turned = arm.arm.arm_angle(result) - arm.arm.arm_angle(posture)
                assert turned - FULL_TURN * round(turned / FULL_TURN) == pytest.approx(0, abs=1e-6)


def test_an_arm_that_has_no_angle_has_no_slopes():
    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    wrist = (0.0, 0.5, 0.0)
    axes = [(frames.ORIGIN, path) for path in (z, x, y, x, z)] + [(wrist, x), (wrist, z)]
    assert ArmAngle(y).slopes(axes) == [0.0] * 7
