"""Motion: path queue with look-ahead, profiles in closed form, stops on the path."""

from rapidgen.motion.group import MotionGroup
from rapidgen.motion.settings import MotionSettings
from rapidgen.motion.system import MotionSystem

__all__ = ["MotionGroup", "MotionSettings", "MotionSystem"]
