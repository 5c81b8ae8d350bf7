"""The nodes of ros-industrial/abb_driver with a simulated controller."""

import signal
import time
from contextlib import suppress
from pathlib import Path

from rapidgen.config import load_config
from tools.interop.ros import HOST, Process, Simulated, Workspace, until

TRUE, FALSE = 1, 0
"""industrial_msgs/TriState."""


class Cell:
    """One controller, one set of nodes, and all their topics."""

    def __init__(
        self,
        workspace: Workspace,
        target: str,
        *options: str,
        robot: str,
        urdf: Path,
        coupled: bool,
    ) -> None:
        from control_msgs.msg import FollowJointTrajectoryFeedback
        from industrial_msgs.msg import RobotStatus
        from rospy import Publisher, Subscriber
        from sensor_msgs.msg import JointState
        from trajectory_msgs.msg import JointTrajectory

        self.workspace = workspace
        self.names = [joint.name for joint in load_config(robot).groups[0].joints]
        workspace.parameters(
            robot_ip_address=HOST, J23_coupled=coupled, controller_joint_names=self.names
        )
        workspace.parameters(robot_description=urdf.read_text())
        self.sim = Simulated(target, *options)
        self.joints: list[tuple[float, JointState]] = []
        self.status: list[tuple[float, RobotStatus]] = []
        self.feedback: list[float] = []
        self._topics = [
            Publisher("joint_path_command", JointTrajectory, queue_size=10),
            Subscriber("joint_states", JointState, _into(self.joints)),
            Subscriber("robot_status", RobotStatus, _into(self.status)),
            Subscriber(
                "feedback_states",
                FollowJointTrajectoryFeedback,
                lambda _: self.feedback.append(time.monotonic()),
            ),
        ]
        self.nodes: dict[str, Process] = {}
        self.start_node("abb_driver", "robot_state")
        self.start_motion_node()

    def start_node(
        self, package: str, program: str, *arguments: str, name: str = "", kill_at: str = ""
    ) -> Process:
        """Start a node, replacing the one of that name."""
        node = self.workspace.node(package, program, *arguments, kill_at=kill_at)
        self.nodes[name or program] = node
        return node

    def start_motion_node(self, *, kill_at: str = "") -> Process:
        """Restart the motion node, and wait until all are ready."""
        node = self.start_node("abb_driver", "motion_download_interface", kill_at=kill_at)
        self.ready()
        return node

    def ready(self) -> None:
        """Wait until states arrive and the motion node listens."""
        from rospy import Publisher
        from trajectory_msgs.msg import JointTrajectory

        since = time.monotonic()
        # A new publisher: killed nodes are not its subscribers.
        self._topics[0].unregister()
        self._topics[0] = Publisher("joint_path_command", JointTrajectory, queue_size=10)
        until(lambda: self.joints and self.joints[-1][0] > since, 20, "no joint_states")
        until(lambda: self._topics[0].get_num_connections() >= 1, 20, "no motion node")
        until(lambda: self.status and self.status[-1][0] > since, 20, "no robot_status")

    # -- commands -----------------------------------------------------------------------------

    def trajectory(self, points, step: float = 0.5, start: float = 0.0):
        """Return a JointTrajectory: points (rad) `step` s apart from `start`."""
        import rospy
        from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

        count = len(self.names)
        message = JointTrajectory(joint_names=self.names)
        for number, point in enumerate(points):
            positions = [*point, *[0.0] * (count - len(point))]
            message.points.append(
                JointTrajectoryPoint(
                    positions=positions,
                    velocities=[0.0] * count,
                    time_from_start=rospy.Duration.from_sec(start + number * step),
                )
            )
        return message

    def publish(self, trajectory) -> float:
        """Publish a trajectory; return the time."""
        self._topics[0].publish(trajectory)
        return time.monotonic()

    def ramp(self, seconds: float, to: float = 0.8):
        """Return joint 1 from its position to another, in steps of 0.5 s."""
        current = self.sim.positions()
        steps = max(1, round(seconds / 0.5))
        return self.trajectory(
            [[current[0] + (to - current[0]) * k / steps, *current[1:]] for k in range(steps + 1)]
        )

    def stop(self, service: str = "stop_motion") -> float:
        """Call the stop_motion service; return the seconds until its answer."""
        return self._call(service, "StopMotion")

    def command_service(self, trajectory) -> float:
        """Call joint_path_command; return the seconds until its answer."""
        return self._call("joint_path_command", "CmdJointTrajectory", trajectory)

    def _call(self, name: str, kind: str, *arguments: object) -> float:
        import industrial_msgs.srv
        import rospy

        rospy.wait_for_service(name, timeout=5)
        service = rospy.ServiceProxy(name, getattr(industrial_msgs.srv, kind))
        begin = time.monotonic()
        answer = service(*arguments)
        assert answer.code.val == 1, answer
        return time.monotonic() - begin

    def action(self):
        """Return an action client; the first call starts its server's node."""
        import actionlib
        from control_msgs.msg import FollowJointTrajectoryAction

        if "joint_trajectory_action" not in self.nodes:
            self.start_node("industrial_robot_client", "joint_trajectory_action")
        client = actionlib.SimpleActionClient(
            "joint_trajectory_action", FollowJointTrajectoryAction
        )
        import rospy

        assert client.wait_for_server(rospy.Duration(10)), "no action server"
        # The action rejects goals until it has received a state.
        received = len(self.feedback)
        until(lambda: len(self.feedback) > received + 5, 10, "no feedback")
        return client

    def moving_by_action(self):
        """Return a client whose goal has moved for a second.

        The goal is joint 1 to 1.2 rad in 6 s.
        """
        client = self.action()
        client.send_goal(self.goal(self.ramp(6, to=1.2)))
        self.wait_moving(15)
        time.sleep(1)
        return client

    @staticmethod
    def ended(client, seconds: float) -> bool:
        """True if the goal of an action ends in time."""
        import rospy

        return client.wait_for_result(rospy.Duration(seconds))

    @staticmethod
    def goal(trajectory):
        """Return an action goal."""
        from control_msgs.msg import FollowJointTrajectoryGoal

        return FollowJointTrajectoryGoal(trajectory=trajectory)

    # -- observations -----------------------------------------------------------------------------

    @property
    def now(self):
        """Return the newest robot_status."""
        return self.status[-1][1]

    def next_status(self, count: int = 2):
        """Return the newest robot_status after `count` more."""
        expected = len(self.status) + count
        until(lambda: len(self.status) >= expected, 10, "robot_status has ended")
        return self.now

    def wait_moving(self, seconds: float = 5.0) -> None:
        """Wait until an axis moves."""
        until(lambda: not self.sim.standing(), seconds, "nothing moved")

    def wait_standing(self, seconds: float = 20.0) -> float:
        """Wait until the robot stands and reports so; return the time."""
        until(self.sim.standing, seconds, "it never stood")
        stood = time.monotonic()
        until(lambda: self.next_status().in_motion.val == FALSE, seconds, "in_motion stays")
        return stood

    def at(self, point, tolerance: float = 1e-4) -> bool:
        """True if the robot is at a point; omitted joints are 0."""
        current = self.sim.positions()
        expected = [*point, *[0.0] * (len(current) - len(point))]
        return max(abs(a - b) for a, b in zip(current, expected, strict=True)) <= tolerance

    def arrives(self, point, seconds: float) -> bool:
        """True if the robot gets to a point in time."""
        with suppress(AssertionError):
            until(lambda: self.at(point) and self.sim.standing(), seconds, "")
            return True
        return False

    def quiet(self, seconds: float = 1.5) -> bool:
        """True if no axis moves for `seconds`."""
        current = self.sim.positions()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if max(abs(a - b) for a, b in zip(current, self.sim.positions(), strict=True)) > 1e-6:
                return False
            time.sleep(0.05)
        return True

    def user_sees(self, since: float = 0.0) -> str:
        """Return the newest fault line of the pendant or event log."""
        words = ("refused", "Trajectory", "trajectory", "ROS", "ENTRY_")
        lines = self.sim.process.lines_containing(*words, since=since)
        return lines[-1] if lines else "-"

    def close(self) -> None:
        """Stop the nodes, then the controller."""
        for node in self.nodes.values():
            if node.alive:
                with suppress(ProcessLookupError):
                    node.send(signal.SIGCONT)
                node.end(signal.SIGKILL)
        for topic in self._topics:
            topic.unregister()
        self.sim.close()


def _into(store):
    return lambda message: store.append((time.monotonic(), message))
