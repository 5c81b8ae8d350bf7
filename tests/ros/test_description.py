"""Packages of a robot with a description: its tree, meshes, tools, scene and pairs."""

import random
import xml.etree.ElementTree as ET
from io import BytesIO

import numpy as np
import pytest
import yourdfpy

from rapidgen.axes.frames import to_matrix
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.cli.app import main
from rapidgen.collision.world import RobotSource
from rapidgen.config import load_config
from rapidgen.config.urdf.visual_trees import tree_of_file
from rapidgen.ros.package import (
    CellMember,
    PackageOptions,
    ros2_cell,
    ros2_packages,
    scene,
)
from rapidgen.ros.package.description import MeshFiles
from rapidgen.ros.package.scene import shapes_of
from rapidgen.ros.package.urdf import PlacedRobot, draw_cell
from tests.docs.tree import ROOT

CORNERS = np.array([[0, 0, 0], [0.05, 0, 0], [0, 0.05, 0], [0, 0, 0.2]])


def tetrahedron():
    """A binary STL file (80 bytes, a count, 50 bytes for each triangle)."""
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    table = np.zeros(4, record)
    table["corners"] = CORNERS[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
    return bytes(80) + (4).to_bytes(4, "little") + table.tobytes()


@pytest.fixture
def robot(tmp_path):
    """An IRB 120 whose bars are `<collision>`, with one mesh in another folder."""
    text = (ROOT / "robots/urdf/irb120.urdf").read_text(encoding="utf-8")
    text = text.replace("<visual>", "<collision>").replace("</visual>", "</collision>")
    mesh = '<geometry><mesh filename="meshes/elbow.stl" scale="1 1 1"/></geometry>'
    first = '<link name="link_3">'
    assert first in text
    text = text.replace(first, f"{first}<visual>{mesh}</visual><collision>{mesh}</collision>")
    (tmp_path / "arm.urdf").write_text(text)
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/elbow.stl").write_bytes(tetrahedron())
    path = tmp_path / "robot.yaml"
    path.write_text("model: irb120\nurdf: {file: arm.urdf}\ncontroller: {robotware: 6.15}\n")
    return load_config(str(path))


CELL = """
robots: {T_ROB1: {model: robot.yaml}}
tools: {tGrip: {frame: {position: [0, 0, 120]}, load: {mass: 1}, shapes: [{box: [60, 60, 100]}]}}
things:
  floor: {half_space: [0, 0, 1], frame: {position: [0, 0, -5]}}
  post: {cylinder: {radius: 60, length: 1200}, frame: {position: [0, 700, 600]}}
  pin: {capsule: {radius: 10, length: 200}, frame: {position: [0, -700, 600]}}
collision: {pairs: {link_3 - link_5: {allowed: bars meet in the wrist}}}
"""


@pytest.fixture
def cell(robot):
    path = robot.path.parent / "cell.yaml"
    path.write_text(CELL)
    return path


def packages(robot, found=(), **more):
    report = found.append if isinstance(found, list) else lambda finding: None
    options = PackageOptions(report=report, **more)
    return ros2_packages(robot, str(robot.path), "cell", (), options)


@pytest.mark.parametrize("at", [(0.0,) * 6, (1.0, -2.0, 0.5, 0.1, 0.2, 3.0)])
def test_tip_of_the_description_is_where_the_kinematics_says(robot, at):
    """The URDF read by yourdfpy, against `axes`."""
    shapes = shapes_of(robot, robot.path, None, is_fitted=False, report=lambda finding: None)
    placed = PlacedRobot(robot, "left_", at, shapes.described)
    drawn = draw_cell([placed], "cell", MeshFiles("p"))
    read = yourdfpy.URDF.load(BytesIO(drawn.text.encode()), load_meshes=False)
    (group,) = robot.groups
    kinematics, joints = Kinematics.of(group), JointMap.of(group)
    base = read.get_transform("left_base_link", "world")
    number = random.Random(5)
    for _ in range(10):
        wire = tuple(number.uniform(joint.lower, joint.upper) for joint in group.joints)
        values = zip(joints.names, joints.to_urdf(wire), strict=True)
        read.update_cfg({f"left_{name}": value for name, value in values})
        matrix = read.get_transform(drawn.arms["left_rob1"].tip, "world")
        position, orientation = kinematics.forward(wire)
        expected = np.eye(4)
        expected[:3, :3], expected[:3, 3] = to_matrix(orientation), position
        # The description has angles with five digits.
        assert matrix == pytest.approx(base @ expected, abs=1e-5)
    assert base[:3, 3] == pytest.approx(at[:3])


def test_meshes_are_copied_and_named_by_their_package(robot):
    files = packages(robot)
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    uris = {mesh.attrib["filename"] for mesh in root.iter("mesh")}
    assert len(uris) == 2
    for uri in uris:
        assert files[uri.removeprefix("package://")] == tetrahedron()
    assert "install(DIRECTORY meshes urdf" in files["cell_description/CMakeLists.txt"]
    elbow = next(link for link in root.iter("link") if link.attrib["name"] == "link_3")
    assert len(elbow.findall("collision")) > 1


def test_limits_are_those_of_the_configuration(robot):
    """The driver refuses what is beyond them, whatever the description says."""
    text = robot.path.read_text() + "joints: {joint_1: {lower: -10, upper: 20}}\n"
    robot.path.write_text(text)
    files = packages(load_config(str(robot.path)))
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    joint = next(one for one in root.iter("joint") if one.attrib["name"] == "joint_1")
    assert float(joint.find("limit").attrib["lower"]) == pytest.approx(np.radians(-10))
    assert float(joint.find("limit").attrib["upper"]) == pytest.approx(np.radians(20))


def test_missing_mesh_refuses_the_package(robot, capsys):
    (robot.path.parent / "meshes/elbow.stl").unlink()
    output = robot.path.parent / "cell"
    assert main(["ros2", str(robot.path), "-o", str(output)]) == 2
    assert "RG827" in capsys.readouterr().err
    assert not output.exists()


def test_bars_of_a_robot_without_description_are_reported(tmp_path, capsys):
    assert main(["ros2", "irb120", "-o", str(tmp_path / "p")]) == 0
    assert "RG699" in capsys.readouterr().err


def test_pairs_without_a_check_are_those_of_the_cell(robot, cell):
    found = []
    files = packages(robot, found, cell=cell)
    srdf = ET.fromstring(files["cell_moveit_config/config/cell.srdf"])
    pairs = {
        frozenset((one.attrib["link1"], one.attrib["link2"])): one.attrib["reason"]
        for one in srdf.iter("disable_collisions")
    }
    assert pairs[frozenset(("link_3", "link_5"))] == "bars meet in the wrist"
    assert pairs[frozenset(("link_1", "link_2"))] == "Adjacent"
    assert pairs[frozenset(("link_6", "tGrip"))] == "Adjacent"
    assert pairs[frozenset(("base_link", "link_2"))] == "Default"
    assert frozenset(("base_link", "link_6")) not in pairs
    assert frozenset(("link_4", "tGrip")) not in pairs
    links, tools = (one.message for one in found)
    assert "base_link - link_2" in links
    assert "plans nothing" in tools
    assert "link_4 - tGrip" in tools


def test_tool_of_the_cell_is_a_link_at_the_tip(robot, cell):
    files = packages(robot, cell=cell)
    text = files["cell_description/urdf/cell.urdf"]
    read = yourdfpy.URDF.load(BytesIO(text.encode()), load_meshes=False)
    assert read.get_transform("tGrip", "tool0") == pytest.approx(np.eye(4))
    tool = next(one for one in ET.fromstring(text).iter("link") if one.attrib["name"] == "tGrip")
    assert tool.find("collision/geometry/box").attrib["size"] == "0.06 0.06 0.1"
    launch = files["cell_bringup/launch/driver.launch.py"]
    assert f'DeclareLaunchArgument("cell", default_value={str(cell)!r})' in launch


def read_scene(text):
    """The objects of a scene, read as `PlanningScene::loadGeometryFromStream` does it."""
    lines = iter(text.splitlines())
    next(lines)
    objects = {}
    while (marker := next(lines)) != ".":
        assert marker.startswith("* ")
        shapes = objects[marker[2:]] = []
        origin = _numbers(lines, 3), _numbers(lines, 4)
        assert origin == ([0, 0, 0], [0, 0, 0, 1])
        for _ in range(int(next(lines))):
            kind = next(lines)
            size = [float(word) for word in next(lines).split()]
            shapes.append((kind, size, _numbers(lines, 3), _numbers(lines, 4)))
            _numbers(lines, 4)
        assert next(lines) == "0"
    return objects


def _numbers(lines, count):
    numbers = [float(word) for word in next(lines).split()]
    assert len(numbers) == count
    return numbers


def test_objects_of_the_cell_are_a_scene_of_moveit(robot, cell):
    objects = read_scene(packages(robot, cell=cell)["cell_moveit_config/config/cell.scene"])
    assert set(objects) == {"floor", "post", "pin"}
    ((kind, size, place, _),) = objects["floor"]
    # The top of the box is the surface of the half-space.
    assert (kind, place[2] + size[2] / 2) == ("box", pytest.approx(-0.005))
    ((kind, size, place, turn),) = objects["post"]
    assert (kind, size, place, turn) == ("cylinder", [0.06, 1.2], [0, 0.7, 0.6], [0, 0, 0, 1])
    kinds = [shape[0] for shape in objects["pin"]]
    assert sorted(kinds) == ["cylinder", "sphere", "sphere"]
    assert sorted(shape[2][2] for shape in objects["pin"]) == pytest.approx([0.5, 0.6, 0.7])


def test_two_robots_with_one_description_have_their_own_links(robot):
    members = [
        CellMember(robot, str(robot.path)),
        CellMember(robot, str(robot.path), (1.0, 0, 0, 0, 0, 0)),
    ]
    path = robot.path.with_name("other.yaml")
    path.write_text(f"name: other\n{robot.path.read_text()}")
    members[1] = CellMember(load_config(str(path)), str(path), members[1].at)
    files = ros2_cell(members, "cell")
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    links = [link.attrib["name"] for link in root.iter("link")]
    assert len(links) == len(set(links))
    assert {"robot_link_3", "other_link_3"} <= set(links)
    assert len([path for path in files if path.endswith(".stl")]) == 2


def test_fitted_parts_replace_meshes_for_collisions(robot):
    pytest.importorskip("coal")
    files = packages(robot, is_fitted=True)
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    elbow = next(link for link in root.iter("link") if link.attrib["name"] == "link_3")
    (visual,) = elbow.findall("visual/geometry/mesh")
    parts = elbow.findall("collision/geometry/mesh")
    assert parts
    assert visual.attrib["filename"] not in {part.attrib["filename"] for part in parts}
    for part in parts:
        assert part.attrib["filename"].removeprefix("package://") in files


def test_description_that_moves_otherwise_is_not_used(robot, monkeypatch):
    """A longer arm would show the robot where it is not."""
    path = robot.path.with_name("longer.urdf")
    text = robot.path.with_name("arm.urdf").read_text()
    path.write_text(text.replace('xyz="0 0 0.27"', 'xyz="0 0 0.37"'))
    source = RobotSource(robot.groups[0], tree_of_file(path))
    monkeypatch.setattr(scene, "sources_of", lambda *_: (source,))
    found = []
    files = packages(robot, found)
    assert "moves otherwise" in found[0].message
    assert not [path for path in files if path.endswith(".stl")]


def test_two_arms_of_one_description_share_its_links(tmp_path):
    (tmp_path / "yumi.urdf").write_bytes((ROOT / "robots/urdf/irb14000.urdf").read_bytes())
    arms = "".join(f"  {arm}: {{urdf: {{file: yumi.urdf}}}}\n" for arm in ("rob_l", "rob_r"))
    path = tmp_path / "yumi.yaml"
    path.write_text(f"model: irb14000\ngroups:\n{arms}")
    files = packages(load_config(str(path)))
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    links = [link.attrib["name"] for link in root.iter("link")]
    assert len(links) == len(set(links))
    srdf = ET.fromstring(files["cell_moveit_config/config/cell.srdf"])
    chains = [chain.attrib for chain in srdf.iter("chain")]
    assert [chain["base_link"] for chain in chains] == ["base_link", "base_link"]
    assert chains[0]["tip_link"] != chains[1]["tip_link"]
