"""Zones of moves, computed as in docs/develop/driver-design.md.

Definition of a zone: S4 datasys 1-zonedata; one radius on both sides, angles and external axes
where the TCP is at rest.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple, cast

from rapidgen.axes import frames
from rapidgen.config.model import Joint
from rapidgen.motion.moves import JointMove, Move, Zone
from rapidgen.rapid.builtins import signatures
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, Position
from rapidgen.verification.suite.motion_task import begins
from rapidgen.verification.suite.speed import asks_as_it_begins
from rapidgen.verification.testbench import Bench

case = SuiteGroup("moving")

_SHARE = 0.3
"""Share of an axis' acceleration."""
_SHORTEST = 0.025
"""s"""
_SMALLEST = 0.0003
_SMALLEST_TURN = math.radians(0.03)
_RESTING = 0.0001
"""m/s"""


class _Leg(NamedTuple):
    """A segment between two points: speeds of the axes and of the TCP."""

    speeds: tuple[float, ...]
    tcp: float


def _named(name: str) -> Zone:
    """Return the zone of a RAPID name."""
    known = signatures.constant(name)
    assert known is not None
    fine, *sizes = cast("tuple[float, ...]", known.value)
    tcp, orientation, external, angle, linear, rotary = (size * 1e-3 for size in sizes)
    turn, swing = math.radians(angle * 1e3), math.radians(rotary * 1e3)
    return Zone(bool(fine), tcp, orientation, external, turn, linear, swing)


def _legs(bench: Bench, points: Sequence[Point]) -> list[_Leg]:
    geometry = bench.motion_group.kinematics
    tool = (bench.group.tool.frame.position, bench.group.tool.frame.orientation)

    def tcp(joints: Position) -> frames.Vector:
        if geometry is None:
            return (0.0, 0.0, 0.0)
        return frames.compose(geometry.forward(joints), tool)[0]

    return [
        _Leg(
            tuple((target - current) / seconds for current, target in zip(one, other, strict=True)),
            frames.distance(tcp(one), tcp(other)) / seconds,
        )
        for (one, _), (other, seconds) in pairwise(points)
    ]


def _corner(bench: Bench, arriving: _Leg, leaving: _Leg) -> Zone:
    """Return the zone between two segments, neither of which is a stay."""
    largest, joints = _named(bench.config.trajectory.zone), bench.group.joints
    if largest.fine or bench.config.trajectory.corners == "zone" or not bench.group.chain:
        return largest
    needed, both = _SHORTEST, arriving.tcp + leaving.tcp
    uneven = abs(leaving.tcp - arriving.tcp) / both if both > _RESTING else 0.0
    sums = dict.fromkeys(map(_part, joints), 0.0)
    for joint, before, after in zip(joints, arriving.speeds, leaving.speeds, strict=True):
        faster = max(abs(before), abs(after))
        change = abs(after - before) + uneven * faster
        needed = max(needed, change / (_SHARE * joint.acceleration))
        sums[_part(joint)] += faster

    def between(least: float, speed: float, most: float) -> float:
        return min(most, max(least, speed * needed / 2))

    tcp = max(arriving.tcp, leaving.tcp)
    size = between(_SMALLEST, tcp, largest.tcp)
    beyond = largest.orientation * size / largest.tcp
    zone = replace(largest, tcp=size, orientation=beyond, external=beyond)
    if tcp > _RESTING:
        return zone
    parts = {
        part: between(
            _SMALLEST if part == "linear" else _SMALLEST_TURN, speed, getattr(largest, part)
        )
        for part, speed in sums.items()
    }
    return replace(
        zone,
        angle=parts.get("angle", zone.angle),
        linear=parts.get("linear", zone.linear),
        rotary=parts.get("rotary", zone.rotary),
    )


def _part(joint: Joint) -> str:
    """Return the zone component of an axis where the TCP is at rest."""
    if joint.kind == "prismatic":
        return "linear"
    return "angle" if joint.axis.startswith("rax") else "rotary"


def _check(bench: Bench, points: Sequence[Point], what: str, percent: float = 100) -> None:
    """Send a trajectory from here; check the zone of each point.

    `percent`: SPEED at its start.
    """
    moves: list[Move] = []
    group = bench.motion_group
    group.listeners.append(moves.append)
    link = bench.motion()
    requested = points
    if percent < 100:
        asks_as_it_begins(bench, bench.control(), percent)
        points = [(place, seconds * 100 / percent) for place, seconds in points]
    begins(bench, link, requested)
    longest = 2 * sum(seconds for _, seconds in points[1:]) + 2
    bench.until(lambda: len(moves) == len(points) - 1, longest, f"{what}: each point is a move")
    bench.wait_until_at(points[-1][0], longest)
    group.listeners.remove(moves.append)
    link.close(then=0.3)
    legs = _legs(bench, points)
    expected = [_corner(bench, *two) for two in pairwise(legs)]
    seen = [m.zone for m in moves if isinstance(m, JointMove)]
    # The first point is the robot's position.
    if len(seen) != len(expected) + 1 or not seen[-1].fine:
        raise CheckFailed(f"{what}: {len(points)} points, but {len(seen)} moves")
    for number, (zone, one) in enumerate(zip(seen, expected, strict=False), 1):
        if not _alike(zone, one):
            raise CheckFailed(f"{what}, point {number}: {zone}, not {one}")


def _alike(zone: Zone, expected: Zone) -> bool:
    """True if zones are equal within the rounding of a num."""
    if zone.fine or expected.fine:
        return zone.fine == expected.fine
    names = ("tcp", "orientation", "external", "angle", "linear", "rotary")
    return all(
        math.isclose(getattr(zone, n), getattr(expected, n), rel_tol=5e-3, abs_tol=1e-6)
        for n in names
    )


class _Walk:
    """Points one segment after another, with given speeds, within limits."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        current = bench.position
        self._inward = [
            1.0 if joint.upper - value >= value - joint.lower else -1.0
            for joint, value in zip(bench.group.joints, current, strict=True)
        ]
        self.points: list[Point] = [(current, 1.0)]

    def go(self, speeds: Sequence[float], seconds: float) -> None:
        current = self.points[-1][0]
        target = tuple(
            value + sign * speed * seconds
            for value, sign, speed in zip(current, self._inward, speeds, strict=True)
        )
        self.points.append((target, seconds))


def _usual(bench: Bench) -> list[float]:
    """Return the speed of each axis that reverses within 0.08 s.

    The reversal uses the given share of the axis' acceleration.
    """
    return [
        min(0.04 * _SHARE * joint.acceleration, 0.2 * joint.speed) for joint in bench.group.joints
    ]


@case("corners", "each point's zone is as small as its axes follow", "R9")
def _moving(bench: Bench) -> None:
    """Move axes one by one, slow and fast, with unequal segment times."""
    usual, count = _usual(bench), len(bench.group.joints)
    least = max(0.2, bench.config.trajectory.min_segment)
    walk = _Walk(bench)
    for axis in range(count):
        # Up, further on, back: the TCP is faster before the point, then after it.
        for part, seconds in ((0.6, 1.3), (1.0, 1.0), (-0.9, 1.1), (0.1, 1.0), (-0.08, 1.5)):
            walk.go([part * usual[n] * (n == axis) for n in range(count)], seconds * least)
    for part, seconds in ((0.5, 1.0), (0.52, 1.2), (0.3, 1.0), (-0.8, 1.0), (0.4, 2.0)):
        walk.go([part * value for value in usual], seconds * least)
    _check(bench, walk.points, "joints in turn")


@case("corners-slowed", "zones of points that SPEED gives more time", "R9", needs="control")
def _slowed(bench: Bench) -> None:
    """Slow down the segments of a point: its zone is that of slow segments."""
    usual, least = _usual(bench), max(0.2, bench.config.trajectory.min_segment)
    walk = _Walk(bench)
    for part, seconds in ((1.0, 1.3), (0.9, 1.0), (-0.8, 1.1), (0.6, 1.0), (-1.0, 1.2)):
        walk.go([part * value for value in usual], seconds * least)
    _check(bench, walk.points, "at half the speed", 50)


@case("largest-corner", "no zone is larger than the configured one", "R9")
def _largest(bench: Bench) -> None:
    """Turn round with a fast TCP: no zone exceeds the configured one."""
    if bench.group.tcp_speed_limit < 5:
        raise NotApplicable("the TCP's ceiling is too low for large corners")
    least = max(0.2, bench.config.trajectory.min_segment)
    walk = _Walk(bench)
    joint = bench.group.joints[0]
    speed = min(0.5 * joint.speed, 1.2 if joint.kind == "revolute" else 0.8)
    remaining = [0.0] * (len(bench.group.joints) - 1)
    for part in (0.5, 0.8, -0.8, 0.5, -0.4):
        walk.go([part * speed, *remaining], least)
    _check(bench, walk.points, "a quick TCP")


@case("resting-corner", "zones of axes that do not move the TCP", "R9")
def _resting(bench: Bench) -> None:
    """Move only axes that leave the TCP at rest: last axis, external axes."""
    usual, count = _usual(bench), len(bench.group.joints)
    least = max(0.2, bench.config.trajectory.min_segment)
    for axis in range(count):
        walk = _Walk(bench)
        parts = ((0.02, 1.0), (0.6, 1.3), (1.0, 1.0), (-1.0, 1.0), (0.05, 1.2), (-0.04, 1.0))
        for part, seconds in parts:
            walk.go([part * usual[n] * (n == axis) for n in range(count)], seconds * least)
        if max(leg.tcp for leg in _legs(bench, walk.points)) <= _RESTING:
            _check(bench, walk.points, f"joint {axis + 1}, which does not move the TCP")


@case("unknown-corner", "a corner of unknown speed is as large as it may be", "R9")
def _unknown(bench: Bench) -> None:
    """Hide the TCP's speed: the largest zone applies, and motion continues."""
    policy = bench.config.trajectory
    if policy.zone == "fine" or policy.corners == "zone" or not bench.group.chain:
        raise NotApplicable("the driver computes no sizes of corners")
    zones: list[Zone] = []
    group = bench.motion_group

    def received(move: Move) -> None:
        zones.append(move.zone)

    group.listeners.append(received)
    fails(bench, "ROS_motion", "CalcRobT", "ERR_ROBLIMIT")
    bench.assert_moves_through(bench.motion(), bench.wave(6))
    group.listeners.remove(received)
    if not any(_alike(zone, _named(policy.zone)) for zone in zones):
        raise CheckFailed(f"CalcRobT has failed, the zones are {zones}")
