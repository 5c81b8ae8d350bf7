"""A stream of points or instructions, sent during execution. Sans-IO.

The rules:

1. The controller has a ring buffer. The client sends only what the buffer has space for, so that
   the controller never stops reading and a STOP is read at once.
2. `_send_limit` counts the points that may be sent. The reply to a batch raises it by the space
   left, PROGRESS by the points passed to the planner. Counts of the wire are modulo 2^23
   (`unwrapped`); one that is lower than the known count is old and ignored.
3. While the buffer is nearly full, space returns point by point. The client waits until `_least`
   points fit, since small batches cost the controller more.
4. A driver starts when it holds enough seconds of motion. If the robot is at rest with a full
   buffer, the client sends what fits with FLUSH, which starts it; so does `flush`.
5. A batch without an answer after `reply` s is a failure.
6. After a refusal nothing more is sent. A refusal of the first batch ends the stream; after a later
   one the controller executes the accepted points, and PROGRESS reports the end.

The owner calls `next_frame` while `has_due` holds, after each change, and sends the frame.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Protocol

import numpy as np

from rapidgen.client.core.checks import CheckedPoints, TransferMode
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
class _SentBatch:
    """A sent batch; `end` is the number of points including it."""

    pending: PendingReply
    end: int
    sent: float


class SendQueue(Protocol):
    """Queue of items to send, which divides them into messages."""

    number: int
    """Number of the message type."""
    flags: StreamFlag
    """Flags of every message."""
    batch: int
    """Usual number of items in one message."""

    def size(self, most: int) -> int:
        """Return the number of items for the next message, at most `most`."""

    def frame(self, stream: int, first: int, size: int, flags: StreamFlag) -> bytes:
        """Remove the next `size` items and return their message."""


class PointQueue:
    """Points, packed."""

    number = POINTS.number
    flags = StreamFlag(0)

    def __init__(self, batch: int, joints: int) -> None:
        self.batch = max(1, batch)
        self._queue: deque[Words] = deque()
        self._no_points = pack_points(np.zeros(0), np.zeros((0, joints)))

    def put(self, values: Words) -> None:
        """Append items to the queue."""
        self._queue.append(values)

    def size(self, most: int) -> int:
        """See SendQueue."""
        return min(most, self.batch)

    def frame(self, stream: int, first: int, size: int, flags: StreamFlag) -> bytes:
        """See SendQueue."""
        return points_frame(stream, first, self._take(size), flags=flags)

    def _take(self, size: int) -> Words:
        """Remove points from the queue; an empty row has no words."""
        parts: list[Words] = [self._no_points]
        while size:
            some = self._queue.popleft()
            parts.append(some[:size])
            if len(some) > size:
                self._queue.appendleft(some[size:])
            size -= len(parts[-1])
        return np.concatenate(parts) if len(parts) != 2 else parts[1]


class InstructionQueue:
    """Packed instructions of a program, each of as many words as it needs."""

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

    mode: TransferMode = "stream"

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
        """`number` is the client's of this stream.

        An unanswered batch fails after `reply` s.
        """
        super().__init__(group, state_port, silence)
        self.stream = number
        self.is_ended = False
        """True once the caller has ended the stream."""
        self.refusal: messages.PointsRefused | messages.Failure | None = None
        """True once the controller rejects further points.

        It executes the earlier ones.
        """
        self.queue = queue
        self.batch = queue.batch
        """Refusal after which the controller accepts no points.

        It executes the earlier ones.
        """
        self._least = min(self.batch, max(1, hello.ring // 2))
        self._reply_timeout = reply
        self._sent = 0
        self._accepted = 0
        self._planned = 0
        self._reached_points = 0
        self._ring = hello.ring
        self._send_limit = hello.ring
        """Limit of the points that may be sent, as far as known now."""
        self._unanswered: deque[_SentBatch] = deque()
        self._looked_at = 0
        """PROGRESS messages at the last evaluation."""
        self._is_flushing = False
        self._is_filled = False
        """True from the order to start a full ring buffer until the start."""
        self._end_is_sent = False
        self._state = TrajectoryState.RECEIVING

    @property
    def backlog(self) -> int:
        """Number of points waiting for space at the controller."""
        return self.total - self._sent

    @property
    def awaits_answer(self) -> bool:
        """See CommandedMotion."""
        return bool(self._unanswered) and not self.is_over

    @property
    def is_complete(self) -> bool:
        """See CommandedMotion."""
        return self._end_is_sent and not self._unanswered

    @property
    def is_paused(self) -> bool:
        """True if the controller has paused the motion on its path."""
        return self._state is TrajectoryState.PAUSED

    # Input from the caller

    def add(self, checked: CheckedPoints) -> None:
        """Queue more points."""
        assert isinstance(self.queue, PointQueue)
        self.queue.put(pack_points(checked.durations, checked.wire))
        self.queued(checked.durations.tolist(), checked.last.wire.tolist())

    def queued(self, durations: Sequence[float], goal: Sequence[float]) -> None:
        """Count queued items with their durations in s, up to this posture."""
        self.goal = goal
        if not self.total:
            self.approach = float(durations[0])
        self.total += len(durations)
        self.planned_seconds += float(sum(durations))
        self.longest = max(self.longest, *map(float, durations))

    def flush(self) -> None:
        """Tell the controller to start with the points sent so far."""
        self._is_flushing = True

    def end(self) -> None:
        """End the stream after the queued points."""
        self.is_ended = True

    # Output

    @property
    def has_due(self) -> bool:
        """True if a batch may be sent now."""
        if self.is_over or self.stopping or self.refusal is not None or self._end_is_sent:
            return False
        backlog = self.backlog
        if not backlog:
            return self._sent > 0 and (self.is_ended or self._is_flushing)
        # Space returns point by point: small batches would cost the controller more.
        return self._send_limit - self._sent >= min(backlog, self._least) or self._is_stuck

    @property
    def _is_stuck(self) -> bool:
        """True if the robot is at rest with a full ring buffer.

        The driver must start although it waits for more seconds of motion.
        """
        moves = self._state_port.status.in_motion is TriState.TRUE
        return not (self._unanswered or moves or self._is_filled or self.is_paused)

    def next_frame(self, pending: PendingReply) -> bytes:
        """Return the batch that is due; `pending` is its reply."""
        size = self.queue.size(min(self.backlog, self._send_limit - self._sent))
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
            # Due only because the robot rests with a full ring buffer (`_is_stuck`).
            flags |= StreamFlag.FLUSH
            self._is_filled = True
        frame = self.queue.frame(self.stream, self._sent, size, flags)
        self._sent += size
        self.is_ordered = True
        self._unanswered.append(_SentBatch(pending, self._sent, self._state_port.clock()))
        return frame

    # Input from the controller

    def step(self) -> None:
        """Process replies and PROGRESS.

        Call it after each message, and regularly without one.
        """
        while (
            not self.is_over and self._unanswered and self._unanswered[0].pending.reply is not None
        ):
            oldest = self._unanswered.popleft()
            assert oldest.pending.reply is not None
            self._answered(oldest.end, oldest.pending.reply)
        if self.is_over:
            return
        waited = self._state_port.clock() - self._unanswered[0].sent if self._unanswered else 0.0
        if waited > self._reply_timeout:
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
                # A program for download is accepted as a whole, with its last batch.
                if self.number is None and (self.mode == "stream" or end == self.total):
                    self.accepted(reply.trajectory)
                self._accepted = end
                self._raise_limit(end + max(0, reply.room))
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
        if self.mode == "stream" and (self.number is not None or accepted):
            # Accepted points are executed, and PROGRESS reports the end.
            if self.number is None and isinstance(reply, messages.PointsRefused):
                self.accepted(reply.trajectory)
            return
        place = place_of(self._group, point, joint, self.noun)
        self.failed(refused(self._state_port, reason or None, place, point, joint))

    def _by_progress(self, report: messages.ProgressReport) -> None:
        if self._state_port.progresses != self._looked_at:
            self._looked_at = self._state_port.progresses
            self._counts(report.planned, report.reached)
            # A point passed to the planner has freed space for another one.
            self._raise_limit(self._planned + self._ring)
            self._now(report.state)
        super()._by_progress(report)

    def _raise_limit(self, until: int) -> None:
        if until > self._send_limit:
            self._send_limit = until
            self._is_filled = False

    def _counts(self, planned: int, reached: int) -> None:
        """Update the counts unless they are older than known ones or impossible."""
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
        """Current progress; `total` is the number of points so far."""
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
    """Return the number next to `near` that equals a count modulo 2^23."""
    half = INDEX_WRAP // 2
    return near + (count - near + half) % INDEX_WRAP - half
