"""The proof between samples against dense samples of the same path."""

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.chain import along, steps_of
from rapidgen.collision import shapes
from rapidgen.collision.path import Path
from rapidgen.collision.proof import prove
from rapidgen.collision.robot import frames_of_chain
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.tree import WORLD, Tree
from rapidgen.config.load import load_config


@pytest.fixture(scope="module")
def group():
    return load_config("irb120").groups[0]


@pytest.fixture(scope="module")
def robot(group):
    return frames_of_chain(group, frames.IDENTITY, 0, 0)


@pytest.fixture(scope="module")
def tree(group, robot):
    return Tree(robot.nodes, len(group.joints))


def scene_of(tree, shape, node, obstacle, clearance=0.0):
    bodies = [Body("tool", node, (shape,)), Body("object", WORLD, (obstacle,))]
    return Scene(tree, bodies, [Pair(0, 1, clearance)])


@pytest.mark.parametrize("model", ["irb120", "irb120_track", "irb660", "irb14000"])
def test_tree_has_the_flange_of_the_chain(model):
    """Among them a prismatic base axis, passive joints and seven axes."""
    group = load_config(model).groups[0]
    base = ((0.1, -0.2, 0.3), frames.about((0.0, 0.0, 1.0), 0.5))
    robot = frames_of_chain(group, base, 0, 0)
    tree = Tree(robot.nodes, len(group.joints))
    values = np.random.default_rng(1).uniform(-1, 1, (5, len(group.joints)))
    rotations, positions, _ = tree.poses(values)
    node, flange = robot.flange
    for row, q in enumerate(values.tolist()):
        expected = frames.compose(base, along(steps_of(group, group.chain), tuple(q)))
        at = positions[row, node] + rotations[row, node] @ np.array(flange[0])
        assert at == pytest.approx(expected[0], abs=1e-9)


def random_trial(tree, node, flange, rng):
    start = rng.uniform(-1, 1, tree.columns)
    way = rng.normal(size=tree.columns)
    end = start + way / np.linalg.norm(way) * rng.uniform(0.1, 1.2)
    centre = tree.poses(((start + end) / 2)[None])[1][0, node] + rng.uniform(-0.1, 0.1, 3)
    turn = rng.normal(size=4)
    pose = (tuple(centre.tolist()), tuple((turn / np.linalg.norm(turn)).tolist()))
    plate = shapes.box(*rng.uniform(0.01, 0.3, 2), 0.001, pose)
    needle = shapes.capsule(0.001, 0.1, frames.compose(flange, ((0, 0, 0.05), frames.UNIT)))
    path = Path.linear(np.array([0.0, 1.0]), np.stack([start, end]))
    return path, needle, plate


def test_proof_misses_no_contact_with_a_thin_plate(tree, robot):
    """`tools/collision_trials.py` runs 10,000 of these."""
    rng = np.random.default_rng(7)
    node, flange = robot.flange
    contacts = 0
    for _ in range(60):
        path, needle, plate = random_trial(tree, node, flange, rng)
        scene = scene_of(tree, needle, node, plate)
        proof = prove(path, scene)
        far = scene.body_distances(path.at(np.linspace(0, 1, 1001)))[:, 0]
        touching = np.flatnonzero(far <= 0)
        if len(touching):
            contacts += 1
            first = proof.violations[0]
            assert first.verdict == "contact"
            assert first.time <= touching[0] / 1000 + 0.005
        else:
            assert proof.is_free or far.min() < 0.001
    assert contacts > 5


def test_sampling_at_12_ms_misses_what_the_proof_finds(tree, robot):
    """A needle crosses a plate of 1 mm at 2 m/s: 24 mm between samples."""
    node, flange = robot.flange
    needle = shapes.sphere(0.001, frames.compose(flange, ((0, 0, 0.1), frames.UNIT)))
    path = Path.linear(
        np.array([0.0, 1.0]), np.array([[-1.0, 0.5, 0, 0, 0.3, 0], [1.0, 0.5, 0, 0, 0.3, 0]])
    )
    at = scene_of(tree, needle, node, shapes.box(1, 0.001, 1, ((0.5, 0.0043, 0.4), frames.UNIT)))
    samples = np.linspace(0, 1, 84)
    assert at.body_distances(path.at(samples)).min() > 0
    proof = prove(path, at)
    assert proof.violations[0].verdict == "contact"
    assert proof.violations[0].time == pytest.approx(0.5, abs=0.01)


def test_too_near_and_contact_are_different_verdicts(tree, robot):
    """The needle passes a wall at 4 mm and touches it later."""
    node, flange = robot.flange
    ball = shapes.sphere(0.01, flange)
    path = Path.linear(np.array([0.0, 1.0]), np.array([[0.0] * 6, [0.8, 0, 0, 0, 0, 0]]))
    ends = scene_of(tree, ball, node, shapes.half_space((0, -1, 0), (0, 0, 0)))
    reach = float(np.linalg.norm(tree.poses(np.zeros((1, 6)))[1][0, node, :2])) + flange[0][0]
    far = ends.body_distances(path.at(np.array([1.0])))[0, 0]
    assert far < 0
    wall = shapes.half_space((0, -1, 0), (0, reach * np.sin(0.8) + 0.01 + 0.003, 0))
    near = prove(path, scene_of(tree, ball, node, wall, clearance=0.005))
    assert [v.verdict for v in near.violations] == ["too near"]
    assert prove(path, scene_of(tree, ball, node, wall, clearance=0.002)).is_free
    through = shapes.half_space((0, -1, 0), (0, reach * np.sin(0.8), 0))
    touch = prove(path, scene_of(tree, ball, node, through, clearance=0.005))
    assert [v.verdict for v in touch.violations] == ["contact"]
    assert touch.violations[0].normal == pytest.approx((0, -1, 0), abs=1e-6)


def test_gliding_body_needs_few_postures(tree, robot):
    """0.5 mm above the clearance; the plain bound alone needs 4,000 postures."""
    node, flange = robot.flange
    box = shapes.box(0.06, 0.06, 0.12, frames.compose(flange, ((0, 0, 0.06), frames.UNIT)))
    q = [0.3, 0.1, 0.0, 1.0, 0.0]
    path = Path.linear(np.array([0.0, 1.0]), np.array([[-1.5, *q], [1.5, *q]]))
    floor = scene_of(tree, box, node, shapes.half_space((0, 0, 1)))
    height = floor.body_distances(path.at(np.array([0.0])))[0, 0]
    at = shapes.half_space((0, 0, 1), (0, 0, float(height) - 0.0055))
    proof = prove(path, scene_of(tree, box, node, at, clearance=0.005))
    assert proof.is_free
    assert proof.postures <= 100
    lower = shapes.half_space((0, 0, 1), (0, 0, float(height) - 0.0045))
    assert not prove(path, scene_of(tree, box, node, lower, clearance=0.005)).is_free


def test_self_pair_uses_only_joints_between(tree, robot):
    """Axis 1 turns both bodies: one posture of each interval proves them."""
    first = Body("one", 0, (shapes.sphere(0.05),), "r", "link")
    node, flange = robot.flange
    second = Body("two", node, (shapes.sphere(0.05, flange),), "r", "link")
    scene = Scene(tree, [first, second], [Pair(0, 1, 0.01)])
    path = Path.linear(
        np.array([0.0, 1.0]), np.array([[-2.5, 0, 0, 0, 0, 0], [2.5, 0, 0, 0, 0, 0]])
    )
    assert prove(path, scene).postures == 1


def test_curve_between_samples_is_inside_the_slack():
    times = np.arange(0, 1, 0.02)
    path = Path.sampled(times, np.sin(times * 3)[:, None])
    u = np.linspace(0, path.last, 4000)
    true = np.sin(np.interp(u, np.arange(len(times)), times) * 3)
    segment = np.minimum(u.astype(int), path.last - 1)
    assert (np.abs(path.at(u)[:, 0] - true) <= path.slack[segment, 0] + 1e-12).all()


def test_ranges_enclose_the_path():
    rng = np.random.default_rng(2)
    path = Path.linear(np.arange(20.0), np.cumsum(rng.normal(size=(20, 3)), axis=0))
    start, end = np.array([0.0, 3.0, 7.25, 11.0]), np.array([3.0, 7.25, 7.5, 19.0])
    middle = np.array([2.0, 5.0, 7.3, 14.0])
    q, delta, line, rest = path.ranges(start, end, middle)
    for i in range(4):
        away = path.at(np.linspace(start[i], end[i], 400)) - q[i]
        assert (np.abs(away) <= delta[i] + 1e-12).all()
        size = np.linalg.norm(line[i])
        share = away @ line[i] / size**2
        assert np.abs(share).max() <= 1 + 1e-9
        assert (np.abs(away - share[:, None] * line[i]) <= rest[i] + 1e-9).all()
