"""Run the whole suite for one robot as a campaign.

Every case runs under every setting; schedules follow.
"""

import logging
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TextIO

from pydantic import TypeAdapter

from rapidgen.config.model import RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.system.model import System
from rapidgen.verification.bench_pool import BenchPool
from rapidgen.verification.campaign import Campaign, Limits, Progress, Workload
from rapidgen.verification.case import SuiteCase
from rapidgen.verification.minimization import minimal_assumptions, smaller
from rapidgen.verification.model import (
    CaseResult,
    Counterexample,
    NotApplicable,
    SuiteResult,
    is_program,
)
from rapidgen.verification.program_equivalence import (
    PROGRAMS,
    compare_program,
    name_of,
    require_programs,
)
from rapidgen.verification.raw_programs import called
from rapidgen.verification.report import series
from rapidgen.verification.result_file import Results, identity
from rapidgen.verification.schedule import ScheduleSpace, drawn, named
from rapidgen.verification.schedule_exploration import (
    Recording,
    ScheduleResult,
    explore,
    ground_of,
    setting_of,
)
from rapidgen.verification.schedule_selection import ScheduleSelector
from rapidgen.verification.settings import Setting, assumed, possible, rows, settings
from rapidgen.verification.suite import CASES
from rapidgen.verification.testbench import FAILURES, Bench, add_lines
from rapidgen.verification.worker_pool import LocalPool, WorkerPool, each, run_in_fork

_LOG = logging.getLogger("rapidgen.verification")

EXPLAINED = 20
"""Maximum number of failing cases that are explained; more would add nothing."""
VERDICTS = TypeAdapter(CaseResult)
EXPLORED = TypeAdapter(ScheduleResult)


@dataclass(frozen=True, slots=True)
class Attempt:
    """A case under a setting, with its assumptions."""

    case: int
    name: str
    assumes: tuple[str, ...]
    setting: Setting

    @property
    def key(self) -> str:
        """Return the same key for the same case under the same setting."""
        return f"{CASES[self.case].name} [{self.name}] {','.join(self.assumes)}"


@dataclass(frozen=True, slots=True)
class FailedAssumptions:
    """A case, and the assumptions under which it failed, by setting."""

    case: int
    rows: Mapping[str, Sequence[str]]


@dataclass(frozen=True, slots=True)
class DriverUnderTest:
    """Context of every worker: a configuration and its generated system."""

    config: RobotConfig
    system: System
    booted: "dict[str, Starter]" = field(default_factory=dict)
    """The worker's current controller, by its setting's assumptions."""
    fresh: BenchPool = field(default_factory=BenchPool)
    """The worker's controllers for schedules and programs."""

    @classmethod
    def of(cls, config: RobotConfig) -> "DriverUnderTest":
        """Return the driver of a configuration.

        Raises DiagnosticError.
        """
        system = make_system(config, build(config), open_words=True)
        return cls(config, in_its_cell(system, config))


def run_suite(
    config: RobotConfig,
    *,
    seeds: int = 200,
    programs: int = 0,
    jobs: int | None = None,
    hire: Callable[["DriverUnderTest"], WorkerPool] | None = None,
    only: Sequence[str] = (),
    cases: bool = True,
    strength: int = 2,
    assuming: Sequence[str] = (),
    progress: Progress | None = None,
    limits: Limits | None = None,
    results: Path | None = None,
    resume: bool = False,
) -> SuiteResult:
    """Run the suite and return its result.

    Runs `cases`, or `only` those named. Without `only` it also explores `seeds` schedules, and
    compares so many random motion `programs` with the same programs in RAPID.

    The answers to any `strength` open questions meet in some setting (0: the default alone);
    `assuming`: in that one only. `progress(what, done, total)` is called for every item. `hire`
    returns the workers, by default `jobs` processes of this machine. Results are saved in a file;
    `resume` continues it. A KeyboardInterrupt ends the run; the report has the results so far, and
    says so. Raises DiagnosticError RG805, RG810, WorkersLost.
    """
    if programs:
        require_programs(config)
    driver = DriverUnderTest.of(config)
    started = time.monotonic()
    report = SuiteResult(config.name, driver.system.build_id)
    requested = {"as asked": tuple(assuming)} if assuming else rows(strength)
    report.rows = possible(config, requested)
    attempts = _attempts(config, report.rows, only) if cases or only else []
    _LOG.info("%s: %d attempts, %d settings", config.name, len(attempts), len(report.rows))
    with (
        Results(results, f"{identity()} {report.build_id}", resume=resume) as saved,
        hire(driver) if hire else LocalPool(driver, jobs) as workers,
    ):
        campaign = Campaign(workers, saved, limits or Limits(), progress)
        try:
            report.outcomes.extend(campaign.run(_suite(attempts)))
            if not assuming:
                report.outcomes = _explained(report, workers, progress)
            if not only and not assuming:
                for outcome in report.outcomes:
                    add_lines(report.lines, outcome.lines)
                _explored(report, campaign, seeds, progress)
            for tried in campaign.run(program_results(programs)):
                report.programs += 1
                if tried.finding is not None:
                    report.findings.append(tried.finding)
        except KeyboardInterrupt:
            report.broken_off = True
    report.left = campaign.left
    report.elapsed = time.monotonic() - started
    return report


def _explored(
    report: SuiteResult, campaign: Campaign, seeds: int, progress: Progress | None
) -> None:
    (result,) = each(campaign.workers, range(1), ground)
    guide = ScheduleSelector(result)
    # Also for an interrupted run.
    report.curve = guide.curve
    for explored in campaign.run(schedules(seeds, guide)):
        report.schedules += 1
        if explored.finding is not None:
            report.findings.append(explored.finding)
    few = report.findings[:EXPLAINED]
    for number, finding in enumerate(each(campaign.workers, few, minimised)):
        report.findings[number] = finding
        if progress is not None:
            progress("smaller schedules", number + 1, len(few))


def _attempts(
    config: RobotConfig, rows: Mapping[str, tuple[str, ...]], only: Sequence[str]
) -> list[Attempt]:
    """Return attempts ordered by setting, so that a worker seldom boots."""
    return [
        Attempt(number, name, rows.get(name, ()), setting)
        for name, setting in settings(config, rows).items()
        for number, case in enumerate(CASES)
        if case.name in only or (not only and (setting.coverage or not case.once))
    ]


def _suite(attempts: Sequence[Attempt]) -> Workload[Attempt, CaseResult]:
    return Workload(
        "cases",
        len(attempts),
        attempt,
        attempts.__getitem__,
        lambda item: item.key,
        VERDICTS,
        lambda verdict: not verdict.passed,
    )


def schedules(seeds: int, guide: ScheduleSelector) -> Workload[str, ScheduleResult]:
    """Return schedules that a selector names, as a workload."""
    return Workload(
        "schedules",
        seeds,
        schedule,
        guide.name,
        lambda name: f"schedule {name}",
        EXPLORED,
        lambda explored: explored.finding is not None,
        needs=guide.needs,
        take=guide.take,
    )


def program_results(programs: int) -> Workload[str, ScheduleResult]:
    """Return random programs by number, as a workload."""
    return Workload(
        "programs",
        programs,
        program,
        name_of,
        lambda name: name,
        EXPLORED,
        lambda tried: tried.finding is not None,
    )


def _explained(
    report: SuiteResult, workers: WorkerPool, progress: Progress | None
) -> list[CaseResult]:
    """Return the outcomes with the assumptions that explain failures.

    Only cases that fail under a non-default setting alone are explained.
    """
    broken = [verdict for verdict in report.outcomes if not verdict.passed]
    anyhow = {verdict.case for verdict in broken if not report.rows.get(verdict.setting)}
    work = [
        FailedAssumptions(
            number, {v.setting: report.rows[v.setting] for v in broken if v.case == case.name}
        )
        for number, case in enumerate(CASES)
        if case.name in {verdict.case for verdict in broken} - anyhow
    ][:EXPLAINED]
    result = each(workers, work, explain)
    explanations: dict[tuple[str, str], tuple[str, ...]] = {}
    for done, (one, by_setting) in enumerate(zip(work, result, strict=True), 1):
        explanations |= {(CASES[one.case].name, name): texts for name, texts in by_setting.items()}
        if progress is not None:
            progress("smallest pairs", done, len(work))
    return [replace(v, blamed=explanations.get((v.case, v.setting), ())) for v in report.outcomes]


# -- work items ----------------------------------------------------------------------------------


def explain(driver: DriverUnderTest, broken: FailedAssumptions) -> dict[str, tuple[str, ...]]:
    """Return the smallest failing set of assumptions of a case, by setting."""

    def breaks(texts: Sequence[str]) -> bool:
        with Bench(driver.config, driver.system, assumed(texts)) as bench:
            return not _verdict(CASES[broken.case], bench).passed

    # A controller leaves state in its process.
    return minimal_assumptions(broken.rows, lambda texts: run_in_fork(lambda: breaks(texts)))


def attempt(driver: DriverUnderTest, job: Attempt) -> CaseResult:
    """Run a case under a setting."""
    # Jobs are ordered by setting, so one controller is kept.
    if job.name not in driver.booted:
        for starter in driver.booted.values():
            starter.close()
        driver.booted.clear()
        driver.booted[job.name] = Starter(driver.config, driver.system, job.setting)
    return replace(driver.booted[job.name].attempt(CASES[job.case]), setting=job.name)


def ground(driver: DriverUnderTest, _item: object) -> ScheduleSpace:
    """Return the set of schedules of a driver."""
    return ground_of(driver.config, driver.system)


def schedule(driver: DriverUnderTest, name: str) -> ScheduleResult:
    """Run one schedule; keep its log only if it fails."""
    config, system, fresh = driver.config, driver.system, driver.fresh
    result = ground_of(config, system)
    if not result.fault:
        fresh.keep(config, system, setting_of(config, drawn(named(name), result)))
    return _kept(run_in_fork(lambda: explore(config, system, name, boot=fresh.take)))


def program(driver: DriverUnderTest, name: str) -> ScheduleResult:
    """Run one random program; keep its log only if it fails."""
    config, system, fresh = driver.config, driver.system, driver.fresh
    for one in (system, called(config, config.groups[0].task)):
        fresh.keep(config, one, PROGRAMS)
    return _kept(run_in_fork(lambda: compare_program(config, system, name, boot=fresh.take)))


def _kept(tried: ScheduleResult) -> ScheduleResult:
    return tried if tried.finding is not None else replace(tried, plan="")


def minimised(driver: DriverUnderTest, finding: Counterexample) -> Counterexample:
    """Return the finding in the smallest schedule that has it."""
    name = named(finding.schedule)
    steps = len(drawn(name, ground_of(driver.config, driver.system)).steps)
    return smaller(name, steps, finding, lambda tried: schedule(driver, str(tried)).finding)


class Starter:
    """A booted controller; each case starts from a copy, in a process."""

    def __init__(self, config: RobotConfig, system: System, setting: Setting) -> None:
        self._bench = Bench(config, system, setting)
        self._bench.compile()

    def attempt(self, case: SuiteCase) -> CaseResult:
        """Run one case.

        Faults of the driver are outcomes; faults of this program raise.
        """
        return run_in_fork(lambda: _verdict(case, self._bench))

    def close(self) -> None:
        """Release the controller."""
        self._bench.close()


def _verdict(case: SuiteCase, bench: Bench) -> CaseResult:
    started = time.process_time()
    detail = untried = ""
    try:
        case.prove(bench)
        bench.assert_healthy()
    except NotApplicable as why:
        untried = str(why)
    except FAILURES as error:
        detail = str(error) or type(error).__name__
    # The case's function may not be picklable.
    return CaseResult(
        case=case.name,
        group=case.group,
        title=case.title,
        answers=case.answers,
        passed=not detail,
        detail=detail,
        untried=untried,
        simulated=bench.now,
        elapsed=time.process_time() - started,
        log=bench.log() if detail else (),
        series=series(bench) if detail or bench.setting.coverage else (),
        lines=bench.lines(),
    )


def replay(
    config: RobotConfig,
    name: str,
    trace: TextIO | None = None,
    record: Recording | None = None,
) -> ScheduleResult:
    """Repeat one schedule or random program exactly.

    Every statement of RAPID is written to `trace`.
    """
    driver = DriverUnderTest.of(config)
    if is_program(name):
        return compare_program(driver.config, driver.system, name, trace, record)
    return explore(driver.config, driver.system, name, trace=trace, record=record)
