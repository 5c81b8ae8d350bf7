"""Motion settings: VelSet, AccSet, ConfL, program displacement.

Sources: S4 datasys 2-VelSet, 2-AccSet, 2-ConfL, 2-PDispOn, 2-EOffsOn and 1-motsetdata; 3HAC050917
for SpeedRefresh and CSpeedOverride.
"""

from collections.abc import Callable
from math import inf

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY
from rapidgen.axes.mapping import ABSENT
from rapidgen.axes.path_shapes import CircleMode
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import Singularities
from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.positions import carry, here_of, load0, payload_of
from rapidgen.runtime.builtins.motion.targets import (
    RAD,
    Offsets,
    data_of,
    frame,
    geometry_of,
    group_of,
    named_group,
)
from rapidgen.runtime.builtins.motion.units import unit_axis
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import NO_OFFSETS, NOT_SIMULATED
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

_LEAST_ACCELERATION = 0.1


@builtin("VelSet")
def vel_set(task: Task, override: float, limit: float) -> None:
    """Set the speed override in percent and the TCP limit in mm/s.

    The override applies to all speeds and to \\T, the limit not to \\T.
    """
    if not 0 < override <= 100 or limit <= 0:
        raise RapidError("ERR_ARGVALERR", f"VelSet {override:g}, {limit:g}")
    modal = group_of(task).modal
    modal.speed_override = override / 100
    modal.speed_limit = limit / 1000


@builtin("AccSet")
def acc_set(task: Task, acceleration: float, ramp: float, _final: float | None) -> None:
    """Set acceleration and ramp in percent, at least 20 and 10.

    Source: S4 datasys 2-AccSet-1. \\FinePointRamp has no effect: all ramps are equal.
    """
    if not 0 <= acceleration <= 100 or not 0 <= ramp <= 100:
        raise RapidError("ERR_ARGVALERR", f"AccSet {acceleration:g}, {ramp:g}")
    modal = group_of(task).modal
    modal.acceleration = max(acceleration, 20) / 100
    modal.ramp = max(ramp, 10) / 100


@builtin("SpeedRefresh")
def speed_refresh(task: Task, override: float) -> None:
    """Set the speed override in percent at once.

    It applies to the current move; the switches `refresh_lasts` and `refresh_standing` decide the
    rest. ERR_SPEED_REFRESH_LIM: outside 0 to 100.
    """
    if not 0 <= override <= 100:
        raise RapidError("ERR_SPEED_REFRESH_LIM", f"{override:g}")
    group_of(task).refresh = override / 100


@builtin("CSpeedOverride")
def c_speed_override(task: Task, own: bool | None) -> float:
    """Return the controller's override in percent.

    \\CTask: includes the override of the program.
    """
    group = group_of(task)
    fraction = group.override * (group.refresh if own else 1.0)
    return single(round(fraction * 100, 3))


@builtin("SingArea")
def sing_area(task: Task, wrist: bool | None, lock_axis_4: bool | None, _off: bool | None) -> None:
    """Select the behaviour of linear and circular moves at singularities."""
    modal = group_of(task).modal
    modal.singularities = Singularities.OFF
    if wrist:
        modal.singularities = Singularities.WRIST
    elif lock_axis_4:
        modal.singularities = Singularities.LOCK_AXIS_4


@builtin("PathAccLim")
def path_acc_lim(
    task: Task,
    limits_rise: bool,
    rise: float | None,
    limits_fall: bool,
    fall: float | None,
) -> None:
    """Limit the TCP acceleration along the path, in m/s^2.

    One value applies to both limits: profiles are symmetric. ERR_ARGVALERR: a limit below 0.1 or
    without a value (switch `argument_error`).
    """
    result = []
    for expected, value in ((limits_rise, rise), (limits_fall, fall)):
        if expected:
            if value is None or value < _LEAST_ACCELERATION:
                raise RapidError("ERR_ARGVALERR", "PathAccLim")
            result.append(value)
    group_of(task).modal.path_acceleration = min(result, default=inf)


@builtin("WorldAccLim")
def world_acc_lim(task: Task, limit: float | None, _off: bool | None) -> None:
    """Limit the TCP acceleration in the world, in m/s^2.

    The limit includes the acceleration of turns. ERR_ARGVALERR: below 0.1. FatalError: the model
    has no geometry.
    """
    group = group_of(task)
    if limit is None:
        group.modal.world_acceleration = inf
        return
    if limit < _LEAST_ACCELERATION:
        raise RapidError("ERR_ARGVALERR", f"WorldAccLim {limit:g}")
    geometry_of(group)
    group.modal.world_acceleration = limit


@builtin("CirPathMode")
def cir_path_mode(
    task: Task,
    _path: bool | None,
    in_object: bool | None,
    circle_point: bool | None,
    wrist45: bool | None,
    wrist46: bool | None,
    wrist56: bool | None,
) -> None:
    """Select the tool orientation on circles.

    FatalError: the model does not simulate circles made by two wrist axes.
    """
    if wrist45 or wrist46 or wrist56:
        raise FatalError(NOT_SIMULATED, "CirPathMode by wrist axes is not simulated")
    modal = group_of(task).modal
    modal.circle = CircleMode.PATH
    if in_object:
        modal.circle = CircleMode.OBJECT
    elif circle_point:
        modal.circle = CircleMode.POINT


@builtin("SpeedLimAxis")
def speed_lim_axis(task: Task, unit: Value, number: float, speed: float) -> None:
    """Limit an axis speed while LimitSpeed is set, in deg/s or mm/s [mem].

    A value of 0 means no limit, as the robots of ETH's cell use it for axes 2 and 3
    (tetov/compas_rcf [code]). ERR_SPEEDLIM_VALUE: negative; ERR_AXIS_PAR: the unit has no such
    axis.
    """
    if speed < 0:
        raise RapidError("ERR_SPEEDLIM_VALUE", f"{speed:g}")
    group, joint = unit_axis(task, unit, number)
    if speed == 0:
        group.modal.axis_limits.pop(joint.axis, None)
        return
    factor = RAD if joint.kind == "revolute" else 1 / 1000
    group.modal.axis_limits[joint.axis] = speed * factor


@builtin("SpeedLimCheckPoint")
def speed_lim_check_point(task: Task, speed: float) -> None:
    """Limit the TCP speed while LimitSpeed is set, in mm/s [mem].

    The limit ignores other check points (elbow, wrist). ERR_SPEEDLIM_VALUE: not positive.
    """
    if speed <= 0:
        raise RapidError("ERR_SPEEDLIM_VALUE", f"{speed:g}")
    group = group_of(task)
    group.modal.point_limit = speed / 1000
    group.limit_point()


@builtin("PDispOn")
def p_disp_on(
    task: Task,
    rotation: bool | None,
    executed: Value,
    programmed: Value,
    tool: Ref,
    work_object: Ref | None,
) -> None:
    """Add the displacement from the programmed to the executed point.

    Without an executed point the current position applies. \\Rot: the executed point in the
    displaced frame becomes the programmed one in the old frame.
    """
    group = group_of(task)
    modal = group.modal
    if executed is None:
        executed = here_of(task, group, tool, work_object)
    had, wants = frame(executed), frame(programmed)
    if rotation:
        step = frames.compose(had, frames.invert(wants))
    else:
        step = (frames.subtract(had[0], wants[0]), frames.UNIT)
    modal.displacement = frames.compose(modal.displacement, step)


@builtin("EOffsOn")
def e_offs_on(task: Task, executed: Value, programmed: Value) -> None:
    """Add executed minus programmed value to each external axis."""
    group = group_of(task)
    data = data_of(task, group)
    offsets = data.external_offset
    have = executed.extax.values() if executed is not None else _external_now(group, offsets)
    data.external_offset = tuple(
        o if max(a, b) > ABSENT / 2 else o + a - b
        for o, a, b in zip(offsets, have, programmed.extax.values(), strict=True)
    )


def _external_now(group: MotionGroup, offsets: Offsets) -> Offsets:
    values = group.map.to_rapid(group.positions())[1]
    return tuple(v if v > ABSENT / 2 else v - o for v, o in zip(values, offsets, strict=True))


def _used(values: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(0.0 if v > ABSENT / 2 else v for v in values)


def _offset(task: Task, values: Offsets) -> None:
    data_of(task, group_of(task)).external_offset = values


def _modal(name: str, value: Callable[..., object]) -> Callable[..., None]:
    """Return a built-in that sets a modal setting from its arguments."""
    return lambda task, *arguments: setattr(group_of(task).modal, name, value(*arguments))


_PLAIN: dict[str, Callable[..., Value]] = {
    "ConfL": _modal("check_linear", lambda _on, off: not off),
    "ConfJ": _modal("check_joint", lambda _on, off: not off),
    "PDispSet": _modal("displacement", frame),
    "PDispOff": _modal("displacement", lambda: IDENTITY),
    "EOffsSet": lambda task, offsets: _offset(task, _used(offsets.values())),
    "EOffsOff": lambda task: _offset(task, NO_OFFSETS),
    "MaxRobSpeed": lambda task: single(group_of(task).config.tcp_speed_limit * 1000),
}
builtins(_PLAIN)


# -- settings without effect on this model ----------------------------------------------------


@builtin("MotionSup")
def motion_sup(
    task: Task, _on: bool | None, off: bool | None, tune: float | None, _stay: bool | None
) -> None:
    """Switch collision detection in a described cell; its sensitivity has no effect.

    ERR_ARGVALERR: outside 1 to 300 %.
    """
    if tune is not None and not 1 <= tune <= 300:
        raise RapidError("ERR_ARGVALERR", f"\\TuneValue:={tune:g}")
    data_of(task, group_of(task)).extra["MotionSup"] = not off


@builtin("GripLoad")
def grip_load(task: Task, load: Ref) -> None:
    """Activate a payload. FatalError: it is undefined.

    Loads do not change kinematics, and the model has no dynamics.
    """
    carry(task, group_of(task), load.get(), "the load of GripLoad")


@builtin("CLoad")
def c_load(task: Task, reference: Value, name: str | None) -> Value:
    """Return the payload of GripLoad, or load0."""
    load: Value = payload_of(task, named_group(task, reference, name)) or load0()
    return load.copy()


@builtin("SoftAct")
def soft_act(task: Task, unit: Value, number: float, softness: float, ramp: float | None) -> None:
    """Accept soft servo settings; no contact is simulated.

    ERR_ARGVALERR: softness outside 0 to 100 %, ramp below 100 % (S4 overview p.5-22).
    """
    if not 0 <= softness <= 100 or (ramp is not None and ramp < 100):
        raise RapidError("ERR_ARGVALERR", f"SoftAct {softness:g}")
    group, joint = unit_axis(task, unit, number)
    data_of(task, group).extra[f"SoftAct {joint.axis}"] = softness


@builtin("TuneReset")
def tune_reset(_task: Task) -> None:
    """Reset the tuning of the servo loops [DB TuneReset]: it is never changed here."""


@builtin("SoftDeact")
def soft_deact(task: Task, ramp: float | None) -> None:
    """Make all axes stiff. ERR_ARGVALERR: ramp below 100 %."""
    if ramp is not None and ramp < 100:
        raise RapidError("ERR_ARGVALERR", f"SoftDeact {ramp:g}")
    extra = data_of(task, group_of(task)).extra
    for name in [name for name in extra if name.startswith("SoftAct")]:
        del extra[name]


@builtin("PathResol")
def path_resol(task: Task, percent: float) -> None:
    """Accept a path resolution; profiles are exact at any value.

    ERR_ARGVALERR: outside 25 to 400 %.
    """
    if not 25 <= percent <= 400:
        raise RapidError("ERR_ARGVALERR", f"PathResol {percent:g}")
    data_of(task, group_of(task)).extra["PathResol"] = percent
