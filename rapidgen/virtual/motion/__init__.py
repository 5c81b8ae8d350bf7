"""Motion: path queue with look-ahead, profiles in closed form, stops on the path."""

from rapidgen.virtual.motion.group import MotionGroup
from rapidgen.virtual.motion.settings import MotionSettings
from rapidgen.virtual.motion.system import MotionSystem

__all__ = ["MotionGroup", "MotionSettings", "MotionSystem"]
