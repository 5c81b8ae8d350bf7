"""Force control."""

from typing import Final

from rapidgen.machine.sensors import ForceSensor
from rapidgen.runtime.builtins.motion.moves import cartesian_move, order
from rapidgen.runtime.builtins.motion.targets import group_of
from rapidgen.runtime.compiler.link import find_type
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.motion_interface import NOT_SIMULATED, planned
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import LoadData, Pos, Ref, Value

# -- Force control ---------------------------------------------------------------------------------
#
# Force control (option 661-2), with readings from the description of a cell.
#
# Sources: names [manual 3HAC083267]; arguments [code]: public programs that polish and press with
# FCPress1LStart, FCPressL, FCPressEnd, read FCGetForce and calibrate by FCLoadID. A sensor without
# calibration stops the program (event 50323), also from these programs. FCPressC corresponds to
# FCPressL [mem]. No contact is simulated: the robot follows the programmed path, and the forces are
# those of the description. Search by force (FCRefStart) stops the program.


_UNCALIBRATED: Final = 50_323


def _sensor(task: Task) -> ForceSensor:
    """Return the sensor of a task.

    FatalError: the cell has no description of its readings.
    """
    result = task.controller.force.of(group_of(task).name)
    if result.measured.readings is None:
        raise FatalError(
            NOT_SIMULATED,
            "Nothing to measure",
            "describe what the force sensor measures under `force:` in the description of the cell",
        )
    return result


def _calibrated(task: Task) -> ForceSensor:
    result = _sensor(task)
    if not result.calibrated:
        raise FatalError(
            _UNCALIBRATED, "Force sensor not calibrated", "FCCalib takes the load of the tool off"
        )
    return result


@builtin("FCCalib")
def fc_calib(task: Task, load: Value, _recovery: bool | None) -> None:
    """Calibrate at standstill; later readings exclude the tool load."""
    group_of(task).wait_standing(task)
    _sensor(task).calibrated = True


@builtin("FCLoadID")
def fc_load_id(
    task: Task,
    reading_time: float | None,
    axis_5: float | None,
    axis_6: float | None,
    points: float | None,
    quiet: bool | None,
    error: Ref | None,
) -> Value:
    """Return the load of the description.

    A real robot moves axes 5 and 6 for the measurement; this one stands still.
    """
    group_of(task).wait_standing(task)
    result = _sensor(task).measured
    if error is not None:
        error.set(0.0)
    load = LoadData()
    load.mass, load.cog = result.mass, Pos(*result.center)
    return load


@builtin("FCGetForce")
def fc_get_force(task: Task, tool: Ref | None, wobj: Ref | None, contact: bool | None) -> Value:
    """Return the next reading; the frame has no effect."""
    vector = find_type("fcforcevector")
    assert vector is not None
    assert vector.make is not None
    return vector.make(*_calibrated(task).read())


@builtin("FCAct")
def fc_act(
    task: Task, tool: Ref, wobj: Ref | None, reference: float | None, turn: Value | None
) -> None:
    """Activate force control; the robot waits for press or search."""
    group_of(task).wait_standing(task)
    _calibrated(task).controls = True


@builtin("FCDeact")
def fc_deact(task: Task) -> None:
    """Deactivate force control."""
    group_of(task).wait_standing(task)
    sensor = _sensor(task)
    sensor.controls = sensor.pressing = False


@builtin("FCIsForceMode")
def fc_is_force_mode(task: Task) -> bool:
    """Return True if force control is active."""
    return _sensor(task).controls


@by_name("FCPress1LStart", "FCPressL", "FCPressC", "FCPressEnd", cost="move")
@planned
def press(task: Task, name: str, arguments: Arguments) -> None:
    """Move on a line or circle with a process force.

    FatalError: FCPressL and related instructions without a start.
    """
    sensor = _calibrated(task)
    if name != "FCPress1LStart" and not sensor.pressing:
        raise FatalError(
            NOT_SIMULATED, "No process force", f"{name} requires FCPress1LStart before"
        )
    sensor.controls = sensor.pressing = True
    if not arguments.get("DeactOnly"):
        order(task, {**arguments, "T": None}, cartesian_move)
    if name == "FCPressEnd":
        group_of(task).wait_standing(task)
        sensor.controls = sensor.pressing = False
