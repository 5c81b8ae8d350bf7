"""Drawing of a robot without meshes."""

from xml.etree import ElementTree

import pytest

from rapidgen.config import load_config, shipped_names
from rapidgen.viewer.primitive_urdf import described
from rapidgen.viewer.robots import side_by_side
from tests.docs.tree import ROOT


def test_every_shipped_model_has_a_drawing_with_its_joints():
    for name in shipped_names():
        for group in load_config(name).groups:
            drawing = described(group)
            tree = ElementTree.fromstring(drawing.urdf)
            joints = {joint.get("name") for joint in tree.iter("joint")}
            text = {step.joint for step in group.chain if step.joint}
            assert text <= joints
            assert drawing.flange in {link.get("name") for link in tree.iter("link")}
            assert len(drawing.values([0.0] * len(group.joints))) == len(drawing.movable)


def test_robots_that_would_stand_in_one_another_stand_apart():
    def bases(name):
        groups = load_config(name).groups
        drawings = [described(group) for group in groups]
        return [robot.base.position for robot in side_by_side(groups, drawings)]

    two = bases(str(ROOT / "robots" / "examples" / "two_arms_track-rw6.yaml"))
    assert two[0] == (0.0, 0.0, 0.0)
    assert two[1][1] < -1
    # The two arms of a YuMi have one root, and shoulders of their own.
    assert bases("irb14000") == [(0.0, 0.0, 0.0)] * 2


def test_the_forearm_turns_with_axis_four():
    """The tube was drawn on link 3, which axis 4 does not turn [facts of public meshes]."""
    for name in ("irb120", "irb1600", "irb6640"):
        group = load_config(name).groups[0]
        tree = ElementTree.fromstring(described(group).urdf)
        length = next(step.xyz[0] for step in group.chain if step.joint == "joint_4")
        lowest = min(
            float(visual.find("origin").get("xyz").split()[0]) - float(shape.get("length")) / 2
            for visual in tree.find("link[@name='link_4']").iter("visual")
            if (shape := visual.find("geometry/cylinder")) is not None
            and shape.get("radius") != "0"
            and abs(float(visual.find("origin").get("xyz").split()[1])) < 1e-9
        )
        assert -0.8 * length < lowest < -0.5 * length


def test_the_balancer_of_heavy_arms_follows_axis_two():
    group = load_config("irb6640").groups[0]
    drawing = described(group)
    upright = drawing.values([0.0] * 6)
    leaning = drawing.values([0.0, 0.3, 0.0, 0.0, 0.0, 0.0])
    assert upright[6:] == (0.0, 0.0)
    # Case and rod stay in one line: the rod turns back what the arm has turned.
    assert leaning[6] - leaning[7] == pytest.approx(0.3)
    assert described(load_config("irb120").groups[0]).passive == ()


def test_a_track_is_as_long_as_its_axis_goes():
    group = load_config("irb120_track").groups[0]
    track = next(joint for joint in group.joints if joint.kind == "prismatic")
    tree = ElementTree.fromstring(described(group).urdf)
    lengths = [max(map(float, shape.get("size").split())) for shape in tree.iter("box")]
    assert max(lengths) >= track.upper - track.lower


def test_positioner_is_separate_and_turns_with_its_axis():
    group = load_config("irb120_track").groups[0]
    tree = ElementTree.fromstring(described(group).urdf)
    (positioner,) = group.positioners
    named = {step.joint for step in positioner.chain if step.joint}
    assert named <= {joint.get("name") for joint in tree.iter("joint")}
    children = {joint.find("child").get("link") for joint in tree.iter("joint")}
    links = [link.get("name") for link in tree.iter("link")]
    assert [link for link in links if link not in children] == ["base"]
    assert "unit_1_1" in children
