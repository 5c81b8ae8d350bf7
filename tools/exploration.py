"""Count the schedules that the exploration needs to find known defects.

    python tools/exploration.py [--campaigns N] [--seeds N] [--jobs N] [FOLDER]
    python tools/exploration.py --of ROBOT... [--seeds N] [--jobs N] [--results FOLDER]

R1, R5, R7a, R7b and R12 (tests/verification/defective describes them), each in a small driver of
our own without other defects. For N campaigns with different seeds it prints the schedules until
the first finding, the median and all. The same driver without a defect, and the generated one, must
give no finding; their covered pairs of statements are printed. With FOLDER, which has abb_driver's
six modules, these are explored unchanged: a finding is classified by its log and the positions of
the tasks.

`--of`: only the generated drivers of these robots, N schedules each: findings, the curve of pairs,
the time for a schedule and for a million. Results are stored in FOLDER, where an interrupted run
continues.
"""

import argparse
import resource
import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.cli.terminal import Bars
from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.schedule_exploration import ground_of
from rapidgen.verification.schedule_selection import ScheduleSelector
from rapidgen.verification.suite_runner import DriverUnderTest, run_suite, schedules
from rapidgen.verification.worker_pool import Call, LocalPool, in_order
from tests.verification.defective import CAPACITY, DEFECTS, small_driver
from tools.interop.abb_driver import read_system

ABB_CAPACITY = 100


def kind_of(finding):
    """Return which of the five defects a finding shows, or "other"."""
    places = "\n".join(finding.log)
    if "that nothing disturbed ended" in finding.detail:
        return "R1"
    if "set free, and got" in finding.detail:
        return "R5"
    if "WaitTestAndSet" in places:
        return "R7a" if "pp-to-main" in finding.plan else "R7b"
    if "good client" in finding.detail or "STOP is answered" in finding.detail:
        return "R12"
    return "other"


def explored(config, system, seeds, workers, first=0, enough=lambda found: False):
    """Explore schedules until `enough` findings.

    Returns findings by number, number of schedules, s, and the selector.
    """
    guide = ScheduleSelector(ground_of(config, system), first)
    started, found, count = time.monotonic(), {}, 0
    work = schedules(seeds, guide)

    def make(number):
        return Call(number, work.function, work.item(number))

    for result in in_order(workers, seeds, make, work.needs, lambda: enough(found)):
        guide.take(result)
        if enough(found):
            continue
        if result.finding is not None:
            found[count] = result.finding
        count += 1
    return found, count, time.monotonic() - started, guide


def cpu():
    """Return s of CPU of this process and of its ended workers."""
    used = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in used)


def at(curve, count):
    """Return the pairs that so many schedules have covered."""
    return max((pairs for schedules, pairs in curve if schedules <= count), default=0)


def long_run(robot, seeds, jobs, folder):
    """Explore one robot's generated driver; return if there was a finding."""
    path = folder and folder / f"{Path(robot).stem}.jsonl"
    known = path.read_bytes().count(b"\n") - 1 if path and path.exists() else 0
    started, before = time.monotonic(), cpu()
    with Bars() as progress:
        report = run_suite(
            load_config(robot),
            seeds=seeds,
            jobs=jobs,
            cases=False,
            progress=progress,
            results=path,
            resume=True,
        )
    new = report.schedules - max(known, 0)
    seconds, used = time.monotonic() - started, cpu() - before
    print(f"{robot}: {len(report.findings)} findings in {report.schedules} schedules")
    if new > 0:
        print(
            f"  {new} new ones in {seconds:.0f} s, {used / new:.3f} s of CPU each; "
            f"a million: {used / new * 1e6 / 3600:.0f} h of CPU"
        )
    marks = [n for d in range(1, 7) for n in (10**d, 3 * 10**d) if n < report.schedules]
    displayed = " ".join(f"{n}:{at(report.curve, n)}" for n in (*marks, report.schedules))
    print(f"  pairs: {displayed}; the last new one in schedule {report.curve[-1][0]}")
    for finding in report.findings:
        print(f"  --replay {finding.schedule}: {finding.detail}")
    sys.stdout.flush()
    return bool(report.findings) or report.broken_off


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("--seeds", type=int, default=300)
    parser.add_argument("--campaigns", type=int, default=9)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--of", nargs="+", metavar="ROBOT", default=())
    parser.add_argument("--results", type=Path, metavar="FOLDER")
    arguments = parser.parse_args()
    if arguments.of:
        if arguments.results:
            arguments.results.mkdir(parents=True, exist_ok=True)
        result = [
            long_run(robot, arguments.seeds, arguments.jobs, arguments.results)
            for robot in arguments.of
        ]
        return any(result)
    config = load_config("irb120")
    small = replace(config, trajectory=replace(config.trajectory, capacity=CAPACITY))
    for defect in DEFECTS:
        system, firsts, seconds = small_driver(defect), [], 0.0
        with LocalPool(DriverUnderTest(small, system), arguments.jobs) as workers:
            for campaign in range(arguments.campaigns):
                result, count, spent, _ = explored(
                    small, system, arguments.seeds, workers, 10_000 * campaign, bool
                )
                firsts.append(min(result, default=count) + 1)
                seconds += spent
        each_one = " ".join(str(first) for first in sorted(firsts))
        print(
            f"{defect:10} schedule {statistics.median(firsts):4g} in the median, "
            f"{seconds / arguments.campaigns:.1f} s: {each_one}",
            flush=True,
        )
    for name, own, system in (
        ("no defect", small, small_driver()),
        ("generated", config, make_system(config, build(config))),
    ):
        with LocalPool(DriverUnderTest(own, system), arguments.jobs) as workers:
            result, count, seconds, guide = explored(own, system, arguments.seeds, workers)
        print(f"{name:10} {len(result)} findings in {count} schedules, {seconds:.0f} s", flush=True)
        print(f"           pairs: {' '.join(f'{n}:{pairs}' for n, pairs in guide.curve[::10])}")
        for finding in result.values():
            print(f"           --replay {finding.schedule}: {finding.detail}")
    if arguments.folder is not None:
        foreign = replace(config, trajectory=replace(config.trajectory, capacity=ABB_CAPACITY))
        system = read_system(arguments.folder)
        with LocalPool(DriverUnderTest(foreign, system), arguments.jobs) as workers:
            result, count, seconds, _ = explored(foreign, system, arguments.seeds, workers)
        print(f"abb_driver {len(result)} findings in {count} schedules, {seconds:.0f} s")
        for kind in (*DEFECTS, "other"):
            own = {seed: f for seed, f in result.items() if kind_of(f) == kind}
            if own:
                first = min(own)
                print(
                    f"  {kind:6} {len(own):4}, first in schedule {first + 1}: {own[first].detail}"
                )
            else:
                print(f"  {kind:6} not found")
    return False


if __name__ == "__main__":
    sys.exit(main())
