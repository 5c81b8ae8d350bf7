"""Solids of an articulated arm with six axes: base, turntable, arms, motors, wrist, balancer.

Lengths come from the kinematic chain; thicknesses are shares of the arm's length, chosen to look
like machines of this kind. No shape is taken from a manufacturer's mesh. Collision checks never use
these solids.

The parts turn as those of real arms do: the forearm's tube with axis 4, the motors of axes 4 to 6
with axis 3. The gas spring or piston of heavy robots follows axis 2, linearly, as ROS packages
describe it with `mimic`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, cos, hypot, sin
from xml.etree.ElementTree import Element, SubElement

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.config.model import ChainLink, GroupConfig
from rapidgen.viewer.primitives import box, cylinder, standing, text

AXES: tuple[Vector, ...] = (
    (0.0, 0.0, 1.0),
    (0.0, 1.0, 0.0),
    (0.0, 1.0, 0.0),
    (1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (1.0, 0.0, 0.0),
)
"""Axes of the joints at the zero position."""
_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_HEAVY = 100.0
"""kg of payload from which an arm has a balancer."""
_BODY, _DARK = "body", "housing"


@dataclass(frozen=True, slots=True)
class Arm:
    """Measures of an arm at its zero position, m. The base is at the origin, x is forward."""

    first: int
    """Index of its first joint in the chain."""
    turntable: float
    """Height of the first joint's frame."""
    shoulder: tuple[float, float]
    """x and z of axis 2."""
    upper: float
    """From axis 2 to axis 3, upwards."""
    forearm: tuple[float, float]
    """x and z from axis 3 to the wrist."""
    wrist: tuple[float, float]
    """x and z from axis 5 to the flange."""
    is_heavy: bool

    @property
    def width(self) -> float:
        """Return the radius of the shoulder, to which others are relative."""
        return 0.095 * (self.upper + self.forearm[0])


def arm_of(group: GroupConfig) -> Arm | None:
    """Return the measures of an arm with the common order of axes; None for others."""
    chain = group.chain
    first = next((i for i, step in enumerate(chain) if step.joint and step.axis == _Z), None)
    steps = chain[first : first + 6] if first is not None else ()
    if first is None or len(steps) < 6 or not all(map(_fits, steps, AXES)):
        return None
    (tx, _, tz), (sx, _, sz), (ux, _, upper), (fx, _, fz), wrist, (wx, _, wz) = (
        step.xyz for step in steps
    )
    if any(step.xyz[1] for step in steps) or any(wrist) or tx or ux:
        return None
    if upper <= 0 or fx <= 0 or tz + sz <= 0:
        return None
    measures = ((sx, tz + sz), upper, (fx, fz), (wx, wz))
    return Arm(first, tz, *measures, group.max_payload >= _HEAVY)


def _fits(step: ChainLink, axis: Vector) -> bool:
    return bool(step.joint) and step.axis == axis and not any(step.rpy)


def dress(arm: Arm, links: Sequence[Element]) -> None:
    """Add the solids of an arm to its base and the six links that its joints move."""
    base, turning, upper, fore, tube, wrist, flange = links
    _base(base, arm)
    _turntable(turning, arm)
    _upper_arm(upper, arm)
    _elbow(fore, arm)
    _tube(tube, arm)
    _wrist(wrist, arm)
    w = arm.width
    cylinder(flange, _DARK, 0.36 * w, 0.2 * w, (-0.1 * w, 0.0, 0.0), _X)


def _block(link: Element, material: str, low: Vector, high: Vector) -> None:
    """Add a box from corner to corner."""
    size = tuple(abs(b - a) for a, b in zip(low, high, strict=True))
    box(link, material, size, frames.scale(frames.add(low, high), 0.5), frames.UNIT)


def _rod(link: Element, material: str, radius: float, start: Vector, end: Vector) -> None:
    """Add a cylinder from point to point."""
    way = frames.add(end, frames.scale(start, -1.0))
    middle = frames.scale(frames.add(start, end), 0.5)
    cylinder(link, material, radius, hypot(*way), middle, way)


def _base(link: Element, arm: Arm) -> None:
    w, top = arm.width, 0.42 * arm.shoulder[1]
    side, plate = 1.75 * w, min(0.35 * w, 0.5 * top)
    _block(link, _DARK, (-side, -side, 0.0), (side, side, plate))
    _rod(link, _BODY, 1.55 * w, (0.0, 0.0, plate), (0.0, 0.0, 0.55 * top))
    _rod(link, _BODY, 1.3 * w, (0.0, 0.0, 0.55 * top), (0.0, 0.0, top))
    # Connectors of power and signals at the back.
    _block(link, _DARK, (-2.0 * w, -0.7 * w, plate), (-1.3 * w, 0.7 * w, min(1.5 * w, 0.9 * top)))


def _turntable(link: Element, arm: Arm) -> None:
    w, (x, z) = arm.width, arm.shoulder
    z -= arm.turntable
    low = 0.42 * arm.shoulder[1] - arm.turntable
    _rod(link, _DARK, 1.4 * w, (0.0, 0.0, low), (0.0, 0.0, low + 0.28 * w))
    _rod(link, _BODY, 1.3 * w, (0.0, 0.0, low + 0.28 * w), (0.0, 0.0, max(low + 0.5 * w, z - w)))
    # Two cheeks carry the upper arm; a beam leads to them.
    for side in (-1.0, 1.0):
        inner, outer = side * 0.72 * w, side * 1.12 * w
        _rod(link, _BODY, 1.05 * w, (x, inner, z), (x, outer, z))
        start, end = (0.3 * x, low + 0.3 * w), (x, z)
        way = (end[0] - start[0], 0.0, end[1] - start[1])
        middle = ((start[0] + end[0]) / 2, (inner + outer) / 2, (start[1] + end[1]) / 2)
        box(link, _BODY, (1.9 * w, 0.4 * w, hypot(*way)), middle, standing(way, _Y))
    _rod(link, _DARK, 0.55 * w, (x, 1.12 * w, z), (x, 1.95 * w, z))
    # Motor of axis 1, upright behind the shoulder.
    behind = min(x - 1.55 * w, -0.75 * w)
    _rod(link, _DARK, 0.42 * w, (behind, 0.5 * w, low + 0.28 * w), (behind, 0.5 * w, z + 0.1 * w))


def _upper_arm(link: Element, arm: Arm) -> None:
    w, top = arm.width, arm.upper
    _rod(link, _DARK, 0.92 * w, (0.0, -0.7 * w, 0.0), (0.0, 0.7 * w, 0.0))
    _block(link, _BODY, (-0.72 * w, -0.55 * w, 0.0), (0.72 * w, 0.55 * w, 0.5 * top))
    _block(link, _BODY, (-0.56 * w, -0.5 * w, 0.5 * top), (0.56 * w, 0.5 * w, top))
    _rod(link, _DARK, 0.72 * w, (0.0, -0.6 * w, top), (0.0, 0.6 * w, top))


def _elbow(link: Element, arm: Arm) -> None:
    w, (length, height) = arm.width, arm.forearm
    for side in (-1.0, 1.0):
        inner, outer = side * 0.62 * w, side * 0.95 * w
        _rod(link, _BODY, 0.8 * w, (0.0, inner, 0.0), (0.0, outer, 0.0))
        low, high = min(inner, outer), max(inner, outer)
        _block(link, _BODY, (-0.7 * w, low, 0.0), (0.8 * w, high, height + 0.3 * w))
    _rod(link, _DARK, 0.42 * w, (0.0, -0.95 * w, 0.0), (0.0, -1.6 * w, 0.0))
    # The housing of the wrist's gears, with the motors of axes 4, 5 and 6 at its back.
    floor = max(height - 0.75 * w, 0.45 * w)
    top = max(height + 0.8 * w, floor + w)
    front = max(0.24 * length, w)
    _block(link, _BODY, (-0.95 * w, -0.95 * w, floor), (0.6 * w, 0.95 * w, top))
    _rod(link, _BODY, 0.72 * w, (0.5 * w, 0.0, height), (front, 0.0, height))
    _rod(link, _DARK, 0.76 * w, (front, 0.0, height), (front + 0.2 * w, 0.0, height))
    middle = (floor + top) / 2
    for y, z in (
        (0.0, middle + 0.4 * w),
        (0.45 * w, middle - 0.3 * w),
        (-0.45 * w, middle - 0.3 * w),
    ):
        _rod(link, _DARK, 0.33 * w, (-0.9 * w, y, z), (-1.75 * w, y, z))


def _tube(link: Element, arm: Arm) -> None:
    """The forearm's tube, behind the wrist: it turns with axis 4."""
    w, length = arm.width, arm.forearm[0]
    back = max(0.24 * length, w) + 0.2 * w - length
    fork = -0.75 * w
    _rod(link, _BODY, 0.6 * w, (back, 0.0, 0.0), (0.55 * back, 0.0, 0.0))
    _rod(link, _BODY, 0.5 * w, (0.55 * back, 0.0, 0.0), (fork, 0.0, 0.0))
    _rod(link, _BODY, 0.56 * w, (fork - 0.12 * w, 0.0, 0.0), (fork + 0.15 * w, 0.0, 0.0))
    for side in (-1.0, 1.0):
        low, high = sorted((side * 0.36 * w, side * 0.56 * w))
        _block(link, _BODY, (fork, low, -0.36 * w), (0.0, high, 0.36 * w))
        # A little thicker than the fork: surfaces in one plane would flicker.
        _rod(link, _DARK, 0.4 * w, (0.0, low - 0.02 * w, 0.0), (0.0, high + 0.02 * w, 0.0))


def _wrist(link: Element, arm: Arm) -> None:
    w, (x, z) = arm.width, arm.wrist
    _rod(link, _DARK, 0.38 * w, (0.0, -0.35 * w, 0.0), (0.0, 0.35 * w, 0.0))
    end = x - 0.2 * w
    if z:
        # An offset wrist: axis 6 is beside axis 4.
        _block(link, _BODY, (-0.3 * w, -0.33 * w, 0.0), (0.3 * w, 0.33 * w, z))
        _rod(link, _BODY, 0.42 * w, (-0.35 * w, 0.0, z), (max(end, 0.1 * w), 0.0, z))
    elif end > 0.05 * w:
        _rod(link, _BODY, 0.33 * w, (0.0, 0.0, 0.0), (end, 0.0, 0.0))


def balancer(
    robot: Element, arm: Arm, turning: Element, upper: Element, index: int
) -> dict[str, tuple[tuple[int, float], ...]]:
    """Add the balancer of a heavy arm; return its passive joints and what they follow.

    `index` is the place of axis 2 among the values of the joints.
    """
    if not arm.is_heavy:
        return {}
    w, (x, z) = arm.width, arm.shoulder
    behind, below = -3.1 * w, 0.35 * w
    eye = (-0.95 * w, 0.55 * w)
    """Of the rod, in the upper arm's frame."""

    def angle(turn: float) -> float:
        """Return the angle of the balancer about y for an angle of axis 2."""
        ex = eye[0] * cos(turn) + eye[1] * sin(turn)
        ez = -eye[0] * sin(turn) + eye[1] * cos(turn)
        return atan2(-(ez - below), ex - behind)

    slope = angle(0.5) - angle(-0.5)
    start = angle(0.0)
    length = hypot(eye[0] - behind, eye[1] - below)
    anchor = (x + behind, 0.0, z - arm.turntable + below)
    case = _hung(robot, turning, "balancer_cylinder", anchor, start)
    _rod(case, _DARK, 0.42 * w, (-0.5 * w, 0.0, 0.0), (0.72 * length, 0.0, 0.0))
    rod = _hung(robot, upper, "balancer_rod", (eye[0], 0.0, eye[1]), start)
    _rod(rod, _BODY, 0.16 * w, (-0.5 * length, 0.0, 0.0), (0.1 * w, 0.0, 0.0))
    return {
        "passive_balancer_cylinder": ((index, slope),),
        "passive_balancer_rod": ((index, slope - 1.0),),
    }


def _hung(robot: Element, parent: Element, name: str, at: Vector, angle: float) -> Element:
    """Add a link that turns about y in its parent."""
    joint = SubElement(robot, "joint", name=f"passive_{name}", type="continuous")
    SubElement(joint, "origin", xyz=text(at), rpy=text((0.0, angle, 0.0)))
    SubElement(joint, "parent", link=parent.get("name", ""))
    SubElement(joint, "child", link=name)
    SubElement(joint, "axis", xyz=text(_Y))
    return SubElement(robot, "link", name=name)
