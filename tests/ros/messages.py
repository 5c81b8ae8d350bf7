"""ROS 2 of this Python: the real rclpy where there is one, else the stand-in.

`make ros-tests` runs the tests of this folder with the real one (Python 3.11); both offer what the
tests ask with: `driver_type` makes a node that was configured, with its topics, services and
actions.
"""

from importlib.util import find_spec

IS_REAL = find_spec("rclpy") is not None
"""True if this Python has ROS 2."""

if IS_REAL:
    from builtin_interfaces.msg import Duration, Time
    from control_msgs.action import FollowJointTrajectory
    from control_msgs.msg import JointTolerance
    from geometry_msgs.msg import Point, Pose, Quaternion, TwistStamped
    from rapidgen_interfaces.msg import Value
    from std_msgs.msg import Float64MultiArray
    from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
else:
    from standin import (
        Duration,
        Float64MultiArray,
        FollowJointTrajectory,
        JointTolerance,
        JointTrajectory,
        JointTrajectoryPoint,
        Point,
        Pose,
        Quaternion,
        Time,
        TwistStamped,
        Value,
    )

__all__ = [
    "Duration",
    "Float64MultiArray",
    "FollowJointTrajectory",
    "JointTolerance",
    "JointTrajectory",
    "JointTrajectoryPoint",
    "Point",
    "Pose",
    "Quaternion",
    "Time",
    "TwistStamped",
    "Value",
]
