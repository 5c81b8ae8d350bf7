"""Figures from measured points: FitSphere, FitCircle, MToolTCPCalib; and Rand.

Sources: FLo-ABB/RAPID-Scripts-and-Demos [code] for what they are called with, the errors of
FitSphere and Rand's largest value; FitSphere's optional arguments [mem].
"""

from rapidgen.axes import fitting, frames
from rapidgen.axes.fitting import NoFit
from rapidgen.axes.frames import Vector
from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.arguments import target_of
from rapidgen.runtime.builtins.motion.task_group import data_of, geometry_of, group_of
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Orient, Pos, Pose, Ref, Value

_MOST = 100
_LARGEST_RANDOM = 32_767


@builtin("Rand")
def rand(task: Task) -> int:
    """A whole number from 0 to 32767, drawn from the controller's seed."""
    return task.scheduler.rng.randint(0, _LARGEST_RANDOM)


@builtin("FitSphere")
def fit_sphere(
    _task: Task,
    points: dict[int, Value],
    count: float | None,
    centre: Ref,
    radius: Ref,
    rms: Ref | None,
    largest: Ref | None,
    worst: Ref | None,
) -> None:
    """The sphere through 4 to 100 points, by least squares.

    ERR_FIT_TOO_FEW_POINTS, ERR_FIT_TOO_MANY_POINTS, ERR_FIT_POINTS_IN_LINE (also in a plane).
    """
    used = [points[i] for i in range(1, (len(points) if count is None else int(count)) + 1)]
    if len(used) < 4:
        raise RapidError("ERR_FIT_TOO_FEW_POINTS", f"{len(used)} of 4")
    if len(used) > _MOST:
        raise RapidError("ERR_FIT_TOO_MANY_POINTS", f"{len(used)} of {_MOST}")
    try:
        result = fitting.sphere([(p.x, p.y, p.z) for p in used])
    except NoFit as fault:
        raise RapidError("ERR_FIT_POINTS_IN_LINE") from fault
    centre.set(_pos(result.centre))
    radius.set(result.radius)
    for where, value in ((rms, result.rms), (largest, result.largest), (worst, result.worst + 1)):
        if where is not None:
            where.set(value)


@builtin("FitCircle")
def fit_circle(
    _task: Task,
    points: dict[int, Value],
    count: float | None,
    centre: Ref,
    radius: Ref,
    normal: Ref,
    rms: Ref | None,
    largest: Ref | None,
    worst: Ref | None,
) -> None:
    """The circle through 3 to 100 points of space. Errors as of FitSphere [mem]."""
    used = [points[i] for i in range(1, (len(points) if count is None else int(count)) + 1)]
    if len(used) < 3:
        raise RapidError("ERR_FIT_TOO_FEW_POINTS", f"{len(used)} of 3")
    if len(used) > _MOST:
        raise RapidError("ERR_FIT_TOO_MANY_POINTS", f"{len(used)} of {_MOST}")
    try:
        result = fitting.circle([(p.x, p.y, p.z) for p in used])
    except NoFit as fault:
        raise RapidError("ERR_FIT_POINTS_IN_LINE") from fault
    centre.set(_pos(result.centre))
    radius.set(result.radius)
    normal.set(_pos(result.normal))
    for where, value in ((rms, result.rms), (largest, result.largest), (worst, result.worst + 1)):
        if where is not None:
            where.set(value)


@builtin("MToolTCPCalib")
def m_tool_tcp_calib(
    task: Task,
    one: Value,
    two: Value,
    three: Value,
    four: Value,
    tool: Ref,
    largest: Ref,
    mean: Ref,
) -> None:
    """The TCP that four postures hold at one place of the world, by least squares, mm.

    Of the tool only the position changes. ERR_ARGVALERR: the postures do not turn the tool.
    """
    group = group_of(task)
    kinematics = geometry_of(group)
    offsets = data_of(task, group).external_offset
    flanges = []
    for joints in (one, two, three, four):
        place, turn = kinematics.forward(target_of(joints, group.map, group.positions(), offsets))
        flanges.append((frames.scale(place, 1000), turn))
    try:
        held, errors = fitting.held_point(flanges)
    except NoFit as fault:
        raise RapidError("ERR_ARGVALERR", str(fault)) from fault
    changed = tool.get().copy()
    changed.tframe = Pose(_pos(held), Orient(*changed.tframe.rot.values()))
    tool.set(changed)
    largest.set(max(errors))
    mean.set(sum(errors) / len(errors))


def _pos(v: Vector) -> Value:
    return Pos(*map(single, v))
