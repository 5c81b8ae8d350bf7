"""Modules loaded at run time, and the disks that hold them."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.diagnostics import Severity
from rapidgen.machine.files import Directory, DiskFault, DiskReason, IODevice
from rapidgen.machine.scheduler import date_time
from rapidgen.runtime.compiler.program import missing_routines
from rapidgen.runtime.compiler.symbols import LoadedModule, Origin
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.text import literal_text
from rapidgen.runtime.values import PersistentCell, register_type
from rapidgen.system.model import ModuleFile

# -- Disks -----------------------------------------------------------------------------------------
#
# The controller's disks as programs see them: iodev, dir, and what a disk's faults are called.


_ERRORS = {
    DiskReason.NO_ACCESS: "ERR_FILEACC",
    DiskReason.TOO_MANY_OPEN: "ERR_FILEOPEN",
}

register_type("iodev", IODevice)
register_type("dir", Directory)


@contextmanager
def _in_rapid() -> Iterator[None]:
    try:
        yield
    except DiskFault as fault:
        raise RapidError(_ERRORS[fault.reason], str(fault)) from fault


def file_path(task: RapidTask, path: str, file: str = "") -> Path:
    """Where a path (with \\File behind it) lies. ERR_FILEACC: on no disk, or outside of it."""
    with _in_rapid():
        return task.controller.files.path(path, file)


def hold(task: RapidTask, device: IODevice | Directory) -> None:
    """A file or folder is open for the task; ERR_FILEOPEN when too many are."""
    with _in_rapid():
        task.controller.files.hold(device, task.name)


def spend(task: RapidTask, count: int) -> None:
    """Account for bytes that are written; ERR_FILEACC when the disk is full."""
    with _in_rapid():
        task.controller.files.spend(count)


# -- Modules ---------------------------------------------------------------------------------------
#
# Modules that a program loads, unloads and saves while it runs.
#
# Sources: S4 reference, pages Load, UnLoad, StartLoad, WaitLoad, Save [manual]; [K §2.18] for the
# value of a persistent, which is saved as its initial value.


LARGEST_MODULE = 8_000_000
"""Bytes; a larger one does not fit the program memory."""


def load(task: RapidTask, words: str, *, dynamic: bool, check: bool) -> str:
    """Link the module of a file into a task; its name.

    RapidError: ERR_FILNOTFND, ERR_IOERROR, ERR_PRGMEMFULL, ERR_SYNTAX, ERR_LOADED,
    ERR_LINKREF (`check`).
    """
    path = _found(task, words)
    try:
        data = read_foreign(path, LARGEST_MODULE)
    except TooLarge as error:
        raise RapidError("ERR_PRGMEMFULL", words) from error
    except OSError as error:
        raise RapidError("ERR_IOERROR", f"{words}: {error.strerror}") from error
    file = ModuleFile(path.stem, words, data)
    tree = task.controller.parse_module(file)
    wrong = [d for d in tree.diagnostics if d.severity is Severity.ERROR]
    if wrong or not tree.name:
        raise RapidError("ERR_SYNTAX", f"{words}: {wrong[0].message if wrong else 'no module'}")
    program = task.program
    if tree.name.lower() in program.modules:
        raise RapidError("ERR_LOADED", tree.name)
    known = len(program.faults)
    program.load([(tree, file)])
    wrong = [d for d in program.faults[known:] if d.severity is Severity.ERROR]
    if wrong:
        reason = wrong[0].message
        del program.faults[known:]
        program.unload(tree.name)
        raise RapidError("ERR_SYNTAX", f"{words}: {reason}")
    if check and missing_routines(program):
        program.unload(tree.name)
        raise RapidError("ERR_LINKREF", words)
    program.modules[tree.name.lower()].origin = Origin(dynamic, int(path.stat().st_mtime))
    return str(tree.name)


def unload(task: RapidTask, words: str, *, save_first: bool = False) -> None:
    """Remove what the same words have loaded; ERR_UNLOAD when there is none, or it runs."""
    for name, module in task.program.modules.items():
        if module.origin is not None and _same(module.file.path, words):
            if any(place.module.lower() == name for place in task.stack()):
                raise RapidError("ERR_UNLOAD", f"{name} is being executed")
            if save_first:
                save(task, name, words)
            task.program.unload(name)
            return
    raise RapidError("ERR_UNLOAD", words)


def erase(task: RapidTask, module: str) -> None:
    """Remove a module by its name; ERR_MODULE when there is none, or it is being executed."""
    running = any(place.module.lower() == module.lower() for place in task.stack())
    loaded = task.program.modules.get(module.lower())
    if running or loaded is None or loaded.installed:  # not for installed ones [manual]
        raise RapidError("ERR_MODULE", module)
    task.program.unload(module)


def save(task: RapidTask, module: str, words: str) -> None:
    """Write a module to a file, with the current values of its persistents."""
    loaded = task.program.modules.get(module.lower())
    if loaded is None or loaded.installed:
        raise RapidError("ERR_MODULE", module)
    if not words:
        if loaded.origin is None:
            raise RapidError("ERR_PATH", "only a loaded module knows its file")
        words = loaded.file.path
    data = module_text(task, loaded).encode(loaded.tree.source.encoding, "replace")
    spend(task, len(data))
    try:
        file_path(task, words).write_bytes(data)
    except OSError as error:
        raise RapidError("ERR_IOERROR", f"{words}: {error.strerror}") from error


def drop_dynamic(task: RapidTask) -> None:
    """PP to main: modules that were loaded with \\Dynamic go."""
    for name, module in tuple(task.program.modules.items()):
        if module.origin is not None and module.origin.dynamic:
            task.program.unload(name)


def time(task: RapidTask, module: str) -> int:
    """Seconds since 1970 of a module's file; ERR_MOD_NOTLOADED when it is not loaded."""
    loaded = task.program.modules.get(module.lower())
    if loaded is None:
        raise RapidError("ERR_MOD_NOTLOADED", module)
    if loaded.origin is not None:
        return loaded.origin.seconds
    return int(date_time(task.scheduler).timestamp() - task.scheduler.now // 1_000_000_000)


def words_of(path: str, file: str | None) -> str:
    """The text that names a file: FilePath and \\File in one."""
    if not file:
        return path
    return path + file if path.endswith(("/", ":")) else f"{path}/{file}"


def _found(task: RapidTask, words: str) -> Path:
    path = file_path(task, words)
    if not path.is_file():
        raise RapidError("ERR_FILNOTFND", words)
    return path


def _same(one: str, other: str) -> bool:
    return one.replace("\\", "/").lower() == other.replace("\\", "/").lower()


def module_text(task: RapidTask, module: LoadedModule) -> str:
    """Source of a module in which every PERS has its present value [K §2.18, 2.23]."""
    source = module.tree.source
    changes: list[tuple[int, int, str]] = []
    for key, declaration in module.declarations.items():
        if declaration.kind != "PERS" or declaration.initial is None:
            continue
        data = task.program.find_data(module, key)
        cell = task.program.space.get(data.code) if data is not None else None
        if isinstance(cell, PersistentCell) and cell.type.is_value:
            start = source.starts[declaration.initial.first]
            last = declaration.initial.last
            end = source.starts[last] + len(source.tokens[last])
            changes.append((start, end, literal_text(cell.v, cell.type)))
    text = source.text
    for start, end, value in sorted(changes, reverse=True):
        text = text[:start] + value + text[end:]
    return text
