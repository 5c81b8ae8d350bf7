"""Frames, and figures from measured points."""

from collections.abc import Callable
from math import pi

from rapidgen.axes import fitting, frames
from rapidgen.axes.fitting import NoFit
from rapidgen.axes.frames import Pose as Frame
from rapidgen.axes.frames import Vector
from rapidgen.axes.mapping import ABSENT
from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.targets import (
    data_of,
    geometry_of,
    group_of,
    quaternion,
    target_of,
)
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import ExtJoint, Orient, Pos, Pose, Ref, Value

# -- Frames ----------------------------------------------------------------------------------------
#
# Frames, orientations and vectors.
#
# Sources: S4 datasys, the page of each name (RelTool, OrientZYX, EulerZYX, DefFrame, DefDFrame,
# MirPos, ORobT, NOrient). Lengths are mm throughout: these functions never leave RAPID's units.


_RAD = pi / 180


def _vector(data: Value) -> Vector:
    return data.x, data.y, data.z


def _frame(data: Value) -> Frame:
    return _vector(data.trans), quaternion(data.rot)


def _pos(v: Vector) -> Value:
    return Pos(single(v[0]), single(v[1]), single(v[2]))


def _orient(q: frames.Quaternion) -> Value:
    return Orient(*map(single, q))


def _pose(frame: Frame) -> Value:
    return Pose(_pos(frame[0]), _orient(frame[1]))


# -- robtargets -----------------------------------------------------------------------------------


@builtin("Offs", pure=True)
def offs(_task: Task, point: Value, x: float, y: float, z: float) -> Value:
    """Return a target shifted along the axes of the object frame."""
    moved = point.copy()
    moved.trans = _pos(frames.add(_vector(point.trans), (x, y, z)))
    return moved


@builtin("RelTool", pure=True)
def rel_tool(
    _task: Task,
    point: Value,
    dx: float,
    dy: float,
    dz: float,
    rx: float | None,
    ry: float | None,
    rz: float | None,
) -> Value:
    """Return a target shifted and rotated in its own frame.

    The rotation is about x, then the new y, then the new z.
    """
    position, q = _frame(point)
    moved = point.copy()
    moved.trans = _pos(frames.add(position, frames.rotate(q, (dx, dy, dz))))
    for axis, angle in (((1.0, 0.0, 0.0), rx), ((0.0, 1.0, 0.0), ry), ((0.0, 0.0, 1.0), rz)):
        if angle is not None:
            q = frames.multiply(q, frames.about(axis, angle * _RAD))
    moved.rot = _orient(q)
    return moved


@builtin("MirPos", pure=True)
def mir_pos(
    _task: Task, point: Value, plane: Value, work_object: Value, mirror_y: bool | None
) -> Value:
    """Return a target mirrored in the xy plane of an object frame.

    The mirror inverts z and x of the tool (\\MirY: z and y); the third axis keeps the frame
    right-handed. The configuration does not change.
    """
    mirror = frames.compose(_frame(plane.uframe), _frame(plane.oframe))
    holder = frames.IDENTITY
    if work_object is not None:
        holder = frames.compose(_frame(work_object.uframe), _frame(work_object.oframe))
    seen = frames.compose(frames.invert(mirror), frames.compose(holder, _frame(point)))
    (x, y, z), rotation = seen
    rows = frames.to_matrix(rotation)
    axes = [(rows[0][i], rows[1][i], -rows[2][i]) for i in range(3)]
    if mirror_y:
        axes[0] = frames.cross(axes[1], axes[2])
    else:
        axes[1] = frames.cross(axes[2], axes[0])
    a, b, c = axes
    turned = frames.from_matrix(((a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])))
    placed = frames.compose(frames.invert(holder), frames.compose(mirror, ((x, y, -z), turned)))
    moved = point.copy()
    moved.trans, moved.rot = _pos(placed[0]), _orient(placed[1])
    return moved


@builtin("ORobT")
def o_rob_t(
    task: Task, point: Value, in_displacement: bool | None, in_offsets: bool | None
) -> Value:
    """Return a target without displacement and external offsets.

    \\InPDisp removes only the offsets, \\InEOffs only the displacement (S4 datasys 3-ORobT).
    """
    group = group_of(task)
    moved = point.copy()
    if not in_displacement:
        (x, y, z), q = group.modal.displacement
        displayed = frames.compose(((x * 1000, y * 1000, z * 1000), q), _frame(point))
        moved.trans, moved.rot = _pos(displayed[0]), _orient(displayed[1])
    if not in_offsets:
        offsets = data_of(task, group).external_offset
        moved.extax = ExtJoint(
            *(
                v if v > ABSENT / 2 else single(v + o)
                for v, o in zip(point.extax.values(), offsets, strict=True)
            )
        )
    return moved


# -- frames ---------------------------------------------------------------------------------------


@builtin("DefFrame", pure=True)
def def_frame(_task: Task, p1: Value, p2: Value, p3: Value, origin: float | None) -> Value:
    """Return a frame defined by three points.

    The points are one on the x axis, another one on it, and one on the positive y side. The origin
    is the first point, the second, or (3) the foot of the third on the x axis.
    """
    first, second, third = (_vector(p.trans) for p in (p1, p2, p3))
    _, turned = _through(p1.trans, p2.trans, p3.trans)
    if origin == 2:
        first = second
    elif origin == 3:
        x = frames.unit(frames.subtract(second, first))
        fraction = frames.dot(frames.subtract(third, first), x)
        first = frames.add(first, frames.scale(x, fraction))
    return _pose((first, turned))


def _through(first: Value, second: Value, third: Value) -> Frame:
    try:
        return fitting.frame_through(_vector(first), _vector(second), _vector(third))
    except NoFit as fault:
        raise RapidError("ERR_FRAME", str(fault)) from fault


@builtin("DefDFrame", pure=True)
def def_d_frame(
    _task: Task, old1: Value, old2: Value, old3: Value, new1: Value, new2: Value, new3: Value
) -> Value:
    """Return the displacement from three old points to three new ones.

    The first point matches exactly.
    """
    old = _through(old1.trans, old2.trans, old3.trans)
    new = _through(new1.trans, new2.trans, new3.trans)
    return _pose(frames.compose(new, frames.invert(old)))


@builtin("DefAccFrame")
def def_acc_frame(
    _task: Task, first: Value, second: Value, count: float, worst: Ref, mean: Ref
) -> Value:
    """Return the displacement from one list of points to another.

    It minimises the sum of squares.
    """
    number = int(count)
    if number != count or not 3 <= number <= min(len(first), len(second)):
        raise RapidError("ERR_FRAME", f"{count:g} points")
    old, new = ([_vector(d[i].trans) for i in range(1, number + 1)] for d in (first, second))
    try:
        result, largest, average = fitting.displacement(old, new)
    except NoFit as fault:
        raise RapidError("ERR_FRAME", str(fault)) from fault
    worst.set(largest)
    mean.set(average)
    return _pose(result)


# -- orientations and vectors -----------------------------------------------------------------


@builtin("EulerZYX", pure=True)
def euler_zyx(
    _task: Task, x: bool | None, y: bool | None, z: bool | None, rotation: Value
) -> float:
    """Return one Euler angle in -180 to 180 degrees.

    ERR_ARGVALERR: the call does not have exactly one switch.
    """
    if (bool(x), bool(y), bool(z)).count(True) != 1:
        raise RapidError("ERR_ARGVALERR", "one of \\X, \\Y, \\Z")
    about_z, about_y, about_x = frames.to_zyx(quaternion(rotation))
    return single((about_x if x else about_y if y else about_z) / _RAD)


# Angles in degrees, turns about z, then the new y, then the new x. NOrient: ERR_ILLQUAT more
# than 0.1 off.
_PURE: dict[str, Callable[..., Value]] = {
    "PoseMult": lambda _, outer, inner: _pose(frames.compose(_frame(outer), _frame(inner))),
    "PoseInv": lambda _, pose: _pose(frames.invert(_frame(pose))),
    "PoseVect": lambda _, pose, place: _pos(frames.transform(_frame(pose), _vector(place))),
    "OrientZYX": lambda _, z, y, x: _orient(frames.from_zyx(z * _RAD, y * _RAD, x * _RAD)),
    "NOrient": lambda _, rotation: _orient(quaternion(rotation)),
    "Distance": lambda _, one, two: single(frames.distance(_vector(one), _vector(two))),
    "DotProd": lambda _, one, two: single(frames.dot(_vector(one), _vector(two))),
    "CrossProd": lambda _, one, two: _pos(frames.cross(_vector(one), _vector(two))),
    "VectMagn": lambda _, vector: single(frames.norm(_vector(vector))),
}
builtins(_PURE, pure=True)


# -- Measured points -------------------------------------------------------------------------------
#
# Figures from measured points: FitSphere, FitCircle, MToolTCPCalib; and Rand.
#
# Sources: FLo-ABB/RAPID-Scripts-and-Demos [code] for what they are called with, the errors of
# FitSphere and Rand's largest value; FitSphere's optional arguments [mem].


_MOST = 100
_LARGEST_RANDOM = 32_767


@builtin("Rand")
def rand(task: Task) -> int:
    """Return a random whole number from 0 to 32767.

    The generator uses the controller's seed.
    """
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
    """Fit a sphere to 4 to 100 points by least squares.

    Raises ERR_FIT_TOO_FEW_POINTS, ERR_FIT_TOO_MANY_POINTS, ERR_FIT_POINTS_IN_LINE (also for points
    in a plane).
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
    centre.set(_pos_value(result.centre))
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
    """Fit a circle to 3 to 100 points in space.

    Errors are those of FitSphere [mem].
    """
    used = [points[i] for i in range(1, (len(points) if count is None else int(count)) + 1)]
    if len(used) < 3:
        raise RapidError("ERR_FIT_TOO_FEW_POINTS", f"{len(used)} of 3")
    if len(used) > _MOST:
        raise RapidError("ERR_FIT_TOO_MANY_POINTS", f"{len(used)} of {_MOST}")
    try:
        result = fitting.circle([(p.x, p.y, p.z) for p in used])
    except NoFit as fault:
        raise RapidError("ERR_FIT_POINTS_IN_LINE") from fault
    centre.set(_pos_value(result.centre))
    radius.set(result.radius)
    normal.set(_pos_value(result.normal))
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
    """Compute a TCP from four postures by least squares, in mm.

    All postures have the TCP at one place in the world. Only the tool's position changes.
    ERR_ARGVALERR: the postures do not rotate the tool.
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
    changed.tframe = Pose(_pos_value(held), Orient(*changed.tframe.rot.values()))
    tool.set(changed)
    largest.set(max(errors))
    mean.set(sum(errors) / len(errors))


def _pos_value(v: Vector) -> Value:
    return Pos(*map(single, v))
