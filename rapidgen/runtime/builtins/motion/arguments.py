"""RAPID's motion data (deg, mm) as what the planner takes (rad, m), and back."""

from math import pi
from typing import TypeAlias

from rapidgen.axes.frames import Pose as Frame
from rapidgen.axes.frames import Quaternion, normalise
from rapidgen.axes.kinematics import Posture
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.moves import MoveSpeed, Zone
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.robot_data import NO_OFFSETS
from rapidgen.runtime.values import ExtJoint, JointTarget, Orient, Pos, Pose, RobJoint, Value

RAD = pi / 180
Offsets: TypeAlias = tuple[float, ...]
"""Of the external axes eax_a to eax_f, deg and mm."""
STOP_TIME = 2
"""stoppointdata.type of a dwell."""


def speed_of(data: Value, tcp: float | None, modal: ModalSettings) -> MoveSpeed:
    """speeddata with \\V and VelSet: the override scales all parts, the limit only the TCP's."""
    fraction = modal.speed_override
    return MoveSpeed(
        tcp=min((data.v_tcp if tcp is None else tcp) * fraction / 1000, modal.speed_limit),
        orientation=data.v_ori * fraction * RAD,
        linear=data.v_leax * fraction / 1000,
        rotary=data.v_reax * fraction * RAD,
    )


def time_of(time: float | None, group: MotionGroup) -> float | None:
    """\\T with VelSet: half the override, twice the time. ERR_ARGVALERR: not positive."""
    if time is None:
        return None
    if time <= 0:
        raise RapidError("ERR_ARGVALERR", f"\\T:={time:g}")
    return time / group.modal.speed_override if group.settings.velset_timed else time


def zone_of(data: Value, radius: float | None, stop: Value = None) -> Zone:
    """zonedata with \\Z; \\Inpos makes any zone a stop point."""
    if data.finep or stop is not None:
        return Zone(fine=True)
    tcp = data.pzone_tcp if radius is None else radius
    fraction = tcp / data.pzone_tcp if radius is not None and data.pzone_tcp > 0 else 1.0
    return Zone(
        fine=False,
        tcp=tcp / 1000,
        orientation=data.pzone_ori * fraction / 1000,
        external=data.pzone_eax * fraction / 1000,
        angle=data.zone_ori * fraction * RAD,
        linear=data.zone_leax * fraction / 1000,
        rotary=data.zone_reax * fraction * RAD,
    )


def dwell_of(stop: Value) -> float:
    """s that the program waits after a stop point with \\Inpos."""
    if stop is None:
        return 0.0
    time = stop.stoptime if stop.type == STOP_TIME else stop.inpos.mintime
    return float(time)


def target_of(
    data: Value,
    axes: JointMap,
    default: Posture,
    offsets: Offsets = NO_OFFSETS,
) -> Posture:
    """A jointtarget as controller values. `offsets` shift external axes; 9E9 keeps `default`."""
    return axes.from_rapid(data.robax.values(), external_values(data.extax, offsets), default)


def external_values(data: Value, offsets: Offsets) -> tuple[float, ...]:
    """extjoint with offsets added where an axis is used."""
    return tuple(
        v if v > ABSENT / 2 else v + o for v, o in zip(data.values(), offsets, strict=True)
    )


def joint_target(axes: JointMap, posture: Posture, offsets: Offsets = NO_OFFSETS) -> Value:
    """A posture as a fresh jointtarget."""
    robot, external = axes.to_rapid(posture)
    return JointTarget(
        RobJoint(*map(single, robot)),
        external_target(external, offsets),
    )


def external_target(external: tuple[float, ...], offsets: Offsets) -> Value:
    """External axes in RAPID units as a fresh extjoint, without the offsets."""
    return ExtJoint(
        *(
            single(v) if v > ABSENT / 2 else single(v - o)
            for v, o in zip(external, offsets, strict=True)
        )
    )


def quaternion(data: Value) -> Quaternion:
    """An orient as a unit quaternion. ERR_ILLQUAT: too far from unit length.

    Up to 1e-5 off in the sum of squares it is normalised silently, up to 0.1 too (the manual
    sends the user to NOrient), above it is unusable (S4 datasys 1-orient-1).
    """
    q = (data.q1, data.q2, data.q3, data.q4)
    if abs(sum(v * v for v in q) - 1.0) > 0.1:
        raise RapidError("ERR_ILLQUAT", f"{list(q)}")
    return normalise(q)


def frame(data: Value) -> Frame:
    """A pose in m."""
    t = data.trans
    return (t.x / 1000, t.y / 1000, t.z / 1000), quaternion(data.rot)


def pose(frame_: Frame) -> Value:
    """A frame as a fresh pose in mm."""
    (x, y, z), q = frame_
    return Pose(Pos(single(x * 1000), single(y * 1000), single(z * 1000)), Orient(*map(single, q)))
