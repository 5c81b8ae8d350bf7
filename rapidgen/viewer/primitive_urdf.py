"""A robot's URDF of solids, from its chain, without meshes.

Every configuration has a chain, shipped or read from a URDF, so this always works, and the page
draws what `axes` computes with. Passive joints (a palletiser's wrist) are joints here too: URDF's
mimic follows one joint only, ours may follow a sum.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot
from xml.etree.ElementTree import Element, SubElement, tostring

from rapidgen.axes.frames import ORIGIN, Pose, add, scale
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import ChainLink, GroupConfig, Joint
from rapidgen.viewer import primitives
from rapidgen.viewer.arm_solids import AXES, arm_of, balancer, dress
from rapidgen.viewer.primitives import text

BASE = "base"
_STOUT, _SLENDER = 0.058, 0.022
"""Radius of the first and the last limb, as a share of the arm's length."""
_LONGEST = 60.0
"""m: a rail that is longer is not drawn."""
_SHORTEST = 0.05
"""m: the length of an arm without lengths."""
_UP = (0.0, 0.0, 1.0)
ENDLESS = {"lower": "-1000000", "upper": "1000000", "effort": "0", "velocity": "0"}


@dataclass(frozen=True, slots=True)
class Drawing:
    """A URDF, its movable joints and the link that carries tools."""

    urdf: str
    movable: tuple[str, ...]
    """The group's joints in wire order, then the passive ones."""
    flange: str
    passive: tuple[tuple[tuple[int, float], ...], ...]
    """For each passive joint: indices and factors of the sum it follows."""
    base: Pose | None = None
    """Pose of its base among other drawings; None if unknown."""

    def values(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Return values of `movable` (rad, m) for the group's joints."""
        return (*urdf, *(sum(urdf[i] * k for i, k in terms) for terms in self.passive))


def described(group: GroupConfig) -> Drawing:
    """Return the description of a group; only the base without geometry.

    Links of the arm are `link_1` and so on, one for each step of the chain; those of its
    positioners have the unit's number as a prefix.
    """
    robot = Element("robot", name=group.name)
    base = SubElement(robot, "link", name=BASE)
    radii = _radii(group.chain)
    if not group.chain:
        primitives.foot(base, radii[0], ORIGIN)
    passive: dict[str, tuple[tuple[int, float], ...]] = {}
    arm = arm_of(group)
    bare = range(arm.first, arm.first + len(AXES)) if arm is not None else range(0)
    links = _branch(robot, base, group, group.chain, radii, "link_", passive, bare)
    flange = links[-1]
    if arm is None:
        primitives.plate(flange, radii[-1] * 1.1)
    else:
        own = links[arm.first : arm.first + len(AXES) + 1]
        dress(arm, own)
        second = group.chain[arm.first + 1].joint
        index = JointMap.of(group).names.index(second)
        passive |= balancer(robot, arm, own[1], own[2], index)
    for i, positioner in enumerate(group.positioners):
        # Its support is no larger than the arm's own foot, its plate is.
        wide = [radii[0] * 1.2] * len(positioner.chain)
        prefix = f"unit_{i + 1}_"
        made = _branch(robot, base, group, positioner.chain, wide, prefix, passive, range(0))
        primitives.plate(made[-1], radii[0] * 3.0)
    movable = (*JointMap.of(group).names, *passive)
    return Drawing(
        tostring(robot, "unicode"), movable, flange.get("name", BASE), (*passive.values(),)
    )


def _branch(
    robot: Element,
    link: Element,
    group: GroupConfig,
    chain: Sequence[ChainLink],
    radii: Sequence[float],
    prefix: str,
    passive: dict[str, tuple[tuple[int, float], ...]],
    bare: range,
) -> list[Element]:
    """Draw a chain from its base; return the base and its links.

    Passive joints are added to `passive`. Steps in `bare` get no solids.
    """
    links = [link]
    names = JointMap.of(group).names
    axis = _UP
    stands = True
    for i, step in enumerate(chain):
        thin = radii[min(i + 1, len(radii) - 1)]
        slide = next(
            (j for j in group.joints if _slides(group, step) and j.name == step.joint), None
        )
        if i in bare:
            stands = False
        elif slide is not None and stands:
            _rail(link, step, slide, radii[i])
        elif stands:
            # A stationary robot has its foot below its first axis.
            primitives.foot(link, radii[i], step.xyz)
            stands = False
        else:
            primitives.limb(link, axis, step.xyz, radii[i], thin)
        name, kind = step.joint or f"fixed_{prefix}{i + 1}", "fixed"
        if step.joint:
            kind = "prismatic" if _slides(group, step) else "continuous"
        elif step.follows:
            kind, name = "continuous", f"passive_{prefix}{i + 1}"
            passive[name] = tuple((names.index(joint), k) for joint, k in step.follows)
        joint = SubElement(robot, "joint", name=name, type=kind)
        SubElement(joint, "origin", xyz=text(step.xyz), rpy=text(step.rpy))
        SubElement(joint, "parent", link=link.get("name", ""))
        link = SubElement(robot, "link", name=f"{prefix}{i + 1}")
        links.append(link)
        SubElement(joint, "child", link=f"{prefix}{i + 1}")
        if kind != "fixed":
            SubElement(joint, "axis", xyz=text(step.axis))
            # Its controller axis has the limits.
            SubElement(joint, "limit", ENDLESS)
        if kind == "continuous" and i not in bare:
            axis = step.axis
            low = i == 0 and step.xyz[2] < radii[i] and axis == _UP
            primitives.joint(link, radii[i], axis, scale(_UP, radii[i] * 1.3) if low else ORIGIN)
        elif slide is not None and not stands:
            _quill(link, step, slide, radii[i])
    return links


def _slides(group: GroupConfig, step: ChainLink) -> bool:
    return any(j.name == step.joint and j.kind == "prismatic" for j in group.joints)


def _radii(chain: Sequence[ChainLink]) -> list[float]:
    """Radii of the links, thick at the base and thin at the flange."""
    lengths = [hypot(*step.xyz) for step in chain]
    complete = max(_SHORTEST, sum(lengths))
    result, done = [], 0.0
    for length in lengths or [0.0]:
        share = done / complete
        result.append(complete * (_STOUT + (_SLENDER - _STOUT) * share))
        done += length
    return result


def _quill(link: Element, step: ChainLink, joint: Joint, radius: float) -> None:
    """Rod of a sliding axis of an arm, as long as its range.

    Its end protrudes.
    """
    first, last = _ends(joint)
    length = abs(last - first)
    if length < _LONGEST:
        back = scale(step.axis, -length / 2 if first + last > 0 else length / 2)
        primitives.cylinder(link, "body", radius * 0.35, length, back, step.axis)


def _rail(link: Element, step: ChainLink, joint: Joint, radius: float) -> None:
    """Rail of a carriage, from limit to limit."""
    first, last = _ends(joint)
    length = abs(last - first)
    if not any(step.rpy) and length < _LONGEST:
        middle = scale(step.axis, (first + last) / 2)
        turned = primitives.standing(step.axis, (0.0, 1.0, 0.0))
        size = (radius * 0.8, radius * 3.2, length + 4 * radius)
        primitives.box(link, "housing", size, add(step.xyz, middle), turned)


def _ends(joint: Joint) -> tuple[float, float]:
    """Limits in the sense of the URDF, m."""
    return joint.sign * (joint.lower - joint.offset), joint.sign * (joint.upper - joint.offset)
