"""Files for ROS 2 and ROS 1 from a robot's configuration alone.

`urdf` describes the chain, `srdf` has data for planning, `files` composes the packages.
"""

from rapidgen.ros.package.files import (
    JOINT_STATES_RATE,
    CellMember,
    PackageOptions,
    ros1_package,
    ros2_cell,
    ros2_packages,
    write,
)

__all__ = [
    "JOINT_STATES_RATE",
    "CellMember",
    "PackageOptions",
    "ros1_package",
    "ros2_cell",
    "ros2_packages",
    "write",
]
