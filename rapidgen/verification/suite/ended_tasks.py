"""Tasks that end: no message ends one, and the robot then stops."""

import struct
from collections.abc import Callable
from typing import Any

from rapidgen.runtime.errors import FatalError
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import watched_orders, wrapped
from rapidgen.verification.messages import RawComm, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.stream import BEGIN, Streamer
from rapidgen.verification.suite.motion_task import halt_timeout, unit_of
from rapidgen.verification.suite.supervisor import end_as_request
from rapidgen.verification.testbench import Bench

case = SuiteGroup("halting")

DETECTED = 0.5
"""Maximum s from the end of a task to the robot's stop and the event."""
_SERVERS = ("ROS_motionServer", "ROS_supervisor", "ROS_control", "ROS_stateServer")
_WHOLE = (0, 1, -1, 2**23 - 1, 2**23 + 1, 2**24 + 1, 2**31 - 1, -(2**31), 65_535, 65_536)
_REAL = (float("nan"), float("inf"), -float("inf"), 3.4e38, -3.4e38, 1e-45, -0.0, 2.0**31)
_SIZES = {
    messages.JOINT_TRAJ_PT: 13,
    messages.HELLO: 5,
    messages.POINTS: 12,
    messages.PAUSE: 1,
    messages.SPEED: 1,
    messages.HEARTBEAT: 1,
    messages.SIGNAL: 3,
    messages.PROGRAM: 12,
    messages.RESULT: 1,
    messages.DATA: 23,
    messages.TARGET: 2,
}
"""Data words of client messages."""


def _boundary_frames() -> list[bytes]:
    """Return messages with one boundary field, the others zero or one."""
    frames = [
        struct.pack("<iiii", length, number, comm, code)
        for number in _WHOLE
        for length, comm, code in ((12, 2, 0), (12, 1, 0), (12, number, 2), (12, 2, number))
    ]
    values = [struct.pack("<i", value) for value in _WHOLE]
    values += [struct.pack("<f", value) for value in _REAL]
    for number, size in _SIZES.items():
        for place in range(min(size, 5)):
            for word in values:
                data = bytearray(struct.pack("<i", 1) * size)
                data[4 * place : 4 * place + 4] = word
                frames.append(messages.framed(number, bytes(data)))
    return frames


@case("boundary-values", "a field at the end of its range ends no task", "R3")
def _boundaries(bench: Bench) -> None:
    """Send each field of each message at its type's limits, on every port."""
    ports = [bench.motion, bench.state]
    if bench.group.ports.control:
        ports.append(bench.control)
    for connect in ports:
        link = connect()
        for frame in _boundary_frames():
            link.send(frame)
            # The server drops the connection if it cannot trust what follows.
            bench.run(0.004 * bench.setting.slowness)
            if link.lost:
                link = connect()
        bench.run(0.3)
        bench.assert_healthy()
        link.close(then=1.5)
    bench.assert_moves_through(bench.motion(), bench.wave(3))


def _modules(bench: Bench) -> list[str]:
    return [m for m in _SERVERS if m != "ROS_control" or bench.group.ports.control]


def _halts(bench: Bench, module: str, situation: str) -> None:
    """End a task while the robot stands or moves; check the reactions."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    what = f"{bench.task(module)} ended, the robot was {situation}"
    bench.run(0.5)
    stream = None
    if situation == "moving":
        bench.start_motion(link, bench.wave(8, duration=unit), 0.6 * unit)
    elif situation == "streaming":
        stream = Streamer(bench, link)
        stream.takes("points", bench.wave(8, duration=unit), BEGIN)
        bench.wait_until_moving()
        bench.run(0.6 * unit)
    orders, last, task = watched_orders(bench), bench.last_event, bench.rapid_task(module)
    task.stop("")
    finished = bench.now
    bench.run(DETECTED)
    if situation != "idle" and not any(o.instruction == "StopMove" for o in orders):
        raise CheckFailed(f"{what}: after {DETECTED} s no task has stopped it")
    log_entries = [str(event) for event in bench.controller.log.since(last)]
    if not any("a server task has ended" in text and task.name in text for text in log_entries):
        raise CheckFailed(
            f"{what}: after {bench.now - finished:.2f} s the event log says {log_entries}"
        )
    bench.wait_until_standing(1 + bench.setting.motion.settle + bench.setting.motion.servo_lag)
    bench.run(halt_timeout(bench))
    if module != "ROS_stateServer":
        status, reply = bench.status(watcher), bench.progress(watcher)
        seen = status.motion_possible, status.in_error, status.error_code
        if seen != (0, 1, RawReason.TASK_ENDED):
            raise CheckFailed(f"{what}: STATUS says {status}")
        if situation != "idle" and (reply.state, reply.reason) != (
            RawTrajectoryState.FAILED,
            RawReason.TASK_ENDED,
        ):
            raise CheckFailed(f"{what}: PROGRESS says {reply}")
    if module != "ROS_motionServer":
        _is_refused(bench, link, stream, what)
    bench.assert_at_rest(1, what)
    task.start()
    bench.run(2 + halt_timeout(bench))
    if module == "ROS_supervisor" and bench.setting.motion.stop_owner != "kind":
        # Here the supervisor cannot reset the stop of a server.
        return
    bench.assert_moves_through(link if not link.lost else bench.motion(), bench.wave(3))


def _is_refused(bench: Bench, link: RawLink, stream: Streamer | None, what: str) -> None:
    link.read()
    link.send(end_as_request(bench, 3, unit_of(bench)))
    content = messages.decode(link.expect_reply(3, "the end frame is answered"))
    if content != messages.RawRefused(RawReason.TASK_ENDED, -1, 0):
        raise CheckFailed(f"{what}: a trajectory is answered by {content}")
    if not bench.streams:
        return
    stream = Streamer(bench, link, 1 if stream is None else stream.number + 1)
    stream.refuses(RawReason.TASK_ENDED, what, bench.wave(3), BEGIN)


@case("task-ends-idle", "a server task ends while the robot is at rest", background=True)
def _idle(bench: Bench) -> None:
    for module in _modules(bench):
        with bench.second_controller(bench.system) as other:
            _halts(other, module, "idle")


@case("task-ends-moving", "a server task ends while the robot moves", background=True)
def _moving(bench: Bench) -> None:
    for module in _modules(bench):
        with bench.second_controller(bench.system) as other:
            _halts(other, module, "moving")


@case("task-ends-streaming", "a server task ends in a stream", needs="stream", background=True)
def _streaming(bench: Bench) -> None:
    for module in _modules(bench):
        with bench.second_controller(bench.system) as other:
            _halts(other, module, "streaming")


@case("task-fails", "a server task ends with an error, and the program is started again")
def _fails(bench: Bench) -> None:
    """End a task with an error: the controller stops the program.

    After Start nothing moves, with tasks in the background and with NORMAL ones.
    """
    for module in _modules(bench):
        with bench.second_controller(bench.system) as other:
            _ends_with_an_error(other, module)


def _ends_with_an_error(bench: Bench, module: str) -> None:
    link = bench.motion()
    bench.run(0.5)
    task = bench.rapid_task(module)
    fault = [FatalError(194_199, "made to fail")]

    def fail(before: Callable[..., Any]) -> Callable[..., Any]:
        def failing(*arguments: object) -> object:
            if fault:
                raise fault[0]
            return before(*arguments)

        return failing

    name = "WaitTime" if module == "ROS_supervisor" else "SocketClose"
    for call in (name, "SocketReceive", "SocketAccept", "CJointT"):
        if task.program.find_routine(None, call.casefold()) is not None:
            wrapped(task, call, fail)
    bench.run(1.5)
    if task.state != "error":
        raise NotApplicable(f"{task.name} does none of that now")
    bench.start_again()
    bench.run(1)
    bench.wait_until_standing(2)
    if not link.lost:
        link.send(bench.download(bench.wave(3)))
    bench.assert_at_rest(2, f"{task.name} ended with an error, and the program was started")
    _pings(bench)
    fault.clear()
    bench.controller.perform("power-loss")
    bench.start_again()
    bench.assert_at_rest(
        2, f"{task.name} ended with an error, the controller and the program were started"
    )
    bench.assert_moves_through(bench.motion(), bench.wave(3))


def _pings(bench: Bench) -> None:
    """Check that STOP gets a reply wherever its server runs."""
    for task, connect in (("ROS_motionServer", bench.motion), ("ROS_control", bench.control)):
        if task == "ROS_control" and not bench.group.ports.control:
            continue
        if bench.rapid_task(task).state == "running":
            other = connect()
            # On the motion port, the driver serves a newer client when the old one is silent.
            bench.run(1.5)
            other.send(messages.encode(messages.RawPing(), RawComm.REQUEST))
            other.reply(messages.PING, 3)
            other.close()
