"""ROS action server, topics and services over the client, without ROS.

`goals` defines the meaning of a FollowJointTrajectory goal, `goal_execution` executes one,
`robot_link` keeps the connection to the robot, `time_stamps` and `status_messages` are published.
Only `node` imports rclpy, and late: all other modules run, and are tested, without ROS.
"""
