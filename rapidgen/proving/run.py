"""The whole suite for one robot: every case under every setting, on several processes."""

import os
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, fields, replace
from multiprocessing import get_context
from typing import Any, TypeVar

from rapidgen.config.model import RobotConfig
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import Bench, Setting
from rapidgen.proving.explore import Explored, explore
from rapidgen.proving.model import Broken, Case, Finding, Outcome, Report
from rapidgen.proving.suite import CASES
from rapidgen.system.model import System
from rapidgen.virtual.controller import Deadlock
from rapidgen.virtual.dialect import Dialect
from rapidgen.virtual.errors import FatalError

R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class _Job:
    case: int
    setting: str


# What a worker needs, inherited by fork: the configuration and its generated system.
_shared: tuple[RobotConfig, System] | None = None


def settings() -> dict[str, Setting]:
    """The default, random schedules, a switch at every PERS access, and every switch inverted.

    A controller's behaviour that is only remembered must not decide whether the driver works.
    """
    found = {
        "": Setting(),
        "random schedule": Setting(seed=1, random_schedule=True),
        "switch at PERS": Setting(seed=1, random_schedule=True, switch_at_pers=True),
    }
    for name, value in _inverted():
        found[f"{name}={value}"] = Setting(dialect=replace(Dialect(), **{name: value}))
    return found


def _inverted() -> Iterable[tuple[str, Any]]:
    for field in fields(Dialect):
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
    system = make_system(config, output)
    _shared = (config, system)
    started = time.monotonic()
    report = Report(config.name, output.build_id)
    chosen = settings() if every_setting else {"": Setting()}
    work = [
        _Job(number, setting)
        for setting in chosen
        for number, case in enumerate(CASES)
        if cases and (not only or case.name in only)
    ]
    report.outcomes = _each(work, run_case, jobs, "cases", progress)
    if not only:
        explored = _each(list(range(seeds)), _explore, jobs, "schedules", progress)
        report.schedules = len(explored)
        report.findings = [e.finding for e in explored if e.finding is not None]
    report.elapsed = time.monotonic() - started
    return report


def _each(
    work: Sequence[object],
    function: Callable[..., R],
    jobs: int | None,
    what: str,
    progress: Callable[[str, int, int], None] | None,
) -> list[R]:
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


def run_case(job: _Job) -> Outcome:
    """One case under one setting; faults of the driver are outcomes, faults of ours fly."""
    assert _shared is not None
    config, system = _shared
    case: Case = CASES[job.case]
    started = time.monotonic()
    bench = Bench(config, system, settings()[job.setting])
    detail = ""
    try:
        case.prove(bench)
    except (Broken, Deadlock, FatalError) as error:
        detail = str(error) or type(error).__name__
    outcome = Outcome(
        case=case,
        passed=not detail,
        detail=detail,
        setting=job.setting,
        simulated=bench.now,
        elapsed=time.monotonic() - started,
        log=bench.log() if detail else (),
        series=bench.series() if detail or case.name == "whole-trajectory" else (),
    )
    bench.close()
    return outcome


def _explore(seed: int) -> Explored:
    assert _shared is not None
    config, system = _shared
    return explore(config.groups[0], system, seed, capacity=config.trajectory.capacity)


def replay(config: RobotConfig, seed: int) -> Finding | None:
    """One schedule again, exactly; what it broke, or None."""
    output = build(config)
    system = make_system(config, output)
    found = explore(config.groups[0], system, seed, capacity=config.trajectory.capacity)
    return found.finding
