"""Cameras of integrated vision (option 1341-1).

The description of a cell defines what a camera sees. An image of a camera without a description
stops the program.

Sources: 3HAC050917 for CamReqImage, CamGetResult and related instructions as remembered [mem];
arguments of CamGetResult and CamGetParameter [code]: TechnoX/ABB-YUMI-LIB,
umairfaisal/Snakes-and-Ladders. The durations of an image and a job are assumptions of this project.
A camera starts in run mode; programs load jobs and write parameters in program mode only.
"""

from functools import partial
from math import inf, radians
from typing import Final

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S
from rapidgen.machine.sensors import Camera, Seen
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import NOT_SIMULATED
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Orient, Pos, Pose, Ref, Value

_IMAGE: Final = 0.2
"""Seconds that an image takes."""
_JOB: Final = 1.0
"""Seconds that loading a job takes."""
_LONGEST: Final = 120.0
"""Seconds that a result is waited for without \\MaxTime [mem]."""


def _camera(task: Task, device: Value) -> Camera:
    """Return the camera of a cameradev, or raise ERR_CAM_NOT_ON_NETWORK."""
    match = task.controller.cameras.get(device.value.lower())
    if match is None:
        raise RapidError("ERR_CAM_NOT_ON_NETWORK", device.value)
    return match


@builtin("CamSetProgramMode")
def cam_set_program_mode(task: Task, device: Value) -> None:
    """Switch to program mode; pending results are lost."""
    camera = _camera(task, device)
    camera.running = False
    camera.results.clear()


@builtin("CamSetRunMode")
def cam_set_run_mode(task: Task, device: Value) -> None:
    """Switch to run mode, which permits image requests."""
    _camera(task, device).running = True


def _in_program_mode(task: Task, device: Value) -> Camera:
    camera = _camera(task, device)
    if camera.running:
        raise RapidError("ERR_CAM_NO_PROGMODE", camera.name)
    return camera


@builtin("CamLoadJob")
def cam_load_job(
    task: Task, device: Value, job: str, keep: bool | None, time_out: float | None
) -> None:
    """Load a job and wait for it.

    Raises ERR_CAM_NO_PROGMODE, and ERR_CAM_MAXTIME after \\MaxTime.
    """
    camera = _in_program_mode(task, device)
    allowed = inf if time_out is None else time_out
    task.wait_for(lambda: False, on=(), timeout=min(_JOB, allowed))
    if allowed < _JOB:
        raise RapidError("ERR_CAM_MAXTIME", job)
    _load(camera, job, keep)


@builtin("CamStartLoadJob")
def cam_start_load_job(task: Task, device: Value, job: str, keep: bool | None) -> None:
    """Load a job without waiting, or raise ERR_CAM_NO_PROGMODE."""
    camera = _in_program_mode(task, device)
    camera.job = ""
    task.scheduler.after(round(_JOB * S), partial(_load, camera, job, keep))


def _load(camera: Camera, job: str, keep: bool | None) -> None:
    if not keep:
        camera.results.clear()
    camera.job = job
    camera.changed.notify()


@builtin("CamWaitLoadJob")
def cam_wait_load_job(task: Task, device: Value) -> None:
    """Wait until the job is loaded."""
    camera = _camera(task, device)
    task.wait_for(lambda: bool(camera.job), on=(camera.changed,))


@builtin("CamReqImage")
def cam_req_image(
    task: Task, device: Value, scene: Ref | None, keep: bool | None, complete: bool | None
) -> None:
    """Request an image, or raise ERR_CAM_NO_RUNMODE.

    FatalError: the cell has no description for this camera.
    """
    camera = _camera(task, device)
    if not camera.running:
        raise RapidError("ERR_CAM_NO_RUNMODE", camera.name)
    if camera.images is None:
        raise FatalError(
            NOT_SIMULATED,
            "Nothing to see",
            f"describe what {camera.name} sees under `cameras:` in the description of the cell",
        )
    camera.under_way += 1
    number = camera.taken + camera.under_way
    if scene is not None:
        scene.set(number)
    task.scheduler.after(round(_IMAGE * S), partial(camera.look, number, keep=bool(keep)))
    if complete:
        task.wait_for(lambda: not camera.under_way, on=(camera.changed,))


@builtin("CamGetResult")
def cam_get_result(
    task: Task, device: Value, target: Ref, scene: float | None, time_out: float | None
) -> None:
    """Fetch a result.

    ERR_CAM_NO_MORE_DATA: no result is left; ERR_CAM_MAXTIME: no image arrived.
    """
    camera = _camera(task, device)
    expected = None if scene is None else int(scene)

    def there() -> bool:
        return bool(_of_scene(camera, expected)) or (camera.taken > 0 and not camera.under_way)

    allowed = _LONGEST if time_out is None else time_out
    if not task.wait_for(there, on=(camera.changed,), timeout=allowed):
        raise RapidError("ERR_CAM_MAXTIME", camera.name)
    result = _of_scene(camera, expected)
    if not result:
        raise RapidError("ERR_CAM_NO_MORE_DATA", camera.name)
    camera.results.remove(result[0])
    target.set(_filled(target.get().copy(), camera, *result[0]))


@builtin("CamNumberOfResults")
def cam_number_of_results(task: Task, device: Value, scene: float | None) -> int:
    """Return the number of pending results."""
    return len(_of_scene(_camera(task, device), None if scene is None else int(scene)))


def _of_scene(camera: Camera, scene: int | None) -> list[tuple[int, Seen]]:
    return [result for result in camera.results if scene in (None, result[0])]


def _filled(made: Value, camera: Camera, scene: int, seen: Seen) -> Value:
    """Return a cameratarget with the values of a result."""
    turn = frames.about((0.0, 0.0, 1.0), radians(seen.angle))
    made.name, made.type, made.cameraname, made.sceneid = seen.name, seen.type, camera.name, scene
    made.cframe = Pose(Pos(*map(single, seen.place)), Orient(*map(single, turn)))
    for n in range(5):
        setattr(made, f"val{n + 1}", single(seen.values[n]) if n < len(seen.values) else 0)
    for n in range(2):
        setattr(made, f"string{n + 1}", seen.texts[n] if n < len(seen.texts) else "")
    return made


@builtin("CamFlush")
def cam_flush(task: Task, device: Value) -> None:
    """Discard all pending results."""
    _camera(task, device).results.clear()


@builtin("CamGetName")
def cam_get_name(task: Task, device: Value) -> str:
    """Return the name of the camera of a cameradev."""
    return _camera(task, device).name


@builtin("CamGetLoadedJob")
def cam_get_loaded_job(task: Task, device: Value) -> str:
    """Return the name of the loaded job, empty without one."""
    return _camera(task, device).job


@builtin("CamGetParameter")
def cam_get_parameter(
    task: Task, device: Value, name: str, number: Ref | None, flag: Ref | None, text: Ref | None
) -> None:
    """Read a parameter.

    ERR_CAM_GET_MISMATCH: neither the description nor the program defines it.
    """
    camera = _camera(task, device)
    value = camera.parameters.get(name.lower(), 0.0 if camera.is_guess else None)
    if value is None:
        raise RapidError("ERR_CAM_GET_MISMATCH", name)
    if number is not None:
        number.set(single(value))
    if flag is not None:
        flag.set(value != 0)
    if text is not None:
        text.set(f"{value:g}")


@builtin("CamSetParameter")
def cam_set_parameter(
    task: Task,
    device: Value,
    name: str,
    number: float | None,
    flag: bool | None,
    text: str | None,
) -> None:
    """Write a parameter.

    Raises ERR_CAM_NO_PROGMODE, and ERR_CAM_SET_MISMATCH for text that is not a number.
    """
    camera = _in_program_mode(task, device)
    arguments = next((value for value in (number, flag, text) if value is not None), 0)
    try:
        camera.parameters[name.lower()] = float(arguments)
    except ValueError as fault:
        raise RapidError("ERR_CAM_SET_MISMATCH", name) from fault


@builtin("CamSetExposure")
def cam_set_exposure(
    task: Task, device: Value, time: float | None, brightness: float | None, contrast: float | None
) -> None:
    """Store exposure values as parameters, or raise ERR_CAM_NO_PROGMODE.

    They do not change the result of an image.
    """
    camera = _in_program_mode(task, device)
    arguments = {"exposuretime": time, "brightness": brightness, "contrast": contrast}
    camera.parameters.update({n: v for n, v in arguments.items() if v is not None})
