"""A ROS action server, its topics and its services over the client, without ROS.

`goals` says what a FollowJointTrajectory goal means, `following` carries one out, `keeping` holds
the link to the robot, `states` and `status` are what is published. Only `node` imports rclpy, and
late: everything else runs, and is tested, where no ROS is.
"""
