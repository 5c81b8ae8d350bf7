"""Run random programs with random stops: no jump, no limit violation.

    python -m tools.motion_campaign [PROGRAMS] [FIRST]

runs many of them (10,000 by default, `make motion-campaign`); test_random.py runs a few. Each must
end. A seed decides everything: kind of moves, robot, settings, disturbances.
"""

import argparse
import random
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S
from rapidgen.motion import MotionSettings
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.moves import CartesianMove, JointMove, MoveSpeed
from rapidgen.runtime.task.task import Task
from tests.motion.cell import Cell, zone

RADII = (0, 0.3, 1, 10, 50, 200)
HOME = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)
RELEASED = 4.0
"""s at which all stops are released and the override is 100 %."""
PERIOD = 0.002
SPEED = {"joint": 1 + 1e-6, "flat": 1 + 1e-6, "brakes": 1 + 1e-6, "cartesian": 1 + 1e-3}
ACCELERATION = {"joint": 1 + 1e-3, "flat": 1 + 1e-3, "brakes": inf, "cartesian": 1 + 1e-3}
"""Allowed shares of the axes' limits.

`flat`: a robot without geometry; `brakes`: some stops use the brakes, which decelerate as hard as
the end of an axis' range requires.
"""
KINDS = ("joint", "flat", "brakes", "cartesian", "cartesian", "cartesian")
RAMPS = (0.05, 0.05, 0.0, 0.2)


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of one program."""

    kind: str
    faults: tuple[str, ...]
    moves: int
    speed: float
    acceleration: float


def disturb(cell: Cell, rng: random.Random, *, count: int, brakes: bool = False) -> None:
    """Apply stops, starts, cleared paths and overrides at random times.

    All are released at 4 s.
    """
    group = cell.group

    def override(value: float) -> None:
        group.override = value

    acts: dict[str, Callable[[], None]] = {
        "stop": lambda: group.stop("x", quick=False),
        "brakes": lambda: group.stop("x", brakes=True),
        "start": lambda: group.start("x"),
        "clear": group.clear_path,
        "override": lambda: override(rng.choice([0.0, 0.1, 0.5, 1.0])),
    }
    for _ in range(rng.randrange(count)):
        other = "brakes" if brakes else "stop"
        cell.at(3 * rng.random(), acts[rng.choice(["stop", "start", other, "clear", "override"])])

    def release() -> None:
        group.override = 1.0
        group.start("x")

    cell.at(RELEASED, release)


def joint_program(cell: Cell, rng: random.Random) -> Callable[[Task], None]:
    """Return up to eleven joint moves."""
    size = rng.choice([0.01, 0.1, 1.0])

    def program(task: Task) -> None:
        values = list(cell.group.positions())
        for k in range(rng.randrange(1, 12)):
            task.sleep(rng.choice([1e-6, 1e-3, 1e-3, 0.05]))
            for i, joint in enumerate(cell.config.joints):
                if rng.random() < 0.6:
                    values[i] = min(max(values[i] + rng.gauss(0, size), joint.lower), joint.upper)
            cell.group.move(
                task,
                JointMove(
                    target=tuple(values),
                    speed=MoveSpeed(rng.choice([0.3, 1, 5])),
                    zone=zone(rng.choice(RADII)),
                    time=rng.choice([None, None, 0.02, 0.1, 0.5]),
                    concurrent=k < 3 and rng.random() < 0.1,
                ),
            )

    return program


def cartesian_program(cell: Cell, rng: random.Random) -> Callable[[Task], None]:
    """Return up to seven lines, circles and joint moves.

    Moves rejected before motion are left out.
    """
    own = cell.group.geometry()
    start = own.forward(HOME)
    home = own.forward(HOME)

    def near() -> frames.Vector:
        x, y, z = (v + rng.uniform(-0.08, 0.08) for v in start[0])
        return x, y, z

    def axis() -> frames.Vector:
        x, y, z = (rng.gauss(0, 1) for _ in range(3))
        return frames.unit((x, y, z))

    def program(task: Task) -> None:
        for _ in range(rng.randrange(2, 8)):
            task.sleep(1e-3)
            turn = frames.about(axis(), rng.choice([0, 0, 0.1, 0.4]))
            turned = frames.multiply(start[1], turn)
            kind = rng.choice(["line", "line", "circle", "joint"])
            common = {
                "speed": MoveSpeed(rng.choice([0.05, 0.2, 1])),
                "zone": zone(rng.choice(RADII)),
                "time": rng.choice([None, None, 0.3, 1.0]),
            }
            target = near(), turned
            try:
                if kind == "joint":
                    result = own.solutions(home, cell.group.path_target)
                    cell.group.move(task, JointMove(target=result[0], **common))
                else:
                    via = (near(), turned) if kind == "circle" else None
                    ends = cell.group.path_target
                    cell.group.move(
                        task, CartesianMove(target=target, via=via, external=ends, **common)
                    )
            except MotionFault:
                continue  # rejected before motion: the path is unchanged

    return program


def run(seed: int, kind: str, ramp: float = MotionSettings().ramp_time) -> Outcome:
    """Run one program to its end, sampled every 2 ms."""
    rng = random.Random(seed)
    cell = Cell(settings=MotionSettings(ramp_time=ramp, cleared_move="return"))
    moves: list[object] = []
    cell.group.listeners.append(moves.append)
    if kind == "flat":
        cell.group.planner.kinematics = None
    if kind == "cartesian":
        cell.group.jump(HOME)
        disturb(cell, rng, count=6)
        task = cell.start(cartesian_program(cell, rng))
    else:
        disturb(cell, rng, count=8, brakes=kind == "brakes")
        task = cell.start(joint_program(cell, rng))

    def over() -> bool:
        late = cell.scheduler.now > (RELEASED + 0.1) * S
        return late and not task.alive and cell.group.is_standing

    cell.sample(over, PERIOD, limit=90)
    faults = []
    if task.alive:
        faults.append("the program did not end")
    if cell.group.positions() != cell.group.path_target:
        faults.append("it does not stand where its path ends")
    speed, acceleration = cell.shares(PERIOD)
    if not speed <= SPEED[kind]:
        faults.append(f"speed {speed:.4f} of the limit")
    if not acceleration <= ACCELERATION[kind]:
        faults.append(f"acceleration {acceleration:.4f} of the limit")
    return Outcome(kind, tuple(faults), len(moves), speed, acceleration)


def main(programs: int, first: int) -> int:
    """Run all; return 1 when a program failed.

    Progress goes to stderr, the sum to stdout.
    """
    started = time.process_time()
    counts, moves = Counter[str](), 0
    worst: dict[str, tuple[float, float]] = {}
    failed = 0
    for seed in range(first, first + programs):
        kind, ramp = KINDS[seed % len(KINDS)], RAMPS[seed // len(KINDS) % len(RAMPS)]
        outcome = run(seed, kind, ramp)
        counts[kind] += 1
        moves += outcome.moves
        speed, acceleration = worst.get(kind, (0.0, 0.0))
        worst[kind] = max(speed, outcome.speed), max(acceleration, outcome.acceleration)
        for fault in outcome.faults:
            print(f"seed {seed} ({kind}, ramp {ramp} s): {fault}", flush=True)
        failed += bool(outcome.faults)
        if (seed - first + 1) % 500 == 0:
            print(f"{seed - first + 1} programs", file=sys.stderr, flush=True)
    for kind, (speed, acceleration) in worst.items():
        print(
            f"{kind}: {counts[kind]} programs, at most {speed:.4f} of the axes' speed and "
            f"{acceleration:.4f} of their acceleration"
        )
    spent = time.process_time() - started
    print(f"{programs} programs, {moves} moves, {failed} failed, {spent:.0f} s of CPU")
    return int(failed > 0)


if __name__ == "__main__":
    np.seterr(all="raise")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs", type=int, nargs="?", default=10_000)
    parser.add_argument("first", type=int, nargs="?", default=0)
    given = parser.parse_args()
    sys.exit(main(given.programs, given.first))
