"""Cut streams: each point value, each invalid batch, reply counts."""

from collections.abc import Sequence

from rapidgen.generate.context import WRAP
from rapidgen.verification import batches, messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import (
    RawComm,
    RawReason,
    RawSpecial,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, changed, inward, small_unit
from rapidgen.verification.raw_connection import raw_point
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.suite.points import fast_ends
from rapidgen.verification.suite.streams import way
from rapidgen.verification.testbench import Bench

case = SuiteGroup("streaming", needs="stream")

_NONE = RawStreamFlag(0)
_SLOW = 30.0
"""s of a segment that no axis is too slow for; the wire allows at most 33 s."""
_HEAD = 4
"""Reads of the driver in front of a batch: of the frame, and of what kind of message it is."""


class _Streams:
    """Streams over one connection, with increasing numbers and known replies."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self.link = bench.motion()
        self.watcher = bench.watcher()
        self.stream = Streamer(bench, self.link, number=0)
        self.trajectory = bench.progress(self.watcher).trajectory

    def begin(self, points: Sequence[Point] = (), flags: RawStreamFlag = _NONE) -> None:
        """Start a new stream with these points."""
        self.stream = Streamer(self._bench, self.link, number=self.stream.number + 1)
        self.trajectory += 1
        self.stream.put(points, BEGIN | flags)

    def taken(self, count: int, what: str) -> messages.RawPointsAccepted:
        """Return the last reply; check that it accepts so many points."""
        reply = self.stream.accepted(what)
        if reply[:3] != (self.stream.number, self.trajectory, count):
            raise CheckFailed(f"{what}: {count} points of {self.trajectory}, the reply is {reply}")
        return reply

    def refused(
        self,
        reason: RawReason,
        accepted: int,
        what: str,
        *,
        point: int | None = None,
        joint: int = 0,
    ) -> None:
        """Check the last reply's rejection of the first point not accepted."""
        at = accepted if point is None else point
        expected = messages.RawPointsRefused(
            self.stream.number, self.trajectory, accepted, reason, at, joint
        )
        if self.stream.last != expected:
            raise CheckFailed(f"{what}: wanted {expected}, the reply is {self.stream.last}")

    def strange(self, number: int, reason: RawReason, what: str) -> None:
        """Check that the last reply rejects a batch of no stream."""
        expected = messages.RawPointsRefused(number, 0, 0, reason, -1, 0)
        if self.stream.last != expected:
            raise CheckFailed(f"{what}: wanted {expected}, the reply is {self.stream.last}")

    def alone(self, sequence: int, what: str) -> None:
        """Send a single point, which is rejected for that."""
        self.trajectory += 1
        self.link.send(raw_point(sequence, self._bench.position, 1.0, RawComm.REQUEST))
        reply = messages.decode(self.link.expect_reply(2, "a point alone is answered"))
        if reply != messages.RawRefused(RawReason.NO_START, 0, 0):
            raise CheckFailed(f"{what}: a point alone is answered by {reply}")

    def stop(self) -> None:
        """Send STOP and check its reply."""
        self.link.stop()

    def shows(self, state: RawTrajectoryState, counts: tuple[int, ...], reason: int) -> None:
        """Check PROGRESS.

        `counts`: received, and planned and reached if given.
        """
        self._bench.run(2 * self._bench.config.state_period + 2 * self._bench.setting.motion.settle)
        reply = self._bench.progress(self.watcher)
        if (reply.trajectory, reply.state, reply.reason) != (self.trajectory, state, reason) or (
            reply[2 : 2 + len(counts)] != counts
        ):
            raise CheckFailed(
                f"trajectory {self.trajectory}, {state.name} with {counts} points for "
                f"{reason}: PROGRESS says {reply}"
            )


@case("stream-values", "each value of a stream's points at its bounds and beyond", "R10, R11")
def _each_value(bench: Bench) -> None:
    """Check limits, speeds and durations: the reply names point and joint."""
    streams, current, policy = _Streams(bench), bench.position, bench.config.trajectory
    for axis, joint in enumerate(bench.group.joints):
        unit = small_unit(joint)
        near = bench.start_tolerance(joint)
        if near > 0:
            start = changed(current, axis, inward(joint, current[axis], 1.03 * near))
            streams.begin([(start, 1.0), (current, 1.0)])
            streams.refused(RawReason.START_TOO_FAR, 0, f"a start at {start}", joint=axis + 1)
        for value in (joint.lower - 0.0015 * unit, joint.upper + 0.0015 * unit):
            streams.begin([(changed(current, axis, value), 1.0), (current, _SLOW)])
            streams.refused(
                RawReason.JOINT_LIMIT, 0, f"{value} of joint {axis + 1}", joint=axis + 1
            )
    for seconds in (0.0, -1e-6, -2.0):
        streams.begin([(current, 1.0), (current, 1.0), (current, seconds)])
        streams.refused(RawReason.BAD_DURATION, 2, f"a duration of {seconds} s")
        # The first duration has no effect; but it must not be negative.
        streams.begin([(current, seconds), (current, 1.0)])
        if seconds < 0:
            streams.refused(RawReason.BAD_DURATION, 0, f"a first duration of {seconds} s")
        else:
            streams.taken(2, "a first duration of 0 s")
    if policy.too_fast != "refuse":
        return
    short = policy.min_segment - 1e-4
    if short > 0.005:
        for flags in (_NONE, END):
            streams.begin([(current, 1.0), (current, short), (current, 1.0)], flags)
            streams.refused(RawReason.SEGMENT_TOO_SHORT, 1, "a short segment in between")
        streams.begin([(current, 1.0), (current, policy.min_segment), (current, short)])
        streams.refused(
            RawReason.SEGMENT_TOO_SHORT, 2, "a short segment that is not marked as last"
        )
        streams.begin([(current, 1.0), (current, policy.min_segment), (current, short)], END)
        streams.taken(3, "a short last segment")
    if bench.group.tcp_speed_limit >= 5:
        _speeds(bench, streams)


def _speeds(bench: Bench, streams: _Streams) -> None:
    current, seconds = bench.position, max(0.1, bench.config.trajectory.min_segment)
    allowed: list[Point] = [(current, 1.0)]
    for axis, joint in enumerate(bench.group.joints):
        for share in (0.999, 1.01):
            ends = fast_ends(joint, seconds, share)
            if ends is None:
                continue
            one, other = (changed(current, axis, value) for value in ends)
            # A slow start: no requested point is reached before the check ends.
            if share < 1:
                allowed += [(one, _SLOW), (other, seconds), (one, seconds), (current, _SLOW)]
            else:
                streams.begin([(current, 1.0), (other, _SLOW), (one, seconds)])
                what = f"joint {axis + 1} from {other} to {one} in {seconds} s"
                streams.refused(RawReason.TOO_FAST, 2, what, joint=axis + 1)
    streams.begin(allowed)
    streams.taken(len(allowed), "each joint at its speed")
    streams.stop()
    bench.wait_until_at_rest(2, 0.1, "the last stream was stopped")


def _expect_logged(bench: Bench, reason: RawReason) -> None:
    """Check that the event log has a rejection for that reason."""
    bench.run(0.05)
    text = messages.text_of(reason)
    if not any(text in " ".join(event.texts) for event in bench.controller.log):
        raise CheckFailed(f"the event log does not say: {text}")


def _no_business_of_it(bench: Bench, streams: _Streams) -> None:
    """Send batches of other streams: the current stream is not affected."""
    stream, points = streams.stream, way(bench, 4)
    for after in (_HEAD, _HEAD + 3):
        recovers = fails(bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=after)
        stream.say(stream.frame(points, _NONE))
        recovers()
        streams.strange(0, RawReason.CHECKSUM, "a head that cannot be read")
    _expect_logged(bench, RawReason.CHECKSUM)
    head = stream.frame(points, _NONE)
    stream.say(head[:16] + b"\xff" * 8 + head[24:])
    if not isinstance(stream.last, messages.RawPointsRefused) or stream.last.stream:
        raise CheckFailed(f"a damaged head is answered by {stream.last}")
    # A start that cannot be read ends nothing either.
    last = _HEAD + 4 + 2 * (1 + len(bench.position))
    for after in (_HEAD + 4, _HEAD + 5, last):
        other = Streamer(bench, stream.link, number=9)
        recovers = fails(bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=after)
        other.put(points[:2], BEGIN)
        recovers()
        streams.stream = other
        streams.strange(9, RawReason.CHECKSUM, "a beginning that cannot be read")
    streams.stream = other = Streamer(bench, stream.link, number=8)
    other.put(points[:2])
    streams.strange(8, RawReason.NO_START, "a batch of another stream")
    streams.stream = stream


@case("odd-batches", "a stream is cut by its own faults alone")
def _odd_batches(bench: Bench) -> None:
    """Cut a stream only by its own faults; execute the accepted points."""
    streams = _Streams(bench)
    values = 1 + len(bench.position)
    for number, (what, first, unreadable) in enumerate(
        (
            ("a damaged batch", 12, None),
            ("a damaged batch after a hole", 13, None),
            ("a checksum that cannot be read", 12, _HEAD + 4 + 2 * values),
            ("a point that cannot be read", 12, _HEAD + 4 + values),
        )
    ):
        points, since = way(bench, 14), bench.now
        streams.begin(points[:8])
        stream = streams.stream
        if not number:
            bench.wait_until_moving(1)
            _no_business_of_it(bench, streams)
        stream.put(points[8:12])
        streams.taken(12, "a batch after others that were none of this stream")
        data = bytearray(stream.frame(points[12:], _NONE, first))
        if unreadable is None:
            data[-9] ^= 1
        recovers = fails(
            bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=unreadable or 999
        )
        stream.say(bytes(data))
        recovers()
        streams.refused(RawReason.CHECKSUM, 12, what)
        stream.put(points[12:])
        streams.refused(RawReason.CHECKSUM, 12, f"a batch after {what}")
        bench.wait_until_at(points[11][0], 10)
        bench.executed(points[:12], since)
        if number in (0, 3):
            streams.shows(RawTrajectoryState.FAILED, (12, 12, 12), RawReason.CHECKSUM)
    # Later data is not affected.
    for which in ("stream", "download", "stream"):
        points = bench.wave(4, duration=0.2)
        if which == "stream":
            streams.begin(points, END)
            streams.taken(4, "a stream after one that was cut")
        else:
            streams.link.send(bench.download(points))
            streams.trajectory += 1
        bench.wait_until_at(points[-1][0], 5)
        streams.shows(RawTrajectoryState.DONE, (4, 4, 4), 0)


@case("early-ends", "streams that end before they move", "R5")
def _early_ends(bench: Bench) -> None:
    """End streams before they move, including the one with number 1."""
    streams, current = _Streams(bench), bench.position
    far = changed(current, 0, bench.group.joints[0].upper + 1)
    streams.begin([(current, 1.0)], END)
    streams.taken(1, "a single point")
    bench.run(0.3)
    streams.shows(RawTrajectoryState.DONE, (1, 1, 1), 0)
    streams.stream.put(())
    if streams.taken(1, "a question after the end").state != RawTrajectoryState.DONE:
        raise CheckFailed(f"a stream is done, the reply is {streams.stream.last}")
    streams.stream.put([(current, 1.0)])
    streams.refused(RawReason.SEQUENCE_GAP, 1, "a single point after the end")
    streams.begin((), END)
    streams.refused(RawReason.SEQUENCE_GAP, 0, "an end without a point")
    streams.begin([(current, 1.0), (current, 1.0), (far, _SLOW)])
    streams.refused(RawReason.JOINT_LIMIT, 2, "a third point that is too far", joint=1)
    # The earlier rejection is not reported for the next stream.
    streams.begin()
    before = streams.trajectory
    streams.link.send(raw_point(-1, current, 1.0))
    streams.stream.put([(current, 1.0)])
    streams.refused(RawReason.SUPERSEDED, 0, "a point after a download", point=-1)
    streams.trajectory = before + 1
    # A stream's start discards a partly received or skipped trajectory.
    streams.begin()
    streams.alone(1, "a download was under way, then a stream began")
    for joints in (far, current):
        streams.trajectory += 1
        streams.link.send(raw_point(-1, joints, 1.0) + raw_point(1, far, 1.0))
        streams.begin()
        streams.alone(2, "a download was refused, then a stream began")
        # A single point is skipped to its end.
        streams.link.send(raw_point(int(RawSpecial.END), current, 1.0))
    streams.begin()
    streams.stop()
    short = bytearray(streams.stream.frame([(current, 1.0)] * 2, _NONE))
    short[28] = 1
    streams.link.send(bytes(short))
    streams.stream.reply()
    streams.refused(RawReason.STOPPED, 0, "a batch of a wrong size after STOP", point=-1)
    if not bench.config.commissioning:
        streams.begin()
        bench.controller.perform("stop")
        for _ in range(2):
            streams.stream.put(())
            streams.taken(0, "no points while stopped")
            streams.begin()
        streams.stream.put([(current, 1.0)])
        streams.refused(RawReason.NOT_EXECUTING, 0, "a single point while stopped", point=-1)
        bench.controller.perform("start")
        bench.run(0.3)
    _left(bench)
    bench.assert_at_rest(0.2, "no stream was to move")


def _left(bench: Bench) -> None:
    """Leave before a stream has a point: rejected, unless it has ended."""
    for stopped in (False, True):
        streams = _Streams(bench)
        streams.begin()
        if stopped:
            streams.stop()
        streams.link.close()
        state = RawTrajectoryState.STOPPED if stopped else RawTrajectoryState.REFUSED
        streams.shows(state, (0,), RawReason.STOPPED if stopped else RawReason.INCOMPLETE)
        streams.watcher.close()
    streams = _Streams(bench)
    streams.begin()
    data = bytearray(streams.stream.frame([(bench.position, 1.0)] * 2, _NONE))
    data[28] = 1
    streams.link.send(bytes(data))
    streams.stream.reply()
    streams.refused(RawReason.FRAMING, 0, "two points that say they are one")
    streams.link.close()
    streams.watcher.close(then=0.3)


@case("room", "as many points as fit, and one more", "R1")
def _ring_space(bench: Bench) -> None:
    """Send as many points as the reply allows, across the counters' wrap."""
    streams, ring = _Streams(bench), bench.config.trajectory.ring
    _count_from(bench, WRAP - 7)
    current, most = bench.position, batches.batch_points(len(bench.position))
    target = bench.wave(2, size=0.01)[1][0]
    goal: list[Point] = [(target if n % 2 else current, 9.0) for n in range(ring + 20)]
    streams.begin(goal[:3], FLUSH)
    bench.wait_until_moving(1)
    bench.run(0.4)
    stream, sent = streams.stream, 3
    stream.put(())
    while space := streams.taken(sent, "points that fit").room:
        planned = stream.accepted("room").planned
        if space != ring - 1 - sent + planned:
            raise CheckFailed(
                f"{sent} of {ring - 1} points sent, {planned} planned, free places {space}"
            )
        stream.put(goal[sent : sent + min(space, most)])
        sent += min(space, most)
    streams.shows(RawTrajectoryState.MOVING, (sent,), 0)
    stream.put(goal[sent : sent + 1])
    streams.refused(RawReason.OVERRUN, sent, "one point more than fit")
    _expect_logged(bench, RawReason.OVERRUN)
    streams.stop()
    bench.wait_until_standing(2)
    stream.put(goal[sent : sent + 1])
    streams.refused(RawReason.OVERRUN, sent, "a point after a stream that was cut")
    # After the counters' wrap, the ring's entries are found, too.
    streams.begin()
    while streams.taken(0, "a stream after one that was stopped").room < ring - 1:
        bench.run(0.1)
        streams.stream.put(())
    points, since = way(bench, 12), bench.now
    streams.stream.put(points, END)
    streams.taken(12, "a stream after one that was stopped")
    bench.arrives(points, since, 5)
    streams.shows(RawTrajectoryState.DONE, (12, 12, 12), 0)


def _count_from(bench: Bench, value: int) -> None:
    """Set the ring's counters near their last value, as after many years.

    The ring is empty.
    """
    number = bench.config.groups.index(bench.group) + 1
    end = f"_{number}" if len(bench.config.groups) > 1 else ""
    task = bench.controller.task(bench.task("ROS_motionServer"))
    for name in ("head", "tail"):
        task[f"ROS_common:ROS_{name}{end}"] = value


@case("stream-move-fails", "the motion task ends a stream")
def _move_fails(bench: Bench) -> None:
    """Fail a move: batches report it, and nothing follows."""
    streams = _Streams(bench)
    points = way(bench, 24)
    streams.begin(points[:10])
    bench.wait_until_moving(1)
    fails(bench, "ROS_motion", "MoveAbsJ", "ERR_COLL_STOP")
    bench.run(0.5)
    bench.wait_until_standing(3)
    streams.stream.put(points[10:14])
    reply = streams.stream.refused(RawReason.COLLISION, "a batch after a collision")
    if reply.trajectory != streams.trajectory or reply.accepted != 10 or not 0 <= reply.point < 10:
        raise CheckFailed(f"a batch after a collision is answered by {reply}")
    bench.assert_moves_through(streams.link, bench.way_to(points[0][0]))
