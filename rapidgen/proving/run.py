"""The whole suite for one robot: every case under every setting, on several processes."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TextIO

from rapidgen.config.model import RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.proving.behaviour import Behaviour
from rapidgen.proving.bench import FAILURES, Bench, add_lines
from rapidgen.proving.blame import blamed
from rapidgen.proving.explore import Explored, explore
from rapidgen.proving.model import Proof, Verdict
from rapidgen.proving.report import series
from rapidgen.proving.settings import Setting, assumed, rows, settings
from rapidgen.proving.suite import CASES
from rapidgen.proving.workers import each, in_a_fork
from rapidgen.system.model import System

EXPLAINED = 20
"""Cases of which the smallest pair is looked for; of a driver that breaks more they tell enough."""


@dataclass(frozen=True, slots=True)
class _Job:
    case: int
    name: str
    setting: Setting


@dataclass(frozen=True, slots=True)
class _Broken:
    """A case, and what was assumed where it broke, by setting."""

    case: int
    rows: Mapping[str, Sequence[str]]


# What a worker needs, inherited by fork: the configuration and its generated system.
_shared: tuple[RobotConfig, System] | None = None
_ready: "dict[str, Starter]" = {}


def prove(
    config: RobotConfig,
    *,
    seeds: int = 200,
    jobs: int | None = None,
    only: Sequence[str] = (),
    cases: bool = True,
    strength: int = 2,
    assuming: Sequence[str] = (),
    progress: Callable[[str, int, int], None] | None = None,
) -> Proof:
    """Run the suite (`cases`, or `only` those named) and, without `only`, the exploration.

    The answers to any `strength` open questions meet in some setting (0: the default alone);
    `assuming`: in that one only. `progress(what, done, total)` is called for every piece of work.
    A KeyboardInterrupt ends the run; the report has what it had seen, and says so.
    """
    global _shared  # noqa: PLW0603 - workers inherit it by fork
    output = build(config)
    system = in_its_cell(make_system(config, output, open_words=True), config)
    _shared = (config, system)
    started = time.monotonic()
    report = Proof(config.name, output.build_id)
    report.rows = {"as asked": tuple(assuming)} if assuming else rows(strength)
    chosen = settings(config, report.rows)
    work = [
        _Job(number, name, setting)
        for name, setting in chosen.items()
        for number, case in enumerate(CASES)
        if cases and not (config.commissioning and case.background)
        if case.name in only or (not only and (setting.coverage or not case.once))
    ]
    explored: list[Explored] = []
    try:
        each(work, _attempt, jobs, "cases", progress, report.outcomes)
        if not assuming:
            report.outcomes = _explained(report, jobs, progress)
        if not only and not assuming:
            for outcome in report.outcomes:
                add_lines(report.lines, outcome.lines)
            each(list(range(seeds)), _explore, jobs, "schedules", progress, explored)
    except KeyboardInterrupt:
        report.broken_off = True
    report.schedules = len(explored)
    report.findings = [e.finding for e in explored if e.finding is not None]
    report.elapsed = time.monotonic() - started
    for starter in _ready.values():
        starter.close()
    _ready.clear()
    return report


def _explained(
    report: Proof, jobs: int | None, progress: Callable[[str, int, int], None] | None
) -> list[Verdict]:
    """The outcomes; those that broke under a hostile setting alone name what is to blame."""
    broken = [verdict for verdict in report.outcomes if not verdict.passed]
    anyhow = {verdict.case for verdict in broken if not report.rows.get(verdict.setting)}
    work = [
        _Broken(number, {v.setting: report.rows[v.setting] for v in broken if v.case == case.name})
        for number, case in enumerate(CASES)
        if case.name in {verdict.case for verdict in broken} - anyhow
    ][:EXPLAINED]
    found = each(work, _blame, jobs, "smallest pairs", progress)
    blame = {
        (CASES[one.case].name, setting): texts
        for one, by_setting in zip(work, found, strict=True)
        for setting, texts in by_setting.items()
    }
    return [replace(v, blamed=blame.get((v.case, v.setting), ())) for v in report.outcomes]


def _blame(broken: _Broken) -> dict[str, tuple[str, ...]]:
    assert _shared is not None
    config, system = _shared

    def breaks(texts: Sequence[str]) -> bool:
        with Bench(config, system, assumed(texts)) as bench:
            return not _verdict(CASES[broken.case], bench).passed

    # A controller leaves things behind in its process.
    return blamed(broken.rows, lambda texts: in_a_fork(lambda: breaks(texts)))


def _attempt(job: _Job) -> Verdict:
    assert _shared is not None
    # Jobs come setting by setting, so one controller is kept.
    if job.name not in _ready:
        for starter in _ready.values():
            starter.close()
        _ready.clear()
        _ready[job.name] = Starter(*_shared, job.setting)
    return replace(_ready[job.name].attempt(CASES[job.case]), setting=job.name)


class Starter:
    """A booted controller from which each case starts anew, in a process of its own."""

    def __init__(self, config: RobotConfig, system: System, setting: Setting) -> None:
        self._bench = Bench(config, system, setting)
        self._bench.compile()

    def attempt(self, case: Behaviour) -> Verdict:
        """One case; faults of the driver are outcomes, faults of ours fly."""
        return in_a_fork(lambda: _verdict(case, self._bench))

    def close(self) -> None:
        """Give the controller back."""
        self._bench.close()


def _verdict(case: Behaviour, bench: Bench) -> Verdict:
    started = time.process_time()
    detail = ""
    try:
        case.prove(bench)
        bench.healthy()
    except FAILURES as error:
        detail = str(error) or type(error).__name__
    # The case's function may be none that can be sent from process to process.
    return Verdict(
        case=case.name,
        group=case.group,
        title=case.title,
        answers=case.answers,
        passed=not detail,
        detail=detail,
        simulated=bench.now,
        elapsed=time.process_time() - started,
        log=bench.log() if detail else (),
        series=series(bench) if detail or bench.setting.coverage else (),
        lines=bench.lines(),
    )


def _explore(seed: int) -> Explored:
    assert _shared is not None
    config, system = _shared
    return explore(config, system, seed)


def replay(config: RobotConfig, seed: int, trace: TextIO | None = None) -> Explored:
    """One schedule again, exactly; every statement of RAPID goes to `trace`."""
    system = in_its_cell(make_system(config, build(config), open_words=True), config)
    return explore(config, system, seed, trace=trace)
