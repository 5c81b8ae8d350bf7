"""Stop robots by the brakes at 80 % of an axis' speed limit or more.

    python tools/fast_stops.py [--count N] [--first SEED] [--jobs N] [--pairs] [ROBOT ...]

Runs N schedules (default 20,000), divided among the robots: after each the robot stays at rest, and
accepts and executes a new trajectory after a restart of the program. `--pairs` also divides them
among the settings in which any two assumptions about controllers meet. A failure is printed with
its seed: `--first SEED --count 1` with the same robots repeats it, with the event log.
`rapidgen/verification/fast_stops.py` describes a schedule.
"""

import argparse
import resource
import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.verification.fast_stops import fast_stop
from rapidgen.verification.settings import assumed, rows
from rapidgen.verification.testbench import Bench
from rapidgen.verification.worker_pool import LocalPool, each, run_in_fork

ROBOTS = ("irb120", "irb6700", "irb2400", "irb120_track", "irb14000")
FAR = (0.01, 0.1, 0.5)
"""m off the path."""


def booted(robot, texts):
    """Return a bench with an idle driver; tasks switch at random."""
    config = load_config(robot)
    system = in_its_cell(make_system(config, build(config)), config)
    hostile = [text for text in texts if not text.startswith("schedule")]
    schedule = "pers" if "schedule=pers" in texts else "random"
    bench = Bench(config, system, assumed((*hostile, f"schedule={schedule}")))
    bench.compile()
    bench.run(0.5)
    return bench


def one(benches, seed):
    bench = benches[seed % len(benches)]
    return run_in_fork(lambda: fast_stop(bench, seed))


def cpu():
    """Return s of CPU of this process and of ended ones."""
    both = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return sum(usage.ru_utime + usage.ru_stime for usage in both)


def report_progress(done):
    if done % 1000 == 0:
        after = time.monotonic() - STARTED
        print(f"{done} of {GIVEN.count} stops after {after:.0f} s", flush=True)


def main():
    seeds = list(range(GIVEN.first, GIVEN.first + GIVEN.count))
    stops = []
    with LocalPool(BENCHES, GIVEN.jobs) as workers:
        for stop in each(workers, seeds, one):
            stops.append(stop)
            report_progress(len(stops))
    for stop in stops:
        if stop.finding:
            print(f"seed {stop.seed}: {stop.finding}")
            if GIVEN.count == 1:
                print("\n".join(stop.log))
    far = ", ".join(
        f"{sum(s.off_path > limit for s in stops) / len(stops):.1%} > {limit * 1000:g} mm"
        for limit in FAR
    )
    stuck = sum(bool(stop.finding) for stop in stops)
    print(
        f"{len(stops)} stops at {min(s.share for s in stops):.0%} of an axis' speed or more "
        f"({dict(Counter(s.action for s in stops))}): {far}, the farthest "
        f"{max(s.off_path for s in stops) * 1000:.0f} mm; {sum(s.from_main for s in stops)} "
        f"started from main; {stuck} did not hold"
    )
    print(f"{cpu():.0f} s of CPU, {len(stops) / cpu():.1f} a second of it")
    return bool(stuck)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robots", nargs="*", default=ROBOTS)
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--pairs", action="store_true")
    GIVEN = parser.parse_args()
    STARTED = time.monotonic()
    ROWS = rows() if GIVEN.pairs else {"": ()}
    BENCHES = [booted(robot, texts) for robot in GIVEN.robots for texts in ROWS.values()]
    sys.exit(main())
