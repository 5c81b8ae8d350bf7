"""State port: contents of each round for each client, and timing."""

from collections.abc import Sequence
from itertools import pairwise, zip_longest
from typing import NamedTuple, TypeVar

from rapidgen.generate.layout import signal_name
from rapidgen.generate.status import STATUS_SIGNALS
from rapidgen.runtime.builtins.system import StopWatch
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import (
    RawComm,
    RawFeature,
    RawMode,
    RawReason,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance, small_unit
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.testbench import Bench

case = SuiteGroup("reading")

C = TypeVar("C")
_NONE = RawFeature(0)


class Round(NamedTuple):
    """Messages to one client at one time."""

    time: float
    frames: list[messages.RawFrame]

    @property
    def numbers(self) -> list[int]:
        """Return message numbers, in order."""
        return [frame.number for frame in self.frames]


def content(one: Round, kind: type[C]) -> C:
    """Return the first message of a type in a round."""
    match = next((c for frame in one.frames if isinstance(c := messages.decode(frame), kind)), None)
    if match is None:
        raise CheckFailed(f"at {one.time:.3f} s a client gets {one.numbers}: no {kind.__name__}")
    return match


def rounds(link: RawLink, since: float) -> list[Round]:
    """Return the rounds of a client since a time.

    Each starts with JOINT; replies are not part of rounds.
    """
    failures: list[Round] = []
    for when, frame in link.frames:
        if when < since or frame.comm == RawComm.REPLY:
            continue
        if frame.number == messages.JOINT_POSITION or not failures:
            failures.append(Round(when, []))
        failures[-1].frames.append(frame)
    return failures


def subscribe(bench: Bench, features: RawFeature, link: RawLink | None = None) -> RawLink:
    """Send HELLO with these features from a client, new or not."""
    client = link if link is not None else bench.state()
    client.read()
    bench.send_hello(client, int(features))
    return client


def _late(bench: Bench) -> float:
    """Return s by which other work may delay a round."""
    return 0.005 * bench.setting.slowness


def on_turn(bench: Bench, result: Sequence[Round], what: str) -> None:
    """Check that rounds came one period apart, without a gap."""
    period = bench.config.state_period
    if len(result) < 3:
        raise CheckFailed(f"{what}: {len(result)} rounds")
    offs = [r.time - result[0].time - n * period for n, r in enumerate(result)]
    if max(offs) - min(offs) > 2 * _late(bench):
        raise CheckFailed(
            f"{what}: rounds are {min(offs):.4f} to {max(offs):.4f} s off their turns"
        )


def _pause(bench: Bench, link: RawLink) -> float:
    """Wait for a moment between two rounds and return its time."""
    bench.status(link)
    bench.run(0.5 * bench.config.state_period)
    return bench.now


PLAIN = [messages.JOINT_POSITION, messages.STATUS]
"""Messages of a round for a client without requests."""
_FOLLOW = {
    RawFeature.PROGRESS: messages.PROGRESS,
    RawFeature.FEEDBACK: messages.JOINT_FEEDBACK,
}


def _all_alike(
    bench: Bench, clients: Sequence[tuple[RawLink, RawFeature]], since: float
) -> list[Round]:
    """Return the first client's rounds; check that clients get equal data.

    Each client gets the features that it requested.
    """
    reply = [rounds(link, since) for link, _ in clients]
    for (_, features), own in zip(clients, reply, strict=True):
        on_turn(bench, own, f"a client of {features!r}")
        expected = [*PLAIN, *(n for f, n in _FOLLOW.items() if f in features)]
        for one in own:
            if one.numbers != expected:
                raise CheckFailed(
                    f"a client that asked for {features!r} gets messages {one.numbers}"
                )
    counts = [len(own) for own in reply]
    if max(counts) - min(counts) > 1:
        raise CheckFailed(f"clients of one server get {counts} rounds")
    # The last round may still be on its way to the others.
    for moment in zip(*reply, strict=False):
        seen: dict[int, messages.RawFrame] = {}
        for one in moment:
            for frame in one.frames:
                if seen.setdefault(frame.number, frame) != frame:
                    raise CheckFailed(f"at {one.time:.3f} s clients get different {frame.number}")
    return reply[0]


def _is_true(bench: Bench, reply: Sequence[Round]) -> set[int]:
    """Check that joints, STATUS and PROGRESS of rounds agree; return states."""
    seen: set[int] = set()
    before, stood = bench.track_at(reply[0].time), 0
    motion = bench.setting.motion
    late = (motion.settle + motion.servo_lag) / bench.config.state_period
    # The server reads the motion in STATUS after PROGRESS: it may be newer.
    slow = bench.setting.random_schedule or bench.setting.slowness > 1
    for one, following in zip_longest(reply, reply[1:]):
        joints, status = content(one, messages.RawJointPosition), content(one, messages.RawStatus)
        progress = content(one, messages.RawProgress)
        count, current = len(before), bench.track_at(one.time)
        if distance(joints.joints[:count], current) > 0.03 or any(joints.joints[count:]):
            raise CheckFailed(f"at {one.time:.3f} s the robot is at {current}, {joints}")
        seen.add(progress.state)
        wrong = progress.state in (RawTrajectoryState.REFUSED, RawTrajectoryState.FAILED)
        code = progress.reason + 100 * progress.joint if wrong else 0
        if (status.in_error, status.error_code) != (int(wrong), code):
            raise CheckFailed(f"{progress} is reported with {status}")
        moving = progress.state == RawTrajectoryState.MOVING
        if slow and following is not None and status.in_motion != moving:
            then = content(following, messages.RawProgress)
            moving = then.state == RawTrajectoryState.MOVING
        stood = stood + 1 if current == before else 0
        if status.in_motion != moving and (moving or stood > late):
            raise CheckFailed(f"{progress} is reported with {status}")
        plain = (status.drives_powered, status.e_stopped, status.mode, status.motion_possible)
        if plain != (1, 0, RawMode.AUTO, 1):
            raise CheckFailed(f"all is well, STATUS says {status}")
        before = current
    return seen


@case("each-round", "messages to each of three clients in each round", needs="feedback")
def _each_round(bench: Bench) -> None:
    """Check three clients with changing features in several situations.

    A trajectory, a rejected one, and a STOP.
    """
    some, everything = RawFeature.PROGRESS, RawFeature.PROGRESS | RawFeature.FEEDBACK
    links = [subscribe(bench, everything), subscribe(bench, _NONE), subscribe(bench, some)]
    motion, joints, period = bench.motion(), bench.group.joints, bench.config.state_period
    for options in ((everything, _NONE, some), (some, _NONE, some)):
        subscribe(bench, options[0], links[0])
        number = bench.progress(links[0]).trajectory
        since = _pause(bench, links[0])
        points = bench.wave(5)
        # A robot that stays at a point is still executing.
        points[3:3] = [(points[2][0], 1.0)]
        motion.send(bench.download(points))
        bench.wait_until_at(points[-1][0])
        bench.run(3 * period + 2 * bench.setting.motion.settle)
        # Of the last joint: its number goes into the error code.
        far = (*points[-1][0][:-1], joints[-1].upper + 0.5)
        motion.send(bench.download([points[-1], (far, 90.0), points[-1]]))
        bench.run(3 * period)
        motion.send(STOP)
        bench.run(3 * period)
        reply = _all_alike(bench, list(zip(links, options, strict=True)), since)
        states = _is_true(bench, reply)
        if not states >= {2, 3, 4, 6}:
            raise CheckFailed(f"a trajectory, a refusal and a STOP: PROGRESS tells states {states}")
        progress = [content(one, messages.RawProgress) for one in reply]
        numbers = list(dict.fromkeys(p.trajectory for p in progress))
        if numbers[-2:] != [number + 1, number + 2] or not number <= numbers[0]:
            raise CheckFailed(f"two trajectories came after {number}, PROGRESS tells of {numbers}")
        done = (RawTrajectoryState.DONE, len(points), len(points), len(points), 0, -1, 0)
        if done not in [p[1:] for p in progress]:
            raise CheckFailed(
                f"{len(points)} points were executed, no PROGRESS says so: {progress}"
            )
        refusal = (RawTrajectoryState.REFUSED, 1, 0, 0, RawReason.JOINT_LIMIT, 1, len(joints))
        if refusal not in [p[1:] for p in progress]:
            raise CheckFailed(f"joint {len(joints)} of point 1 is wrong, no PROGRESS says so")


_WRAP = 1000
"""s after which the time stamp of JOINT_FEEDBACK wraps, as docs/reference/driver.md says."""


def _stamps(reply: Sequence[Round]) -> list[float]:
    return [content(one, messages.RawJointFeedback).time for one in reply]


def _is_measured(bench: Bench, reply: Sequence[Round], what: str) -> None:
    """Check that JOINT_FEEDBACK stamps match the rounds, and velocities match."""
    period, count = bench.config.state_period, len(bench.position)
    for before, now in pairwise(content(one, messages.RawJointFeedback) for one in reply):
        if not (0 <= now.time < _WRAP and now.valid_fields == 0b111):
            raise CheckFailed(f"{what}: {now}")
        seconds = (now.time - before.time) % _WRAP
        if abs(seconds - period) > 2 * _late(bench):
            raise CheckFailed(f"{what}: stamps {before.time} and {now.time} are of two rounds")
        for joint in range(count):
            gone = (now.positions[joint] - before.positions[joint]) / seconds
            if abs(gone - now.velocities[joint]) > 1e-5 + 1e-3 * abs(gone):
                raise CheckFailed(f"{what}: joint {joint + 1} moves with {gone}, reported is {now}")


def _clocks(bench: Bench) -> list[StopWatch]:
    program = bench.rapid_task("ROS_stateServer").program
    return [clock for value in program.space.values() for clock in _of(value)]


def _of(value: object) -> list[StopWatch]:
    if isinstance(value, dict):
        return [clock for one in value.values() for clock in _of(one)]
    return [value] if isinstance(value, StopWatch) and value.started is not None else []


@case("over-the-ends", "schedule and stamps over the ends of the clock", needs="feedback")
def _over_the_ends(bench: Bench) -> None:
    """Let the schedule and stamps pass both ends of the clock, in motion."""
    link = subscribe(bench, RawFeature.FEEDBACK | RawFeature.PROGRESS)
    motion, period = bench.motion(), bench.config.state_period
    server = bench.controller.task(bench.task("ROS_stateServer"))
    for what, left in (
        ("an end of the clock", 3.0),
        ("the next end", 3.0),
        # The clock is exchanged after 0.7 periods past each of its ends.
        ("an end of months later", 20.8 * period),
        ("the end after that", 2.7 * period),
        ("a delay over the end", -1.0),
    ):
        since = _pause(bench, link)
        # Most of the time to the end is skipped, as if the clocks had run.
        clock = _stamps(rounds(link, since - period))[-1] + 0.5 * period
        clock -= server["ROS_stateServer:overrun"] % _WRAP
        _advance(bench, _WRAP - left - clock)
        if what == "an end of months later":
            server["ROS_stateServer:overrun"] = _WRAP - 0.01 * period
        if left == 3:
            points = bench.wave(6, duration=0.6)
            points[3:3] = [(points[2][0], 0.8)]
            motion.send(bench.download(points))
        # The awaited round, and at once the next one, which is too late.
        bench.run(max(left, 0.0) + 2)
        result = rounds(link, since)[1:]
        on_turn(bench, result, what)
        _is_true(bench, result)
        _is_measured(bench, result, what)
        stamps = _stamps(result)
        lost = result[-1].time - result[0].time - (stamps[-1] - stamps[0]) % _WRAP
        if abs(lost) > _late(bench):
            raise CheckFailed(f"{what}: the stamps have lost {lost:.4f} s")
    _late_by_half(bench, link)


def _late_by_half(bench: Bench, link: RawLink) -> None:
    """Delay a round by less than a period: the next one is on schedule."""
    period, since = bench.config.state_period, _pause(bench, link)
    _advance(bench, 1.5 * period)
    bench.run(5 * period)
    times = [one.time for one in rounds(link, since)]
    gaps = [b - a for a, b in pairwise(times)]
    expected = (0.0, 0.5 * period, period)
    if any(abs(gap - w) > 2 * _late(bench) for gap, w in zip(gaps, expected, strict=False)):
        raise CheckFailed(f"a round was late by half a period, rounds came at {times}")


def _advance(bench: Bench, seconds: float) -> None:
    """Advance the state server's clocks, as if it was delayed."""
    for clock in _clocks(bench):
        assert clock.started is not None
        clock.started -= int(seconds * 10**9)


@case("not-over-yet", "a halted trajectory whose path is not cleared yet", needs="feedback")
def _not_over_yet(bench: Bench) -> None:
    """Halt with an uncleared path: the robot stands and accepts no trajectory."""
    link, motion, period = bench.watcher(), bench.motion(), bench.config.state_period
    for ending, state, reason in (
        ("STOP", RawTrajectoryState.STOPPED, RawReason.STOPPED),
        ("leaves", RawTrajectoryState.FAILED, RawReason.CLIENT_LOST),
    ):
        bench.start_motion(motion, bench.wave(8), 0.6)
        end = fails(bench, "ROS_motion", "ClearPath", "ERR_PATH_STOP", 999)
        if ending == "STOP":
            motion.send(STOP)
        else:
            motion.close()
        bench.wait_until_standing(3)
        bench.run(halt_timeout(bench))
        since = _pause(bench, link)
        bench.run(3 * period)
        for one in rounds(link, since):
            status, reply = content(one, messages.RawStatus), content(one, messages.RawProgress)
            if (reply.state, reply.reason, reply.point) != (state, reason, reply.reached):
                raise CheckFailed(
                    f"{ending} came, its path is not cleared yet, PROGRESS says {reply}"
                )
            if (status.in_motion, status.motion_possible) != (0, 0):
                raise CheckFailed(
                    f"{ending} came, its path is not cleared yet, STATUS says {status}"
                )
        end()
        bench.run(1)
        if not bench.status(link).motion_possible:
            raise CheckFailed(f"{ending} came, the path is cleared, no motion is possible")
        motion = bench.motion()


@case(
    "first-of-all",
    "who comes when all have left; movements that no signal shows",
    "R16",
    needs="feedback",
)
def _first_of_all(bench: Bench) -> None:
    """Connect to a server without clients: the first round is immediate.

    The schedule restarts for this client.
    """
    period, motion = bench.config.state_period, bench.motion()
    names = {s.function: signal_name(bench.config, bench.group, s) for s in STATUS_SIGNALS}
    error, at_rest, stop = (names[n] for n in ("controller_error", "standing", "emergency_stop"))
    for visit in range(3):
        came = bench.now
        bench.controller.signals[error] = visit % 2
        link = bench.state()
        bench.until(lambda: bool(link.frames), 0.1, "the first client gets a round")  # noqa: B023
        bench.run(4 * period)
        result = rounds(link, came)
        on_turn(bench, result, f"visit {visit + 1}")
        first = content(result[0], messages.RawStatus)
        if first.in_motion:
            raise CheckFailed(f"the robot has moved without clients, the first STATUS is {first}")
        if first.in_error != visit % 2:
            raise CheckFailed(f"signal {error} is {visit % 2}, the first STATUS is {first}")
        for name, value in ((at_rest, 0), (stop, 1), (at_rest, 1), (stop, 0)):
            bench.controller.signals[name] = value
            since = _pause(bench, link)
            bench.run(2 * period)
            status = content(rounds(link, since)[-1], messages.RawStatus)
            expected = tuple(bench.controller.signals[n] for n in (at_rest, stop))
            if (1 - status.in_motion, status.e_stopped) != expected:
                raise CheckFailed(f"signals {at_rest}, {stop} are {expected}, STATUS says {status}")
        subscribe(bench, RawFeature.FEEDBACK | RawFeature.PROGRESS, link)
        _pause(bench, link)
        _advance(bench, 0.3)
        since = _pause(bench, link)
        bench.run(2 * period)
        stamp = _stamps(rounds(link, since))[-1]
        if abs(stamp - (bench.now - result[0].time) - 0.3) > period:
            raise CheckFailed(
                f"the first client has come {bench.now - came:.2f} s ago, reported is {stamp}"
            )
        link.close(abort=visit == 1, then=2 * period + 0.1)
        bench.assert_moves_through(motion, bench.wave(3, duration=0.2))
        # The last small remainder belongs to the motion.
        bench.wait_until_standing(3)
        bench.run(2 * bench.setting.motion.settle)
    _moved_by_others(bench, bench.state())


def _moved_by_others(bench: Bench, link: RawLink) -> None:
    """Move an axis by other means, without a signal: STATUS reports it once."""
    fails(bench, "ROS_stateServer", "DOutput", "ERR_NORUNUNIT", 10**6)
    bench.run(0.5)
    group, period = bench.motion_group, bench.config.state_period
    for axis, joint in enumerate(bench.group.joints):
        unit = small_unit(joint)
        for size, times in ((0.2, 1), (0.03, 0)):
            current, since = bench.position, _pause(bench, link)
            step = (
                size
                * unit
                * (1 if joint.upper - current[axis] > current[axis] - joint.lower else -1)
            )
            group.jump((*current[:axis], current[axis] + step, *current[axis + 1 :]))
            bench.run(3 * period)
            reply = [content(one, messages.RawStatus) for one in rounds(link, since)]
            seen = sum(status.in_motion == 1 for status in reply)
            if seen != times:
                raise CheckFailed(
                    f"joint {axis + 1} was moved by {size} deg (mm), {seen} STATUS say so"
                )
