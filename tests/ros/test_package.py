"""Generated ROS packages: names that match, frames that are where the kinematics says."""

import ast
import os
import random
import xml.etree.ElementTree as ET
from io import BytesIO
from itertools import combinations, pairwise

import numpy as np
import pytest
import yourdfpy
from ruamel.yaml import YAML
from trimesh import transformations

from rapidgen.axes.frames import to_matrix
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.cli.app import main
from rapidgen.config import load_config, shipped_names
from rapidgen.diagnostics import DiagnosticError
from rapidgen.ros.package import CellMember, ros1_package, ros2_cell, ros2_packages, write
from rapidgen.ros.package.urdf import draw


def package(name):
    return flat(ros2_packages(load_config(name), name, name))


def flat(files):
    """The files by the path within their package; of the last one where several have it."""
    return {path.partition("/")[2]: text for path, text in files.items()}


@pytest.mark.parametrize("name", shipped_names())
def test_tool0_of_the_urdf_is_where_the_kinematics_says(name):
    """The URDF read by yourdfpy, against `axes`."""
    config = load_config(name)
    drawn = draw(config, name)
    robot = yourdfpy.URDF.load(BytesIO(drawn.text.encode()), load_meshes=False)
    number = random.Random(3)
    for group in config.groups:
        kinematics, joints = Kinematics.of(group), JointMap.of(group)
        for _ in range(20):
            wire = tuple(number.uniform(joint.lower, joint.upper) for joint in group.joints)
            robot.update_cfg(dict(zip(joints.names, joints.to_urdf(wire), strict=True)))
            matrix = robot.get_transform(drawn.arms[group.name].tip, "world")
            position, orientation = kinematics.forward(wire)
            assert matrix[:3, 3] == pytest.approx(position, abs=1e-6)
            assert matrix[:3, :3] == pytest.approx(np.array(to_matrix(orientation)), abs=1e-6)


@pytest.mark.parametrize("name", shipped_names())
def test_every_file_is_what_its_name_says(name):
    config, files = load_config(name), package(name)
    for path, text in files.items():
        if path.endswith(".py"):
            ast.parse(text)
        elif path.endswith(".yaml"):
            YAML(typ="safe").load(text)
        elif path.endswith((".xml", ".urdf", ".srdf", ".launch")):
            ET.fromstring(text)
    joints = {joint.name for group in config.groups for joint in group.joints}
    urdf = ET.fromstring(next(text for path, text in files.items() if path.endswith(".urdf")))
    assert joints <= {joint.attrib["name"] for joint in urdf.iter("joint")}
    limits = YAML(typ="safe").load(files["config/joint_limits.yaml"])["joint_limits"]
    assert set(limits) == joints


def test_moveit_waits_for_the_controller_and_complains_before_the_driver():
    config = load_config("irb120")
    report = YAML(typ="safe").load(package("irb120")["config/moveit_controllers.yaml"])
    execution = report["trajectory_execution"]
    assert execution["execution_duration_monitoring"] is False
    assert 0 < execution["allowed_start_tolerance"] < config.trajectory.start_tolerance
    controllers = report["moveit_simple_controller_manager"]
    assert controllers["controller_names"] == ["rob1_controller"]
    assert controllers["rob1_controller"]["joints"] == [f"joint_{n}" for n in range(1, 7)]


def test_srdf_names_links_and_joints_that_the_urdf_has():
    files = package("irb14000")
    urdf = ET.fromstring(files["urdf/irb14000.urdf"])
    srdf = ET.fromstring(files["config/irb14000.srdf"])
    links = {link.attrib["name"] for link in urdf.iter("link")}
    pairs = list(srdf.iter("disable_collisions"))
    assert {pair.attrib[key] for pair in pairs for key in ("link1", "link2")} <= links
    assert {group.attrib["name"] for group in srdf.findall("group")} == {
        "rob_l", "rob_r", "robots"
    }  # fmt: skip


@pytest.mark.parametrize("name", shipped_names())
def test_a_plan_of_a_motion_group_has_kinematics_and_fits_its_controller(name):
    """As MoveIt reads the groups (robot_model.cpp: `addJointModelGroup`, `setKinematicsAllocators`;
    robot_trajectory.cpp: joints that move and mimic none)."""
    files = package(name)
    urdf, srdf = (
        ET.fromstring(files[path]) for path in (f"urdf/{name}.urdf", f"config/{name}.srdf")
    )
    solved = YAML(typ="safe").load(files["config/kinematics.yaml"])
    groups = {group.attrib["name"]: group for group in srdf.findall("group")}
    joints = {group: _joints(groups, group, urdf) for group in groups}
    assert set(solved) <= set(groups)
    controllers = YAML(typ="safe").load(files["config/moveit_controllers.yaml"])
    controllers = controllers["moveit_simple_controller_manager"]
    for group in load_config(name).groups:
        own = [one for one in solved if joints[one] <= joints[group.name]]
        assert len(own) == 1
        assert groups[own[0]].find("chain") is not None
        moving = {
            joint.attrib["name"]
            for joint in urdf.iter("joint")
            if joint.attrib["name"] in joints[group.name]
            and joint.attrib["type"] != "fixed"
            and joint.find("mimic") is None
        }
        assert moving == set(controllers[f"{group.name}_controller"]["joints"])
        if "robots" in groups:
            assert joints[group.name] <= joints["robots"]


def _joints(groups, name, urdf):
    """Names of all joints of a planning group, fixed ones included."""
    above = {joint.find("child").attrib["link"]: joint for joint in urdf.iter("joint")}
    group, result = groups[name], set()
    for chain in group.findall("chain"):
        link = chain.attrib["tip_link"]
        while link != chain.attrib["base_link"]:
            result.add(above[link].attrib["name"])
            link = above[link].find("parent").attrib["link"]
    result |= {joint.attrib["name"] for joint in group.findall("joint")}
    within = [one.attrib["name"] for one in group.findall("group")]
    return result.union(*(_joints(groups, one, urdf) for one in within))


@pytest.mark.parametrize("name", ["irb120", "irb2400", "irb5400", "irb14050", "irb14000"])
def test_nothing_of_an_arm_collides_with_itself_at_home(name):
    """With move_group a start state in collision has no plan, whatever is asked for."""
    files = package(name)
    text = files[f"urdf/{name}.urdf"]
    urdf = ET.fromstring(text)
    srdf = ET.fromstring(files[f"config/{name}.srdf"])
    robot = yourdfpy.URDF.load(BytesIO(text.encode()), load_meshes=False)
    home = srdf.findall("group_state/joint")
    robot.update_cfg({j.attrib["name"]: float(j.attrib["value"]) for j in home})
    bars = {
        link.attrib["name"]: _points_in_bar(link.find("collision"), robot, link.attrib["name"])
        for link in urdf.iter("link")
        if link.find("collision") is not None
    }
    allowed = {
        frozenset((pair.attrib["link1"], pair.attrib["link2"]))
        for pair in srdf.iter("disable_collisions")
    }
    assert len(bars) > 2
    for (one, (a, thick)), (other, (b, thin)) in combinations(bars.items(), 2):
        apart = np.linalg.norm(a[:, None] - b[None], axis=2).min() - thick - thin
        assert apart > 0 or frozenset((one, other)) in allowed, (one, other, apart)
    # What a folded arm can hit stays looked at.
    assert frozenset((next(iter(bars)), list(bars)[-1])) not in allowed


def _points_in_bar(collision, robot, link):
    """Points (n, 3) of the axis in the world, and the radius, m."""
    origin, cylinder = collision.find("origin"), collision.find("geometry/cylinder")
    xyz, rpy = ([float(v) for v in origin.attrib[key].split()] for key in ("xyz", "rpy"))
    at = robot.get_transform(link, "world") @ transformations.translation_matrix(xyz)
    at = at @ transformations.euler_matrix(*rpy)
    half = float(cylinder.attrib["length"]) / 2
    ends = np.linspace(-half, half, 50)
    axis = np.stack([0 * ends, 0 * ends, ends, ends**0])
    return (at @ axis)[:3].T, float(cylinder.attrib["radius"])


@pytest.fixture
def cell(tmp_path):
    """Two robots with a controller each, one of them with a linkage, 2 m apart and turned."""
    for name, model in (("left", "irb120"), ("right", "irb2400")):
        (tmp_path / f"{name}.yaml").write_text(f"name: {name}\nmodel: {model}\n")
    return [
        CellMember(load_config(str(tmp_path / "left.yaml")), "left.yaml"),
        CellMember(
            load_config(str(tmp_path / "right.yaml")), "right.yaml", (2, 0, 0.5, 0, 0, np.pi)
        ),
    ]


def test_two_robots_of_a_cell_are_where_they_were_put(cell):
    files = flat(ros2_cell(cell, "cell"))
    text = files["urdf/cell.urdf"]
    robot = yourdfpy.URDF.load(BytesIO(text.encode()), load_meshes=False)
    rows = {}
    for member, prefix in zip(cell, ("left_", "right_"), strict=True):
        (group,) = member.config.groups
        joints, wire = JointMap.of(group), [0.1] * len(group.joints)
        values = zip(joints.names, joints.to_urdf(wire), strict=True)
        robot.update_cfg({prefix + name: value for name, value in values})
        rows[prefix] = Kinematics.of(group).forward(wire)[0]
    left, right = (robot.get_transform(f"{p}tool0", "world")[:3, 3] for p in rows)
    assert left == pytest.approx(rows["left_"], abs=1e-6)
    x, y, z = rows["right_"]
    assert right == pytest.approx((2 - x, -y, 0.5 + z), abs=1e-6)


def test_two_robots_share_a_moveit(cell):
    files = flat(ros2_cell(cell, "cell"))
    report = YAML(typ="safe").load(files["config/moveit_controllers.yaml"])
    controllers = report["moveit_simple_controller_manager"]
    assert controllers["controller_names"] == ["left/rob1_controller", "right/rob1_controller"]
    assert controllers["right/rob1_controller"]["joints"][2] == "right_joint_3"
    urdf = ET.fromstring(files["urdf/cell.urdf"])
    srdf = ET.fromstring(files["config/cell.srdf"])
    joints = [joint.attrib["name"] for joint in urdf.iter("joint")]
    assert len(set(joints)) == len(joints)
    assert {m.attrib["joint"] for m in urdf.iter("mimic")} <= set(joints)
    named = [joint.attrib["name"] for joint in srdf.findall("group_state/joint")]
    assert set(named) <= set(joints)
    assert set(YAML(typ="safe").load(files["config/joint_limits.yaml"])["joint_limits"]) == set(
        named
    )
    groups = {group.attrib["name"] for group in srdf.findall("group")}
    assert groups == {"left_rob1", "right_rob1", "robots"}
    launch = files["launch/driver.launch.py"]
    ast.parse(launch)
    assert "__ns:=/right" in launch
    assert "tf_prefix:=right_" in launch


def test_two_robots_of_one_name_are_refused(cell):
    with pytest.raises(DiagnosticError, match="RG693"):
        ros2_cell([cell[0], cell[0]], "cell")


@pytest.mark.parametrize(
    ("given", "report"),
    [
        (["irb120", "irb2400"], "give it once for each robot"),
        (["irb120", "--base-pose", "0,0,0"], "only for several robots"),
        (["irb120", "irb2400", "--base-pose", "0,0,0", "--base-pose", "0,1"], "is not X,Y,Z"),
        (["irb120", "irb2400", "--base-pose", "0,0,0", "--base-pose", "nan,0,1"], "is not X,Y,Z"),
    ],
)
def test_places_that_do_not_fit_are_refused(given, report, tmp_path, capsys):
    assert main(["ros2", *given, "-o", str(tmp_path / "p")]) == 2
    assert report in capsys.readouterr().err
    assert not (tmp_path / "p").exists()


def test_ros1_says_names_coupling_and_ports():
    config = load_config("irb2400")
    files = ros1_package(config, "irb2400", "cell")
    launch = ET.fromstring(files["launch/robot.launch"])
    values = {e.attrib.get("name"): e.attrib.get("value") for e in launch.iter("param")}
    assert values["J23_coupled"] == "true"
    names = next(launch.iter("rosparam")).text
    assert names == "[joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]"
    ast.parse(files["scripts/watcher.py"])


def test_packages_are_called_as_the_folder_and_name_what_they_need():
    """As ament names packages (REP 144); launch files import what package.xml lists (R3)."""
    files = ros2_packages(load_config("irb120"), "irb120", "My Cell")
    needs = {
        name: {one.text for one in ET.fromstring(files[f"{name}/package.xml"]).iter("exec_depend")}
        for name in ("my_cell_description", "my_cell_bringup", "my_cell_moveit_config")
    }
    assert {path.partition("/")[0] for path in files} == set(needs)
    for name, report in needs.items():
        assert files[f"{name}/CMakeLists.txt"].count(f"project({name} NONE)") == 1
        for path, text in files.items():
            if path.startswith(name) and path.endswith(".py"):
                imported = {
                    one.module.partition(".")[0]
                    for one in ast.walk(ast.parse(text))
                    if isinstance(one, ast.ImportFrom)
                }
                assert imported - {"pathlib", "xml"} <= report
    assert not any("moveit" in one or "rviz" in one for one in needs["my_cell_bringup"])


def test_moveit_finds_urdf_and_srdf_and_has_pilz():
    """Without `.setup_assistant` moveit_configs_utils warns that it infers both (R5)."""
    files = ros2_packages(load_config("irb120"), "irb120", "cell")
    read = YAML(typ="safe").load
    text = files["cell_moveit_config/.setup_assistant"]
    setup = read(text)["moveit_setup_assistant_config"]
    urdf, srdf = setup["urdf"], setup["srdf"]
    assert f"{urdf['package']}/{urdf['relative_path']}" in files
    assert f"cell_moveit_config/{srdf['relative_path']}" in files
    limits = read(files["cell_moveit_config/config/pilz_cartesian_limits.yaml"])["cartesian_limits"]
    assert limits["max_trans_vel"] > 0 > limits["max_trans_dec"]
    launch = files["cell_moveit_config/launch/moveit.launch.py"]
    assert "pilz_industrial_motion_planner" in launch


def test_write_replaces_own_package_but_no_other(tmp_path):
    files = ros1_package(load_config("irb120"), "irb120", "a")
    write(files, tmp_path / "a")
    write(files, tmp_path / "a")
    assert not os.access(tmp_path / "a" / "package.xml", os.X_OK)
    (tmp_path / "a" / "mine.txt").write_text("mine")
    with pytest.raises(DiagnosticError, match=r"mine\.txt"):
        write(files, tmp_path / "a")


def test_the_watcher_can_be_executed(tmp_path):
    """`roslaunch` finds no node in a file that cannot."""
    write(ros1_package(load_config("irb120"), "irb120", "cell"), tmp_path)
    assert os.access(tmp_path / "scripts/watcher.py", os.X_OK)


@pytest.mark.parametrize("verb", ["ros1", "ros2"])
def test_the_command(verb, tmp_path, capsys):
    assert main([verb, "irb120", "-o", str(tmp_path / "p")]) == 0
    assert "files in" in capsys.readouterr().out
    assert (tmp_path / "p" / {"ros1": "", "ros2": "p_bringup"}[verb] / "package.xml").is_file()
    assert main([verb, "irb12o", "-o", str(tmp_path / "q")]) == 2
    assert not (tmp_path / "q").exists()


def called(names, tmp_path):
    """An irb120 whose joints have these names."""
    joints = "".join(f'  "{name}": {{axis: rax_{n}}}\n' for n, name in enumerate(names, 1))
    yaml = tmp_path / "called.yaml"
    yaml.write_text(f"model: irb120\njoints:\n{joints}")
    return load_config(str(yaml))


def test_joints_may_be_called_as_links_and_fixed_joints_are(tmp_path):
    config = called(["base", "base_link_joint", "tool0", "tool0_joint", "world", "x"], tmp_path)
    files = flat(ros2_packages(config, "called.yaml", "called"))
    drawn = ET.fromstring(files["urdf/called.urdf"])
    for tag in ("link", "joint"):
        names = [element.attrib["name"] for element in drawn.iter(tag)]
        assert len(names) == len(set(names)), tag
    robot = yourdfpy.URDF.load(BytesIO(files["urdf/called.urdf"].encode()), load_meshes=False)
    joints = {joint.name for joint in config.groups[0].joints}
    assert joints <= set(robot.actuated_joint_names)
    chain = ET.fromstring(files["config/called.srdf"]).find("group/chain")
    assert chain is not None
    assert chain.attrib == {"base_link": "base_link", "tip_link": "tool0"}


def test_names_of_joints_stay_texts_in_yaml(tmp_path):
    """ROS reads YAML 1.1, in which 3, no and y are no texts."""
    names = ["1", "no", "y", "1e3", "0x1", "a: b"]
    config, yaml = called(names, tmp_path), YAML(typ="safe")
    yaml.version = (1, 1)
    files = flat(ros2_packages(config, "called.yaml", "called"))
    assert list(yaml.load(files["config/joint_limits.yaml"])["joint_limits"]) == names
    report = yaml.load(files["config/moveit_controllers.yaml"])
    assert report["moveit_simple_controller_manager"]["rob1_controller"]["joints"] == names
    launch = ET.fromstring(ros1_package(config, "called.yaml", "called")["launch/robot.launch"])
    assert yaml.load(launch.findtext("group/rosparam")) == names


def commands(launch):
    """The texts in each command of a launch file."""
    lists = [k.value for k in ast.walk(ast.parse(launch)) if isinstance(k, ast.keyword)]
    return [
        [word.value for word in ast.walk(words) if isinstance(word, ast.Constant)]
        for words in lists
        if isinstance(words, ast.List)
    ]


@pytest.mark.parametrize(
    "robots", [["irb120"], ["irb120", "irb2400", "--base-pose=0,0,0", "--base-pose=2,0,0"]]
)
def test_node_and_simulator_know_what_was_overridden(robots, tmp_path):
    """With the ports, ranges and joints of another robot they would drive it otherwise."""
    sets = ["state.rate=20", "ports.motion=12000", "network.allowed_clients=[10.0.0.1, 10.0.0.2]"]
    words = [word for one in sets for word in ("--set", one)]
    assert main(["ros2", *robots, "-o", str(tmp_path / "p"), *words]) == 0
    report = commands((tmp_path / "p/p_bringup/launch/driver.launch.py").read_text())
    simulators = [one for one in report if one[:2] == ["rapidgen", "sim"]]
    nodes = [one for one in report if "rapidgen.ros" in one]
    assert len(simulators) == len(nodes) == sum("irb" in one for one in robots)
    for one in simulators:
        assert [value for key, value in pairwise(one) if key == "--set"] == sets
    for one in nodes:
        (given,) = [word for word in one if word.startswith("overrides:=")]
        assert YAML(typ="safe").load(given.removeprefix("overrides:=")) == sets


@pytest.mark.parametrize(
    ("given", "rate"), [([], "state.rate=50"), (["--set", "state.rate=25"], "state.rate=25")]
)
def test_joint_states_have_50_hz_unless_the_user_says_otherwise(given, rate, tmp_path, capsys):
    assert main(["ros2", "irb120", "-o", str(tmp_path / "p"), *given]) == 0
    launch = (tmp_path / "p/p_bringup/launch/driver.launch.py").read_text()
    assert launch.count(rate) == 2
    assert ("50 Hz" in capsys.readouterr().out) is (not given)


def test_a_hostile_name_stays_text(tmp_path):
    yaml = tmp_path / "robot.yaml"
    yaml.write_text('name: "it\'s <b>"\nmodel: irb120\n')
    try:
        config = load_config(str(yaml))
    except DiagnosticError:
        return
    for path, text in ros2_packages(config, str(yaml), "it's <b>").items():
        if path.endswith(".py"):
            ast.parse(text)
        elif path.endswith((".xml", ".urdf", ".srdf")):
            ET.fromstring(text)
    assert np.isfinite(config.state_period)
