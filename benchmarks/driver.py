"""Measure the driver on the reference cost model, and abb_driver.

    python benchmarks/driver.py [FOLDER with abb_driver's six modules] [--ramp S]

Simulated time per point (from the slope over two lengths of a download whose points all pass every
check, ended by a STOP whose reply marks the time), time from STOP to deceleration, and time and
path error on the trajectories in this folder, without the approach, also with corners of one size
(`trajectory.corners: zone`, z10). S is the motion model's time in which acceleration builds up (0:
no limit of jerk). A time error below 0.1 ms is rounding. These figures compare algorithms in our
cost and motion model; no controller was measured.
"""

import argparse
import csv
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.motion import MotionSettings
from rapidgen.verification.position_checks import off
from rapidgen.verification.raw_connection import STOP, point_frame
from rapidgen.verification.testbench import Bench
from tools.interop.abb_driver import read_system

ROUNDING = 1e-4
"""s: remainder of num and the planner's steps from an exact time."""
MOVED = 1e-6
"""rad"""
TRAJECTORIES = Path(__file__).resolve().parent / "trajectories"


def drivers(folder):
    config = load_config("irb120")
    yield "rapidgen", config, make_system(config, build(config))
    zone = load_config("irb120", overrides=["trajectory.corners=zone", "trajectory.zone=z10"])
    yield "rapidgen, corners: zone, z10", zone, make_system(zone, build(zone))
    if folder is not None:
        foreign = replace(config, trajectory=replace(config.trajectory, capacity=100))
        yield "abb_driver", foreign, read_system(folder)


def per_point(config, system):
    """Return simulated s for one more point."""
    in_use = []
    for count in (20, 90):
        bench = Bench(config, system)
        bench.run(1)
        link = bench.motion()
        points = bench.wave(count + 1, duration=0.2, size=0.01)
        data = b"".join(point_frame(n, count + 1, *points[n]) for n in range(count))
        start = bench.now
        link.send(data + STOP)
        bench.until(lambda got=link.frames: bool(got), 60, "STOP is answered")
        in_use.append(link.frames[0][0] - start)
        bench.close()
    return (in_use[1] - in_use[0]) / 70


def stopping(config, system):
    """Return s from the last byte of STOP to the stop order."""
    result = []
    for delay in (0.5, 0.77, 1.03, 1.31, 1.6):
        bench = Bench(config, system)
        bench.run(1)
        link = bench.motion()
        link.send(bench.download(bench.wave(30)))
        bench.wait_until_moving()
        bench.run(delay)
        group = bench.controller.motion.group("rob1")
        link.send(STOP)
        start = bench.now
        bench.until(
            lambda g=group: g.stop_reasons or not g.legs, 5, "the robot gets the stop order"
        )
        result.append(bench.now - start)
        bench.close()
    return sorted(result)[len(result) // 2], max(result)


def read(path):
    with path.open(newline="") as file:
        rows = list(csv.reader(file))[1:]
    times = [float(row[0]) for row in rows]
    joints = [tuple(float(v) for v in row[1:]) for row in rows]
    steps = [10.0, *(b - a for a, b in pairwise(times))]
    return times, list(zip(joints, steps, strict=True))


def follow(config, system, path, ramp):
    """Return (time error s, path error rad) of the whole motion.

    The path error is the largest distance. The motion lasts from the first move to another place
    until the planned end of the last one.
    """
    times, points = read(path)
    bench = Bench(config, system)
    bench.controller.motion.settings = MotionSettings(ramp_time=ramp)
    bench.run(1)
    group = bench.controller.motion.group("rob1")
    begins = []

    def received(move):
        if max(abs(a - b) for a, b in zip(move.target, group.positions(), strict=True)) > MOVED:
            begins.append(bench.now)

    group.listeners.append(received)
    link = bench.motion()
    link.send(bench.download(points))
    bench.run(2 + times[-1] * 1.5 + 12)
    if not begins:
        bench.close()
        return None
    began, finished = begins[0], group.motion.end / 1e9
    way = [p for p, _ in points]
    apart, at = 0.0, 0
    for when, seen in bench.track:
        if when < began:
            continue
        near = [(off(seen, way[i], way[i + 1]), i) for i in range(at, min(at + 4, len(way) - 1))]
        distance, at = min(near)
        apart = max(apart, distance)
    lost = max(abs(a - b) for a, b in zip(bench.position, way[-1], strict=True))
    bench.close()
    # If the last points are one place, the robot has no motion left.
    last = next(t for t, p in zip(times, way, strict=True) if p == way[-1])
    if way[0] == way[-1]:
        last = next(t for t, p in list(zip(times, way, strict=True))[1:] if p == way[-1])
    return abs((finished - began) - last), max(apart, lost)


def main(folder, ramp):
    results = {}
    for name, config, system in drivers(folder):
        median, worst = stopping(config, system)
        results[name] = own = {
            "point": per_point(config, system),
            **{p.stem: follow(config, system, p, ramp) for p in sorted(TRAJECTORIES.glob("*.csv"))},
        }
        print(
            f"{name}: {own['point'] * 1e3:.3f} ms a point, STOP {median * 1e3:.1f} ms "
            f"(worst {worst * 1e3:.1f})"
        )
        for path in sorted(TRAJECTORIES.glob("*.csv")):
            result = own[path.stem]
            if result is None:
                print(f"  {path.stem:6} not moved")
            else:
                print(f"  {path.stem:6} time {result[0]:8.4f} s  path {result[1]:.5f} rad")
    if folder is None:
        return
    theirs = results.pop("abb_driver")
    for name, own in results.items():
        names = [p for p in own if p != "point"]
        times = [f"{p} {_share(own[p][0], theirs[p][0])}" for p in names]
        paths = [f"{p} {own[p][1] / theirs[p][1]:.2f}" for p in names]
        print(
            f"{name}, share of abb_driver's: point {own['point'] / theirs['point']:.2f}, "
            f"time {', '.join(times)}, path {', '.join(paths)}"
        )


def _share(own, theirs):
    """Return the ratio of time errors; one within rounding is 0."""
    own, theirs = (0.0 if error <= ROUNDING else error for error in (own, theirs))
    return f"{own / theirs:.2f}" if theirs else f"({own:.4f} s, of none)"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--ramp", type=float, default=MotionSettings().ramp_time)
    given = parser.parse_args()
    main(given.folder, given.ramp)
