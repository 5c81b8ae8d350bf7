"""What is common to everything under way: how a motion ends, and what is known of it. Sans-IO.

A driver that tells PROGRESS is believed: its states end a motion here. `Download` (a trajectory
that was sent whole) and `PointStream` (one that is sent while it is executed) add the rest.
"""

import logging
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto

from rapidgen.client.core.checks import Way
from rapidgen.client.core.group import Group
from rapidgen.client.core.state import Progress, State
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.errors import MotionFailed, MotionStopped, RobotError, TrajectoryRefused, fault
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Diagnostic
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.spec import Reason, TrajectoryState, TriState

_REASONS = {int(reason): reason for reason in Reason}
_FIXES = {
    Reason.TASK_ENDED: "restart the controller (a warm start): a server task that has ended does "
    "not begin again with PP to Main and Start; the controller's event log names the task"
}
_NOT_BEGUN = (TrajectoryState.NONE, TrajectoryState.RECEIVING, TrajectoryState.REFUSED)
_UNANSWERED = 0.5
"""s for which the robot may move by an order whose answer has not come."""
_STANDS = 1.0
"""s for which a robot stands at the end before that counts, where PROGRESS does not come."""
_STRANDED = 3.0
"""s for which it may stand elsewhere then."""
GOAL_TOLERANCE = 0.01
"""rad or m: as industrial_robot_client."""


class Phase(Enum):
    """Where a motion is."""

    SENDING = auto()
    MOVING = auto()
    OVER = auto()


@dataclass(frozen=True, slots=True)
class Result:
    """A trajectory that was executed to its end.

    `deviation` is the largest distance of a joint from the last point, rad or m; `way` is how
    the points came to the controller; `starved` how often a stream ran out of points.
    """

    points: int
    seconds: float
    planned_seconds: float
    deviation: float
    state: State
    way: Way = "download"
    starved: int = 0


class CommandedMotion(ABC):
    """A motion from its first byte to its end. Its owner holds a lock or a loop."""

    way: Way
    noun = "point"
    """What is counted."""
    starved = 0
    """How often it ran out of points."""

    def __init__(self, group: Group, state_port: StatePort, silence: float) -> None:
        self.phase = Phase.SENDING
        self.result: Result | None = None
        self.error: RobotError | None = None
        self.is_taken = False
        """Whether the controller took it: from then on `result` tells how it ends."""
        self.is_ordered = False
        """Bytes have gone out by which the controller may begin to move."""
        self.is_settled = False
        """The controller has said how it ended, or the robot stands behind a STOP."""
        self._unanswered_since: float | None = None
        self._stands_since: float | None = None
        self.stopping = False
        """Somebody asked for a STOP: nothing more of this is sent."""
        self.number: int | None = None
        """Of the trajectory on the controller, once it told it."""
        self.trajectory: Trajectory | None = None
        """What was asked for in the robot's order of joints, where it was there as a whole."""
        self.warnings: Sequence[Diagnostic] = ()
        """What the checks noted."""
        self.total = 0
        """Points that were asked for, so far."""
        self.planned_seconds = 0.0
        """Seconds that the controller is asked to take, so far."""
        self.approach = 0.0
        """Those of the first point, where the robot stands already."""
        self.longest = 0.0
        """Seconds that may pass without a sign of getting on."""
        self.goal: Sequence[float] = ()
        """Axis values of the last point, rad or m."""
        self.stood: tuple[float, ...] | None = None
        """Joints where the controller says that the robot stood after a halt."""
        self._group = group
        self._state_port = state_port
        self._silence = silence
        self.events_before = state_port.event_count
        """Entries of the controller's log that had come before it."""
        self._before = state_port.progress
        self._began = state_port.clock()
        self._first_sample = state_port.samples
        self._first_progress = state_port.progresses
        self._moved_before = state_port.status.in_motion is TriState.TRUE

    @property
    def is_over(self) -> bool:
        """Whether `result` or `error` is there."""
        return self.phase is Phase.OVER

    @property
    def needs_stop(self) -> bool:
        """Whether it has failed, and the robot may be moving by it, or begin to."""
        return self.is_over and self.error is not None and self.is_ordered and not self.is_settled

    @property
    def is_superseded(self) -> bool:
        """Whether the controller executes, or has executed, a motion behind this one."""
        progress = self._state_port.progress
        newer = self._state_port.progresses >= self._first_progress + 2
        return (
            newer
            and self.number is not None
            and progress is not None
            and progress.trajectory != self.number
        )

    @property
    @abstractmethod
    def awaits_answer(self) -> bool:
        """Whether something that was sent for it is unanswered."""

    @property
    def is_complete(self) -> bool:
        """Whether the controller has all of it."""
        return True

    @property
    @abstractmethod
    def progress(self) -> Progress:
        """How far it is, now."""

    @property
    def mark(self) -> tuple[object, ...]:
        """Changes when the motion gets on."""
        progress = self.progress
        return (progress.state, progress.reached, progress.received)

    def accepted(self, number: int | None) -> None:
        """The controller took the trajectory (under this number, where it tells one)."""
        if self.is_over:
            return
        self._note(f"{self.total} {self.noun}s by {self.way} were taken")
        self._state_port.taken()
        self.phase = Phase.MOVING
        self.is_taken = True
        self.number = number
        self._began = self._state_port.clock()
        self._first_sample = self._state_port.samples
        self._first_progress = self._state_port.progresses

    def failed(self, error: RobotError) -> None:
        """It is over; only the first reason counts."""
        if not self.is_over:
            self.phase = Phase.OVER
            self.error = error
            self.is_settled = isinstance(error, TrajectoryRefused)
            self._note(str(error))

    def _note(self, text: str) -> None:
        self._state_port.note(text, logging.INFO)

    def stopped(self) -> None:
        """A STOP was confirmed and the robot stands."""
        self._end(MotionStopped, fault("RG631", "stopped on request"), Reason.STOPPED)

    def done(self) -> None:
        """The controller said in another way that all of it was executed."""
        if not self.is_over:
            self._succeed()

    def step(self) -> None:
        """Look at the newest state. Call after each message, and now and then without one."""
        if self.phase is Phase.SENDING:
            self._look_for_answer()
        if self.phase is not Phase.MOVING or self._is_silent():
            return
        if self._state_port.is_progress_lost:
            self._without_progress()
            return
        self._stands_since = None
        report = self._told()
        if report is not None:
            self._by_progress(report)

    def _look_for_answer(self) -> None:
        """An answer that does not come while the robot already moves is lost."""
        if not (self.is_ordered and self._has_begun()):
            self._unanswered_since = None
            return
        now = self._state_port.clock()
        if self._unanswered_since is None:
            self._unanswered_since = now
        if now - max(self._unanswered_since, self._state_port.listening) > _UNANSWERED:
            self.failed(
                self._state_port.late(
                    "the robot has begun to move, and the controller did not answer the order",
                    "a STOP was sent; look at the robot",
                )
            )

    def _has_begun(self) -> bool:
        """Whether the controller executes it, by what the state port says."""
        progress, status = self._state_port.progress, self._state_port.status
        if progress is None:
            return status.in_motion is TriState.TRUE and not self._moved_before
        before = self._before.trajectory if self._before else 0
        return progress.trajectory != before and progress.state not in _NOT_BEGUN

    def _without_progress(self) -> None:
        """PROGRESS does not come any more: where the robot stands, and for how long, decides."""
        state = self._state_port.state
        assert state is not None
        # STATUS has in_motion 1 while a motion is active, also where the robot waits on its way.
        still = state.status.in_motion is TriState.FALSE and self.is_complete
        if not still or self.progress.state is TrajectoryState.PAUSED:
            self._stands_since = None
            return
        if self._stands_since is None:
            self._stands_since = state.time
        stood = state.time - self._stands_since
        if self.stopping:
            self.stopped()
        elif self._deviation(state) <= GOAL_TOLERANCE:
            if stood > _STANDS and state.time - self._began > self.planned_seconds - self.approach:
                self._succeed()
        elif stood > _STRANDED:
            self.failed(
                self._state_port.late(
                    "the driver does not tell any more how far the motion is, and the robot stands "
                    f"{self._deviation(state):.4f} (rad, m) from its end",
                    "a STOP was sent; look at the robot, and at the controller's event log",
                )
            )

    def _is_silent(self) -> bool:
        """Whether nobody sees the robot any more: then it is over."""
        state_port = self._state_port
        silent = state_port.clock() - max(state_port.heard, state_port.listening)
        if silent <= self._silence:
            return False
        self.failed(
            state_port.late(
                f"no state for {silent:.1f} s while the robot may be moving",
                "look at the robot; a STOP was sent",
            )
        )
        return True

    def _told(self) -> messages.ProgressReport | None:
        """PROGRESS of this very trajectory.

        Its number and state are written by one task of the controller and read by another: what
        was put together while the trajectory came in may have the number of this one and the
        state of the one before. So it counts from the second message after the acceptance.
        """
        if self._state_port.progresses < self._first_progress + 2:
            return None
        progress = self._state_port.progress
        if progress is None:
            return None
        if self.number is not None:
            return progress if progress.trajectory == self.number else None
        before = self._before.trajectory if self._before else 0
        return progress if progress.trajectory != before else None

    def _by_progress(self, report: messages.ProgressReport) -> None:
        match report.state:
            case TrajectoryState.DONE:
                if self._state_port.status.in_motion is not TriState.TRUE:
                    self._succeed()
            case TrajectoryState.STOPPED:
                if not self.stopping:
                    text = "stopped by another request or by the operator"
                    self._end(MotionStopped, fault("RG631", text), reason_of(report.reason))
                elif self._state_port.status.in_motion is not TriState.TRUE:
                    self.stopped()
            case TrajectoryState.FAILED | TrajectoryState.REFUSED:
                point = self._index(report.point)
                place = place_of(self._group, point, report.joint, self.noun)
                reason = reason_of(report.reason)
                result = fault(
                    "RG630",
                    f"the controller ended the motion{place}: {reason_text(report.reason)}",
                    fix_of(
                        reason,
                        "look at the robot; what was executed is a prefix of what was asked",
                    ),
                )
                self._end(MotionFailed, result, reason, point=point, joint=report.joint)

    def _index(self, point: int) -> int:
        """Which point of this motion a number of the wire means; -1 none."""
        return point

    def _reached(self) -> int | None:
        """Points known to be reached, None when the driver does not say."""
        report = self._told()
        return report.reached if report is not None else None

    def _deviation(self, state: State) -> float:
        goal = self._group.from_wire(self.goal)
        return max(abs(a - b) for a, b in zip(state.joints, goal, strict=True))

    def _succeed(self) -> None:
        state = self._state_port.state
        assert state is not None
        self.phase = Phase.OVER
        self.result = Result(
            points=self.total,
            seconds=self._state_port.clock() - self._began,
            planned_seconds=self.planned_seconds,
            deviation=self._deviation(state),
            state=state,
            way=self.way,
            starved=self.starved,
        )
        self._note(f"done in {self.result.seconds:.2f} s")

    def _end(
        self,
        kind: type[MotionStopped] | type[MotionFailed],
        diagnostic: Diagnostic,
        reason: Reason | None,
        *,
        point: int = -1,
        joint: int = 0,
    ) -> None:
        self.failed(
            kind(
                diagnostic,
                reason=reason,
                reached=self._reached(),
                point=point,
                joint=joint,
                **self._state_port.evidence(),
            )
        )
        self.is_settled = True


def reason_of(number: int) -> Reason | None:
    """A reason of the wire; None for a number that is none."""
    return _REASONS.get(number)


def fix_of(reason: Reason | None, otherwise: str) -> str:
    """What to do about a reason of the wire."""
    return _FIXES.get(reason, otherwise) if reason is not None else otherwise


def reason_text(number: int) -> str:
    """A reason of the wire in words."""
    reason = reason_of(number)
    return reason.text if reason is not None else f"reason {number}"


def refused(
    state_port: StatePort, reason: int | None, place: str = "", point: int = -1, joint: int = 0
) -> TrajectoryRefused:
    """The controller took nothing, for a reason of the wire (None where it gave none); `place` in
    words."""
    text = "no reason given" if reason is None else reason_text(reason)
    return TrajectoryRefused.because(
        "RG620",
        f"the controller refused{place}: {text}",
        fix_of(None if reason is None else reason_of(reason), "nothing moved"),
        reason=None if reason is None else reason_of(reason),
        point=point,
        joint=joint,
        **state_port.evidence(),
    )


def place_of(group: Group, point: int, joint: int, noun: str = "point") -> str:
    """` at point 3, joint_2`, as far as it is known; `point` from 0, `joint` from 1."""
    result = f" at {noun} {point}" if point >= 0 else ""
    if 1 <= joint <= len(group.names):
        result += f"{',' if result else ' at'} {group.names[joint - 1]}"
    return result
