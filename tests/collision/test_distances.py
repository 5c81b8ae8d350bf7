"""Closed forms and coal against MuJoCo, which computes distances independently."""

import itertools
import sys

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.collision import hulls, shapes
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.tree import WORLD, Tree

coal = pytest.importorskip("coal")
SIMPLE = ("sphere", "capsule", "box")
MICROMETRE = 1e-6


def random_pose(rng):
    q = rng.normal(size=4)
    q1, q2, q3, q4 = (q / np.linalg.norm(q)).tolist()
    x, y, z = rng.uniform(-0.3, 0.3, 3).tolist()
    return (x, y, z), (q1, q2, q3, q4)


def random_shape(kind, rng):
    a, b, c = rng.uniform(0.04, 0.3, 3).tolist()
    pose = random_pose(rng)
    match kind:
        case "sphere":
            return shapes.sphere(a, pose)
        case "capsule":
            return shapes.capsule(a / 3, b, pose)
        case "box":
            return shapes.box(a, b, c, pose)
        case "cylinder":
            return shapes.cylinder(a / 2, b, pose)
        case "half_space":
            normal, _ = frames.to_axis(pose[1])
            return shapes.half_space(normal, pose[0])
    return shapes.hull(rng.normal(size=(30, 3)) * 0.08, pose)


def scene_of(first, second):
    bodies = [Body(str(i), WORLD, (shape,)) for i, shape in enumerate(first + second)]
    pairs = [Pair(i, len(first) + i, 0.0) for i in range(len(first))]
    return Scene(Tree([], 1), bodies, pairs)


def distances(scene):
    rotations, positions, _ = scene.tree.poses(np.zeros((1, 1)))
    places = scene.places(rotations, positions)
    count = len(scene.pairs)
    return scene.distances(np.arange(count), np.zeros(count, dtype=np.intp), *places)


def geom(spec, shape, name):
    """Add a shape to a MuJoCo model, whose sizes are radius and half lengths."""
    import mujoco

    body = spec.worldbody.add_body(name=f"body {name}", pos=shape.pose[0], quat=shape.pose[1])
    body.add_freejoint()
    kinds = {
        "sphere": (mujoco.mjtGeom.mjGEOM_SPHERE, (*shape.size, 0, 0)),
        "capsule": (
            mujoco.mjtGeom.mjGEOM_CAPSULE,
            (*shape.size[:1], *(x / 2 for x in shape.size[1:]), 0),
        ),
        "box": (mujoco.mjtGeom.mjGEOM_BOX, shape.size),
        "cylinder": (
            mujoco.mjtGeom.mjGEOM_CYLINDER,
            (*shape.size[:1], *(x / 2 for x in shape.size[1:]), 0),
        ),
    }
    if shape.kind == "hull":
        spec.add_mesh(name=name, uservert=shape.vertices.ravel().tolist())
        body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name)
    else:
        kind, size = kinds[shape.kind]
        body.add_geom(name=name, type=kind, size=size)


def of_mujoco(first, second):
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec()
    spec.option.ccd_tolerance = 1e-12
    spec.option.ccd_iterations = 200
    for i, (one, other) in enumerate(zip(first, second, strict=True)):
        geom(spec, one, f"a{i}")
        geom(spec, other, f"b{i}")
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)

    def far(i):
        a, b = model.geom(f"a{i}").id, model.geom(f"b{i}").id
        return mujoco.mj_geomDistance(model, data, a, b, 10.0, np.zeros(6))

    return np.array([far(i) for i in range(len(first))])


@pytest.mark.parametrize(
    ("kind", "other"), list(itertools.combinations_with_replacement(SIMPLE, 2))
)
def test_closed_forms_agree_with_mujoco(kind, other):
    rng = np.random.default_rng(3)
    first = [random_shape(kind, rng) for _ in range(40)]
    second = [random_shape(other, rng) for _ in range(40)]
    far, a, b = distances(scene_of(first, second))
    expected = of_mujoco(first, second)
    free = far > 0
    assert free.sum() > 10
    assert np.abs(far - expected)[free].max() < MICROMETRE
    assert (expected[~free] < MICROMETRE).all()
    assert np.abs(np.linalg.norm(a - b, axis=1) - np.abs(far)).max() < MICROMETRE


@pytest.mark.parametrize("other", ["hull", "box", "capsule"])
def test_hulls_agree_with_mujoco(other):
    rng = np.random.default_rng(5)
    first = [random_shape("hull", rng) for _ in range(25)]
    second = [random_shape(other, rng) for _ in range(25)]
    far = distances(scene_of(first, second))[0]
    free = far > 0
    assert free.sum() > 5
    assert np.abs(far - of_mujoco(first, second))[free].max() < 10 * MICROMETRE


@pytest.mark.parametrize(
    ("kind", "other"),
    [*itertools.combinations_with_replacement(SIMPLE, 2), *((k, "half_space") for k in SIMPLE)],
)
def test_closed_forms_agree_with_coal_in_penetration(kind, other):
    """Signed distance: the depth of a penetration too [coal: enable_signed_distance]."""
    rng = np.random.default_rng(4)
    scene = scene_of(
        [random_shape(kind, rng) for _ in range(100)],
        [random_shape(other, rng) for _ in range(100)],
    )
    places = [values[0] for values in scene.places(*scene.tree.poses(np.zeros((1, 1)))[:2])]
    first, second = ([value[rows] for value in places] for rows in (scene.first, scene.second))
    expected = scene._hulls.distances(scene.first, scene.second, first, second)[0]
    far = distances(scene)[0]
    assert (far < 0).any()
    assert np.abs(far - expected).max() < MICROMETRE


def test_hull_without_coal_names_the_extra(monkeypatch):
    hulls._coal.cache_clear()
    monkeypatch.setitem(sys.modules, "coal", None)
    rng = np.random.default_rng(1)
    with pytest.raises(ModuleNotFoundError, match="coal"):
        distances(scene_of([random_shape("hull", rng)], [random_shape("box", rng)]))
