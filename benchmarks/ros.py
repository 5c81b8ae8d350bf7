"""Delay of goals and jitter of stamps, on the virtual clock.

    python benchmarks/ros.py [--goals N] [--model NAME] [--seconds S]

From the goal callback to the first interpolated position off the robot's rest position, for goals
of 5 and of 50 points (downloaded whole); then the spacing of joint_states' stamps. All times are
simulated: they do not depend on the machine.
"""

import argparse
import asyncio
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / "ros"), str(ROOT / "tests" / "client")]

from driven import booted, robot_of  # noqa: E402
from ready import goal, station  # noqa: E402

from rapidgen.ros.goal_execution import Policy  # noqa: E402
from rapidgen.ros.goals import FinalStatus  # noqa: E402
from rapidgen.ros.robot_link import RobotLink  # noqa: E402
from rapidgen.testing.asyncio_clock import VirtualLoop  # noqa: E402

LOOK = 0.001
"""s between two looks at the interpolated position."""
MOVED = 1e-9
LIMITS = {5: 0.040, 50: 0.150}
"""Points: s."""
SPACING = 0.05
"""p99 of the deviation from the period, as a share of it."""


class Noted:
    """What the link publishes: stamps only."""

    def __init__(self):
        self.stamps = []

    def joint_states(self, states):
        self.stamps.append(states.stamp)

    def status(self, status, health):
        pass

    def note(self, text):
        pass


async def soon(s, requested):
    """Return s from the callback until the commanded position changes.

    The goal must succeed.
    """
    began, before = s.loop.time(), s.joints
    following = asyncio.ensure_future(s.follow(requested))
    while np.abs(s.joints - before).max() <= MOVED:
        assert not following.done(), following.result()
        await asyncio.sleep(LOOK)
    latency = s.loop.time() - began
    outcome = await following
    assert outcome.status is FinalStatus.SUCCEEDED, outcome
    return latency


def latencies(points, count, model):
    with station(name=model) as s:
        result, current, target = [], 0.0, 0.004 * points
        for _ in range(count):
            rows = np.linspace(current, target, points)
            result.append(s.run(soon(s, goal(*rows, seconds=0.1))))
            current, target = target, current
        return np.array(result) * 1e3


def spacings(model, seconds):
    """Return s between the stamps of joint_states, and the period."""
    controller, config = booted(model)
    loop, public = VirtualLoop(controller), Noted()
    with controller:
        link = RobotLink(lambda: robot_of(config, feedback=True), Policy(), loop.time, public)

        async def run():
            running = asyncio.ensure_future(link.run())
            await asyncio.sleep(seconds)
            running.cancel()
            await asyncio.gather(running, return_exceptions=True)

        loop.run_until_complete(run())
        loop.run_until_complete(loop.shutdown_asyncgens())
        loop.close()
    return np.diff(public.stamps) * 1e-9, config.state_period


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--goals", type=int, default=20)
    parser.add_argument("--model", default="irb120")
    parser.add_argument("--seconds", type=float, default=60.0)
    requested = parser.parse_args()
    missed = 0
    for points, limit in LIMITS.items():
        result = latencies(points, requested.goals, requested.model)
        good = result.max() <= limit * 1e3
        missed += not good
        print(
            f"{points:3d} points: median {np.median(result):6.1f} ms, "
            f"worst {result.max():6.1f} ms, "
            f"at most {limit * 1e3:.0f}: {'kept' if good else 'MISSED'}"
        )
    gaps, period = spacings(requested.model, requested.seconds)
    off = np.quantile(np.abs(gaps - period), 0.99) / period
    good = off <= SPACING
    missed += not good
    print(
        f"stamps: {len(gaps)} gaps of {period * 1e3:.0f} ms, p99 {off:.2%} off the period, "
        f"at most {SPACING:.0%}: {'kept' if good else 'MISSED'}"
    )
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
