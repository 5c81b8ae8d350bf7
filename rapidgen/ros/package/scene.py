"""Collision data of a package: objects of a cell as a MoveIt scene, tools, pairs without a check.

All come from the world of collision checks, so that MoveIt and rapidgen see the same cell. The
format of a scene is that of `PlanningScene::saveGeometryToStream` and `shapes::saveAsText`
[code: moveit2, geometric_shapes].
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.default_postures import usual_start
from rapidgen.collision.robot import MotionMismatch, frames_of_chain
from rapidgen.collision.scene import Body
from rapidgen.collision.shapes import Shape, box, cylinder, sphere
from rapidgen.collision.tree import WORLD
from rapidgen.collision.world import RobotSource, World, build_world, sources_of
from rapidgen.config.cell import CellDescription
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.ros.package.description import DescribedGroup, MeshFiles, described

_EXTENT = 20.0
"""m: side of the box that stands for a half-space."""
_DEPTH = 1.0
"""m: its thickness."""
Report = Callable[[Diagnostic], None]


@dataclass(frozen=True, slots=True, eq=False)
class RobotShapes:
    """What a package knows of the shapes of a robot and its cell."""

    described: Mapping[str, DescribedGroup]
    """Groups with a description that moves as the configuration."""
    world: World | None
    """None: nothing has shapes, or coal is missing."""


def shapes_of(
    config: RobotConfig,
    path: Path | None,
    cell: CellDescription | None,
    *,
    is_fitted: bool,
    report: Report,
) -> RobotShapes:
    """Return the shapes of a robot; `path` is its configuration, None for a shipped model.

    `is_fitted`: convex parts replace the meshes for collisions. `report` gets warnings (RG699).
    Raises DiagnosticError for a faulty cell or mesh; ModuleNotFoundError without coal if something
    is to be fitted.
    """
    paths = {group.name: path for group in config.groups} if path is not None else {}
    sources = sources_of(cell or CellDescription(), config.groups, paths)
    known: dict[str, DescribedGroup] = {}
    for source in sources:
        if (own := _described(source, is_fitted=is_fitted, report=report)) is not None:
            known[source.group.name] = own
    if not known and cell is None:
        return RobotShapes(known, None)
    home = {group.name: usual_start(group) for group in config.groups}
    try:
        return RobotShapes(known, build_world(cell or CellDescription(), sources, home))
    except ModuleNotFoundError:
        if cell is not None:
            raise
        report(
            _doubt(
                "pairs of links that overlap in the home position are not known without coal",
                "pip install 'rapidgen[collision]', then generate the packages again",
            )
        )
        return RobotShapes(known, None)


def _described(source: RobotSource, *, is_fitted: bool, report: Report) -> DescribedGroup | None:
    group, tree = source.group, source.description
    if tree is None or not (tree.visuals or tree.collisions):
        report(
            _doubt(
                f"the links of {group.name} have no meshes: they are drawn as bars along the axes, "
                "which are not the robot's shape",
                "give the configuration a `urdf:` with meshes",
            )
        )
        return None
    fits = {}
    if is_fitted:
        from rapidgen.collision.fitted_urdf import fit_description

        fits = {link.name: link.fit for link in fit_description(tree) if link.fit is not None}
    try:
        return described(group, tree, fits)
    except MotionMismatch:
        report(
            _doubt(
                f"the description of {group.name} moves otherwise than its configuration: the "
                "links are drawn as bars along the axes",
                "use a URDF of this robot with the configuration's joint names",
            )
        )
        return None


def _doubt(message: str, help: str) -> Diagnostic:
    return error("RG699", None, message, help, severity=Severity.WARNING)


def without_check(
    world: World, names: Mapping[str, str], report: Report
) -> Iterator[tuple[str, str, str]]:
    """Yield (link, link, reason) of pairs that need no check, by the URDF's names.

    `names` are links of the URDF by body. Pairs that overlap in the home position are reported:
    links, whose shapes are too large there, are excluded as MoveIt's Setup Assistant does it, but
    no tools.
    """
    scene = world.scene
    near = scene.body_distances(world.values({}))[0].tolist()
    checked = {frozenset(scene.names(number)): distance for number, distance in enumerate(near)}
    links = {body.name for body in scene.bodies if body.role == "link"}
    overlaps: list[str] = []
    blocked: list[str] = []
    for one, other in combinations([body.name for body in scene.bodies if body.name in names], 2):
        pair = frozenset((one, other))
        reason = world.allowed.get(pair, "")
        if reason or pair not in checked:
            yield names[one], names[other], reason or "Adjacent"
        elif checked[pair] <= 0 and pair <= links:
            overlaps.append(f"{one} - {other}")
            yield names[one], names[other], "Default"
        elif checked[pair] <= 0:
            blocked.append(f"{one} - {other}")
    if overlaps:
        report(
            _doubt(
                "convex shapes that overlap in the home position are not checked against each "
                f"other by MoveIt: {', '.join(overlaps)}",
                "--fit-shapes makes shapes that follow the meshes more closely",
            )
        )
    if blocked:
        report(
            _doubt(
                f"these overlap in the home position, so MoveIt plans nothing from there: "
                f"{', '.join(blocked)}",
                f"correct the tool's shapes, or collision: {{pairs: {{{blocked[0]}: "
                "{allowed: REASON}}} in the cell file",
            )
        )


def link_names(
    config: RobotConfig, prefix: str, drawn: Mapping[str, Mapping[str, str]]
) -> dict[str, str]:
    """Return links of the URDF by the names that bodies of the world have."""
    several = len(config.groups) > 1
    result = {}
    for group in config.groups:
        for link, name in drawn.get(prefix + group.name, {}).items():
            result[f"{group.name}/{link}" if several else link] = name
    return result


def add_tools(
    root: ET.Element,
    world: World,
    group: GroupConfig,
    own: DescribedGroup | None,
    tip: str,
    prefix: str,
    meshes: MeshFiles,
) -> dict[str, str]:
    """Add links of the cell's tools at a tip; return their names by body."""
    made = own.frames if own is not None else frames_of_chain(group, frames.IDENTITY, 0, 0)
    at = frames.invert(made.flange[1])
    result = {}
    for body in world.scene.bodies:
        if body.role != "tool" or body.owner != group.name:
            continue
        name = prefix + body.name.rpartition("/")[2]
        link = ET.SubElement(root, "link", name=name)
        for tag in ("visual", "collision"):
            for shape in body.shapes:
                _add_shape(ET.SubElement(link, tag), shape.placed(at), body.name, meshes)
        joint = ET.SubElement(root, "joint", name=f"{name}_joint", type="fixed")
        ET.SubElement(joint, "parent", link=tip)
        ET.SubElement(joint, "child", link=name)
        ET.SubElement(joint, "origin", xyz="0 0 0", rpy="0 0 0")
        result[body.name] = name
    return result


def _add_shape(element: ET.Element, shape: Shape, name: str, meshes: MeshFiles) -> None:
    """Draw a shape; a capsule as its cylinder, whose ends the spheres of MoveIt's scene have."""
    from rapidgen.collision.fitted_urdf import stl_bytes

    xyz, q = shape.pose
    yaw, pitch, roll = frames.to_zyx(q)
    ET.SubElement(element, "origin", xyz=_words(xyz), rpy=_words((roll, pitch, yaw)))
    geometry = ET.SubElement(element, "geometry")
    match shape.kind:
        case "sphere":
            ET.SubElement(geometry, "sphere", radius=_words(shape.size))
        case "capsule" | "cylinder":
            radius, length = shape.size
            length += 2 * radius if shape.kind == "capsule" else 0.0
            ET.SubElement(geometry, "cylinder", radius=_words([radius]), length=_words([length]))
        case "box":
            ET.SubElement(geometry, "box", size=_words([2 * half for half in shape.size]))
        case _:
            uri = meshes.added("tools", f"{name}.stl", stl_bytes(shape.vertices))
            ET.SubElement(geometry, "mesh", filename=uri)


def scene_text(name: str, bodies: Sequence[Body]) -> str:
    """Return a MoveIt scene with the objects that stand in the world."""
    lines = [name]
    for body in bodies:
        if body.role != "object" or body.node != WORLD or not body.shapes:
            continue
        parts = [part for shape in body.shapes for part in _parts(shape)]
        lines += [f"* {body.name}", *_pose(frames.IDENTITY), str(len(parts))]
        for part in parts:
            lines += [*_shape_lines(part), *_pose(part.pose), "0 0 0 0"]
        lines.append("0")
    return "\n".join([*lines, ".", ""])


def _parts(shape: Shape) -> list[Shape]:
    """Return shapes that MoveIt has for one: it knows no capsules, and planes without a solid."""
    if shape.kind == "capsule":
        radius, length = shape.size
        ends = [
            replace(sphere(radius), pose=frames.compose(shape.pose, ((0.0, 0.0, end), frames.UNIT)))
            for end in (-length / 2, length / 2)
        ]
        return [cylinder(radius, length, shape.pose), *ends]
    if shape.kind == "half_space":
        below = (0.0, 0.0, -_DEPTH / 2), frames.UNIT
        return [box(_EXTENT, _EXTENT, _DEPTH, frames.compose(shape.pose, below))]
    return [shape]


def _shape_lines(shape: Shape) -> list[str]:
    match shape.kind:
        case "sphere":
            return ["sphere", _words(shape.size)]
        case "box":
            return ["box", _words([2 * half for half in shape.size])]
        case "cylinder":
            return ["cylinder", _words(shape.size)]
    from rapidgen.collision.hulls import hull_triangles

    points, index = hull_triangles(shape.vertices)
    rows = [_words(row) for row in np.asarray(points).tolist()]
    triangles = [" ".join(map(str, row)) for row in np.asarray(index).tolist()]
    return ["mesh", f"{len(rows)} {len(triangles)}", *rows, *triangles]


def _pose(pose: frames.Pose) -> list[str]:
    """Return position and quaternion x, y, z, w."""
    xyz, (w, x, y, z) = pose
    return [_words(xyz), _words((x, y, z, w))]


def _words(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)
