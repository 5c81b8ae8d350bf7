"""The sans-IO half of a robot: what both clients share. Bytes and times in, decisions out.

Its owner holds a lock (sync) or a loop (async) and moves the bytes.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypedDict

from rapidgen import __version__
from rapidgen.client.checks import Plan, plan
from rapidgen.client.errors import (
    ConnectionLost,
    NotReady,
    ProtocolError,
    RobotError,
    TrajectoryRefused,
    fault,
)
from rapidgen.client.group import PLAIN_CAPACITY, Group
from rapidgen.client.run import Run
from rapidgen.client.state import State
from rapidgen.client.tracker import Tracker
from rapidgen.client.trajectory import Trajectory
from rapidgen.protocol import (
    ContentError,
    FrameSplitter,
    FramingError,
    decode,
    encode,
    messages,
)
from rapidgen.protocol.spec import (
    JOINT_TRAJ_PT,
    MAX_JOINTS,
    PROTOCOL_VERSION,
    REASON_TEXTS,
    Comm,
    Feature,
    Port,
    Reason,
    Sequence,
    TriState,
)

STOP_FRAME = encode(
    messages.TrajectoryPoint(Sequence.STOP, (0.0,) * MAX_JOINTS, 0.0, 0.0), Comm.REQUEST
)


class Evidence(TypedDict):
    """What every RobotError carries."""

    messages: tuple[tuple[float, str], ...]
    states: tuple[State, ...]


@dataclass(frozen=True, slots=True)
class Timeouts:
    """Seconds. Every wait of the client has one."""

    connect: float = 5.0
    hello: float = 1.0
    """How long a driver may take to answer HELLO before it counts as plain simple_message."""
    state: float = 5.0
    """First state after connecting; also the next one, where no other time is given."""
    ready: float = 1.0
    """For the robot to say that motion is possible, before a trajectory is sent."""
    silence: float = 2.0
    """Without a state for so long, a motion under way is stopped and has failed."""
    send: float = 5.0
    """Without a byte taken by the controller for so long, a trajectory is given up."""
    reply: float = 5.0
    """Reply to the end frame; 20 ms more for each point."""
    stop: float = 5.0
    """Reply to STOP, and again until the robot stands."""


@dataclass(slots=True, eq=False)
class Pending:
    """A request that waits for its reply."""

    number: int
    reply: messages.Content | None = None


@dataclass(slots=True)
class Conversation:
    """One connection on which requests are answered in their order."""

    splitter: FrameSplitter = field(default_factory=FrameSplitter)
    pending: deque[Pending] = field(default_factory=deque)
    is_open: bool = False

    def request(self, number: int) -> Pending:
        """Expect a reply of this message type."""
        waiting = Pending(number)
        self.pending.append(waiting)
        return waiting


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
    ) -> None:
        """`watch`: never move, only look. `plain`: do not ask for a rapidgen driver.

        `reconnect`: for how many s a lost connection is tried again; 0: not.
        """
        self.watch = watch
        self.reconnect = reconnect
        self.timeouts = timeouts
        self.clock = clock
        self.plain = plain
        self.configured = group
        self.tracker = Tracker(clock)
        self.state_open = False
        self.talks = {Port.MOTION: Conversation(), Port.CONTROL: Conversation()}
        self.fault: RobotError | None = None
        """Why the last connection was lost."""
        self.run: Run | None = None
        self._group: Group | None = None
        if group is not None:
            self.use(group)

    # What the connections bring

    @property
    def is_connected(self) -> bool:
        """Whether all connections stand that this client wants."""
        return self.state_open and (self.watch or self.talks[Port.MOTION].is_open)

    def opened(self, port: Port) -> None:
        """A connection stands."""
        self.fault = None
        if port is Port.STATE:
            self.tracker.restart()
            self.state_open = True
        else:
            self.talks[port] = Conversation(is_open=True)

    def received(self, port: Port, data: bytes) -> bool:
        """Take bytes; False when the connection must be closed (it cannot be followed)."""
        try:
            if port is Port.STATE:
                self.tracker.feed(data)
            else:
                self._replies(port, data)
        except FramingError as error:
            found = fault(
                "RG604",
                f"the {port.name.lower()} port does not speak simple_message: {error}",
                "is this the right host and port?",
            )
            self._lost(port, ProtocolError(found, **self.evidence()))
            return False
        self.poll()
        return True

    def _replies(self, port: Port, data: bytes) -> None:
        talk = self.talks[port]
        talk.splitter.feed(data)
        while (frame := talk.splitter.next()) is not None:
            self.tracker.keep(frame)
            try:
                content = decode(frame)
            except ContentError as error:
                self.tracker.note(str(error))
                continue
            if frame.comm != Comm.REPLY or not talk.pending:
                self.tracker.note("nobody asked for this message")
            elif talk.pending[0].number != frame.number:
                self.tracker.note(f"a reply to {talk.pending[0].number} was expected")
            else:
                talk.pending.popleft().reply = content

    def lost(self, port: Port, why: str) -> None:
        """A connection broke."""
        found = fault(
            "RG602",
            f"the connection to the {port.name.lower()} port was lost: {why}",
            "look at the robot, then connect again",
        )
        self._lost(port, ConnectionLost(found, **self.evidence()))

    def _lost(self, port: Port, error: RobotError) -> None:
        if port is Port.STATE:
            self.state_open = False
        else:
            self.talks[port].is_open = False
        self.fault = error
        # A lost control connection takes nothing from a motion under way.
        if self.run is not None and port is not Port.CONTROL:
            self.run.failed(error)

    def closed(self) -> None:
        """The caller closed all connections."""
        self.fault = None
        self.state_open = False
        for talk in self.talks.values():
            talk.is_open = False

    def disconnected(self) -> RobotError:
        """Why there is no connection."""
        return self.fault or ConnectionLost(fault("RG602", "not connected", "connect()"))

    def poll(self) -> None:
        """Let what is under way look at the newest state and at the clock."""
        if self.run is not None:
            self.run.step()

    # What callers ask

    @property
    def group(self) -> Group | None:
        """Names, units and limits; None before a driver without configuration answered."""
        return self._group

    def use(self, group: Group) -> None:
        """Take these names, units and limits."""
        self._group = group
        self.tracker.use(group)

    def evidence(self) -> Evidence:
        """The last messages and states, for an exception."""
        return {"messages": self.tracker.messages, "states": self.tracker.states}

    def hello(self) -> bytes:
        """The request that asks who is there."""
        major, minor, patch = (int(part) for part in __version__.split(".")[:3])
        asked = messages.Hello(PROTOCOL_VERSION, (major, minor, patch), int(Feature.PROGRESS))
        return encode(asked, Comm.REQUEST)

    @property
    def capacity(self) -> int:
        """Points of one trajectory: what the driver told, else abb_driver's."""
        hello = self.tracker.driver.hello
        if hello is not None:
            return hello.capacity
        # Who does not say how many it holds may be abb_driver, which drops the others.
        return min(PLAIN_CAPACITY, self._group.policy.capacity if self._group else PLAIN_CAPACITY)

    def plan(self, trajectory: Trajectory) -> Plan:
        """Check a trajectory. Raises InvalidTrajectory, NotReady (no state yet)."""
        start = self.tracker.wire_joints
        if self._group is None or start is None:
            raise NotReady(
                fault("RG621", "the robot has not told where it stands", "connect first")
            )
        return plan(
            trajectory,
            self._group,
            start=start,
            capacity=self.capacity,
            goes_to_single=self.tracker.driver.is_rapidgen,
        )

    def hindrances(self) -> list[str]:
        """Why the robot cannot move now, by its own word."""
        status = self.tracker.status
        pairs = (
            (status.e_stopped is TriState.TRUE, "an emergency stop is active"),
            (status.drives is TriState.FALSE, "the motors are off"),
            (
                status.motion_possible is TriState.FALSE and status.in_motion is not TriState.TRUE,
                "the controller says that motion is not possible",
            ),
        )
        return [text for is_so, text in pairs if is_so]

    def ready(self) -> None:
        """Raise NotReady when the robot says that it cannot move, or moves already."""
        if self.run is not None and not self.run.is_over:
            raise NotReady(
                fault("RG622", "a trajectory is under way", "wait for its result, or stop()")
            )
        hindrances = self.hindrances()
        if hindrances:
            text = "; ".join(hindrances)
            raise NotReady(
                fault("RG621", f"the robot cannot move: {text}", "mend that at the robot"),
                **self.evidence(),
            )

    def begin(self, plan: Plan) -> Run:
        """A run of this plan, from now on the one under way."""
        assert self._group is not None
        self.run = Run(plan, self._group, self.tracker, silence=self.timeouts.silence)
        return self.run

    def answered(self, run: Run, reply: messages.Content) -> None:
        """The reply to the end frame has come: accepted, or TrajectoryRefused is raised."""
        if isinstance(reply, messages.Accepted):
            run.accepted(reply.trajectory)
            return
        if isinstance(reply, messages.Acknowledged):
            run.accepted(None)
            return
        error = self._refusal(reply)
        run.failed(error)
        raise error

    def _refusal(self, reply: messages.Content) -> TrajectoryRefused:
        assert self._group is not None
        reason: Reason | None = None
        point, joint, text, where = -1, 0, "no reason given", ""
        if isinstance(reply, messages.Refused):
            point, joint = reply.point, reply.joint
            reason = Reason(reply.reason) if reply.reason in list(Reason) else None
            text = REASON_TEXTS[reason] if reason is not None else f"reason {reply.reason}"
            where = f" (point {point}" if point >= 0 else ""
            if 1 <= joint <= len(self._group.names):
                where += f"{', ' if where else ' ('}{self._group.names[joint - 1]}"
            where += ")" if where else ""
        return TrajectoryRefused(
            fault("RG620", f"the controller refused: {text}{where}", "nothing moved"),
            reason=reason,
            point=point,
            joint=joint,
            **self.evidence(),
        )

    @property
    def stop_port(self) -> Port:
        """The connection for STOP: one of its own where the driver has it."""
        return Port.CONTROL if self.talks[Port.CONTROL].is_open else Port.MOTION

    def request_stop(self, port: Port) -> Pending:
        """A STOP is about to be sent on this connection."""
        if self.run is not None and not self.run.is_over:
            self.run.stopping = True
        return self.talks[port].request(JOINT_TRAJ_PT.number)
