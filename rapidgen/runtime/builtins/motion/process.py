"""Errors of a process that runs while the robot moves, and what its axes carry.

Sources: [K §7.4] for ProcerrRecovery, which stops the movement; 3HAC050917 for arguments. There
are no dynamics: torques are 0, loads change nothing. gizatt/ABB-IRB140 [code] for the arguments of
TestSignDefine, its twelve channels and the numbers of a force sensor's signals.
"""

from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.loads import require_defined
from rapidgen.runtime.builtins.motion.task_group import data_of, group_of, moving_group
from rapidgen.runtime.builtins.motion.units import unit_axis
from rapidgen.runtime.errors import FatalError, Location, RapidError, errnum
from rapidgen.runtime.motion_faults import NOT_ALLOWED, NOT_SIMULATED
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.process_errors import ProcessError
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

_CHANNELS = range(1, 13)
_TORQUE = 9
_FORCES = range(201, 213)
"""Torque of a motor, and what a force sensor feels: 0 where there are no dynamics."""


@builtin("ProcerrRecovery")
def procerr_recovery(
    task: Task, origin: bool | None, last: bool | None, _signal: bool | None
) -> None:
    """Stop the movement and raise ERR_PATH_STOP where the robot is moved from; only in a trap."""
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
    """Module and routine of the move that made the path; empty when there is no path."""
    place = group.legs[0].move.place if group.legs else None
    result = place() if place is not None else None
    return (result.module, result.routine) if isinstance(result, Location) else ("", "")


def _axis(group: MotionGroup, number: float) -> int:
    """The axis of a number from 1; ERR_AXIS_PAR."""
    if number != int(number) or not 1 <= number <= len(group.config.joints):
        raise RapidError("ERR_AXIS_PAR", f"axis {number:g}")
    return int(number)


@builtin("MechUnitLoad")
def mech_unit_load(task: Task, _unit: Value, axis: float, load: Ref) -> None:
    """Payload of an external mechanical unit. FatalError: it is undefined."""
    group = group_of(task)
    require_defined(task, group, load.get(), "the load of MechUnitLoad")
    data_of(task, group).extra[f"load of axis {int(axis)}"] = load.get().copy()


@builtin("GetMotorTorque")
def get_motor_torque(task: Task, _unit: Value, axis: float) -> float:
    """0 Nm. ERR_AXIS_PAR."""
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
    """A signal of the servos for a channel. ERR_ARGVALERR: no such channel; ERR_AXIS_PAR.

    FatalError: a signal of which nobody knows what it shows.
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
    """The value of a channel. ERR_ARGVALERR: none is defined for it."""
    value = task.controller.test_signals.get(int(channel))
    if value is None:
        raise RapidError("ERR_ARGVALERR", f"channel {channel:g} has no signal")
    return value


@builtin("TestSignReset")
def reset_test_signals(task: Task) -> None:
    """All channels are free."""
    task.controller.test_signals.clear()
