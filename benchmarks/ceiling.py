"""Random trajectories near a TCP speed limit: recorded speed, refusals.

    python benchmarks/ceiling.py [ROBOT] [--count N] [--jobs N] [--ceiling MM/S] [--margin F]

Each path has `margin` times the time in which the TCP keeps its limit, evaluated at sixty places; a
refusal of one is counted as false. Half of them are streamed. The recording is compared with the
limit, every 4 ms.
"""

import argparse
import random
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.suite.tcp_speed_limit import ALLOWED, fastest, is_taken, random_way
from rapidgen.verification.testbench import Bench

CHUNK = 20
"""Trajectories of one controller."""


def share(seed):
    """Return the maximum share of the limit, points and refusals.

    Of one controller.
    """
    chance, limit = random.Random(seed), CONFIG.groups[0].tcp_speed_limit
    worst, points, refused = 0.0, 0, 0
    bench = Bench(CONFIG, SYSTEM)
    bench.run(0.5)
    for number in range(CHUNK):
        since, way = bench.now, random_way(bench, chance, GIVEN.margin)
        points += len(way)
        refused += not is_taken(bench, way, streaming=number % 2 == 0)
        worst = max(worst, fastest(bench, since) / limit)
        bench.forget()
    bench.close()
    return worst, points, refused


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ceiling", type=float, default=250)
    parser.add_argument("--margin", type=float, default=1.09)
    GIVEN = parser.parse_args()
    CONFIG = load_config(GIVEN.robot, overrides=[f"tcp_speed_limit={GIVEN.ceiling}"])
    SYSTEM = make_system(CONFIG, build(CONFIG))
    started = time.monotonic()
    with ProcessPoolExecutor(GIVEN.jobs, mp_context=get_context("fork")) as pool:
        found = list(pool.map(share, range(-(-GIVEN.count // CHUNK))))
    worst = max(w for w, _, _ in found)
    print(
        f"{GIVEN.robot}, ceiling {GIVEN.ceiling:g} mm/s: {len(found) * CHUNK} trajectories, "
        f"{sum(p for _, p, _ in found)} points with {GIVEN.margin:g} of the time that they need: "
        f"fastest {worst:.3f} of the ceiling, {sum(r for _, _, r in found)} refused; "
        f"{time.monotonic() - started:.0f} s"
    )
    sys.exit(worst > ALLOWED)
