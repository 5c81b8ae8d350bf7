"""Reading and resampling of curves, and what is rejected."""

import math
from pathlib import Path

import numpy as np
import pytest

from rapidgen.curves.curve import read_curve
from rapidgen.diagnostics import DiagnosticError


def written(folder: Path, rows, name="curve.csv"):
    """Write rows of numbers; return the file."""
    path = folder / name
    path.write_text("\n".join(",".join(map(repr, row)) for row in rows), encoding="utf-8")
    return path


def arc(radius=200.0, step=10.0, degrees=90.0):
    """Rows along a horizontal circle, mm, normals up."""
    count = round(math.radians(degrees) * radius / step)
    turns = [math.radians(degrees) * k / count for k in range(count + 1)]
    return [(radius * math.cos(a), radius * math.sin(a), 0.0, 0.0, 0.0, 1.0) for a in turns]


def test_spline_between_distant_points_is_the_circle(tmp_path):
    curve = read_curve(written(tmp_path, arc()))
    radii = np.linalg.norm(curve.positions[:, :2], axis=1)
    assert curve.length == pytest.approx(0.2 * math.pi / 2, abs=1e-5)
    # The ends of a natural spline are straight; 10 mm from them it is the circle.
    assert np.abs(radii[20:-20] - 0.2).max() < 2e-5
    steps = np.linalg.norm(np.diff(curve.positions, axis=0), axis=1)
    assert np.ptp(steps) < 1e-6


def test_normals_turn_at_constant_rate(tmp_path):
    rows = [(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (100.0, 0.0, 0.0, 0.0, 1.0, 0.0)]
    curve = read_curve(written(tmp_path, rows))
    _, axes, _ = curve.at(np.array([0.025, 0.05]))
    assert axes[0] == pytest.approx([0, math.sin(math.pi / 8), math.cos(math.pi / 8)], abs=1e-6)
    assert axes[1] == pytest.approx([0, math.sqrt(0.5), math.sqrt(0.5)], abs=1e-6)


def test_inward_turns_the_tool_against_the_normals(tmp_path):
    curve = read_curve(written(tmp_path, arc()), inward=True)
    assert curve.axes[0] == pytest.approx([0, 0, -1])


def test_beyond_its_ends_a_curve_is_straight(tmp_path):
    curve = read_curve(written(tmp_path, arc()))
    places, axes, _ = curve.at(np.array([-0.1, curve.length + 0.1]))
    assert places[0] == pytest.approx([0.2, -0.1, 0.0], abs=2e-3)
    assert places[1] == pytest.approx([-0.1, 0.2, 0.0], abs=2e-3)
    assert axes[1] == pytest.approx([0, 0, 1])


def test_poses_keep_the_rotation_about_the_tool(tmp_path):
    rows = [(0.0, 0, 0, 1, 0, 0, 0), (50.0, 0, 0, 1, 0, 0, 0), (100.0, 0, 0, 0, 0, 0, 1)]
    curve = read_curve(written(tmp_path, rows))
    assert curve.is_pose
    _, _, side = curve.at(np.array([0.05, 0.1]))
    assert side[0] == pytest.approx([1, 0, 0], abs=1e-6)
    assert side[1] == pytest.approx([-1, 0, 0], abs=1e-6)


def test_header_and_comments_are_skipped(tmp_path):
    path = tmp_path / "c.csv"
    path.write_text("# part 7\nx,y,z,nx,ny,nz\n0 0 0 0 0 1\n10;0;0;0;0;1\n", encoding="ascii")
    assert read_curve(path).points == 2


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("", "RG782", 1),
        ("x,y,z,nx,ny,nz\n", "RG782", 1),
        ("x,y,z,a,b,c\n0,0,0,0,0,1\n", "RG781", 1),
        ("0,0,0,0,0,1\n5,0,nan,0,0,1\n", "RG781", 2),
        ("0,0,0,0,0,1\n5,0,inf,0,0,1\n", "RG781", 2),
        ("0,0,0,0,0,1\n5,0,0,0,0,2\n", "RG781", 2),
        ("0,0,0,0,0,1\n5,0,0,0,0\n", "RG781", 2),
        ("0,0,0,0,0,1\n5,0,zero,0,0,1\n", "RG781", 2),
        ("0,0,0\n5,0,0\n", "RG781", 1),
        ("0,0,0,0,0,1\n0,0,0,0,0,1\n", "RG783", 1),
        ("0,0,0,0,0,1\n30000,0,0,0,0,1\n", "RG783", 1),
        ("0,0,0,1,0,0\n50,0,0,1,0,0\n", "RG782", 1),
    ],
)
def test_bad_curve_is_rejected_with_its_line(tmp_path, text, code, line):
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="ascii")
    with pytest.raises(DiagnosticError) as raised:
        read_curve(path)
    found = raised.value.diagnostics[0]
    assert (found.code, found.span.line) == (code, line)


@pytest.mark.parametrize(("unit", "fix"), [("mm", "--unit m"), ("m", "--unit mm")])
def test_wrong_unit_names_the_right_one(tmp_path, unit, fix):
    """30 m in one unit are 30 mm in the other."""
    size = 0.3 if unit == "mm" else 300.0
    path = written(tmp_path, [(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (size, 0.0, 0.0, 0.0, 0.0, 1.0)])
    with pytest.raises(DiagnosticError) as raised:
        read_curve(path, unit)
    assert fix in raised.value.diagnostics[0].help


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", None])
def test_what_is_no_text_file_is_rejected(tmp_path, data):
    path = tmp_path / "c.csv"
    if data is None:
        path.mkdir()
    else:
        path.write_bytes(data)
    with pytest.raises(DiagnosticError, match="RG780"):
        read_curve(path)
