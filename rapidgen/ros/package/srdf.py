"""SRDF: planning groups, a home posture, pairs of links that may touch.

Excluded from the collision check are pairs that a joint connects, bars of one chain that touch at
home because they are drawn too thick, and the pairs that rapidgen's own collision check leaves out.
An unnecessary check does no harm.
"""

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.ros.package.shapes import overlapping
from rapidgen.ros.package.urdf import PlacedRobot, UrdfDrawing, urdf_range

TOGETHER = "robots"
"""Planning group of all others: a plan for all arms at once."""


def draw(
    robots: Sequence[PlacedRobot],
    drawn: UrdfDrawing,
    name: str,
    unchecked: Iterable[tuple[str, str, str]] = (),
) -> str:
    """Return the text for the URDF `drawn`.

    Planning groups are named as motion groups. `unchecked` are further pairs (link, link, reason).
    """
    root = ET.Element("robot", name=name)
    for robot in robots:
        for group in robot.config.groups:
            _group(root, group, robot.prefix, drawn)
    if len(drawn.arms) > 1:
        together = ET.SubElement(root, "group", name=TOGETHER)
        for member in drawn.arms:
            ET.SubElement(together, "group", name=member)
    for element in drawn.root.iter("joint"):
        if element.find("mimic") is not None:
            ET.SubElement(root, "passive_joint", name=element.attrib["name"])
    home = {
        robot.prefix + joint: value
        for robot in robots
        for group in robot.config.groups
        for joint, value in home_posture(group)
    }
    pairs = dict.fromkeys(drawn.adjacent, "Adjacent")
    shaped = {link for names in drawn.names.values() for link in names.values()}
    for one, other in overlapping(drawn.root, home, shaped):
        pairs.setdefault((one, other), "Default")
    for one, other, reason in unchecked:
        if (other, one) not in pairs:
            pairs.setdefault((one, other), reason)
    for (one, other), reason in pairs.items():
        ET.SubElement(root, "disable_collisions", link1=one, link2=other, reason=reason)
    ET.indent(root)
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def chain_group(name: str, joints: Sequence[str], drawn: UrdfDrawing) -> str:
    """Return the planning group of the arm's chain, which has a solver.

    It is the motion group's, or a separate one if the motion group has more joints (those of
    positioners).
    """
    return name if set(joints) <= set(drawn.arms[name].joints) else f"{name}_arm"


def _group(root: ET.Element, group: GroupConfig, prefix: str, drawn: UrdfDrawing) -> None:
    name = prefix + group.name
    joints = [prefix + joint.name for joint in group.joints]
    arm, solved = drawn.arms[name], chain_group(name, joints, drawn)
    # MoveIt solves a group by the solver of one in it, fixed joints included: a list of joints that
    # move would have none.
    chain = ET.Element("chain", base_link=arm.links[0], tip_link=arm.tip)
    ET.SubElement(root, "group", name=solved).append(chain)
    if solved != name:
        complete = ET.SubElement(root, "group", name=name)
        ET.SubElement(complete, "group", name=solved)
        for joint in joints:
            if joint not in arm.joints:
                ET.SubElement(complete, "joint", name=joint)
    home = ET.SubElement(root, "group_state", name="home", group=name)
    for joint_name, value in home_posture(group):
        ET.SubElement(home, "joint", name=prefix + joint_name, value=f"{value:.6g}")


def home_posture(group: GroupConfig) -> list[tuple[str, float]]:
    """Return the model's usual start within the URDF's ranges; rad or m.

    With all joints at 0 wrists are singular, and the grippers of two arms may touch.
    """
    result = []
    values = JointMap.of(group).to_urdf(usual_start(group))
    for joint, value in zip(group.joints, values, strict=True):
        lower, upper = urdf_range(joint)
        result.append((joint.name, min(max(value, lower), upper)))
    return result
