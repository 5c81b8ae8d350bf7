"""Schedules x stops x faults: does what was executed stay a prefix of what was asked?

One seed decides everything: which task runs when, what the clients do and when, what happens
to the network and to the controller. The oracle looks at the robot alone, so it judges any driver
that speaks simple_message on the group's motion port:

- a robot that stands moves only after a whole trajectory has been sent to it;
- while it moves, it is on the way through the points of the newest trajectories;
- once STOP has stopped it, it gets no move of the old trajectory any more;
- a trajectory that nothing disturbed is executed to its last point, or not at all;
- afterwards, whatever happened, a good client moves the robot.
"""

import random
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TextIO

from rapidgen.config.model import RobotConfig
from rapidgen.controller.faults import FaultPlan
from rapidgen.controller.tracing import Trace
from rapidgen.machine.network.rules import Direction, NetworkRule
from rapidgen.proving.bench import FAILURES, Bench
from rapidgen.proving.history import STEPS, History, Place
from rapidgen.proving.link import STOP
from rapidgen.proving.model import Finding
from rapidgen.proving.settings import Setting
from rapidgen.rapid import parse
from rapidgen.rapid.syntax.nodes import DataDeclaration
from rapidgen.system.model import System


@dataclass(frozen=True, slots=True)
class Explored:
    """What one seed did; `finding` when it broke the invariant."""

    seed: int
    plan: str
    finding: Finding | None


def explore(
    config: RobotConfig,
    system: System,
    seed: int,
    *,
    only: Sequence[str] = (),
    silence: float = 4.0,
    trace: TextIO | None = None,
) -> Explored:
    """Run one seed; the same one gives the same history.

    `only` names the steps that a history is made of (default: all of STEPS). `silence`: s
    after which a new client may expect to be served. `trace` gets a line for each statement
    of RAPID and for each step of the history.
    """
    chance = random.Random(f"{seed} walk")
    # Half of the histories have stops at statements, which needs code that reports them.
    try:
        places = _places(config, system) if seed % 4 < 2 else ()
    except FAILURES as error:
        return Explored(seed, "", Finding(seed, f"while nothing disturbs it: {error}", "", ()))
    setting = Setting(
        seed=seed,
        random_schedule=True,
        switch_at_pers=seed % 2 == 0,
        coverage=trace is not None or bool(places),
        faults=FaultPlan(network=_weather(config, chance)),
    )
    bench = Bench(config, system, setting)
    if trace is not None:
        Trace(bench.controller, trace)
    walk = History(bench, chance, only or tuple(STEPS), silence, places, trace)
    finding = None
    try:
        walk.go()
        bench.healthy()
    except FAILURES as error:
        finding = Finding(seed, str(error), "\n".join(walk.plan), bench.log())
    finally:
        bench.close()
    return Explored(seed, "\n".join(walk.plan), finding)


def _weather(config: RobotConfig, chance: random.Random) -> tuple[NetworkRule, ...]:
    """How the network is: mostly good, else late, in pieces, or in lumps, in one direction."""
    kind = chance.choice(("good", "good", "good", "delay", "split", "merge"))
    if kind == "good":
        return ()
    directions: tuple[Direction, ...] = ("in", "out")
    direction = chance.choice(directions)
    port = config.groups[0].ports.motion
    if kind == "delay":
        return (NetworkRule("delay", port, direction, seconds=chance.uniform(0.001, 0.2)),)
    if kind == "merge":
        return (NetworkRule("merge", port, direction, seconds=chance.uniform(0.005, 0.1)),)
    size = chance.choice((1, 3, 17, 67, 68, 69, 500))
    return (NetworkRule("split", port, direction, bytes=size, seconds=size * 2e-6),)


@lru_cache(maxsize=4)
def _places(config: RobotConfig, system: System) -> tuple[Place, ...]:
    """What a driver executes while it works and is stopped."""
    bench = Bench(config, system, Setting(coverage=True))
    try:
        bench.run(0.5)
        link = bench.motion()
        for _ in range(2):
            link.send(bench.download(bench.wave(8, duration=0.3)))
            bench.run(1.5)
        link.send(STOP)
        bench.run(1)
        reached = bench.lines()
    finally:
        bench.close()
    shared = _shared_lines(system)
    return tuple(
        Place(task.name, module.name, line, (module.path, line) in shared)
        for task in system.tasks
        for module in task.modules
        for line, hits in sorted(reached.get(module.path, {}).items())
        if hits
    )


def _shared_lines(system: System) -> set[tuple[str, int]]:
    """Where tasks meet: path and line of each mention of a persistent that they may share."""
    texts = {module.path: module.data for task in system.tasks for module in task.modules}
    trees = {path: parse(data, path=path) for path, data in texts.items()}
    names = {
        declaration.name.casefold()
        for tree in trees.values()
        for declaration in tree.declarations
        if isinstance(declaration, DataDeclaration)
        and declaration.kind == "PERS"
        and not declaration.scope
    }
    return {
        (path, tree.source.line(number))
        for path, tree in trees.items()
        for number, token in enumerate(tree.source.tokens)
        if token.casefold() in names
    }
