"""The whole suite for one robot: every case under every setting, on several processes."""

import os
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, fields, replace
from multiprocessing import get_context
from typing import Any, TextIO, TypeVar

from rapidgen.config.model import RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.motion.settings import MotionSettings
from rapidgen.proving.bench import FAILURES, Bench, Setting, add_lines
from rapidgen.proving.explore import Explored, explore
from rapidgen.proving.forking import in_a_fork
from rapidgen.proving.model import Case, Outcome, Report
from rapidgen.proving.suite import CASES
from rapidgen.runtime.switches import NOT_THE_DRIVERS, Switches
from rapidgen.system.model import System

R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class _Job:
    case: int
    name: str
    setting: Setting


# What a worker needs, inherited by fork: the configuration and its generated system.
_shared: tuple[RobotConfig, System] | None = None
_ready: "dict[str, Starter]" = {}


def settings(config: RobotConfig) -> dict[str, Setting]:
    """The default for every motion group, two hostile schedules, and every switch inverted.

    A controller's behaviour that is only remembered must not decide whether the driver works.
    """
    found = {
        "": Setting(coverage=True),
        "random schedule": Setting(seed=1, random_schedule=True),
        "switch at PERS": Setting(seed=1, random_schedule=True, switch_at_pers=True),
    }
    for number, group in enumerate(config.groups[1:], 1):
        found[group.name] = Setting(group=number, coverage=True)
    for name, value in _inverted():
        found[f"{name}={value}"] = Setting(dialect=replace(Switches(), **{name: value}))
    for name, value in _MOTION.items():
        found[f"{name}={value}"] = Setting(motion=replace(MotionSettings(), **{name: value}))
    return found


# Open questions about motion, each answered the other way.
_MOTION: dict[str, Any] = {
    "stop_waits": True,
    "stop_owner": "task",
    "refresh_timed": False,
    "cleared_move": "hang",
    "range_error": "fatal",
    "zero_length": "wait",
    "planning_lead": 0.02,
    "servo_lag": 0.05,
    "settle": 0.2,
    "emergency_stop": "path",
    "quick_factor": 1.0,
}


# What the driver cannot do without. Where it is otherwise a task ends at its start or every link
# breaks, and nothing moves: tests/generate/test_assumptions.py.
_NEEDED = {"unpack_ulint", "alias_by_name"}


def _inverted() -> Iterable[tuple[str, Any]]:
    for field in fields(Switches):
        if field.name in _NEEDED | NOT_THE_DRIVERS:
            continue
        if isinstance(field.default, bool):
            yield field.name, not field.default
        elif isinstance(field.default, str):
            for other in getattr(field.type, "__args__", ()):
                if other != field.default:
                    yield field.name, other


def prove(
    config: RobotConfig,
    *,
    seeds: int = 200,
    jobs: int | None = None,
    only: Sequence[str] = (),
    cases: bool = True,
    every_setting: bool = True,
    progress: Callable[[str, int, int], None] | None = None,
) -> Report:
    """Run the suite (`cases`, or `only` those named) and, without `only`, the exploration.

    `progress(what, done, total)` is called for every piece of work.
    """
    global _shared  # noqa: PLW0603 - workers inherit it by fork
    output = build(config)
    system = in_its_cell(make_system(config, output), config)
    _shared = (config, system)
    started = time.monotonic()
    report = Report(config.name, output.build_id)
    chosen = settings(config)
    if not every_setting:
        chosen = {name: setting for name, setting in chosen.items() if setting.coverage}
    work = [
        _Job(number, name, setting)
        for name, setting in chosen.items()
        for number, case in enumerate(CASES)
        if cases and not (config.commissioning and case.background)
        if case.name in only or (not only and (setting.coverage or not case.once))
    ]
    report.outcomes = each(work, _attempt, jobs, "cases", progress)
    if not only:
        for outcome in report.outcomes:
            add_lines(report.lines, outcome.lines)
        explored = each(list(range(seeds)), _explore, jobs, "schedules", progress)
        report.schedules = len(explored)
        report.findings = [e.finding for e in explored if e.finding is not None]
    report.elapsed = time.monotonic() - started
    for starter in _ready.values():
        starter.close()
    _ready.clear()
    return report


def each(
    work: Sequence[object],
    function: Callable[..., R],
    jobs: int | None,
    what: str = "",
    progress: Callable[[str, int, int], None] | None = None,
) -> list[R]:
    """Results of a module's function for each piece of work, in order, on several processes."""
    count = jobs or os.cpu_count() or 1
    results = []
    if count == 1:
        for done, item in enumerate(work, 1):
            results.append(function(item))
            if progress is not None:
                progress(what, done, len(work))
        return results
    with ProcessPoolExecutor(count, mp_context=get_context("fork")) as pool:
        for done, result in enumerate(pool.map(function, work, chunksize=4), 1):
            results.append(result)
            if progress is not None:
                progress(what, done, len(work))
    return results


def _attempt(job: _Job) -> Outcome:
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

    def attempt(self, case: Case) -> Outcome:
        """One case; faults of the driver are outcomes, faults of ours fly."""
        return in_a_fork(lambda: _outcome(case, self._bench))

    def close(self) -> None:
        """Give the controller back."""
        self._bench.close()


def attempt(case: Case, config: RobotConfig, system: System, setting: Setting) -> Outcome:
    """One case under one setting; faults of the driver are outcomes, faults of ours fly."""
    bench = Bench(config, system, setting)
    try:
        return _outcome(case, bench)
    finally:
        bench.close()


def _outcome(case: Case, bench: Bench) -> Outcome:
    started = time.process_time()
    detail = ""
    try:
        case.prove(bench)
        bench.healthy()
    except FAILURES as error:
        detail = str(error) or type(error).__name__
    # The case's function may be none that can be sent from process to process.
    return Outcome(
        case=case.name,
        group=case.group,
        title=case.title,
        answers=case.answers,
        passed=not detail,
        detail=detail,
        simulated=bench.now,
        elapsed=time.process_time() - started,
        log=bench.log() if detail else (),
        series=bench.series() if detail or bench.setting.coverage else (),
        lines=bench.lines(),
    )


def _explore(seed: int) -> Explored:
    assert _shared is not None
    config, system = _shared
    return explore(config, system, seed)


def replay(config: RobotConfig, seed: int, trace: TextIO | None = None) -> Explored:
    """One schedule again, exactly; every statement of RAPID goes to `trace`."""
    system = in_its_cell(make_system(config, build(config)), config)
    return explore(config, system, seed, trace=trace)
