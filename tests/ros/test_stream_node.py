"""Streaming topics on rclpy: real messages over DDS, and datagrams of a simulator over UDP."""

import json
import socket
import subprocess
import sys
import time

import pytest
from messages import (
    IS_REAL,
    Duration,
    Float64MultiArray,
    JointTrajectory,
    JointTrajectoryPoint,
    TwistStamped,
)

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system

EGM = "robots/examples/irb120_egm-rw6.yaml"


@pytest.fixture
def guided():
    """Address of a simulator in a process of its own, and what changes its configuration."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    # What a loaded machine delays is no loss; the driver's own limit stays in force.
    changes = [f"egm.port={port}", "egm.timeout=1"]
    words = [word for change in changes for word in ("--set", change)]
    process = subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", "sim", EGM, "--ports", "auto", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        ready = json.loads(process.stdout.readline().removeprefix("ready "))
        yield {"config": EGM, "overrides": changes, "address": ready["address"]["rob1"]}
    finally:
        process.terminate()
        process.wait()
        process.stdout.close()


@pytest.fixture
def unguided():
    """Address of a controller in this process, without EGM."""
    config = load_config("irb120")
    system = make_system(config, build(config))
    with VirtualController(system, config.groups, clock="real", ports="auto") as controller:
        controller.start()
        yield str(controller.address("rob1", timeout=60))


def twist(z, frame="base_link"):
    message = TwistStamped()
    message.header.frame_id = frame
    message.twist.linear.z = z
    return message


def streaming(node, code):
    """Wait for a diagnostic of the streaming topics; return its text."""

    def is_it(report):
        values = {value.key: value.value for status in report.status for value in status.values}
        return values.get("code") == code

    return node.topics["/diagnostics"].wait(is_it).status[0].message


@pytest.mark.skipif(not IS_REAL, reason="the stand-in has no DDS")
def test_twist_moves_the_robot_and_its_silence_stops_it(driver_type, guided):
    node = driver_type(parameter_overrides=guided)
    try:
        states = node.topics["joint_states"]
        states.wait(lambda message: True)
        begin = time.monotonic()
        while abs(states.sent[-1].position[2]) < 0.02:
            assert time.monotonic() - begin < 60
            node.send("~/twist_commands", twist(-0.05))
            time.sleep(0.02)
        node.send("~/twist_commands", twist(-0.05, frame="elbow"))
        assert "'elbow' is not known" in streaming(node, "RG694")
        states.wait(lambda message: max(abs(rate) for rate in message.velocity) < 1e-3)

        # What MoveIt Servo publishes, and velocities.
        there = list(states.sent[-1].position)
        there[0] += 0.05
        node.send("~/position_commands", Float64MultiArray(data=there))
        states.wait(lambda message: abs(message.position[0] - there[0]) < 1e-3)
        there[0] += 0.05
        point = JointTrajectoryPoint(positions=there, time_from_start=Duration(sec=1))
        names = [f"joint_{n}" for n in range(1, 7)]
        node.send("~/joint_trajectory", JointTrajectory(joint_names=names, points=[point]))
        states.wait(lambda message: abs(message.position[0] - there[0]) < 1e-3)
        while states.sent[-1].position[0] > there[0] - 0.02:
            node.send(
                "~/velocity_commands", Float64MultiArray(data=[-0.2, 0.0, 0.0, 0.0, 0.0, 0.0])
            )
            time.sleep(0.02)
    finally:
        node.destroy_node()


def test_without_egm_the_first_command_says_so(driver_type, unguided):
    node = driver_type(parameter_overrides={"config": "irb120", "address": unguided})
    try:
        node.topics["joint_states"].wait(lambda message: True)
        node.send("~/twist_commands", twist(-0.05))
        assert "allow_delayed" in streaming(node, "RG695")
    finally:
        node.destroy_node()
