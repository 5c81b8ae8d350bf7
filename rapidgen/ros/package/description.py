"""The user's robot description in a generated URDF: its tree, with the meshes in the package.

Names of links and joints are the description's, so that they are those of a cell file, too. Limits
are those of the configuration. Joints that the configuration does not have stand at 0, as for
collision checks. The description hangs below the world so that its last link moves as the
configuration's chain.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol
from xml.etree import ElementTree as ET

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.collision.fitting import Fit
from rapidgen.collision.robot import RobotFrames, frames_of_description
from rapidgen.config.model import GroupConfig, Joint
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.config.urdf.visual_trees import Tree
from rapidgen.config.urdf.visuals import Visual
from rapidgen.diagnostics import refusal

_SAME = 1e-4
"""m and rad: a link at the end of the chain is the tip."""


@dataclass(frozen=True, slots=True, eq=False)
class DescribedGroup:
    """A motion group with its description, and collision parts that replace the meshes."""

    group: GroupConfig
    tree: Tree
    frames: RobotFrames
    """In the frame of the robot's base."""
    fits: Mapping[str, Fit] = field(default_factory=dict)


def described(group: GroupConfig, tree: Tree, fits: Mapping[str, Fit]) -> DescribedGroup:
    """Return a group with its description.

    Raises MotionMismatch if the description moves otherwise than the configuration's chain.
    """
    made = frames_of_description(group, tree.graph, frames.IDENTITY, 0, 0)
    return DescribedGroup(group, tree, made, fits)


class MeshFiles:
    """Mesh files of a package, by path in the package."""

    def __init__(self, package: str) -> None:
        self._package = package
        self._names: dict[tuple[str, Path], str] = {}
        self.files: dict[str, bytes] = {}

    def copied(self, kind: str, path: Path) -> str:
        """Return the URI of a copy of a mesh. Raises OSError."""
        known = self._names.get((kind, path))
        if known is None:
            known = self._names[kind, path] = self.added(kind, path.name, path.read_bytes())
        return known

    def added(self, kind: str, name: str, data: bytes) -> str:
        """Return the URI of a new mesh, with another name if the name is in use."""
        plain = "".join(c if c.isalnum() or c in "-_." else "_" for c in name)
        stem, suffix = Path(plain).stem, Path(plain).suffix.lower()
        file, number = f"meshes/{kind}/{stem}{suffix}", 2
        while file in self.files:
            file, number = f"meshes/{kind}/{stem}_{number}{suffix}", number + 1
        self.files[file] = data
        return f"package://{self._package}/{file}"


class _Names(Protocol):
    """What draws links and joints with names that are not in use."""

    def link(self, wished: str) -> str:
        """Add a link and return its name."""

    def fixed(
        self, parent: str, child: str, xyz: Sequence[float], rpy: Sequence[float], name: str = ""
    ) -> None:
        """Add a fixed joint."""

    def moving(self, joint: UrdfJoint, names: tuple[str, str, str], limits: Joint | None) -> None:
        """Add a joint with its name, parent and child; one without limits turns freely."""


def draw_tree(
    drawer: _Names,
    own: DescribedGroup,
    joints: Mapping[str, Joint],
    prefix: str,
    world: tuple[str, Pose],
) -> dict[str, str]:
    """Draw all links and joints of a description; return the names of its links in the URDF.

    `joints` are those of all groups of the robot, `world` is the link that the robot's base is in,
    and where.
    """
    root, base = world
    graph = own.tree.graph
    names: dict[str, str] = {}
    for link in graph.robot.links:
        # The description's own world would be the one of the URDF.
        names[link] = drawer.link(prefix + (link if link != root else f"robot_{link}"))
    for link in graph.robot.links:
        if link not in graph.above:
            xyz, q = frames.compose(base, own.frames.links[link][1])
            drawer.fixed(root, names[link], xyz, _rpy(q))
    for joint in graph.robot.joints:
        ends = names[joint.parent], names[joint.child]
        is_follower = joint.mimic in joints and joint.kind != "fixed"
        if joint.name in joints or is_follower:
            limits = joints.get(joint.name)
            drawer.moving(joint, (prefix + joint.name, *ends), limits)
        else:
            drawer.fixed(*ends, joint.xyz, joint.rpy, prefix + joint.name)
    return names


def tip_of(drawer: _Names, own: DescribedGroup, names: Mapping[str, str], wished: str) -> str:
    """Return the link at the end of the chain; it is added if the description has none there."""
    node, flange = own.frames.flange
    for link in reversed(own.tree.graph.robot.links):
        at, pose = own.frames.links[link]
        if at == node and max(map(abs, frames.error(pose, flange))) < _SAME:
            return names[link]
    carrier = next(link for link in own.tree.graph.robot.links if own.frames.links[link][0] == node)
    xyz, q = frames.within(own.frames.links[carrier][1], flange)
    tip = drawer.link(wished)
    drawer.fixed(names[carrier], tip, xyz, _rpy(q))
    return tip


def chain_of(
    own: DescribedGroup, tip: str, names: Mapping[str, str]
) -> tuple[list[str], list[str]]:
    """Return the links from the root to the tip, and the joints of goals on the way."""
    by_name = {name: link for link, name in names.items()}
    moving = {joint.name for joint in own.group.joints}
    last = by_name.get(tip)
    if last is None:
        node = own.frames.flange[0]
        last = next(
            link for link in own.tree.graph.robot.links if own.frames.links[link][0] == node
        )
    path = own.tree.graph.path_to(last)
    links = [names[path[0].parent], *(names[joint.child] for joint in path)] if path else []
    if tip not in links:
        links.append(tip)
    return links, [joint.name for joint in path if joint.name in moving]


def add_shapes(
    elements: Mapping[str, ET.Element],
    own: DescribedGroup,
    names: Mapping[str, str],
    meshes: MeshFiles,
) -> Iterator[str]:
    """Add visual and collision geometry to links; yield links without own collision geometry.

    For them the visuals are used. Raises DiagnosticError RG827 for a mesh that cannot be read.
    """
    from rapidgen.collision.fitted_urdf import stl_bytes

    for link in own.tree.graph.robot.links:
        element = elements[names[link]]
        visuals = own.tree.visuals.get(link, ())
        collisions = own.tree.collisions.get(link, ())
        for visual in visuals:
            _shape(element, "visual", visual, link, meshes.copied)
        fit = own.fits.get(link)
        for number, part in enumerate(fit.parts if fit is not None else (), 1):
            geometry = ET.SubElement(ET.SubElement(element, "collision"), "geometry")
            uri = meshes.added("collision", f"{link}_{number}.stl", stl_bytes(part))
            ET.SubElement(geometry, "mesh", filename=uri)
        for shape in collisions or visuals:
            if fit is None or shape.kind != "mesh":
                _shape(element, "collision", shape, link, meshes.copied)
        if visuals and not collisions and fit is None:
            yield link


def _shape(
    element: ET.Element, tag: str, shape: Visual, link: str, copied: Callable[[str, Path], str]
) -> None:
    made = ET.SubElement(element, tag)
    ET.SubElement(made, "origin", xyz=_text(shape.xyz), rpy=_text(shape.rpy))
    geometry = ET.SubElement(made, "geometry")
    match shape.kind:
        case "box":
            ET.SubElement(geometry, "box", size=_text(shape.size))
        case "sphere":
            ET.SubElement(geometry, "sphere", radius=_text(shape.size))
        case "cylinder":
            radius, length = shape.size
            ET.SubElement(geometry, "cylinder", radius=_text([radius]), length=_text([length]))
        case "mesh":
            try:
                if shape.mesh is None:
                    raise OSError(shape.fault)
                uri = copied(tag, shape.mesh)
            except OSError as fault:
                raise refusal(
                    "RG827", None, f"mesh of {link}: {fault}", "correct the description"
                ) from None
            ET.SubElement(geometry, "mesh", filename=uri, scale=_text(shape.size))
    if tag == "visual" and shape.colour:
        material = ET.SubElement(made, "material", name=f"rgba {_text(shape.colour)}")
        ET.SubElement(material, "color", rgba=_text(shape.colour))


def at_base(pose: Sequence[float]) -> Pose:
    """Return x, y, z, roll, pitch, yaw as a pose."""
    x, y, z, roll, pitch, yaw = pose
    return (x, y, z), frames.from_rpy(roll, pitch, yaw)


def _rpy(q: frames.Quaternion) -> tuple[float, float, float]:
    yaw, pitch, roll = frames.to_zyx(q)
    return roll, pitch, yaw


def _text(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)
