"""Random motion programs, compared with the same program in RAPID.

A name, `program/17`, determines the number of moves, their kinds, speeds and zones.
"""

import random
from dataclasses import replace
from typing import TextIO

from rapidgen.config.model import RobotConfig
from rapidgen.controller.tracing import Trace
from rapidgen.diagnostics import refusal
from rapidgen.system.model import System
from rapidgen.verification.bench_pool import Boot
from rapidgen.verification.model import Counterexample
from rapidgen.verification.raw_programs import Programmer, RawMove, called, in_rapid, orders
from rapidgen.verification.schedule_exploration import Recording, ScheduleResult
from rapidgen.verification.settings import Setting
from rapidgen.verification.suite.program_moves import MotionDiffers, program_matches_rapid
from rapidgen.verification.testbench import FAILURES, Bench

LONGEST = 12
"""Maximum number of moves in a program; the minimum is two."""
PROGRAMS = Setting()
"""The setting of the controllers."""
_MS = 1_000_000
LOOKS = ((20 * _MS, 0), (_MS, 0), (_MS, 1), (_MS, 2), (_MS, 3))
"""Sampling in ns and rounding of rotations, for each attempt.

If a program seems to deviate, the comparison is repeated with the next entry. Chords of 20 ms cut
corners by up to 0.5 mm. If the motion law could equally begin to brake 0.1 s earlier, 1e-8 in a
rotation changes the motion.
"""


def name_of(seed: int) -> str:
    """Return the program name of a seed."""
    return f"program/{seed}"


def require_programs(config: RobotConfig) -> None:
    """Require a driver that accepts programs.

    Raises DiagnosticError RG810.
    """
    if config.profile != "full":
        help = "take --programs away, or build it with `profile: full`"
        raise refusal("RG810", None, f"the driver of {config.name} takes no programs", help)


def compare_program(
    config: RobotConfig,
    system: System,
    name: str,
    trace: TextIO | None = None,
    record: Recording | None = None,
    boot: Boot = Bench,
) -> ScheduleResult:
    """Compare a random program with the same program in RAPID.

    The path must agree within 0.01 mm, the time within 0.5 %. The log of the result is the program
    in RAPID. `trace` and `record` as for `explore`: of the last attempt.
    """
    seen = trace is not None or record is not None
    tried = ScheduleResult(name, "", None)
    for sample, rounding in LOOKS[-1:] if seen else LOOKS:
        tried, unlike = _look(config, system, name, sample, rounding, trace, record, boot)
        if not unlike:
            break
    return tried


def _look(
    config: RobotConfig,
    system: System,
    name: str,
    sample: int,
    rounding: int,
    trace: TextIO | None,
    record: Recording | None,
    boot: Boot,
) -> tuple[ScheduleResult, bool]:
    """Compare once; also return True if only the comparison failed."""
    chance = random.Random(name)
    finding, unlike = None, False
    setting = replace(PROGRAMS, tracing=trace is not None)
    with boot(config, system, setting) as bench:
        bench.sample = sample
        if trace is not None:
            Trace(bench.controller, trace)
        program = orders(bench, chance.randint(2, LONGEST), chance)
        plan = in_rapid(bench, program)
        end = record(bench.controller) if record is not None else None
        try:
            other = boot(config, called(config, bench.group.task), setting)
            other.sample = sample
            hand = [_rounded(order, rounding) for order in program]
            program_matches_rapid(Programmer(bench), bench, program, other, hand)
            bench.assert_healthy()
        except FAILURES as error:
            finding = Counterexample(name, str(error), plan, bench.log())
            unlike = isinstance(error, MotionDiffers)
        finally:
            if end is not None:
                end()
    return ScheduleResult(name, plan, finding), unlike


def _rounded(order: RawMove, rounding: int) -> RawMove:
    """Return the same move with the rotation rescaled.

    A quaternion may be multiplied by any factor.
    """
    if order.pose is None or not rounding:
        return order
    place, rotation = order.pose
    a, b, c, d = (part * (1 - rounding * 3e-7) for part in rotation)
    return replace(order, pose=(place, (a, b, c, d)))
