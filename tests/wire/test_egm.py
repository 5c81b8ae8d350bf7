"""Messages of externally guided motion against the classes of abb_robot_client."""

import math
import random

import pytest

from rapidgen.wire.egm.codec import decode_robot, decode_sensor, encode_robot, encode_sensor
from rapidgen.wire.egm.values import (
    AxisPositions,
    CartesianPose,
    EgmMessageError,
    RapidData,
    RobotMessage,
    SensorMessage,
)

foreign = pytest.importorskip("abb_robot_client._egm_protobuf.egm_pb2")

POSE = CartesianPose((100.0, -20.5, 300.0), (1.0, 0.0, 0.0, 0.0))
AXES = AxisPositions((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), (700.0,), POSE, 1.25)
MESSAGE = RobotMessage(
    sequence=7,
    milliseconds=1250,
    measured=AXES,
    planned=AXES,
    motors_on=True,
    state="running",
    program_runs=True,
    converged=False,
    utilization=12.5,
    move_index=3,
    collision=False,
    data=RapidData(True, (1.0, 2.0)),
)


def test_bytes_of_a_controller():
    """Golden bytes, written down from the declaration of egm.proto by hand."""
    axes = AxisPositions((1.0,), time=1.25)
    message = RobotMessage(1, 4, axes, axes, True, "running", True, False)
    positions = "0a09" + "09000000000000f03f" + "2206" + "0801" + "1090a10f"
    part = f"{len(positions) // 2:02x}{positions}"
    header = "0a06" + "0801" + "1004" + "1802"
    expected = header + f"12{part}1a{part}" + "22020801" + "2a020803" + "3000" + "42020802"
    assert encode_robot(message, (6, 13)).hex() == expected


def test_another_package_reads_a_controller():
    robot = foreign.EgmRobot()
    robot.ParseFromString(encode_robot(MESSAGE, (6, 13)))
    assert robot.IsInitialized()
    assert (robot.header.seqno, robot.header.tm, robot.header.mtype) == (7, 1250, 2)
    assert list(robot.feedBack.joints.joints) == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert list(robot.feedBack.externalJoints.joints) == [700.0]
    assert robot.planned.cartesian.pos.y == -20.5
    assert robot.planned.cartesian.orient.u0 == 1.0
    assert (robot.feedBack.time.sec, robot.feedBack.time.usec) == (1, 250_000)
    assert robot.mciState.state == 3
    assert robot.motorState.state == 1
    assert robot.rapidExecState.state == 2
    assert robot.utilizationRate == 12.5


@pytest.mark.parametrize(
    ("release", "fields"),
    [
        ((6, 5), []),
        ((6, 7), ["time"]),
        ((6, 10), ["time", "utilizationRate"]),
        ((7, 6), ["time", "utilizationRate", "moveIndex", "collision"]),
        ((7, 7), ["time", "utilizationRate", "moveIndex", "collision", "data"]),
    ],
)
def test_fields_by_release(release, fields):
    message = decode_robot(encode_robot(MESSAGE, release))
    has = {
        "time": message.measured.time is not None,
        "utilizationRate": message.utilization is not None,
        "moveIndex": message.move_index is not None,
        "collision": message.collision is not None,
        "data": message.data is not None,
    }
    assert [name for name, there in has.items() if there] == fields


def test_controller_message_both_ways():
    assert decode_robot(encode_robot(MESSAGE, (7, 16))) == MESSAGE


def sensor(**parts):
    message = foreign.EgmSensor()
    message.header.mtype = parts.pop("mtype", 3)
    for name, values in parts.items():
        target = message
        for step in name.split("__"):
            target = getattr(target, step)
        target.extend(values)
    return message


def test_messages_of_another_package():
    message = sensor(
        planned__joints__joints=[1, 2, 3, 4, 5, 6], speedRef__cartesians__value=[1, 2, 3, 4, 5, 6]
    )
    message.planned.cartesian.pos.x = message.planned.cartesian.pos.y = 1.0
    message.planned.cartesian.pos.z = 2.0
    message.planned.cartesian.orient.u0 = 2.0
    for name in ("u1", "u2", "u3"):
        setattr(message.planned.cartesian.orient, name, 0.0)
    result = decode_sensor(message.SerializeToString())
    assert result.joints == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert result.cartesian_speeds == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert result.pose == CartesianPose((1.0, 1.0, 2.0), (1.0, 0.0, 0.0, 0.0))
    assert result.sequence is None


def test_euler_angles_count_before_a_quaternion():
    """Manual 3HAC073318: if both are sent, Euler wins."""
    message = sensor()
    pose = message.planned.cartesian
    pose.pos.x = pose.pos.y = pose.pos.z = 0.0
    pose.orient.u0, pose.orient.u1, pose.orient.u2, pose.orient.u3 = 1.0, 0.0, 0.0, 0.0
    pose.euler.x, pose.euler.y, pose.euler.z = 0.0, 0.0, 90.0
    result = decode_sensor(message.SerializeToString()).pose
    half = math.sqrt(0.5)
    assert result.orientation == pytest.approx((half, 0.0, 0.0, half))


def test_partner_message_both_ways():
    message = SensorMessage(
        sequence=2,
        milliseconds=8,
        joints=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0),
        external=(7.0,),
        pose=POSE,
        joint_speeds=(0.5,) * 6,
        external_speeds=(1.5,),
        cartesian_speeds=(1.0,) * 6,
        data=RapidData(False, (3.0,)),
    )
    assert decode_sensor(encode_sensor(message)) == message
    assert foreign.EgmSensor.FromString(encode_sensor(message)).header.mtype == 3


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (sensor(mtype=4), "no correction"),
        (sensor(mtype=2), "no correction"),
        (sensor(planned__joints__joints=[math.nan] * 6), "not finite"),
        (sensor(speedRef__joints__joints=[math.inf] * 6), "not finite"),
        (sensor(planned__joints__joints=[0.0] * 7), "at most 6"),
        (sensor(speedRef__cartesians__value=[0.0] * 3), "six are needed"),
    ],
)
def test_rejected_messages(message, reason):
    with pytest.raises(EgmMessageError, match=reason):
        decode_sensor(message.SerializeToString())


def test_values_that_are_not_sent():
    with pytest.raises(EgmMessageError, match="not finite"):
        encode_sensor(SensorMessage(joints=(math.nan,) * 6))


def test_hostile_datagrams():
    """Any bytes are a message or rejected with a reason."""
    source = random.Random(5)
    good = encode_sensor(SensorMessage(1, 2, joints=(1.0,) * 6, pose=POSE))
    for trial in range(2_000):
        data = bytearray(good if trial % 2 else source.randbytes(source.randrange(80)))
        for _ in range(source.randrange(1, 4)):
            if data:
                data[source.randrange(len(data))] = source.randrange(256)
        del data[source.randrange(len(data) + 1) :]
        try:
            result = decode_sensor(bytes(data))
        except EgmMessageError:
            continue
        values = (*(result.joints or ()), *(result.joint_speeds or ()))
        assert all(map(math.isfinite, values))
    with pytest.raises(EgmMessageError, match="datagram"):
        decode_sensor(bytes(70_000))
