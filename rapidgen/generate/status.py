"""Virtual outputs with a status of the controller, and their spelling.

docs/rapid/cfg.md has the source of each row.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class StatusSignal:
    """A signal and the system output that drives it."""

    base: str
    """Its name, as in abb_driver, so that an upgraded controller keeps its signals."""
    function: str
    """The RAPID function (without ROS_) that reads it."""
    text: str
    spelled: Mapping[int, str]
    """Status in SYSSIG_OUT, by first RobotWare version."""
    seen: frozenset[int]
    """Generations with a cfg file that has the status; the others are open."""
    one_when_well: bool = False
    """True if it is 1 while the robot waits for work: one that was never 1 may have no source."""
    by_routines: bool = False
    """True if event routines of the motion task also see its end."""
    of: Literal["", "unit", "task"] = ""
    """Subject of the status: the controller, or a group's mechanical unit or motion task."""

    def status(self, generation: int) -> str:
        """Return the spelling of a RobotWare generation."""
        return self.spelled[max(since for since in self.spelled if since <= generation)]

    def is_open(self, generation: int) -> bool:
        """True if no file of that generation had it."""
        return generation not in self.seen


STATUS_SIGNALS = (
    StatusSignal(
        "signalMotorOn",
        "motors_on",
        "Return whether the motors are on (ROS_TRI_...).",
        {5: "MotOnState", 7: "MotorOn"},
        frozenset({5, 6, 7}),
        one_when_well=True,
    ),
    StatusSignal(
        "signalRobotEStop",
        "emergency_stop",
        "Return whether an emergency stop is active.",
        {5: "EmStop"},
        frozenset({5, 6}),
    ),
    StatusSignal(
        "signalExecutionError",
        "controller_error",
        "Return whether the motion task's program has stopped with an error.",
        {5: "Error"},
        frozenset({5, 6, 7}),
        of="task",
    ),
    StatusSignal(
        "signalRobotNotMoving",
        "standing",
        "Return whether the robot stands.",
        {5: "MechUnitNotMoving"},
        frozenset({5, 6}),
        one_when_well=True,
        of="unit",
    ),
    StatusSignal(
        "signalRosMotionTaskExecuting",
        "executing",
        "Return whether the motion task's program is running.",
        {5: "TaskExecuting"},
        frozenset({5, 6}),
        one_when_well=True,
        by_routines=True,
        of="task",
    ),
)
