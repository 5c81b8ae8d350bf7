"""A SRDF: planning groups, a home posture, and the pairs of links that may touch.

Only pairs that a joint connects are taken from the collision check: what else can never touch is
not known without the robot's real shape, and a check too many harms nobody.
"""

from xml.etree import ElementTree as ET

from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.ros.package.urdf import Drawn, urdf_range


def draw(config: RobotConfig, drawn: Drawn, name: str) -> str:
    """The text for the URDF that `drawn` is; planning groups are named as motion groups."""
    root = ET.Element("robot", name=name)
    for group in config.groups:
        element = ET.SubElement(root, "group", name=group.name)
        for joint in group.joints:
            ET.SubElement(element, "joint", name=joint.name)
        tool = drawn.arms[group.name].tip
        ET.SubElement(root, "group", name=f"{group.name}_arm").append(
            ET.Element("chain", base_link=drawn.arms[group.name].links[0], tip_link=tool)
        )
        home = ET.SubElement(root, "group_state", name="home", group=group.name)
        for joint_name, value in home_posture(group):
            ET.SubElement(home, "joint", name=joint_name, value=f"{value:.6g}")
    for element in drawn.root.iter("joint"):
        if element.find("mimic") is not None:
            ET.SubElement(root, "passive_joint", name=element.attrib["name"])
    for one, other in dict.fromkeys(drawn.adjacent):
        ET.SubElement(root, "disable_collisions", link1=one, link2=other, reason="Adjacent")
    ET.indent(root)
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def home_posture(group: GroupConfig) -> list[tuple[str, float]]:
    """All joints at 0, or as near to it as their range allows; rad or m."""
    found = []
    for joint in group.joints:
        lower, upper = urdf_range(joint)
        found.append((joint.name, min(max(0.0, lower), upper)))
    return found
