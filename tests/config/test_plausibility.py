"""Implausible loads, frames and axis figures: findings with places."""

import pytest

from rapidgen.config import load_config
from rapidgen.config.cell import load_cell
from rapidgen.config.manifest import group_from_manifest, group_to_manifest
from rapidgen.config.model_cache import shipped_groups
from rapidgen.config.plausibility import Arm, arm_of, load_doubts
from rapidgen.config.registry import shipped_names
from rapidgen.config.variant_group import group_of
from rapidgen.config.variant_library import variants
from rapidgen.diagnostics import DiagnosticError, Severity
from tests.config.drawing import drawn

LOAD = "model: irb120\ntool: {{name: g, load: {}}}\n"
TOOL = "model: irb120\ntool: {{name: g, frame: {{position: {}}}, load: {{mass: 1}}}}\n"
OBJECT = "model: irb120\nwork_object: {{name: w, {}}}\n"


def findings(tmp_path, text):
    path = tmp_path / "robot.yaml"
    path.write_text(text)
    try:
        return load_config(path).diagnostics
    except DiagnosticError as fault:
        return fault.diagnostics


ERROR, WARNING = Severity.ERROR, Severity.WARNING


@pytest.mark.parametrize(
    ("text", "code", "severity", "words"),
    [
        (LOAD.format("{mass: -1}"), "RG006", ERROR, "at least 0, not -1"),
        (LOAD.format("{mass: 0}"), "RG014", ERROR, "weighs nothing"),
        (LOAD.format("{mass: 3.1}"), "RG070", WARNING, "3.1 kg is more than the 3 kg payload of"),
        (LOAD.format("{mass: 1200}"), "RG070", ERROR, "more than the 3 kg payload of irb120"),
        (LOAD.format("{mass: 1, centre: [0, 0, 0.05]}"), "RG070", WARNING, "0.05 mm away"),
        (LOAD.format("{mass: 1, centre: [0, 0, 500]}"), "RG070", WARNING, "half the arm's reach"),
        (LOAD.format("{mass: 1, centre: [0, 0, 50000]}"), "RG070", ERROR, "50000 mm away"),
        (LOAD.format("{mass: 1, inertia: [-0.1, 0, 0]}"), "RG070", ERROR, "inertia of -0.1"),
        (LOAD.format("{mass: 1, inertia: [0, 0, 0.1]}"), "RG070", ERROR, "sum of the others"),
        (LOAD.format("{mass: 1, inertia: [0.2, 0.2, 0.2]}"), "RG070", WARNING, "radius of 447"),
        (LOAD.format("{mass: 1, inertia: [900, 900, 90]}"), "RG070", ERROR, "radius of 30000 mm"),
        (LOAD.format("{mass: 1, axes: [1, 1, 0, 0]}"), "RG014", ERROR, "not a unit quaternion"),
        (TOOL.format("[0, 0, 0.12]"), "RG071", WARNING, "[0, 0, 0.12] is a shift of 0.12 mm"),
        (TOOL.format("[0, 0, 900]"), "RG071", WARNING, "900 mm from the flange"),
        (TOOL.format("[0, 0, 12000]"), "RG071", ERROR, "the arm reaches 652 mm"),
        (OBJECT.format("user_frame: {position: [0.4, 0, 0]}"), "RG071", WARNING, "0.4 mm"),
        (OBJECT.format("object_frame: {position: [9000, 0, 0]}"), "RG071", WARNING, "9000 mm away"),
        (
            OBJECT.format("held: true, object_frame: {position: [900, 0, 0]}"),
            "RG071",
            WARNING,
            "900 mm from the flange",
        ),
        ("model: irb120\njoints: {joint_1: {speed: 0.5}}\n", "RG071", WARNING, "no speed of an"),
        (
            "model: irb120\njoints: {joint_1: {lower: -2.88, upper: 2.88}}\n",
            "RG071",
            WARNING,
            "a way of 5.76 deg",
        ),
        ("model: irb120\nmax_payload: 3000\n", "RG070", WARNING, "3000 kg is more than any robot"),
        ("model: irb120\njoints: {joint_1: {offset: 1.5708}}\n", "RG071", WARNING, "1.5708 deg"),
        ("model: irb120\njoints: {joint_1: {acceleration: 5}}\n", "RG071", ERROR, "in 50 s"),
        ("model: irb120\njoints: {joint_1: {acceleration: 43}}\n", "RG071", ERROR, "in 5.81 s"),
        (
            "model: irb120_track\njoints: {track: {lower: 0, upper: 3}}\n",
            "RG071",
            WARNING,
            "a way of 3 mm",
        ),
        ("model: irb120_track\njoints: {track: {speed: 0.9}}\n", "RG071", WARNING, "0.9 mm/s"),
    ],
)
def test_implausible_figure_is_reported(tmp_path, text, code, severity, words):
    found = [d for d in findings(tmp_path, text) if d.code == code]
    assert [d.severity for d in found] == [severity]
    assert words in found[0].message
    assert found[0].help
    assert found[0].span.path.endswith("robot.yaml")
    assert found[0].span.line == 2


@pytest.mark.parametrize(
    "text",
    [
        LOAD.format("{mass: 3, centre: [40, 0, 60], inertia: [0.02, 0.02, 0.005]}"),
        LOAD.format("{mass: 0.001, centre: [0, 0, 0.001]}"),  # that of tool0
        TOOL.format("[-0.3, 0.4, 349]"),
        OBJECT.format("user_frame: {position: [5000, 0, 0]}"),
        "model: irb120\nmax_payload: 4\ntool: {name: g, load: {mass: 4}}\n",
    ],
)
def test_figures_of_real_robots_are_plausible(tmp_path, text):
    assert findings(tmp_path, text) == ()


def test_an_arm_in_metres_is_refused(tmp_path):
    lines = ["coupling: 0", "joints:"]
    for n in range(1, 7):
        lines.append(f"  joint_{n}: {{axis: rax_{n}, lower: -90, upper: 90, speed: 100}}")
    lines.append("chain:")
    for n, x in enumerate((0.29, 0.27, 0.07, 0.302, 0.072, 0.05), 1):
        lines.append(f"  - {{joint: joint_{n}, xyz: [{x}, 0, 0], rpy: [0, 1.5708, 0]}}")
    found = findings(tmp_path, "\n".join(lines))
    assert [d.code for d in found if d.severity is ERROR] == ["RG062"]
    assert sum(d.code == "RG071" and "90" in d.help for d in found) == 6


def test_a_robot_that_is_recognised_has_its_payload(tmp_path):
    (tmp_path / "robot.urdf").write_text(drawn("irb120"))
    joints = ", ".join(f"joint_{n}: {{axis: rax_{n}}}" for n in range(1, 7))
    text = f"urdf: {{file: robot.urdf}}\njoints: {{{joints}}}\ntool: {{name: g, load: {{mass: 9}}}}"
    (result,) = [d for d in findings(tmp_path, text) if d.code == "RG070"]
    assert "the 3 kg payload of IRB 120-3/0.58" in result.message


def test_payloads_have_sources_and_survive_a_manifest():
    for name in shipped_names():
        for group in shipped_groups(name):
            assert group.max_payload or name == "irb5400"
            assert group_from_manifest(group_to_manifest(group), group) == group
    for variant in variants():
        assert bool(variant.max_payload) == ("max_payload" in dict(variant.sources))
    known = next(v for v in variants() if v.name == "IRB 6700-150/3.2")
    assert group_of(known).max_payload == 150


def test_loads_of_a_cell_are_held_against_its_strongest_robot(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text(
        "robots: {T_ROB1: {model: irb120, base: {position: [0.5, 0, 0]}}}\n"
        "loads: {part: {mass: 4}}\n"
        "tools: {gun: {frame: {position: [0, 0, 0.2]}, load: {mass: 1}}}\n"
    )
    result = load_cell(path).diagnostics
    assert sorted((d.code, d.span.line) for d in result) == [
        ("RG070", 2),
        ("RG071", 1),
        ("RG071", 3),
    ]
    path.write_text("force: {mass: 9000}\n")
    with pytest.raises(DiagnosticError) as fault:
        load_cell(path)
    assert "more than any robot of ABB carries" in str(fault.value)


def test_moments_of_inertia_as_they_are_measured_are_taken():
    arm = arm_of(shipped_groups("irb6640")[0])
    assert list(load_doubts(147.4, (0.047, 0.024, 0.349), (10.342, 16.393, 7.632), arm)) == []
    assert list(load_doubts(1.0, (0.0, 0.0, 0.05), (0.01, 0.01, 0.0205), Arm())) == []
