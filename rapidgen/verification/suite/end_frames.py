"""End frame: hand-over of a trajectory, and the timing of its motion."""

import math
from itertools import pairwise

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawReason, RawSpecial, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import (
    SETTLED,
    Point,
    Position,
    changed,
    distance,
    inward,
)
from rapidgen.verification.suite.points import Table
from rapidgen.verification.testbench import CEILING, Bench

case = SuiteGroup("taking")

_BEGIN, _END = int(RawSpecial.BEGIN), int(RawSpecial.END)
_TAKEN = messages.RawAcknowledged()
_NO_START = messages.RawRefused(RawReason.NO_START, 0, 0)


def _inward(bench: Bench, steps: Position) -> Position:
    """Return each axis' step with the sign of the larger distance to a limit."""
    return tuple(
        inward(joint, current, step)
        for joint, current, step in zip(bench.group.joints, bench.position, steps, strict=True)
    )


def _approach(bench: Bench, steps: Position) -> float:
    """Return s of the motion to a first point at approach speed."""
    policy, joints = bench.config.trajectory, bench.group.joints
    by_axis = (s / (policy.approach_speed * j.speed) for s, j in zip(steps, joints, strict=True))
    return max(policy.min_segment, *by_axis)


def _from_rest(bench: Bench, steps: Position) -> float:
    """Return the minimum s from rest to rest: half the distance each ramp."""
    joints = zip(steps, bench.group.joints, strict=True)
    ramps = (2 * math.sqrt(step / joint.acceleration) for step, joint in joints)
    return max(ramps) + bench.setting.motion.ramp_time


def _slack(bench: Bench) -> float:
    """Return s by which a motion may start later or last longer."""
    return 0.03 + 0.02 * bench.setting.slowness


def _in_time(bench: Bench, what: str, seen: float, expected: float, possible: float = 0.0) -> None:
    """Check that a duration is as requested, or as possible if longer."""
    motion = bench.setting.motion
    late = _slack(bench) + motion.settle + motion.servo_lag
    if not 0.95 * expected - 0.02 <= seen <= max(expected, possible) + late:
        raise CheckFailed(f"{what} took {seen:.3f} s, not {expected:.3f} s")


def _times(bench: Bench, since: float, place: Position) -> tuple[float, float]:
    """Return when the robot came to a place and left it (now: not yet)."""
    track = [(t, p) for t, p in bench.track if t >= since]
    arrived = next((i for i, (_, p) in enumerate(track) if distance(p, place) < SETTLED), None)
    if arrived is None:
        raise CheckFailed(f"the robot was not at {place}")
    for (left, _), (_, after) in pairwise(track[arrived:]):
        if distance(after, place) >= SETTLED:
            return track[arrived][0], left
    return track[arrived][0], bench.now


def _done(bench: Bench, table: Table, count: int, seconds: float) -> None:
    """Check that PROGRESS reports all points as executed within that time."""
    expected = (table.number, RawTrajectoryState.DONE, count, count, count, 0, -1, 0)
    table.watcher.read()
    more = 2.5 * bench.config.state_period + 2 * bench.setting.motion.settle
    until, reply = bench.now + seconds + more, None
    while bench.now < until:
        reply = table.watcher.expect(messages.RawProgress, 2, "a PROGRESS arrives")
        if reply == expected:
            return
    raise CheckFailed(f"{count} points are executed, PROGRESS says {reply}")


@case("one-place", "one point, sent twice, in its time", "R8")
def _one_place(bench: Bench) -> None:
    """Send one point twice: given time or approach speed, whichever is longer."""
    table, joints = Table(bench), bench.group.joints
    for part, given in ((0.9, 0.05), (0.9, 0.8), (0.5, 0.05), (0.0, 0.4)):
        steps = tuple(part * bench.start_tolerance(joint) for joint in joints)
        target = _inward(bench, steps)
        needed = _approach(bench, steps) if any(steps) else 0.0
        # From rest to rest, and below the TCP's speed limit.
        needed = max(needed, 2 * bench.tcp_seconds(bench.position, target))
        table.row(_BEGIN, target, given, _TAKEN)
        table.accepted(target, given)
        since = bench.now
        table.ask()
        if bench.now - since > 0.2:
            raise CheckFailed(f"the end frame was answered after {bench.now - since:.2f} s")
        bench.wait_until_at(target, 5)
        if needed:
            took = bench.now - since
            possible = _from_rest(bench, steps)
            _in_time(bench, "a point that was sent twice", took, max(needed, given), possible)
        # The point is a target, not a stay.
        _done(bench, table, 2, 0.1 if needed else given + 0.1)


@case("start-and-ways", "where a trajectory may begin; ways and stays in their time", "R8, R10")
def _start(bench: Bench) -> None:
    """Start off the first point, within its tolerance.

    Later segments and stays keep their times.
    """
    table, joints = Table(bench), bench.group.joints
    near = tuple(map(bench.start_tolerance, joints))
    # A position without an axis at zero.
    target = _inward(bench, tuple(4 * n for n in near))
    table.row(_BEGIN, bench.position, 0.1, _TAKEN)
    table.accepted(target, bench.seconds_to(target))
    table.ask()
    bench.wait_until_at(target, 5)
    bench.wait_until_standing()
    if min(near) > 0:
        beyond = _inward(bench, tuple(1.03 * n for n in near))
        for axis in range(len(joints)):
            far = messages.RawRefused(RawReason.START_TOO_FAR, 0, axis + 1)
            start = (*target[:axis], *beyond[axis:])
            table.row(_BEGIN, start, 9.0, _TAKEN)
            table.row(_END, target, 9.0, far)
            alone = changed(target, axis, beyond[axis])
            table.row(_BEGIN, alone, 9.0, _TAKEN)
            table.row(1, alone, 9.0, _TAKEN)
            table.row(_END, target, 9.0, far)
        table.number += 1
        table.row(1, target, 9.0, _NO_START)
        table.ask()
        bench.assert_at_rest(0.1, "the first point was too far")
    _ways(bench, table, near)


def _ways(bench: Bench, table: Table, near: Position) -> None:
    policy = bench.config.trajectory
    short = max(0.3, 1.05 * policy.min_segment)
    for last in (True, False):
        current = bench.position
        start = _inward(bench, tuple(-0.97 * n for n in near))
        one, two, three = (p for p, _ in bench.wave(4, duration=short, size=0.03)[1:])
        points: list[Point] = [(start, 9.0), (one, short), (one, 0.5), (two, short)]
        points += [(three, short + 0.1), (three, 0.4)][: 2 if last else 1]
        for number, (place, seconds) in enumerate(points[:-1]):
            table.row(number or _BEGIN, place, seconds, _TAKEN)
        table.accepted(*points[-1])
        since = bench.now
        table.ask()
        bench.wait_until_at(points[-1][0], 10)
        _done(bench, table, len(points), 0.4 if last else 0.0)
        finished = bench.now
        if bench.setting.motion.servo_lag or bench.group.tcp_speed_limit < CEILING:
            # An axis that follows late does not quite reach a place without a stay. With a TCP
            # speed limit, segments from and to rest may take longer.
            continue
        started = _times(bench, since, current)[1]
        at_start = _times(bench, since, start)[0]
        if min(near) > 0:
            needed = _approach(bench, tuple(0.97 * n for n in near))
            _in_time(bench, "the way to the first point", at_start - started, needed)
        arrived, left = _times(bench, at_start, one)
        _in_time(bench, "the first way", arrived - at_start, short)
        _in_time(bench, "a stay", left - arrived, 0.5)
        ended = _times(bench, left, three)[0]
        _in_time(bench, "the ways after a stay", ended - left, 2 * short + 0.1)
        if last and finished < ended + 0.3:
            raise CheckFailed("a stay at the end was left out")


@case("not-now", "an end frame while no motion is possible, or another one moves", "R7a")
def _not_now(bench: Bench) -> None:
    """Reject with the event that stops the robot; wait for a halt."""
    table, current = Table(bench), bench.position

    def refused(reason: RawReason) -> None:
        table.row(_END, current, 9.0, messages.RawRefused(reason, -1, 0))
        table.number += 1
        table.row(1, current, 9.0, _NO_START)
        table.ask()

    if bench.group.ports.control:
        control = bench.control()
        for _ in range(2):
            table.row(_BEGIN, current, 9.0, _TAKEN)
            table.row(1, current, 9.0, _TAKEN)
            table.ask()
            table.stop(control)
            refused(RawReason.STOPPED)
    stops = (("stop", RawReason.NOT_EXECUTING), ("e-stop", RawReason.EMERGENCY_STOP))
    # While commissioning the driver stops with the program, and sends no reply.
    for action, reason in () if bench.config.commissioning else stops:
        table.row(_BEGIN, current, 9.0, _TAKEN)
        table.ask()
        bench.controller.perform(action)
        # Sooner than the next periodic look.
        bench.run(0.01)
        refused(reason)
        bench.start_again()
        bench.run(0.5)
    bench.assert_at_rest(0.2, "nothing was handed over")
    _while_moving(bench, table)


def _while_moving(bench: Bench, table: Table) -> None:
    """Replace a trajectory: wait for its halt, no longer than needed."""
    joint, current = bench.group.joints[0], bench.position
    step = 0.8 * max(joint.upper - current[0], current[0] - joint.lower)
    away = _inward(bench, (step, *[0.0] * (len(current) - 1)))
    # A TCP with its own speed limit is slower than the axis.
    slower = 1.1 if bench.group.tcp_speed_limit >= 5 else 14
    seconds = slower * step / joint.speed
    table.row(_BEGIN, current, 9.0, _TAKEN)
    table.accepted(away, seconds)
    table.ask()
    bench.wait_until_moving()
    bench.run(0.6 * seconds)
    # The new trajectory starts elsewhere.
    far = messages.RawRefused(RawReason.START_TOO_FAR, 0, 1)
    for number, expected in ((_BEGIN, _TAKEN), (_END, far)):
        table.row(number, current, 0.2, expected)
    since = bench.now
    table.ask()
    halted = bench.now
    if not since + 0.02 < halted < since + 0.9 + bench.setting.motion.settle:
        raise CheckFailed(f"a trajectory under way was halted in {halted - since:.3f} s")
    bench.wait_until_standing(5)
    bench.followed([current, away], since=since - 0.6 * seconds)
    bench.assert_moves_through(table.link, bench.way_to(current))


def _long(bench: Bench, count: int) -> list[Point]:
    """Return `count` points in little time; more than the ring holds."""
    seconds = max(0.1, 1.02 * bench.config.trajectory.min_segment)
    return [(p, seconds) for p, _ in bench.wave(count, duration=seconds, size=0.02)]


@case("fed", "more points than the ring takes", "R1")
def _fed(bench: Bench) -> None:
    """Execute more points than the ring holds, in time.

    The server keeps reading.
    """
    policy = bench.config.trajectory
    if policy.capacity < policy.ring + 25:
        raise NotApplicable("a whole trajectory fits into the ring")
    table, points, since = Table(bench), _long(bench, policy.ring + 25), bench.now
    table.number += 1
    table.link.send(bench.download(points))
    bench.wait_until_moving(1)
    for silence in (0.1, 0.1, 1.25):
        bench.run(silence)
        if not isinstance(table.link.ask(messages.RawPing(), 0.05), messages.RawAcknowledged):
            raise CheckFailed("PING is not confirmed while a trajectory is fed")
    requested = sum(d for _, d in points[1:])
    bench.wait_until_at(points[-1][0], requested + 5)
    # How closely axes follow dense points depends on their accelerations.
    if bench.now - since > 1.4 * requested + 1:
        raise CheckFailed(
            f"{requested:.2f} s of {len(points)} points took {bench.now - since:.2f} s"
        )
    _done(bench, table, len(points), 0.1)
    bench.executed(points, since)


@case("ends-while-fed", "the end of a trajectory that is still fed", "R5", background=True)
def _ends_while_fed(bench: Bench) -> None:
    """End a trajectory while it is fed: waiting points never execute."""
    policy = bench.config.trajectory
    if policy.capacity < policy.ring + 60:
        raise NotApplicable("a whole trajectory fits into the ring")
    table, points = Table(bench), _long(bench, policy.ring + 60)
    link, data = table.link, bench.download(points)
    for action in ("STOP", "stop", "another"):
        since, start = bench.now, bench.position
        # From the stop position to the start of the path.
        table.number += 2
        link.send(bench.download(bench.way_to(points[0][0])))
        bench.wait_until_at(points[0][0], 5)
        bench.wait_until_standing()
        link.send(data)
        bench.wait_until_moving(2)
        bench.run(0.7)
        if action == "STOP":
            table.stop()
        elif action == "another":
            break
        else:
            bench.controller.perform(action)
        bench.wait_until_standing(3)
        bench.followed([start, *(p for p, _ in points)], since=since)
        bench.controller.perform("start")
        bench.assert_at_rest(1, f"a long trajectory was ended by {action}")
    goal = changed(points[0][0], 0, inward(bench.group.joints[0], points[0][0][0], 0.3))
    far = messages.RawRefused(RawReason.START_TOO_FAR, 0, 1)
    for sequence, expected in ((_BEGIN, _TAKEN), (_END, far)):
        table.row(sequence, goal, 0.3, expected)
    table.ask()
    # Axes may follow late.
    bench.wait_until_standing(1)
    bench.assert_at_rest(0.3, "the one before was superseded")
