"""Cells as worlds: shapes, pairs, zones, and faults of the file."""

import numpy as np
import pytest

from rapidgen.cli.app import main
from rapidgen.client.collisions import CellCheck
from rapidgen.collision.check import check_path
from rapidgen.collision.path import Path
from rapidgen.collision.srdf import disabled_pairs, read_srdf, write_srdf
from rapidgen.collision.world import build_world, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.load import load_config
from rapidgen.diagnostics import DiagnosticError

POST = "things:\n  post: {box: [80, 80, 900], frame: {position: [350, 250, 450]}}"
TWO = (
    "robots:\n  T_ROB1: {model: robot.yaml, base: {position: [0, 0, 0]}}\n"
    "  T_ROB2: {model: robot.yaml, base: {position: [1500, 0, 0]}}"
)
TURN = np.array([[0.0, 0.2, 0.1, 0, 0.6, 0], [1.2, 0.2, 0.1, 0, 0.6, 0]])


def world_of(path):
    described = load_cell(path)
    groups = [load_config(keys.model).groups[0] for keys in described.robots.values() if keys.model]
    return build_world(described, sources_of(described, groups))


def codes(path):
    with pytest.raises(DiagnosticError) as caught:
        world_of(path)
    return [d.code for d in caught.value.diagnostics]


def report_of(world, values=TURN, group="rob1"):
    return check_path(
        world, Path.linear(np.arange(float(len(values))), world.values({group: values}))
    )


def test_arm_touches_a_post_on_its_way(cell):
    report = report_of(world_of(cell(POST)))
    first = report.diagnostics[0]
    assert first.code == "RG820"
    assert "touches post at 0." in first.message
    assert {v["bodies"][1] for v in report.as_json()} == {"post"}
    assert report.clearances().between("link_5", "post") < 0


def test_moved_post_is_free_and_the_rest_is_named(cell):
    world = world_of(cell(POST.replace("350, 250", "-400, 250")))
    report = report_of(world)
    assert report.is_free
    assert report.clearances(50).least > 0.01
    assert any("hoses" in text for text in world.unchecked)
    assert "link tool0 of rob1: no shape" in world.unchecked


def test_three_touched_points_place_an_object_like_its_frame(cell):
    placed = world_of(cell(POST))
    points = "points: [[350, 250, 450], [350, 300, 450], [300, 250, 450]]"
    touched = world_of(cell(f"things:\n  post: {{box: [80, 80, 900], {points}}}"))
    values = placed.values({"rob1": TURN})
    far, other = (w.scene.body_distances(values) for w in (placed, touched))
    # x and y of the frame are exchanged, and the box is square.
    assert far == pytest.approx(other, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("things:\n  a: {box: [1, 1, 1], sphere: 5}", ["RG832"]),
        ("things:\n  a: {frame: {position: [1, 2, 3]}}", ["RG832"]),
        ("things:\n  a: {sphere: 5, points: [[0, 0, 0], [1, 0, 0], [2, 0, 0]]}", ["RG832"]),
        ("things:\n  a: {mesh: none.stl, unit: mm}", ["RG827"]),
        ("zones:\n  z: {keep: out, box: {low: [0, 0, 0], high: [1, 1, 1]}, of: [hand]}", ["RG829"]),
    ],
)
def test_faulty_object_is_reported(cell, text, expected):
    assert codes(cell(text)) == expected


def test_mesh_without_unit_or_in_a_wrong_one_is_reported(cell, folder):
    pytest.importorskip("coal")
    write_tetrahedron(folder / "part.stl", 1.0)
    assert codes(cell("things:\n  a: {mesh: part.stl}")) == ["RG825"]
    text = (folder / "arm.urdf").read_text()
    mesh = '<collision><geometry><mesh filename="part.stl"/></geometry></collision></link>'
    (folder / "large.urdf").write_text(text.replace("</link>", mesh, 1))
    write_tetrahedron(folder / "part.stl", 300.0)
    robots = "robots:\n  T_ROB1: {model: robot.yaml, shapes: large.urdf}"
    with pytest.raises(DiagnosticError) as caught:
        world_of(cell(robots=robots))
    assert caught.value.diagnostics[0].code == "RG826"
    assert "0.001" in caught.value.diagnostics[0].help


def write_tetrahedron(path, size, faces=4):
    a, b, c, d = np.array([[0, 0, 0], [size, 0, 0], [0, size, 0], [0, 0, size]])
    triangles = [(a, c, b), (a, b, d), (a, d, c), (b, c, d)][:faces]
    rows = b"".join(
        np.zeros(3, "<f4").tobytes() + np.array(t, "<f4").tobytes() + b"\0\0" for t in triangles
    )
    path.write_bytes(bytes(80) + len(triangles).to_bytes(4, "little") + rows)


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "its length does not fit"),
        (bytes(84), "no triangles"),
        (b"solid x\nvertex 1 2\n", "three numbers"),
        (bytes(80) + b"\xff\xff\xff\xff", "its length does not fit"),
    ],
)
def test_damaged_mesh_is_reported(cell, folder, data, reason):
    pytest.importorskip("coal")
    (folder / "bad.stl").write_bytes(data)
    with pytest.raises(DiagnosticError, match="RG827") as caught:
        world_of(cell("things:\n  a: {mesh: bad.stl, unit: mm}"))
    assert reason in caught.value.diagnostics[0].message


def test_open_mesh_is_noted(cell, folder):
    pytest.importorskip("coal")
    write_tetrahedron(folder / "open.stl", 50.0, faces=3)
    world = world_of(cell("things:\n  a: {mesh: open.stl, unit: mm}"))
    assert [d.code for d in world.diagnostics] == ["RG827"]


def test_unknown_pair_is_reported_with_a_suggestion(cell):
    path = cell(POST)
    path.write_text(path.read_text() + "    link_5 - pots: 3\n")
    with pytest.raises(DiagnosticError, match="RG829") as caught:
        world_of(path)
    assert "post" in caught.value.diagnostics[0].help


def test_two_robots_need_bases(cell):
    two = "robots:\n  T_ROB1: {model: robot.yaml}\n  T_ROB2: {model: robot.yaml}"
    path = cell(robots=two)
    path.write_text(path.read_text().split("collision:")[0])
    described = load_cell(path)
    group = load_config(described.robots["T_ROB1"].model).groups[0]
    from dataclasses import replace

    other = replace(group, name="rob2", task="T_ROB2")
    with pytest.raises(DiagnosticError, match="RG828"):
        build_world(described, sources_of(described, [group, other]))


def test_two_robots_meet_on_one_clock(folder, cell):
    from dataclasses import replace

    two = (
        "robots:\n  T_ROB1: {model: robot.yaml, base: {position: [0, 0, 0]}}\n"
        "  T_ROB2: {model: robot.yaml, base: {position: [700, 0, 0], orientation: [0, 0, 0, 1]}}"
    )
    path = cell(robots=two)
    path.write_text(path.read_text().split("collision:")[0])
    described = load_cell(path)
    group = load_config(described.robots["T_ROB1"].model).groups[0]
    other = replace(group, name="rob2", task="T_ROB2")
    world = build_world(described, sources_of(described, [group, other]))
    between = [
        v
        for v in report_of(world, TURN * 0).as_json()
        if {name.split("/")[0] for name in v["bodies"]} == {"rob1", "rob2"}
    ]
    assert between
    assert between[0]["time"] == pytest.approx(0.0, abs=1e-3)


def test_zone_keeps_the_tcp_inside_and_links_out(cell):
    box = "box: {low: [0, -900, 0], high: [900, 200, 1200]}"
    inside = f"zones:\n  area: {{keep: inside, {box}, of: [tcp]}}"
    report = report_of(world_of(cell(inside)))
    assert {tuple(v["bodies"]) for v in report.as_json()} == {("tcp", "zone area")}
    out = "zones:\n  door: {keep: out, box: {low: [-900, 200, 0], high: [900, 900, 1200]}}"
    assert not report_of(world_of(cell(out))).is_free
    assert report_of(world_of(cell(out)), TURN * 0.1).is_free


def test_overlap_at_home_is_reported_and_still_checked(cell):
    world = world_of(cell("things:\n  block: {sphere: 100, frame: {position: [0, 0, 600]}}"))
    assert "RG823" in [d.code for d in world.diagnostics]
    assert not report_of(world).is_free


def test_links_without_shapes_are_a_warning_if_a_tool_has_some(cell):
    """Drawing solids of shipped models are never used."""
    tool = "tools:\n  tGrip: {load: {mass: 1}, shapes: [{sphere: 50}]}"
    path = cell(f"{tool}\n{POST}", robots="robots:\n  T_ROB1: {model: irb120}")
    path.write_text(path.read_text().split("collision:")[0])
    world = world_of(path)
    assert [d.code for d in world.diagnostics] == ["RG824"]
    assert [world.scene.names(i) for i in range(len(world.scene.pairs))] == [("tGrip", "post")]
    assert any("links of rob1" in text for text in world.unchecked)


def test_cell_without_anything_to_check_is_rejected(cell):
    path = cell(POST, robots="robots:\n  T_ROB1: {model: irb120}")
    path.write_text(path.read_text().split("collision:")[0])
    assert codes(path) == ["RG824", "RG824"]


def test_srdf_is_written_and_read(cell, folder):
    write_srdf(folder / "arm.srdf", "arm", [("link_5", "post", "User")])
    path = cell(POST, collision="collision:\n  srdf: arm.srdf")
    world = world_of(path)
    assert world.allowed[frozenset(("link_5", "post"))] == "SRDF: User"
    assert "link_5" not in {v["bodies"][0] for v in report_of(world).as_json()}


def test_written_srdf_is_read_back_with_the_same_pairs(cell, folder, capsys):
    """[MoveIt: disable_collisions link1 link2 reason]; other elements of a file stay."""
    output = folder / "out.srdf"
    output.write_text(
        '<robot name="mine"><group name="arm"/><disable_collisions link1="a" link2="b"/></robot>'
    )
    assert main(["check", "--cell", str(cell(POST)), "--srdf", str(output)]) == 0
    text = output.read_text()
    assert '<group name="arm"' in text
    assert '<robot name="mine">' in text
    written = set(read_srdf(folder, "out.srdf"))
    assert ("link_3", "link_5", "bars meet in the wrist") in written
    assert ("link_3", "link_4", "Adjacent") in written
    assert not [pair for pair in written if "post" in pair or "a" in pair]
    # The same cell with the SRDF instead of its own pairs checks the same pairs of links.
    before = world_of(cell(POST))
    path = cell(POST, collision="collision:\n  srdf: out.srdf")
    path.write_text(path.read_text().split("\n  pairs:")[0])
    after = world_of(path)
    own, read = (disabled_pairs(w.scene, w.allowed, {"post"}) for w in (before, after))
    assert own == read
    assert {after.scene.names(i) for i in range(len(after.scene.pairs))} == {
        before.scene.names(i) for i in range(len(before.scene.pairs))
    }


def test_srdf_of_two_equal_robots_is_rejected(cell, folder, capsys):
    path = cell(POST, robots=TWO)
    path.write_text(path.read_text().split("collision:")[0])
    assert main(["check", "--cell", str(path), "--srdf", str(folder / "two.srdf")]) == 2
    assert "RG848" in capsys.readouterr().err
    assert not (folder / "two.srdf").exists()
    assert main(["check", "--srdf", str(folder / "two.srdf")]) == 2


def test_second_robot_of_one_configuration_is_in_the_world(cell, folder):
    """A client of one robot sees the other one, although both have the same configuration."""
    path = cell(POST, robots=TWO)
    path.write_text(path.read_text().split("collision:")[0])
    config = load_config(folder / "robot.yaml")
    world = CellCheck(path, config, config.groups[0]).world
    assert {name.split("/")[0] for name in (b.name for b in world.scene.bodies) if "/" in name} == {
        "rob1",
        "rob2",
    }


def test_robot_without_a_model_is_not_checked(cell):
    two = (
        f"{TWO.splitlines()[0]}\n{TWO.splitlines()[1]}\n  T_ROB3: {{base: {{position: [9, 9, 9]}}}}"
    )
    world = world_of(cell(POST, robots=two))
    assert any("T_ROB3" in text for text in world.unchecked)


@pytest.mark.parametrize(("size", "severity"), [(4.0, "warning"), (40.0, "error")])
def test_mesh_of_a_doubtful_size_is_asked_about(cell, folder, size, severity):
    pytest.importorskip("coal")
    text = (folder / "arm.urdf").read_text()
    mesh = '<collision><geometry><mesh filename="size.stl"/></geometry></collision></link>'
    (folder / "size.urdf").write_text(text.replace("</link>", mesh, 1))
    write_tetrahedron(folder / "size.stl", size)
    path = cell(robots="robots:\n  T_ROB1: {model: robot.yaml, shapes: size.urdf}")
    if severity == "error":
        assert codes(path)[0] == "RG826"
    else:
        (found,) = [d for d in world_of(path).diagnostics if d.code == "RG826"]
        assert "is its unit wrong?" in found.help


@pytest.mark.parametrize("text", ["<robot", '<!DOCTYPE a [<!ENTITY b "c">]><robot>&b;</robot>'])
def test_faulty_srdf_is_reported(cell, folder, text):
    (folder / "bad.srdf").write_text(text)
    assert codes(cell(collision="collision:\n  srdf: bad.srdf")) == ["RG833"]


def test_description_of_another_robot_is_reported(cell, folder):
    from tests.docs.tree import ROOT

    (folder / "other.urdf").write_text((ROOT / "robots/urdf/irb2400.urdf").read_text())
    robots = "robots:\n  T_ROB1: {model: robot.yaml, shapes: other.urdf}"
    assert "RG831" in codes(cell(robots=robots))
