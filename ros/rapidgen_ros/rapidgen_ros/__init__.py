"""`ros2 run rapidgen_ros driver`: the node of `rapidgen.ros`, under the name that ROS looks for."""
