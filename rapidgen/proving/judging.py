"""Which mutants does the suite notice?

The cases run once on the driver as it is, with coverage; a mutant is then judged only by the cases
that execute its statement, those that have noticed most for their time first.
"""

import os
import signal
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import FrameType

from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import DiagnosticError
from rapidgen.proving.bench import FAILURES, Bench, Setting, with_module
from rapidgen.proving.forking import in_a_fork
from rapidgen.proving.model import Case
from rapidgen.proving.mutation import Mutant
from rapidgen.proving.run import attempt
from rapidgen.system.model import System

PATIENCE = (5.0, 20.0)
"""A case has this many s of CPU, or so many times what it takes on the driver as it is, whatever
is more. A mutant that takes longer hangs the driver: whoever runs the suite sees that."""


class _Hung(Exception):
    pass


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a mutant: `by` names the case that noticed it, empty: none did."""

    by: str
    seconds: float
    tried: int


class Judge:
    """Judges mutants of one system under one setting."""

    def __init__(
        self,
        config: RobotConfig,
        system: System,
        cases: Sequence[Case],
        setting: Setting | None = None,
    ) -> None:
        """Run all cases once. Raises ValueError when one does not hold without a mutation."""
        self._config = config
        self._system = system
        self._setting = setting if setting is not None else Setting()
        self._usual: dict[str, float] = {}
        self._lines: dict[str, set[tuple[str, int]]] = {}
        self._noticed: Counter[str] = Counter()
        self._cases = {case.name: case for case in cases}
        for case in cases:
            outcome = attempt(case, config, system, replace(self._setting, coverage=True))
            if not outcome.passed:
                raise ValueError(f"{case.name} does not hold: {outcome.detail}")
            self._usual[case.name] = outcome.elapsed
            self._lines[case.name] = {
                (path, line)
                for path, lines in outcome.lines.items()
                for line, hits in lines.items()
                if hits
            }

    def concerned(self, mutant: Mutant) -> list[Case]:
        """The cases that execute the mutant's statement, in the order to be tried."""
        place = (mutant.path, mutant.statement)
        names = [n for n in self._cases if not mutant.statement or place in self._lines[n]]
        names.sort(key=lambda n: -(self._noticed[n] + 1) / self._usual[n])
        return [self._cases[name] for name in names]

    def judge(self, mutant: Mutant) -> Verdict:
        """Try one case after another until one notices the mutant."""
        started = _spent()
        system = with_module(self._system, mutant.path, mutant.text)
        try:
            bench = Bench(self._config, system, self._setting)
        except DiagnosticError:
            return Verdict("(not loaded)", _seconds(started), 0)
        bench.compile()
        tried, by = 0, ""
        try:
            for case in self.concerned(mutant):
                tried += 1
                by = in_a_fork(partial(self._noticed_by, case, bench))
                if by:
                    self._noticed[case.name] += 1
                    break
        finally:
            bench.close()
        return Verdict(by, _seconds(started), tried)

    def _noticed_by(self, case: Case, bench: Bench) -> str:
        least, times = PATIENCE
        signal.signal(signal.SIGPROF, _hang)
        signal.setitimer(signal.ITIMER_PROF, max(least, times * self._usual[case.name]))
        try:
            case.prove(bench)
            bench.healthy()
        except (*FAILURES, DiagnosticError):
            return case.name
        except _Hung:
            return f"{case.name} (hangs)"
        return ""


def _spent() -> float:
    """s of CPU of this process and of those that it has waited for."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def _seconds(started: float) -> float:
    return _spent() - started


def _hang(_signal: int, _frame: FrameType | None) -> None:
    raise _Hung
