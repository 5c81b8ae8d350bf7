"""SPEED and the order of moves: at the order, in short moves, too late."""

from dataclasses import replace
from itertools import product

from rapidgen.motion.moves import Move
from rapidgen.runtime.task.task import Task
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, at_call, fails, wrapped
from rapidgen.verification.messages import RawComm
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import changed, distance, inward
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import Programmer
from rapidgen.verification.suite.control import done
from rapidgen.verification.suite.speed import (
    LONG,
    RATE,
    as_asked,
    asks_as_it_begins,
    paces,
    straight,
    straight_moves,
)
from rapidgen.verification.testbench import Bench

case = SuiteGroup("speed", needs="control")


@case("speed-before-order", "a speed that comes just before a long move is ordered holds for it")
def _before_the_order(bench: Bench) -> None:
    """Send SPEED after a move's time is computed.

    The driver slows it down like an ordered move, even if the move starts much later.
    """
    control, link = bench.control(), bench.motion()
    short = max(0.12, 1.05 * bench.config.trajectory.min_segment)
    for percent in (50.0, 5.0):
        line = straight(bench, 9, short)
        current, step = line[0][0], line[1][0][0] - line[0][0][0]
        far = changed(line[-1][0], 0, line[-1][0][0] + step * 1.5 / short)
        last = changed(far, 0, far[0] + 4 * step), 4 * short
        points = [*line, (far, 1.5), last]
        since: list[float] = []

        def ask(expected: float = percent, since: list[float] = since) -> None:
            since.append(bench.now)
            control.at_once(messages.encode(messages.RawSpeed(expected), RawComm.REQUEST))
            bench.rapid_task("ROS_motion").sleep(0.05)

        # Interrupts are off at the start of a trajectory, and for each move before its order.
        at_call(bench, "ROS_motion", "IDisable", 1 + len(line), ask)
        started = bench.now
        bench.start_motion(link, points)
        bench.arrives(points, started, 100)
        # A stop between two moves is a move of 0.1 s, and may be slowed down as well.
        as_asked(bench, since[0], percent, 1.5, 2 if percent > 10 else 6)
        bench.run(0.5)
        bench.assert_moves_through(link, bench.way_to(current))
        bench.run(0.5)


@case("speed-between", "a speed that comes as a trajectory begins is not held twice")
def _between(bench: Bench) -> None:
    """Send SPEED between short moves: all get their time."""
    control, link, group = bench.control(), bench.motion(), bench.motion_group
    bench.assert_moves_through(link, straight(bench, 2, 1.0))
    bench.run(0.5)
    refreshed: list[float] = []

    def received(move: Move) -> None:
        refreshed.append(group.refresh)

    asks_as_it_begins(bench, control, 50)
    group.listeners.append(received)
    points, since = straight(bench, 4, 1.0), bench.now
    bench.start_motion(link, points)
    bench.arrives(points, since, 30)
    group.listeners.remove(received)
    if refreshed != [1.0] * (len(points) - 1):
        raise CheckFailed(
            f"{len(points) - 1} moves with their time for SPEED 50, held to {refreshed}"
        )
    as_asked(bench, since, 50, 1.0)


@case("speed-of-short", "short moves get more time, and the robot does not stop between them")
def _of_short(bench: Bench) -> None:
    """Slow down short moves without SpeedRefresh, which would stop the robot."""
    if not bench.setting.corners_in_time:
        raise NotApplicable("tasks by lot are not in time for a corner")
    control, link = bench.control(), bench.motion()
    short = max(0.12, 1.05 * bench.config.trajectory.min_segment)
    if short > LONG:
        raise NotApplicable("`min_segment` allows no short moves")
    line = straight(bench, 26, short)
    # A long move before them no longer counts.
    points = [line[0], (line[6][0], 6 * short), *line[7:]]
    bench.start_motion(link, points, 10 * short)
    done(control.ask(messages.RawSpeed(50)), "SPEED 50")
    since = bench.now
    bench.until(lambda: distance(bench.position, points[-3][0]) < 5e-3, 30, "the last but two")
    if any(pace < 0.05 for *_, pace in paces(bench, since, RATE)):
        raise CheckFailed("short moves are slower, and the robot stops between them")
    bench.wait_until_at(points[-1][0], 10)


@case("speed-reached", "a move that was slowed down is reached before the next one begins")
def _reached_first(bench: Bench) -> None:
    """Report a slowed move's last point in its last move.

    It ends in a stop. If that stop fails, PROGRESS does not report the point.
    """
    control, watcher, link = bench.control(), bench.watcher(), bench.motion()
    line = straight(bench, 6, 0.6)
    current, first, second, last = (line[n][0] for n in (0, 1, 2, 5))
    points = [line[0], (first, 0.6), (second, 0.6), (last, 1.8)]
    moves = [
        replace(straight_moves(bench, 1, RATE * 0.6)[0], joints=p) for p in (first, second, last)
    ]
    program = [*(replace(move, zone=0.002) for move in moves[:-1]), moves[-1]]
    for what, is_good in product(("a trajectory", "a program"), (True, False)):
        if what == "a trajectory":
            bench.start_motion(link, points)
        elif bench.streams:
            Programmer(bench, link).takes(what, program)
        else:
            return
        bench.until(
            lambda: abs(bench.position[0] - current[0]) > 1.4 * abs(first[0] - current[0]), 10, what
        )
        done(control.ask(messages.RawSpeed(50)), f"SPEED of {what}")
        count = bench.progress(watcher).planned
        if is_good:
            bench.until(lambda: distance(bench.position, second) < 1e-3, 10, what)
            bench.run(1)
        else:
            fails(bench, "ROS_motion", "MoveAbsJ", "ERR_COLL_STOP")
            bench.wait_until_at_rest(5, 0.5, f"the end of a slower move of {what} has failed")
        reply = bench.progress(watcher)
        if (reply.planned, reply.reached) != (
            (count + 1, count) if is_good else (count, count - 1)
        ):
            raise CheckFailed(
                f"the end of a slower move of {what}, which {is_good=}, is reported as {reply}"
            )
        if is_good:
            bench.wait_until_at(last, 20)
        bench.run(0.3)
        bench.assert_moves_through(link, bench.way_to(current))


@case("speed-is-over", "a speed that comes after the last move leaves nothing to be ended", "R5")
def _is_over(bench: Bench) -> None:
    """Send SPEED in a stay at the end: the next trajectory starts normally."""
    current, log_entries = bench.position, _refreshes(bench)
    link = _asked_in_a_stay(bench, bench.motion())
    if any(value < 100 for _, value in log_entries) or bench.motion_group.refresh < 1:
        raise CheckFailed(f"nothing is left to be slowed down, SpeedRefresh: {log_entries}")
    bench.controller.perform("stop")
    bench.run(0.5)
    # By hand.
    bench.motion_group.jump(current)
    bench.start_again()
    link.close(then=1.5)
    link = bench.motion()
    target = changed(current, 1, inward(bench.group.joints[1], current[1], 0.05))
    bench.assert_moves_through(link, bench.way_to(target))
    if not bench.streams:
        return
    # The last instruction of an earlier program is not executed again.
    client = Programmer(bench, link)
    moves = straight_moves(bench, 2, RATE * 0.6)
    client.takes("a program", moves)
    bench.wait_until_at(moves[-1].joints, 60)
    _asked_in_a_stay(bench, link)
    moves, since = straight_moves(bench, 2, RATE * 0.6), bench.now
    started = bench.position
    client.takes("a program after a trajectory", moves)
    bench.wait_until_at(moves[-1].joints, 60)
    bench.followed([started, *(move.joints for move in moves)], since=since, corner=0.002)


def _asked_in_a_stay(bench: Bench, link: RawLink) -> RawLink:
    """Send SPEED in a stay at a trajectory's end; wait for the end."""
    control, points = bench.control(), straight(bench, 2, 1.0)
    bench.start_motion(link, [*points, (points[1][0], 2.0)])
    bench.wait_until_at(points[1][0], 5)
    # Until the motion task knows that the robot stands.
    bench.run(0.3 + 2 * bench.setting.motion.settle)
    done(control.ask(messages.RawSpeed(50)), "SPEED in a stay")
    bench.run(2.5)
    control.close()
    return link


@case("speed-said-enough", "SpeedRefresh is repeated as long as it may be lost, and no longer")
def _repeats_refresh(bench: Bench) -> None:
    """Repeat SpeedRefresh at full speed in the next trajectory, then stop."""
    control, link, log_entries = bench.control(), bench.motion(), _refreshes(bench)
    points = straight(bench, 2, 1.0)
    bench.start_motion(link, points, 0.3)
    done(control.ask(messages.RawSpeed(50)), "SPEED 50")
    if {value for _, value in log_entries} != {50.0}:
        raise CheckFailed(
            f"SPEED 50 of a move that is under way is confirmed, SpeedRefresh: {log_entries}"
        )
    bench.wait_until_at(points[-1][0], 20)
    bench.run(0.5)
    since, points = bench.now, straight(bench, 5, 1.0)
    bench.start_motion(link, points, 2.0)
    if not any(when > since for when, _ in log_entries):
        raise CheckFailed(
            "a speed is over, and SpeedRefresh has not followed while the robot moves"
        )
    enough = bench.now
    bench.wait_until_at(points[-1][0], 20)
    late = [when for when, _ in log_entries if enough < when < bench.now - 0.5]
    if late:
        raise CheckFailed(f"SpeedRefresh is repeated at {late}, 2 s after the start")


@case("speed-keeps-own", "SPEED multiplies the SpeedRefresh of the program, which is there again")
def _keeps_own(bench: Bench) -> None:
    """Persist SpeedRefresh: the operator's override stays unchanged."""
    motion = replace(bench.setting.motion, refresh_lasts=True, refresh_standing=True)
    setting = replace(bench.setting, motion=motion)
    with bench.second_controller(bench.system, setting=setting) as other:
        control, link, group = other.control(), other.motion(), other.motion_group
        group.refresh, group.override = 0.5, 0.8
        for percent in (50.0, 100.0):
            points = straight(other, 2, 1.0)
            since = other.now
            other.start_motion(link, points, 0.3)
            done(control.ask(messages.RawSpeed(percent)), "SPEED")
            if abs(group.refresh - 0.5 * percent / 100) > 1e-3:
                raise CheckFailed(f"SPEED {percent}, SpeedRefresh was 0.5 and is {group.refresh}")
            other.arrives(points, since, 100)
            other.run(1)
            other.start_motion(link, straight(other, 2, 0.5), 0.6)
            other.wait_until_standing(30)
            if (round(group.refresh, 3), group.override) != (0.5, 0.8):
                raise CheckFailed(
                    f"after SPEED the speeds are {group.refresh} and {group.override}"
                )


def _refreshes(bench: Bench) -> list[tuple[float, float]]:
    """Record times and values of the motion task's SpeedRefresh from now on."""
    log_entries: list[tuple[float, float]] = []

    def noted(as_before: Instruction) -> Instruction:
        def noting(task: Task, percent: float) -> object:
            log_entries.append((bench.now, percent))
            return as_before(task, percent)

        return noting

    wrapped(bench.rapid_task("ROS_motion"), "SpeedRefresh", noted)
    return log_entries
