"""Load to ModTime: modules at run time. See `loading.py` for sources."""

from rapidgen.rapid.numbers import single
from rapidgen.runtime import loading
from rapidgen.runtime.compiler.undefined_calls import missing_routines
from rapidgen.runtime.disks import file_path
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, register_type

_LOAD_RATE = 1_000_000
"""Bytes of a module that StartLoad reads in a second, while the program goes on."""


class LoadSession:
    """A `loadsession`: what StartLoad has ordered, if anything."""

    __slots__ = ("dynamic", "ready_at", "words")

    def __init__(self) -> None:
        self.words: str | None = None
        self.dynamic = False
        self.ready_at = 0


register_type("loadsession", LoadSession)


@builtin("Load", cost="socket")
def load(task: Task, dynamic: bool | None, path: str, file: str | None, check: bool | None) -> None:
    """Load a module and link it."""
    loading.load(task, loading.words_of(path, file), dynamic=bool(dynamic), check=bool(check))


@builtin("UnLoad", cost="socket")
def unload(
    task: Task, _if_changed: bool | None, save: bool | None, path: str, file: str | None
) -> None:
    """Unload what the same words have loaded."""
    loading.unload(task, loading.words_of(path, file), save_first=bool(save))


@builtin("StartLoad", cost="socket")
def start_load(
    task: Task, dynamic: bool | None, path: str, file: str | None, session: LoadSession
) -> None:
    """Order a module; whether its file exists only WaitLoad says [S4 WaitLoad]."""
    if session.words is not None:
        raise RapidError("ERR_LOADNO_INUSE")
    session.words = loading.words_of(path, file)
    session.dynamic = bool(dynamic)
    try:
        size = file_path(task, session.words).stat().st_size
    except (OSError, RapidError):
        size = 0
    session.ready_at = task.scheduler.now + size * 1_000_000_000 // _LOAD_RATE


@builtin("WaitLoad", cost="socket")
def wait_load(
    task: Task,
    unload_path: str | None,
    unload_file: str | None,
    session: LoadSession,
    check: bool | None,
) -> None:
    """Wait for an ordered module and link it; another one may go first."""
    if session.words is None:
        raise RapidError("ERR_LOADNO_NOUSE")
    task.sleep(max(0, session.ready_at - task.scheduler.now) / 1e9)
    words, session.words = session.words, None
    if unload_path is not None:
        loading.unload(task, loading.words_of(unload_path, unload_file))
    loading.load(task, words, dynamic=session.dynamic, check=bool(check))


@builtin("CancelLoad", cost="socket")
def cancel_load(_task: Task, session: LoadSession) -> None:
    """Take an order back."""
    if session.words is None:
        raise RapidError("ERR_LOADNO_NOUSE")
    session.words = None


@builtin("Save", cost="socket")
def save(
    task: Task,
    reference: object,
    name: str | None,
    module: str,
    path: str | None,
    file: str | None,
) -> None:
    """Save a module, of this task or another, with the present values of its persistents."""
    owner = task_named(task, reference, name)
    loading.save(owner, module, loading.words_of(path or "", file))


@builtin("EraseModule", cost="socket")
def erase_module(task: Task, module: str) -> None:
    """Remove a module from the program."""
    loading.erase(task, module)


@builtin("ModExist", cost="string")
def mod_exist(task: Task, module: str) -> bool:
    """Whether the task has a module of that name, or has loaded one."""
    known = task.program.modules.get(module.lower())
    return known is not None and (task.controller.dialect.modules_told or known.origin is not None)


@builtin("ModTime", cost="string")
def mod_time(task: Task, module: str, digits: Ref | None) -> float:
    """Time of a module's file; a num resolves 128 s today, \\StrDig every one."""
    return single(mod_time_dnum(task, module, digits))


@builtin("ModTimeDnum", cost="string")
def mod_time_dnum(task: Task, module: str, digits: Ref | None) -> int:
    """Time of a module's file."""
    seconds = loading.time(task, module)
    if digits is not None:
        digits.set(str(seconds))
    return seconds


@builtin("CheckProgRef", cost="socket")
def check_prog_ref(task: Task) -> None:
    """ERR_LINKREF when the program calls what does not exist."""
    missing = missing_routines(task.program)
    if missing:
        raise RapidError("ERR_LINKREF", missing[0].message)


def task_named(task: Task, reference: object, name: str | None) -> RapidTask:
    """The task of \\TaskRef or \\TaskName, else this one; ERR_TASKNAME: there is none."""
    expected = name if reference is None else getattr(reference, "value", None)
    if expected is None:
        return task
    for known, other in task.controller.rapid_tasks.items():
        if known.lower() == str(expected).lower():
            return other
    raise RapidError("ERR_TASKNAME", str(expected))
