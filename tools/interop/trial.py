"""Trial: every RAPID program of a folder on the virtual controller.

    python -m tools.interop.trial FOLDER [ROBOT]     (or: make interop FOREIGN=FOLDER)

Programs are unchanged and cells are inferred, as in `rapidgen run PROGRAM --cell infer`. If the
inferred robot does not reach a position, the robot that gets furthest is used. Undeclared data is
created, and inputs and dialogs get an answer, but no communication partner does. A backup moves its
own robot. For each program the trial prints how it ended (whole; waits for a partner: socket, file,
guide; stops after a partner: a dialog was answered before; goes round; stops with an error; does
not load), the reached share of its lines, and the obstacle. The last lines are the sums.
"""

import re
import statistics
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.controller import Cycle
from rapidgen.controller.inference.restarts import run_past_stops
from rapidgen.controller.tracing import Coverage
from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.rapid import check
from tools.interop.called import lines_called
from tools.interop.programs import Program, programs

ROBOTS = (
    *("irb120", "irb1200", "IRB 140-6/0.81", "irb1600", "irb2400", "IRB 2600-12/1.65", "irb4600"),
    *("irb6640", "irb6700", "irb660", "irb14000", "crb15000", "irb910sc"),
)
"""Tried after the inferred one, in this order, while a position is out of reach."""
_MISFIT = re.compile("REACH|ROBLIMIT|not compatible|singularity")
_PARTNER = re.compile(
    r"Socket|bytes from|waits for an answer|message|ERR_SOCK|ERR_FILE|ERR_TP_|EGM |ERR_UDPUC"
)
_NEXT = re.compile("waits for bytes from|waits for a client")
_TIME = 300.0
_STATEMENTS = 2_000_000
_LITTLE = 0.6
GOOD = (
    *("whole", "waits for a partner", "waits for the next message"),
    *("stops after a partner", "goes round"),
)
"""A program that was answered and then stops has reached its first partner."""


@dataclass(frozen=True)
class Outcome:
    """Progress of a program."""

    end: str
    reached: int = 0
    lines: int = 0
    called: int = 0
    """Lines of routines that are called."""
    notes: tuple[str, ...] = ()

    @property
    def share(self) -> float:
        """Return the reached share of the lines."""
        return self.reached / self.lines if self.lines else 0.0


def trial(program: Program, robot: str = "", statements: int = _STATEMENTS) -> Outcome:
    """Run one cycle of main, with a limit of statements.

    If that reaches little, and reads inputs, more cycles follow.
    """
    once = cycles(program, robot, "once", statements)
    if once.end == "whole" and once.share < _LITTLE:
        more = cycles(program, robot, "forever", statements)
        return replace(more, end="whole" if more.end == "goes round" else more.end)
    return once


def cycles(program: Program, robot: str, cycle: Cycle, statements: int) -> Outcome:
    """Load, start, run until it ends, or for some time."""
    try:
        result = load_target(program.files, BootOptions(cell="infer", robot=robot))
        errors = [d for d in check(result.system, gaps=True) if d.severity is Severity.ERROR]
        if errors:
            raise DiagnosticError(errors)
        controller = VirtualController.boot(result, cycle=cycle, tracing=True, autostart=False)
    except DiagnosticError as error:
        wrong = [d for d in error.diagnostics if d.severity is Severity.ERROR]
        notes = tuple(
            f"{d.code} {Path(d.span.path).name if d.span else ''}:{d.span.line if d.span else ''} "
            f"{d.message}"
            for d in wrong[:4]
        )
        return Outcome(f"does not load ({len(wrong)} errors)", notes=notes)
    with controller:
        covered = Coverage(controller)
        controller.operator.attach()
        controller.start_program()
        finished = run_past_stops(controller, max_time=_TIME, max_statements=statements)
        by_file = covered.lines()
        lines = [hits for file in by_file.values() for hits in file.values()]
        called = lines_called(controller)
        count = sum(1 for f, rows in by_file.items() for line in rows if line in called.get(f, ()))
        faults = [f"{t.name}: {t.fault}" for t in controller.tasks.values() if t.fault is not None]
        waits = controller.where()
        guessed = result.guessed
        notes = [*faults, *waits]
        if guessed is not None and guessed.unknown:
            notes.append(
                "in no module: " + ", ".join(f"{u.type} {u.name}" for u in guessed.unknown[:5])
            )
        # Sockets, and dialogs and stops with texts or places; data and signals are not partners.
        requested = any(w == "SocketReceive" or " " in w for w, _ in controller.guessed.answered)
        messages = sum(what == "SocketReceive" for what, _ in controller.guessed.answered)
        end = _end(finished, faults, waits, requested=requested, served=messages > 1)
        if controller.guessed.missed:
            notes.append(f"the guessed robot missed {len(set(controller.guessed.missed))} places")
        reached = sum(1 for hits in lines if hits)
        return Outcome(end, reached, len(lines), max(reached, count), tuple(notes))


def _end(
    finished: str, faults: Sequence[str], waits: Sequence[str], *, requested: bool, served: bool
) -> str:
    """Return how a run ended; `served`: several messages of a socket were answered before."""
    # Only what stops a task or what it waits for counts, not its name or its path.
    faults = [fault.split(": ", 1)[-1] for fault in faults]
    waits = [where.rsplit("), ", 1)[-1] for where in waits if "), " in where]
    if faults and not all(map(_PARTNER.search, faults)):
        return "stops after a partner" if requested else "stops"
    if faults:
        return "waits for a partner"
    if finished == "finished":
        return "whole"
    if any(_PARTNER.search(where) for where in waits):
        again = served and any(_NEXT.search(where) for where in waits)
        return "waits for the next message" if again else "waits for a partner"
    return "goes round" if finished in ("time", "statements") else "waits for ever"


def best(program: Program, robots: Sequence[str]) -> tuple[str, Outcome]:
    """Return the robot with which a program gets furthest, and the result."""
    result: list[tuple[str, Outcome]] = []
    for robot in robots:
        result.append((robot or "its own or guessed", trial(program, robot)))
        if not any(note for note in result[-1][1].notes if _MISFIT.search(note)):
            break
    return max(result, key=lambda one: (one[1].end in GOOD, one[1].reached))


def main(folder: Path, robots: Sequence[str]) -> None:
    """Print one paragraph for each program, and the sums."""
    ends: Counter[str] = Counter()
    shares: list[tuple[float, float]] = []
    for program in programs(folder):
        backup = program.is_backup
        robot, outcome = best(program, ("",) if backup else ("", *robots))
        ends[("backups: " if backup else "mains: ") + outcome.end.split(" (")[0]] += 1
        if not backup:
            shares.append((outcome.share, outcome.reached / max(1, outcome.called)))
        print(f"{program.name}: {robot}: {outcome.end} {outcome.reached} of {outcome.lines} lines")
        for note in outcome.notes:
            print(f"    {note}", flush=True)
    for end, count in sorted(ends.items()):
        print(f"{count:5} {end}")
    if shares:
        all_lines, called = (statistics.median(column) for column in zip(*shares, strict=True))
        print(
            f"median of the lines of mains: {all_lines:.0%}, of those that are called {called:.0%}"
        )


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:] or ROBOTS)
