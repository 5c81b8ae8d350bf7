"""Flows that connect and identify the driver."""

import logging
import math

from rapidgen.client.core.group import Group
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    RobotError,
    RobotTimeout,
)
from rapidgen.client.flows.effects import INTERRUPTIONS, Close, CloseAll, Flow, Open, Send, Wait
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.messages import HELLO
from rapidgen.wire.simple_message.spec import MAX_JOINTS, PROTOCOL_VERSION, Feature, Port

_RETRY = 0.5
"""s between two attempts to connect again."""
SILENT = "the control port accepts a connection, but sends no answer"
"""Reason for a missing control connection: its task does not run."""
OTHERS_MOTION = "to connect there would end another client's motion"
_SILENT_STATES = 4
"""Joint messages without an answer to HELLO that mean a plain driver."""


def connect(core: Core) -> Flow[None]:
    """Connect and identify the driver; on failure close all connections."""
    try:
        yield from _open(core)
    except (RobotError, *INTERRUPTIONS):
        yield CloseAll()
        raise


def _open(core: Core) -> Flow[None]:
    core.fault = None
    limits = core.timeouts
    yield Open(Port.STATE, limits.connect)
    requested = core.clock()
    if not core.plain:
        yield Send(Port.STATE, core.hello(), limits.send)
    state_port = core.state_port
    came = yield Wait(lambda: state_port.is_complete or not core.state_open, limits.state)
    if not core.state_open:
        raise core.disconnected()
    if not came:
        raise core.state_port.late(
            f"connected, but no joints and status came within {limits.state:g} s",
            "is the state server's task running?",
        )
    if not core.plain:
        left = max(0.0, requested + limits.hello - core.clock())
        yield Wait(lambda: state_port.hello is not None or not core.state_open, left)
        # Late states mean a late answer: a driver sends it between two of them.
        yield Wait(
            lambda: (
                state_port.hello is not None
                or not core.state_open
                or state_port.samples >= _SILENT_STATES
            ),
            limits.state,
        )
    _check_driver(core, state_port.hello)
    report = state_port.driver.hello
    name = f"rapidgen {state_port.driver.version}, build {report.build_id}" if report else "plain"
    state_port.note(f"connected: {name}, {state_port.status}", logging.INFO)
    if core.watch:
        return
    yield Open(Port.MOTION, limits.connect)
    if Feature.CONTROL not in state_port.driver.features:
        return
    # The driver serves the newest client there, and ends the motion of the one before: STATUS shows
    # whether it has one, and so does PROGRESS after the answer to HELLO.
    seen = state_port.samples
    yield Wait(
        lambda: (
            state_port.progress is not None or state_port.samples >= seen + 2 or not core.state_open
        ),
        limits.hello,
    )
    if core.is_another_moving:
        core.without_control(OTHERS_MOTION, again=True)
    else:
        yield from _open_control(core)


def reach_control(core: Core) -> Flow[None]:
    """Open the control connection if it is missing."""
    if core.may_reach_control and not core.ports[Port.CONTROL].is_open:
        core.may_reach_control = False
        core.without_control("")
        yield from _open_control(core)


def _open_control(core: Core) -> Flow[None]:
    """Open the control connection if it belongs to this driver."""
    trouble = "another driver answers on the control port"
    try:
        yield Open(Port.CONTROL, core.timeouts.connect)
        control = core.ports[Port.CONTROL]
        pending = control.request(HELLO.number)
        yield Send(Port.CONTROL, core.hello(subscribe=False), core.timeouts.send)
        yield Wait(lambda: pending.reply is not None or not control.is_open, core.timeouts.reply)
        known, report = core.state_port.hello, pending.reply
        assert isinstance(known, messages.HelloReply)
        if isinstance(report, messages.HelloReply) and report.same_driver(known):
            return
        if report is None:
            trouble = SILENT
        if control.is_open:
            yield Close(Port.CONTROL)
    except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
        trouble = str(error)
    core.without_control(trouble, again=trouble == SILENT)


def _check_driver(core: Core, hello: messages.HelloReply | messages.HelloRefusal | None) -> None:
    """Check that versions and joint maps fit.

    Without a configuration the driver's data is used.
    """
    if hello is not None and hello.protocol != PROTOCOL_VERSION:
        raise IncompatibleDriver.because(
            "RG605",
            f"the driver speaks protocol version {hello.protocol}, this client {PROTOCOL_VERSION}",
            "build and deploy the driver again with this rapidgen",
            **core.evidence(),
        )
    if isinstance(hello, messages.HelloReply):
        fault = hello_fault(hello)
        if fault:
            raise IncompatibleDriver.because(
                "RG605",
                f"the driver reports {fault}",
                "build and deploy the driver again",
                **core.evidence(),
            )
        if core.configured is not None:
            core.configured.require(hello)
            core.use(core.configured.with_controller_limits(hello))
        else:
            core.use(Group.from_hello(hello))
    elif core.group is None:
        core.use(Group.unknown([f"joint_{i + 1}" for i in range(6)]))


def hello_fault(report: messages.HelloReply) -> str:
    """Describe an impossible value of a HELLO; later code relies on the rest."""
    streams = Feature.STREAMING in Feature(report.features)
    least = {
        "joint_count": 1,
        "capacity": 2,
        "ring": 1 if streams else 0,
        "batch": 0,
        "signals": 0,
        "control_port": 0,
        "state_period": 0.0,
        "min_segment": 0.0,
        "start_tolerance": 0.0,
        "start_tolerance_linear": 0.0,
        "preload": 0.0,
    }
    for name, bound in least.items():
        value = getattr(report, name)
        if not bound <= value < math.inf:
            return f"{name} {value:g}, which is at least {bound:g}"
    if report.joint_count > MAX_JOINTS:
        return f"{report.joint_count} joints, {MAX_JOINTS} are the most"
    for i, (lower, upper, speed) in enumerate(
        zip(report.lower, report.upper, report.speed, strict=True), 1
    ):
        if i <= report.joint_count and not (lower <= upper and speed > 0):
            return f"of joint {i} limits {lower:g} to {upper:g} and a speed of {speed:g}"
    return ""


def alive(core: Core, *, to_move: bool = False) -> Flow[None]:
    """Connect again if a connection was lost and `reconnect` allows it.

    Nothing is sent again.
    """
    if core.state_open and (core.ports[Port.MOTION].is_open or not to_move):
        return
    if core.fault is None or core.reconnect <= 0:
        raise core.disconnected()
    deadline = core.clock() + core.reconnect
    while True:
        try:
            yield from _open(core)
            return
        except (ConnectionFailed, ConnectionLost, RobotTimeout) as error:
            if core.clock() + _RETRY >= deadline:
                raise
            core.state_port.note(f"connecting again: {error}", logging.WARNING)
        yield Wait(lambda: False, _RETRY)
