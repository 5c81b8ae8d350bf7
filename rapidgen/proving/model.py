"""What a proof is made of: cases, what came out of them, and a run of the whole suite."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from rapidgen.proving.bench import Bench


Proving: TypeAlias = "Callable[[Bench], None]"


class Broken(Exception):
    """A demand that did not hold. The text says what was wanted and what was seen."""


@dataclass(frozen=True, slots=True)
class Behaviour:
    """One behaviour of the driver: a case of the suite.

    `answers` names what upstream gets wrong here, if anything.

    `once`: it takes too long for every setting, and runs under the default ones alone.
    `background`: it needs background tasks that go on when the program is stopped, which those of
    a driver that is being commissioned do not.
    """

    name: str
    title: str
    group: str
    prove: Proving
    answers: str = ""
    once: bool = False
    background: bool = False


class Theme:
    """The cases of one file, in the order of its text: a decorator that says a case's own facts.

    With `port="control"`, for all or for one, there is nothing to prove where the configuration has
    no such port.
    """

    def __init__(self, group: str, *, port: Literal["", "control"] = "") -> None:
        self._group = group
        self._port = port
        self.cases: list[Behaviour] = []

    def __call__(
        self,
        name: str,
        title: str,
        answers: str = "",
        *,
        once: bool = False,
        background: bool = False,
        port: Literal["", "control"] = "",
    ) -> "Callable[[Proving], Proving]":
        """Make a function the case of that name; it stays what it is."""

        def made(prove: Proving) -> Proving:
            own = self._where_there_is_a_port(prove) if port or self._port else prove
            self.cases.append(Behaviour(name, title, self._group, own, answers, once, background))
            return prove

        return made

    @staticmethod
    def _where_there_is_a_port(prove: Proving) -> Proving:
        def proved(bench: "Bench") -> None:
            if bench.group.ports.control:
                prove(bench)

        return proved


@dataclass(frozen=True, slots=True)
class Series:
    """Joint values over time for a plot: seconds, and one row of joints (rad, m) each."""

    label: str
    times: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class Verdict:
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
class Proof:
    """A run of the suite."""

    name: str
    build_id: str
    outcomes: list[Verdict] = field(default_factory=list)
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
