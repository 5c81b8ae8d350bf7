"""Sources of exported modules: tables, ROS messages and G-code, read with the place of each row."""

from rapidgen.export.sources.gcode import read_gcode
from rapidgen.export.sources.ros import read_ros
from rapidgen.export.sources.tables import read_table
from rapidgen.export.sources.toolpath import JointPath, PathStep, SourceOptions, Toolpath

__all__ = [
    "JointPath",
    "PathStep",
    "SourceOptions",
    "Toolpath",
    "read_gcode",
    "read_ros",
    "read_table",
]
