"""Figures from measured points: FitSphere, MToolTCPCalib; and Rand.

Sources: FLo-ABB/RAPID-Scripts-and-Demos [code] for what they are called with, the errors of
FitSphere and Rand's largest value; FitSphere's optional arguments [mem].
"""

from typing import TYPE_CHECKING

from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.access import data_of, geometry_of, group_of
from rapidgen.runtime.builtins.motion.arguments import target_of
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Orient, Pos, Pose, Ref, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_MOST = 100
_FLAT = 1e-9
"""Spread of points across a line or a plane, against their spread along it."""
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
    import numpy as np  # only a best fit needs linear algebra

    used = [points[i] for i in range(1, (len(points) if count is None else int(count)) + 1)]
    if len(used) < 4:
        raise RapidError("ERR_FIT_TOO_FEW_POINTS", f"{len(used)} of 4")
    if len(used) > _MOST:
        raise RapidError("ERR_FIT_TOO_MANY_POINTS", f"{len(used)} of {_MOST}")
    at = np.array([(p.x, p.y, p.z) for p in used])
    middle = at.mean(axis=0)
    spread = np.linalg.svd(at - middle, compute_uv=False)
    if spread[2] <= _FLAT * spread[0]:
        raise RapidError("ERR_FIT_POINTS_IN_LINE")
    near = at - middle
    # |p - c|^2 = r^2 is linear in c and r^2 - |c|^2.
    matrix = np.column_stack([2 * near, np.ones(len(near))])
    solved = np.linalg.lstsq(matrix, (near**2).sum(axis=1), rcond=None)[0]
    found = float(np.sqrt(solved[3] + solved[:3] @ solved[:3]))
    errors = np.abs(np.linalg.norm(near - solved[:3], axis=1) - found)
    centre.set(_pos(solved[:3] + middle))
    radius.set(found)
    if rms is not None:
        rms.set(float(np.sqrt((errors**2).mean())))
    if largest is not None:
        largest.set(float(errors.max()))
    if worst is not None:
        worst.set(int(errors.argmax()) + 1)


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
    import numpy as np

    group = group_of(task)
    kinematics = geometry_of(group)
    offsets = data_of(task, group).external_offset
    rows, ends = [], []
    for joints in (one, two, three, four):
        posture = target_of(joints, group.map, group.positions(), offsets)
        place, turn = kinematics.forward(posture)
        # turn * tcp + place = world, for the unknown tcp and world
        rows.append(np.hstack([_matrix(turn), -np.eye(3)]))
        ends.append(-np.array(place) * 1000)
    solved, _, rank, _ = np.linalg.lstsq(np.vstack(rows), np.concatenate(ends), rcond=1e-9)
    if rank < 6:
        raise RapidError("ERR_ARGVALERR", "the postures do not turn the tool about two axes")
    errors = [
        float(np.linalg.norm(row @ solved - end)) for row, end in zip(rows, ends, strict=True)
    ]
    changed = tool.get().copy()
    changed.tframe = Pose(_pos(solved[:3]), Orient(*changed.tframe.rot.values()))
    tool.set(changed)
    largest.set(max(errors))
    mean.set(sum(errors) / len(errors))


def _matrix(q: tuple[float, float, float, float]) -> "NDArray[np.float64]":
    import numpy as np

    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _pos(values: "NDArray[np.float64]") -> Value:
    return Pos(*(single(float(v)) for v in values))
