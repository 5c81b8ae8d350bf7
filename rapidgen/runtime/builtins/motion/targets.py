"""robtargets as moves: frames of tool and work object, inverse kinematics with a configuration."""

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.axes.kinematics import (
    AxisConfiguration,
    ConfigurationCheck,
    Kinematics,
    MovingFrame,
    Posture,
)
from rapidgen.axes.reach_errors import unreached
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import MoveFrames
from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.arguments import (
    Offsets,
    external_target,
    external_values,
    frame,
)
from rapidgen.runtime.builtins.motion.task_group import geometry_of
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_faults import FRAMES_CONTRADICT, NO_GEOMETRY, NOT_COMPATIBLE
from rapidgen.runtime.values import ConfData, Orient, Pos, RobTarget, Value


def carrier_of(group: MotionGroup, tool: Value, work_object: Value) -> MoveFrames:
    """Frames of tooldata and wobjdata (None: wobj0) with the program displacement.

    Exactly one of them is held by the robot (S4 datasys 2-MoveAbsJ-3). With ufprog FALSE the user
    frame is that of the unit `ufmec`, and uframe does not count (S4 datasys 1-wobjdata).
    """
    held = work_object is not None and work_object.robhold
    if bool(tool.robhold) == bool(held):
        raise FatalError(
            FRAMES_CONTRADICT,
            "Tool and work object contradict",
            "one of them, and only one, is held by the robot",
        )
    placed, unit = IDENTITY, None
    if work_object is not None:
        placed = frame(work_object.oframe)
        if work_object.ufprog:
            placed = frames.compose(frame(work_object.uframe), placed)
        else:
            unit = _unit(group, work_object)
    return MoveFrames(
        tool=frame(tool.tframe),
        object=frames.compose(placed, group.modal.displacement),
        stationary=not tool.robhold,
        unit=unit,
    )


def _unit(group: MotionGroup, work_object: Value) -> MovingFrame:
    """What carries an object. FatalError: held by the robot too, or of unknown geometry."""
    if work_object.robhold:
        raise FatalError(
            FRAMES_CONTRADICT,
            "Work object contradicts",
            f"it is held by the robot and by {work_object.ufmec!r}",
        )
    result = group.moving_frame(work_object.ufmec)
    if result is None:
        raise FatalError(
            NO_GEOMETRY,
            "No geometry",
            f"{group.name}: where {work_object.ufmec!r} holds its work object is not known",
            "give its chain as `positioners:` in the robot's configuration",
        )
    return result


def external_posture(group: MotionGroup, data: Value, offsets: Offsets) -> Posture:
    """The path's end with the external axes of an extjoint (deactivated ones as they are)."""
    ends = group.path_target
    values = external_values(data, offsets)
    requested = group.map.from_rapid((0.0,) * 6, values, ends)
    return group.with_active(
        tuple(
            new if joint.axis.startswith("eax") else old
            for joint, new, old in zip(group.config.joints, requested, ends, strict=True)
        )
    )


class NoConfiguration(FatalError):
    """A place has no posture with the configuration that is asked for: moves stop there."""

    __slots__ = ()

    def __init__(self, text: str) -> None:
        super().__init__(NOT_COMPATIBLE, "Position not compatible", text)


def joints_for(
    kinematics: Kinematics,
    flange: Pose,
    near: Posture,
    expected: AxisConfiguration | None,
    check: ConfigurationCheck,
    current: Posture,
) -> Posture:
    """The posture for a flange pose: that of the wanted configuration, or the closest one.

    External axes are those of `near`; of an arm with seven axes its seventh value is the arm angle
    that the target asks for, unless it is that of `current`. ERR_OUTSIDE_REACH, ERR_ROBLIMIT (an
    axis outside its range in every posture); NoConfiguration: not with this one.
    """
    place = kinematics.seventh
    arm_angle = None
    if place >= 0 and near[place] != current[place]:
        arm_angle = near[place]
        started = (*near[:place], current[place], *near[place + 1 :])
        result = []
        for one in kinematics.at_arm_angle(flange, arm_angle, started):
            result.append(one)
            if expected is None or kinematics.misfit(one, expected) == 0.0:
                return one
        near = started
    else:
        result = kinematics.solutions(flange, near, expected)
    if not result:
        reached, why = unreached(kinematics, flange, near, arm_angle)
        raise RapidError("ERR_ROBLIMIT" if reached else "ERR_OUTSIDE_REACH", why)
    if expected is None:
        return result[0]
    posture = kinematics.fitting(result, expected, check)
    if posture is not None:
        return posture
    others = ", ".join(str(list(kinematics.configuration(p))) for p in result[:4])
    raise NoConfiguration(f"no posture with configuration {list(expected)}; there are {others}")


def with_arm_angle(kinematics: Kinematics, posture: Posture) -> Posture:
    """A posture with the arm angle in the place of the seventh axis, where there is one."""
    place = kinematics.seventh
    if place < 0:
        return posture
    return (*posture[:place], kinematics.arm.arm_angle(posture), *posture[place + 1 :])


def configuration_of(data: Value) -> AxisConfiguration:
    """confdata"""
    return int(data.cf1), int(data.cf4), int(data.cf6), int(data.cfx)


def rob_target(
    group: MotionGroup, posture: Posture, carrier: MoveFrames, offsets: Offsets
) -> Value:
    """A posture as a fresh robtarget in the frames of a tool and an object."""
    kinematics = geometry_of(group)
    (x, y, z), q = carrier.at(posture).pose(kinematics.forward(posture))
    if q[0] < 0:
        q = (-q[0], -q[1], -q[2], -q[3])
    return RobTarget(
        Pos(single(x * 1000), single(y * 1000), single(z * 1000)),
        Orient(*map(single, q)),
        ConfData(*kinematics.configuration(posture)),
        external_target(group.map.to_rapid(with_arm_angle(kinematics, posture))[1], offsets),
    )
