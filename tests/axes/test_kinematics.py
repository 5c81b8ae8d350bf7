"""Kinematics of the shipped robots against other sources and known poses."""

import math
import random
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import yourdfpy

from rapidgen.axes import frames, numeric_ik
from rapidgen.axes.kinematics import Kinematics, quarter
from rapidgen.axes.spherical_wrist import BRANCHES
from rapidgen.config import load_config, shipped_names

GROUPS = [(name, group) for name in shipped_names() for group in load_config(name).groups]
MODELS = [pytest.param(g, id=f"{name}-{g.name}") for name, g in GROUPS if g.chain]
WRIST_ARMS = [
    pytest.param(g, id=f"{name}-{g.name}")
    for name, g in GROUPS
    if g.chain and Kinematics.of(g)._arm
]

IRB140 = Path(__file__).parents[2] / "tools" / "interop" / "irb140.yaml"


def kinematics(name):
    return Kinematics.of(load_config(name).groups[0])


def postures(group, count, seed=1):
    rng = random.Random(seed)
    return [
        tuple(rng.uniform(joint.lower, joint.upper) for joint in group.joints) for _ in range(count)
    ]


def difference(a, b):
    return max(frames.distance(a[0], b[0]), frames.angle_between(a[1], b[1]))


def as_urdf(group):
    """The chain as a URDF; a passive step becomes a joint of its own."""
    links, joints = ["<link name='l0'/>"], []
    kinds = {joint.name: joint.kind for joint in group.joints}
    for i, step in enumerate(group.chain):
        kind = kinds.get(step.joint, "revolute" if step.follows else "fixed")
        links.append(f"<link name='l{i + 1}'/>")
        xyz, rpy, axis = (" ".join(map(repr, v)) for v in (step.xyz, step.rpy, step.axis))
        joints.append(
            f"<joint name='{step.joint or f'step{i}'}' type='{kind}'>"
            f"<parent link='l{i}'/><child link='l{i + 1}'/>"
            f"<origin xyz='{xyz}' rpy='{rpy}'/><axis xyz='{axis}'/>"
            "<limit lower='-20' upper='20' velocity='1' effort='1'/></joint>"
        )
    return f"<robot name='r'>{''.join(links + joints)}</robot>", f"l{len(group.chain)}"


@pytest.mark.parametrize("group", MODELS)
def test_forward_agrees_with_yourdfpy(group):
    text, tip = as_urdf(group)
    urdf = yourdfpy.URDF.load(BytesIO(text.encode()), load_meshes=False, build_scene_graph=True)
    own = Kinematics.of(group)
    for posture in postures(group, 5):
        values = dict(zip(own.map.names, own.map.to_urdf(posture), strict=True))
        for i, step in enumerate(group.chain):
            if step.follows:
                values[f"step{i}"] = sum(values[name] * k for name, k in step.follows)
        urdf.update_cfg({name: values[name] for name in urdf.actuated_joint_names})
        matrix = urdf.get_transform(tip, "l0")
        position, q = own.forward(posture)
        assert position == pytest.approx(matrix[:3, 3], abs=1e-9)
        assert np.array(frames.to_matrix(q)) == pytest.approx(matrix[:3, :3], abs=1e-9)


@pytest.mark.parametrize("group", MODELS)
def test_inverse_undoes_forward(group):
    own = Kinematics.of(group)
    for posture in postures(group, 40 if own.is_closed_form else 6):
        pose = own.forward(posture)
        assert own.follow(pose, posture) == pytest.approx(posture, abs=1e-5)
        result = own.solutions(pose, posture)
        assert result[0] == pytest.approx(posture, abs=1e-5)
        for other in result:
            assert difference(own.forward(other), pose) < 1e-6


def opw_robot(arm):
    """The arm in the package's own parameters, whose zero has the forearm upright."""
    opw = pytest.importorskip("py_opw_kinematics", reason="needs Python 3.11")
    shoulder, (length, rise) = arm.shoulder, arm.fore
    model = opw.KinematicModel(
        a1=shoulder[0], a2=-length * math.sin(rise), b=arm.lateral, c1=shoulder[1],
        c2=arm.upper[0], c3=length * math.cos(rise), c4=frames.norm(arm.flange),
        offsets=(0, 0, -math.pi / 2, 0, 0, 0), flip_axes=(False,) * 6,
    )  # fmt: skip
    return opw.Robot(model, degrees=False)


def wrapped(angles):
    return tuple(math.remainder(a, 2 * math.pi) for a in angles)


@pytest.mark.parametrize("group", WRIST_ARMS)
def test_an_independent_package_finds_the_same_postures(group):
    own = Kinematics.of(group)
    arm = own._arm.arm
    robot = opw_robot(arm)
    for posture in postures(group, 25):
        angles = own._robot_angles(own.map.to_urdf(posture))
        theirs = robot.forward(angles)
        pose = arm.forward(angles)
        assert theirs.translation == pytest.approx(pose[0], abs=1e-9)
        assert theirs.rotation.as_matrix() == pytest.approx(
            np.array(frames.to_matrix(pose[1])), abs=1e-9
        )
        mine = [arm.solve(pose, branch, angles[3]) for branch in BRANCHES]
        mine = sorted(wrapped(a) for a in mine if a is not None)
        result = [
            wrapped(a) for a in robot.reach(theirs).joints.reshape(-1, 6) if not np.isnan(a).any()
        ]
        for solution in mine:
            gap = min(max(abs(math.remainder(a - b, 2 * math.pi)) for a, b in
                          zip(solution, other, strict=True)) for other in result)  # fmt: skip
            assert gap < 1e-6
        assert len(mine) == len(result)


# ABB's product data: flange at zero. IRB 120: 374 mm out, 630 mm up (ROB0149EN, the drawing
# of the working range); the others: the lengths that the ROS-Industrial models quote from ABB.
KNOWN = {
    "irb120": (374.0, 0.0, 630.0),
    "irb1600": (815.0, 0.0, 961.5),
    "irb2400": (940.0, 0.0, 1455.0),
    "irb6640": (1912.5, 0.0, 2055.0),
    "irb6700": (1662.5, 0.0, 2105.0),
}


@pytest.mark.parametrize("name", KNOWN)
def test_zero_pose(name):
    (x, y, z), q = kinematics(name).forward((0.0,) * 6)
    assert (x * 1000, y * 1000, z * 1000) == pytest.approx(KNOWN[name], abs=1e-6)
    half = math.sqrt(0.5)
    assert q == pytest.approx((half, 0.0, half, 0.0), abs=1e-12)  # z of the flange forward


def test_coupling_holds_the_forearm_when_axis_2_moves():
    # IRB 2400: rax_3 counts from the horizontal, so axis 2 alone only shifts the wrist.
    own = kinematics("irb2400")
    before, after = own.forward((0.0,) * 6), own.forward((0.0, 0.5, 0.0, 0.0, 0.0, 0.0))
    assert frames.angle_between(before[1], after[1]) < 1e-9
    assert frames.distance(before[0], after[0]) > 0.3


def test_a_palletiser_keeps_its_tool_upright():
    own = kinematics("irb460")
    for posture in postures(own.group, 10):
        _, q = own.forward(posture)
        assert frames.rotate(q, (0.0, 0.0, 1.0)) == pytest.approx((0, 0, -1), abs=1e-9)


@pytest.mark.parametrize(
    ("place", "quadrants"),
    [((1408.88, 37.23, 925.3), (0, 0)), ((1421.11, -325.25, 475.46), (-1, -1))],
)
def test_palletiser_at_zero_has_the_tool_pointing_down(place, quadrants):
    # tool0 and wobj0 of a working IRB 660 [code EdgarIvanMM]: quaternion 0,0,1,0, cf1 and cf6.
    own = kinematics("irb660")
    pose = (tuple(mm / 1000 for mm in place), (0.0, 0.0, 1.0, 0.0))
    result = own.follow(pose, (0.0,) * 4)
    assert result is not None
    assert tuple(math.floor(result[k] / (math.pi / 2)) for k in (0, 3)) == quadrants


def test_a_track_moves_the_base():
    own = kinematics("irb120_track")
    home = (0.0,) * len(own.group.joints)
    place = [j.axis for j in own.group.joints].index("eax_a")
    moved = tuple(0.5 if i == place else v for i, v in enumerate(home))
    here, target = own.forward(home), own.forward(moved)
    assert frames.distance(here[0], target[0]) == pytest.approx(0.5)
    assert own.follow(target, moved) == pytest.approx(moved, abs=1e-9)


def test_the_singular_wrist_keeps_axis_4():
    own = kinematics("irb120")
    posture = (0.1, 0.2, 0.3, 0.7, 0.0, -0.4)
    assert own.follow(own.forward(posture), posture) == pytest.approx(posture, abs=1e-6)


def test_out_of_reach_is_nothing():
    own = kinematics("irb120")
    far = ((2.0, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
    assert own.follow(far, (0.0,) * 6) is None
    assert own.solutions(far, (0.0,) * 6) == []
    assert not any(own.beyond(far, (0.0,) * 6))


def test_axis_6_appears_with_every_turn_of_its_range():
    own = kinematics("irb120")
    posture = (0.1, 0.2, 0.3, 0.7, 0.5, 0.4)
    same = [
        p for p in own.solutions(own.forward(posture), posture)
        if p[:5] == pytest.approx(posture[:5], abs=1e-6)
    ]  # fmt: skip
    turns = sorted(round(math.degrees(p[5] - posture[5])) for p in same)
    assert turns == [-360, 0, 360]  # range +-400 degrees


@pytest.mark.parametrize(
    ("degrees", "cf"),
    [(0, 0), (89.9, 0), (90, 1), (-0.1, -1), (-89.9, -1), (-90, -2), (200, 2), (-200, -3)],
)
def test_quarter_turns(degrees, cf):
    # S4 datasys 1-confdata: trunc(a / 90), for negative angles trunc(a / 90 - 1)
    assert quarter(math.radians(degrees)) == cf


def test_metres_of_a_linear_axis():
    assert [quarter(v, linear=True) for v in (0.5, 1.5, -0.5)] == [0, 1, -1]


def test_cfx_tells_the_eight_branches_apart():
    # +4 behind axis 1, +2 behind the lower arm [mem], +1 axis 5 negative
    own = kinematics("irb120")
    posture = (0.1, 0.2, 0.3, 0.7, 0.5, 0.4)
    result = {own.configuration(p)[3] for p in own.solutions(own.forward(posture), posture)}
    assert own.configuration(posture)[3] == 0
    assert own.configuration((0.1, 0.2, 0.3, 0.7, -0.5, 0.4))[3] == 1
    assert result >= {0, 1}
    assert own.configuration((0.1, -1.5, -1.5, 0.7, 0.5, 0.4))[3] & 4


def with_axis_4(degrees):
    return (0.1, 0.0, 0.0, math.radians(degrees), 0.5, 0.1)


@pytest.mark.parametrize(("robot", "check"), [("irb120", "quarter"), ("irb2400", "turn")])
def test_45_degrees_off_the_quarter_are_accepted(robot, check):
    # S4 overview 5-33: cf4 = 0 accepts -45 to 135 degrees; always so without cfx
    own = kinematics(robot)
    for angle, accepted in ((-44, True), (-46, False), (134, True), (136, False)):
        assert own.matches(with_axis_4(angle), (0, 0, 0, 0), check) is accepted


def test_cfx_and_the_turn_make_a_configuration():
    # Public programs for the IRB 140 reach targets whose axes 4 and 6 are up to 100 degrees
    # outside their quarters; none has another cfx, none is a turn off (docs/rapid/motion-model.md).
    own = kinematics("irb120")
    for angle, accepted in ((-134, True), (-136, False), (100, True)):
        assert own.matches(with_axis_4(angle), (0, 0, 0, 0)) is accepted
    assert not own.matches(with_axis_4(45), (0, 0, 0, 1))
    assert not own.matches((0.1, 0.0, 0.0, 0.1, 0.5, 0.1 + 2 * math.pi), (0, 0, 0, 0))


@pytest.mark.parametrize(("cf6", "turn"), [(0, 0), (-1, 0), (1, 0), (2, 1), (4, 1), (-4, -1)])
def test_the_programmed_turn_is_the_one_closest_to_its_quarter(cf6, turn):
    own = kinematics("irb120")
    posture = (0.1, 0.2, 0.3, 0.7, 0.5, math.radians(20))
    result = own.solutions(own.forward(posture), posture)
    chosen = own.fitting(result, (0, 0, cf6, 0), "turn")
    assert math.degrees(chosen[5]) == pytest.approx(20 + 360 * turn)
    assert chosen[3] == pytest.approx(0.7)


def as_written(pose, digits=None):
    """A pose whose quaternion went through a file of so many decimals, or single precision."""
    q = np.round(pose[1], digits) if digits else np.array(pose[1], np.float32).astype(float)
    return pose[0], tuple((q / np.linalg.norm(q)).tolist())


@pytest.mark.parametrize("digits", [6, 9, None])
def test_rounding_does_not_turn_a_straight_wrist(digits):
    own = kinematics("irb120")
    for posture in postures(own.group, 50):
        a1, a2, a3, a4, _, a6 = posture
        straight = (a1, a2 / 3, a3 / 3, a4, 0.0, a6)  # away from the other singularities
        pose = as_written(own.forward(straight), digits)
        assert own.solutions(pose, straight)[0] == pytest.approx(straight, abs=5e-5)


def test_a_straight_wrist_has_both_signs_of_axis_5():
    own = kinematics("irb120")
    straight = (0.1, 0.2, 0.3, 0.4, 0.0, 0.5)
    assert [own.matches(straight, (0, 0, 0, x)) for x in range(4)] == [True, True, False, False]
    assert not own.matches((*straight[:4], 1e-3, 0.5), (0, 0, 0, 1))


def test_home_of_an_irb_140():
    """RobotStudio's API documentation (RsRobTarget) places it at 506.29, 0, 679.5 mm, turned
    by 180, 60, 180 degrees; its stations begin with axis 5 at 30 degrees."""
    own = kinematics(str(IRB140))
    home = (0.0, 0.0, 0.0, 0.0, math.radians(30), 0.0)
    place, q = own.forward(home)
    assert place == pytest.approx((0.50629, 0.0, 0.6795), abs=5e-6)
    turned = frames.from_rpy(*map(math.radians, (180, 60, 180)))
    assert frames.angle_between(q, turned) < 1e-9
    assert own.matches(home, (0, 0, 0, 0), "quarter")


def test_infinitely_many_postures_are_compared_at_once(monkeypatch):
    """A tool straight down on axis 1: axes 1 and 6 turn about one line, most starts arrive."""
    calls = []
    wrapped = numeric_ik._wrapped
    monkeypatch.setattr(numeric_ik, "_wrapped", lambda *a: calls.append(1) or wrapped(*a))
    own = Kinematics.of(load_config("irb14050").groups[0])
    start = tuple((j.lower + j.upper) / 2 for j in own.group.joints)
    list(own.found(((0.0, 0.0, 0.05), (0.0, 1.0, 0.0, 0.0)), start))
    assert len(calls) < 10_000  # 5,926 starts


def test_a_singular_arm_is_no_end_of_a_search():
    """Rows of the Jacobian vanish with a tool straight down in the robot's own foot."""
    singular = np.array([[1.0, 0.0], [0.0, 0.0]])
    assert numeric_ik.solved(singular, np.array([2.0, 0.0])) == pytest.approx([2.0, 0.0])
