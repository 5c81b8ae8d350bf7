"""Modules that a program loads, unloads and saves while it runs.

Sources: S4 reference, pages Load, UnLoad, StartLoad, WaitLoad, Save [manual]; [K §2.18] for the
value of a persistent, which is saved as its initial value.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.diagnostics import Severity
from rapidgen.machine.calendar import date_time
from rapidgen.runtime.compiler.missing import missing_routines
from rapidgen.runtime.compiler.symbols import Data, LoadedModule
from rapidgen.runtime.disks import file_path, spend
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.text import literal_text
from rapidgen.runtime.values import PersistentCell
from rapidgen.system.model import ModuleFile

if TYPE_CHECKING:
    from rapidgen.runtime.task.task import Task

LARGEST_MODULE = 8_000_000
"""Bytes; a larger one does not fit the program memory."""


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a module came from: the words of the Load that brought it."""

    path: str
    dynamic: bool
    seconds: int
    """Time of the file, since 1970."""


class ModuleTable:
    """Modules that the tasks of a controller have loaded themselves."""

    def __init__(self) -> None:
        self._origins: dict[tuple[str, str], Origin] = {}
        self.searches: dict[str, Iterator[tuple[LoadedModule | None, Data]]] = {}
        """By task: what SetDataSearch has found and GetNextSym has not given yet."""

    def origin(self, task: "Task", module: str) -> Origin | None:
        """Where a module came from; None when it belongs to the configuration."""
        return self._origins.get((task.name, module.lower()))

    def load(self, task: "Task", words: str, *, dynamic: bool, check: bool) -> str:
        """Link the module of a file into a task; its name.

        RapidError: ERR_FILNOTFND, ERR_IOERROR, ERR_PRGMEMFULL, ERR_SYNTAX, ERR_LOADED,
        ERR_LINKREF (`check`).
        """
        path = _found(task, words)
        try:
            data = path.read_bytes()
        except OSError as error:
            raise RapidError("ERR_IOERROR", f"{words}: {error.strerror}") from error
        if len(data) > LARGEST_MODULE:
            raise RapidError("ERR_PRGMEMFULL", words)
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
        if len(program.faults) > known:
            reason = program.faults[known].message
            del program.faults[known:]
            program.unload(tree.name)
            raise RapidError("ERR_SYNTAX", f"{words}: {reason}")
        if check and missing_routines(program):
            program.unload(tree.name)
            raise RapidError("ERR_LINKREF", words)
        origin = Origin(words, dynamic, int(path.stat().st_mtime))
        self._origins[task.name, tree.name.lower()] = origin
        return str(tree.name)

    def unload(self, task: "Task", words: str, *, save: bool = False) -> None:
        """Remove what the same words have loaded; ERR_UNLOAD when there is none, or it runs."""
        for (owner, module), origin in self._origins.items():
            if owner == task.name and _same(origin.path, words):
                if any(place.module.lower() == module for place in task.stack()):
                    raise RapidError("ERR_UNLOAD", f"{module} is being executed")
                if save:
                    self.save(task, module, words)
                task.program.unload(module)
                del self._origins[owner, module]
                return
        raise RapidError("ERR_UNLOAD", words)

    def erase(self, task: "Task", module: str) -> None:
        """Remove a module by its name; ERR_MODULE when there is none, or it is being executed."""
        running = any(place.module.lower() == module.lower() for place in task.stack())
        loaded = task.program.modules.get(module.lower())
        if running or loaded is None or loaded.installed:  # not for installed ones [manual]
            raise RapidError("ERR_MODULE", module)
        task.program.unload(module)
        self._origins.pop((task.name, module.lower()), None)

    def save(self, task: "Task", module: str, words: str) -> None:
        """Write a module to a file, with the current values of its persistents."""
        loaded = task.program.modules.get(module.lower())
        if loaded is None or loaded.installed:
            raise RapidError("ERR_MODULE", module)
        if not words:
            origin = self.origin(task, module)
            if origin is None:
                raise RapidError("ERR_PATH", "only a loaded module knows its file")
            words = origin.path
        data = module_text(task, loaded).encode(loaded.tree.source.encoding, "replace")
        spend(task, len(data))
        try:
            file_path(task, words).write_bytes(data)
        except OSError as error:
            raise RapidError("ERR_IOERROR", f"{words}: {error.strerror}") from error

    def drop_dynamic(self, task: "Task") -> None:
        """PP to main: modules that were loaded with \\Dynamic go."""
        for (owner, module), origin in tuple(self._origins.items()):
            if owner == task.name and origin.dynamic:
                task.program.unload(module)
                del self._origins[owner, module]

    def time(self, task: "Task", module: str) -> int:
        """Seconds since 1970 of a module's file; ERR_MOD_NOTLOADED when it is not loaded."""
        if module.lower() not in task.program.modules:
            raise RapidError("ERR_MOD_NOTLOADED", module)
        origin = self.origin(task, module)
        if origin is not None:
            return origin.seconds
        return int(date_time(task.scheduler).timestamp() - task.scheduler.now // 1_000_000_000)


def words_of(path: str, file: str | None) -> str:
    """The text that names a file: FilePath and \\File in one."""
    if not file:
        return path
    return path + file if path.endswith(("/", ":")) else f"{path}/{file}"


def _found(task: "Task", words: str) -> Path:
    path = file_path(task, words)
    if not path.is_file():
        raise RapidError("ERR_FILNOTFND", words)
    return path


def _same(one: str, other: str) -> bool:
    return one.replace("\\", "/").lower() == other.replace("\\", "/").lower()


def module_text(task: "Task", module: LoadedModule) -> str:
    """Source of a module in which every PERS has its present value [K §2.18, 2.23]."""
    source = module.tree.source
    changes: list[tuple[int, int, str]] = []
    for key, declaration in module.declarations.items():
        if declaration.kind != "PERS" or declaration.initial is None:
            continue
        data = task.program.find_data(module, key)
        cell = task.program.space.get(data.code) if data is not None else None
        if isinstance(cell, PersistentCell):
            start = source.starts[declaration.initial.first]
            last = declaration.initial.last
            end = source.starts[last] + len(source.tokens[last])
            changes.append((start, end, literal_text(cell.v, cell.type)))
    text = source.text
    for start, end, value in sorted(changes, reverse=True):
        text = text[:start] + value + text[end:]
    return text
