"""Tracks and positioners: shapes that move with external axes, and objects on links."""

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.chain import along, steps_of
from rapidgen.collision.check import check_path
from rapidgen.collision.path import Path
from rapidgen.collision.world import build_world, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.load import load_config
from rapidgen.diagnostics import DiagnosticError
from tests.docs.tree import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """An IRB 120 on a track, with a rotary positioner, all in one description."""
    path = tmp_path_factory.mktemp("track")
    text = (ROOT / "robots" / "urdf" / "irb120_track.urdf").read_text(encoding="utf-8")
    text = text.replace("<visual>", "<collision>").replace("</visual>", "</collision>")
    (path / "arm.urdf").write_text(text)
    (path / "robot.yaml").write_text("model: irb120_track\nurdf: {file: arm.urdf}\n")
    return path


def world_of(folder, things, shapes="urdf"):
    path = folder / "cell.yaml"
    base = "base: {position: [100, 50, 0]}"
    path.write_text(
        f"robots:\n  T_ROB1: {{model: robot.yaml, shapes: {shapes}, {base}}}\n"
        f"things:\n{things}\ncollision: {{clearance: 5, self_clearance: 0}}\n"
    )
    cell = load_cell(path)
    return build_world(cell, sources_of(cell, load_config(folder / "robot.yaml").groups))


def place(world, name, values):
    """Return the position (3,) of the first shape of a body."""
    scene = world.scene
    index = next(i for i, body in enumerate(scene.bodies) if body.name == name)
    poses = scene.tree.poses(world.to_urdf("rob1", np.array([values])))[:2]
    return scene.places(*poses)[1][0, scene.shapes_of[index].start]


VALUES = (0.2, 0.1, -0.2, 0.3, 0.4, 0.5, 1.1, 0.7)
PART = "  part: {box: [200, 40, 60], on: STN_1, frame: {position: [120, 0, 30]}}"


@pytest.mark.parametrize("shapes", ["urdf", "none"])
def test_part_turns_with_the_positioner(folder, shapes):
    """With a description and without one: the user frame is that of the configuration's chain."""
    world = world_of(folder, f"{PART}\n  post: {{sphere: 20}}", shapes)
    group = load_config(folder / "robot.yaml").groups[0]
    chain = along(steps_of(group, group.positioners[0].chain), VALUES)
    base = ((0.1, 0.05, 0.0), frames.UNIT)
    expected = frames.compose(base, frames.compose(chain, ((0.12, 0.0, 0.03), frames.UNIT)))
    assert place(world, "part", VALUES) == pytest.approx(expected[0], abs=1e-9)


def test_links_move_with_the_track(folder):
    world = world_of(folder, PART)
    moved = [*VALUES[:6], VALUES[6] + 0.5, VALUES[7]]
    far = place(world, "link_5", moved) - place(world, "link_5", VALUES)
    assert far == pytest.approx((0.5, 0, 0), abs=1e-9)


def test_part_on_a_positioner_hits_a_post(folder):
    post = "  post: {box: [30, 30, 400], frame: {position: [1600, 1050, 500]}}"
    world = world_of(folder, f"{PART}\n{post}")
    values = np.zeros((2, 8))
    values[1, 7] = 2.5
    report = check_path(world, Path.linear(np.arange(2.0), world.values({"rob1": values})))
    found = {frozenset(v["bodies"]): v for v in report.as_json()}
    hit = found[frozenset(("part", "post"))]
    # Every millisecond: the first sample below the clearance.
    samples = np.linspace(values[0], values[1], 1001)
    index = [
        i for i, p in enumerate(world.scene.pairs) if set(world.scene.names(i)) == {"part", "post"}
    ]
    far = world.scene.body_distances(world.to_urdf("rob1", samples), index)[:, 0]
    assert hit["verdict"] == "contact"
    assert hit["time"] == pytest.approx(np.flatnonzero(far <= 0)[0] / 1000, abs=0.002)


def test_part_does_not_touch_its_positioner(folder):
    world = world_of(folder, PART)
    pairs = {frozenset(world.scene.names(i)) for i in range(len(world.scene.pairs))}
    assert frozenset(("part", "link_5")) in pairs
    assert "table" in {body.name for body in world.scene.bodies}
    assert frozenset(("part", "table")) not in pairs


def test_cable_package_moves_with_its_link(folder):
    hose = "  hose: {capsule: {radius: 30, length: 200}, on: link_3, frame: {position: [0, 90, 0]}}"
    world = world_of(folder, f"{hose}\n{PART}")
    pairs = {frozenset(world.scene.names(i)) for i in range(len(world.scene.pairs))}
    assert frozenset(("hose", "part")) in pairs
    assert frozenset(("hose", "link_3")) not in pairs
    bodies = {body.name: body for body in world.scene.bodies}
    assert bodies["hose"].node == bodies["link_3"].node
    assert bodies["hose"].owner == "rob1"


@pytest.mark.parametrize(
    ("thing", "code", "help"),
    [
        ("{sphere: 5, on: link_33}", "RG847", "link_3"),
        ("{sphere: 5, on: STN1}", "RG847", "STN_1"),
        ("{half_space: [0, 0, 1], on: STN_1}", "RG832", "box"),
    ],
)
def test_object_on_something_unknown_is_reported(folder, thing, code, help):
    with pytest.raises(DiagnosticError) as caught:
        world_of(folder, f"  a: {thing}")
    (found,) = caught.value.diagnostics
    assert found.code == code
    assert help in found.help
