"""Schedules: steps and their disturbances, task order and network.

A schedule has a name, and all of the schedule is drawn from the name. The name is a seed, or a seed
and later changes, as `17`, `17~4`, `17~4~2` (drawn from 17, changed by 4, then by 2). Slashes
follow with the parts removed by the minimizer: `17~4/steps=1,3/turns/calm`.

Design: a schedule is a pure value. `drawn(name, ground)` maps a name to the same plan on every
machine, as long as the driver's RAPID text is the same. Task order is one of three policies:

- `random`: any ready task runs for any time;
- `pers`: at each access to a PERS another task may run;
- `priorities`: the task of the highest priority runs and loses its priority a few times
  (probabilistic concurrency testing).
"""

import random
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, get_args

from rapidgen.diagnostics import DiagnosticError, refusal

Order: TypeAlias = Literal["random", "pers", "priorities"]
"""Task order policy: `random`, `pers` or `priorities`; see above."""
Network: TypeAlias = Literal["good", "delay", "split", "merge"]

ACTS: Mapping[str, tuple[str, ...]] = {
    "whole": ("a pause",),
    "stopped": ("STOP", "STOP", "STOP", "two STOP"),
    "interrupted": ("stop", "stop pp-to-main", "stop pp-to-main", "e-stop", "motors-off"),
    "controlled": ("STOP over the control port",),
}
"""Disturbances of each step; other steps have none."""
WEIGHTS = {"stopped": 2, "interrupted": 2, "controlled": 2}
"""Relative weights of steps; the others have 1."""
BUSY = (0, 5, 40)
"""ms that the statement before a disturbance may take."""
PASSES = (1, 1, 1, 1, 1, 2, 3, 8)
BY_TIME = 0.2
"""Share of disturbances at a time instead of at a statement."""


@dataclass(frozen=True, slots=True)
class DriverLine:
    """A line that a driver executes; `meets`: tasks meet there."""

    task: str
    module: str
    line: int
    meets: bool


@dataclass(frozen=True, slots=True)
class StatementHit:
    """The `count`-th execution of a statement, which then takes `busy` ms."""

    place: DriverLine
    count: int
    busy: int


@dataclass(frozen=True, slots=True)
class Disturbance:
    """One step; its other random choices are drawn from `seed`.

    `where`: None, at some time.
    """

    name: str
    act: str
    where: StatementHit | None
    seed: str


@dataclass(frozen=True, slots=True)
class TaskSchedule:
    """A whole schedule."""

    steps: tuple[Disturbance, ...]
    order: Order | Literal["turns"]
    network: Network
    seed: str
    """Seed of the task order and of the network."""


@dataclass(frozen=True, slots=True)
class ScheduleSpace:
    """The set of schedules: a driver's steps and executed statements.

    `fault`: the driver's failure without any disturbance.
    """

    steps: tuple[str, ...]
    places: tuple[DriverLine, ...] = ()
    task: str = ""
    """Name of the motion task."""
    fault: str = ""


@dataclass(frozen=True, slots=True)
class ScheduleName:
    """A parsed schedule name."""

    seed: int
    changes: tuple[int, ...] = ()
    steps: tuple[int, ...] | None = None
    """Numbers of the remaining steps; None: all."""
    turns: bool = False
    """Tasks run in turn, each for a whole time slice."""
    calm: bool = False
    """The network has no faults."""

    def __str__(self) -> str:
        parts = ["~".join(str(number) for number in (self.seed, *self.changes))]
        if self.steps is not None:
            parts.append("steps=" + ",".join(str(number) for number in self.steps))
        return "/".join(parts + ["turns"] * self.turns + ["calm"] * self.calm)


_NAME = re.compile(r"(\d+)((?:~\d+)*)(?:/steps=(\d+(?:,\d+)*)?)?(/turns)?(/calm)?")


def named(text: str) -> ScheduleName:
    """Parse a schedule name.

    Raises DiagnosticError RG807.
    """
    match = _NAME.fullmatch(text)
    if match is None:
        raise _no_name(text)
    seed, changes, steps, turns, calm = match.groups()
    chosen = tuple(int(number) for number in (steps or "").split(",") if number)
    return ScheduleName(
        int(seed),
        tuple(int(number) for number in changes.split("~") if number),
        chosen if "/steps=" in text else None,
        bool(turns),
        bool(calm),
    )


def _no_name(text: str) -> DiagnosticError:
    help = "copy it whole from the report: 17, 17~4, 17~4/steps=1,3/turns/calm"
    return refusal("RG807", None, f"'{text}' names no schedule", help)


def drawn(name: ScheduleName, ground: ScheduleSpace) -> TaskSchedule:
    """Return the plan of a name: the same for the same driver."""
    plan = _fresh(name.seed, ground)
    for change in name.changes:
        plan = _changed(plan, change, ground)
    if name.steps is not None:
        plan = replace(plan, steps=tuple(s for n, s in enumerate(plan.steps) if n in name.steps))
    if name.turns:
        plan = replace(plan, order="turns")
    return replace(plan, network="good") if name.calm else plan


def _fresh(seed: int, ground: ScheduleSpace) -> TaskSchedule:
    chance = random.Random(f"{seed} plan")
    names = [name for name in ground.steps for _ in range(WEIGHTS.get(name, 1))]
    steps = tuple(
        _step(chance.choice(names), f"{seed} {number}", chance, ground)
        for number in range(chance.randrange(3, 7))
    )
    networks: tuple[Network, ...] = ("good", "good", "good", "delay", "split", "merge")
    return TaskSchedule(steps, chance.choice(get_args(Order)), chance.choice(networks), str(seed))


def _step(name: str, seed: str, chance: random.Random, ground: ScheduleSpace) -> Disturbance:
    acts = ACTS.get(name)
    if acts is None:
        return Disturbance(name, "", None, seed)
    act = chance.choice(acts)
    by_time = not ground.places or chance.random() < BY_TIME
    return Disturbance(name, act, None if by_time else _where(chance, ground), seed)


def _where(chance: random.Random, ground: ScheduleSpace) -> StatementHit:
    """Choose a statement, mostly one where the motion task meets others."""
    moving = [place for place in ground.places if place.task == ground.task]
    meeting = [place for place in moving if place.meets] or moving
    chosen = chance.choice((meeting, meeting, meeting, moving, ground.places)) or ground.places
    return StatementHit(chance.choice(chosen), chance.choice(PASSES), chance.choice(BUSY))


def _changed(plan: TaskSchedule, change: int, ground: ScheduleSpace) -> TaskSchedule:
    """Return the plan with another task order, or one disturbance moved."""
    chance = random.Random(f"{plan.seed} {change}")
    seed = f"{plan.seed}~{change}"
    disturbing = [n for n, step in enumerate(plan.steps) if step.where is not None]
    if not disturbing or chance.random() < 0.3:
        return replace(plan, order=chance.choice(get_args(Order)), seed=seed)
    number = chance.choice(disturbing)
    step = plan.steps[number]
    assert step.where is not None
    moved = _where(chance, ground)
    if chance.random() < 0.6:
        # New coverage is likely near places with new coverage.
        near = [p for p in ground.places if _near(p, step.where.place)]
        moved = replace(moved, place=chance.choice(near))
    steps = (*plan.steps[:number], replace(step, where=moved), *plan.steps[number + 1 :])
    return replace(plan, steps=steps, seed=seed)


def _near(one: DriverLine, other: DriverLine) -> bool:
    same = (one.task, one.module) == (other.task, other.module)
    return same and abs(one.line - other.line) <= 5
