"""confdata of an arm with six axes against the targets of a controller's backup.

IRB 120 hanging from a ceiling, RobotWare 6.07, all moves with tool0 in wobj0
(PaulaFreudenberger/ABB-Rapid-Git; base_frame_orient of MOC.cfg [0, -0.707107, 0.707107, 0]): place
(mm), orientation, confdata. All 29 targets agree, the rows are those that differ.
"""

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config

BASE = ((0.0, 0.0, 0.0), frames.normalise((0.0, -0.707107, 0.707107, 0.0)))
# fmt: off
HANGING = [
    ((245.61, -95.36, -654.56), (0.273127, 0.649156, 0.656078, 0.27122), (1, -1, -4, 5)),
    ((391.05, -226.33, -563.68), (0.273472, 0.648907, 0.656086, 0.271448), (1, -1, -3, 5)),
    ((362.34, -85.73, -550.58), (0.27315, 0.649146, 0.656074, 0.271229), (1, -1, -4, 5)),
    ((391.99, -226.89, -743.4), (0.273153, 0.649142, 0.656082, 0.271215), (1, -1, -3, 5)),
    ((334.39, -86.21, -731.08), (0.272926, 0.649193, 0.656148, 0.271165), (1, -1, -4, 5)),
    ((231.96, 103.06, -637.69), (0.1988, -0.703524, 0.656951, -0.184251), (0, 0, -1, 5)),
    ((291.47, 169.422, -650.949), (0.273592, -0.649567, 0.654463, -0.273656), (0, -2, -3, 4)),
    ((291.55, 169.48, -803.35), (0.273603, -0.649601, 0.654423, -0.273659), (0, -2, -4, 4)),
    ((-361.34, 251.46, -504.38), (0.614524, -0.694621, -0.183338, 0.32596), (-1, 0, -1, 5)),
    ((-362.82, 7.63, -699.15), (0.231848, 0.562911, 0.732908, 0.303684), (-2, -1, -2, 4)),
    ((-146.08, 64.78, -700.29), (0.306839, 0.728476, -0.564869, -0.236845), (-1, -1, 0, 5)),
    ((-409.32, -5.18, -684.87), (0.231863, 0.562916, 0.732904, 0.303672), (-2, -1, -2, 4)),
    ((-67.83, 85.11, -686.63), (0.306892, 0.728538, -0.564782, -0.236793), (-1, -1, 0, 5)),
]
# fmt: on


@pytest.mark.parametrize("row", HANGING)
def test_one_posture_has_the_confdata_that_a_controller_stored(row):
    place, turn, configuration = row
    own = Kinematics.of(load_config("irb120").groups[0])
    world = tuple(v / 1000 for v in place), frames.normalise(turn)
    found = own.solutions(frames.compose(frames.invert(BASE), world), (0.0,) * 6)
    assert len(found) > 1
    assert [own.configuration(p) for p in found].count(configuration) == 1
    assert own.configuration(own.fitting(found, configuration, "turn")) == configuration
