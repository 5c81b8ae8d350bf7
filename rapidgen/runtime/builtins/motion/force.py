"""Force control (option 661-2), which answers by the description of a cell.

Sources: names [manual 3HAC083267]; arguments [code]: public programs that polish and press with
FCPress1LStart, FCPressL, FCPressEnd, read FCGetForce and calibrate by FCLoadID. That a sensor which
is not calibrated stops the program is theirs, too (event 50323). FCPressC is as FCPressL [mem].
Nothing is touched: the robot goes where the program says, and a force is what the file says.
Searching by force (FCRefStart) stops the program.
"""

from typing import Final

from rapidgen.machine.force import ForceSensor
from rapidgen.runtime.builtins.motion.cartesian_request import cartesian_move
from rapidgen.runtime.builtins.motion.enqueue import order
from rapidgen.runtime.builtins.motion.task_group import group_of
from rapidgen.runtime.compiler.predefined import find_type
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.motion_faults import NOT_SIMULATED, planned
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import LoadData, Pos, Ref, Value

_UNCALIBRATED: Final = 50_323


def _sensor(task: Task) -> ForceSensor:
    """FatalError: nothing tells what the sensor measures."""
    result = task.controller.force.of(group_of(task).name)
    if result.measured.readings is None:
        raise FatalError(
            NOT_SIMULATED,
            "Nothing to measure",
            "say what the force sensor measures under `force:` in the description of the cell",
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
    """The robot stands, and the load of the tool is taken off from now on."""
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
    """The load of the description; axes 5 and 6, which a robot would turn for it, stand."""
    group_of(task).wait_standing(task)
    result = _sensor(task).measured
    if error is not None:
        error.set(0.0)
    load = LoadData()
    load.mass, load.cog = result.mass, Pos(*result.center)
    return load


@builtin("FCGetForce")
def fc_get_force(task: Task, tool: Ref | None, wobj: Ref | None, contact: bool | None) -> Value:
    """The next reading, in whatever frame it is asked for."""
    vector = find_type("fcforcevector")
    assert vector is not None
    assert vector.make is not None
    return vector.make(*_calibrated(task).read())


@builtin("FCAct")
def fc_act(
    task: Task, tool: Ref, wobj: Ref | None, reference: float | None, turn: Value | None
) -> None:
    """Force control is active; the robot stands until it is told to press or to search."""
    group_of(task).wait_standing(task)
    _calibrated(task).controls = True


@builtin("FCDeact")
def fc_deact(task: Task) -> None:
    """The robot is held in its position again."""
    group_of(task).wait_standing(task)
    sensor = _sensor(task)
    sensor.controls = sensor.pressing = False


@builtin("FCIsForceMode")
def fc_is_force_mode(task: Task) -> bool:
    """Whether force control is active."""
    return _sensor(task).controls


@by_name("FCPress1LStart", "FCPressL", "FCPressC", "FCPressEnd", cost="move")
@planned
def press(task: Task, name: str, arguments: Arguments) -> None:
    """A line or a circle of a path with a process force, as programmed. FatalError: FCPressL and
    its kin without a start."""
    sensor = _calibrated(task)
    if name != "FCPress1LStart" and not sensor.pressing:
        raise FatalError(
            NOT_SIMULATED, "No process force", f"{name} goes on from FCPress1LStart, which was not"
        )
    sensor.controls = sensor.pressing = True
    if not arguments.get("DeactOnly"):
        order(task, {**arguments, "T": None}, cartesian_move)
    if name == "FCPressEnd":
        group_of(task).wait_standing(task)
        sensor.controls = sensor.pressing = False
