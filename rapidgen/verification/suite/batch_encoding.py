"""Batches as bytes: in pieces, as topics, late, damaged or malformed."""

import random
import struct

from rapidgen.verification import batches, messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.stream import BEGIN, END, NONE, Streamer
from rapidgen.verification.suite.streams import way
from rapidgen.verification.testbench import Bench

case = SuiteGroup("streaming", needs="stream")


@case("batch-pieces", "a stream in pieces of every size", "R2")
def _in_pieces(bench: Bench) -> None:
    """Send two batches and a PING, with TCP segments of any size."""
    link = bench.motion()
    for number, size in enumerate((1, 3, 7, 15, 16, 17, 31, 500, 1000, 1020, 100_000), 1):
        points, since = way(bench, 24, 0.12), bench.now
        stream = Streamer(bench, link, number=number)
        data = stream.frame(points[:15], BEGIN)
        stream.sent = 15
        data += stream.frame(points[15:], END)
        for at in range(0, len(data), size):
            link.send(data[at : at + size])
            bench.run(0.0005)
        for count in (15, 24):
            stream.reply()
            if stream.accepted(f"in pieces of {size} bytes").accepted != count:
                raise CheckFailed(f"{count} points in pieces of {size} bytes: {stream.last}")
        bench.arrives(points, since, 10)


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
    expected = (RawTrajectoryState.FAILED, 22, 22, 22, RawReason.SEQUENCE_GAP, 22, 0)
    if progress[1:] != expected or (status.in_error, status.error_code) != (
        1,
        RawReason.SEQUENCE_GAP,
    ):
        raise CheckFailed(f"a topic after 22 points had a hole, {progress}, {status}")


@case("batch-in-time", "a batch that comes while the last point is approached", "R9")
def _just_in_time(bench: Bench) -> None:
    """Send each batch just in time.

    The robot passes all points in order, and every corner has a successor.
    """
    link = bench.motion()
    seconds = max(0.2, 1.05 * bench.config.trajectory.min_segment)
    for number in range(1, 13):
        points, since, last = way(bench, 14, seconds), bench.now, bench.last_event
        stream = Streamer(bench, link, number=number)
        stream.takes("the first points", points[:6], BEGIN)
        bench.run(4.25 * seconds + 0.02 * number)
        stream.takes("points that come just in time, or too late", points[6:], END)
        bench.arrives(points, since, 20)
        if any(e.code == 50_024 for e in bench.controller.log.since(last)):
            raise CheckFailed(f"a corner had no successor: {number * 20} ms later")


@case("batch-damage", "random damage of a batch moves nothing but what was sent", "R3")
def _damage(bench: Bench) -> None:
    """Change or cut random bytes: only a prefix of the path is executed."""
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


@case("batch-shapes", "batches of a shape that none has", "R2")
def _shapes(bench: Bench) -> None:
    """Send wrong comm types, heads, word orders, counts and lengths."""
    points = way(bench, 10)
    for comm in (0, 3, 7):
        link = bench.motion()
        link.send(batches.points_frame(7, 0, points, BEGIN, comm))
        link.wait_disconnected(5, f"comm_type {comm} drops the client")
    link = bench.motion()
    for size in (0, 8, 16):
        link.send(messages.framed(messages.POINTS, bytes(size)))
        answer = messages.decode(link.expect_reply(2, "a batch without a head is answered"))
        if not isinstance(answer, messages.RawPointsRefused | messages.RawFailure):
            raise CheckFailed(f"a batch of {size} bytes is answered by {answer}")
    for number, first in enumerate((1, messages.INDEX_WRAP - 1), 2):
        link.send(batches.points_frame(number, first, points, BEGIN))
        stream = Streamer(bench, link, number=number)
        stream.reply()
        answer = stream.refused(RawReason.SEQUENCE_GAP, f"a beginning at point {first}")
        if (answer.accepted, answer.point) != (0, 0):
            raise CheckFailed(f"a beginning at point {first}: the reply is {answer}")
    bench.assert_at_rest(1, "no stream has started")
    values = [word for point in points[5:] for word in batches.words_of(point)]
    exchanged = bytearray(batches.points_frame(7, 5, points[5:]))
    exchanged[32:40] = exchanged[36:40] + exchanged[32:36]
    data = batches.points_frame(7, 5, points[5:])[16:]
    wrong = [(bytes(exchanged), RawReason.CHECKSUM)]
    wrong += [
        (batches.words_frame(7, 5, c, values), RawReason.FRAMING) for c in (4, 6, 0, -(2**31))
    ]
    wrong += [
        (messages.framed(messages.POINTS, data[:more]), RawReason.FRAMING) for more in (-8, -4)
    ]
    wrong += [
        (messages.framed(messages.POINTS, data + bytes(more)), RawReason.FRAMING) for more in (4, 8)
    ]
    for value in (2**24 + 1, 2**31 - 1, -(2**31)):
        for place in (32, 36, len(data) + 12):
            damaged = bytearray(batches.points_frame(7, 5, points[5:]))
            struct.pack_into("<i", damaged, place, value)
            wrong.append((bytes(damaged), RawReason.CHECKSUM))
    for bad, reason in wrong:
        points = way(bench, 10)
        stream = Streamer(bench, link, number=7)
        stream.put(points[:5], BEGIN)
        link.send(bad)
        stream.reply()
        answer = stream.refused(reason, f"a batch that begins with {bad[:40].hex()}")
        if (answer.accepted, answer.point, answer.joint) != (5, 5, 0):
            raise CheckFailed(f"five points were right, the reply is {answer}")
        bench.wait_until_at(points[4][0], 10)
        if distance(bench.position, points[4][0]) > 1e-3:
            raise CheckFailed("the points before a wrong batch are not executed")
