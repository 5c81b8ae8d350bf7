"""Settings: behaviour of the controller, under which every case runs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import TypeAlias, TypeVar, get_args

from rapidgen.config.model import RobotConfig
from rapidgen.controller.faults import FaultPlan
from rapidgen.diagnostics import refusal, suggest
from rapidgen.machine.cost_model import Costs
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid.switches import NOT_THE_DRIVERS, Switches
from rapidgen.verification.covering_array import covering

Answer: TypeAlias = bool | float | str
T = TypeVar("T", Switches, MotionSettings)


@dataclass(frozen=True, slots=True)
class Setting:
    """Behaviour of the controller, and the motion group that is driven."""

    seed: int = 0
    group: int = 0
    random_schedule: bool = False
    switch_at_pers: bool = False
    dialect: Switches = field(default_factory=Switches)
    motion: MotionSettings = field(default_factory=MotionSettings)
    costs: Costs = field(default_factory=Costs)
    faults: FaultPlan = field(default_factory=FaultPlan)
    coverage: bool = False
    tracing: bool = False
    """Tracers get every statement; `coverage` implies it."""

    @property
    def slowness(self) -> float:
        """Return how much slower than by default the driver works, at least 1.

        Time limits of a case for work, not for waiting, scale with it.
        """
        return max(1.0, self.costs.builtin_scale)

    @property
    def corners_in_time(self) -> bool:
        """True if the motion task runs between a move's release and its corner.

        With random task order it may wait for a dozen socket calls in a row, 25 ms of a slow
        controller with two clients. No driver meets a `planning_lead` of 20 ms then, and it need
        not (docs/develop/assumptions-driver.md, 35). With tasks in turn it is 13 ms.
        """
        return not self.random_schedule or self.motion.planning_lead > _TURN * self.slowness

    @property
    def latest_interrupt(self) -> float:
        """Return the maximum s from an event to its trap."""
        return self.costs.interrupt_delay[1] * 1e-9

    def early(self) -> "Setting":
        """Return the same setting before any task or robot settling has run."""
        return replace(self, motion=replace(self.motion, settle=0.0))


# Behaviour that the driver requires. Otherwise a task ends at its start or every connection breaks,
# and the robot does not move: tests/verification/test_variants.py.
NEEDED = frozenset({"alias_by_name"})
# With a TCP speed limit, the driver rejects every trajectory.
NOT_WITH_CEILINGS = "calc_in_background=false"
_CEILING = 5.0
# s that other tasks may take together before the motion task runs, with random order.
_TURN = 0.01
# Motion parameters without a source, each with an alternative value.
FIGURES = {"planning_lead": 0.02, "servo_lag": 0.05, "settle": 0.2, "quick_factor": 1.0}
COSTS = (1.0, 0.25, 4.0)
SCHEDULES = ("round-robin", "random", "pers")
STRENGTHS = ("default", "alone", "pairs", "triples")
"""Number of assumptions combined in a row of settings, by index."""


def assumption_choices(switches: Switches | MotionSettings) -> dict[str, tuple[Answer, ...]]:
    """Return every switch with its choices; the current value comes first."""
    result: dict[str, tuple[Answer, ...]] = {}
    for switch in fields(switches):
        chosen = getattr(switches, switch.name)
        if switch.name in FIGURES:
            result[switch.name] = (chosen, FIGURES[switch.name])
        elif isinstance(chosen, bool):
            result[switch.name] = (chosen, not chosen)
        elif others := get_args(switch.type):
            result[switch.name] = (chosen, *(other for other in others if other != chosen))
    return result


def questions() -> dict[str, tuple[Answer, ...]]:
    """Return open questions about controllers and answers, default first."""
    switches = assumption_choices(Switches()) | assumption_choices(MotionSettings())
    left_out = NEEDED | NOT_THE_DRIVERS
    requested = {name: own for name, own in switches.items() if name not in left_out}
    return requested | {"costs": COSTS, "schedule": SCHEDULES}


def assumption_text(name: str, answer: Answer) -> str:
    """Return an assumption as `--assume` takes it."""
    return f"{name}={str(answer).lower()}" if isinstance(answer, bool) else f"{name}={answer}"


def assumed(texts: Sequence[str]) -> Setting:
    """Return the setting with these assumptions; `seed=N` may be one.

    Raises DiagnosticError RG804.
    """
    known = {
        assumption_text(n, answer): (n, answer) for n, own in questions().items() for answer in own
    }
    answers: dict[str, Answer] = {}
    seed = 0
    for text in texts:
        name, _, figure = text.partition("=")
        if name == "seed" and figure.isdecimal():
            seed = int(figure)
        elif text in known:
            answers[name] = known[text][1]
        else:
            raise _unknown(text)
    schedule = answers.pop("schedule", SCHEDULES[0])
    return Setting(
        seed=seed,
        random_schedule=schedule != SCHEDULES[0],
        switch_at_pers=schedule == "pers",
        costs=Costs().scaled(float(answers.pop("costs", 1.0))),
        dialect=_answered(Switches(), answers),
        motion=_answered(MotionSettings(), answers),
    )


def _answered(switches: T, answers: Mapping[str, Answer]) -> T:
    """Return the switches with the answers that concern them."""
    own = {switch.name for switch in fields(switches)}
    chosen = {name: answer for name, answer in answers.items() if name in own}
    return replace(switches, **chosen)  # type: ignore[arg-type]


def _unknown(text: str) -> Exception:
    requested = questions()
    name = text.partition("=")[0]
    if name in requested:
        help = "one of " + ", ".join(assumption_text(name, answer) for answer in requested[name])
    else:
        help = suggest(name, list(requested)) or f"there are seed, {', '.join(requested)}"
    return refusal("RG804", None, f"nothing can be assumed as '{text}'", help)


def rows(strength: int = 2) -> dict[str, tuple[str, ...]]:
    """Return the non-default assumptions of each row, by name.

    The first row is the default alone. The answers to any `strength` questions meet in some row:
    the driver must not depend on a controller behaviour that is only remembered, nor on two of them
    together.
    """
    result: dict[str, tuple[str, ...]] = {"": ()}
    if not strength:
        return result
    requested = questions()
    array = covering(requested, strength)
    for number, row in enumerate(array[1:], 1):
        others = [
            assumption_text(n, answer) for n, answer in row.items() if answer != requested[n][0]
        ]
        # Each row has random numbers of its own.
        result[f"{STRENGTHS[strength]} {number}"] = (*others, f"seed={number}")
    return result


def possible(config: RobotConfig, rows: Mapping[str, Sequence[str]]) -> dict[str, tuple[str, ...]]:
    """Return the rows without assumptions that contradict the driver's needs."""
    ceiling = any(group.tcp_speed_limit < _CEILING for group in config.groups)
    return {
        name: tuple(text for text in texts if not (ceiling and text == NOT_WITH_CEILINGS))
        for name, texts in rows.items()
    }


def settings(config: RobotConfig, rows: Mapping[str, Sequence[str]]) -> dict[str, Setting]:
    """Return a setting for each row, and one for each further motion group."""
    result = {name: assumed(texts) for name, texts in rows.items()}
    if "" in result:
        result[""] = replace(result[""], coverage=True)
        for number, group in enumerate(config.groups[1:], 1):
            result[group.name] = Setting(group=number, coverage=True)
    return result
