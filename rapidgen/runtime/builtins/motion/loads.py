"""Loads that a robot carries: one that is undefined stops the program, one too heavy is reported.

Loads change no motion here, but a controller's motion and collision detection depend on them.
Event 41438 was seen at EGMActJoint with a load of 0 kg (ros-industrial/abb_libegm, issue 73); that
a negative mass has it at every move and in GripLoad is from memory [mem]: `undefined_load`. A mass
of 0 in a move is taken: no source says that a controller refuses it.
"""

from typing import Final

from rapidgen.config.plausibility import arm_of, mass_doubts
from rapidgen.motion.events import overload
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.positions import load0
from rapidgen.runtime.builtins.motion.task_group import data_of, here
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import Arguments
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value

_UNDEFINED: Final = 41_438
_GRIPPED: Final = "GripLoad"


def payload_of(task: RapidTask, group: MotionGroup) -> Value:
    """The active payload: what GripLoad or SetSysData set, None: nothing since PP to main."""
    return data_of(task, group).extra.get(_GRIPPED)


def carry(task: RapidTask, group: MotionGroup, load: Value, what: str) -> None:
    """Make a payload the active one. FatalError: it is undefined."""
    require_defined(task, group, load, what)
    data_of(task, group).extra[_GRIPPED] = load.copy()


def require_defined(
    task: RapidTask, group: MotionGroup, load: Value, what: str, *, zero: bool = True
) -> None:
    """FatalError: a mass is negative or no number; without `zero` also if it is 0."""
    if load.mass >= 0 if zero else load.mass > 0:
        return
    title, text = "Undefined load", f"{what} has a mass of {load.mass:g} kg"
    if group.settings.undefined_load == "stop":
        raise FatalError(_UNDEFINED, title, text)
    task.controller.log.warning(_UNDEFINED, title, text, task=task.name)


def check_loads(task: Task, group: MotionGroup, arguments: Arguments) -> None:
    """What a move carries; more than the robot's payload is reported once for each change.

    FatalError: a load is undefined. With \\TLoad that is all of it, unless it is load0
    (3HAC050917, MoveL).
    """
    total = arguments["TLoad"].get() if arguments.get("TLoad") is not None else None
    if total is not None and total != load0():
        loads = [("\\TLoad", total)]
    else:
        loads = [("the load of the tool", arguments["Tool"].get().tload)]
        payload = payload_of(task, group)
        loads += [("the payload", payload)] if payload is not None else []
    for what, load in loads:
        require_defined(task, group, load, what)
    mass = sum(load.mass for _, load in loads)
    data = data_of(task, group)
    if mass == data.carried:
        return
    data.carried = mass
    # The payload of a guessed robot says nothing of the program.
    if task.controller.motion.on_missed is not None:
        return
    for doubt in mass_doubts(mass, arm_of(group.config)):
        place = here(task)
        overload(task.controller.log, group.name, doubt.message, place() if place else None)
