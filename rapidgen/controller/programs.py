"""Modules of a controller's tasks from outside, and backups."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from rapidgen._reading import TooLarge, read_foreign
from rapidgen.controller.controller import VirtualController
from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.machine.files import copy_files
from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.syntax.lexer import decode
from rapidgen.runtime.compiler.program import missing_routines
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine
from rapidgen.runtime.loading import LARGEST_MODULE, module_text
from rapidgen.runtime.task.task import Task
from rapidgen.system.cfg import cfg_bytes
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import ModuleFile

# -- Programs --------------------------------------------------------------------------------------
#
# Modules are loaded, unloaded and saved; faults are reported on request.
#
# A module that cannot be linked is in its task nevertheless, and its errors are reported there. A
# controller answers a load with success and reports the faults on request [VC 7.21].


SYSTEM_ENDINGS = (".sys", ".sysx")


class CannotLoad(Exception):
    """A module cannot be loaded or unloaded.

    The text is a name of `wire.rws.codes`.
    """


@dataclass(slots=True)
class UnlinkedModule:
    """A module in a task that is not linked."""

    file: ModuleFile
    faults: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True)
class ModuleState:
    """A module of a task.

    `is_system`: it stays when a program is removed.
    """

    name: str
    file: ModuleFile
    is_system: bool
    faults: tuple[Diagnostic, ...] = field(default=())


class Programs:
    """The modules in the tasks of one controller."""

    def __init__(self, controller: VirtualController) -> None:
        self._controller = controller
        self.broken: dict[str, dict[str, UnlinkedModule]] = {
            name: {} for name in controller.rapid_tasks
        }
        """By task, by lower-case name."""
        self.changes = dict.fromkeys(controller.rapid_tasks, 0)
        """How often modules of a task were put in or taken out."""
        self.changed = WaitSet()
        """Notified then."""

    @property
    def is_stopped(self) -> bool:
        """True if no task executes, background tasks included [real 7.21]."""
        return all(t.state != "running" for t in self._controller.rapid_tasks.values())

    def modules(self, task: Task) -> list[ModuleState]:
        """Return the modules of a task in loading order."""
        linked = [
            ModuleState(module.name, module.file, _is_system(module))
            for module in task.program.modules.values()
        ]
        return linked + [
            ModuleState(b.file.name, b.file, _named_system(b.file), b.faults)
            for b in self.broken[task.name].values()
        ]

    def text(self, task: Task, name: str) -> str | None:
        """Return the source of a module, None for an unknown one.

        Initial values are as written [VC 7.21].
        """
        module = task.program.modules.get(name.lower())
        if module is not None:
            return module.tree.source.text
        broken = self.broken[task.name].get(name.lower())
        return None if broken is None else decode(broken.file.data)[0]

    def load(self, task: Task, path: Path, words: str, *, replaced: bool) -> str:
        """Load a module file into a task; return its name. CannotLoad."""
        if not self.is_stopped:
            raise CannotLoad("E_EXEC_STATE")
        try:
            data = read_foreign(path, LARGEST_MODULE)
        except TooLarge as error:
            raise CannotLoad("E_TOO_BIG_MODULE") from error
        except OSError as error:
            raise CannotLoad("E_FILE_NOT_FOUND") from error
        return self.put(task, ModuleFile(path.stem, words, data), replaced=replaced)

    def put(self, task: Task, module: ModuleFile, *, replaced: bool) -> str:
        """Put a module into a task; return its declared name. CannotLoad."""
        if not self.is_stopped:
            raise CannotLoad("E_EXEC_STATE")
        words, data = module.path, module.data
        if len(data) > LARGEST_MODULE:
            raise CannotLoad("E_TOO_BIG_MODULE")
        tree = self._controller.parse_module(module)
        name = tree.name or module.name
        file = ModuleFile(name, words, data)
        wrong = tuple(d for d in tree.diagnostics if d.severity is Severity.ERROR)
        current = self.broken[task.name]
        if name.lower() in task.program.modules or name.lower() in current:
            if not replaced:
                raise CannotLoad("E_MOD_AMBNAME")
            self.unload(task, name)
        if not wrong and tree.name:
            known = len(task.program.faults)
            task.program.load([(tree, file)])
            wrong = tuple(task.program.faults[known:])
            del task.program.faults[known:]
            if wrong:
                self._take_out(task, name)
                current[name.lower()] = UnlinkedModule(file, wrong)
            self.put_clashes_aside(task)
        elif wrong:
            current[name.lower()] = UnlinkedModule(file, wrong)
        self._find_entry(task)
        self._count(task)
        return name

    def unload(self, task: Task, name: str) -> None:
        """Remove a module from a task. CannotLoad."""
        if not self.is_stopped:
            raise CannotLoad("E_EXEC_STATE")
        self._count(task)
        if self.broken[task.name].pop(name.lower(), None) is not None:
            return
        module = task.program.modules.get(name.lower())
        if module is None:
            raise CannotLoad("E_NO_SUCH_SYMBOL")
        if module.installed:
            raise CannotLoad("E_MOD_WRITE_PROTECTED")
        if any(place.module.lower() == name.lower() for place in task.stack()):
            raise CannotLoad("E_EXEC_STATE")
        self._take_out(task, name)
        self._find_entry(task)

    def _count(self, task: Task) -> None:
        self.changes[task.name] += 1
        self.changed.notify()

    def _take_out(self, task: Task, name: str) -> None:
        """Unlink a module.

        A persistent without another declaration loses its value.
        """
        gone = {
            key
            for key, node in task.program.modules[name.lower()].declarations.items()
            if node.kind == "PERS" and not node.scope
        }
        task.program.unload(name)
        programs = [other.program for other in self._controller.rapid_tasks.values()]
        left = {key for p in programs for m in p.modules.values() for key in m.declarations}
        for key in gone - left:
            self._controller.shared.cells.pop(key, None)

    def put_clashes_aside(self, task: Task) -> None:
        """Unlink modules with duplicate declarations, such as a second `main`."""
        clashes = task.program.names.clashes
        for _, second in clashes:
            if second.module is None or second.module.tree.name.lower() not in task.program.modules:
                continue
            module = task.program.modules[second.module.tree.name.lower()]
            at = module.span(second.node) if second.node is not None else None
            fault = error("RG401", at, f"Global routine name {second.name} ambiguous")
            self._take_out(task, module.name)
            self.broken[task.name][module.name.lower()] = UnlinkedModule(module.file, (fault,))
        clashes.clear()

    def faults(self, task: Task) -> list[Diagnostic]:
        """Return faults of a task: broken modules and undeclared names."""
        broken = [d for b in self.broken[task.name].values() for d in b.faults]
        missing = missing_routines(task.program)
        return broken + [d for d in missing if d.severity is Severity.ERROR]

    def _find_entry(self, task: Task) -> None:
        """Set the entry routine of a task; without it the task is empty."""
        entry = task.program.find_routine(None, task.spec.entry.lower())
        result = isinstance(entry, Routine) and entry.kind == "PROC" and not entry.parameters
        if not result:
            task.state = "empty"
        elif task.state == "empty":
            task.state = "ready"

    def kept(self) -> Mapping[str, tuple[ModuleFile, ...]]:
        """Return the modules of each task for a restart.

        They contain the present values of persistents.
        """
        return {
            task.name: (
                *(_as_it_is(task, module) for module in task.program.modules.values()),
                *(b.file for b in self.broken[task.name].values()),
            )
            for task in self._controller.rapid_tasks.values()
        }


def _is_system(module: LoadedModule) -> bool:
    named = {attribute.upper() for attribute in module.tree.attributes}
    return "SYSMODULE" in named or _named_system(module.file)


def _named_system(file: ModuleFile) -> bool:
    return file.path.lower().endswith(SYSTEM_ENDINGS)


def _as_it_is(task: Task, module: LoadedModule) -> ModuleFile:
    if module.installed or module.file.shared:
        return module.file
    text = module_text(task, module)
    if text == module.tree.source.text:
        return module.file
    return replace(module.file, data=text.encode(module.tree.source.encoding, "replace"))


# -- Backups ---------------------------------------------------------------------------------------
#
# A backup of a controller, as `rapidgen sim` and RobotStudio read one.


_INFO = ">>VERSION OF ROBOTWARE\nRobotWare {0}.{1:02}\n"


def back_up(
    controller: VirtualController, programs: Programs, cfg: ControllerCfg, folder: Path
) -> None:
    """Write BACKINFO, HOME, RAPID and SYSPAR into a new folder.

    Persistents have their present values. OSError: the folder exists, or cannot be written.
    """
    folder.mkdir()
    for part in ("BACKINFO", "RAPID", "SYSPAR"):
        (folder / part).mkdir()
    home = controller.files.path("HOME:")
    copy_files(home, folder / "HOME", without=folder)
    lines = [_INFO.format(*controller.system.robotware)]
    for number, task in enumerate(controller.rapid_tasks.values(), 1):
        lines.append(f">>TASK{number}: ({task.name},,)\n")
        for module in programs.modules(task):
            loaded = task.program.modules.get(module.name.lower())
            data = module.file.data
            if loaded is not None and not (loaded.installed or module.file.shared):
                text = module_text(task, loaded)
                data = text.encode(loaded.tree.source.encoding, "replace")
            kind, ending = ("SYSMOD", "sys") if module.is_system else ("PROGMOD", "mod")
            if module.file.path.lower().endswith(SYSTEM_ENDINGS):
                ending = "sys"
            place = folder / "RAPID" / f"TASK{number}" / kind
            place.mkdir(parents=True, exist_ok=True)
            (place / f"{module.name}.{ending}").write_bytes(data)
    (folder / "BACKINFO" / "backinfo.txt").write_text("".join(lines), encoding="ascii")
    for domain in cfg.domains:
        path = folder / "SYSPAR" / f"{domain.domain}.cfg"
        path.write_bytes(cfg_bytes(domain))
