"""A higher programmed speed or a larger zone never makes a path slower.

As in logs of RobotStudio: the time falls with the speed in 59 of 60 series, and never grows with
the zone in 185 steps (hehonglu123/ABB_Primitive_Study).
"""

import random
from functools import cache
from itertools import pairwise

import pytest

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S
from rapidgen.motion.events import CORNER_PATH_FAILURE
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.moves import CartesianMove, JointMove, MoveSpeed
from tests.motion.cell import Cell, zone

SPEEDS = (0.1, 0.5, 1.0, 2.0, 7.0)
ZONES = (0.3, 1, 5, 10, 50, 150)
MODELS = ("irb120", "irb1200", "irb2400", "irb6640_180_255", "irb910sc", "crb15000")
SLOWER = 1.01


@cache
def home(model: str) -> tuple[float, ...]:
    joints = Cell(model).config.joints
    usual = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0) if len(joints) == 6 else (0.3, 0.9, 0.05, 0.0)
    return tuple(min(max(q, j.lower), j.upper) for q, j in zip(usual, joints, strict=True))


def seconds(model, kinds, offsets, speed, size):
    """s of a path through points around the first posture; None: it is not possible."""
    cell = Cell(model)
    group = cell.group
    group.jump(home(model))
    start = group.geometry().forward(home(model))
    ends = []

    def program(task):
        try:
            for i, (kind, offset) in enumerate(zip(kinds, offsets, strict=True)):
                last = i == len(kinds) - 1
                target = frames.add(start[0], offset), start[1]
                shared = {"speed": MoveSpeed(speed), "zone": zone(0 if last else size)}
                if kind == "joint":
                    solutions = group.geometry().solutions(target, group.path_target)
                    if not solutions:
                        return
                    group.move(task, JointMove(target=solutions[0], **shared))
                else:
                    group.move(task, CartesianMove(target=target, external=home(model), **shared))
        except MotionFault:
            return
        ends.append(task.scheduler.now / S)

    cell.run(program, period=0.5, limit=100.0)
    return ends[0] if ends and not cell.events(CORNER_PATH_FAILURE) else None


def random_path(seed):
    rng = random.Random(seed)
    model = MODELS[seed % len(MODELS)]
    reach = 0.25 if model.startswith("irb6640") else 0.06
    sizes = (reach, reach, 0.0 if model == "irb910sc" else reach)
    offsets = [tuple(rng.uniform(-size, size) for size in sizes) for _ in range(rng.randint(1, 4))]
    return model, [rng.choice(("line", "line", "joint")) for _ in offsets], offsets, rng


def never_slower(times):
    known = [time for time in times if time is not None]
    return all(faster <= slower * SLOWER for slower, faster in pairwise(known))


@pytest.mark.parametrize("seed", range(24))
def test_a_higher_speed_is_not_slower(seed):
    *path, rng = random_path(seed)
    size = rng.choice(ZONES)
    assert never_slower([seconds(*path, speed, size) for speed in SPEEDS])


@pytest.mark.parametrize("seed", range(24))
def test_a_larger_zone_is_not_slower(seed):
    *path, rng = random_path(seed)
    speed = rng.choice(SPEEDS)
    assert never_slower([seconds(*path, speed, size) for size in ZONES])


@pytest.mark.parametrize("first", range(1000, 1400, 20))
def test_neither_is_slower_on_many_paths(first):
    """Both at once, over 400 paths."""
    slower = []
    for seed in range(first, first + 20):
        *path, rng = random_path(seed)
        size = rng.choice(ZONES)
        if not never_slower([seconds(*path, speed, size) for speed in SPEEDS]):
            slower.append((seed, "speed"))
        speed = rng.choice(SPEEDS)
        if not never_slower([seconds(*path, speed, size) for size in ZONES]):
            slower.append((seed, "zone"))
    assert slower == []


@pytest.mark.parametrize("model", MODELS)
def test_a_line_at_full_speed_is_the_fastest(model):
    """The example with which it was found: v500 0.95 s, v1000 1.19 s, v7000 1.41 s."""
    path = model, ["line"], [(-0.05, 0.05, 0.0)]
    times = [seconds(*path, speed, 1) for speed in SPEEDS]
    assert None not in times
    assert never_slower(times)
