"""STOP, and the end."""

import logging

from rapidgen.client.core.motion import CommandedMotion, Phase
from rapidgen.client.core.request_port import PendingReply
from rapidgen.client.core.robot import STOP_FRAME, Core
from rapidgen.client.core.state import State
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    RobotTimeout,
    StopFailed,
)
from rapidgen.client.flows.effects import Flow, HangUp, Open, Send, Wait
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.spec import Port, TriState

PER_POINT = 0.02
"""s that a controller may take to read one point."""
_STILL_SAMPLES = 5
"""Joint messages without a movement after which a robot stands, whatever its status says."""


def _send_stop(core: Core, port: Port) -> Flow[PendingReply]:
    if not core.ports[port].is_open:
        yield Open(port, core.timeouts.connect)
    pending = core.request_stop(port)
    core.state_port.note(f"STOP over the {port.name.lower()} port", logging.INFO)
    yield Send(port, STOP_FRAME, core.timeouts.stop, urgent=True)
    return pending


def stop(core: Core) -> Flow[State | None]:
    """Stop at once, whatever else is under way; the state in which the robot stands.

    STOP is written before anything is waited for. Without a connection the motion port alone is
    opened, nobody sees the robot stand, and None is returned. Raises StopFailed: use the
    emergency stop.
    """
    # Over the control port where there is one, which no point delays; and over the motion port
    # when what was sent there is not all answered: it may be read after the STOP. Where the
    # motion port cannot be reached, the control port of whoever is there is the last that is left.
    motion = core.motion
    ports = core.ports
    control = ports[Port.CONTROL]
    limit = core.timeouts.stop
    heard = None
    if control.is_open:
        try:
            heard = yield from _send_stop(core, Port.CONTROL)
        except (ConnectionLost, RobotTimeout) as error:
            core.state_port.note(f"STOP could not be sent over the control port ({error})")
    read = None
    if heard is None or ports[Port.MOTION].pending:
        try:
            read = yield from _stop_behind_points(core)
        except StopFailed:
            if heard is not None or control.is_open:
                raise
            heard = yield from _stop_as_a_stranger(core)
            if heard is None:
                raise
            control = ports[Port.CONTROL]
    if heard is not None:
        yield Wait(lambda: heard.reply is not None or not control.is_open, limit / 2)
        if heard.reply is None and read is None:
            core.state_port.note("the control port did not answer STOP")
            read = yield from _stop_behind_points(core)
    if read is not None:
        left = limit + PER_POINT * _unread(motion)
        yield Wait(lambda: read.reply is not None or not ports[Port.MOTION].is_open, left)
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
    if motion is not None and not motion.is_over:
        motion.stopped()
    return state


def close(core: Core) -> Flow[None]:
    """Close all connections. A motion under way is stopped first."""
    motion = core.motion
    try:
        if motion is not None and not motion.is_over and core.ports[Port.MOTION].is_open:
            yield from stop(core)
    finally:
        yield HangUp()


def _stop_behind_points(core: Core) -> Flow[PendingReply]:
    """STOP over the motion port: carried out after what was sent there."""
    try:
        return (yield from _send_stop(core, Port.MOTION))
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        raise _not_stopped(core, f"STOP could not be sent ({error})") from error


def _stop_as_a_stranger(core: Core) -> Flow[PendingReply | None]:
    """STOP over the control port, though nobody asked who is there: the last that is left."""
    try:
        return (yield from _send_stop(core, Port.CONTROL))
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        core.state_port.note(str(error))
        return None


def _unread(motion: CommandedMotion | None) -> int:
    """Points that the controller may have to read before a STOP behind them."""
    return motion.total if motion is not None and motion.phase is Phase.SENDING else 0


def _until_standing(core: Core) -> Flow[State]:
    state_port = core.state_port
    seen = state_port.samples

    def stands() -> bool:
        # Two joint messages: the status between them was made after the STOP was answered.
        if state_port.samples < seen + 2:
            return False
        # After an emergency stop a driver may call a motion under way that stands.
        still = state_port.samples >= seen + _STILL_SAMPLES and state_port.is_still(_STILL_SAMPLES)
        return state_port.status.in_motion is not TriState.TRUE or still

    came = yield Wait(lambda: stands() or not core.state_open, core.timeouts.stop)
    state = state_port.state
    # It may move again, for somebody else, before this goes on.
    if state is None or not came or not (core.state_open or stands()):
        raise _not_stopped(core, "STOP was answered, and the robot was not seen to stand")
    state_port.note("stands behind STOP", logging.INFO)
    return state


def _not_stopped(core: Core, text: str) -> StopFailed:
    return StopFailed.because(
        "RG632", text, "use the emergency stop if the robot moves", **core.evidence()
    )
