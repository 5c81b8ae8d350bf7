"""The messages of externally guided motion, declared once.

Sources: egm.proto as published in ros-industrial/abb_libegm, rpiRobotics/abb_robot_client and
madelinegannon/example-externalguidedmotion_hello-world; manual 3HAC073318 rev. K, 3.1.3. They agree
in numbers and types; fields that only newer releases have carry the release.
"""

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, cast, get_args

PACKAGE: Final = "abb.egm"
Label: TypeAlias = Literal["required", "optional", "repeated"]
Release: TypeAlias = tuple[int, int]
"""RobotWare, such as (6, 10)."""
Scalar: TypeAlias = Literal["uint32", "uint64", "double", "bool"]
Kind: TypeAlias = Scalar | Literal["enum", "message"]


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a message; `type` is a scalar, a message or an enumeration."""

    number: int
    name: str
    type: str
    label: Label = "optional"
    since: Release = (0, 0)

    @property
    def kind(self) -> Kind:
        """Return the kind of the type."""
        for scalar in get_args(Scalar):
            if self.type == scalar:
                return cast(Scalar, scalar)
        return "enum" if self.type in ENUMERATIONS else "message"


def _triple(*names: str) -> tuple[Field, ...]:
    return tuple(Field(i, name, "double", "required") for i, name in enumerate(names, start=1))


ENUMERATIONS: Final[dict[str, dict[str, int]]] = {
    "EgmHeader.MessageType": {
        "MSGTYPE_UNDEFINED": 0,
        "MSGTYPE_COMMAND": 1,
        "MSGTYPE_DATA": 2,
        "MSGTYPE_CORRECTION": 3,
        "MSGTYPE_PATH_CORRECTION": 4,
    },
    "EgmMotorState.MotorStateType": {"MOTORS_UNDEFINED": 0, "MOTORS_ON": 1, "MOTORS_OFF": 2},
    "EgmMCIState.MCIStateType": {
        "MCI_UNDEFINED": 0,
        "MCI_ERROR": 1,
        "MCI_STOPPED": 2,
        "MCI_RUNNING": 3,
    },
    "EgmRapidCtrlExecState.RapidCtrlExecStateType": {
        "RAPID_UNDEFINED": 0,
        "RAPID_STOPPED": 1,
        "RAPID_RUNNING": 2,
    },
}
"""Values by enumeration; the part before the point is the enclosing message."""

_MEASURED: Final = (
    Field(1, "joints", "EgmJoints"),
    Field(2, "cartesian", "EgmPose"),
    Field(3, "externalJoints", "EgmJoints"),
    Field(4, "time", "EgmClock", since=(6, 7)),
    Field(5, "timeStamp", "EgmTimestamp", since=(7, 16)),
)

MESSAGES: Final[dict[str, tuple[Field, ...]]] = {
    "EgmHeader": (
        Field(1, "seqno", "uint32"),
        Field(2, "tm", "uint32"),
        Field(3, "mtype", "EgmHeader.MessageType"),
    ),
    "EgmCartesian": _triple("x", "y", "z"),
    "EgmQuaternion": _triple("u0", "u1", "u2", "u3"),
    "EgmEuler": _triple("x", "y", "z"),
    "EgmClock": (
        Field(1, "sec", "uint64", "required"),
        Field(2, "usec", "uint64", "required"),
    ),
    "EgmTimestamp": (Field(1, "sec", "uint64"), Field(2, "nsec", "uint64")),
    "EgmPose": (
        Field(1, "pos", "EgmCartesian"),
        Field(2, "orient", "EgmQuaternion"),
        Field(3, "euler", "EgmEuler"),
    ),
    "EgmCartesianSpeed": (Field(1, "value", "double", "repeated"),),
    "EgmJoints": (Field(1, "joints", "double", "repeated"),),
    "EgmPlanned": _MEASURED,
    "EgmFeedBack": _MEASURED,
    "EgmSpeedRef": (
        Field(1, "joints", "EgmJoints"),
        Field(2, "cartesians", "EgmCartesianSpeed"),
        Field(3, "externalJoints", "EgmJoints"),
    ),
    "EgmMotorState": (Field(1, "state", "EgmMotorState.MotorStateType", "required"),),
    "EgmMCIState": (Field(1, "state", "EgmMCIState.MCIStateType", "required"),),
    "EgmRapidCtrlExecState": (
        Field(1, "state", "EgmRapidCtrlExecState.RapidCtrlExecStateType", "required"),
    ),
    "EgmTestSignals": (Field(1, "signals", "double", "repeated"),),
    "EgmMeasuredForce": (Field(1, "fcActive", "bool"), Field(2, "force", "double", "repeated")),
    "EgmCollisionInfo": (
        Field(1, "collsionTriggered", "bool"),
        Field(2, "collDetQuota", "double", "repeated"),
    ),
    "EgmRAPIDdata": (Field(1, "digVal", "bool"), Field(2, "dnum", "double", "repeated")),
    "EgmPathCorr": (
        Field(1, "pos", "EgmCartesian", "required"),
        Field(2, "age", "uint32", "required"),
    ),
    "EgmRobot": (
        Field(1, "header", "EgmHeader"),
        Field(2, "feedBack", "EgmFeedBack"),
        Field(3, "planned", "EgmPlanned"),
        Field(4, "motorState", "EgmMotorState"),
        Field(5, "mciState", "EgmMCIState"),
        Field(6, "mciConvergenceMet", "bool"),
        Field(7, "testSignals", "EgmTestSignals"),
        Field(8, "rapidExecState", "EgmRapidCtrlExecState"),
        Field(9, "measuredForce", "EgmMeasuredForce"),
        Field(10, "utilizationRate", "double", since=(6, 10)),
        Field(11, "moveIndex", "uint32", since=(7, 6)),
        Field(12, "CollisionInfo", "EgmCollisionInfo", since=(7, 6)),
        Field(13, "RAPIDfromRobot", "EgmRAPIDdata", since=(7, 7)),
        Field(14, "torqueRef", "EgmJoints", since=(7, 16)),
    ),
    "EgmSensor": (
        Field(1, "header", "EgmHeader"),
        Field(2, "planned", "EgmPlanned"),
        Field(3, "speedRef", "EgmSpeedRef"),
        Field(4, "RAPIDtoRobot", "EgmRAPIDdata", since=(7, 7)),
    ),
    "EgmSensorPathCorr": (Field(1, "header", "EgmHeader"), Field(2, "pathCorr", "EgmPathCorr")),
}
"""Fields by message, each message after those that it contains."""
