"""The SRDF of a URDF: data that MoveIt would not find by itself."""

import xml.etree.ElementTree as ET

import pytest

from rapidgen.config import load_config
from rapidgen.ros.package import ros2_packages


def drawn(robot):
    """Configuration, URDF and SRDF of a package."""
    config = load_config(robot)
    files = ros2_packages(config, robot, robot)
    return config, *(
        ET.fromstring(next(text for path, text in files.items() if path.endswith(kind)))
        for kind in (".urdf", ".srdf")
    )


@pytest.mark.parametrize(
    ("robot", "groups", "passive"),
    [
        ("irb120", ["rob1"], 0),
        ("irb460", ["rob1"], 2),
        ("irb14000", ["rob_l", "rob_r", "robots"], 0),
        ("irb120_track", ["rob1_arm", "rob1"], 0),
    ],
)
def test_groups_homes_and_joints_that_follow_others(robot, groups, passive):
    config, urdf, srdf = drawn(robot)
    assert srdf.attrib["name"] == urdf.attrib["name"]
    assert [group.attrib["name"] for group in srdf.findall("group")] == groups
    followers = [j.attrib["name"] for j in urdf.iter("joint") if j.find("mimic") is not None]
    report = [joint.attrib["name"] for joint in srdf.findall("passive_joint")]
    assert (report, len(report)) == (followers, passive)
    homes = {home.attrib["group"]: home for home in srdf.findall("group_state")}
    assert list(homes) == [group.name for group in config.groups]
    limits = {joint.attrib["name"]: joint.find("limit") for joint in urdf.iter("joint")}
    for group in config.groups:
        home = homes[group.name]
        assert home.attrib["name"] == "home"
        values = {joint.attrib["name"]: float(joint.attrib["value"]) for joint in home}
        assert list(values) == [joint.name for joint in group.joints]
        for name, value in values.items():
            lower, upper = (float(limits[name].attrib[key]) for key in ("lower", "upper"))
            assert lower <= value <= upper


@pytest.mark.parametrize("robot", ["irb120", "irb14000", "irb120_track"])
def test_links_that_a_joint_connects_may_touch(robot):
    _, urdf, srdf = drawn(robot)
    pairs = {
        frozenset((pair.attrib["link1"], pair.attrib["link2"])): pair.attrib["reason"]
        for pair in srdf.iter("disable_collisions")
    }
    assert len(pairs) == len(srdf.findall("disable_collisions"))
    assert set(pairs.values()) <= {"Adjacent", "Default"}
    shapes = {
        link.attrib["name"] for link in urdf.iter("link") if link.find("collision") is not None
    }
    connected = {
        frozenset((joint.find("parent").attrib["link"], joint.find("child").attrib["link"]))
        for joint in urdf.iter("joint")
    }
    for pair in connected:
        if pair <= shapes:
            assert pairs[pair] == "Adjacent"


def test_the_group_of_all_arms_has_each_of_them():
    _, _, srdf = drawn("irb14000")
    (together,) = (group for group in srdf.findall("group") if group.attrib["name"] == "robots")
    assert [member.attrib["name"] for member in together] == ["rob_l", "rob_r"]
    for name in ("rob_l", "rob_r"):
        (group,) = (group for group in srdf.findall("group") if group.attrib["name"] == name)
        assert [part.tag for part in group] == ["chain"]


def test_srdf_of_positioner_has_arm_and_joint_groups():
    _, urdf, srdf = drawn("irb120_track")
    arm, complete = srdf.findall("group")
    (chain,) = arm
    links = {link.attrib["name"] for link in urdf.iter("link")}
    assert (chain.tag, {*chain.attrib.values()} <= links) == ("chain", True)
    assert [(part.tag, part.attrib["name"]) for part in complete] == [
        ("group", "rob1_arm"),
        ("joint", "positioner"),
    ]
