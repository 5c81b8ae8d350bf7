"""Streams: batches, free places, starvation, wrong batches and early ends."""

import random
import struct
from collections.abc import Callable, Iterator, Sequence

from rapidgen.generate.context import WRAP
from rapidgen.verification import batches, messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, Position, changed, inward, small_unit
from rapidgen.verification.raw_programs import WHOLE, Programmer, orders
from rapidgen.verification.steps import (
    WAY,
    Alone,
    At,
    Disconnected,
    Download,
    Executed,
    Fails,
    Healthy,
    Logged,
    MovesOn,
    Moving,
    NotAt,
    NotLogged,
    Operator,
    Pass,
    Points,
    Progress,
    Reconnect,
    Rest,
    Run,
    Standing,
    StartAgain,
    Status,
    Stayed,
    Step,
    Stop,
    Took,
    Way,
    Works,
    generated,
    steps,
)
from rapidgen.verification.stream import BEGIN, END, FLUSH, NONE, Streamer, way
from rapidgen.verification.stream_steps import (
    Accepted,
    Batch,
    Begin,
    Change,
    Changed,
    Foreign,
    Refused,
    Whole,
    unrelated,
)
from rapidgen.verification.suite.motion_task import datum
from rapidgen.verification.suite.points import fast_ends
from rapidgen.verification.testbench import CORNER_FAILURE, Bench

case = SuiteGroup("streaming", needs="stream")

DONE, FAILED, MOVING = (
    RawTrajectoryState.DONE,
    RawTrajectoryState.FAILED,
    RawTrajectoryState.MOVING,
)
REFUSED, STARVED, STOPPED = (
    RawTrajectoryState.REFUSED,
    RawTrajectoryState.STARVED,
    RawTrajectoryState.STOPPED,
)
CHECKSUM, FRAMING, SEQUENCE_GAP = RawReason.CHECKSUM, RawReason.FRAMING, RawReason.SEQUENCE_GAP

_LARGEST = 2**23 - 1
"""Largest number of a stream."""
_SLOW = 30.0
"""s of a segment that no axis is too slow for; the wire allows at most 33 s."""
_READS = 4
"""Reads of the driver before those of a batch: of the frame, and of the type of message."""
_HEAD = 4
"""Reads of a batch's head."""


def _flip(place: int, bits: int = 1) -> Change:
    """Return a change of some bits of a byte."""

    def change(data: bytearray) -> None:
        data[place] ^= bits

    return change


def _write(place: int, data: bytes) -> Change:
    """Return a change of some bytes."""

    def change(message: bytearray) -> None:
        begin = place % len(message)
        message[begin : begin + len(data)] = data

    return change


def _bytes(data: bytes) -> Change:
    """Return a change to another message."""

    def change(message: bytearray) -> None:
        message[:] = data

    return change


def _unchanged(message: bytearray) -> None:
    """Send the message as it is."""


# -- whole streams -----------------------------------------------------------------------------


@case("stream", "a stream longer than the ring is executed whole, in time", "R1", once=True)
@generated
def _whole_stream(bench: Bench) -> Iterator[Step]:
    points = way(bench, 2 * bench.config.trajectory.ring + 7, 0.12)
    count, seconds = len(points), sum(duration for _, duration in points[1:])
    for size in (1, 7, 20):
        yield from (Points(points), Whole(size), At(-1, 30 + seconds))
        yield from (Took(0, 1.3 * seconds + 3), Progress(DONE, counts=(count,) * 3))
        points = [*reversed(points)]


@case("preload", "motion begins with enough points in the ring, or on request")
@generated
def _preload(bench: Bench) -> Iterator[Step]:
    seconds = bench.config.trajectory.preload
    duration = way(bench, 2, 0.2)[1][1]
    few = max(2, int(0.6 * seconds / duration))
    if few * duration >= seconds:
        raise NotApplicable("`preload` is shorter than a few points")
    for more, flags in ((0, END), (0, FLUSH), (8, NONE)):
        last = few + more - 1
        yield from (Way(40, 0.2), Begin(WAY[:few]), Rest(3), Batch(WAY[few : few + more], flags))
        yield from (Moving(2), Batch(flags=END), At(last), Reconnect())


@case("batch-enough", "just enough points to begin with")
@generated
def _enough(bench: Bench) -> Iterator[Step]:
    duration = bench.config.trajectory.preload / 4
    if duration < 1.05 * bench.config.trajectory.min_segment:
        raise NotApplicable("its segments are longer than a part of `preload`")
    for count, first in ((5, Moving(1)), (4, Rest(2))):
        yield from (Way(5, duration), Begin(WAY[:count]), first, Batch(flags=FLUSH))
        yield from (At(count - 1, 10), Reconnect(1.2))


@case("batch-full-ring", "a full ring begins with less than it likes to have", "R1")
@generated
def _full_ring(bench: Bench) -> Iterator[Step]:
    policy = bench.config.trajectory
    count, seconds = policy.ring - 1, max(0.12, 1.05 * policy.min_segment)
    if count * seconds > policy.preload:
        raise NotApplicable("a full ring lasts longer than `preload`")
    yield from (Way(count, seconds), Begin(WAY[:-3]), Rest(1))
    yield from (Batch(WAY[-3:], reply=Accepted(count, places=0)), Moving(1))
    yield from (Batch(flags=END), At(-1, 30))


@case("starves", "starvation is a stop on the path; more points go on", "R9")
@generated
def _starves(bench: Bench) -> Iterator[Step]:
    yield from (Way(45), Begin(WAY[:15]), At(14), Rest(2))
    yield from (Progress(STARVED, counts=(15, 15, 15)), Status(), Batch(WAY[15:17]))
    if bench.config.trajectory.preload > 3 * way(bench, 2)[1][1]:
        yield Rest(2)
    yield from (Batch(WAY[17:30]), At(29), Pass(1), Batch(WAY[30:], END), At())
    yield Progress(DONE, counts=(45, 45, 45))


@case("batch-replies", "replies to batches: counts, free places, state")
@generated
def _replies(bench: Bench) -> Iterator[Step]:
    ring = bench.config.trajectory.ring
    yield Way(40)
    for first in range(0, 40, 10):
        part = WAY[first : first + 10]
        yield Batch(part) if first else Begin(part, number=_LARGEST)
        yield from (_Counts(ring), Pass(0.3))
    yield from (Batch(reply=Accepted(40, MOVING)), At(-1, 30), Pass(0.5))
    yield from (Batch(reply=Accepted(40, STARVED, ring - 1)), Progress(STARVED, counts=(40,) * 3))
    yield from (Batch(flags=END), Pass(0.5))
    yield from (Batch(flags=flags, reply=Accepted(40, DONE)) for flags in (NONE, END))


class _Counts:
    """The counts of the newest reply fit each other and the ring buffer."""

    def __init__(self, ring: int) -> None:
        self._places = ring - 1

    def play(self, run: Run) -> None:
        """Compare the reply with the ring buffer."""
        bench, reply = run.bench, run.stream.accepted("a batch")
        # The motion task may take points between the two readings, of planned and then of places:
        # the first points are short, and random task order decides how many.
        setting = bench.setting
        otherwise = setting.seed or setting.group or setting.random_schedule
        between = 4 if otherwise or setting.slowness > 1 else 1
        task = bench.controller.task(bench.task("ROS_motion"))
        in_it = task[datum(bench, "ros_head")] - task[datum(bench, "ros_tail")]
        if (
            not reply.reached <= reply.planned <= reply.accepted
            or reply.room > self._places - in_it
            or reply.accepted > self._places - reply.room + reply.planned + between
        ):
            raise CheckFailed(f"{in_it} of {self._places} places are used, the reply is {reply}")


@case("batch-pieces", "a stream in pieces of every size", "R2")
@generated
def _in_pieces(bench: Bench) -> Iterator[Step]:
    for size in (1, 3, 7, 15, 16, 17, 31, 500, 1000, 1020, 100_000):
        yield from (Way(24, 0.12), _Pieces(size), At(-1, 10))


class _Pieces:
    """Send a stream as two batches in pieces of `size` bytes; both are accepted."""

    def __init__(self, size: int) -> None:
        self._size = size

    def play(self, run: Run) -> None:
        """Send the pieces, and read both replies."""
        stream = run.stream = Streamer(run.bench, run.link, number=run.stream.number + 1)
        run.trajectory += 1
        run.of_stream = run.trajectory
        data = stream.frame(run.way[:15], BEGIN) + stream.frame(run.way[15:], END, 15)
        for at in range(0, len(data), self._size):
            stream.link.send(data[at : at + self._size])
            run.bench.run(0.0005)
        for count in (15, len(run.way)):
            Accepted(count).check(stream.reply(), run)


@case("batch-topics", "batches as topics are not answered, STATUS and PROGRESS tell of them")
def _as_topics(bench: Bench) -> None:
    watcher, link = bench.watcher(), bench.motion()
    points = way(bench, 20)
    for first, flags in ((0, BEGIN), (20, NONE), (50, NONE)):
        own = [(p, 0.12) for p, _ in points] if first != 20 else points[-1:] * 2
        link.send(batches.points_frame(7, first, own, flags, RawComm.TOPIC))
    bench.wait_until_at(points[-1][0], 20)
    bench.run(1 + 2 * bench.config.state_period)
    if link.read():
        raise CheckFailed("batches as topics were answered")
    progress, status = bench.progress(watcher), bench.status(watcher)
    expected = (FAILED, 22, 22, 22, SEQUENCE_GAP, 22, 0)
    if progress[1:] != expected or (status.in_error, status.error_code) != (1, SEQUENCE_GAP):
        raise CheckFailed(f"a topic after 22 points had a hole, {progress}, {status}")


@case("batch-in-time", "a batch that comes while the last point is approached", "R9")
@generated
def _just_in_time(bench: Bench) -> Iterator[Step]:
    seconds = max(0.2, 1.05 * bench.config.trajectory.min_segment)
    for late in range(1, 13):
        yield from (Way(14, seconds), Begin(WAY[:6]), Pass(4.25 * seconds + 0.02 * late))
        yield from (Batch(WAY[6:], END), At(), NotLogged(CORNER_FAILURE))


@case("batch-stay", "a stay in a stream", "R8")
@generated
def _stays(bench: Bench) -> Iterator[Step]:
    first, second, third = way(bench, 3, 0.4)
    stay = (second[0], 1.5)
    seconds = second[1] + stay[1] + third[1]
    yield from (Points([first, second, stay, third]), Begin(WAY[:], END), At(-1, 10))
    yield from (Took(seconds - 0.1, 1.3 * seconds + 0.4), Stayed(1))
    # The next batch shows that it is a stay.
    first, second, third = way(bench, 3, 0.6)
    stay = (second[0], 1.5)
    yield from (Points([first, second, stay, third]), Begin(WAY[:2], FLUSH), Batch(WAY[2:], END))
    yield from (At(-1, 10), Stayed(1))


@case("batch-short-last", "a short last segment of a stream", "R9")
@generated
def _short_last(bench: Bench) -> Iterator[Step]:
    policy = bench.config.trajectory
    if policy.too_fast != "refuse" or policy.min_segment < 0.005:
        raise NotApplicable("`min_segment` refuses no segment")
    points = [(p, 1.0) for p, _ in bench.wave(4, size=0.001)]
    points[3] = (points[3][0], policy.min_segment / 2)
    yield from (Points(points), Begin(WAY[:], END), At(-1, 10))


@case("batch-silent", "a stream that is silent for seconds; then a newer client is served", "R12")
@generated
def _silent(bench: Bench) -> Iterator[Step]:
    yield from (Way(60), Begin(WAY[:25]), Moving())
    bench.motion()
    yield from (Pass(2.5), Batch(WAY[25:50], END), At(49, 30), Disconnected())


@case("room", "as many points as fit, and one more", "R1")
@generated
def _ring_space(bench: Bench) -> Iterator[Step]:
    ring, current = bench.config.trajectory.ring, bench.position
    target = bench.wave(2, size=0.01)[1][0]
    task = bench.controller.task(bench.task("ROS_motionServer"))
    for name in ("ros_head", "ros_tail"):
        # As after many years. The ring buffer is empty.
        task[datum(bench, name)] = WRAP - 7
    yield Points([(target if n % 2 else current, 9.0) for n in range(ring + 20)])
    yield from (Begin(WAY[:3], FLUSH), Moving(1), Pass(0.4), fill := _Fill(ring))
    sent = fill.sent
    one = WAY[sent : sent + 1]
    yield Progress(MOVING, counts=(sent,))
    yield from (Batch(one, reply=Refused(RawReason.OVERRUN, sent)), Logged(RawReason.OVERRUN))
    yield from (Stop(), Standing(2), Batch(one, reply=Refused(RawReason.OVERRUN, sent)))
    # The places of the ring buffer are found after the wrap of its counters, too.
    yield from (Begin(), _Empty(ring), Way(12), Batch(WAY[:], END), At(-1, 5))
    yield Progress(DONE, counts=(12, 12, 12))


class _Fill:
    """Send as many points of the way as fit. Each reply has the right number of free places."""

    def __init__(self, ring: int) -> None:
        self._places = ring - 1
        self.sent = 3

    def play(self, run: Run) -> None:
        """Fill the ring buffer."""
        stream, most = run.stream, batches.batch_points(len(run.bench.position))
        stream.put(())
        while free := (reply := stream.accepted("points that fit")).room:
            if free != self._places - self.sent + reply.planned:
                raise CheckFailed(f"{self.sent} points were sent, the reply is {reply}")
            count = min(free, most)
            stream.put(run.way[self.sent : self.sent + count])
            self.sent += count


class _Empty:
    """Ask until all places of the ring buffer are free."""

    def __init__(self, ring: int) -> None:
        self._places = ring - 1

    def play(self, run: Run) -> None:
        """Ask with batches without points."""
        while run.stream.accepted("a stream after one that was stopped").room < self._places:
            run.bench.run(0.1)
            run.stream.put(())


@case("overrun", "more points than fit, before the reply to those that fit", "R1")
def _overrun(bench: Bench) -> None:
    since, ring = bench.now, bench.config.trajectory.ring
    points = way(bench, 2 * ring, 0.12)
    stream = Streamer(bench)
    stream.put(points[:20], BEGIN)
    while stream.room >= 20:
        stream.takes("points that fit", points[stream.sent : stream.sent + 20])
    before = stream.sent
    stream.link.send(stream.frame(points[before : before + 20], NONE))
    stream.link.send(stream.frame(points[before + 20 : before + 40], NONE, first=before + 20))
    for _ in range(2):
        stream.reply()
    answer = stream.refused(RawReason.OVERRUN, "more points than fit")
    if not before <= answer.accepted <= before + 20:
        raise CheckFailed(f"{before} points were sent with places for them, the reply is {answer}")
    bench.wait_until_at(points[answer.accepted - 1][0], 60)
    bench.executed(points[: answer.accepted], since)


@case("batch-index-wraps", "more points than numbers")
@generated
def _index_wraps(bench: Bench) -> Iterator[Step]:
    last = messages.INDEX_WRAP
    yield from (Way(40), Begin(WAY[:10]), At(9), Pass(0.5))
    server = bench.controller.task(bench.task("ROS_motionServer"))
    server["ROS_motionServer:ROS_point_count"] = server["ROS_stream:accepted"] = last - 5
    motion = bench.controller.task(bench.task("ROS_motion"))
    motion["ROS_motion:expected_index"] = last - 4
    yield Batch(WAY[10:20], first=last - 5, reply=Accepted(5))
    yield from (Batch(WAY[20:], END, first=5), At())


# -- wrong batches in a moving stream ----------------------------------------------------------

_MISTAKES: tuple[tuple[str, int, Change, RawReason], ...] = (
    # A batch of four points after 20: what is wrong, its first index, its change, the reason.
    *((f"bit 0 of byte {n}", 20, _flip(n), CHECKSUM) for n in (-1, -8, 40, 24, 60)),
    *((f"the index {n}", n, _unchanged, SEQUENCE_GAP) for n in (19, 21, 0, 30)),
    ("a hole and damage", 21, _flip(-9), CHECKSUM),
    ("three points", 20, _write(28, struct.pack("<i", 3)), FRAMING),
)


@case("stream-mistakes", "a wrong batch cuts a stream after the points before it", "R2, C4")
@generated
def _mistakes(bench: Bench) -> Iterator[Step]:
    for what, first, change, reason in _MISTAKES:
        reply = Refused(reason, 20)
        bad = Changed(WAY[20:24], what, change, reply, first=first)
        yield from _cut(bad, reply)


def _cut(bad: Step, reply: Refused, taken: int = 20) -> Iterator[Step]:
    """Yield the steps of a moving stream of 20 points that a wrong batch cuts."""
    assert isinstance(reply.reason, RawReason)
    yield from (Way(30), Begin(WAY[:20], number=3), Moving(), bad)
    yield from (Batch(WAY[20:24], reply=reply, first=20), Standing(20))
    yield from (Executed(taken, complete=taken == 20), Rest(2))
    yield from (Progress(FAILED, reply.reason), Status(reply.reason))
    yield from (Way(12), Whole(), At(), Reconnect())


@case("stream-point", "points before a wrong one are executed", "R10")
@generated
def _wrong_point(bench: Bench) -> Iterator[Step]:
    joints, policy = bench.group.joints, bench.config.trajectory
    far = joints[1].upper + 0.1
    wrong: list[tuple[RawReason, int, Callable[[Position], Point]]] = [
        (RawReason.JOINT_LIMIT, 2, lambda place: (changed(place, 1, far), 30.0)),
        (RawReason.BAD_DURATION, 0, lambda place: (place, 0.0)),
        (RawReason.BAD_DURATION, 0, lambda place: (place, -1.0)),
    ]
    if policy.too_fast == "refuse" and policy.min_segment >= 0.005:
        short = policy.min_segment / 2
        wrong.append((RawReason.SEGMENT_TOO_SHORT, 0, lambda place: (place, short)))
    for reason, joint, make in wrong:
        first, second, _, last = way(bench, 4)
        points = [(first[0], 1.0), (second[0], 1.0), make(second[0]), last]
        reply = Refused(reason, 22, joint=joint)
        yield from _cut(Batch(points, reply=reply), reply, taken=22)


@case("batch-shapes", "batches of a shape that none has", "R2")
@generated
def _shapes(bench: Bench) -> Iterator[Step]:
    points = way(bench, 10)
    for comm in (0, 3, 7):
        yield from (_Sent(batches.points_frame(7, 0, points, BEGIN, comm)), Disconnected(5))
        yield Reconnect(0)
    for size in (0, 8, 16):
        yield _Sent(messages.framed(messages.POINTS, bytes(size)), answered=True)
    for first in (1, messages.INDEX_WRAP - 1):
        refused = Refused(SEQUENCE_GAP)
        yield _Beginning(Changed(points, "another index", _unchanged, refused, BEGIN, first))
    yield Rest(1)
    for what, change, reason in _shape_table(bench):
        yield from (Way(10), Begin(WAY[:5], number=7))
        yield from (Changed(WAY[5:], what, change, Refused(reason, 5)), At(4, 10))


class _Sent:
    """Send any bytes; `answered`: a failure is the reply."""

    def __init__(self, data: bytes, *, answered: bool = False) -> None:
        self._data, self._answered = data, answered

    def play(self, run: Run) -> None:
        """Send the bytes."""
        run.link.send(self._data)
        if self._answered:
            answer = messages.decode(run.link.expect_reply(2, "a failure is the reply"))
            if not isinstance(answer, messages.RawPointsRefused | messages.RawFailure):
                raise CheckFailed(f"the reply is {answer}")


def _begins_at(first: int, points: Sequence[Point]) -> Step:
    """Return the beginning of a stream with a first index other than 0."""
    return _Beginning(
        Changed(points, f"begins at {first}", _unchanged, Refused(SEQUENCE_GAP), BEGIN, first)
    )


class _Beginning:
    """A message that begins the next stream."""

    def __init__(self, message: Changed) -> None:
        self._message = message

    def __str__(self) -> str:
        return str(self._message)

    def play(self, run: Run) -> None:
        """Send the message as the beginning."""
        run.stream = Streamer(run.bench, run.link, number=run.stream.number + 1)
        run.trajectory += 1
        run.of_stream = run.trajectory
        self._message.play(run)


def _shape_table(bench: Bench) -> Iterator[tuple[str, Change, RawReason]]:
    """Yield wrong batches of five points: what is wrong, the change, the reason."""

    def exchange(data: bytearray) -> None:
        data[32:40] = data[36:40] + data[32:36]

    yield "two words are exchanged", exchange, CHECKSUM
    for count in (4, 6, 0, -(2**31)):
        words = [word for point in way(bench, 10)[5:] for word in batches.words_of(point)]
        yield f"count {count}", _bytes(batches.words_frame(7, 5, count, words)), FRAMING
    for more in (-8, -4, 4, 8):
        data = batches.points_frame(7, 5, way(bench, 10)[5:])[16:]
        data = data[:more] if more < 0 else data + bytes(more)
        yield f"{more} bytes more", _bytes(messages.framed(messages.POINTS, data)), FRAMING
    for value in (2**24 + 1, 2**31 - 1, -(2**31)):
        for place in (32, 36, -4):
            yield f"{value} at {place}", _write(place, struct.pack("<i", value)), CHECKSUM


@case("batch-damage", "random damage of a batch moves nothing but what was sent", "R3")
def _damage(bench: Bench) -> None:
    chance = random.Random(bench.setting.seed)
    for _ in range(20):
        points, since = way(bench, 24, 0.12), bench.now
        stream = Streamer(bench)
        stream.takes("the first points", points[:12], BEGIN)
        data = bytearray(stream.frame(points[12:], END))
        for _ in range(chance.randint(1, 3)):
            data[chance.randrange(4, len(data))] = chance.randrange(256)
        stream.link.send(bytes(data[: chance.choice((len(data), chance.randrange(1, len(data))))]))
        bench.run(0.3)
        stream.link.close()
        bench.wait_until_standing(10)
        bench.executed(points, since)
        bench.assert_healthy()


@case("batch-unreadable", "bytes of a batch that cannot be read", "R3")
def _unreadable(bench: Bench) -> None:
    # The frame's own, the head's, those of two points, the checksum.
    for after in range(_READS + _HEAD + 2 * (1 + len(bench.position)) + 1):
        stream, since = Streamer(bench), bench.now
        points = way(bench, 10)
        stream.put(points[:8], BEGIN | FLUSH)
        bench.wait_until_moving()
        recovers = fails(bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=after)
        stream.link.send(stream.frame(points[8:], NONE))
        bench.run(0.1)
        recovers()
        if not stream.link.lost:
            stream.reply()
            stream.refused(CHECKSUM, f"read {after} of a batch has failed")
        bench.wait_until_standing(10)
        bench.executed(points[:8], since)
        bench.assert_at_rest(0.3, f"read {after} of a batch has failed")
        bench.assert_healthy()
        stream.link.close(then=0.3)


@case("batch-fits-unread", "words that cannot be read where the checksum is right without", "R3")
@generated
def _fits_unread(bench: Bench) -> Iterator[Step]:
    # By chance the checksum would be right once in 2^31: only the read error can decide.
    values = 1 + len(bench.position)
    for number, unread in enumerate(("a point", "the checksum"), 1):
        points = way(bench, 9)
        sent = batches.words_of(points[8])
        head = [number, 0, 8, 2]
        expected = batches.checksum([*head, *sent]) if unread == "a point" else 0
        sent += batches.words_to(expected, [*head, *sent], values)
        data = batches.words_frame(number, 8, 2, sent)
        yield from (Points(points), Begin(WAY[:8], FLUSH, number=number))
        yield Fails("ROS_motionServer", "UnpackRawBytes", after=_READS + _HEAD + values * number)
        yield Changed(WAY[8:], unread, _bytes(data), Refused(CHECKSUM, 8))
        yield from (Works(), At(7, 10), Reconnect(0.5))


@case("odd-batches", "a stream is cut by its own faults alone")
@generated
def _odd_batches(bench: Bench) -> Iterator[Step]:
    values = 1 + len(bench.position)
    for number, (what, first, change, unread) in enumerate(
        (
            ("damage", 12, _flip(-9), None),
            ("damage after a hole", 13, _flip(-9), None),
            ("unreadable checksum", 12, _unchanged, _READS + _HEAD + 2 * values),
            ("unreadable point", 12, _unchanged, _READS + _HEAD + values),
        )
    ):
        yield from (Way(14), Begin(WAY[:8]))
        if not number:
            yield Moving(1)
            yield from _of_other_streams(values)
        yield Batch(WAY[8:12])
        if unread is not None:
            yield Fails("ROS_motionServer", "UnpackRawBytes", after=unread)
        yield from (Changed(WAY[12:], what, change, Refused(CHECKSUM, 12), first=first), Works())
        yield from (Batch(WAY[12:], reply=Refused(CHECKSUM, 12)), At(11, 10))
        if number in (0, 3):
            yield Progress(FAILED, CHECKSUM, (12, 12, 12))
    # Later messages are not affected.
    for which in (Begin(WAY[:], END), MovesOn(), Begin(WAY[:], END)):
        yield from (Points(bench.wave(4, duration=0.2)), which)
        if isinstance(which, Begin):
            yield At(-1, 5)
        yield Progress(DONE, counts=(4, 4, 4))


def _of_other_streams(values: int) -> Iterator[Step]:
    """Yield batches of other streams, which do not affect the present one."""
    for after in (_READS, _READS + 3):
        yield Fails("ROS_motionServer", "UnpackRawBytes", after=after)
        yield from (Foreign(1, WAY[8:12], NONE, unrelated(CHECKSUM, 0)), Works())
    yield Logged(CHECKSUM)
    damaged = Refused((CHECKSUM, RawReason.NO_START), 0, -1, stream=0, trajectory=0)
    yield Foreign(1, WAY[8:12], NONE, damaged, _write(16, b"\xff" * 8))
    # A beginning that cannot be read ends nothing either.
    for after in (_READS + _HEAD, _READS + _HEAD + 1, _READS + _HEAD + 2 * values):
        yield Fails("ROS_motionServer", "UnpackRawBytes", after=after)
        yield from (Foreign(9, WAY[:2], BEGIN, unrelated(CHECKSUM, 9)), Works())
    yield Foreign(8, WAY[:2], NONE, unrelated(RawReason.NO_START, 8))


@case("batch-beginning", "a damaged beginning while a stream moves")
@generated
def _damaged_beginning(bench: Bench) -> Iterator[Step]:
    """That of another stream ends nothing; that of the present one cuts it."""
    cut = Refused(CHECKSUM, 20)
    yield from (Way(24), Begin(WAY[:20], number=3), Moving())
    yield Foreign(4, WAY[:3], BEGIN, unrelated(CHECKSUM, 4), _flip(60))
    yield from (Batch(WAY[20:], END), At(), Reconnect(1.2))
    yield from (Way(24), Begin(WAY[:20], number=3), Moving())
    yield from (Foreign(3, WAY[:3], BEGIN, cut, _flip(60)), Batch(WAY[20:], END, cut), At(19))


@case("batch-no-number", "numbers that no batch has", "R2")
@generated
def _no_number(bench: Bench) -> Iterator[Step]:
    """Eight bytes of ones are two invalid numbers."""
    last = len(Streamer(bench, number=3).frame(way(bench, 4), BEGIN)) - 8
    for place, stream in ((16, 0), (24, 3), (32, 3), (40, 3), (last - 8, 3), (last, 3)):
        yield from (Way(4), _Damaged(place, stream), Rest(1), Reconnect(0.5))


class _Damaged:
    """Begin stream 3 with eight bytes of ones at a place: nothing is accepted."""

    def __init__(self, place: int, stream: int) -> None:
        self._place, self._stream = place, stream

    def play(self, run: Run) -> None:
        """Send the beginning; the driver may take it for one or not."""
        data = bytearray(batches.points_frame(3, 0, run.way, BEGIN))
        data[self._place : self._place + 8] = b"\xff" * 8
        reply = run.stream.say(bytes(data))
        if (
            not isinstance(reply, messages.RawPointsRefused)
            or (reply.accepted, reply.stream) != (0, self._stream)
            or (self._place >= 32 and reply.reason != CHECKSUM)
        ):
            raise CheckFailed(f"8 bytes of ff at {self._place}, the reply is {reply}")


# -- beginnings and ends -----------------------------------------------------------------------


@case("batch-strange", "batches of no stream", "C4")
@generated
def _strange(bench: Bench) -> Iterator[Step]:
    no_start = RawReason.NO_START
    yield Way(4)
    for number, flags in ((7, NONE), (7, END), (7, FLUSH), (0, BEGIN), (0, NONE)):
        yield Foreign(number, WAY[:], flags, unrelated(no_start, number))
    yield Foreign(_LARGEST + 1, WAY[:], BEGIN, unrelated(no_start, 0))
    yield from (Begin(WAY[:], number=7), Foreign(8, WAY[:], NONE, unrelated(no_start, 8)))
    yield from (Way(4), Batch(WAY[:], END), Pass(3), Standing())


@case("stream-names", "a refusal names point and joint", "R8")
@generated
def _names_the_point(bench: Bench) -> Iterator[Step]:
    points = [(p, 30.0) for p, _ in way(bench, 6)]
    points[4] = (changed(points[4][0], 1, bench.group.joints[1].lower - 0.1), 30.0)
    yield Begin(points, END, Refused(RawReason.JOINT_LIMIT, 4, joint=2))


@case("stream-begins-wrong", "a wrong beginning moves nothing", "R8")
@generated
def _first_batch_is_wrong(bench: Bench) -> Iterator[Step]:
    joint, current = bench.group.joints[0], bench.position
    step = 0.2 if joint.upper - current[0] > current[0] - joint.lower else -0.2
    for reason, value in (
        (RawReason.JOINT_LIMIT, joint.upper + 1),
        (RawReason.START_TOO_FAR, current[0] + step),
    ):
        refused = Refused(reason, joint=1)
        yield from (Way(10), Begin([(changed(current, 0, value), 1.0)], reply=refused))
        yield from (Batch(WAY[:], reply=refused), Rest(3), Reconnect())
    damaged = Changed(WAY[:], "bit 2 of byte 50", _flip(50, 4), Refused(CHECKSUM), BEGIN)
    yield from (Way(10), _Beginning(damaged))
    yield from (Begin((), END, Refused(SEQUENCE_GAP)), Rest(3), Whole(), At())


@case("behind-the-end", "nothing follows the end of a stream")
@generated
def _after_end(bench: Bench) -> Iterator[Step]:
    yield from (Way(12), Whole(), Batch(WAY[:3], reply=Refused(SEQUENCE_GAP, 12)), At())
    yield from (Rest(2), Progress(DONE, counts=(12, 12, 12)))


_STOPPED = (RawReason.MOTORS_OFF, RawReason.PROGRAM_STOPPED, RawReason.EMERGENCY_STOP)
_ENDS: tuple[tuple[Step, RawReason | tuple[RawReason, ...]], ...] = (
    (Stop(), RawReason.STOPPED),
    *((Operator(action), _STOPPED) for action in ("e-stop", "stop", "motors-off")),
    (Download(), RawReason.SUPERSEDED),
    (Begin(), ()),
)
"""What ends a moving stream, and the reasons of the batches after it."""


@case("stream-ended", "stops end a stream, and batches get the reason", "R5, R7a", background=True)
@generated
def _early_end(bench: Bench) -> Iterator[Step]:
    for end, reasons in _ENDS:
        yield from (Way(60), Begin(WAY[:25]), Moving(), Pass(0.6), end, Standing(), Executed())
        yield Pass(0.3)
        if reasons:
            yield Batch(WAY[25:30], reply=Refused(reasons, None), first=25)
        yield from (Rest(2), StartAgain(), Rest(3), Reconnect(), MovesOn(3), Pass(1.5))


@case("stream-client-lost", "a stream ends with its client")
@generated
def _client_lost(bench: Bench) -> Iterator[Step]:
    lost = RawReason.CLIENT_LOST
    for abort in (False, True):
        started = (Way(40), Begin(WAY[:25]), Moving(), Pass(0.5))
        for beginning, reasons in (
            (started, lost),
            ((*started, At(24), Pass(0.3)), lost),
            ((Way(40), Begin(WAY[:2])), (lost, RawReason.INCOMPLETE)),
        ):
            yield from (*beginning, Reconnect(0, abort=abort), Standing())
            if beginning is started:
                yield NotAt(24)
            yield from (Rest(3), _Reason(reasons), MovesOn(3), Pass(1.5))


class _Reason:
    """PROGRESS contains one of these reasons."""

    def __init__(self, reasons: RawReason | tuple[RawReason, ...]) -> None:
        self._reasons = reasons if isinstance(reasons, tuple) else (reasons,)

    def play(self, run: Run) -> None:
        """Read PROGRESS."""
        run.pause()
        seen = run.bench.progress(run.watcher)
        if seen.reason not in self._reasons:
            raise CheckFailed(f"{self._reasons} is right, PROGRESS says {seen}")


case("stream-taken-over", "a new client ends a silent stream", "R12")(
    steps(Way(30), Begin(WAY[:]), Moving(), Reconnect(3), Standing(10), MovesOn())
)


@case("batch-not-now", "a stream while no motion is possible", "R7a", background=True)
@generated
def _not_now(bench: Bench) -> Iterator[Step]:
    """A stream and a program are rejected like a download."""
    for action, reasons in (
        ("stop", (RawReason.NOT_EXECUTING,)),
        ("e-stop", (RawReason.EMERGENCY_STOP, RawReason.MOTORS_OFF)),
    ):
        yield from (Operator(action), Pass(0.5), Begin(), Way(20))
        yield from (Batch(WAY[:], reply=Refused(reasons, 0, -1)), _ProgramRefused(reasons))
        yield from (StartAgain(), Rest(3), Reconnect(1.2))


class _ProgramRefused:
    """Begin a program; its first part is rejected for one of these reasons."""

    def __init__(self, reasons: tuple[RawReason, ...]) -> None:
        self._reasons = reasons

    def play(self, run: Run) -> None:
        """Send the first part of a program."""
        run.trajectory += 1
        program = Programmer(run.bench, run.link)
        reply = program.send(orders(run.bench, 3, random.Random(3)), BEGIN | WHOLE)
        if not isinstance(reply, messages.RawPointsRefused) or reply.reason not in self._reasons:
            raise CheckFailed(f"the first part of a program is answered by {reply}")


@case("early-ends", "streams that end before they move", "R5")
@generated
def _early_ends(bench: Bench) -> Iterator[Step]:
    current = bench.position
    far = changed(current, 0, bench.group.joints[0].upper + 1)
    here: Sequence[Point] = [(current, 1.0)]
    superseded = Refused(RawReason.SUPERSEDED, 0, -1)
    yield from (Begin(here, END), Pass(0.3), Progress(DONE, counts=(1, 1, 1)))
    yield from (Batch(reply=Accepted(1, DONE)), Batch(here, reply=Refused(SEQUENCE_GAP, 1)))
    yield Begin((), END, Refused(SEQUENCE_GAP))
    third = [(current, 1.0), (current, 1.0), (far, _SLOW)]
    yield Begin(third, reply=Refused(RawReason.JOINT_LIMIT, 2, joint=1))
    # The earlier rejection is not reported for the next stream.
    yield from (Begin(), Download(), Batch(here, reply=superseded))
    # The beginning of a stream discards a trajectory that is partly received or skipped.
    yield from (Begin(), Alone(1))
    for joints in (far, current):
        yield from (Download((-1, 1), [(joints, 1.0), (far, 1.0)]), Begin(), Alone(2))
        # A single point is skipped to its end.
        yield Download((int(messages.RawSpecial.END),))
    short = _write(28, b"\x01")
    yield from (Begin(), Stop())
    refused = Refused(RawReason.STOPPED, 0, -1)
    yield from (Batch(here, reply=refused), Changed([*here, *here], "one point", short, refused))
    if not bench.config.commissioning:
        not_executing = Refused(RawReason.NOT_EXECUTING, 0, -1)
        yield from (Begin(), Operator("stop"), Batch(), Begin(), Batch(), Begin())
        yield from (Batch(here, reply=not_executing), Operator("start"), Pass(0.3))
    # A client that leaves before its stream has a point.
    yield from (Begin(), Reconnect(0), Progress(REFUSED, RawReason.INCOMPLETE, (0,), (0, 0)))
    yield from (Begin(), Stop(), Reconnect(0), Progress(STOPPED, RawReason.STOPPED, (0,)))
    yield from (Begin(), Changed([*here, *here], "one point", short, Refused(FRAMING)))
    yield from (Reconnect(0.3), Begin(), Batch(way(bench, 3)))
    yield Batch(way(bench, 3), reply=Refused(SEQUENCE_GAP, 3), first=17)
    yield from (Reconnect(1), Rest(0.2), Healthy())


@case("stream-values", "each value of a stream's points at its bounds and beyond", "R10, R11")
@generated
def _each_value(bench: Bench) -> Iterator[Step]:
    current, policy = bench.position, bench.config.trajectory
    for number, joint in enumerate(bench.group.joints, 1):
        unit, near = small_unit(joint), bench.start_tolerance(joint)
        axis = number - 1
        if near > 0:
            start = changed(current, axis, inward(joint, current[axis], 1.03 * near))
            refused = Refused(RawReason.START_TOO_FAR, joint=number)
            yield Begin([(start, 1.0), (current, 1.0)], reply=refused)
        for value in (joint.lower - 0.0015 * unit, joint.upper + 0.0015 * unit):
            refused = Refused(RawReason.JOINT_LIMIT, joint=number)
            yield Begin([(changed(current, axis, value), 1.0), (current, _SLOW)], reply=refused)
    for seconds in (0.0, -1e-6, -2.0):
        bad = Refused(RawReason.BAD_DURATION, 2)
        yield Begin([(current, 1.0), (current, 1.0), (current, seconds)], reply=bad)
        # The first duration has no effect; but it must not be negative.
        first = Refused(RawReason.BAD_DURATION) if seconds < 0 else Accepted(2)
        yield Begin([(current, seconds), (current, 1.0)], reply=first)
    if policy.too_fast != "refuse":
        return
    least, short = policy.min_segment, policy.min_segment - 1e-4
    if short > 0.005:
        for flags, durations, reply in (
            (NONE, (1.0, short, 1.0), Refused(RawReason.SEGMENT_TOO_SHORT, 1)),
            (END, (1.0, short, 1.0), Refused(RawReason.SEGMENT_TOO_SHORT, 1)),
            (NONE, (1.0, least, short), Refused(RawReason.SEGMENT_TOO_SHORT, 2)),
            (END, (1.0, least, short), Accepted(3)),
        ):
            yield Begin([(current, seconds) for seconds in durations], flags, reply)
    if bench.group.tcp_speed_limit >= 5:
        yield from _speeds(bench)


def _speeds(bench: Bench) -> Iterator[Step]:
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
                fast = [(current, 1.0), (other, _SLOW), (one, seconds)]
                yield Begin(fast, reply=Refused(RawReason.TOO_FAST, 2, joint=axis + 1))
    yield from (Begin(allowed), Stop(), Standing(2), Rest(0.1))


@case("stream-move-fails", "the motion task ends a stream")
def _move_fails(bench: Bench) -> None:
    stream, points = Streamer(bench), way(bench, 24)
    trajectory = stream.takes("a stream", points[:10], BEGIN).trajectory
    bench.wait_until_moving(1)
    fails(bench, "ROS_motion", "MoveAbsJ", "ERR_COLL_STOP")
    bench.run(0.5)
    bench.wait_until_standing(3)
    reply = stream.refuses(RawReason.COLLISION, "a batch after a collision", points[10:14])
    if (reply.trajectory, reply.accepted) != (trajectory, 10) or not 0 <= reply.point < 10:
        raise CheckFailed(f"a batch after a collision is answered by {reply}")
    bench.assert_moves_through(stream.link, bench.way_to(points[0][0]))
