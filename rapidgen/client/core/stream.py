"""A stream: points or instructions, sent while the robot executes the ones before. Sans-IO.

Its owner asks `has_due` and `next_frame` whenever something has changed, and sends. Nothing is
sent that the controller has no room for, so that it never stops reading.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Protocol

import numpy as np

from rapidgen.client.core.checks import Way
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import CommandedMotion, place_of, refused
from rapidgen.client.core.request_port import PendingReply
from rapidgen.client.core.state import Progress, trajectory_state
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.errors import (
    MotionStopped,
    ProtocolError,
    TrajectoryRefused,
)
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.instructions import WORDS
from rapidgen.wire.simple_message.messages import POINTS, PROGRAM
from rapidgen.wire.simple_message.numpy_codec import Words, pack_points, points_frame, program_frame
from rapidgen.wire.simple_message.spec import INDEX_WRAP, StreamFlag, TrajectoryState, TriState


@dataclass(slots=True)
class _Flight:
    """A batch on its way: `end` is the number of points that it completes."""

    pending: PendingReply
    end: int
    sent: float


class SendQueue(Protocol):
    """What waits to be sent, and how it goes into messages."""

    number: int
    """Of the messages."""
    flags: StreamFlag
    """What each of them says."""
    batch: int
    """How many one message takes, more or less."""

    def size(self, most: int) -> int:
        """How many of the next go into one message, `most` at most."""

    def frame(self, stream: int, first: int, size: int, flags: StreamFlag) -> bytes:
        """The message with the next `size`, which are taken out."""


class PointQueue:
    """Points, packed."""

    number = POINTS.number
    flags = StreamFlag(0)

    def __init__(self, batch: int, joints: int) -> None:
        self.batch = max(1, batch)
        self._queue: deque[Words] = deque()
        self._no_points = pack_points(np.zeros(0), np.zeros((0, joints)))

    def put(self, values: Words) -> None:
        """Behind those that wait."""
        self._queue.append(values)

    def size(self, most: int) -> int:
        """See SendQueue."""
        return min(most, self.batch)

    def frame(self, stream: int, first: int, size: int, flags: StreamFlag) -> bytes:
        """See SendQueue."""
        return points_frame(stream, first, self._take(size), flags=flags)

    def _take(self, size: int) -> Words:
        """Points from the queue; none as a row of no words."""
        parts: list[Words] = [self._no_points]
        while size:
            some = self._queue.popleft()
            parts.append(some[:size])
            if len(some) > size:
                self._queue.appendleft(some[size:])
            size -= len(parts[-1])
        return np.concatenate(parts) if len(parts) != 2 else parts[1]


class InstructionQueue:
    """Instructions of a program, packed: each as many words as it needs."""

    number = PROGRAM.number
    batch = 16

    def __init__(self, instructions: Sequence[Sequence[int]], *, complete: bool) -> None:
        self.flags = StreamFlag.WHOLE if complete else StreamFlag(0)
        self._queue = deque(instructions)

    def size(self, most: int) -> int:
        """See SendQueue."""
        values = count = 0
        for one in islice(self._queue, most):
            values += len(one)
            if values > WORDS:
                break
            count += 1
        return count

    def frame(self, stream: int, first: int, size: int, flags: StreamFlag) -> bytes:
        """See SendQueue."""
        some = [self._queue.popleft() for _ in range(size)]
        return program_frame(stream, first, some, flags=flags)


class PointStream(CommandedMotion):
    """A stream from its first point, or instruction, to its end."""

    way: Way = "stream"

    def __init__(
        self,
        number: int,
        queue: SendQueue,
        hello: messages.HelloReply,
        group: Group,
        state_port: StatePort,
        *,
        silence: float,
        reply: float,
    ) -> None:
        """`number` is the client's of this stream; `reply` s that a batch may stay unanswered."""
        super().__init__(group, state_port, silence)
        self.stream = number
        self.is_ended = False
        """The caller said that nothing follows."""
        self.refusal: messages.PointsRefused | messages.Failure | None = None
        """From one point on the controller takes nothing more; what it has it executes."""
        self.queue = queue
        self.batch = queue.batch
        """Points of one message."""
        self._least = min(self.batch, max(1, hello.ring // 2))
        self._patience = reply
        self._sent = 0
        self._accepted = 0
        self._planned = 0
        self._reached_points = 0
        self._ring = hello.ring
        self._room_until = hello.ring
        """Points that may be sent at all, for what is known now."""
        self._flights: deque[_Flight] = deque()
        self._looked_at = 0
        """PROGRESS messages when one was looked at last."""
        self._is_flushing = False
        self._is_filled = False
        """Whether the controller was told to start with a full ring, and it has not yet."""
        self._end_is_sent = False
        self._state = TrajectoryState.RECEIVING

    @property
    def backlog(self) -> int:
        """Points that wait here for room at the controller."""
        return self.total - self._sent

    @property
    def awaits_answer(self) -> bool:
        """See CommandedMotion."""
        return bool(self._flights) and not self.is_over

    @property
    def is_complete(self) -> bool:
        """See CommandedMotion."""
        return self._end_is_sent and not self._flights

    @property
    def is_paused(self) -> bool:
        """Whether the controller holds the motion on its path."""
        return self._state is TrajectoryState.PAUSED

    # What the caller gives

    def goes_on(self, durations: Sequence[float], goal: Sequence[float]) -> None:
        """So many more wait in the queue, for so many s each, up to this posture."""
        self.goal = goal
        if not self.total:
            self.approach = float(durations[0])
        self.total += len(durations)
        self.planned_seconds += float(sum(durations))
        self.longest = max(self.longest, *map(float, durations))

    def flush(self) -> None:
        """The controller shall start with what it has, once all points are there."""
        self._is_flushing = True

    def end(self) -> None:
        """Nothing follows."""
        self.is_ended = True

    # What goes out

    @property
    def has_due(self) -> bool:
        """Whether a batch may be sent now."""
        if self.is_over or self.stopping or self.refusal is not None or self._end_is_sent:
            return False
        backlog = self.backlog
        if not backlog:
            return self._sent > 0 and (self.is_ended or self._is_flushing)
        # Room comes back point by point: small batches would cost the controller more.
        return self._room_until - self._sent >= min(backlog, self._least) or self._is_stuck

    @property
    def _is_stuck(self) -> bool:
        """Whether the robot stands with a ring as full as it gets: it shall start with that,
        though the driver likes to have more seconds."""
        moves = self._state_port.status.in_motion is TriState.TRUE
        return not (self._flights or moves or self._is_filled or self.is_paused)

    def next_frame(self, pending: PendingReply) -> bytes:
        """The batch that is due, whose reply is `pending`."""
        size = self.queue.size(min(self.backlog, self._room_until - self._sent))
        flags = self.queue.flags
        if self._sent == 0:
            flags |= StreamFlag.BEGIN
        if size == self.backlog:
            if self.is_ended:
                flags |= StreamFlag.END
                self._end_is_sent = True
            if self._is_flushing:
                flags |= StreamFlag.FLUSH
                self._is_flushing = False
        elif size < self._least:
            flags |= StreamFlag.FLUSH
            self._is_filled = True
        frame = self.queue.frame(self.stream, self._sent, size, flags)
        self._sent += size
        self.is_ordered = True
        self._flights.append(_Flight(pending, self._sent, self._state_port.clock()))
        return frame

    # What comes in

    def step(self) -> None:
        """Take replies and PROGRESS. Call after each message, and now and then without one."""
        while not self.is_over and self._flights and self._flights[0].pending.reply is not None:
            flight = self._flights.popleft()
            assert flight.pending.reply is not None
            self._answered(flight.end, flight.pending.reply)
        if self.is_over:
            return
        waited = self._state_port.clock() - self._flights[0].sent if self._flights else 0.0
        if waited > self._patience:
            self.failed(
                self._state_port.late(
                    f"the controller did not answer a batch of points within {waited:.1f} s",
                    "a STOP was sent; look at the robot",
                )
            )
            return
        super().step()

    def _answered(self, end: int, reply: Content) -> None:
        match reply:
            case messages.PointsAccepted() if reply.stream == self.stream:
                if self.number is None and (self.way == "stream" or end == self.total):
                    self.accepted(reply.trajectory)
                self._accepted = end
                self._has_room(end + max(0, reply.room))
                self._counts(reply.planned, reply.reached)
                self._now(reply.state)
            case messages.PointsRefused() if reply.stream == self.stream:
                self._refused(reply, reply.reason, reply.point, reply.joint, reply.accepted)
            case messages.Failure():
                self._refused(reply, 0, -1, 0, 0)
            case _:
                self.failed(
                    ProtocolError.because(
                        "RG604",
                        f"a batch of points was answered with {reply}",
                        "a STOP was sent; look at the robot",
                        **self._state_port.evidence(),
                    )
                )

    def _refused(
        self,
        reply: messages.PointsRefused | messages.Failure,
        reason: int,
        point: int,
        joint: int,
        accepted: int,
    ) -> None:
        if self.refusal is None:
            self.refusal = reply
        if self.way == "stream" and (self.number is not None or accepted):
            # What was accepted is executed, and PROGRESS says how that ends.
            if self.number is None and isinstance(reply, messages.PointsRefused):
                self.accepted(reply.trajectory)
            return
        place = place_of(self._group, point, joint, self.noun)
        self.failed(refused(self._state_port, reason or None, place, point, joint))

    def _by_progress(self, report: messages.ProgressReport) -> None:
        if self._state_port.progresses != self._looked_at:
            self._looked_at = self._state_port.progresses
            self._counts(report.planned, report.reached)
            # A point that was given to the planner has made room for another one.
            self._has_room(self._planned + self._ring)
            self._now(report.state)
        super()._by_progress(report)

    def _has_room(self, until: int) -> None:
        if until > self._room_until:
            self._room_until = until
            self._is_filled = False

    def _counts(self, planned: int, reached: int) -> None:
        """Take what was told, unless it is older than what is known, or cannot be."""
        planned = unwrapped(planned, self._planned)
        if self._planned <= planned <= self._sent:
            self._planned = planned
        reached = unwrapped(reached, self._reached_points)
        if self._reached_points <= reached <= self._planned:
            self._reached_points = reached

    def _now(self, state: int) -> None:
        now = trajectory_state(state)
        if now is None or now is self._state:
            return
        self._state = now
        if now is TrajectoryState.STARVED:
            self.starved += 1
            self._state_port.note(f"the stream ran out of points at point {self._reached_points}")

    def _index(self, point: int) -> int:
        return unwrapped(point, self._accepted) if point >= 0 else point

    def _reached(self) -> int | None:
        return self._reached_points

    @property
    def progress(self) -> Progress:
        """How far it is, now. `total` are the points given so far."""
        state = self._state
        if self.result is not None:
            state = TrajectoryState.DONE
        elif isinstance(self.error, MotionStopped):
            state = TrajectoryState.STOPPED
        elif isinstance(self.error, TrajectoryRefused):
            state = TrajectoryState.REFUSED
        elif self.error is not None:
            state = TrajectoryState.FAILED
        reached = self._reached_points
        fraction = reached / self.total if self.total else 0.0
        return Progress(state, self.total, self._accepted, self._planned, reached, fraction)


def unwrapped(count: int, near: int) -> int:
    """The number that a count modulo 2^23 means: the one that is next to `near`."""
    half = INDEX_WRAP // 2
    return near + (count - near + half) % INDEX_WRAP - half
