"""Sessions of externally guided motion on a controller: identities, states and robots.

A session goes through EGMGetId, EGMSetupUC, EGMAct and EGMRun. Its exchange with the partner runs
in a loop: in lock-step with the controller's clock for a partner that is a function, or wherever
`open_loop` lets it run. Without a partner nothing runs, and the robot stands still.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Literal, Protocol, TypeAlias

from rapidgen.machine.event_log import EventLog
from rapidgen.machine.scheduler import S, Scheduler, Timer, WaitSet
from rapidgen.motion.egm.exchange import (
    Activate,
    Exchange,
    Finish,
    Inputs,
    Link,
    Order,
    Outcome,
    Result,
    StartRun,
    StopRun,
    Stream,
)
from rapidgen.motion.egm.guide import Activation, GuidedRobot, Run
from rapidgen.motion.egm.law import CYCLE, Profile
from rapidgen.motion.group import MotionGroup
from rapidgen.system.cfg import Instance
from rapidgen.system.model import UdpDevice
from rapidgen.wire.egm.values import RapidData

MAX_IDENTITIES: Final = 4
"""At a time [manual 3HAC073318 5.2]."""
Guidance: TypeAlias = Literal["Joint", "Pose", "PathCorr"]
Partner: TypeAlias = Callable[[bytes], bytes | None]
"""A partner in lock-step: a message of the controller in, the answer or None out."""
_REJECTED: Final = 194_912
_BRAKES: Final = "brakes"


class Loop(Protocol):
    """Where an exchange runs."""

    def execute(self, order: Order) -> None:
        """Execute an order before the next cycle."""

    def cycle(self, inputs: Inputs, now: float) -> Sequence[Result]:
        """Return the results of the cycles since the last call, oldest first."""

    def close(self) -> None:
        """End the loop."""


class PartnerLink:
    """A partner in the same process: it answers each message at once."""

    def __init__(self, partner: Partner) -> None:
        self._partner = partner
        self.answers: deque[bytes] = deque()
        """Not read yet."""

    def send(self, data: bytes) -> None:
        """Call the partner."""
        answer = self._partner(data)
        if answer is not None:
            self.answers.append(answer)

    def receive(self) -> bytes | None:
        """Return its oldest answer."""
        return self.answers.popleft() if self.answers else None

    def close(self) -> None:
        """Drop what was not read."""
        self.answers.clear()


class LockStep:
    """A loop on the clock of the controller: one cycle at each call."""

    def __init__(self, exchange: Exchange, link: Link) -> None:
        self._exchange = exchange
        self.link = link

    def execute(self, order: Order) -> None:
        """Execute an order at once."""
        self._exchange.execute(order)

    def cycle(self, inputs: Inputs, now: float) -> Sequence[Result]:
        """Execute a cycle."""
        return (self._exchange.cycle(self.link, inputs, now),)

    def close(self) -> None:
        """Close the link."""
        self.link.close()


@dataclass(frozen=True, slots=True)
class Behaviour:
    """What sources disagree about; the defaults are those of the manual."""

    dead_time: float = 0.016
    """s between an order and the motion."""
    any_cycle: bool = False
    """True if cycles without a message count for the condition time, too."""
    epoch: float = 0.0
    """s to add to the controller's time in `time` of messages."""


@dataclass(frozen=True, slots=True)
class Conditions:
    """State of the controller that messages contain."""

    motors_on: bool
    program_runs: bool


@dataclass(slots=True, eq=False)
class EgmSession:
    """Session of an identity, from EGMGetId to EGMReset."""

    task: str
    guidance: Guidance | None = None
    """Guidance of the set-up; None: streaming alone, or no set-up."""
    device: UdpDevice | None = None
    profile: Profile = field(default_factory=Profile)
    comm_timeout: float | None = None
    """Seconds without a datagram after which there is no communication; None: never."""
    group: MotionGroup | None = None
    active: Guidance | None = None
    """Guidance of the activation."""
    activation: Activation | None = None
    streaming: bool = False
    """Positions go out."""
    guided: bool = False
    """Positions come in: from EGMRunJoint or EGMRunPose on."""
    outcome: Outcome = ""
    reason: str = ""
    """Of an outcome that is an error."""
    latest: Result = field(default_factory=Result)
    """Of the last cycle."""
    changed: WaitSet = field(default_factory=WaitSet)
    on_end: Callable[[], None] | None = None
    """Called once when a stream or a run ends for which the program does not wait."""
    loop: Loop | None = None
    timer: Timer | None = None
    outgoing: Callable[[], RapidData] | None = None
    """Returns what RAPID sends in each message; None: nothing."""
    incoming: Callable[[RapidData], None] | None = None
    """Takes what the partner sends to RAPID; None: it is dropped."""

    @property
    def running(self) -> bool:
        """True in EGM_STATE_RUNNING; otherwise connected."""
        return self.streaming or self.guided

    @property
    def partner(self) -> str:
        """Name of the expected partner."""
        return str(self.device)


class EgmSessions:
    """Identities of a controller.

    Args:
        scheduler: Clock of the cycles.
        log: Receives the events of sessions.
        release: RobotWare, which decides about the fields of messages.
        devices: UDP devices; None: unknown configuration.
        conditions: Returns the state of the controller for a task.
        profiles: Returns the instances of EXT_MOTION_DATA by name.
        behaviour: Where sources disagree.
    """

    def __init__(
        self,
        scheduler: Scheduler,
        log: EventLog,
        release: tuple[int, int],
        devices: tuple[UdpDevice, ...] | None,
        conditions: Callable[[str], Conditions],
        profiles: Callable[[], Mapping[str, Profile]] = dict,
        behaviour: Behaviour | None = None,
    ) -> None:
        self._behaviour = behaviour or Behaviour()
        self._scheduler = scheduler
        self._log = log
        self._release = release
        self._devices = devices
        self._conditions = conditions
        self._profiles = profiles
        self._sessions: list[EgmSession] = []
        self._partners: dict[str, Partner] = {}
        self.open_loop: Callable[[UdpDevice, Exchange], Loop | None] | None = None
        """Opens the loop of a device without a partner of `connect`; None: there is none."""

    # -- configuration ----------------------------------------------------------------------

    def device(self, name: str) -> UdpDevice | None:
        """Return a device by name, None if unknown.

        Programs may append a colon.
        """
        expected = name.removesuffix(":")
        if self._devices is None:
            return UdpDevice(expected)
        return next((d for d in self._devices if d.name.lower() == expected.lower()), None)

    def profile(self, name: str) -> Profile | None:
        """Return an instance of EXT_MOTION_DATA; None: unknown.

        Without a configuration every name means the default.
        """
        known = {key.lower(): profile for key, profile in self._profiles().items()}
        if self._devices is None or name.lower() == "default":
            return known.get(name.lower(), Profile())
        return known.get(name.lower())

    @property
    def release(self) -> tuple[int, int]:
        """Return the release of RobotWare whose messages are exchanged."""
        return self._release

    def guides(self, group: MotionGroup) -> bool:
        """True if a run guides the robot of a group."""
        return any(session.guided and session.group is group for session in self._sessions)

    def connect(self, device: str, partner: Partner) -> None:
        """Let a function be the partner of a device, in lock-step with the clock."""
        self._partners[device.removesuffix(":").lower()] = partner

    # -- identities -------------------------------------------------------------------------

    @property
    def sessions(self) -> tuple[EgmSession, ...]:
        """Return the sessions, oldest first."""
        return tuple(self._sessions)

    def take(self, task: str) -> EgmSession | None:
        """Return a new session, None if all identities are in use."""
        if len(self._sessions) >= MAX_IDENTITIES:
            return None
        self._sessions.append(EgmSession(task))
        return self._sessions[-1]

    def free(self, session: EgmSession) -> None:
        """Release the identity of a session; a robot that it guides brakes."""
        self.end(session)
        if session in self._sessions:
            self._sessions.remove(session)

    def close_task(self, task: str) -> None:
        """Release all identities of a task."""
        for session in [s for s in self._sessions if s.task == task]:
            self.free(session)

    def close(self) -> None:
        """Release all identities and what their loops use."""
        for session in self.sessions:
            self.free(session)

    # -- runs -------------------------------------------------------------------------------

    def stream(self, session: EgmSession) -> None:
        """Start the position stream."""
        session.streaming = True
        self._order(session, Stream(on=True))

    def stop_stream(self, session: EgmSession) -> None:
        """Stop the position stream."""
        session.streaming = False
        self._order(session, Stream(on=False))

    def start(self, session: EgmSession, run: Run) -> None:
        """Start a run: positions of the partner are executed from now on."""
        session.outcome, session.reason, session.guided = "", "", True
        self._order(session, StartRun(run))

    def stop(self, session: EgmSession, *, hold: bool, ramp_out: float) -> None:
        """End a run: brake within a time in s, or return to its start (EGMStop)."""
        if session.loop is None or not session.guided:
            self.end(session)
        else:
            session.loop.execute(StopRun(hold, ramp_out))

    def end(self, session: EgmSession) -> None:
        """End guidance and streaming at once; a guided robot brakes.

        EGMReset and the end of a task have this effect.
        """
        self._finish(session, "stopped")
        session.streaming = False
        self._close(session)

    def give_up(self, session: EgmSession) -> None:
        """End a run that has no partner, as a silent one."""
        self._finish(session, "silent", f"no datagram of {session.partner}")

    def _finish(self, session: EgmSession, outcome: Outcome, reason: str = "") -> None:
        """End a run; a robot that still moves brakes."""
        if not session.running:
            return
        if session.guided and session.group is not None:
            session.group.brake_guided()
        # The end of EGMRun ends the stream, too; programs start it again.
        session.guided = session.streaming = False
        session.outcome, session.reason = outcome, reason
        if session.loop is not None:
            session.loop.execute(Finish())
        session.changed.notify()
        if session.on_end is not None:
            act, session.on_end = session.on_end, None
            act()

    # -- cycles -----------------------------------------------------------------------------

    def _order(self, session: EgmSession, order: Order) -> None:
        if session.loop is None:
            session.loop = self._open(session)
        if session.loop is None:
            return
        if session.activation is not None:
            session.loop.execute(Activate(session.activation))
        session.loop.execute(order)
        if session.timer is None:
            self._cycle(session)

    def _open(self, session: EgmSession) -> Loop | None:
        device, group = session.device, session.group
        if device is None or group is None:
            return None
        exchange = Exchange(
            _robot(group, self._behaviour),
            self._release,
            session.profile,
            session.partner,
            session.comm_timeout,
            self._behaviour.epoch,
        )
        partner = self._partners.get(device.name.lower())
        if partner is not None:
            return LockStep(exchange, PartnerLink(partner))
        return None if self.open_loop is None else self.open_loop(device, exchange)

    @staticmethod
    def _close(session: EgmSession) -> None:
        if session.timer is not None:
            session.timer.cancel()
            session.timer = None
        if session.loop is not None:
            session.loop.close()
            session.loop = None

    def _cycle(self, session: EgmSession) -> None:
        """Apply the results of a cycle and ask for the next one."""
        session.timer = None
        loop, group = session.loop, session.group
        if loop is None or group is None:
            return
        inputs = self._inputs(session, group)
        results = loop.cycle(inputs, self._scheduler.now / S)
        for result in results:
            if result.rejected:
                text = f"{session.partner}: {result.rejected}"
                self._log.record(_REJECTED, text, task=session.task)
        if results:
            session.latest = results[-1]
            self._receive(session, results)
            self._move(session, group, inputs, results)
        for result in results:
            if result.outcome:
                self._finish(session, result.outcome, result.reason)
        if session.loop is loop and session.running:
            session.timer = self._scheduler.after(round(CYCLE * S), lambda: self._cycle(session))

    def _inputs(self, session: EgmSession, group: MotionGroup) -> Inputs:
        conditions, reasons = self._conditions(session.task), group.stop_reasons
        return Inputs(
            group.positions(),
            group.commanded(),
            conditions.motors_on,
            conditions.program_runs,
            stopped=bool(reasons),
            braking=_BRAKES in reasons,
            standing=group.is_standing,
            data=None if session.outgoing is None else session.outgoing(),
        )

    @staticmethod
    def _receive(session: EgmSession, results: Sequence[Result]) -> None:
        """Pass data of the partner on to RAPID; the newest of several cycles count."""
        data = next((result.data for result in reversed(results) if result.data is not None), None)
        if data is not None and session.incoming is not None:
            session.incoming(data)

    def _move(
        self, session: EgmSession, group: MotionGroup, inputs: Inputs, results: Sequence[Result]
    ) -> None:
        """Put the position of the last cycle on the robot."""
        position = results[-1].position
        if inputs.braking or not session.guided:
            return
        if position is not None:
            group.guide(position, len(results) * CYCLE, results[-1].reference)
        elif inputs.stopped:
            group.brake_guided()


def profile_of(row: Instance) -> Profile:
    """Return an instance of EXT_MOTION_DATA; what it leaves out has the default."""
    default = Profile()
    return Profile(
        level=int(row.number("ext_motion_level", default.level)),
        stands_after_motors_off=row.flag("do_not_restart_after_motors_off"),
        ramp_time=row.number("ramp_time", default.ramp_time),
        gain=row.number("ext_motion_Kp", default.gain),
        bandwidth=row.number("ext_motion_filter_bandwidth", default.bandwidth),
    )


def _robot(group: MotionGroup, behaviour: Behaviour) -> GuidedRobot:
    """Return what guidance needs to know of a group."""
    joints = group.config.joints
    return GuidedRobot(
        group.map,
        group.kinematics,
        tuple(joint.lower for joint in joints),
        tuple(joint.upper for joint in joints),
        behaviour.dead_time,
        behaviour.any_cycle,
    )
