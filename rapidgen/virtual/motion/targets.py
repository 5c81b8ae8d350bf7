"""robtargets as moves: frames of tool and work object, inverse kinematics with a configuration."""

from typing import Any, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.axes.kinematics import Configuration, Kinematics
from rapidgen.virtual.errors import FatalError, RapidError
from rapidgen.virtual.motion import events
from rapidgen.virtual.motion.arguments import external_target, external_values, frame
from rapidgen.virtual.motion.group import MotionGroup
from rapidgen.virtual.motion.modal import ModalSettings
from rapidgen.virtual.motion.moves import Carrier, Posture
from rapidgen.virtual.values import ConfData, Orient, Pos, RobTarget, single

Data: TypeAlias = Any


def carrier_of(tool: Data, work_object: Data, modal: ModalSettings) -> Carrier:
    """Frames of tooldata and wobjdata (None: wobj0) with the program displacement.

    Exactly one of them is held by the robot (S4 datasys 2-MoveAbsJ-3). A user frame that
    follows a mechanical unit (ufprog FALSE) is not simulated.
    """
    held = work_object is not None and work_object.robhold
    if bool(tool.robhold) == bool(held):
        raise FatalError(
            events.FRAMES_CONTRADICT,
            "Tool and work object contradict",
            "one of them, and only one, is held by the robot",
        )
    placed = IDENTITY
    if work_object is not None:
        if not work_object.ufprog:
            raise FatalError(
                events.NOT_SIMULATED, "Moving user frame", f"unit {work_object.ufmec!r}"
            )
        placed = frames.compose(frame(work_object.uframe), frame(work_object.oframe))
    return Carrier(
        tool=frame(tool.tframe),
        object=frames.compose(placed, modal.displacement),
        stationary=not tool.robhold,
    )


def external_posture(group: MotionGroup, data: Data) -> Posture:
    """The path's end with the external axes of an extjoint (deactivated ones as they are)."""
    ends = group.path_target
    values = external_values(data, group.modal.external_offset)
    asked = group.map.from_rapid((0.0,) * 6, values, ends)
    return group.with_active(
        tuple(
            new if joint.axis.startswith("eax") else old
            for joint, new, old in zip(group.config.joints, asked, ends, strict=True)
        )
    )


def joints_for(
    kinematics: Kinematics,
    flange: Pose,
    near: Posture,
    wanted: Configuration | None,
) -> Posture:
    """The posture for a flange pose: with the wanted configuration, else the closest one.

    External axes are those of `near`. ERR_OUTSIDE_REACH, ERR_ROBLIMIT (an axis outside its
    range in every posture); FatalError 50080: not with this configuration.
    """
    found = kinematics.solutions(flange, near)
    if not found:
        if kinematics.reaches(flange, near):
            raise RapidError("ERR_ROBLIMIT")
        raise RapidError("ERR_OUTSIDE_REACH")
    if wanted is None:
        return found[0]
    for slack in (1e-6, 0.7853981633974483):
        for posture in found:
            if kinematics.matches(posture, wanted, slack):
                return posture
    others = ", ".join(str(list(kinematics.configuration(p))) for p in found[:4])
    raise FatalError(
        events.NOT_COMPATIBLE,
        "Position not compatible",
        f"no posture with configuration {list(wanted)}; there are {others}",
    )


def configuration_of(data: Data) -> Configuration:
    """confdata"""
    return int(data.cf1), int(data.cf4), int(data.cf6), int(data.cfx)


def rob_target(group: MotionGroup, posture: Posture, carrier: Carrier) -> Data:
    """A posture as a fresh robtarget in the frames of a tool and an object."""
    kinematics = group.geometry()
    (x, y, z), q = carrier.pose(kinematics.forward(posture))
    if q[0] < 0:
        q = (-q[0], -q[1], -q[2], -q[3])
    return RobTarget(
        Pos(single(x * 1000), single(y * 1000), single(z * 1000)),
        Orient(*map(single, q)),
        ConfData(*kinematics.configuration(posture)),
        external_target(group.map.to_rapid(posture)[1], group.modal.external_offset),
    )
