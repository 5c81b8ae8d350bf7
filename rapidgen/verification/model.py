"""What came out of a proof: of one case, and of the whole suite."""

import re
from dataclasses import dataclass, field


def is_program(name: str) -> bool:
    """Whether a name is that of a random motion program (`program/17`), and of no schedule."""
    return re.fullmatch(r"program/\d{1,12}", name, re.ASCII) is not None


def title(name: str) -> str:
    """What a report calls a schedule or a program: `schedule 17~4`, `program/17`."""
    return name if is_program(name) else f"schedule {name}"


class CheckFailed(Exception):
    """A demand that did not hold.

    The text says what was wanted and what was seen.
    """


class NotApplicable(Exception):
    """Raised by a case that is about what the driver or the controller does not have; says what."""


@dataclass(frozen=True, slots=True)
class Series:
    """Joint values over time for a plot: seconds, and one row of joints (rad, m) each."""

    label: str
    times: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class CaseResult:
    """What came out of one case, by name, under one setting of the assumptions."""

    case: str
    group: str
    title: str
    answers: str
    passed: bool
    detail: str = ""
    setting: str = ""
    blamed: tuple[str, ...] = ()
    """The smallest part of what the setting assumes that breaks the case."""
    untried: str = ""
    """Why there was nothing to prove, if so; it has passed then."""
    simulated: float = 0.0
    elapsed: float = 0.0
    """s of CPU."""
    log: tuple[str, ...] = ()
    series: tuple[Series, ...] = ()
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """How often lines of RAPID were reached, by file; where coverage was asked for."""


@dataclass(frozen=True, slots=True)
class Counterexample:
    """A schedule that broke the invariant, or a program that moved otherwise than in RAPID; its
    name replays it exactly."""

    schedule: str
    detail: str
    plan: str
    log: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """What a report calls it."""
        return title(self.schedule)


@dataclass(slots=True)
class SuiteResult:
    """A run of the suite."""

    name: str
    build_id: str
    outcomes: list[CaseResult] = field(default_factory=list)
    rows: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """What the settings assume other than by default, by name."""
    findings: list[Counterexample] = field(default_factory=list)
    schedules: int = 0
    programs: int = 0
    """Random motion programs that were tried."""
    curve: list[tuple[int, int]] = field(default_factory=list)
    """How many schedules had met how many pairs of statements, where there was a new one."""
    elapsed: float = 0.0
    broken_off: bool = False
    """Whether somebody ended the run before it had seen everything."""
    left: int = 0
    """Pieces of work that were not begun, for a budget or after a failure."""
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """Lines of RAPID by file, and how often the cases reached them; empty: not the whole suite."""

    @property
    def tried(self) -> list[CaseResult]:
        """Outcomes of the cases that had something to prove."""
        return [outcome for outcome in self.outcomes if not outcome.untried]

    @property
    def covered(self) -> tuple[int, int]:
        """Lines that were reached, and all lines with a statement."""
        hits = [hit for lines in self.lines.values() for hit in lines.values()]
        return sum(1 for hit in hits if hit), len(hits)

    @property
    def passed(self) -> bool:
        """Whether everything held."""
        return not self.broken_off and not self.findings and all(o.passed for o in self.outcomes)
