"""Test goals of ROS 2 against a virtual controller, in your own CI.

In a shell that has sourced ROS 2, in an environment with rapidgen:

    launch_test examples/ros2_launch_test.py

Replace `irb120` with your configuration, and the goals with those of your nodes. With `--speed` the
controller is faster than real time; the node then publishes its time as /clock.
"""

import unittest

import launch_testing.actions
import launch_testing.asserts
import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from rclpy.action import ActionClient
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectoryPoint

CONFIG = "irb120"
RATE = "state.rate=50"
"""States, and so /clock, at 50 Hz."""
ACTION = "rob1_controller/follow_joint_trajectory"
JOINTS = [f"joint_{number}" for number in range(1, 7)]
TIMEOUT = 60.0
"""s that anything may take on a busy machine."""


def generate_test_description():
    """Start a virtual controller and the node; the tests begin at once and wait themselves."""
    simulator = ExecuteProcess(
        cmd=["rapidgen", "sim", CONFIG, "--set", RATE, "--speed", "5"], output="screen"
    )
    node = ExecuteProcess(
        cmd=[
            "python3", "-m", "rapidgen.ros", "--ros-args",
            "-p", f"config:={CONFIG}",
            "-p", f"overrides:=['{RATE}']",
            "-p", "publish_clock:=true",
        ],
        output="screen",
    )  # fmt: skip
    actions = [simulator, node, launch_testing.actions.ReadyToTest()]
    return LaunchDescription(actions), {"simulator": simulator, "node": node}


class TestGoals(unittest.TestCase):
    """Goals of a client, while the processes run."""

    def setUp(self):
        rclpy.init()
        self.node = rclpy.create_node("test_goals")
        self.client = ActionClient(self.node, FollowJointTrajectory, ACTION)
        assert self.client.wait_for_server(TIMEOUT)
        # The node offers the action before it is connected.
        connected = rclpy.task.Future()
        self.node.create_subscription(JointState, "joint_states", connected.set_result, 10)
        self.wait(connected)

    def tearDown(self):
        self.node.destroy_node()
        rclpy.shutdown()

    def wait(self, future):
        """Return the result of a future."""
        rclpy.spin_until_future_complete(self.node, future, timeout_sec=TIMEOUT)
        assert future.done()
        return future.result()

    def execute(self, *rows):
        """Return state and result of a goal; the points are a second apart."""
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = JOINTS
        goal.trajectory.points = [
            JointTrajectoryPoint(positions=[row] * 6, time_from_start=Duration(sec=second))
            for second, row in enumerate(rows, 1)
        ]
        handle = self.wait(self.client.send_goal_async(goal))
        report = self.wait(handle.get_result_async())
        return report.status, report.result

    def test_goal_within_the_limits_is_executed(self):
        status, result = self.execute(0.1, 0.2, 0.0)
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_string

    def test_goal_outside_of_the_limits_is_refused(self):
        status, result = self.execute(0.1, 9.0)
        assert status == GoalStatus.STATUS_ABORTED
        assert "outside its limits" in result.error_string


@launch_testing.post_shutdown_test()
class TestEnd(unittest.TestCase):
    """Exit codes, after all processes have ended."""

    def test_processes_end_without_a_fault(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)
