"""STOP of a guided robot: s from its last byte to EGMStop, and the angle until it stands.

    python benchmarks/egm_stop.py [--count N]

Simulated time at four times the reference costs. A partner in lock-step moves axis 1 at nine tenths
of `max_speed`; STOP comes on the control port at various moments. The 99th percentile must be at
most 50 ms: exit status 1. The angle is that of the virtual controller, which brakes in `stop_ramp`.
"""

import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.generate import build, make_system
from rapidgen.system import System
from rapidgen.verification.instruction_hooks import Instruction, wrapped
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.settings import assumed
from rapidgen.verification.suite.guidance import GuidedBench
from rapidgen.verification.testbench import Bench

EXAMPLES = ("irb120_egm-rw6", "crb15000_egm-rw7")
GOAL = 0.050
SHARE = 0.9


def stopping(config: RobotConfig, system: System, seed: int) -> tuple[float, float, float]:
    """Return s to EGMStop, s until the robot stands, and rad until then."""
    bench = Bench(config, system, assumed(["costs=4.0", "schedule=random", f"seed={seed}"]))
    guided = GuidedBench(bench)
    assert bench.group.egm is not None
    bench.run(0.5)
    guided.start(math.degrees(bench.group.egm.max_speed) * SHARE * 0.2)
    guided.partner.speed *= 5
    guided.run(0.05 + 0.0037 * seed)
    stops: list[float] = []

    def watch(as_before: Instruction) -> Instruction:
        def call(*arguments: object) -> object:
            stops.append(bench.now)
            return as_before(*arguments)

        return call

    wrapped(bench.rapid_task("ROS_egm"), "EGMStop", watch)
    start, place = bench.now, bench.position[0]
    guided.control.at_once(STOP)
    assert bench.controller.run_until(lambda: bool(stops), timeout=2)
    bench.wait_until_standing(5)
    result = stops[0] - start, bench.now - start, abs(bench.position[0] - place)
    bench.close()
    return result


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    count = parser.parse_args().count
    worst = 0.0
    for name in EXAMPLES:
        config = load_config(f"robots/examples/{name}.yaml")
        system = make_system(config, build(config))
        results = [stopping(config, system, seed) for seed in range(count)]
        times = sorted(time for time, _, _ in results)
        p99 = times[int(0.99 * (count - 1))]
        worst = max(worst, p99)
        speed = math.degrees(config.groups[0].egm.max_speed) if config.groups[0].egm else 0.0
        print(
            f"{name}: STOP to EGMStop, median {times[count // 2] * 1e3:.1f} ms, "
            f"p99 {p99 * 1e3:.1f} ms; stands after {max(s for _, s, _ in results):.2f} s and "
            f"{math.degrees(max(a for _, _, a in results)):.1f} deg at most "
            f"({SHARE * speed:.1f} deg/s ordered)"
        )
    return worst > GOAL


if __name__ == "__main__":
    sys.exit(main())
