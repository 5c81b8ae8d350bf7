"""One side of a session, without clock and sockets: what happens in each cycle.

A cycle of 4 ms executes these steps:

1. read one datagram of the partner, if there is one (ABB: one is read in a cycle),
2. let the guide order the position at the end of the cycle,
3. send the present state to the partner.

So an answer to a message has an effect in the next cycle. An exchange contains values only: it runs
on the virtual clock, or in a process of its own that serves a partner in real time.
"""

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

from rapidgen._extras import named
from rapidgen.axes.kinematics import Posture
from rapidgen.motion.egm.guide import (
    Activation,
    Guide,
    GuidedRobot,
    OutOfBounds,
    Run,
    axis_positions,
)
from rapidgen.motion.egm.law import CYCLE, Profile
from rapidgen.wire.egm.values import EgmMessageError, RapidData, RobotMessage

if TYPE_CHECKING:
    from types import ModuleType

Outcome: TypeAlias = Literal["", "converged", "stopped", "silent", "unreachable", "bounds"]
"""How a run ended; empty: it has not."""


class Link(Protocol):
    """Datagrams to and from a partner. No method waits."""

    def send(self, data: bytes) -> None:
        """Send a datagram. ConnectionRefusedError: nothing listens there."""

    def receive(self) -> bytes | None:
        """Return the next datagram of the partner; None: none is there."""

    def close(self) -> None:
        """Release what the link uses."""


# -- Orders and results ----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Activate:
    """EGMActJoint or EGMActPose."""

    activation: Activation


@dataclass(frozen=True, slots=True)
class Stream:
    """Start or end the position stream."""

    on: bool


@dataclass(frozen=True, slots=True)
class StartRun:
    """Execute positions of the partner from now on."""

    run: Run


@dataclass(frozen=True, slots=True)
class StopRun:
    """Brake within a time in s, or return to the start (EGMStop)."""

    hold: bool
    ramp_out: float


@dataclass(frozen=True, slots=True)
class Finish:
    """End run and stream at once."""


Order: TypeAlias = Activate | Stream | StartRun | StopRun | Finish


@dataclass(frozen=True, slots=True)
class Inputs:
    """State of the controller in a cycle."""

    measured: Posture
    commanded: Posture
    motors_on: bool
    program_runs: bool
    stopped: bool = False
    """The robot must come to rest, and stay."""
    braking: bool = False
    """The brakes bring it to rest."""
    standing: bool = True
    data: RapidData | None = None
    """What RAPID sends to the partner."""


@dataclass(frozen=True, slots=True)
class Result:
    """What a cycle did."""

    position: Posture | None = None
    """Of a guided robot at the end of the cycle."""
    outcome: Outcome = ""
    """Of a run that ended in this cycle."""
    reason: str = ""
    rejected: str = ""
    """Why a datagram was rejected, the first time for this reason."""
    reference: Posture | None = None
    """Where the partner wants a guided robot to be (Joint), or is ordered to be (Pose)."""
    age: float | None = None
    """s since the last message of the partner."""
    data: RapidData | None = None
    """What the partner sends to RAPID, in a message of this cycle."""


@dataclass(slots=True)
class Exchange:
    """The controller's side of a session."""

    robot: GuidedRobot
    release: tuple[int, int]
    """RobotWare, which decides about the fields of messages."""
    profile: Profile
    partner: str
    """Name for diagnostics."""
    comm_timeout: float | None = None
    """s without a datagram after which a run ends; None: never."""
    epoch: float = 0.0
    """s to add to the controller's time in `time` of messages."""
    activation: Activation = field(default_factory=lambda: Activation("Joint"))
    streaming: bool = False
    run: Run | None = None
    guide: Guide | None = None
    sequence: int = 0
    rejected: Counter[str] = field(default_factory=Counter)
    """Datagrams by the reason of their rejection."""
    _ending: Outcome = ""
    _origin: Posture | None = None
    """Where the run began, also after a stop of the program."""
    _heard: float = 0.0
    """When the last message came, or the run began, s."""
    _left: int = 0
    """Cycles until the next message: times of a real clock are not exact."""
    _now: float = 0.0
    _data: RapidData | None = None

    @property
    def running(self) -> bool:
        """True while messages are exchanged."""
        return self.streaming or self.run is not None

    @property
    def has_ended(self) -> bool:
        """True if the next cycle reports the end of a run that was stopped before its start."""
        return not self.running and bool(self._ending)

    def execute(self, order: Order) -> None:
        """Execute an order between two cycles."""
        match order:
            case Activate(activation):
                self.activation = activation
            case Stream(on):
                self.streaming = on
            case StartRun(run):
                self.run, self.guide, self._ending, self._origin = run, None, "", None
                # A run is a new session for its partner (abb_libegm: sequence number 0).
                self.sequence, self._heard, self._left = 0, self._now, 0
            case StopRun(hold, ramp_out):
                self._ending = "stopped"
                if self.guide is None:
                    # Before its first cycle, or after a stop: the next cycle ends it.
                    self._end()
                else:
                    self.guide.leave(hold=hold, ramp_out=ramp_out)
            case Finish():
                self._end()
                self._ending = ""

    def _end(self) -> None:
        self.run = self.guide = None
        # The end of EGMRun ends the stream, too; programs start it again.
        self.streaming = False

    # -- cycle ------------------------------------------------------------------------------

    def cycle(self, link: Link, inputs: Inputs, now: float) -> Result:
        """Execute a cycle; `now` is the time of the controller in s."""
        self._now = now
        if not self.running:
            ending, self._ending = self._ending, ""
            return Result(outcome=ending)
        fresh, rejected = self._receive(link)
        position: Posture | None = None
        outcome: Outcome = ""
        reason = ""
        if self.run is not None:
            position, outcome, reason = self._guided(inputs, fresh=fresh)
        guide = self.guide
        reference = None if guide is None else guide.reference or guide.ordered
        data, self._data = self._data, None
        self._left -= 1
        if self.running and self._left <= 0:
            try:
                self._send(link, inputs, now)
            except ConnectionRefusedError:
                self._end()
                outcome, reason = "unreachable", self.partner
        if outcome:
            self._ending = ""
        age = now - self._heard
        return Result(position, outcome, reason, rejected, reference, age, data)

    def _receive(self, link: Link) -> tuple[bool, str]:
        """Read one datagram; return if it has a reference, and why it was rejected."""
        data = link.receive()
        if data is None:
            return False, ""
        try:
            message = codec().decode_sensor(data)
        except EgmMessageError as fault:
            self.rejected[str(fault)] += 1
            return False, str(fault) if self.rejected[str(fault)] == 1 else ""
        self._heard = self._now
        self._data = message.data
        # Partners answer also while nothing is to be guided; that is no fault.
        return self.guide is not None and self.guide.read(message), ""

    def _guided(self, inputs: Inputs, *, fresh: bool) -> tuple[Posture | None, Outcome, str]:
        """Return the next position, and how the run ended."""
        if inputs.stopped:
            return self._come_to_rest(inputs)
        guide = self.guide
        if guide is None:
            # At the start, and after a stop: from where the robot stands.
            if not inputs.standing:
                return None, "", ""
            assert self.run is not None
            if self._origin is None:
                self._origin = inputs.commanded
            guide = self.guide = Guide(
                self.robot, self.activation, self.run, inputs.commanded, self._origin
            )
            self._heard = self._now
        if guide.is_standing:
            self._end()
            return guide.position, self._ending or "converged", ""
        try:
            position = guide.cycle()
        except OutOfBounds as fault:
            self._end()
            return None, "bounds", str(fault)
        if guide.is_stopping:
            return position, "", ""
        if guide.count(fresh=fresh):
            self._ending = "converged"
            # The robot is there: nothing is to be reduced over the ramp-out time.
            ramp_out = CYCLE if guide.run.hold else guide.run.ramp_out
            guide.leave(hold=guide.run.hold, ramp_out=ramp_out)
        elif self.comm_timeout is not None and self._now - self._heard >= self.comm_timeout:
            self._end()
            return position, "silent", f"no datagram of {self.partner}"
        return position, "", ""

    def _come_to_rest(self, inputs: Inputs) -> tuple[Posture | None, Outcome, str]:
        """Let a robot whose program stops come to rest where it is.

        The run goes on when the program does, unless it was about to end.
        """
        guide = self.guide
        if guide is None:
            return None, "", ""
        position = None
        if inputs.braking or not inputs.motors_on:
            self.guide = None
            if self.profile.stands_after_motors_off:
                self._end()
        elif guide.is_standing:
            self.guide, position = None, guide.position
        else:
            guide.hold(self.profile.ramp_time)
            return guide.cycle(), "", ""
        if self._ending:
            self._end()
        return position, self._ending, ""

    def _send(self, link: Link, inputs: Inputs, now: float) -> None:
        guide, activation = self.guide, self.activation
        self._left = max(1, round(activation.sample_time / CYCLE))
        ordered = inputs.commanded if guide is None else guide.ordered
        measured = inputs.measured if guide is None else guide.position
        message = RobotMessage(
            sequence=self.sequence,
            milliseconds=round(now * 1000),
            measured=axis_positions(self.robot, activation, measured, now + self.epoch),
            planned=axis_positions(self.robot, activation, ordered, now + self.epoch),
            motors_on=inputs.motors_on,
            state="running" if guide is not None else "stopped",
            program_runs=inputs.program_runs,
            converged=guide is not None and guide.in_tolerance,
            utilization=0.0 if guide is None else guide.utilization,
            data=inputs.data,
            move_index=0,
            collision=False,
        )
        self.sequence += 1
        link.send(codec().encode_robot(message, self.release))


def codec() -> "ModuleType":
    """Return the codec, which needs an extra; only a partner makes it necessary."""
    with named():
        from rapidgen.wire.egm import codec as result
    return result
