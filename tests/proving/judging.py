"""Which mutants does the suite notice?

The cases run once on the driver as it is, with coverage; a mutant is then judged only by the cases
that execute its statement, those that have noticed most around it for their time first.
"""

import math
import os
import signal
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

from rapidgen.diagnostics import DiagnosticError
from rapidgen.proving.behaviour import Behaviour
from rapidgen.proving.bench import FAILURES, Bench, with_module
from rapidgen.proving.run import Starter
from rapidgen.proving.settings import Setting
from rapidgen.proving.workers import Local, each, in_a_fork
from rapidgen.rapid import parse
from rapidgen.runtime.errors import FatalError

PATIENCE = (2.0, 12.0)
"""A case has this many s of CPU, or so many times what it takes on the driver as it is, whatever
is more. A mutant that takes longer hangs the driver: whoever runs the suite sees that."""
HANGS = " (hangs)"
FAILS = " (fails)"
STUMBLES = (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""What a case may raise that expected an answer of another shape: it notices, without words."""
NEAR = 12
"""Lines: what a case has noticed this near to a mutant counts more than what it has elsewhere."""


class _Hung(Exception):
    pass


@dataclass(frozen=True, slots=True)
class Noticed:
    """What became of a mutant: `by` names the case that noticed it, empty: none did.

    `tried`: the cases that were; `left`: how many more execute it and were not.
    """

    by: str
    seconds: float
    tried: tuple[str, ...]
    left: int = 0


class Judge:
    """Judges mutants of one system under one setting."""

    def __init__(
        self,
        config,
        system,
        cases: Sequence[Behaviour],
        setting: Setting | None = None,
        jobs: int = 1,
    ) -> None:
        """Run all cases once. Raises ValueError when one does not hold without a mutation."""
        chosen = setting if setting is not None else Setting()
        self._noticed: list[tuple[str, int, str]] = []
        self._cases = {case.name: case for case in cases}
        starter = Starter(config, system, replace(chosen, coverage=True))
        with Local((starter, cases), jobs) as workers:
            outcomes = list(each(workers, range(len(cases)), _as_it_is))
        starter.close()
        for outcome in outcomes:
            if not outcome.passed:
                raise ValueError(f"{outcome.case} does not hold: {outcome.detail}")
        self._usual = {o.case: o.elapsed for o in outcomes}
        self._lines = {
            o.case: {(p, n) for p, lines in o.lines.items() for n, hits in lines.items() if hits}
            for o in outcomes
        }
        self._worth = _worth(self._lines)
        self._bench = Bench(config, system, chosen)
        self._bench.compile()

    def learn(self, path: str, line: int, case: str) -> None:
        """A mutant there was noticed by this case: it may well notice the next one, too."""
        name = case.removesuffix(HANGS).removesuffix(FAILS)
        if name in self._cases:
            self._noticed.append((path, line, name))

    def concerned(self, mutant) -> list[Behaviour]:
        """The cases that execute the mutant's statement, in the order to be tried."""
        place = (mutant.path, mutant.statement)
        names = [n for n in self._cases if not mutant.statement or place in self._lines[n]]
        worth = {name: self._worth[name].get(mutant.path, 1.0) for name in names}
        for path, line, name in self._noticed:
            if name in worth:
                near = path == mutant.path and abs(line - mutant.line) <= NEAR
                worth[name] += 50 if near else 0.05
        names.sort(key=lambda n: -worth[n] / self._usual[n])
        return [self._cases[name] for name in names]

    def judge(self, mutant, budget: float = math.inf, already: Collection[str] = ()) -> Noticed:
        """Try one case after another until one notices it, or `budget` s of CPU are spent.

        `already`: cases that have been tried, and did not notice it.
        """
        started = _spent()
        by, tried, left = in_a_fork(partial(self._try, mutant, budget, already))
        self.learn(mutant.path, mutant.line, by)
        return Noticed(by, _spent() - started, tried, left)

    def close(self) -> None:
        """Give the controller back."""
        self._bench.close()

    def _try(
        self, mutant, budget: float, already: Collection[str]
    ) -> tuple[str, tuple[str, ...], int]:
        """Who notices the mutant, who was tried, and how many were left out."""
        started = _spent()
        try:
            exchange(self._bench, mutant.path, mutant.text)
        except DiagnosticError:
            return "(not loaded)", (), 0
        concerned = [case for case in self.concerned(mutant) if case.name not in already]
        tried: tuple[str, ...] = ()
        for case in concerned:
            if _spent() - started >= budget:
                return "", tried, len(concerned) - len(tried)
            tried = (*tried, case.name)
            try:
                by = in_a_fork(partial(self._noticed_by, case))
            except STUMBLES:
                by = case.name + FAILS
            if by:
                return by, tried, 0
        return "", tried, 0

    def _noticed_by(self, case: Behaviour) -> str:
        least, times = PATIENCE
        signal.signal(signal.SIGPROF, _hang)
        signal.setitimer(signal.ITIMER_PROF, max(least, times * self._usual[case.name]))
        try:
            case.prove(self._bench)
            self._bench.healthy()
        except (*FAILURES, DiagnosticError):
            return case.name
        except _Hung:
            return case.name + HANGS
        return ""


def _worth(reached: Mapping[str, set[tuple[str, int]]]) -> dict[str, dict[str, float]]:
    """What each case is likely to notice in each file: a line counts by how few cases get there."""
    common = Counter(place for places in reached.values() for place in places)
    found: dict[str, dict[str, float]] = {}
    for name, places in reached.items():
        own = found[name] = {}
        for path, line in places:
            own[path] = own.get(path, 0.0) + 1 / common[path, line]
    return found


def _as_it_is(context: tuple[Starter, Sequence[Behaviour]], number: int):
    starter, cases = context
    # Plots and the log are of no use here.
    return replace(starter.attempt(cases[number]), series=(), log=())


def _spent() -> float:
    """s of CPU of this process and of those that it has waited for."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def _hang(_signal: int, _frame) -> None:
    raise _Hung


def exchange(bench: Bench, path: str, data: bytes) -> None:
    """Give a module file another text, as if the controller had been booted with it.

    For a bench that has not run yet, and a text that differs inside of routines only; that
    takes a fraction of a boot's time. Raises DiagnosticError when it is no module.
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
    """Put the routines of `tree` that differ in the place of a module's own."""
    before, module.tree = module.tree, tree
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
        # What cannot be linked ends its task when it is called, not here.
        with suppress(FatalError):
            program.function(routine)
