"""What the planner refuses, and why, as data. What RAPID calls it is the runtime's business."""

from enum import Enum


class FaultReason(Enum):
    """Why a move is refused; behind each stands what `MotionFault.facts` has."""

    OUT_OF_REACH = "out of reach"
    """Where the TCP should be, m."""
    OUT_OF_REACH_IN_CORNER = "out of reach in a corner"
    OUT_OF_REACH_WITH_WRIST = "out of reach while the wrist axes go straight"
    OUT_OF_REACH_WITH_AXIS_4 = "out of reach with axis 4 locked"
    NO_POSTURE = "no posture reaches it"
    NO_POSTURE_IN_RANGE = "no posture reaches it within the axis ranges"
    OUT_OF_RANGE = "an axis leaves its range"
    """The `axes.limits.LimitFault`."""
    SINGULARITY = "an axis would have to turn at once"
    NO_CIRCLE = "three points that make no circle"
    CIRCLE_TOO_LONG = "more than 240 degrees of a circle"
    CONFIGURATION = "the way ends in another configuration"
    """That configuration, and the wanted one."""
    NO_GEOMETRY = "the model has no geometry"
    """The group's name."""
    NO_SPEED = "a part of the move has speed 0"
    TOO_MANY_CONCURRENT = "too many concurrent moves"
    NOTHING_STORED = "no path is stored"


class MotionFault(Exception):
    """A move or request that cannot be executed. The path is unchanged."""

    def __init__(self, refusal: FaultReason, *facts: object) -> None:
        super().__init__(": ".join(map(str, (refusal.value, *facts))))
        self.refusal = refusal
        self.facts = facts
