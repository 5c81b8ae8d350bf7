"""Read URDF and xacro without ROS, check, and map joints to axes."""
