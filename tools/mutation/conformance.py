"""Find a mutant that fails each conformance program.

See tools/conformance_mutants.py.
"""

import gc
import signal
import sys
from collections import defaultdict
from contextlib import contextmanager, suppress

from rapidgen.rapid import parse
from rapidgen.rapid.builtins import signatures
from tests.rapid import conformance_files
from tools.mutation.front_end import ROOT, NoProgram, of_builtins, of_functions, of_tables

BROAD = 50
"""Per cent of all files that a mutant may fail, for a file without a narrower one."""
SECONDS = (0.1, 2.0)
"""CPU time after which a mutant seems to hang, and after which it does; a file takes some
milliseconds, but a delayed machine counts that as CPU time, too.
"""


class Hung(Exception):
    """The mutant does not end."""


def judged(file, seconds):
    """True if a file's findings differ from the announced ones.

    Raises Hung after this much CPU time.
    """
    armed = True  # never raised once the file is judged

    def hang(number, frame):
        if armed:
            raise Hung

    before = signal.signal(signal.SIGVTALRM, hang)
    # Raised inside a callback of the collector, which a mutant may call, Hung would be lost.
    collecting, callbacks = gc.isenabled(), gc.callbacks[:]
    gc.disable()
    gc.callbacks.clear()
    # Repeatedly: a mutant may swallow the first.
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, seconds)
    try:
        return file.found() != file.expected
    finally:
        armed = False
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        gc.callbacks[:] = callbacks
        if collecting:
            gc.enable()
        signal.signal(signal.SIGVTALRM, before)


def fails(file):
    """True if a file's findings differ; None for a hang or a crash."""
    for seconds in SECONDS:
        try:
            return judged(file, seconds)
        except Hung:
            continue
        except Exception:  # noqa: BLE001  # a mutant may raise anything
            return None
    return None


def executed(file):
    """Return (path, line) of the front end that judging a file executes."""
    lines = set()
    root = str(ROOT)

    def local(frame, event, argument):
        lines.add((frame.f_code.co_filename, frame.f_lineno))
        return local

    def called(frame, event, argument):
        return local(frame, event, argument) if frame.f_code.co_filename.startswith(root) else None

    before = sys.gettrace()
    sys.settrace(called)
    try:
        file.found()
    finally:
        sys.settrace(before)
    return lines


class Campaign:
    """Search for a mutant for each file."""

    def __init__(self, files, every, share):
        self.files = files
        self.all = every
        self.limit = int(len(every) * share / 100)
        self.shown = {}
        """File to (mutant, number of files that fail with it)."""
        self.broad = set()
        """Mutants that fail too many files, or none."""
        self.tried = 0
        self.runs = self._runs(every)

    @staticmethod
    def _runs(files):
        """Return (path, line) to the files that execute it."""
        signatures.routines()  # read once, so that no file seems to read them
        signatures.predefined()
        signatures.type_names()
        runs = defaultdict(list)
        for file in files:
            for place in executed(file):
                runs[place].append(file)
        return runs

    def broader(self, share):
        """Let mutants fail more files from now on."""
        self.limit = int(len(self.all) * share / 100)
        self.broad.clear()

    @property
    def left(self):
        return [file for file in self.files if file not in self.shown]

    def try_mutant(self, mutant, file, others):
        """True if the mutant fails `file`, and few of `others`."""
        self.tried += 1
        try:
            with mutant.made():
                if not fails(file):
                    return False
                result = [file]
                for other in others:
                    if other is not file and fails(other):
                        result.append(other)
                        if len(result) > self.limit:
                            self.broad.add(mutant)
                            return False
        except NoProgram:
            return False  # not a program
        self.broad.add(mutant)  # no other file can use it
        for one in result:
            if one in self.files and one not in self.shown:
                self.shown[one] = (mutant, len(result))
        return True

    def builtins(self):
        """Try mutants of built-ins that a file names."""
        by_name = defaultdict(list)
        for mutant in of_builtins():
            by_name[mutant.name].append(mutant)
        words = {f: {t.lower() for t in parse(f.text).source.tokens} for f in self.all}
        users = defaultdict(list)
        for file, names in words.items():
            for name in names & by_name.keys():
                users[name].append(file)
        for file in self.left:
            if file.section[0] not in "23":
                continue
            names = sorted(words[file] & by_name.keys(), key=lambda name: len(users[name]))
            self._first(file, ((m, users[name]) for name in names[:4] for m in by_name[name]))

    def functions(self):
        """Try mutants of lines that a file executes, the rarest first."""
        lines = defaultdict(set)
        for place, files in self.runs.items():
            for file in files:
                lines[file].add(place)
        mutants = defaultdict(list)
        for mutant in of_functions():
            mutants[(str(mutant.path), mutant.line)].append(mutant)
        for file in self.left:
            places = sorted(lines[file] & mutants.keys(), key=lambda p: (len(self.runs[p]), p))
            self._first(file, ((m, self.runs[p]) for p in places for m in mutants[p]))

    def _first(self, file, candidates):
        if file in self.shown:
            return
        for mutant, others in candidates:
            if mutant not in self.broad and self.try_mutant(mutant, file, others):
                return

    def tables(self):
        """Try mutants of tables, on the remaining files."""
        for mutant in of_tables():
            left = self.left
            if not left:
                return
            with suppress(NoProgram), mutant.made(), judged_anew():
                self._table(mutant, left)

    def _table(self, mutant, left):
        self.tried += 1
        result = [file for file in left if fails(file)]
        if not result:
            return
        count = len(result)
        for other in self.all:
            if other not in left and fails(other):
                count += 1
            if count > self.limit:
                return
        for file in result:
            self.shown[file] = (mutant, count)


@contextmanager
def judged_anew():
    """Judge the conformance programs by the package as it is imported now."""
    names = ("check", "parse", "Dialect")
    before = {name: getattr(conformance_files, name) for name in names}
    for name in names:
        setattr(conformance_files, name, getattr(sys.modules["rapidgen.rapid"], name))
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(conformance_files, name, value)
