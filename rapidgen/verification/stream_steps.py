"""Steps of streams, as data: batches and their replies.

Points are given as a part of the present way (`WAY[:20]`), or as values. Every reply to a batch is
compared as a whole: number of the stream, number of the trajectory, accepted points, reason, point
and joint.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

from rapidgen.verification import messages
from rapidgen.verification.batches import points_frame
from rapidgen.verification.messages import (
    INDEX_WRAP,
    RawReason,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.steps import NO_POINTS, Part, Run
from rapidgen.verification.stream import BEGIN, NONE, Streamer

Change: TypeAlias = Callable[[bytearray], object]
"""Changes a message in place."""


# -- replies -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Accepted:
    """Reply that accepts so many points; by default all that were sent."""

    points: int | None = None
    state: RawTrajectoryState | None = None
    places: int | None = None
    """Free places of the ring buffer."""

    def check(self, reply: messages.RawContent, run: Run) -> None:
        """Compare a reply."""
        stream = run.stream
        points = stream.sent % INDEX_WRAP if self.points is None else self.points
        if (
            not isinstance(reply, messages.RawPointsAccepted)
            or reply[:3] != (stream.number, run.of_stream, points)
            or self.state not in (None, reply.state)
            or self.places not in (None, reply.room)
        ):
            raise CheckFailed(
                f"{points} points of trajectory {run.of_stream} are right, the reply is {reply}"
            )


@dataclass(frozen=True, slots=True)
class Refused:
    """Reply that rejects a batch, for one of these reasons.

    By default it is about the present stream, and the first point that was not accepted is
    faulty. None: not compared.
    """

    reason: RawReason | tuple[RawReason, ...]
    accepted: int | None = 0
    point: int | None = None
    joint: int = 0
    stream: int | None = None
    trajectory: int | None = None

    def check(self, reply: messages.RawContent, run: Run) -> None:
        """Compare a reply."""
        reasons = self.reason if isinstance(self.reason, tuple) else (self.reason,)
        if not isinstance(reply, messages.RawPointsRefused):
            raise CheckFailed(f"the reply is {reply}")
        expected = reply._replace(
            stream=run.stream.number if self.stream is None else self.stream,
            trajectory=run.of_stream if self.trajectory is None else self.trajectory,
        )
        if self.accepted is not None:
            point = self.accepted if self.point is None else self.point
            expected = expected._replace(accepted=self.accepted, point=point, joint=self.joint)
        if reply != expected or reply.reason not in reasons:
            raise CheckFailed(f"{expected} for one of {reasons} is right, the reply is {reply}")


def unrelated(reason: RawReason, number: int) -> Refused:
    """Return the rejection of a batch that belongs to no stream."""
    return Refused(reason, 0, -1, stream=number, trajectory=0)


Reply: TypeAlias = Accepted | Refused
ACCEPTED = Accepted()


# -- batches -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Begin:
    """Begin a stream with these points."""

    points: Part = NO_POINTS
    flags: RawStreamFlag = NONE
    reply: Reply = ACCEPTED
    number: int | None = None
    """By default the next one."""

    def play(self, run: Run) -> None:
        number = run.stream.number + 1 if self.number is None else self.number
        run.stream = Streamer(run.bench, run.link, number=number)
        run.trajectory += 1
        run.of_stream = run.trajectory
        self.reply.check(run.stream.put(run.points(self.points), BEGIN | self.flags), run)


@dataclass(frozen=True, slots=True)
class Batch:
    """Send a batch of the present stream."""

    points: Part = NO_POINTS
    flags: RawStreamFlag = NONE
    reply: Reply = ACCEPTED
    first: int | None = None
    """Index of its first point; by default the next one."""

    def play(self, run: Run) -> None:
        if self.first is not None:
            run.stream.sent = self.first
        before = run.stream.sent
        reply = run.stream.put(run.points(self.points), self.flags)
        if isinstance(self.reply, Refused):
            run.stream.sent = before
        self.reply.check(reply, run)


@dataclass(frozen=True, slots=True)
class Foreign:
    """Send a batch with a number that is not that of the present stream."""

    number: int
    points: Part
    flags: RawStreamFlag
    reply: Refused
    change: Change | None = field(default=None, repr=False)

    def play(self, run: Run) -> None:
        data = bytearray(points_frame(self.number, 0, run.points(self.points), self.flags))
        if self.change is not None:
            self.change(data)
        self.reply.check(run.stream.say(bytes(data)), run)


@dataclass(frozen=True, slots=True)
class Changed:
    """Send a batch of the present stream that was changed on its way."""

    points: Part
    what: str
    change: Change = field(repr=False)
    reply: Reply
    flags: RawStreamFlag = NONE
    first: int | None = None

    def play(self, run: Run) -> None:
        data = bytearray(run.stream.frame(run.points(self.points), self.flags, self.first))
        self.change(data)
        self.reply.check(run.stream.say(bytes(data)), run)


@dataclass(frozen=True, slots=True)
class Whole:
    """Send a stream of the way in batches of `size`, with respect to the free places."""

    size: int = 10

    def play(self, run: Run) -> None:
        stream = Streamer(run.bench, run.link, number=run.stream.number + 1)
        run.trajectory += 1
        run.stream, run.of_stream = stream, run.trajectory
        stream.all(run.way, size=self.size)
