"""Flows of a motion program: check, send, wait for acceptance."""

from collections.abc import Mapping, Sequence

import numpy as np

from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import CommandedMotion, Result
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import Event
from rapidgen.client.errors import (
    InvalidProgram,
    MotionFailed,
    NotSupported,
    RobotError,
    RoutineFailed,
    fault,
)
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow, Send, Wait
from rapidgen.client.flows.motion import control_answers, ready, result, stream_accepted, until
from rapidgen.client.flows.stop import ended, stop
from rapidgen.client.pose import Pose
from rapidgen.client.program import SLOW, Argument, Left, Program, SpeedLike, Target
from rapidgen.config.model import UserRoutine
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message import encode, messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.spec import Comm, EventType, Port, Reason

LONGEST_JOG = {"revolute": 0.2, "prismatic": 0.1}
"""Limits of one jog, rad and m."""
DIRECTIONS = ("x", "y", "z")
"""Limit of the work object's values."""
_DEAD_MAN = 0.2
"""s of silence of the client after which a jogged robot is stopped."""
_LOOK = 0.01
"""s between two checks whether a routine has ended."""
_GRACE = 2.0
"""s after its time-out within which the controller leaves a routine."""
_EVENT_WAIT = 1.0
"""s within which an event of the controller arrives."""
_ANY = 1e6
"""s permitted to a routine without a time-out."""


def run(
    core: Core, program: Program, mode: TransferMode | None, *, leaving: bool = False
) -> Flow[CommandedMotion]:
    """Run a program by download or stream; None: download if it fits."""
    yield from ready(core)
    checked, chosen = core.check_program(program, mode, leaving=leaving)
    yield from control_answers(core)
    motion = core.begin_program(checked, chosen)
    yield from stream_accepted(core, motion)
    return motion


def move_to(
    core: Core, joints: Sequence[float], *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Move all axes to joints (rad, m) together, and wait for the end."""
    return (yield from _go(core, Program(speed=speed).move_joints(joints), timeout))


def move_linear(
    core: Core, pose: Pose, *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Move to a pose on a line, and wait for the end. Raises as `run`."""
    return (yield from _go(core, Program(speed=speed).move_linear(pose), timeout))


def jog(core: Core, /, *, speed: SpeedLike = SLOW, **by: float) -> Flow[Result]:
    """Move joints by name, or the tool along x, y, z, by a small step."""
    yield from ready(core)
    state, group = core.state_port.state, core.known_group
    assert state is not None
    _check_steps(group, by)
    if not (core.ports[Port.CONTROL].is_open or core.may_reach_control):
        raise NotSupported.because(
            "RG624", "jogging requires a control connection", "`ports.control`"
        )
    if by and not set(by) & set(group.names):
        place, turn = group.poses.pose(group.map.to_controller(state.joints))
        x, y, z = (at + by.get(name, 0.0) for at, name in zip(place, DIRECTIONS, strict=True))
        step = Program(speed=speed).move_linear(Pose((x, y, z), turn))
    else:
        pairs = zip(group.names, state.joints, strict=True)
        step = Program(speed=speed).move_joints([at + by.get(name, 0.0) for name, at in pairs])
    timeout_before, core.heartbeat.timeout = core.heartbeat.timeout, _DEAD_MAN
    try:
        motion = yield from run(core, step, None, leaving=True)
        return (yield from result(core, motion, None))
    finally:
        core.heartbeat.timeout = timeout_before


def _check_steps(group: Group, by: Mapping[str, float]) -> None:
    """Raise InvalidProgram (RG670) for a step that is empty or too large."""
    kinds = {name: "prismatic" for name in DIRECTIONS}
    kinds |= {joint.name: joint.kind for joint in group.joints}
    for name, step in by.items():
        if name not in kinds:
            raise InvalidProgram.because(
                "RG670",
                f"'{name}' is neither a joint nor a direction",
                suggest(name, list(kinds)) or f"there are {', '.join(kinds)}",
            )
        most, unit = LONGEST_JOG[kinds[name]], "rad" if kinds[name] == "revolute" else "m"
        if not isinstance(step, int | float | np.number) or not abs(step) <= most:
            raise InvalidProgram.because(
                "RG670",
                f"'{name}' cannot be jogged by {step!r}",
                f"a number, at most {most:g} {unit} at a time",
            )
    turned = [name for name in by if name in group.names]
    if turned and len(turned) < len(by):
        raise InvalidProgram.because(
            "RG670",
            f"joints and directions do not go together: {', '.join(by)}",
            "jog twice: once joints, once x, y, z",
        )


def _go(core: Core, program: Program, timeout: float | None) -> Flow[Result]:
    motion = yield from run(core, program, None)
    return (yield from result(core, motion, timeout))


def call(
    core: Core, routine: str, *arguments: Argument, timeout: float | None = None
) -> Flow[tuple[Left, ...]]:
    """Call a procedure of the controller's program and wait for its end."""
    limit = 0.0 if timeout is None else timeout
    motion = yield from run(core, Program().call(routine, *arguments, timeout=limit), None)
    try:
        return (yield from _called(core, motion, routine, timeout))
    except INTERRUPTIONS:
        if not motion.is_over:
            yield from stop(core)
        raise
    except RobotError as error:
        # Without an answer it is unknown whether the routine still runs.
        motion.failed(error)
        if motion.error is error:
            raise (yield from ended(core, motion)) from error.__cause__
        raise


def _called(
    core: Core, motion: CommandedMotion, routine: str, timeout: float | None
) -> Flow[tuple[Left, ...]]:
    """Wait for the end of a routine and read its results. Raises as `call`."""
    motion.longest = _ANY if timeout is None else timeout + _GRACE
    deadline = core.clock() + motion.longest
    result_reply = yield from _read_result(core)
    while result_reply.trajectory != motion.number and core.clock() < deadline:
        # PROGRESS arrives too rarely to wait for it.
        if (yield from until(core, motion, lambda: False, _LOOK)):
            break
        result_reply = yield from _read_result(core)
    if result_reply.trajectory == motion.number and result_reply.error == 0:
        motion.done()
    try:
        yield from result(core, motion, max(0.0, deadline - core.clock()))
    except MotionFailed as failed:
        if failed.reason is Reason.PROGRAM_STOPPED:
            yield from _why_it_stopped(core, routine, motion.events_before, failed)
        if failed.reason is not Reason.ROUTINE:
            raise
        result_reply = yield from _read_result(core)
        called = f" ({result_reply.text})" if result_reply.text else ""
        raise RoutineFailed(
            fault("RG675", f"routine '{routine}' has raised error {result_reply.error}{called}"),
            number=result_reply.error,
            name=result_reply.text,
            **core.evidence(),
        ) from failed
    if result_reply.trajectory != motion.number:
        # The motion ended first: the known result belongs to the call before.
        result_reply = yield from _read_result(core)
    (own,) = (r for r in core.known_group.routines if r.name == routine)
    return (yield from _results(core, own, result_reply))


def _why_it_stopped(core: Core, routine: str, before: int, failed: MotionFailed) -> Flow[None]:
    """Raise RoutineFailed if an error has stopped the robot's program.

    It holds the driver's event of the error, if there is one; `before` events had arrived at the
    start of the motion.
    """

    def report() -> Event | None:
        events = core.state_port.events
        return next((e for e in events if e.number > before and e.type is EventType.ERROR), None)

    yield Wait(lambda: report() is not None, _EVENT_WAIT)
    event = report()
    if event is not None:
        raise RoutineFailed(
            fault(
                "RG675",
                f"routine '{routine}' has stopped the program of the robot: "
                + ", ".join((str(event), *event.texts)),
                "correct the routine, then PP to Main and Start",
            ),
            number=0,
            event=event,
            **core.evidence(),
        ) from failed


def _results(
    core: Core, own: UserRoutine, result_reply: messages.ResultReply
) -> Flow[tuple[Left, ...]]:
    """Return the results of a routine by the types of its parameters.

    Each text and each target needs a request of its own.
    """
    left = [(n, p.type) for n, p in enumerate(own.parameters, 1) if p.inout]
    if own.returns:
        left.append((len(own.parameters) + 1, own.returns))
    result: list[Left] = []
    for number, kind in left:
        if kind.endswith("target"):
            place = sum(p.type == kind for p in own.parameters[:number])
            result.append((yield from _target(core, kind == "jointtarget", place)))
        elif kind == "string":
            result.append((yield from _read_result(core, number)).text)
        else:
            value = result_reply.values[number - 1]
            result.append(value == 1 if kind == "bool" else value)
    return tuple(result)


def _target(core: Core, joints: bool, number: int) -> Flow[Left]:
    """Return the `number`th jointtarget or robtarget that a routine set."""
    requested = messages.TargetRequest(int(joints), number)
    reply = yield from _ask(core, requested, messages.TARGET.number)
    if not isinstance(reply, messages.TargetReply):
        raise core.state_port.late(
            "the controller did not report the result of a routine in a target"
        )
    group = core.known_group
    urdf = group.from_wire(reply.joints)
    if joints:
        return urdf
    (x, y, z), (w, a, b, c) = reply.position, reply.orientation
    cf1, cf4, cf6, cfx = map(int, reply.configuration)
    outer = {
        joint.name: value
        for joint, value in zip(group.joints, urdf, strict=True)
        if joint.axis.startswith("eax")
    }
    return Target(Pose((x, y, z), (w, a, b, c)), (cf1, cf4, cf6, cfx), outer)


def _read_result(core: Core, parameter: int = 0) -> Flow[messages.ResultReply]:
    """Return the driver's result of the last call that has ended."""
    reply = yield from _ask(core, messages.ResultRequest(parameter), messages.RESULT.number)
    if not isinstance(reply, messages.ResultReply):
        raise core.state_port.late("the controller did not report the result of a routine")
    return reply


def _ask(core: Core, requested: Content, number: int) -> Flow[Content | None]:
    """Return the reply to a request on the motion port; None if it is late."""
    port = core.ports[Port.MOTION]
    pending = port.request(number)
    yield Send(Port.MOTION, encode(requested, Comm.REQUEST), core.timeouts.send)
    yield Wait(lambda: pending.reply is not None or not port.is_open, core.timeouts.reply)
    return pending.reply
