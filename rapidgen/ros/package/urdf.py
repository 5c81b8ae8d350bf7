"""URDF of a configuration, with the joint names of goals.

joint_states has the same names. It is the configuration's description, if that has one. Otherwise
links are cylinders along the chain: enough to see it move, and not empty for planning, but not the
robot's shape.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from math import acos, atan2, sqrt
from xml.etree import ElementTree as ET

from rapidgen.config.model import ChainLink, GroupConfig, Joint, RobotConfig
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.ros.package.description import (
    DescribedGroup,
    MeshFiles,
    add_shapes,
    at_base,
    chain_of,
    draw_tree,
    tip_of,
)

ROOT = "world"
_EFFORT = "1000"
"""N m, N: URDF requires a value, and the controller does not report it."""
_THICKNESS = 0.12
"""Radius of a drawn link, as a share of its length."""


@dataclass(frozen=True, slots=True)
class PlacedRobot:
    """A robot of a drawing: prefix of its names, and its base in the world."""

    config: RobotConfig
    prefix: str = ""
    at: tuple[float, ...] = (0.0,) * 6
    """x, y, z in m; roll, pitch, yaw in rad."""
    described: Mapping[str, DescribedGroup] = field(default_factory=dict)
    """By group; the others are drawn along their chains."""


@dataclass(frozen=True, slots=True)
class LinkChain:
    """A chain of links from the root.

    It is that of an arm (with its tool0) or of a positioner.
    """

    links: tuple[str, ...]
    joints: tuple[str, ...]
    """Joints of goals, from the root on."""

    @property
    def tip(self) -> str:
        """The last link."""
        return self.links[-1]


@dataclass(frozen=True, slots=True)
class UrdfDrawing:
    """A URDF and data for its users."""

    root: ET.Element
    arms: dict[str, LinkChain]
    """By motion group, with its robot's prefix."""
    names: dict[str, Mapping[str, str]] = field(default_factory=dict)
    """By motion group with a description: links of the URDF by the description's names."""
    without_collision: tuple[str, ...] = ()
    """Links of descriptions that have visuals only, which are used for collisions as well."""

    @property
    def text(self) -> str:
        """Text of the file."""
        ET.indent(self.root)
        return ET.tostring(self.root, encoding="unicode", xml_declaration=True) + "\n"

    @property
    def adjacent(self) -> Iterator[tuple[str, str]]:
        """Links that a joint connects."""
        for joint in self.root.iter("joint"):
            parent, child = joint.find("parent"), joint.find("child")
            assert parent is not None
            assert child is not None
            yield parent.attrib["link"], child.attrib["link"]


def draw(config: RobotConfig, name: str) -> UrdfDrawing:
    """The URDF of all groups of a configuration, in m and rad."""
    return draw_cell([PlacedRobot(config)], name)


def draw_cell(
    robots: Sequence[PlacedRobot], name: str, meshes: MeshFiles | None = None
) -> UrdfDrawing:
    """Return the URDF of several robots in one world.

    `meshes` gets the meshes of descriptions. Raises DiagnosticError RG827 for one that is missing.
    """
    root = ET.Element("robot", name=name)
    ET.SubElement(root, "link", name=ROOT)
    meshes = meshes or MeshFiles(name)
    arms: dict[str, LinkChain] = {}
    names: dict[str, Mapping[str, str]] = {}
    visual_only: list[str] = []
    for robot in robots:
        several = len(robot.config.groups) > 1
        joints = {joint.name: joint for group in robot.config.groups for joint in group.joints}
        drawer = _Drawer(root, joints, robot.prefix, robot.at)
        trees: list[tuple[DescribedGroup, dict[str, str]]] = []
        for group in robot.config.groups:
            key = robot.prefix + group.name
            prefix = robot.prefix + (f"{group.name}_" if several else "")
            own = robot.described.get(group.name)
            if own is None:
                arms[key] = _along_chain(drawer, group, prefix)
                continue
            # Arms in one description share its links.
            drawn = next(
                (one for known, one in trees if known.tree.graph.robot == own.tree.graph.robot),
                None,
            )
            if drawn is None:
                drawn = draw_tree(drawer, own, joints, robot.prefix, (ROOT, at_base(robot.at)))
                elements = {element.attrib["name"]: element for element in root.iter("link")}
                visual_only += add_shapes(elements, own, drawn, meshes)
                trees.append((own, drawn))
            names[key] = drawn
            tip = tip_of(drawer, own, drawn, f"{prefix}tool0")
            links, moving = chain_of(own, tip, drawn)
            arms[key] = LinkChain(tuple(links), tuple(robot.prefix + one for one in moving))
    return UrdfDrawing(root, arms, names, tuple(visual_only))


def _along_chain(drawer: "_Drawer", group: GroupConfig, prefix: str) -> LinkChain:
    arm = drawer.branch(f"{prefix}base_link", group.chain, f"{prefix}tool0")
    for unit in group.positioners:
        drawer.branch(f"{prefix}{unit.unit}_base", unit.chain, f"{prefix}{unit.unit}_table")
    return arm


def urdf_range(joint: Joint) -> tuple[float, float]:
    """Return limits of a joint in URDF's sense, rad or m.

    For a coupled one axis 2 is at 0.
    """
    ends = sorted((value - joint.offset) * joint.sign for value in (joint.lower, joint.upper))
    return ends[0], ends[1]


@dataclass(frozen=True, slots=True)
class _Drawer:
    root: ET.Element
    joints: dict[str, Joint]
    prefix: str
    at: Sequence[float]
    """The robot's base in the world: x, y, z in m; roll, pitch, yaw in rad."""

    def branch(self, base: str, chain: Sequence[ChainLink], tip: str) -> LinkChain:
        base = self.link(base)
        self.fixed(ROOT, base, self.at[:3], self.at[3:])
        links, joints = [base], []
        for number, step in enumerate(chain, 1):
            end = tip if number == len(chain) and not (step.joint or step.follows) else ""
            if step.joint:
                joints.append(self.prefix + step.joint)
            links += self._step(links[-1], step, end or f"{base}_{number}")
        if links[-1] != tip:
            tip = self.link(tip)
            self.fixed(links[-1], tip, (0, 0, 0), (0, 0, 0))
            links.append(tip)
        return LinkChain(tuple(links), tuple(joints))

    def _step(self, parent: str, step: ChainLink, child: str) -> list[str]:
        """Add links after `parent`, drawn as a bar to the next joint."""
        self._bar(parent, step.xyz)
        if step.joint:
            name, joint = self.prefix + step.joint, self.joints[step.joint]
            child = self.link(f"{name}_link")
            element = self._joint(name, joint.kind, parent, child, step.xyz, step.rpy, step.axis)
            _limit(element, joint)
            return [child]
        if not step.follows:
            child = self.link(child)
            self.fixed(parent, child, step.xyz, step.rpy)
            return [child]
        # A passive joint may follow several: one mimicking joint for each, about the same axis.
        made: list[str] = []
        xyz, rpy = step.xyz, step.rpy
        for number, (followed, factor) in enumerate(step.follows, 1):
            link = self.link(f"{child}_{number}")
            at = made[-1] if made else parent
            name = self._free("joint", f"{link}_joint")
            element = self._joint(name, "continuous", at, link, xyz, rpy, step.axis)
            ET.SubElement(
                element, "mimic", joint=self.prefix + followed, multiplier=_number(factor)
            )
            made.append(link)
            xyz = rpy = (0.0, 0.0, 0.0)
        return made

    def link(self, wished: str) -> str:
        """Add a link and return its name."""
        name = self._free("link", wished)
        ET.SubElement(self.root, "link", name=name)
        return name

    def fixed(
        self, parent: str, child: str, xyz: Sequence[float], rpy: Sequence[float], name: str = ""
    ) -> None:
        """Add a fixed joint."""
        name = self._free("joint", name or f"{child}_joint")
        self._joint(name, "fixed", parent, child, xyz, rpy)

    def moving(self, joint: UrdfJoint, names: tuple[str, str, str], limits: Joint | None) -> None:
        """Add a joint of a description: its name, parent and child; without limits it mimics."""
        name, parent, child = names
        slides = joint.kind == "prismatic"
        # A prismatic joint needs limits; those of what it follows are the ones that matter.
        kind = limits.kind if limits is not None else "prismatic" if slides else "continuous"
        element = self._joint(name, kind, parent, child, joint.xyz, joint.rpy, joint.axis)
        if limits is not None:
            _limit(element, limits)
            return
        if slides:
            far = {"lower": "-10", "upper": "10", "velocity": "10", "effort": _EFFORT}
            ET.SubElement(element, "limit", far)
        ET.SubElement(
            element,
            "mimic",
            joint=self.prefix + joint.mimic,
            multiplier=_number(joint.multiplier),
        )

    def _free(self, tag: str, wished: str) -> str:
        """Return an unused name: the robot's own joints may have any name."""
        in_use = {element.get("name") for element in self.root.iter(tag)}
        if tag == "joint":
            in_use |= {self.prefix + joint for joint in self.joints}
        name, numbers = wished, count(2)
        while name in in_use:
            name = f"{wished}_{next(numbers)}"
        return name

    def _joint(
        self,
        name: str,
        kind: str,
        parent: str,
        child: str,
        xyz: Sequence[float],
        rpy: Sequence[float],
        axis: Sequence[float] | None = None,
    ) -> ET.Element:
        element = ET.SubElement(self.root, "joint", name=name, type=kind)
        ET.SubElement(element, "parent", link=parent)
        ET.SubElement(element, "child", link=child)
        ET.SubElement(element, "origin", xyz=_numbers(xyz), rpy=_numbers(rpy))
        if axis is not None:
            ET.SubElement(element, "axis", xyz=_numbers(axis))
        return element

    def _bar(self, link: str, to: Sequence[float]) -> None:
        x, y, z = to
        length = sqrt(x * x + y * y + z * z)
        if length < 0.02:
            return
        element = next(e for e in self.root.iter("link") if e.get("name") == link)
        rpy = (0.0, acos(z / length), atan2(y, x))
        for what in ("visual", "collision"):
            shape = ET.SubElement(element, what)
            ET.SubElement(shape, "origin", xyz=_numbers([c / 2 for c in to]), rpy=_numbers(rpy))
            geometry = ET.SubElement(shape, "geometry")
            radius = _number(min(length * _THICKNESS, 0.12))
            ET.SubElement(geometry, "cylinder", radius=radius, length=_number(length))


def _limit(element: ET.Element, joint: Joint) -> None:
    lower, upper = urdf_range(joint)
    ET.SubElement(
        element,
        "limit",
        lower=_number(lower),
        upper=_number(upper),
        velocity=_number(joint.speed),
        effort=_EFFORT,
    )


def _number(value: float) -> str:
    return f"{value:.9g}"


def _numbers(values: Sequence[float]) -> str:
    return " ".join(_number(value) for value in values)
