"""Motion: moves planned per second of CPU, inverse kinematics, sampling.

    python benchmarks/motion.py

Limits: 5,000 dense linear moves planned a second, 50 µs a pose in closed form, and end times that
do not depend on the sampling rate.
"""

import time
from collections.abc import Callable
from math import cos, sin
from types import SimpleNamespace

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion import MotionGroup, MotionSystem
from rapidgen.motion.moves import CartesianMove, JointMove, Move, MoveSpeed, Zone
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import System, TaskSpec

HOME = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)
DENSE = Zone(tcp=0.001, orientation=0.0015, external=0.0015, angle=0.0026)
ZONE = Zone(tcp=0.01, orientation=0.015, external=0.015, angle=0.026)


def run(moves: Callable[[MotionGroup], list[Move]], period: float = 0.0) -> tuple[float, int, int]:
    """Return CPU s, end time in ns and process switches of a program."""
    config = load_config("irb120").groups[0]
    scheduler = Scheduler()
    log = EventLog(scheduler)
    io = IOSystem(scheduler, log, System("bench", ()))
    group = MotionSystem(scheduler, [config], log, io).group(config.name)
    group.jump(HOME)
    program = moves(group)
    controller = SimpleNamespace(dialect=Switches(), options=Options())
    task = Task(scheduler, TaskSpec("T_ROB1"), controller, Shared())
    finished = 0

    def body() -> None:
        nonlocal finished
        for move in program:
            task.charge(1_000_000)
            group.move(task, move)
        finished = scheduler.now

    def look() -> None:
        group.positions()
        if task.alive:
            scheduler.after(round(period * S), look)

    task.launch(body)
    if period:
        scheduler.after(0, look)
    start = time.process_time()
    scheduler.advance(stop=lambda: not task.alive)
    return time.process_time() - start, finished, scheduler.switches


def joint_moves(count: int) -> Callable[[MotionGroup], list[Move]]:
    """Return a zigzag of `count` joint moves of 0.1 s."""

    def make(_group: MotionGroup) -> list[Move]:
        return [
            JointMove(
                target=(0.02 * (k % 7), 0.2, 0.1 + 0.01 * (k % 3), 0.0, 0.6, 0.01 * k / count),
                speed=MoveSpeed(0.2),
                zone=ZONE if k < count - 1 else Zone(fine=True),
                time=0.1,
            )
            for k in range(1, count + 1)
        ]

    return make


def linear_moves(count: int) -> Callable[[MotionGroup], list[Move]]:
    """Return a zigzag of `count` lines of 20 mm."""

    def make(group: MotionGroup) -> list[Move]:
        start = group.geometry().forward(HOME)
        return [
            CartesianMove(
                target=(frames.add(start[0], (0.0, 0.02 * (k % 2), 0.02 * (k // 2 % 2))), start[1]),
                external=HOME,
                speed=MoveSpeed(0.2),
                zone=ZONE if k < count - 1 else Zone(fine=True),
            )
            for k in range(1, count + 1)
        ]

    return make


def dense_moves(count: int) -> Callable[[MotionGroup], list[Move]]:
    """Return `count` lines of 0.5 mm along a circle at 200 mm/s."""

    def make(group: MotionGroup) -> list[Move]:
        start = group.geometry().forward(HOME)
        angles = [0.0005 / 0.06 * k for k in range(1, count + 1)]
        places = [(0.06 * (cos(a) - 1), 0.06 * sin(a), 0.0) for a in angles]
        return [
            CartesianMove(
                target=(frames.add(start[0], place), start[1]),
                external=HOME,
                speed=MoveSpeed(0.2),
                zone=DENSE if k < count - 1 else Zone(fine=True),
            )
            for k, place in enumerate(places)
        ]

    return make


def inverse(count: int = 5000) -> float:
    """Return s of CPU for one pose on a known branch."""
    own = Kinematics.of(load_config("irb120").groups[0])
    assert own is not None
    pose = own.forward(HOME)
    start = time.process_time()
    for _ in range(count):
        own.follow(pose, HOME)
    return (time.process_time() - start) / count


def main() -> None:
    """Print the figures."""
    for name, count, moves in (
        ("joint", 1000, joint_moves),
        ("linear", 300, linear_moves),
        ("linear moves of 0.5 mm: dense", 3000, dense_moves),
    ):
        spent, end, switches = min(run(moves(count)) for _ in range(3))
        print(
            f"{name} moves: {count / spent:,.0f} a second of CPU, "
            f"{switches / count:.1f} switches a move, {end / S:.3f} s simulated"
        )
    print(f"inverse kinematics: {inverse() * 1e6:.1f} µs a pose")
    ends = {period: run(linear_moves(20), period)[1] for period in (0.0, 0.001, 0.01, 0.1)}
    print(f"end times differ by {(max(ends.values()) - min(ends.values())) / 1e6:.6f} ms")


if __name__ == "__main__":
    main()
