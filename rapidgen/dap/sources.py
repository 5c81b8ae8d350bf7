"""Sources of a session: files of the client, modules of the tasks, and back.

A module of a loose file, a folder or a backup has the path that it was read from. A module that is
generated in memory or was loaded from a disk of the virtual controller has none: the client's file
is used if the client named one with the same text, otherwise the client requests the text by a
number.
"""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from rapidgen._json import Members
from rapidgen._reading import read_foreign
from rapidgen.dap.client import RequestRefused
from rapidgen.rapid.syntax.lexer import decode
from rapidgen.runtime.compiler.symbols import LoadedModule
from rapidgen.runtime.loading import LARGEST_MODULE
from rapidgen.runtime.task.task import Task
from rapidgen.system.loading import module_name


def same_path(path: str) -> str:
    """Return a path in the form in which two names of one file are equal."""
    return os.path.normcase(os.path.realpath(path))


class Sources:
    """Modules of all tasks as sources of a client."""

    def __init__(self, tasks: Mapping[str, Task]) -> None:
        self._tasks = tasks
        self._texts: list[str] = []
        """By reference, from 1."""
        self._named: dict[str, str] = {}
        """Paths that the client used, by lower-case module name."""

    def modules(self) -> Iterator[tuple[str, LoadedModule]]:
        """Return tasks and their modules, without those of options."""
        for name, task in self._tasks.items():
            yield from ((name, m) for m in task.program.modules.values() if not m.installed)

    def of(self, module: LoadedModule) -> Members:
        """Return the source of a module for the client."""
        path = module.file.path
        name = Path(path.replace("\\", "/")).name or module.name
        if os.path.isabs(path) and os.path.isfile(path):
            return {"name": name, "path": path}
        named = self._named.get(module.name.lower(), "")
        if named and _text(named) == module.tree.source.text:
            return {"name": Path(named).name, "path": named}
        return {
            "name": name,
            "sourceReference": self._reference(module.tree.source.text),
            "origin": "in the memory of the virtual controller",
        }

    def _reference(self, text: str) -> int:
        if text not in self._texts:
            self._texts.append(text)
        return self._texts.index(text) + 1

    def text(self, source: Members, reference: int) -> str:
        """Return the text of a source. RequestRefused: unknown."""
        number = source.get("sourceReference") or reference
        if isinstance(number, int) and 0 < number <= len(self._texts):
            return self._texts[number - 1]
        path = source.get("path")
        for _, module in self.modules():
            if isinstance(path, str) and same_path(module.file.path) == same_path(path):
                return module.tree.source.text
        raise RequestRefused("no loaded module has this source")

    def find(self, source: Members) -> "FoundModule":
        """Return the module of a client's source, loaded or not. RequestRefused: unknown."""
        number, path = source.get("sourceReference"), source.get("path")
        loaded = tuple(self.modules())
        if isinstance(number, int) and number:
            text = self.text(source, number)
            found = tuple((t, m) for t, m in loaded if m.tree.source.text == text)
            if found:
                return FoundModule(f"\0{number}", found[0][1].name, found, "")
            raise RequestRefused("no task has this module any more")
        if not isinstance(path, str) or "\0" in path:
            raise RequestRefused("a source has a path or a reference")
        key = same_path(path)
        found = tuple((t, m) for t, m in loaded if same_path(m.file.path) == key)
        if found:
            return FoundModule(key, found[0][1].name, found, "")
        written = _text(path)
        name = (
            Path(path).stem
            if written is None
            else module_name(written.encode("latin-1", "replace"), Path(path).stem)
        )
        self._named[name.lower()] = path
        found = tuple((t, m) for t, m in loaded if m.name.lower() == name.lower())
        equal = all(m.tree.source.text == written for _, m in found)
        return FoundModule(
            key, name, found, "" if equal else f"the loaded module {name} differs from this file"
        )


class FoundModule:
    """The module of a source: its key, name, the tasks that have it, and a doubt."""

    __slots__ = ("doubt", "key", "loaded", "name")

    def __init__(
        self, key: str, name: str, loaded: tuple[tuple[str, LoadedModule], ...], doubt: str
    ) -> None:
        self.key = key
        self.name = name
        self.loaded = loaded
        self.doubt = doubt


def _text(path: str) -> str | None:
    try:
        return decode(read_foreign(Path(path), LARGEST_MODULE))[0]
    except OSError:
        return None
