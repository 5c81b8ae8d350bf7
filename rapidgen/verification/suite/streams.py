"""Endless trajectories: batches, credits, starvation and cut streams."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawReason, RawStreamFlag, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, distance
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.testbench import Bench

case = SuiteGroup("streaming", needs="stream")

_NONE = RawStreamFlag(0)


def way(bench: Bench, count: int, duration: float = 0.15) -> list[Point]:
    """Return `count` small points there and back; the first is here."""
    duration = max(duration, 1.05 * bench.config.trajectory.min_segment)
    return [(p, duration) for p, _ in bench.wave(count, duration=duration, size=0.03)]


def _progress(bench: Bench, link: RawLink) -> messages.RawProgress:
    bench.run(halt_timeout(bench))
    return bench.progress(link)


@case("stream", "a stream longer than the ring is executed whole, in time", "R1", once=True)
def _whole_stream(bench: Bench) -> None:
    """Stream more points than the ring holds, in batches of many sizes."""
    watcher, since = bench.watcher(), bench.now
    points = way(bench, 2 * bench.config.trajectory.ring + 7, 0.12)
    stream = Streamer(bench)
    for size in (1, 7, 20):
        since = bench.now
        requested = sum(d for _, d in points[1:])
        stream.number += 1
        stream.sent, stream.points, stream.room = 0, [], bench.config.trajectory.ring - 1
        stream.all(points, size=size)
        bench.arrives(points, since, 30 + requested)
        if bench.now - since > 1.3 * requested + 3:
            raise CheckFailed(f"{requested:.1f} s of a stream took {bench.now - since:.1f} s")
        reply = _progress(bench, watcher)
        count = len(points)
        if reply[1:] != (RawTrajectoryState.DONE, count, count, count, 0, -1, 0):
            raise CheckFailed(f"a stream of {count} points is done, PROGRESS says {reply}")
        points = [*reversed(points)]


@case("preload", "motion begins with enough points in the ring, or on request")
def _preload(bench: Bench) -> None:
    """Start the motion with enough preload, at the end, or on request."""
    seconds = bench.config.trajectory.preload
    points = way(bench, 40, 0.2)
    few = max(2, int(0.6 * seconds / points[1][1]))
    if few * points[1][1] >= seconds:
        raise NotApplicable("`preload` is shorter than a few points")
    for flags in (END, FLUSH, _NONE):
        stream = Streamer(bench)
        own = [(p, points[1][1]) for p, _ in way(bench, 40, 0.2)]
        stream.takes("the first points", own[:few], BEGIN)
        bench.assert_at_rest(3, f"{few} points are less than it wants to have")
        if flags:
            stream.put((), flags)
        else:
            stream.put(own[few : few + 8])
        stream.accepted("the rest")
        bench.wait_until_moving(2)
        stream.put((), END)
        bench.wait_until_at(stream.points[-1][0], 20)
        stream.link.close(then=1.5)


@case("starves", "starvation is a stop on the path; more points go on", "R9")
def _starves(bench: Bench) -> None:
    """Starve a stream: the robot stops on its path, reports, and resumes."""
    watcher = bench.watcher()
    points, since = way(bench, 45), bench.now
    stream = Streamer(bench)
    stream.takes("the first points", points[:15], BEGIN)
    bench.wait_until_at(points[14][0], 20)
    bench.assert_at_rest(2, "the stream has starved")
    reply = _progress(bench, watcher)
    if (reply.state, reply.reached, reply.reason) != (RawTrajectoryState.STARVED, 15, 0):
        raise CheckFailed(f"a stream has starved after 15 points, PROGRESS says {reply}")
    status = bench.status(watcher)
    if (status.in_motion, status.in_error) != (0, 0):
        raise CheckFailed(f"a stream has starved, STATUS says {status}")
    stream.put(points[15:17])
    if bench.config.trajectory.preload > 3 * points[1][1]:
        bench.assert_at_rest(2, "two points are too few to go on with")
    stream.put(points[17:30])
    bench.wait_until_at(points[29][0], 20)
    bench.run(1)
    stream.put(points[30:], END)
    bench.arrives(points, since, 20)
    reply = _progress(bench, watcher)
    if (reply.state, reply.reached) != (RawTrajectoryState.DONE, 45):
        raise CheckFailed(f"a stream that starved twice is done, PROGRESS says {reply}")


def _cut(bench: Bench, data: bytes, reason: RawReason, what: str, taken: int = 0) -> None:
    """Send an invalid batch in a moving stream: only accepted points run."""
    watcher, since = bench.watcher(), bench.now
    points = way(bench, 30)
    stream = Streamer(bench, number=3)
    stream.takes("the first points", points[:20], BEGIN)
    bench.wait_until_moving()
    stream.say(data)
    reply = stream.refused(reason, what)
    if reply.accepted != 20 + taken:
        raise CheckFailed(f"{what}: {20 + taken} points are right, the reply is {reply}")
    stream.sent = 20
    stream.refuses(reason, f"a batch after {what}", points[20:24])
    bench.wait_until_standing(20)
    bench.executed(points[: 20 + taken], since)
    if not taken and distance(bench.position, points[19][0]) > 1e-3:
        raise CheckFailed(f"{what}: the points before it are not executed")
    bench.assert_at_rest(2, what)
    progress, status = _progress(bench, watcher), bench.status(watcher)
    if (progress.state, progress.reason) != (RawTrajectoryState.FAILED, reason):
        raise CheckFailed(f"{what}: PROGRESS says {progress}")
    if status.in_error != 1 or status.error_code % 100 != reason:
        raise CheckFailed(f"{what}: STATUS says {status}")
    fresh = Streamer(bench, stream.link, number=4)
    fresh.all(way(bench, 12))
    bench.wait_until_at(fresh.points[-1][0], 20)
    watcher.close()
    stream.link.close(then=1.5)


def _maker(bench: Bench) -> Streamer:
    """Return a maker of stream 3 frames that sends none."""
    maker = Streamer(bench, number=3)
    maker.link.close(then=1.2)
    maker.sent = 20
    return maker


@case("stream-checksum", "a damaged batch cuts the stream")
def _wrong_checksum(bench: Bench) -> None:
    for place in (-1, -8, 40, 24, 60):
        data = bytearray(_maker(bench).frame(way(bench, 3), _NONE))
        data[place] ^= 1
        _cut(bench, bytes(data), RawReason.CHECKSUM, f"a bit of byte {place} of a batch turned")


@case("stream-hole", "a missing or repeated batch cuts the stream", "C4")
def _hole(bench: Bench) -> None:
    for first in (19, 21, 0, 30):
        data = _maker(bench).frame(way(bench, 3), _NONE, first=first)
        _cut(bench, data, RawReason.SEQUENCE_GAP, f"a batch that begins at {first} instead of 20")


@case("stream-size", "a batch whose length does not fit cuts the stream", "R2")
def _wrong_size(bench: Bench) -> None:
    data = bytearray(_maker(bench).frame(way(bench, 4), _NONE))
    data[28:32] = (3).to_bytes(4, "little")
    _cut(bench, bytes(data), RawReason.FRAMING, "a batch of four points that says three")


@case("stream-point", "points before a wrong one are executed", "R10")
def _wrong_point(bench: Bench) -> None:
    current, joints = bench.position, bench.group.joints
    wrong: list[tuple[RawReason, Point]] = [
        (RawReason.JOINT_LIMIT, ((*current[:1], joints[1].upper + 0.1, *current[2:]), 30.0)),
        (RawReason.BAD_DURATION, (current, 0.0)),
        (RawReason.BAD_DURATION, (current, -1.0)),
    ]
    if bench.config.trajectory.too_fast == "refuse":
        wrong.append(
            (RawReason.SEGMENT_TOO_SHORT, (current, bench.config.trajectory.min_segment / 2))
        )
    for reason, point in wrong:
        if reason is RawReason.SEGMENT_TOO_SHORT and bench.config.trajectory.min_segment < 0.005:
            continue
        good = way(bench, 4)
        if point[0] == current:
            point = (good[1][0], point[1])
        points = [*[(p, 1.0) for p, _ in good[:2]], point, good[3]]
        data = _maker(bench).frame(points, _NONE)
        _cut(bench, data, reason, f"a third point with {reason.name}", 2)


@case("stream-names", "a refusal names point and joint")
def _names_the_point(bench: Bench) -> None:
    stream = Streamer(bench)
    points = [(p, 30.0) for p, _ in way(bench, 6)]
    points[4] = ((points[4][0][0], bench.group.joints[1].lower - 0.1, *points[4][0][2:]), 30.0)
    stream.put(points, BEGIN | END)
    reply = stream.refused(RawReason.JOINT_LIMIT, "joint 2 of point 4 is outside its limits")
    if (reply.accepted, reply.point, reply.joint) != (4, 4, 2):
        raise CheckFailed(f"joint 2 of point 4 is outside its limits, the reply is {reply}")


@case("stream-begins-wrong", "a wrong beginning moves nothing", "R8")
def _first_batch_is_wrong(bench: Bench) -> None:
    """Start a stream with an invalid batch: nothing moves."""
    far = [(bench.group.joints[0].upper + 1, *bench.position[1:])]
    joint, current = bench.group.joints[0], bench.position
    step = 0.2 if joint.upper - current[0] > current[0] - joint.lower else -0.2
    away = [(current[0] + step, *current[1:])]
    for reason, joints in ((RawReason.JOINT_LIMIT, far), (RawReason.START_TOO_FAR, away)):
        stream = Streamer(bench)
        stream.refuses(reason, "a first point that is wrong", [(p, 1.0) for p in joints], BEGIN)
        stream.refuses(reason, "a batch after a first point that is wrong", way(bench, 10))
        bench.assert_at_rest(3, "the first point of the stream is wrong")
        stream.link.close(then=1.5)
    stream = Streamer(bench, number=9)
    for flags in (_NONE, END, FLUSH):
        stream.refuses(RawReason.NO_START, "a batch without a beginning", way(bench, 10), flags)
    stream.sent = 0
    data = bytearray(stream.frame(way(bench, 10), BEGIN))
    data[50] ^= 4
    stream.say(bytes(data))
    stream.refused(RawReason.CHECKSUM, "a damaged beginning")
    stream.refuses(RawReason.SEQUENCE_GAP, "an end without a point", (), BEGIN | END)
    bench.assert_at_rest(3, "no stream has started")
    stream.number, stream.sent = 10, 0
    stream.all(way(bench, 10))
    bench.wait_until_at(stream.points[-1][0], 20)


@case("overrun", "more points than fit cut the stream", "R1")
def _overrun(bench: Bench) -> None:
    watcher, since = bench.watcher(), bench.now
    ring = bench.config.trajectory.ring
    points = way(bench, 2 * ring, 0.12)
    stream = Streamer(bench)
    stream.put(points[:20], BEGIN)
    while stream.room >= 20:
        stream.takes("points that fit", points[stream.sent : stream.sent + 20])
    before = stream.sent
    stream.link.send(stream.frame(points[before : before + 20], _NONE))
    stream.link.send(stream.frame(points[before + 20 : before + 40], _NONE, first=before + 20))
    for _ in range(2):
        stream.reply()
    answer = stream.refused(RawReason.OVERRUN, "more points than fit")
    if not before <= answer.accepted <= before + 20:
        raise CheckFailed(f"{before} points were sent with places for them, the reply is {answer}")
    bench.wait_until_standing(60)
    bench.executed(points[: answer.accepted], since)
    if distance(bench.position, points[answer.accepted - 1][0]) > 1e-3:
        raise CheckFailed("points that were accepted before an overrun are not executed")
    if _progress(bench, watcher).reason != RawReason.OVERRUN:
        raise CheckFailed(f"after an overrun PROGRESS says {bench.progress(watcher)}")


@case("behind-the-end", "nothing follows the end of a stream")
def _after_end(bench: Bench) -> None:
    stream = Streamer(bench)
    points = way(bench, 12)
    stream.all(points)
    stream.refuses(RawReason.SEQUENCE_GAP, "points after the end", way(bench, 3))
    bench.wait_until_at(points[-1][0], 20)
    bench.assert_at_rest(2, "the stream has ended")


@case("stream-ended", "stops end a stream, and batches get the reason", "R5, R7a", background=True)
def _early_end(bench: Bench) -> None:
    """End a stream by each event; batches report the reason."""
    stopped = (RawReason.MOTORS_OFF, RawReason.PROGRAM_STOPPED, RawReason.EMERGENCY_STOP)
    for action, reasons in (
        ("STOP", (RawReason.STOPPED,)),
        ("e-stop", stopped),
        ("stop", stopped),
        ("motors-off", stopped),
        ("download", (RawReason.SUPERSEDED,)),
        ("stream", (RawReason.SUPERSEDED,)),
    ):
        since, points = bench.now, way(bench, 60)
        stream = Streamer(bench, number=5)
        stream.put(points[:25], BEGIN)
        bench.wait_until_moving()
        bench.run(0.6)
        if action == "STOP":
            stream.link.stop()
        elif action == "download":
            stream.link.send(bench.download(bench.wave(4))[:68])
        elif action == "stream":
            Streamer(bench, stream.link, number=6).put((), BEGIN)
        else:
            bench.controller.perform(action)
        bench.wait_until_standing(5)
        bench.executed(points, since)
        bench.run(0.3)
        if action != "stream":
            stream.put(points[25:30])
            reply = stream.last
            if not isinstance(reply, messages.RawPointsRefused) or reply.reason not in reasons:
                raise CheckFailed(f"a stream was ended by {action}, a batch is answered by {reply}")
        bench.assert_at_rest(2, f"the stream was ended by {action}")
        bench.start_again()
        bench.assert_at_rest(3, f"the stream was ended by {action}, then the program was started")
        stream.link.close(then=1.5)
        bench.assert_moves_through(bench.motion(), bench.wave(3))
        bench.run(1.5)


@case("stream-client-lost", "a stream ends with its client")
def _client_lost(bench: Bench) -> None:
    for started, starved in ((True, False), (True, True), (False, False)):
        for abort in (False, True):
            watcher = bench.watcher()
            points = way(bench, 40)
            stream = Streamer(bench)
            stream.put(points[: 25 if started else 2], BEGIN)
            if started:
                bench.wait_until_moving()
                bench.run(0.5)
            if starved:
                bench.wait_until_at(points[24][0], 20)
                bench.run(0.3)
            stream.link.close(abort=abort)
            bench.wait_until_standing(5)
            if not starved and distance(bench.position, points[24][0]) < 1e-4:
                raise CheckFailed("a stream went on to its last point for a client that had left")
            bench.assert_at_rest(3, "the client of the stream has left")
            reply = _progress(bench, watcher)
            reasons = (
                [RawReason.CLIENT_LOST]
                if started
                else [RawReason.CLIENT_LOST, RawReason.INCOMPLETE]
            )
            if reply.reason not in reasons:
                raise CheckFailed(f"the client of a stream has left, PROGRESS says {reply}")
            watcher.close()
            bench.assert_moves_through(bench.motion(), bench.wave(3))
            bench.run(1.5)


@case("stream-taken-over", "a new client ends a silent stream", "R12")
def _taken_over(bench: Bench) -> None:
    """Connect a standard client while a silent stream's client is there.

    The new client takes over.
    """
    stream = Streamer(bench)
    stream.put(way(bench, 30), BEGIN)
    bench.wait_until_moving()
    link = bench.motion()
    bench.run(3)
    bench.wait_until_standing(10)
    bench.assert_moves_through(link, bench.wave(4))
