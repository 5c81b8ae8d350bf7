"""Two robots with a shift of time, against dense samples of all shifts."""

import re
from dataclasses import replace

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.collision import shapes
from rapidgen.collision.check import check_path
from rapidgen.collision.path import Path
from rapidgen.collision.robot import frames_of_chain
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.timing import prove_timing
from rapidgen.collision.tree import Tree
from rapidgen.collision.world import build_world, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.load import load_config
from rapidgen.controller.collisions import CollisionSetup, CollisionWatch
from rapidgen.controller.controller import VirtualController
from tests.docs.tree import ROOT

COLUMNS = {"one": slice(0, 6), "two": slice(6, 12)}
CLEARANCE = 0.01


def two_robots(far):
    """Two IRB 120 that face each other, with a capsule for each of three links and for a tool."""
    group = load_config("irb120").groups[0]
    opposite = ((far, 0.0, 0.0), frames.about((0.0, 0.0, 1.0), np.pi))
    one = frames_of_chain(group, frames.IDENTITY, 0, 0)
    two = frames_of_chain(group, opposite, len(one.nodes), 6)
    bodies = []
    for name, robot, first in (("one", one, 0), ("two", two, 6)):
        for index in (1, 2, 4):
            link = shapes.capsule(0.05, 0.15, ((0.0, 0.0, 0.05), frames.UNIT))
            bodies.append(Body(f"{name}/{index}", first + index, (link,), name, "link"))
        node, flange = robot.flange
        tool = shapes.capsule(0.02, 0.2, frames.compose(flange, ((0.0, 0.0, 0.1), frames.UNIT)))
        bodies.append(Body(f"{name}/tool", node, (tool,), name, "tool"))
    pairs = [Pair(a, b, CLEARANCE) for a in range(4) for b in range(4, 8)]
    return Scene(Tree([*one.nodes, *two.nodes], 12), bodies, pairs)


def random_path(rng):
    spread = np.array([1.2, 0.6, 0.6, 1.0, 1.0, 1.0] * 2)
    return Path.linear(np.arange(4) * 1.5, rng.uniform(-1, 1, (4, 12)) * spread)


def test_every_shift_agrees_with_dense_samples():
    rng = np.random.default_rng(2)
    results = []
    for _ in range(6):
        scene, path, tolerance = two_robots(rng.uniform(0.7, 1.2)), random_path(rng), 0.6
        (timing,) = prove_timing(path, scene, COLUMNS, tolerance)
        times = np.linspace(0, path.times[-1], 91)
        values = path.at(np.interp(times, path.times, np.arange(4.0)))
        i, j = np.nonzero(np.abs(times[:, None] - times) <= tolerance + 1e-9)
        far = scene.body_distances(np.hstack([values[i, :6], values[j, 6:]]))
        near = {int(pair) for pair in np.flatnonzero(far.min(axis=0) <= CLEARANCE)}
        assert {v.pair for v in timing.violations} == near
        if near:
            shifts = np.abs(times[i] - times[j])[(far <= CLEARANCE).any(axis=1)]
            assert timing.proved <= shifts.min() + 1e-9
            assert timing.violations[0].shift == pytest.approx(shifts.min(), abs=0.1)
        contact = {int(pair) for pair in np.flatnonzero(far.min(axis=0) <= 0)}
        assert {v.pair for v in timing.violations if v.verdict == "contact"} == contact
        results.append(bool(near))
    assert set(results) == {True, False}


def test_distant_robots_are_free_for_any_timing():
    (timing,) = prove_timing(random_path(np.random.default_rng(1)), two_robots(2.0), COLUMNS)
    assert timing.proved == np.inf
    assert timing.tolerance == 1.0


def passing():
    """Return a scene and a path: the tools use one place, 2 s after each other."""
    scene = two_robots(0.9)
    away, there = [1.2, 0.3, 0, 0, 0.6, 0], [0.0, 0.5, 0, 0, 0.6, 0]
    rows = [there + away, away + away, away + away, away + there]
    return scene, Path.linear(np.array([0.0, 1.0, 2.0, 3.0]), np.array(rows))


def test_robots_that_take_turns_depend_on_the_shift():
    scene, path = passing()
    (free,) = prove_timing(path, scene, COLUMNS, 0.1)
    assert not free.violations
    (late,) = prove_timing(path, scene, COLUMNS, 3.0)
    assert 0.5 < late.proved < 3.0
    first, second = late.violations[0].times
    assert second - first == pytest.approx(late.violations[0].shift)


def test_shared_clock_needs_no_shift():
    scene, path = passing()
    both = frozenset(COLUMNS)
    (timing,) = prove_timing(path, scene, COLUMNS, 3.0, [(0.0, 3.0, both)])
    assert not timing.violations
    # A common clock between the turns: neither can be in both.
    (timing,) = prove_timing(path, scene, COLUMNS, 3.0, [(1.4, 1.5, both)])
    assert not timing.violations


@pytest.fixture(scope="module")
def yumi(tmp_path_factory):
    """Both arms of a YuMi in one description, with its drawing solids as `<collision>`."""
    folder = tmp_path_factory.mktemp("yumi")
    text = (ROOT / "robots" / "urdf" / "irb14000.urdf").read_text(encoding="utf-8")
    text = text.replace("<visual>", "<collision>").replace("</visual>", "</collision>")
    (folder / "yumi.urdf").write_text(text)
    (folder / "robot.yaml").write_text(
        "model: irb14000\n"
        "groups: {rob_l: {urdf: {file: yumi.urdf}}, rob_r: {urdf: {file: yumi.urdf}}}\n"
    )
    robots = "robots:\n  T_ROB_L: {model: robot.yaml}\n  T_ROB_R: {model: robot.yaml}\n"
    (folder / "cell.yaml").write_text(f"{robots}collision: {{clearance: 1, self_clearance: 0}}\n")
    return folder


def test_arms_of_one_description_stand_on_one_base(yumi):
    cell = load_cell(yumi / "cell.yaml")
    world = build_world(cell, sources_of(cell, load_config(yumi / "robot.yaml").groups))
    names = [body.name for body in world.scene.bodies]
    assert names.count("rob_l/base_link") == 1
    assert "rob_r/base_link" not in names
    assert not [n for n in names if (n[:5], n[-2:]) in (("rob_l", "_r"), ("rob_r", "_l"))]
    pairs = {frozenset(world.scene.names(i)) for i in range(len(world.scene.pairs))}
    assert frozenset(("rob_l/link_6_l", "rob_r/link_6_r")) in pairs
    assert frozenset(("rob_l/base_link", "rob_r/link_1_r")) not in pairs  # a joint connects them


def test_finding_names_both_arms_and_both_times(yumi):
    cell = load_cell(yumi / "cell.yaml")
    world = build_world(cell, sources_of(cell, load_config(yumi / "robot.yaml").groups))
    middle, left, right = np.zeros(7), np.array([1.2, *[0.0] * 6]), np.array([-1.2, *[0.0] * 6])
    postures = {"rob_l": [middle, left, left, left], "rob_r": [right, right, right, middle]}
    values = world.values({name: np.array(rows) for name, rows in postures.items()})
    path = Path.linear(np.arange(4.0), values)
    report = check_path(replace(world, time_tolerance=3.0), path)
    found = [d for d in report.diagnostics if d.code == "RG845"]
    assert re.search(r"rob_l/\w+ at \d\.\d+ s touches rob_r/\w+ at \d\.\d+ s", found[0].message)
    assert "proved for time shifts up to" in found[0].notes[0]
    shifted = [v for v in report.as_json() if "times" in v]
    assert len(shifted) == len(report.timings[0].violations)
    # The default of 1 s, and one clock.
    assert not check_path(world, path).timings[0].violations
    assert check_path(replace(world, time_tolerance=0.0), path).timings == ()


def test_synchronised_movement_of_a_program_is_known(yumi):
    """[mem: MultiMove]"""
    declarations = (
        'PERS tasks both{2} := [["T_ROB_L"],["T_ROB_R"]];\nVAR syncident a;\nVAR syncident b;'
    )
    here = "[[0,-90,30,0,30,0],[0,9E9,9E9,9E9,9E9,9E9]]"
    there = here.replace("[[0,", "[[20,")
    body = (
        f"MoveAbsJ {there}, v1000, fine, tool0;\nSyncMoveOn a, both;\n"
        f"MoveAbsJ {here} \\ID:=1, v1000, fine, tool0;\nSyncMoveOff b;\n"
        f"MoveAbsJ {there}, v1000, fine, tool0;"
    )
    files = {}
    for task in ("T_ROB_L", "T_ROB_R"):
        files[task] = [yumi / f"{task}.mod"]
        text = f"MODULE m{task[-1]}\n{declarations}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
        files[task][0].write_text(text)
    groups = load_config(yumi / "robot.yaml").groups
    with VirtualController.from_files(files, robots=groups, cycle="once", autostart=False) as vc:
        watch = CollisionWatch(vc, CollisionSetup(load_cell(yumi / "cell.yaml")))
        vc.start_program()
        assert vc.run(max_time=60) == "finished"
        ((start, end, names),) = watch.together()
        path = watch.path()
    assert names == {"rob_l", "rob_r"}
    moving = np.abs(np.diff(path.values, axis=0)).sum(axis=1) > 0
    # Of the three moves, the second one is in the interval.
    assert 0.2 < start < end < path.times[-1] - 0.2
    inside = (path.times[:-1] >= start) & (path.times[1:] <= end)
    assert moving[inside].any()
