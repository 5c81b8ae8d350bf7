"""Random motion programs: each moves as the same one does that is written in RAPID.

A name, `program/17`, decides everything: how many moves, which, how fast, through which zones.
"""

import random
from dataclasses import replace
from typing import TextIO

from rapidgen.config.model import RobotConfig
from rapidgen.controller.tracing import Trace
from rapidgen.diagnostics import refusal
from rapidgen.proving.bench import FAILURES, Bench
from rapidgen.proving.explore import Explored, Recording
from rapidgen.proving.fresh import Boot
from rapidgen.proving.model import Finding
from rapidgen.proving.programs import Programmer, called, in_rapid, orders
from rapidgen.proving.settings import Setting
from rapidgen.proving.suite.programs import one_like_rapid
from rapidgen.system.model import System

LONGEST = 12
"""Moves of a program at most; two at least."""
PROGRAMS = Setting()
"""Under which they run."""
SAMPLE = 20_000_000
"""ns between two positions that are kept: in the smallest zone is one of them at least."""


def name_of(seed: int) -> str:
    """What the program of a seed is called."""
    return f"program/{seed}"


def takes_programs(config: RobotConfig) -> None:
    """Refuse a driver that takes none. Raises DiagnosticError RG810."""
    if config.profile != "full":
        mend = "take --programs away, or build it with `profile: full`"
        raise refusal("RG810", None, f"the driver of {config.name} takes no programs", mend)


def liken(
    config: RobotConfig,
    system: System,
    name: str,
    trace: TextIO | None = None,
    record: Recording | None = None,
    boot: Boot = Bench,
) -> Explored:
    """Run a random program, and the same one in RAPID: path within 0.01 mm, time within 2 %.

    The story is the program in RAPID. `trace` and `record` as for `explore`.
    """
    chance = random.Random(name)
    finding = None
    setting = replace(PROGRAMS, tracing=trace is not None)
    with boot(config, system, setting) as bench:
        bench.sample = SAMPLE
        if trace is not None:
            Trace(bench.controller, trace)
        program = orders(bench, chance.randint(2, LONGEST), chance)
        plan = in_rapid(bench, program)
        end = record(bench.controller) if record is not None else None
        try:
            other = boot(config, called(config, bench.group.task), setting)
            other.sample = SAMPLE
            one_like_rapid(Programmer(bench), bench, program, other)
            bench.healthy()
        except FAILURES as error:
            finding = Finding(name, str(error), plan, bench.log())
        finally:
            if end is not None:
                end()
    return Explored(name, plan, finding)
