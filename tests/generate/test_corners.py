"""What tight corners do to the motion; which size each has is a matter of the suite (`corners`).

What a zone is: S4 datasys 1-zonedata.
"""

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build
from tests.generate.bench import trajectory
from tests.generate.driving import reply_of, send_all

STEP = 0.2
SMALLEST, LARGEST = 0.0003, 0.05


def wave(joints, size, count=20):
    """Points of a curve that starts and ends at rest."""
    rows = []
    for k in range(count + 1):
        grown = size * math.sin(math.pi * k / count) ** 2
        rows.append([grown * math.sin(0.5 * k + n) * (n < joints) for n in range(joints)])
    return rows


def executed(bench, rows):
    """Zones of the fly-by moves, seconds in motion, and postures each 4 ms."""
    zones, seen = [], []
    bench.group.listeners.append(lambda move: move.zone.fine or zones.append(move.zone))
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


def test_a_turning_point_of_the_last_axis_alone_is_reached(bench):
    """With a zone of 7.5 degrees it would be missed by a quarter of a segment."""
    b = bench()
    rows = [[0.0] * 5 + [0.02 * k] for k in (0, 1, 2, 3, 2, 1, 0)]
    _, _, seen = executed(b, rows)
    assert max(place[5] for place in seen) > 0.06 - 0.001


def test_without_geometry_corners_are_those_of_the_zone():
    config = load_config("irb120")
    (group,) = config.groups
    unknown = replace(config, groups=(replace(group, chain=()),))
    known, plain = (
        next(f.data for f in build(c).files if f.path.endswith("ROS_motion.mod"))
        for c in (config, unknown)
    )
    assert b"shape_corner" in known
    assert b"shape_corner" not in plain
    assert b", CORNER, tool0" in plain


def test_they_keep_closer_to_the_points_and_cost_no_time(bench):
    found = {}
    for corners in ("zone", "tight"):
        b = bench(overrides=[f"trajectory.corners={corners}"])
        rows = wave(6, 0.12)
        zones, taken, seen = executed(b, rows)
        found[corners] = taken, max(distance(place, rows) for place in seen)
        assert corners == "tight" or {z.tcp for z in zones} == {LARGEST}
    assert abs(found["tight"][0] - found["zone"][0]) < 0.01
    assert found["tight"][1] < found["zone"][1] / 3


def test_a_zone_that_is_smaller_than_tight_stays(bench):
    b = bench(overrides=["trajectory.zone=z0"])
    zones, _, _ = executed(b, wave(6, 0.1))
    assert [z.tcp for z in zones] == pytest.approx([SMALLEST] * 19, rel=1e-6)
    assert [z.orientation for z in zones] == pytest.approx([SMALLEST] * 19, rel=1e-6)


def test_stop_points_stay_stop_points(bench):
    b = bench(overrides=["trajectory.zone=fine"])
    zones, _, _ = executed(b, wave(6, 0.1, count=6))
    assert zones == []
