"""Interface to the motion planner.

The planner (`rapidgen.motion`) knows neither RAPID nor its errors. It rejects a move with a
`MotionFault`: a reason and the values. This module maps every reason to its consequence in a
program:

1. A RAPID error (`_Error`) with an ERR_ constant, which an ERROR handler may handle.
2. A target that the robot cannot reach (`_OutOfReach`). It stops the tasks with event 50050; a
   switch lets an ERROR handler receive it.
3. An event (`_Stop`) with a number of the log, which stops the task. [mem] marks numbers without a
   public source.

`planned` wraps built-ins that call the planner, so that no MotionFault leaves a built-in. Events on
the path run outside a built-in; the task maps their faults itself (`Task.poll`). Units end here:
RAPID has degrees and mm, the planner rad and m (`builtins/motion/targets.py`).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps
from typing import ParamSpec, TypeVar

from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.errors import FatalError, MotionError, RapidError
from rapidgen.runtime.values import Record

# -- Faults of the planner -------------------------------------------------------------------------
#
# What the planner's refusals are called in RAPID: ERR_ constants, and events that stop the task.
#
# Numbers from 194900 and 195900 on are ours: ABB's are not public.


SINGULARITY = 50_026
CIRCLE_UNCERTAIN = 50_063
NOT_COMPATIBLE = 50_080
NO_UNIT = 194_900
NO_MOTION_TASK = 194_901
NOT_ALLOWED = 194_902
FRAMES_CONTRADICT = 194_904
NOT_SIMULATED = 194_905
WORLD_ZONE = 194_907
GUIDED = 194_911
NO_GEOMETRY = 195_900

_P = ParamSpec("_P")
_R = TypeVar("_R")


@dataclass(frozen=True, slots=True)
class _Error:
    """A recoverable error; its text contains the values of the fault."""

    name: str
    text: str = ""

    def made(self, *facts: object) -> RapidError:
        return RapidError(self.name, self.text.format(*facts))


@dataclass(frozen=True, slots=True)
class _OutOfReach(_Error):
    """A place that the robot cannot reach."""

    def made(self, *facts: object) -> RapidError:
        return MotionError(self.name, self.text.format(*facts))


@dataclass(frozen=True, slots=True)
class _Stop:
    """An event that stops the task."""

    event: int
    title: str
    text: str = ""

    def made(self, *facts: object) -> FatalError:
        return FatalError(self.event, self.title, *filter(None, [self.text.format(*facts)]))


_MEANINGS: dict[FaultReason, _Error | _Stop] = {
    FaultReason.OUT_OF_REACH: _OutOfReach("ERR_OUTSIDE_REACH", "on the way; {}"),
    FaultReason.OUT_OF_REACH_IN_CORNER: _OutOfReach("ERR_OUTSIDE_REACH", "in a corner"),
    FaultReason.OUT_OF_REACH_WITH_WRIST: _OutOfReach("ERR_OUTSIDE_REACH", "with SingArea \\Wrist"),
    FaultReason.OUT_OF_REACH_WITH_AXIS_4: _OutOfReach(
        "ERR_OUTSIDE_REACH", "with SingArea \\LockAxis4"
    ),
    FaultReason.NO_POSTURE: _OutOfReach("ERR_OUTSIDE_REACH", "{}"),
    FaultReason.NO_POSTURE_IN_RANGE: _OutOfReach("ERR_ROBLIMIT", "{}"),
    FaultReason.OUT_OF_RANGE: _OutOfReach("ERR_ROBLIMIT", "{}"),
    FaultReason.SINGULARITY: _Stop(
        SINGULARITY, "Close to singularity", "an axis would have to turn at once"
    ),
    FaultReason.NO_CIRCLE: _Stop(
        CIRCLE_UNCERTAIN, "Circle uncertain", "the three points make no circle"
    ),
    FaultReason.CIRCLE_TOO_LONG: _Stop(
        CIRCLE_UNCERTAIN, "Circle uncertain", "more than 240 degrees in one MoveC"
    ),
    FaultReason.CONFIGURATION: _Stop(
        NOT_COMPATIBLE,
        "Position not compatible",
        "the way ends in configuration {}, programmed is {}",
    ),
    FaultReason.NO_GEOMETRY: _Stop(
        NO_GEOMETRY,
        "No geometry",
        "{}: the configuration has no chain, so the robot moves in joints only",
    ),
    FaultReason.NO_SPEED: _Error("ERR_ARGVALERR", "a part of the move has speed 0"),
    FaultReason.TOO_MANY_CONCURRENT: _Error("ERR_CONC_MAX"),
    FaultReason.NOTHING_STORED: _Stop(NOT_ALLOWED, "No path is stored"),
}


def in_rapid(fault: MotionFault) -> RapidError | FatalError:
    """Return a planner's fault as a RAPID error or event."""
    return _MEANINGS[fault.refusal].made(*fault.facts)


def planned(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Wrap a function so that planner faults become RAPID errors."""

    @wraps(function)
    def call(*arguments: _P.args, **named: _P.kwargs) -> _R:
        try:
            return function(*arguments, **named)
        except MotionFault as fault:
            raise in_rapid(fault) from fault

    return call


# -- Settings of programs --------------------------------------------------------------------------
#
# Settings of programs for a robot, in RAPID values. The planner does not use them.


NO_OFFSETS = (0.0,) * 6


@dataclass(slots=True)
class RobotData:
    """Settings of one robot.

    Tool and work object survive PP to main, the others do not.
    """

    tool: Record | None = None
    """tooldata of the last move, None before the first."""
    work_object: Record | None = None
    """wobjdata of the last move, None before the first or when it had none."""
    external_offset: tuple[float, ...] = NO_OFFSETS
    """Offsets of eax_a to eax_f (EOffsOn), deg and mm."""
    partners: frozenset[str] = frozenset()
    """Tasks that move synchronously with this one, itself included (SyncMoveOn); lower case."""
    suspended: bool = False
    """SyncMoveSuspend"""
    carried: float = 0.0
    """kg of the last move, tool and payload."""
    extra: dict[str, object] = field(default_factory=dict)
    """Settings without an effect on motion: programs can write and read them."""

    @classmethod
    def of(cls, group: MotionGroup) -> "RobotData":
        """Return new settings of a robot, reset together with it."""
        data = cls()
        group.on_reset.append(data.reset)
        return data

    def use(self, tool: Record | None, work_object: Record | None) -> None:
        """Activate tool and work object of the next move."""
        self.tool = tool.copy() if tool is not None else None
        self.work_object = work_object.copy() if work_object is not None else None

    def reset(self) -> None:
        """Reset the settings, for PP to main."""
        self.external_offset = NO_OFFSETS
        self.partners = frozenset()
        self.suspended = False
        self.carried = 0.0
        self.extra.clear()
