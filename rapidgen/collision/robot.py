"""Moving frames and link shapes of one robot, from its configuration and a description.

The frames come from the configuration's chain, which the controller's postures refer to. Shapes
come from a description: the one of the configuration or another with the same kinematics, such as
the result of `rapidgen fit-shapes`. The links of the description move with the description's own
joints; its root is aligned with the chain.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from rapidgen.axes import frames
from rapidgen.axes.alignment import aligned
from rapidgen.axes.chain import Step, along, steps_of
from rapidgen.axes.mapping import JointMap
from rapidgen.collision.shapes import Shape
from rapidgen.collision.tree import WORLD, Node
from rapidgen.config.model import GroupConfig
from rapidgen.config.urdf.graph import Graph
from rapidgen.config.urdf.robot import UrdfJoint


@dataclass(frozen=True, slots=True)
class RobotFrames:
    """Nodes of a robot in a tree, and where links and the flange hang on them.

    `links` and `flange` are (node, pose in the node's frame).
    """

    nodes: tuple[Node, ...]
    flange: tuple[int, frames.Pose]
    links: Mapping[str, tuple[int, frames.Pose]]
    neighbours: frozenset[frozenset[str]] = frozenset()
    """Links that a joint connects directly."""


class MotionMismatch(Exception):
    """A description moves otherwise than the chain of the configuration."""


def frames_of_chain(group: GroupConfig, base: frames.Pose, first: int, column: int) -> RobotFrames:
    """Return the frames of a robot without a description.

    `first` is the index of its first node in the tree, `column` that of its first joint. Its links
    are `base` and one for each joint, with the joint's name.
    """
    steps = steps_of(group, group.chain)
    nodes: list[Node] = []
    links = {"base": (WORLD, base)}
    node, pose = WORLD, base
    for number, step in enumerate(steps):
        pose = frames.compose(pose, step.fixed)
        columns = _columns(step, column)
        if not columns:
            continue
        name = group.joints[step.joint].name if step.joint >= 0 else f"passive_{number}"
        nodes.append(Node(name, node, pose, step.axis, step.prismatic, columns))
        node, pose = first + len(nodes) - 1, frames.IDENTITY
        links[name] = (node, pose)
    return RobotFrames(tuple(nodes), (node, pose), links)


def stations_of(
    group: GroupConfig, base: frames.Pose, first: int, column: int
) -> tuple[tuple[Node, ...], Mapping[str, tuple[int, frames.Pose]]]:
    """Return nodes of a group's positioners, and the user frame of each by its unit.

    They are separate from the nodes of a description, which may lack positioners.
    """
    nodes: list[Node] = []
    stations: dict[str, tuple[int, frames.Pose]] = {}
    for positioner in group.positioners:
        node, pose = WORLD, base
        for step in steps_of(group, positioner.chain):
            pose = frames.compose(pose, step.fixed)
            columns = _columns(step, column)
            if columns:
                name = group.joints[step.joint].name if step.joint >= 0 else positioner.unit
                nodes.append(Node(name, node, pose, step.axis, step.prismatic, columns))
                node, pose = first + len(nodes) - 1, frames.IDENTITY
        stations[positioner.unit] = (node, pose)
    return tuple(nodes), stations


def _columns(step: Step, column: int) -> tuple[tuple[int, float], ...]:
    if step.joint >= 0:
        return ((column + step.joint, 1.0),)
    return tuple((column + index, factor) for index, factor in step.follows)


def frames_of_description(
    group: GroupConfig, graph: Graph, base: frames.Pose, first: int, column: int
) -> RobotFrames:
    """Return the frames of all links of a description that moves as the group's chain.

    Joints that are no joints of the group stand at 0. Raises MotionMismatch.
    """
    names = JointMap.of(group).names
    result = _aligned(group, graph, names)
    if result is None:
        raise MotionMismatch
    root, flange = result
    # root: from the description's root to the chain's; the links hang on the description's.
    start = frames.compose(base, frames.invert(root))
    nodes: list[Node] = []
    links: dict[str, tuple[int, frames.Pose]] = {}
    for link in graph.robot.links:
        if link not in graph.above:
            links[link] = (WORLD, start)
    for joint in _top_down(graph):
        node, pose = links[joint.parent]
        pose = frames.compose(pose, (joint.xyz, frames.from_rpy(*joint.rpy)))
        columns = _joint_columns(joint, names, column)
        if columns:
            slides = joint.kind == "prismatic"
            nodes.append(Node(joint.name, node, pose, joint.axis, slides, columns))
            node, pose = first + len(nodes) - 1, frames.IDENTITY
        links[joint.child] = (node, pose)
    last = _last_joint(group)
    end = graph.robot.joint(last)
    node, pose = links[end.child] if end is not None else (WORLD, start)
    neighbours = frozenset(frozenset((j.parent, j.child)) for j in graph.robot.joints)
    return RobotFrames(tuple(nodes), (node, frames.compose(pose, flange)), links, neighbours)


def _joint_columns(
    joint: UrdfJoint, names: Sequence[str], column: int
) -> tuple[tuple[int, float], ...]:
    if joint.name in names:
        return ((column + names.index(joint.name), 1.0),)
    if joint.mimic in names and joint.kind != "fixed":
        return ((column + names.index(joint.mimic), joint.multiplier),)
    return ()


def _top_down(graph: Graph) -> list[UrdfJoint]:
    """Return the joints of the tree, parents first."""
    return sorted(graph.robot.joints, key=lambda joint: len(graph.path_to(joint.child)))


def _last_joint(group: GroupConfig) -> str:
    return next((step.joint for step in reversed(group.chain) if step.joint), "")


def _aligned(
    group: GroupConfig, graph: Graph, names: tuple[str, ...]
) -> tuple[frames.Pose, frames.Pose] | None:
    end = graph.robot.joint(_last_joint(group))
    if end is None or not set(names) <= {joint.name for joint in graph.robot.joints}:
        return None
    path = graph.path_to(end.child)

    def description(values: Sequence[float]) -> frames.Pose:
        pose = frames.IDENTITY
        for joint in path:
            columns = _joint_columns(joint, names, 0)
            amount = sum(values[index] * factor for index, factor in columns)
            pose = frames.compose(pose, (joint.xyz, frames.from_rpy(*joint.rpy)))
            if joint.kind == "prismatic":
                pose = frames.compose(pose, (frames.scale(joint.axis, amount), frames.UNIT))
            else:
                pose = frames.compose(pose, (frames.ORIGIN, frames.about(joint.axis, amount)))
        return pose

    return aligned(description, partial(along, steps_of(group, group.chain)), len(names))


def shapes_on_node(shapes: Sequence[Shape], pose: frames.Pose) -> tuple[Shape, ...]:
    """Return shapes of a link in the frame of its node."""
    return tuple(shape.placed(pose) for shape in shapes)
