"""Delays of commands and goals of the ROS 2 node, with a real rclpy.

    python benchmarks/ros_streaming.py [--twists N] [--goals N]

The Python is that of a sourced ROS 2. The node, `rapidgen sim` and this client are three processes.
The datagrams of externally guided motion pass through this one, which notes when they change: the
answers of the node (a command has reached the wire) and the frames of the controller (an axis has
moved). During goals there are only joint_states, 50 in a second: a motion is known from the arrival
of the first sample that shows it; the time of braking is the controller's own.
"""

import argparse
import json
import os
import select
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / "ros"), str(ROOT / "tests" / "client")]

import real  # noqa: E402
from geometry_msgs.msg import TwistStamped  # noqa: E402
from messages import Duration, FollowJointTrajectory, JointTrajectoryPoint  # noqa: E402
from rclpy.qos import QoSProfile  # noqa: E402
from rclpy.utilities import get_rmw_implementation_identifier  # noqa: E402

from rapidgen.wire.egm.codec import decode_robot, decode_sensor  # noqa: E402

CONFIG = str(ROOT / "robots" / "examples" / "irb120_egm-rw6.yaml")
MOVED = 1e-4
"""deg: a change of a joint that is a motion."""
STANDS = 1e-3
"""rad/s: lower speeds count as standing."""
DATAGRAM, MOTION, GOAL, CANCEL = 8.0, 40.0, 60.0, 60.0
"""ms, limits of medians; CANCEL is beyond the time of braking."""


class Relay(threading.Thread):
    """Passes datagrams on, and keeps the time and the joints (deg) of each."""

    def __init__(self, node_port):
        super().__init__(daemon=True)
        self.controller = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.controller.bind(("127.0.0.1", 0))
        self.node = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.node.bind(("127.0.0.1", 0))
        self.port = self.controller.getsockname()[1]
        self.to_node, self.back = ("127.0.0.1", node_port), None
        self.frames, self.answers = [], []

    def run(self):
        while True:
            for ready in select.select([self.controller, self.node], [], [])[0]:
                try:
                    data, source = ready.recvfrom(65_536)
                except ConnectionRefusedError:
                    continue  # No session of the node listens.
                now = time.monotonic()
                if ready is self.controller:
                    self.back = source
                    self.node.sendto(data, self.to_node)
                    self.frames.append((now, decode_robot(data).measured.joints))
                else:
                    self.controller.sendto(data, self.back)
                    self.answers.append((now, decode_sensor(data).joints))

    def changed(self, rows, begin, timeout=5.0):
        """Return s from `begin` to the first change of `rows`, a list of this relay."""
        number = next((i for i in range(len(rows) - 1, -1, -1) if rows[i][0] <= begin), 0)
        first = rows[number][1] if rows and rows[number][0] <= begin else None
        while time.monotonic() - begin < timeout:
            if number >= len(rows):
                time.sleep(0.001)
                continue
            at, joints = rows[number]
            number += 1
            if at <= begin or joints is None:
                continue
            if first is None:
                first = joints
            elif np.abs(np.subtract(joints, first)).max() > MOVED:
                return at - begin
        raise TimeoutError("no motion")


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def twist(publisher, clock, speed):
    message = TwistStamped()
    message.header.frame_id = "base_link"
    message.header.stamp = clock.now().to_msg()
    message.twist.linear.z = speed
    publisher.publish(message)


def commands(client, relay, count):
    """Return s from a twist to the datagram, and to the first motion; and joint_states."""
    clock = client.client.get_clock()
    publisher = client.client.create_publisher(
        TwistStamped, "/rapidgen/twist_commands", QoSProfile(depth=1)
    )
    until = time.monotonic() + 60
    # The first ones open the session.
    while not relay.answers or np.ptp([row[1][2] for row in relay.answers[-20:]]) < 0.1:
        assert time.monotonic() < until, "no session"
        twist(publisher, clock, -0.05)
        time.sleep(0.02)
    arrivals, stamps = [], []

    def heard(message):
        arrivals.append(time.monotonic())
        stamps.append(message.header.stamp.sec + message.header.stamp.nanosec * 1e-9)

    client.client.create_subscription(
        real._type("sensor_msgs/msg/JointState"), "/joint_states", heard, 50
    )
    time.sleep(1.5)
    chance, to_wire, to_motion = np.random.default_rng(1), [], []
    arrivals.clear()
    stamps.clear()
    for number in range(count):
        time.sleep(2.0 + chance.uniform(0, 0.02))
        speed, begin = (-0.05, 0.05)[number % 2], time.monotonic()
        for _ in range(4):
            twist(publisher, clock, speed)
            time.sleep(0.02)
        to_wire.append(relay.changed(relay.answers, begin))
        to_motion.append(relay.changed(relay.frames, begin))
    return np.array(to_wire), np.array(to_motion), np.diff(arrivals), np.diff(stamps)


def path(*rows, seconds):
    goal = FollowJointTrajectory.Goal()
    goal.trajectory.joint_names = [f"joint_{n}" for n in range(1, 7)]
    goal.trajectory.points = [
        JointTrajectoryPoint(
            positions=[float(value) for value in row],
            time_from_start=Duration(sec=int(n * seconds), nanosec=int(n * seconds % 1 * 1e9)),
        )
        for n, row in enumerate(rows)
    ]
    return goal


class Samples:
    """Arrivals, positions and speeds of the first joint in joint_states, and stamps; s."""

    def __init__(self, node):
        self.rows = []
        kind = real._type("sensor_msgs/msg/JointState")
        node.create_subscription(kind, "/joint_states", self._heard, 50)

    def _heard(self, message):
        stamp = message.header.stamp
        row = (message.position[0], message.velocity[0], stamp.sec + stamp.nanosec * 1e-9)
        self.rows.append((time.time(), *row))

    def after(self, begin):
        """Return (n, 4) rows that came after `begin`."""
        return np.array([row for row in list(self.rows) if row[0] > begin])


def standing(samples, begin):
    """Return s from `begin` to standstill, and s of braking."""
    time.sleep(2.0)
    times, _, speeds, stamps = samples.after(begin - 0.2).T
    speeds = np.abs(speeds)
    cruise = np.median(speeds[times <= begin])
    after = np.flatnonzero(times > begin)
    brakes = next(i for i in after if speeds[i] < 0.97 * cruise)
    stands = next(i for i in after if i > brakes and speeds[i] < STANDS)
    # It began to brake after the sample before.
    return times[stands] - begin, stamps[stands] - stamps[brakes - 1]


def goals(client, count):
    """Return s from a goal to the first motion, and from its cancellation to standstill.

    The time of braking is not part of the latter.
    """
    samples = Samples(client.client)
    action = client.actions["rob1_controller/follow_joint_trajectory"]
    to_motion, to_stand = [], []
    time.sleep(1.0)
    for number in range(count):
        here = np.array(client.topics["joint_states"].sent[-1].position)
        there = np.add(here, [(0.5, -0.5)[number % 2], 0, 0, 0, 0, 0])
        begin = time.time()
        handle = action.send(path(here, there, seconds=4.0))
        time.sleep(1.5)
        rows = samples.after(begin)
        moved = np.abs(rows[:, 1] - here[0]) > 2e-5
        to_motion.append(rows[moved][0, 0] - begin)
        begin = time.time()
        action.cancel(handle)
        total, braking = standing(samples, begin)
        to_stand.append(total - braking)
        assert handle.over.wait(60)
    return np.array(to_motion), np.array(to_stand)


def report(name, values, limit=None):
    """Print ms; return whether the median keeps its limit."""
    values = values * 1e3
    median, worst = np.median(values), np.quantile(values, 0.99)
    kept = limit is None or median <= limit
    text = "" if limit is None else f", at most {limit:g}: {'kept' if kept else 'MISSED'}"
    print(f"{name} ({len(values)}): median {median:.1f} ms, p99 {worst:.1f} ms{text}")
    return kept


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--twists", type=int, default=30)
    parser.add_argument("--goals", type=int, default=12)
    requested = parser.parse_args()
    # When interrupted, it ends the processes that it has started.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node_port = free_port()
    relay = Relay(node_port)
    relay.start()
    changes = [f"egm.port={node_port}", "egm.timeout=1", "state.rate=50"]
    real.start()
    print(f"rmw: {get_rmw_implementation_identifier()}; load {os.getloadavg()[0]:.1f}")
    words = [word for change in changes for word in ("--set", change)]
    program = [sys.executable, "-m", "rapidgen.cli", "sim", CONFIG, "--ports", "auto"]
    partner = ["--egm", f"ROS_EGM=127.0.0.1:{relay.port}"]
    running = [
        subprocess.Popen(
            [*program, *partner, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
    ]
    try:
        ready = json.loads(running[0].stdout.readline().removeprefix("ready "))
        arguments = ["-p", f"config:={CONFIG}", "-p", f"address:={ready['address']['rob1']}"]
        arguments += ["-p", f"overrides:={json.dumps(changes)}"]
        running.append(
            subprocess.Popen([sys.executable, "-m", "rapidgen.ros", "--ros-args", *arguments])
        )
        client = real.Client()
        client.topics["joint_states"].wait(lambda _: True)
        kept = []
        wire, motion, arrivals, stamps = commands(client, relay, requested.twists)
        kept.append(report("twist to datagram", wire, DATAGRAM))
        kept.append(report("twist to first motion", motion, MOTION))
        print(f"joint_states: {1 / np.mean(arrivals):.1f} Hz")
        report("  off 4 ms, stamps", np.abs(stamps - 0.004))
        report("  off 4 ms, arrivals", np.abs(arrivals - 0.004))
        time.sleep(1.0)
        begin, stand = goals(client, requested.goals)
        # The first one ends the session.
        kept.append(report("goal to first motion", begin[1:], GOAL))
        kept.append(report("cancel to standing, less braking", stand, CANCEL))
        client.close()
    finally:
        for process in reversed(running):
            process.terminate()
            process.wait()
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
