"""Read URDF text with yourdfpy, after our own checks.

Meshes are off. yourdfpy accepts loops, duplicates, NaN and unknown types (and raises Python's own
errors on others). Its assumptions are therefore checked on the XML first. No mesh is opened.
"""

import gc
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from io import BytesIO
from types import ModuleType
from typing import TYPE_CHECKING

from rapidgen.config.truncation import limit_findings
from rapidgen.config.urdf.expand import Description
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, refusal

if TYPE_CHECKING:
    import numpy as np
    from lxml.etree import _Element as Element
    from numpy.typing import NDArray

    Matrix = NDArray[np.float64]
    PlaceOf = Callable[[Element], Span | None]

KINDS = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
MAX_JOINTS = 1000
MAX_NAME = 200
_NUMBERS = {
    "limit": ("lower", "upper", "velocity"),
    "mimic": ("multiplier", "offset"),
}
_VECTORS = {"origin": ("xyz", "rpy"), "axis": ("xyz",)}
Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class UrdfJoint:
    """One joint of the file: rad, m, s; None is an omitted value.

    The offset of a mimic joint is part of its `xyz` and `rpy`.
    """

    name: str
    kind: str
    parent: str
    child: str
    xyz: Vector
    rpy: Vector
    axis: Vector
    lower: float | None
    upper: float | None
    velocity: float | None
    mimic: str
    multiplier: float
    span: Span | None

    @property
    def is_actuated(self) -> bool:
        """True if the joint moves by itself: neither fixed nor a mimic."""
        return self.kind != "fixed" and not self.mimic

    @property
    def has_zero_axis(self) -> bool:
        """True for an axis of length 0, which allows no motion."""
        return self.axis == (0.0, 0.0, 0.0)

    @property
    def has_empty_range(self) -> bool:
        """True if the range of an actuated joint is empty.

        Such a joint keeps a place, or its range is not set.
        """
        return self.is_actuated and self.lower is not None and self.lower == self.upper

    def moved(self, amount: float) -> tuple[Vector, Vector]:
        """Return xyz and rpy of the joint turned by `amount` (rad), as one step."""
        step = _moved(_matrix(self.xyz, self.rpy), self.axis, amount, slides=False)
        return _vector(step[:3, 3]), _rpy(step)


@dataclass(frozen=True, slots=True)
class UrdfRobot:
    """Joints in the order of the document."""

    name: str
    links: tuple[str, ...]
    joints: tuple[UrdfJoint, ...]

    def joint(self, name: str) -> UrdfJoint | None:
        """Return a joint by name."""
        return next((j for j in self.joints if j.name == name), None)


def read_robot(description: Description, place: Span | None) -> UrdfRobot:
    """Return the robot of a description.

    Raises DiagnosticError (RG031, RG051, RG053, RG060).
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    data = description.text.encode()
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as fault:
        line, column = fault.position
        span = place if description.expanded else Span(str(description.path), line, column or 1)
        raise refusal(
            "RG060",
            span,
            f"{description.path.name} is not well-formed XML: {fault.msg}",
            "correct the file there; nothing after that place was read",
        ) from None

    def span_of(element: "Element") -> Span | None:
        if description.expanded:
            named = element if element.tag in ("link", "joint") else element.getparent()
            known = named is not None and named.get("name")
            return (description.origin(known, named.tag) if known else None) or place
        if not element.sourceline:
            return place
        return Span(str(description.path), element.sourceline, 1)

    if etree.QName(root).localname != "robot":
        raise refusal(
            "RG060",
            span_of(root),
            f"{description.path.name} is no robot description: its root is <{root.tag}>",
            "the root of a URDF is <robot>",
        )
    count = sum(1 for _ in root.iterchildren("joint"))
    if count > MAX_JOINTS:
        raise refusal(
            "RG043",
            place,
            f"{description.path.name} has {count:,} joints; a cell has at most {MAX_JOINTS:,}",
            "give the description of the robot alone",
        )
    faults = list(_structure(root, span_of, description.path.name))
    if faults:
        raise DiagnosticError(limit_findings(faults))
    root.set("name", root.get("name") or description.path.stem)
    lines = {e.get("name"): span_of(e) for e in root.iterchildren("joint")}
    return _read(etree.tostring(_skeleton(root)), lines)


def _skeleton(root: "Element") -> "Element":
    """Return the robot with links and joints only.

    Without geometry, no mesh is read.
    """
    from lxml import etree

    made = etree.Element("robot", name=root.get("name"))
    for element in root:
        if element.tag == "link":
            etree.SubElement(made, "link", name=element.get("name"))
        elif element.tag == "joint":
            joint = etree.SubElement(made, "joint", dict(element.attrib))
            for part in element:
                if part.tag in ("parent", "child", "origin", "axis", "limit", "mimic"):
                    etree.SubElement(joint, part.tag, dict(part.attrib))
    return made


def _yourdfpy() -> ModuleType:
    """Return the module.

    It imports trimesh and scipy: garbage collection during the import takes a tenth of its time.
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        import yourdfpy
    finally:
        if enabled:
            gc.enable()
    module: ModuleType = yourdfpy
    return module


def _read(data: bytes, lines: dict[str, Span | None]) -> UrdfRobot:
    made = _yourdfpy().URDF.load(BytesIO(data), load_meshes=False, build_scene_graph=False)
    robot = made.robot
    joints = []
    for joint in robot.joints:
        limit, mimic = joint.limit, joint.mimic
        factor = mimic.multiplier if mimic and mimic.multiplier is not None else 1.0
        axis = _unit(_vector(joint.axis))
        matrix = joint.origin
        if mimic and mimic.offset:
            matrix = _moved(matrix, axis, float(mimic.offset), slides=joint.type == "prismatic")
        joints.append(
            UrdfJoint(
                joint.name,
                joint.type,
                joint.parent,
                joint.child,
                _vector(matrix[:3, 3]) if matrix is not None else (0.0, 0.0, 0.0),
                _rpy(matrix) if matrix is not None else (0.0, 0.0, 0.0),
                axis,
                None if limit is None else limit.lower,
                None if limit is None else limit.upper,
                None if limit is None else limit.velocity,
                mimic.joint if mimic else "",
                float(factor),
                lines.get(joint.name),
            )
        )
    return UrdfRobot(robot.name, tuple(link.name for link in robot.links), tuple(joints))


def _moved(matrix: "Matrix | None", axis: Vector, amount: float, *, slides: bool) -> "Matrix":
    """Return a joint's origin with the joint itself moved by `amount`."""
    import numpy as np

    step = np.eye(4)
    x, y, z = axis
    if slides:
        step[:3, 3] = np.array(axis) * amount
    else:
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = math.sin(amount) * cross + (1 - math.cos(amount)) * cross @ cross
        step[:3, :3] += turn
    return step if matrix is None else matrix @ step


def _matrix(xyz: Vector, rpy: Vector) -> "Matrix":
    import numpy as np

    made = np.eye(4)
    for axis, angle in zip(
        ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)), rpy[::-1], strict=True
    ):
        made = _moved(made, axis, angle, slides=False)
    made[:3, 3] = xyz
    return made


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = (float(v) for v in values)
    return (x, y, z)


def _unit(values: Vector) -> Vector:
    norm = math.sqrt(sum(v * v for v in values)) or 1.0
    x, y, z = (v / norm for v in values)
    return (x, y, z)


def _rpy(matrix: "Matrix") -> Vector:
    """Return roll, pitch, yaw about fixed axes of a rotation matrix."""
    cosine = math.hypot(matrix[0, 0], matrix[1, 0])
    pitch = math.atan2(-matrix[2, 0], cosine)
    if cosine < 1e-9:
        return (math.atan2(-matrix[1, 2], matrix[1, 1]), pitch, 0.0)
    return (
        math.atan2(matrix[2, 1], matrix[2, 2]),
        pitch,
        math.atan2(matrix[1, 0], matrix[0, 0]),
    )


def _structure(root: "Element", span_of: "PlaceOf", name: str) -> Iterator[Diagnostic]:
    """Check assumptions of yourdfpy: names, parent, child, numbers, types."""
    seen: dict[tuple[str, str], int] = {}
    for element in root:
        if element.tag not in ("link", "joint"):
            continue
        own = element.get("name")
        if not own:
            message = f"a <{element.tag}> has no name"
            yield error("RG053", span_of(element), message, f'write <{element.tag} name="...">')
            continue
        if len(own) > MAX_NAME or not own.isprintable():
            yield error(
                "RG053",
                span_of(element),
                f"the name of a <{element.tag}> is {len(own)} characters long"
                if len(own) > MAX_NAME
                else f"the name {own!a} has a character that is not printed",
                "give it a short name of plain letters",
            )
            continue
        if (element.tag, own) in seen:
            yield error(
                "RG051",
                span_of(element),
                f"two {element.tag}s are called '{own}'",
                "give one of them another name",
                label="second time",
            )
        seen[element.tag, own] = 1
        if element.tag == "joint":
            yield from _joint_structure(element, own, span_of)
    if root.find("joint") is None:
        yield error(
            "RG031",
            span_of(root),
            f"{name} is an empty robot: it has no joints",
            "give the top-level file of the description",
        )


def _joint_structure(element: "Element", name: str, span_of: "PlaceOf") -> Iterator[Diagnostic]:
    kind = element.get("type")
    if kind not in KINDS:
        yield error(
            "RG053",
            span_of(element),
            f"joint '{name}' has the unknown type '{kind}'",
            f"a joint is {', '.join(KINDS[:4])}",
        )
    for part in ("parent", "child"):
        inner = element.find(part)
        if inner is None or not inner.get("link"):
            message = f"joint '{name}' has no {part} link"
            yield error("RG053", span_of(element), message, f'add <{part} link="..."/>')
    mimic = element.find("mimic")
    if mimic is not None and not mimic.get("joint"):
        message = f"joint '{name}' mimics no joint"
        yield error("RG042", span_of(element), message, 'write <mimic joint="..."/>')
    for part, attributes in (*_NUMBERS.items(), *_VECTORS.items()):
        inner = element.find(part)
        for attribute in attributes if inner is not None else ():
            text = inner.get(attribute)
            expected = 1 if part in _NUMBERS else 3
            if text is not None and not _is_numbers(text, expected):
                yield error(
                    "RG053",
                    span_of(inner),
                    f"joint '{name}': {part} {attribute}=\"{text}\" is not "
                    + ("a finite number" if expected == 1 else "three finite numbers"),
                    "write a decimal point, not a comma"
                    if "," in text
                    else "write a number"
                    if expected == 1
                    else "write three numbers with blanks between them",
                )


def _is_numbers(text: str, count: int) -> bool:
    words = text.split()
    if len(words) != count:
        return False
    try:
        return all(math.isfinite(float(word)) for word in words)
    except ValueError:
        return False
