"""Parts of a world while it is made: its draft, and shapes from descriptions and cell files.

Faults are collected in the draft, so that a user sees all of them at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rapidgen.axes import frames
from rapidgen.collision.hulls import hull_vertices
from rapidgen.collision.meshes import MeshFault, is_open, triangles_of
from rapidgen.collision.scene import Body
from rapidgen.collision.shapes import Array, Shape, box, capsule, cylinder, half_space, hull, sphere
from rapidgen.collision.tree import Node
from rapidgen.config.cell import CellShape
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.config.urdf.visual_trees import Tree as Description
from rapidgen.config.urdf.visuals import NoMesh, Visual, mesh_in_folder
from rapidgen.diagnostics import Diagnostic, Severity, error

_DOUBTFUL, _WRONG = (0.1, 2.5), (0.02, 10.0)
"""Size of a robot's largest mesh over that of its chain, outside of which its unit is doubtful, or
wrong. The largest mesh of a robot of ABB is 0.25 to 1 of its chain."""


@dataclass(frozen=True, slots=True)
class Carrier:
    """A frame that moves: its node, its pose there, and the robot of a link."""

    node: int
    pose: frames.Pose
    owner: str = ""
    together: frozenset[str] = frozenset()
    """Links that move with it."""


@dataclass(slots=True, eq=False)
class Draft:
    """Parts of a world while it is made."""

    nodes: list[Node] = field(default_factory=list)
    bodies: list[Body] = field(default_factory=list)
    findings: list[Diagnostic] = field(default_factory=list)
    unchecked: list[str] = field(default_factory=list)
    neighbours: set[frozenset[str]] = field(default_factory=set)
    columns: dict[str, slice] = field(default_factory=dict)
    carriers: dict[str, Carrier] = field(default_factory=dict)
    """Links and mechanical units that objects may be fixed to."""
    parts: frozenset[str] = frozenset()
    """Objects that grippers can hold."""

    def report(
        self, code: str, message: str, help: str = "", severity: Severity = Severity.ERROR
    ) -> None:
        self.findings.append(error(code, None, message, help, severity=severity))


def pose_of(placement: Placement) -> frames.Pose:
    """Return a placement as a pose."""
    return placement.position, placement.orientation


def link_shapes(
    group: GroupConfig, description: Description, chosen: Sequence[str], draft: Draft
) -> dict[str, tuple[Shape, ...]]:
    """Return shapes of links in their frames: `<collision>`, else the hull of `<visual>`."""
    result: dict[str, tuple[Shape, ...]] = {}
    from_visuals = []
    largest = 0.0
    for link in chosen:
        visuals = description.collisions.get(link, ())
        if not visuals:
            visuals = description.visuals.get(link, ())
            from_visuals += [link] if visuals else []
        shapes = []
        for visual in visuals:
            shape = _of_visual(visual, link, draft)
            if shape is None:
                continue
            if shape.kind == "hull":
                largest = max(largest, 2 * shape.bounding_sphere()[1])
            shapes.append(shape)
        if shapes:
            result[link] = tuple(shapes)
        else:
            draft.unchecked.append(f"link {link} of {group.name}: no shape")
    if from_visuals:
        draft.report(
            "RG824",
            f"{len(from_visuals)} links of {group.name} have no <collision>: "
            f"{', '.join(from_visuals[:12])}",
            "the convex hulls of their visuals are used; parts that are not drawn are not checked",
            Severity.WARNING,
        )
    if largest > 0:
        _check_size(group, largest, draft)
    return result


def _check_size(group: GroupConfig, largest: float, draft: Draft) -> None:
    """Report meshes whose size does not fit the chain, with its tracks (RG826)."""
    chain = sum(float(np.linalg.norm(step.xyz)) for step in group.chain)
    chain += sum(j.upper - j.lower for j in group.joints if j.kind == "prismatic")
    if not chain or _DOUBTFUL[0] * chain < largest < _DOUBTFUL[1] * chain:
        return
    is_wrong = not _WRONG[0] * chain < largest < _WRONG[1] * chain
    factor = "0.001 0.001 0.001" if largest > chain else "1000 1000 1000"
    draft.report(
        "RG826",
        f"the largest mesh of {group.name} is {largest:.3g} m long, its kinematic chain "
        f"{chain:.3g} m",
        f'is its unit wrong? <mesh ... scale="{factor}"/> in the description corrects mm and m',
        Severity.ERROR if is_wrong else Severity.WARNING,
    )


def _of_visual(visual: Visual, link: str, draft: Draft) -> Shape | None:
    pose = (visual.xyz, frames.from_rpy(*visual.rpy))
    match visual.kind, visual.size:
        case "box", (x, y, z):
            return box(x, y, z, pose)
        case "cylinder", (radius, length):
            return cylinder(radius, length, pose)
        case "sphere", (radius,):
            return sphere(radius, pose)
    if visual.mesh is None:
        draft.report("RG827", f"mesh of {link}: {visual.fault}", "correct the description")
        return None
    return _hull_of(visual.mesh, np.array(visual.size), pose, link, draft)


def _hull_of(path: Path, scale: Array, pose: frames.Pose, owner: str, draft: Draft) -> Shape | None:
    try:
        triangles = triangles_of(path)
        points = np.unique(triangles.reshape(-1, 3), axis=0) * scale
        vertices = hull_vertices(points)
    except (MeshFault, ValueError) as why:
        draft.report(
            "RG827", f"mesh {path.name} of {owner} cannot be used: {why}", "export it again"
        )
        return None
    if is_open(triangles):
        draft.report(
            "RG827",
            f"mesh {path.name} of {owner} is open",
            "its convex hull is used, which closes it",
            Severity.INFO,
        )
    return hull(vertices, pose, path.name)


def cell_shape(shape: CellShape, folder: Path, owner: str, draft: Draft) -> Shape | None:
    """Return a shape of the cell file (RG825, RG827)."""
    pose = pose_of(shape.frame)
    match shape.kind, shape.size:
        case "box", (x, y, z):
            return box(x, y, z, pose)
        case "cylinder", (radius, length):
            return cylinder(radius, length, pose)
        case "capsule", (radius, length):
            return capsule(radius, length, pose)
        case "sphere", (radius,):
            return sphere(radius, pose)
        case "half_space", (x, y, z):
            return half_space(frames.rotate(pose[1], (x, y, z)), pose[0])
    try:
        path = mesh_in_folder(shape.mesh, folder)
    except NoMesh as why:
        draft.report("RG827", f"mesh of {owner}: {why}", "put it into the cell file's folder")
        return None
    if not shape.scale:
        draft.report("RG825", f"mesh of {owner} has no unit", "add `unit: mm` or `unit: m`")
        return None
    return _hull_of(path, np.full(3, shape.scale), pose, owner, draft)
