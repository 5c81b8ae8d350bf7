"""Assumptions of the motion model as switches. docs/rapid/motion-model.md gives their sources."""

from dataclasses import dataclass
from typing import Literal

from rapidgen.axes.kinematics import ConfigurationCheck


@dataclass(frozen=True, slots=True)
class MotionSettings:
    """How the controller plans and moves where no public source settles it."""

    planning_lead: float = 0.1
    """s before the last chance to plan a corner at which a fly-by move lets the program go on
    (S4 overview p.5-25: about 0.1 s)."""

    ramp_time: float = 0.09
    """s in which acceleration builds up to its full value with AccSet 100, 100; 0: at once, no
    limit of jerk. ABB publishes no figure; a ramp of one period does not excite a vibration of
    20 Hz, about where the first one of an arm lies. Own choice."""

    quick_factor: float = 2.0
    """Deceleration of a quick or emergency stop, in units of the normal one. Memory."""

    stop_waits: bool = False
    """StopMove lets the program go on only when the robot stands. False: S4 datasys
    2-StopMove-1."""

    stop_owner: Literal["kind", "task"] = "kind"
    """StartMove takes back the StopMove of any task of its kind (motion task or not, the two that
    IsStopMoveAct knows), or only that of its own task. No source."""

    refresh_timed: bool = True
    """SpeedRefresh stretches moves with \\T, too. No source."""

    refresh_lasts: bool = False
    """SpeedRefresh holds for later moves, too, until PP to main; or for the move under way only.
    3HAC050917 speaks of the ongoing movement. No source; the strict answer."""

    refresh_standing: bool = False
    """SpeedRefresh while the robot stands acts on what moves next; or it does nothing, as seen on
    a RobotWare 7.21 controller (Nantaphat-Yoktaworn/node-red-contrib-abb-gofa)."""

    velset_timed: bool = True
    """VelSet stretches a \\T, too (S4 datasys 2-VelSet-1)."""

    cleared_move: Literal["hang", "return"] = "hang"
    """What a move instruction does whose path ClearPath removes while it waits: it never returns,
    as seen on a RobotWare 7.21 controller in two programs of one author
    (Nantaphat-Yoktaworn/node-red-contrib-abb-gofa), or it does."""

    undefined_load: Literal["stop", "report"] = "stop"
    """A negative mass of a tool or payload: event 41438 stops the program, or is a warning. Seen
    with EGM only (ros-industrial/abb_libegm, issue 73); at every move memory. The strict answer."""

    configuration_check: ConfigurationCheck = "turn"
    """What ConfJ and ConfL accept where cfx tells the postures apart: "turn", every axis within
    half a turn of the middle of its quarter, as public programs need that run on controllers;
    "quarter", within 45 degrees of it (S4 overview 5-33, of robots without cfx; these are always
    checked so)."""

    zero_length: Literal["skip", "wait"] = "skip"
    """A move to where the path already ends: no time at all, or its \\T."""

    lever: float = 1.0
    """m from an axis to the TCP, for speeds and zones in mm of robots without a chain."""

    corner_size: float = 0.87
    """Part of the zone that the parabola of a corner takes. RobotStudio and a real IRB 6640 pass a
    point at 0.87 of the distance that a parabola of the whole zone would have, at low speed and in
    zones of 1 to 100 mm (logs of hehonglu123/ABB_Primitive_Study)."""

    shortest_corner: float = 0.004
    """s that the way through the zone of a linear or circular move takes at least, one period of
    the interpolation: RobotStudio passes z1 at about 0.5 m/s before the smoothing, also where the
    path goes straight on, and z10 at full speed (the same logs)."""

    corner_share: float = 0.9
    """Part of the axes' acceleration that a corner may use to turn; the rest is for the speed."""

    conc_limit: int = 5
    """Consecutive \\Conc moves (S4 datasys 2-MoveJ-1)."""

    emergency_stop: Literal["brakes", "path"] = "brakes"
    """Emergency stop by the brakes (category 0), off the path; or controlled on the path with
    `quick_factor` (category 1). Which one is a matter of the cell. A power failure is always the
    former (S4 overview p.5-23)."""

    path_distance: float = 0.01
    """m off the path beyond which StartMove fails with ERR_PATHDIST (S4 datasys 2-StartMove-1)."""

    cleared_distance: Literal["counts", "forgotten"] = "counts"
    """Whether StartMove, and a start of the program, still ask how far a robot is from a path that
    ClearPath has removed while it stood off it. No source; the strict answer."""

    stop_move_reset: Literal["releases", "keeps"] = "releases"
    """StopMoveReset takes back a StopMove of its kind of task, however far the robot is from its
    path, and nothing moves (3HAC050917: it resets the stop move status without starting any
    movement); or it resets what an error has stopped only, and a StopMove stays."""

    path_angle: float = 0.3490658503988659
    """rad (20 degrees) of the TCP off the path, the same (S4 datasys 2-StartMove-1)."""

    regain_distance: float = 0.5
    """m off the path beyond which a program does not start (a controller's default in
    automatic mode, from public system parameters)."""

    settle: float = 0.0
    """s after the end of motion until a stop point counts as reached. No figure is public."""

    servo_lag: float = 0.0
    """s by which the measured position follows the commanded one (S4 overview p.5-26: 0 to 1).

    0.035 for an IRB 6640, whose feedback ends that much later than RobotStudio's command (median of
    the same logs). Commanded positions, paths and durations never change. What a program reads at
    a stop point (CRobT, CJointT) and the feedback of positions do, so it is off."""
