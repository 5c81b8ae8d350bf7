"""Convex shapes from mesh files.

A file is hostile: its size and its number of triangles are limited, and only points and triangles
are read. STL and OBJ are read here; DAE needs trimesh, which takes 2 s to import.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.collision.shapes import Array
from rapidgen.config.urdf.source import xml_fault

LARGEST = 100_000_000
"""Bytes of a mesh file."""
MOST_TRIANGLES = 2_000_000
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class MeshFault(Exception):
    """A mesh cannot be used; the text gives the reason with figures."""


def triangles_of(path: Path) -> Array:
    """Return the triangles (n, 3, 3) of a mesh, in its own unit. Raises MeshFault."""
    try:
        data = read_foreign(path, LARGEST)
    except TooLarge:
        raise MeshFault(f"it is larger than {LARGEST / 1e6:.0f} MB") from None
    except OSError as fault:
        raise MeshFault(f"it cannot be read: {fault.strerror}") from None
    suffix = path.suffix.lower()
    if suffix == ".stl":
        result = _stl(data)
    elif suffix == ".obj":
        result = _obj(data)
    else:
        result = _dae(data)
    if not len(result):
        raise MeshFault("it has no triangles")
    if len(result) > MOST_TRIANGLES:
        raise MeshFault(f"it has {len(result):,} triangles, at most {MOST_TRIANGLES:,} are used")
    if not np.isfinite(result).all():
        raise MeshFault("it has coordinates that are not finite")
    return result


def _stl(data: bytes) -> Array:
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * count:
        table = np.frombuffer(data, _TRIANGLE, count, 84)
        return table["corners"].astype(np.float64)
    if not data.lstrip().startswith(b"solid"):
        raise MeshFault("it is no STL: its length does not fit its number of triangles")
    points = [
        _numbers(line[6:]) for line in map(bytes.strip, data.splitlines()) if line[:7] == b"vertex "
    ]
    if len(points) % 3:
        raise MeshFault(f"it has {len(points)} corners, which is not a multiple of 3")
    return np.array(points, dtype=np.float64).reshape(-1, 3, 3)


def _numbers(text: bytes) -> list[float]:
    try:
        values = [float(word) for word in text.split()[:3]]
    except ValueError:
        values = []
    if len(values) != 3:
        raise MeshFault("a corner has not three numbers")
    return values


def _obj(data: bytes) -> Array:
    points: list[list[float]] = []
    corners: list[tuple[int, int, int]] = []
    for line in data.splitlines():
        if line.startswith(b"v "):
            points.append(_numbers(line[2:]))
        elif line.startswith(b"f "):
            try:
                own = [int(word.partition(b"/")[0]) for word in line.split()[1:]]
            except ValueError:
                raise MeshFault("a face has a corner that is no number") from None
            own = [index - 1 if index > 0 else len(points) + index for index in own]
            if any(not 0 <= index < len(points) for index in own):
                raise MeshFault("a face has a corner that does not exist")
            corners += [(own[0], b, c) for b, c in pairwise(own[1:])]
    if not corners:
        return np.zeros((0, 3, 3))
    return np.array(points, dtype=np.float64)[np.array(corners, dtype=np.intp)]


def _dae(data: bytes) -> Array:
    fault = xml_fault(data)
    if fault:
        raise MeshFault(fault)
    import io

    import trimesh

    try:
        made = trimesh.load_scene(io.BytesIO(data), file_type="dae").to_mesh()
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, ImportError) as why:
        raise MeshFault(f"it cannot be read: {why}") from None
    return np.asarray(made.triangles, dtype=np.float64)


def is_open(triangles: Array) -> bool:
    """True if an edge of a mesh belongs to one triangle only."""
    points, index = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    corners = index.reshape(-1, 3)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges.sort(axis=1)
    _, counts = np.unique(edges[:, 0] * len(points) + edges[:, 1], return_counts=True)
    return bool((counts == 1).any())
