"""Drawing of a robot from the user's description: links with visuals.

The description itself never reaches the page. Links have numbers instead of names, meshes names
that the server gives them; a missing mesh has no name, and the page draws a solid from joint to
joint instead.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import dropwhile
from xml.etree.ElementTree import Element, SubElement, tostring

from rapidgen.axes import frames
from rapidgen.axes.alignment import aligned
from rapidgen.axes.chain import along, steps_of
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.config.urdf.visual_trees import Tree
from rapidgen.config.urdf.visuals import Visual
from rapidgen.viewer.primitive_urdf import BASE, ENDLESS, Drawing
from rapidgen.viewer.primitives import text

FLANGE = "flange"
NameOf = Callable[[Visual], str]


def shares(groups: Sequence[GroupConfig], result: Mapping[str, Tree]) -> dict[str, frozenset[str]]:
    """Return the links of its description that each group draws.

    They are those after its own joints; links without a robot belong to the first group.
    """
    made: dict[str, frozenset[str]] = {}
    for tree in dict.fromkeys(result.values()):
        own = [group for group in groups if result.get(group.name) is tree]
        by_joint = {joint.name: group.name for group in own for joint in group.joints}
        owner = {
            link: next(
                (
                    by_joint[j.name]
                    for j in reversed(tree.graph.path_to(link))
                    if j.name in by_joint
                ),
                own[0].name,
            )
            for link in tree.graph.robot.links
        }
        for group in own:
            made[group.name] = frozenset(k for k, name in owner.items() if name == group.name)
    return made


def drawn(group: GroupConfig, tree: Tree, links: frozenset[str], name_of: NameOf) -> Drawing | None:
    """Return the drawing of a group with the description's joints.

    None: it moves otherwise.
    """
    numbers = {link: f"part_{i}" for i, link in enumerate(tree.graph.robot.links)}
    names = JointMap.of(group).names
    stands = _stands(group, tree)
    end, last = _last(group, tree)
    chain = steps_of(group, group.chain)
    result = aligned(partial(_along, group, last, stands), partial(along, chain), len(names))
    if result is None:
        return None
    root, flange = result
    robot = Element("robot", name=group.name)
    SubElement(robot, "link", name=BASE)
    passive: dict[str, tuple[tuple[int, float], ...]] = {}
    for link, number in numbers.items():
        element = SubElement(robot, "link", name=number)
        for visual in tree.visuals.get(link, ()) if link in links else ():
            _draw(element, visual, name_of)
        if link not in tree.graph.above:
            _joint(robot, f" root_{number}", "fixed", (BASE, number), _origin(frames.invert(root)))
    for i, joint in enumerate(tree.graph.robot.joints):
        ends = (numbers[joint.parent], numbers[joint.child])
        place = joint.moved(stands.get(joint.name, 0.0))
        kind = "prismatic" if joint.kind == "prismatic" else "continuous"
        if joint.name in names:
            _joint(robot, joint.name, kind, ends, place, joint)
        elif joint.mimic in names and joint.kind != "fixed":
            # No joint name begins with a blank, because the page's parser does not trim it.
            passive[name := f" passive_{i}"] = ((names.index(joint.mimic), joint.multiplier),)
            _joint(robot, name, kind, ends, place, joint)
        else:
            _joint(robot, f" fixed_{i}", "fixed", ends, place)
    SubElement(robot, "link", name=FLANGE)
    _joint(robot, " flange", "fixed", (numbers.get(end, BASE), FLANGE), _origin(flange))
    urdf = tostring(robot, "unicode")
    return Drawing(urdf, (*names, *passive), FLANGE, (*passive.values(),), root)


def _stands(group: GroupConfig, tree: Tree) -> dict[str, float]:
    """Return fixed joints of the arm and their poses."""
    axes = {joint.name: joint.axis for joint in group.joints}
    last = next((j.name for j in reversed(group.joints) if j.axis.startswith("rax")), "")
    end = tree.graph.robot.joint(last)
    path = (*tree.graph.ancestors(end), end) if end is not None else ()
    arm = dropwhile(lambda joint: not axes.get(joint.name, "").startswith("rax"), path)
    still = [joint.name for joint in arm if joint.is_actuated and joint.name not in axes]
    return dict(zip(still, (saved.value for saved in group.kept), strict=False))


def _last(group: GroupConfig, tree: Tree) -> tuple[str, tuple[UrdfJoint, ...]]:
    """Return the link with the flange (empty: the root) and its joints."""
    name = next((step.joint for step in reversed(group.chain) if step.joint), "")
    joint = tree.graph.robot.joint(name)
    return (joint.child, tree.graph.path_to(joint.child)) if joint is not None else ("", ())


def _along(
    group: GroupConfig,
    path: Sequence[UrdfJoint],
    stands: Mapping[str, float],
    values: Sequence[float],
) -> frames.Pose:
    """Return the pose of the link at the end of a path.

    The joint values are in the sense of the URDF.
    """
    by_name = dict(zip(JointMap.of(group).names, values, strict=True))
    made = frames.IDENTITY
    for joint in path:
        amount = by_name.get(joint.mimic, 0.0) * joint.multiplier
        amount = by_name.get(joint.name, amount)
        slides = joint.kind == "prismatic"
        xyz, rpy = joint.moved(stands.get(joint.name, 0.0))
        made = frames.compose(made, (xyz, frames.from_rpy(*rpy)))
        step = frames.scale(joint.axis, amount if slides else 0.0)
        turn = frames.about(joint.axis, 0.0 if slides else amount)
        made = frames.compose(made, (step, turn))
    return made


def _origin(pose: frames.Pose) -> tuple[frames.Vector, frames.Vector]:
    """xyz and rpy."""
    z, y, x = frames.to_zyx(pose[1])
    return pose[0], (x, y, z)


def _joint(
    robot: Element,
    name: str,
    kind: str,
    ends: tuple[str, str],
    place: tuple[frames.Vector, frames.Vector],
    moving: UrdfJoint | None = None,
) -> None:
    joint = SubElement(robot, "joint", name=name, type=kind)
    SubElement(joint, "origin", xyz=text(place[0]), rpy=text(place[1]))
    SubElement(joint, "parent", link=ends[0])
    SubElement(joint, "child", link=ends[1])
    if moving is not None:
        SubElement(joint, "axis", xyz=text(moving.axis))
        SubElement(joint, "limit", ENDLESS)


def _draw(link: Element, visual: Visual, name_of: NameOf) -> None:
    element = SubElement(link, "visual")
    SubElement(element, "origin", xyz=text(visual.xyz), rpy=text(visual.rpy))
    shape = SubElement(SubElement(element, "geometry"), visual.kind)
    match visual.kind, visual.size:
        case "mesh", _:
            shape.set("filename", name_of(visual))
            shape.set("scale", text(visual.size))
        case "box", _:
            shape.set("size", text(visual.size))
        case "sphere", (radius,):
            shape.set("radius", repr(radius))
        case _, (radius, length):
            shape.set("radius", repr(radius))
            shape.set("length", repr(length))
    material = SubElement(element, "material", name="own" if visual.colour else "body")
    if visual.colour:
        SubElement(material, "color", rgba=text(visual.colour))
