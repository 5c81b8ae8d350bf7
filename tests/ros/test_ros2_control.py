"""The node as hardware of ros2_control, over topics.

Messages are those of `joint_state_topic_hardware_interface` 1.1.0 and of its version 0.2.1, as
their sources have them; the real controller_manager is not available as a wheel.
"""

import asyncio
import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from ruamel.yaml import YAML
from streamed import NAMES, streamed

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system
from rapidgen.ros.package import CellMember, ros2_cell, ros2_packages
from rapidgen.ros.stream_commands import JointCommand

EGM = "egm: {address: 127.0.0.1, max_deviation: 20, max_speed: 45}\n"


@pytest.fixture
def guided(tmp_path):
    """Configurations of robots with EGM by name, and the paths of their files."""

    def make(name="cell", model="irb120"):
        path = tmp_path / f"{name}.yaml"
        path.write_text(f"name: {name}\nmodel: {model}\ncontroller: {{robotware: 6.15}}\n{EGM}")
        return load_config(str(path)), str(path)

    return make


def test_node_leaves_joint_states_and_goals_to_the_controllers(driver_type, guided):
    config, path = guided()
    system = make_system(config, build(config))
    with VirtualController(system, config.groups, clock="real", ports="auto") as controller:
        controller.start()
        address = str(controller.address("rob1", timeout=60))
        node = driver_type(
            parameter_overrides={"config": path, "address": address, "control": "ros2_control"}
        )
        try:
            states = node.topics["/rapidgen/joint_states"].wait(lambda message: message.velocity)
            assert list(states.name) == [f"joint_{n}" for n in range(1, 7)]
            assert "/joint_states" not in node.published
            assert not node.published_actions
        finally:
            node.destroy_node()


def test_hardware_of_the_description_uses_the_topics_of_the_node(guided):
    config, path = guided()
    files = ros2_packages(config, path, "cell")
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    (system,) = root.findall("ros2_control")
    assert (system.attrib["name"], system.attrib["type"]) == ("rob1", "system")
    assert system.findtext("hardware/plugin") == (
        "joint_state_topic_hardware_interface/JointStateTopicSystem"
    )
    parameters = {one.attrib["name"]: one.text for one in system.findall("hardware/param")}
    assert parameters == {
        "joint_commands_topic": "/rapidgen/joint_commands",
        "joint_states_topic": "/rapidgen/joint_states",
        "trigger_joint_command_threshold": "-1",
    }
    joints = [joint.attrib["name"] for joint in system.findall("joint")]
    assert joints == [joint.name for joint in config.groups[0].joints]
    for joint in system.findall("joint"):
        assert [one.attrib["name"] for one in joint.findall("command_interface")] == ["position"]
        states = [one.attrib["name"] for one in joint.findall("state_interface")]
        assert states == ["position", "velocity"]


def test_controllers_have_the_joints_and_begin_where_the_robot_stands(guided):
    """Version 0.2.1 of the hardware begins with commands of 0: a controller must not take them."""
    files = ros2_packages(*guided(), "cell")
    read = YAML(typ="safe").load
    text = read(files["cell_bringup/config/controllers.yaml"])
    manager = text["/**/controller_manager"]["ros__parameters"]
    assert manager["update_rate"] == 250
    types = {name: value["type"] for name, value in manager.items() if name != "update_rate"}
    assert types == {
        "joint_state_broadcaster": "joint_state_broadcaster/JointStateBroadcaster",
        "rob1_controller": "joint_trajectory_controller/JointTrajectoryController",
        "rob1_forward_controller": "forward_command_controller/ForwardCommandController",
    }
    names = [f"joint_{n}" for n in range(1, 7)]
    trajectory = text["/**/rob1_controller"]["ros__parameters"]
    assert trajectory["joints"] == text["/**/rob1_forward_controller"]["ros__parameters"]["joints"]
    assert trajectory["joints"] == names
    assert trajectory["set_last_command_interface_value_as_state_on_activation"] is False
    # 45 deg/s at a gain of 5 /s is 0.157 rad behind.
    assert trajectory["constraints"]["joint_1"]["trajectory"] == pytest.approx(0.257, abs=1e-3)
    # MoveIt finds an action with the same name.
    moveit = read(files["cell_moveit_config/config/moveit_controllers.yaml"])
    names = moveit["moveit_simple_controller_manager"]["controller_names"]
    assert names == ["rob1_controller"]
    assert "cell_moveit_config/config/moveit_ros2_control.yaml" not in files


def test_controllers_of_two_robots_in_one_manager(guided):
    members = [CellMember(*guided(name)) for name in ("left", "right")]
    files = ros2_cell(members, "cell")
    root = ET.fromstring(files["cell_description/urdf/cell.urdf"])
    systems = {one.attrib["name"]: one for one in root.findall("ros2_control")}
    assert set(systems) == {"left_rob1", "right_rob1"}
    topics = [one.text for one in systems["right_rob1"].findall("hardware/param")]
    assert topics[:2] == ["/right/rapidgen/joint_commands", "/right/rapidgen/joint_states"]
    read = YAML(typ="safe").load
    controllers = read(files["cell_bringup/config/controllers.yaml"])
    moveit = read(files["cell_moveit_config/config/moveit_ros2_control.yaml"])
    moveit = moveit["moveit_simple_controller_manager"]
    assert moveit["controller_names"] == ["left_rob1_controller", "right_rob1_controller"]
    for name in moveit["controller_names"]:
        joints = controllers[f"/**/{name}"]["ros__parameters"]["joints"]
        assert joints == moveit[name]["joints"]


def test_package_without_egm_has_nothing_of_ros2_control():
    files = ros2_packages(load_config("irb120"), "irb120", "cell")
    assert not [path for path in files if path.endswith("controllers.yaml") and "bringup" in path]
    assert not [path for path, text in files.items() if "ros2_control" in text]


@pytest.mark.parametrize("namespace", ["", "/left"])
def test_rcl_finds_the_parameters_in_any_namespace(request, guided, tmp_path, namespace):
    """The controllers of controller_manager's process read them from its `--params-file`."""
    rclpy = pytest.importorskip("rclpy")
    request.getfixturevalue("_rclpy")
    files = ros2_packages(*guided(), "cell")
    path = tmp_path / "controllers.yaml"
    path.write_text(files["cell_bringup/config/controllers.yaml"])
    expected = {"controller_manager": ("update_rate", 250)}
    expected["rob1_controller"] = ("joints", [f"joint_{n}" for n in range(1, 7)])
    expected["rob1_forward_controller"] = ("interface_name", "position")
    for name, (parameter, value) in expected.items():
        node = rclpy.create_node(
            name,
            namespace=namespace,
            cli_args=["--ros-args", "--params-file", str(path)],
            automatically_declare_parameters_from_overrides=True,
        )
        assert node.get_parameter(parameter).value == value
        node.destroy_node()


CYCLE = 0.004
"""s: `update_rate` of the generated controllers.yaml."""


class Hardware:
    """`JointStateTopicSystem::write`: one message a cycle, whatever the commands are.

    They are `first` until a controller is active: NaN in 1.1.0, 0.0 in 0.2.1.
    """

    def __init__(self, station, first):
        self.station, self.commands = station, (first,) * 6

    def write(self):
        command = JointCommand(self.commands, names=NAMES, stamp=self.station.loop.time())
        self.station.link.command("joint_commands", command)

    async def update(self, seconds, controller=None):
        """Run cycles; `controller` gives commands by the time since it became active."""
        rows = []
        for number in range(round(seconds / CYCLE)):
            if controller is not None:
                self.commands = tuple(controller(number * CYCLE))
            self.write()
            await asyncio.sleep(CYCLE)
            rows.append(self.station.joints - self.commands)
        return np.array(rows)


def hold(joints):
    """A controller that holds the position that it read when it was activated."""
    return lambda _: joints


def quintic(begin, end, seconds):
    """joint_trajectory_controller: a segment between two points at rest."""

    def at(time):
        x = min(time / seconds, 1.0)
        share = x**3 * (10 - 15 * x + 6 * x**2)
        return begin + share * (end - begin)

    return at


def test_trajectory_of_a_controller_is_followed():
    """At 250 Hz the robot is behind by the gain of the guidance (5 /s), and ends at the goal."""

    async def use(s):
        hardware = Hardware(s, math.nan)
        begin = s.joints
        await hardware.update(1.0)
        assert not s.streamer.is_open
        await hardware.update(2.5, hold(begin))
        assert s.streamer.is_measuring
        assert np.abs(s.joints - begin).max() < 1e-3
        goal = begin + np.array([0.3, -0.1, 0.1, 0.2, -0.2, 0.3])
        behind = await hardware.update(2.0, quintic(begin, goal, 2.0))
        peak = 0.3 * 1.875 / 2.0
        assert np.abs(behind).max() < 2 * peak / 5
        await hardware.update(2.0, hold(goal))
        assert np.abs(s.joints - goal).max() < 1e-3
        # A controller that holds for longer than `idle` keeps the session.
        await hardware.update(1.0, hold(goal))
        assert s.streamer.is_measuring
        assert not s.reports, s.reports

    streamed(use, is_hardware=True, speed=1.0, idle=1.0)


def test_commands_elsewhere_do_not_move_the_robot():
    """The zeros of 0.2.1, and an old command after a restart: nothing goes there."""

    async def use(s):
        begin = s.joints
        hardware = Hardware(s, 0.0)
        away = begin + 0.2
        await hardware.update(2.0, hold(away))
        assert np.abs(s.joints - begin).max() < 1e-6
        assert not s.streamer.is_open
        (code,) = {report.code for report in s.reports}
        assert code == "RG694"
        assert "0.200 away from where the robot stands" in s.reports[0].text
        # Passing by is not resting there.
        await hardware.update(2.0, quintic(away, begin - 0.2, 2.0))
        assert not s.streamer.is_open
        assert np.abs(s.joints - begin).max() < 1e-6

    streamed(use, is_hardware=True)


def test_trajectory_after_a_stop_does_not_go_on():
    """JTC sends the rest of its trajectory whether the robot moves or not."""

    async def use(s):
        hardware = Hardware(s, math.nan)
        begin = s.joints
        await hardware.update(2.0, hold(begin))
        way = quintic(begin, begin + 0.4, 4.0)
        await hardware.update(1.5, way)
        await s.link.stop()
        stopped = s.joints
        await hardware.update(1.0, lambda time: way(1.5 + time))
        braked = s.joints
        assert np.abs(braked - stopped).max() < 0.1
        await hardware.update(1.5, hold(begin + 0.4))
        assert np.abs(s.joints - braked).max() < 1e-3
        assert s.reports[-1].code == "RG694"
        # A controller that is activated again begins where the robot stands.
        here = s.joints
        await hardware.update(2.0, hold(here))
        assert s.streamer.is_measuring
        await hardware.update(2.2, quintic(here, here + 0.1, 1.0))
        assert np.abs(s.joints - (here + 0.1)).max() < 1e-3

    streamed(use, is_hardware=True, speed=1.0)
