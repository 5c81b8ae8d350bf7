"""Sources of exported modules: what they become, and how faults are reported."""

from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.axes import frames
from rapidgen.diagnostics import DiagnosticError
from rapidgen.export.sources import (
    JointPath,
    SourceOptions,
    read_gcode,
    read_ros,
    read_table,
)
from rapidgen.export.sources.toolpath import WordAction, tool_orientation

DOWN = SourceOptions(length=0.001, tool_axis=(0.0, 0.0, -1.0), turn=0.0)


def file(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text)
    return path


def gcode(tmp_path, text, options=DOWN):
    return read_gcode(file(tmp_path, "a.nc", text), options).steps


def places(steps):
    return [tuple(round(1000 * v, 4) for v in step.pose[0]) for step in steps if step.pose]


def fault(call):
    with pytest.raises(DiagnosticError) as error:
        call()
    return error.value.diagnostics[0]


# -- G-code: expected values by hand, from RS274/NGC [NIST IR 6556 §3.5] ---------------------------


def test_lines_have_units_modes_and_feeds(tmp_path):
    steps = gcode(
        tmp_path, "G21 G90\nG0 X0 Y0 Z10\nG1 Z0 F600\nX10\nG91 Y5\nG20 X1 F60\nG90 X0 (home)\n"
    )
    assert places(steps) == [(0, 0, 10), (0, 0, 0), (10, 0, 0), (10, 5, 0), (35.4, 5, 0), (0, 5, 0)]
    assert [round(step.speed, 5) for step in steps] == [0.25, 0.01, 0.01, 0.01, 0.0254, 0.0254]
    assert [step.span.line for step in steps] == [2, 3, 4, 5, 6, 7]


@pytest.mark.parametrize(
    ("arc", "degrees", "centre"),
    [
        ("G2 X10 Y10 I10 J0", 90, (10, 0)),
        ("G3 X10 Y10 I0 J10", 90, (0, 10)),
        ("G2 X10 Y10 R10", 90, (10, 0)),
        ("G3 X10 Y10 R10", 90, (0, 10)),
        ("G2 X10 Y10 R-10", 270, (0, 10)),
        ("G3 X0 Y0 I5 J0", 360, (5, 0)),
        ("G90.1 G3 X0 Y0 I5 J0", 360, (5, 0)),
    ],
)
def test_arc_has_its_centre_and_length(tmp_path, arc, degrees, centre):
    start, *arcs = gcode(tmp_path, f"G0 X0 Y0 Z0\nF100 {arc}\n")
    points = [start.pose[0]]
    for step in arcs:
        points += [step.via[0], step.pose[0]]
    radius = hypot(*centre)
    turned = 0.0
    for (a, b, _), (c, d, _) in pairwise(points):
        chord = hypot(c - a, d - b) * 1000
        turned += 2 * np.degrees(np.arcsin(chord / 2 / radius))
    assert turned == pytest.approx(degrees, abs=1e-6)
    for x, y, _ in points:
        assert hypot(1000 * x - centre[0], 1000 * y - centre[1]) == pytest.approx(radius)
    assert len(arcs) == -(-degrees // 120)


def test_planes_are_right_handed(tmp_path):
    """Seen from +y, z points to the right and x upwards (G18): z, x, y are right-handed."""
    _, arc = gcode(tmp_path, "G0 X0 Y0 Z0\nG18 F100 G3 X10 Z10 I10 K0\n")
    assert hypot(1000 * arc.via[0][0] - 10, 1000 * arc.via[0][2]) == pytest.approx(10)
    assert places([arc]) == [(10, 0, 10)]
    assert len(gcode(tmp_path, "G0 X0 Y0 Z0\nG18 F100 G2 X10 Z10 I10 K0\n")) == 4
    _, arc = gcode(tmp_path, "G0 X0 Y0 Z0\nG19 F100 G3 Y10 Z10 J0 K10\n")
    assert hypot(1000 * arc.via[0][1], 1000 * arc.via[0][2] - 10) == pytest.approx(10)


def test_helix_becomes_lines_within_its_tolerance(tmp_path):
    start, *lines = gcode(tmp_path, "G0 X10 Y0 Z0\nG3 F100 X10 Y0 Z-5 I-10 J0\n")
    assert {step.kind for step in lines} == {"line"}
    ends = [start.pose[0], *(step.pose[0] for step in lines)]
    middles = [hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in pairwise(ends)]
    assert min(middles) >= 0.010 - 21e-6
    assert places(lines)[-1] == (10, 0, -5)


@pytest.mark.parametrize("arc", ["G2 X0.05 Y0.05 I0.05", "G3 X10 Y0 I5 J1000"])
def test_short_and_flat_arcs_become_lines(tmp_path, arc):
    """MoveC rejects them."""
    _, *steps = gcode(tmp_path, f"G0 X0 Y0 Z0\nF100 {arc}\n")
    assert {step.kind for step in steps} == {"line"}


def test_work_offsets_keep_the_machine_in_place(tmp_path):
    options = replace(DOWN, offsets={"G54": (0.1, 0, 0), "G55": (0.2, 0, 0)})
    steps = gcode(tmp_path, "G0 X0 Y0 Z0\nG55 G91 X1\n", options)
    assert places(steps) == [(100, 0, 0), (101, 0, 0)]


def test_origin_and_tool_axis(tmp_path):
    origin = (0.3, 0.0, 0.2), frames.from_rpy(0, 0, pi / 2)
    (step,) = gcode(tmp_path, "G0 X10 Y0 Z0\n", replace(DOWN, origin=origin, turn=pi / 2))
    assert places([step]) == [(300, 10, 200)]
    x = frames.rotate(step.pose[1], (1.0, 0.0, 0.0))
    z = frames.rotate(step.pose[1], (0.0, 0.0, 1.0))
    assert np.allclose(z, (0, 0, -1))
    # Along -y of the source by the turn, which the origin turns to +x.
    assert np.allclose(x, (1, 0, 0))


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.3, -0.4, 0.5), (-1, 0, 0)])
def test_tool_axis_is_z_of_the_tool(axis):
    q = tool_orientation(axis, 0.7)
    size = hypot(*axis)
    assert np.allclose(frames.rotate(q, (0.0, 0.0, 1.0)), np.array(axis) / size)


def test_words_of_the_user_act_before_the_motion(tmp_path):
    words = {
        "M3": WordAction("signal", "spindle", 1),
        "S": WordAction("signal", "rate"),
        "M6": WordAction("call", "change"),
        "T": WordAction("ignore"),
    }
    path = file(tmp_path, "a.nc", "G0 X0 Y0 Z0 M03 S900\nM6 T2\nG4 P0.5\n")
    result = read_gcode(path, replace(DOWN, words=words))
    found = [(s.kind, s.name, s.value) for s in result.steps]
    assert found == [
        ("set", "spindle", 1),
        ("set", "rate", 900),
        ("line", "", 0),
        ("call", "change", 0),
        ("wait", "", 0.5),
    ]
    assert result.ignored == ("T2",)


@pytest.mark.parametrize(
    ("text", "code", "line", "report"),
    [
        ("G0 X0 Y0 Z0\nM8\n", "RG762", 2, "'M8' is not supported"),
        ("G0 X0 Y0 Z0 A5\n", "RG762", 1, "'A5'"),
        ("G28\n", "RG762", 1, "'G28'"),
        ("#1=5\n", "RG762", 1, "'#1=5'"),
        ("/G0 X0\n", "RG762", 1, "'/G0'"),
        ("G1 X[1+2]\n", "RG762", 1, "'X[1+2]'"),
        ("G0 X0 Y0\nG1 Z5 F5\n", "RG760", 2, "unknown position"),
        ("G91 G0 X1\n", "RG760", 1, "relative to an unknown position"),
        ("G0 X0 Y0 Z0\nG1 X5\n", "RG760", 2, "without a feed"),
        ("G0 X0 Y0 Z0\nG2 X5 Y0 I1 J0 F9\n", "RG760", 2, "radius 1 mm at its beginning"),
        ("G0 X0 Y0 Z0\nG2 X5 Y0 F9\n", "RG760", 2, "without a centre"),
        ("G0 X0 Y0 Z0\nG2 X9 R1 F9\n", "RG760", 2, "smaller than half"),
        ("X0\n", "RG760", 1, "without a motion"),
        ("G55 G0 X0\n", "RG761", 1, "work offset of G55"),
        ("G0 X0 Y0 Z0\nX30000\n", "RG761", 2, "30 m wide: wrong unit"),
        ("G0 X0 Y0 Z0\nG80 X10\n", "RG760", 2, "without a motion"),
        ("G4\n", "RG760", 1, "without a time"),
        ("(nothing)\n%\n", "RG760", 1, "has no points"),
        ("G0 G1 X1\n", "RG760", 1, "two motions"),
    ],
)
def test_fault_of_gcode_has_its_line(tmp_path, text, code, line, report):
    found = fault(lambda: gcode(tmp_path, text))
    assert (found.code, found.span.line) == (code, line)
    assert report in found.message


def test_gcode_without_unit_or_orientation_is_rejected(tmp_path):
    bare = replace(DOWN, length=None)
    assert "unit of lengths" in fault(lambda: gcode(tmp_path, "G0 X1\n", bare)).message
    assert places(gcode(tmp_path, "G20 G0 X1 Y0 Z0", bare)) == [(25.4, 0, 0)]
    assert (
        "tool's axis" in fault(lambda: gcode(tmp_path, "", replace(DOWN, tool_axis=None))).message
    )
    assert "rotation" in fault(lambda: gcode(tmp_path, "", replace(DOWN, turn=None))).message


@settings(max_examples=150, deadline=None)
@given(st.text("GMXYZIJKRFST0123456789.-+ \n()[]#;%/", max_size=60))
def test_any_text_is_read_or_rejected(tmp_path_factory, text):
    path = tmp_path_factory.getbasetemp() / "fuzz.nc"
    path.write_text(text)
    with suppress(DiagnosticError):
        assert read_gcode(path, DOWN).steps


# -- tables and messages ---------------------------------------------------------------------------


def test_tables_of_poses(tmp_path):
    text = "x,y,z,q1,q2,q3,q4,speed\n# comment\n300,0,400,0,1,0,0,50\n300,10,400,0,-1,0,0,60\n"
    steps = read_table(file(tmp_path, "a.csv", text), SourceOptions(length=0.001)).steps
    assert places(steps) == [(300, 0, 400), (300, 10, 400)]
    assert [(step.speed, step.span.line) for step in steps] == [(0.05, 3), (0.06, 4)]
    normals = file(tmp_path, "b.csv", "0.3 0 0.4 0 0 2\n")
    options = SourceOptions(length=1.0, turn=0.0, columns=("x", "y", "z", "nx", "ny", "nz"))
    (step,) = read_table(normals, options).steps
    assert np.allclose(frames.rotate(step.pose[1], (0, 0, 1)), (0, 0, -1))


def test_quaternions_of_ros_have_the_scalar_last(tmp_path):
    scalar_first = "x,y,z,q1,q2,q3,q4\n1,2,3,0.5,-0.5,0.1,0.7\n4,2,3,0.5,-0.5,0.1,0.7\n"
    of_ros = "x,y,z,qx,qy,qz,qw\n1,2,3,-0.5,0.1,0.7,0.5\n4,2,3,-0.5,0.1,0.7,0.5\n"
    first, second = (
        [step.pose for step in read_table(file(tmp_path, name, text), DOWN).steps]
        for name, text in (("a.csv", scalar_first), ("b.csv", of_ros))
    )
    assert first == second


def test_time_is_time_in_any_case(tmp_path):
    path = file(tmp_path, "a.csv", "Time, a\n0, 0.1\n1, 0.2\n")
    result = read_table(path, SourceOptions())
    assert (result.times, result.names) == ((0.0, 1.0), ("a",))


def test_tables_of_joints(tmp_path):
    with_times = read_table(file(tmp_path, "a.csv", "time,a,b\n0,1,2\n1,3,4\n"), SourceOptions())
    assert isinstance(with_times, JointPath)
    assert (with_times.times, with_times.names, with_times.lines) == ((0, 1), ("a", "b"), (2, 3))
    np.save(tmp_path / "a.npy", np.array([[90.0, 0.0]]))
    options = SourceOptions(angle=pi / 180, columns=("a", "b"))
    loaded = read_table(tmp_path / "a.npy", options)
    assert loaded.steps[0].joints == (pi / 2, 0)
    text = '{"columns": ["a"], "rows": [[1], [2]]}'
    steps = read_table(file(tmp_path, "a.json", text), SourceOptions(angle=1.0)).steps
    assert [step.joints for step in steps] == [(1,), (2,)]


@pytest.mark.parametrize(
    ("name", "text", "code", "line", "report"),
    [
        ("a.csv", "x,y,z\n1,2,nan\n", "RG760", 2, "'nan' is not a finite number"),
        ("a.csv", "x,y,z\n1,2\n", "RG760", 2, "2 values for 3 columns"),
        ("a.csv", "1,2,3\n", "RG760", 1, "no names"),
        ("a.csv", "", "RG760", 1, "no points"),
        ("a.csv", "x,y,z,w\n1,2,3,4\n", "RG760", 1, "column 'w' is unknown"),
        ("a.csv", "x,y,z,q1\n1,2,3,1\n", "RG760", 1, "column 'q2' is missing"),
        ("a.csv", "x,y,z,q1,q2,q3,q4\n1,2,3,2,0,0,0\n", "RG760", 2, "has the length 2"),
        ("a.csv", "x,y,z\n0,0,0\n30000,0,0\n", "RG761", 3, "30 m wide: wrong unit"),
        ("a.csv", "a,b\n1,2\n", "RG761", 2, "unit of angles"),
        ("a.csv", "x,x,y,z\n1,2,3,4\n", "RG760", 1, "there twice"),
        ("a.json", "{", "RG760", 1, "not JSON"),
        ("a.json", "{}", "RG760", 1, "no table"),
    ],
)
def test_fault_of_a_table_has_its_line(tmp_path, name, text, code, line, report):
    found = fault(lambda: read_table(file(tmp_path, name, text), DOWN))
    assert (found.code, found.span.line) == (code, line)
    assert report in found.message


def test_pickled_array_is_rejected(tmp_path):
    np.save(tmp_path / "a.npy", np.array([{"a": 1}], dtype=object), allow_pickle=True)
    found = fault(lambda: read_table(tmp_path / "a.npy", replace(DOWN, columns=("x",))))
    assert "no array of numbers" in found.message


PLAN = """joint_trajectory:
  header: {frame_id: base_link}
  joint_names: [joint_1, joint_2]
  points:
  - positions: [0.0, 0.1]
    velocities: []
    time_from_start: {sec: 0, nanosec: 0}
  - positions: [0.2, 0.1]
    time_from_start:
      secs: 1
      nsecs: 500000000
multi_dof_joint_trajectory:
  joint_names: []
  points: []
---
"""


def test_moveit_plan(tmp_path):
    plan = read_ros(file(tmp_path, "a.yaml", PLAN))
    assert (plan.times, plan.positions) == ((0.0, 1.5), ((0.0, 0.1), (0.2, 0.1)))
    assert plan.lines == (5, 8)
    display = "trajectory:\n- " + PLAN.removesuffix("---\n").replace("\n", "\n  ")
    assert read_ros(file(tmp_path, "b.yaml", display)).times == plan.times


@pytest.mark.parametrize(
    ("old", "new", "line", "report"),
    [
        ("[0.2, 0.1]", "[0.2]", 8, "point 1: 1 positions for 2 joints"),
        ("[0.2, 0.1]", "[.nan, 0.1]", 8, "point 1: a value is not a finite number"),
        ("secs: 1", "mins: 1", 8, "neither sec nor secs"),
        ("points: []\n", "points: [1]\n", 14, "several degrees of freedom"),
        ("joint_names: [joint_1, joint_2]", "", 2, "'joint_names' is not a list"),
    ],
)
def test_fault_of_a_plan_has_its_line(tmp_path, old, new, line, report):
    assert old in PLAN
    found = fault(lambda: read_ros(file(tmp_path, "a.yaml", PLAN.replace(old, new))))
    assert (found.code, found.span.line) == ("RG760", line)
    assert report in found.message
