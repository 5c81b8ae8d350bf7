"""Stops at critical moments, and drivers without signals or routines."""

from dataclasses import replace
from functools import partial

from rapidgen.generate.context import WRAP
from rapidgen.machine.event_log import EventType
from rapidgen.runtime.errors import RapidError
from rapidgen.system.model import System
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import (
    Instruction,
    at_call,
    fails,
    watched_orders,
    wrapped,
)
from rapidgen.verification.messages import JOINT_TRAJ_PT, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import SETTLED, Position
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.suite.instruction_errors import set_counters
from rapidgen.verification.suite.motion_task import (
    CpuMeter,
    begins,
    datum,
    halt_timeout,
    soon,
    unit_of,
)
from rapidgen.verification.suite.off_path import STAYS_STOPPED
from rapidgen.verification.suite.supervisor import end_as_request
from rapidgen.verification.testbench import Bench, with_module

case = SuiteGroup("interrupted")

_TRAJ = JOINT_TRAJ_PT


def _ended(bench: Bench, watcher: RawLink, reason: RawReason, what: str) -> messages.RawProgress:
    """Return PROGRESS; check that the newest trajectory ended for that reason."""
    reply = bench.progress(watcher)
    stopped = reason is RawReason.STOPPED
    state = RawTrajectoryState.STOPPED if stopped else RawTrajectoryState.FAILED
    reasons = [reason]
    if bench.setting.switch_at_pers and reason is RawReason.MOTORS_OFF:
        # Motors off also stop the program, which the driver may read first.
        reasons.append(RawReason.PROGRAM_STOPPED)
    if reply.state != state or reply.reason not in reasons:
        raise CheckFailed(f"{what}: {reason.name} is wanted, PROGRESS says {reply}")
    return reply


def _works(bench: Bench, link: RawLink) -> None:
    """Check that a trajectory starts soon and ends in time."""
    unit = unit_of(bench)
    points = bench.wave(2, duration=unit)
    begins(bench, link, points)
    bench.wait_until_at(points[1][0], unit + 0.3)
    bench.run(0.1)


@case("before-a-move", "a stop of the program just before a move", "R7a", background=True)
def _before_a_move(bench: Bench) -> None:
    """Stop and Start just before a move: the move does not start."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    task = bench.controller.task(bench.task("ROS_motion"))
    for number, pause in ((1, 0.001), (2, 0.03), (3, 0.07), (3, 0.001)):
        at_call(bench, "ROS_motion", "MoveAbsJ", number, partial(bench.controller.perform, "stop"))
        link.send(bench.download(bench.wave(5, duration=unit)))
        bench.until(lambda: task.state == "stopped", 3 * unit, "the program is stopped")
        bench.wait_until_standing(1)
        bench.run(pause)
        bench.controller.perform("start")
        bench.assert_at_rest(
            halt_timeout(bench), f"the program was stopped before move {number}, and started"
        )
        reply = _ended(bench, watcher, RawReason.PROGRAM_STOPPED, "the program was stopped")
        if (reply.planned, reply.reached) != (number + 1, max(1, number - 1)):
            raise CheckFailed(
                f"the program was stopped before move {number}, PROGRESS says {reply}"
            )
        _works(bench, link)


@case("first-reason", "the first of two reasons counts", background=True)
def _first_reason(bench: Bench) -> None:
    """Combine two stop reasons: the first counts, and one end is reported."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    last = bench.last_event
    begins(bench, link, bench.wave(5, duration=unit))
    bench.run(unit)
    link.stop()
    bench.controller.perform("stop")
    bench.run(halt_timeout(bench))
    _ended(bench, watcher, RawReason.STOPPED, "STOP, then a stop of the program")
    bench.controller.perform("start")
    bench.run(halt_timeout(bench))
    # A move fails just when the supervisor has requested a halt.
    in_progress = _fails_with_a_halt(bench, "ERR_COLL_STOP")
    link.send(bench.download(bench.wave(5, duration=unit)))
    bench.until(lambda: bool(in_progress), 2 * unit, "the second move begins")
    link.stop()
    bench.wait_until_standing(2)
    bench.run(halt_timeout(bench))
    _ended(bench, watcher, RawReason.STOPPED, "STOP, then a move that fails")
    _works(bench, link)
    log_entries = [e for e in bench.controller.log.since(last) if e.type is EventType.ERROR]
    if log_entries:
        raise CheckFailed(
            f"a trajectory was stopped, the event log says {[str(e) for e in log_entries]}"
        )


def _fails_with_a_halt(bench: Bench, error: str) -> list[float]:
    """Fail the second move from now, during a halt request.

    The time of the failure is appended to the result list.
    """
    view = bench.controller.task(bench.task("ROS_motion"))
    requested, done = datum(bench, "ros_abort"), datum(bench, "ros_abort_done")
    in_progress: list[float] = []
    left = 2

    def wrap(as_before: Instruction) -> Instruction:
        def failing(*arguments: object) -> object:
            nonlocal left
            left -= 1
            if left != 0:
                return as_before(*arguments)
            in_progress.append(bench.now)
            while view[requested] == view[done]:
                view.rapid.sleep(0.001)
            raise RapidError(error)

        return failing

    wrapped(bench.rapid_task("ROS_motion"), "MoveAbsJ", wrap)
    return in_progress


@case("late-point", "a point of a stopped trajectory that comes late", "R5")
def _late_point(bench: Bench) -> None:
    """Announce a point of a stopped trajectory late: it is dropped."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    task = bench.controller.task(bench.task("ROS_motion"))
    ring, head = datum(bench, "ros_ring"), datum(bench, "ros_head")
    last = bench.last_event
    begins(bench, link, bench.wave(5, duration=unit))
    bench.run(1.15 * unit)
    link.stop()
    bench.run(halt_timeout(bench))
    reply = _ended(bench, watcher, RawReason.STOPPED, "STOP")
    points = list(task[ring].values())
    place = int(task[head]) % len(points)
    points[place].trajectory, points[place].index = reply.trajectory, reply.planned + 1
    points[place].target, points[place].duration = points[1].target, 1.0
    task[head] = task[head] + 1
    bench.assert_at_rest(1, "a point of a stopped trajectory came late")
    _works(bench, link)
    if any(e.type is EventType.ERROR for e in bench.controller.log.since(last)):
        raise CheckFailed("a point of a stopped trajectory came late, and is reported as an error")


def _second_controller(bench: Bench, system: System, *, early: bool = False) -> Bench:
    """Boot another controller; `early`: none of its tasks has run yet."""
    return bench.second_controller(system, setting=bench.setting.early() if early else None)


def _bare(system: System, *events: str) -> System:
    """Return the system without signals and with these event routines only."""
    saved = tuple(e for e in system.events if e.event in events)
    return replace(system, signals=(), outputs=(), cross=(), events=saved)


def _moves(bench: Bench, link: RawLink) -> None:
    """Check that a trajectory moves from its point 1 to 2."""
    unit = unit_of(bench)
    begins(bench, link, bench.wave(6, duration=unit))
    bench.run(1.6 * unit)


@case("unseen", "stops that neither a signal nor an event routine shows", "R15", background=True)
def _unseen(bench: Bench) -> None:
    """Stop without signals or event routines.

    The driver sees a stop by the mode, or when main starts again.
    """
    with _second_controller(bench, _bare(bench.system)) as other:
        watcher, link = other.watcher(), other.motion()
        for action, reason, restarts in (
            ("manual", RawReason.MODE_CHANGED, False),
            ("stop", RawReason.STOPPED, False),
            ("stop", RawReason.PROGRAM_STOPPED, True),
        ):
            _moves(other, link)
            last = other.last_event
            other.controller.perform(action)
            other.wait_until_standing(1)
            halted = other.now
            if restarts:
                other.controller.perform("pp-to-main")
            elif reason is RawReason.STOPPED:
                other.run(3)
                link.send(STOP)
                halted = other.now
                link.reply(_TRAJ)
            if not restarts:
                other.run(5)
                _ended(other, watcher, reason, f"{action} of a driver without signals")
            log_entries = [e.time for e in other.controller.log.since(last) if "answer" in e.title]
            if len(log_entries) != int(not restarts) or any(
                abs(t - halted - 2) > 0.2 for t in log_entries
            ):
                raise CheckFailed(
                    f"from {halted:.2f} s on no task answers, which is reported at {log_entries} s"
                )
            other.start_again()
            other.assert_at_rest(1, f"{action} of a driver without signals, then Start")
            _ended(other, watcher, reason, f"{action} of a driver without signals, then Start")
            other.run(halt_timeout(other))
            _works(other, link)


@case("stopped-alone", "event routines alone tell that the program is stopped", background=True)
def _stopped_alone(bench: Bench) -> None:
    """Stop without signals: data before Start is rejected and has no effect."""
    with _second_controller(
        bench, _bare(bench.system, *(e.event for e in bench.system.events))
    ) as other:
        for action in ("stop", "e-stop", "power-loss"):
            other.controller.perform(action)
            other.run(halt_timeout(other))
            link = other.motion()
            link.send(end_as_request(other, 3, unit_of(other)))
            reply = messages.decode(link.expect_reply(3, "the end frame is answered"))
            # Without its event routine, an emergency stop is not reported.
            unseen = action == "e-stop" and not other.setting.dialect.e_stop_routines
            if reply != messages.RawRefused(RawReason.NOT_EXECUTING, -1, 0) and not unseen:
                raise CheckFailed(f"{action} of a driver without signals, a trajectory: {reply}")
            other.start_again()
            other.assert_at_rest(
                halt_timeout(other), f"{action} of a driver without signals, then Start"
            )
            _works(other, link)
            link.close(then=0.3)


@case("motion-task-cannot", "the motion task cannot drop its path, or not take back its own stop")
def _cannot(bench: Bench) -> None:
    """Reject the restart of motion: reported once, with the reason.

    The driver recovers as soon as the restart is possible.
    """
    link = bench.motion()
    for instruction, title in (
        ("ClearPath", "ROS: the motion task does not answer"),
        ("StartMove", STAYS_STOPPED),
    ):
        _moves(bench, link)
        ends = fails(bench, "ROS_motion", instruction, "ERR_PATH_STOP", 10**6)
        if instruction == "ClearPath":
            link.stop()
        else:
            bench.controller.perform("stop")
            bench.wait_until_standing(1)
            bench.controller.perform("start")
        bench.wait_until_standing(1)
        last, meter = bench.last_event, CpuMeter(bench)
        bench.assert_at_rest(2.5, f"{instruction} of the motion task fails")
        meter.end(f"while {instruction} of the motion task fails")
        log_entries = [
            e.title for e in bench.controller.log.since(last) if e.title.startswith("ROS")
        ]
        if log_entries != [title]:
            raise CheckFailed(
                f"{instruction} of the motion task fails, the event log says {log_entries}"
            )
        ends()
        bench.run(halt_timeout(bench))
        link = link if not link.lost else bench.motion()
        _works(bench, link)


def _crept(bench: Bench, current: Position, wait: float, when: str) -> None:
    """Check that Start moved the robot no further than unavoidable.

    Start sets the path in motion, and random order decides which task continues first. During a
    `wait` of the event routine an axis accelerates, and brakes as long: at most a t^2, less with
    its ramps. With a fixed order the driver stops first, and nothing moves.
    """
    if wait > soon(bench):
        raise CheckFailed(f"{when}: the robot is stopped after {wait:.3f} s")
    for number, (joint, a, b) in enumerate(
        zip(bench.group.joints, current, bench.position, strict=True), 1
    ):
        if abs(b - a) > joint.acceleration * wait * wait + SETTLED:
            raise CheckFailed(
                f"{when}: in {1000 * wait:.1f} ms joint {number} went on by {b - a:.5f}"
            )


@case("start-alone", "event routines drop the path by themselves", "R7a", background=True)
def _start_alone(bench: Bench) -> None:
    """Check that the Start and emergency stop routines each clear the path."""
    with _second_controller(bench, _bare(bench.system, "START", "RESTART", "QSTOP")) as other:
        watcher, link, orders = other.watcher(), other.motion(), watched_orders(other)
        for action in ("stop", "e-stop", "stop of the supervisor"):
            _moves(other, link)
            if action in ("stop", "e-stop"):
                other.controller.perform(action)
            else:
                # It ends, and the program stops with it.
                fails(other, "ROS_supervisor", "OpMode", "ERR_OUTOFBND")
            other.wait_until_standing(1)
            other.run(halt_timeout(other))
            if action == "e-stop" and other.setting.dialect.e_stop_routines:
                _ended(other, watcher, RawReason.PROGRAM_STOPPED, action)
            current, since = other.position, other.now
            other.start_again()
            if other.setting.random_schedule:
                other.run(0.3)
                stops = [order.time for order in orders if order.time >= since]
                _crept(other, current, min(stops, default=since) - since, f"{action}, then Start")
            other.assert_at_rest(halt_timeout(other), f"{action}, then Start")
            _ended(other, watcher, RawReason.PROGRAM_STOPPED, f"{action}, then Start")
            if action in ("stop", "e-stop"):
                _works(other, link)


@case("without-routines", "no event routine, and counters that begin anew", "R7a", background=True)
def _without_routines(bench: Bench) -> None:
    """Remove event routines but keep signals: the supervisor ends all.

    Counters restart.
    """
    with _second_controller(bench, replace(bench.system, events=()), early=True) as other:
        view = other.controller.task(other.task("ROS_supervisor"))
        set_counters(other, WRAP - 2)
        # Old requests, and a ring whose counters restart in the middle.
        view[datum(other, "ros_stop_done")] = WRAP - 4
        for name in ("ros_head", "ros_tail"):
            view[datum(other, name)] = WRAP - 64
        watcher, link = other.watcher(), other.motion()
        control = other.control() if other.group.ports.control else None
        for number in (WRAP - 1, 0):
            _pauses_at_its_end(other, watcher, link, control)
            if other.progress(watcher).trajectory != number:
                raise CheckFailed(f"the last trajectory was {number}, {other.progress(watcher)}")
        _refills(other, link)
        for action, reason in (
            ("stop", RawReason.PROGRAM_STOPPED),
            ("e-stop", RawReason.EMERGENCY_STOP),
            ("motors-off", RawReason.MOTORS_OFF),
        ):
            _moves(other, link)
            if control is not None:
                _pause(other, control, 1)
            other.controller.perform(action)
            if control is not None:
                reply = control.ask(messages.RawPause(0))
                # If a task's turn ends at a PERS, the supervisor may have ended it already.
                reasons = (reason, RawReason.IDLE) if other.setting.switch_at_pers else (reason,)
                if reply not in [messages.RawNotDone(reason) for reason in reasons]:
                    raise CheckFailed(f"{action}, and right after it the end of a pause: {reply}")
            other.wait_until_standing(1)
            other.run(halt_timeout(other))
            _ended(other, watcher, reason, f"{action} without event routines")
            other.start_again()
            other.assert_at_rest(
                halt_timeout(other), f"{action} without event routines, then Start"
            )
            _works(other, link)
        _moves(other, link)
        other.controller.perform("power-loss")
        other.run(6)
        control = other.control() if control is not None else None
        other.start_again()
        other.assert_at_rest(2, "a power failure without event routines, then Start")
        if control is not None:
            stopped = control.expect(messages.RawStopped, 1, "STOPPED arrives")
            if stopped.reason != RawReason.POWER_FAILURE:
                raise CheckFailed(f"a power failure has ended a trajectory, STOPPED says {stopped}")
        _works(other, other.motion())


def _pause(bench: Bench, control: RawLink, paused: int) -> None:
    reply = control.ask(messages.RawPause(paused))
    bench.run(0.1)
    if reply != messages.RawAcknowledged() or bench.standing != bool(paused):
        raise CheckFailed(
            f"PAUSE {paused} is answered by {reply}, the robot is at rest: {bench.standing}"
        )


def _pauses_at_its_end(
    bench: Bench, watcher: RawLink, link: RawLink, control: RawLink | None
) -> None:
    """Pause a trajectory on its path, and in the stay at its end."""
    unit = unit_of(bench)
    path = bench.wave(2, duration=unit)
    begins(bench, link, [*path, (path[1][0], 2 * unit)])
    if control is not None:
        for paused in (1, 0):
            _pause(bench, control, paused)
    bench.wait_until_at(path[1][0], unit + 1)
    if control is not None:
        _pause(bench, control, 1)
        bench.run(2 * bench.config.state_period)
        if bench.status(watcher).motion_possible:
            raise CheckFailed("a trajectory is paused, STATUS says that another one may come")
    bench.run(2.5 * unit)
    reply, status = bench.progress(watcher), bench.status(watcher)
    if (reply.state, status.motion_possible) != (RawTrajectoryState.DONE, 1):
        raise CheckFailed(
            f"a trajectory that was paused in its last stay is over: {reply}, {status}"
        )


def _refills(bench: Bench, link: RawLink) -> None:
    """Execute more points than the ring holds, after a pause."""
    count = bench.config.trajectory.ring + 12
    if count > bench.config.trajectory.capacity:
        return
    seconds = max(0.1, 1.05 * bench.config.trajectory.min_segment)
    bench.start_motion(link, bench.wave(count, duration=seconds, size=0.01), 20 * seconds)
    if bench.standing:
        raise CheckFailed("a trajectory longer than the ring stops on its way")
    link.stop()
    bench.wait_until_standing(1)
    bench.run(halt_timeout(bench))


@case("stale-build", "a module was exchanged, and its task shows what it did")
def _stale_build(bench: Bench) -> None:
    """Load a module of another build into a task with the right one before."""
    build = bench.system.build_id.encode()
    path, data = next(
        (m.path, m.data)
        for t in bench.system.tasks
        if t.name == bench.task("ROS_motion")
        for m in t.modules
        if m.name == "ROS_motion"
    )
    mixed = with_module(bench.system, path, data.replace(build, b"0123456789ab"))
    with _second_controller(bench, mixed, early=True) as other:
        task = other.controller.task(other.task("ROS_motion"))
        task[datum(other, "ros_task_build_motion")] = bench.system.build_id
        watcher, link = other.watcher(), other.motion()
        link.send(other.download(other.wave(3)))
        other.assert_at_rest(1, "modules of the motion task are of different builds")
        reply = other.progress(watcher)
        if (reply.state, reply.reason) != (RawTrajectoryState.REFUSED, RawReason.BUILD_MISMATCH):
            raise CheckFailed(f"modules of the motion task are of different builds, {reply}")
