"""Frame functions against hand-made values. Sources: S4 datasys, the page of each name."""

from types import SimpleNamespace

import pytest

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import bound
from rapidgen.runtime.values import ConfData, ExtJoint, Orient, Pos, Pose, RobTarget, WobjData

TURN_Z = Orient(0.70710678, 0, 0, 0.70710678)
UNIT = Orient(1, 0, 0, 0)


def call(name, *arguments):
    return bound(name).function(SimpleNamespace(), *arguments)


def target(x, y, z, rot=UNIT):
    return RobTarget(Pos(x, y, z), rot.copy(), ConfData(0, 0, 0, 0), ExtJoint(*[9e9] * 6))


def xyz(pos):
    return (pos.x, pos.y, pos.z)


def q(rot):
    return (rot.q1, rot.q2, rot.q3, rot.q4)


def pose(x, y, z, rot=UNIT):
    return Pose(Pos(x, y, z), rot.copy())


def test_offs_keeps_all_but_the_position():
    moved = call("Offs", target(1, 2, 3, TURN_Z), 10, 20, 30)
    assert xyz(moved.trans) == (11, 22, 33)
    assert moved.rot == TURN_Z


def test_rel_tool_shifts_in_the_tool_and_turns_x_then_new_y_then_new_z():
    moved = call("RelTool", target(0, 0, 0, TURN_Z), 10, 0, 5, None, None, None)
    assert xyz(moved.trans) == pytest.approx((0, 10, 5), abs=1e-5)
    both = call("RelTool", target(0, 0, 0), 0, 0, 0, 90, None, 90)
    # about x, then about the new z (which points along -y)
    assert q(both.rot) == pytest.approx((0.5, 0.5, -0.5, 0.5), abs=1e-6)


def test_orient_zyx_turns_in_the_opposite_order():
    assert q(call("OrientZYX", 90, 0, 90)) == pytest.approx((0.5, 0.5, 0.5, 0.5), abs=1e-6)


def test_euler_zyx_takes_exactly_one_switch():
    rotation = call("OrientZYX", 30, 20, 10)
    result = [
        call("EulerZYX", *(True if i == k else None for i in range(3)), rotation) for k in range(3)
    ]
    assert result == pytest.approx([10, 20, 30], abs=1e-4)
    with pytest.raises(RapidError):
        call("EulerZYX", True, True, None, rotation)


def test_poses():
    outer, inner = pose(10, 0, 0, TURN_Z), pose(1, 2, 3)
    both = call("PoseMult", outer, inner)
    assert xyz(both.trans) == pytest.approx((8, 1, 3), abs=1e-5)
    back = call("PoseMult", call("PoseInv", outer), both)
    assert xyz(back.trans) == pytest.approx((1, 2, 3), abs=1e-5)
    assert xyz(call("PoseVect", outer, Pos(1, 2, 3))) == pytest.approx((8, 1, 3), abs=1e-5)


def test_n_orient_corrects_small_errors_and_refuses_others():
    assert q(call("NOrient", Orient(0.98, 0, 0, 0))) == pytest.approx((1, 0, 0, 0))
    with pytest.raises(RapidError, match="ERR_ILLQUAT"):
        call("NOrient", Orient(0.5, 0, 0, 0))


def test_def_frame_with_its_three_origins():
    points = target(10, 0, 0), target(10, 5, 0), target(0, 2, 0)
    frame = call("DefFrame", *points, None)
    assert xyz(frame.trans) == (10, 0, 0)
    # x along the world's y, p3 on the positive y side: y along -x
    assert q(frame.rot) == pytest.approx((0.70710678, 0, 0, 0.70710678), abs=1e-6)
    assert xyz(call("DefFrame", *points, 2).trans) == (10, 5, 0)
    assert xyz(call("DefFrame", *points, 3).trans) == pytest.approx((10, 2, 0))


@pytest.mark.parametrize("third", [(20, 0, 0), (0, 0, 0.05)])
def test_points_that_make_no_frame(third):
    with pytest.raises(RapidError, match="ERR_FRAME"):
        call("DefFrame", target(0, 0, 0), target(10, 0, 0), target(*third), None)


def test_def_d_frame_takes_old_points_to_new_ones():
    old = [(0, 0, 0), (10, 0, 0), (0, 10, 0)]
    new = [(5, 5, 0), (5, 15, 0), (-5, 5, 0)]
    moved = call("DefDFrame", *(target(*p) for p in old), *(target(*p) for p in new))
    for a, b in zip(old, new, strict=True):
        assert xyz(call("PoseVect", moved, Pos(*a))) == pytest.approx(b, abs=1e-4)


def test_def_acc_frame_fits_best_and_tells_the_errors():
    old = [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 100)]
    new = [(5, 5, 0), (5, 105, 0), (-95, 5, 0), (5, 5, 104)]
    errors = {}
    worst, mean = (SimpleNamespace(set=lambda v, k=k: errors.update({k: v})) for k in "wm")
    arrays = [{i + 1: target(*p) for i, p in enumerate(points)} for points in (old, new)]
    fitted = call("DefAccFrame", *arrays, 4, worst, mean)
    assert q(fitted.rot) == pytest.approx((0.7071, 0, 0, 0.7071), abs=0.02)
    assert 0 < errors["m"] <= errors["w"] < 4


def test_mirror_in_the_xy_plane():
    plane = WobjData(False, True, "", pose(0, 0, 100), pose(0, 0, 0))
    moved = call("MirPos", target(10, 20, 130), plane, None, None)
    assert xyz(moved.trans) == pytest.approx((10, 20, 70), abs=1e-5)
    # x stays, z turns over: y is turned to keep the frame right-handed
    assert q(moved.rot) == pytest.approx((0, 1, 0, 0), abs=1e-6)
    other = call("MirPos", target(10, 20, 130), plane, None, True)
    assert q(other.rot) == pytest.approx((0, 0, 1, 0), abs=1e-6)


def test_vectors():
    assert call("Distance", Pos(1, 2, 3), Pos(1, 5, 7)) == 5
    assert call("DotProd", Pos(1, 2, 3), Pos(4, 5, 6)) == 32
    assert xyz(call("CrossProd", Pos(1, 0, 0), Pos(0, 1, 0))) == (0, 0, 1)
    assert call("VectMagn", Pos(3, 4, 0)) == 5
