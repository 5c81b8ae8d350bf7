"""URDF of a robot whose collision geometry are convex parts fitted to its meshes.

`fit_description` fits every link; `write_fitted` writes the URDF and an STL file for each part. The
result is used by `shapes: FILE.urdf` in a cell file, and by any program that reads URDF.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np

from rapidgen._atomic_write import write_whole
from rapidgen.axes import frames
from rapidgen.collision.fitting import PARTS, Fit, fit_parts
from rapidgen.collision.hulls import hull_triangles
from rapidgen.collision.meshes import MeshFault, triangles_of
from rapidgen.collision.shapes import Array
from rapidgen.config.urdf.graph import Graph
from rapidgen.config.urdf.visual_trees import Tree
from rapidgen.config.urdf.visuals import Visual
from rapidgen.diagnostics import refusal

_MESHES = "meshes"


@dataclass(frozen=True, slots=True, eq=False)
class FittedLink:
    """A link with its fit, in m and in the link's frame; `simple` are shapes without a mesh."""

    name: str
    fit: Fit | None
    simple: tuple[Visual, ...] = ()


def fit_description(
    tree: Tree, most: int = PARTS, report: Callable[[FittedLink], None] | None = None
) -> tuple[FittedLink, ...]:
    """Fit at most `most` convex parts to the visual meshes of each link.

    `report` gets each link when it is done. Raises DiagnosticError RG836 for a description without
    meshes, RG827 for a mesh that cannot be used; ModuleNotFoundError without coal.
    """
    result = []
    for link in tree.graph.robot.links:
        visuals = tree.visuals.get(link, ()) or tree.collisions.get(link, ())
        meshes = [visual for visual in visuals if visual.kind == "mesh"]
        simple = tuple(visual for visual in visuals if visual.kind != "mesh")
        if not visuals:
            continue
        fit = None
        if meshes:
            try:
                fit = fit_parts(np.concatenate([_triangles(visual) for visual in meshes]), most)
            except (MeshFault, ValueError) as why:
                raise refusal(
                    "RG827", None, f"mesh of {link} cannot be used: {why}", "export it again"
                ) from None
        result.append(FittedLink(link, fit, simple))
        if report is not None:
            report(result[-1])
    if not any(link.fit is not None for link in result):
        raise refusal(
            "RG836",
            None,
            f"{tree.graph.robot.name} has no meshes",
            "its boxes, cylinders and spheres are convex already: use the description itself",
        )
    return tuple(result)


def _triangles(visual: Visual) -> Array:
    """Return the triangles of a mesh in the frame of its link, m."""
    if visual.mesh is None:
        raise MeshFault(visual.fault)
    triangles = triangles_of(visual.mesh) * np.array(visual.size)
    rotation = np.array(frames.to_matrix(frames.from_rpy(*visual.rpy)))
    result: Array = triangles @ rotation.T + np.array(visual.xyz)
    return result


def write_fitted(graph: Graph, links: tuple[FittedLink, ...], folder: Path) -> Path:
    """Write NAME.urdf and the meshes of its parts into a new folder; return the URDF's path.

    Raises DiagnosticError RG836 for an existing folder, OSError.
    """
    if folder.exists():
        raise refusal("RG836", None, f"{folder} exists already", "choose another --output")
    files: dict[str, bytes] = {}
    by_name = {link.name: link for link in links}
    robot = Element("robot", name=graph.robot.name)
    for name in graph.robot.links:
        element = SubElement(robot, "link", name=name)
        link = by_name.get(name)
        if link is None:
            continue
        for visual in link.simple:
            _simple(element, visual)
        for number, part in enumerate(link.fit.parts if link.fit is not None else (), 1):
            file = f"{_MESHES}/{_file_name(name)}_{number}.stl"
            files[file] = stl_bytes(part)
            geometry = SubElement(SubElement(element, "collision"), "geometry")
            SubElement(geometry, "mesh", filename=file)
    for joint in graph.robot.joints:
        element = SubElement(robot, "joint", name=joint.name, type=joint.kind)
        SubElement(element, "origin", xyz=_text(joint.xyz), rpy=_text(joint.rpy))
        SubElement(element, "parent", link=joint.parent)
        SubElement(element, "child", link=joint.child)
        if joint.kind != "fixed":
            SubElement(element, "axis", xyz=_text(joint.axis))
        if joint.mimic:
            SubElement(
                element, "mimic", joint=joint.mimic, multiplier=repr(float(joint.multiplier))
            )
        if joint.kind in ("revolute", "prismatic", "continuous"):
            limits = {"lower": joint.lower, "upper": joint.upper, "velocity": joint.velocity}
            given = {key: repr(float(v)) for key, v in limits.items() if v is not None}
            SubElement(element, "limit", {"effort": "0.0", "velocity": "0.0", **given})
    indent(robot)
    (folder / _MESHES).mkdir(parents=True)
    for file, data in files.items():
        write_whole(folder / file, data)
    path = folder / f"{_file_name(graph.robot.name)}.urdf"
    write_whole(path, f'<?xml version="1.0"?>\n{tostring(robot, "unicode")}\n'.encode())
    return path


def _file_name(text: str) -> str:
    return "".join(c if c.isalnum() or c in "-_" else "_" for c in text) or "robot"


def _text(values: tuple[float, ...]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _simple(link: Element, visual: Visual) -> None:
    element = SubElement(link, "collision")
    SubElement(element, "origin", xyz=_text(visual.xyz), rpy=_text(visual.rpy))
    geometry = SubElement(element, "geometry")
    match visual.kind, visual.size:
        case "box", size:
            SubElement(geometry, "box", size=_text(size))
        case "sphere", (radius,):
            SubElement(geometry, "sphere", radius=repr(radius))
        case _, (radius, length):
            SubElement(geometry, "cylinder", radius=repr(radius), length=repr(length))


def stl_bytes(vertices: Array) -> bytes:
    """Return the hull of vertices (n, 3) as a binary STL file.

    Coordinates are float32: the part grows by its rounding, so that it still covers the mesh.
    """
    points, index = hull_triangles(vertices)
    middle = points.mean(axis=0)
    points = middle + (points - middle) * (1 + 1e-6)
    corners = points[index].astype("<f4")
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    table = np.zeros(len(corners), record)
    table["corners"] = corners
    return bytes(80) + len(corners).to_bytes(4, "little") + table.tobytes()


def find_description(source: Path) -> Path:
    """Return the URDF or xacro file of a file, or of a ROS package's folder.

    Raises DiagnosticError RG836 if there is none, or more than one.
    """
    if source.is_file():
        return source
    found = sorted(
        path
        for pattern in ("urdf/*.urdf", "urdf/*.xacro", "robots/*.urdf", "*.urdf")
        for path in source.glob(pattern)
        if "macro" not in path.name
    )
    # A URDF next to a xacro file of the same name was made from it.
    stems = {path.stem: path for path in reversed(found)}
    if len(stems) == 1:
        return next(iter(stems.values()))
    names = ", ".join(path.name for path in found)
    raise refusal(
        "RG836",
        None,
        f"{source} has {'several descriptions: ' + names if found else 'no description'}",
        "name the URDF or xacro file",
    )


def summary(links: Mapping[str, Fit]) -> str:
    """Return a table of the fits, in mm."""
    rows = [("link", "parts", "over", "one hull", "under")]
    for name, fit in links.items():
        over, hull, under = (f"{1000 * value:.1f}" for value in (fit.over, fit.hull, fit.under))
        rows.append((name, str(len(fit.parts)), over, hull, under))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    lines = ("  ".join(word.ljust(w) for word, w in zip(row, widths, strict=True)) for row in rows)
    return "".join(f"{line.rstrip()}\n" for line in lines)
