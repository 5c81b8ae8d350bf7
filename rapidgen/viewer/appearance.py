"""Appearance of robots and cell objects: drawings and their mesh files.

A robot is drawn from the meshes of its description if its configuration names one, else from its
chain. Missing files are reported, and a solid replaces them.
"""

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.axes.frames import IDENTITY, UNIT, Pose, multiply
from rapidgen.config.cell import CellDescription, CellShape
from rapidgen.config.layers import Overrides
from rapidgen.config.model import GroupConfig
from rapidgen.config.urdf.source import xml_fault
from rapidgen.config.urdf.visual_trees import Tree, trees
from rapidgen.config.urdf.visuals import NoMesh, Visual, mesh_in_folder
from rapidgen.config.zones import ZoneKeys
from rapidgen.viewer.messages import SeenShape, SeenThing
from rapidgen.viewer.primitive_urdf import Drawing, described
from rapidgen.viewer.primitives import standing
from rapidgen.viewer.robots import pose_of
from rapidgen.viewer.urdf_visuals import drawn, shares

LARGEST = 40_000_000
"""Largest mesh, bytes."""
MOST = 200_000_000
"""Largest size of all meshes, bytes."""


@dataclass(frozen=True)
class Appearance:
    """Appearance of robots.

    Robots without a drawing are drawn from their chain.
    """

    drawings: Mapping[str, Drawing] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict, repr=False)
    """Meshes by the names in the page's requests."""
    faults: tuple[str, ...] = ()
    """Deviations from the description."""

    things: tuple[SeenThing, ...] = ()
    """Objects, zones and tool shapes of the cell."""
    bases: Mapping[str, Pose] = field(default_factory=dict)
    """Poses of robots by task in lower case, as far as known."""

    def of(self, group: GroupConfig) -> Drawing:
        """Return the drawing of a robot."""
        drawing = self.drawings.get(group.name) or described(group)
        base = self.bases.get(group.task.casefold())
        return drawing if base is None else replace(drawing, base=base)


PLAIN = Appearance()


class Meshes:
    """Files of meshes, each read once."""

    def __init__(self) -> None:
        self.files: dict[str, bytes] = {}
        self.faults: list[str] = []
        self._names: dict[Path, str] = {}

    def name(self, visual: Visual) -> str:
        """Return the page's name of a visual's mesh; empty if it has none."""
        if visual.mesh is None:
            self._say(visual.fault)
            return ""
        return self.name_of(visual.mesh)

    def name_in(self, name: str, folder: Path) -> str:
        """Return the page's name of a mesh in a folder."""
        try:
            return self.name_of(mesh_in_folder(name, folder))
        except NoMesh as why:
            self._say(str(why))
            return ""

    def name_of(self, mesh: Path) -> str:
        """Return the page's name of a mesh file."""
        if mesh not in self._names:
            self._names[mesh] = self._read(mesh)
        return self._names[mesh]

    def _read(self, path: Path) -> str:
        remaining = min(LARGEST, MOST - sum(map(len, self.files.values())))
        try:
            data = read_foreign(path, remaining)
        except TooLarge:
            self._say(f"{path.name} is larger than {remaining / 1e6:.0f} MB")
            return ""
        except OSError as fault:
            self._say(f"{path}: {fault.strerror}")
            return ""
        if path.suffix.lower() == ".dae" and (why := xml_fault(data)):
            self._say(f"{path.name}: {why}")
            return ""
        name = f"mesh-{hashlib.sha256(data).hexdigest()[:20]}{path.suffix.lower()}"
        self.files[name] = data
        return name

    def _say(self, fault: str) -> None:
        if fault not in self.faults:
            self.faults.append(fault)


def appearance(
    groups: Sequence[GroupConfig],
    described: Mapping[str, Path],
    overrides: Overrides = (),
    cell: CellDescription | None = None,
) -> Appearance:
    """Return the appearance of `described` configurations by group.

    `cell` has further objects. Raises DiagnosticError for a configuration that `load_config` would
    not accept.
    """
    result = {path: trees(path, overrides) for path in dict.fromkeys(described.values())}
    own = {
        group.name: tree
        for group in groups
        if group.name in described
        and (tree := _fitting(group, result[described[group.name]])) is not None
    }
    links = shares(groups, own)
    meshes = Meshes()
    drawings: dict[str, Drawing] = {}
    for group in groups:
        if group.name not in own:
            continue
        drawing = drawn(group, own[group.name], links[group.name], meshes.name)
        if drawing is not None:
            alone = sum(tree is own[group.name] for tree in own.values()) == 1
            free = alone and drawing.base == IDENTITY
            drawings[group.name] = replace(drawing, base=None) if free else drawing
        else:
            meshes.faults.append(f"the description does not move as the chain of {group.name} does")
    things = tuple(_things(cell, groups, meshes)) if cell is not None else ()
    placed = cell.bases if cell is not None else {}
    bases = {task.casefold(): (at.position, at.orientation) for task, at in placed.items()}
    return Appearance(drawings, MappingProxyType(meshes.files), tuple(meshes.faults), things, bases)


def _things(
    cell: CellDescription, groups: Sequence[GroupConfig], meshes: Meshes
) -> Iterator[SeenThing]:
    """Return objects, zones and the shapes of mounted tools."""
    for thing in cell.things:
        if thing.on:
            # The page places objects in the world only.
            continue
        shape = _shape(thing.shape, cell.folder, meshes)
        if shape is not None:
            yield SeenThing(name=thing.name, shapes=(shape,))
    for name, zone in cell.zones.items():
        role: Literal["keep-in", "keep-out"] = "keep-in" if zone.keep == "inside" else "keep-out"
        yield SeenThing(name=name, role=role, shapes=(_zone_shape(zone),))
    for group in groups:
        keys = {task.casefold(): robot for task, robot in cell.robots.items()}
        robot = keys.get(group.task.casefold())
        mounted = None if robot is None else robot.mounted
        if mounted is None:
            # As in collision checks: with several robots, it is open who carries a tool.
            mounted = list(cell.tool_shapes) if len(groups) == 1 else []
        for name in mounted:
            own = (_shape(one, cell.folder, meshes) for one in cell.tool_shapes.get(name, ()))
            shapes = tuple(shape for shape in own if shape is not None)
            if shapes:
                yield SeenThing(name=name, role="tool", robot=group.name, shapes=shapes)


def _zone_shape(zone: ZoneKeys) -> SeenShape:
    """Return the volume of a zone as a message."""
    if zone.cylinder is not None:
        x, y, z = (value / 1000 for value in zone.cylinder.base)
        radius, height = zone.cylinder.radius / 1000, zone.cylinder.height / 1000
        place = pose_of(((x, y, z + height / 2), UNIT))
        return SeenShape(kind="cylinder", size=(radius, height), pose=place)
    if zone.sphere is not None:
        x, y, z = (value / 1000 for value in zone.sphere.centre)
        size: tuple[float, ...] = (zone.sphere.radius / 1000,)
        return SeenShape(kind="sphere", size=size, pose=pose_of(((x, y, z), UNIT)))
    assert zone.box is not None  # `load_cell` requires one of them
    low, high = zone.box.low, zone.box.high
    x, y, z = ((a + b) / 2000 for a, b in zip(low, high, strict=True))
    size = tuple(abs(b - a) / 1000 for a, b in zip(low, high, strict=True))
    return SeenShape(kind="box", size=size, pose=pose_of(((x, y, z), UNIT)))


def _shape(shape: CellShape, folder: Path, meshes: Meshes) -> SeenShape | None:
    """Return a shape of the cell as a message; None: its mesh is missing, which is reported."""
    pose = (shape.frame.position, shape.frame.orientation)
    match shape.kind, shape.size:
        case "mesh", _:
            name = meshes.name_in(shape.mesh, folder)
            size = (shape.scale or 1.0,)
            return (
                SeenShape(kind="mesh", size=size, pose=pose_of(pose), mesh=name) if name else None
            )
        case "half_space", (x, y, z):
            normal = standing((x, y, z), (0.0, 1.0, 0.0))
            outer = (pose[0], multiply(pose[1], normal))
            return SeenShape(kind="half_space", pose=pose_of(outer))
    return SeenShape(kind=shape.kind, size=shape.size, pose=pose_of(pose))


def _fitting(group: GroupConfig, result: Mapping[str, Tree]) -> Tree | None:
    """Return the description with a group's joints that draws something.

    Groups of other programs may have other names.
    """
    first = [result[group.name]] if group.name in result else []
    names = {joint.name for joint in group.joints}
    for tree in (*first, *result.values()):
        if tree.visuals and names <= {joint.name for joint in tree.graph.robot.joints}:
            return tree
    return None
