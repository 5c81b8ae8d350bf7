"""Built-ins that are known and checked, but that nothing here stands behind, and why.

Loading a program says which of them it uses; reaching one stops the task with an event.
"""

from typing import Final

_GROUPS: Final[tuple[tuple[str, str], ...]] = (
    (
        "externally guided motion (option 689-1) is not simulated",
        """EGMGetId EGMGetState EGMSetupUC EGMSetupAI EGMSetupAO EGMSetupLTAPP EGMActJoint
        EGMActPose EGMActMove EGMRunJoint EGMRunPose EGMMoveL EGMMoveC EGMStop EGMReset
        EGMStreamStart EGMStreamStop""",
    ),
    (
        "world zones are not simulated",
        """WZBoxDef WZCylDef WZSphDef WZHomeJointDef WZLimJointDef WZDOSet WZLimSup WZEnable
        WZDisable WZFree""",
    ),
    (
        "the servo loops are not simulated",
        "SoftAct SoftDeact TuneServo TuneReset TestSignRead TestSignDefine TestSignReset",
    ),
    (
        "there are no I/O units: every signal is a virtual one",
        "IOEnable IODisable IOUnitState PackDNHeader",
    ),
    (
        "SafeMove is not simulated",
        """GetMaxNumberOfCyclicBool SetupCyclicBool RemoveCyclicBool RemoveAllCyclicBool
        SetLeadThrough IsLeadThrough""",
    ),
    (
        "path correction and sensors are not simulated",
        """CorrCon CorrDiscon CorrClear CorrWrite CorrRead WaitWObj DropWObj WaitSensor SyncToSensor
        DropSensor SenDevice WriteVar ReadVar WriteBlock ReadBlock ContactL""",
    ),
    (
        "process equipment is not simulated",
        """ArcL ArcC ArcLStart ArcLEnd ArcCStart ArcCEnd SpotL SpotJ LoadId CamLoadJob
        CamStartLoadJob CamWaitLoadJob CamSetProgramMode CamSetRunMode CamReqImage CamGetResult
        CamGetParameter CamSetParameter CamSetExposure CamFlush CamGetName CamNumberOfResults""",
    ),
    (
        "independent axes are not simulated",
        "IndAMove IndCMove IndDMove IndRMove IndReset IndInpos IndSpeed",
    ),
)
_REASONS: Final = {name.lower(): reason for reason, names in _GROUPS for name in names.split()}
NOT_THERE: Final = "it is not simulated yet"


def reason(name: str) -> str:
    """Why a built-in without a binding cannot be executed."""
    return _REASONS.get(name.lower(), NOT_THERE)


def names() -> frozenset[str]:
    """Lower-case names of all that are left out on purpose."""
    return frozenset(_REASONS)
