"""Volumes of zones as shapes."""

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.collision.pairs import zone_shapes
from rapidgen.config.zones import ZoneCylinderKeys, ZoneKeys, ZoneSphereKeys

CYLINDER = ZoneCylinderKeys([100.0, -200.0, 50.0], 300.0, 400.0)
SPHERE = ZoneSphereKeys([100.0, -200.0, 250.0], 300.0)


def depth(points, shapes):
    """Return how far points (n, 3) are in front of half-spaces, at least."""
    normals = np.array([frames.rotate(shape.pose[1], (0.0, 0.0, 1.0)) for shape in shapes])
    places = np.array([shape.pose[0] for shape in shapes])
    return (np.einsum("ni,si->ns", points, normals) - (places * normals).sum(axis=1)).min(axis=1)


def inside(points, volume):
    """Return how far points are within a volume, by its own formula; 0 at its border."""
    centre = np.array(getattr(volume, "base", None) or volume.centre) / 1000
    way = points - centre
    if volume is SPHERE:
        return 0.3 - np.linalg.norm(way, axis=1)
    across = 0.3 - np.linalg.norm(way[:, :2], axis=1)
    return np.minimum(across, np.minimum(way[:, 2], 0.4 - way[:, 2]))


@pytest.mark.parametrize(
    ("zone", "lost"),
    [
        (ZoneKeys("inside", cylinder=CYLINDER), 0.002),
        (ZoneKeys("inside", sphere=SPHERE), 0.01),
    ],
)
def test_planes_of_a_volume_to_stay_in_leave_out_its_rim_only(zone, lost):
    volume = zone.cylinder or zone.sphere
    random = np.random.default_rng(1)
    points = np.array([0.1, -0.2, 0.25]) + random.uniform(-0.4, 0.4, (20_000, 3))
    allowed = depth(points, zone_shapes(zone)) > 0
    truly = inside(points, volume)
    assert (truly[allowed] > 0).all()
    assert allowed[truly > 0.3 * lost].all()


@pytest.mark.parametrize(
    ("zone", "kind", "place"),
    [
        (ZoneKeys("out", cylinder=CYLINDER), "cylinder", (0.1, -0.2, 0.25)),
        (ZoneKeys("out", sphere=SPHERE), "sphere", (0.1, -0.2, 0.25)),
    ],
)
def test_volume_to_keep_out_of_is_one_shape(zone, kind, place):
    (shape,) = zone_shapes(zone)
    assert shape.kind == kind
    assert shape.pose[0] == pytest.approx(place)
