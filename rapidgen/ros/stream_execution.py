"""Execution of streaming commands over externally guided motion.

A session of the driver is opened by the first command that moves something and is kept while
commands come, because its start takes about a second. Goals have priority: while one is executed,
commands are ignored, or with `preempt` end it. One `StreamExecutor` is one motion group, on the
loop of its robot, also on a virtual clock.

After a stop, a fault or a goal, a stream that goes on does not move the robot: messages must first
pause, or ask for no motion.
"""

import asyncio
from collections.abc import Callable, Sequence
from contextlib import AbstractAsyncContextManager
from typing import Protocol

from rapidgen.client.aio import AsyncRobot
from rapidgen.client.egm import AsyncEgmSession, EgmState, Envelope
from rapidgen.client.egm.exchange import CYCLE, Path
from rapidgen.client.errors import NotReady, RobotError, TargetRejected
from rapidgen.ros.delayed_session import delayed
from rapidgen.ros.goal_execution import reason
from rapidgen.ros.stream_commands import (
    HELD,
    SILENCE,
    Command,
    CommandIgnored,
    Hold,
    Positions,
    Request,
    Speeds,
    Spline,
    StreamReport,
    StreamSettings,
    distance,
    repeats,
)
from rapidgen.ros.twist_motion import SLOW, TwistMotion

PAUSE = 0.5
"""s without a command after which a stream that was interrupted may move the robot again."""
AGAIN = 1.0
"""s between two reports of the same code and topic."""
NEAR = 0.01
"""rad or m: where commands of ros2_control have to rest before they may move the robot."""
FOREVER = 1e9
"""s: a position stays the target until the next one."""


class StreamListener(Protocol):
    """Receiver of what a session measures, on the loop."""

    def measured(self, state: EgmState) -> None:
        """Publish the joints of a frame."""

    def streaming(self, report: StreamReport) -> None:
        """Publish and log a change of the streaming topics."""


class Goals(Protocol):
    """The goals of the same robot."""

    @property
    def is_busy(self) -> bool:
        """True if a goal is active."""

    async def preempt(self) -> None:
        """End all goals and wait until the robot is at rest."""


class StreamExecutor:
    """Executor of the streaming topics of one robot."""

    def __init__(
        self,
        robot: AsyncRobot,
        settings: StreamSettings,
        goals: Goals,
        now: Callable[[], float],
        public: StreamListener,
    ) -> None:
        """`now` is s of ROS time."""
        self._robot, self._settings, self._goals = robot, settings, goals
        self._now, self._public = now, public
        envelope = Envelope.of(settings.group, settings.speed)
        self._twist = TwistMotion(settings.group, envelope)
        self._wanted, self._leave, self._closed = asyncio.Event(), asyncio.Event(), asyncio.Event()
        self._closed.set()
        self._session: AsyncEgmSession | None = None
        self._pending: tuple[str, Command, Request] | None = None
        self._twisting: Speeds | None = None
        self._speeds: tuple[float, ...] = ()
        self._received = float("-inf")
        self._ended = self._is_faulty = False
        self._resting: tuple[Positions, float] | None = None
        self._blocked = ""
        self._moved = float("-inf")
        self._stands = True
        self._reported: dict[tuple[str, str], float] = {}

    @property
    def is_open(self) -> bool:
        """True from the request of a session to its end."""
        return not self._closed.is_set()

    @property
    def is_measuring(self) -> bool:
        """True while the states of a session are published."""
        return self._session is not None and self._settings.group.egm is not None

    @property
    def is_moving(self) -> bool:
        """True if a command moves the robot, or has done so in the last moments."""
        return self.is_open and self._loop_time() - self._moved < 2 * SILENCE

    # -- commands ---------------------------------------------------------------------------

    def receive(self, topic: str, command: Command) -> None:
        """Execute a command, or report why it is ignored."""
        gap = self._gap()
        try:
            request = self._settings.reader.read(topic, command, self._now())
            self._take(topic, command, request, gap)
        except CommandIgnored as ignored:
            self._ignore(topic, ignored.code, ignored.text)
        except TargetRejected as rejected:
            self._ignore(topic, *_first(rejected))

    def _gap(self) -> float:
        """Return s since the last command of any topic."""
        now = self._loop_time()
        gap, self._received = now - self._received, now
        return gap

    def _take(self, topic: str, command: Command, request: Request, gap: float) -> None:
        if isinstance(request, Speeds) and request.axes != "joints" and not self._twist.is_possible:
            raise CommandIgnored("RG694", "the geometry of the robot or its tool is not known")
        if self._settings.is_hardware and self._session is None:
            if self._is_resting(request):
                self._blocked = ""
                self._pending = topic, command, request
                self._wanted.set()
            return
        is_silence = self._is_silence(request)
        if self._blocked and (gap >= PAUSE or is_silence):
            self._blocked = ""
        if self._blocked:
            raise CommandIgnored(
                "RG696",
                f"{self._blocked}, and the commands went on",
                f"pause for {PAUSE:g} s, or send a command without motion",
            )
        if self._goals.is_busy:
            if is_silence:
                return
            if not self._settings.preempt:
                self._blocked = "a goal was executed"
                raise CommandIgnored(
                    "RG696", "a goal is executed", "cancel it, or set the parameter preempt"
                )
        session = self._session
        if session is not None:
            self._execute(session, request, gap)
            if not is_silence or self._settings.is_hardware:
                self._moved = self._loop_time()
                self._recovered(topic)
        elif not is_silence:
            self._pending = topic, command, request
            self._wanted.set()

    def _is_resting(self, request: Request) -> bool:
        """True if commands of ros2_control have been where the robot stands for some time.

        Raises CommandIgnored if they are elsewhere: a controller that begins there would move the
        robot by more than was asked for.
        """
        if not isinstance(request, Positions):
            self._resting = None
            return False
        joints, now = self._robot.state.joints, self._loop_time()
        far, index = distance(request, joints)
        if far > NEAR:
            self._resting = None
            raise CommandIgnored(
                "RG694",
                f"{self._settings.reader.names[index]} is commanded {far:.3f} away from where the "
                "robot stands",
                "activate the controller again, so that it begins where the robot is",
            )
        if self._resting is None or distance(request, self._resting[0].values)[0] > HELD:
            self._resting = request, now
        return now - self._resting[1] >= PAUSE

    def _is_silence(self, request: Request) -> bool:
        """True if a request asks for no motion of a robot that stands."""
        state = None if self._session is None else self._session.state
        if state is None:
            return repeats(request, self._robot.state.joints)
        return self._stands and self._twisting is None and repeats(request, state.reference)

    def _execute(self, session: AsyncEgmSession, request: Request, gap: float) -> None:
        """Send a request to an open session. Raises TargetRejected."""
        at_rest = (0.0,) * len(self._settings.reader.names)
        lasts = SILENCE
        if isinstance(request, Speeds | Positions):
            lasts -= max(self._now() - request.at, 0.0)
        match request:
            case Speeds() if request.axes != "joints":
                session.envelope.tcp.check_speeds(request.values)
                if self._twisting is None:
                    self._speeds = at_rest
                self._twisting = request
                self._twist_on(session, CYCLE)
                return
            case Speeds():
                session.send(speeds=request.values, lasts=lasts)
            case Positions() if request.speeds is not None:
                session.send(request.values, speeds=request.speeds, lasts=lasts)
            case Positions() if gap <= SILENCE and (state := session.state) is not None:
                session.begin(_interpolated(request, state.reference, session.envelope, gap))
            case Positions():
                session.send(request.values, lasts=FOREVER)
            case Spline():
                session.begin(
                    Path(request.times, request.positions, request.velocities, request.since)
                )
            case Hold():
                session.send(speeds=at_rest, lasts=FOREVER)
        # Not before: what is rejected ends nothing.
        self._twisting = None

    def _twist_on(self, session: AsyncEgmSession, time: float) -> None:
        """Send the joint speeds of the next cycle of a twist, until it is too old."""
        request, state = self._twisting, session.state
        if request is None or state is None:
            return
        late = max(self._now() - request.at, 0.0)
        if late > SILENCE:
            self._twisting = None
            return
        motion = self._twist.speeds(
            request.values, state.reference, self._speeds, time, request.axes
        )
        self._speeds = motion.speeds
        session.send(speeds=motion.speeds, lasts=SILENCE - late)
        if motion.share < SLOW:
            share = f"{motion.share * 100:.0f} per cent"
            self._tell(
                StreamReport("RG698", f"slowed down to {share} by {motion.limit}", "twist_commands")
            )

    # -- sessions ---------------------------------------------------------------------------

    async def run(self) -> None:
        """Open and end sessions until cancelled."""
        while not self._ended:
            await self._wanted.wait()
            self._leave.clear()
            self._closed.clear()
            failed = False
            try:
                if self._goals.is_busy:
                    await self._goals.preempt()
                async with self._open() as session:
                    await self._serve(session)
            except RobotError as error:
                # Frames may end before the driver's report of the reason comes.
                failed = True
                known = "" if self._session is None else self._session.explain()
                self._interrupt(
                    "RG697" if known else error.diagnostics[0].code, known or reason(error)
                )
            finally:
                self._session = self._twisting = self._pending = None
                self._closed.set()
            if failed:
                await asyncio.sleep(AGAIN)
            self._wanted.clear()

    def end(self) -> None:
        """Let `run` end: its cancellation may be lost in a wait for the next frame."""
        self._ended = True
        self._leave.set()

    def _open(self) -> AbstractAsyncContextManager[AsyncEgmSession]:
        """Return a session, without EGM one over the client's stream."""
        settings = self._settings
        if settings.group.egm is not None:
            return self._robot.egm(fraction=settings.speed)
        return delayed(self._robot, settings.group, settings.speed, self._delayed_by)

    def _delayed_by(self, delay: float) -> None:
        text = f"commands are executed {delay:.2f} s late, as measured"
        self._tell(StreamReport("", text))

    async def release(self) -> None:
        """End the session for a goal. Raises NotReady if commands move the robot."""
        if self.is_moving:
            raise NotReady.because(
                "RG622", "commands of a topic move the robot", "end them, then send the goal"
            )
        if self.is_open:
            self._pending = None
            self._leave.set()
            await self._closed.wait()

    def stop(self) -> None:
        """Execute nothing more until the commands have paused."""
        self._pending = None
        if self.is_open:
            self._leave.set()
        self._blocked = "the robot was stopped"

    async def _serve(self, session: AsyncEgmSession) -> None:
        """Publish states and execute commands until the session is to be ended."""
        self._session, seen = session, session.state
        self._moved = self._loop_time()
        if not self._leave.is_set():
            self._begin(session)
        while not self._leave.is_set():
            state = session.state
            if state is seen or state is None:
                state = await session.next_state()
            if self._settings.group.egm is not None:
                self._public.measured(state)
            if not state.guided or state.stopped:
                self._interrupt("RG697", state.ended or "the robot was stopped")
                return
            passed = CYCLE
            if seen is not None:
                passed = state.controller_time - seen.controller_time
                self._stands = state.reference == seen.reference
            seen, now = state, self._loop_time()
            if not self._stands:
                self._moved = now
            try:
                self._twist_on(session, max(passed, 0.0))
            except TargetRejected as rejected:
                # What was sent last is in force for 0.1 s at most; then the robot slows down.
                self._twisting = None
                self._ignore("twist_commands", *_first(rejected))
            if now - self._moved > self._settings.idle:
                return

    def _begin(self, session: AsyncEgmSession) -> None:
        """Execute the newest command that came before the session, if it is still in force."""
        if self._pending is None:
            return
        (topic, command, request), self._pending = self._pending, None
        try:
            if isinstance(request, Speeds):
                if self._now() - request.at > SILENCE:
                    return
            else:
                request = self._settings.reader.read(topic, command, self._now())
            self._execute(session, request, PAUSE)
        except CommandIgnored as ignored:
            self._ignore(topic, ignored.code, ignored.text)
        except TargetRejected as rejected:
            self._ignore(topic, *_first(rejected))

    # -- reports ----------------------------------------------------------------------------

    def _ignore(self, topic: str, code: str, text: str) -> None:
        self._tell(StreamReport(code, f"{topic} ignored: {text}", topic))

    def _interrupt(self, code: str, why: str) -> None:
        """Report the end of a session; what goes on moves nothing."""
        self._blocked = self._blocked or "the session has ended"
        self._tell(StreamReport(code, f"streaming has ended: {why}"))

    def _tell(self, report: StreamReport) -> None:
        """Report each code of a topic at most once in a second."""
        now = self._loop_time()
        if now - self._reported.get((report.code, report.topic), float("-inf")) >= AGAIN:
            self._reported[report.code, report.topic] = now
            self._public.streaming(report)
            self._is_faulty = bool(report.code)

    def _recovered(self, topic: str) -> None:
        if self._is_faulty and self._twisting is None:
            self._tell(StreamReport("", f"{topic} executed", topic))

    @staticmethod
    def _loop_time() -> float:
        return asyncio.get_running_loop().time()


def _first(rejected: TargetRejected) -> tuple[str, str]:
    """Return code and message."""
    diagnostic = rejected.diagnostics[0]
    return diagnostic.code, diagnostic.message


def _interpolated(
    request: Positions, reference: Sequence[float], envelope: Envelope, gap: float
) -> Path:
    """Return the way to a position of a stream: as long as the distance of its messages.

    The robot thus moves evenly, one message behind, and does not overshoot.
    """
    pairs = zip(request.values, reference, envelope.speed, strict=True)
    least = max(abs(a - b) / top for a, b, top in pairs)
    return Path((max(gap, least, CYCLE),), (request.values,))
