"""A trajectory that was sent completely before the motion. Sans-IO.

The rules, besides those of `motion.py`:

1. The robot may move once the end frame is being sent; its reply accepts or refuses the trajectory.
2. With PROGRESS the reported state ends the motion.
3. Without PROGRESS (abb_driver) the trajectory is done if three conditions hold together: in_motion
   is 0, the planned time is over, and the robot is at the last point. So a path that ends at its
   start, or crosses its end, does not end early.
4. A robot that was never seen moving has not arrived, unless the trajectory does not move it. Every
   joint message is evaluated for this, since many may arrive at once.
5. A robot at rest elsewhere, `_GRACE` s after the planned end, is a failure. So are an emergency
   stop, motors off and a new error of the controller.
"""

from collections.abc import Sequence

import numpy as np

from rapidgen.client.core.checks import CheckedPoints
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import (
    GOAL_TOLERANCE,
    CommandedMotion,
    Phase,
    place_of,
    refused,
)
from rapidgen.client.core.request_port import PendingReply
from rapidgen.client.core.state import Progress, trajectory_state
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.errors import MotionFailed, MotionStopped, ProtocolError, fault
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES, encode_trajectory
from rapidgen.wire.simple_message.spec import TrajectoryState, TriState

_MOVED = 1e-4
"""rad or m: more than this is a movement."""
_GRACE = 2.0
"""s of standstill after the planned end that count as a failure."""
_EARLY = 0.25
"""s by which a robot may be early: it skips a first point at its position."""


class Download(CommandedMotion):
    """A trajectory from its first byte to its end."""

    mode = "download"

    def __init__(
        self, points: CheckedPoints, group: Group, state_port: StatePort, *, silence: float
    ) -> None:
        super().__init__(group, state_port, silence)
        self.trajectory = points.trajectory
        self.warnings = points.warnings
        self.total = len(points.trajectory.times)
        self.frames = len(points.wire)
        self._unsent = encode_trajectory(points.wire, points.durations)
        # A standard abb_driver reports no progress.
        self.planned_seconds = self.longest = float(points.durations.sum())
        self.goal = points.wire[-1].tolist()
        self._pending: PendingReply | None = None
        self.approach = float(points.durations[0])
        self._was_in_error = state_port.status.in_error is TriState.TRUE
        self._start = state_port.wire_joints
        self._looked_at = 0
        """Joint messages at the last evaluation."""
        self._seen_moving = False
        self._stood_since: float | None = None
        self._is_still = bool(np.ptp(points.trajectory.positions, axis=0).max() < _MOVED)

    def take_points(self) -> bytes:
        """Return all frames but the last one: the robot does not move yet."""
        data, self._unsent = self._unsent[:-FRAME_BYTES], self._unsent[-FRAME_BYTES:]
        return data

    def take_end(self, pending: PendingReply) -> bytes:
        """Return the end frame, after which the robot may move.

        `pending` is the reply to it.
        """
        self._pending = pending
        self.is_ordered = True
        self._looked_at = self._state_port.samples
        return self._unsent

    @property
    def awaits_answer(self) -> bool:
        """See CommandedMotion."""
        return self._pending is not None and self._pending.reply is None and not self.is_over

    def step(self) -> None:
        """Process the reply and the newest state.

        Without PROGRESS the position decides.
        """
        pending = self._pending
        if pending is None:
            return
        self._look()
        if self.phase is Phase.SENDING and pending.reply is not None:
            self._answered(pending.reply)
        super().step()
        state_port = self._state_port
        if (
            self.phase is Phase.MOVING
            and state_port.progress is None
            and not state_port.is_progress_lost
            and state_port.samples > self._first_sample
        ):
            self._by_position()

    def _look(self) -> None:
        """Evaluate each joint message.

        Many may arrive at once, also before the reply.
        """
        for sample in self._state_port.samples_since(self._looked_at):
            self._seen_moving = self._seen_moving or self._has_moved(sample.joints)
        self._looked_at = self._state_port.samples

    def _answered(self, reply: Content) -> None:
        match reply:
            case messages.Accepted():
                self.accepted(reply.trajectory)
            case messages.Acknowledged():
                self.accepted(None)
            case messages.Refused():
                place = place_of(self._group, reply.point, reply.joint)
                report = reply.reason, place, reply.point, reply.joint
                self.failed(refused(self._state_port, *report))
            case messages.Failure():
                self.failed(refused(self._state_port, None))
            case _:
                self.failed(
                    ProtocolError.because(
                        "RG604",
                        f"the trajectory was answered with {reply}",
                        "a STOP was sent; look at the robot",
                        **self._state_port.evidence(),
                    )
                )

    def _by_position(self) -> None:
        state = self._state_port.state
        assert state is not None
        now, status = state.time, state.status
        moving = status.in_motion is TriState.TRUE
        self._seen_moving = self._seen_moving or moving
        if self.stopping:
            # A STOP without a wait: the motion has ended when the robot is at rest.
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
        # Before that time the robot may cross its last point, or not have left it yet.
        if elapsed < self.planned_seconds - self.approach - _EARLY:
            return
        if self._deviation(state) <= GOAL_TOLERANCE and (self._seen_moving or self._is_still):
            self._succeed()
        elif elapsed > self.planned_seconds + _GRACE and now - self._stood_since > _GRACE:
            what = "stands elsewhere" if self._seen_moving else "never moved"
            result = fault(
                "RG633",
                f"the robot {what}: {self._deviation(state):.4f} (rad, m) from the last point",
                "look at the controller's event log: a speed override, a stopped program, "
                "or a refusal that this driver cannot report",
            )
            self._end(MotionFailed, result, status.error)

    def _trouble(self) -> str:
        status = self._state_port.status
        if status.e_stopped is TriState.TRUE:
            return "emergency stop"
        if status.drives is TriState.FALSE:
            return "the motors are off"
        if status.in_error is TriState.TRUE and not self._was_in_error:
            text = status.error.text if status.error else f"code {status.error_code}"
            return f"the controller reports an error ({text})"
        return ""

    def _has_moved(self, joints: Sequence[float]) -> bool:
        if self._start is None:
            return False
        pairs = zip(joints, self._start, strict=True)
        return any(abs(a - b) > _MOVED for a, b in pairs)

    @property
    def progress(self) -> Progress:
        """Current progress."""
        total = self.total
        report = self._current_progress() if self.phase is not Phase.SENDING else None
        state = trajectory_state(report.state) if report is not None else None
        if report is not None and state is not None:
            share = min(1.0, report.reached / self.frames)
            return Progress(state, total, report.received, report.planned, report.reached, share)
        if self.result is not None:
            return Progress(TrajectoryState.DONE, total, fraction=1.0)
        if self.phase is Phase.SENDING:
            return Progress(TrajectoryState.RECEIVING, total)
        state = TrajectoryState.MOVING
        if self.error is not None:
            stopped = isinstance(self.error, MotionStopped)
            state = TrajectoryState.STOPPED if stopped else TrajectoryState.FAILED
        elapsed = self._state_port.clock() - self._began
        return Progress(state, total, fraction=min(0.99, elapsed / max(self.planned_seconds, 1e-9)))
