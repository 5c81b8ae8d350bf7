"""The state of an editor's session: documents, programs, trees, scopes, findings.

A `Workspace` has the documents that are open, and a `LoadedProgram` for each program that one of
them belongs to. All features are pure functions of a `View`: one module in one task.

Costs. An edit replaces one tree and one scope in each task of its file (`TaskCheck.replace`); a
module of 2,000 lines costs about 15 ms of parsing and 30 ms of checking. Findings of other modules
of the task may change, too; they are computed again in slices of one module (`Workspace.work`), so
that the server answers requests in between. References first look into the set of words of each
module, so that only modules that have the name are bound.

All functions run in one thread.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error
from rapidgen.editor import configuration
from rapidgen.editor.configuration import kind_of
from rapidgen.editor.documents import (
    Document,
    Lines,
    decode_file,
    is_file,
    probable_encoding,
    real_path,
)
from rapidgen.editor.project import Program, Settings, discover, is_module
from rapidgen.rapid import parse
from rapidgen.rapid.binding import BoundModule, ModuleScope
from rapidgen.rapid.checks import TaskCheck, tasks_of
from rapidgen.rapid.checks.task import encoding_findings
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.syntax.lexer import decode
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.rapid.syntax.source import Source
from rapidgen.system.paths import read_limited

LARGE: Final = 1_000_000
"""Characters of a module above which only its syntax is checked."""
TOO_LARGE: Final = 2_000_000
"""Characters of a module that is not analysed: its parse would delay each answer by a second."""
MANY: Final = 550_000
"""Tokens of a module of which only syntax errors are known: its names would take a second, too."""


@dataclass(slots=True, eq=False)
class LoadedTask:
    """A task, or a group of modules, with its checker."""

    name: str
    """Empty for a group."""
    check: TaskCheck
    modules: dict[str, ModuleScope] = field(default_factory=dict)
    """By real path."""
    bound: dict[ModuleScope, BoundModule] = field(default_factory=dict)
    _whole: list[Diagnostic] | None = None

    def findings(self) -> list[Diagnostic]:
        """Return the findings of the task as a whole, until the next edit."""
        if self._whole is None:
            self._whole = self.check.task_findings()
        return self._whole

    def replace(self, real: str, tree: Module) -> None:
        """Put an edited module into its place."""
        self.modules[real] = self.check.replace(self.modules[real], tree)
        self.bound.clear()
        self._whole = None

    def names_of(self, module: ModuleScope) -> BoundModule:
        """Return a module with its names, until the next edit of the task."""
        result = self.bound.get(module)
        if result is None:
            result = self.bound[module] = BoundModule(module)
        return result


@dataclass(slots=True, eq=False)
class View:
    """One module in one task, as a feature sees it."""

    workspace: "Workspace"
    program: "LoadedProgram"
    task: LoadedTask
    module: ModuleScope

    @property
    def source(self) -> Source:
        """Text and tokens of the module."""
        return self.module.tree.source

    @property
    def names(self) -> BoundModule:
        """The module with its names."""
        return self.task.names_of(self.module)


@dataclass(slots=True, eq=False)
class LoadedProgram:
    """A program with its tasks; modules are added by `load`."""

    program: Program
    tasks: list[LoadedTask] = field(default_factory=list)
    words: dict[str, frozenset[str]] = field(default_factory=dict)
    """Lower-case words of each module, by real path."""
    faults: dict[str, list[Diagnostic]] = field(default_factory=dict)
    """Files that cannot be read, by real path."""
    is_complete: bool = False
    stale: dict[str, None] = field(default_factory=dict)
    """Real paths whose findings are to be computed again, in order."""
    findings: dict[str, list[Diagnostic]] = field(default_factory=dict)
    """By real path; those of `stale` paths are of an earlier edit."""
    _loading: Iterator[tuple[int, int]] | None = None

    def load(self, workspace: "Workspace") -> Iterator[tuple[int, int]]:
        """Add one module after the other; yields how many of how many are there."""
        program = self.program
        tasks: list[tuple[TaskCheck, str, list[tuple[str, bytes | None, bool]]]] = []
        if program.system is not None:
            checks = tasks_of(
                program.system,
                program.dialect,
                program.gaps,
                program.payloads,
                strict=program.strict,
                configured=program.configured,
            )
            for spec, check in checks:
                files: list[tuple[str, bytes | None, bool]] = [
                    (f.path, f.data, f.installed or f.shared) for f in spec.modules
                ]
                tasks.append((check, spec.name, files))
        else:
            payload = program.payloads.get("")
            check = TaskCheck(
                program.dialect, configured=False, strict=program.strict, payload=payload
            )
            tasks.append((check, "", [(path, None, False) for path in program.files]))
        total = sum(len(files) for _, _, files in tasks)
        done = 0
        for check, name, files in tasks:
            task = LoadedTask(name, check)
            self.tasks.append(task)
            for path, data, installed in files:
                real = real_path(path)
                tree = workspace.tree(self, real, path, data)
                done += 1
                if tree is not None:
                    task.modules[real] = check.add(tree, installed=installed)
                    self.words[real] = frozenset(map(str.lower, tree.source.tokens))
                    self.stale[real] = None
                yield done, total
        self.is_complete = True

    def views(self, workspace: "Workspace", path: str) -> list[View]:
        """Return a file's module in each task that has it."""
        real = real_path(path)
        return [
            View(workspace, self, task, task.modules[real])
            for task in self.tasks
            if real in task.modules
        ]

    def all_views(self, workspace: "Workspace", word: str = "") -> Iterator[View]:
        """Iterate over all modules of all tasks; with `word` over those that have it."""
        for task in self.tasks:
            for path, module in task.modules.items():
                if not word or word in self.words[path]:
                    yield View(workspace, self, task, module)


@dataclass(slots=True, eq=False)
class Workspace:
    """Documents and programs of a session."""

    folders: tuple[str, ...] = ()
    settings: Settings = field(default_factory=Settings)
    documents: dict[str, Document] = field(default_factory=dict)
    """By real path."""
    programs: list[LoadedProgram] = field(default_factory=list)
    _trees: dict[str, tuple[object, Module]] = field(default_factory=dict)
    """The last tree of each path, with the text or bytes that it was made of."""
    _others: dict[str, None] = field(default_factory=dict)
    """Real paths of open YAML and cfg documents whose findings are to be computed."""
    _changed: dict[str, None] = field(default_factory=dict)
    """Real paths whose tree is older than the text."""

    # -- documents -----------------------------------------------------------------------

    def open(self, document: Document) -> None:
        """Add a document that the client has opened."""
        real = real_path(document.path)
        self.documents[real] = document
        if is_module(document.path) or document.language == "rapid":
            if self._program_of(real) is None:
                self._start(document.path)
            self._touch(real)
        elif kind_of(document.path, document.language):
            self._others[real] = None

    def document(self, path: str) -> Document | None:
        """Return an open document."""
        return self.documents.get(real_path(path))

    def has_module(self, path: str) -> bool:
        """Return True if a program has a file."""
        return self._program_of(real_path(path)) is not None

    def edited(self, path: str) -> None:
        """Note that the text of an open document has changed."""
        real = real_path(path)
        document = self.documents.get(real)
        if document is not None and self._program_of(real) is None:
            self._others[real] = None
        self._touch(real)

    def close(self, path: str) -> None:
        """Remove a document: its file counts again. Programs without documents are dropped."""
        real = real_path(path)
        self.documents.pop(real, None)
        self._touch(real)
        self.programs = [p for p in self.programs if p.program.paths & self.documents.keys()]
        known: frozenset[str] = frozenset().union(*(p.program.paths for p in self.programs))
        for old in [old for old in self._trees if old not in known]:
            del self._trees[old]

    def reload(self) -> None:
        """Discover all programs again: files came, went or changed, or the settings did."""
        self.programs.clear()
        self._trees.clear()
        self._changed.clear()
        for document in list(self.documents.values()):
            self.open(document)

    def saved(self, path: str) -> None:
        """Note that the client has written an open document: its encoding may be another one."""
        real = real_path(path)
        for program in self.programs:
            if real in program.words:
                program.stale[real] = None

    def file_changed(self, path: str) -> None:
        """Note that another program has written a module that is not open."""
        real = real_path(path)
        if real not in self.documents:
            self._touch(real)

    def _touch(self, real: str) -> None:
        self._changed[real] = None

    # -- programs ------------------------------------------------------------------------

    def _program_of(self, real: str) -> LoadedProgram | None:
        for program in self.programs:
            if real in program.program.paths:
                return program
        return None

    def _start(self, path: str) -> LoadedProgram:
        program = LoadedProgram(discover(path, self.folders, self.settings))
        if real_path(path) not in program.program.paths:
            program = LoadedProgram(Program("file", path, (path,)))
        program._loading = program.load(self)
        self.programs.append(program)
        return program

    def program_of(self, path: str) -> LoadedProgram | None:
        """Return the program of a file, complete and with all edits; None: not open."""
        program = self._program_of(real_path(path))
        if program is not None:
            self._finish(program)
        return program

    def views(self, path: str) -> list[View]:
        """Return the module of a file in each of its tasks, with all edits."""
        program = self.program_of(path)
        return program.views(self, path) if program is not None else []

    def loaded(self) -> list[LoadedProgram]:
        """Return all programs, complete and with all edits."""
        for program in self.programs:
            self._finish(program)
        return self.programs

    def _finish(self, program: LoadedProgram) -> None:
        if program._loading is not None:
            for _ in program._loading:
                pass
            program._loading = None
        self._apply()

    def _apply(self) -> None:
        """Replace the trees of files whose text has changed."""
        for real in list(self._changed):
            program = self._program_of(real)
            if program is not None and program._loading is not None:
                continue
            del self._changed[real]
            if program is None:
                continue
            for task in program.tasks:
                module = task.modules.get(real)
                if module is None:
                    continue
                path = module.tree.source.path
                tree = self.tree(program, real, path, None)
                if tree is None or tree is module.tree:
                    continue
                task.replace(real, tree)
                program.words[real] = frozenset(map(str.lower, tree.source.tokens))
                # The edited module comes first, then the others, which may depend on it.
                others = [other for other in program.words if other != real]
                program.stale = dict.fromkeys((real, *program.stale, *others))

    def text_of(self, path: str) -> str | None:
        """Return the text of a file: the client's, else the file's; None: unreadable."""
        document = self.documents.get(real_path(path))
        if document is not None:
            return document.text
        try:
            return decode_file(read_limited(Path(path)), self.settings.encoding)
        except (DiagnosticError, OSError):
            return None

    def lines_of(self, path: str) -> Lines:
        """Return the lines of a file, for positions; empty if it is unreadable."""
        real = real_path(path)
        document = self.documents.get(real)
        if document is not None:
            return document.lines
        known = self._trees.get(real)
        if known is not None:
            return Lines(known[1].source.text, known[1].source.lines)
        return Lines(self.text_of(path) or "")

    def tree(
        self, program: LoadedProgram, real: str, path: str, data: bytes | None
    ) -> Module | None:
        """Return the tree of a file's present text; None if it cannot be read."""
        document = self.documents.get(real)
        content: str | bytes
        if document is not None:
            content = document.text
        elif data is not None:
            content = data
        else:
            try:
                content = read_limited(Path(path))
            except DiagnosticError as fault:
                at = Span(path, 1, 1)
                self_findings = [error(d.code, at, d.message, d.help) for d in fault.diagnostics]
                program.faults[real] = self_findings
                return None
        program.faults.pop(real, None)
        known = self._trees.get(real)
        if known is not None and known[0] == content and known[1].source.path == path:
            return known[1]
        text = content if isinstance(content, str) else self._decoded(content)
        if len(text) > TOO_LARGE:
            what = f"{TOO_LARGE:,} characters"
            tree = Module(0, 0, "", (), [], Source("", path, "utf-8"), [_too_large(path, what)])
            self._trees[real] = (content, tree)
            return tree
        tree = parse(text, path=path, dialect=program.program.dialect)
        if len(tree.source.tokens) > MANY:
            found = [*tree.diagnostics, _too_large(path, f"{MANY:,} words and signs")]
            tree = Module(0, 0, "", (), [], Source("", path, "utf-8"), found)
        self._trees[real] = (content, tree)
        return tree

    def _decoded(self, data: bytes) -> str | bytes:
        """Return the text of a file that is not open; bytes where the parser decodes them."""
        if self.settings.encoding == "auto" or b"\0" in data[:4096]:
            return data
        return decode_file(data, self.settings.encoding)

    # -- findings ------------------------------------------------------------------------

    def findings_of(self, path: str) -> list[Diagnostic]:
        """Return the findings of a file, with all edits."""
        program = self.program_of(path)
        real = real_path(path)
        if program is None:
            document = self.documents.get(real)
            return self._other_findings(document) if document is not None else []
        if real in program.stale or real not in program.findings:
            self._compute(program, real)
        return program.findings.get(real, [])

    def work(self) -> Iterator[tuple[str, list[Diagnostic]]]:
        """Compute findings that are not up to date, one file a step.

        Yields the path and the findings of each file. An edit between two steps makes the rest of
        an iteration useless: begin a new one.
        """
        self._apply()
        for real in list(self._others):
            self._others.pop(real, None)
            document = self.documents.get(real)
            if document is not None:
                yield document.path, self._other_findings(document)
        for program in self.programs:
            if program._loading is not None:
                self._finish(program)
            # Open documents come first: the others are not on the screen.
            order = sorted(program.stale, key=lambda real: real not in self.documents)
            for real in order:
                if real in program.stale:
                    self._compute(program, real)
                yield self.path_in(program, real), program.findings.get(real, [])
            for real, faults in program.faults.items():
                yield self.path_in(program, real), faults

    def load_step(self) -> tuple[str, int, int] | None:
        """Load one more module; return the program's root, the modules done and their number."""
        for program in self.programs:
            if program._loading is not None:
                step = next(program._loading, None)
                if step is None:
                    program._loading = None
                    continue
                return (program.program.root, *step)
        return None

    def is_idle(self) -> bool:
        """Return True if nothing is to be computed."""
        return (
            not self._changed
            and not self._others
            and all(p._loading is None and not p.stale for p in self.programs)
        )

    def _other_findings(self, document: Document) -> list[Diagnostic]:
        """Return the findings of a YAML or cfg document."""
        kind = kind_of(document.path, document.language)
        return configuration.findings(document.path, document.text, kind)

    def path_in(self, program: LoadedProgram, real: str) -> str:
        """Return the name under which a program has a file."""
        document = self.documents.get(real)
        if document is not None:
            return document.path
        for task in program.tasks:
            if real in task.modules:
                return task.modules[real].tree.source.path
        return real

    def _compute(self, program: LoadedProgram, real: str) -> None:
        program.stale.pop(real, None)
        views = program.views(self, real)
        by_task: list[tuple[str, list[Diagnostic]]] = []
        for view in views:
            if len(view.source.text) > LARGE:
                by_task.append((view.task.name, list(view.module.tree.diagnostics)))
                continue
            own = view.task.check.module_findings(view.module)
            path = view.source.path
            own += [d for d in view.task.findings() if d.span is not None and d.span.path == path]
            by_task.append((view.task.name, own))
        found = merge_tasks(by_task)
        notes = [d for d in program.program.notes if d.span and real_path(d.span.path) == real]
        document = self.documents.get(real)
        if document is not None:
            notes += _wrong_encoding(document)
            notes += _file_encoding(document, program.program.dialect)
        ignored = program.program.ignored
        program.findings[real] = [d for d in (*notes, *found) if d.code not in ignored]


def _wrong_encoding(document: Document) -> list[Diagnostic]:
    """Report a document that the editor has read in another encoding than that of its file.

    Its letters are lost: the editor shows U+FFFD for each, and would save that.
    """
    at = document.text.find("\ufffd")
    if at < 0 or not is_file(document.path):
        return []
    try:
        data = read_limited(Path(document.path))
    except DiagnosticError:
        return []
    if "\ufffd".encode() in data:
        return []
    line, column = document.lines.position(at, "utf-32")
    encoding = {"gbk": "GBK", "cp1252": "Windows-1252"}.get(probable_encoding(data), "UTF-8")
    return [
        error(
            "RG338",
            Span(document.path, line + 1, column + 1),
            "letters of this file are lost: the editor has read it in a wrong encoding",
            f"do not save; reopen it with the encoding {encoding}",
            severity=Severity.WARNING,
        )
    ]


def _file_encoding(document: Document, dialect: Dialect) -> list[Diagnostic]:
    """Report the encoding of an open document's file: its text in the editor has none."""
    if not dialect.is_known or not is_file(document.path):
        return []
    try:
        data = read_limited(Path(document.path))
    except DiagnosticError:
        return []
    return encoding_findings(document.path, decode(data)[1], dialect)


def _too_large(path: str, limit: str) -> Diagnostic:
    return error(
        "RG337",
        Span(path, 1, 1),
        f"the text has more than {limit}: it is not analysed while it is edited",
        "check it with `rapidgen check`, or split the module",
        severity=Severity.INFO,
    )


def merge_tasks(by_task: Sequence[tuple[str, Sequence[Diagnostic]]]) -> list[Diagnostic]:
    """Return the findings of one file in several tasks, each once.

    A finding that not all tasks have tells which ones do.
    """
    if len(by_task) == 1:
        return list(dict.fromkeys(by_task[0][1]))
    tasks: dict[Diagnostic, list[str]] = {}
    for name, found in by_task:
        for diagnostic in dict.fromkeys(found):
            tasks.setdefault(diagnostic, []).append(name)
    result = []
    for d, names in tasks.items():
        if len(names) < len(by_task):
            where = f"in {'task' if len(names) == 1 else 'tasks'} {', '.join(names)}"
            d = replace(d, message=f"{d.message} ({where})")
        result.append(d)
    return sorted(result, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0))
