"""World Zones of a driver, from the zones of a cell file.

A controller with option 608-1 stops the robot before its TCP enters a volume, or leaves one [manual
3HAC050917: WZLimSup]. The volumes are boxes along the axes of the world, vertical cylinders and
spheres. Only the TCP is supervised, no link and no part, so a zone of links is no World Zone.
"""

from math import isclose
from pathlib import Path

from rapidgen.config import model, vectors
from rapidgen.config.cell import CellDescription, ZoneKeys, load_cell
from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.vectors import Vector
from rapidgen.diagnostics import DiagnosticError, Severity

MOST = 20
"""World Zones of a controller [mem]."""
LEAST_SIDE, LEAST_RADIUS = 0.010, 0.005
"""m [mem]"""
_OF_TCP = ("tcp", "all")


def world_zones_of(
    file: Path, group: model.GroupConfig, several: bool, at: KeyPath, report: DraftFindings
) -> tuple[model.WorldZone, ...]:
    """Return the World Zones of a motion group (RG839, and the findings of the cell file).

    `several`: the controller has several motion groups, whose common world is that of the cell.
    Otherwise the controller's world is the base of its robot.
    """
    try:
        cell = load_cell(file)
    except DiagnosticError as fault:
        report.found += fault.diagnostics
        return ()
    report.found += cell.diagnostics
    world = model.Placement() if several else _base(cell, group)
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


def _base(cell: CellDescription, group: model.GroupConfig) -> model.Placement:
    for task, base in cell.bases.items():
        if task.casefold() == group.task.casefold():
            return base
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
