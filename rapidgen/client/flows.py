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

from rapidgen.client.core import STOP_FRAME, Core, Pending
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    RobotError,
    RobotTimeout,
    StopFailed,
    fault,
)
from rapidgen.client.group import Group
from rapidgen.client.run import Result, Run
from rapidgen.client.state import State
from rapidgen.client.trajectory import Trajectory
from rapidgen.protocol import messages
from rapidgen.protocol.bulk import FRAME_BYTES, encode_trajectory
from rapidgen.protocol.spec import (
    JOINT_TRAJ_PT,
    MAX_JOINTS,
    PROTOCOL_VERSION,
    Feature,
    Port,
    TriState,
)

T = TypeVar("T")
_PER_POINT = 0.02
"""s that a controller may take to read one point."""
_RETRY = 0.5
"""s between two attempts to connect again."""
_STILL_SAMPLES = 5
"""Joint messages without a movement after which a robot stands, whatever its status says."""
_INTERRUPTIONS = (KeyboardInterrupt, CancelledError)


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


Effect = Connect | Send | Wait
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
        yield Connect(Port.CONTROL, limits.connect)


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
    except _INTERRUPTIONS:
        yield from _stop_and_leave(core)
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
    plan = core.plan(trajectory)
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
        yield from _stop_and_leave(core)
        raise RobotTimeout(
            fault(
                "RG603",
                f"the controller did not answer within {patience:.1f} s whether it took the "
                "trajectory",
                "a STOP was sent; look at the robot",
            ),
            **core.evidence(),
        )


def result(core: Core, run: Run, timeout: float | None) -> Flow[Result]:
    """Wait for the end of a run. Without a time-out: four times the planned time and 30 s."""
    patience = 4 * run.plan.total + 30 if timeout is None else timeout
    try:
        yield Wait(lambda: run.is_over, patience)
        # Blind or cut off while the robot may be moving: stop it, as far as that can be.
        if isinstance(run.error, RobotTimeout | ConnectionLost):
            yield from _stop_and_leave(core)
    except _INTERRUPTIONS:
        yield from _stop_and_leave(core)
        raise
    if run.error is not None:
        raise run.error
    if run.result is None:
        raise RobotTimeout(
            fault(
                "RG603",
                f"the motion did not end within {patience:.1f} s; it goes on",
                "wait longer with result(timeout), or stop()",
            ),
            **core.evidence(),
        )
    return run.result


def _stop_and_leave(core: Core) -> Flow[None]:
    """Write a STOP if there is a connection for it; nobody waits for the answer."""
    port = core.stop_port
    if not core.talks[port].is_open:
        return
    core.request_stop(port)
    try:
        yield Send(port, STOP_FRAME, core.timeouts.stop, urgent=True)
    except RobotError as error:
        core.tracker.note(str(error))


def stop(core: Core) -> Flow[State | None]:
    """Stop at once, whatever else is under way; the state in which the robot stands.

    Connects to the motion port when there is no connection. None without a state connection
    (then nobody saw it stand). Raises StopFailed.
    """
    port = core.stop_port
    run = core.run
    try:
        if not core.talks[port].is_open:
            yield Connect(port, core.timeouts.connect)
        pending: Pending = core.request_stop(port)
        yield Send(port, STOP_FRAME, core.timeouts.stop, urgent=True)
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        raise _not_stopped(core, f"STOP could not be sent ({error})") from error
    talk = core.talks[port]
    yield Wait(lambda: pending.reply is not None or not talk.is_open, core.timeouts.stop)
    if pending.reply is None:
        raise _not_stopped(core, "the controller did not answer STOP")
    if not isinstance(pending.reply, messages.Acknowledged):
        raise _not_stopped(core, "the controller could not stop")
    if not core.state_open:
        return None
    state = yield from _until_standing(core)
    if run is not None and not run.is_over:
        run.stopped()
    return state


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
