"""Trajectories that are rejected as a whole, before any motion."""

import math
from collections.abc import Sequence

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point
from rapidgen.verification.raw_connection import point_frame, raw_point
from rapidgen.verification.testbench import Bench

case = SuiteGroup("refused")


def refused(
    bench: Bench,
    frames: bytes,
    reasons: Sequence[RawReason],
    joint: int = 0,
    point: int | None = None,
) -> None:
    """Check that nothing moves, and STATUS and PROGRESS give a reason.

    If `joint` (from 1) and `point` (from 0, -1: none) are given, they are reported too.
    """
    state, link = bench.watcher(), bench.motion()
    link.send(frames)
    # The controller has read all of it by then.
    bench.assert_at_rest(
        3 * bench.setting.slowness, f"it had to be refused: {messages.text_of(reasons[0])}"
    )
    status, reply = bench.status(state), bench.progress(state)
    reason, wrong = messages.split_error_code(status.error_code)
    if status.in_error != 1 or reason not in reasons or (joint and wrong != joint):
        names = " or ".join(r.name for r in reasons)
        raise CheckFailed(
            f"wanted in_error with {names}{f' of joint {joint}' if joint else ''}, STATUS says "
            f"in_error {status.in_error}, error_code {status.error_code}"
        )
    if (reply.state, reply.reason, reply.joint) != (RawTrajectoryState.REFUSED, reason, wrong):
        raise CheckFailed(f"STATUS says error_code {status.error_code}, PROGRESS {reply}")
    if point == 0 and reason != RawReason.START_TOO_FAR and reply.received:
        raise CheckFailed(f"the first point had to be refused, PROGRESS says {reply}")
    if point is not None and reply.point != point:
        raise CheckFailed(f"point {point} had to be named, PROGRESS says {reply}")
    # A rejection is over with the next good trajectory.
    bench.assert_moves_through(link, bench.wave(3))
    bench.run(0.5)
    if bench.status(state).in_error != 0:
        raise CheckFailed("in_error stays after a good trajectory")
    state.close()
    link.close(then=0.5)


def _changed(points: Sequence[Point], index: int, joints: Sequence[float]) -> list[Point]:
    changed = list(points)
    changed[index] = (tuple(joints), changed[index][1])
    return changed


@case("too-many-points", "one point over the capacity: nothing moves", "R1")
def _too_many(bench: Bench) -> None:
    capacity = bench.config.trajectory.capacity
    frames = bench.download(bench.wave(capacity + 1, duration=0.2, size=0.01))
    refused(bench, frames, [RawReason.CAPACITY], point=capacity)


@case("hole", "a missing point: nothing moves", "C4")
def _hole(bench: Bench) -> None:
    points = bench.wave(8)
    for missing in (1, 4, 6):
        frames = b"".join(
            point_frame(n, len(points), *point) for n, point in enumerate(points) if n != missing
        )
        # Without point N-2 the end frame comes one early, which the driver cannot detect.
        if missing < len(points) - 2:
            refused(bench, frames, [RawReason.SEQUENCE_GAP], point=missing)


@case("twice", "a point that comes twice: nothing moves")
def _twice(bench: Bench) -> None:
    points = bench.wave(6)
    frames = [point_frame(n, len(points), *point) for n, point in enumerate(points)]
    refused(
        bench, b"".join([*frames[:3], frames[2], *frames[3:]]), [RawReason.SEQUENCE_GAP], point=3
    )


@case("not-finite", "NaN and infinity in any joint")
def _not_finite(bench: Bench) -> None:
    for value in (math.nan, math.inf, -math.inf):
        for axis in range(len(bench.position)):
            points = bench.wave(4)
            joints = [*points[2][0][:axis], value, *points[2][0][axis + 1 :]]
            refused(
                bench,
                bench.download(_changed(points, 2, joints)),
                [RawReason.NOT_FINITE],
                axis + 1,
                point=2,
            )


@case("duration-not-finite", "NaN, infinite and negative durations", "R10")
def _duration_not_finite(bench: Bench) -> None:
    for value in (math.nan, math.inf, -1.0):
        points = bench.wave(4)
        points[2] = (points[2][0], value)
        refused(bench, bench.download(points), [RawReason.NOT_FINITE, RawReason.BAD_DURATION])


@case("outside-limits", "a joint outside its limits", "R11")
def _outside_limits(bench: Bench) -> None:
    for axis, joint in enumerate(bench.group.joints):
        for value in (joint.lower - 0.01, joint.upper + 0.01):
            points = bench.wave(4, duration=5.0)
            joints = [*points[2][0][:axis], value, *points[2][0][axis + 1 :]]
            longer = [(p, 60.0) for p, _ in _changed(points, 2, joints)]
            refused(bench, bench.download(longer), [RawReason.JOINT_LIMIT], axis + 1, 2)


@case("start-too-far", "a first point too far from the robot", "R8")
def _start_too_far(bench: Bench) -> None:
    points = bench.wave(4)
    for axis, joint in enumerate(bench.group.joints):
        current = bench.position
        near = bench.start_tolerance(joint)
        away = current[axis] + (
            1.5 * near if current[axis] + 2 * near < joint.upper else -1.5 * near
        )
        start = (*current[:axis], away, *current[axis + 1 :])
        points = [(start, 10.0), *bench.wave(4)[1:]]
        refused(bench, bench.download(points), [RawReason.START_TOO_FAR], axis + 1, 0)


@case("too-fast", "a duration that an axis cannot meet", "R10")
def _too_fast(bench: Bench) -> None:
    if bench.config.trajectory.too_fast != "refuse":
        raise NotApplicable("`too_fast` slows down")
    for axis, joint in enumerate(bench.group.joints):
        current = bench.position
        seconds = max(0.2, bench.config.trajectory.min_segment)
        step = 1.2 * seconds * joint.speed
        if current[axis] + step > joint.upper:
            step = -step
        if current[axis] + step < joint.lower:
            continue
        target = (*current[:axis], current[axis] + step, *current[axis + 1 :])
        points = [(current, 10.0), (target, seconds), (target, 1.0)]
        refused(
            bench, bench.download(points), [RawReason.TOO_FAST, RawReason.TCP_TOO_FAST], axis + 1, 1
        )


@case("segment-too-short", "a segment that the planner cannot follow", "R9")
def _segment_too_short(bench: Bench) -> None:
    shortest = bench.config.trajectory.min_segment
    if bench.config.trajectory.too_fast != "refuse" or shortest < 0.005:
        raise NotApplicable("`min_segment` refuses no segment")
    points = bench.wave(5, size=0.001)
    points[2] = (points[2][0], shortest / 2)
    refused(bench, bench.download(points), [RawReason.SEGMENT_TOO_SHORT], point=2)


@case("padding", "values for joints that the robot does not have")
def _padding(bench: Bench) -> None:
    count = len(bench.position)
    for extra in range(count, messages.MAX_JOINTS):
        points = bench.wave(3)
        padded = [
            raw_point(s, [*p, *[0.0] * (extra - count), 0.5], d)
            for s, (p, d) in zip((-1, 1, -3), points, strict=True)
        ]
        refused(bench, b"".join(padded), [RawReason.BAD_PADDING], extra + 1, 0)


@case("no-end", "without an end frame nothing moves")
def _no_end(bench: Bench) -> None:
    points = bench.wave(5)
    link = bench.motion()
    link.send(bench.download(points)[: -(messages.POINT_BYTES - 4) - 4])
    bench.assert_at_rest(5, "its end frame has not come")


@case("reasons", "a request's reply has reason, point and joint")
def _requests_get_reason(bench: Bench) -> None:
    link = bench.motion()
    points = bench.wave(4)
    joints = (bench.group.joints[0].upper + 0.5, *points[2][0][1:])
    points = [(p, 30.0) for p, _ in _changed(points, 2, joints)]
    replies = []
    for number, (target, duration) in enumerate(points):
        link.send(point_frame(number, len(points), target, duration, RawComm.REQUEST))
        replies.append(link.expect_reply(2, f"point {number} is answered"))
    content = messages.decode(replies[-1])
    if not isinstance(content, messages.RawRefused) or content.reason != RawReason.JOINT_LIMIT:
        raise CheckFailed(f"the reply to the end frame is {content}")
    if (content.point, content.joint) != (2, 1):
        raise CheckFailed(f"the reply names point {content.point}, joint {content.joint}")
    bench.assert_at_rest(2, "it was refused")
