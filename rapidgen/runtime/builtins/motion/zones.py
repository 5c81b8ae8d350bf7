"""World zones: shapes, outputs and supervision (WZBoxDef to WZFree).

Source: [manual] 3HAC050917 (RobotWare 6) for arguments and effects. Remembered only [mem]: the
maximum number of zones, the minimum side of 10 mm and the minimum radius of 5 mm.
"""

from collections.abc import Callable
from math import inf

from rapidgen.axes.mapping import ABSENT
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.zones import Ball, BoxVolume, Cylinder, JointSpace, Shape, WorldZone
from rapidgen.runtime.builtins.io import dionum
from rapidgen.runtime.builtins.motion.targets import geometry_of, group_of
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.motion_interface import NOT_ALLOWED, WORLD_ZONE
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value, register_type

MOST_ZONES = 20
_LEAST_SIDE, _LEAST_RADIUS = 10.0, 5.0


class ShapeData:
    """A shapedata: the result of a WZ...Def instruction."""

    __slots__ = ("zone",)

    def __init__(self) -> None:
        self.zone: WorldZone | None = None


register_type("shapedata", ShapeData)


def _refused(text: str) -> FatalError:
    return FatalError(NOT_ALLOWED, "World zone not possible", text)


# -- shapes --------------------------------------------------------------------------------------


def _metres(data: Value) -> tuple[float, float, float]:
    return data.x / 1000, data.y / 1000, data.z / 1000


def _put(shape: ShapeData, inside: bool | None, outside: bool | None, result: Shape) -> None:
    if not inside and not outside:
        raise _refused("\\Inside or \\Outside has to be given")
    shape.zone = WorldZone(result, outside=bool(outside))


@builtin("WZBoxDef")
def box(
    _task: Task,
    inside: bool | None,
    outside: bool | None,
    shape: ShapeData,
    one: Value,
    other: Value,
) -> None:
    """Define a box between two corners. FatalError: a side is too short."""
    corners = list(zip(_metres(one), _metres(other), strict=True))
    if any(abs(a - b) < _LEAST_SIDE / 1000 for a, b in corners):
        raise _refused(f"a side of the box is shorter than {_LEAST_SIDE:g} mm")
    low, high = (tuple(map(end, corners)) for end in (min, max))
    _put(shape, inside, outside, BoxVolume((low[0], low[1], low[2]), (high[0], high[1], high[2])))


@builtin("WZCylDef")
def cylinder(
    _task: Task,
    inside: bool | None,
    outside: bool | None,
    shape: ShapeData,
    centre: Value,
    radius: float,
    height: float,
) -> None:
    """Define a cylinder upwards from the centre of its bottom.

    A negative height means downwards.
    """
    if radius < _LEAST_RADIUS or abs(height) < _LEAST_SIDE:
        raise _refused(f"a cylinder of radius {radius:g} and height {height:g} mm is too small")
    _put(shape, inside, outside, Cylinder(_metres(centre), radius / 1000, height / 1000))


@builtin("WZSphDef")
def sphere(
    _task: Task,
    inside: bool | None,
    outside: bool | None,
    shape: ShapeData,
    centre: Value,
    radius: float,
) -> None:
    """Define a sphere."""
    if radius < _LEAST_RADIUS:
        raise _refused(f"a sphere of radius {radius:g} mm is too small")
    _put(shape, inside, outside, Ball(_metres(centre), radius / 1000))


def _unused(value: float) -> bool:
    return abs(value) > ABSENT / 2


def _space(group: MotionGroup, low: list[float], high: list[float]) -> JointSpace:
    """Return a space of RAPID values of rax_1 to eax_f.

    An infinite limit disables supervision of the axis.
    """
    names = [f"rax_{k}" for k in range(1, 7)] + [f"eax_{c}" for c in "abcdef"]
    zero = (0.0,) * len(group.config.joints)
    ends = []
    for values in (low, high):
        known = [0.0 if abs(v) == inf else v for v in values]
        ends.append(group.map.from_rapid(known[:6], known[6:], zero))
    ranges = []
    for joint, one, other in zip(group.config.joints, *ends, strict=True):
        place = names.index(joint.axis)
        a, b = min(one, other), max(one, other)
        ranges.append((a if low[place] > -inf else -inf, b if high[place] < inf else inf))
    return JointSpace(tuple(a for a, _ in ranges), tuple(b for _, b in ranges))


@builtin("WZHomeJointDef")
def home_joints(
    task: Task,
    inside: bool | None,
    outside: bool | None,
    shape: ShapeData,
    middle: Value,
    delta: Value,
) -> None:
    """Define an axis space around a posture.

    9E9 in one of both values disables supervision of the axis.
    """
    low, high = [], []
    for value, path in zip(_axes(middle), _axes(delta), strict=True):
        if _unused(value) or _unused(path):
            low.append(-inf)
            high.append(inf)
        elif path <= 0:
            raise _refused("each part of DeltaJointVal has to be larger than 0")
        else:
            low.append(value - path)
            high.append(value + path)
    _put(shape, inside, outside, _space(group_of(task), low, high))


@builtin("WZLimJointDef")
def limited_joints(
    task: Task,
    inside: bool | None,
    outside: bool | None,
    shape: ShapeData,
    low: Value,
    high: Value,
) -> None:
    """Define an axis space between two postures.

    9E9 or -9E9 means no limit on that side.
    """
    lows = [-inf if _unused(v) else v for v in _axes(low)]
    highs = [inf if _unused(v) else v for v in _axes(high)]
    if any(a >= b for a, b in zip(lows, highs, strict=True)):
        raise _refused("each part of LowJointVal has to be below that of HighJointVal")
    _put(shape, inside, outside, _space(group_of(task), lows, highs))


def _axes(data: Value) -> tuple[float, ...]:
    return (*data.robax.values(), *data.extax.values())


# -- zones ---------------------------------------------------------------------------------------


def _define(
    task: Task,
    temporary: bool | None,
    stationary: bool | None,
    datum: Ref,
    shape: ShapeData,
    act: Callable[[bool], None],
    *,
    ahead: bool,
) -> None:
    if not temporary and not stationary:
        raise _refused("\\Temp or \\Stat has to be given")
    if datum.type.name != "wztemporary":
        raise _refused(f"a zone is kept in a wztemporary or wzstationary: {datum.type.name}")
    anywhere = task.controller.dialect.stationary_zones == "anywhere"
    if stationary and not anywhere and task.events.running != "POWER_ON":
        raise _refused("a stationary zone is defined in an event routine of POWER ON")
    zone, zones, group = shape.zone, task.controller.motion.zones, group_of(task)
    number = int(datum.get().wz)
    if zone is None:
        raise _refused("the shape is not defined")
    if number in zones and not stationary:
        raise _refused(f"zone {number} exists: WZFree before its datum is used again")
    if len(zones) >= MOST_ZONES:
        raise _refused(f"there are {MOST_ZONES} zones already")
    if not isinstance(zone.shape, JointSpace):
        geometry_of(group)
    changed = datum.get().copy()
    changed.wz = zones.add(
        group, zone, act, ahead=ahead, stationary=bool(stationary), expected=number
    )
    datum.set(changed)


@builtin("WZDOSet")
def set_output(
    task: Task,
    temporary: bool | None,
    stationary: bool | None,
    datum: Ref,
    inside: bool | None,
    before: bool | None,
    shape: ShapeData,
    signal: AnySignal,
    value: float,
) -> None:
    """Set an output while the robot is inside the zone.

    Outside it has the opposite value. \\Before: also set it where the robot can no longer stop
    before the zone.
    """
    if not inside and not before:
        raise _refused("\\Inside or \\Before has to be given")
    expected, io, target = dionum(task, value), task.controller.io, signal.signal

    def act(reached: bool) -> None:
        io.set(target, expected if reached else 1 - expected)

    _define(task, temporary, stationary, datum, shape, act, ahead=bool(before))


@builtin("WZLimSup")
def supervise(
    task: Task, temporary: bool | None, stationary: bool | None, datum: Ref, shape: ShapeData
) -> None:
    """Stop robot and program on the path before the zone."""
    controller, group = task.controller, group_of(task)

    def act(reached: bool) -> None:
        if reached and not group.is_standing and not group.stop_reasons:
            controller.log.error(
                WORLD_ZONE,
                "World zone reached",
                f"{group.name} stops before a zone that it must not enter",
                task=task.name,
            )
            controller.stop_program()

    _define(task, temporary, stationary, datum, shape, act, ahead=True)


def _temporary(task: Task, datum: Ref) -> int:
    """Return the number of a temporary zone.

    FatalError: the zone is stationary.
    """
    number = int(datum.get().wz)
    if task.controller.motion.zones.is_stationary(number):
        raise _refused(f"zone {number} is stationary: it stays until the next warm start")
    return number


def _switch(on: bool) -> Callable[[Task, Ref], None]:
    def switch(task: Task, datum: Ref) -> None:
        number = _temporary(task, datum)
        if number not in task.controller.motion.zones:
            raise _refused("the zone is not defined")
        task.controller.motion.zones.enable(number, on)

    return switch


@builtin("WZFree")
def free(task: Task, datum: Ref) -> None:
    """Remove a zone; its output keeps its value.

    Does nothing for a datum without a zone.
    """
    task.controller.motion.zones.drop(_temporary(task, datum))
    changed = datum.get().copy()
    changed.wz = 0
    datum.set(changed)


_SWITCHES: dict[str, Callable[..., Value]] = {
    "WZEnable": _switch(True),
    "WZDisable": _switch(False),
}
builtins(_SWITCHES)
