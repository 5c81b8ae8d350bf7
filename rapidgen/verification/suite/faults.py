"""Faults of cells: stops at statements, stale data, files, two robots."""

import random
from dataclasses import replace
from itertools import pairwise

from rapidgen.diagnostics import DiagnosticError
from rapidgen.runtime.values import PersistentCell
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, distance
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.testbench import Bench, with_module

case = SuiteGroup("faults")


@case("stop-and-more", "STOP and a new trajectory in one packet", "R5")
def _stop_and_more_in_one_packet(bench: Bench) -> None:
    link = bench.motion()
    for delay in (0.0, 0.4):
        first, second = bench.wave(8), bench.wave(5)
        link.send(bench.download(first))
        bench.run(delay)
        # The trajectory starts at the robot's initial position.
        link.send(STOP + bench.download(second))
        link.expect_reply(3, "STOP with a trajectory after it is answered")
        bench.run(6)
        bench.wait_until_standing(20)
        at_end = distance(bench.position, second[-1][0]) < 1e-3
        if not delay and not at_end:
            raise CheckFailed("a trajectory in the packet of a STOP is not executed")
        bench.assert_at_rest(2, "all that was sent is over")
        bench.assert_moves_through(link, bench.wave(3))


@case("loop", "a way through its own end", "C6")
def _loop(bench: Bench) -> None:
    """Pass the end point of a loop: the trajectory is not done there."""
    watcher, link = bench.watcher(), bench.motion()
    out = bench.wave(5)
    points: list[Point] = [*out, *((p, 0.4) for p, _ in reversed(out[:-1]))]
    points += [(p, 0.4) for p, _ in out[1:3]]
    since = bench.now
    bench.start_motion(link, points)
    # The first move may start before a check could see it.
    while bench.progress(watcher).state in (
        RawTrajectoryState.RECEIVING,
        RawTrajectoryState.MOVING,
    ):
        if bench.now - since > 20:
            raise CheckFailed("a loop does not end")
    if bench.now - since < sum(d for _, d in points[1:]) - 0.5:
        raise CheckFailed("a loop is reported as done before it is")
    bench.wait_until_at(points[-1][0], 5)
    bench.followed([p for p, _ in points], since=since)
    moved = [p for t, p in bench.track if t >= since]
    if min(distance(p, out[-1][0]) for p in moved) > 0.05:
        raise CheckFailed("the far end of a loop was left out")


@case("close-points", "zones wider than segments, points at no distance", "R9")
def _close_points(bench: Bench) -> None:
    """Send zones wider than segments, and points at negligible distances."""
    link = bench.motion()
    shortest = max(0.15, 1.05 * bench.config.trajectory.min_segment)
    for size in (2e-3, 1e-4, 1e-6):
        current = bench.position
        points: list[Point] = [(current, 10.0)]
        for number in range(1, 20):
            step = size * number
            away = (
                h + (step if j.upper - h > h - j.lower else -step)
                for h, j in zip(current, bench.group.joints, strict=True)
            )
            points.append((tuple(away), shortest))
        since = bench.now
        link.send(bench.download(points))
        bench.wait_until_at(points[-1][0], 30)
        bench.followed([p for p, _ in points], since=since, corner=2 * size + 1e-4)
        bench.run(3)
        took = max(t for t, _ in bench.track) - since
        if took > 20 * shortest + 3:
            raise CheckFailed(f"{19 * shortest:.1f} s of short segments took {took:.1f} s")
        bench.assert_moves_through(link, bench.wave(3))


@case("override", "a speed override of 50 %")
def _override(bench: Bench) -> None:
    """Set half the speed override: the same path, in twice the time."""
    group = bench.motion_group
    link = bench.motion()
    accepted = []
    for override in (1.0, 0.5):
        group.override = override
        points, since = bench.wave(6), bench.now
        bench.assert_moves_through(link, points)
        accepted.append(bench.now - since)
    group.override = 1.0
    if not 1.6 * accepted[0] - 0.5 < accepted[1] < 2.4 * accepted[0] + 0.5:
        raise CheckFailed(f"at 50 % {accepted[0]:.2f} s became {accepted[1]:.2f} s")


@case("manual-speed", "a trajectory in manual mode", background=True)
def _manual_mode(bench: Bench) -> None:
    """Start in manual mode by hand: the trajectory runs more slowly."""
    bench.run(0.5)
    bench.controller.perform("manual")
    for action in ("motors-on", "start"):
        bench.controller.perform(action)
    bench.run(1)
    state, link = bench.state(), bench.motion()
    if bench.status(state).motion_possible != 1:
        raise CheckFailed("in manual mode, motors on, program running, no motion is possible")
    bench.assert_moves_through(link, bench.wave(5, duration=1.0))


def _garbled(value: object, chance: random.Random) -> object:
    if isinstance(value, bool):
        return chance.random() < 0.5
    if isinstance(value, int | float):
        return chance.randrange(0, 300)
    return value


@case("stale-data", "whatever persistent data hold at the start", "R7a", once=True)
def _stale_data(bench: Bench) -> None:
    """Start with any lock, ring or counter data in PERS: no motion."""
    chance = random.Random(bench.setting.seed)
    for _ in range(6):
        with bench.second_controller(bench.system) as other:
            cells = other.controller.shared.cells.values()
            for cell in cells:
                _fill(cell, other, chance)
            before = other.position
            other.run(4)
            if distance(before, other.position) > 1e-4:
                raise CheckFailed("the robot moved at the start, by what its data happened to hold")
            link = other.motion()
            other.assert_moves_through(link, other.wave(4))
            other.start_motion(link, other.wave(8))
            link.stop()
            other.wait_until_standing(5)
            other.assert_moves_through(link, other.wave(3))
            other.assert_healthy()


def _fill(cell: PersistentCell, bench: Bench, chance: random.Random) -> None:
    if "ros_ring" in cell.name.lower() and cell.dims:
        for point in cell.v.values():
            point.trajectory, point.index = chance.randrange(0, 300), chance.randrange(1, 9)
            point.duration = 1.0
            for n, axis in enumerate(("rax_1", "rax_2", "rax_3")):
                setattr(point.target.robax, axis, float(5 * n + chance.randrange(0, 5)))
    elif not cell.dims and cell.name.lower().startswith("ros_"):
        cell.set(_garbled(cell.v, chance))


@case("half-files", "a module that was cut on its way", once=True)
def _half_files(bench: Bench) -> None:
    """Truncate a module: its task does not load, or nothing moves."""
    for share in (0.3, 0.7, 0.95):
        for path, data in sorted(_files(bench).items()):
            half = data[: int(share * len(data))]
            _moves_nothing(bench, with_module(bench.system, path, half), f"half of {path}")


@case("second-main", "another module with a main")
def _second_main(bench: Bench) -> None:
    """Load a second main first: that one runs, and no trajectory is accepted."""
    text = b"MODULE other\n    PROC main()\n        WaitTime 1;\n    ENDPROC\nENDMODULE\n"
    extra = ModuleFile("other", "HOME/other.mod", text, "HOME:/other.mod")
    tasks = tuple(
        replace(task, modules=(extra, *task.modules)) if task.name == bench.group.task else task
        for task in bench.system.tasks
    )
    _moves_nothing(bench, replace(bench.system, tasks=tasks), "a second main")


def _files(bench: Bench) -> dict[str, bytes]:
    unit = bench.mechanical_unit
    return {
        module.path: module.data
        for task in bench.system.tasks
        for module in task.modules
        if task.mechanical_unit_group == unit
    }


def _moves_nothing(bench: Bench, system: System, what: str) -> None:
    try:
        other = bench.second_controller(system)
    except DiagnosticError:
        return
    try:
        port = other.group.ports.motion
        other.run(3)
        if port in other.controller.network.listeners:
            link = other.motion()
            link.send(other.download(other.wave(4)))
        other.assert_at_rest(4, f"{what} was loaded")
    finally:
        other.close()


@case("two-groups", "several groups at the same time", "R20")
def _two_groups(bench: Bench) -> None:
    """Move groups at the same time; STOP for one does not stop another."""
    if len(bench.config.groups) < 2:
        raise NotApplicable("there is one group")
    other = bench.of_group((bench.setting.group + 1) % len(bench.config.groups))
    mine, theirs = bench.motion(), other.motion()
    for stopping in (False, True):
        first, second = bench.wave(8), other.wave(8)
        mine.send(bench.download(first))
        theirs.send(other.download(second))
        bench.until(lambda: not bench.standing and not other.standing, 5, "both groups move")
        if stopping:
            mine.stop()
            bench.wait_until_standing(3)
            if distance(bench.position, first[-1][0]) < 1e-3:
                raise CheckFailed("a group went on after its STOP")
        else:
            bench.wait_until_at(first[-1][0])
        other.wait_until_at(second[-1][0])
    mine.close()
    bench.run(1.5)
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@case("even-speed", "no slowing down at points of a straight way", "R9")
def _even(bench: Bench) -> None:
    """Move at constant speed: points do not slow down the robot."""
    points = bench.wave(2)
    start, end = points[0][0], points[1][0]
    count, seconds = 12, max(0.25, 1.1 * bench.config.trajectory.min_segment)
    path = [
        tuple(a + (b - a) * n / count for a, b in zip(start, end, strict=True))
        for n in range(count + 1)
    ]
    link, since = bench.motion(), bench.now
    link.send(bench.download([(p, seconds if n else 10.0) for n, p in enumerate(path)]))
    bench.wait_until_at(end, 30)
    track = [(t, p) for t, p in bench.track if t >= since]
    started, finished = track[0][0] + 3 * seconds, track[-1][0] - 3 * seconds
    speeds = [
        distance(a, b) / (t2 - t1)
        for (t1, a), (t2, b) in pairwise(track)
        if started < t1 and t2 < finished and t2 - t1 > 1e-3
    ]
    if not speeds:
        raise CheckFailed("on a straight way the robot hardly moved")
    if min(speeds) < 0.5 * max(speeds):
        raise CheckFailed(
            f"on a straight way the robot goes from {max(speeds):.3f} down to {min(speeds):.3f} "
            "rad/s at its points"
        )
