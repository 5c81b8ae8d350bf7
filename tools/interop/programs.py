"""Find the RAPID programs of a folder: backups, and mains with modules."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rapidgen.controller.cell_setup import apply_cell
from rapidgen.controller.inference.cell import infer_cell
from rapidgen.rapid import parse
from rapidgen.rapid.syntax import nodes as n
from rapidgen.system import is_backup, read_files, read_system, task_folders
from rapidgen.system.model import System

_MAIN = re.compile(rb"^[^!\"\n]*\bPROC\s+main\s*\(", re.I | re.M)
_MODULE = re.compile(rb"^\s*MODULE\s+\w+", re.I | re.M)
_NAMED = n.DataDeclaration | n.RoutineDeclaration | n.RecordDeclaration | n.AliasDeclaration
_SUFFIXES = {".mod", ".modx", ".sys", ".sysx", ".prg"}


@dataclass(frozen=True)
class Program:
    """A backup, a folder with a folder for each task, or a main with modules.

    The modules are those without a main, in the main's folder and below.
    """

    name: str
    files: tuple[Path, ...]

    @property
    def is_backup(self) -> bool:
        """True if it contains its own robot."""
        return self.files[0].is_dir() and is_backup(self.files[0])

    def read(self) -> System:
        """Read the system.

        Raises DiagnosticError.
        """
        if self.is_backup:
            return read_system(self.files[0])
        if self.files[0].is_dir():
            return read_files(task_folders(self.files[0]), name=self.name)
        return read_files(self.files, name=self.name)


def furnished(system: System) -> System:
    """Return a system with the signals, tools and work objects it lacks."""
    return apply_cell(system, infer_cell(system).cell)


def programs(folder: Path) -> Iterator[Program]:
    """Yield the programs of a folder."""
    backups = [p for p in (folder, *sorted(folder.rglob("*"))) if p.is_dir() and is_backup(p)]
    for backup in backups:
        yield Program(str(backup.relative_to(folder)), (backup,))
    modules = [
        path
        for path in sorted(folder.rglob("*"))
        if path.suffix.lower() in _SUFFIXES
        and path.is_file()
        and not any(backup in path.parents for backup in backups)
        and _MODULE.search(path.read_bytes())
    ]
    mains = [path for path in modules if _MAIN.search(path.read_bytes())]
    tasks = {p.parent.parent for p in mains if p.parent.name.upper().startswith("T_")}
    together = {p for p in tasks if len(task_folders(p)) > 1}
    for several in sorted(together):
        yield Program(str(several.relative_to(folder)), (several,))
    for main in mains:
        if main.parent.parent in together:
            continue
        adjacent = [p for p in modules if p not in mains and _belongs_to(p, main.parent)]
        yield Program(str(main.relative_to(folder)), (main, *_needed(main, adjacent)))


def _belongs_to(path: Path, folder: Path) -> bool:
    """True if a file is in main's folder or below.

    PROGMOD and SYSMOD belong together.
    """
    if folder.name.upper() == "PROGMOD":
        folder = folder.parent
    return folder in path.parents


def _needed(main: Path, adjacent: list[Path]) -> Iterator[Path]:
    """Yield the modules that declare missing names of main.

    Also those of other needed modules. Of two that declare the same name the first counts: a folder
    may hold versions and exercises.
    """
    trees = {path: parse(path.read_bytes(), path=str(path)) for path in (main, *adjacent)}
    names = {
        path: {d.name.lower() for d in tree.declarations if isinstance(d, _NAMED)}
        | {tree.name.lower()}
        for path, tree in trees.items()
    }
    words = {path: {t.lower() for t in tree.source.tokens} for path, tree in trees.items()}
    known, expected = set(names[main]), set(words[main])
    left = list(adjacent)
    while True:
        match = next(
            (p for p in left if names[p] & expected - known and not names[p] & known), None
        )
        if match is None:
            return
        left.remove(match)
        known |= names[match]
        expected |= words[match]
        yield match
