"""Control port clients and requests: HELLO, PING, SIGNAL, invalid data."""

import math
import struct

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawComm, RawReason, RawReplyCode
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.raw_connection import STOP, RawLink, raw_point
from rapidgen.verification.suite.control import done, not_done, stop
from rapidgen.verification.testbench import HELLO, Bench

case = SuiteGroup("controlling", needs="control")

_TRAJ = messages.JOINT_TRAJ_PT


@case("control-leaves", "a control client leaves")
def _control_client_leaves(bench: Bench) -> None:
    """Disconnect a control client: only one with heartbeats stops the robot."""
    for heartbeats in (True, False, True):
        control, link = bench.control(), bench.motion()
        points = bench.wave(12)
        bench.start_motion(link, points)
        if heartbeats:
            control.ask(messages.RawHeartbeat(0.8))
        bench.run(0.3)
        control.close()
        if heartbeats:
            bench.wait_until_standing(3)
            if distance(bench.position, points[-1][0]) < 1e-3:
                raise CheckFailed("the robot went on though the client that beats has left")
            bench.assert_at_rest(2, "the client that beats has left")
        else:
            bench.wait_until_at(points[-1][0], 20)
        link.close(then=2)


@case("newest-control", "the newest control client is served", "R12")
def _newest_control_client(bench: Bench) -> None:
    """Connect a new control client: it can stop the robot.

    Other connections may hang on the port.
    """
    old = bench.control()
    for _ in range(2):
        control = bench.control()
        old.wait_disconnected(1, "the client before gives way")
        old = control
        bench.run(0.5)
        link = bench.motion()
        bench.run(1.2)
        bench.start_motion(link, bench.wave(12))
        stop(control)
        bench.wait_until_at_rest(3, 1, "the newest client has stopped it")


@case("control-hello", "HELLO, PING and requests in pieces and lumps", "R2")
def _control_hello(bench: Bench) -> None:
    control = bench.control()
    answer = control.ask(HELLO)
    if not isinstance(answer, messages.RawHelloReply) or answer.build_id != bench.system.build_id:
        raise CheckFailed(f"HELLO on the control port is answered by {answer}")
    if bench.state().ask(HELLO) != answer:
        raise CheckFailed(f"HELLO on the state port is not answered by {answer}")
    done(control.ask(messages.RawPing()), "PING")
    control.send(b"\x0c\0\0\0\x14\0\0\0\x02\0\0\0\0\0\0\0")
    if not isinstance(_failure(control), messages.RawFailure):
        raise CheckFailed("a request of an unknown type is not answered by a failure")
    for byte in messages.encode(messages.RawHeartbeat(0), RawComm.REQUEST):
        control.send(bytes([byte]))
        bench.run(0.003)
    control.reply(messages.HEARTBEAT)
    # All at once; the driver answers each in order.
    control.send(STOP + messages.encode(messages.RawSpeed(5), RawComm.REQUEST) + STOP)
    for number in (_TRAJ, messages.SPEED, _TRAJ):
        control.reply(number)


def _failure(link: RawLink) -> object:
    """Return the content of a failure reply to a type without content."""
    frame = link.expect_reply(2, "a request of an unknown type is answered")
    if (frame.comm, frame.reply, frame.data) == (RawComm.REPLY, RawReplyCode.FAILURE, b""):
        return messages.RawFailure()
    return messages.decode(frame)


@case("control-junk", "junk drops its client and stops nothing", "R3")
def _control_junk(bench: Bench) -> None:
    """Send invalid requests: the driver drops the client and stops nothing."""
    topic = bytearray(STOP)
    topic[8] = 1
    wrong = [
        b"\xff" * 8,
        struct.pack("<i", 11),
        struct.pack("<i", 1021),
        bytes(topic),
        raw_point(3, bench.position, 1.0, RawComm.REQUEST),
        struct.pack("<5i", 16, messages.PAUSE, 1, 0, 1),
        struct.pack("<6i", 20, messages.PAUSE, 2, 0, 1, 1),
        struct.pack("<4i", 12, messages.SPEED, 2, 0),
        struct.pack("<4i", 12, messages.HEARTBEAT, 2, 0),
    ]
    link = bench.motion()
    points = bench.wave(40)
    bench.start_motion(link, points)
    for data in wrong:
        control = bench.control()
        control.send(data)
        control.wait_disconnected(3, f"{data[:24].hex()} drops its client")
        if bench.standing:
            raise CheckFailed(f"the robot stopped for {data[:24].hex()}")
    bench.wait_until_at(points[-1][0], 30)
    control = bench.control()
    stop(control)


@case("signals", "signals that the configuration exposes")
def _signals(bench: Bench) -> None:
    """Read and write the configured signals; reject the others."""
    control = bench.control()
    exposed = bench.config.signals
    count = len(exposed)
    for index in (-1, count, 99, 2**31 - 1, -(2**31)):
        control.send(messages.encode(messages.RawSignal(index, 0, 0.0), RawComm.REQUEST))
        if count:
            answer = control.reply(messages.SIGNAL)
            not_done(answer, RawReason.NO_SIGNAL, f"signal {index} of {count}")
        elif not isinstance(_failure(control), messages.RawFailure):
            raise CheckFailed("a driver without signals answers SIGNAL")
    for index, signal in enumerate(exposed):
        _one_signal(bench, control, index, signal.kind, signal.access == "write")


def _one_signal(bench: Bench, control: RawLink, index: int, kind: str, writable: bool) -> None:
    target = bench.config.signals[index].name in bench.controller.signals
    reply = control.ask(messages.RawSignal(index, 0, 0.0))
    if not target:
        not_done(reply, RawReason.NO_SIGNAL, f"signal {index} is not on the controller")
        return
    if not isinstance(reply, messages.RawSignalReply) or reply.signal != index:
        raise CheckFailed(f"signal {index} is read as {reply}")
    name, signals = bench.config.signals[index].name, bench.controller.signals
    if not writable:
        signals[name] = 1
        reply = control.ask(messages.RawSignal(index, 0, 0.0))
        if reply != messages.RawSignalReply(index, 1.0):
            raise CheckFailed(f"signal {index} is 1, it is read as {reply}")
        reply = control.ask(messages.RawSignal(index, 1, 0.0))
        not_done(reply, RawReason.READ_ONLY, f"signal {index} may not be written")
        if signals[name] != 1:
            raise CheckFailed(f"signal {index} may not be written, and is {signals[name]}")
        return
    reply = control.ask(messages.RawSignal(index, 1, 1.0))
    if reply != messages.RawSignalReply(index, 1.0):
        raise CheckFailed(f"signal {index} is written as {reply}")
    none = {"DO": (2.0, 0.5, -1.0), "GO": (-1.0, 0.5)}.get(kind, ())
    for value in (*none, math.nan, math.inf, 1e20):
        not_done(
            control.ask(messages.RawSignal(index, 1, value)),
            RawReason.BAD_VALUE,
            f"{value} to {kind}",
        )
    if signals[name] != 1:
        raise CheckFailed(f"signal {index} is written, and is {signals[name]}")
    for write in (2, -1):
        reply = control.ask(messages.RawSignal(index, write, 0.0))
        not_done(reply, RawReason.BAD_VALUE, "neither read nor write")
    if control.ask(messages.RawSignal(index, 1, 0.0)) != messages.RawSignalReply(index, 0.0):
        raise CheckFailed(f"signal {index} does not go back to 0")
