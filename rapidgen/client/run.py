"""One trajectory under way: decides from states alone when it is over, and how. Sans-IO.

A driver that tells PROGRESS is believed. Any other is judged by position **and** in_motion
**and** time: a path that ends where it began, or crosses its end, is not done early, and a
robot that never moved has not arrived.
"""

from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from rapidgen.client.checks import Plan
from rapidgen.client.errors import MotionFailed, MotionStopped, RobotError, RobotTimeout, fault
from rapidgen.client.group import Group
from rapidgen.client.state import Progress, State
from rapidgen.client.tracker import Tracker
from rapidgen.diagnostics import Diagnostic
from rapidgen.protocol import messages
from rapidgen.protocol.spec import REASON_TEXTS, Reason, TrajectoryState, TriState

GOAL_TOLERANCE = 0.01
"""rad or m: as industrial_robot_client."""
_MOVED = 1e-4
"""rad or m: more than this is a movement."""
_GRACE = 2.0
"""s that a robot may stand after the time was up, before that counts as a failure."""
_EARLY = 0.25
"""s by which a robot may be early: it skips a first point that it stands on."""


class Phase(Enum):
    """Where a run is."""

    SENDING = auto()
    MOVING = auto()
    OVER = auto()


@dataclass(frozen=True, slots=True)
class Result:
    """A trajectory that was executed to its end.

    `deviation` is the largest distance of a joint from the last point, rad or m.
    """

    points: int
    seconds: float
    planned_seconds: float
    deviation: float
    state: State


class Run:
    """A trajectory from its first byte to its end. Its owner holds a lock or a loop."""

    def __init__(self, plan: Plan, group: Group, tracker: Tracker, *, silence: float) -> None:
        self.plan = plan
        self.phase = Phase.SENDING
        self.result: Result | None = None
        self.error: RobotError | None = None
        self.stopping = False
        self.number: int | None = None
        self._group = group
        self._tracker = tracker
        self._silence = silence
        self._before = tracker.progress
        self._was_in_error = tracker.status.in_error is TriState.TRUE
        self._start = tracker.state
        self._began = tracker.clock()
        self._first_sample = tracker.samples
        self._first_progress = tracker.progresses
        self._seen_moving = False
        self._stood_since: float | None = None
        self._goal = plan.trajectory.positions[-1]
        self._is_still = bool(np.ptp(plan.trajectory.positions, axis=0).max() < _MOVED)

    @property
    def is_over(self) -> bool:
        """Whether `result` or `error` is there."""
        return self.phase is Phase.OVER

    def accepted(self, number: int | None) -> None:
        """The controller took the trajectory (under this number, where it tells one)."""
        if self.is_over:
            return
        self.phase = Phase.MOVING
        self.number = number
        self._began = self._tracker.clock()
        self._first_sample = self._tracker.samples
        self._first_progress = self._tracker.progresses

    def failed(self, error: RobotError) -> None:
        """It is over; only the first reason counts."""
        if not self.is_over:
            self.phase = Phase.OVER
            self.error = error

    def stopped(self) -> None:
        """A STOP was confirmed and the robot stands."""
        self._end(MotionStopped, fault("RG631", "stopped on request"), Reason.STOPPED)

    def step(self) -> None:
        """Look at the newest state. Call after each message, and now and then without one."""
        tracker = self._tracker
        if self.phase is not Phase.MOVING:
            return
        silent = tracker.clock() - tracker.heard
        if silent > self._silence:
            self.failed(
                RobotTimeout(
                    fault(
                        "RG603",
                        f"no state for {silent:.1f} s while the robot may be moving",
                        "look at the robot; a STOP was sent",
                    ),
                    messages=tracker.messages,
                    states=tracker.states,
                )
            )
            return
        told = self._told()
        if told is not None:
            self._by_progress(told)
        elif tracker.progress is None and tracker.samples > self._first_sample:
            self._by_position()

    def _told(self) -> messages.Progress | None:
        """PROGRESS of this very trajectory.

        Its number and state are written by one task of the controller and read by another: what
        was put together while the trajectory came in may have the number of this one and the
        state of the one before. So it counts from the second message after the acceptance.
        """
        if self._tracker.progresses < self._first_progress + 2:
            return None
        progress = self._tracker.progress
        if progress is None:
            return None
        if self.number is not None:
            return progress if progress.trajectory == self.number else None
        before = self._before.trajectory if self._before else 0
        return progress if progress.trajectory != before else None

    def _by_progress(self, told: messages.Progress) -> None:
        reason = Reason(told.reason) if told.reason in list(Reason) else None
        match told.state:
            case TrajectoryState.DONE:
                if self._tracker.status.in_motion is not TriState.TRUE:
                    self._succeed()
            case TrajectoryState.STOPPED:
                if not self.stopping:
                    text = "stopped by another request or by the operator"
                    self._end(MotionStopped, fault("RG631", text), reason, told.reached)
                elif self._tracker.status.in_motion is not TriState.TRUE:
                    self.stopped()
            case TrajectoryState.FAILED | TrajectoryState.REFUSED:
                text = REASON_TEXTS.get(reason, "no reason") if reason else f"reason {told.reason}"
                place = f" at point {told.point}" if told.point >= 0 else ""
                joint = self._joint(told.joint)
                found = fault(
                    "RG630",
                    f"the controller ended the motion{place}{joint}: {text}",
                    "look at the robot; what was executed is a prefix of what was asked",
                )
                self._end(MotionFailed, found, reason, told.reached)

    def _by_position(self) -> None:
        state = self._tracker.state
        assert state is not None
        now, status = state.time, state.status
        moving = status.in_motion is TriState.TRUE
        if moving or self._has_moved(state):
            self._seen_moving = True
        if self.stopping:
            # A STOP whose sender did not wait: it is over when the robot stands.
            if not moving and now - self._began > _EARLY:
                self.stopped()
            return
        trouble = self._trouble()
        if trouble:
            self._end(
                MotionFailed,
                fault("RG630", f"the motion ended early: {trouble}", "look at the robot"),
                status.error,
            )
            return
        if moving:
            self._stood_since = None
            return
        if self._stood_since is None:
            self._stood_since = now
        elapsed = now - self._began
        if elapsed < self.plan.total - self.plan.durations[0] - _EARLY:
            return
        if self._deviation(state) <= GOAL_TOLERANCE and (self._seen_moving or self._is_still):
            self._succeed()
        elif elapsed > self.plan.total + _GRACE and now - self._stood_since > _GRACE:
            what = "stands elsewhere" if self._seen_moving else "never moved"
            found = fault(
                "RG633",
                f"the robot {what}: {self._deviation(state):.4f} (rad, m) from the last point",
                "look at the controller's event log: a speed override, a program that does not "
                "run, or a refusal that this driver cannot tell",
            )
            self._end(MotionFailed, found, status.error)

    def _trouble(self) -> str:
        status = self._tracker.status
        if status.e_stopped is TriState.TRUE:
            return "emergency stop"
        if status.drives is TriState.FALSE:
            return "the motors are off"
        if status.in_error is TriState.TRUE and not self._was_in_error:
            text = REASON_TEXTS[status.error] if status.error else f"code {status.error_code}"
            return f"the controller reports an error ({text})"
        return ""

    def _has_moved(self, state: State) -> bool:
        if self._start is None:
            return False
        pairs = zip(state.joints, self._start.joints, strict=True)
        return any(abs(a - b) > _MOVED for a, b in pairs)

    def _deviation(self, state: State) -> float:
        return float(np.abs(np.array(state.joints) - self._goal).max())

    def _joint(self, number: int) -> str:
        names = self._group.names
        return f", {names[number - 1]}" if 1 <= number <= len(names) else ""

    def _succeed(self) -> None:
        state = self._tracker.state
        assert state is not None
        self.phase = Phase.OVER
        self.result = Result(
            points=len(self.plan.trajectory),
            seconds=self._tracker.clock() - self._began,
            planned_seconds=self.plan.total,
            deviation=self._deviation(state),
            state=state,
        )

    def _end(
        self,
        kind: type[MotionStopped] | type[MotionFailed],
        diagnostic: Diagnostic,
        reason: Reason | None,
        reached: int | None = None,
    ) -> None:
        tracker = self._tracker
        told = self._told()
        self.failed(
            kind(
                diagnostic,
                reason=reason,
                reached=reached if reached is not None or told is None else told.reached,
                messages=tracker.messages,
                states=tracker.states,
            )
        )

    @property
    def progress(self) -> Progress:
        """How far it is, now."""
        total = len(self.plan.trajectory)
        told = self._told() if self.phase is not Phase.SENDING else None
        if told is not None and told.state in list(TrajectoryState):
            return Progress(
                TrajectoryState(told.state),
                total,
                told.received,
                told.planned,
                told.reached,
                min(1.0, told.reached / len(self.plan.wire)),
            )
        if self.result is not None:
            return Progress(TrajectoryState.DONE, total, fraction=1.0)
        if self.phase is Phase.SENDING:
            return Progress(TrajectoryState.RECEIVING, total)
        state = TrajectoryState.MOVING
        if self.error is not None:
            stopped = isinstance(self.error, MotionStopped)
            state = TrajectoryState.STOPPED if stopped else TrajectoryState.FAILED
        elapsed = self._tracker.clock() - self._began
        return Progress(state, total, fraction=min(0.99, elapsed / max(self.plan.total, 1e-9)))
