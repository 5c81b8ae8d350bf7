"""Files for ROS 2 and ROS 1 from a robot's configuration alone.

`urdf` describes the chain, `srdf` has data for planning, `files` composes a package.
"""

from rapidgen.ros.package.files import CellMember, ros1_package, ros2_cell, ros2_package, write

__all__ = ["CellMember", "ros1_package", "ros2_cell", "ros2_package", "write"]
