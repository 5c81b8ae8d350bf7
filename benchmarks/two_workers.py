"""Gain of a second worker: the same schedules with one and with two.

For comparison, two separate processes do the same work, which is the maximum of the machine.

    python benchmarks/two_workers.py --schedules 60 --rounds 3
"""

import argparse
import statistics
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from rapidgen.config import load_config
from rapidgen.verification.suite_runner import run_suite


def seconds(schedules: int, jobs: int) -> float:
    """Return wall time of a campaign of schedules on an IRB 120's driver."""
    started = time.perf_counter()
    report = run_suite(load_config("irb120"), seeds=schedules, jobs=jobs, cases=False)
    assert report.schedules == schedules
    return time.perf_counter() - started


def apart(schedules: int) -> float:
    """Return the time of two independent campaigns of half the schedules."""
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        return max(pool.map(seconds, [schedules // 2] * 2, [1] * 2))


def main() -> None:
    """Print the medians and their ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--schedules", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    many = options.schedules
    ones, twos, pairs = [], [], []
    for _ in range(options.rounds):
        ones.append(seconds(many, 1))
        twos.append(seconds(many, 2))
        pairs.append(apart(many))
    one, two, pair = map(statistics.median, (ones, twos, pairs))
    print(f"{many} schedules: one worker {one:.1f} s, two {two:.1f} s: {one / two:.2f} x")
    print(f"two processes of their own {pair:.1f} s: {one / pair:.2f} x")


if __name__ == "__main__":
    main()
