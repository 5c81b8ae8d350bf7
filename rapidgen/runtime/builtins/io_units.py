"""I/O units: those that the signals of the configuration are on, switched off and on.

Sources: S4 datasys 2-IODisable, 2-IOEnable, 3HAC16581-1 IOUnitState [manual]; numbers of the states
as installed modules have them [code]. A unit runs unless a program has disabled it. Not simulated:
that signals of a disabled unit are not there; nothing is on the wire that could fail in time.
"""

from typing import Final

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task

_STATES: Final = {
    "Phys": (20.0, 21.0),
    "Logic": (10.0, 11.0),
    "": (3.0, 1.0),
}
"""iounit_state of a disabled unit and of one that runs: IOUNIT_PHYS_STATE_DEACTIVATED and _RUNNING,
IOUNIT_LOG_STATE_DISABLED and _ENABLED; IOUNIT_DISABLE and IOUNIT_RUNNING without a switch."""


def _known(task: Task, name: str) -> str:
    """ERR_NAME_INVALID: there is no such unit."""
    io = task.controller.io
    if not io.is_unit(name):
        raise RapidError("ERR_NAME_INVALID", f"no I/O unit '{name}'")
    return name.casefold()


@builtin("IOEnable")
def io_enable(task: Task, name: str, _max_time: float) -> None:
    """Switch a unit on."""
    task.controller.io.disabled.discard(_known(task, name))


@builtin("IODisable")
def io_disable(task: Task, name: str, _max_time: float) -> None:
    """Switch a unit off."""
    task.controller.io.disabled.add(_known(task, name))


@builtin("IOUnitState")
def io_unit_state(task: Task, name: str, phys: bool | None, logic: bool | None) -> float:
    """How a unit is."""
    disabled, running = _STATES["Phys" if phys else "Logic" if logic else ""]
    return disabled if _known(task, name) in task.controller.io.disabled else running
