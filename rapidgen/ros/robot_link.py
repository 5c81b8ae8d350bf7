"""Connection to one motion group, kept up and re-established.

It starts before the robot is available and says why it waits. One `RobotLink` runs on one asyncio
loop. Its observations go to a `LinkListener`, which publishes them.
"""

import asyncio
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Protocol

from rapidgen.client.aio import AsyncRobot
from rapidgen.client.core.state import State
from rapidgen.client.errors import NotReady, RequestRefused, RobotError
from rapidgen.client.program import Argument, Left
from rapidgen.ros.goal_execution import ActiveGoal, GoalExecutor, GoalFeedback, Policy, reason
from rapidgen.ros.goals import Code, FinalStatus, Goal, Outcome
from rapidgen.ros.status_messages import (
    JointStates,
    RobotHealth,
    RobotStatus,
    health,
    no_link,
    robot_status,
    unknown_status,
)
from rapidgen.ros.stream_commands import Command, StreamReport, StreamSettings
from rapidgen.ros.time_stamps import RosTimeEstimator
from rapidgen.wire.simple_message.spec import Feature, Reason

if TYPE_CHECKING:
    from rapidgen.client.egm import EgmState
    from rapidgen.ros.stream_execution import StreamExecutor

AGAIN = 1.0
"""s between two attempts to connect."""


class LinkListener(Protocol):
    """Receiver of data to publish, on the link's loop."""

    def joint_states(self, states: JointStates) -> None:
        """Publish a new sample of the joints, each once."""

    def status(self, status: RobotStatus, health: RobotHealth) -> None:
        """Publish with each joint message, and each second without a link."""

    def note(self, text: str) -> None:
        """Log a change of the link, or the result of a goal."""

    def streaming(self, report: StreamReport) -> None:
        """Publish and log a change of the streaming topics."""


class RobotLink:
    """Connection of one motion group to ROS."""

    def __init__(
        self,
        make: Callable[[], AsyncRobot],
        policy: Policy,
        now: Callable[[], float],
        public: LinkListener,
        *,
        is_clock: bool = False,
        stream: StreamSettings | None = None,
    ) -> None:
        """`make` returns an unconnected robot; `now` is s of ROS time.

        With `is_clock` the controller's clock starts there and continues by itself. `stream`: None
        without streaming topics.
        """
        self._make = make
        self._policy = policy
        self._machine = now
        self._is_clock = is_clock
        self._public = public
        self._stamps = RosTimeEstimator(is_clock=is_clock)
        self._stream = stream
        self._streamer: StreamExecutor | None = None
        self._egm_stamps = RosTimeEstimator()
        self._fed: EgmState | None = None
        self._robot: AsyncRobot | None = None
        self._follower: GoalExecutor | None = None
        self._why = "not connected yet"
        self._paused_at: tuple[float, ...] | None = None
        self._refused = float("-inf")
        self.stops = 0
        """Number of requests to stop. A goal that was accepted before the last one never starts."""

    @property
    def is_up(self) -> bool:
        """True if the robot accepts requests."""
        return self._follower is not None

    def now(self) -> float:
        """s of ROS time."""
        if self._is_clock and self._stamps.last:
            return self._stamps.last * 1e-9
        return self._machine()

    async def run(self) -> None:
        """Keep the link until this is cancelled; then stop the motion first."""
        while True:
            robot = self._make()
            try:
                async with robot:
                    self._came(robot)
                    await self._serve(robot)
            except RobotError as error:
                self._lost(robot, reason(error))
            finally:
                self._robot = self._follower = self._streamer = None
            await asyncio.sleep(AGAIN)

    def _came(self, robot: AsyncRobot) -> None:
        self._robot = robot
        self._follower = GoalExecutor(robot, self._policy, self.now, self._public.note)
        stream = self._stream
        if stream is not None and (stream.group.egm is not None or stream.allow_delayed):
            # Late: it needs an extra.
            from rapidgen.ros.stream_execution import StreamExecutor

            self._streamer = StreamExecutor(robot, stream, self._follower, self.now, self)
        self._why = ""
        self._public.note(f"connected to {robot.address}")

    def _lost(self, robot: AsyncRobot, why: str) -> None:
        # Logged once, however often it is tried.
        if why != self._why:
            self._why = why
            self._public.note(f"no link to the robot at {robot.address}: {why}")
        self._public.status(unknown_status(), no_link(why, str(robot.address)))

    async def _serve(self, robot: AsyncRobot) -> None:
        """Publish, and execute commands, until the link is lost."""
        tasks = [asyncio.ensure_future(self._publish(robot))]
        if self._streamer is not None:
            tasks.append(asyncio.ensure_future(self._streamer.run()))
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            if self._streamer is not None:
                self._streamer.end()
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _publish(self, robot: AsyncRobot) -> None:
        """Publish each sample once, until the link is lost."""
        measures = Feature.FEEDBACK in robot.driver.features
        while True:
            if measures:
                fed = await robot.next_feedback()
                moment, joints, velocity = fed.time, fed.joints, fed.velocity
                state = robot.state
            else:
                state = await robot.next_state()
                moment, joints, velocity = state.time, state.joints, state.velocity
            stamp = self._stamps.stamp(moment, self._machine())
            if self._streamer is None or not self._streamer.is_measuring or self._is_clock:
                self._public.joint_states(JointStates(stamp, robot.group.names, joints, velocity))
            report = health(state, robot.driver, str(robot.address))
            self._public.status(robot_status(state.status), report)

    def measured(self, state: "EgmState") -> None:
        """See `StreamListener`: 250 times in a second, in place of the driver's messages."""
        before, self._fed = self._fed, state
        if self._is_clock or before is None or state.controller_time <= before.controller_time:
            return
        passed = state.controller_time - before.controller_time
        pairs = zip(state.joints, before.joints, strict=True)
        velocity = tuple((a - b) / passed for a, b in pairs)
        stamp = self._egm_stamps.stamp(state.controller_time, self._machine())
        assert self._robot is not None
        names = self._robot.group.names
        self._public.joint_states(JointStates(stamp, names, state.joints, velocity))

    def streaming(self, report: StreamReport) -> None:
        """See `StreamListener`."""
        self._public.streaming(report)

    # Requests of ROS

    def command(self, topic: str, command: Command) -> None:
        """Execute a command of a streaming topic, or report why it is ignored."""
        if self._streamer is not None:
            self._streamer.receive(topic, command)
            return
        if self._robot is None:
            code, text = "RG621", f"no link to the robot: {self._why}"
        else:
            code = "RG695"
            text = (
                "it needs externally guided motion, and the configuration has no `egm:`; "
                "add it, build and deploy, or set the parameter allow_delayed"
            )
        now = asyncio.get_running_loop().time()
        if now - self._refused > AGAIN:
            self._refused = now
            self._public.streaming(StreamReport(code, f"{topic} ignored: {text}", topic))

    async def follow(
        self, goal: Goal, tell: Callable[[GoalFeedback], None], under: ActiveGoal
    ) -> Outcome:
        """Execute a goal; without a link abort it with the reason."""
        follower = self._follower
        if follower is None:
            text = f"no link to the robot: {self._why}"
            return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, text)
        if under.stops not in (None, self.stops):
            under.cancel_pending()
        self._paused_at = None
        try:
            await self._release()
        except RobotError as error:
            return Outcome(FinalStatus.ABORTED, Code.INVALID_GOAL, reason(error))
        return await follower.follow(goal, tell, under)

    async def _release(self) -> None:
        """End a session of commands that stands. Raises NotReady for one that moves."""
        if self._streamer is not None:
            await self._streamer.release()

    async def stop(self) -> State | None:
        """Stop the robot, whichever client moves it; waiting goals end too.

        Raises RobotError.
        """
        self.stops += 1
        robot = self._there()
        if self._follower is not None:
            self._follower.cancel_pending()
        if self._streamer is not None:
            self._streamer.stop()
        return await robot.stop()

    async def pause(self) -> None:
        """Pause the motion on its path. Raises RobotError."""
        robot = self._there()
        await robot.pause()
        stood = await robot.wait_until(lambda state: not state.is_moving, 10.0)
        self._paused_at = stood.joints

    async def resume(self) -> None:
        """Resume after a pause if the robot has not moved since.

        Raises RobotError.
        """
        robot = self._there()
        if self._paused_at is None:
            raise RequestRefused.because("RG625", "nothing was paused here", "send a goal")
        moved = max(abs(a - b) for a, b in zip(robot.state.joints, self._paused_at, strict=True))
        if moved > robot.group.policy.start_tolerance:
            raise NotReady.because(
                "RG621",
                f"the robot was moved by {moved:.4f} (rad, m) since it was paused",
                "stop, and plan again from the current position",
            )
        await robot.resume()
        self._paused_at = None

    @property
    def speed(self) -> float:
        """% of the programmed speed that was last set. Raises NotReady."""
        return self._there().override * 100

    async def set_speed(self, percent: float) -> None:
        """Move at 1 to 100 % of the programmed speed.

        Raises RobotError, ValueError.
        """
        await self._there().set_speed(percent)

    async def read_signal(self, name: str) -> float:
        """Read a signal that the configuration exposes. Raises RobotError."""
        return await self._there().read_signal(name)

    async def write_signal(self, name: str, value: float) -> float:
        """Set a signal; return its value as read afterwards. Raises RobotError."""
        return await self._there().write_signal(name, value)

    async def call(self, routine: str, arguments: Sequence[Argument]) -> tuple[Left, ...]:
        """Call a routine of the controller's program; return its results.

        Raises RobotError.
        """
        robot = self._there()
        if self._follower is not None and self._follower.is_busy:
            raise NotReady.because(
                "RG621", "a goal is executed", "cancel it, or wait for its end, then call"
            )
        await self._release()
        self._paused_at = None
        return await robot.call(routine, *arguments)

    def _there(self) -> AsyncRobot:
        if self._robot is None:
            raise NotReady.because(
                "RG621", f"no link to the robot: {self._why}", "start the driver's tasks"
            )
        return self._robot


async def set_speeds(links: Sequence[RobotLink], percent: float) -> None:
    """Set 1 to 100 % for all groups that move, or for none.

    None is changed if one of them refuses, or has no link. Raises RobotError, also if none moves,
    and ValueError.
    """
    before = [link.speed for link in links]
    changed: list[tuple[RobotLink, float]] = []
    idle: RequestRefused | None = None
    try:
        for link, was in zip(links, before, strict=True):
            try:
                await link.set_speed(percent)
                changed.append((link, was))
            except RequestRefused as refused:
                if refused.reason is not Reason.IDLE:
                    raise
                idle = refused
    except (RobotError, ValueError):
        for link, was in changed:
            # A motion that has ended meanwhile, or a lost link, has no speed.
            with suppress(RobotError):
                await link.set_speed(was)
        raise
    if idle is not None and not changed:
        raise idle
