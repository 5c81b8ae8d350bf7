"""Built-ins without an implementation here, and the reasons.

The checker knows them. Loading a program reports which of them it uses; a call stops the task with
an event.
"""

from functools import cache
from typing import Final

from rapidgen.rapid.builtins import signatures

_GROUPS: Final[tuple[tuple[str, str], ...]] = (
    (
        "a robot cannot be guided by signals, nor its path corrected",
        "EGMSetupAI EGMSetupAO EGMSetupGI EGMSetupLTAPP EGMActMove EGMMoveL EGMMoveC",
    ),
    ("the servo loops are not simulated", "TuneServo"),
    (
        "there are no I/O buses: every signal is a virtual one",
        "IOBusStart IOBusState PackDNHeader",
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
        "a search by force needs something to touch, which is not simulated",
        "FCRefStart FCRefStop",
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
    (
        "loads and friction are not identified: torques are 0",
        """LoadId ManLoadIdProc ParIdPosValid ParIdRobValid FricIdInit FricIdEvaluate
        FricIdSetFricLevels""",
    ),
    (
        "profiles of synchronised sensors are not simulated",
        """PrxActivAndStoreRecord PrxActivRecord PrxDbgStoreRecord PrxDeactRecord PrxResetPos
        PrxResetRecords PrxSetPosOffset PrxSetRecordSampleTime PrxSetSyncalarm PrxStartRecord
        PrxStopRecord PrxStoreRecord PrxUseFileRecord PrxGetMaxRecordpos SupSyncSensorOn
        SupSyncSensorOff""",
    ),
    (
        "continuous applications (CAP) are not simulated",
        """CapL CapC CapCondSetDO CapEquiDist CapNoProcess CapRefresh CapGetFailSigs ICap InitSuperv
        SetupSuperv RemoveSuperv""",
    ),
    (
        "servo guns are not simulated",
        """STCalib STClose STOpen STIndGun STIndGunReset STTune STTuneReset STCalcForce STCalcTorque
        STIsCalib STIsClosed STIsIndGun STIsOpen""",
    ),
    (
        "there is no safety controller",
        """SafetyControllerSyncRequest SafetyControllerGetChecksum SafetyControllerGetOpModePinCode
        SafetyControllerGetSWVersion SafetyControllerGetUserChecksum""",
    ),
    (
        "wear of axes is not counted",
        """ResetAxisDistance ResetAxisMoveTime GetAxisDistance GetAxisMoveTime HollowWristReset""",
    ),
    (
        "how the planner's modes and its event buffer act is in no public source",
        "MotionProcessModeSet ActEventBuffer DeactEventBuffer",
    ),
    ("program memory has no size here", "ProgMemFree"),
    (
        "what a program does is shown by --trace, not by a file of the controller",
        "SpyStart SpyStop",
    ),
    (
        "it is not remembered who moved the pointer, nor which path power failed on",
        "PPMovedInManMode ResetPPMoved PFRestart",
    ),
    ("UIMsgWrite is written, not shown: nothing is there to take away", "UIMsgWriteAbort"),
    (
        "spot welding is not simulated",
        "SpotL SpotJ",
    ),
    (
        "independent axes are not simulated",
        "IndAMove IndCMove IndDMove IndRMove IndReset IndInpos IndSpeed",
    ),
)
OPTION: Final = (
    "it belongs to an option or add-in of RobotWare, of which only the name is known here:"
    " declare it in a module of your own to say what it does"
)
_REASONS: Final = {name.lower(): reason for reason, names in _GROUPS for name in names.split()}


def reason(name: str) -> str:
    """Return the reason for a built-in or option name.

    KeyError: it is implemented.
    """
    key = name.lower()
    return OPTION if key in option_routines() else _REASONS[key]


@cache
def option_routines() -> frozenset[str]:
    """Return lower-case names of option routines without signatures."""
    return signatures.option_names("procedures") | signatures.option_names("functions")


def names() -> frozenset[str]:
    """Return lower-case names of all deliberate omissions."""
    return frozenset(_REASONS)
