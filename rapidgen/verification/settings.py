"""How the controller under the driver behaves: the settings under which every case runs."""

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
    """How the controller under the driver behaves, and which of its groups is driven."""

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
    """Tracers hear of every statement; with `coverage` they do anyway."""

    @property
    def slowness(self) -> float:
        """How much longer than by default the driver's work takes, at least 1.

        What a case allows for work, not for waiting, goes with it.
        """
        return max(1.0, self.costs.builtin_scale)

    @property
    def corners_in_time(self) -> bool:
        """Whether the motion task has its turn between a move's release and its corner.

        Tasks that run by lot may keep it waiting for a dozen calls on sockets in a row, 25 ms of
        a slow controller with two clients: no driver is in time there for a `planning_lead` of
        20 ms, nor need it be (docs/develop/assumptions.md, 35). In turns it is 13 ms.
        """
        return not self.random_schedule or self.motion.planning_lead > _TURN * self.slowness

    @property
    def latest_interrupt(self) -> float:
        """s from an event to its trap, at most."""
        return self.costs.interrupt_delay[1] * 1e-9

    def early(self) -> "Setting":
        """The same on a controller of which no task has run yet: no robot that settles first."""
        return replace(self, motion=replace(self.motion, settle=0.0))


# What the driver cannot do without. Where it is otherwise a task ends at its start or every link
# breaks, and nothing moves: tests/verification/test_variants.py.
NEEDED = frozenset({"alias_by_name"})
# Where the TCP has a ceiling of its own every trajectory is refused with it.
NOT_WITH_CEILINGS = "calc_in_background=false"
_CEILING = 5.0
# s that the other tasks may take together before the motion task has its turn, by lot.
_TURN = 0.01
# Figures of the motion that no source gives, and another one for each.
FIGURES = {"planning_lead": 0.02, "servo_lag": 0.05, "settle": 0.2, "quick_factor": 1.0}
COSTS = (1.0, 0.25, 4.0)
SCHEDULES = ("round-robin", "random", "pers")
STRENGTHS = ("default", "alone", "pairs", "triples")
"""How many assumptions meet in a row of settings, by number."""


def assumption_choices(switches: Switches | MotionSettings) -> dict[str, tuple[Answer, ...]]:
    """Every switch that is a choice, with what may be chosen; as it is set comes first."""
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
    """What a driver can notice of its controller, with the answers to it; the default first."""
    switches = assumption_choices(Switches()) | assumption_choices(MotionSettings())
    left_out = NEEDED | NOT_THE_DRIVERS
    requested = {name: own for name, own in switches.items() if name not in left_out}
    return requested | {"costs": COSTS, "schedule": SCHEDULES}


def said(name: str, answer: Answer) -> str:
    """An assumption in words, as `--assume` takes it."""
    return f"{name}={str(answer).lower()}" if isinstance(answer, bool) else f"{name}={answer}"


def assumed(texts: Sequence[str]) -> Setting:
    """The setting in which these assumptions hold, and else the defaults; `seed=N` may be one.

    Raises DiagnosticError RG804.
    """
    known = {said(n, answer): (n, answer) for n, own in questions().items() for answer in own}
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
    """The switches with those of the answers that are to them."""
    own = {switch.name for switch in fields(switches)}
    chosen = {name: answer for name, answer in answers.items() if name in own}
    return replace(switches, **chosen)  # type: ignore[arg-type]


def _unknown(text: str) -> Exception:
    requested = questions()
    name = text.partition("=")[0]
    if name in requested:
        help = "one of " + ", ".join(said(name, answer) for answer in requested[name])
    else:
        help = suggest(name, list(requested)) or f"there are seed, {', '.join(requested)}"
    return refusal("RG804", None, f"nothing can be assumed as '{text}'", help)


def rows(strength: int = 2) -> dict[str, tuple[str, ...]]:
    """What is assumed other than by default, by name: the default alone, and hostile settings.

    The answers to any `strength` questions meet in some row. A controller's behaviour that is only
    remembered must not decide whether the driver works, nor may two of them together.
    """
    result: dict[str, tuple[str, ...]] = {"": ()}
    if not strength:
        return result
    requested = questions()
    array = covering(requested, strength)
    for number, row in enumerate(array[1:], 1):
        others = [said(n, answer) for n, answer in row.items() if answer != requested[n][0]]
        # Its chances are a row's own.
        result[f"{STRENGTHS[strength]} {number}"] = (*others, f"seed={number}")
    return result


def possible(config: RobotConfig, rows: Mapping[str, Sequence[str]]) -> dict[str, tuple[str, ...]]:
    """The rows without what this configuration's driver cannot do without."""
    ceiling = any(group.tcp_speed_limit < _CEILING for group in config.groups)
    return {
        name: tuple(text for text in texts if not (ceiling and text == NOT_WITH_CEILINGS))
        for name, texts in rows.items()
    }


def settings(config: RobotConfig, rows: Mapping[str, Sequence[str]]) -> dict[str, Setting]:
    """A setting for each row, and the default for each further motion group."""
    result = {name: assumed(texts) for name, texts in rows.items()}
    if "" in result:
        result[""] = replace(result[""], coverage=True)
        for number, group in enumerate(config.groups[1:], 1):
            result[group.name] = Setting(group=number, coverage=True)
    return result
