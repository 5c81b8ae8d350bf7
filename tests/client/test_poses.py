"""`Pose`: constructors against SciPy's conventions, and refusals with the unit or the order."""

import math

import numpy as np
import pytest

from rapidgen.client import InvalidProgram, Pose, Program, from_degrees

# A turn of 90 deg about z. SciPy's Rotation.from_euler("z", 90, degrees=True) has
# as_quat() = (0, 0, 0.70711, 0.70711) and as_rotvec() = (0, 0, 1.5708).
HALF = math.sqrt(0.5)
TURNED = Pose.from_wxyz((0.3, -0.2, 0.5), (HALF, 0, 0, HALF))


@pytest.mark.parametrize(
    "pose",
    [
        Pose.from_xyzw(np.array([0.3, -0.2, 0.5]), np.array([0, 0, HALF, HALF])),
        Pose.from_mm((300, -200, 500), (HALF, 0, 0, HALF)),
        Pose.from_rotvec((0.3, -0.2, 0.5), (0, 0, math.pi / 2)),
        Pose.from_matrix([[0, -1, 0, 0.3], [1, 0, 0, -0.2], [0, 0, 1, 0.5], [0, 0, 0, 1]]),
        Pose.from_matrix(TURNED.matrix),
        Pose.from_rotvec(TURNED.position, TURNED.rotvec),
        Pose.from_xyzw(TURNED.position, TURNED.xyzw),
        Pose.from_wxyz(TURNED.position, -TURNED.wxyz).moved().moved(0.1).moved(x=-0.1),
    ],
)
def test_constructors_agree(pose):
    assert np.allclose(pose.matrix, TURNED.matrix, atol=1e-12)
    assert np.allclose(pose.mm, (300, -200, 500))
    assert np.allclose(pose.rotvec, (0, 0, math.pi / 2), atol=1e-9)


@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-3, 3.1])
def test_rotation_vectors_of_any_size_return(size):
    rotvec = size * np.array([0.6, 0.0, -0.8])
    assert np.allclose(Pose.from_rotvec((0, 0, 0), rotvec).rotvec, rotvec, atol=1e-12)


def test_repr_has_units():
    assert repr(TURNED) == (
        "Pose(x=0.3 m, y=-0.2 m, z=0.5 m; qw=0.707107, qx=0, qy=0, qz=0.707107)"
    )


def test_pose_is_a_position_and_a_quaternion():
    (x, y, z), (w, *_) = TURNED
    assert (x, y, z, w) == pytest.approx((0.3, -0.2, 0.5, HALF))
    assert TURNED.position == (0.3, -0.2, 0.5)


@pytest.mark.parametrize(
    ("wrong", "message", "help"),
    [
        (lambda: Pose.from_wxyz((300, 0, 500), (1, 0, 0, 0)), "beyond 100 m", "Pose.from_mm"),
        (lambda: Pose.from_wxyz((0, 0, 0), (1, 1, 0, 0)), "length 1.414, not 1", "divide"),
        (lambda: Pose.from_wxyz((0, 0), (1, 0, 0, 0)), "position (x, y, z) in m", "3 finite"),
        (lambda: Pose.from_xyzw((0, 0, 0), (1, 0, 0)), "quaternion (x, y, z, w)", "4 finite"),
        (lambda: Pose.from_xyzw((0, 0, 0), (1, 0, 0, math.nan)), "quaternion", "4 finite"),
        (lambda: Pose.from_wxyz("abc", (1, 0, 0, 0)), "position", "3 numbers"),
        (lambda: Pose.from_matrix(np.eye(3)), "3x3", "(4, 4)"),
        (lambda: Pose.from_matrix(np.diag([1, 1, -1, 1])), "not a rotation", "right-handed"),
        (lambda: Pose.from_matrix(np.diag([1000, 1000, 1000, 1])), "not a rotation", "orthogonal"),
        (lambda: Pose.from_rotvec((0, 0, 0), (1, 0)), "rotation vector, rad", "3 finite"),
        (lambda: Program().move_linear(((0.3, 0, 0.5), (1, 0, 0, 0))), "not a Pose", "from_xyzw"),
        (lambda: from_degrees(0, 10, "x"), "joints, deg", "3 numbers"),
    ],
)
def test_wrong_pose_is_refused(wrong, message, help):
    with pytest.raises(InvalidProgram) as refused:
        wrong()
    (fault,) = refused.value.diagnostics
    assert message in fault.message
    assert help in fault.help


def test_degrees_become_rad():
    assert from_degrees(0, 90, -180) == pytest.approx((0, math.pi / 2, -math.pi))
