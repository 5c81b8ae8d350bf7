"""TCP speed limit, if a configuration has one below the standard."""

import math
import random
from itertools import pairwise

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawPointsAccepted, RawReason
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, Position, changed
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.suite.refusals import refused
from rapidgen.verification.testbench import CEILING, Bench

case = SuiteGroup("edges")

ROUNDS = 4
"""Random trajectories of one run; a benchmark has more."""
ALLOWED = 1.05
"""Share of the speed limit that a recording may show."""
_MARGIN = 1.09
"""Share of the needed time that a driver accepts in any case."""


def _asked(bench: Bench) -> bool:
    if bench.config.trajectory.too_fast != "refuse" or bench.motion_group.kinematics is None:
        return False
    return bench.group.tcp_speed_limit < CEILING


@case("tcp-too-fast", "more speed than the TCP may have", "R10")
def _tcp_too_fast(bench: Bench) -> None:
    """Exceed the speed limit with the TCP alone; no axis is too fast."""
    if not _asked(bench):
        raise NotApplicable("the TCP has no ceiling of its own")
    seconds = max(0.2, bench.config.trajectory.min_segment)
    step = 0.5 * seconds * bench.group.joints[0].speed
    current = bench.position
    away = changed(current, 0, current[0] + step)
    if bench.tcp_seconds(current, away) < 1.2 * seconds:
        raise NotApplicable("no axis can make the TCP too fast")
    points = [(current, 1.0), (away, seconds), (current, 9.0)]
    refused(bench, bench.download(points), [RawReason.TCP_TOO_FAST], point=1)
    if not bench.streams:
        return
    good = bench.wave(8)
    stream = Streamer(bench)
    stream.takes("the first points", good, BEGIN)
    end = good[-1][0]
    stream.put([(changed(end, 0, end[0] + step), seconds)], END)
    reply = stream.refused(RawReason.TCP_TOO_FAST, "a TCP that is too fast")
    if (reply.accepted, reply.point, reply.joint) != (8, 8, 0):
        raise CheckFailed(f"eight points were right, the reply is {reply}")
    bench.wait_until_at(end, 20)


@case("tcp-arc", "a long turn between two places that are near each other", "R10")
def _long_turn(bench: Bench) -> None:
    """Turn far: the TCP follows its arc, not the chord."""
    joint, current = bench.group.joints[0], bench.position
    low, high = (changed(current, 0, v) for v in (joint.lower + 0.01, joint.upper - 0.01))
    seconds = 0.5 * bench.tcp_seconds(low, high)
    if not _asked(bench) or seconds < 1.1 * (joint.upper - joint.lower) / joint.speed:
        raise NotApplicable("axis 1 can make no TCP too fast")
    bench.assert_moves_through(bench.motion(), [(current, 1.0), (low, bench.seconds_to(low))])
    points = [(low, 1.0), (high, seconds)]
    refused(bench, bench.download(points), [RawReason.TCP_TOO_FAST], point=1)
    if not bench.streams:
        return
    current = bench.position
    bench.assert_moves_through(bench.motion(), [(current, 1.0), (low, bench.seconds_to(low))])
    stream = Streamer(bench)
    stream.put(points, BEGIN | END)
    reply = stream.refused(RawReason.TCP_TOO_FAST, "a long turn that is too fast")
    if reply.point != 1:
        raise CheckFailed(f"the first point was right, the reply is {reply}")


def random_way(bench: Bench, chance: random.Random, margin: float) -> list[Point]:
    """Return random points in `margin` times the needed time, near here."""
    policy, joints = bench.config.trajectory, bench.group.joints

    def near(place: Position, share: float) -> Position:
        goals = (chance.uniform(0.9 * j.lower, 0.9 * j.upper) for j in joints)
        move = [chance.random() < 0.6 for _ in joints]
        steps = (share * (g - p) * m for g, p, m in zip(goals, place, move, strict=True))
        return tuple(p + s for p, s in zip(place, steps, strict=True))

    def seconds(one: Position, other: Position) -> float:
        by_axis = (1.05 * abs(b - a) / j.speed for a, b, j in zip(one, other, joints, strict=True))
        return max(margin * bench.tcp_seconds(one, other), 1.1 * policy.min_segment, *by_axis)

    share = chance.choice((0.03, 0.2, 0.9))
    places = [
        tuple(
            p + 0.9 * bench.start_tolerance(j) for p, j in zip(bench.position, joints, strict=True)
        )
    ]
    if not all(j.lower < p < j.upper for p, j in zip(places[0], joints, strict=True)):
        places = [bench.position]
    for _ in range(chance.randint(1, 5)):
        places.append(near(places[-1], share))
    return [(places[0], 1.0), *((b, seconds(a, b)) for a, b in pairwise(places))]


def fastest(bench: Bench, since: float) -> float:
    """Return the highest recorded TCP speed since then, m/s."""
    track = [(when, bench.tcp(seen)) for when, seen in bench.track if when >= since]
    return max(
        (math.dist(a, b) / (then - when) for (when, a), (then, b) in pairwise(track)), default=0.0
    )


def is_taken(bench: Bench, points: list[Point], *, streaming: bool) -> bool:
    """True if the driver accepts the trajectory; then execute it."""
    link, end = bench.motion(), points[-1][0]
    if streaming:
        stream = Streamer(bench, link)
        accepted = isinstance(stream.put(points, BEGIN | END), RawPointsAccepted)
    else:
        link.send(bench.download(points))
        bench.run(0.5 + 0.01 * len(points))
        accepted = not bench.status(bench.state()).in_error
    if accepted:
        bench.wait_until_at(end, 10 + 2 * sum(seconds for _, seconds in points))
    bench.wait_until_standing(60)
    link.close(then=0.3)
    return accepted


@case("tcp-turns", "the TCP keeps its ceiling between corners that slow it down", "R10")
def _turns(bench: Bench) -> None:
    """Turn round on axis 1, immediately and after a while."""
    if not _asked(bench):
        raise NotApplicable("the TCP has no ceiling of its own")
    joint, current, limit = bench.group.joints[0], bench.position, bench.group.tcp_speed_limit
    for seconds in (0.2, 0.3, 0.5):
        expected = max(seconds, 1.2 * bench.config.trajectory.min_segment)
        step = min(0.3, expected * joint.speed / 1.05)
        step *= min(
            1.0,
            expected
            / (_MARGIN * bench.tcp_seconds(current, changed(current, 0, current[0] + step))),
        )
        target = changed(current, 0, current[0] + step)
        since, path = bench.now, [current, *[target, current] * 3]
        points = [(place, expected) for place in path]
        if not is_taken(bench, points, streaming=False):
            raise CheckFailed(f"{points} is refused, its ways have {_MARGIN} of the time they need")
        speed = fastest(bench, since)
        if speed > ALLOWED * limit:
            raise CheckFailed(
                f"the TCP went at {speed:.3f} m/s, the ceiling is {limit} m/s: {points}"
            )


@case("tcp-recorded", "the TCP is never faster than its ceiling", "R10")
def _recorded(bench: Bench) -> None:
    """Record random paths near the speed limit, complete and streamed."""
    if not _asked(bench):
        raise NotApplicable("the TCP has no ceiling of its own")
    chance, limit = random.Random(bench.setting.seed), bench.group.tcp_speed_limit
    for number in range(ROUNDS):
        since, points = bench.now, random_way(bench, chance, _MARGIN)
        if not is_taken(bench, points, streaming=bench.streams and number % 2 == 0):
            raise CheckFailed(f"{points} is refused, its ways have {_MARGIN} of the time they need")
        speed = fastest(bench, since)
        if speed > ALLOWED * limit:
            raise CheckFailed(
                f"the TCP went at {speed:.3f} m/s, the ceiling is {limit} m/s: {points}"
            )
