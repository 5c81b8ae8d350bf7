"""The sans-IO half of a robot: what both clients share. Bytes and times in, decisions out.

Its owner holds a lock (sync) or a loop (async) and moves the bytes.
"""

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isfinite

from rapidgen import __version__
from rapidgen.client.core.checks import (
    CheckedPoints,
    CheckedTrajectory,
    Way,
    check_points,
    check_trajectory,
    require_mode,
    require_trajectory,
    to_stream,
)
from rapidgen.client.core.download import Download
from rapidgen.client.core.group import PLAIN_CAPACITY, Group
from rapidgen.client.core.heartbeat import HeartbeatSchedule
from rapidgen.client.core.motion import Phase, fix_of
from rapidgen.client.core.program_checks import CheckedProgram, check_program, require_program
from rapidgen.client.core.request_port import PendingReply, RequestPort
from rapidgen.client.core.state_port import ErrorContext, StatePort
from rapidgen.client.core.stream import InstructionQueue, PointQueue, PointStream, SendQueue
from rapidgen.client.errors import (
    ConnectionLost,
    NotReady,
    NotSupported,
    ProtocolError,
    RequestRefused,
    RobotError,
    RobotTimeout,
    fault,
)
from rapidgen.client.program import Program
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message import ContentError, FramingError, decode, encode, messages
from rapidgen.wire.simple_message.codec import number_of
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.messages import HEARTBEAT, JOINT_TRAJ_PT, batch_points
from rapidgen.wire.simple_message.numpy_codec import pack_points
from rapidgen.wire.simple_message.spec import (
    INDEX_WRAP,
    MAX_JOINTS,
    PROTOCOL_VERSION,
    Comm,
    Feature,
    Port,
    Reason,
    Sequence,
    TrajectoryState,
    TriState,
)

STOP_FRAME = encode(
    messages.TrajectoryPoint(Sequence.STOP, (0.0,) * MAX_JOINTS, 0.0, 0.0), Comm.REQUEST
)
_SIMULATION = 1.2
"""Pace beyond which a clock is no controller's."""
_SLACK = 3
_FRESH = 1.0
"""s for which an answer on the control port tells that STOP works there."""
_ASK_AGAIN = 1.0
"""s between two requests for PROGRESS."""
_UNDER_WAY = (
    TrajectoryState.RECEIVING,
    TrajectoryState.MOVING,
    TrajectoryState.PAUSED,
    TrajectoryState.STARVED,
)
_HELD_UP = 0.5
"""s without a look at what has come: this process was held up, not the robot."""


@dataclass(frozen=True, slots=True)
class Timeouts:
    """Seconds. Every wait of the client has one."""

    connect: float = 5.0
    hello: float = 1.0
    """For this long, and for four states, a driver may leave HELLO without an answer before it
    counts as plain simple_message."""
    state: float = 5.0
    """First state after connecting; also the next one, where no other time is given."""
    ready: float = 1.0
    """For the robot to say that motion is possible, before a trajectory is sent."""
    silence: float = 2.0
    """Without a state for so long, a motion under way is stopped and has failed."""
    send: float = 5.0
    """Without a byte taken by the controller for so long, a trajectory is given up."""
    reply: float = 5.0
    """Reply to the end frame; 20 ms more for each point. Also to HELLO on the control port."""
    stop: float = 5.0
    """Reply to STOP, and again until the robot stands."""
    heartbeat: float = 2.0
    """While something moves the controller hears from the client, where it has a control port,
    and stops the robot when it did not for so long; 0: it does not ask for that."""


class Core:
    """Everything that one robot's client knows and decides."""

    def __init__(
        self,
        group: Group | None,
        timeouts: Timeouts,
        clock: Callable[[], float],
        *,
        watch: bool = False,
        plain: bool = False,
        reconnect: float = 0.0,
        feedback: bool = False,
        simulated: bool = False,
        where: str = "",
    ) -> None:
        """`watch`: never move, only look. `plain`: do not ask for a rapidgen driver.

        `reconnect`: for how many s a lost connection is tried again; 0: not. `feedback`: ask
        for joints with the controller's own time and velocities. `simulated`: the controller's
        clock may run faster than this one. `where`: which robot this is, for the log.
        """
        self.simulated = simulated
        self.watch = watch
        self.subscribe = Feature.PROGRESS | Feature.EVENTS
        if feedback:
            self.subscribe |= Feature.FEEDBACK
        self.reconnect = reconnect
        self.timeouts = timeouts
        self.clock = clock
        self.plain = plain
        self.configured = group
        self.state_port = StatePort(clock, where)
        self.state_open = False
        self.ports = {Port.MOTION: RequestPort(), Port.CONTROL: RequestPort()}
        self.fault: RobotError | None = None
        """Why the last connection was lost."""
        self.motion: Download | PointStream | None = None
        self.override = 1.0
        """Share of the programmed speed that was asked for."""
        self.heartbeat = HeartbeatSchedule(timeouts.heartbeat)
        self._stopped_blindly: Download | PointStream | None = None
        self.may_reach_control = False
        """Whether a control port that is not connected is worth another try."""
        self._control_heard = clock()
        self._asked_again = clock()
        self._looked = clock()
        self._streams = 0
        self._outbox: deque[tuple[PendingReply, bytes]] = deque()
        self._group: Group | None = None
        if group is not None:
            self.use(group)

    # What the connections bring

    @property
    def is_connected(self) -> bool:
        """Whether all connections stand that this client wants."""
        return self.state_open and (self.watch or self.ports[Port.MOTION].is_open)

    def opened(self, port: Port) -> None:
        """A connection stands."""
        self.fault = None
        if port is Port.STATE:
            self.state_port.restart()
            self.state_open = True
        else:
            self.ports[port] = RequestPort(is_open=True)
        if port is Port.CONTROL:
            self.heartbeat.forget()
            self._outbox.clear()

    def received(self, port: Port, data: bytes) -> bool:
        """Take bytes; False when the connection must be closed (it cannot be followed)."""
        try:
            if port is Port.STATE:
                self.state_port.feed(data)
            else:
                self._replies(port, data)
        except FramingError as error:
            result = fault(
                "RG604",
                f"the {port.name.lower()} port does not speak simple_message: {error}",
                "is this the right host and port?",
            )
            self._lost(port, ProtocolError(result, **self.evidence()))
            return False
        self.poll()
        return True

    def _replies(self, port: Port, data: bytes) -> None:
        talk = self.ports[port]
        if port is Port.CONTROL:
            self._control_heard = self.clock()
        talk.splitter.feed(data)
        while (frame := talk.splitter.next()) is not None:
            self.state_port.keep(frame)
            try:
                content = decode(frame)
            except ContentError as error:
                self._senseless(port, str(error))
                continue
            if isinstance(content, messages.Stopped):
                self._stood(content)
                continue
            has_data = self.state_port.driver.is_rapidgen
            if frame.comm != Comm.REPLY or not talk.answered(
                frame.number, content, orders_have_data=has_data
            ):
                self._senseless(port, "nobody asked for this message")

    def _senseless(self, port: Port, text: str) -> None:
        """A message that answers nothing; where an answer to an order is awaited, it was that."""
        self.state_port.note(text)
        motion = self.motion
        if port is Port.MOTION and motion is not None and motion.awaits_answer:
            motion.failed(
                ProtocolError.because(
                    "RG604",
                    f"what should answer an order on the motion port makes no sense: {text}",
                    "a STOP was sent; look at the robot",
                    **self.evidence(),
                )
            )

    def _stood(self, report: messages.Stopped) -> None:
        """The controller says where the robot stands after a halt."""
        if self.motion is not None and self._group is not None:
            self.motion.stood = self._group.from_wire(report.joints)

    def lost(self, port: Port, why: str) -> None:
        """A connection broke."""
        result = fault(
            "RG602",
            f"the connection to the {port.name.lower()} port was lost: {why}",
            "look at the robot, then connect again",
        )
        self._lost(port, ConnectionLost(result, **self.evidence()))

    def _lost(self, port: Port, error: RobotError) -> None:
        if port is Port.STATE:
            self.state_open = False
        else:
            self.ports[port].is_open = False
        self.fault = error
        self.state_port.note(str(error), logging.INFO)
        if port is Port.CONTROL:
            self.may_reach_control = True
            # Takes nothing from a motion under way; the controller stops it by itself where it
            # awaited a heartbeat there.
            self.heartbeat.forget()
        elif self.motion is not None:
            self.motion.failed(error)

    def dropped(self, port: Port) -> None:
        """This client closed a connection."""
        if port is Port.STATE:
            self.state_open = False
        else:
            self.ports[port].is_open = False

    def closed(self) -> None:
        """The caller closed all connections."""
        if self.state_open:
            self.state_port.note("closed", logging.INFO)
        self.fault = None
        self.state_open = False
        for talk in self.ports.values():
            talk.is_open = False

    def disconnected(self) -> RobotError:
        """Why there is no connection."""
        return self.fault or ConnectionLost.because("RG602", "not connected", "connect()")

    def poll(self) -> None:
        """Let what is under way look at the newest state and at the clock."""
        now, port = self.clock(), self.state_port
        # Once in a silence: a process that is held up again and again is not to wait for ever.
        if now - self._looked > _HELD_UP and port.heard >= port.listening:
            port.listening = now
        self._looked = now
        run = self.motion
        if run is None:
            return
        if not run.is_over and self.heartbeat.is_late(now, port.listening):
            run.failed(
                self.state_port.late(
                    "the control port does not answer any more while the robot may be moving",
                    "a STOP was sent; look at the robot",
                )
            )
        run.step()

    # What goes out by itself

    @property
    def is_busy(self) -> bool:
        """Whether `due` must be asked now and then, though nothing comes in."""
        run = self.motion
        return (run is not None and not run.is_over) or self.heartbeat.is_armed

    def due(self, port: Port) -> bytes | None:
        """The next frame for this connection, None: nothing. It is taken for sent."""
        if port is Port.STATE:
            return self._ask_again()
        if port not in self.ports or not self.ports[port].is_open:
            return None
        if port is Port.CONTROL:
            if self._outbox:
                pending, frame = self._outbox.popleft()
                self.ports[port].pending.append(pending)
                return frame
            return self._beat()
        run = self.motion
        if isinstance(run, PointStream) and run.has_due:
            return run.next_frame(self.ports[port].request(run.queue.number))
        return None

    def _ask_again(self) -> bytes | None:
        """HELLO on the state port: PROGRESS of a motion under way does not come any more."""
        run, now = self.motion, self.clock()
        if run is None or run.phase is not Phase.MOVING or not self.state_port.is_progress_lost:
            return None
        if now - self._asked_again < _ASK_AGAIN:
            return None
        self._asked_again = now
        self.state_port.note("PROGRESS does not come any more: asked for again")
        return self.hello()

    def _beat(self) -> bytes | None:
        if self.heartbeat.is_refused:
            self.state_port.note("the controller takes no heartbeat")
            self.heartbeat.timeout = 0.0
            self.heartbeat.forget()
        now = self.clock()
        moves = self.motion is not None and not self.motion.is_over
        timeout = self.heartbeat.due(now, moves=moves)
        if timeout is None:
            return None
        pace = self.state_port.pace if self.simulated else 1.0
        if pace is None:
            return None
        if pace > _SIMULATION:
            # A stall of this machine shortens the time by so much more; no robot is in danger.
            pace *= _SLACK
        self.heartbeat.sent(now, timeout, self.ports[Port.CONTROL].request(HEARTBEAT.number))
        return encode(messages.HeartbeatRequest(timeout * max(1.0, pace)), Comm.REQUEST)

    def post(self, content: Content) -> PendingReply:
        """A request for the control port; it goes out next. Raises RequestRefused for a value
        that its message cannot hold."""
        pending = PendingReply(number_of(content))
        try:
            frame = encode(content, Comm.REQUEST)
        except ContentError as error:
            raise RequestRefused.because("RG625", f"cannot be asked for: {error}") from error
        self._outbox.append((pending, frame))
        return pending

    def unmonitored_stops(self) -> list[Port]:
        """Connections on which a STOP must go out now: nobody sees any more what moves.

        Told once for each motion; the requests are taken for made.
        """
        run = self.motion
        unmonitored = ConnectionLost | RobotTimeout | ProtocolError
        if run is None or run is self._stopped_blindly or not isinstance(run.error, unmonitored):
            return []
        if run.is_settled:
            return []
        self._stopped_blindly = run
        self.ports[Port.MOTION].forget_orders()
        # Should no STOP get through, the controller misses the heartbeat.
        self.heartbeat.forget()
        ports = [port for port, talk in self.ports.items() if talk.is_open]
        for port in ports:
            self.request_stop(port)
            why = f"STOP over the {port.name.lower()} port: nobody sees the robot any more"
            self.state_port.note(why, logging.WARNING)
        return ports

    # What callers ask

    @property
    def group(self) -> Group | None:
        """Names, units and limits; None before a driver without configuration answered."""
        return self._group

    def use(self, group: Group) -> None:
        """Take these names, units and limits."""
        self._group = group
        self.state_port.use(group)

    def evidence(self) -> ErrorContext:
        """The last messages and states, for an exception."""
        return self.state_port.evidence()

    @property
    def is_control_fresh(self) -> bool:
        """Whether the control port has answered a moment ago."""
        return self.clock() - self._control_heard < _FRESH

    @property
    def is_another_moving(self) -> bool:
        """Whether the robot executes a motion that is not this client's."""
        if self.motion is not None and not self.motion.is_over:
            return False
        progress = self.state_port.progress
        in_progress = progress is not None and progress.state in _UNDER_WAY
        return in_progress or self.state_port.status.in_motion is TriState.TRUE

    def without_control(self, why: str, *, again: bool = False) -> None:
        """There is no control connection, though the driver has the port; `again`: it is worth
        another try."""
        self.may_reach_control = again
        self.state_port.note(f"no control connection: {why}", logging.INFO)
        self.state_port.driver = replace(self.state_port.driver, control_fault=why)

    def hello(self, *, subscribe: bool = True) -> bytes:
        """The request that asks who is there."""
        expected = int(self.subscribe) if subscribe else 0
        major, minor, patch = (int(part) for part in __version__.split(".")[:3])
        requested = messages.HelloRequest(PROTOCOL_VERSION, (major, minor, patch), expected)
        return encode(requested, Comm.REQUEST)

    @property
    def capacity(self) -> int:
        """Points of one trajectory: what the driver told, else abb_driver's."""
        hello = self.state_port.driver.hello
        if hello is not None:
            return hello.capacity
        # Who does not say how many it holds may be abb_driver, which drops the others.
        return min(PLAIN_CAPACITY, self._group.policy.capacity if self._group else PLAIN_CAPACITY)

    @property
    def batch(self) -> int:
        """Points that go well together."""
        hello = self.state_port.driver.hello
        return hello.batch if hello is not None and hello.batch > 0 else batch_points(MAX_JOINTS)

    @property
    def can_stream(self) -> bool:
        """Whether the driver takes points while it executes those before."""
        hello = self.state_port.driver.hello
        return (
            hello is not None and Feature.STREAMING in Feature(hello.features) and hello.batch > 0
        )

    def require_streaming(self) -> None:
        """Raise NotSupported where the driver takes no points while the robot moves."""
        if not self.can_stream:
            raise NotSupported.because(
                "RG624",
                "the driver does not take points while the robot moves",
                "send the trajectory as a whole, or build and deploy a driver that streams",
            )

    def check(
        self, trajectory: Trajectory, way: Way | None = None
    ) -> CheckedTrajectory | CheckedPoints:
        """Check a trajectory, once: what goes by `download`, or the points of a stream.

        When nobody says the way, one that the driver's ring does not hold is streamed, so that
        motion need not wait for the last point. Raises InvalidTrajectory, NotReady (no state
        yet), NotSupported (no driver that streams).
        """
        require_trajectory(trajectory)
        require_mode(way)
        if way == "stream":
            self.require_streaming()
            return check_points(trajectory, self.known_group, before=None, start=self.start)
        hello = self.state_port.driver.hello
        fits = hello is None or len(trajectory) <= hello.ring
        if way == "download" or fits or not self.can_stream:
            return self.check_whole(trajectory)
        complete = self.check_whole(trajectory, len(trajectory))
        return to_stream(complete, self.known_group, self.capacity)

    def check_program(self, program: Program, way: Way | None = None) -> tuple[CheckedProgram, Way]:
        """Check a program, and the way that it goes by: whole, where the driver's ring holds it.

        Raises InvalidProgram, NotReady (no state yet), NotSupported.
        """
        require_program(program)
        require_mode(way)
        hello = self.state_port.driver.hello
        if hello is None or Feature.PROGRAMS not in Feature(hello.features):
            raise NotSupported.because(
                "RG624",
                "the driver takes no programs",
                "build and deploy one whose configuration has not `profile: basic`",
            )
        chosen = way or ("download" if len(program) <= hello.ring else "stream")
        most = hello.ring if chosen == "download" else INDEX_WRAP - 1
        return check_program(program, self.known_group, start=self.start, most=most), chosen

    def check_whole(self, trajectory: Trajectory, capacity: int | None = None) -> CheckedTrajectory:
        """Check what goes by download. Raises InvalidTrajectory, NotReady."""
        require_trajectory(trajectory)
        return check_trajectory(
            trajectory,
            self.known_group,
            start=self.start,
            capacity=self.capacity if capacity is None else capacity,
            goes_to_single=self.state_port.driver.is_rapidgen,
        )

    @property
    def start(self) -> tuple[float, ...]:
        """The ten axis values where the robot stands. Raises NotReady before they came."""
        start = self.state_port.wire_joints
        if start is None:
            raise _unknown()
        # No distance from such a value is too far, and none is near.
        lost = [n for n, v in zip(self.known_group.names, start, strict=False) if not isfinite(v)]
        if lost:
            raise NotReady.because(
                "RG621",
                f"the controller tells no number for {', '.join(lost)}",
                "look at the robot: where it stands is not known",
                **self.evidence(),
            )
        return start

    @property
    def known_group(self) -> Group:
        """Names, units and limits. Raises NotReady before they are known."""
        if self._group is None:
            raise _unknown()
        return self._group

    def blockers(self) -> list[str]:
        """Why the robot cannot move now, by its own word."""
        status = self.state_port.status
        has_ended = status.motion_possible is TriState.FALSE and status.error is Reason.TASK_ENDED
        pairs = (
            (has_ended, f"{Reason.TASK_ENDED.text}, so it takes no motion"),
            (status.e_stopped is TriState.TRUE, "an emergency stop is active"),
            (status.drives is TriState.FALSE, "the motors are off"),
            (
                status.motion_possible is TriState.FALSE
                and status.in_motion is not TriState.TRUE
                and not has_ended,
                "the controller says that motion is not possible",
            ),
        )
        return [text for is_so, text in pairs if is_so]

    def ready(self) -> None:
        """Raise NotReady when the robot says that it cannot move, or moves already; or why there
        is no connection to move it over."""
        if not self.ports[Port.MOTION].is_open:
            raise self.disconnected()
        if self.motion is not None and not self.motion.is_over:
            raise NotReady.because(
                "RG622", "a trajectory is under way", "wait for its result, or stop()"
            )
        hindrances = self.blockers()
        if hindrances:
            text = "; ".join(hindrances)
            raise NotReady.because(
                "RG621",
                f"the robot cannot move: {text}",
                fix_of(self.state_port.status.error, "mend that at the robot"),
                **self.evidence(),
            )

    def begin(self, checked: CheckedTrajectory) -> Download:
        """The motion by this trajectory, from now on the one under way."""
        self.override = 1.0
        self.motion = motion = Download(
            checked, self.known_group, self.state_port, silence=self.timeouts.silence
        )
        return motion

    def begin_stream(self, checked: CheckedPoints) -> PointStream:
        """A stream that has these points first, from now on the motion under way."""
        hello = self.state_port.driver.hello
        assert hello is not None
        motion = self._begin(PointQueue(hello.batch, len(self.known_group.names)))
        motion.warnings = checked.warnings
        self.go_on(motion, checked)
        return motion

    @staticmethod
    def go_on(stream: PointStream, checked: CheckedPoints) -> None:
        """More points of a stream."""
        assert isinstance(stream.queue, PointQueue)
        stream.queue.put(pack_points(checked.durations, checked.wire))
        stream.goes_on(checked.durations.tolist(), checked.last.wire.tolist())

    def begin_program(self, checked: CheckedProgram, way: Way) -> PointStream:
        """A program, from now on the motion under way."""
        motion = self._begin(InstructionQueue(checked.instructions, complete=way == "download"))
        motion.way, motion.noun, motion.warnings = way, "instruction", checked.notes
        motion.goes_on(checked.seconds, checked.goal)
        motion.end()
        return motion

    def _begin(self, queue: SendQueue) -> PointStream:
        hello = self.state_port.driver.hello
        assert hello is not None
        self._streams = self._streams % (INDEX_WRAP - 1) + 1
        self.override = 1.0
        self.motion = motion = PointStream(
            self._streams,
            queue,
            hello,
            self.known_group,
            self.state_port,
            silence=self.timeouts.silence,
            reply=self.timeouts.reply,
        )
        return motion

    def request_stop(self, port: Port) -> PendingReply:
        """A STOP is about to be sent on this connection."""
        if self.motion is not None:
            self.motion.stopping = True
        return self.ports[port].request(JOINT_TRAJ_PT.number, is_stop=True)


def _unknown() -> NotReady:
    return NotReady.because("RG621", "the robot has not told where it stands", "connect first")
