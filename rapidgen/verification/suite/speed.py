"""SPEED: never faster than requested, and not slowed down twice.

SpeedRefresh slows down ordered moves; later moves get more time. SpeedRefresh may have no effect.
"""

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rapidgen.axes.frames import Pose, slerp
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call
from rapidgen.verification.messages import RawComm, RawInstruction, RawReason
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.path_deviation import farthest, points
from rapidgen.verification.position_checks import Point, Position, changed, distance, inward
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import Programmer, RawMove, computes, orders, reached
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.suite.control import done, not_done
from rapidgen.verification.suite.motion_task import begins, soon, unit_of
from rapidgen.verification.testbench import Bench

case = SuiteGroup("speed", needs="control")

RATE = 0.08
"""rad/s or m/s of the observed axis."""
_TICK = 0.1
"""s between two SpeedRefresh of the driver, the minimum of ITimer."""
LONG = 0.25
"""s of a move that the driver slows down by SpeedRefresh."""
_RAMPS = 0.15
"""s in which the axis has reached another speed."""

_PEAK = 1.4
"""A short move that ends at a standstill is faster in its middle than on average ..."""
_MOMENT = 0.05
"""... and for so many s much faster."""


def straight(bench: Bench, count: int, seconds: float) -> list[Point]:
    """Return points on a straight path of the first axis, at equal speed."""
    current, joint = bench.position, bench.group.joints[0]
    step = inward(joint, current[0], RATE * seconds) - current[0]
    return [
        (current, 10.0),
        *((changed(current, 0, current[0] + n * step), seconds) for n in range(1, count)),
    ]


def _slow(bench: Bench) -> float:
    """Return s from a request or timer to SpeedRefresh."""
    return soon(bench) + bench.setting.latest_interrupt


def paces(bench: Bench, since: float, rate: float) -> list[tuple[float, float, float]]:
    """Return intervals with the axis' speed as a share of its normal one."""
    track = [(when, seen[0]) for when, seen in bench.track if when >= since]
    return [
        (when, then, abs(b - a) / (then - when) / rate)
        for (when, a), (then, b) in pairwise(track)
        if then > when
    ]


def as_asked(
    bench: Bench,
    since: float,
    percent: float,
    seconds: float,
    stops: int = 2,
    rate: float | None = None,
) -> None:
    """Check that the axis was never faster than requested, or long too slow.

    `seconds`: duration of a move at the previous speed. `stops`: number of stops. `rate`: of the
    axis in moves without a time of their own.
    """
    requested, seen = percent / 100, paces(bench, since, RATE if rate is None else rate)
    lag = bench.setting.motion.servo_lag
    ordered = 2 * seconds + bench.setting.motion.planning_lead + _slow(bench) + lag
    acts = rate is not None or (seconds > LONG and bench.setting.motion.refresh_timed)
    # Each ordered move may start at its ordered speed, until a timer expires.
    most = _TICK + _slow(bench) + _RAMPS + lag if acts else ordered
    last = since + (ordered / requested if acts else ordered) + most
    fast = 0.0
    for when, then, pace in seen:
        fast = fast + then - when if pace > _PEAK * requested else 0.0
        if fast > most or (fast > _MOMENT and then > last):
            raise CheckFailed(
                f"{then - since:.2f} s after SPEED {percent:g} the robot is at {100 * pace:.0f} % "
                f"of its speed, for {fast:.2f} s"
            )
    slow = sum(then - when for when, then, pace in seen if pace < 0.75 * requested)
    at_rest = _RAMPS + _slow(bench) + _TICK + bench.setting.motion.settle + lag
    if slow > stops * at_rest:
        raise CheckFailed(f"at SPEED {percent:g} the robot is slower than that for {slow:.2f} s")


def asks_as_it_begins(bench: Bench, control: RawLink, percent: float) -> None:
    """Send SPEED at a trajectory's start.

    Interrupts of the motion task are off there for the first time.
    """

    def ask() -> None:
        control.at_once(messages.encode(messages.RawSpeed(percent), RawComm.REQUEST))
        # Long enough for the control server and an interrupt.
        bench.rapid_task("ROS_motion").sleep(0.05)

    at_call(bench, "ROS_motion", "IDisable", 1, ask)


_Send = Callable[[Bench, RawLink, Sequence[Point]], None]


def _download(bench: Bench, link: RawLink, points: Sequence[Point]) -> None:
    link.send(bench.download(points))


def _stream(bench: Bench, link: RawLink, points: Sequence[Point]) -> None:
    Streamer(bench, link).put(points, BEGIN | END)


@case("speed-kept", "never faster than asked, nor slowed down twice")
def _kept(bench: Bench) -> None:
    """Check long and short moves, slower, faster, and the next trajectory."""
    control, link, lead = bench.control(), bench.motion(), bench.setting.motion.planning_lead
    short = max(0.12, 1.05 * bench.config.trajectory.min_segment)
    paths: list[tuple[_Send, int, float]] = [(_download, 8, 0.6), (_download, 24, short)]
    if bench.streams:
        paths.append((_stream, 24, short))
    for send, count, seconds in paths:
        for percents in ((50.0,), (60.0, 20.0), (20.0, 60.0)):
            points, started = straight(bench, count, seconds), bench.now
            send(bench, link, points)
            bench.wait_until_moving()
            # Once without another ordered move, once with one.
            bench.run(seconds * (0.5 if percents[-1] > 50 else 2) - 0.8 * lead)
            before = 1.0
            for percent in percents:
                since = bench.now
                done(control.ask(messages.RawSpeed(percent)), f"SPEED {percent:g}")
                if bench.now - since > soon(bench):
                    raise CheckFailed(f"SPEED is answered after {bench.now - since:.3f} s")
                if percent == percents[-1]:
                    bench.wait_until_at(points[-1][0], 10 + 8 * count * seconds)
                    # Moves ordered with less speed keep it.
                    stops = 2 if percent < 100 * before else 2 + math.ceil(2 * seconds / before)
                    as_asked(bench, since, percent, seconds / before, stops)
                else:
                    bench.run(0.3)
                before = percent / 100
            bench.executed(points, started)
            bench.wait_until_standing()
        points, since = straight(bench, count, seconds), bench.now
        send(bench, link, points)
        bench.wait_until_at(points[-1][0], 10 + 8 * count * seconds)
        as_asked(bench, since, 100, seconds)
        bench.wait_until_standing()


@case("speed-in-pause", "a speed that is asked for in a pause holds after it")
def _in_pause(bench: Bench) -> None:
    """Send SPEED in a pause.

    SpeedRefresh may have no effect while the robot stands.
    """
    control, link = bench.control(), bench.motion()
    points, started = straight(bench, 6, 0.8), bench.now
    bench.start_motion(link, points, 1.0)
    done(control.ask(messages.RawPause(1)), "PAUSE")
    bench.wait_until_standing(3)
    done(control.ask(messages.RawSpeed(40)), "SPEED")
    bench.run(0.5)
    since = bench.now
    done(control.ask(messages.RawPause(0)), "the end of a pause")
    bench.wait_until_moving()
    bench.arrives(points, started, 60)
    as_asked(bench, since, 40, 0.8, 3)


@case("speed-at-end", "a speed that is asked for in the last move is over with it")
def _at_the_end(bench: Bench) -> None:
    """Send SPEED at the end.

    SpeedRefresh may persist, and may have no effect while the robot stands.
    """
    control, link = bench.control(), bench.motion()
    bench.start_motion(link, straight(bench, 2, 1.0), 0.2)
    done(control.ask(messages.RawSpeed(50)), "SPEED")
    bench.wait_until_standing()
    bench.run(2)
    points, since = straight(bench, 4, 1.0), bench.now
    bench.start_motion(link, points)
    bench.arrives(points, since, 20)
    as_asked(bench, since, 100, 1.0)


@case("speed", "a speed for one trajectory")
def _speed(bench: Bench) -> None:
    """Set half the speed for this trajectory; the next one is at full speed."""
    control, link = bench.control(), bench.motion()
    not_done(control.ask(messages.RawSpeed(50)), RawReason.IDLE, "SPEED of nothing")
    accepted = []
    for percent in (100.0, 50.0, 0.0):
        points, since = bench.wave(12), bench.now
        bench.start_motion(link, points)
        if percent:
            done(control.ask(messages.RawSpeed(80)), "SPEED 80")
            done(control.ask(messages.RawSpeed(percent)), f"SPEED {percent:g}")
        for wrong in (0.0, -5.0, 101.0, 0.99, 1e6, math.nan, math.inf):
            not_done(control.ask(messages.RawSpeed(wrong)), RawReason.BAD_VALUE, f"SPEED {wrong:g}")
        bench.wait_until_at(points[-1][0], 60)
        bench.followed([p for p, _ in points], since=since)
        accepted.append(bench.now - since)
        bench.run(0.5)
    if (
        not 1.5 * accepted[0] < accepted[1] < 2.5 * accepted[0]
        or abs(accepted[2] - accepted[0]) > 0.5
    ):
        raise CheckFailed(f"at 100, 50 and again 100 % a trajectory took {accepted} s")
    bench.start_motion(link, bench.wave(12))
    done(control.ask(messages.RawSpeed(1)), "the smallest SPEED")
    link.stop()
    bench.wait_until_at_rest(3, 1, "it was stopped")
    bench.assert_moves_through(link, bench.wave(3))


@case("speed-at-start", "a speed that comes at the beginning of a trajectory")
def _at_the_start(bench: Bench) -> None:
    """Send SPEED just before the first move is ordered: all get more time."""
    control, link, unit = bench.control(), bench.motion(), unit_of(bench)
    task = bench.rapid_task("ROS_motion")

    def ask() -> None:
        control.at_once(messages.encode(messages.RawSpeed(50), RawComm.REQUEST))
        # Long enough for the control server and an interrupt.
        task.sleep(0.05)

    begins(bench, link, bench.wave(2, duration=unit))
    control.ask(messages.RawSpeed(50))
    bench.wait_until_standing(3 * unit)
    at_call(bench, "ROS_motion", "MoveAbsJ", 1, ask)
    points = bench.wave(3, duration=unit)
    bench.start_motion(link, points)
    started = bench.now
    answer = control.reply(messages.SPEED, soon(bench))
    if answer != messages.RawAcknowledged():
        raise CheckFailed(f"SPEED at the beginning of a trajectory is answered by {answer}")
    bench.wait_until_at(points[2][0], 10 * unit)
    if bench.now - started < 3.0 * unit:
        raise CheckFailed(
            f"{2 * unit:.2f} s of motion at half the speed took {bench.now - started:.2f} s"
        )


@case("program-speed", "a program is never faster than asked, nor slowed down twice")
def _program(bench: Bench) -> None:
    """Change speed within and between a program's moves, then start another."""
    control, client = bench.control(), Programmer(bench)
    step, count = RATE * 0.6, 6
    program = straight_moves(bench, count, step)
    since = bench.now
    client.takes("a program", program)
    bench.wait_until_at(program[-1].joints, 60)
    rates = sorted(pace for *_, pace in paces(bench, since, 1.0))
    rate = max(rates[-len(rates) // 4 :])
    seconds = step / rate
    for percents in ((50.0,), (60.0, 20.0), (20.0, 60.0)):
        program, started = straight_moves(bench, count, step), bench.position
        client.takes("a program", program)
        bench.wait_until_moving()
        bench.run(seconds * (0.5 if percents[-1] > 50 else 1.5))
        before = 1.0
        for percent in percents:
            since = bench.now
            done(control.ask(messages.RawSpeed(percent)), f"SPEED {percent:g} of a program")
            if percent == percents[-1]:
                bench.wait_until_at(program[-1].joints, 10 + 8 * count * seconds)
                stops = 2 if percent < 100 * before else 2 + math.ceil(2 * seconds / before)
                as_asked(bench, since, percent, seconds / before, stops, rate)
            else:
                bench.run(0.3)
            before = percent / 100
        bench.followed([started, *(order.joints for order in program)], since=since)
        bench.wait_until_standing()
    program, since = straight_moves(bench, count, step), bench.now
    client.takes("a program", program)
    bench.wait_until_at(program[-1].joints, 60)
    as_asked(bench, since, 100, seconds, rate=rate)


@case("speed-on-circle", "a circle that is slowed down goes on where it was")
def _circle(bench: Bench) -> None:
    """Slow down a circle: the driver orders its end again.

    The new move is not a circle through the earlier position.
    """
    # The tool turns with the circle, which a palletizer cannot do.
    if not computes(bench) or len(bench.group.joints) < 6:
        raise NotApplicable("no poses are computed, or the tool does not turn with a circle")
    control, client = bench.control(), Programmer(bench)
    first, *_, last = orders(bench, 4, random.Random(31))
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    pose = reached(bench, last.joints)
    via = aside(reached(bench, first.joints), pose)
    circle = replace(last, kind=RawInstruction.MOVE_C, pose=pose, via=via)
    circle = replace(circle, speed=0.03, zone=0.002)
    back = RawMove(RawInstruction.MOVE_ABSJ, first.joints, None, zone=None)
    paths: list[list[Position]] = []
    seconds = 0.0
    for share in (None, 0.3, 0.6):
        client.takes("a circle", [circle, back])
        bench.wait_until_moving()
        since = bench.now
        if share is not None:
            bench.run(share * seconds)
            done(control.ask(messages.RawSpeed(30.0)), "SPEED on a circle")
        bench.until(lambda: distance(bench.position, last.joints) < 0.01, 60, "the circle ends")
        accepted = bench.now - since
        seconds = seconds or accepted
        # The remainder takes more than three times as long; but it may be short.
        if share is not None and seconds > 1 and accepted < (1 + (1 - share)) * seconds:
            raise CheckFailed(
                f"a circle of {seconds:.1f} s, {share:.0%} on the way SPEED 30: {accepted:.1f} s"
            )
        paths.append([place for at, place in bench.track if at >= since])
        bench.wait_until_at(first.joints, 60)
        bench.run(0.3)
    for path in paths[1:]:
        if (far := farthest(points(bench, path), points(bench, paths[0]))) > 0.004:
            raise CheckFailed(f"a circle that was slowed down is left by {far * 1000:.1f} mm")


def aside(one: Pose, other: Pose, share: float = 0.2) -> Pose:
    """Return a pose off the middle between two poses.

    `share` of the distance: 0.2 for an arc of 80 degrees.
    """
    path = np.subtract(other[0], one[0])
    side = np.cross(path, np.eye(3)[np.argmin(np.abs(path))])
    x, y, z = (np.add(one[0], other[0]) / 2 + share * side).tolist()
    return (x, y, z), slerp(one[1], other[1], 0.5)


def straight_moves(bench: Bench, count: int, step: float) -> list[RawMove]:
    """Return moves on a straight path, each about 0.6 s, the last a stop point."""
    current, joint = bench.position, bench.group.joints[0]
    step = inward(joint, current[0], step) - current[0]
    places = [changed(current, 0, current[0] + n * step) for n in range(count + 1)]
    speed = 0.1
    if bench.motion_group.kinematics is not None:
        speed = max(0.02, math.dist(bench.tcp(places[0]), bench.tcp(places[1])) / 0.6)
    return [
        RawMove(RawInstruction.MOVE_ABSJ, place, None, speed=speed, zone=zone)
        for place, zone in zip(places[1:], [*[0.002] * (count - 1), None], strict=True)
    ]
