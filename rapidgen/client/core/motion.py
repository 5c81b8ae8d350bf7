"""State machine common to all active motions. Sans-IO.

The rules:

1. The robot may move once the end frame or the first batch is being sent (`is_ordered`). An error
   from then on needs a STOP (`needs_stop`), unless the end was reported (`is_settled`).
2. The reply accepts or refuses the order. If the state port shows a motion and the reply is still
   missing after `_UNANSWERED` s, the motion fails.
3. With PROGRESS the reported state ends the motion: done, stopped, failed or refused, with reason,
   point and joint. It counts from the second PROGRESS after the acceptance (see
   `_current_progress`). Done and stopped also need in_motion 0.
4. If PROGRESS stops arriving, the position decides: at rest within `GOAL_TOLERANCE` of the end for
   `_ARRIVED` s, after the planned time, is done; at rest elsewhere for `_STRANDED` s is a failure.
5. No state for `silence` s is a failure. Time in which this process did not read does not count.
6. The first end counts: later errors and results are dropped.

`Download` (a trajectory sent before the motion) and `PointStream` (one sent during it) add their
own rules.
"""

import logging
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto

from rapidgen.client.core.checks import TransferMode
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
_NOT_STARTED = (TrajectoryState.NONE, TrajectoryState.RECEIVING, TrajectoryState.REFUSED)
_UNANSWERED = 0.5
"""s for which an unanswered order may still move the robot."""
_ARRIVED = 1.0
"""s at rest at the end that count as arrival without PROGRESS."""
_STRANDED = 3.0
"""s at rest elsewhere that count as a failure without PROGRESS."""
GOAL_TOLERANCE = 0.01
"""rad or m: as in industrial_robot_client."""


class Phase(Enum):
    """Phase of a motion."""

    SENDING = auto()
    MOVING = auto()
    OVER = auto()


@dataclass(frozen=True, slots=True)
class Result:
    """Result of a trajectory that was executed to its end.

    `deviation` is the largest distance of a joint from the last point, rad or m; `mode` is
    `download` or `stream`; `starved` counts the stops because a stream ran out of points.
    """

    points: int
    seconds: float
    planned_seconds: float
    deviation: float
    state: State
    mode: TransferMode = "download"
    starved: int = 0


class CommandedMotion(ABC):
    """A motion from its first byte to its end.

    Its owner holds a lock or a loop.
    """

    mode: TransferMode
    noun = "point"
    """Noun of the counted items."""
    starved = 0
    """Number of stops because the stream ran out of points."""

    def __init__(self, group: Group, state_port: StatePort, silence: float) -> None:
        self.phase = Phase.SENDING
        self.result: Result | None = None
        self.error: RobotError | None = None
        self.is_accepted = False
        """True once the controller has accepted the motion; `result` follows."""
        self.is_ordered = False
        """True once bytes were sent after which the controller may move."""
        self.is_settled = False
        """True once the end was reported, or a STOP has taken effect."""
        self._unanswered_since: float | None = None
        self._at_rest_since: float | None = None
        self.stopping = False
        """True once a STOP was requested: no further point is sent."""
        self.number: int | None = None
        """Number of the trajectory on the controller, once reported."""
        self.trajectory: Trajectory | None = None
        """The commanded trajectory in the robot's order of joints, if complete."""
        self.warnings: Sequence[Diagnostic] = ()
        """Warnings of the checks."""
        self.total = 0
        """Number of commanded points so far."""
        self.planned_seconds = 0.0
        """Commanded duration so far, s."""
        self.approach = 0.0
        """Time of the first point, at the robot's position, s."""
        self.longest = 0.0
        """Longest time without progress, s."""
        self.goal: Sequence[float] = ()
        """Axis values of the last point, rad or m."""
        self.stopped_joints: tuple[float, ...] | None = None
        """Joints at which the controller reports a stop."""
        self.rest: State | None = None
        """State of the robot at rest after its caller has cancelled the motion."""
        self._group = group
        self._state_port = state_port
        self._silence = silence
        self.events_before = state_port.event_count
        """Entries of the controller's log before the motion."""
        self._before = state_port.progress
        self._began = state_port.clock()
        self._first_sample = state_port.samples
        self._first_progress = state_port.progresses
        self._moved_before = state_port.status.in_motion is TriState.TRUE

    @property
    def is_over(self) -> bool:
        """True if `result` or `error` is known."""
        return self.phase is Phase.OVER

    @property
    def needs_stop(self) -> bool:
        """True if the motion has failed and may still move the robot."""
        return self.is_over and self.error is not None and self.is_ordered and not self.is_settled

    @property
    def is_superseded(self) -> bool:
        """True if the controller executes or has executed a later motion."""
        progress = self._state_port.progress
        # As in `_current_progress`: the first message may combine old and new values.
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
        """True if a message of this motion is unanswered."""

    @property
    def is_complete(self) -> bool:
        """True if the controller has all points."""
        return True

    @property
    @abstractmethod
    def progress(self) -> Progress:
        """Current progress."""

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints at which the robot stopped, as far as known."""
        if self.stopped_joints is not None:
            return self.stopped_joints
        if self.result is not None:
            return self.result.state.joints
        if self.rest is not None:
            return self.rest.joints
        return self.error.states[-1].joints if self.error and self.error.states else None

    def __str__(self) -> str:
        """Describe the progress or the result."""
        if self.error is not None:
            return f"ended: {self.error}"
        if self.result is not None:
            done = self.result
            return f"done: {done.points} {self.noun}s in {done.seconds:.2f} s by {done.mode}"
        return progress_text(self.progress, self.noun)

    @property
    def progress_marker(self) -> tuple[object, ...]:
        """Value that changes with the progress of the motion."""
        progress = self.progress
        return (progress.state, progress.reached, progress.received)

    def accepted(self, number: int | None) -> None:
        """Record that the controller accepted the trajectory under this number."""
        if self.is_over:
            return
        self._note(f"{self.total} {self.noun}s by {self.mode} were accepted")
        self._state_port.motion_accepted()
        self.phase = Phase.MOVING
        self.is_accepted = True
        self.number = number
        self._began = self._state_port.clock()
        self._first_sample = self._state_port.samples
        self._first_progress = self._state_port.progresses

    def failed(self, error: RobotError) -> None:
        """Record the error that ended the motion; only the first one counts."""
        if not self.is_over:
            self.phase = Phase.OVER
            self.error = error
            # A refused order moves nothing, so it needs no STOP.
            self.is_settled = isinstance(error, TrajectoryRefused)
            self._note(str(error))

    def _note(self, text: str) -> None:
        self._state_port.note(text, logging.INFO)

    def stopped(self) -> None:
        """Record that a STOP was confirmed and the robot is at rest."""
        self._end(MotionStopped, fault("RG631", "stopped on request"), Reason.STOPPED)

    def done(self) -> None:
        """Record the controller's report that all points were executed."""
        if not self.is_over:
            self._succeed()

    def step(self) -> None:
        """Process the newest state.

        Call it after each message, and regularly without one.
        """
        if self.phase is Phase.SENDING:
            self._look_for_answer()
        if self.phase is not Phase.MOVING or self._is_silent():
            return
        if self._state_port.is_progress_lost:
            self._without_progress()
            return
        # PROGRESS is back: a later loss starts to count the time at rest anew.
        self._at_rest_since = None
        report = self._current_progress()
        if report is not None:
            self._by_progress(report)

    def _look_for_answer(self) -> None:
        """Give up an answer that is missing while the robot already moves."""
        if not (self.is_ordered and self._has_started()):
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

    def _has_started(self) -> bool:
        """True if the state port shows that the motion has started."""
        progress, status = self._state_port.progress, self._state_port.status
        if progress is None:
            return status.in_motion is TriState.TRUE and not self._moved_before
        before = self._before.trajectory if self._before else 0
        return progress.trajectory != before and progress.state not in _NOT_STARTED

    def _without_progress(self) -> None:
        """Judge by position and time at rest if PROGRESS stops arriving."""
        state = self._state_port.state
        assert state is not None
        # in_motion of STATUS is 1 while a motion is active, also while the robot waits on its path.
        still = state.status.in_motion is TriState.FALSE and self.is_complete
        if not still or self.progress.state is TrajectoryState.PAUSED:
            self._at_rest_since = None
            return
        if self._at_rest_since is None:
            self._at_rest_since = state.time
        at_rest = state.time - self._at_rest_since
        if self.stopping:
            self.stopped()
        elif self._deviation(state) <= GOAL_TOLERANCE:
            if (
                at_rest > _ARRIVED
                and state.time - self._began > self.planned_seconds - self.approach
            ):
                self._succeed()
        elif at_rest > _STRANDED:
            self.failed(
                self._state_port.late(
                    "the driver no longer reports the progress of the motion, and the robot rests "
                    f"{self._deviation(state):.4f} (rad, m) from its end",
                    "a STOP was sent; look at the robot, and at the controller's event log",
                )
            )

    def _is_silent(self) -> bool:
        """Fail a motion that no state shows any more."""
        state_port = self._state_port
        silent = state_port.clock() - max(state_port.last_message, state_port.listening)
        if silent <= self._silence:
            return False
        self.failed(
            state_port.late(
                f"no state for {silent:.1f} s while the robot may be moving",
                "look at the robot; a STOP was sent",
            )
        )
        return True

    def _current_progress(self) -> messages.ProgressReport | None:
        """Process PROGRESS of this trajectory.

        One task of the controller writes its number and state and another one reads them: a message
        composed while the trajectory arrived may have the number of this one and the state of the
        one before. So it counts from the second message after the acceptance.
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
                # PROGRESS and STATUS are different messages: both must show the end.
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
                        "look at the robot; it has executed a prefix of the commanded motion",
                    ),
                )
                self._end(MotionFailed, result, reason, point=point, joint=report.joint)

    def _index(self, point: int) -> int:
        """Map a number of the wire to a point of this motion; -1 for none."""
        return point

    def _reached(self) -> int | None:
        """Number of points reached; None if the driver does not report it."""
        report = self._current_progress()
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
            mode=self.mode,
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


def progress_text(progress: Progress, noun: str = "point") -> str:
    """Describe the progress of a motion."""
    reached = "" if progress.reached is None else f"{progress.reached} of "
    state = progress.state.name.lower()
    return f"{state}: {reached}{progress.total} {noun}s, {progress.fraction:.0%}"


def reason_of(number: int) -> Reason | None:
    """Return the reason of a wire number; None for an unknown one."""
    return _REASONS.get(number)


def fix_of(reason: Reason | None, otherwise: str) -> str:
    """Return the help for a reason of the wire."""
    return _FIXES.get(reason, otherwise) if reason is not None else otherwise


def reason_text(number: int) -> str:
    """A reason of the wire in words."""
    reason = reason_of(number)
    return reason.text if reason is not None else f"reason {number}"


def refused(
    state_port: StatePort, reason: int | None, place: str = "", point: int = -1, joint: int = 0
) -> TrajectoryRefused:
    """Return the error of a refusal by the controller.

    `reason` is that of the wire, None if there was none; `place` is in words.
    """
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
    """Return ` at point 3, joint_2`, as far as known.

    `point` counts from 0, `joint` from 1.
    """
    result = f" at {noun} {point}" if point >= 0 else ""
    if 1 <= joint <= len(group.names):
        result += f"{',' if result else ' at'} {group.names[joint - 1]}"
    return result
