"""The sans-IO core of a robot, common to both clients.

Bytes and times enter, decisions leave: the frames that are due, the end of a motion, errors. The
rules:

1. The owner holds a lock (sync) or a loop (async) and moves the bytes. It calls `received` for each
   read, `poll` regularly, and sends what `due` returns.
2. At most one motion is active. `ready` raises before `begin` or `begin_program` if the robot
   reports a blocker; `motion.py` decides when a motion ends.
3. Replies are matched to requests by connection and type (`request_port.py`). A message on the
   motion port without a request, while an order awaits its answer, fails the motion.
4. During a motion the controller gets heartbeats on the control port, and stops the robot when one
   is late.
5. A lost state or motion connection, missing states and missing heartbeat replies fail the motion.
   STOP then goes out once on every open connection (`unmonitored_stops`), and heartbeats end, so
   that the controller stops the robot even if no STOP arrives.
6. A lost control connection fails nothing by itself.
7. Silence counts only while this process reads: data that arrived while it was delayed is still
   unread (`poll`).
"""

import logging
from collections import deque
from collections.abc import Callable
from collections.abc import Sequence as SequenceOf
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import count
from math import isfinite
from typing import TYPE_CHECKING

from rapidgen import __version__
from rapidgen.client.core.checks import (
    CheckedPoints,
    DriverLimits,
    LastPoint,
    TransferMode,
    check_trajectory,
    require_mode,
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
    InvalidProgram,
    InvalidTrajectory,
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

if TYPE_CHECKING:
    from rapidgen.client.collisions import CellCheck

STOP_FRAME = encode(
    messages.TrajectoryPoint(Sequence.STOP, (0.0,) * MAX_JOINTS, 0.0, 0.0), Comm.REQUEST
)
_SIMULATION = 1.2
"""Rate above which a clock is that of a simulation."""
_SLACK = 3
_FRESH = 1.0
"""s for which an answer on the control port proves that STOP works there."""
_ASK_AGAIN = 1.0
"""s between two requests for PROGRESS."""
_UNDER_WAY = (
    TrajectoryState.RECEIVING,
    TrajectoryState.MOVING,
    TrajectoryState.PAUSED,
    TrajectoryState.STARVED,
)
_TICK = 0.1
_OFTEN = 5
"""Checks of the clock within the time-out of a guided robot's heartbeats."""
_HELD_UP = 0.5
"""s without a read after which this process, not the robot, was delayed."""


@dataclass(frozen=True, slots=True)
class Timeouts:
    """Time limits of the client's waits, s."""

    connect: float = 5.0
    hello: float = 1.0
    """Wait for the answer to HELLO, s.

    Without an answer, and after four states, the driver counts as plain simple_message.
    """
    state: float = 5.0
    """Wait for the first state after connecting, and default for the next one."""
    ready: float = 1.0
    """Wait for the robot to report that motion is possible before an order."""
    silence: float = 2.0
    """Time without a state after which an active motion is stopped and fails."""
    send: float = 5.0
    """Time without a byte read by the controller that fails a trajectory."""
    reply: float = 5.0
    """Wait for the reply to the end frame, plus 20 ms for each point.

    Also the wait for the reply to HELLO on the control port.
    """
    stop: float = 5.0
    """Wait for the reply to STOP, and again for the robot at rest."""
    heartbeat: float = 2.0
    """Time-out of heartbeats on the control port; 0 disables them.

    The controller stops the robot when none arrives for so long during a motion.
    """


class Core:
    """State and decisions of one robot's client."""

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
        """`watch`: read states only. `plain`: do not expect a rapidgen driver.

        `reconnect`: s for which a lost connection is tried again; 0: not. `feedback`: request
        joints with the controller's own time and velocities. `simulated`: the controller's clock
        may run faster than this one. `where`: name of the robot in the log.
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
        """Reason for the loss of the last connection."""
        self.motion: Download | PointStream | None = None
        self.collisions: CellCheck | None = None
        """Check of commanded motions in a cell; None: no check."""
        self.override = 1.0
        """Share of the programmed speed that this client has set."""
        self.heartbeat = HeartbeatSchedule(timeouts.heartbeat)
        self._guidance: Callable[[], None] | None = None
        """Called with each heartbeat of a session."""
        self._heartbeat_before = 0.0
        self._stopped_unmonitored: Download | PointStream | None = None
        self.may_reach_control = False
        """True if another attempt to connect the control port is worthwhile."""
        self._control_answered = clock()
        self._asked_again = clock()
        self._looked = clock()
        self._streams = 0
        self._outbox: deque[tuple[PendingReply, bytes]] = deque()
        self._group: Group | None = None
        if group is not None:
            self.use(group)

    # Input from the connections

    @property
    def is_connected(self) -> bool:
        """True if all connections that this client needs are open."""
        return self.state_open and (self.watch or self.ports[Port.MOTION].is_open)

    def opened(self, port: Port) -> None:
        """Record that a connection is open."""
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
        """Process bytes; False if the connection must be closed."""
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
        requests = self.ports[port]
        if port is Port.CONTROL:
            self._control_answered = self.clock()
        requests.splitter.feed(data)
        while (frame := requests.splitter.next()) is not None:
            self.state_port.keep(frame)
            try:
                content = decode(frame)
            except ContentError as error:
                self._senseless(port, str(error))
                continue
            if isinstance(content, messages.Stopped):
                self._note_stop(content)
                continue
            # A rapidgen driver answers orders with data: its bare replies belong to STOP.
            has_data = self.state_port.driver.is_rapidgen
            if frame.comm != Comm.REPLY or not requests.answered(
                frame.number, content, orders_have_data=has_data
            ):
                self._senseless(port, "this message was not requested")

    def _senseless(self, port: Port, text: str) -> None:
        """Process a message without a request; it may replace an awaited answer."""
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

    def _note_stop(self, report: messages.Stopped) -> None:
        """Process the controller's report of the position after a stop."""
        if self.motion is not None and self._group is not None:
            self.motion.stopped_joints = self._group.from_wire(report.joints)

    def lost(self, port: Port, why: str) -> None:
        """Record that a connection was lost."""
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
            # An active motion continues; the controller stops it by itself if it expects a
            # heartbeat there.
            self.heartbeat.forget()
        elif self.motion is not None:
            self.motion.failed(error)

    def dropped(self, port: Port) -> None:
        """Record that this client closed a connection."""
        if port is Port.STATE:
            self.state_open = False
        else:
            self.ports[port].is_open = False

    def closed(self) -> None:
        """Record that the caller closed all connections."""
        if self.state_open:
            self.state_port.note("closed", logging.INFO)
        self.fault = None
        self.state_open = False
        for requests in self.ports.values():
            requests.is_open = False

    def forked(self) -> None:
        """Forget the connections and the motion: they belong to the parent process.

        Nothing connects again by itself, since that would take the motion port from the parent.
        """
        error = ConnectionLost.because(
            "RG602",
            "the connections belong to the process from which this one was forked",
            "connect() here, in place of the other process, or make a client of your own",
        )
        if self.motion is not None:
            self.motion.failed(error)
            # An error of this process must not stop the parent's motion.
            self.motion.is_settled = True
        connected = self.state_open or any(requests.is_open for requests in self.ports.values())
        self.closed()
        self.ports = {port: RequestPort() for port in self.ports}
        self.reconnect = 0.0
        self.may_reach_control = False
        self.heartbeat.forget()
        self._outbox.clear()
        if connected:
            self.fault = error

    def disconnected(self) -> RobotError:
        """Return the reason for a missing connection."""
        return self.fault or ConnectionLost.because("RG602", "not connected", "connect()")

    def poll(self) -> None:
        """Let the active motion process the newest state and the time."""
        now, port = self.clock(), self.state_port
        # Only once in a silence: a process that is delayed repeatedly must not wait for ever.
        if now - self._looked > _HELD_UP and port.last_message >= port.listening:
            port.listening = now
        self._looked = now
        motion = self.motion
        if motion is None:
            return
        if not motion.is_over and self.heartbeat.is_late(now, port.listening):
            motion.failed(
                self.state_port.late(
                    "the control port stopped answering while the robot may be moving",
                    "a STOP was sent; look at the robot",
                )
            )
        motion.step()

    # Output without a request of the caller

    @property
    def may_move(self) -> bool:
        """True if a motion of this client may move the robot."""
        motion = self.motion
        return motion is not None and (not motion.is_over or motion.needs_stop)

    @property
    def tick(self) -> float:
        """Return the s between two checks of the clock while no data arrives."""
        return min(_TICK, self.heartbeat.timeout / _OFTEN) if self.is_guiding else _TICK

    @property
    def is_busy(self) -> bool:
        """True if `due` must be called regularly, also without input."""
        motion = self.motion
        active = motion is not None and not motion.is_over
        return active or self.is_guiding or self.heartbeat.is_armed

    def due(self, port: Port) -> bytes | None:
        """Return the next frame for this connection, or None.

        The frame counts as sent.
        """
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
        motion = self.motion
        if isinstance(motion, PointStream) and motion.has_due:
            return motion.next_frame(self.ports[port].request(motion.queue.number))
        return None

    def _ask_again(self) -> bytes | None:
        """Send HELLO on the state port if PROGRESS stops during a motion."""
        motion, now = self.motion, self.clock()
        if (
            motion is None
            or motion.phase is not Phase.MOVING
            or not self.state_port.is_progress_lost
        ):
            return None
        if now - self._asked_again < _ASK_AGAIN:
            return None
        self._asked_again = now
        self.state_port.note("PROGRESS stopped arriving: requested again")
        return self.hello()

    def _beat(self) -> bytes | None:
        if self.heartbeat.is_refused:
            self.state_port.note("the controller rejects the heartbeat")
            self.heartbeat.timeout = 0.0
            self.heartbeat.forget()
        now = self.clock()
        moves = (self.motion is not None and not self.motion.is_over) or self.is_guiding
        timeout = self.heartbeat.due(now, moves=moves)
        if timeout is None:
            return None
        rate = self.state_port.clock_rate if self.simulated else 1.0
        if rate is None:
            return None
        if rate > _SIMULATION:
            # A stall of this machine shortens the time by the same factor; no real robot is
            # concerned.
            rate *= _SLACK
        self.heartbeat.sent(now, timeout, self.ports[Port.CONTROL].request(HEARTBEAT.number))
        if self._guidance is not None:
            self._guidance()
        return encode(messages.HeartbeatRequest(timeout * max(1.0, rate)), Comm.REQUEST)

    def post(self, content: Content) -> PendingReply:
        """Queue a request for the control port.

        Raises RequestRefused for a value that its message cannot hold.
        """
        pending = PendingReply(number_of(content))
        try:
            frame = encode(content, Comm.REQUEST)
        except ContentError as error:
            raise RequestRefused.because("RG625", f"cannot be requested: {error}") from error
        self._outbox.append((pending, frame))
        return pending

    def unmonitored_stops(self) -> list[Port]:
        """Return connections that need a STOP because states stopped arriving.

        Each motion is reported once; the requests count as made.
        """
        motion = self.motion
        unmonitored = ConnectionLost | RobotTimeout | ProtocolError
        if (
            motion is None
            or motion is self._stopped_unmonitored
            or not isinstance(motion.error, unmonitored)
        ):
            return []
        if motion.is_settled:
            return []
        self._stopped_unmonitored = motion
        self.ports[Port.MOTION].forget_orders()
        # If no STOP arrives, the controller misses the heartbeat.
        self.heartbeat.forget()
        ports = [port for port, requests in self.ports.items() if requests.is_open]
        for port in ports:
            self.request_stop(port)
            why = f"STOP over the {port.name.lower()} port: no states arrive from the robot"
            self.state_port.note(why, logging.WARNING)
        return ports

    # Requests of callers

    @property
    def group(self) -> Group | None:
        """Names, units and limits; None before the driver has sent them."""
        return self._group

    def use(self, group: Group) -> None:
        """Set names, units and limits."""
        self._group = group
        self.state_port.use(group)

    def evidence(self) -> ErrorContext:
        """Return the last messages and states, for an exception."""
        return self.state_port.evidence()

    @property
    def is_control_fresh(self) -> bool:
        """True if the control port has answered within the last moment."""
        return self.clock() - self._control_answered < _FRESH

    @property
    def is_another_moving(self) -> bool:
        """True if the robot executes a motion of another client."""
        if self.motion is not None and not self.motion.is_over:
            return False
        progress = self.state_port.progress
        in_progress = progress is not None and progress.state in _UNDER_WAY
        return in_progress or self.state_port.status.in_motion is TriState.TRUE

    def without_control(self, why: str, *, again: bool = False) -> None:
        """Record that the driver's control port has no connection.

        `again`: another attempt is worthwhile.
        """
        self.may_reach_control = again
        self.state_port.note(f"no control connection: {why}", logging.INFO)
        self.state_port.driver = replace(self.state_port.driver, control_fault=why)

    def hello(self, *, subscribe: bool = True) -> bytes:
        """Return the request for the driver's identity."""
        expected = int(self.subscribe) if subscribe else 0
        major, minor, patch = (int(part) for part in __version__.split(".")[:3])
        requested = messages.HelloRequest(PROTOCOL_VERSION, (major, minor, patch), expected)
        return encode(requested, Comm.REQUEST)

    @property
    def limits(self) -> DriverLimits:
        """Trajectories that the driver accepts."""
        driver = self.state_port.driver
        hello = driver.hello
        if hello is None:
            # A driver that does not report its capacity may be abb_driver, which drops further
            # points.
            policy = self._group.policy if self._group is not None else None
            least = PLAIN_CAPACITY if policy is None else min(PLAIN_CAPACITY, policy.capacity)
            return DriverLimits(least, goes_to_single=driver.is_rapidgen)
        streams = Feature.STREAMING in Feature(hello.features) and hello.batch > 0
        ring = hello.ring if streams else None
        return DriverLimits(hello.capacity, ring, goes_to_single=driver.is_rapidgen)

    @property
    def batch(self) -> int:
        """Number of points of an efficient message."""
        hello = self.state_port.driver.hello
        return hello.batch if hello is not None and hello.batch > 0 else batch_points(MAX_JOINTS)

    def check(
        self,
        trajectory: Trajectory,
        mode: TransferMode | None = None,
        *,
        before: LastPoint | None = None,
        is_open: bool = False,
    ) -> CheckedPoints:
        """Check points against the robot and its driver: see `check_trajectory`.

        Raises NotReady before the robot has reported its position.
        """
        start = self.start if before is None else None
        checked = check_trajectory(
            trajectory,
            self.known_group,
            self.limits,
            mode,
            start=start,
            before=before,
            is_open=is_open,
        )
        if self.collisions is None:
            return checked
        reached = before.wire.tolist() if before is not None else self.start
        report = self.collisions.check_points(
            checked.wire,
            checked.durations,
            reached,
            first=before.points if before is not None else 0,
            since=float(checked.trajectory.times[0]),
        )
        found = report.diagnostics
        if report.is_free and is_open:
            # The next piece may not come, and a stop may come anywhere.
            found = self.collisions.check_stops(
                checked.wire,
                checked.durations,
                reached,
                first=before.points if before is not None else 0,
            )
        if not report.is_free or found:
            raise InvalidTrajectory(found, exit_code=1)
        return replace(checked, warnings=(*checked.warnings, *self.collisions.diagnostics))

    def check_program(
        self, program: Program, mode: TransferMode | None = None, *, leaving: bool = False
    ) -> tuple[CheckedProgram, TransferMode]:
        """Check a program and choose its mode.

        It is downloaded if the ring buffer holds it. `leaving`: see `CellCheck.check_program`.
        Raises InvalidProgram, NotReady (no state yet), NotSupported.
        """
        require_program(program)
        require_mode(mode)
        hello = self.state_port.driver.hello
        if hello is None or Feature.PROGRAMS not in Feature(hello.features):
            raise NotSupported.because(
                "RG624",
                "the driver does not accept programs",
                "build and deploy a driver without `profile: basic` in its configuration",
            )
        chosen = mode or ("download" if len(program) <= hello.ring else "stream")
        most = hello.ring if chosen == "download" else INDEX_WRAP - 1
        checked = check_program(program, self.known_group, start=self.start, most=most)
        if self.collisions is not None:
            report = self.collisions.check_program(checked, leaving=leaving)
            if not report.is_free:
                raise InvalidProgram(report.diagnostics)
        return checked, chosen

    @property
    def start(self) -> tuple[float, ...]:
        """Ten axis values of the current position.

        Raises NotReady before they have arrived.
        """
        start = self.state_port.wire_joints
        if start is None:
            raise _unknown()
        # Comparisons with NaN are false: no distance would be too far.
        lost = [n for n, v in zip(self.known_group.names, start, strict=False) if not isfinite(v)]
        if lost:
            raise NotReady.because(
                "RG621",
                f"the controller reports no number for {', '.join(lost)}",
                "look at the robot: its position is unknown",
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
        """Reported reasons why the robot cannot move now."""
        status = self.state_port.status
        has_ended = status.motion_possible is TriState.FALSE and status.error is Reason.TASK_ENDED
        pairs = (
            (has_ended, f"{Reason.TASK_ENDED.text}, so it accepts no motion"),
            (status.e_stopped is TriState.TRUE, "an emergency stop is active"),
            (status.drives is TriState.FALSE, "the motors are off"),
            (
                status.motion_possible is TriState.FALSE
                and status.in_motion is not TriState.TRUE
                and not has_ended,
                "the controller reports that motion is not possible",
            ),
        )
        return [text for is_so, text in pairs if is_so]

    def ready(self) -> None:
        """Raise NotReady if the robot cannot move now.

        It reports a blocker, moves already, or lacks a connection.
        """
        if not self.ports[Port.MOTION].is_open:
            raise self.disconnected()
        if self.motion is not None and not self.motion.is_over:
            raise NotReady.because(
                "RG622", "a trajectory is active", "wait for its result, or stop()"
            )
        if self.is_guiding:
            raise NotReady.because(
                "RG622", "a session of externally guided motion is active", "end it before"
            )
        reasons = self.blockers()
        if reasons:
            text = "; ".join(reasons)
            raise NotReady.because(
                "RG621",
                f"the robot cannot move: {text}",
                fix_of(self.state_port.status.error, "fix this at the robot"),
                **self.evidence(),
            )

    def begin(self, checked: CheckedPoints) -> Download | PointStream:
        """Start the motion of these points as the active one."""
        if checked.mode == "stream":
            hello = self.state_port.driver.hello
            assert hello is not None
            stream = self._begin(PointQueue(hello.batch, len(self.known_group.names)))
            stream.warnings = checked.warnings
            stream.add(checked)
            return stream
        self.override = 1.0
        self.motion = motion = Download(
            checked, self.known_group, self.state_port, silence=self.timeouts.silence
        )
        return motion

    def begin_program(self, checked: CheckedProgram, mode: TransferMode) -> PointStream:
        """Start a program as the active motion."""
        motion = self._begin(InstructionQueue(checked.instructions, complete=mode == "download"))
        motion.mode, motion.noun, motion.warnings = mode, "instruction", checked.notes
        motion.queued(checked.seconds, checked.goal)
        motion.end()
        return motion

    def _begin(self, queue: SendQueue) -> PointStream:
        hello = self.state_port.driver.hello
        assert hello is not None
        # Numbers run from 1 to INDEX_WRAP - 1 and begin again.
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

    # Externally guided motion

    @property
    def is_guiding(self) -> bool:
        """True from the request of a session to its end."""
        return self._guidance is not None

    def begin_guidance(
        self, timeout: float, beat: Callable[[SequenceOf[float]], None] | None
    ) -> None:
        """Send heartbeats with this time-out, s; `beat` sends a count of them to RAPID."""
        beats = count(1)

        def send() -> None:
            if beat is not None:
                # A partner that has ended sends nothing: the driver notices that.
                with suppress(RobotError):
                    beat([float(next(beats))])

        self._heartbeat_before, self.heartbeat.timeout = self.heartbeat.timeout, timeout
        self._guidance = send

    def end_guidance(self) -> None:
        """Send no heartbeats any more."""
        if self._guidance is not None:
            self.heartbeat.timeout = self._heartbeat_before
            self._guidance = None

    def request_stop(self, port: Port) -> PendingReply:
        """Record that a STOP will be sent on this connection."""
        if self.motion is not None:
            self.motion.stopping = True
        return self.ports[port].request(JOINT_TRAJ_PT.number, is_stop=True)


def _unknown() -> NotReady:
    return NotReady.because("RG621", "the robot has not reported its position", "connect first")
