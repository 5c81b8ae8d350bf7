"""The project file `rapidgen.toml`: settings of the programs in a folder and below it.

`find_project` looks for it in the folder of a file, then in each folder above. Paths in it are
relative to its folder and may not leave it, because `fmt` writes to them.
"""

import os
import re
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Final, TypeVar

from rapidgen._json import Members
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, suggest
from rapidgen.system.paths import inside, read_limited
from rapidgen.system.releases import ANY_MINOR, release

T = TypeVar("T")
PROJECT_FILE: Final = "rapidgen.toml"
_LARGEST: Final = 256 * 1024
_TASK: Final = re.compile(r"[A-Za-z]\w{0,31}", re.ASCII)
_CODE: Final = re.compile(r"RG\d{3}", re.ASCII)
_PLACE: Final = re.compile(r"\(at line (\d+), column (\d+)\)")


@dataclass(frozen=True, slots=True)
class Project:
    """The settings of a project file; paths are complete."""

    path: Path
    folders: tuple[Path, ...] = ()
    tasks: Mapping[str, tuple[Path, ...]] = field(default_factory=dict)
    cfg: tuple[Path, ...] = ()
    robot: str = ""
    robotware: str = ""
    strict: bool = False
    ignore: frozenset[str] = frozenset()
    places: Mapping[str, Span] = field(default_factory=dict)
    """Place of each key of the file."""

    @property
    def sources(self) -> Mapping[str, tuple[Path, ...]]:
        """Files and folders of each task, the cfg files with the first one."""
        if not self.tasks:
            return {}
        first, *others = self.tasks.items()
        return {first[0]: (*first[1], *self.cfg), **dict(others)}

    def is_reported(self, finding: Diagnostic) -> bool:
        """Return True unless the project ignores the code of a finding."""
        return finding.code not in self.ignore


def find_project(start: Path) -> Project | None:
    """Return the settings for a file or folder: those of the nearest project file.

    None: no project file in the folder or above. Raises DiagnosticError RG730.
    """
    folder = Path(os.path.abspath(start))
    for place in (folder, *folder.parents):
        file = place / PROJECT_FILE
        if os.path.lexists(file):
            return read_project(file if start.is_absolute() else Path(os.path.relpath(file)))
    return None


def read_project(path: Path, content: bytes | None = None) -> Project:
    """Read a project file, or its text in an editor.

    Raises DiagnosticError with all its faults (RG730).
    """
    return _Reader(path, content).project()


def project_schema() -> Members:
    """Return the JSON schema of a project file."""
    properties: Members = {
        name: {**key.schema, "description": key.description, "examples": [key.example]}
        for name, key in _KEYS.items()
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": PROJECT_FILE,
        "type": "object",
        "additionalProperties": False,
        "properties": properties,
    }


class _Reader:
    """Reads one file and collects its faults."""

    def __init__(self, path: Path, content: bytes | None = None) -> None:
        self.path = path
        self.content = content
        self.lines: list[str] = []
        self.faults: list[Diagnostic] = []

    def project(self) -> Project:
        """Return the settings, or raise the faults."""
        data = self._parsed()
        for name in data:
            if name not in _KEYS:
                help = suggest(name, list(_KEYS)) or f"the keys are {', '.join(_KEYS)}"
                self.fault(name, f"unknown key '{name}'", help)

        def value(name: str, read: Callable[[str, object], T], otherwise: T) -> T:
            return read(name, data[name]) if name in data else otherwise

        result = Project(
            self.path,
            folders=value("folders", self.paths, ()),
            tasks=value("tasks", self.tasks, MappingProxyType({})),
            cfg=value("cfg", self.paths, ()),
            robot=value("robot", self.robot, ""),
            robotware=value("robotware", self.robotware, ""),
            strict=value("strict", self.switch, False),
            ignore=value("ignore", self.codes, frozenset()),
            places=MappingProxyType({name: self.place(name) for name in data}),
        )
        if self.faults:
            raise DiagnosticError(self.faults)
        return result

    def _parsed(self) -> dict[str, object]:
        # Most runs have no project file, and need no reader of TOML.
        if sys.version_info >= (3, 11):
            import tomllib
        else:
            import tomli as tomllib

        data = self._bytes() if self.content is None else self.content
        if len(data) > _LARGEST:
            message = f"the file has more than {_LARGEST // 1024} KB"
            raise self._refused(Span(str(self.path), 1, 1), message)
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError as fault:
            line = data.count(b"\n", 0, fault.start) + 1
            raise self._refused(Span(str(self.path), line, 1), "the file is not UTF-8") from fault
        self.lines = text.splitlines()
        try:
            result: dict[str, object] = tomllib.loads(text)
        except RecursionError as fault:
            at = Span(str(self.path), 1, 1)
            raise self._refused(at, "the file is nested too deep") from fault
        except ValueError as fault:
            # Also for a number with too many digits, which is no TOMLDecodeError.
            found = _PLACE.search(str(fault))
            line, column = (int(found[1]), int(found[2])) if found else (len(self.lines) or 1, 1)
            reason = _PLACE.sub("", str(fault)).strip() if found else "a value is out of range"
            at = Span(str(self.path), line, column)
            raise self._refused(at, f"invalid TOML: {reason[:1].lower()}{reason[1:]}") from fault
        return result

    def _bytes(self) -> bytes:
        try:
            return read_limited(self.path, below=self.path.parent)
        except DiagnosticError as fault:
            at = Span(str(self.path), 1, 1)
            raise self._refused(at, fault.diagnostics[0].message) from fault

    def _refused(self, at: Span, message: str) -> DiagnosticError:
        help = f"write key = value; the keys are {', '.join(_KEYS)}"
        return DiagnosticError(error("RG730", at, message, help))

    def fault(self, name: str, message: str, help: str = "") -> None:
        """Add a fault at a key."""
        self.faults.append(error("RG730", self.place(name), message, help))

    def place(self, name: str) -> Span:
        """Return the place of a key; the TOML reader of Python does not report it."""
        key = re.compile(rf"""^[\s\[{{,]*["']?{re.escape(name)}["']?\s*[=.\]]""")
        inner = re.compile(rf"""[{{.,\s]["']?{re.escape(name)}["']?\s*=""")
        for pattern in (key, inner):
            for number, line in enumerate(self.lines, 1):
                if found := pattern.search(line.partition("#")[0]):
                    column = line.index(name, found.start()) + 1
                    return Span(str(self.path), number, column, number, column + len(name))
        return Span(str(self.path), 1, 1)

    def text(self, name: str, value: object) -> str:
        """Read a text."""
        if not isinstance(value, str) or not value or not value.isprintable():
            self.fault(name, f"'{name}' must be a text, such as {_KEYS[name].example}")
            return ""
        return value

    def robot(self, name: str, value: object) -> str:
        """Read a model, or the path of a configuration."""
        text = self.text(name, value)
        if Path(text).suffix.lower() in (".yaml", ".yml"):
            return "".join(map(str, self.paths(name, [text])))
        return text

    def robotware(self, name: str, value: object) -> str:
        """Read a release."""
        text = self.text(name, value)
        if text:
            try:
                _, minor = release(text)
            except DiagnosticError as fault:
                first = fault.diagnostics[0]
                self.fault(name, first.message, first.help)
            else:
                if minor == ANY_MINOR:
                    self.fault(name, f"'{text}' is not a single version", f"such as {text}.6")
        return text

    def switch(self, name: str, value: object) -> bool:
        """Read true or false."""
        if not isinstance(value, bool):
            self.fault(name, f"'{name}' must be true or false")
            return False
        return value

    def texts(self, name: str, value: object) -> list[str]:
        """Read a list of texts."""
        correct = isinstance(value, list) and all(isinstance(one, str) and one for one in value)
        if not correct or not isinstance(value, list):
            example = _KEYS[name].example if name in _KEYS else '["PROGMOD", "data.mod"]'
            self.fault(name, f"'{name}' must be a list of texts, such as {example}")
            return []
        return value

    def codes(self, name: str, value: object) -> frozenset[str]:
        """Read a list of diagnostic codes."""
        from rapidgen.diagnostics.pages import codes

        texts = self.texts(name, value)
        known = codes() if texts else []
        for text in texts:
            if not _CODE.fullmatch(text) or text not in known:
                self.fault(name, f"'{text}' is no diagnostic code", "`rapidgen explain all`")
        return frozenset(texts)

    def paths(self, name: str, value: object) -> tuple[Path, ...]:
        """Read a list of paths that exist in the project's folder."""
        result = []
        for text in self.texts(name, value):
            try:
                path = inside(self.path.parent, text)
            except DiagnosticError as fault:
                first = fault.diagnostics[0]
                help = f"put {PROJECT_FILE} into a folder above all its files"
                self.fault(name, first.message, help)
                continue
            if not os.path.exists(path):
                self.fault(name, f"{path} does not exist")
            result.append(path)
        return tuple(result)

    def tasks(self, name: str, value: object) -> Mapping[str, tuple[Path, ...]]:
        """Read the table of tasks."""
        if not isinstance(value, dict):
            self.fault(name, f"'{name}' must be a table, such as {_KEYS[name].example}")
            return {}
        result = {}
        for task, paths in value.items():
            if not _TASK.fullmatch(task):
                self.fault(task, f"'{task}' is no name of a task")
            elif not paths:
                self.fault(task, f"the task {task} has no file")
            else:
                result[task] = self.paths(task, paths)
        return MappingProxyType(result)


@dataclass(frozen=True, slots=True)
class _Key:
    """A key of the file: its type, description and an example."""

    schema: Members
    description: str
    example: str


_TEXTS: Final[Members] = {"type": "array", "items": {"type": "string", "minLength": 1}}
_KEYS: Final[Mapping[str, _Key]] = {
    "folders": _Key(
        _TEXTS,
        "Folders that `check` and `fmt` read if no path is given; default: the project's folder.",
        '["src"]',
    ),
    "tasks": _Key(
        {"type": "object", "additionalProperties": _TEXTS},
        "Files and folders of each task. `run` and `sim` boot them if no target is given; `check` "
        "checks them together.",
        '{T_ROB1 = ["src"]}',
    ),
    "cfg": _Key(
        _TEXTS,
        "cfg files (SYS.cfg, EIO.cfg) of the tasks: they declare tasks and signals.",
        '["EIO.cfg"]',
    ),
    "robot": _Key(
        {"type": "string", "minLength": 1},
        "Robot of the programs: a shipped model, a known variant or a configuration. Same as "
        "`--robot`.",
        '"irb1200"',
    ),
    "robotware": _Key(
        {"type": "string", "pattern": r"^[5-8]\.\d+$"},
        "RobotWare version of the controller. Same as `--robotware`.",
        '"6.15"',
    ),
    "strict": _Key(
        {"type": "boolean", "default": False},
        "Names that no module declares are errors, also for `run` and `sim`. Same as `--strict`.",
        "true",
    ),
    "ignore": _Key(
        {"type": "array", "items": {"type": "string", "pattern": r"^RG\d{3}$"}},
        "Codes of findings that `check`, `run` and `sim` do not report.",
        '["RG324"]',
    ),
}
