"""Distances of simple shapes in closed form, for many pairs at once.

A segment with a ball stands for sphere and capsule. All functions return signed distances (n,),
negative for a penetration, and the nearest points on both shapes (n, 3). The depth of a penetration
is the shortest translation that separates the shapes.
"""

import itertools

import numpy as np

from rapidgen.collision.shapes import Array

_TINY = 1e-12
Distances = tuple[Array, Array, Array]


def _dot(a: Array, b: Array) -> Array:
    result: Array = np.einsum("...i,...i->...", a, b)
    return result


def segments(a: Array, u: Array, b: Array, v: Array) -> tuple[Array, Array]:
    """Return the nearest points of segments a + s u and b + t v, s and t from 0 to 1.

    Shapes (n, 3). The nearest pair is in the interior of both, or at one of the four ends.
    """
    w = a - b
    uu, vv, uv = _dot(u, u), _dot(v, v), _dot(u, v)
    uw, vw = _dot(u, w), _dot(v, w)
    det = uu * vv - uv * uv
    safe_u, safe_v = np.where(uu > 0, uu, 1.0), np.where(vv > 0, vv, 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.where(det > _TINY * uu * vv, (uv * vw - vv * uw) / det, 0.0)
    s = np.stack([np.clip(inner, 0, 1), np.zeros_like(uw), np.ones_like(uw)])
    t = np.clip((vw + s * uv) / safe_v, 0, 1)
    # From each end of the other segment, too.
    t = np.concatenate([t, np.zeros((1, len(uw))), np.ones((1, len(uw)))])
    back = np.clip((t * uv - uw) / safe_u, 0, 1)
    p, q = a + back[..., None] * u, b + t[..., None] * v
    best = _dot(p - q, p - q).argmin(axis=0)
    rows = np.arange(len(uw))
    return p[best, rows], q[best, rows]


def segment_segment(a: Array, u: Array, r: Array, b: Array, v: Array, s: Array) -> Distances:
    """Return the distances of segments a + [0, 1] u with radius r and b + [0, 1] v with radius s.

    Crossing segments separate along their common normal.
    """
    p, q = segments(a, u, b, v)
    way = p - q
    far = np.linalg.norm(way, axis=1)
    normal = np.cross(u, v)
    size = np.linalg.norm(normal, axis=1)
    across = np.where((size > 0)[:, None], normal, _perpendicular(u, v))
    across = across / np.maximum(np.linalg.norm(across, axis=1), _TINY)[:, None]
    n = np.where((far > _TINY)[:, None], way / np.maximum(far, _TINY)[:, None], across)
    return far - r - s, p - n * r[:, None], q + n * s[:, None]


def _perpendicular(u: Array, v: Array) -> Array:
    """Return a direction across the longer of two parallel vectors."""
    longer = np.where((_dot(u, u) >= _dot(v, v))[:, None], u, v)
    least = np.eye(3)[np.abs(longer).argmin(axis=1)]
    result: Array = np.cross(longer, least)
    zero = _dot(result, result) == 0
    result[zero] = (0.0, 0.0, 1.0)
    return result


def segment_in_box(p: Array, d: Array, half: Array) -> tuple[Array, Array]:
    """Return squared distance and nearest parameter of segments p + [0, 1] d from boxes.

    All in the boxes' frames, shapes (..., 3). The squared distance is convex and piecewise
    quadratic: its slope at the ends and where the segment crosses a face's plane brackets the zero.
    """
    safe = np.where(np.abs(d) > _TINY, d, 1.0)
    crossings = np.concatenate([(half - p) / safe, (-half - p) / safe], axis=-1)
    parallel = np.concatenate([np.abs(d) <= _TINY] * 2, axis=-1)
    knots = np.clip(np.where(parallel, 0.0, crossings), 0.0, 1.0)
    shape = knots.shape[:-1]
    t = np.sort(np.concatenate([np.zeros((*shape, 1)), knots, np.ones((*shape, 1))], axis=-1))
    x = p[..., None, :] + t[..., None] * d[..., None, :]
    out = x - np.clip(x, -half[..., None, :], half[..., None, :])
    slope = _dot(out, d[..., None, :])
    # The last knot with a slope of at most 0; the zero is between it and the next.
    index = np.maximum((slope <= 0).sum(axis=-1) - 1, 0)[..., None]
    after = np.minimum(index + 1, t.shape[-1] - 1)
    t0, t1 = (np.take_along_axis(t, i, axis=-1)[..., 0] for i in (index, after))
    s0, s1 = (np.take_along_axis(slope, i, axis=-1)[..., 0] for i in (index, after))
    rise = s1 - s0
    share = np.where(rise > 0, np.clip(-s0 / np.where(rise > 0, rise, 1.0), 0.0, 1.0), 0.0)
    best = t0 + share * (t1 - t0)
    at = p + best[..., None] * d
    rest = at - np.clip(at, -half, half)
    return _dot(rest, rest), best


def segment_box(
    a: Array, u: Array, r: Array, rotation: Array, position: Array, half: Array
) -> Distances:
    """Return the distances of segments a + [0, 1] u with radius r from boxes."""
    p = np.einsum("nji,nj->ni", rotation, a - position)
    d = np.einsum("nji,nj->ni", rotation, u)
    squared, t = segment_in_box(p, d, half)
    at = p + t[:, None] * d
    foot = np.clip(at, -half, half)
    far = np.sqrt(squared)
    n = (at - foot) / np.maximum(far, _TINY)[:, None]
    inside = far <= _TINY
    if inside.any():
        rows = np.flatnonzero(inside)
        depth, way = _segment_depth(p[rows], d[rows], half[rows])
        far[rows], n[rows] = -depth, way
        # The deepest end of the segment, and the face in front of it.
        end = np.where((_dot(d[rows], way) < 0)[:, None], p[rows] + d[rows], p[rows])
        at[rows], foot[rows] = end, end + depth[:, None] * way
    first = at - n * r[:, None]
    to_world = "nij,nj->ni"
    return (
        far - r,
        position + np.einsum(to_world, rotation, first),
        position + np.einsum(to_world, rotation, foot),
    )


def _segment_depth(p: Array, d: Array, half: Array) -> tuple[Array, Array]:
    """Return depth and direction out for segments that meet a box around the origin.

    Candidates are the normals of faces and the cross products of the segment with edges: all
    face normals of the Minkowski difference.
    """
    axes = np.broadcast_to(np.eye(3), (len(p), 3, 3))
    crossed = np.cross(d[:, None, :], axes)
    length = np.linalg.norm(crossed, axis=2)
    usable = length > 1e-9
    crossed = crossed / np.where(usable, length, 1.0)[..., None]
    ways = np.concatenate([axes, -axes, crossed, -crossed], axis=1)
    extent = np.einsum("nwi,ni->nw", np.abs(ways), half)
    low = np.minimum(np.einsum("nwi,ni->nw", ways, p), np.einsum("nwi,ni->nw", ways, p + d))
    depth = extent - low
    depth[:, 6:] = np.where(np.concatenate([usable, usable], axis=1), depth[:, 6:], np.inf)
    best = depth.argmin(axis=1)
    rows = np.arange(len(p))
    return depth[rows, best], ways[rows, best]


_EDGES = np.array(
    [
        [[*corner[:i], -1, *corner[i:]], [*corner[:i], 1, *corner[i:]]]
        for i in range(3)
        for corner in itertools.product((-1, 1), repeat=2)
    ],
    dtype=np.float64,
)
"""The 12 edges of a cube: (12, 2, 3)."""


def box_box(r1: Array, p1: Array, h1: Array, r2: Array, p2: Array, h2: Array) -> Distances:
    """Return the distances of boxes with rotations (n, 3, 3), positions and half lengths (n, 3).

    Two separated boxes are nearest at an edge of one of them, since each vertex ends edges.
    """
    far, first, second = _edges_box(r1, p1, h1, r2, p2, h2)
    other, on_second, on_first = _edges_box(r2, p2, h2, r1, p1, h1)
    swap = other < far
    far = np.where(swap, other, far)
    first = np.where(swap[:, None], on_first, first)
    second = np.where(swap[:, None], on_second, second)
    # Of two boxes that overlap, an edge of one enters the other.
    touching = np.flatnonzero(far <= _TINY)
    if len(touching):
        depth, way = _box_depth(*(value[touching] for value in (r1, p1, h1, r2, p2, h2)))
        far[touching] = -depth
        # The deepest point of the first box, and its foot on the second one's face.
        local = np.einsum("nij,ni->nj", r1[touching], way)
        deepest = np.einsum("nij,nj->ni", r1[touching], -np.sign(local) * h1[touching])
        first[touching] = p1[touching] + deepest
        second[touching] = first[touching] + depth[:, None] * way
    return far, first, second


def _edges_box(r1: Array, p1: Array, h1: Array, r2: Array, p2: Array, h2: Array) -> Distances:
    """Return the distances of the first box's edges from the second box, and the points."""
    into = np.einsum("nji,njk->nik", r2, r1)
    origin = np.einsum("nji,nj->ni", r2, p1 - p2)
    ends = origin[:, None, None, :] + np.einsum(
        "nik,nepk->nepi", into, _EDGES[None] * h1[:, None, None, :]
    )
    start, way = ends[:, :, 0], ends[:, :, 1] - ends[:, :, 0]
    half = np.broadcast_to(h2[:, None, :], start.shape)
    squared, t = segment_in_box(start, way, half)
    best = squared.argmin(axis=1)
    rows = np.arange(len(p1))
    at = start[rows, best] + t[rows, best, None] * way[rows, best]
    foot = np.clip(at, -h2, h2)
    to_world = "nij,nj->ni"
    return (
        np.sqrt(squared[rows, best]),
        p2 + np.einsum(to_world, r2, at),
        p2 + np.einsum(to_world, r2, foot),
    )


def _box_depth(
    r1: Array, p1: Array, h1: Array, r2: Array, p2: Array, h2: Array
) -> tuple[Array, Array]:
    """Return depth and direction that moves the first of two boxes out of the second."""
    a, b = np.swapaxes(r1, 1, 2), np.swapaxes(r2, 1, 2)
    crossed = np.cross(a[:, :, None, :], b[:, None, :, :]).reshape(len(p1), 9, 3)
    length = np.linalg.norm(crossed, axis=2)
    usable = length > 1e-9
    crossed = crossed / np.where(usable, length, 1.0)[..., None]
    ways = np.concatenate([a, b, crossed], axis=1)
    apart = np.einsum("nwi,ni->nw", ways, p1 - p2)
    extent = (np.abs(np.einsum("nwi,nai->nwa", ways, a)) * h1[:, None, :]).sum(axis=2) + (
        np.abs(np.einsum("nwi,nai->nwa", ways, b)) * h2[:, None, :]
    ).sum(axis=2)
    depth = extent - np.abs(apart)
    depth[:, 6:] = np.where(usable, depth[:, 6:], np.inf)
    best = depth.argmin(axis=1)
    rows = np.arange(len(p1))
    way = ways[rows, best] * np.where(apart[rows, best] < 0, -1.0, 1.0)[:, None]
    return depth[rows, best], way
