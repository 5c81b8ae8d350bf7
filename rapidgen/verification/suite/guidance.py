"""Externally guided motion: sessions, their ends, and what they exclude.

The partner is in lock-step with the virtual controller and encodes its datagrams itself. The ends
of a session are a table: what happens, and what the driver must report then. After each of them the
robot stands, stays, and has never left the limits that the controller enforces.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TypeAlias

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.egm_partner import GuidingPartner
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import distance
from rapidgen.verification.suite.control import done, not_done, stop
from rapidgen.verification.testbench import Bench

case = SuiteGroup("guiding", needs="egm")

DONE, FAILED, STOPPED = (
    RawTrajectoryState.DONE,
    RawTrajectoryState.FAILED,
    RawTrajectoryState.STOPPED,
)
_SHARE = 0.3
"""Of the largest speed: the partner moves an axis so fast at most."""
_LONGEST = 6.0
"""s of a motion to one side: then it would be at the limit of its deviation."""
_ROUND = 1e-4
"""rad: RAPID's num, and the last cycle before a limit is noticed."""
_FRAMES = 200
"""Messages per s of a trajectory at least; the controller sends 250."""
_IDLE = 30.0
"""s: a longer idle time takes too long to wait for."""


class GuidedBench:
    """A bench with a partner, and a control connection that sends heartbeats."""

    def __init__(self, bench: Bench) -> None:
        egm = bench.group.egm
        assert egm is not None
        self.bench, self.egm = bench, egm
        self.speed = math.degrees(min(egm.max_speed * _SHARE, egm.max_deviation / _LONGEST))
        """Degrees/s."""
        self.partner = GuidingPartner(lambda: bench.now)
        bench.controller.egm.connect(egm.device, self.partner)
        self.control, self.watcher = bench.control(), bench.watcher()
        self.begun = bench.now
        """When the newest session was requested."""

    def heartbeat(self) -> None:
        """Announce the next heartbeat, and check the reply."""
        reply = self.control.ask(messages.RawHeartbeat(self.egm.timeout))
        if not isinstance(reply, messages.RawHeartbeatReply):
            raise CheckFailed(f"HEARTBEAT: the reply is {reply}")

    def run(self, seconds: float) -> None:
        """Let time pass with heartbeats."""
        end = self.bench.now + seconds
        beat = messages.encode(messages.RawHeartbeat(self.egm.timeout), RawComm.REQUEST)
        while self.bench.now < end - 1e-9:
            if not self.control.lost:
                self.control.send(beat)
            self.bench.run(min(self.egm.timeout / 2.5, end - self.bench.now))

    def wait_until_standing(self, seconds: float) -> None:
        """Wait for the robot with heartbeats: their lack would stop it, too."""
        end = self.bench.now + seconds
        while not self.bench.standing:
            if self.bench.now > end:
                raise CheckFailed(f"the robot does not stand within {seconds:g} s")
            self.run(0.04)

    def request(self) -> messages.RawContent:
        """Request a session with a heartbeat, and return the reply."""
        if self.control.lost:
            self.control = self.bench.control()
        self.heartbeat()
        return self.control.ask(messages.RawEgm(1))

    def start(self, speed: float | None = None) -> int:
        """Start a session and let it move; return its number."""
        self.partner.speed = self.speed if speed is None else speed
        self.begun = self.bench.now
        sessions, reply = self.partner.sessions, self.request()
        if not isinstance(reply, messages.RawEgmReply):
            raise CheckFailed(f"a session is not started: {reply}")
        self.run(1.0)
        if self.partner.sessions != sessions + 1 or not self.partner.frames[-1][1].running:
            raise CheckFailed("the controller does not guide the robot after the reply to EGM")
        return reply.trajectory

    def ended(
        self, session: int, state: RawTrajectoryState, reasons: tuple[RawReason, ...] = ()
    ) -> None:
        """Check how a session has ended, and that the robot has kept within its limits."""
        self.bench.assert_at_rest(1, "its session has ended")
        progress = self.bench.progress(self.watcher)
        wrong = reasons and progress.reason not in reasons
        if (progress.trajectory, progress.state) != (session, state) or wrong:
            names = ", ".join(r.name for r in reasons)
            raise CheckFailed(f"session {session} is {state.name} ({names}), PROGRESS: {progress}")
        within_limits(self)

    def again(self) -> None:
        """Check that a new session begins at the robot's position."""
        before = self.bench.position
        self.start(0.0)
        if distance(before, self.bench.position) > _ROUND:
            raise CheckFailed(f"a new session moves from {before} to {self.bench.position}")
        reply = self.control.ask(messages.RawEgm(0))
        if not isinstance(reply, messages.RawEgmReply):
            raise CheckFailed(f"the end of a session is not confirmed: {reply}")
        self.run(1.0)


def within_limits(guided: GuidedBench) -> None:
    """Check the record of the newest session against `max_deviation` and `max_speed`."""
    egm, start = guided.egm, guided.bench.track_at(guided.begun)
    track = [(when, place) for when, place in guided.bench.track if when >= guided.begun]
    for (earlier, a), (later, b) in pairwise(track):
        if distance(start, b) > egm.max_deviation + _ROUND:
            raise CheckFailed(f"at {later:.3f} s the robot is at {b}, it began at {start}")
        if distance(a, b) > egm.max_speed * (later - earlier) * 1.001 + _ROUND:
            raise CheckFailed(f"at {later:.3f} s the robot is faster than max_speed")


# -- sessions --------------------------------------------------------------------------------------


@case("egm-session", "a session starts and ends on request, and a next one begins anew")
def _session(bench: Bench) -> None:
    """Without a heartbeat none starts; each begins with sequence number 0 where the robot is."""
    guided = GuidedBench(bench)
    not_done(guided.control.ask(messages.RawEgm(1)), RawReason.NO_HEARTBEAT, "EGM alone")
    slow = messages.RawHeartbeat(4 * guided.egm.timeout)
    guided.control.ask(slow)
    not_done(guided.control.ask(messages.RawEgm(1)), RawReason.NO_HEARTBEAT, "a slow heartbeat")
    not_done(guided.control.ask(messages.RawEgm(0)), RawReason.IDLE, "an end without a session")
    not_done(guided.control.ask(messages.RawEgm(2)), RawReason.BAD_VALUE, "EGM 2")
    start = bench.position
    for _ in range(2):
        session = guided.start()
        if distance(start, bench.position) < 0.1 * math.radians(guided.speed):
            raise CheckFailed(f"the robot does not follow: {start} to {bench.position}")
        reply = guided.control.ask(messages.RawEgm(0))
        if reply != messages.RawEgmReply(session):
            raise CheckFailed(f"the end of session {session}: {reply}")
        guided.wait_until_standing(guided.egm.stop_ramp + 0.2 * bench.setting.slowness)
        guided.run(0.5)
        guided.ended(session, DONE)
        start = bench.position
    guided.again()
    done(guided.control.ask(messages.RawPing()), "PING after sessions")
    guided.control.ask(messages.RawHeartbeat(0.0))
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@case("egm-converged", "a session ends at its target after the idle time", once=True)
def _converges(bench: Bench) -> None:
    """EGMRunJoint returns by itself; the next session is a new one."""
    guided = GuidedBench(bench)
    if guided.egm.idle_timeout > _IDLE:
        raise NotApplicable(f"idle_timeout is longer than {_IDLE:g} s")
    session = guided.start(0.0)
    guided.run(guided.egm.idle_timeout)
    guided.ended(session, DONE)
    frames = len(guided.partner.frames)
    guided.run(0.5)
    if len(guided.partner.frames) > frames:
        raise CheckFailed("the controller still sends after the end of a session")
    guided.again()


@case("egm-excludes", "sessions and trajectories exclude each other")
def _excludes(bench: Bench) -> None:
    """During one of them, the other is refused (MOVING) and changes nothing."""
    guided, link = GuidedBench(bench), bench.motion()
    session = guided.start()
    for name, request in (("PAUSE", messages.RawPause(1)), ("SPEED", messages.RawSpeed(50.0))):
        not_done(guided.control.ask(request), RawReason.GUIDED, f"{name} in a session")
    guided.run(0.1)
    not_done(guided.control.ask(messages.RawEgm(1)), RawReason.MOVING, "a second session")
    link.send(bench.download(bench.wave(3), RawComm.REQUEST))
    guided.run(0.5)
    replies = [content for _, content in link.messages_of(messages.RawRefused)]
    if not replies or any(reply.reason != RawReason.MOVING for reply in replies):
        raise CheckFailed(f"a trajectory in a session: the replies are {replies}")
    if bench.progress(guided.watcher).trajectory != session or bench.standing:
        raise CheckFailed("a rejected trajectory has ended the session")
    guided.run(0.1)
    guided.control.ask(messages.RawEgm(0))
    guided.run(1.0)
    guided.ended(session, DONE)
    points = bench.wave(6)
    bench.start_motion(link, points)
    guided.run(0.2)
    not_done(guided.request(), RawReason.MOVING, "a session during a trajectory")
    guided.run(5.0)
    if distance(bench.position, points[-1][0]) > _ROUND:
        raise CheckFailed("a rejected session has ended the trajectory")
    guided.again()


@case("egm-feedback", "positions are sent during trajectories, and only then")
def _feedback(bench: Bench) -> None:
    """With `feedback: true` the controller sends each 4 ms, and executes no answer."""
    guided = GuidedBench(bench)
    frames, points, link = guided.partner.frames, bench.wave(4), bench.motion()
    begun = bench.now
    bench.start_motion(link, points)
    bench.arrives(points, begun, 30)
    if not guided.egm.feedback:
        if frames:
            raise CheckFailed("positions are sent without `feedback: true`")
        return
    bench.run(0.5)
    count, last = len(frames), frames[-1][0] if frames else 0.0
    if count < (last - begun) * _FRAMES or any(received.running for _, received in frames):
        raise CheckFailed(f"{count} messages in a trajectory of {last - begun:.1f} s")
    bench.run(0.5)
    if len(frames) > count:
        raise CheckFailed("positions are sent after the end of the trajectory")
    link.send(bench.download(bench.wave(6)))
    bench.wait_until_moving()
    stop(guided.control)
    bench.wait_until_standing(3)
    bench.run(0.5)
    count = len(frames)
    bench.run(0.5)
    if len(frames) > count:
        raise CheckFailed("positions are sent after a stop")
    guided.again()


# -- ends ------------------------------------------------------------------------------------------

Act: TypeAlias = Callable[[GuidedBench], None]


def _operate(*actions: str) -> Act:
    """Return what an operator does."""

    def act(guided: GuidedBench) -> None:
        for action in actions:
            guided.bench.controller.perform(action)
        guided.run(1.0)

    return act


def _stop(guided: GuidedBench) -> None:
    stop(guided.control)


def _stop_motion_port(guided: GuidedBench) -> None:
    reply = guided.bench.motion().stop(1)
    done(reply, "STOP on the motion port")


def _leave(guided: GuidedBench) -> None:
    guided.control.close()


def _vanish(guided: GuidedBench) -> None:
    guided.control.close(abort=True)


def _hold_back(guided: GuidedBench) -> None:
    """Send no heartbeat."""
    guided.bench.run(2 * guided.egm.timeout)


def _silence(guided: GuidedBench) -> None:
    guided.partner.silent = True
    guided.run(1.5)


def _freeze(guided: GuidedBench) -> None:
    if guided.bench.config.robotware < (7, 7):
        raise NotApplicable("RAPID receives no data of the partner before RobotWare 7.7")
    guided.partner.frozen = True
    guided.run(guided.egm.timeout + 0.5)


def _run_away(guided: GuidedBench) -> None:
    """Go on with the largest speed until the controller stops."""
    seconds = guided.egm.max_deviation / math.radians(guided.speed)
    guided.run(2 * seconds + 1)


@dataclass(frozen=True, slots=True)
class Ending:
    """An end of a session: what happens, what PROGRESS says, and what a new one needs."""

    name: str
    title: str
    act: Act
    state: RawTrajectoryState
    reasons: tuple[RawReason, ...]
    pp_to_main: bool = False
    """The program was stopped: Start alone must not serve sessions again."""


ENDINGS = (
    Ending("egm-stop", "STOP ends a session", _stop, STOPPED, (RawReason.STOPPED,)),
    Ending(
        "egm-stop-motion-port",
        "STOP on the motion port ends a session",
        _stop_motion_port,
        STOPPED,
        (RawReason.STOPPED,),
    ),
    Ending("egm-left", "a client that leaves", _leave, FAILED, (RawReason.CLIENT_LOST,)),
    Ending("egm-vanished", "a client that vanishes", _vanish, FAILED, (RawReason.CLIENT_LOST,)),
    Ending("egm-late", "a heartbeat that is late", _hold_back, FAILED, (RawReason.CLIENT_LOST,)),
    Ending("egm-silent", "a partner without answers", _silence, FAILED, (RawReason.CLIENT_LOST,)),
    Ending(
        "egm-frozen",
        "a partner whose heartbeat stands still",
        _freeze,
        FAILED,
        (RawReason.CLIENT_LOST,),
    ),
    Ending(
        "egm-e-stop",
        "an emergency stop ends a session",
        _operate("e-stop"),
        FAILED,
        (RawReason.EMERGENCY_STOP,),
        pp_to_main=True,
    ),
    Ending(
        "egm-motors-off",
        "motors off end a session",
        _operate("motors-off"),
        FAILED,
        (RawReason.MOTORS_OFF,),
        pp_to_main=True,
    ),
    Ending(
        "egm-program-stop",
        "a stop of the program ends a session",
        _operate("stop"),
        FAILED,
        (RawReason.PROGRAM_STOPPED,),
        pp_to_main=True,
    ),
    Ending(
        "egm-out-of-bounds",
        "the controller stops beyond max_deviation",
        _run_away,
        FAILED,
        (RawReason.PROGRAM_STOPPED, RawReason.MOTORS_OFF, RawReason.MOTION_ERROR),
        pp_to_main=True,
    ),
)


def _ends(ending: Ending, bench: Bench) -> None:
    guided = GuidedBench(bench)
    session, slowness = guided.start(), bench.setting.slowness
    ending.act(guided)
    guided.wait_until_standing(guided.egm.stop_ramp + 1.0 + 0.3 * slowness)
    guided.run(1.0)
    guided.ended(session, ending.state, ending.reasons)
    guided.partner.silent = guided.partner.frozen = False
    if ending.pp_to_main:
        bench.start_again()
        guided.run(2.0)
        reply = guided.request()
        if not isinstance(reply, messages.RawNotDone):
            raise CheckFailed(f"Start alone, without PP to main, serves a session: {reply}")
        bench.assert_at_rest(1, "no session was started")
        bench.controller.perform("pp-to-main")
        bench.start_again()
        guided.run(2.0)
    guided.again()


for _ending in ENDINGS:
    case(_ending.name, _ending.title)(partial(_ends, _ending))
