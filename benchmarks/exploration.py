"""How many schedules does the exploration need to find what is known of drivers in use?

    python benchmarks/exploration.py [--seeds N] [--jobs N] [FOLDER with abb_driver's six modules]

R1, R5, R7a, R7b and R12 (tests/proving/defective says what they are), each in a small driver of
our own that has nothing else wrong; the same driver without a defect, and the generated one, where
nothing may be found. With FOLDER also abb_driver's own modules, unchanged: a finding there is
counted for what its story and the places of the tasks show.
"""

import argparse
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.proving.explore import explore
from tests.foreign.abb_driver import read_system
from tests.proving.defective import CAPACITY, DEFECTS, small_driver

ABB_CAPACITY = 100


def kind_of(finding):
    """Which of the five a finding in modules with several of them is; "other" if none."""
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


def run(seed):
    return explore(CONFIG, SYSTEM, seed)


def explored(config, system, seeds, jobs, enough=None):
    """Findings by seed, until `enough(finding)`; how many schedules; s."""
    global CONFIG, SYSTEM
    CONFIG, SYSTEM = config, system
    started, found, count = time.monotonic(), {}, 0
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork")) as pool:
        for first in range(0, seeds, 16):
            for one in pool.map(run, range(first, min(first + 16, seeds))):
                count += 1
                if one.finding is not None:
                    found[one.seed] = one.finding
            if enough is not None and enough(found):
                break
    return found, count, time.monotonic() - started


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("--seeds", type=int, default=300)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    config = load_config("irb120")
    small = replace(config, trajectory=replace(config.trajectory, capacity=CAPACITY))
    for defect in DEFECTS:
        found, _, seconds = explored(small, small_driver(defect), given.seeds, given.jobs, bool)
        if not found:
            print(f"{defect:10} not found in {given.seeds} schedules, {seconds:.0f} s", flush=True)
            continue
        first = min(found)
        print(
            f"{defect:10} schedule {first + 1:4}, {seconds:5.1f} s: {found[first].detail}",
            flush=True,
        )
    for name, own, system in (
        ("no defect", small, small_driver()),
        ("generated", config, make_system(config, build(config))),
    ):
        found, count, seconds = explored(own, system, given.seeds, given.jobs)
        print(f"{name:10} {len(found)} findings in {count} schedules, {seconds:.0f} s", flush=True)
        for seed, finding in found.items():
            print(f"           seed {seed}: {finding.detail}")
    if given.folder is not None:
        foreign = replace(config, trajectory=replace(config.trajectory, capacity=ABB_CAPACITY))
        found, count, seconds = explored(
            foreign, read_system(given.folder), given.seeds, given.jobs
        )
        print(f"abb_driver {len(found)} findings in {count} schedules, {seconds:.0f} s")
        for kind in (*DEFECTS, "other"):
            own = {seed: f for seed, f in found.items() if kind_of(f) == kind}
            if own:
                first = min(own)
                print(
                    f"  {kind:6} {len(own):4}, first in schedule {first + 1}: {own[first].detail}"
                )
            else:
                print(f"  {kind:6} not found")


if __name__ == "__main__":
    main()
