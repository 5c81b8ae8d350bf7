"""Flows that stop the robot and close connections.

The rules:

1. STOP is written to every open connection before anything is awaited. A missing connection is
   opened for it only if no other one proves the stop.
2. The control port answers STOP without delay. The driver reads STOP on the motion port after the
   data sent there, so its answer is also required while data there is unanswered: the driver might
   read that data after the STOP of the control port.
3. The wait for the motion port is longer by `PER_POINT` for each unread point.
4. An answer proves that the driver stops, not that the robot is at rest: two later joint messages
   with in_motion 0, or several without movement, do (`_until_standing`).
5. After an error of a motion (`ended`) the flow stops the robot and adds the result to the error.
   It stops nothing if another client's motion has replaced the failed one.
6. Everything that cannot be proved is said in the error, with the emergency stop as help.
"""

import logging
from collections.abc import Sequence

from rapidgen.client.core.motion import CommandedMotion, Phase
from rapidgen.client.core.request_port import PendingReply
from rapidgen.client.core.robot import STOP_FRAME, Core
from rapidgen.client.core.state import State
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    RobotError,
    RobotTimeout,
    StopFailed,
)
from rapidgen.client.flows.effects import Close, CloseAll, Flow, Open, SendAtOnce, Wait
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.spec import Port, TriState

PER_POINT = 0.02
"""s that a controller may need to read one point."""
_SUPERSEDED = 0.5
"""s within which PROGRESS reports a motion that has replaced this one."""
_STILL_SAMPLES = 5
"""Joint messages without movement that mean rest, whatever STATUS says."""


def _send_stop(core: Core, ports: Sequence[Port]) -> Flow[dict[Port, PendingReply]]:
    """Send STOP on all open connections before waiting for any reply.

    Returns the connections that accepted it, with the reply to come.
    """
    pending = {port: core.request_stop(port) for port in ports}
    for port in ports:
        core.state_port.note(f"STOP over the {port.name.lower()} port", logging.INFO)
    order = SendAtOnce(tuple(ports), STOP_FRAME, core.timeouts.stop)
    yield order
    for port, error in order.failures.items():
        core.state_port.note(f"STOP could not be sent over the {port.name.lower()} port ({error})")
    return {port: reply for port, reply in pending.items() if port not in order.failures}


def _connect_and_send(core: Core, port: Port) -> Flow[dict[Port, PendingReply]]:
    """Send STOP on a new connection. Raises StopFailed."""
    try:
        yield Open(port, min(core.timeouts.connect, core.timeouts.stop))
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        raise _not_stopped(core, f"STOP could not be sent ({error})") from error
    sent = yield from _send_stop(core, [port])
    if not sent:
        raise _not_stopped(core, f"STOP could not be sent over the {port.name.lower()} port")
    return sent


def stop(core: Core) -> Flow[State | None]:
    """Stop at once, whatever else is active; return the state at rest."""
    motion = core.motion
    yield from _confirmed(core)
    if not core.state_open:
        return None
    state = yield from _until_standing(core)
    if motion is not None:
        if not motion.is_over:
            motion.stopped()
        motion.is_settled = True
    return state


def _confirmed(core: Core) -> Flow[None]:
    """Send STOP and wait for an answer. Raises StopFailed."""
    # No point delays STOP on the control port; on the motion port the driver reads it after the
    # data sent there. If something there is unanswered, only that answer proves the end: the driver
    # may read the data after the STOP of the control port.
    motion, ports, limit = core.motion, core.ports, core.timeouts.stop
    after = bool(ports[Port.MOTION].pending) or (motion is not None and motion.needs_stop)
    # The faster port first, in the same step.
    first = (Port.CONTROL, Port.MOTION)
    requested = yield from _send_stop(core, [port for port in first if ports[port].is_open])
    if Port.MOTION not in requested and (after or not requested):
        try:
            requested |= yield from _connect_and_send(core, Port.MOTION)
        except StopFailed as failed:
            if requested or ports[Port.CONTROL].is_open:
                raise
            # The control port is the last resort, even if HELLO has not announced it.
            try:
                requested |= yield from _connect_and_send(core, Port.CONTROL)
            except StopFailed as error:
                core.state_port.note(str(error))
                raise failed from None
    elif Port.CONTROL not in requested and core.may_reach_control:
        try:
            requested |= yield from _connect_and_send(core, Port.CONTROL)
        except StopFailed as error:
            core.state_port.note(str(error))
    received, read = requested.get(Port.CONTROL), requested.get(Port.MOTION)
    if received is not None:
        control = ports[Port.CONTROL]
        yield Wait(lambda: received.reply is not None or not control.is_open, limit / 2)
        if received.reply is None:
            core.state_port.note("the control port did not answer STOP")
            if read is None:
                read = (yield from _connect_and_send(core, Port.MOTION))[Port.MOTION]
    needed = read is not None and (after or received is None or received.reply is None)
    if read is not None and needed:
        left, requests = limit + PER_POINT * _unread(motion), ports[Port.MOTION]
        yield Wait(lambda: read.reply is not None or not requests.is_open, left)
    report = [one.reply for one in (received, read) if one is not None and one.reply is not None]
    last = read if needed else received
    assert last is not None
    if any(not isinstance(reply, messages.Acknowledged) for reply in report):
        raise _not_stopped(core, "the controller could not stop")
    if last.reply is None:
        raise _not_stopped(core, "the controller did not answer STOP")


def ended(core: Core, motion: CommandedMotion) -> Flow[RobotError]:
    """Return the error of an ended motion once the robot is at rest.

    It includes unknowns: unanswered data may still be executed, also after this error.
    """
    error = motion.error
    assert error is not None
    if not motion.needs_stop:
        return error
    motion.is_settled = True
    if motion.is_accepted and core.state_open and not any(t.is_open for t in core.ports.values()):
        # A new connection and STOP would stop the motion of the client that has replaced this one;
        # without one the driver itself stops for the connections that it has lost.
        yield Wait(lambda: motion.is_superseded or not core.state_open, _SUPERSEDED)
        if motion.is_superseded:
            error.amend("another motion has replaced it", "the robot moves for another client")
            return error
    reopened = False
    unknown = ""
    state = None
    try:
        yield from _confirmed(core)
    except StopFailed as failed:
        unknown = failed.diagnostics[0].message
    hello, driver = core.state_port.hello, core.state_port.driver
    if not core.state_open:
        reopened = yield from _reopen_state(core)
    if core.state_open:
        try:
            state = yield from _until_standing(core)
        except StopFailed as failed:
            unknown = unknown or failed.diagnostics[0].message
    if reopened:
        yield Close(Port.STATE)
        core.fault = error
        core.state_port.hello, core.state_port.driver = hello, driver
    if state is not None and not unknown:
        if motion.stopped_joints is None:
            motion.stopped_joints = state.joints
        error.amend("a STOP was sent, and the robot is at rest", "look at the robot, then continue")
        return error
    unknown = unknown or "STOP was answered, and the state port stopped sending data"
    error.amend(
        f"it is not known whether the robot is at rest ({unknown})",
        "look at the robot; use the emergency stop if it moves",
    )
    return error


def _reopen_state(core: Core) -> Flow[bool]:
    """Reopen the state port to observe the stop; True if it is open."""
    try:
        yield Open(Port.STATE, min(core.timeouts.connect, core.timeouts.stop))
    except (ConnectionFailed, RobotTimeout) as error:
        core.state_port.note(str(error))
        return False
    return True


def close(core: Core) -> Flow[None]:
    """Close all connections. An active motion is stopped first."""
    motion = core.motion
    try:
        if motion is not None and motion.needs_stop:
            yield from ended(core, motion)
        elif motion is not None and not motion.is_over and core.ports[Port.MOTION].is_open:
            yield from stop(core)
    finally:
        yield CloseAll()


def drop(core: Core) -> Flow[None]:
    """Close all connections without a STOP, as a lost cable does."""
    motion = core.motion
    if motion is not None and not motion.is_over:
        motion.failed(
            ConnectionLost.because("RG602", "this client dropped its connections on purpose")
        )
        motion.is_settled = True
    yield CloseAll()


def _unread(motion: CommandedMotion | None) -> int:
    """Return the points that the controller may read before a later STOP."""
    return motion.total if motion is not None and motion.phase is Phase.SENDING else 0


def _until_standing(core: Core) -> Flow[State]:
    state_port = core.state_port
    seen = state_port.samples

    def is_at_rest() -> bool:
        # Two joint messages: the status between them was made after the STOP was answered.
        if state_port.samples < seen + 2:
            return False
        # After an emergency stop a driver may report a stopped motion as active.
        still = state_port.samples >= seen + _STILL_SAMPLES and state_port.is_still(_STILL_SAMPLES)
        return state_port.status.in_motion is not TriState.TRUE or still

    came = yield Wait(lambda: is_at_rest() or not core.state_open, core.timeouts.stop)
    state = state_port.state
    # Another client may move the robot again before this flow resumes.
    if state is None or not came or not (core.state_open or is_at_rest()):
        raise _not_stopped(core, "STOP was answered, and the robot was not observed at rest")
    state_port.note("is at rest after STOP", logging.INFO)
    return state


def _not_stopped(core: Core, text: str) -> StopFailed:
    return StopFailed.because(
        "RG632", text, "use the emergency stop if the robot moves", **core.evidence()
    )
