"""The supervisor from outside: reaction times, end reasons, pauses."""

from rapidgen.machine.event_log import Event, EventType
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call, fails
from rapidgen.verification.messages import RawComm, RawMode, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP, RawLink, point_frame
from rapidgen.verification.stream import BEGIN, Streamer
from rapidgen.verification.suite.motion_task import (
    begins,
    begins_soon,
    datum,
    halt_timeout,
    soon,
    unit_of,
)
from rapidgen.verification.testbench import Bench

case = SuiteGroup("halting")

_TRAJ = messages.JOINT_TRAJ_PT


def _at_once(bench: Bench) -> float:
    """Return s of the supervisor's work in a trap."""
    return bench.setting.latest_interrupt + 0.025 * bench.setting.slowness


_SOCKETS_CHECKED = 0.12
"""s until the motion server has checked its sockets. The reply on the control port waits for it."""


def _prompt(bench: Bench, requested: float, what: str, allowed: float = 0) -> None:
    late = bench.now - requested - allowed
    # Some controllers continue a program after StopMove only when the robot stands.
    if late > _at_once(bench) + (0.3 if bench.setting.motion.stop_waits else 0):
        raise CheckFailed(f"{what} is answered after {late:.3f} s")


def end_as_request(bench: Bench, count: int, duration: float) -> bytes:
    """Return the bytes of a trajectory whose end frame is a request."""
    points = bench.wave(count, duration=duration)
    frames = [point_frame(n, count, *p) for n, p in enumerate(points[:-1])]
    return b"".join((*frames, point_frame(count - 1, count, *points[-1], RawComm.REQUEST)))


@case("answers-soon", "the supervisor answers by interrupts", "R7a", background=True)
def _answers_soon(bench: Bench) -> None:
    """Send requests at any moment: the supervisor answers immediately."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    control = bench.control() if bench.group.ports.control else None
    period = bench.config.state_period
    for phase in range(5):
        # At different moments of the supervisor's round.
        bench.run(0.3 + 0.021 * phase)
        link.send(end_as_request(bench, 5, unit))
        requested = bench.now
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        if not isinstance(content, messages.RawAccepted):
            raise CheckFailed(f"a good trajectory is answered by {content}")
        _prompt(bench, requested, "the end frame of a trajectory")
        begins_soon(bench, requested)
        if control is not None:
            for paused in (1, 0):
                requested = bench.now
                if control.ask(messages.RawPause(paused)) != messages.RawAcknowledged():
                    raise CheckFailed(f"PAUSE {paused} is refused")
                _prompt(bench, requested, f"PAUSE {paused}")
                bench.run(0.1)
        # The reply comes just before a STATUS, which then reports the stop.
        bench.status(watcher)
        bench.run(max(0.0, period - 0.045))
        port = link
        if phase in (1, 3) and control is not None:
            port = control
        port.read()
        port.send(STOP)
        requested = bench.now
        if port.reply(_TRAJ) != messages.RawAcknowledged():
            raise CheckFailed("STOP is not confirmed")
        _prompt(bench, requested, "STOP", _SOCKETS_CHECKED if port is control else 0)
        # An earlier measurement is on its way for no longer than this.
        bench.run(0.01)
        status = bench.status(watcher)
        if bench.now - requested < 0.06 and status.motion_possible:
            raise CheckFailed(f"STOP came {bench.now - requested:.3f} s ago, STATUS says {status}")
        bench.wait_until_standing(0.3)
        for other in (link, control):
            if other is not None:
                bench.run(0.2 + 0.021 * phase)
                requested = bench.now
                other.stop()
                allowed = _SOCKETS_CHECKED if other is control else 0
                _prompt(bench, requested, "STOP at a standstill", allowed)
        # Data right after a stop of the program is rejected.
        bench.run(0.4)
        bench.controller.perform("stop")
        link.send(end_as_request(bench, 3, unit))
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        if content != messages.RawRefused(RawReason.NOT_EXECUTING, -1, 0):
            raise CheckFailed(
                f"right after a stop of the program a trajectory is answered: {content}"
            )
        bench.controller.perform("start")


def _warnings(bench: Bench, since: int) -> list[Event]:
    return [
        e
        for e in bench.controller.log.since(since)
        if e.type is not EventType.INFO and e.title.startswith("ROS")
    ]


@case("why-it-ended", "the reason for each early end, at once", "R11, R14", background=True)
def _why_it_ended(bench: Bench) -> None:
    """Report each event's own reason immediately; reject data meanwhile."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    number = bench.progress(watcher).trajectory
    auto, failed = RawMode.AUTO, RawTrajectoryState.FAILED
    for action, reason, later, status in (
        ("e-stop", RawReason.EMERGENCY_STOP, RawReason.EMERGENCY_STOP, (0, 1, auto)),
        ("motors-off", RawReason.MOTORS_OFF, RawReason.MOTORS_OFF, (0, 0, auto)),
        ("stop", RawReason.PROGRAM_STOPPED, RawReason.NOT_EXECUTING, (1, 0, auto)),
        ("manual", RawReason.MOTORS_OFF, RawReason.MOTORS_OFF, (0, 0, RawMode.MANUAL)),
        ("leaves", RawReason.CLIENT_LOST, RawReason.NONE, (1, 0, auto)),
    ):
        last, points = bench.last_event, bench.wave(5, duration=unit)
        link.send(bench.download(points))
        number += 1
        begins_soon(bench, bench.now)
        bench.run(1.15 * unit)
        if action == "leaves":
            link.close()
        else:
            bench.controller.perform(action)
        bench.wait_until_standing(3)
        bench.run(halt_timeout(bench))
        reply, seen = bench.progress(watcher), bench.status(watcher)
        if reply != (number, failed, 5, 3, 1, reason, 1, 0):
            raise CheckFailed(f"{action} came between points 1 and 2, PROGRESS says {reply}")
        powered, e_stopped, mode = status
        possible = int(action == "leaves")
        expected = messages.RawStatus(powered, e_stopped, reason, 1, 0, mode, possible)
        # An emergency stop is also an error of the controller.
        if seen != expected:
            raise CheckFailed(f"after {action} STATUS says {seen}, wanted {expected}")
        log_entries = [e.texts[0] for e in _warnings(bench, last)]
        if log_entries != ([messages.text_of(reason)] if action == "leaves" else []):
            raise CheckFailed(f"after {action} the event log says {log_entries}")
        if action == "leaves":
            bench.run(0.3)
            link = bench.motion()
            continue
        link.send(end_as_request(bench, 3, unit))
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        number += 1
        if content != messages.RawRefused(later, -1, 0):
            raise CheckFailed(f"after {action} a trajectory is answered by {content}")
        # Data received meanwhile is discarded, even if its end comes after recovery.
        frames = end_as_request(bench, 3, unit)
        link.send(frames[:68])
        number += 1
        bench.run(0.3)
        bench.start_again()
        bench.assert_at_rest(halt_timeout(bench), f"the program was started again after {action}")
        if bench.status(watcher).motion_possible != 1:
            raise CheckFailed(f"after {action} and a start of the program no motion is possible")
        link.send(frames[68:])
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        # The return to automatic mode is a change of mode, too.
        noted = RawReason.MODE_CHANGED if action == "manual" else reason
        if content != messages.RawRefused(noted, -1, 0):
            raise CheckFailed(
                f"what started after {action}, and ended later, is answered by {content}"
            )


def _is_paused(bench: Bench, watcher: RawLink, planned: int, reached: int) -> None:
    bench.wait_until_standing(0.1 + soon(bench) + bench.setting.motion.servo_lag)
    bench.run(soon(bench) + 2 * bench.config.state_period)
    reply, status = bench.progress(watcher), bench.status(watcher)
    if (reply.state, reply.planned, reply.reached, reply.reason) != (
        RawTrajectoryState.PAUSED,
        planned,
        reached,
        0,
    ):
        raise CheckFailed(f"a trajectory is paused, PROGRESS says {reply}")
    if status != (1, 0, 0, 0, 0, RawMode.AUTO, 0):
        raise CheckFailed(f"a trajectory is paused, STATUS says {status}")
    bench.assert_at_rest(0.3, "it is paused")


@case("pause-by-step", "each answer to PAUSE, and how a paused trajectory ends", needs="control")
def _pause_by_step(bench: Bench) -> None:
    """Check each reply to PAUSE, its reports, and the paused trajectory."""
    control, watcher, link, unit = bench.control(), bench.watcher(), bench.motion(), unit_of(bench)

    def ask(paused: int, reason: RawReason = RawReason.NONE) -> None:
        reply = control.ask(messages.RawPause(paused))
        if reply != (messages.RawNotDone(reason) if reason else messages.RawAcknowledged()):
            raise CheckFailed(f"PAUSE {paused} is answered by {reply}")

    def goes_on() -> None:
        ask(0)
        bench.wait_until_moving(_at_once(bench) + bench.setting.motion.servo_lag)

    for paused in (1, 0):
        ask(paused, RawReason.IDLE)
    path = bench.wave(4, duration=unit)
    started = begins(bench, link, [*path, (path[3][0], 3 * unit)])
    bench.run(1.15 * unit)
    ask(1)
    _is_paused(bench, watcher, 3, 1)
    fails(bench, "ROS_supervisor", "StartMove", "ERR_PATHDIST")
    ask(0, RawReason.INTERNAL)
    _is_paused(bench, watcher, 3, 1)
    ask(1)
    goes_on()
    fails(bench, "ROS_supervisor", "StopMove", "ERR_PATH_STOP")
    ask(1, RawReason.INTERNAL)
    ask(0)
    bench.run(soon(bench) + 2 * bench.config.state_period)
    if bench.standing or bench.status(watcher)[3:] != (0, 1, RawMode.AUTO, 1):
        raise CheckFailed("a pause that was refused, and the end of none, stop the robot")
    bench.wait_until_at(path[3][0], 5)
    bench.followed([p for p, _ in path], since=started)
    # The stay at its end continues in a pause; then nothing is left to pause.
    bench.run(0.5 * unit)
    ask(1)
    _is_paused(bench, watcher, 5, 4)
    bench.run(3 * unit)
    reply, status = bench.progress(watcher), bench.status(watcher)
    if (reply.state, status.motion_possible) != (RawTrajectoryState.DONE, 1):
        raise CheckFailed(f"a paused trajectory has come to its end: {reply}, {status}")
    ask(0, RawReason.IDLE)
    for stopped in (True, False):
        begins(bench, link, bench.wave(3, duration=unit))
        bench.run(0.5 * unit)
        ask(1)
        bench.wait_until_standing(1)
        if stopped:
            link.stop()
            bench.run(halt_timeout(bench))
            ask(0, RawReason.IDLE)
        points = bench.wave(3, duration=unit)
        link.send(bench.download(points))
        bench.wait_until_at(points[2][0], 3 * unit + 2)


@case("stop-in-pause", "STOP while a paused robot is about to be started", "R7b", needs="control")
def _stop_in_the_end_of_a_pause(bench: Bench) -> None:
    """Send STOP while the supervisor resumes a paused robot: no motion."""
    control, link, unit = bench.control(), bench.motion(), unit_of(bench)
    supervisor = bench.rapid_task("ROS_supervisor")

    def stop() -> None:
        link.at_once(STOP)
        # Long enough for the motion server, too short for an interrupt.
        supervisor.sleep(0.004 * bench.setting.slowness)

    for _ in range(4):
        begins(bench, link, bench.wave(4, duration=unit, size=0.3))
        bench.run(0.7 * unit)
        control.ask(messages.RawPause(1))
        bench.wait_until_standing(1)
        at_call(bench, "ROS_supervisor", "StartMove", 1, stop)
        control.send(messages.encode(messages.RawPause(0), RawComm.REQUEST))
        bench.assert_at_rest(halt_timeout(bench), "STOP came at the end of a pause")
        if link.reply(_TRAJ) != messages.RawAcknowledged():
            raise CheckFailed("STOP at the end of a pause is not confirmed")


@case("builds-differ", "a task that shows another build, at a time", background=True)
def _builds_differ(bench: Bench) -> None:
    """Show another build in a task: one report after 2 s, no trajectories."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    task = bench.controller.task(bench.task("ROS_supervisor"))
    displayed, last = datum(bench, "ros_task_build_state"), bench.last_event
    good = task[displayed]

    def mix() -> None:
        task[displayed] = "0123456789ab"

    for seconds, times in ((1.5, 0), (1.5, 0), (3.0, 1), (2.5, 2)):
        # Just after a look of the supervisor.
        at_call(bench, "ROS_supervisor", "WaitTime", 1, mix)
        bench.until(lambda: task[displayed] != good, 0.2, "the supervisor looks")
        mixed = bench.now
        link.send(end_as_request(bench, 3, unit))
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        if content != messages.RawRefused(RawReason.BUILD_MISMATCH, -1, 0):
            raise CheckFailed(f"tasks show different builds, a trajectory is answered by {content}")
        bench.run(seconds)
        if bench.status(watcher).motion_possible:
            raise CheckFailed("tasks show different builds, STATUS says that motion is possible")
        task[displayed] = good
        bench.run(halt_timeout(bench))
        if not bench.status(watcher).motion_possible:
            raise CheckFailed("tasks show one build again, STATUS says that no motion is possible")
        log_entries = [e for e in _warnings(bench, last) if "different builds" in e.title]
        if len(log_entries) != times or (
            log_entries and not 1.95 < log_entries[-1].time - mixed < 2.08
        ):
            raise CheckFailed(
                f"builds differed for {seconds} s from {mixed:.3f} s on, the event log says "
                f"{[str(e) for e in log_entries]}"
            )
    stream = Streamer(bench, link)
    for number, role in enumerate(("motion_server", "supervisor", "control"), 1):
        if role == "control" and not bench.group.ports.control:
            continue
        other = datum(bench, f"ros_task_build_{role}")
        task[other] = "0123456789ab"
        link.send(end_as_request(bench, 3, unit))
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        if content != messages.RawRefused(RawReason.BUILD_MISMATCH, -1, 0):
            raise CheckFailed(
                f"the {role} shows another build, a trajectory is answered by {content}"
            )
        if bench.streams:
            stream.number, stream.sent = number, 0
            stream.put(bench.wave(3, duration=unit), BEGIN)
            stream.refused(RawReason.BUILD_MISMATCH, f"the {role} shows another build")
        task[other] = good
    # The value of the motion task counts once its program runs.
    displayed = datum(bench, "ros_task_build_motion")
    for text, stopped, reason in (
        ("", False, RawReason.NOT_EXECUTING),
        ("mixed", True, RawReason.NOT_EXECUTING),
        ("mixed", False, RawReason.BUILD_MISMATCH),
    ):
        if stopped:
            bench.controller.perform("stop")
        task[displayed] = text
        link.send(end_as_request(bench, 3, unit))
        content = messages.decode(link.expect_reply(2, "the end frame is answered"))
        if not isinstance(content, messages.RawRefused) or content.reason != reason:
            raise CheckFailed(
                f"the motion task shows {text!r}, a trajectory is answered by {content}"
            )
        task[displayed] = good
        if stopped:
            bench.controller.perform("start")
        bench.run(0.3)
    begins(bench, link, bench.wave(3, duration=unit))
