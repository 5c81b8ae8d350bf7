"""Modules at run time and access to data by name."""

import re
from collections.abc import Callable, Iterator

from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.numbers import single
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime import loading
from rapidgen.runtime.builtins.motion.positions import carry, payload_of
from rapidgen.runtime.builtins.motion.targets import data_of, frame
from rapidgen.runtime.compiler.program import missing_routines
from rapidgen.runtime.compiler.symbols import Data, LoadedModule
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.loading import file_path
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.signals import target_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import PersistentCell, Ref, ValueRef, copy_value, register_type

# -- Modules ---------------------------------------------------------------------------------------
#
# Load to ModTime: modules at run time. See `loading.py` for sources.


class LoadSession:
    """A `loadsession`: the module ordered by StartLoad."""

    __slots__ = ("dynamic", "ready_at", "size", "words")

    def __init__(self) -> None:
        self.words: str | None = None
        self.dynamic = False
        self.ready_at = 0
        self.size = 0


register_type("loadsession", LoadSession)


@builtin("Load", cost="socket")
def load(task: Task, dynamic: bool | None, path: str, file: str | None, check: bool | None) -> None:
    """Load a module and link it."""
    loading.load(task, loading.words_of(path, file), dynamic=bool(dynamic), check=bool(check))


@builtin("UnLoad", cost="socket")
def unload(
    task: Task, _if_changed: bool | None, save: bool | None, path: str, file: str | None
) -> None:
    """Unload a module by the arguments that loaded it."""
    loading.unload(task, loading.words_of(path, file), save_first=bool(save))


@builtin("StartLoad", cost="socket")
def start_load(
    task: Task, dynamic: bool | None, path: str, file: str | None, session: LoadSession
) -> None:
    """Order a module to be loaded.

    WaitLoad reports a missing file [S4 WaitLoad].
    """
    if session.words is not None:
        raise RapidError("ERR_LOADNO_INUSE")
    session.words = loading.words_of(path, file)
    session.dynamic = bool(dynamic)
    try:
        session.size = file_path(task, session.words).stat().st_size
    except (OSError, RapidError):
        session.size = 0
    session.ready_at = task.scheduler.now + session.size * task.controller.costs.module_load


@builtin("WaitLoad", cost="socket")
def wait_load(
    task: Task,
    unload_path: str | None,
    unload_file: str | None,
    session: LoadSession,
    check: bool | None,
) -> None:
    """Wait for an ordered module and link it; optionally unload another one."""
    if session.words is None:
        raise RapidError("ERR_LOADNO_NOUSE")
    linked_at = max(session.ready_at, task.scheduler.now)
    linked_at += session.size * task.controller.costs.module_link
    task.sleep((linked_at - task.scheduler.now) / 1e9)
    words, session.words = session.words, None
    if unload_path is not None:
        loading.unload(task, loading.words_of(unload_path, unload_file))
    loading.load(task, words, dynamic=session.dynamic, check=bool(check))


@builtin("CancelLoad", cost="socket")
def cancel_load(_task: Task, session: LoadSession) -> None:
    """Cancel an order."""
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
    """Save a module of any task.

    The file contains the present values of the module's persistents.
    """
    owner = task_named(task, reference, name)
    loading.save(owner, module, loading.words_of(path or "", file))


@builtin("EraseModule", cost="socket")
def erase_module(task: Task, module: str) -> None:
    """Remove a module from the program."""
    loading.erase(task, module)


@builtin("ModExist", cost="string")
def mod_exist(task: Task, module: str) -> bool:
    """Return True if the task has a module of that name or path."""
    known = task.program.modules.get(module.lower())
    return known is not None and (
        task.controller.dialect.installed_modules_exist or known.origin is not None
    )


@builtin("ModTime", cost="string")
def mod_time(task: Task, module: str, digits: Ref | None) -> float:
    """Return the time of a module's file.

    A num has a resolution of 128 s today; \\StrDig has 1 s.
    """
    return single(mod_time_dnum(task, module, digits))


@builtin("ModTimeDnum", cost="string")
def mod_time_dnum(task: Task, module: str, digits: Ref | None) -> int:
    """Return the time of a module's file."""
    seconds = loading.time(task, module)
    if digits is not None:
        digits.set(str(seconds))
    return seconds


@builtin("CheckProgRef", cost="socket")
def check_prog_ref(task: Task) -> None:
    """Raise ERR_LINKREF if the program calls an undefined routine."""
    missing = missing_routines(task.program)
    if missing:
        raise RapidError("ERR_LINKREF", missing[0].message)


def task_named(task: Task, reference: object, name: str | None) -> RapidTask:
    """Return the task of \\TaskRef or \\TaskName, or this task.

    Raises ERR_TASKNAME for an unknown task.
    """
    expected = name if reference is None else getattr(reference, "value", None)
    if expected is None:
        return task
    for known, other in task.controller.rapid_tasks.items():
        if known.lower() == str(expected).lower():
            return other
    raise RapidError("ERR_TASKNAME", str(expected))


# -- Data by name ----------------------------------------------------------------------------------
#
# Data by name: GetDataVal, SetDataSearch and their family; the active tool and work object.
#
# Sources: 3HAC16581-1's arguments and error names [manual]; the pairing of error and case is
# remembered only [mem]. A search that is not narrowed to a task or module sees predefined data,
# too: Keyence's CV-X modules [code] look for tool0 and wobj0 so.


_ELEMENT = re.compile(r"(\w+)\{([\d,\s]+)\}")


class DataPosition:
    """A `datapos`: the module that contains a found datum."""

    __slots__ = ("module",)

    def __init__(self) -> None:
        self.module: LoadedModule | None = None


register_type("datapos", DataPosition)


# -- by name ------------------------------------------------------------------------------------


def _data_ref(
    task: RapidTask, module: LoadedModule | None, name: str
) -> tuple[Data, Ref | PersistentCell]:
    """Return the data of a task by name, or raise ERR_SYM_ACCESS."""
    program = task.program
    data = program.find_data(module, name.lower())
    if data is None:
        raise RapidError("ERR_SYM_ACCESS", name)
    if data.storage == "inline":
        return data, ValueRef(data.value, data.type, (), data.name)
    if data.storage == "cell":
        cell: PersistentCell = program.space[data.code]
        return data, cell
    reference: Ref = program.space[program.global_ref(data)]
    return data, reference


def _reached(
    task: Task, block: DataPosition | None, reference: object, task_name: str | None, name: str
) -> tuple[Data, Ref | PersistentCell]:
    """Return data by name, of this task or of a named task.

    In another task only persistents are visible [mem]; other names raise ERR_SYM_ACCESS.
    """
    owner = task_named(task, reference, task_name)
    data, result = _data_ref(owner, block.module if block is not None else None, name)
    if owner is not task and not task.controller.dialect.data_of_tasks:
        raise RapidError("ERR_TASKNAME", owner.name)
    if owner is not task and data.storage != "cell":
        raise RapidError("ERR_SYM_ACCESS", f"{name} is no PERS of {owner.name}")
    return data, result


def _indices(name: str) -> tuple[str, tuple[int, ...]]:
    match = _ELEMENT.fullmatch(name.strip())
    if match is None:
        return name.strip(), ()
    return match[1], tuple(int(part) for part in match[2].split(","))


def _check_type(source: Ref | PersistentCell, degree: int, target: Ref | PersistentCell) -> None:
    if source.type is not target.type:
        raise RapidError("ERR_SYMBOL_TYPE", f"{source.name} is a {source.type.name}")
    if source.dims[degree:] != target.dims:
        raise RapidError("ERR_INVDIM", source.name)


@builtin("GetDataVal", cost="string")
def get_data_val(
    task: Task,
    name: str,
    block: DataPosition | None,
    reference: object,
    task_name: str | None,
    argument: object,
) -> None:
    """Return the value of data by name, or of an element `name{i}`."""
    target = target_of(argument)
    plain, indices = _indices(name)
    _, source = _reached(task, block, reference, task_name, plain)
    _check_type(source, len(indices), target)
    value = source.get()
    for index in indices:
        value = value[index]
    target.set(copy_value(value))


@builtin("SetDataVal", cost="string")
def set_data_val(
    task: Task,
    name: str,
    block: DataPosition | None,
    reference: object,
    task_name: str | None,
    argument: object,
) -> None:
    """Set data by name; constants raise ERR_SYM_ACCESS."""
    value = target_of(argument)
    plain, indices = _indices(name)
    data, target = _reached(task, block, reference, task_name, plain)
    if data.readonly:
        raise RapidError("ERR_SYM_ACCESS", f"{name} is a constant")
    _check_type(target, len(indices), value)
    if not indices:
        target.set(copy_value(value.get()))
        return
    complete = copy_value(target.get())
    part = complete
    for index in indices[:-1]:
        part = part[index]
    part[indices[-1]]  # an index outside is the usual error
    part[indices[-1]] = copy_value(value.get())
    target.set(complete)


# -- searches -----------------------------------------------------------------------------------


def _fitting(task: RapidTask, pattern: str) -> Callable[[str], object]:
    """Return a function that matches names with a regular expression.

    The expression matches the complete name or a part of it.
    """
    try:
        compiled = re.compile(pattern, re.IGNORECASE)
    except re.error as error:
        raise RapidError("ERR_ARGVALERR", f"'{pattern}' is no pattern") from error
    part = task.controller.dialect.search_pattern == "part"
    return compiled.search if part else compiled.fullmatch


def _declared(
    task: RapidTask, type_: str, module: str, pattern: str
) -> Iterator[tuple[LoadedModule, n.DataDeclaration, Data]]:
    """Iterate over module data of a type whose names match.

    An empty type name means all types.
    """
    fits = _fitting(task, pattern)
    for loaded in tuple(task.program.modules.values()):
        if module and loaded.name.lower() != module.lower():
            continue
        for key, declaration in tuple(loaded.declarations.items()):
            if type_ and declaration.type.lower() != type_.lower():
                continue
            if pattern and not fits(declaration.name):
                continue
            data = task.program.find_data(loaded, key)
            if data is not None:
                yield loaded, declaration, data


def _predefined(task: Task, type_: str, pattern: str, kinds: set[str]) -> Iterator[Data]:
    """Iterate over predefined data that the program does not hide.

    An empty type name means all types.
    """
    fits = _fitting(task, pattern)
    for key, known in signatures.predefined().items():
        if type_ and known.type.lower() != type_.lower():
            continue
        if (kinds and known.kind not in kinds) or key in task.program.names.globals:
            continue
        if pattern and not fits(known.name):
            continue
        data = task.program.find_data(None, key)
        if data is not None:
            yield data


@builtin("SetDataSearch", cost="string")
def set_data_search(
    task: Task,
    type_: str,
    _type_module: str | None,
    pattern: str | None,
    pers: bool | None,
    var: bool | None,
    const: bool | None,
    in_task: bool | None,
    in_module: str | None,
    _in_routine: str | None,
    global_: bool | None,
    local: bool | None,
) -> None:
    """Begin a search, restricted by kinds, location and scope.

    Without restrictions it covers all data.
    """
    kinds = {k for k, expected in (("PERS", pers), ("VAR", var), ("CONST", const)) if expected}
    result: list[tuple[LoadedModule | None, Data]] = [
        (module, data)
        for module, declaration, data in _declared(
            task, type_, "" if in_task else in_module or "", pattern or ""
        )
        if (not kinds or declaration.kind in kinds)
        and (not global_ or declaration.scope != "LOCAL")
        and (not local or declaration.scope == "LOCAL")
    ]
    if not (in_task or in_module or local):
        result += [(None, data) for data in _predefined(task, type_, pattern or "", kinds)]
    task.found, task.searched_module = iter(result), bool(in_module) and not in_task


@builtin("GetNextSym", cost="string")
def get_next_sym(task: Task, name: Ref, block: DataPosition, recursive: bool | None) -> bool:
    """Return the next result of a search.

    The search covers its level, or also the levels below. Returns FALSE after the last result.
    """
    below = recursive or task.searched_module or task.controller.dialect.next_symbol == "below"
    for module, data in task.found:
        if below or module is None:
            name.set(data.name)
            block.module = module
            return True
    return False


@builtin("SetAllDataVal", cost="string")
def set_all_data_val(
    task: Task,
    type_: str,
    _type_module: str | None,
    pattern: str | None,
    _hidden: bool | None,
    argument: object,
) -> None:
    """Set all module data of a type (and name) except constants."""
    value = target_of(argument)
    for module, _, data in list(_declared(task, type_, "", pattern or "")):
        _, target = _data_ref(task, module, data.name)
        if not data.readonly and target.dims == value.dims:
            target.set(copy_value(value.get()))


# -- what is active -----------------------------------------------------------------------------

_ACTIVE = {"tooldata": "tool0", "wobjdata": "wobj0", "loaddata": "load0"}


@builtin("GetSysData", cost="string")
def get_sys_data(
    task: Task, reference: object, task_name: str | None, target: Ref, name: Ref | None
) -> None:
    """Return the active tool, work object or payload, by target type."""
    owner = task_named(task, reference, task_name)
    kind = target.type.name
    if kind not in _ACTIVE:
        raise RapidError("ERR_SYMBOL_TYPE", kind)
    group = task.controller.motion.of_task(owner.name)
    active = None
    if group is not None:
        data = data_of(owner, group)
        known_ones = {"tooldata": data.tool, "wobjdata": data.work_object}
        active = known_ones[kind] if kind in known_ones else payload_of(owner, group)
    _, default = _data_ref(owner, None, _ACTIVE[kind])
    value = default.get() if active is None else active
    target.set(copy_value(value))
    if name is not None:
        known = "" if active is None else _name_of(owner, kind, value)
        name.set(known or _ACTIVE[kind])


def _name_of(task: RapidTask, kind: str, value: object) -> str:
    """Return the name of the persistent that contains a value.

    The persistent that is the object itself precedes one with an equal value.
    """
    equal = ""
    for module, _, data in _declared(task, kind, "", ""):
        held = _data_ref(task, module, data.name)[1].get()
        if held is value:
            return data.name
        if not equal and held == value:
            equal = data.name
    return equal


@builtin("SetSysData", cost="string")
def set_sys_data(task: Task, source: Ref, name: str | None) -> None:
    """Activate a tool, work object or payload."""
    kind = source.type.name
    if kind not in _ACTIVE:
        raise RapidError("ERR_SYMBOL_TYPE", kind)
    chosen = source if name is None else _data_ref(task, None, name)[1]
    group = task.controller.motion.of_task(task.name)
    if group is None:
        return
    data = data_of(task, group)
    if kind == "tooldata":
        data.use(chosen.get(), data.work_object)
        group.planner.tool = frame(chosen.get().tframe)
    elif kind == "wobjdata":
        data.use(data.tool, chosen.get())
    else:
        carry(task, group, chosen.get(), "the load of SetSysData")
