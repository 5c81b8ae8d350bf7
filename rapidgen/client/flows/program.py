"""A motion program: checked, sent, taken."""

from collections.abc import Sequence

from rapidgen.axes.frames import Pose
from rapidgen.client.core.checks import Way
from rapidgen.client.core.job import Job
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import MotionFailed, RobotTimeout, RoutineFailed, fault
from rapidgen.client.flows.effects import Flow, Send, Wait
from rapidgen.client.flows.job import result, taken
from rapidgen.client.flows.motion import ready, until
from rapidgen.client.flows.stop import stop
from rapidgen.client.program import SLOW, Program, SpeedLike
from rapidgen.wire.simple_message import encode, messages
from rapidgen.wire.simple_message.spec import Comm, Port, Reason

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
            fault("RG655", f"routine '{routine}' has raised error {told.error}"),
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
