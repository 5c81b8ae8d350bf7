"""ROS interface of the streaming topics; as `node` it imports rclpy.

Set points are received with best effort, so that publishers of either reliability fit; the newest
one counts. A trajectory may have many fragments and is reliable. The messages of one topic keep
their order: one callback group each.
"""

from collections.abc import Callable, Sequence

from geometry_msgs.msg import TwistStamped
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory

from rapidgen.ros.goals import Point
from rapidgen.ros.operator_interface import ServingNode
from rapidgen.ros.robot_link import RobotLink
from rapidgen.ros.stream_commands import Command, JointCommand, TrajectoryCommand, TwistCommand
from rapidgen.ros.user_services import Message

_RELIABLE = QoSProfile(depth=10)


class StreamInterface:
    """Subscriptions of the streaming topics of one motion group."""

    def __init__(self, node: ServingNode, link: RobotLink, space: str, prefix: str) -> None:
        self._node = node
        self._prefix = prefix
        self._subscriptions = [
            node.create_subscription(
                kind,
                f"~/{space}{topic}",
                self._receiver(link, topic, read),
                qos,
                callback_group=MutuallyExclusiveCallbackGroup(),
            )
            for kind, topic, read, qos in (
                (JointTrajectory, "joint_trajectory", self._trajectory, _RELIABLE),
                (JointState, "joint_commands", self._joints, qos_profile_sensor_data),
                (Float64MultiArray, "position_commands", _positions, qos_profile_sensor_data),
                (Float64MultiArray, "velocity_commands", _velocities, qos_profile_sensor_data),
                (TwistStamped, "twist_commands", _twist, qos_profile_sensor_data),
            )
        ]

    def destroy(self) -> None:
        """Destroy all subscriptions."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)

    def _receiver(
        self, link: RobotLink, topic: str, read: Callable[[Message], Command]
    ) -> Callable[[Message], None]:
        def receive(message: Message) -> None:
            command = read(message)
            self._node.soon(lambda: link.command(topic, command))

        return receive

    def _names(self, names: Sequence[str]) -> tuple[str, ...]:
        return tuple(name.removeprefix(self._prefix) for name in names)

    def _trajectory(self, message: Message) -> Command:
        points = [
            Point(seconds(point.time_from_start), point.positions, point.velocities)
            for point in message.points
        ]
        names = self._names(message.joint_names)
        return TrajectoryCommand(names, points, seconds(message.header.stamp))

    def _joints(self, message: Message) -> Command:
        return JointCommand(
            message.position,
            message.velocity,
            self._names(message.name),
            seconds(message.header.stamp),
        )


def _positions(message: Message) -> Command:
    return JointCommand(message.data, layout=[part.size for part in message.layout.dim])


def _velocities(message: Message) -> Command:
    layout = [part.size for part in message.layout.dim]
    return JointCommand(velocities=message.data, layout=layout)


def _twist(message: Message) -> Command:
    linear, angular = message.twist.linear, message.twist.angular
    return TwistCommand(
        seconds(message.header.stamp),
        message.header.frame_id,
        (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z),
    )


def seconds(report: Message) -> float:
    """Convert a Time or Duration to s."""
    return float(report.sec) + float(report.nanosec) * 1e-9
