"""What the client does step by step, as generators: written once, run by both clients.

A flow yields what it needs (a connection, bytes sent, a wait) and is resumed with the outcome:
`Wait` gives whether the condition came true in time; a failed `Connect` or `Send` is thrown in
as RobotError. When the caller is interrupted (Ctrl-C, cancellation) the interruption is thrown
in; `execute` and `result` answer it with a STOP before they let it pass.
"""

from asyncio import CancelledError
from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any, TypeVar

from rapidgen.client.core import STOP_FRAME, Core
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    NotSupported,
    RobotError,
    RobotTimeout,
    StopFailed,
    fault,
)
from rapidgen.client.group import Group
from rapidgen.client.motion import Motion, Phase, Result
from rapidgen.client.run import Run
from rapidgen.client.state import Event, Feedback, State
from rapidgen.client.talk import Pending
from rapidgen.client.trajectory import Trajectory
from rapidgen.protocol import messages
from rapidgen.protocol.bulk import FRAME_BYTES, encode_trajectory
from rapidgen.protocol.spec import (
    HELLO,
    JOINT_TRAJ_PT,
    MAX_JOINTS,
    PROTOCOL_VERSION,
    Feature,
    Port,
    TrajectoryState,
    TriState,
)

T = TypeVar("T")
_PER_POINT = 0.02
"""s that a controller may take to read one point."""
_RETRY = 0.5
"""s between two attempts to connect again."""
_STILL_SAMPLES = 5
"""Joint messages without a movement after which a robot stands, whatever its status says."""
INTERRUPTIONS = (KeyboardInterrupt, CancelledError)


@dataclass(frozen=True, slots=True)
class Connect:
    """Open a connection."""

    port: Port
    timeout: float


@dataclass(frozen=True, slots=True)
class Send:
    """Send bytes: `urgent` ones at the next frame boundary, ahead of whatever is being sent.

    Points of a `run` are cut short, by MotionStopped, once somebody asked it to stop.
    """

    port: Port
    data: bytes
    timeout: float
    urgent: bool = False
    run: Run | None = None

    @property
    def is_stopped(self) -> bool:
        """Whether these points must not be sent any more."""
        return self.run is not None and self.run.stopping


@dataclass(frozen=True, slots=True)
class Wait:
    """Wait until the condition holds; it is looked at after each message."""

    until: Callable[[], bool]
    timeout: float


@dataclass(frozen=True, slots=True)
class Close:
    """Close a connection that is of no use."""

    port: Port


Effect = Connect | Send | Wait | Close
Flow = Generator[Effect, Any, T]


def connect(core: Core) -> Flow[None]:
    """Open the connections and find out who is there."""
    core.fault = None
    limits = core.timeouts
    yield Connect(Port.STATE, limits.connect)
    asked = core.clock()
    if not core.plain:
        yield Send(Port.STATE, core.hello(), limits.send)
    tracker = core.tracker
    came = yield Wait(lambda: tracker.is_complete or not core.state_open, limits.state)
    if not core.state_open:
        raise core.disconnected()
    if not came:
        raise RobotTimeout(
            fault(
                "RG603",
                f"connected, but no joints and status came within {limits.state:g} s",
                "is the state server's task running?",
            ),
            **core.evidence(),
        )
    if not core.plain:
        left = max(0.0, asked + limits.hello - core.clock())
        yield Wait(lambda: tracker.hello is not None or not core.state_open, left)
    _meet(core, tracker.hello)
    if core.watch:
        return
    yield Connect(Port.MOTION, limits.connect)
    if Feature.CONTROL in tracker.driver.features:
        yield from _meet_control(core)


def _meet_control(core: Core) -> Flow[None]:
    """Open the control connection, if it is one of this very driver; else do without."""
    trouble = "another driver answers on the control port"
    try:
        yield Connect(Port.CONTROL, core.timeouts.connect)
        talk = core.talks[Port.CONTROL]
        pending = talk.request(HELLO.number)
        yield Send(Port.CONTROL, core.hello(subscribe=False), core.timeouts.send)
        yield Wait(lambda: pending.reply is not None or not talk.is_open, core.timeouts.hello)
        known, told = core.tracker.hello, pending.reply
        assert isinstance(known, messages.HelloReply)
        if isinstance(told, messages.HelloReply) and told.same_driver(known):
            return
        if told is None:
            trouble = "nobody answers on the control port"
        if talk.is_open:
            yield Close(Port.CONTROL)
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        trouble = str(error)
    core.without_control(trouble)


def _meet(core: Core, hello: messages.HelloReply | messages.HelloRefusal | None) -> None:
    """Versions and joint maps must fit; without a configuration the driver's word counts."""
    if hello is not None and hello.protocol != PROTOCOL_VERSION:
        raise IncompatibleDriver(
            fault(
                "RG605",
                f"the driver speaks protocol version {hello.protocol}, this client "
                f"{PROTOCOL_VERSION}",
                "build and deploy the driver again with this rapidgen",
            ),
            **core.evidence(),
        )
    if isinstance(hello, messages.HelloReply):
        if core.configured is not None:
            core.configured.require(hello)
            core.use(core.configured.narrowed(hello))
        elif not 1 <= hello.joint_count <= MAX_JOINTS:
            raise IncompatibleDriver(
                fault("RG605", f"the driver tells {hello.joint_count} joints"), **core.evidence()
            )
        else:
            core.use(Group.told(hello))
    elif core.group is None:
        core.use(Group.unknown([f"joint_{i + 1}" for i in range(6)]))


def alive(core: Core, *, to_move: bool = False) -> Flow[None]:
    """Connect again if a connection was lost and reconnecting was told; nothing is re-sent."""
    if core.state_open and (core.talks[Port.MOTION].is_open or not to_move):
        return
    if core.fault is None or core.reconnect <= 0:
        raise core.disconnected()
    deadline = core.clock() + core.reconnect
    while True:
        try:
            yield from connect(core)
            return
        except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
            if core.clock() + _RETRY >= deadline:
                raise
            core.tracker.note(str(error))
        yield Wait(lambda: False, _RETRY)


def execute(core: Core, trajectory: Trajectory) -> Flow[Run]:
    """Check, send, and wait until the controller took it; only then it moves."""
    yield from ready(core)
    run, data = prepare(core, trajectory)
    try:
        yield from send_points(core, run, data)
        yield from finish(core, run, data)
    except INTERRUPTIONS:
        yield from stop_and_leave(core)
        raise
    except RobotError as error:
        run.failed(error)
        raise
    return run


def ready(core: Core) -> Flow[None]:
    """Connected, and no reason why the robot could not move, or none that passes soon."""
    yield from alive(core, to_move=True)
    yield Wait(lambda: not core.hindrances() or not core.state_open, core.timeouts.ready)


def prepare(core: Core, trajectory: Trajectory) -> tuple[Run, bytes]:
    """Everything before the first byte. Raises InvalidTrajectory, NotReady, ConnectionLost."""
    if not core.talks[Port.MOTION].is_open:
        raise core.disconnected()
    core.ready()
    plan = core.plan(trajectory, "download")
    data = encode_trajectory(plan.wire, plan.durations)
    return core.begin(plan), data


def send_points(core: Core, run: Run, data: bytes) -> Flow[None]:
    """Send all but the end frame: nothing moves yet."""
    yield Send(Port.MOTION, data[:-FRAME_BYTES], core.timeouts.send, run=run)


def finish(core: Core, run: Run, data: bytes) -> Flow[None]:
    """Send the end frame and wait for the controller's word."""
    pending = yield from send_end(core, run, data)
    yield from accepted(core, run, pending)


def send_end(core: Core, run: Run, data: bytes) -> Flow[Pending]:
    """Send the end frame: the controller may begin to move."""
    pending = core.talks[Port.MOTION].request(JOINT_TRAJ_PT.number)
    yield Send(Port.MOTION, data[-FRAME_BYTES:], core.timeouts.send, run=run)
    return pending


def accepted(core: Core, run: Run, pending: Pending) -> Flow[None]:
    """Wait for the controller's word on the whole trajectory."""
    patience = core.timeouts.reply + _PER_POINT * len(run.plan.wire)
    yield Wait(lambda: pending.reply is not None or run.is_over, patience)
    if pending.reply is not None:
        core.answered(run, pending.reply)
    if run.error is not None:
        raise run.error
    if pending.reply is None:
        raise RobotTimeout(
            fault(
                "RG603",
                f"the controller did not answer within {patience:.1f} s whether it took the "
                "trajectory",
                "a STOP was sent; look at the robot",
            ),
            **core.evidence(),
        )


def result(core: Core, run: Motion, timeout: float | None) -> Flow[Result]:
    """Wait for the end of a motion; without a time-out for as long as it gets on."""
    try:
        yield from patiently(core, run, lambda: run.is_over, timeout)
    except INTERRUPTIONS:
        yield from stop_and_leave(core)
        raise
    if run.error is not None:
        raise run.error
    if run.result is None:
        waited = patience(core, run) if timeout is None else timeout
        raise RobotTimeout(
            fault(
                "RG603",
                f"the motion did not end within {waited:.1f} s; it goes on",
                "wait longer with result(timeout), or stop()",
            ),
            **core.evidence(),
        )
    return run.result


def patience(core: Core, run: Motion) -> float:
    """Seconds without a sign of getting on after which nobody waits any longer."""
    return 4 * run.longest / core.override + 30


def patiently(
    core: Core, run: Motion, condition: Callable[[], bool], timeout: float | None = None
) -> Flow[None]:
    """Wait until the condition holds, or `timeout` s; without, for as long as the motion gets on
    or is paused."""
    if timeout is not None:
        yield Wait(condition, timeout)
        return
    while True:
        mark = run.mark

        def stirs(mark: tuple[object, ...] = mark) -> bool:
            return condition() or run.mark != mark

        yield Wait(stirs, patience(core, run))
        if condition():
            return
        if run.mark == mark and run.progress.state is not TrajectoryState.PAUSED:
            return


def stop_and_leave(core: Core) -> Flow[None]:
    """Write a STOP on every connection for it; nobody waits for the answer."""
    for port, talk in core.talks.items():
        if not talk.is_open:
            continue
        try:
            yield from _send_stop(core, port)
        except RobotError as error:
            core.tracker.note(str(error))


def _send_stop(core: Core, port: Port) -> Flow[Pending]:
    if not core.talks[port].is_open:
        yield Connect(port, core.timeouts.connect)
    pending = core.request_stop(port)
    yield Send(port, STOP_FRAME, core.timeouts.stop, urgent=True)
    return pending


def stop(core: Core) -> Flow[State | None]:
    """Stop at once, whatever else is under way; the state in which the robot stands.

    Over the control port where there is one, which no point delays; and over the motion port
    when what was sent there is not all answered: it may be read after the STOP. Connects to the
    motion port when there is no connection. None without a state connection (then nobody saw it
    stand). Raises StopFailed.
    """
    run = core.run
    talks = core.talks
    control = talks[Port.CONTROL]
    limit = core.timeouts.stop
    heard = None
    if control.is_open:
        try:
            heard = yield from _send_stop(core, Port.CONTROL)
        except (ConnectionLost, RobotTimeout) as error:
            core.tracker.note(f"STOP could not be sent over the control port ({error})")
    read = None
    if heard is None or talks[Port.MOTION].pending:
        read = yield from _stop_behind_points(core)
    if heard is not None:
        yield Wait(lambda: heard.reply is not None or not control.is_open, limit / 2)
        if heard.reply is None and read is None:
            core.tracker.note("the control port did not answer STOP")
            read = yield from _stop_behind_points(core)
    if read is not None:
        left = limit + _PER_POINT * _unread(run)
        yield Wait(lambda: read.reply is not None or not talks[Port.MOTION].is_open, left)
    asked = [pending for pending in (heard, read) if pending is not None]
    if any(isinstance(pending.reply, messages.Failure) for pending in asked):
        raise _not_stopped(core, "the controller could not stop")
    last = asked[-1]
    if last.reply is None:
        raise _not_stopped(core, "the controller did not answer STOP")
    if not isinstance(last.reply, messages.Acknowledged):
        raise _not_stopped(core, "the controller could not stop")
    if not core.state_open:
        return None
    state = yield from _until_standing(core)
    if run is not None and not run.is_over:
        run.stopped()
    return state


def _stop_behind_points(core: Core) -> Flow[Pending]:
    """STOP over the motion port: carried out after what was sent there."""
    try:
        return (yield from _send_stop(core, Port.MOTION))
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        raise _not_stopped(core, f"STOP could not be sent ({error})") from error


def _unread(run: Motion | None) -> int:
    """Points that the controller may have to read before a STOP behind them."""
    return run.total if run is not None and run.phase is Phase.SENDING else 0


def _until_standing(core: Core) -> Flow[State]:
    tracker = core.tracker
    seen = tracker.samples

    def stands() -> bool:
        # Two joint messages: the status between them was made after the STOP was answered.
        if tracker.samples < seen + 2:
            return False
        # After an emergency stop a driver may call a motion under way that stands.
        still = tracker.samples >= seen + _STILL_SAMPLES and tracker.is_still(_STILL_SAMPLES)
        return tracker.status.in_motion is not TriState.TRUE or still

    yield Wait(lambda: stands() or not core.state_open, core.timeouts.stop)
    state = tracker.state
    if not stands() or state is None:
        raise _not_stopped(core, "STOP was answered, and the robot was not seen to stand")
    return state


def _not_stopped(core: Core, text: str) -> StopFailed:
    return StopFailed(
        fault("RG632", text, "use the emergency stop if the robot moves"), **core.evidence()
    )


def wait_until(
    core: Core, condition: Callable[[State], bool], timeout: float, what: str
) -> Flow[State]:
    """The first state, from now on, for which the condition holds."""
    yield from alive(core)
    tracker = core.tracker
    found: list[State] = []

    def holds() -> bool:
        state = tracker.state
        if state is not None and tracker.is_complete and condition(state):
            found.append(state)
        return bool(found) or not core.state_open

    yield Wait(holds, timeout)
    if found:
        return found[0]
    if not core.state_open:
        raise core.disconnected()
    raise RobotTimeout(
        fault("RG603", f"{what} did not come within {timeout:g} s"), **core.evidence()
    )


def next_state(core: Core, timeout: float | None) -> Flow[State]:
    """The state of the next joint message."""
    yield from alive(core)
    seen = core.tracker.samples
    patience = core.timeouts.state if timeout is None else timeout
    return (
        yield from wait_until(core, lambda state: state.number > seen, patience, "the next state")
    )


def next_event(core: Core, timeout: float | None, after: Event | None) -> Flow[Event]:
    """The next entry of the controller's log, or the one behind `after`; without a time-out as
    long as there is a link."""
    yield from alive(core)
    tracker = core.tracker
    seen = tracker.event_count if after is None else after.number
    patience = float("inf") if timeout is None else timeout
    yield Wait(lambda: tracker.event_count > seen or not core.state_open, patience)
    found = [event for event in tracker.events if event.number > seen]
    if found:
        return found[0]
    if not core.state_open:
        raise core.disconnected()
    raise RobotTimeout(fault("RG603", f"no event came within {timeout:g} s"), **core.evidence())


def next_feedback(core: Core, timeout: float | None) -> Flow[Feedback]:
    """The next joints with the controller's time."""
    yield from alive(core)
    tracker = core.tracker
    if Feature.FEEDBACK not in tracker.driver.features & core.subscribe:
        raise NotSupported(
            fault(
                "RG624",
                "the driver sends no feedback with the controller's time",
                "Robot(..., feedback=True) asks for it, where the driver has it",
            )
        )
    seen = tracker.feedbacks
    limit = core.timeouts.state if timeout is None else timeout
    yield Wait(lambda: tracker.feedbacks > seen or not core.state_open, limit)
    feedback = tracker.feedback
    if feedback is not None and tracker.feedbacks > seen:
        return feedback
    if not core.state_open:
        raise core.disconnected()
    raise RobotTimeout(fault("RG603", f"no feedback came within {limit:g} s"), **core.evidence())
