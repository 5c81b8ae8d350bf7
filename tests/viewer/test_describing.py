"""Drawing of a robot with a description: links at the poses of `axes`."""

import random
from xml.etree import ElementTree

import numpy as np
import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config import load_config
from rapidgen.viewer.appearance import Meshes, appearance
from rapidgen.viewer.robots import side_by_side
from tests.docs.tree import ROOT

URDF = ROOT / "robots" / "urdf"
CONFIGS = {
    "irb120": "model: irb120\nurdf: {file: %s/irb120.urdf}\n",
    "irb120_track": "model: irb120_track\nurdf: {file: %s/irb120_track.urdf}\n",
    "irb2400": "model: irb2400\nurdf: {file: %s/irb2400.urdf}\n",
    "irb910sc": "model: irb910sc\nurdf: {file: %s/irb910sc.urdf}\n",
}


def look(tmp_path, text):
    path = tmp_path / "robot.yaml"
    path.write_text(text)
    groups = load_config(path).groups
    return groups, appearance(groups, {group.name: path for group in groups})


@pytest.mark.parametrize("name", CONFIGS)
def test_the_flange_is_where_axes_says(tmp_path, name):
    (group,), result = look(tmp_path, CONFIGS[name] % URDF)
    drawing = result.of(group)
    tree = ElementTree.fromstring(drawing.urdf)
    assert len(list(tree.iter("visual"))) > 3
    assert drawing.flange == "flange"
    chance = random.Random(name)
    for _ in range(10):
        posture = tuple(chance.uniform(j.lower, j.upper) for j in group.joints)
        values = dict(
            zip(drawing.movable, drawing.values(JointMap.of(group).to_urdf(posture)), strict=True)
        )
        place, turned = Kinematics.of(group).forward(posture)
        assert drawing.base is None
        drawn = forward(tree, drawing.flange, values)
        np.testing.assert_allclose(drawn[:3, 3], place, atol=1e-9)
        np.testing.assert_allclose(drawn[:3, :3], frames.to_matrix(turned), atol=1e-9)


def forward(tree, link, values):
    """The pose of a link by the text of the URDF alone."""
    joint = next((j for j in tree.iter("joint") if j.find("child").get("link") == link), None)
    if joint is None:
        return np.eye(4)
    numbers = {
        name: [float(word) for word in joint.find("origin").get(name).split()]
        for name in ("xyz", "rpy")
    }
    made = np.eye(4)
    made[:3, :3] = frames.to_matrix(frames.from_rpy(*numbers["rpy"]))
    made[:3, 3] = numbers["xyz"]
    moved = np.eye(4)
    if joint.get("type") != "fixed":
        axis = np.array([float(word) for word in joint.find("axis").get("xyz").split()])
        amount = values[joint.get("name")]
        if joint.get("type") == "prismatic":
            moved[:3, 3] = axis * amount
        else:
            moved[:3, :3] = frames.to_matrix(frames.about(tuple(axis), amount))
    return forward(tree, joint.find("parent").get("link"), values) @ made @ moved


def test_each_arm_draws_its_own_links_in_one_place(tmp_path):
    axes = {1: "rax_1", 2: "rax_2", 7: "eax_a", 3: "rax_3", 4: "rax_4", 5: "rax_5", 6: "rax_6"}
    text = "groups:\n"
    for side in "lr":
        joints = ", ".join(f"yumi_joint_{i}_{side}: {{axis: {a}}}" for i, a in axes.items())
        text += f"  {side}: {{model: irb14050, joints: {{{joints}}}, "
        text += f"urdf: {{file: {URDF}/irb14000.urdf, tip: tool0_{side}}}}}\n"
    groups, result = look(tmp_path, text)
    shapes = [
        len(list(ElementTree.fromstring(result.of(group).urdf).iter("visual"))) for group in groups
    ]
    complete = len(list(ElementTree.parse(URDF / "irb14000.urdf").iter("visual")))
    assert sum(shapes) == complete
    assert min(shapes) > 6
    drawings = [result.of(group) for group in groups]
    bases = [robot.base.position for robot in side_by_side(groups, drawings)]
    # The model's arm has a root of its own, in the shoulder of the body.
    feet = [
        ElementTree.parse(URDF / "irb14000.urdf").find(f"joint[@name='yumi_joint_1_{side}']/origin")
        for side in "lr"
    ]
    for base, foot in zip(bases, feet, strict=True):
        assert np.allclose(base, [float(word) for word in foot.get("xyz").split()], atol=0.2)
    assert bases[0][1] > 0 > bases[1][1]


def test_missing_description_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr("rapidgen.viewer.appearance.LARGEST", 100)
    urdf = (URDF / "irb120.urdf").read_text()
    meshes = "".join(
        f'<visual><geometry><mesh filename="{name}"/></geometry></visual>'
        for name in ("big.stl", "small.stl", "small.stl", "../../gone.stl", "<b>.obj")
    ).replace("<b>", "&lt;b&gt;")
    (tmp_path / "arm.urdf").write_text(
        urdf.replace('<link name="tool0"/>', f'<link name="tool0">{meshes}</link>')
    )
    (tmp_path / "big.stl").write_bytes(b"x" * 101)
    (tmp_path / "small.stl").write_bytes(b"x" * 100)
    (group,), result = look(tmp_path, "model: irb120\nurdf: {file: arm.urdf}\n")
    named = [m.get("filename") for m in ElementTree.fromstring(result.of(group).urdf).iter("mesh")]
    assert named[1] == named[2] == next(iter(result.files))
    assert [named[0], *named[3:]] == ["", "", ""]
    assert result.files[named[1]] == b"x" * 100
    assert len(result.faults) == 3
    assert "larger" in result.faults[0]
    assert str(tmp_path) not in result.of(group).urdf


def test_meshes_together_have_a_limit_too_and_xml_of_others_declares_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr("rapidgen.viewer.appearance.MOST", 100)
    meshes = Meshes()
    for name, data in (
        ("one.stl", b"x" * 60),
        ("two.stl", b"y" * 41),
        ("three.stl", b"z" * 40),
        ("four.dae", b"<!DOCTYPE a><a/>"),
    ):
        (tmp_path / name).write_bytes(data)
    monkeypatch.setattr("rapidgen.viewer.appearance.LARGEST", 70)
    named = [meshes.name_in(f"{name}.stl", tmp_path) for name in ("one", "two", "three", "one")]
    assert [bool(name) for name in named] == [True, False, True, True]
    assert named[0] == named[3]
    assert [len(data) for data in meshes.files.values()] == [60, 40]
    monkeypatch.setattr("rapidgen.viewer.appearance.MOST", 200)
    assert meshes.name_in("four.dae", tmp_path) == ""
    assert meshes.name_in("../gone.stl", tmp_path) == meshes.name_in("../gone.stl", tmp_path) == ""
    message = [
        "two.stl is larger",
        "four.dae: it has a document type",
        "'../gone.stl' is not there",
    ]
    assert len(meshes.faults) == len(message)
    for fault, wanted in zip(meshes.faults, message, strict=True):
        assert fault.startswith(wanted)
