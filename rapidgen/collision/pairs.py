"""Pairs of bodies to check: all that can change their distance, allowed ones, and zones."""

import re
from collections.abc import Iterator, Mapping

import numpy as np

from rapidgen.axes import frames
from rapidgen.collision.draft import Draft
from rapidgen.collision.scene import Pair
from rapidgen.collision.shapes import Array, Shape, box, cylinder, half_space, sphere
from rapidgen.collision.srdf import FROM_SRDF, read_srdf
from rapidgen.collision.tree import WORLD, Tree
from rapidgen.config.cell import AllowedKeys, CellDescription, CollisionKeys
from rapidgen.config.zones import ZoneKeys
from rapidgen.diagnostics import suggest

_PAIR = re.compile(r"\s+-\s+")
_EVERYTHING = "all"


_SIDES, _DIRECTIONS = 64, 600
"""Planes around a cylinder, and around a sphere, to keep inside of."""


def zone_shapes(zone: ZoneKeys) -> tuple[Shape, ...]:
    """Return the volume to keep out of, or half-spaces around the one to keep inside of.

    Planes within a cylinder or a sphere leave out at most 0.2 % or 1 % of its radius.
    """
    if zone.box is not None:
        low, high = np.array(zone.box.low) / 1000, np.array(zone.box.high) / 1000
        x, y, z = ((low + high) / 2).tolist()
        if zone.keep == "out":
            a, b, c = (high - low).tolist()
            return (box(a, b, c, ((x, y, z), frames.UNIT)),)
        planes = [(axis, low) for axis in np.eye(3)] + [(-axis, high) for axis in np.eye(3)]
        return tuple(_behind(normal, corner) for normal, corner in planes)
    if zone.cylinder is not None:
        base = np.array(zone.cylinder.base) / 1000
        radius, height = zone.cylinder.radius / 1000, zone.cylinder.height / 1000
        up = np.array([0.0, 0.0, height])
        if zone.keep == "out":
            x, y, z = (base + up / 2).tolist()
            return (cylinder(radius, height, ((x, y, z), frames.UNIT)),)
        turns = 2 * np.pi * np.arange(_SIDES) / _SIDES
        ways = np.stack([np.cos(turns), np.sin(turns), np.zeros(_SIDES)], axis=1)
        inner = radius * np.cos(np.pi / _SIDES)
        ends = (_behind(up / height, base), _behind(-up / height, base + up))
        return (*ends, *(_behind(-way, base + inner * way) for way in ways))
    assert zone.sphere is not None  # `load_cell` requires one of them
    centre, radius = np.array(zone.sphere.centre) / 1000, zone.sphere.radius / 1000
    if zone.keep == "out":
        x, y, z = centre.tolist()
        return (sphere(radius, ((x, y, z), frames.UNIT)),)
    ways = _directions(_DIRECTIONS)
    # Every direction is near one of them, so all points inside the planes are in the sphere.
    return tuple(_behind(-way, centre + _INNER * radius * way) for way in ways)


def _behind(normal: Array, point: Array) -> Shape:
    """Return the half-space behind a plane, whose normal points out of it."""
    x, y, z = point.tolist()
    return half_space(normal.tolist(), (x, y, z))


_INNER = 0.99
"""Cosine of the largest angle of any direction to the nearest of `_directions`."""


def _directions(count: int) -> Array:
    """Return evenly spread unit vectors (count, 3), on a spiral from pole to pole."""
    k = np.arange(count) + 0.5
    z = 1 - 2 * k / count
    turn = k * np.pi * (3 - np.sqrt(5))
    around = np.sqrt(1 - z * z)
    result: Array = np.stack([around * np.cos(turn), around * np.sin(turn), z], axis=1)
    return result


def zone_pairs(name: str, zone: ZoneKeys, index: int, draft: Draft) -> list[Pair]:
    """Return pairs of a zone with the bodies that it concerns (RG829)."""
    moving = [(i, b) for i, b in enumerate(draft.bodies[:index]) if b.owner]
    result = []
    for word in zone.of:
        if word in draft.parts:
            continue  # `gripping` adds the pairs of parts
        chosen = [
            i
            for i, b in moving
            if (word == _EVERYTHING and b.role != "zone") or word in (b.name, b.name.split("/")[-1])
        ]
        # The base of a robot does not move.
        chosen = [i for i in chosen if draft.bodies[i].node != WORLD or word != _EVERYTHING]
        if not chosen and word != _EVERYTHING:
            names = [b.name for _, b in moving]
            draft.report("RG829", f"zone {name}: no '{word}' moves", suggest(word, names))
        result += [Pair(i, index, 0.0) for i in chosen]
    return result


def special_pairs(
    cell: CellDescription, draft: Draft
) -> tuple[dict[frozenset[str], str], dict[frozenset[str], float]]:
    """Return reasons of allowed pairs, and clearances in m of others (RG829, RG833)."""
    keys = cell.collision or CollisionKeys()
    names = [body.name for body in draft.bodies]
    allowed: dict[frozenset[str], str] = {}
    special: dict[frozenset[str], float] = {}
    for text, value in keys.pairs.items():
        parts = _PAIR.split(text.strip())
        unknown = [part for part in parts if part not in names]
        if len(parts) != 2 or unknown:
            wrong = unknown[0] if unknown else text
            help = suggest(wrong, names) or f"bodies of this cell: {', '.join(names[:30])}"
            draft.report("RG829", f"collision.pairs: '{text}': no body '{wrong}'", help)
            continue
        if isinstance(value, AllowedKeys):
            allowed[frozenset(parts)] = value.allowed
        else:
            special[frozenset(parts)] = value / 1000
    if keys.srdf:
        for one, other, reason in read_srdf(cell.folder, keys.srdf):
            allowed.setdefault(frozenset((one, other)), FROM_SRDF + reason)
    return allowed, special


def body_pairs(
    cell: CellDescription,
    draft: Draft,
    tree: Tree,
    allowed: Mapping[frozenset[str], str],
    special: Mapping[frozenset[str], float],
) -> Iterator[Pair]:
    """Yield pairs of bodies that can change their distance, without neighbours.

    Neighbours are bodies of one robot that a joint connects, or that hang on the same node or on
    parent and child.
    """
    keys = cell.collision or CollisionKeys()
    clearance, own_clearance = keys.clearance / 1000, keys.self_clearance / 1000
    for i, one in enumerate(draft.bodies):
        for j, other in enumerate(draft.bodies[i + 1 :], i + 1):
            names = frozenset((one.name, other.name))
            if one.node == other.node or "zone" in (one.role, other.role) or names in allowed:
                continue
            is_own = bool(one.owner) and one.owner == other.owner
            if names in draft.neighbours or (
                is_own and _are_neighbours(tree, one.node, other.node)
            ):
                continue
            standard = own_clearance if is_own else clearance
            yield Pair(i, j, special.get(names, standard))


def _are_neighbours(tree: Tree, a: int, b: int) -> bool:
    def parent(node: int) -> int:
        return WORLD if node == WORLD else tree.nodes[node].parent

    return parent(a) == b or parent(b) == a
