"""A goal carried out: SUCCEEDED only on the controller's DONE, everything else with its reason.

One `GoalExecutor` is one motion group. It runs on the loop of its robot, also on a virtual clock.
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
"""Share of the axes' speeds at which a replacing goal's first point is gone to."""
_GRACE = 1e-9
_STANDS = 1e-4
"""rad, m: a robot that is not further away has not begun to move."""
_MAY_HAVE_MOVED = (MotionError, ConnectionLost, RobotTimeout, ProtocolError, StopFailed)
"""What ends the sending of a goal and does not say that the robot stands where it stood."""
_LONGER = "plan with a longer sampling period"
_MENDS = {
    "RG615": "plan with the speeds of joint_limits.yaml as `rapidgen ros2` writes it",
    "RG616": "plan again from there, or `replace: approach` goes to the first point",
    "RG617": _LONGER,
    "RG618": f"{_LONGER}, or `dense: resample` replaces points",
}
"""What to do, for whom ROS sends the goal: the client's own words are Python's."""


@dataclass(frozen=True, slots=True)
class Policy:
    """What the user said of goals; the defaults refuse what is in doubt."""

    defaults: Defaults = field(default_factory=Defaults)
    replace: Literal["refuse", "approach"] = "refuse"
    """A goal while another one moves: refused, or the robot stops and goes from there to the
    first point of the new one, on a straight way in joint space that nobody planned."""
    dense: Literal["refuse", "resample"] = "refuse"
    """Points nearer in time than the controller's planner follows: refused, or replaced by
    points on the same way that are far enough apart."""


@dataclass(frozen=True, slots=True, eq=False)
class GoalFeedback:
    """Of FollowJointTrajectory: positions rad or m and velocities (k,), `time` s since the start;
    `error` is desired minus actual."""

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
    """A goal from its acceptance to its end, and whether somebody wants it to end."""

    def __init__(self) -> None:
        self.ending = asyncio.Event()
        self.over = asyncio.Event()
        self.is_replaced = False
        self.is_called_off = False

    def cancel(self) -> None:
        """End it, on the follower's loop; `follow` returns when the robot stands."""
        self.ending.set()

    def replace(self) -> None:
        """End it in favour of another one."""
        self.is_replaced = True
        self.ending.set()

    def cancel_pending(self) -> None:
        """End it before it begins: somebody wants the robot to stand."""
        self.is_called_off = True
        self.ending.set()


class GoalExecutor:
    """Carries out goals for one robot, one at a time."""

    def __init__(
        self,
        robot: AsyncRobot,
        policy: Policy,
        now: Callable[[], float],
        note: Callable[[str], None],
    ) -> None:
        """`now` is s of ROS time; `note` takes what the user should know of a goal."""
        self._robot = robot
        self._policy = policy
        self._now = now
        self._note = note
        self._current: ActiveGoal | None = None
        self._unsent: set[ActiveGoal] = set()
        self._stood = 0.0
        """s of `_samples`: when the robot was last seen where the motion under way began."""

    @property
    def is_busy(self) -> bool:
        """Whether a goal is under way."""
        return self._current is not None

    async def follow(
        self, goal: Goal, tell: Callable[[GoalFeedback], None], under: ActiveGoal
    ) -> Outcome:
        """Carry out a goal; returns when it is over and, after a stop, the robot stands.

        `under` is how it is cancelled, also before this is called.
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
        """End the goals that wait for their moment or for another one's end."""
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
        """Take the place of the goal under way, once nobody has it. Raises GoalRefused."""
        while (other := self._current) is not None:
            if self._policy.replace == "refuse":
                raise GoalRefused(
                    Code.INVALID_GOAL,
                    "another goal is executed: cancel it and wait for its end "
                    "(replace: approach would stop it)",
                )
            other.replace()
            await other.over.wait()
        self._current = under

    async def _carried_out(
        self, requested: ValidatedGoal, under: ActiveGoal, tell: Callable[[GoalFeedback], None]
    ) -> Outcome:
        if await self._waited(requested.start or 0.0, under):
            return _ended_early(under, "before it started: nothing moved")
        self._unsent.discard(under)
        # Without a link nothing is sent.
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
            return _ended_early(under, "while it was sent; the robot stands")
        for note in requested.notes:
            self._note(note)
        return await self._until_over(requested, execution, under, tell)

    async def _waited(self, start: float, under: ActiveGoal) -> bool:
        """Wait for the moment `start` s of ROS time; True when the goal is ended before it.

        Without a link there is nothing to wait for.
        """
        while (left := start - self._now()) > 0 and self._robot.is_connected:
            ending = asyncio.ensure_future(under.ending.wait())
            # ROS time may be simulated, at a speed of its own: it is looked at again.
            await asyncio.wait({ending}, timeout=min(left, 0.1))
            if under.ending.is_set():
                break
            await _cancelled(ending)
        return under.ending.is_set()

    def _fitted(self, requested: ValidatedGoal) -> ValidatedGoal:
        """The points as the user's policy has them sent. Raises GoalRefused."""
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
        """With a way from where the robot stands to a first point elsewhere: in the time that the
        goal has for it, else where the user's policy says so."""
        group, state, trajectory = self._robot.group, self._robot.state, requested.trajectory
        current, first = np.array(state.joints), trajectory.positions[0]
        # Where the controller takes it as it is, nothing is added.
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
                Code.INVALID_GOAL, "the axes' speeds are not known: there is no way to the start"
            )
        report = (
            f"a way of {seconds:.2f} s was put in front, from where the robot stood to the first "
            f"point, {np.abs(current - first).max():.3f} (rad, m) away"
        )
        return requested.with_trajectory(trajectory.starting_at(state, seconds), report)

    async def _accepted(self, trajectory: Trajectory, under: ActiveGoal) -> AsyncExecution | None:
        """The motion; None when the goal was ended before the controller took it."""
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
            # Sending that is cancelled here stops the robot: nobody waits for it any more.
            await _cancelled(sending, ending, standing)

    async def _note_standing(self) -> None:
        """Keep when the robot was last seen where it stands, until it moves."""
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
                    return violation or _ended_early(under, "the robot stands")
                return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
            except RobotError as error:
                return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
            # The controller may have been faster than whoever wanted it to end.
            return violation or self._reached(requested, reached)
        finally:
            await _cancelled(result, watching, ending)

    async def _watch(
        self, requested: ValidatedGoal, tell: Callable[[GoalFeedback], None]
    ) -> Outcome:
        """Tell feedback; returns when a tolerance is violated."""
        before: float | None = None
        desired = unsure = 0.0
        async for time, joints, velocity in self._samples():
            if before is None:
                # It began somewhere between the sample in which it stood and this one.
                before, unsure = time, max(time - self._stood, 0.0)
            passed, before = max(time - before, 0.0), time
            # Simulated or real, the controller's time; slower under an override, none in a pause.
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
        """Seconds of the trajectory in a second, as this client knows it."""
        if self._robot.state.trajectory is TrajectoryState.PAUSED:
            return 0.0
        return self._robot.override

    async def _samples(self) -> AsyncIterator[tuple[float, Array, Array]]:
        """Time s, joints and velocities (k,): by the controller's clock where it tells it."""
        robot = self._robot
        while True:
            if self._measures:
                fed = await robot.next_feedback(math.inf)
                yield fed.time, np.array(fed.joints), np.array(fed.velocity)
            else:
                state = await robot.next_state(math.inf)
                yield state.time, np.array(state.joints), np.array(state.velocity)

    def _reached(self, requested: ValidatedGoal, result: Result) -> Outcome:
        """DONE, and whether the robot stands where it was asked to."""
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
            f"done in {result.seconds:.2f} s, {requested.trajectory.duration:.2f} s were asked for"
        )
        return Outcome(
            FinalStatus.SUCCEEDED, Code.SUCCESSFUL, "; ".join((report, *requested.notes))
        )


def resampled(requested: ValidatedGoal, shortest: float) -> ValidatedGoal:
    """Points at least `shortest` s apart, where some are nearer; how far off is noted."""
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
    """A last segment below `shortest` s is given that time; the way is the same.

    Planners that sample at a period leave such a rest at the end of nearly every path.
    """
    times = requested.trajectory.times
    if len(times) < 2 or times[-1] - times[-2] >= shortest - _GRACE:
        return requested
    remaining = float(times[-1] - times[-2])
    later = np.append(times[:-1], times[-2] + shortest)
    fresh = Trajectory(later, requested.trajectory.positions, requested.trajectory.names)
    note = f"the last segment of {remaining:.3f} s was given {shortest:g} s"
    return requested.with_trajectory(fresh, note)


def _violation(requested: ValidatedGoal, report: GoalFeedback, window: float) -> Outcome | None:
    """What of the tolerances does not hold, or None.

    When the robot began to move is known to `window` s, mostly one sample: it is compared with
    all that was asked for within it, and has to fit none of it.
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
    """What was watched and does not hold; the loss of the link is told by the motion's end."""
    if not watching.done() or isinstance(watching.exception(), RobotError):
        return None
    return watching.result()


async def _cancelled(*tasks: "asyncio.Future[Any]") -> None:
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def _stopped(execution: AsyncExecution) -> Outcome | None:
    """Stop it; an outcome where nobody confirmed that the robot stands."""
    try:
        await execution.cancel()
    except StopFailed as error:
        return _aborted(Code.PATH_TOLERANCE_VIOLATED, error)
    except RobotError:
        # Why it ended is told by its result.
        return None
    return None


def _ended_early(under: ActiveGoal, where: str) -> Outcome:
    if under.is_called_off:
        return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, f"stopped on request {where}")
    if under.is_replaced:
        return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, f"replaced by a newer goal {where}")
    return Outcome(FinalStatus.CANCELED, Code.SUCCESSFUL, f"cancelled {where}")


def _aborted(code: Code, error: RobotError) -> Outcome:
    return Outcome(FinalStatus.ABORTED, code, reason(error))


def reason(error: RobotError) -> str:
    """What went wrong and what to do about it, as one line."""
    first, *others = error.diagnostics
    report = first.message + (f" (and {len(others)} more faults)" if others else "")
    mend = _MENDS.get(first.code, first.help)
    return f"{report}; {mend}" if mend else report
