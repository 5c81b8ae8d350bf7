"""The motion task from outside: steps of a trajectory, timing, ends."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest

from rapidgen.machine.event_log import EventType
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call, fails
from rapidgen.verification.messages import RawMode, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, distance, inward
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.testbench import Bench

case = SuiteGroup("moving")

_CLOSE = 0.06
"""Maximum s between a change and its visibility."""
_EVER = 99.0


def soon(bench: Bench) -> float:
    """Return s in which the driver reacts if nothing delays it.

    With random task order one task may wait for the others.
    """
    waits = 0.15 if bench.setting.random_schedule else 0.12
    return waits + 0.06 * bench.setting.slowness


@dataclass(frozen=True, slots=True)
class _Step:
    """State reported from `since` to `until`, s after the motion's start."""

    since: float
    until: float
    planned: int
    reached: int
    state: RawTrajectoryState = RawTrajectoryState.MOVING


def unit_of(bench: Bench) -> float:
    """Return s of a segment that is long for one reading per state period."""
    return max(0.5, 5 * bench.config.state_period, 1.1 * bench.config.trajectory.min_segment)


def _scaled(unit: float, *steps: _Step) -> list[_Step]:
    return [_Step(s.since * unit, s.until * unit, s.planned, s.reached, s.state) for s in steps]


def _in_order(
    bench: Bench,
    started: float,
    reply: Sequence[tuple[float, RawTrajectoryState | int, int, int]],
    steps: Sequence[_Step],
) -> None:
    """Check that reported states follow the steps in order and in time."""
    # A robot may take time to settle at each stop point.
    late = _CLOSE + bench.setting.motion.settle * len(steps)
    seen, mixed, at = set(), set(), 0
    each = [(step.state, step.planned, step.reached) for step in steps]
    for when, *log_entries in reply:
        # A reply mixes two steps if the task's turn ends while it reads. Where a turn ends at each
        # PERS, several replies do.
        now, then = each[at], each[min(at + 1, len(each) - 1)]
        between = log_entries[0] in (now[0], then[0]) and all(
            a <= value <= b for value, a, b in zip(log_entries[1:], now[1:], then[1:], strict=True)
        )
        may_mix = bench.setting.switch_at_pers or at not in mixed
        if may_mix and between and tuple(log_entries) not in each[at:]:
            mixed.add(at)
            continue
        while at < len(steps) and tuple(log_entries) != each[at]:
            at += 1
        if at == len(steps):
            raise CheckFailed(
                f"{when - started:.3f} s after its beginning "
                f"a trajectory is reported in state {log_entries[0]} "
                f"with {log_entries[1]} points planned and {log_entries[2]} reached"
            )
        seen.add(at)
        if not steps[at].since - _CLOSE <= when - started <= steps[at].until + late:
            raise CheckFailed(f"{steps[at]} is reported {when - started:.3f} s after the start")
    missing = [step for number, step in enumerate(steps) if number not in seen]
    if missing:
        raise CheckFailed(f"not reported: {missing}")


def watched(
    link: RawLink, since: float
) -> list[tuple[float, messages.RawProgress, messages.RawStatus]]:
    """Return PROGRESS since `since`, with time and STATUS of the same round."""
    failures: list[tuple[float, messages.RawProgress, messages.RawStatus]] = []
    status: messages.RawStatus | None = None
    for when, frame in link.frames:
        content = messages.decode(frame) if when >= since else None
        if isinstance(content, messages.RawStatus):
            status = content
        elif isinstance(content, messages.RawProgress) and status is not None:
            failures.append((when, content, status))
    return failures


def _goes_by(
    bench: Bench, link: RawLink, started: float, trajectory: int, count: int, steps: Sequence[_Step]
) -> None:
    """Check PROGRESS and STATUS of each step of a good trajectory."""
    reply = watched(link, started + _CLOSE)
    _in_order(bench, started, [(t, p.state, p.planned, p.reached) for t, p, _ in reply], steps)
    over, lag = 0.0, 6 * bench.setting.motion.servo_lag
    following = [progress.state for _, progress, _ in reply[1:]]
    for (when, progress, status), then in zip_longest(reply, following):
        if (progress.trajectory, progress.received, *progress[5:]) != (trajectory, count, 0, -1, 0):
            raise CheckFailed(f"at {when:.3f} s trajectory {trajectory} is reported as {progress}")
        moving = [int(progress.state == RawTrajectoryState.MOVING)]
        over = over if over or moving[0] else when
        if when <= over + lag:
            # The first STATUS after the end may report the motion before it.
            moving.append(1)
        if bench.setting.switch_at_pers:
            # The server reads STATUS after PROGRESS: it may report a later state.
            moving.append(int(then == RawTrajectoryState.MOVING))
        if status not in [messages.RawStatus(1, 0, 0, 0, m, RawMode.AUTO, 1) for m in moving]:
            raise CheckFailed(f"at {when:.3f} s PROGRESS says {progress}, but STATUS {status}")


def begins_soon(bench: Bench, sent: float) -> float:
    """Return the start of the motion requested at `sent`; check its delay."""
    bench.wait_until_moving(2)
    if bench.now - sent > soon(bench) + 2 * bench.setting.motion.settle:
        raise CheckFailed(f"the robot begins to move {bench.now - sent:.3f} s after the end frame")
    return bench.now


def begins(bench: Bench, link: RawLink, points: Sequence[Point]) -> float:
    """Send a trajectory and return when its motion starts; check its delay."""
    sent = bench.now
    link.send(bench.download(points))
    return begins_soon(bench, sent)


class CpuMeter:
    """Processor time of the driver."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self.begin()

    def begin(self) -> None:
        """Start to count."""
        scheduler = self._bench.controller.scheduler
        self._now, self._idle = scheduler.now, scheduler.idle

    def end(self, doing: str) -> None:
        """Check that the processor time is small, as for a waiting driver."""
        scheduler, config = self._bench.controller.scheduler, self._bench.config
        fraction = 1 - (scheduler.idle - self._idle) / (scheduler.now - self._now)
        # The state server has some 3 ms of work in each period.
        little = len(config.groups) * (0.06 + 0.004 / config.state_period)
        if fraction > little * self._bench.setting.slowness:
            raise CheckFailed(f"{doing} the driver takes {fraction:.0%} of the processor")
        self.begin()


@case("step-by-step", "PROGRESS tells each step of a trajectory in its time")
def _step_by_step(bench: Bench) -> None:
    """Check progress at zones, stop points and stays, and the end."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    number, done = bench.progress(watcher).trajectory, RawTrajectoryState.DONE
    meter = CpuMeter(bench)
    for last in (True, False):
        path = bench.wave(6, duration=unit)
        points: list[Point] = [*path[:4], (path[3][0], unit), *path[4:]]
        ends = [_Step(6, 7, 8, 7), _Step(7, _EVER, 8, 8, done)]
        if last:
            points.append((path[5][0], unit))
        else:
            ends = [_Step(6, _EVER, 7, 7, done)]
        frames = bench.download(points)
        link.send(frames[:68])
        bench.run(0.3)
        meter.end("while points are awaited")
        sent = bench.now
        link.send(frames[68:])
        started = begins_soon(bench, sent)
        number += 1
        bench.run(8 * unit)
        meter.end("while the robot moves")
        steps = _scaled(
            unit,
            _Step(0, 1, 2, 1),
            _Step(0.3, 2, 3, 1),
            _Step(1.3, 3, 4, 2),
            _Step(3, 4, 5, 4),
            _Step(4, 5, 6, 5),
            _Step(4.3, 6, 7, 5),
            *ends,
        )
        _goes_by(bench, watcher, started, number, len(points), steps)
        bench.run(0.53)
        meter.end("when nothing is under way")
        # One point, sent twice, near the robot's position.
        target = tuple(
            inward(joint, current, 0.9 * bench.start_tolerance(joint))
            for joint, current in zip(bench.group.joints, bench.position, strict=True)
        )
        started = begins(bench, link, [(target, 2 * unit)] * 2)
        number += 1
        bench.run(3 * unit)
        steps = _scaled(unit, _Step(0, 2, 1, 0), _Step(2, _EVER, 2, 2, done))
        _goes_by(bench, watcher, started, number, 2, steps)


@case("stream-by-step", "each step of a stream in its time", "R9", needs="stream")
def _stream_by_step(bench: Bench) -> None:
    """Check progress of a stream that starves twice, and of a cut one."""
    watcher, unit = bench.watcher(), unit_of(bench)
    stream, meter = Streamer(bench), CpuMeter(bench)
    starved, done = RawTrajectoryState.STARVED, RawTrajectoryState.DONE
    points = bench.wave(4, duration=unit)
    reports: list[tuple[float, RawTrajectoryState | int, int, int]] = []

    def ask(seconds: float) -> None:
        until = bench.now + seconds
        while bench.now < until:
            stream.put(())
            reply = stream.accepted("a question")
            reports.append((bench.now, reply.state, reply.planned, reply.reached))
            bench.run(0.03)

    stream.put(points[:3], BEGIN | FLUSH)
    started = begins_soon(bench, bench.now)
    ask(2.5 * unit)
    meter.begin()
    bench.run(0.5)
    meter.end("while a stream waits for points")
    status = bench.status(watcher)
    if (status.in_motion, status.in_error) != (0, 0):
        raise CheckFailed(f"a stream waits for points, STATUS says {status}")
    more = bench.now - started
    stream.put(points[3:], FLUSH)
    ask(1.7 * unit)
    over = bench.now - started
    stream.put((), END)
    ask(0.2)
    steps = _scaled(unit, _Step(0, 1, 2, 1), _Step(0.3, 2, 3, 1), _Step(2, _EVER, 3, 3, starved))
    _in_order(
        bench,
        started,
        reports,
        [
            *steps,
            _Step(more, more + unit, 4, 3),
            _Step(more + unit, _EVER, 4, 4, starved),
            _Step(over, _EVER, 4, 4, done),
        ],
    )
    # The stream is cut: accepted points are executed, then it has failed.
    number = bench.progress(watcher).trajectory + 1
    stream.number, stream.sent = 2, 0
    points = bench.wave(3, duration=unit)
    stream.put(points[:2], BEGIN | FLUSH)
    started = begins_soon(bench, bench.now)
    bench.run(0.5 * unit)
    beyond = (bench.group.joints[0].upper + 1, *points[2][0][1:])
    stream.refuses(RawReason.JOINT_LIMIT, "joint 1 is outside its limits", [(beyond, 30.0)])
    bench.wait_until_at(points[1][0], 5)
    bench.run(2 * (bench.config.state_period + bench.setting.motion.settle))
    progress, status = bench.progress(watcher), bench.status(watcher)
    failed = (number, RawTrajectoryState.FAILED, 2, 2, 2, RawReason.JOINT_LIMIT, 2, 1)
    if progress != failed or (status.in_error, status.error_code, status.in_motion) != (1, 104, 0):
        raise CheckFailed(f"a stream was cut after two points, but {progress} and {status}")


def _cycles(bench: Bench) -> int:
    """Return how often the motion task's program has reached its end."""
    return bench.rapid_task("ROS_motion").cycles


def halt_timeout(bench: Bench) -> float:
    """s in which a halt is over, and STATUS has said so."""
    return soon(bench) + 2 * (bench.config.state_period + bench.setting.motion.settle)


def _over_soon(bench: Bench, watcher: RawLink, since: float, what: str) -> messages.RawProgress:
    """Check that PROGRESS and STATUS soon report a stopped trajectory."""
    bench.until(
        lambda: any(
            p.state == RawTrajectoryState.STOPPED and s.motion_possible == 1
            for _, p, s in watched(watcher, since)
        ),
        halt_timeout(bench),
        f"{what}: PROGRESS tells of it",
    )
    return watched(watcher, since)[-1][1]


def _reports_stop(bench: Bench, watcher: RawLink, since: float) -> None:
    bench.until(
        lambda: any(p.state == RawTrajectoryState.STOPPED for _, p, _ in watched(watcher, since)),
        3,
        "a path that cannot be cleared at once: PROGRESS tells of the stop",
    )


@case("halts", "how soon a stop is over, and that main never begins anew", "R5, R6")
def _halts(bench: Bench) -> None:
    """Stop at rest, in a stay and in a zone, and with a stuck path."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    cycles = _cycles(bench)
    # Some controllers continue a program after StopMove only when the robot has settled.
    latest = soon(bench)
    if bench.setting.motion.stop_waits:
        latest += 0.3 + bench.setting.motion.settle
    for _ in range(7):
        link.stop(latest, "STOP at a standstill is answered")
    begins(bench, link, bench.wave(4, duration=unit))
    bench.run(1.15 * unit)
    since = bench.now
    link.stop(latest, "STOP on the way is answered")
    reply = _over_soon(bench, watcher, since, "STOP on the way")
    if (reply.planned, reply.reached) != (3, 1):
        raise CheckFailed(f"STOP came between points 1 and 2, PROGRESS says {reply}")
    path = bench.wave(3, duration=unit)
    begins(bench, link, [*path[:2], (path[1][0], 5.0), path[2]])
    bench.wait_until_at(path[1][0], 5)
    bench.run(0.5)
    since = bench.now
    link.stop(latest, "STOP in a stay is answered")
    reply = _over_soon(bench, watcher, since, "STOP in a stay")
    if (reply.planned, reply.reached) != (3, 2):
        raise CheckFailed(f"STOP came in the stay after two points, PROGRESS says {reply}")
    for _ in range(2):
        begins(bench, link, bench.wave(5, duration=unit))
        bench.run(1.15 * unit)
        since = bench.now
        fails(bench, "ROS_motion", "ClearPath", "ERR_PATH_STOP", 6)
        link.send(STOP)
        _reports_stop(bench, watcher, since)
        bench.wait_until_at_rest(1, 1, "it was stopped, and its path not cleared at once")
        reply = _over_soon(bench, watcher, since, "a path that cannot be cleared at once")
        if (reply.planned, reply.reached) != (3, 1):
            raise CheckFailed(f"STOP came between points 1 and 2, PROGRESS says {reply}")
    if _cycles(bench) != cycles:
        raise CheckFailed("main of the motion task began anew")


@case("halted-twice", "another halt while main leaves a move", "R5, R7b")
def _halted_twice(bench: Bench) -> None:
    """Request a second halt while the trap leaves a move.

    The interrupt is raised again before main does anything else.
    """
    link, unit = bench.motion(), unit_of(bench)
    task = bench.rapid_task("ROS_motion")

    def ask() -> None:
        link.at_once(STOP)
        # Long enough for the motion server and for two interrupts.
        task.sleep(0.08)

    for call in (1, 2):
        begins(bench, link, bench.wave(5, duration=unit))
        bench.run(1.15 * unit)
        at_call(bench, "ROS_motion", "SkipWarn", call, ask)
        link.send(STOP)
        bench.wait_until_at_rest(2, 0.5, "it was stopped twice")
        bench.assert_healthy()
        bench.assert_moves_through(link, bench.wave(3))


def datum(bench: Bench, name: str) -> str:
    """Return the full name of a group's PERS.

    With several groups, names end in the group's number.
    """
    task = bench.rapid_task("ROS_motion")
    declared = task.program.modules["ros_common"].declarations
    return next(f"ROS_common:{key}" for key in declared if re.fullmatch(rf"{name}(_\d+)?", key))


@case("gives-up", "a fault on the way ends the trajectory there", "R11, R14")
def _gives_up(bench: Bench) -> None:
    """Fail a move, or leave a gap in the ring: the robot stops and reports."""
    watcher, link, unit = bench.watcher(), bench.motion(), unit_of(bench)
    number = bench.progress(watcher).trajectory
    task = bench.controller.task(bench.task("ROS_motion"))
    for error, reason in (
        ("ERR_COLL_STOP", RawReason.COLLISION),
        ("ERR_PATH_STOP", RawReason.MOTION_ERROR),
        ("", RawReason.INTERNAL),
    ):
        points, last = bench.wave(6, duration=unit), bench.last_event
        link.send(bench.download(points))
        number += 1
        started = begins_soon(bench, bench.now)
        if error:
            fails(bench, "ROS_motion", "MoveAbsJ", error, after=1)
        else:
            ring = task[datum(bench, "ros_ring")].values()
            next(p for p in ring if (p.trajectory, p.index) == (number, 4)).index = 5.0
        bench.wait_until_standing(5)
        # The axes come to rest after the controller's planned end.
        latest = 2 * unit + 0.1 + bench.setting.motion.servo_lag
        if bench.now - started > latest or distance(bench.position, points[2][0]) < 5e-4:
            raise CheckFailed(f"{reason.name} on the way to point 2, and the robot went on to it")
        bench.assert_at_rest(1, "its trajectory has failed")
        planned = 4 if error else 3
        expected = (number, RawTrajectoryState.FAILED, 6, planned, 2, reason, 2, 0)
        progress, status = bench.progress(watcher), bench.status(watcher)
        if progress != expected or status != (1, 0, reason, 1, 0, RawMode.AUTO, 1):
            raise CheckFailed(f"{reason.name}, wanted {expected}: {progress}, {status}")
        # The failed trajectory is over.
        points = bench.wave(2, duration=unit)
        link.send(bench.download(points))
        number += 1
        begins_soon(bench, bench.now)
        bench.wait_until_at(points[1][0], 2 * unit)
        bench.wait_until_standing(1)
        log_entries = [e for e in bench.controller.log.since(last) if e.type is EventType.ERROR]
        if len(log_entries) != 1 or log_entries[0].texts[:2] != (
            messages.text_of(reason),
            f"At point {planned - 1}.",
        ):
            raise CheckFailed(f"{reason.name}, the event log says {[str(e) for e in log_entries]}")
