"""A robot's URDF out of its chain: bars and housings, for whoever has no meshes.

The chain is what every configuration has, shipped or read from a URDF, so this always works, and
the page draws what `axes` computes with. Passive joints (a palletiser's wrist) are joints here,
too: URDF's mimic follows one joint only, ours may follow a sum.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, hypot
from xml.etree.ElementTree import Element, SubElement, tostring

from rapidgen.axes.frames import Pose
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import ChainLink, GroupConfig, Joint

BASE = "base"
_STOUT, _SLENDER = 0.058, 0.022
"""Radius of the first and the last bar, as a share of the arm's length."""
_LONGEST = 60.0
"""m: a rail that is longer is none."""
_SHORTEST = 0.05
"""m: the length of an arm without lengths."""
ENDLESS = {"lower": "-1000000", "upper": "1000000", "effort": "0", "velocity": "0"}
Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Drawing:
    """A URDF, its movable joints and the link that carries tools."""

    urdf: str
    movable: tuple[str, ...]
    """The group's joints in wire order, then the passive ones."""
    flange: str
    passive: tuple[tuple[tuple[int, float], ...], ...]
    """Of each passive joint: places and factors of the joints that it follows the sum of."""
    base: Pose | None = None
    """Where its base stands among what else is drawn; None: nothing tells."""

    def values(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Values of `movable` (rad, m) for those of the group's joints."""
        return (*urdf, *(sum(urdf[i] * k for i, k in terms) for terms in self.passive))


def described(group: GroupConfig) -> Drawing:
    """The description of a group; without geometry there is only its base."""
    names = JointMap.of(group).names
    slides = {joint.name for joint in group.joints if joint.kind == "prismatic"}
    robot = Element("robot", name=group.name)
    link = SubElement(robot, "link", name=BASE)
    passive: dict[str, tuple[tuple[int, float], ...]] = {}
    radii = _radii(group.chain)
    _cylinder(link, "housing", radii[0] * 1.9, radii[0] * 0.3, (0.0, 0.0, radii[0] * 0.15))
    flange = BASE
    for i, step in enumerate(group.chain):
        _bar(link, step.xyz, radii[i])
        if step.joint in slides:
            _rail(link, step, next(j for j in group.joints if j.name == step.joint), radii[i])
        parent, flange = flange, f"link_{i + 1}"
        kind = "fixed"
        name = step.joint or f"fixed_{i + 1}"
        if step.joint:
            kind = "prismatic" if step.joint in slides else "continuous"
        elif step.follows:
            kind, name = "continuous", f"passive_{i + 1}"
            passive[name] = tuple((names.index(joint), k) for joint, k in step.follows)
        joint = SubElement(robot, "joint", name=name, type=kind)
        SubElement(joint, "origin", xyz=text(step.xyz), rpy=text(step.rpy))
        SubElement(joint, "parent", link=parent)
        SubElement(joint, "child", link=flange)
        link = SubElement(robot, "link", name=flange)
        if kind != "fixed":
            SubElement(joint, "axis", xyz=text(step.axis))
            # What bounds it is said by its controller axis.
            SubElement(joint, "limit", ENDLESS)
        if kind == "continuous":
            _cylinder(link, "housing", radii[i] * 1.3, radii[i] * 2.5, along=step.axis)
    return Drawing(tostring(robot, "unicode"), (*names, *passive), flange, (*passive.values(),))


def _radii(chain: Sequence[ChainLink]) -> list[float]:
    """Of the bar to each step, stout at the base and slender at the flange."""
    lengths = [hypot(*step.xyz) for step in chain]
    whole = max(_SHORTEST, sum(lengths))
    found, done = [], 0.0
    for length in lengths or [0.0]:
        share = done / whole
        found.append(whole * (_STOUT + (_SLENDER - _STOUT) * share))
        done += length
    return found


def _bar(link: Element, to: Vector, radius: float) -> None:
    length = hypot(*to)
    if length > radius / 2:
        middle = (to[0] / 2, to[1] / 2, to[2] / 2)
        _cylinder(link, "body", radius, length, middle, to)


def _rail(link: Element, step: ChainLink, joint: Joint, radius: float) -> None:
    """What a carriage slides on, from limit to limit."""
    ends = [joint.sign * (value - joint.offset) for value in (joint.lower, joint.upper)]
    length = abs(ends[1] - ends[0])
    if not any(step.rpy) and length < _LONGEST:
        x, y, z = (at + a * sum(ends) / 2 for at, a in zip(step.xyz, step.axis, strict=True))
        _cylinder(link, "housing", radius * 0.5, length + 2 * radius, (x, y, z), step.axis)


def _cylinder(
    link: Element,
    material: str,
    radius: float,
    length: float,
    middle: Vector = (0.0, 0.0, 0.0),
    along: Vector = (0.0, 0.0, 1.0),
) -> None:
    """A cylinder around a line; URDF's own stand along z."""
    pitch, yaw = atan2(hypot(along[0], along[1]), along[2]), atan2(along[1], along[0])
    visual = SubElement(link, "visual")
    SubElement(visual, "origin", xyz=text(middle), rpy=text((0.0, pitch, yaw)))
    shape = SubElement(visual, "geometry")
    SubElement(shape, "cylinder", radius=f"{radius:.6g}", length=f"{length:.6g}")
    SubElement(visual, "material", name=material)


def text(vector: Sequence[float]) -> str:
    """Numbers as an attribute has them."""
    return " ".join(map(repr, vector))
