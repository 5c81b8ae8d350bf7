"""Motion groups, motion data and targets."""

import sys
from collections.abc import Callable
from functools import partial
from math import isnan, pi
from types import CodeType, FrameType
from typing import TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Quaternion, normalise
from rapidgen.axes.frames import Pose as Frame
from rapidgen.axes.kinematics import (
    AxisConfiguration,
    ConfigurationCheck,
    Kinematics,
    MovingFrame,
    Posture,
)
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.axes.reach_errors import unreached
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.moves import MoveFrames, MoveSpeed, Zone
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, Location, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.motion_interface import (
    FRAMES_CONTRADICT,
    NO_GEOMETRY,
    NO_MOTION_TASK,
    NO_OFFSETS,
    NO_UNIT,
    NOT_COMPATIBLE,
    RobotData,
    planned,
)
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import (
    ConfData,
    ExtJoint,
    JointTarget,
    Orient,
    Pos,
    Pose,
    RobJoint,
    RobTarget,
    Value,
)

# -- Motion groups ---------------------------------------------------------------------------------
#
# How a built-in finds the motion group of its task.


def here(task: Task) -> Callable[[], Location | None] | None:
    """Return a function that looks up the task's location on demand."""
    codes = task.program.codes
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        file = frame.f_code.co_filename
        if file in codes:
            return partial(_place, task, frame.f_code, frame.f_lasti)
        frame = frame.f_back
    return None


def _place(task: Task, code: CodeType, instruction: int) -> Location | None:
    """Return the location of an instruction of a compiled routine.

    Finding its line takes a time that grows with the routine, so no move asks for it.
    """
    rows = code.co_lines()
    line = next((line for first, last, line in rows if first <= instruction < last), None)
    return None if line is None else task.place_of(code.co_filename, line)


def group_of(task: RapidTask) -> MotionGroup:
    """Return the group that a task moves or uses, or raise FatalError."""
    group = task.controller.motion.of_task(task.name)
    if group is None:
        raise FatalError(NO_UNIT, "No mechanical unit", f"{task.name} is connected to no robot")
    return group


def data_of(task: RapidTask, group: MotionGroup) -> RobotData:
    """Return the settings of programs for a robot."""
    return task.controller.robot_data[group.name]


@planned
def geometry_of(group: MotionGroup) -> Kinematics:
    """Return the kinematics of a robot. FatalError: no geometry."""
    return group.geometry()


def moving_group(task: Task) -> MotionGroup:
    """Return the group of a motion task, for move instructions."""
    if not task.controller.motion.is_motion_task(task.name):
        raise FatalError(NO_MOTION_TASK, "Not a motion task", f"{task.name} cannot execute moves")
    if task.interrupts.process_error is not None:
        task.raise_process_error(task.interrupts.process_error)
    return group_of(task)


def named_group(task: Task, reference: Value, name: str | None) -> MotionGroup:
    """Return the group of \\TaskRef or \\TaskName, or the task's group.

    ERR_TASKNAME: no such task, which in an inferred cell means the calling task; ERR_NOT_MOVETASK:
    it is not a motion task.
    """
    expected = name if reference is None else reference.value
    if expected is None:
        return group_of(task)
    if expected.lower() not in (known.lower() for known in task.controller.tasks):
        if task.controller.meetings.any_task:
            return group_of(task)
        raise RapidError("ERR_TASKNAME", expected)
    motion = task.controller.motion
    group = motion.of_task(expected)
    if group is None or not motion.is_motion_task(expected):
        raise RapidError("ERR_NOT_MOVETASK", expected)
    return group


# -- Motion data -----------------------------------------------------------------------------------
#
# RAPID's motion data (deg, mm) as what the planner takes (rad, m), and back.


RAD = pi / 180
Offsets: TypeAlias = tuple[float, ...]
"""Of the external axes eax_a to eax_f, deg and mm."""
STOP_TIME = 2
"""stoppointdata.type of a dwell."""


def speed_of(data: Value, tcp: float | None, modal: ModalSettings) -> MoveSpeed:
    """Return speeds of speeddata, \\V and VelSet.

    The override scales all parts, the limit only that of the TCP.
    """
    fraction = modal.speed_override
    point = data.v_tcp if tcp is None else tcp
    if isnan(point + data.v_ori + data.v_leax + data.v_reax):
        raise RapidError("ERR_ARGVALERR", "a part of the speed is no number")
    return MoveSpeed(
        tcp=min(point * fraction / 1000, modal.speed_limit),
        orientation=data.v_ori * fraction * RAD,
        linear=data.v_leax * fraction / 1000,
        rotary=data.v_reax * fraction * RAD,
    )


def time_of(time: float | None, group: MotionGroup) -> float | None:
    """Return the time \\T scaled by VelSet, in seconds.

    Half the override doubles the time. ERR_ARGVALERR: not positive.
    """
    if time is None:
        return None
    if not time > 0:
        raise RapidError("ERR_ARGVALERR", f"\\T:={time:g}")
    return time / group.modal.speed_override if group.settings.velset_timed else time


def zone_of(data: Value, radius: float | None, stop: Value = None) -> Zone:
    """Return the zone of zonedata and \\Z; \\Inpos means a stop point."""
    if data.finep or stop is not None:
        return Zone(fine=True)
    tcp = data.pzone_tcp if radius is None else radius
    if isnan(tcp):
        raise RapidError("ERR_ARGVALERR", "the zone is no number")
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
    """Return the dwell time in seconds after a stop point with \\Inpos."""
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
    """Return a jointtarget as controller values.

    `offsets` shift external axes; 9E9 keeps `default`.
    """
    return axes.from_rapid(data.robax.values(), external_values(data.extax, offsets), default)


def external_values(data: Value, offsets: Offsets) -> tuple[float, ...]:
    """Return the values of an extjoint plus offsets, for used axes."""
    return tuple(
        v if v > ABSENT / 2 else v + o for v, o in zip(data.values(), offsets, strict=True)
    )


def joint_target(axes: JointMap, posture: Posture, offsets: Offsets = NO_OFFSETS) -> Value:
    """Return a posture as a new jointtarget."""
    robot, external = axes.to_rapid(posture)
    return JointTarget(
        RobJoint(*map(single, robot)),
        external_target(external, offsets),
    )


def external_target(external: tuple[float, ...], offsets: Offsets) -> Value:
    """Return external axes in RAPID units as a new extjoint.

    The result excludes the offsets.
    """
    return ExtJoint(
        *(
            single(v) if v > ABSENT / 2 else single(v - o)
            for v, o in zip(external, offsets, strict=True)
        )
    )


def quaternion(data: Value) -> Quaternion:
    """Return an orient as a unit quaternion, or raise ERR_ILLQUAT.

    The sum of squares may differ from 1 by 0.1. The function normalises it without a report; above
    1e-5 the manual recommends NOrient (S4 datasys 1-orient-1).
    """
    q = (data.q1, data.q2, data.q3, data.q4)
    if abs(sum(v * v for v in q) - 1.0) > 0.1:
        raise RapidError("ERR_ILLQUAT", f"{list(q)}")
    return normalise(q)


def frame(data: Value) -> Frame:
    """Return a pose with the position in m."""
    t = data.trans
    return (t.x / 1000, t.y / 1000, t.z / 1000), quaternion(data.rot)


def pose(frame_: Frame) -> Value:
    """Return a frame as a new pose in mm."""
    (x, y, z), q = frame_
    return Pose(Pos(single(x * 1000), single(y * 1000), single(z * 1000)), Orient(*map(single, q)))


# -- Targets ---------------------------------------------------------------------------------------
#
# robtargets as moves: frames of tool and work object, inverse kinematics with a configuration.


def carrier_of(group: MotionGroup, tool: Value, work_object: Value) -> MoveFrames:
    """Return the frames of tooldata and wobjdata with the displacement.

    None means wobj0. The robot carries exactly one of tool and object (S4 datasys 2-MoveAbsJ-3).
    With ufprog FALSE the user frame is that of the unit `ufmec`, and uframe has no effect (S4
    datasys 1-wobjdata).
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
    """Return the frame of the unit that carries an object.

    FatalError: the robot also carries it, or the unit's geometry is unknown.
    """
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
    """Return the path's end with the external axes of an extjoint.

    Deactivated axes keep their position.
    """
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
    """No posture at a place has the required configuration."""

    __slots__ = ()

    def __init__(self, text: str) -> None:
        super().__init__(NOT_COMPATIBLE, "Position not compatible", text)


def joints_for(
    kinematics: Kinematics,
    flange: Frame,
    near: Posture,
    expected: AxisConfiguration | None,
    check: ConfigurationCheck,
    current: Posture,
) -> Posture:
    """Return the posture for a flange pose.

    It has the required configuration, or is the closest one. External axes are those of `near`. The
    seventh value of a seven-axis arm is the arm angle of the target, or else that of `current`.
    Raises MotionFault NO_POSTURE, NO_POSTURE_IN_RANGE (an axis is outside its range in every
    posture) and NoConfiguration.
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
        raise MotionFault(
            FaultReason.NO_POSTURE_IN_RANGE if reached else FaultReason.NO_POSTURE, why
        )
    if expected is None:
        return result[0]
    posture = kinematics.fitting(result, expected, check)
    if posture is not None:
        return posture
    others = ", ".join(str(list(kinematics.configuration(p))) for p in result[:4])
    raise NoConfiguration(f"no posture with configuration {list(expected)}; there are {others}")


def with_arm_angle(kinematics: Kinematics, posture: Posture) -> Posture:
    """Return a posture with the arm angle in place of the seventh axis."""
    place = kinematics.seventh
    if place < 0:
        return posture
    return (*posture[:place], kinematics.arm.arm_angle(posture), *posture[place + 1 :])


def configuration_of(data: Value) -> AxisConfiguration:
    """Return the configuration of confdata."""
    return int(data.cf1), int(data.cf4), int(data.cf6), int(data.cfx)


def rob_target(
    group: MotionGroup, posture: Posture, carrier: MoveFrames, offsets: Offsets
) -> Value:
    """Return a posture as a new robtarget in a tool and an object frame."""
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
