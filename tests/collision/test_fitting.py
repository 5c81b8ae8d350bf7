"""Convex parts that cover a mesh, and the URDF that holds them."""

import numpy as np
import pytest

from rapidgen.cli.app import main
from rapidgen.collision.fitted_urdf import stl_bytes
from rapidgen.collision.fitting import _clip, fit_parts
from rapidgen.collision.meshes import is_open, triangles_of
from rapidgen.collision.world import build_world, sources_of
from rapidgen.config.cell import load_cell
from rapidgen.config.load import load_config

pytest.importorskip("coal")


def block(low, high):
    """Triangles (12, 3, 3) of a box."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    faces = [
        (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3),
    ]  # fmt: skip
    points = np.array(low) + corners * (np.array(high) - np.array(low))
    quads = [(a, b, c) for a, b, c, _ in faces] + [(a, c, d) for a, _, c, d in faces]
    return points[np.array(quads)]


@pytest.fixture(scope="module")
def bracket():
    """An L of two blocks, 300 mm high and wide and 100 mm thick."""
    return np.concatenate([block((0, 0, 0), (0.3, 0.1, 0.1)), block((0, 0, 0.1), (0.1, 0.1, 0.3))])


@pytest.fixture(scope="module")
def fitted(bracket):
    return fit_parts(bracket)


def test_parts_of_a_bracket_cover_it_closely(fitted):
    """The hull's slope is 0.2 sin 45 deg / 2 = 0.141 / 2 away from the inner corner."""
    assert fitted.hull == pytest.approx(0.1, abs=0.05)
    assert fitted.over <= fitted.hull / 2
    assert fitted.under == 0.0
    assert 2 <= len(fitted.parts) <= 8


@pytest.mark.long
def test_parts_leave_a_blind_hole_open():
    """No single cut of a round hole saves anything."""
    turn = np.linspace(0, 2 * np.pi, 25)
    inner, outer = (r * np.stack([np.cos(turn), np.sin(turn), 0 * turn], 1) for r in (0.04, 0.1))
    up, down = np.array([0, 0, 0.03]), np.array([0, 0, -0.02])
    middle = np.zeros_like(inner)
    strips = [
        (middle, inner), (inner, inner + up), (inner + up, outer + up), (outer + up, outer + down),
        (outer + down, middle + down),
    ]  # fmt: skip
    triangles = []
    for low, high in strips:
        for i in range(24):
            triangles += [(low[i], low[i + 1], high[i + 1]), (low[i], high[i + 1], high[i])]
    fitted = fit_parts(np.array(triangles)[:, ::-1])
    assert fitted.hull == pytest.approx(0.03, abs=0.001)
    assert fitted.over <= fitted.hull / 2
    assert fitted.under == 0.0


def test_one_part_is_the_hull(bracket):
    one = fit_parts(bracket, most=1)
    assert len(one.parts) == 1
    assert one.over == one.hull


def test_cut_keeps_every_point_of_the_surface(bracket):
    normal = np.array([0.6, 0.0, 0.8])
    below, above = _clip(bracket, normal, 0.12)

    def area(triangles):
        edges = triangles[:, 1:] - triangles[:, :1]
        return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2

    assert area(below) + area(above) == pytest.approx(area(bracket))
    assert (below @ normal).max() <= 0.12 + 1e-12
    assert (above @ normal).min() >= 0.12 - 1e-12


def test_part_is_written_as_a_closed_mesh(fitted, tmp_path):
    (tmp_path / "part.stl").write_bytes(stl_bytes(fitted.parts[0]))
    assert not is_open(triangles_of(tmp_path / "part.stl"))


@pytest.fixture(scope="module")
def described(folder, bracket):
    """The description with a bracket as the visual of link_3."""
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    table = np.zeros(len(bracket), record)
    table["corners"] = bracket
    data = bytes(80) + len(bracket).to_bytes(4, "little") + table.tobytes()
    (folder / "bracket.stl").write_bytes(data)
    text = (folder / "arm.urdf").read_text()
    head, link, rest = text.partition('<link name="link_3">')
    visual = '<visual><geometry><mesh filename="bracket.stl"/></geometry></visual>'
    (folder / "meshed.urdf").write_text(head + link + visual + rest)
    return folder / "meshed.urdf"


def test_fit_shapes_writes_a_urdf_that_a_cell_uses(described, cell, folder, capsys):
    output = folder / "shapes"
    words = ["fit-shapes", str(described), "--output", str(output), "--parts", "4"]
    assert main(words) == 0
    assert "link_3" in capsys.readouterr().out
    assert main(words) == 2
    assert "RG836" in capsys.readouterr().err
    robots = "robots:\n  T_ROB1: {model: robot.yaml, shapes: shapes/irb120.urdf}"
    read = load_cell(cell(robots=robots))
    group = load_config(read.robots["T_ROB1"].model).groups[0]
    world = build_world(read, sources_of(read, [group]))
    shapes = {body.name: body.shapes for body in world.scene.bodies}
    assert {shape.kind for shape in shapes["link_3"]} == {"hull"}
    assert len(shapes["link_3"]) > 1


def test_fit_shapes_without_meshes_is_rejected(folder, capsys):
    assert main(["fit-shapes", str(folder / "arm.urdf"), "-o", str(folder / "none")]) == 2
    assert "RG836" in capsys.readouterr().err
    assert not (folder / "none").exists()
