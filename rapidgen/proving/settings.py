"""How the controller under the driver behaves: the settings under which every case runs."""

from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace

from rapidgen.config.model import RobotConfig
from rapidgen.controller.faults import FaultPlan
from rapidgen.machine.costs import Costs
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid.switches import NOT_THE_DRIVERS, Switches, parse_switches


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

    def early(self) -> "Setting":
        """The same on a controller of which no task has run yet: no robot that settles first."""
        return replace(self, motion=replace(self.motion, settle=0.0))


def settings(config: RobotConfig) -> dict[str, Setting]:
    """The default for every motion group, two hostile schedules, and every switch inverted.

    A controller's behaviour that is only remembered must not decide whether the driver works.
    """
    found = {
        "": Setting(coverage=True),
        "random schedule": Setting(seed=1, random_schedule=True),
        "switch at PERS": Setting(seed=1, random_schedule=True, switch_at_pers=True),
    }
    for number, group in enumerate(config.groups[1:], 1):
        found[group.name] = Setting(group=number, coverage=True)
    found.update({said: Setting(dialect=parse_switches(said.lower())) for said in _inverted()})
    found.update({said: Setting(motion=motion) for said, motion in _MOTION.items()})
    return found


# Open questions about motion, each answered the other way.
_MOTION = {
    "stop_waits=True": MotionSettings(stop_waits=True),
    "stop_owner=task": MotionSettings(stop_owner="task"),
    "refresh_timed=False": MotionSettings(refresh_timed=False),
    "cleared_move=return": MotionSettings(cleared_move="return"),
    "cleared_distance=forgotten": MotionSettings(cleared_distance="forgotten"),
    "stop_move_reset=keeps": MotionSettings(stop_move_reset="keeps"),
    "range_error=fatal": MotionSettings(range_error="fatal"),
    "zero_length=wait": MotionSettings(zero_length="wait"),
    "planning_lead=0.02": MotionSettings(planning_lead=0.02),
    "servo_lag=0.05": MotionSettings(servo_lag=0.05),
    "settle=0.2": MotionSettings(settle=0.2),
    "emergency_stop=path": MotionSettings(emergency_stop="path"),
    "quick_factor=1.0": MotionSettings(quick_factor=1.0),
}
# What the driver cannot do without. Where it is otherwise a task ends at its start or every link
# breaks, and nothing moves: tests/proving/test_variants.py.
NEEDED = frozenset({"unpack_ulint", "alias_by_name"})


def _inverted() -> Iterable[str]:
    for switch in fields(Switches):
        if switch.name in NEEDED | NOT_THE_DRIVERS:
            continue
        if isinstance(switch.default, bool):
            yield f"{switch.name}={not switch.default}"
        elif isinstance(switch.default, str):
            for other in getattr(switch.type, "__args__", ()):
                if other != switch.default:
                    yield f"{switch.name}={other}"
