"""YAML and URDF become one frozen, checked model of the robot."""
