"""The node as a process of its own, with the real rclpy."""

import os
import signal
import subprocess
import sys

import pytest
from messages import IS_REAL
from test_node import LONG, action, ended, goal, wait_for_line

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system

pytestmark = pytest.mark.skipif(not IS_REAL, reason="needs the real rclpy")

BROKEN = """
import sys
from rapidgen.ros import node


def broken(self, states):
    raise RuntimeError("the middleware is gone")


node.GroupInterface.joint_states = broken
sys.exit(node.run(sys.argv))
"""


@pytest.fixture
def sim():
    config = load_config("irb120")
    system = make_system(config, build(config))
    with VirtualController(
        system, config.groups, clock="real", speed=10.0, ports="auto"
    ) as controller:
        controller.start()
        yield controller


@pytest.fixture
def client(_rclpy):
    from real import Client

    made = Client()
    yield made
    made.close()


@pytest.fixture
def process(sim):
    started = []

    def start(*program):
        address = str(sim.address("rob1", timeout=60))
        parameters = ["--ros-args", "-p", "config:=irb120", "-p", f"address:={address}"]
        started.append(
            subprocess.Popen(
                [sys.executable, *program, *parameters],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                env={**os.environ, "RCUTILS_LOGGING_BUFFERED_STREAM": "0"},
            )
        )
        return started[-1]

    yield start
    for one in started:
        one.kill()
        one.communicate()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_stops_the_robot_and_aborts_the_goal(sim, client, process, number):
    node = process("-m", "rapidgen.ros")
    client.topics["robot_status"].wait(lambda report: report.motion_possible.val == 1)
    handle = action(client).send(goal(0.0, 0.5, seconds=LONG))
    client.topics["joint_states"].wait(lambda report: report.position[0] > 1e-3)
    node.send_signal(number)
    assert ended(handle)[0] == "aborted"
    assert node.wait(60) == 0
    assert sim.call(lambda: sim.motion.groups["rob1"].is_standing)


def test_fault_while_publishing_ends_the_process(process):
    """Launch can respawn a process that has ended, not one that does nothing (R1)."""
    node = process("-c", BROKEN)
    text, _ = node.communicate(timeout=60)
    assert node.returncode == 1
    assert "the link ended by a fault of this node: RuntimeError('the middleware" in text
    assert "Traceback" not in text


def test_second_node_on_a_robot_is_reported_by_both(sim, driver_type):
    """Each stops the other's motions (R2)."""
    address = str(sim.address("rob1", timeout=60))
    parameters = {"config": "irb120", "address": address}
    nodes = [driver_type(parameter_overrides=parameters, namespace=f"/{x}") for x in ("one", "two")]
    try:
        for node, other in zip(nodes, ("/two/rapidgen", "/one/rapidgen"), strict=True):
            text = f"another node is connected to this robot: {other}"
            own = node.node.get_namespace()

            def reported(message, text=text, own=own):
                values = {one.key: one.value for one in message.status[0].values}
                return text in message.status[0].message and values["node"].startswith(own)

            node.topics["/diagnostics"].wait(reported)
            wait_for_line(node.get_logger(), text)
    finally:
        for node in nodes:
            node.destroy_node()
