"""The node on rclpy, real or a stand-in, with a controller in real time."""

import signal
import sys
import time
from functools import partial
from itertools import pairwise

import pytest
from messages import (
    Duration,
    FollowJointTrajectory,
    JointTolerance,
    JointTrajectoryPoint,
    Time,
)

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system

NAMES = [f"joint_{n}" for n in range(1, 7)]
SPEED = 10.0
LONG = 600.0
"""Simulated s of a motion that is to go on while something is asked, however slow this machine."""


@pytest.fixture
def rate():
    """Hz of the driver's states; None: its default."""
    return None


@pytest.fixture
def sim(rate):
    config = load_config("irb120", overrides=[f"state.rate={rate}"] if rate else [])
    system = make_system(config, build(config))
    with VirtualController(
        system, config.groups, clock="real", speed=SPEED, ports="auto"
    ) as controller:
        controller.start()
        yield controller


@pytest.fixture
def node(driver_type, sim):
    made = []

    def make(**parameters):
        address = str(sim.address("rob1", timeout=60))
        made.append(
            driver_type(parameter_overrides={"config": "irb120", "address": address, **parameters})
        )
        return made[-1]

    yield make
    for one in made:
        one.destroy_node()


@pytest.fixture
def up(node):
    def make(**parameters):
        one = node(**parameters)
        one.topics["robot_status"].wait(lambda report: report.motion_possible.val == 1)
        return one

    return make


def goal(*rows, seconds=1.0, **report):
    points = [
        JointTrajectoryPoint(
            positions=[float(row)] * 6,
            time_from_start=Duration(sec=int(n * seconds), nanosec=int(n * seconds % 1 * 1e9)),
        )
        for n, row in enumerate(rows)
    ]
    requested = FollowJointTrajectory.Goal(**report)
    requested.trajectory.joint_names = NAMES
    requested.trajectory.points = points
    return requested


def ended(handle):
    assert handle.over.wait(60)
    return handle.status, handle.result.error_code, handle.result.error_string


def wait_for_line(logger, text):
    """Wait until a line with `text` is logged."""
    with logger.logged:
        assert logger.logged.wait_for(lambda: any(text in line for line in logger.lines), 60)


def action(node):
    return node.actions["rob1_controller/follow_joint_trajectory"]


def test_a_goal_from_end_to_end(up):
    node = up()
    handle = action(node).send(goal(0.0, 0.1, 0.2))
    status, code, text = ended(handle)
    assert (status, code) == ("succeeded", 0)
    assert "done in" in text
    assert handle.feedback[-1].joint_names == NAMES
    assert len(handle.feedback[-1].error.positions) == 6
    states = node.topics["joint_states"].wait(lambda logged: logged.position[0] > 0.1999)
    assert states.name == NAMES
    assert len(states.velocity) == 6
    assert states.header.stamp.sec > 0


def test_publishers_are_reliable_volatile_and_ten_deep(up):
    node = up()
    assert node.published == {"/joint_states", "/diagnostics", "/robot_status"}
    for topic in ("joint_states", "/diagnostics", "robot_status"):
        assert node.qos(topic) == ("RELIABLE", "VOLATILE", 10)
        assert node.is_qos_overridable(topic)


def test_refused_is_aborted_with_its_reason(up):
    node = up()
    status, code, text = ended(action(node).send(goal(0.0, 9.0, 0.0)))
    assert (status, code) == ("aborted", -1)
    assert "outside its limits" in text
    stamped = goal(0.0, 0.1)
    stamped.trajectory.header.stamp = Time(sec=0, nanosec=5)
    status, code, text = ended(action(node).send(stamped))
    assert (status, code) == ("aborted", -3)
    toleranced = goal(0.0, 0.1, path_tolerance=[JointTolerance(name="elbow", position=1.0)])
    assert "not a joint here" in ended(action(node).send(toleranced))[2]


CELL = """
robots: {T_ROB1: {model: irb120, shapes: none}}
tools: {tBall: {frame: {position: [0, 0, 40]}, load: {mass: 1}, shapes: [{sphere: 30}]}}
things: {table: {half_space: [0, 0, 1], frame: {position: [0, 0, 300]}}}
collision: {}
"""


def test_goal_into_an_object_of_the_cell_is_refused_with_the_pair(up, tmp_path):
    (tmp_path / "cell.yaml").write_text(CELL)
    node = up(cell=str(tmp_path / "cell.yaml"))
    wait_for_line(node.get_logger(), "have no shapes")
    status, code, text = ended(action(node).send(goal(0.0, 0.9, seconds=5.0)))
    assert (status, code) == ("aborted", -1)
    assert "tBall touches table" in text
    assert ended(action(node).send(goal(0.0, 0.1)))[0] == "succeeded"


def test_good_goal_after_refused_one_succeeds(up):
    """rclpy ends a goal ABORTED and without a text where the callback raises, as its logger did."""
    node = up()
    assert ended(action(node).send(goal(9.0, 9.1)))[0] == "aborted"
    status, code, text = ended(action(node).send(goal(0.0, 0.1)))
    assert (status, code, "done in" in text) == ("succeeded", 0, True)


def test_cancel_is_canceled_and_of_a_second_goal_leaves_the_first(up):
    node = up()
    first = action(node).send(goal(0.0, 0.5, 1.0, seconds=LONG))
    assert first.fed.wait(60)
    second = action(node).send(goal(0.5, 0.0))
    assert ended(second)[0] == "aborted"
    assert first.status == "executing"
    action(node).cancel(first)
    status, code, text = ended(first)
    assert (status, code) == ("canceled", 0), text


def test_services_and_speed(up):
    node = up()
    report = node.services["resume"]()
    assert (report.success, "nothing was paused" in report.message) == (False, True)
    handle = action(node).send(goal(0.0, 0.5, seconds=LONG))
    assert handle.fed.wait(60)
    assert node.services["pause"]().success
    assert node.services["resume"]().success
    assert node.set("speed", 50.0).successful
    refused = node.set("speed", 500.0)
    assert (refused.successful, "1 to 100" in refused.reason) == (False, True)
    assert node.get_parameter("speed").value == 50.0
    assert node.services["stop"]().success
    assert ended(handle)[0] == "aborted"


def test_the_parameter_speed_ends_with_the_motion(up):
    node = up()
    refused = node.set("speed", 50.0)
    assert (refused.successful, "no trajectory" in refused.reason) == (False, True)
    handle = action(node).send(goal(0.0, 0.5, seconds=LONG))
    assert handle.fed.wait(60)
    assert node.set("speed", 50.0).successful
    action(node).cancel(handle)
    assert ended(handle)[0] == "canceled"
    assert node.get_parameter("speed").value == 100.0


def test_a_parameter_that_would_change_nothing_is_refused(up):
    refused = up().set("replace", "approach")
    assert (refused.successful, "when the node is configured" in refused.reason) == (False, True)


def test_stop_ends_a_goal_that_waits_for_its_moment(up):
    node = up()
    later = goal(0.0, 0.5)
    later.trajectory.header.stamp = Time(sec=int(time.time()) + 30, nanosec=0)
    handle = action(node).send(later)
    assert node.services["stop"]().success
    status, code, text = ended(handle)
    assert (status, code) == ("aborted", -1)
    assert "stopped on request before it started" in text


def test_a_goal_is_judged_by_the_overridden_configuration(up):
    node = up(overrides=["joints.joint_1.upper=1"])
    status, code, text = ended(action(node).send(goal(0.0, 0.1)))
    assert (status, code, "outside its limits" in text) == ("aborted", -1, True)


@pytest.mark.parametrize("rate", [50])
def test_clock_is_the_controllers_and_has_50_hz(up, rate):
    """A simulator with another speed: its time is that of all stamps."""
    node = up(publish_clock=True, overrides=[f"state.rate={rate}"])
    clock = node.topics["/clock"]
    first = clock.wait(lambda _: True).clock
    clock.wait(lambda message: message.clock.sec - first.sec >= 3)
    times = [message.clock.sec + message.clock.nanosec * 1e-9 for message in clock.sent]
    steps = sorted(b - a for a, b in pairwise(times))
    assert steps[0] > 0
    assert steps[len(steps) // 2] == pytest.approx(0.02, abs=1e-3)
    states = node.topics["joint_states"].wait(lambda _: True)
    assert abs(states.header.stamp.sec - times[-1]) < 10


def test_clock_below_50_hz_is_reported(up):
    node = up(publish_clock=True)
    wait_for_line(node.get_logger(), "/clock has the 10 Hz of the states")


def test_up_before_the_robot_and_says_why_it_waits(driver_type):
    overrides = {"config": "irb120", "address": "127.0.0.1:1,1"}
    node = driver_type(parameter_overrides=overrides)
    report = node.topics["/diagnostics"].wait(lambda report: report.status[0].level == b"\x03")
    assert "no link to the robot: cannot connect" in report.status[0].message
    assert node.topics["joint_states"].sent == []
    assert "no link" in ended(action(node).send(goal(0.0, 0.1)))[2]
    assert not node.services["stop"]().success
    node.destroy_node()


def test_ends_with_a_goal_under_way_and_the_robot_stands(up, sim):
    node = up()
    handle = action(node).send(goal(0.0, 0.5, seconds=LONG))
    assert handle.fed.wait(60)
    node.trigger_deactivate()
    assert ended(handle)[0] == "aborted"
    group = next(iter(sim.motion.groups.values()))
    assert group.is_standing
    node.trigger_cleanup()
    assert not node.published


def test_end_of_link_is_logged_and_diagnosed(up):
    """A node that cannot publish is no use: `run` ends it, so that launch can respawn it (R1)."""
    node = up()
    diagnostics = node.topics["/diagnostics"]
    node.break_joint_states(RuntimeError("the middleware is gone"))
    report = diagnostics.wait(lambda report: report.status[0].level == b"\x02")
    assert "middleware is gone" in report.status[0].message
    assert "middleware is gone" in node.fault
    wait_for_line(node.get_logger(), "middleware is gone")


def test_refusal_is_an_error_code_of_robot_status(up):
    """ROS 2's message has a list (industrial_msgs of industrial_core, branch ros2_msgs_only)."""
    node = up()
    status = node.topics["robot_status"]
    assert list(status.wait(lambda report: report.motion_possible.val == 1).error_codes) == []


@pytest.mark.parametrize(
    ("parameters", "report"),
    [
        ({"config": "irb12o"}, "irb12o"),
        ({"config": "irb120", "address": "not an address"}, "is not an address of a robot"),
        ({"config": "irb14000", "address": "127.0.0.1:11000"}, "irb14000 has 2 of them"),
        ({"config": "irb120", "overrides": ["ports.moton=1"]}, "unknown key 'moton'"),
        ({"config": "irb120", "cell": "/no/such/cell.yaml"}, "cell.yaml"),
        ({"config": "irb120", "control": "moveit"}, "it is node or ros2_control"),
        ({"config": "irb120", "control": "ros2_control"}, "rob1 has no `egm:`"),
        # An override is of a motion: the first goal would have gone at full speed.
        ({"config": "irb120", "speed": 20.0}, "would not move"),
    ],
)
def test_invalid_configuration_is_logged(driver_type, parameters, report):
    node = driver_type(parameter_overrides=parameters)
    assert node.state == "unconfigured"
    wait_for_line(node.get_logger(), report)
    node.destroy_node()


@pytest.mark.parametrize(
    ("number", "before"),
    [
        (signal.SIGINT, signal.SIG_IGN),
        (signal.SIGTERM, signal.SIG_IGN),
        (signal.SIGHUP, signal.SIG_DFL),
    ],
)
def test_signal_aborts_the_goal_and_ends_the_node(
    sourced, driver_type, sim, monkeypatch, number, before
):
    """As started by `&` of a script, with SIGINT ignored: the robot stands when the node ends."""
    module = sys.modules["rapidgen.ros.node"]
    handles = []

    class Executor:
        def __init__(self, num_threads):
            pass

        def add_node(self, node):
            self.node = node

        def spin_once(self, timeout_sec):
            if handles:
                handles[0].over.wait(timeout_sec)
                return
            node = self.node
            node.topics["robot_status"].wait(lambda report: report.motion_possible.val == 1)
            handles.append(action(node).send(goal(0.0, 0.5, seconds=LONG)))
            node.topics["joint_states"].wait(lambda report: report.position[0] > 1e-3)
            signal.raise_signal(number)

    parameters = {"config": "irb120", "address": str(sim.address("rob1", timeout=60))}
    monkeypatch.setattr(module, "MultiThreadedExecutor", Executor)
    monkeypatch.setattr(module, "RobotNode", partial(driver_type, parameter_overrides=parameters))
    for name in ("init", "try_shutdown"):
        monkeypatch.setattr(module.rclpy, name, lambda **_: None, raising=False)
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    handlers = {one: signal.getsignal(one) for one in numbers}
    try:
        signal.signal(number, before)
        assert module.run([]) == 0
        stood = sim.call(sim.motion.groups["rob1"].positions)
    finally:
        for one, handler in handlers.items():
            signal.signal(one, handler)
    assert ended(handles[0])[0] == "aborted"
    assert 1e-3 < stood[0] < 0.5
    assert sim.call(lambda: sim.motion.groups["rob1"].is_standing)
