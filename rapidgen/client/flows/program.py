"""A motion program: checked, sent, taken."""

from collections.abc import Sequence

from rapidgen.axes.frames import Pose
from rapidgen.client.core.checks import Way
from rapidgen.client.core.job import Job
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import (
    InvalidProgram,
    MotionFailed,
    NotSupported,
    RobotTimeout,
    RoutineFailed,
    fault,
)
from rapidgen.client.flows.effects import Flow, Send, Wait
from rapidgen.client.flows.job import result, taken
from rapidgen.client.flows.motion import ready, until
from rapidgen.client.flows.stop import stop
from rapidgen.client.program import SLOW, Program, SpeedLike
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message import encode, messages
from rapidgen.wire.simple_message.spec import Comm, Port, Reason

LONGEST_JOG = {"revolute": 0.2, "prismatic": 0.1}
"""rad and m of one jog."""
_DEAD_MAN = 0.2
"""s without a word of the client after which a jogged robot is stopped."""
_LOOK = 0.01
"""s between two looks whether a routine has ended."""
_ANY = 1e6
"""s that a routine without a time-out may take."""


def run(core: Core, program: Program, way: Way | None) -> Flow[Job]:
    """A program whole or by stream; None: whole, where the driver's ring holds it."""
    yield from ready(core)
    core.ready()
    checked, chosen = core.check_program(program, way)
    job = Job(core)
    job.program = program
    job.way, job.is_ended = chosen, True
    job.motion = job.stream = motion = core.begin_program(checked, chosen)
    yield from taken(core, motion)
    return job


def move_to(
    core: Core, joints: Sequence[float], *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Go to joints (rad, m), all axes together, and wait for the end. Raises as `run`."""
    return (yield from _go(core, Program(speed=speed).move_joints(joints), timeout))


def move_linear(
    core: Core, pose: Pose, *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Go to a pose on a line, and wait for the end. Raises as `run`."""
    return (yield from _go(core, Program(speed=speed).move_linear(pose), timeout))


def jog(core: Core, /, *, speed: SpeedLike = SLOW, **by: float) -> Flow[Result]:
    """Move joints, by name, a little (at most 0.2 rad or 0.1 m), and wait for the end.

    While it moves the controller stops the robot when it does not hear of this client for 0.2 s.
    Raises NotSupported without a control connection, otherwise as `run`.
    """
    yield from ready(core)
    if not core.ports[Port.CONTROL].is_open:
        raise NotSupported.because(
            "RG624", "nobody jogs without a control connection", "`ports.control`"
        )
    state, group = core.state_port.state, core.known_group
    assert state is not None
    target = dict(zip(group.names, state.joints, strict=True))
    for name, step in by.items():
        most = LONGEST_JOG.get(
            group.joints[group.names.index(name)].kind if name in target else "", 0.0
        )
        if not abs(step) <= most:
            raise InvalidProgram.because(
                "RG670",
                f"'{name}' cannot be jogged by {step}",
                suggest(name, group.names) or "by at most 0.2 rad or 0.1 m, by the joint's name",
            )
        target[name] += step
    patience, core.heartbeat.timeout = core.heartbeat.timeout, _DEAD_MAN
    try:
        return (yield from move_to(core, list(target.values()), speed=speed))
    finally:
        core.heartbeat.timeout = patience


def _go(core: Core, program: Program, timeout: float | None) -> Flow[Result]:
    job = yield from run(core, program, None)
    return (yield from result(job, timeout))


def call(
    core: Core, routine: str, *arguments: float | bool | str, timeout: float | None = None
) -> Flow[tuple[float | bool, ...]]:
    """Call a procedure of the controller's program and wait for its end: what it left in its
    parameters that are `inout`, in their order.

    Without a time-out it may take as long as it likes; when it does not end in time it is left by a
    STOP, and its state is unknown. Raises RoutineFailed with the number of the error that it has
    raised, otherwise as `run`.
    """
    job = yield from run(core, Program().call(routine, *arguments), None)
    motion = job.motion
    assert motion is not None
    motion.longest = _ANY if timeout is None else timeout
    deadline = core.clock() + motion.longest
    told = yield from _told(core)
    while told.trajectory != motion.number and core.clock() < deadline:
        # PROGRESS comes too seldom to wait for it.
        if (yield from until(core, motion, lambda: False, _LOOK)):
            break
        told = yield from _told(core)
    if told.trajectory == motion.number and told.error == 0:
        motion.done()
    try:
        yield from result(job, max(0.0, deadline - core.clock()))
    except MotionFailed as failed:
        if failed.reason is not Reason.ROUTINE:
            raise
        told = yield from _told(core)
        raise RoutineFailed(
            fault("RG675", f"routine '{routine}' has raised error {told.error}"),
            number=told.error,
            **core.evidence(),
        ) from failed
    except RobotTimeout:
        yield from stop(core)
        raise
    (own,) = (r for r in core.known_group.routines if r.name == routine)
    values = zip(own.parameters, told.values, strict=False)
    return tuple(v == 1 if p.type == "bool" else v for p, v in values if p.inout)


def _told(core: Core) -> Flow[messages.ResultReply]:
    """What the driver says of the newest call that has ended."""
    port = core.ports[Port.MOTION]
    pending = port.request(messages.RESULT.number)
    asked = encode(messages.ResultRequest(0), Comm.REQUEST)
    yield Send(Port.MOTION, asked, core.timeouts.send)
    yield Wait(lambda: pending.reply is not None or not port.is_open, core.timeouts.reply)
    if not isinstance(pending.reply, messages.ResultReply):
        raise core.state_port.late("the controller did not tell what has come of a routine")
    return pending.reply
