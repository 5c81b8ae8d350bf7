"""Find a mutant of the runtime that fails each conformance program.

See tools/conformance_mutants_runtime.py. Mutants are made as those of the front end
(tools/mutation/front_end.py).
Each trial is a process of its own, so that a mutant cannot harm the next trial.
"""

import os
import signal
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import rapidgen
from rapidgen.machine.process import Process
from tests.rapid_programs import Program
from tests.runtime.test_conformance import HERE, PROGRAMS, test_program_matches_its_source
from tools.mutation.front_end import Mutant, NoProgram, of_functions

PACKAGES = ("machine", "motion", "runtime", "controller")
ROOTS = [Path(rapidgen.__file__).parent / package for package in PACKAGES]
BROAD = 50
"""Per cent of all files that a mutant may fail, for a file without a narrower one."""
SECONDS = 1.0
"""CPU time after which a mutant hangs; a file takes some hundredths."""
LARGEST_TRIAL = 400
"""Mutants of rare lines that are tried for one file before its commonest lines."""
PASSED, FAILED, BROKEN = 0, 1, 2

Place = tuple[str, int]


@dataclass(frozen=True)
class File:
    """A conformance program and its check (AssertionError: failed)."""

    program: Program
    judge: Callable[[Program], None]

    def __str__(self) -> str:
        return self.program.below(HERE)


def all_files() -> list[File]:
    """Return every conformance program of the runtime."""
    return [File(program, test_program_matches_its_source) for program in PROGRAMS]


# -- a file in a process of its own ----------------------------------------------------------


def _apart(work: Callable[[], int], pipe: int | None = None) -> int:
    """Return the result of `work` in a child; BROKEN if it dies or raises."""
    child = os.fork()
    if not child:
        signal.signal(signal.SIGVTALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS if pipe is None else 100 * SECONDS)
        silent = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silent, 1)
        os.dup2(silent, 2)
        try:
            os._exit(work())
        finally:
            os._exit(BROKEN)
    if pipe is not None:
        return child
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else BROKEN


def _judged(file: File) -> int:
    try:
        file.judge(file.program)
    except AssertionError:
        return FAILED
    return PASSED


def outcome(file: File, mutant: Mutant | None = None) -> int:
    """Return whether a file passes or fails with a mutant, or it is BROKEN."""

    def work() -> int:
        if mutant is None:
            return _judged(file)
        try:
            with mutant.made():
                return _judged(file)
        except NoProgram:
            return BROKEN

    return _apart(work)


def executed(file: File) -> set[Place]:
    """Return lines of the runtime that a file executes."""
    reader, writer = os.pipe()

    def work() -> int:
        lines: set[Place] = set()
        root = tuple(map(str, ROOTS))

        def local(frame, event, argument):
            lines.add((frame.f_code.co_filename, frame.f_lineno))
            return local

        def called(frame, event, argument):
            if frame.f_code.co_filename.startswith(root):
                return local(frame, event, argument)
            return None

        launch = Process.launch

        def traced(process: Process, body: Callable[[], None]) -> None:
            def inside() -> None:  # every greenlet has a trace function of its own
                sys.settrace(called)
                body()

            launch(process, inside)

        Process.launch = traced  # type: ignore[method-assign]
        sys.settrace(called)
        try:
            return _judged(file)
        finally:
            sys.settrace(None)
            with os.fdopen(writer, "w") as stream:
                stream.writelines(f"{line} {path}\n" for path, line in lines)

    child = _apart(work, reader)
    os.close(writer)
    with os.fdopen(reader) as stream:
        rows = [row.rstrip("\n").split(" ", 1) for row in stream]
    os.waitpid(child, 0)
    return {(path, int(line)) for line, path in rows}


# -- the campaign ----------------------------------------------------------------------------


class Campaign:
    """Search for a mutant for each file."""

    def __init__(self, files: Iterable[File], every: list[File], share: float) -> None:
        self.files = list(files)
        self.all = every
        self.limit = max(1, int(len(every) * share / 100))
        self.shown: dict[File, tuple[Mutant, int]] = {}
        """Mutant of a file, and number of files that fail with it."""
        self.tried = 0
        self._done: set[Mutant] = set()
        self.runs: dict[Place, list[File]] = defaultdict(list)
        self._lines: dict[File, set[Place]] = {}
        for file in every:
            self._lines[file] = executed(file)
            for place in self._lines[file]:
                self.runs[place].append(file)
        self._mutants: dict[Place, list[Mutant]] = defaultdict(list)
        for root in ROOTS:
            for mutant in of_functions(root=root, package=f"rapidgen.{root.name}"):
                self._mutants[str(mutant.path), mutant.line].append(mutant)

    @property
    def left(self) -> list[File]:
        """Return files that no mutant has failed."""
        return [file for file in self.files if file not in self.shown]

    def broader(self, share: float) -> None:
        """Let mutants fail more files from now on."""
        self.limit = int(len(self.all) * share / 100)
        self._done.clear()

    def search(self, tell: Callable[[File], None] = lambda file: None) -> None:
        """Try mutants of the lines that a file executes, the rarest first."""
        for file in self.left:
            places = sorted(
                self._lines[file] & self._mutants.keys(), key=lambda p: (len(self.runs[p]), p)
            )
            candidates = [(m, place) for place in places for m in self._mutants[place]]
            if len(candidates) > 2 * LARGEST_TRIAL:
                candidates = candidates[:LARGEST_TRIAL] + candidates[-LARGEST_TRIAL:]
            for mutant, place in candidates:
                if mutant not in self._done and self._try(mutant, file, self.runs[place]):
                    break
            tell(file)

    def _try(self, mutant: Mutant, file: File, others: list[File]) -> bool:
        """True if the mutant fails `file`, and few of `others`."""
        self.tried += 1
        if outcome(file, mutant) != FAILED:
            return False
        self._done.add(mutant)
        result = [file]
        for other in others:
            if other is not file and outcome(other, mutant) == FAILED:
                result.append(other)
                if len(result) > self.limit:
                    return False
        for one in result:
            if one in self.files:
                self.shown.setdefault(one, (mutant, len(result)))
        return True
