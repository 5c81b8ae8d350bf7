"""Files that ROS 2 and ROS 1 want of a robot, from its configuration alone.

`urdf` draws the chain, `srdf` what planning needs, `files` puts a package together.
"""

from rapidgen.ros.package.files import CellMember, ros1_package, ros2_cell, ros2_package, write

__all__ = ["CellMember", "ros1_package", "ros2_cell", "ros2_package", "write"]
