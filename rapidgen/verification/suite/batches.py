"""Single batches of points: contents of each reply, and invalid batches."""

import random

from rapidgen.verification import messages
from rapidgen.verification.batches import checksum, words_frame, words_of, words_to
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawReason, RawStreamFlag, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, distance
from rapidgen.verification.raw_programs import WHOLE, Programmer, orders
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.suite.motion_task import datum
from rapidgen.verification.suite.streams import way
from rapidgen.verification.testbench import Bench

case = SuiteGroup("streaming", needs="stream")

_NONE = RawStreamFlag(0)
_LARGEST = 2**23 - 1


@case("batch-replies", "replies to batches: counts, free places, state")
def _replies(bench: Bench) -> None:
    """Check stream, trajectory, accepted points, space and progress of replies."""
    watcher, ring = bench.watcher(), bench.config.trajectory.ring
    stream = Streamer(bench, number=_LARGEST)
    points = way(bench, 40)
    task = bench.controller.task(bench.task("ROS_motion"))
    for first in range(0, 40, 10):
        stream.put(points[first : first + 10], _NONE if first else BEGIN)
        reply = stream.accepted(f"points from {first} on")
        if (reply.stream, reply.accepted) != (_LARGEST, first + 10):
            raise CheckFailed(
                f"{first + 10} points of stream {_LARGEST} were sent, the reply is {reply}"
            )
        if not reply.reached <= reply.planned <= reply.accepted:
            raise CheckFailed(f"counts of a reply do not fit each other: {reply}")
        # The motion task may take points between the two readings, of planned and then of space:
        # the first points are short, and random task order decides how many.
        setting = bench.setting
        otherwise = setting.seed or setting.group or setting.random_schedule
        between = 4 if otherwise or setting.slowness > 1 else 0
        in_it = task[datum(bench, "ros_head")] - task[datum(bench, "ros_tail")]
        if (
            reply.room > ring - 1 - in_it
            or reply.accepted > ring - 1 - reply.room + reply.planned + between
        ):
            raise CheckFailed(f"a ring of {ring} places, the reply is {reply}")
        bench.run(0.3)
        if bench.progress(watcher).trajectory != reply.trajectory:
            raise CheckFailed(f"PROGRESS is of another trajectory than {reply}")
    stream.put(())
    if stream.accepted("a batch without points").state != RawTrajectoryState.MOVING:
        raise CheckFailed(f"the robot moves, the reply is {stream.last}")
    bench.wait_until_at(points[-1][0], 30)
    bench.run(0.5)
    reply = stream.takes("a batch without points, starved", ())
    if reply[2:] != (40, ring - 1, 40, 40, RawTrajectoryState.STARVED):
        raise CheckFailed(f"all of 40 points are executed, the reply is {reply}")
    stream.put((), END)
    bench.run(0.5)
    for flags in (_NONE, END):
        stream.put((), flags)
        if stream.accepted("a batch without points after the end").state != RawTrajectoryState.DONE:
            raise CheckFailed(f"the stream is done, the reply is {stream.last}")


@case("batch-strange", "batches of no stream", "C4")
def _strange(bench: Bench) -> None:
    """Send a batch of no stream: the reply does not concern a trajectory."""
    stream = Streamer(bench, number=7)
    points = way(bench, 4)
    for number, flags in ((7, _NONE), (7, END), (0, BEGIN), (0, _NONE), (_LARGEST + 1, BEGIN)):
        stream.number, stream.sent = number, 0
        reply = stream.refuses(RawReason.NO_START, f"stream {number}, {flags!r}", points, flags)
        expected = number if number <= _LARGEST else 0
        if reply != messages.RawPointsRefused(expected, 0, 0, RawReason.NO_START, -1, 0):
            raise CheckFailed(f"a batch of no stream is answered by {reply}")
    stream.number, stream.sent = 7, 0
    stream.takes("a beginning", points, BEGIN)
    stream.number = 8
    stream.refuses(RawReason.NO_START, "a batch of another stream", points)
    stream.number, stream.sent = 7, 4
    stream.takes("the rest of a stream", way(bench, 4), END)
    bench.run(3)
    bench.wait_until_standing(5)


def _damaged(frame: bytes, place: int) -> bytes:
    data = bytearray(frame)
    data[place : place + 8] = b"\xff" * 8
    return bytes(data)


@case("batch-no-number", "numbers that no batch has", "R2")
def _no_number(bench: Bench) -> None:
    """Send eight bytes of ones (two invalid numbers) anywhere in a batch."""
    last = len(Streamer(bench, number=3).frame(way(bench, 4), BEGIN)) - 8
    for place, whose in ((16, 0), (24, 3), (32, 3), (40, 3), (last - 8, 3), (last, 3)):
        stream = Streamer(bench, number=3)
        stream.say(_damaged(stream.frame(way(bench, 4), BEGIN), place))
        reply = stream.last
        if (
            not isinstance(reply, messages.RawPointsRefused)
            or reply.accepted
            or reply.stream != whose
        ):
            raise CheckFailed(f"8 bytes of ff at {place} of stream 3, the reply is {reply}")
        if place >= 32 and reply.reason != RawReason.CHECKSUM:
            raise CheckFailed(f"8 bytes of ff at {place} of stream 3, the reply is {reply}")
        bench.assert_at_rest(1, "a beginning is damaged")
        stream.link.close(then=0.5)


@case("batch-beginning", "a damaged beginning while a stream moves")
def _damaged_beginning(bench: Bench) -> None:
    """Damage the start of a stream.

    The start of another stream ends nothing; the start of the current one cuts it.
    """
    for number in (4, 3):
        stream, since = Streamer(bench, number=3), bench.now
        points = way(bench, 24)
        stream.put(points[:20], BEGIN)
        bench.wait_until_moving()
        wrong = Streamer(bench, stream.link, number=number)
        data = bytearray(wrong.frame(way(bench, 3), BEGIN))
        data[60] ^= 1
        stream.say(bytes(data))
        reply = stream.refused(RawReason.CHECKSUM, "a damaged beginning")
        if reply.stream != number:
            raise CheckFailed(f"a damaged beginning of stream {number}: the reply is {reply}")
        stream.put(points[20:], END)
        if number == 4:
            stream.accepted("points of the stream under way")
            bench.wait_until_at(points[-1][0], 20)
        else:
            stream.refused(RawReason.CHECKSUM, "points after a damaged beginning")
            bench.wait_until_at(points[19][0], 20)
        bench.executed(points, since)
        stream.link.close(then=1.2)


@case("batch-enough", "just enough points to begin with")
def _enough(bench: Bench) -> None:
    """Preload exactly the required seconds, and then one point less."""
    preload = bench.config.trajectory.preload
    duration = preload / 4
    if duration < 1.05 * bench.config.trajectory.min_segment:
        raise NotApplicable("its segments are longer than a part of `preload`")
    for count, enough in ((5, True), (4, False)):
        stream = Streamer(bench)
        points = [(p, duration) for p, _ in way(bench, 5, duration)][:count]
        stream.takes("the first points", points, BEGIN)
        if enough:
            bench.wait_until_moving(1)
        else:
            bench.assert_at_rest(2, f"{(count - 1) * duration:g} s wait in the ring")
        stream.put((), FLUSH)
        bench.wait_until_at(points[-1][0], 10)
        stream.link.close(then=1.2)


@case("batch-not-now", "a stream while no motion is possible", "R7a", background=True)
def _not_now(bench: Bench) -> None:
    """Start a stream while no motion is possible: rejected, like a download."""
    for action, reasons in (
        ("stop", (RawReason.NOT_EXECUTING,)),
        ("e-stop", (RawReason.EMERGENCY_STOP, RawReason.MOTORS_OFF)),
    ):
        bench.controller.perform(action)
        bench.run(0.5)
        stream = Streamer(bench)
        stream.takes("a beginning without points", (), BEGIN)
        stream.put(way(bench, 20))
        reply = stream.last
        if not isinstance(reply, messages.RawPointsRefused) or reply.reason not in reasons:
            raise CheckFailed(f"after {action} points are answered by {reply}")
        if (reply.accepted, reply.point, reply.joint) != (0, -1, 0):
            raise CheckFailed(f"after {action} points are answered by {reply}")
        program = Programmer(bench, stream.link)
        reply = program.send(orders(bench, 3, random.Random(3)), BEGIN | WHOLE)
        if not isinstance(reply, messages.RawPointsRefused) or reply.reason not in reasons:
            raise CheckFailed(f"after {action} the first part of a program is answered by {reply}")
        bench.start_again()
        bench.assert_at_rest(3, f"points came after {action}")
        stream.link.close(then=1.2)


@case("batch-ends-early", "streams that end before they move", "R5")
def _ends_before_it_moves(bench: Bench) -> None:
    """Stop, leave or replace a stream without points: it never moves."""
    watcher = bench.watcher()
    stream = Streamer(bench)
    # A rejection of the previous stream does not count for the next one.
    stream.put([(p, 0.0) for p, _ in way(bench, 2)], BEGIN | END)
    stream.refused(RawReason.BAD_DURATION, "a second point without a duration")
    stream.number, stream.sent = 5, 0
    stream.put((), BEGIN)
    stream.link.stop()
    refusal = stream.refuses(RawReason.STOPPED, "points after a STOP", way(bench, 20))
    if (refusal.accepted, refusal.point, refusal.joint) != (0, -1, 0):
        raise CheckFailed(f"points after a STOP are answered by {refusal}")
    bench.assert_at_rest(1, "the stream was stopped")
    stream.number, stream.sent = 2, 0
    stream.put((), BEGIN)
    stream.link.send(bench.download(bench.wave(3))[:68])
    stream.refuses(RawReason.SUPERSEDED, "points after a download", way(bench, 20))
    bench.assert_at_rest(1, "the stream was superseded")
    for number in (3, 4):
        stream.number, stream.sent = number, 0
        stream.put((), BEGIN)
        if number == 4:
            stream.put(way(bench, 3), _NONE)
            stream.sent = 17
            stream.refuses(RawReason.SEQUENCE_GAP, "points after a hole", way(bench, 3), _NONE)
        stream.link.close(then=1)
        reply = bench.progress(watcher)
        expected = (RawTrajectoryState.REFUSED, RawReason.INCOMPLETE) if number == 3 else None
        if expected and (
            (reply.state, reply.reason) != expected or (reply.point, reply.joint) != (0, 0)
        ):
            raise CheckFailed(f"a stream without a point was left, PROGRESS says {reply}")
        stream = Streamer(bench)
        watcher.read()
    bench.run(1)


@case("batch-stay", "a stay in a stream", "R8")
def _stays(bench: Bench) -> None:
    """Send the same position again in a stream: a stay."""
    first, second, third = way(bench, 3, 0.4)
    stay = 1.5
    points: list[Point] = [first, second, (second[0], stay), third]
    stream, since = Streamer(bench), bench.now
    stream.takes("a stream with a stay", points, BEGIN | END)
    bench.wait_until_at(third[0], 10)
    requested = second[1] + stay + third[1]
    if not requested - 0.1 <= bench.now - since <= 1.3 * requested + 0.4:
        raise CheckFailed(f"{requested:.2f} s with a stay took {bench.now - since:.2f} s")
    still = [t for t, p in bench.track if t > since and distance(p, second[0]) < 1e-4]
    if not still:
        raise CheckFailed("the robot was not where it had to stay")
    # The next batch shows that it is a stay.
    first, second, third = way(bench, 3, 0.6)
    stream, since = Streamer(bench, stream.link, number=2), bench.now
    stream.put([first, second], BEGIN | FLUSH)
    stream.takes("a stay in another batch", [(second[0], stay), third], END)
    bench.wait_until_at(third[0], 10)
    if not any(t > since and distance(p, second[0]) < 1e-4 for t, p in bench.track):
        raise CheckFailed("the robot was not where the next batch asked for a stay")


@case("batch-short-last", "a short last segment of a stream", "R9")
def _short_last(bench: Bench) -> None:
    """Send a short last segment, which needs no successor."""
    policy = bench.config.trajectory
    if policy.too_fast != "refuse" or policy.min_segment < 0.005:
        raise NotApplicable("`min_segment` refuses no segment")
    points = [(p, 1.0) for p, _ in bench.wave(4, size=0.001)]
    points[3] = (points[3][0], policy.min_segment / 2)
    stream = Streamer(bench)
    stream.takes("a short last segment", points, BEGIN | END)
    bench.wait_until_at(points[3][0], 10)


@case("batch-silent", "a stream that is silent for seconds", "R12")
def _silent(bench: Bench) -> None:
    """Pause a stream for seconds; after its end serve a newer client."""
    stream = Streamer(bench)
    points = way(bench, 60)
    stream.put(points[:25], BEGIN)
    bench.wait_until_moving()
    bench.motion()
    bench.run(2.5)
    stream.takes("points after 2.5 s of silence", points[25:50], END)
    bench.wait_until_at(points[49][0], 30)
    stream.link.wait_disconnected(2, "a client whose stream has ended gives way")


@case("batch-index-wraps", "more points than numbers")
def _index_wraps(bench: Bench) -> None:
    """Let point numbers wrap after the last exact integer."""
    last = messages.INDEX_WRAP
    stream, since = Streamer(bench), bench.now
    points = way(bench, 40)
    stream.takes("the first points", points[:10], BEGIN)
    bench.wait_until_at(points[9][0], 20)
    bench.run(0.5)
    server, motion = bench.task("ROS_motionServer"), bench.task("ROS_motion")
    bench.controller.task(server)["ROS_motionServer:ROS_point_count"] = last - 5
    bench.controller.task(server)["ROS_stream:accepted"] = last - 5
    bench.controller.task(motion)["ROS_motion:expected_index"] = last - 4
    stream.sent = last - 5
    stream.put(points[10:20])
    if stream.accepted("points over the last number").accepted != 5:
        raise CheckFailed(f"ten points from {last - 5} on, the reply is {stream.last}")
    stream.sent = 5
    stream.takes("points after the last number", points[20:], END)
    bench.arrives(points, since, 20)


@case("batch-unreadable", "bytes of a batch that cannot be read", "R3")
def _unreadable(bench: Bench) -> None:
    """Make the bytes of a batch unreadable.

    The driver rejects the batch or drops its client.
    """
    # The frame's own, four of the head, those of two points, the checksum.
    for after in range(4 + 4 + 2 * (1 + len(bench.position)) + 1):
        stream, since = Streamer(bench), bench.now
        points = way(bench, 10)
        stream.put(points[:8], BEGIN | FLUSH)
        bench.wait_until_moving()
        recovers = fails(bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=after)
        stream.link.send(stream.frame(points[8:], _NONE))
        bench.run(0.1)
        recovers()
        if not stream.link.lost:
            stream.reply()
            answer = stream.last
            if (
                not isinstance(answer, messages.RawPointsRefused)
                or answer.reason != RawReason.CHECKSUM
            ):
                raise CheckFailed(f"read {after} of a batch has failed, the reply is {answer}")
        bench.wait_until_standing(10)
        bench.executed(points[:8], since)
        bench.assert_at_rest(0.3, f"read {after} of a batch has failed")
        bench.assert_healthy()
        stream.link.close(then=0.3)


@case(
    "batch-fits-unread", "words that cannot be read, where the checksum is right without them", "R3"
)
def _fits_unread(bench: Bench) -> None:
    """Send unreadable bytes whose checksum would match.

    The probability is 1 in 2^31, so that the read error must decide.
    """
    values = 1 + len(bench.position)
    for number, unread in enumerate(("a point", "the checksum"), 1):
        stream, since, points = Streamer(bench, number=number), bench.now, way(bench, 9)
        stream.put(points[:8], BEGIN | FLUSH)
        sent = words_of(points[8])
        head = [number, 0, 8, 2]
        expected = checksum([*head, *sent]) if unread == "a point" else 0
        sent += words_to(expected, [*head, *sent], values)
        # The words of the frame and of the head.
        after = 4 + 4 + values * number
        fails(bench, "ROS_motionServer", "UnpackRawBytes", "ERR_OUTOFBND", after=after)
        reply = stream.say(words_frame(number, 8, 2, sent))
        if not isinstance(reply, messages.RawPointsRefused) or reply.reason != RawReason.CHECKSUM:
            raise CheckFailed(f"{unread} of a batch cannot be read, the reply is {reply}")
        bench.wait_until_at(points[7][0], 10)
        bench.executed(points[:8], since)
        stream.link.close(then=0.5)


@case("batch-behind-end", "points after the end")
def _after_end(bench: Bench) -> None:
    """Send points after the end: rejected, and earlier points are executed."""
    watcher = bench.watcher()
    stream = Streamer(bench)
    stream.all(way(bench, 12))
    reply = stream.refuses(RawReason.SEQUENCE_GAP, "points after the end", way(bench, 3))
    if (reply.accepted, reply.point) != (12, 12):
        raise CheckFailed(f"points came after 12 and the end, the reply is {reply}")
    bench.wait_until_at(stream.points[11][0], 20)
    bench.run(0.5)
    progress = bench.progress(watcher)
    if (progress.state, progress.reached) != (RawTrajectoryState.DONE, 12):
        raise CheckFailed(f"points came after the end, PROGRESS says {progress}")


@case("batch-full-ring", "a full ring begins with less than it likes to have", "R1")
def _full_ring(bench: Bench) -> None:
    """Fill the ring exactly: client and driver must not wait for each other."""
    policy = bench.config.trajectory
    count, seconds = policy.ring - 1, max(0.12, 1.05 * policy.min_segment)
    if count * seconds > policy.preload:
        raise NotApplicable("a full ring lasts longer than `preload`")
    stream = Streamer(bench)
    points = way(bench, count, seconds)
    stream.takes("almost all that fit", points[:-3], BEGIN)
    bench.assert_at_rest(1, f"{count - 4} points are less than it likes to have")
    stream.put(points[-3:])
    if stream.accepted("all that fit").room:
        raise CheckFailed(f"the ring is full, the reply is {stream.last}")
    bench.wait_until_moving(1)
    stream.put((), END)
    bench.wait_until_at(points[-1][0], 30)
