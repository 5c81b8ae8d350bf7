"""Execution of a goal: SUCCEEDED only on the controller's DONE.

Every other result has its reason. One `GoalExecutor` is one motion group. It runs on the loop of
its robot, also on a virtual clock.
"""

import asyncio
import math
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from rapidgen.client.aio import AsyncExecution, AsyncRobot
from rapidgen.client.core.motion import Result
from rapidgen.client.errors import (
    ConnectionLost,
    MotionError,
    MotionStopped,
    ProtocolError,
    RobotError,
    RobotTimeout,
    StopFailed,
)
from rapidgen.client.trajectory import Array, Trajectory
from rapidgen.ros.goals import (
    Code,
    Defaults,
    FinalStatus,
    Goal,
    GoalRefused,
    Outcome,
    ValidatedGoal,
    validate_goal,
)
from rapidgen.wire.simple_message.spec import Feature, TrajectoryState

_APPROACH = 0.1
"""Share of the axes' speeds for the approach of a replacing goal."""
_GRACE = 1e-9
_STANDS = 1e-4
"""rad, m: a robot within this distance has not begun to move."""
_MAY_HAVE_MOVED = (MotionError, ConnectionLost, RobotTimeout, ProtocolError, StopFailed)
"""Errors during the sending of a goal that leave the robot's state open.

The robot may not be where it was.
"""
_LONGER = "plan with a longer sampling period"
_ROS_HELPS = {
    "RG615": "plan with the speeds of joint_limits.yaml as `rapidgen ros2` writes it",
    "RG616": "plan again from there, or `replace: approach` moves to the first point first",
    "RG617": _LONGER,
    "RG618": f"{_LONGER}, or `dense: resample` replaces points",
}
"""Helps for users of ROS, since the client's own help is for Python."""


@dataclass(frozen=True, slots=True)
class Policy:
    """The user's policy for goals; the defaults refuse in doubt."""

    defaults: Defaults = field(default_factory=Defaults)
    replace: Literal["refuse", "approach"] = "refuse"
    """Goal during another one's motion: refused, or an approach.

    With an approach the robot stops and moves to the first point of the new goal, on a straight
    path in joint space that no planner has checked.
    """
    dense: Literal["refuse", "resample"] = "refuse"
    """Points nearer in time than the path planner can follow.

    They are refused, or replaced by points on the same path at a sufficient distance.
    """


@dataclass(frozen=True, slots=True, eq=False)
class GoalFeedback:
    """Feedback of FollowJointTrajectory.

    Positions in rad or m and velocities (k,), `time` s since the start; `error` is desired minus
    actual.
    """

    names: tuple[str, ...]
    time: float
    desired: Array
    desired_velocity: Array
    actual: Array
    actual_velocity: Array

    @property
    def error(self) -> Array:
        """Desired minus actual positions."""
        difference: Array = self.desired - self.actual
        return difference


class ActiveGoal:
    """A goal from its acceptance to its end, with its cancellation."""

    def __init__(self, stops: int | None = None) -> None:
        """`stops` is how many stops the link had been asked for at the acceptance."""
        self.stops = stops
        self.ending = asyncio.Event()
        self.over = asyncio.Event()
        self.replaced_by = ""
        self.is_called_off = False

    def cancel(self) -> None:
        """Cancel it, on the follower's loop; `follow` returns at rest."""
        self.ending.set()

    def replace(self, by: str) -> None:
        """End it because a newer goal or command replaces it."""
        self.replaced_by = by
        self.ending.set()

    def cancel_pending(self) -> None:
        """Cancel it before its start, because of a stop."""
        self.is_called_off = True
        self.ending.set()


class GoalExecutor:
    """Executor of goals for one robot, one at a time."""

    def __init__(
        self,
        robot: AsyncRobot,
        policy: Policy,
        now: Callable[[], float],
        note: Callable[[str], None],
    ) -> None:
        """`now` is s of ROS time; `note` receives messages about a goal."""
        self._robot = robot
        self._policy = policy
        self._now = now
        self._note = note
        self._current: ActiveGoal | None = None
        self._unsent: set[ActiveGoal] = set()
        self._stood = 0.0
        """s of `_samples`: last observation at the start of the active motion."""

    @property
    def is_busy(self) -> bool:
        """True if a goal is active."""
        return self._current is not None

    async def follow(
        self, goal: Goal, tell: Callable[[GoalFeedback], None], under: ActiveGoal
    ) -> Outcome:
        """Execute a goal; return at its end, after a stop at rest.

        `under` cancels it, also before this call.
        """
        self._unsent.add(under)
        try:
            return await self._judged_and_carried_out(goal, tell, under)
        finally:
            self._unsent.discard(under)
            if self._current is under:
                self._current = None
            under.over.set()

    def cancel_pending(self) -> None:
        """End the goals that wait for their time or for another one's end."""
        for under in self._unsent:
            under.cancel_pending()

    async def _judged_and_carried_out(
        self, goal: Goal, tell: Callable[[GoalFeedback], None], under: ActiveGoal
    ) -> Outcome:
        try:
            requested = validate_goal(
                goal, self._robot.group.names, self._policy.defaults, self._now()
            )
            await self._enter(under)
        except GoalRefused as refused:
            return refused.outcome
        except RobotError as error:
            return _aborted(Code.INVALID_GOAL, error)
        return await self._carried_out(requested, under, tell)

    async def _enter(self, under: ActiveGoal) -> None:
        """Wait until no goal is active, then become the active one.

        Raises GoalRefused.
        """
        while (other := self._current) is not None:
            if self._policy.replace == "refuse":
                raise GoalRefused(
                    Code.INVALID_GOAL,
                    "another goal is executed: cancel it and wait for its end "
                    "(replace: approach would stop it)",
                )
            other.replace("a newer goal")
            await other.over.wait()
        self._current = under

    async def preempt(self) -> None:
        """End the active goal for a command of a topic; return when the robot is at rest."""
        while (goal := self._current) is not None:
            goal.replace("a command of a topic")
            await goal.over.wait()

    async def _carried_out(
        self, requested: ValidatedGoal, under: ActiveGoal, tell: Callable[[GoalFeedback], None]
    ) -> Outcome:
        if await self._waited(requested.start or 0.0, under):
            return _ended_early(under, "before it started: nothing moved")
        self._unsent.discard(under)
        # Without a link no byte is sent.
        may_move = self._robot.is_connected
        try:
            requested = self._fitted(requested)
            execution = await self._accepted(requested.trajectory, under)
        except GoalRefused as refused:
            return refused.outcome
        except _MAY_HAVE_MOVED as error:
            code = Code.PATH_TOLERANCE_VIOLATED if may_move else Code.INVALID_GOAL
            return _aborted(code, error)
        except RobotError as error:
            return _aborted(Code.INVALID_GOAL, error)
        if execution is None:
            return _ended_early(under, "while it was sent; the robot is at rest")
        for note in requested.notes:
            self._note(note)
        return await self._until_over(requested, execution, under, tell)

    async def _waited(self, start: float, under: ActiveGoal) -> bool:
        """Wait for `start` s of ROS time; True if the goal is cancelled before.

        Without a link it returns at once.
        """
        while (left := start - self._now()) > 0 and self._robot.is_connected:
            ending = asyncio.ensure_future(under.ending.wait())
            # ROS time may be simulated at another speed: read it repeatedly.
            await asyncio.wait({ending}, timeout=min(left, 0.1))
            if under.ending.is_set():
                break
            await _cancelled(ending)
        return under.ending.is_set()

    def _fitted(self, requested: ValidatedGoal) -> ValidatedGoal:
        """Return the points as the policy permits. Raises GoalRefused."""
        if requested.watches_path and not self._measures:
            raise GoalRefused(
                Code.INVALID_GOAL,
                "path_tolerance cannot be watched: this driver sends no feedback with the "
                "controller's time (-1 asks for none)",
            )
        shortest = self._robot.group.policy.min_segment
        if self._policy.dense == "resample":
            requested = resampled(requested, shortest)
        requested = with_time_to_stop(requested, shortest)
        return self._from_here(requested)

    @property
    def _measures(self) -> bool:
        return Feature.FEEDBACK in self._robot.driver.features

    def _from_here(self, requested: ValidatedGoal) -> ValidatedGoal:
        """Prepend a path from the robot's position to a first point elsewhere.

        Its time is the one in the goal, else that of the user's policy.
        """
        group, state, trajectory = self._robot.group, self._robot.state, requested.trajectory
        current, first = np.array(state.joints), trajectory.positions[0]
        # If the controller accepts it as it is, it stays unchanged.
        if (np.abs(current - first) <= group.start_tolerance).all():
            return requested
        seconds = float(trajectory.times[0])
        if seconds == 0 and self._policy.replace == "refuse":
            return requested
        if seconds == 0:
            wire = np.abs(np.diff(group.to_wire(np.array([current, first])), axis=0)[0])
            seconds = float((wire / (group.speed * _APPROACH)).max())
            seconds = max(seconds, group.policy.min_segment)
        if not math.isfinite(seconds):
            raise GoalRefused(
                Code.INVALID_GOAL, "the axes' speeds are not known: there is no path to the start"
            )
        report = (
            f"a path of {seconds:.2f} s was prepended, from the robot's position to the first "
            f"point, {np.abs(current - first).max():.3f} (rad, m) away"
        )
        return requested.with_trajectory(trajectory.starting_at(state, seconds), report)

    async def _accepted(self, trajectory: Trajectory, under: ActiveGoal) -> AsyncExecution | None:
        """Return the motion; None if the goal was cancelled before acceptance."""
        sending = asyncio.ensure_future(self._robot.execute(trajectory))
        ending = asyncio.ensure_future(under.ending.wait())
        standing = asyncio.ensure_future(self._note_standing())
        try:
            await asyncio.wait({sending, ending}, return_when=asyncio.FIRST_COMPLETED)
            if sending.done():
                return sending.result()
            await self._robot.stop()
            await asyncio.gather(sending, return_exceptions=True)
            return None
        finally:
            # Cancelling the task here stops the robot: it has no other waiter.
            await _cancelled(sending, ending, standing)

    async def _note_standing(self) -> None:
        """Record the last observation at the current position until it moves."""
        fed, state = self._robot.feedback, self._robot.state
        current = np.array(state.joints)
        self._stood = fed.time if self._measures and fed is not None else state.time
        async for time, joints, _ in self._samples():
            if np.abs(joints - current).max() > _STANDS:
                return
            self._stood = time

    async def _until_over(
        self,
        requested: ValidatedGoal,
        execution: AsyncExecution,
        under: ActiveGoal,
        tell: Callable[[GoalFeedback], None],
    ) -> Outcome:
        result = asyncio.ensure_future(execution.result())
        watching = asyncio.ensure_future(self._watch(requested, tell))
        ending = asyncio.ensure_future(under.ending.wait())
        try:
            await asyncio.wait({result, watching, ending}, return_when=asyncio.FIRST_COMPLETED)
            violation = _violation_of(watching)
            expected = violation is not None or ending.done()
            if expected and not result.done() and (unsure := await _stopped(execution)):
                return unsure
            try:
                reached = await result
            except MotionStopped as error:
                if expected:
                    return violation or _ended_early(under, "the robot is at rest")
                return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
            except RobotError as error:
                return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
            # The controller may have finished before the cancellation.
            return violation or self._reached(requested, reached)
        finally:
            await _cancelled(result, watching, ending)

    async def _watch(
        self, requested: ValidatedGoal, tell: Callable[[GoalFeedback], None]
    ) -> Outcome:
        """Publish feedback; return if a tolerance is violated."""
        before: float | None = None
        desired = unsure = 0.0
        async for time, joints, velocity in self._samples():
            if before is None:
                # It began between the sample at rest and this one.
                before, unsure = time, max(time - self._stood, 0.0)
            passed, before = max(time - before, 0.0), time
            # The controller's time, simulated or real; slower under an override, none in a pause.
            desired += passed * self._pace
            report = GoalFeedback(
                requested.trajectory.names,
                desired,
                requested.desired(desired),
                requested.desired_velocity(desired),
                joints,
                velocity,
            )
            tell(report)
            result = _violation(requested, report, max(passed, unsure))
            if result is not None:
                return result
        raise AssertionError("samples have no end")

    @property
    def _pace(self) -> float:
        """Return the speed of the trajectory as a share, as far as known."""
        if self._robot.state.trajectory is TrajectoryState.PAUSED:
            return 0.0
        return self._robot.override

    async def _samples(self) -> AsyncIterator[tuple[float, Array, Array]]:
        """Yield time s, joints and velocities (k,), by the controller's clock.

        Without feedback the time is that of reception.
        """
        robot = self._robot
        while True:
            if self._measures:
                fed = await robot.next_feedback(math.inf)
                yield fed.time, np.array(fed.joints), np.array(fed.velocity)
            else:
                state = await robot.next_state(math.inf)
                yield state.time, np.array(state.joints), np.array(state.velocity)

    def _reached(self, requested: ValidatedGoal, result: Result) -> Outcome:
        """Return the result of DONE, after checking the goal tolerances."""
        off = np.abs(np.array(result.state.joints) - requested.trajectory.positions[-1])
        worst = int(np.argmax(off - requested.goal))
        if off[worst] > requested.goal[worst]:
            return Outcome(
                FinalStatus.ABORTED,
                Code.GOAL_TOLERANCE_VIOLATED,
                f"the controller ended the motion {off[worst]:.4f} from the last point at "
                f"{requested.trajectory.names[worst]}, and {requested.goal[worst]:g} was allowed",
            )
        report = (
            f"done in {result.seconds:.2f} s, {requested.trajectory.duration:.2f} s were commanded"
        )
        return Outcome(
            FinalStatus.SUCCEEDED, Code.SUCCESSFUL, "; ".join((report, *requested.notes))
        )


def resampled(requested: ValidatedGoal, shortest: float) -> ValidatedGoal:
    """Replace points so that they are at least `shortest` s apart.

    The largest deviation is noted.
    """
    trajectory = requested.trajectory
    times = trajectory.times
    if len(times) < 3 or np.diff(times).min() >= shortest - _GRACE:
        return requested
    span = float(times[-1] - times[0])
    count = max(int((span + _GRACE) / shortest), 1)
    fresh = trajectory.resampled(span / count)
    back = [np.interp(times, fresh.times, column) for column in fresh.positions.T]
    off = float(np.abs(np.stack(back, axis=1) - trajectory.positions).max())
    note = (
        f"{len(times)} points, some nearer than {shortest:g} s, became {len(fresh)}: "
        f"off by up to {off:.5f} (rad, m)"
    )
    return requested.with_trajectory(fresh, note)


def with_time_to_stop(requested: ValidatedGoal, shortest: float) -> ValidatedGoal:
    """Extend a last segment below `shortest` s; the path stays.

    Planners that sample at a period leave such a rest at the end of nearly every path.
    """
    times = requested.trajectory.times
    if len(times) < 2 or times[-1] - times[-2] >= shortest - _GRACE:
        return requested
    remaining = float(times[-1] - times[-2])
    later = np.append(times[:-1], times[-2] + shortest)
    fresh = Trajectory(later, requested.trajectory.positions, requested.trajectory.names)
    note = f"the last segment of {remaining:.3f} s was extended to {shortest:g} s"
    return requested.with_trajectory(fresh, note)


def _violation(requested: ValidatedGoal, report: GoalFeedback, window: float) -> Outcome | None:
    """Return the violated tolerance, or None.

    The start of the motion is known to `window` s, mostly one sample: the position violates a
    tolerance only if it does so for every start within it.
    """
    if report.time > requested.trajectory.duration + requested.goal_time + window:
        return Outcome(
            FinalStatus.ABORTED,
            Code.GOAL_TOLERANCE_VIOLATED,
            f"not at the goal {report.time - requested.trajectory.duration:.2f} s "
            "after its time, and "
            f"{requested.goal_time:g} s were allowed",
        )
    moments = np.linspace(report.time - window, report.time + window, 9)
    for what, actual, desired, allowed in (
        ("", report.actual, requested.desired, requested.path),
        (
            "velocity of ",
            report.actual_velocity,
            requested.desired_velocity,
            requested.path_velocity,
        ),
    ):
        if not np.isfinite(allowed).any():
            continue
        off = np.abs(np.array([desired(moment) for moment in moments]) - actual).min(axis=0)
        worst = int(np.argmax(off - allowed))
        if off[worst] > allowed[worst]:
            return Outcome(
                FinalStatus.ABORTED,
                Code.PATH_TOLERANCE_VIOLATED,
                f"{what}{report.names[worst]} was {off[worst]:.4f} off its path "
                f"{report.time:.2f} s after the start, and {allowed[worst]:g} was allowed",
            )
    return None


def _violation_of(watching: "asyncio.Future[Outcome]") -> Outcome | None:
    """Return the violation found by the watcher.

    The motion's end reports the loss of the link.
    """
    if not watching.done() or isinstance(watching.exception(), RobotError):
        return None
    return watching.result()


async def _cancelled(*tasks: "asyncio.Future[Any]") -> None:
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def _stopped(execution: AsyncExecution) -> Outcome | None:
    """Stop the motion; return an outcome if the stop was not confirmed."""
    try:
        await execution.cancel()
    except StopFailed as error:
        return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
    except RobotError:
        # Its result gives the reason.
        return None
    return None


def _ended_early(under: ActiveGoal, where: str) -> Outcome:
    if under.is_called_off:
        return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, f"stopped on request {where}")
    if under.replaced_by:
        text = f"replaced by {under.replaced_by} {where}"
        return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, text)
    return Outcome(FinalStatus.CANCELED, Code.SUCCESSFUL, f"cancelled {where}")


def _aborted(code: Code, error: RobotError) -> Outcome:
    return Outcome(FinalStatus.ABORTED, code, reason(error))


def reason(error: RobotError) -> str:
    """Return error and help in one line."""
    first, *others = error.diagnostics
    report = first.message + (f" (and {len(others)} more faults)" if others else "")
    help_text = _ROS_HELPS.get(first.code, first.help)
    return f"{report}; {help_text}" if help_text else report
