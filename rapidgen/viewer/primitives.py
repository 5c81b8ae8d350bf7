"""Solids of a robot without meshes: columns, beams, joints, foot, plate.

An arm's lengths are known, its castings are not. A link is a column along the axis of its joint and
a beam across it, as arms are built; thicknesses are shares of the arm's length.
"""

from collections.abc import Sequence
from math import hypot
from xml.etree.ElementTree import Element, SubElement

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector

_ALONG_Z: Vector = (0.0, 0.0, 1.0)


def foot(link: Element, radius: float, top: Vector) -> None:
    """Foot on the floor under a first axis at `top`: plate, steps, column."""
    x, y, height = top
    size = radius * 3.4
    box(link, "housing", (size, size, radius * 0.35), (x, y, radius * 0.175), frames.UNIT)
    for share, tall in ((1.55, 0.9), (1.3, 1.5), (1.0, height / radius)):
        upper = min(radius * tall, height)
        if upper > radius * 0.35:
            cylinder(link, "body", radius * share, upper, (x, y, upper / 2), _ALONG_Z)


def joint(link: Element, radius: float, axis: Vector, middle: Vector = frames.ORIGIN) -> None:
    """A joint's housing about its axis, with a cap at each end."""
    cylinder(link, "housing", radius * 1.25, radius * 2.3, middle, axis)
    cylinder(link, "body", radius * 0.85, radius * 2.6, middle, axis)


def limb(link: Element, axis: Vector, to: Vector, radius: float, thin: float) -> None:
    """Limb from a joint about `axis` to the next one.

    `thin` is the radius there.
    """
    share = sum(a * v for a, v in zip(axis, to, strict=True))
    along = frames.scale(axis, share)
    across = frames.add(to, frames.scale(along, -1.0))
    if abs(share) > radius / 4:
        cylinder(link, "body", radius, abs(share), frames.scale(along, 0.5), along)
    length = hypot(*across)
    if length > radius / 4:
        turned = standing(across, axis)
        middle = frames.add(along, frames.scale(across, 0.5))
        thick = (radius + thin) / 2
        box(link, "body", (thick * 1.7, thick * 1.45, length), middle, turned)


def plate(link: Element, radius: float, along: Vector = _ALONG_Z) -> None:
    """The flange, or a positioner's plate: a disc that ends at the frame."""
    thick = radius * 0.35
    cylinder(link, "housing", radius, thick, frames.scale(along, -thick / 2), along)


def box(
    link: Element, material: str, size: Sequence[float], middle: Vector, turned: frames.Quaternion
) -> None:
    """A box around a point."""
    shape = _visual(link, "box", material, middle, turned)
    shape.set("size", text(size))


def cylinder(
    link: Element,
    material: str,
    radius: float,
    length: float,
    middle: Vector = frames.ORIGIN,
    along: Vector = _ALONG_Z,
) -> None:
    """A cylinder around a line; URDF's own are along z."""
    shape = _visual(link, "cylinder", material, middle, standing(along, (0.0, 1.0, 0.0)))
    shape.set("radius", f"{radius:.6g}")
    shape.set("length", f"{length:.6g}")


def _visual(
    link: Element, kind: str, material: str, middle: Vector, turned: frames.Quaternion
) -> Element:
    visual = SubElement(link, "visual")
    z, y, x = frames.to_zyx(turned)
    SubElement(visual, "origin", xyz=text(middle), rpy=text((x, y, z)))
    shape = SubElement(SubElement(visual, "geometry"), kind)
    SubElement(visual, "material", name=material)
    return shape


def standing(along: Vector, side: Vector) -> frames.Quaternion:
    """Rotate z to a line, and y as near to `side` as possible."""
    size = hypot(*along) or 1.0
    z = frames.scale(along, 1 / size)
    for hint in (side, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)):
        x = _cross(hint, z)
        if hypot(*x) > 1e-3:
            break
    x = frames.scale(x, 1 / hypot(*x))
    y = _cross(z, x)
    return frames.from_matrix(((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])))


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def text(vector: Sequence[float]) -> str:
    """Numbers as an attribute has them."""
    return " ".join(map(repr, vector))
