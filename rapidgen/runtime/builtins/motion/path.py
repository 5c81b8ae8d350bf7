"""Path control and process errors."""

from collections.abc import Callable, Iterable

from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.positions import require_defined
from rapidgen.runtime.builtins.motion.targets import data_of, group_of, moving_group
from rapidgen.runtime.builtins.motion.units import unit_axis
from rapidgen.runtime.errors import FatalError, Location, RapidError, errnum
from rapidgen.runtime.motion_interface import NOT_ALLOWED, NOT_SIMULATED, planned
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.interrupts import ProcessError
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

# -- Path ------------------------------------------------------------------------------------------
#
# Stopping, starting and changing the path.
#
# Sources: 3HAC050917 for arguments and IsStopMoveAct's two kinds, S4 datasys 2-StopMove and
# 2-StartMove for behaviour, abb_driver [code] for StopMove, ClearPath, StartMove in sequence.


MOVE_TASK = "move task"
OTHER_TASK = "other task"


def reason_of(task: Task) -> str:
    """Return the stop owner of a task, for stopping and starting a robot."""
    motion = task.controller.motion
    if motion.is_motion_task(task.name):
        return MOVE_TASK
    return OTHER_TASK if motion.settings.stop_owner == "kind" else f"{OTHER_TASK} {task.name}"


def _groups(task: Task, all_tasks: bool | None) -> Iterable[MotionGroup]:
    if not all_tasks:
        return (group_of(task),)
    if task.controller.motion.is_motion_task(task.name):
        raise FatalError(NOT_ALLOWED, "Not allowed", "\\AllMotionTasks is for non-motion tasks")
    return task.controller.motion.groups.values()


@builtin("StopMove", cost="call")
def stop_move(task: Task, quick: bool | None, all_tasks: bool | None) -> None:
    """Brake on the path; the program continues (S4 datasys 2-StopMove-1)."""
    groups = tuple(_groups(task, all_tasks))
    for group in groups:
        group.stop(reason_of(task), quick=bool(quick))
    if task.controller.motion.settings.stop_waits:
        for group in groups:
            group.wait_standing(task)


@builtin("StartMove", cost="call")
def start_move(task: Task, all_tasks: bool | None) -> None:
    """Cancel the stop of this kind of task; move if no other stop remains.

    ERR_PATHDIST: more than 10 mm or 20 degrees off the path (S4 datasys 2-StartMove-1).
    """
    groups = tuple(_groups(task, all_tasks))
    for group in groups:
        path, turn = group.off_path
        if path > group.settings.path_distance or turn > group.settings.path_angle:
            raise RapidError("ERR_PATHDIST", f"{group.name}: {path * 1000:.1f} mm off the path")
    for group in groups:
        group.start(reason_of(task))


@builtin("StartMoveRetry", cost="call")
def start_move_retry(task: Task) -> None:
    """Execute StartMove and RETRY, in an ERROR handler only.

    Source: [manual 3HAC050917].
    """
    start_move(task, None)
    task.errors.retry_here()


@builtin("StopMoveReset", cost="call")
def stop_move_reset(task: Task, all_tasks: bool | None) -> None:
    """Cancel the stop without movement.

    The remaining path is discarded (`stop_move_reset`).
    """
    for group in _groups(task, all_tasks):
        if group.settings.stop_move_reset == "releases":
            group.release(reason_of(task))


@builtin("IsStopMoveAct")
def is_stop_move_act(task: Task, from_move: bool | None, from_other: bool | None) -> bool:
    """Return True if a StopMove stops the robot.

    \\FromMoveTask and \\FromNonMoveTask select the kind of the stopping task.
    """
    reasons = group_of(task).stop_reasons
    other = any(reason.startswith(OTHER_TASK) for reason in reasons)
    if from_move:
        return MOVE_TASK in reasons
    if from_other:
        return other
    return MOVE_TASK in reasons or other


@builtin("RestoPath")
@planned
def resto_path(task: Task) -> None:
    """Restore the stored path; StartMove continues the movement."""
    group_of(task).restore_path(reason_of(task))


_PLAIN: dict[str, Callable[..., Value]] = {
    # What is left of the path goes; the robot ends where its stop ends.
    "ClearPath": lambda task: group_of(task).clear_path(),
    "WaitRob": lambda task, _in_pos, _zero_speed: group_of(task).wait_standing(task),
    "StorePath": lambda task, _keep_sync: group_of(task).store_path(task, reason_of(task)),
    "PathLevel": lambda task: group_of(task).path_level,
}
builtins(_PLAIN)


# -- Process errors, servo signals -----------------------------------------------------------------
#
# Process errors during movements, and payloads of axes.
#
# Sources: [K §7.4] for ProcerrRecovery, which stops the movement; 3HAC050917 for arguments. The
# model has no dynamics: torques are 0, loads have no effect. gizatt/ABB-IRB140 [code] for the
# arguments of TestSignDefine, its twelve channels and the signal numbers of a force sensor.


_CHANNELS = range(1, 13)
_TORQUE = 9
_FORCES = range(201, 213)
"""Torque of a motor, and what a force sensor feels: 0 where there are no dynamics."""


@builtin("ProcerrRecovery")
def procerr_recovery(
    task: Task, origin: bool | None, last: bool | None, _signal: bool | None
) -> None:
    """Stop the movement and raise ERR_PATH_STOP in the moving routine.

    Permitted in a trap only.
    """
    if not task.in_trap or origin == last:
        raise FatalError(
            NOT_ALLOWED,
            "ProcerrRecovery",
            "in a trap, with \\SyncOrg- or \\SyncLastMoveInst",
        )
    group = moving_group(task)
    group.stop("move task")
    owner = None
    if origin:
        owner = _owner(group)
    task.interrupts.process_error = ProcessError(errnum("ERR_PATH_STOP"), owner)


def _owner(group: MotionGroup) -> tuple[str, str]:
    """Return module and routine of the current path's move.

    Both are empty without a path.
    """
    place = group.legs[0].move.place if group.legs else None
    result = place() if place is not None else None
    return (result.module, result.routine) if isinstance(result, Location) else ("", "")


def _axis(group: MotionGroup, number: float) -> int:
    """Return the axis of a number from 1, or raise ERR_AXIS_PAR."""
    if number != int(number) or not 1 <= number <= len(group.config.joints):
        raise RapidError("ERR_AXIS_PAR", f"axis {number:g}")
    return int(number)


@builtin("MechUnitLoad")
def mech_unit_load(task: Task, _unit: Value, axis: float, load: Ref) -> None:
    """Set the payload of an external mechanical unit.

    FatalError: the load is undefined.
    """
    group = group_of(task)
    require_defined(task, group, load.get(), "the load of MechUnitLoad")
    data_of(task, group).extra[f"load of axis {int(axis)}"] = load.get().copy()


@builtin("GetMotorTorque")
def get_motor_torque(task: Task, _unit: Value, axis: float) -> float:
    """Return 0 Nm, or raise ERR_AXIS_PAR."""
    _axis(group_of(task), axis)
    return 0.0


# -- test signals --------------------------------------------------------------------------------


@builtin("TestSignDefine")
def define_test_signal(
    task: Task,
    channel: float,
    signal: float,
    unit: Value,
    axis: float,
    _sample: float,
) -> None:
    """Assign a servo signal to a channel.

    ERR_ARGVALERR: invalid channel; ERR_AXIS_PAR: invalid axis; FatalError: a signal without a
    public description.
    """
    if channel not in _CHANNELS:
        raise RapidError("ERR_ARGVALERR", f"channel {channel:g}")
    unit_axis(task, unit, axis)
    if signal != _TORQUE and signal not in _FORCES:
        raise FatalError(
            NOT_SIMULATED,
            f"Test signal {signal:g} is not simulated",
            "torques (9) and force sensors (201 to 212) are, and are 0",
        )
    task.controller.test_signals[int(channel)] = 0.0


@builtin("TestSignRead")
def read_test_signal(task: Task, channel: float) -> float:
    """Return the value of a channel, or raise ERR_ARGVALERR."""
    value = task.controller.test_signals.get(int(channel))
    if value is None:
        raise RapidError("ERR_ARGVALERR", f"channel {channel:g} has no signal")
    return value


@builtin("TestSignReset")
def reset_test_signals(task: Task) -> None:
    """Remove the signals of all channels."""
    task.controller.test_signals.clear()
