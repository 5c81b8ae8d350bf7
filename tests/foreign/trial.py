"""Trial: every RAPID program below a folder, as it is, on the virtual controller.

    python -m tests.foreign.trial FOLDER [ROBOT]     (or: make foreign FOREIGN=FOLDER)

Nothing of a program is changed. Its cell is made up: signals and tools that no module declares
exist, inputs change at random, an operator presses the first button, numbers are 1, and start
is pressed again behind a Stop; axis 5 begins at 30 degrees, as in a RobotStudio station. For
each program it says how it ended, what of its lines was reached, and why not further.
"""

import math
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.controller.tracing import Coverage
from rapidgen.diagnostics import DiagnosticError, Severity
from tests.foreign.cell import furnish
from tests.foreign.programs import Program, programs

HERE = Path(__file__).parent
ROBOTS = (
    *("irb120", "irb1200", "irb1600", "irb2400", "irb4600", "irb6640", "irb660"),
    str(HERE / "irb140.yaml"),
)
"""Tried in this order while a position cannot be reached."""
_MISFIT = re.compile("REACH|ROBLIMIT|not compatible|singularity")
_TIME = 300.0
_STATEMENTS = 2_000_000
_STEP = 0.5
_PRESSES = 20
"""How often the operator presses start behind a Stop."""


@dataclass(frozen=True)
class Outcome:
    """How far a program ran."""

    end: str
    reached: int
    lines: int
    notes: tuple[str, ...] = ()


def trial(program: Program, robot: str = "irb120", *, seed: int = 1) -> Outcome:
    """Load, start, run until it ends, or for a while."""
    try:
        system, cell = furnish(program.read())
        groups = groups_for(system, load_config(robot))
        controller = VirtualController(
            system, groups, cycle="once", tracing=True, seed=seed, autostart=False
        )
    except DiagnosticError as error:
        wrong = [d for d in error.diagnostics if d.severity is Severity.ERROR]
        notes = tuple(
            f"{d.code} {Path(d.span.path).name if d.span else ''}:{d.span.line if d.span else ''} "
            f"{d.message}"
            for d in wrong[:3]
        )
        return Outcome(f"does not load ({len(wrong)} errors)", 0, 0, notes)
    with controller:
        covered = Coverage(controller)
        controller.operator.attach()
        for group in controller.motion.groups.values():
            axes = [joint.axis for joint in group.config.joints]
            group.jump(tuple(math.radians(30) if axis == "rax_5" else 0.0 for axis in axes))
        controller.start_program()
        end = _run(controller)
        lines = [hits for file in covered.lines().values() for hits in file.values()]
        said = [d.message for d in controller.diagnostics]
        notes = [f"given: {cell}"] if str(cell) else []
        notes += [f"in no module: {kind} {name}" for name, kind in list(cell.lost.items())[:3]]
        for task in controller.tasks.values():
            if task.fault is not None:
                notes.append(f"{task.name}: {_fault(task.fault)}")
        notes += [f"waits: {where}" for where in controller.where()]
        notes += said[:4]
        return Outcome(end, sum(1 for hits in lines if hits), len(lines), tuple(notes))


def _fault(fault: object) -> str:
    span = getattr(fault, "span", None)
    where = f" at {Path(span.path).name}:{span.line}" if span is not None else ""
    return f"{fault}{where}"


def _run(controller: VirtualController) -> str:
    """Let time pass while inputs change and dialogs are answered; how it ended."""
    scheduler = controller.scheduler
    inputs = [s for s in controller.io.signals.values() if s.spec.type in ("DI", "GI", "AI")]
    price = controller.costs.statement
    presses = 0
    while controller.now < _TIME:
        controller.run_for(_STEP)
        states = {task.state for task in controller.tasks.values()}
        if "stopped" in states and not _faults(controller) and presses < _PRESSES:
            presses += 1
            controller.start_program()
        elif "running" not in states:
            return "ends" if not _faults(controller) else "stops"
        if scheduler.now - scheduler.idle > _STATEMENTS * price:
            break
        for signal in inputs:
            if scheduler.rng.random() < 0.3:
                controller.io.set(signal, scheduler.rng.randrange(2))
        for question in tuple(controller.operator.questions):
            _answer(controller, question.number, question.choices)
    return "stops" if _faults(controller) else f"runs on ({controller.now:.0f} s)"


def _faults(controller: VirtualController) -> bool:
    return any(task.fault is not None for task in controller.tasks.values())


def _answer(controller: VirtualController, number: int, choices: tuple[str, ...]) -> None:
    for value in (*choices, "1", "a"):
        try:
            controller.operator.answer(number, value)
        except ValueError:
            continue
        return


def best(program: Program, robots: Sequence[str]) -> tuple[str, Outcome]:
    """The robot with which a program gets furthest, and how far."""
    found: list[tuple[str, Outcome]] = []
    for robot in robots:
        found.append((Path(robot).stem, trial(program, robot)))
        if not any(note for note in found[-1][1].notes if _MISFIT.search(note)):
            break
    return max(found, key=lambda one: one[1].reached)


def main(folder: Path, robots: Sequence[str]) -> None:
    """Print one paragraph for each program."""
    for program in programs(folder):
        robot, outcome = best(program, robots)
        share = f"{outcome.reached} of {outcome.lines} lines" if outcome.lines else ""
        print(f"{program.name}: {robot}: {outcome.end} {share}")
        for note in outcome.notes:
            print(f"    {note}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:] or ROBOTS)
