"""Judge which mutants the suite detects.

The cases run once on the unchanged driver, with coverage; then only the cases that execute a
mutant's statement judge it. Those with most detections nearby for their time come first.
"""

import hashlib
import math
import os
import signal
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from pydantic import TypeAdapter

from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import DiagnosticError
from rapidgen.rapid import parse
from rapidgen.runtime.errors import FatalError
from rapidgen.system.model import System
from rapidgen.verification.campaign import Workload
from rapidgen.verification.case import SuiteCase
from rapidgen.verification.model import NotApplicable
from rapidgen.verification.settings import Setting
from rapidgen.verification.suite import CASES
from rapidgen.verification.suite_runner import Starter
from rapidgen.verification.testbench import FAILURES, Bench, with_module
from rapidgen.verification.worker_pool import WorkerPool, each, run_in_fork
from tools.mutation.driver import Mutant

TIME_LIMIT = (2.0, 12.0)
"""Time limit of a case: this many s of CPU, or this multiple of its time on the unchanged driver,
whichever is more. A mutant that takes longer hangs the driver, which a user of the suite notices.
"""
HANGS = " (hangs)"
FAILS = " (fails)"
STUMBLES = (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""Errors of a case that expected an answer of another form: they count as detection."""
NEAR = 12
"""Lines: detections within this distance of a mutant count more than others."""


IN_PROGRESS = 16
"""Mutants in progress at a time: the next one does not know their results."""
_CASES = {case.name: case for case in CASES}


class _Hung(Exception):
    pass


@dataclass(frozen=True, slots=True)
class Noticed:
    """Verdict on a mutant at `path` and `line`.

    `by` names the detecting case, empty: none. `tried`: the cases that ran; `left`: number of
    further cases that execute it; `elapsed`: s of CPU.
    """

    path: str
    line: int
    by: str
    elapsed: float = 0.0
    tried: tuple[str, ...] = ()
    left: int = 0


VERDICTS = TypeAdapter(Noticed)


@dataclass(frozen=True, slots=True)
class Learned:
    """Number of mutants that each case has detected: nearby, and elsewhere."""

    near: dict[str, int] = field(default_factory=dict)
    elsewhere: dict[str, int] = field(default_factory=dict)


class Learning:
    """Predictions from the verdicts so far for the next mutant."""

    def __init__(self, names: Collection[str]) -> None:
        self._names = frozenset(names)
        self._noticed: list[tuple[str, int, str]] = []

    def learn(self, verdict: Noticed) -> None:
        """Record a verdict: its case is likely to detect the next mutant."""
        name = verdict.by.removesuffix(HANGS).removesuffix(FAILS)
        if name in self._names:
            self._noticed.append((verdict.path, verdict.line, name))

    def about(self, mutant: Mutant) -> Learned:
        """Return the predictions for this mutant."""
        near: Counter[str] = Counter()
        elsewhere: Counter[str] = Counter()
        for path, line, name in self._noticed:
            is_near = path == mutant.path and abs(line - mutant.line) <= NEAR
            (near if is_near else elsewhere)[name] += 1
        return Learned(dict(near), dict(elsewhere))


@dataclass(frozen=True, slots=True)
class Question:
    """A mutant to judge with `budget` s of CPU; `already` did not detect it."""

    mutant: Mutant
    budget: float = math.inf
    already: tuple[str, ...] = ()
    learned: Learned = field(default_factory=Learned)


@dataclass(frozen=True, slots=True)
class Grounds:
    """Context of every worker: system, cases by name, and their profiles."""

    config: RobotConfig
    system: System
    cases: tuple[str, ...]
    setting: Setting
    text: str
    """Hash of the judging program; a worker with another one is rejected."""
    row: str = ""
    """Suffix of tried cases' names: the setting."""
    usual: dict[str, float] = field(default_factory=dict)
    """s of CPU of each case, for the time limit of a mutant."""
    costs: dict[str, int] = field(default_factory=dict)
    """Statements that each case executes: the shortest case comes first, on any machine."""
    lines: dict[str, set[tuple[str, int]]] = field(default_factory=dict)
    """Lines that each case executes."""
    kept: "list[Starter | Judge]" = field(default_factory=list)
    """Controllers that a worker keeps between items."""


def grounds(
    config: RobotConfig,
    system: System,
    cases: Sequence[SuiteCase],
    hire: Callable[[Grounds], WorkerPool],
    setting: Setting | None = None,
    row: str = "",
) -> Grounds:
    """Run all cases once and return the context.

    Raises ValueError when one fails without a mutation.
    """
    names = tuple(case.name for case in cases)
    bare = Grounds(config, system, names, setting or Setting(), _own_text(), row)
    with hire(bare) as workers:
        outcomes = list(each(workers, names, _as_it_is))
    for outcome in outcomes:
        if not outcome.passed:
            raise ValueError(f"{outcome.case} does not hold: {outcome.detail}")
    usual = {o.case: o.elapsed for o in outcomes}
    lines = {
        o.case: {(p, n) for p, lines in o.lines.items() for n, hits in lines.items() if hits}
        for o in outcomes
    }
    costs = {o.case: 1 + sum(sum(own.values()) for own in o.lines.values()) for o in outcomes}
    return replace(bare, usual=usual, costs=costs, lines=lines, kept=[])


def _own_text() -> str:
    folder = Path(__file__).parent
    texts = [(folder / name).read_bytes() for name in ("judging.py", "driver.py")]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


def _same_text(arguments: Grounds) -> None:
    """Reject a worker with another checkout.

    Raises RuntimeError.
    """
    if arguments.text != _own_text():
        raise RuntimeError("this worker's checkout is not that of the campaign")


def _as_it_is(arguments: Grounds, name: str):
    _same_text(arguments)
    if not arguments.kept:
        setting = replace(arguments.setting, coverage=True)
        arguments.kept.append(Starter(arguments.config, arguments.system, setting))
    # Plots and the log are not needed here.
    return replace(arguments.kept[0].attempt(_CASES[name]), series=(), log=())


def judged(arguments: Grounds, question: Question) -> Noticed:
    """Return the verdict on one mutant, as a work item."""
    _same_text(arguments)
    if not arguments.kept:
        arguments.kept.append(Judge(arguments))
    return arguments.kept[0].judge(question)


def verdicts(
    questions: Sequence[Question], learning: Learning, key: Callable[[int], str]
) -> Workload[Question, Noticed]:
    """Return mutants in order, as a workload.

    Each question uses the results of all but the last few before it, whatever the number of
    workers. `key` of a question's number.
    """

    def item(number: int) -> Question:
        question = questions[number]
        return replace(question, learned=learning.about(question.mutant))

    def take(verdict: Noticed) -> Noticed:
        learning.learn(verdict)
        return verdict

    numbers = {id(question.mutant): number for number, question in enumerate(questions)}
    return Workload(
        "mutants",
        len(questions),
        judged,
        item,
        lambda question: key(numbers[id(question.mutant)]),
        VERDICTS,
        lambda _: False,
        needs=lambda number: max(0, number - IN_PROGRESS),
        take=take,
    )


class Judge:
    """Judge mutants of one system in copies of a booted controller."""

    def __init__(self, arguments: Grounds) -> None:
        self._usual, self._costs, self._lines = arguments.usual, arguments.costs, arguments.lines
        self._worth = _worth(arguments.lines)
        self._names, self._row = arguments.cases, arguments.row
        self._bench = Bench(arguments.config, arguments.system, arguments.setting)
        self._bench.compile()

    def concerned(self, mutant: Mutant, learned: Learned) -> list[SuiteCase]:
        """Return the cases that execute the mutant's statement, in trial order."""
        place = (mutant.path, mutant.statement)
        names = [n for n in self._names if not mutant.statement or place in self._lines[n]]
        worth = {name: self._worth[name].get(mutant.path, 1.0) for name in names}
        for name in names:
            worth[name] += 50 * learned.near.get(name, 0) + 0.05 * learned.elsewhere.get(name, 0)
        names.sort(key=lambda n: -worth[n] / self._costs[n])
        return [_CASES[name] for name in names]

    def judge(self, question: Question) -> Noticed:
        """Try cases until one detects it, or its budget is spent."""
        started = _spent()
        by, tried, left = run_in_fork(partial(self._try, question))
        mutant = question.mutant
        return Noticed(mutant.path, mutant.line, by, _spent() - started, tried, left)

    def close(self) -> None:
        """Release the controller."""
        self._bench.close()

    def _try(self, question: Question) -> tuple[str, tuple[str, ...], int]:
        """Return the detecting case, tried cases, and number left out."""
        started, mutant = _spent(), question.mutant
        try:
            exchange(self._bench, mutant.path, mutant.text)
        except DiagnosticError:
            return "(not loaded)", (), 0
        concerned = [
            case
            for case in self.concerned(mutant, question.learned)
            if case.name + self._row not in question.already
        ]
        tried: tuple[str, ...] = ()
        for case in concerned:
            if _spent() - started >= question.budget:
                return "", tried, len(concerned) - len(tried)
            tried = (*tried, case.name + self._row)
            try:
                by = run_in_fork(partial(self._noticed_by, case))
            except STUMBLES:
                by = case.name + FAILS
            if by:
                return by, tried, 0
        return "", tried, 0

    def _noticed_by(self, case: SuiteCase) -> str:
        least, times = TIME_LIMIT
        signal.signal(signal.SIGPROF, _hang)
        signal.setitimer(signal.ITIMER_PROF, max(least, times * self._usual[case.name]))
        try:
            case.prove(self._bench)
            self._bench.assert_healthy()
        except NotApplicable:
            return ""
        except (*FAILURES, DiagnosticError):
            return case.name
        except _Hung:
            return case.name + HANGS
        return ""


def _worth(reached: Mapping[str, set[tuple[str, int]]]) -> dict[str, dict[str, float]]:
    """Return weights of cases by file: rarely reached lines count more."""
    common = Counter(place for places in reached.values() for place in places)
    result: dict[str, dict[str, float]] = {}
    for name, places in reached.items():
        own = result[name] = {}
        for path, line in places:
            own[path] = own.get(path, 0.0) + 1 / common[path, line]
    return result


def _spent() -> float:
    """Return s of CPU of this process and of ended children."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def _hang(_signal: int, _frame) -> None:
    raise _Hung


def exchange(bench: Bench, path: str, data: bytes) -> None:
    """Replace a module file's text, as if booted with it.

    For a bench that has not run yet, and a text that differs inside routines only; that takes a
    fraction of a boot's time. Raises DiagnosticError when it is not a module.
    """
    tree = parse(data, path=path)
    if tree.diagnostics:
        raise DiagnosticError(*tree.diagnostics)
    bench.system = with_module(bench.system, path, data)
    for task in bench.controller.rapid_tasks.values():
        for module in task.program.modules.values():
            if module.file.path == path:
                _exchange(task.program, module, tree)


def _exchange(program, module, tree):
    """Replace the routines of a module that differ in `tree`."""
    before, module.tree = module.tree, tree
    # Code that is shared by programs belongs to the modules as they were loaded.
    program.emitted = None
    known = {r.name.casefold(): r for r in before.routines}
    for node in tree.routines:
        old = known[node.name.casefold()]
        new_tokens = tree.source.tokens[node.first : node.last + 1]
        if new_tokens == before.source.tokens[old.first : old.last + 1]:
            continue
        routine = module.routines[node.name.casefold()]
        routine.node = node
        program.codes.pop(program.code_name(routine), None)
        program._linked.discard(routine)
        program.space[routine.code] = program._stub(routine)
        # A link error ends its task when it is called, not here.
        with suppress(FatalError):
            program.function(routine)
