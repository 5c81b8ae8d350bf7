"""Last accepted and first rejected values; requested durations."""

import math
from itertools import pairwise

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    RawComm,
    RawReason,
    RawSpecial,
    RawTrajectoryState,
    decode,
)
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import (
    SETTLED,
    Point,
    Position,
    changed,
    distance,
    inward,
    small_unit,
)
from rapidgen.verification.raw_connection import RawLink, point_frame, raw_point
from rapidgen.verification.suite.refusals import refused
from rapidgen.verification.testbench import Bench

case = SuiteGroup("edges")

_LONGEST = 3600.0


def _inward(bench: Bench, axis: int, step: float) -> float:
    """Return `step` with the sign of the larger distance to a limit."""
    return inward(bench.group.joints[axis], bench.position[axis], step)


def _taken(bench: Bench, points: list[Point], why: str) -> None:
    """Check that the trajectory starts, and stop it."""
    link = bench.motion()
    frames = [point_frame(n, len(points), *p) for n, p in enumerate(points[:-1])]
    link.send(b"".join(frames))
    link.send(point_frame(len(points) - 1, len(points), *points[-1], RawComm.REQUEST))
    content = decode(link.expect_reply(5, "the end frame is answered"))
    if not isinstance(content, messages.RawAccepted):
        raise CheckFailed(f"{why} is refused: {content}")
    link.stop()
    bench.wait_until_standing(5)
    link.close(then=1.2)


@case("durations", "the longest duration and those beyond", "R10")
def _durations(bench: Bench) -> None:
    for seconds in (_LONGEST, 3599.0):
        points = bench.wave(4)
        points[2] = (points[2][0], seconds)
        _taken(bench, points, f"a duration of {seconds:g} s")
    for seconds in (_LONGEST + 1, 0.0, -0.0, -1e-3):
        points = bench.wave(4)
        points[2] = (points[2][0], seconds)
        refused(bench, bench.download(points), [RawReason.BAD_DURATION], 0, 2)
    for seconds in (0.0, 1e-3, _LONGEST):
        points = bench.wave(4)
        points[0] = (points[0][0], seconds)
        _taken(bench, points, f"a first duration of {seconds:g} s")
    for seconds, reason in ((-1.0, RawReason.BAD_DURATION), (math.nan, RawReason.NOT_FINITE)):
        points = bench.wave(4)
        points[0] = (points[0][0], seconds)
        refused(bench, bench.download(points), [reason], 0, 0)


@case("shortest-segment", "the shortest segment, and a short last one", "R9")
def _shortest_segment(bench: Bench) -> None:
    shortest = bench.config.trajectory.min_segment
    if shortest < 0.005 or bench.config.trajectory.too_fast != "refuse":
        raise NotApplicable("`min_segment` refuses no segment")
    points = bench.wave(4, size=0.001)
    points[1] = points[2] = (points[1][0], shortest * 1.001)
    _taken(bench, [points[0], (points[1][0], shortest * 1.001), points[3]], "the shortest segment")
    for index in (1, 2):
        points = bench.wave(4, size=0.001)
        points[index] = (points[index][0], shortest * 0.99)
        refused(bench, bench.download(points), [RawReason.SEGMENT_TOO_SHORT], 0, index)
    # The last segment has no successor that must be planned in time.
    points = bench.wave(4, size=0.001)
    points[3] = (points[3][0], shortest / 2)
    _taken(bench, points, "a short last segment")


@case("fastest", "each axis at its speed and above", "R10")
def _fastest(bench: Bench) -> None:
    if bench.config.trajectory.too_fast != "refuse" or bench.group.tcp_speed_limit < 5:
        raise NotApplicable("axes are not refused for their speed alone")
    for axis, joint in enumerate(bench.group.joints):
        seconds = max(0.2, bench.config.trajectory.min_segment)
        space = max(joint.upper - bench.position[axis], bench.position[axis] - joint.lower)
        if space < 1.1 * seconds * joint.speed:
            continue
        current = bench.position
        for share in (0.995, 1.05):
            target = changed(current, axis, _inward(bench, axis, share * seconds * joint.speed))
            points = [(current, 10.0), (target, seconds), (target, 1.0)]
            if share < 1:
                _taken(bench, points, f"joint {axis + 1} at its speed")
                link = bench.motion()
                bench.assert_moves_through(link, bench.way_to(current))
                link.close(then=1.2)
            else:
                refused(bench, bench.download(points), [RawReason.TOO_FAST], axis + 1, 1)


@case("rounding", "limits as rounding leaves them, and farther")
def _limits_by_rounding(bench: Bench) -> None:
    """Accept values outside a limit by rounding; reject values farther off."""
    link = bench.motion()
    for axis, joint in enumerate(bench.group.joints):
        unit = small_unit(joint)
        for limit, side in ((joint.lower, -1), (joint.upper, 1)):
            current = bench.position
            seconds = bench.seconds_to(changed(current, axis, limit))
            expected = changed(current, axis, limit + side * 0.0003 * unit)
            link.send(bench.download([(current, 10.0), (expected, seconds), (expected, 0.5)]))
            bench.wait_until_at(changed(current, axis, limit), 20 + 4 * seconds)
            link.send(bench.download([(bench.position, 10.0), (current, seconds), (current, 0.5)]))
            bench.wait_until_at(current, 20 + 4 * seconds)
            expected = changed(current, axis, limit + side * 0.0012 * unit)
            frames = bench.download([(current, 10.0), (expected, seconds), (expected, 0.5)])
            link.send(frames)
            bench.assert_at_rest(1, f"joint {axis + 1} was asked beyond its limit")


@case("start-tolerance", "a start within tolerance is driven to, one beyond is refused", "R8")
def _start_tolerance(bench: Bench) -> None:
    policy = bench.config.trajectory
    for axis, joint in enumerate(bench.group.joints):
        near = bench.start_tolerance(joint)
        if near <= 0:
            continue
        start = changed(bench.position, axis, _inward(bench, axis, 0.97 * near))
        end = changed(start, axis, _inward(bench, axis, 0.97 * near + 0.02 * joint.speed))
        # The driver ignores the first point's duration: after the previous trajectory's last point,
        # a stamp gives a short one.
        link, since = bench.motion(), bench.now
        link.send(bench.download([(start, 10.0 if axis % 2 else 1e-3), (end, 0.5), (end, 0.5)]))
        bench.wait_until_at(end, 30)
        _slow_to(bench, start, since, policy.approach_speed * joint.speed)
        link.close(then=1.2)
        start = changed(bench.position, axis, _inward(bench, axis, 1.03 * near))
        end = changed(start, axis, _inward(bench, axis, 1.03 * near + 0.02 * joint.speed))
        frames = bench.download([(start, 10.0), (end, 0.5), (end, 0.5)])
        refused(bench, frames, [RawReason.START_TOO_FAR], axis + 1, 0)


def _slow_to(bench: Bench, start: Position, since: float, speed: float) -> None:
    """Check that the robot reached its first point at approach speed at most."""
    for (t1, one), (t2, two) in pairwise([(t, p) for t, p in bench.track if t >= since]):
        if distance(one, two) > 1.5 * speed * (t2 - t1) + 1e-4:
            raise CheckFailed(
                f"on the way to the first point the robot was faster than {speed:.3f}/s"
            )
        if distance(two, start) < SETTLED:
            return
    raise CheckFailed("the first point was left out")


def _moved(bench: Bench, since: float) -> tuple[float, float]:
    """Return the times of the first and the last movement."""
    start = bench.track_at(since)
    times = [t for t, p in bench.track if t > since and distance(p, start) > SETTLED]
    changes = [t for t, _ in bench.track if t > since]
    if not times:
        raise CheckFailed("the robot has not moved")
    return times[0], changes[-1]


@case("takes-its-time", "motion and stays last as long as asked", "R8, R10")
def _takes_its_time(bench: Bench) -> None:
    """Check that a trajectory takes the sum of its durations, with stays."""
    first, second, third, fourth = bench.wave(4, duration=0.5)
    for points, stands in (
        ([first, second, third, fourth], ()),
        ([first, second, (second[0], 1.5), third], (1,)),
        ([first, (first[0], 1.5), second, third], (0,)),
        ([first, second, third, (third[0], 0.8)], ()),
        ([first, second, (second[0], 0.4), (second[0], 0.9), third], (1,)),
    ):
        link, since = bench.motion(), bench.now
        link.send(bench.download(points))
        bench.wait_until_at(points[-1][0], 30)
        bench.run(2)
        started, finished = _moved(bench, since)
        moving = sum(d for _, d in points[1:])
        if points[-1][0] == points[-2][0]:
            moving -= points[-1][1]
        if points[0][0] == points[1][0]:
            moving -= points[1][1]
            if started - since < points[1][1]:
                raise CheckFailed(f"the robot left its first point after {started - since:.2f} s")
        if not 0.85 * moving - 0.05 <= finished - started <= 1.15 * moving + 0.25:
            raise CheckFailed(f"{moving:.2f} s of motion took {finished - started:.2f} s")
        for index in stands:
            if index and not _stood_at(bench, points[index][0], since, 0.8 * points[index + 1][1]):
                raise CheckFailed(f"the robot did not stay at point {index}")
        bench.run(1)
        link.send(bench.download([(bench.position, 10.0), (first[0], 2.0), (first[0], 0.5)]))
        bench.wait_until_at(first[0], 30)
        link.close(then=1.2)


def _stood_at(bench: Bench, place: Position, since: float, seconds: float) -> bool:
    """True if the record has a stay at a place.

    The record holds a position when it changes.
    """
    seen = [(t, p) for t, p in bench.track if t > since]
    arrived = [i for i, (_, p) in enumerate(seen) if distance(p, place) < SETTLED]
    return any(i + 1 < len(seen) and seen[i + 1][0] - seen[i][0] >= seconds - 0.2 for i in arrived)


@case("stop-in-stay", "STOP while the robot stays at a point")
def _stop_in_a_stay(bench: Bench) -> None:
    link = bench.motion()
    first, second, third = bench.wave(3)
    link.send(bench.download([first, second, (second[0], 20.0), third]))
    bench.wait_until_at(second[0])
    bench.run(1)
    link.stop(1, "STOP in a stay is answered")
    bench.assert_at_rest(25, "it was stopped in a stay")
    bench.assert_moves_through(link, bench.wave(3))


@case("approach", "a single point is approached slowly, or as slowly as asked", "R8")
def _approach(bench: Bench) -> None:
    """Send one point twice: approach speed, or the given time if longer."""
    link, policy = bench.motion(), bench.config.trajectory
    for axis, joint in enumerate(bench.group.joints):
        step = 0.9 * bench.start_tolerance(joint)
        if not step:
            continue
        for seconds in (0.02, 1.0):
            needed = max(policy.min_segment, step / (policy.approach_speed * joint.speed))
            target = changed(bench.position, axis, _inward(bench, axis, step))
            since = bench.now
            link.send(point_frame(0, 2, target, seconds) + point_frame(1, 2, target, seconds))
            bench.wait_until_at(target, 60)
            started, finished = _moved(bench, since)
            expected = max(needed, seconds)
            if not 0.8 * expected - 0.1 <= finished - started <= 1.3 * expected + 0.3:
                raise CheckFailed(
                    f"joint {axis + 1}: {step:.4f} rad (m) in {seconds:.2f} s, or at approach "
                    f"speed in {needed:.2f} s, took {finished - started:.2f} s"
                )
            bench.run(0.2)


@case("all-sizes", "messages in pieces of every size", "R2")
def _pieces_of_all_sizes(bench: Bench) -> None:
    link = bench.motion()
    current = bench.position
    for size in (2, 3, 4, 5, 15, 16, 17, 20, 63, 64, 66, 67, 68, 69, 72, 84, 135, 136, 137, 271):
        points = [(p, 0.2) for p, _ in bench.wave(5, duration=0.2, size=0.01)]
        points[-1] = (current, 0.4)
        ping = b"\x0c\0\0\0\x01\0\0\0\x02\0\0\0\0\0\0\0"
        data = ping + bench.download(points) + ping
        since = bench.now
        for at in range(0, len(data), size):
            link.send(data[at : at + size])
            bench.run(0.002)
        for _ in range(2):
            link.expect_reply(2, f"PING in pieces of {size} bytes is answered")
        bench.run(0.5)
        bench.wait_until_at(current, 20)
        bench.followed([current, *(p for p, _ in points)], since=since)
        _moved(bench, since)


@case("in-one-chunk", "messages across the driver's calls", "R2")
def _in_one_chunk(bench: Bench) -> None:
    """Send more than one read call of the driver, with points across calls."""
    link = bench.motion()
    for count in (14, 15, 16, 30, 46):
        bench.assert_moves_through(link, bench.wave(count, duration=0.15, size=0.02))


@case("rest-skipped", "the rest of a refused trajectory is nothing")
def _rest_is_skipped(bench: Bench) -> None:
    link = bench.motion()
    points = [(p, 30.0) for p, _ in bench.wave(6)]
    points[2] = (changed(points[2][0], 0, bench.group.joints[0].upper + 1), 30.0)
    frames = [point_frame(n, 6, *point) for n, point in enumerate(points)]
    state = bench.watcher()
    link.send(b"".join(frames[:4]))
    bench.run(0.5)
    number = bench.progress(state).trajectory
    link.send(frames[4])
    bench.assert_at_rest(0.5, "a refused trajectory goes on")
    _expect_reason(bench, state, number, RawReason.JOINT_LIMIT)
    # A new start ends the skipping, and the rejected trajectory's end does too.
    good = bench.wave(4)
    bench.assert_moves_through(link, good)
    link.send(b"".join(frames))
    bench.assert_at_rest(0.5, "it was refused")
    _expect_reason(bench, state, number + 2, RawReason.JOINT_LIMIT)
    link.send(raw_point(1, bench.position, 1.0))
    bench.assert_at_rest(0.5, "it has no start")
    _expect_reason(bench, state, number + 3, RawReason.NO_START)
    link.send(raw_point(int(RawSpecial.END), bench.position, 1.0))
    bench.run(0.5)
    bench.assert_moves_through(link, bench.wave(4))
    for wrong in (-2, -5, 2, 1000):
        link.send(raw_point(-1, bench.position, 1.0) + raw_point(wrong, bench.position, 1.0))
        bench.assert_at_rest(0.4, f"number {wrong} is no next one")
        link.send(raw_point(int(RawSpecial.END), bench.position, 1.0))
        bench.run(0.3)
        if bench.progress(state).reason != RawReason.SEQUENCE_GAP:
            raise CheckFailed(f"number {wrong} after a start is taken")


def _expect_reason(bench: Bench, state: RawLink, number: int, reason: RawReason) -> None:
    bench.run(0.3)
    reply = bench.progress(state)
    if (reply.trajectory, reply.state, reply.reason) != (
        number,
        RawTrajectoryState.REFUSED,
        reason,
    ):
        raise CheckFailed(f"trajectory {number} had to be refused with {reason.name}, {reply}")


@case("replies-of-refused", "replies tell what became of the trajectory so far")
def _replies_of_a_refused_one(bench: Bench) -> None:
    """Reply to each request with the state of the trajectory so far."""
    link = bench.motion()
    points = [(p, 30.0) for p, _ in bench.wave(6)]
    points[3] = (changed(points[3][0], 1, bench.group.joints[1].upper + 1), 30.0)
    for number, point in enumerate(points):
        link.send(point_frame(number, 6, *point, RawComm.REQUEST))
        content = decode(link.expect_reply(2, f"point {number} is answered"))
        if number < 3 and not isinstance(content, messages.RawAcknowledged):
            raise CheckFailed(f"point {number} is right, the reply is {content}")
        if number >= 3 and content != messages.RawRefused(RawReason.JOINT_LIMIT, 3, 2):
            raise CheckFailed(f"point 3 was wrong, the reply to point {number} is {content}")
    # After a rejection at the end, the driver has nothing to skip.
    axis, current = 0, bench.position
    far = changed(current, axis, _inward(bench, axis, 0.3))
    link.send(point_frame(0, 2, far, 9.0) + point_frame(1, 2, current, 9.0))
    link.send(raw_point(1, current, 1.0, RawComm.REQUEST))
    content = decode(link.expect_reply(2, "a point after a refused end is answered"))
    if not isinstance(content, messages.RawRefused) or content.reason != RawReason.NO_START:
        raise CheckFailed(f"a point after a refused end is answered by {content}")
    link.send(raw_point(int(RawSpecial.END), current, 1.0))
    bench.run(0.5)
    state = bench.watcher()
    number = bench.progress(state).trajectory
    good = bench.wave(3)
    for index, point in enumerate(good):
        link.send(point_frame(index, 3, *point, RawComm.REQUEST))
        content = decode(link.expect_reply(3, f"point {index} is answered"))
    if content != messages.RawAccepted(number + 1):
        raise CheckFailed(f"trajectory {number + 1} was taken, the reply is {content}")
    bench.wait_until_at(good[-1][0])
