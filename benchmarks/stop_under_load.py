"""STOP under load: s from its last byte to StopMove.

    python benchmarks/stop_under_load.py [--count N]

Idle, and with both other ports flooded. Simulated time in the reference cost model. The robot
moves; STOP comes on the control port. Under load the rest of a stream of 100,000 points arrives at
once, and three state clients send HELLO without a pause. The 99th percentile under load must be at
most twice the idle one: exit status 1.
"""

import argparse
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks.streaming import batches, booted, reply
from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.verification.instruction_hooks import watched_orders
from rapidgen.verification.messages import RawComm, encode
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.testbench import HELLO

POINTS = 100_000
HELLOS = 20_000


@cache
def rest_of_stream() -> tuple[bytes, bytes]:
    """Return the first batch, and all later ones."""
    first, *others = batches(POINTS)
    return first, b"".join(others)


def stopping(config: RobotConfig, seed: int, *, loaded: bool) -> float:
    """Return s from the delivery of STOP to StopMove."""
    bench = booted(replace(config, state_period=0.02), seed=seed)
    client, control = bench.motion(), bench.control()
    watchers = [bench.watcher() for _ in range(3)]
    first, remaining = rest_of_stream()
    client.send(first)
    reply(client)
    bench.wait_until_moving()
    bench.run(0.6 + 0.0137 * seed)
    if loaded:
        client.at_once(remaining)
        for watcher in watchers:
            watcher.at_once(HELLOS * encode(HELLO, RawComm.REQUEST))
        bench.run(0.05 + 0.0031 * seed)
    assert not bench.standing
    orders = watched_orders(bench)
    control.at_once(STOP)
    start = bench.now

    def stops() -> list[float]:
        return [order.time for order in orders if order.instruction == "StopMove"]

    assert bench.controller.run_until(lambda: bool(stops()), timeout=2)
    in_use = stops()[0] - start
    bench.close()
    return in_use


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    count = parser.parse_args().count
    config = load_config("irb120")
    highest = []
    for loaded in (False, True):
        result = sorted(stopping(config, seed % 100, loaded=loaded) for seed in range(count))
        highest.append(result[int(0.99 * (count - 1))])
        print(
            f"STOP to StopMove, {'loaded' if loaded else 'idle'}: median "
            f"{result[count // 2] * 1e3:.1f} ms, p99 {highest[-1] * 1e3:.1f} ms, worst "
            f"{result[-1] * 1e3:.1f} ms"
        )
    print(f"p99 under load / idle: {highest[1] / highest[0]:.2f}")
    return highest[1] > 2 * highest[0]


if __name__ == "__main__":
    sys.exit(main())
