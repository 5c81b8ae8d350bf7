"""Overhead of the ROS 2 node over a bare client and publisher.

    python benchmarks/ros_node.py [--rounds N] [--seconds S]

One run with a real rclpy; the Python is that of a sourced ROS 2. Both publish the joints of the
same `rapidgen sim` at the same time: the controller takes up to 30 ms to send a sample, which
belongs to neither. The output is the delay of each after the client's stamp of the sample, and each
process' share of a core. The first connection is served first: they take turns in that.
"""

import argparse
import asyncio
import os
import re
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import rclpy
from builtin_interfaces.msg import Time
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState

from rapidgen.client import AsyncRobot
from rapidgen.ros.time_stamps import RosTimeEstimator

LATER, MORE = 2.0, 5.0
"""ms of p99, and points of CPU, that the node may add."""


async def bare(address):
    """Run a client, and a publisher of its data."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node, stamps = rclpy.create_node("bare"), RosTimeEstimator()
    publisher = node.create_publisher(JointState, "/bare/joint_states", QoSProfile(depth=10))
    async with AsyncRobot("irb120", address=address, feedback=True, watch=True) as robot:
        while True:
            fed = await robot.next_feedback()
            message = JointState(name=list(robot.group.names))
            message.position, message.velocity = list(fed.joints), list(fed.velocity)
            seconds, remaining = divmod(stamps.stamp(fed.time, time.time()), 10**9)
            message.header.stamp = Time(sec=seconds, nanosec=remaining)
            publisher.publish(message)


def cpu(process):
    """Return s of CPU that a process has used."""
    text = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(text[11]) + int(text[12])) / os.sysconf("SC_CLK_TCK")


def delays(commands, seconds):
    """Return ms after the stamps of `bare`, and the core share in percent.

    By name.
    """
    node, text, running = rclpy.create_node("ear"), {name: [] for name in commands}, {}

    def hear(name, message):
        stamp = message.header.stamp
        text[name].append((stamp.sec + stamp.nanosec * 1e-9, time.time()))

    for name in commands:
        node.create_subscription(JointState, f"/{name}/joint_states", partial(hear, name), 50)
    try:
        for name, command in commands.items():
            running[name] = subprocess.Popen(command)
            begin = time.monotonic()
            while len(text[name]) < 20:
                assert time.monotonic() - begin < 60, f"no joint_states of {name}"
                rclpy.spin_once(node, timeout_sec=0.5)
        for samples in text.values():
            samples.clear()
        begin, used = time.monotonic(), {name: cpu(one) for name, one in running.items()}
        while time.monotonic() - begin < seconds:
            rclpy.spin_once(node, timeout_sec=0.1)
        passed = time.monotonic() - begin
        share = {name: (cpu(one) - used[name]) / passed * 100 for name, one in running.items()}
    finally:
        for one in running.values():
            one.terminate()
            one.wait()
        node.destroy_node()
    stamps = np.array([stamp for stamp, _ in text["bare"]])
    late = {}
    for name, samples in text.items():
        own = np.array(samples)
        # The same samples: their stamps differ by less than half a period.
        nearest = stamps[np.abs(own[:, :1] - stamps).argmin(axis=1)]
        same = np.abs(own[:, 0] - nearest) < np.median(np.diff(stamps)) / 2
        late[name] = (own[same, 1] - nearest[same]) * 1e3
    return late, share


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--bare", help=argparse.SUPPRESS)
    requested = parser.parse_args()
    if requested.bare:
        asyncio.run(bare(requested.bare))
    # When interrupted, it ends the processes that it has started.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    program = str(Path(sys.executable).with_name("rapidgen"))
    sim = subprocess.Popen(
        [program, "sim", "irb120", "--ports", "auto"], stdout=subprocess.PIPE, text=True
    )
    try:
        address = re.search(r'"address": \{"rob1": "([^"]+)"', sim.stdout.readline())[1]
        node = ["-m", "rapidgen.ros", "--ros-args", "-r", "__ns:=/node", "-p", "config:=irb120"]
        commands = {
            "bare": [sys.executable, __file__, "--bare", address],
            "node": [sys.executable, *node, "-p", f"address:={address}"],
        }
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
        result = {name: ([], []) for name in commands}
        for number in range(requested.rounds):
            order = sorted(commands, reverse=number % 2 == 1)
            late, share = delays({name: commands[name] for name in order}, requested.seconds)
            for name in commands:
                result[name][0].append(np.quantile(late[name], 0.99))
                result[name][1].append(share[name])
    except KeyboardInterrupt:
        return 130
    finally:
        sim.terminate()
        rclpy.try_shutdown()
    late, share = ({name: np.median(one[i]) for name, one in result.items()} for i in (0, 1))
    for name in commands:
        print(f"{name}: p99 {late[name]:.2f} ms, {share[name]:.1f} % of a core")
    adds = late["node"] - late["bare"], share["node"] - share["bare"]
    saved = adds[0] <= LATER and adds[1] <= MORE
    print(f"adds {adds[0]:+.2f} ms and {adds[1]:+.1f} points: {'kept' if saved else 'MISSED'}")
    return 0 if saved else 1


if __name__ == "__main__":
    sys.exit(main())
