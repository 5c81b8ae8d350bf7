"""A raw client that streams batches with credits, valid or invalid."""

from collections.abc import Sequence

from rapidgen.verification import messages
from rapidgen.verification.batches import batch_points, points_frame
from rapidgen.verification.messages import POINTS, RawReason, RawStreamFlag
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.testbench import Bench

BEGIN, END, FLUSH = RawStreamFlag.BEGIN, RawStreamFlag.END, RawStreamFlag.FLUSH
NONE = RawStreamFlag(0)


def way(bench: Bench, count: int, duration: float = 0.15) -> list[Point]:
    """Return `count` small points there and back; the first is here."""
    duration = max(duration, 1.05 * bench.config.trajectory.min_segment)
    return [(p, duration) for p, _ in bench.wave(count, duration=duration, size=0.03)]


class Streamer:
    """One stream over one connection to the motion server."""

    def __init__(self, bench: Bench, link: RawLink | None = None, number: int = 1) -> None:
        self.bench = bench
        self.link = link if link is not None else bench.motion()
        self.number = number
        self.sent = 0
        """Points sent so far."""
        self.room = bench.config.trajectory.ring - 1
        self.last: messages.RawContent | None = None
        self.points: list[Point] = []

    def frame(
        self, points: Sequence[Point], flags: RawStreamFlag, first: int | None = None
    ) -> bytes:
        """One POINTS message."""
        at = self.sent if first is None else first
        return points_frame(self.number, at, points, flags)

    def put(self, points: Sequence[Point], flags: RawStreamFlag = NONE) -> messages.RawContent:
        """Send one batch, split over messages if needed; return the last reply."""
        most = batch_points(len(self.bench.position))
        parts = [points[at : at + most] for at in range(0, len(points), most)] or [points]
        for number, part in enumerate(parts):
            own = flags & ~(END | FLUSH) if number + 1 < len(parts) else flags
            self.link.send(self.frame(part, own & ~BEGIN if number else own))
            self.sent += len(part)
            self.points += part
            answer = self.reply()
        return answer

    def say(self, frame: bytes) -> messages.RawContent:
        """Send a batch as bytes, valid or not; return the reply."""
        self.link.send(frame)
        return self.reply()

    def reply(self) -> messages.RawContent:
        """Return the next reply to a batch."""
        self.last = self.link.reply(POINTS, 5)
        if isinstance(self.last, messages.RawPointsAccepted):
            self.room = self.last.room
        return self.last

    def accepted(self, what: str) -> messages.RawPointsAccepted:
        """Return the last reply; check that it is a success."""
        if not isinstance(self.last, messages.RawPointsAccepted):
            raise CheckFailed(f"{what}: the reply is {self.last}")
        return self.last

    def refused(self, reason: RawReason, what: str) -> messages.RawPointsRefused:
        """Return the last reply; check that it is a rejection for that reason."""
        if not isinstance(self.last, messages.RawPointsRefused) or self.last.reason != reason:
            raise CheckFailed(f"{what}: wanted {reason.name}, the reply is {self.last}")
        return self.last

    def takes(
        self, what: str, points: Sequence[Point], flags: RawStreamFlag = NONE
    ) -> messages.RawPointsAccepted:
        """Send a batch and check that the reply is a success."""
        self.put(points, flags)
        return self.accepted(what)

    def refuses(
        self, reason: RawReason, what: str, points: Sequence[Point], flags: RawStreamFlag = NONE
    ) -> messages.RawPointsRefused:
        """Send a batch and check that the reply is a rejection for that reason."""
        self.put(points, flags)
        return self.refused(reason, what)

    def all(self, points: Sequence[Point], *, end: bool = True, size: int = 10) -> None:
        """Send a whole stream, never more points than the driver has space for."""
        at = 0
        while at < len(points):
            batch = points[at : at + max(1, min(size, self.room))]
            if self.room < len(batch):
                self.bench.run(0.05)
                self.put(())
                continue
            at += len(batch)
            flags = RawStreamFlag(0)
            if not self.sent:
                flags |= BEGIN
            if end and at == len(points):
                flags |= END
            self.takes(f"points up to {at} of {len(points)}", batch, flags)
