"""Flows of externally guided motion: a session is requested and ended on the control port.

The partner (`rapidgen.client.egm`) listens before the request. From the request to the end this
client sends heartbeats, on the control port and, where RAPID receives data, in the datagrams as
well. Without them the driver stops the robot, so a lost client, a lost control connection and a
lost network all end in a stop.
"""

from collections.abc import Callable, Sequence
from functools import partial

from rapidgen.client.core.motion import reason_text
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import NotSupported, RequestRefused, RobotError
from rapidgen.client.flows.control import ask
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow, Wait
from rapidgen.client.flows.motion import control_answers, ready
from rapidgen.client.flows.stop import stop
from rapidgen.config.model import EgmSettings
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.spec import Feature, Reason, TrajectoryState

DATA_SINCE = (7, 7)
"""RobotWare from which RAPID receives data of the partner [manual 3HAC073318, revisions]."""
_MARGIN = 0.8
"""Of the driver's time limit: the time-out of heartbeats must not exceed it after rounding."""
_ENDS = 5.0
"""s for the robot to stand after the end of a session; a real one needs about one."""
_UNDER_WAY = (TrajectoryState.RECEIVING, TrajectoryState.MOVING)
Beat = Callable[[Sequence[float]], None]


def settings(core: Core) -> EgmSettings:
    """Return the settings of the configuration. Raises NotSupported without them."""
    egm = core.known_group.egm
    if egm is None:
        raise NotSupported.because(
            "RG624",
            "the configuration has no `egm:`",
            "add it, build and deploy; create the robot with this configuration",
        )
    return egm


def start(core: Core, beat: Beat | None) -> Flow[int]:
    """Start a session; return its number.

    `beat` sends numbers to RAPID with the datagrams. Raises NotSupported, NotReady, RequestRefused,
    RobotTimeout, ConnectionLost.
    """
    egm = settings(core)
    yield from ready(core)
    hello = core.state_port.driver.hello
    if hello is None or Feature.EGM not in Feature(hello.features):
        raise NotSupported.because(
            "RG624",
            "the driver does not start sessions of externally guided motion",
            "build and deploy a driver with `egm:` in its configuration",
        )
    yield from control_answers(core)
    core.begin_guidance(egm.timeout * _MARGIN, beat)
    try:
        # The driver rejects a session without a heartbeat before it.
        yield Wait(lambda: core.heartbeat.is_armed, core.timeouts.reply)
        reply = yield from ask(core, messages.EgmRequest(1), "start a session")
        if not isinstance(reply, messages.EgmReply):
            raise core.state_port.late(f"a session was answered with {reply}")
    except INTERRUPTIONS:
        core.end_guidance()
        yield from stop(core)
        raise
    except RobotError:
        core.end_guidance()
        raise
    return reply.trajectory


def reason(core: Core, session: int) -> str:
    """Return why the driver has ended a session; empty: it has not, or did not report it yet."""
    progress = core.state_port.progress
    if progress is None or not _has_ended(core, session):
        return ""
    state = TrajectoryState(progress.state).name
    return f"the driver reports {state} ({reason_text(progress.reason)})"


def end(core: Core) -> Flow[None]:
    """End the session and wait until the robot stands; without one, do nothing.

    Raises RequestRefused, RobotTimeout, ConnectionLost: the missing heartbeat then stops the robot.
    """
    if not core.is_guiding:
        return
    try:
        reply = yield from ask(core, messages.EgmRequest(0), "end the session")
        if isinstance(reply, messages.EgmReply):
            yield Wait(partial(_has_ended, core, reply.trajectory), _ENDS)
    except RequestRefused as refused:
        # It has ended before: by STOP, at its target, or by a fault that PROGRESS reports.
        if refused.reason is not Reason.IDLE:
            raise
    finally:
        core.end_guidance()
    # A motion that follows has longer pauses between heartbeats than the session had.
    yield Wait(lambda: not core.heartbeat.is_armed, core.timeouts.reply)


def _has_ended(core: Core, session: int) -> bool:
    progress = core.state_port.progress
    return (
        progress is not None and progress.trajectory == session and progress.state not in _UNDER_WAY
    )
