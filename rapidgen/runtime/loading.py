"""Modules loaded at run time, and the disks that store them."""

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
    """Return the path of a program's file name.

    `file` is the argument \\File. ERR_FILEACC: outside all disks.
    """
    with _in_rapid():
        return task.controller.files.path(path, file)


def hold(task: RapidTask, device: IODevice | Directory) -> None:
    """Register an open file or folder. ERR_FILEOPEN: too many."""
    with _in_rapid():
        task.controller.files.hold(device, task.name)


def spend(task: RapidTask, count: int) -> None:
    """Account for written bytes. ERR_FILEACC: the disk is full."""
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
    """Load the module of a file into a task and return its name.

    RapidError: ERR_FILNOTFND, ERR_IOERROR, ERR_PRGMEMFULL, ERR_SYNTAX, ERR_LOADED, ERR_LINKREF
    (`check`).
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
    """Remove a module by the path that loaded it.

    ERR_UNLOAD: not loaded, or in execution.
    """
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
    """Remove a module by name. ERR_MODULE: unknown, or in execution."""
    running = any(place.module.lower() == module.lower() for place in task.stack())
    loaded = task.program.modules.get(module.lower())
    if running or loaded is None or loaded.installed:  # not for installed ones [manual]
        raise RapidError("ERR_MODULE", module)
    task.program.unload(module)


def save(task: RapidTask, module: str, words: str) -> None:
    """Write a module with current values of its persistents."""
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
    """Remove modules loaded with \\Dynamic, for PP to main."""
    for name, module in tuple(task.program.modules.items()):
        if module.origin is not None and module.origin.dynamic:
            task.program.unload(name)


def time(task: RapidTask, module: str) -> int:
    """Return the time of a module's file in seconds since 1970.

    ERR_MOD_NOTLOADED: the module is not loaded.
    """
    loaded = task.program.modules.get(module.lower())
    if loaded is None:
        raise RapidError("ERR_MOD_NOTLOADED", module)
    if loaded.origin is not None:
        return loaded.origin.seconds
    return int(date_time(task.scheduler).timestamp() - task.scheduler.now // 1_000_000_000)


def words_of(path: str, file: str | None) -> str:
    """Join FilePath and \\File into one text."""
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
    """Return the source of a module with present PERS values [K §2.18, 2.23]."""
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
