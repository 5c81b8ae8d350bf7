"""World Zones of a driver, from the zones of a cell file.

A controller with option 608-1 stops the robot before its TCP enters a volume, or leaves one [manual
3HAC050917: WZLimSup]. The volumes are boxes along the axes of the world, vertical cylinders and
spheres. Only the TCP is supervised, no link and no part, so a zone of links is no World Zone.
"""

from collections.abc import Collection
from dataclasses import dataclass, field
from math import isclose
from pathlib import Path
from typing import Annotated

from rapidgen.config import model, vectors
from rapidgen.config.assemble import display_path, keys_of
from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.plausibility import Arm
from rapidgen.config.rules import Rule
from rapidgen.config.schema import FrameKeys, Identifier, StrictModel
from rapidgen.config.tools import placement_of
from rapidgen.config.validate import valid_subset
from rapidgen.config.vectors import Vector
from rapidgen.config.yaml_tree import MappingNode, read_bytes
from rapidgen.config.zones import ZoneKeys, check_zones
from rapidgen.diagnostics import DiagnosticError, Severity

MOST = 20
"""World Zones of a controller [mem]."""
LEAST_SIDE, LEAST_RADIUS = 0.010, 0.005
"""m [mem]"""
_OF_TCP = ("tcp", "all")


@dataclass(frozen=True)
class _RobotKeys(StrictModel):
    """What a zone needs of a robot of a cell file."""

    base: Annotated[FrameKeys | None, Rule("Position of its base.")] = None


@dataclass(frozen=True)
class _FileKeys(StrictModel):
    """What World Zones need of a cell file; `load_cell` checks its other keys."""

    robots: Annotated[dict[Identifier, _RobotKeys], Rule("By task.")] = field(default_factory=dict)
    zones: Annotated[dict[Identifier, ZoneKeys], Rule("By name.")] = field(default_factory=dict)


def world_zones_of(
    file: Path, group: model.GroupConfig, several: bool, at: KeyPath, report: DraftFindings
) -> tuple[model.WorldZone, ...]:
    """Return the World Zones of a motion group (RG839, and the findings of the cell file).

    `several`: the controller has several motion groups, whose common world is that of the cell.
    Otherwise the controller's world is the base of its robot.
    """
    try:
        displayed = display_path(file)
        root, found = keys_of(read_bytes(file, displayed), displayed, "a cell file", "`zones:`")
    except DiagnosticError as fault:
        report.found += fault.diagnostics
        return ()
    root = _only(root, ("robots", "zones"))
    robots = root.entries.get("robots")
    if robots is not None and isinstance(robots[1], MappingNode):
        entries = {
            task: (place, _only(value, ("base",)) if isinstance(value, MappingNode) else value)
            for task, (place, value) in robots[1].entries.items()
        }
        root.entries["robots"] = (robots[0], MappingNode(entries, robots[1].span))
    cell, faults, removed = valid_subset(root, _FileKeys)
    own = DraftFindings(root, removed)
    own.found = found + faults
    check_zones(cell.zones, own)
    base = _base(cell, group, own)
    report.found += own.found
    if own.failed:
        return ()
    world = model.Placement() if several else base
    result = []
    for name, zone in cell.zones.items():
        left_out = [word for word in zone.of if word not in _OF_TCP]
        if len(left_out) == len(zone.of):
            _warn(report, at, f"zone {name} is none: it concerns {', '.join(left_out)}")
            continue
        if zone.of != ["tcp"]:
            _warn(report, at, f"World Zone {name} concerns the TCP, and not {', '.join(zone.of)}")
        made = _made(name, zone, world)
        if isinstance(made, str):
            report.error(
                "RG839",
                f"zone {name} cannot be a World Zone: {made}",
                at,
                help="change the zone, or leave `world_zones` out",
            )
        else:
            result.append(made)
    if len(result) > MOST:
        report.error("RG839", f"{len(result)} World Zones; a controller has {MOST} at most", at)
    return tuple(result)


def _warn(report: DraftFindings, at: KeyPath, text: str) -> None:
    report.add(
        "RG839",
        Severity.WARNING,
        text,
        at,
        help="World Zones supervise the TCP of the active tool; links are checked before a motion "
        "(`Robot(cell=...)`)",
    )


def _only(node: MappingNode, names: Collection[str]) -> MappingNode:
    entries = {name: value for name, value in node.entries.items() if name in names}
    return MappingNode(entries, node.span)


def _base(cell: _FileKeys, group: model.GroupConfig, report: DraftFindings) -> model.Placement:
    for task, robot in cell.robots.items():
        if task.casefold() == group.task.casefold() and robot.base is not None:
            return placement_of(robot.base, ("robots", task, "base"), report, Arm())
    return model.Placement()


def _made(name: str, zone: ZoneKeys, world: model.Placement) -> model.WorldZone | str:
    """Return a zone in the controller's world, placed in the cell, or why there is none."""
    keep = zone.keep
    up = _turned(world, (0.0, 0.0, 1.0))
    if zone.box is not None:
        corners = [_moved(world, corner) for corner in (zone.box.low, zone.box.high)]
        x_axis = _turned(world, (1.0, 0.0, 0.0))
        if not all(_is_along_axis(axis) for axis in (x_axis, up)):
            return "it is turned against the controller's world, and boxes lie along its axes"
        low = [min(pair) for pair in zip(*corners, strict=True)]
        high = [max(pair) for pair in zip(*corners, strict=True)]
        least = min(b - a for a, b in zip(low, high, strict=True))
        if least < LEAST_SIDE:
            return f"a side of {1000 * least:g} mm is shorter than {1000 * LEAST_SIDE:g} mm"
        return model.WorldZone(name, "box", keep, (*low, *high))
    if zone.cylinder is not None:
        radius, height = zone.cylinder.radius / 1000, zone.cylinder.height / 1000
        if not isclose(up[2], 1.0, abs_tol=1e-9):
            return "it is turned against the controller's world, and cylinders are vertical"
        if radius < LEAST_RADIUS or height < LEAST_SIDE:
            return "its radius is at least 5 mm, its height 10 mm"
        base = _moved(world, zone.cylinder.base)
        return model.WorldZone(name, "cylinder", keep, (*base, radius, height))
    assert zone.sphere is not None  # `load_cell` requires one of them
    radius = zone.sphere.radius / 1000
    if radius < LEAST_RADIUS:
        return "its radius is at least 5 mm"
    return model.WorldZone(name, "sphere", keep, (*_moved(world, zone.sphere.centre), radius))


def _turned(world: model.Placement, way: Vector) -> Vector:
    """Return a direction of the cell in the controller's world."""
    w, x, y, z = world.orientation
    return vectors.rotated((w, -x, -y, -z), way)


def _moved(world: model.Placement, point: list[float]) -> Vector:
    """Return a point of the cell, mm, in the controller's world, m."""
    x, y, z = (value / 1000 for value in point)
    return _turned(world, vectors.subtract((x, y, z), world.position))


def _is_along_axis(way: Vector) -> bool:
    return any(isclose(abs(value), 1.0, abs_tol=1e-9) for value in way)
