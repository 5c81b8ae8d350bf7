"""ros2_control over the node's topics, without C++ of our own.

The hardware is `joint_state_topic_hardware_interface/JointStateTopicSystem` of the distribution: it
publishes the command interfaces of its joints as a JointState in each cycle, and reads a JointState
into their state interfaces. The node receives the commands for externally guided motion, so each
group needs `egm:`. Source of names and parameters: topic_based_hardware_interfaces 1.1.0.
"""

from collections.abc import Iterator, Sequence
from xml.etree import ElementTree as ET

from rapidgen.config.model import EgmSettings, GroupConfig
from rapidgen.ros.package.urdf import PlacedRobot

PLUGIN = "joint_state_topic_hardware_interface/JointStateTopicSystem"
_NODE = "rapidgen"
_SLACK = 0.1
"""rad by which a joint may be away from its command besides the delay of the guidance."""


def is_possible(robots: Sequence[PlacedRobot]) -> bool:
    """True if set points reach all groups of all robots."""
    return all(group.egm is not None for robot in robots for group in robot.config.groups)


def add_hardware(root: ET.Element, robots: Sequence[PlacedRobot]) -> None:
    """Add a `<ros2_control>` block for each motion group, if all have EGM."""
    if not is_possible(robots):
        return
    for robot in robots:
        for group in robot.config.groups:
            system = ET.SubElement(
                root, "ros2_control", name=robot.prefix + group.name, type="system"
            )
            hardware = ET.SubElement(system, "hardware")
            ET.SubElement(hardware, "plugin").text = PLUGIN
            for name, value in _parameters(node_topics(robot, group)):
                ET.SubElement(hardware, "param", name=name).text = value
            for joint in group.joints:
                element = ET.SubElement(system, "joint", name=robot.prefix + joint.name)
                ET.SubElement(element, "command_interface", name="position")
                ET.SubElement(element, "state_interface", name="position")
                ET.SubElement(element, "state_interface", name="velocity")


def node_topics(robot: PlacedRobot, group: GroupConfig) -> str:
    """Return what the names of the node's own topics for a group begin with."""
    space = f"/{robot.prefix.removesuffix('_')}" if robot.prefix else ""
    several = len(robot.config.groups) > 1
    return f"{space}/{_NODE}" + (f"/{group.name}" if several else "")


def _parameters(topics: str) -> Iterator[tuple[str, str]]:
    yield "joint_commands_topic", f"{topics}/joint_commands"
    yield "joint_states_topic", f"{topics}/joint_states"
    # Commands near the measured position are sent as well: silence would end the guidance.
    yield "trigger_joint_command_threshold", "-1"


def path_tolerance(group: GroupConfig) -> float:
    """Return how far a joint may be from its command in motion, rad.

    The law of the guidance turns a deviation into a speed, so at the largest speed the robot is
    `max_speed / gain` behind.
    """
    settings = group.egm
    return 0.0 if settings is None else _delay(settings) + _SLACK


def _delay(settings: EgmSettings) -> float:
    return settings.max_speed / settings.gain
