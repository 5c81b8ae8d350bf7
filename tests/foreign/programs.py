"""The RAPID programs of a folder: its ABB backups, and every main with the modules beside it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rapidgen.system import is_backup, read_files, read_system
from rapidgen.system.model import System

_MAIN = re.compile(rb"^[^!\"\n]*\bPROC\s+main\s*\(", re.I | re.M)
_MODULE = re.compile(rb"^\s*MODULE\s+\w+", re.I | re.M)
_SUFFIXES = {".mod", ".modx", ".sys", ".sysx", ".prg"}


@dataclass(frozen=True)
class Program:
    """A backup's folder, or a module with main and the modules without one beside and below."""

    name: str
    files: tuple[Path, ...]

    def read(self) -> System:
        """DiagnosticError when it cannot be read."""
        if self.files[0].is_dir():
            return read_system(self.files[0])
        return read_files(self.files, name=self.name)


def programs(folder: Path) -> Iterator[Program]:
    """What can be started in a folder."""
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
    for main in mains:
        parts = [p for p in modules if p not in mains and _belongs(p, main.parent)]
        yield Program(str(main.relative_to(folder)), (main, *parts))


def _belongs(path: Path, folder: Path) -> bool:
    """Beside main or below; PROGMOD and SYSMOD belong together."""
    if folder.name.upper() == "PROGMOD":
        folder = folder.parent
    return folder in path.parents
