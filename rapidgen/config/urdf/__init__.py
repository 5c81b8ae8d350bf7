"""URDF and xacro without ROS: read, check, and map joints to controller axes."""
