"""Mechanical units of a controller, as its cfg describes them: frozen data.

MECHANICAL_UNIT names SINGLEs (one axis each) or a ROBOT without a TCP (a gantry). Their JOINTs give
the logical axis (7 is eax_a), ARM the limits, TRANSMISSION whether the axis rotates, and with
STRESS_DUTY_CYCLE its speed, ACC_DATA its acceleration. ARM_TYPE and ROBOT_TYPE give the geometry of
a gantry. Lengths m, angles rad.

A product of ABB is in a backup by its type only: its kind is taken from the type's name, and its
speed is not known. `UnitAxis.assumed` lists what the cfg does not contain.
"""

from dataclasses import dataclass, field
from typing import Literal

from rapidgen.config.model import Placement
from rapidgen.system.base.mechanics_cfg import (
    FIRST_EXTERNAL,
    arm_of_joint,
    external_units,
    internal_cfg,
)
from rapidgen.system.cfg import Instance
from rapidgen.system.cfg_database import CfgDatabase, value_of
from rapidgen.system.controller_cfg import ControllerCfg

MAX_AXES = 6
"""Axes of one unit, and external axes of one robot: eax_a to eax_f."""
_SIX_DIGITS = 5e-6
"""Half a unit of the sixth digit: a controller writes 165 degrees as 2.87979 rad, which is less."""
TRACK_TYPES = ("TRACK", "IRBT", "RTT", "T4004", "T6004", "T7004", "TRAVELTRACK")
"""Beginnings of the types of tracks [backups: IRBT4004_1; product names]."""


@dataclass(frozen=True, slots=True)
class UnitAxis:
    """One axis. `offset`, `attitude` and `turn` place it after the axis before."""

    joint: str
    logical: int
    linear: bool
    lower: float
    upper: float
    speed: float | None = None
    acceleration: float | None = None
    locked: bool = False
    follows: str = ""
    """Joint of another unit that this one is linked to (FollowerTo)."""
    length: float = 0.0
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    attitude: float = 0.0
    turn: float = 0.0
    assumed: tuple[str, ...] = ()

    @property
    def external(self) -> str:
        """Return the axis in RAPID, such as `eax_a`."""
        return f"eax_{'abcdef'[self.logical - FIRST_EXTERNAL]}"


@dataclass(frozen=True, slots=True)
class MechanicalUnit:
    """A unit of external axes; `base` is its base frame, `pose` that of its first axis in it."""

    name: str
    kind: Literal["single", "robot"]
    type: str
    axes: tuple[UnitAxis, ...]
    base: Placement
    pose: Placement = field(default_factory=Placement)
    active: bool = True
    """Active after the start of the controller."""
    may_deactivate: bool = True


@dataclass(frozen=True, slots=True)
class RobotMount:
    """Where a robot stands: its base frame, the unit that moves it, limits of axes 1 to 6."""

    base: Placement
    moved_by: str
    limits: tuple[tuple[float, float] | None, ...]
    units: tuple[MechanicalUnit, ...]
    unknown: tuple[str, ...] = ()
    """Units without usable axes."""


def mount_of(cfg: ControllerCfg, robot: str) -> RobotMount | None:
    """Return how a robot stands and moves with its units; None without such a robot."""
    database = CfgDatabase(cfg, internal_cfg(cfg, ()))
    instance = database.instance("MOC", "ROBOT", robot)
    if instance is None:
        return None
    limits = tuple(_limits(database, instance.text(f"use_joint_{n}")) for n in range(6))
    names = external_units(cfg, robot)
    units = [unit for name in names if (unit := _unit(database, name)) is not None]
    missing = {name.casefold() for name in names} - {unit.name.casefold() for unit in units}
    return RobotMount(
        _frame("ROBOT", instance, "base_frame", "orient"),
        instance.text("base_frame_coordinated"),
        limits,
        tuple(units),
        tuple(name for name in names if name.casefold() in missing),
    )


def _unit(database: CfgDatabase, name: str) -> MechanicalUnit | None:
    """Return a unit; None if the cfg lacks its axes."""
    row = database.instance("MOC", "MECHANICAL_UNIT", name)
    active = row is None or row.flag("activate_at_start_up")
    forbidden = row is not None and row.flag("deactivation_forbidden")
    robot = row.text("use_robot") if row is not None else ""
    if robot:
        return _gantry(database, name, robot, active, not forbidden)
    used = [row.text(f"use_single_{n}") for n in range(MAX_AXES)] if row is not None else [name]
    singles = [database.instance("MOC", "SINGLE", one) for one in used if one]
    axes = [axis for one in singles if one is not None and (axis := _single_axis(database, one))]
    first = next((one for one in singles if one is not None), None)
    if first is None or not axes:
        return None
    return MechanicalUnit(
        name,
        "single",
        first.text("use_single_type"),
        tuple(axes),
        _frame("SINGLE", first, "base_frame", "orient"),
        active=active,
        may_deactivate=not forbidden,
    )


def _gantry(
    database: CfgDatabase, name: str, robot: str, active: bool, may_deactivate: bool
) -> MechanicalUnit | None:
    row = database.instance("MOC", "ROBOT", robot)
    if row is None:
        return None
    kind = database.instance("MOC", "ROBOT_TYPE", row.text("use_robot_type"))
    joints = [row.text(f"use_joint_{n}") for n in range(MAX_AXES)]
    axes = [axis for one in joints if one and (axis := _axis(database, one, None)) is not None]
    if kind is None or not axes:
        return None
    return MechanicalUnit(
        name,
        "robot",
        row.text("use_robot_type"),
        tuple(axes),
        _frame("ROBOT", row, "base_frame", "orient"),
        _frame("ROBOT_TYPE", kind, "base_pose", "rot"),
        active,
        may_deactivate,
    )


def _single_axis(database: CfgDatabase, single: Instance) -> UnitAxis | None:
    name = single.text("use_single_type")
    kind = database.instance("MOC", "SINGLE_TYPE", name)
    mechanics = kind.text("mechanics").upper() if kind is not None else ""
    linear: bool | None = None
    if mechanics in ("TRACK", "FREE_ROT"):
        linear = mechanics == "TRACK"
    elif name.upper().startswith(TRACK_TYPES):
        linear = True
    return _axis(database, single.text("use_joint"), linear)


def _axis(database: CfgDatabase, name: str, linear: bool | None) -> UnitAxis | None:
    """Return an axis; None without a JOINT of the external axes 7 to 12, or without limits."""
    joint = database.instance("MOC", "JOINT", name)
    if joint is None:
        return None
    place = int(joint.number("logical_axis"))
    limits = _limits(database, name)
    if limits is None or not FIRST_EXTERNAL <= place < FIRST_EXTERNAL + MAX_AXES:
        return None
    assumed = []
    own = _saved(database, "TRANSMISSION", joint.text("use_transmission"))
    if own is not None:
        linear = not own.flag("rotating_move")
    elif linear is None:
        linear = False
        assumed.append("that it rotates")
    arm = database.instance("MOC", "ARM", joint.text("use_arm"))
    assert arm is not None  # it has the limits
    kind = database.instance("MOC", "ARM_TYPE", arm.text("use_arm_type"))
    row = kind if kind is not None else Instance(())
    speed = _speed(database, joint, own)
    data = database.instance("MOC", "ACC_DATA", arm.text("use_acc_data"))
    acceleration = data.number("wc_acc") if data is not None else 0.0
    if speed is None:
        assumed.append("speed")
    if not acceleration:
        assumed.append("acceleration")
    return UnitAxis(
        name,
        place,
        linear,
        *limits,
        speed,
        acceleration or None,
        joint.flag("lock_joint_in_ipol"),
        joint.text("follower_to_joint"),
        row.number("length"),
        (row.number("offset_x"), row.number("offset_y"), row.number("offset_z")),
        row.number("attitude"),
        row.number("theta_home_position"),
        tuple(assumed),
    )


def _saved(database: CfgDatabase, section: str, name: str) -> Instance | None:
    """Return an instance that is in the file."""
    instance = database.instance("MOC", section, name)
    if instance is None or database.is_internal("MOC", section, instance):
        return None
    return instance


def _speed(database: CfgDatabase, joint: Instance, transmission: Instance | None) -> float | None:
    """Return the axis speed: that of the motor, by the transmission (motor rad per m or rad)."""
    drive = database.instance("MOC", "DRIVE_SYSTEM", joint.text("use_drive_system"))
    if drive is None or transmission is None:
        return None
    cycle = database.instance("MOC", "STRESS_DUTY_CYCLE", drive.text("use_stress_duty_cycle"))
    ratio = abs(transmission.number("transm_joint"))
    motor = cycle.number("speed_absolute_max") if cycle is not None else 0.0
    return motor / ratio if motor and ratio else None


def _limits(database: CfgDatabase, joint: str) -> tuple[float, float] | None:
    row = database.instance("MOC", "JOINT", joint)
    name = row.text("use_arm") if row is not None else arm_of_joint(database.cfg, joint)
    arm = database.instance("MOC", "ARM", name)
    if arm is None:
        return None
    lower, upper = (value_of("MOC", "ARM", arm, f"{end}_joint_bound") for end in ("lower", "upper"))
    if not isinstance(lower, int | float) or not isinstance(upper, int | float) or lower >= upper:
        return None
    return lower - _SIX_DIGITS * abs(lower), upper + _SIX_DIGITS * abs(upper)


def _frame(section: str, row: Instance, name: str, turn: str) -> Placement:
    values = []
    for end in (*(f"pos_{axis}" for axis in "xyz"), *(f"{turn}_u{n}" for n in range(4))):
        value = value_of("MOC", section, row, f"{name}_{end}")
        values.append(float(value) if isinstance(value, int | float) else 0.0)
    x, y, z, *quaternion = values
    length = sum(v * v for v in quaternion) ** 0.5
    if not length:
        return Placement((x, y, z))
    u0, u1, u2, u3 = (v / length for v in quaternion)
    return Placement((x, y, z), (u0, u1, u2, u3))
