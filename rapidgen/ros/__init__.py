"""ROS action server, topics and services over the client, without ROS.

`goals` defines the meaning of a FollowJointTrajectory goal, `goal_execution` executes one,
`robot_link` keeps the connection to the robot, `time_stamps` and `status_messages` are published.
`stream_commands` defines the meaning of streaming topics, `stream_execution` executes them over
EGM, with `twist_motion` for the TCP; `delayed_session` is the way without EGM. Only `node` and the
modules `*_interface` import rclpy, and late: all others run, and are tested, without ROS.
"""
