"""Tight corners, as small as the axes follow, and those of the configured zone."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.generate import build
from tests.generate.bench import trajectory
from tests.generate.driving import reply_of, send_all

STEP = 0.2
SHORTEST, SMALLEST, LARGEST, SHARE = 0.025, 0.0003, 0.05, 0.3


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


def wanted(config, rows):
    """Zones of tight corners, from the configuration alone (m)."""
    group = config.groups[0]
    forward = Kinematics.of(group).forward
    speeds = [math.dist(forward(a)[0], forward(b)[0]) / STEP for a, b in pairwise(rows)]
    zones = []
    for k in range(1, len(rows) - 1):
        needed = SHORTEST
        one, other = speeds[k - 1 : k + 1]
        uneven = abs(one - other) / (one + other)
        for joint, a, b, c in zip(group.joints, rows[k - 1], rows[k], rows[k + 1], strict=True):
            faster = max(abs(b - a), abs(c - b))
            change = (abs((c - b) - (b - a)) + uneven * faster) / STEP
            needed = max(needed, change / (SHARE * joint.acceleration))
        size = max(speeds[k - 1], speeds[k]) * needed / 2
        zones.append(min(LARGEST, max(SMALLEST, size)))
    return zones


@pytest.mark.parametrize("name", ["irb120", "irb120_track", "irb910sc"])
@pytest.mark.parametrize("size", [0.1, 0.35])
def test_tight_corners_take_what_the_axes_need(bench, name, size):
    b = bench(name)
    start = b.joints()
    rows = [[s + v for s, v in zip(start, row, strict=True)] for row in wave(len(start), size)]
    if name == "irb910sc":
        rows = [[*row[:2], start[2] - abs(row[2]) / 10, row[3]] for row in rows]
    if name == "irb120_track":
        rows = [[*row[:6], *map(abs, row[6:])] for row in rows]
    zones, _, _ = executed(b, rows)
    assert [z.tcp for z in zones] == pytest.approx(wanted(b.config, rows), rel=2e-3)
    assert len({z.tcp for z in zones}) > 3
    # z50's, so that they do not shrink the TCP's zone; its own is never below the TCP's.
    assert {z.angle for z in zones} == {math.radians(7.5)}
    assert [z.orientation for z in zones] == pytest.approx([1.5 * z.tcp for z in zones])


@pytest.mark.parametrize("size", [0.002, 0.05, 0.35])
@pytest.mark.parametrize(
    ("name", "axis", "part"), [("irb120", 5, "angle"), ("irb120_track", 7, "rotary")]
)
def test_where_the_tcp_rests_the_angle_is_what_the_axis_needs(bench, name, axis, part, size):
    b = bench(name)
    start = b.joints()
    rows = [[*start[:axis], row[0], *start[axis + 1 :]] for row in wave(1, size)]
    zones, _, _ = executed(b, rows)
    speeds = [abs(y[axis] - x[axis]) / STEP for x, y in pairwise(rows)]
    change = SHARE * b.config.groups[0].joints[axis].acceleration
    angles = []
    for k in range(1, len(rows) - 1):
        needed = abs(rows[k + 1][axis] - 2 * rows[k][axis] + rows[k - 1][axis]) / STEP / change
        angle = max(speeds[k - 1], speeds[k]) * max(SHORTEST, needed) / 2
        angles.append(min(math.radians(7.5), max(math.radians(0.03), angle)))
    assert [getattr(z, part) for z in zones] == pytest.approx(angles, rel=2e-3)


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
    assert [z.tcp for z in zones] == pytest.approx([0.0003] * 19, rel=1e-6)
    assert [z.orientation for z in zones] == pytest.approx([0.0003] * 19, rel=1e-6)


def test_stop_points_stay_stop_points(bench):
    b = bench(overrides=["trajectory.zone=fine"])
    zones, _, _ = executed(b, wave(6, 0.1, count=6))
    assert zones == []
