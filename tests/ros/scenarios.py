"""Goals drawn by lot, with faults at any moment: what a follower says against what a robot did.

`play(seed)` is one controller, three goals and what happens to them; it returns what is wrong.
"""

import asyncio
import random
from collections import Counter
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from ready import NAMES, station

from rapidgen.ros.goal_execution import ActiveGoal, Policy
from rapidgen.ros.goals import Code, Defaults, FinalStatus, Goal, Point, Tolerance

TIME_LIMIT = 200.0
"""Simulated s after which a goal that is not over is one that hangs: 12 s take 120 s at a tenth."""
OFF_PATH = 0.05
"""rad: corners are cut by less."""


@dataclass
class Found:
    """Violations, and the results of goals."""

    wrong: list[str] = field(default_factory=list)
    ends: Counter = field(default_factory=Counter)


def play(seed):
    """Three goals on one controller, and what is wrong with how they ended."""
    draw, result = random.Random(seed), Found()
    policy = Policy(
        Defaults(path=draw.choice([np.inf, np.inf, 0.3])),
        draw.choice(["refuse", "approach"]),
        draw.choice(["refuse", "resample"]),
    )
    with station(policy, seed=seed) as s:
        for number in range(3):
            _recover(s)
            _one(s, draw, result, f"seed {seed}, goal {number}")
    return result


def _recover(s):
    controller = s.controller
    controller.set_e_stop(False)
    controller.set_mode("auto")
    controller.set_motors(True)
    s.slow_down(1.0)
    controller.start_program()
    controller.run_for(2.0)
    if not s.robot.is_connected:
        s.run(s.robot.close())
        s.run(s.robot.connect())


def _one(s, draw, result, where):
    requested, spoiled = _goal(draw, s.joints)
    before, recorder = s.joints, next(iter(s.controller.record().values()))
    under = ActiveGoal()
    outcome = s.run(_with_fault(s, draw, s.follow(requested, under), under))
    if outcome is None:
        result.wrong.append(f"{where}: not over after {TIME_LIMIT:g} s")
        return
    result.ends[f"{outcome.status.value} {outcome.code.name}"] += 1
    moved = np.abs(recorder.recording().actual[:, :6] - before).max()
    recorder.stop()

    def wrong(what):
        result.wrong.append(f"{where}: {what} ({outcome})")

    if not outcome.text:
        wrong("no reason")
    if outcome.status is FinalStatus.SUCCEEDED:
        last = np.array(
            [
                dict(zip(requested.names, requested.points[-1].positions, strict=True))[n]
                for n in NAMES
            ]
        )
        if spoiled:
            wrong(f"succeeded, though {spoiled}")
        if not s.stands or np.abs(s.joints - last).max() > 0.01:
            wrong("succeeded, and the robot is not there")
        if _off(recorder, requested, before) > OFF_PATH:
            wrong("succeeded on another path")
    elif outcome.code in (Code.INVALID_JOINTS, Code.OLD_HEADER_TIMESTAMP) and moved > 1e-6:
        wrong("refused, and the robot moved")
    elif outcome.status is FinalStatus.CANCELED and not s.stands:
        wrong("cancelled, and the robot moves")
    elif outcome.status is FinalStatus.CANCELED and not under.ending.is_set():
        wrong("cancelled without a request")
    if outcome.code is Code.INVALID_GOAL and moved > 1e-6:
        wrong("refused, and the robot moved")


def _off(recorder, requested, before):
    """How far the robot was from the straight ways between the points, rad."""
    order = [list(requested.names).index(name) for name in NAMES]
    corners = np.array(
        [before, *([point.positions[i] for i in order] for point in requested.points)]
    )
    places = recorder.recording(0.05).actual[:, :6]
    return max(min(_to(place, a, b) for a, b in pairwise(corners)) for place in places)


def _to(place, a, b):
    way = b - a
    length = way @ way
    share = 0.0 if length == 0 else float(np.clip((place - a) @ way / length, 0, 1))
    return float(np.linalg.norm(place - a - share * way))


def _goal(draw, here):
    """A goal from where the robot stands, and what is wrong with it."""
    count = draw.randint(1, 12)
    seconds = draw.choice([0.1, 0.2, 0.5, 0.5, 1.0])
    rows = [here]
    for _ in range(count):
        step = [draw.uniform(-1, 1) * seconds * 0.4 for _ in NAMES]
        rows.append(np.clip(rows[-1] + step, -1.0, 1.0))
    points = [Point(n * seconds, list(map(float, row))) for n, row in enumerate(rows)]
    if draw.random() < 0.2:
        points[-1] = replace(points[-1], time=points[-2].time + 0.03)
    requested, spoiled = Goal(NAMES, points), ""
    kind = draw.randint(0, 11)
    if kind == 0:
        far = replace(points[-1], positions=[9.0] * 6)
        requested, spoiled = (
            replace(requested, points=[*points[:-1], far]),
            "it is outside the limits",
        )
    elif kind == 1:
        requested, spoiled = replace(requested, names=(*NAMES[:5], "elbow")), "a name is wrong"
    elif kind == 2:
        requested, spoiled = replace(requested, stamp=0.001), "its stamp is past"
    elif kind == 3:
        again = [*points, replace(points[-1])]
        requested, spoiled = replace(requested, points=again), "its times do not increase"
    elif kind == 4:
        requested = replace(requested, names=NAMES[::-1], points=[
            replace(point, positions=point.positions[::-1]) for point in points
        ])  # fmt: skip
    elif kind == 5:
        requested = replace(requested, path_tolerance=[Tolerance(n, position=0.5) for n in NAMES])
    elif kind == 6:
        requested = replace(requested, goal_time_tolerance=draw.choice([0.5, 3.0]))
    return requested, spoiled


async def _with_fault(s, draw, following, under):
    """The outcome of a goal to which something happens; None when it hangs."""
    task = asyncio.ensure_future(following)
    moment = draw.uniform(0.0, 4.0)
    act = draw.choice(
        [
            None,
            None,
            None,
            under.cancel,
            lambda: s.controller.set_e_stop(True),
            s.controller.stop_program,
            lambda: s.controller.set_mode("manual_reduced"),
            lambda: s.controller.set_motors(False),
            lambda: s.slow_down(draw.choice([0.1, 0.5])),
            s.controller.power_loss,
        ]
    )
    done, _ = await asyncio.wait({task}, timeout=moment)
    if not done and act is not None:
        act()
    done, _ = await asyncio.wait({task}, timeout=TIME_LIMIT)
    if not done:
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        return None
    return task.result()
