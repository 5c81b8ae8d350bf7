"""Results of the suite: of one case, and of a whole run."""

import re
from dataclasses import dataclass, field


def is_program(name: str) -> bool:
    """True if a name is a random motion program (`program/17`)."""
    return re.fullmatch(r"program/\d{1,12}", name, re.ASCII) is not None


def title(name: str) -> str:
    """Return the title of a schedule or program in reports.

    Examples: `schedule 17~4`, `program/17`.
    """
    return name if is_program(name) else f"schedule {name}"


class CheckFailed(Exception):
    """A check failed.

    The text gives the expected and the observed value.
    """


class NotApplicable(Exception):
    """A case needs a feature that the driver or controller lacks; with reason."""


@dataclass(frozen=True, slots=True)
class Series:
    """Joint values over time for a plot.

    Seconds, and one row of joints (rad, m) each.
    """

    label: str
    times: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class CaseResult:
    """The result of one case, by name, under one setting of assumptions."""

    case: str
    group: str
    title: str
    answers: str
    passed: bool
    detail: str = ""
    setting: str = ""
    blamed: tuple[str, ...] = ()
    """The smallest set of the setting's assumptions that makes the case fail."""
    untried: str = ""
    """Why the case does not apply, if so; it counts as passed."""
    simulated: float = 0.0
    elapsed: float = 0.0
    """s of CPU."""
    log: tuple[str, ...] = ()
    series: tuple[Series, ...] = ()
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """Execution counts of RAPID lines, by file, if coverage is enabled."""


@dataclass(frozen=True, slots=True)
class Counterexample:
    """A schedule or random program that failed; its name replays it exactly.

    A schedule violates the invariant. A program moves differently than in RAPID.
    """

    schedule: str
    detail: str
    plan: str
    log: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """Return its title in reports."""
        return title(self.schedule)


@dataclass(slots=True)
class SuiteResult:
    """A run of the suite."""

    name: str
    build_id: str
    outcomes: list[CaseResult] = field(default_factory=list)
    rows: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Non-default assumptions of the settings, by name."""
    findings: list[Counterexample] = field(default_factory=list)
    schedules: int = 0
    programs: int = 0
    """Number of random motion programs."""
    curve: list[tuple[int, int]] = field(default_factory=list)
    """(schedules, pairs of statements seen), one entry for each new pair."""
    elapsed: float = 0.0
    broken_off: bool = False
    """True if the run was interrupted."""
    left: int = 0
    """Work items that did not start because of a budget or a failure."""
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """Execution counts of RAPID lines, by file; empty: not the whole suite."""

    @property
    def tried(self) -> list[CaseResult]:
        """Return the outcomes of the cases that apply."""
        return [outcome for outcome in self.outcomes if not outcome.untried]

    @property
    def covered(self) -> tuple[int, int]:
        """Return the number of reached lines and of lines with a statement."""
        hits = [hit for lines in self.lines.values() for hit in lines.values()]
        return sum(1 for hit in hits if hit), len(hits)

    @property
    def passed(self) -> bool:
        """True if all checks passed."""
        return not self.broken_off and not self.findings and all(o.passed for o in self.outcomes)
