"""Random programs with random stops: never a jump, never past a limit, always an end.

RAPIDGEN_RANDOM_PROGRAMS sets how many (60 by default). 7,500 joint programs were run once.
"""

import os
import random

import pytest

from rapidgen.axes import frames
from rapidgen.virtual.errors import FatalError, RapidError
from rapidgen.virtual.kernel import S
from rapidgen.virtual.motion.moves import CartesianMove, JointMove, Speed

COUNT = int(os.environ.get("RAPIDGEN_RANDOM_PROGRAMS", "60"))
RADII = (0, 0.3, 1, 10, 50, 200)
HOME = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)


def disturb(cell, rng, *, count):
    """Stops, starts, cleared paths and overrides at random times; all is released at 4 s."""
    group = cell.group

    def override(value):
        group.override = value

    acts = {
        "stop": lambda: group.stop("x", quick=False),
        "start": lambda: group.start("x"),
        "clear": group.clear_path,
        "override": lambda: override(rng.choice([0.0, 0.1, 0.5, 1.0])),
    }
    for _ in range(rng.randrange(count)):
        cell.at(3 * rng.random(), acts[rng.choice(["stop", "start", "stop", "clear", "override"])])

    def release():
        group.override = 1.0
        group.start("x")

    cell.at(4.0, release)


def joint_program(cell, rng, zones):
    size = rng.choice([0.01, 0.1, 1.0])

    def program(task):
        values = list(cell.group.positions())
        for k in range(rng.randrange(1, 12)):
            pause = rng.choice([1e-6, 1e-3, 1e-3, 0.05])
            task.sleep(pause)
            for i, joint in enumerate(cell.config.joints):
                if rng.random() < 0.6:
                    values[i] = min(max(values[i] + rng.gauss(0, size), joint.lower), joint.upper)
            cell.group.move(
                task,
                JointMove(
                    target=tuple(values),
                    speed=Speed(rng.choice([0.3, 1, 5])),
                    zone=zones(rng.choice(RADII)),
                    time=rng.choice([None, None, 0.02, 0.1, 0.5]),
                    concurrent=k < 3 and rng.random() < 0.1,
                ),
            )

    return program


def cartesian_program(cell, rng, zones):
    own = cell.group.kinematics
    start = own.forward(HOME)

    def near():
        return tuple(v + rng.uniform(-0.08, 0.08) for v in start[0])

    def program(task):
        for _ in range(rng.randrange(2, 8)):
            task.sleep(1e-3)
            axis = frames.unit(tuple(rng.gauss(0, 1) for _ in range(3)))
            turned = frames.multiply(start[1], frames.about(axis, rng.choice([0, 0, 0.1, 0.4])))
            kind = rng.choice(["line", "line", "circle", "joint"])
            common = {
                "speed": Speed(rng.choice([0.05, 0.2, 1])),
                "zone": zones(rng.choice(RADII)),
                "time": rng.choice([None, None, 0.3, 1.0]),
            }
            target = near(), turned
            try:
                if kind == "joint":
                    found = own.solutions(own.forward(HOME), cell.group.path_target)
                    cell.group.move(task, JointMove(target=found[0], **common))
                else:
                    via = (near(), turned) if kind == "circle" else None
                    ends = cell.group.path_target
                    cell.group.move(
                        task, CartesianMove(target=target, via=via, external=ends, **common)
                    )
            except (RapidError, FatalError):
                continue  # refused before motion: the path is as it was

    return program


@pytest.mark.parametrize("seed", range(COUNT))
def test_joint_programs(cell, zones, seed):
    rng = random.Random(seed)
    if seed % 2:
        cell.group.kinematics = None
    disturb(cell, rng, count=8)
    task = cell.start(joint_program(cell, rng, zones))
    cell.sample(lambda: not task.alive and cell.kernel.now > 4.1 * S, limit=90)
    assert not task.alive
    speed, acceleration = cell.shares()
    assert speed <= 1 + 1e-6
    assert acceleration <= 1 + 1e-3


@pytest.mark.parametrize("seed", range(COUNT // 2))
def test_cartesian_programs(cell, zones, seed):
    """Limits along a line come from samples of its inverse kinematics: within a fifth."""
    rng = random.Random(seed)
    cell.group.jump(HOME)
    disturb(cell, rng, count=6)
    task = cell.start(cartesian_program(cell, rng, zones))
    cell.sample(lambda: not task.alive and cell.kernel.now > 4.1 * S, limit=90)
    assert not task.alive
    speed, acceleration = cell.shares()
    assert speed <= 1.02
    assert acceleration <= 1.2
