"""SetupCyclicBool to IsCyclicBool. See `rapidgen/runtime/cyclic.py` for sources."""

from collections.abc import Iterator

from rapidgen.runtime.compiler.runtime import Condition
from rapidgen.runtime.cyclic import MOST, CyclicBool, CyclicBools, follower
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value


@builtin("SetupCyclicBool")
def setup_cyclic_bool(
    task: Task, flag: Ref, condition: Condition, signal: AnySignal | None
) -> None:
    """Evaluate a condition on signals and persistents from now on.

    ERR_ARGVALERR: it calls a function of the program, or there are 60 already.
    """
    if condition.calls:
        raise RapidError("ERR_ARGVALERR", "the condition calls a function of the program")
    others = sum(name != flag.name.lower() for every in _all(task) for name in every.known)
    if others >= MOST:
        raise RapidError("ERR_ARGVALERR", f"there are {MOST} cyclic bools")
    follow = follower(signal.signal if signal is not None else None, task.controller.io.set)
    made = CyclicBool(task.scheduler, flag, condition.look, condition.watched, follow)
    task.cyclic.put(flag.name, made)


@builtin("RemoveCyclicBool")
def remove_cyclic_bool(task: Task, flag: Ref | None, name: str | None) -> None:
    """The persistent keeps its value. ERR_ARGVALERR: it has no condition in this task."""
    expected = _name(flag, name)
    if not task.cyclic.remove(expected):
        raise RapidError("ERR_ARGVALERR", f"{expected} is no cyclic bool")


@builtin("RemoveAllCyclicBool")
def remove_all_cyclic_bool(task: Task, all_tasks: bool | None) -> None:
    """Those of this task, or of all."""
    for every in _all(task) if all_tasks else (task.cyclic,):
        every.clear()


@builtin("GetMaxNumberOfCyclicBool")
def get_max_number_of_cyclic_bool(_task: Task) -> int:
    """How many there may be in all tasks."""
    return MOST


@builtin("GetNumberOfCyclicBool")
def get_number_of_cyclic_bool(task: Task) -> int:
    """How many there are in all tasks."""
    return sum(len(every.known) for every in _all(task))


@builtin("GetNextCyclicBool")
def get_next_cyclic_bool(task: Task, place: Ref, name: Ref) -> bool:
    """The next one behind a place, which is 0 at first; FALSE: there are no more."""
    names = [c.flag.name for every in _all(task) for c in every.known.values()]
    at = int(place.get())
    if not 0 <= at < len(names):
        return False
    name.set(names[at])
    place.set(at + 1)
    return True


@builtin("IsCyclicBool")
def is_cyclic_bool(
    task: Task, flag: Ref | None, name: str | None, reference: Value, task_name: str | None
) -> bool:
    """Whether a persistent has a condition, in this task or in a named one. ERR_TASKNAME."""
    expected = task_name if task_name is not None else reference.value if reference else task.name
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == str(expected).lower():
            return _name(flag, name).lower() in other.cyclic.known
    raise RapidError("ERR_TASKNAME", str(expected))


def _name(flag: Ref | None, name: str | None) -> str:
    return str(name) if flag is None else flag.name


def _all(task: RapidTask) -> Iterator[CyclicBools]:
    for other in task.controller.rapid_tasks.values():
        yield other.cyclic
