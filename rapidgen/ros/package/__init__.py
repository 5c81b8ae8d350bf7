"""Files that ROS 2 and ROS 1 want of a robot, from its configuration alone.

`urdf` draws the chain, `moveit` what planning needs, `files` puts a package together.
"""

from rapidgen.ros.package.files import ros1_package, ros2_package, write

__all__ = ["ros1_package", "ros2_package", "write"]
