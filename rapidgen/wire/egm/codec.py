"""Messages between a controller and its EGM partner as bytes.

The protobuf package does the encoding; its classes are built from the declaration. Import fails
without that package (extra `egm`).
"""
# ruff: noqa: ANN401 (the classes are made at run time, so nothing knows their fields)

from collections.abc import Sequence
from math import asin, atan2, cos, degrees, isfinite, radians, sin
from typing import Any, Final

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

from rapidgen.wire.egm.declaration import ENUMERATIONS, MESSAGES, PACKAGE, Field, Release
from rapidgen.wire.egm.values import (
    MAX_BYTES,
    MAX_JOINTS,
    MAX_NUMBERS,
    AxisPositions,
    CartesianPose,
    EgmMessageError,
    Mode,
    RapidData,
    RobotMessage,
    SensorMessage,
    Values,
)

_MODES: Final[tuple[Mode, ...]] = ("undefined", "error", "stopped", "running")
_DATA, _CORRECTION = 2, 3


# -- Protobuf classes ------------------------------------------------------------------------------


def _descriptor() -> descriptor_pb2.FileDescriptorProto:
    """Return the declaration as a file of protobuf."""
    file = descriptor_pb2.FileDescriptorProto(
        name="rapidgen/egm.proto", package=PACKAGE, syntax="proto2"
    )
    for name, fields in MESSAGES.items():
        message = file.message_type.add(name=name)
        for kind, values in ENUMERATIONS.items():
            owner, _, short = kind.partition(".")
            if owner == name:
                enumeration = message.enum_type.add(name=short)
                for label, number in values.items():
                    enumeration.value.add(name=label, number=number)
        for field in fields:
            _declare(message, field)
    return file


def _declare(message: Any, field: Field) -> None:
    types = descriptor_pb2.FieldDescriptorProto
    declared = message.field.add(
        name=field.name,
        number=field.number,
        type=getattr(types, f"TYPE_{field.kind.upper()}"),
        label=getattr(types, f"LABEL_{field.label.upper()}"),
    )
    if field.kind in ("message", "enum"):
        declared.type_name = f".{PACKAGE}.{field.type}"


# A pool of its own: the default one may hold another package's abb.egm.
_POOL: Final = descriptor_pool.DescriptorPool()
_POOL.Add(_descriptor())


def _message(name: str) -> Any:
    return message_factory.GetMessageClass(_POOL.FindMessageTypeByName(f"{PACKAGE}.{name}"))


_ROBOT: Final = _message("EgmRobot")
_SENSOR: Final = _message("EgmSensor")
_CLASSES: Final = {"EgmRobot": _ROBOT, "EgmSensor": _SENSOR}
_SINCE: Final = {
    (message, field.name): field.since for message in MESSAGES for field in MESSAGES[message]
}


# -- Controller to partner -------------------------------------------------------------------------


def encode_robot(message: RobotMessage, release: Release) -> bytes:
    """Return the bytes of EgmRobot as a release of RobotWare sends them."""
    robot = _ROBOT()
    robot.header.seqno = message.sequence & 0xFFFF_FFFF
    robot.header.tm = message.milliseconds & 0xFFFF_FFFF
    robot.header.mtype = _DATA
    for name, target, positions in (
        ("EgmFeedBack", robot.feedBack, message.measured),
        ("EgmPlanned", robot.planned, message.planned),
    ):
        _put_positions(target, positions, with_time=release >= _SINCE[name, "time"])
    robot.motorState.state = 1 if message.motors_on else 2
    robot.mciState.state = _MODES.index(message.state)
    robot.mciConvergenceMet = message.converged
    robot.rapidExecState.state = 2 if message.program_runs else 1

    def known(field: str) -> bool:
        return release >= _SINCE["EgmRobot", field]

    if message.utilization is not None and known("utilizationRate"):
        robot.utilizationRate = message.utilization
    if message.move_index is not None and known("moveIndex"):
        robot.moveIndex = message.move_index
    if message.collision is not None and known("CollisionInfo"):
        robot.CollisionInfo.collsionTriggered = message.collision
    if message.data is not None and known("RAPIDfromRobot"):
        _put_data(robot.RAPIDfromRobot, message.data)
    return bytes(robot.SerializeToString())


def _put_positions(target: Any, positions: AxisPositions, *, with_time: bool) -> None:
    target.joints.joints.extend(positions.joints)
    if positions.external:
        target.externalJoints.joints.extend(positions.external)
    if positions.pose is not None:
        _put_pose(target.cartesian, positions.pose)
    if with_time and positions.time is not None:
        target.time.sec, target.time.usec = divmod(round(positions.time * 1_000_000), 1_000_000)


def _put_pose(target: Any, pose: CartesianPose) -> None:
    target.pos.x, target.pos.y, target.pos.z = pose.position
    target.orient.u0, target.orient.u1, target.orient.u2, target.orient.u3 = pose.orientation
    # RobotStudio sends both forms (ros-industrial/abb_libegm, issue 119).
    target.euler.x, target.euler.y, target.euler.z = _euler(pose.orientation)


def _put_data(target: Any, data: RapidData) -> None:
    if data.digital is not None:
        target.digVal = data.digital
    target.dnum.extend(data.numbers)


def decode_robot(data: bytes) -> RobotMessage:
    """Return the message of a controller. EgmMessageError: it is not EgmRobot."""
    robot = _parse("EgmRobot", data)
    if not robot.HasField("header") or robot.header.mtype != _DATA:
        raise EgmMessageError("the header does not announce data of a controller")
    if not (robot.HasField("feedBack") and robot.feedBack.HasField("joints")):
        raise EgmMessageError("no measured joints")
    collision = robot.CollisionInfo.collsionTriggered if robot.HasField("CollisionInfo") else None
    return RobotMessage(
        sequence=robot.header.seqno,
        milliseconds=robot.header.tm,
        measured=_positions(robot.feedBack),
        planned=_positions(robot.planned),
        motors_on=robot.motorState.state == 1,
        state=_MODES[robot.mciState.state],
        program_runs=robot.rapidExecState.state == 2,
        converged=robot.mciConvergenceMet,
        utilization=robot.utilizationRate if robot.HasField("utilizationRate") else None,
        data=_rapid_data(robot.RAPIDfromRobot) if robot.HasField("RAPIDfromRobot") else None,
        move_index=robot.moveIndex if robot.HasField("moveIndex") else None,
        collision=collision,
    )


def _positions(source: Any) -> AxisPositions:
    time = source.time.sec + source.time.usec / 1e6 if source.HasField("time") else None
    return AxisPositions(
        joints=_finite("joints", source.joints.joints),
        external=_finite("external joints", source.externalJoints.joints),
        pose=_pose(source.cartesian) if source.HasField("cartesian") else None,
        time=time,
    )


# -- Partner to controller -------------------------------------------------------------------------


def encode_sensor(message: SensorMessage) -> bytes:
    """Return the bytes of EgmSensor.

    ValueError: a value is not finite, or there are too many of them.
    """
    sensor = _SENSOR()
    sensor.header.mtype = _CORRECTION
    if message.sequence is not None:
        sensor.header.seqno = message.sequence & 0xFFFF_FFFF
    if message.milliseconds is not None:
        sensor.header.tm = message.milliseconds & 0xFFFF_FFFF
    planned, speeds = sensor.planned, sensor.speedRef
    for name, values, field in (
        ("joints", message.joints, planned.joints.joints),
        ("external joints", message.external, planned.externalJoints.joints),
        ("joint speeds", message.joint_speeds, speeds.joints.joints),
        ("external speeds", message.external_speeds, speeds.externalJoints.joints),
        ("cartesian speeds", message.cartesian_speeds, speeds.cartesians.value),
    ):
        if values:
            field.extend(_finite(name, values))
    if message.pose is not None:
        _finite("pose", (*message.pose.position, *message.pose.orientation), 7)
        pose = planned.cartesian
        pose.pos.x, pose.pos.y, pose.pos.z = message.pose.position
        orient = pose.orient
        orient.u0, orient.u1, orient.u2, orient.u3 = message.pose.orientation
    if message.data is not None:
        _put_data(sensor.RAPIDtoRobot, message.data)
    return bytes(sensor.SerializeToString())


def decode_sensor(data: bytes) -> SensorMessage:
    """Return the message of a partner.

    EgmMessageError: not EgmSensor, no correction, a value that is not finite, or too many values.
    A message without positions and speeds is one: it may carry RAPID data only.
    """
    sensor = _parse("EgmSensor", data)
    if sensor.header.mtype != _CORRECTION:
        raise EgmMessageError(f"message type {sensor.header.mtype} is no correction of a position")
    header, planned, speeds = sensor.header, sensor.planned, sensor.speedRef

    def joints(name: str, owner: Any, field: str) -> Values | None:
        return _finite(name, getattr(owner, field).joints) if owner.HasField(field) else None

    cartesian = None
    if speeds.HasField("cartesians"):
        cartesian = _finite("cartesian speeds", speeds.cartesians.value)
        if cartesian and len(cartesian) != 6:
            raise EgmMessageError(f"{len(cartesian)} cartesian speeds: six are needed")
    return SensorMessage(
        sequence=header.seqno if header.HasField("seqno") else None,
        milliseconds=header.tm if header.HasField("tm") else None,
        joints=joints("joints", planned, "joints") or None,
        external=joints("external joints", planned, "externalJoints") or None,
        pose=_pose(planned.cartesian) if planned.HasField("cartesian") else None,
        joint_speeds=joints("joint speeds", speeds, "joints") or None,
        external_speeds=joints("external speeds", speeds, "externalJoints") or None,
        cartesian_speeds=cartesian or None,
        data=_rapid_data(sensor.RAPIDtoRobot) if sensor.HasField("RAPIDtoRobot") else None,
    )


# -- Parts -----------------------------------------------------------------------------------------


def _parse(name: str, data: bytes) -> Any:
    result = _CLASSES[name]()
    if len(data) > MAX_BYTES:
        raise EgmMessageError(f"{len(data)} bytes are more than a datagram has")
    try:
        result.ParseFromString(data)
    except DecodeError:
        raise EgmMessageError(f"these {len(data)} bytes are no {name}") from None
    return result


def _finite(name: str, values: Sequence[float], limit: int = MAX_JOINTS) -> Values:
    result = tuple(values)
    if len(result) > limit:
        raise EgmMessageError(f"{len(result)} {name}: at most {limit} are possible")
    if not all(map(isfinite, result)):
        raise EgmMessageError(f"{name} that are not finite")
    return result


def _rapid_data(source: Any) -> RapidData:
    numbers = _finite("numbers", source.dnum, MAX_NUMBERS)
    return RapidData(source.digVal if source.HasField("digVal") else None, numbers)


def _pose(source: Any) -> CartesianPose | None:
    if not source.HasField("pos"):
        return None
    x, y, z = _finite("position", (source.pos.x, source.pos.y, source.pos.z))
    # With both orientations in a message the angles count (manual 3HAC073318).
    if source.HasField("euler"):
        angles = _finite("euler angles", (source.euler.x, source.euler.y, source.euler.z))
        return CartesianPose((x, y, z), _quaternion(angles))
    if not source.HasField("orient"):
        return CartesianPose((x, y, z))
    orient = source.orient
    a, b, c, d = _finite("quaternion", (orient.u0, orient.u1, orient.u2, orient.u3))
    size = (a * a + b * b + c * c + d * d) ** 0.5
    if not 1e-3 < size < 1e3:
        raise EgmMessageError("a quaternion of length zero")
    return CartesianPose((x, y, z), (a / size, b / size, c / size, d / size))


def _quaternion(angles: Values) -> tuple[float, float, float, float]:
    """Return the quaternion of angles about z, then the new y, then the new x."""
    (cx, sx), (cy, sy), (cz, sz) = (
        (cos(radians(angle) / 2), sin(radians(angle) / 2)) for angle in angles
    )
    return (
        cx * cy * cz + sx * sy * sz,
        sx * cy * cz - cx * sy * sz,
        cx * sy * cz + sx * cy * sz,
        cx * cy * sz - sx * sy * cz,
    )


def _euler(orientation: Values) -> Values:
    """Return angles about x, y and z, degrees; the inverse of `_quaternion`."""
    a, b, c, d = orientation
    x = atan2(2 * (a * b + c * d), 1 - 2 * (b * b + c * c))
    y = asin(max(-1.0, min(1.0, 2 * (a * c - d * b))))
    z = atan2(2 * (a * d + b * c), 1 - 2 * (c * c + d * d))
    return degrees(x), degrees(y), degrees(z)
