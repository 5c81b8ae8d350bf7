"""Explore schedules, stops and faults: only a prefix of commands executes.

One seed decides everything: which task runs when, what the clients do and when, what happens to the
network and to the controller. The oracle observes the robot alone, so it judges any driver that
speaks simple_message on the group's motion port. Invariants:

- a robot at rest moves only after a client has sent it a whole trajectory;
- while it moves, it is on the path through the points of the newest trajectories;
- after STOP has stopped it, it gets no further move of the old trajectory;
- an undisturbed trajectory is executed to its last point, or not at all;
- afterwards, in all cases, a well-behaved client moves the robot.

How a schedule runs: `schedule.drawn` turns a name into a plan, `setting_of` boots a controller with
the plan's task order and network, and `History` executes the steps. Random choices of the plan, the
network and the history come from separate generators. A tracer or a recording draws no random
number, so a replay with `trace` gives the same history. The pairs of statements of different tasks
(`interleaving_coverage.py`) tell the selection (`schedule_selection.py`) which schedules are new,
and the minimizer (`minimization.py`) removes steps from one that fails.
"""

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TextIO

from rapidgen.config.model import RobotConfig
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.faults import FaultPlan
from rapidgen.controller.tracing import Trace
from rapidgen.machine.network.fault_injection import Direction, NetworkRule
from rapidgen.system.model import System
from rapidgen.verification.bench_pool import Boot
from rapidgen.verification.history import PAIRED, STEPS, History
from rapidgen.verification.interleaving_coverage import Pair, RacePairs, RacePoints, spots
from rapidgen.verification.model import Counterexample
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.schedule import DriverLine, ScheduleSpace, TaskSchedule, drawn, named
from rapidgen.verification.settings import Setting
from rapidgen.verification.testbench import FAILURES, Bench

Recording = Callable[[VirtualController], Callable[[], None]]
"""Starts a recording of a controller, and returns the function that ends it."""
SAMPLE = 20_000_000
"""ns between two samples of a moving robot: the tolerance is centimetres."""


@dataclass(frozen=True, slots=True)
class ScheduleResult:
    """The result of one schedule; `finding` if it violates the invariant."""

    schedule: str
    plan: str
    finding: Counterexample | None
    pairs: tuple[Pair, ...] = ()
    """Pairs of statements of different tasks (`interleaving_coverage.py`)."""


def explore(
    config: RobotConfig,
    system: System,
    schedule: str,
    *,
    only: Sequence[str] = (),
    silence: float = 4.0,
    trace: TextIO | None = None,
    record: Recording | None = None,
    boot: Boot = Bench,
) -> ScheduleResult:
    """Run one schedule; the same schedule gives the same history.

    `only` names the possible steps of a history (default: all of STEPS). `silence`: s after which
    the driver must serve a new client. `trace` gets a line for each statement of RAPID and for each
    step of the history; `record` starts a recording of the controller and returns the function that
    ends it. Neither changes the history. Raises DiagnosticError RG807.
    """
    name = named(schedule)
    ground = ground_of(config, system)
    if only:
        ground = replace(ground, steps=tuple(only))
    if ground.fault and name.seed % 2 == 0:
        fault = f"while nothing disturbs it: {ground.fault}"
        return ScheduleResult(schedule, "", Counterexample(schedule, fault, "", ()))
    plan = drawn(name, ground)
    with boot(config, system, setting_of(config, plan)) as bench:
        bench.sample = SAMPLE
        if plan.order == "priorities":
            bench.controller.scheduler.schedule = "priorities"
        pairs = RacePairs(bench.controller, spots_of(system))
        if trace is not None:
            Trace(bench.controller, trace)
        walk = History(bench, plan, silence, trace)
        finding = None
        end = record(bench.controller) if record is not None else None
        try:
            walk.go()
            bench.assert_healthy()
        except FAILURES as error:
            finding = Counterexample(schedule, str(error), "\n".join(walk.plan), bench.log())
        finally:
            if end is not None:
                end()
    return ScheduleResult(schedule, "\n".join(walk.plan), finding, pairs.found())


def setting_of(config: RobotConfig, plan: TaskSchedule) -> Setting:
    """Return the boot setting of a schedule's controller."""
    chance = random.Random(f"{plan.seed} network")
    return Setting(
        seed=chance.randrange(1 << 30),
        random_schedule=plan.order != "turns",
        switch_at_pers=plan.order in ("pers", "priorities"),
        tracing=True,
        faults=FaultPlan(network=_weather(config, plan, chance)),
    )


def _weather(
    config: RobotConfig, plan: TaskSchedule, chance: random.Random
) -> tuple[NetworkRule, ...]:
    """Return network rules: mostly none, else delays or splits.

    A rule delays, splits or merges data in one direction.
    """
    directions: tuple[Direction, ...] = ("in", "out")
    direction = chance.choice(directions)
    port = config.groups[0].ports.motion
    if plan.network == "delay":
        return (NetworkRule("delay", port, direction, seconds=chance.uniform(0.001, 0.2)),)
    if plan.network == "merge":
        return (NetworkRule("merge", port, direction, seconds=chance.uniform(0.005, 0.1)),)
    if plan.network == "split":
        size = chance.choice((1, 3, 17, 67, 68, 69, 500))
        return (NetworkRule("split", port, direction, bytes=size, seconds=size * 2e-6),)
    return ()


@lru_cache(maxsize=4)
def spots_of(system: System) -> RacePoints:
    """Return the lines where a driver's tasks meet."""
    return spots(system)


@lru_cache(maxsize=4)
def ground_of(config: RobotConfig, system: System) -> ScheduleSpace:
    """Return a driver's steps, and its statements while working and stopped."""
    group = config.groups[0]
    bench = Bench(config, system, Setting(coverage=True))
    try:
        bench.run(0.5)
        streams = group.ports.control and group.ports.control in bench.controller.network.listeners
        steps = tuple(name for name in STEPS if streams or name not in PAIRED)
        link = bench.motion()
        for _ in range(2):
            link.send(bench.download(bench.wave(8, duration=0.3)))
            bench.run(1.5)
        link.send(STOP)
        bench.run(1)
        reached = bench.lines()
    except FAILURES as error:
        return ScheduleSpace(tuple(name for name in STEPS if name not in PAIRED), fault=str(error))
    finally:
        bench.close()
    shared = spots_of(system).lines
    places = tuple(
        DriverLine(task.name, module.name, line, (module.path, line) in shared)
        for task in system.tasks
        for module in task.modules
        for line, hits in sorted(reached.get(module.path, {}).items())
        if hits
    )
    return ScheduleSpace(steps, places, group.task)
