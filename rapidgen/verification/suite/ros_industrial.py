"""Messages of the unmodified ROS-Industrial nodes."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    JOINT_POSITION,
    STATUS,
    RawComm,
    RawReason,
    RawReplyCode,
    decode,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, Position, distance, inward
from rapidgen.verification.raw_connection import STOP, point_frame, raw_point
from rapidgen.verification.suite.refusals import refused
from rapidgen.verification.testbench import Bench

case = SuiteGroup("compatible")

_REPLY = 2.0


@case("whole-trajectory", "a trajectory sent as topics is executed whole, in order")
def _whole_trajectory(bench: Bench) -> None:
    points = bench.wave(12)
    link = bench.motion()
    bench.assert_moves_through(link, points)
    if link.read():
        raise CheckFailed("points sent as topics were answered")


@case("first-point-10s", "the 10 s that the node gives the first point are not waited for", "R8")
def _first_point_of_ten_seconds(bench: Bench) -> None:
    points = bench.wave(4)
    link = bench.motion()
    started = bench.now
    link.send(bench.download(points))
    bench.wait_until_at(points[-1][0], 30)
    accepted, requested = bench.now - started, sum(d for _, d in points[1:])
    if accepted > requested + 3:
        raise CheckFailed(
            f"{requested:.1f} s of motion took {accepted:.1f} s: the first 10 s were waited for"
        )


@case("single-point", "a single point, sent as -1 and -3, starts at the robot's position", "R8")
def _single_point_sent_twice(bench: Bench) -> None:
    """Send a single near point twice: reached; a far one: rejected."""
    link, joints = bench.motion(), bench.group.joints

    def away(part: float) -> Position:
        return tuple(
            inward(joint, current, part * bench.start_tolerance(joint))
            for joint, current in zip(joints, bench.position, strict=True)
        )

    def twice(target: Position) -> bytes:
        return point_frame(0, 2, target, 10.0) + point_frame(1, 2, target, 10.0)

    near = away(0.9)
    link.send(twice(near))
    bench.wait_until_at(near, 40)
    bench.wait_until_standing()
    refused(bench, twice(away(1.1)), [RawReason.START_TOO_FAR], joint=1, point=0)
    link = bench.motion()
    # Two points with only the second elsewhere are a normal segment.
    bench.assert_moves_through(link, bench.wave(2, duration=1.0))


@case("equal-stamps", "equal stamps are a stay, and the rest follows")
def _equal_stamps(bench: Bench) -> None:
    first, second, third = bench.wave(3)
    # The node turns equal stamps into 10 s; the robot stays for them, and continues.
    points: list[Point] = [first, second, (second[0], 10.0), third]
    link = bench.motion()
    bench.assert_moves_through(link, points)


@case("more-trajectories", "trajectory after trajectory over one connection")
def _more_trajectories(bench: Bench) -> None:
    link = bench.motion()
    for _ in range(5):
        bench.assert_moves_through(link, bench.wave(5))


@case("state-stream", "JOINT and STATUS as plain topics at the set rate", "R16")
def _state_stream(bench: Bench) -> None:
    link = bench.state()
    bench.run(1)
    before = len(link.frames)
    bench.run(20)
    frames = link.frames[before:]
    period = bench.config.state_period
    for number, size in ((JOINT_POSITION, 44), (STATUS, 28)):
        stamps = [when for when, f in frames if f.number == number]
        if any(
            f.comm != RawComm.TOPIC or f.reply or len(f.data) != size
            for _, f in frames
            if f.number == number
        ):
            raise CheckFailed(f"a message {number} is no plain topic of {size} bytes")
        if abs(len(stamps) - 20 / period) > 2:
            raise CheckFailed(f"{len(stamps)} messages {number} in 20 s, wanted {20 / period:.0f}")
        for i, when in enumerate(stamps):
            if abs(when - (stamps[0] + i * period)) > period:
                raise CheckFailed(f"message {number} at {when:.3f} s is more than a period off")
    if {f.number for _, f in frames} != {JOINT_POSITION, STATUS}:
        raise CheckFailed("a client that did not say hello gets messages of ours")


@case("state-true", "JOINT and STATUS tell what the robot does")
def _state_is_true(bench: Bench) -> None:
    link, motion = bench.state(), bench.motion()
    bench.run(1)
    idle = bench.status(link)
    if (idle.drives_powered, idle.e_stopped, idle.in_error, idle.in_motion) != (1, 0, 0, 0):
        raise CheckFailed(f"an idle robot says {idle}")
    if (idle.mode, idle.motion_possible) != (2, 1):
        raise CheckFailed(f"a robot in automatic mode with its program running says {idle}")
    points = bench.wave(6)
    bench.start_motion(motion, points)
    if bench.status(link).in_motion != 1:
        raise CheckFailed("a moving robot says that it is not in motion")
    bench.wait_until_at(points[-1][0])
    bench.run(1)
    _, last = link.messages_of(messages.RawJointPosition)[-1]
    current = bench.position
    if distance(last.joints[: len(current)], current) > 1e-4 or any(last.joints[len(current) :]):
        raise CheckFailed(f"JOINT says {last.joints}, the robot is at {current}")
    if bench.status(link).in_motion != 0:
        raise CheckFailed("a standing robot says that it is in motion")


@case("short-movements", "every movement is in at least one STATUS", "R16")
def _short_movements_show(bench: Bench) -> None:
    link, motion = bench.state(), bench.motion()
    bench.run(0.5)
    for attempt in range(5):
        current = bench.position
        step = 0.0005 if attempt % 2 else -0.0005
        target = tuple(
            min(max(h + step, j.lower), j.upper)
            for h, j in zip(current, bench.group.joints, strict=True)
        )
        before = len(link.frames)
        motion.send(bench.download([(current, 10.0), (target, 0.1), (target, 0.1)]))
        bench.run(1.0)
        seen = [decode(f) for _, f in link.frames[before:] if f.number == STATUS]
        if not any(isinstance(s, messages.RawStatus) and s.in_motion == 1 for s in seen):
            raise CheckFailed("a movement between two STATUS messages was in none of them")


@case("stop-answered", "STOP is answered at once, in the node's bytes")
def _stop_is_answered(bench: Bench) -> None:
    link = bench.motion()
    link.send(STOP)
    frame = link.expect_reply(_REPLY, "STOP is answered by an idle driver")
    if frame != (11, RawComm.REPLY, RawReplyCode.SUCCESS, b""):
        raise CheckFailed(f"the reply to STOP is {frame}")


@case("at-the-limits", "every limit of every joint can be reached")
def _limits_are_reached(bench: Bench) -> None:
    link = bench.motion()
    # A limit in 64 bits may lie outside by the rounding to 32.
    for index, joint in enumerate(bench.group.joints):
        for limit in (joint.lower, joint.upper):
            current = bench.position
            target = (*current[:index], limit, *current[index + 1 :])
            seconds = bench.seconds_to(target)
            link.send(bench.download([(current, 10.0), (target, seconds), (target, 0.5)]))
            bench.wait_until_at(target, 20 + 4 * seconds)
            link.send(bench.download([(target, 10.0), (current, seconds), (current, 0.5)]))
            bench.wait_until_at(current, 20 + 4 * seconds)


@case("in-pieces", "a trajectory byte by byte", "R2")
def _in_pieces(bench: Bench) -> None:
    link = bench.motion()
    points = bench.wave(4)
    since = bench.now
    for byte in bench.download(points):
        link.send(bytes([byte]))
        bench.run(0.001)
    bench.wait_until_at(points[-1][0])
    bench.followed([p for p, _ in points], since=since)


@case("in-one-piece", "a trajectory and a STOP in one segment")
def _in_one_piece_with_a_stop(bench: Bench) -> None:
    link = bench.motion()
    points = bench.wave(6)
    link.send(bench.download(points) + STOP)
    link.expect_reply(5, "STOP after a trajectory in one segment is answered")
    bench.wait_until_standing()
    bench.assert_at_rest(2, "it was stopped")
    bench.assert_moves_through(link, bench.wave(4))


@case("full-capacity", "as many points as the driver says it holds", "R1", once=True)
def _full_capacity(bench: Bench) -> None:
    count = bench.config.trajectory.capacity
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(min(count, 1000), duration=0.2, size=0.01))


@case("ping", "PING as a request is answered")
def _ping(bench: Bench) -> None:
    link = bench.motion()
    link.send(b"\x0c\0\0\0\x01\0\0\0\x02\0\0\0\0\0\0\0")
    if link.expect_reply(_REPLY, "PING is answered").comm != RawComm.REPLY:
        raise CheckFailed("PING was not answered by a reply")


@case("requests", "points sent as requests are answered")
def _requests_are_answered(bench: Bench) -> None:
    link = bench.motion()
    points = bench.wave(3)
    for number, (joints, duration) in enumerate(points):
        link.send(point_frame(number, len(points), joints, duration, RawComm.REQUEST))
        frame = link.expect_reply(_REPLY, f"point {number} sent as a request is answered")
        if frame.reply != RawReplyCode.SUCCESS:
            raise CheckFailed(f"point {number} of a good trajectory was refused: {decode(frame)}")
    bench.wait_until_at(points[-1][0])


@case("stray-point", "a point without a start moves nothing")
def _stray_point(bench: Bench) -> None:
    link = bench.motion()
    link.send(raw_point(3, bench.wave(3)[-1][0], 1.0))
    bench.assert_at_rest(2, "a point without a start")
