"""The shipped models: sources, known poses, agreement with URDFs."""

import math
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rapidgen.config import load_config, shipped_names
from rapidgen.config.catalogue import shipped_models
from rapidgen.config.registry import find_shipped, shipped_headings
from rapidgen.config.yaml_tree import parse, to_python
from rapidgen.diagnostics import Severity

NAMES = [
    "irb120", "irb120_track", "irb1200", "irb1600", "irb2400", "irb4600", "irb5400", "irb6640",
    "irb6700", "irb7600", "crb15000", "irb14000", "irb14050", "irb460", "irb660", "irb910sc",
]  # fmt: skip
URDFS = Path(find_shipped("irb120")).parent / "urdf"


def rotation(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def flange(group, values=None):
    """Position in m of the flange for URDF joint values; a check apart from `axes`."""
    values = values or {}
    turned, at = np.eye(3), np.zeros(3)
    for link in group.chain:
        at = at + turned @ np.array(link.xyz)
        roll, pitch, yaw = link.rpy
        turned = (
            turned
            @ rotation((0, 0, 1), yaw)
            @ rotation((0, 1, 0), pitch)
            @ rotation((1, 0, 0), roll)
        )
        amount = values.get(link.joint, 0.0)
        amount += sum(values.get(name, 0.0) * factor for name, factor in link.follows)
        kind = next((j.kind for j in group.joints if j.name == link.joint), "revolute")
        if kind == "prismatic":
            at = at + turned @ (np.array(link.axis) * amount)
        else:
            turned = turned @ rotation(link.axis, amount)
    return at, turned


def test_the_list_is_the_promised_one():
    assert set(shipped_names()) == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_model_is_complete_and_has_its_sources(name):
    config = load_config(name)
    assert not [d for d in config.diagnostics if d.severity is Severity.ERROR]
    for group in config.groups:
        assert group.chain
        assert group.model == name
        assert {link.joint for link in group.chain if link.joint} <= {j.name for j in group.joints}
        for joint in group.joints:
            assert joint.source
            assert joint.lower < joint.upper
            assert joint.speed > 0
            assert joint.acceleration > 0
    data = to_python(parse(find_shipped(name).read_text(encoding="utf-8"), name)[0])
    for group in data.get("groups", {"": data}).values():
        assert {"limits", "speeds", "chain", "coupling"} <= set(group["source"])


@pytest.mark.parametrize("name", NAMES)
def test_only_uncertain_figures_are_reported(name):
    config = load_config(name)
    text = find_shipped(name).read_text(encoding="utf-8")
    messages = [d for d in config.diagnostics if d.code == "RG016"]
    assert bool(messages) == bool(re.search(r"unsure: \[", text))
    for group, warning in zip(config.groups, messages, strict=False):
        for joint in group.joints:
            assert joint.unsure == (f"{joint.name} " in warning.message)


@pytest.mark.parametrize("name", NAMES)
def test_limits_are_hundredths(name):
    for group in load_config(name).groups:
        for joint in group.joints:
            scale = 1000 if joint.kind == "prismatic" else 180 / math.pi
            for end in (joint.lower * scale, joint.upper * scale):
                assert end * 100 == pytest.approx(round(end * 100), abs=1e-6)


@pytest.mark.parametrize(
    ("name", "position"),
    [
        ("irb120", (0.374, 0, 0.630)),
        ("irb1200", (0.533, 0, 0.8891)),
        ("irb1600", (0.815, 0, 0.9615)),
        ("irb2400", (0.940, 0, 1.455)),
        ("irb4600", (1.270, 0, 1.570)),
        ("irb6640", (1.9125, 0, 2.055)),
        ("irb6700", (1.6625, 0, 2.105)),
        ("irb7600", (2.672, 0, 2.020)),
        ("crb15000", (0.571, 0, 0.899)),
        ("irb460", (1.510, 0, 1.4385)),
        ("irb660", (1.910, 0, 1.833)),
        ("irb910sc", (0.450, 0, 0.220)),
    ],
)
def test_the_flange_at_zero_is_where_the_drawings_have_it(name, position):
    """Sums of the public dimensions: for the IRB 120, x 302 + 72 and z 290 + 270 + 70 mm."""
    at, _ = flange(load_config(name).groups[0])
    assert at == pytest.approx(position, abs=1e-9)


def test_tool0_of_the_irb120_points_forward():
    _, turned = flange(load_config("irb120").groups[0])
    assert turned[:, 2] == pytest.approx((1, 0, 0), abs=1e-9)


@pytest.mark.parametrize("name", ["irb460", "irb660"])
def test_a_palletiser_keeps_its_tool_upright(name):
    group = load_config(name).groups[0]
    assert [j.axis for j in group.joints] == ["rax_1", "rax_2", "rax_3", "rax_6"]
    _, turned = flange(group, {"joint_1": 0.4, "joint_2": 0.7, "joint_3": -0.3})
    assert turned[:, 2] == pytest.approx((0, 0, -1), abs=1e-9)


def test_the_hollow_wrist_folds_straight():
    """IRB 5400: with joint5 turned, the tube in between turns back (mimic x -1)."""
    group = load_config("irb5400").groups[0]
    assert [link.follows for link in group.chain if link.follows] == [(("joint5", -1.0),)]


def test_yumi_has_axis_7_as_eax_a_in_degrees():
    left, right = load_config("irb14000").groups
    assert (left.task, right.task) == ("T_ROB_L", "T_ROB_R")
    for group in (left, right):
        assert [j.axis for j in group.joints] == [*(f"rax_{n}" for n in range(1, 7)), "eax_a"]
        assert group.joints[6].kind == "revolute"
        order = [link.joint.split("_")[2] for link in group.chain if link.joint]
        assert order == list("1273456")
    (a, _), (b, _) = flange(left), flange(right)
    assert a == pytest.approx(b * (1, -1, 1), abs=0.003)


def test_the_track_carries_the_robot_in_metres():
    group = load_config("irb120_track").groups[0]
    assert [(j.axis, j.kind) for j in group.joints[6:]] == [
        ("eax_a", "prismatic"),
        ("eax_b", "revolute"),
    ]
    assert group.external_units == ("TRACK_1", "STN_1")
    at, _ = flange(group, {"track": 1.5})
    assert at == pytest.approx((1.874, 0, 0.630))


def test_a_scara_goes_down_for_negative_values():
    group = load_config("irb910sc").groups[0]
    assert (group.joints[2].kind, group.joints[2].lower) == ("prismatic", -0.18)
    at, _ = flange(group, {"joint_3": -0.1})
    assert at == pytest.approx((0.45, 0, 0.12))


@pytest.mark.parametrize("path", sorted(URDFS.glob("*.urdf")), ids=lambda p: p.stem)
def test_own_urdfs_agree_with_their_models(path, tmp_path):
    names = [group.name for group in load_config(path.stem).groups]
    urdf = f"{{urdf: {{file: {path}}}}}"
    groups = "".join(f"  {name}: {urdf}\n" for name in names)
    (tmp_path / "cell.yaml").write_text(f"model: {path.stem}\ngroups:\n{groups}")
    config = load_config(tmp_path / "cell.yaml")
    assert {d.code for d in config.diagnostics} <= {"RG016", "RG046"}
    for made, known in zip(config.groups, load_config(path.stem).groups, strict=True):
        assert made.joints == known.joints
        assert made.chain == known.chain


@pytest.mark.parametrize("path", sorted(URDFS.glob("*.urdf")), ids=lambda p: p.stem)
def test_own_urdfs_have_the_models_geometry(path):
    from rapidgen.config.draft import GroupDraft, JointDraft
    from rapidgen.config.urdf.expand import Request, expand
    from rapidgen.config.urdf.graph import build_graph
    from rapidgen.config.urdf.group import chain
    from rapidgen.config.urdf.packages import Packages
    from rapidgen.config.urdf.robot import read_robot

    description = expand(Request(path, Packages({}, [], path.parent)))
    graph, result = build_graph(read_robot(description, None), None)
    assert not result
    for group in load_config(path.stem).groups:
        draft = GroupDraft(group.name, joints=[JointDraft(j.name, j.axis) for j in group.joints])
        made = replace(group, chain=tuple(chain(graph, draft, "")))
        values = {j.name: 0.3 * n for n, j in enumerate(group.joints, 1)}
        assert flange(made, values)[0] == pytest.approx(flange(group, values)[0], abs=1e-5)


def test_a_shipped_model_needs_no_heavy_import():
    program = (
        "import sys; from rapidgen.config import load_config; load_config('irb120')\n"
        "print([m for m in ('numpy', 'yourdfpy', 'xacro', 'lxml', 'pydantic.main') "
        "if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout == "[]\n"


def test_headings_of_shipped_models_are_those_of_their_configurations():
    complete = {m.name: (m.description, m.generations) for m in shipped_models()}
    assert shipped_headings() == complete
