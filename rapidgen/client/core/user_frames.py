"""Tools and work objects by values, checked and encoded as words."""

from math import isfinite, sqrt

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.client.pose import pose_of
from rapidgen.client.program import UserTool, UserWorkObject

_UNIT = 1e-3
"""Tolerance of a quaternion's length."""
_FARTHEST, _HEAVIEST, _INERTIA = 100.0, 2000.0, 2000.0
"""Limits of the driver: m, kg, kg m2."""


def own_tool(tool: UserTool) -> tuple[tuple[float, ...], Pose]:
    """Return the words of a TOOL, and its TCP in the flange's frame.

    Raises ValueError, and InvalidProgram for an invalid pose.
    """
    frame = _frame(pose_of(tool.frame), "the tool's frame")
    centre = _frame((tool.centre, tool.axes), "the tool's centre and axes")
    moments = tuple(map(float, tool.inertia))
    mass = float(tool.mass)
    if not 0 < mass <= _HEAVIEST:
        raise ValueError(f"a tool weighs more than 0 and at most {_HEAVIEST:g} kg")
    if len(moments) != 3 or not all(0 <= moment <= _INERTIA for moment in moments):
        raise ValueError(f"three moments of inertia are 0 to {_INERTIA:g} kg m2")
    return (*frame[0], *frame[1], *centre[0], *centre[1], mass, *moments), frame


def own_work_object(wobj: UserWorkObject) -> tuple[tuple[float, ...], Pose]:
    """Return the words of a WORK_OBJECT, and its pose in the world.

    Raises as `own_tool`.
    """
    user = _frame(pose_of(wobj.user_frame), "the user frame")
    place = _frame(pose_of(wobj.object_frame), "the object frame")
    return (*user[0], *user[1], *place[0], *place[1]), frames.compose(user, place)


def _frame(given: Pose, what: str) -> Pose:
    place, turn = given
    size = sqrt(sum(value * value for value in turn))
    if not all(map(isfinite, (*place, size))) or sqrt(sum(v * v for v in place)) > _FARTHEST:
        raise ValueError(f"{what} is at {place}: finite numbers, m, within {_FARTHEST:g} m")
    if abs(size - 1) > _UNIT:
        raise ValueError(f"{what} has a quaternion of length {size:.4g}: (w, x, y, z) of length 1")
    return place, frames.normalise(turn)
