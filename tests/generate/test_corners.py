"""Corners of the configured zone, and tight ones: as small as the axes follow."""

import math
from itertools import pairwise

import pytest

from rapidgen.axes.kinematics import Kinematics
from tests.generate.bench import trajectory
from tests.generate.driving import reply_of, send_all

STEP = 0.2
SHORTEST, SMALLEST, SHARE = 0.025, 0.0003, 0.3


def wave(joints, size, count=20):
    """Points of a curve that starts and ends at rest."""
    rows = []
    for k in range(count + 1):
        grown = size * math.sin(math.pi * k / count) ** 2
        rows.append([grown * math.sin(0.5 * k + n) * (n < joints) for n in range(joints)])
    return rows


def executed(bench, rows):
    """TCP zones of the fly-by moves (m), seconds in motion, and postures each 4 ms."""
    zones, seen = [], []
    bench.group.listeners.append(lambda move: move.zone.fine or zones.append(move.zone.tcp))
    client = bench.client()
    bench.vc.run_for(0.2)
    send_all(client, trajectory(rows, [0.0] + [STEP] * (len(rows) - 1)))
    assert reply_of(client) == (1, (1,))
    bench.vc.run_until(lambda: not bench.group.is_standing, timeout=5)
    begun = bench.vc.now
    while bench.pers("ROS_done") != 1:
        bench.vc.run_for(0.004)
        seen.append(bench.joints())
        assert bench.vc.now - begun < 60
    return zones, bench.group.motion.end / 1e9 - begun, seen


def distance(place, rows):
    """rad between a posture and the polyline of the points."""

    def from_line(a, b):
        way = [y - x for x, y in zip(a, b, strict=True)]
        square = sum(w * w for w in way) or 1.0
        share = sum((p - x) * w for p, x, w in zip(place, a, way, strict=True)) / square
        share = min(1.0, max(0.0, share))
        return math.dist(place, [x + w * share for x, w in zip(a, way, strict=True)])

    return min(from_line(a, b) for a, b in pairwise(rows))


def wanted(config, rows):
    """Zones of tight corners, from the configuration alone (m)."""
    group = config.groups[0]
    forward = Kinematics.of(group).forward
    speeds = [math.dist(forward(a)[0], forward(b)[0]) / STEP for a, b in pairwise(rows)]
    zones = []
    for k in range(1, len(rows) - 1):
        needed = SHORTEST
        for joint, a, b, c in zip(group.joints, rows[k - 1], rows[k], rows[k + 1], strict=True):
            change = abs((c - b) - (b - a)) / STEP
            needed = max(needed, change / (SHARE * joint.acceleration))
        size = max(speeds[k - 1], speeds[k]) * needed / 2
        zones.append(min(0.01, max(SMALLEST, size)))
    return zones


@pytest.mark.parametrize("name", ["irb120", "irb120_track", "irb910sc"])
@pytest.mark.parametrize("size", [0.1, 0.35])
def test_tight_corners_take_what_the_axes_need(bench, name, size):
    b = bench(name, overrides=["trajectory.corners=tight"])
    start = b.joints()
    rows = [[s + v for s, v in zip(start, row, strict=True)] for row in wave(len(start), size)]
    if name == "irb910sc":
        rows = [[*row[:2], start[2] - abs(row[2]) / 10, row[3]] for row in rows]
    if name == "irb120_track":
        rows = [[*row[:6], *map(abs, row[6:])] for row in rows]
    zones, _, _ = executed(b, rows)
    assert zones == pytest.approx(wanted(b.config, rows), rel=2e-3)
    assert len(set(zones)) > 3


def test_they_keep_closer_to_the_points_and_cost_no_time(bench):
    found = {}
    for corners in ("zone", "tight"):
        b = bench(overrides=[f"trajectory.corners={corners}"])
        rows = wave(6, 0.12)
        zones, taken, seen = executed(b, rows)
        found[corners] = taken, max(distance(place, rows) for place in seen)
        assert corners == "tight" or set(zones) == {0.01}
    assert abs(found["tight"][0] - found["zone"][0]) < 0.01
    assert found["tight"][1] < found["zone"][1] / 3


def test_a_zone_that_is_smaller_than_tight_stays(bench):
    b = bench(overrides=["trajectory.corners=tight", "trajectory.zone=z0"])
    zones, _, _ = executed(b, wave(6, 0.1))
    assert zones == pytest.approx([0.0003] * 19, rel=1e-6)


def test_stop_points_stay_stop_points(bench):
    b = bench(overrides=["trajectory.corners=tight", "trajectory.zone=fine"])
    zones, _, _ = executed(b, wave(6, 0.1, count=6))
    assert zones == []
