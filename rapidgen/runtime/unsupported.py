"""Built-ins that are known and checked, but that nothing here stands behind, and why.

Loading a program says which of them it uses; reaching one stops the task with an event.
"""

from typing import Final

_GROUPS: Final[tuple[tuple[str, str], ...]] = (
    (
        "externally guided motion (option 689-1) is not simulated",
        """EGMGetId EGMGetState EGMSetupUC EGMSetupAI EGMSetupAO EGMSetupLTAPP EGMActJoint
        EGMActPose EGMActMove EGMRunJoint EGMRunPose EGMMoveL EGMMoveC EGMStop EGMReset
        EGMStreamStart EGMStreamStop EGMWaitCond""",
    ),
    ("the servo loops are not simulated", "TuneServo TuneReset"),
    (
        "there are no I/O units: every signal is a virtual one",
        "IOEnable IODisable IOUnitState PackDNHeader",
    ),
    (
        "conditions that the controller evaluates by itself are not simulated",
        "GetMaxNumberOfCyclicBool SetupCyclicBool RemoveCyclicBool RemoveAllCyclicBool",
    ),
    (
        "path correction is not simulated",
        "CorrCon CorrDiscon CorrClear CorrWrite CorrRead",
    ),
    (
        "conveyors are not simulated",
        "WaitWObj DropWObj WaitSensor SyncToSensor DropSensor",
    ),
    (
        "there is no sensor to talk to",
        """SenDevice WriteVar ReadVar WriteBlock ReadBlock SiConnect SiClose SiGetCyclic
        SiSetCyclic IVarValue""",
    ),
    (
        "force control (option 661-2) is not simulated",
        """FCCalib FCAct FCDeact FCRefStart FCRefStop FCPress1LStart FCPressL FCPressC FCPressEnd
        FCLoadID""",
    ),
    ("linked motors are not simulated", "Linked_m_exe"),
    (
        "BullsEye measures a real tool with its beam: there is neither",
        "BESetupToolJ BECheckTcp BEUpdateTcp BERefPointer BETcpExtend BEDebugState",
    ),
    (
        "the Production Manager's engine, which calls parts and menus, is not simulated",
        "ExecEngine PMgrGetNextPart PMgrSetNextPart PMgrRunMenu",
    ),
    (
        "paths of seams are not recorded, and weld data hold for a whole movement",
        "ArcRepL ArcRefresh",
    ),
    (
        "SmarTac feels a part with the torch: there is neither",
        "Search_1D Search_Groove Search_Part PDispAdd",
    ),
    (
        "the controller's path recorder is not simulated",
        """PathRecStart PathRecStop PathRecMoveBwd PathRecMoveFwd PathRecValidBwd PathRecValidFwd
        StepBwdPath""",
    ),
    (
        "continuous processes are not simulated",
        "TriggStopProc TriggSpeed TriggRampAO IPathPos",
    ),
    ("motor angles need gear ratios, which are in no public source", "ReadMotor"),
    (
        "its arguments are in no public source",
        "TriggLIOs TriggJIOs SSearchL",
    ),
    (
        "how the controller fits axes and tools to measured points is in no public source",
        "CalcRotAxisFrame CalcRotAxFrameZ MToolRotCalib SToolRotCalib SToolTCPCalib",
    ),
    ("loads are not identified: torques are 0", "LoadId"),
    (
        "there is no camera",
        """CamLoadJob CamStartLoadJob CamWaitLoadJob CamSetProgramMode CamSetRunMode CamReqImage
        CamGetResult CamGetParameter CamSetParameter CamSetExposure CamFlush CamGetName
        CamNumberOfResults""",
    ),
    (
        "spot welding is not simulated",
        "SpotL SpotJ",
    ),
    (
        "independent axes are not simulated",
        "IndAMove IndCMove IndDMove IndRMove IndReset IndInpos IndSpeed",
    ),
)
_REASONS: Final = {name.lower(): reason for reason, names in _GROUPS for name in names.split()}


def reason(name: str) -> str:
    """Why a built-in without a binding cannot be executed. KeyError: it can."""
    return _REASONS[name.lower()]


def names() -> frozenset[str]:
    """Lower-case names of all that are left out on purpose."""
    return frozenset(_REASONS)
