"""Module files as bytes, with their declared names."""

import os
import re
from pathlib import Path

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error, refusal
from rapidgen.system.cfg_reader import ModuleEntry
from rapidgen.system.model import ModuleFile, TaskSpec
from rapidgen.system.paths import (
    MODULE_SUFFIXES,
    home_file,
    inside,
    module_files,
    read_limited,
)

# The head of a module; text before it (a %%% header, comments) is skipped.
_MODULE = re.compile(rb"^[ \t]*MODULE\s+([A-Za-z\xc0-\xff][\w\xc0-\xff]*)", re.I | re.M)
_PROGRAM = re.compile(rb"<Module>\s*([^<>]{1,260}?)\s*</Module>", re.I)

Origin = tuple[tuple[int, str, int], ...]


def module_name(data: bytes, fallback: str) -> str:
    """Return the name in the module's own text, else `fallback`."""
    match = _MODULE.search(data)
    return match[1].decode("latin-1") if match else fallback


def load_module(
    path: Path,
    *,
    target: str = "",
    origin: Origin = (),
    shared: bool = False,
    installed: bool = False,
) -> ModuleFile:
    """Load one module file.

    Raises RG704 or RG705.
    """
    data = read_limited(path)
    name = module_name(data, path.stem)
    return ModuleFile(name, str(path), data, target, origin, shared, installed)


def expand(path: Path) -> list[Path]:
    """Return the module files of `path`: a file, a folder or a program.

    A folder without modules may have them in SYSMOD and PROGMOD, as a backup keeps a task.

    Raises RG704 (path does not exist) and RG709 (no modules).
    """
    if path.is_dir():
        programs = [p for p in sorted(path.glob("*.pgf")) if not p.name.startswith("._")]
        result = list(module_files(path))
        if not result and not programs:
            shelves = [inside(path, name) for name in ("SYSMOD", "PROGMOD")]
            result = [file for one in shelves if any(module_files(one)) for file in expand(one)]
        if len(programs) == 1:
            # The configuration gives tasks their system modules: a program names none.
            named = expand(programs[0])
            adjacent = (p for p in result if p.suffix.casefold() in (".sys", ".sysx"))
            result = [*named, *(p for p in adjacent if p not in named)]
    elif path.suffix.casefold() == ".pgf":
        named = [name.decode("latin-1") for name in _PROGRAM.findall(read_limited(path))]
        home = path.parent
        result = [home_file(home, f"HOME:{name}") for name in named]
    else:
        return [path]
    if not result:
        help = f"modules end in {', '.join(MODULE_SUFFIXES)}"
        if path.is_dir() and (path.parent / "SYSPAR").is_dir():
            help = f"a backup is loaded whole: name {path.parent}"
        elif not path.is_dir():
            help = "a program lists files of modules: <Module>NAME.mod</Module>"
            if _MODULE.search(read_limited(path)):
                help = f"it is a module itself: call it {path.stem}.mod"
        raise refusal("RG709", None, f"no RAPID module in {path}", help)
    return result


def load_entries(
    task: TaskSpec,
    entries: tuple[ModuleEntry, ...],
    home: Path,
    loaded: tuple[ModuleFile, ...],
    cfg_path: str,
    notes: list[Diagnostic] | None,
    origins: dict[str, Origin] | None = None,
) -> tuple[ModuleFile, ...]:
    """Return `loaded` and the modules that CAB_TASK_MODULES adds.

    A missing file is a warning RG710 when `notes` collects them, else an error; files of options
    (RELEASE:) are skipped then, because no backup contains them. A second file with a module of the
    same name is RG714 in the same way.
    """
    modules = list(loaded)
    known = {module.name.casefold() for module in loaded}
    brought: dict[str, str] = {}
    for entry in entries:
        if not entry.loads_into(task):
            continue
        place = Span(cfg_path, entry.line, 1) if entry.line else None
        outside = not entry.file.strip().upper().startswith("HOME:")
        path = None if outside else home_file(home, entry.file)
        if path is None or not os.path.exists(path):
            stem = entry.file.replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
            if stem.casefold() in known:
                continue
            known_missing = notes is not None and any(
                note.code == "RG710" and note.span == place for note in notes
            )
            if known_missing or (outside and notes is not None):
                continue
            _note(
                notes,
                "RG710",
                place,
                f"module file '{entry.file}' is missing",
                "put the file into HOME, or take its CAB_TASK_MODULES instance out",
            )
            continue
        origin = (origins or {}).get(f"HOME/{path.relative_to(home).as_posix()}", ())
        module = load_module(
            path,
            target=entry.file,
            origin=origin,
            shared=entry.shared,
            installed=entry.installed,
        )
        first = brought.setdefault(module.name.casefold(), entry.file)
        if first.casefold() != entry.file.casefold():
            _note(
                notes,
                "RG714",
                place,
                f"task {task.name} gets module {module.name} from '{entry.file}' and, before it, "
                f"from '{first}': which of two a controller takes is not sure [mem]",
                "take one of the two CAB_TASK_MODULES instances out",
            )
        if module.name.casefold() not in known:
            known.add(module.name.casefold())
            modules.append(module)
    return tuple(modules)


def _note(
    notes: list[Diagnostic] | None, code: str, place: Span | None, message: str, help: str
) -> None:
    """Add a warning to `notes`, or raise an error without them."""
    severity = Severity.ERROR if notes is None else Severity.WARNING
    fault = error(code, place, message, help, severity=severity)
    if notes is None:
        raise DiagnosticError(fault)
    notes.append(fault)
