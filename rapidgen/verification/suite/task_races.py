"""Races: stops, trajectories and halts at each statement of the driver."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import fields, replace

from rapidgen.rapid import parse
from rapidgen.rapid.syntax.nodes import Node
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    JOINT_TRAJ_PT,
    POINTS,
    RawReason,
    RawTrajectoryState,
    decode,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.suite.control import done
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.suite.state_port import rounds
from rapidgen.verification.testbench import Bench

case = SuiteGroup("faults")


@contextmanager
def _stepped(bench: Bench) -> Iterator[Bench]:
    """Return another controller, which can be stopped at a statement."""
    with bench.second_controller(
        bench.system, setting=replace(bench.setting, coverage=True)
    ) as other:
        yield other
        other.run(1.5)
        other.assert_moves_through(other.motion(), other.wave(4))
        other.assert_healthy()


def _lines(bench: Bench, module: str, *routines: str) -> list[int]:
    """Return the first lines of the statements of some routines."""
    data = next(m.data for t in bench.system.tasks for m in t.modules if m.name == module)
    tree = parse(data)
    result: set[int] = set()

    def look_into(node: Node) -> None:
        for field in fields(node):
            value = getattr(node, field.name)
            for one in value if isinstance(value, list) else [value]:
                if isinstance(one, Node):
                    if field.name in ("body", "otherwise"):
                        result.add(tree.source.line(one.first))
                    look_into(one)

    for routine in tree.routines:
        if routine.name in routines:
            look_into(routine)
    return sorted(result)


def _once_at(
    bench: Bench, module: str, place: tuple[str, int], count: int, act: Callable[[], None]
) -> list[float]:
    """Call `act` at a statement's `count`-th execution; return the times."""
    came: list[float] = []

    def reached() -> None:
        if not came:
            came.append(bench.now)
            act()

    bench.controller.before_statement(bench.task(module), *place, count, reached)
    return came


@case(
    "stop-every-statement",
    "a program stop at each statement of the motion task",
    "R7a",
    once=True,
)
def _stopped_at_every_statement(bench: Bench) -> None:
    """Stop and restart the program at each statement of the motion task.

    With Start, or PP to main and Start.
    """
    with _stepped(bench) as other:
        link = other.motion()
        other.assert_moves_through(link, other.wave(4))
        reached = other.lines()
        modules = next(t for t in other.system.tasks if t.name == other.group.task).modules
        places = [
            (module.name, line)
            for module in modules
            for line, hits in sorted(reached.get(module.path, {}).items())
            if hits
        ]
        for number, place in enumerate(places):
            link = other.motion()
            other.run(1.1)
            came = _once_at(
                other, "ROS_motion", place, 1 + number % 2,
                lambda: other.controller.perform("stop"),
            )  # fmt: skip
            since = other.now
            points = other.wave(5, duration=0.25)
            link.send(other.download(points))
            _is_over(other, came)
            other.executed(points, since)
            for action in ("pp-to-main",) if number % 2 else ():
                other.controller.perform(action)
                other.run(0.05)
            other.start_again()
            other.assert_at_rest(1.5, f"the program was stopped at {place} and started again")
            link.close()


def _is_over(bench: Bench, came: list[float]) -> None:
    """Wait for the event at a statement, if any, and for standstill."""
    bench.controller.run_until(lambda: bool(came), timeout=3)
    came.append(bench.now)
    bench.wait_until_standing(5)


@case(
    "wire-stop-every-statement",
    "STOP and a program stop at each statement of the motion task in a stream",
    "R5, R7b",
    once=True,
    needs="stream",
)
def _stream_stopped_at_every_statement(bench: Bench) -> None:
    """Stop streams that run, starve and end, at each statement."""
    routines = ("next_point", "wait_for_points", "finish_trajectory")
    with _stepped(bench) as other:
        for number, line in enumerate(2 * _lines(other, "ROS_motion", *routines)):
            link = other.motion()
            other.run(1.1)
            # While commissioning the servers stop with the program: the remaining data gets no
            # reply.
            by_wire = number % 2 == 0 or other.config.commissioning
            stream, since = Streamer(other, link), other.now

            def act(link: RawLink = link, by_wire: bool = by_wire) -> None:
                if by_wire:
                    link.at_once(STOP)
                else:
                    other.controller.perform("stop")

            came = _once_at(other, "ROS_motion", ("ROS_motion", line), 1 + number % 3, act)
            points = other.wave(6, duration=0.2)
            stream.put(points[:3], BEGIN | FLUSH)
            other.run(1)
            stream.put(points[3:], END)
            _is_over(other, came)
            other.executed(points, since)
            if not by_wire:
                other.start_again()
            elif came[0] != came[-1]:
                other.until(lambda: _is_answered(link), 2, f"STOP at line {line}")  # noqa: B023
            other.assert_at_rest(1.5, f"it was stopped at line {line} of the motion task")
            link.close()


def _is_answered(link: RawLink) -> bool:
    """True if STOP got a plain success reply."""
    return any(
        frame.number == JOINT_TRAJ_PT and decode(frame) == messages.RawAcknowledged()
        for _, frame in link.frames
    )


@case(
    "begin-every-statement",
    "STOP over the control port at each statement of a beginning",
    "R7b",
    once=True,
    needs="control",
)
def _stopped_at_every_statement_of_a_beginning(bench: Bench) -> None:
    """Stop at each statement of a start: nothing moves after the reply."""
    with _stepped(bench) as other:
        control = other.control()
        for module, routines in (
            ("ROS_motionServer", ("ROS_start_motion", "ROS_blocker")),
            ("ROS_stream", ("read_points",)),
        ):
            for line in _lines(other, module, *routines):
                link = other.motion()
                other.run(1.1)
                control.read()
                came = _once_at(
                    other, "ROS_motionServer", (module, line), 1, lambda: control.at_once(STOP)
                )
                link.send(Streamer(other, link).frame(other.wave(20, duration=0.2), BEGIN))
                link.reply(POINTS, 2)
                if not came:
                    other.run(0.2)
                if came:
                    done(control.reply(JOINT_TRAJ_PT), f"STOP at line {line} of {module}")
                    other.wait_until_at_rest(1, 1, f"STOP came at line {line} of {module}")
                else:
                    link.send(STOP)
                    other.wait_until_standing(2)
                came.append(other.now)
                link.close(then=0.1)


@case(
    "resume-every-statement",
    "STOP at each statement with which a paused robot goes on",
    "R7b",
    once=True,
    needs="control",
)
def _stopped_at_every_statement_of_going_on(bench: Bench) -> None:
    with _stepped(bench) as other:
        control, link = other.control(), other.motion()
        other.run(0.5)
        for line in _lines(other, "ROS_supervisor", "resume"):
            other.start_motion(link, other.wave(12), 0.3)
            control.ask(messages.RawPause(1))
            other.wait_until_standing(2)
            came = _once_at(
                other, "ROS_supervisor", ("ROS_supervisor", line), 1, lambda: link.at_once(STOP)
            )
            control.ask(messages.RawPause(0))
            if not came:
                came.append(other.now)
                link.send(STOP)
            link.reply(JOINT_TRAJ_PT)
            other.wait_until_at_rest(
                2, 1, f"STOP came at line {line} of the supervisor, which ended a pause"
            )
            other.run(halt_timeout(other))


@case(
    "progress-every-statement",
    "PROGRESS is of one trajectory, whatever statement a task is at",
    once=True,
)
def _progress_at_every_statement(bench: Bench) -> None:
    """Check PROGRESS at every statement: no mix of two trajectories."""
    far = bench.group.joints[0].upper + 1
    with _stepped(bench) as other:
        link, watcher = other.motion(), other.watcher()
        for module, places, refused in (
            ("ROS_stateServer", (("ROS_stateServer", "send_state"),), True),
            (
                "ROS_stateServer",
                (("ROS_server", "ROS_read_progress"), ("ROS_server", "read_trajectory")),
                True,
            ),
            ("ROS_motionServer", (("ROS_motionServer", "ROS_new_trajectory"),), False),
            ("ROS_motionServer", (("ROS_motionServer", "ROS_start_motion"),), False),
            ("ROS_motionServer", (("ROS_motionServer", "start_motion"),), False),
            ("ROS_motion", (("ROS_motion", "next_point"),), False),
        ):
            for home, routine in places:
                for line in _lines(other, home, routine):
                    _held_at(other, link, watcher, (module, home, line), far if refused else None)


def _held_at(
    bench: Bench,
    link: RawLink,
    watcher: RawLink,
    place: tuple[str, str, int],
    far: float | None,
) -> None:
    """Hold a task at a statement during two trajectories.

    The first is good, the second good or not.
    """
    module, home, line = place
    current = bench.position
    link.send(bench.download(bench.wave(3, duration=0.2)))
    bench.wait_until_moving(2)
    bench.wait_until_standing(5)
    bench.run(2 * bench.config.state_period)
    watcher.read()
    before = bench.progress(watcher)
    if before[1:] != (RawTrajectoryState.DONE, 3, 3, 3, 0, -1, 0):
        raise CheckFailed(f"three points are executed, PROGRESS says {before}")
    target = bench.position
    beyond = [] if far is None else [((far, *current[1:]), 0.5)]
    second = bench.download([(target, 9.0), (current, 0.5), *beyond])
    task, now = bench.rapid_task(module), bench.now

    def held() -> None:
        if module == "ROS_stateServer":
            link.at_once(second)
        task.hold()
        # One or two PROGRESS, and less than the time that counts as a task's end.
        bench.controller.scheduler.after(120_000_000, task.release)

    came = _once_at(bench, module, (home, line), 1, held)
    if module != "ROS_stateServer":
        link.send(second)
    bench.run(1)
    if not came and module == "ROS_stateServer":
        link.send(second)
    came.append(bench.now)
    bench.wait_until_standing(3)
    bench.run(3 * bench.config.state_period)
    number = before.trajectory + 1
    reply = [
        content
        for one in rounds(watcher, now)
        for frame in one.frames
        if isinstance(content := decode(frame), messages.RawProgress)
    ]
    where = f"{module} was held at {home}:{line}"
    _fits(reply, before, number, where, refused=far is not None)


def _fits(
    reply: Sequence[messages.RawProgress],
    before: messages.RawProgress,
    number: int,
    where: str,
    *,
    refused: bool,
) -> None:
    last = (number, RawTrajectoryState.DONE, 2, 2, 2, 0, -1, 0)
    if refused:
        last = (number, RawTrajectoryState.REFUSED, 2, 0, 0, RawReason.JOINT_LIMIT, 2, 1)
    if not reply or reply[-1] != last:
        raise CheckFailed(f"{where}: wanted {last}, PROGRESS says {reply[-1:]}")
    for one in reply:
        if one in (before, last):
            continue
        good = (
            one.trajectory == number
            and one.state in (RawTrajectoryState.RECEIVING, RawTrajectoryState.MOVING)
            and one.reached <= one.planned <= one.received <= 3
            and (one.state != RawTrajectoryState.RECEIVING or one.planned == 0)
            and one[5:] == (0, -1, 0)
        )
        if not good or (refused and one.state != RawTrajectoryState.RECEIVING):
            raise CheckFailed(f"{where}: PROGRESS says {one}")
