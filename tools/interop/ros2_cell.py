"""One controller, one node of rapidgen, and an rclpy client of both."""

import os
import signal
import sys
import threading
import time
from collections import defaultdict
from contextlib import suppress
from pathlib import Path

import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectoryPoint

from rapidgen.config import load_config
from tools.interop.ros import HOST, Process, Simulated, until

SUCCEEDED, CANCELED, ABORTED = (
    GoalStatus.STATUS_SUCCEEDED,
    GoalStatus.STATUS_CANCELED,
    GoalStatus.STATUS_ABORTED,
)
ENDINGS = {SUCCEEDED: "SUCCEEDED", CANCELED: "CANCELED", ABORTED: "ABORTED"}


class Sent:
    """A sent goal and its responses."""

    def __init__(self, cell: "Cell", client: ActionClient, goal) -> None:
        self._cell = cell
        self.feedback = []
        self.began = time.monotonic()
        self.handle = cell.asked(lambda: client.send_goal_async(goal, self._fed), 30)
        self._result = None
        if self.handle.accepted:
            self._result = cell.inside(self.handle.get_result_async)

    def _fed(self, message) -> None:
        self.feedback.append(message.feedback)

    @property
    def is_over(self) -> bool:
        """True if there is a result."""
        return self._result is None or self._result.done()

    def end(self, seconds: float = 60.0):
        """Wait for status, error_code and error_string."""
        assert self._result is not None, "the goal was rejected"
        text = self._cell.wait(self._result, seconds)
        self.took = time.monotonic() - self.began
        return text.status, text.result.error_code, text.result.error_string

    def cancel(self, seconds: float = 10.0):
        """Cancel the goal and return the response."""
        return self._cell.asked(self.handle.cancel_goal_async, seconds)


class Cell:
    """The controller at HOST, the node, and a client. Close it."""

    def __init__(self, robot: str, *options: str, parameters: tuple[str, ...] = ()) -> None:
        self.robot, self._parameters = robot, parameters
        self.config = load_config(robot)
        self.sim = Simulated(robot, *options)
        rclpy.init()
        self.client = Node("bench")
        self.received = defaultdict(list)
        self.client.create_subscription(JointState, "joint_states", self._into("states"), 50)
        self.client.create_subscription(DiagnosticArray, "/diagnostics", self._into("health"), 50)
        self.actions = {
            group.name: ActionClient(
                self.client,
                FollowJointTrajectory,
                f"{group.name}_controller/follow_joint_trajectory",
            )
            for group in self.config.groups
        }
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.client)
        threading.Thread(target=self._spin, daemon=True).start()
        self.start_node()

    def _spin(self) -> None:
        with suppress(ExternalShutdownException):
            while rclpy.ok():
                self._executor.spin_once(0.2)

    def _into(self, name: str):
        return lambda message: self.received[name].append((time.monotonic(), message))

    def start_node(self, *more: str) -> None:
        """Start the node; wait for it and its robot."""
        arguments = [f"config:={self.robot}", f"address:={HOST}", *self._parameters, *more]
        command = [sys.executable, "-m", "rapidgen.ros", "--ros-args"]
        for one in arguments:
            command += ["-p", one]
        self.node = Process(command)
        self.ready()

    def ready(self) -> None:
        """Wait for the action servers and for joint_states from now on."""
        since = time.monotonic()
        for client in self.actions.values():
            assert client.wait_for_server(timeout_sec=30), self.node.lines[-5:]
        until(lambda: self.state_since(since), 30, f"no joint_states: {self.node.lines[-5:]}")

    def state_since(self, since: float) -> bool:
        """True if joint_states arrived since then."""
        return bool(self.received["states"]) and self.received["states"][-1][0] > since

    def inside(self, act):
        """Call `act` while nothing else of the client runs.

        rclpy's clients race with answers.
        """
        return self.wait(self._executor.create_task(act), 10)

    def asked(self, act, seconds: float):
        """Return the answer to the request that `act` sends."""
        return self.wait(self.inside(act), seconds)

    def wait(self, future, seconds: float):
        """Return the result of an rclpy future."""
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        assert future.done() or done.wait(seconds), "no answer"
        return future.result()

    def call(self, kind: type, name: str, request=None, seconds: float = 20.0):
        """Return the response of a service."""
        client = self.client.create_client(kind, name)
        try:
            assert client.wait_for_service(timeout_sec=20), f"no service {name}"
            return self.asked(lambda: client.call_async(request or kind.Request()), seconds)
        finally:
            self.client.destroy_client(client)

    def trigger(self, name: str):
        """Return the response of a std_srvs/Trigger."""
        return self.call(Trigger, name)

    # -- goals -------------------------------------------------------------------------------

    def names(self, group: str) -> list[str]:
        """Return the joint names in the robot's order."""
        match = next(one for one in self.config.groups if one.name == group)
        return [joint.name for joint in match.joints]

    def goal(self, rows, step: float = 0.5, group: str = "", **text):
        """Return a goal of positions `step` s apart, from 0 s on.

        A number means all joints.
        """
        names = self.names(group or self.config.groups[0].name)
        goal = FollowJointTrajectory.Goal(**text)
        goal.trajectory.joint_names = names
        for number, row in enumerate(rows):
            positions = [float(row)] * len(names) if isinstance(row, (int, float)) else row
            seconds, remaining = divmod(round(number * step * 1e9), 10**9)
            goal.trajectory.points.append(
                JointTrajectoryPoint(
                    positions=[float(value) for value in positions],
                    time_from_start=Duration(sec=seconds, nanosec=remaining),
                )
            )
        return goal

    def send(self, goal, group: str = "") -> Sent:
        """Send a goal; return when it is accepted or rejected."""
        return Sent(self, self.actions[group or self.config.groups[0].name], goal)

    def moving(self, to: float = 1.0, seconds: float = 8.0) -> Sent:
        """Send a goal and return while the first joint moves."""
        current = self.sim.positions()[: len(self.names(self.config.groups[0].name))]
        sent = self.send(self.goal([current, [to, *current[1:]]], seconds))
        until(lambda: not self.sim.standing(), 15, "nothing moved")
        return sent

    def at(self, row, group: str = "rob1", tolerance: float = 1e-4) -> bool:
        """True if the axes are at `row`."""
        current = self.sim.positions(group)
        return max(abs(a - b) for a, b in zip(current, row, strict=False)) <= tolerance

    def memory(self) -> float:
        """Return resident MB of the node."""
        status = Path(f"/proc/{self.node.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024

    def close(self) -> None:
        """Stop the node, the client, the controller."""
        if self.node.alive:
            self.node.end(signal.SIGINT)
        if self.node.alive:
            os.kill(self.node.pid, signal.SIGKILL)
        rclpy.shutdown()
        self.sim.close()
