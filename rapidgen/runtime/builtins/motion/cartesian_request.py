"""Move instructions to robtargets: one place where RAPID's arguments become a Move."""

from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import FINE, CartesianMove, JointMove, Move, PathEvent
from rapidgen.runtime.builtins.motion.arguments import dwell_of, frame, speed_of, time_of, zone_of
from rapidgen.runtime.builtins.motion.loads import check_loads
from rapidgen.runtime.builtins.motion.targets import (
    carrier_of,
    configuration_of,
    external_posture,
    joints_for,
)
from rapidgen.runtime.builtins.motion.task_group import data_of, geometry_of, here, moving_group
from rapidgen.runtime.registry import Arguments
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value


def common(task: Task, group: MotionGroup, arguments: Arguments) -> dict[str, Value]:
    """What every move to a robtarget has. Without a `Zone` (searches) it ends in a stop point."""
    tool = arguments["Tool"].get()
    work_object = arguments["WObj"].get() if arguments["WObj"] is not None else None
    carrier = carrier_of(group, tool, work_object)
    check_loads(task, group, arguments)
    data_of(task, group).use(tool, work_object)
    group.planner.tool = carrier.tool
    stop = arguments.get("Inpos")
    return {
        "speed": speed_of(arguments["Speed"], arguments.get("V"), group.modal),
        "zone": zone_of(arguments["Zone"], arguments.get("Z"), stop)
        if "Zone" in arguments
        else FINE,
        "time": time_of(arguments["T"], group),
        "concurrent": bool(arguments.get("Conc")),
        "dwell": dwell_of(stop),
        "carrier": carrier,
        "place": here(task),
    }


def joint_move(
    task: Task, arguments: Arguments, events: tuple[PathEvent, ...] = (), *, checked: bool = True
) -> tuple[MotionGroup, Move]:
    """To a robtarget with all axes together; not `checked`: in the nearest configuration."""
    group = moving_group(task)
    kinematics = geometry_of(group)
    shared = common(task, group, arguments)
    target = arguments["ToPoint"]
    near = external_posture(group, target.extax, data_of(task, group).external_offset)
    flange = shared["carrier"].at(near).flange(frame(target))
    expected = configuration_of(target.robconf) if checked and group.modal.check_joint else None
    check = group.settings.configuration_check
    posture = joints_for(kinematics, flange, near, expected, check, group.path_target)
    return group, JointMove(target=posture, events=events, **shared)


def cartesian_move(
    task: Task, arguments: Arguments, events: tuple[PathEvent, ...] = ()
) -> tuple[MotionGroup, Move]:
    """To a robtarget on a line, or on the circle through `CirPoint`."""
    group = moving_group(task)
    kinematics = geometry_of(group)
    shared = common(task, group, arguments)
    target, via = arguments["ToPoint"], arguments.get("CirPoint")
    expected = configuration_of(target.robconf) if group.modal.check_linear else None
    external = external_posture(group, target.extax, data_of(task, group).external_offset)
    if kinematics.seventh >= 0:
        # The seventh axis goes straight to where it is at the end, with the arm angle there.
        flange = shared["carrier"].at(external).flange(frame(target))
        check, ends = group.settings.configuration_check, group.path_target
        external = joints_for(kinematics, flange, external, expected, check, ends)
    return group, CartesianMove(
        target=frame(target),
        external=external,
        via=None if via is None else frame(via),
        wanted=expected,
        singularities=group.modal.singularities,
        circle=group.modal.circle,
        events=events,
        **shared,
    )
