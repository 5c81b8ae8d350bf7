"""Sections, attributes and words of cfg files, by release, with sources.

Sources: backups of controllers of RobotWare 5.15 (KRAKER), 5.61 (MCUBE), 6.03-6.14 and 7.5-7.6,
ABB's own files for 7.x (RARO, the DAP example on HOME of a 7.6); docs/rapid/cfg.md names them.
Unconfirmed words are not listed, and are rejected in a generated file.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Argument = Literal["", "unit", "task"]


@dataclass(frozen=True, slots=True)
class SystemSignal:
    """A status or an action: its signal type and its arguments."""

    name: str
    argument: Argument = ""
    """Its subject: a mechanical unit in Arg1, a task in Arg2 (an input: Arg6, Arg7)."""
    needed: bool = False
    others: tuple[str, ...] = ()
    """Other attributes seen with it."""
    kind: str = "DO"


def _table(*rows: SystemSignal) -> Mapping[str, SystemSignal]:
    return {row.name.casefold(): row for row in rows}


OUTPUTS_TO_6 = _table(
    # Statuses without an argument: backups 5.61-6.14.
    *map(SystemSignal, ("CycleOn", "EmStop", "AutoOn", "MotOnState", "MotorOn", "MotOffState")),
    *map(SystemSignal, ("RunchOk", "ProdExecError", "RegainDistError", "PFError")),
    # Backups and ABB's files always give a task.
    SystemSignal("Error", "task", needed=True),
    SystemSignal("TaskExecuting", "task", needed=True),
    SystemSignal("PPMoved", "task", others=("Arg3",)),
    # 6.13 with the unit, 6.04 without.
    SystemSignal("MechUnitNotMoving", "unit"),
    *(SystemSignal(name, "unit") for name in ("MotSupTrigg", "MotSupOn", "LimitSpeed")),
)
OUTPUTS_7 = _table(
    *map(SystemSignal, ("MotorOn", "AutoOn", "CycleOn")),
    SystemSignal("Error", "task", needed=True),
    SystemSignal("TCPSpeed", "unit", kind="AO"),
)
OPEN_7 = _table(
    # The spelling in RobotWare 7 files is unconfirmed.
    *map(SystemSignal, ("MotOnState", "EmStop")),
    SystemSignal("MechUnitNotMoving", "unit"),
    SystemSignal("TaskExecuting", "task", needed=True),
)
_START = ("Arg1",)
INPUTS = _table(
    SystemSignal("Start", others=_START, kind="DI"),
    SystemSignal("StartMain", others=_START, kind="DI"),
    SystemSignal("MotOnStart", others=_START, kind="DI"),
    SystemSignal("LoadStart", others=_START, kind="DI"),
    SystemSignal("Load", others=_START, kind="DI"),
    SystemSignal("LimitSpeed", "unit", kind="DI"),
    SystemSignal("PpToMain", "task", kind="DI"),
    # Every YuMi's backup has a DO here.
    SystemSignal("CollAvoidance", kind="DO"),
    *(
        SystemSignal(name, kind="DI")
        for name in (
            *("ResetError", "ResetEstop", "MotorOn", "MotorOff", "SoftStop"),
            *("Stop", "StopCycle", "StopInstr", "QuickStop", "SysReset"),
        )
    ),
)
SHELVES = ("POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET", "STEP")
TRUST_LEVELS = ("None", "SysStop", "SysHalt", "SysFail")
TASK_TYPES = ("NORMAL", "STATIC", "SEMISTATIC")

_TASKS = "Name Type MotionTask TrustLevel UseMechanicalUnitGroup Task_in_forground Entry"
_SIGNAL = "Name SignalType Access Default Category Size MaxLog MinLog MaxPhys MinPhys EncType"
_SIGNAL += " MaxPhysLimit MinPhysLimit MaxBitVal MinBitVal SafeLevel FiltAct SysfailReset"
_OUT, _IN = "Arg1 Arg2 Arg3 Arg4", "Arg1 Arg2 Arg3 Arg4 Arg5 Arg6 Arg7"
_CROSS = "Name Res Act1 Act1_invert" + "".join(
    f" Oper{n} Act{n + 1} Act{n + 1}_invert" for n in range(1, 5)
)
_COMMON = {
    # [mem] The message queue's three and BindRef (5.61) are not part of a delivered file.
    ("SYS", "CAB_TASKS"): f"{_TASKS} BindRef RmqType RmqMaxMsgSize RmqMaxNoOfMsg",
    ("SYS", "CAB_TASK_MODULES"): "File ModName Task AllTask AllMotionTask Shared Hidden Install",
    ("SYS", "CAB_EXEC_HOOKS"): "Routine Shelf Task AllTask AllMotionTask SeqNo",
    ("SYS", "SYS_MISC"): "Name Value",
    ("EIO", "EIO_CROSS"): _CROSS,
    ("EIO", "EIO_ACCESS"): "Name Rapid LocalManual LocalAuto RemoteManual RemoteAuto",
}
_GROUP = "Name Robot UseMotionPlanner" + "".join(f" MechanicalUnit_{n}" for n in range(1, 7))
_EGM = "name ext_motion_level do_not_restart_after_motors_off return_to_program_position"
_EGM += " ramp_time ext_motion_Kp ext_motion_filter_bandwidth"
_COM_TRP = "Name Type PhyChannel RemoteAdress RemotePortNumber"


def sections(main: int, *, multimove: bool) -> Mapping[tuple[str, str], frozenset[str]]:
    """Return the allowed attributes of sections, without case."""
    rows = dict(_COMMON)
    if multimove:
        rows["SYS", "MECHANICAL_UNIT_GROUP"] = _GROUP
    if main >= 6:
        # Its one attribute without a source is not written [mem].
        rows["MOC", "EXT_MOTION_DATA"] = _EGM
    if main <= 5:
        rows["EIO", "EIO_SIGNAL"] = f"{_SIGNAL} Unit UnitMap SignalLabel"
    else:
        rows["EIO", "EIO_SIGNAL"] = f"{_SIGNAL} Device DeviceMap Label"
    if main <= 6:
        rows["EIO", "SYSSIG_OUT"] = f"Status Signal {_OUT}"
        rows["EIO", "SYSSIG_IN"] = f"Action Signal {_IN}"
        rows["SIO", "COM_TRP"] = _COM_TRP
    else:
        rows["SYS", "SYSSIG_OUT"] = f"Status Name {_OUT}"
        rows["SYS", "SYSSIG_IN"] = f"Action Name {_IN}"
        rows["SIO", "FIREWALL_MANAGEMENT"] = (
            "Name EnableOnPublicNet EnableOnPrivateNet EnableOnIONet"
        )
        rows["SIO", "UDPUC_HOST"] = "Name Type RemoteAddress RemotePortNumber LocalPortNumber"
    return {place: frozenset(names.casefold().split()) for place, names in rows.items()}
