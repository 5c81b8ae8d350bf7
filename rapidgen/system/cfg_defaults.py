"""Defaults of attributes that a cfg file leaves out, by domain and type, with their sources.

A controller writes an attribute only where it differs from its default. A flag that is left out is
FALSE and needs no entry. An attribute without an entry has a default that no source gives;
`ReadCfgData` of it fails with ERR_CFG_NOTFND and says so.

Sources: [b] backups: a row of all types with the attribute shows another value, and the rows
without it agree with the value here (docs/rapid/cfg.md names the backups). [m] the reference manual
of system parameters, as remembered. [r] a real controller with RobotWare 7.21.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from rapidgen.system.cfg import Scalar


@dataclass(frozen=True, slots=True)
class Default:
    """The default of one attribute and where it comes from: `backups`, `manual`, `controller`."""

    name: str
    value: Scalar
    source: str


def _rows(source: str, **values: Scalar) -> dict[str, Default]:
    return {name.casefold(): Default(name, value, source) for name, value in values.items()}


_FRAME: Final = {
    f"base_frame_{name}": float(name == "orient_u0")
    for name in (*(f"pos_{axis}" for axis in "xyz"), *(f"orient_u{n}" for n in range(4)))
}
_POSE: Final = {
    f"base_pose_{name}": float(name == "rot_u0")
    for name in (*(f"pos_{axis}" for axis in "xyz"), *(f"rot_u{n}" for n in range(4)))
}
DEFAULTS: Final[Mapping[tuple[str, str], Mapping[str, Default]]] = {
    ("SYS", "CAB_TASKS"): _rows("controller", Type="SEMISTATIC", TrustLevel="SysFail")
    | _rows("backups", Entry="main", UseMechanicalUnitGroup="", Task_in_forground="")
    | _rows("manual", RmqMaxMsgSize=400, RmqMaxNoOfMsg=5),
    # Backups of 6.04 to 6.13 leave Value out where the function is off.
    ("SYS", "SYS_MISC"): _rows("backups", Value=0),
    ("SYS", "CAB_TASK_MODULES"): _rows("backups", ModName="", Task=""),
    ("SYS", "CAB_EXEC_HOOKS"): _rows("backups", Task="", SeqNo=0),
    ("EIO", "EIO_SIGNAL"): _rows(
        "manual",
        Access="Default",
        Category="",
        Label="",
        Device="",
        DeviceMap="",
        Unit="",
        UnitMap="",
        SignalLabel="",
        Default=0,
        SafeLevel="DefaultSafeLevel",
        EncType="UNSIGNED",
        MaxLog=0,
        MinLog=0,
        MaxPhys=0,
        MinPhys=0,
        MaxPhysLimit=0,
        MinPhysLimit=0,
        MaxBitVal=0,
        MinBitVal=0,
        FiltAct=0,
        FiltPas=0,
    ),
    ("EIO", "SYSSIG_OUT"): _rows("backups", Arg1="", Arg2="", Arg3="", Arg4=""),
    ("EIO", "SYSSIG_IN"): _rows("backups", **{f"Arg{n}": "" for n in range(1, 8)}),
    ("SIO", "COM_TRP"): _rows("backups", PhyChannel="", RemoteAdress="")
    | _rows("manual", RemotePortNumber=6510),
    ("SIO", "UDPUC_HOST"): _rows("manual", RemotePortNumber=6510, LocalPortNumber=0),
    ("MOC", "ROBOT"): _rows(
        "backups",
        base_frame_coordinated="",
        gravity_alpha=0.0,
        gravity_beta=0.0,
        gamma_rotation=0.0,
        **_FRAME,
    ),
    ("MOC", "SINGLE"): _rows("backups", base_frame_coordinated="", **_FRAME),
    ("MOC", "ROBOT_TYPE"): _rows("backups", **_POSE),
    ("MOC", "ARM"): _rows("backups", cal_position=0.0, use_check_point="", use_arm_calib=""),
    ("MOC", "ARM_TYPE"): _rows(
        "backups",
        length=0.0,
        offset_x=0.0,
        offset_y=0.0,
        offset_z=0.0,
        attitude=0.0,
        theta_home_position=0.0,
    ),
    ("MOC", "ARM_CALIB"): _rows("backups", cal_offset=0.0),
    ("MOC", "MECHANICAL_UNIT"): _rows("backups", use_activation_relay="", use_brake_relay=""),
    ("MOC", "JOINT"): _rows("backups", follower_to_joint="", use_process="", drive_module=1),
    ("MOC", "EXT_MOTION_DATA"): _rows(
        "manual",
        ext_motion_level=1,
        ramp_time=0.5,
        ext_motion_Kp=5.0,
        ext_motion_filter_bandwidth=20.0,
    ),
    ("MOC", "TRANSMISSION"): _rows("manual", transm_joint=1.0),
}


def default_of(domain: str, section: str, attribute: str) -> Default | None:
    """Return the default of an attribute, named without case; None if no source gives it."""
    known = DEFAULTS.get((domain.upper(), section.upper()), {})
    return known.get(attribute.casefold())
