"""Send random FollowJointTrajectory goals with faults; check their ends.

`python tools/ros_goals.py [--scenarios N] [--first SEED] [--jobs N]`; three goals a scenario.
"""

import argparse
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / "ros"), str(ROOT / "tests" / "client")]

from scenarios import play  # noqa: E402


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenarios", type=int, default=3400)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    requested = parser.parse_args()
    began, ends, wrong = time.monotonic(), Counter(), []
    seeds = range(requested.first, requested.first + requested.scenarios)
    with ProcessPoolExecutor(requested.jobs) as pool:
        for result in pool.map(play, seeds, chunksize=4):
            ends.update(result.ends)
            wrong += result.wrong
    for end, count in ends.most_common():
        print(f"{count:7d}  {end}")
    print(f"{ends.total()} goals, {time.monotonic() - began:.0f} s, {len(wrong)} wrong")
    for line in wrong[:20]:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
