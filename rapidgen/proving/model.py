"""What a proof is made of: cases, what came out of them, and a run of the whole suite."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.proving.bench import Bench


class Broken(Exception):
    """A demand that did not hold. The text says what was wanted and what was seen."""


@dataclass(frozen=True, slots=True)
class Case:
    """One behaviour of the driver. `answers` names what upstream gets wrong here, if anything.

    `once`: it takes too long for every setting, and runs under the default ones alone.
    `background`: it needs background tasks that go on when the program is stopped, which those of
    a driver that is being commissioned do not.
    """

    name: str
    title: str
    group: str
    prove: "Callable[[Bench], None]"
    answers: str = ""
    once: bool = False
    background: bool = False


@dataclass(frozen=True, slots=True)
class Series:
    """Joint values over time for a plot: seconds, and one row of joints (rad, m) each."""

    label: str
    times: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came out of one case, by name, under one setting of the assumptions."""

    case: str
    group: str
    title: str
    answers: str
    passed: bool
    detail: str = ""
    setting: str = ""
    simulated: float = 0.0
    elapsed: float = 0.0
    """s of CPU."""
    log: tuple[str, ...] = ()
    series: tuple[Series, ...] = ()
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """How often lines of RAPID were reached, by file; where coverage was asked for."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A schedule that broke the invariant: `seed` replays it exactly."""

    seed: int
    detail: str
    plan: str
    log: tuple[str, ...] = ()


@dataclass(slots=True)
class Report:
    """A run of the suite."""

    name: str
    build_id: str
    outcomes: list[Outcome] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    schedules: int = 0
    elapsed: float = 0.0
    lines: dict[str, dict[int, int]] = field(default_factory=dict)
    """Lines of RAPID by file, and how often the cases reached them; empty: not the whole suite."""

    @property
    def covered(self) -> tuple[int, int]:
        """Lines that were reached, and all lines with a statement."""
        hits = [hit for lines in self.lines.values() for hit in lines.values()]
        return sum(1 for hit in hits if hit), len(hits)

    @property
    def passed(self) -> bool:
        """Whether everything held."""
        return not self.findings and all(o.passed for o in self.outcomes)
