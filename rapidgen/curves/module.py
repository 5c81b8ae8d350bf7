"""A fit as a RAPID module, through the writer of `rapidgen.export`.

The program goes to its start with MoveAbsJ, from wherever it is: a person clears the way. Then come
the lines and circles with zones of their own. With a place of the curve the targets stay in the
curve's own frame, and a work object says where that is.
"""

from math import degrees, floor

from rapidgen.axes import frames
from rapidgen.axes.configuration import configuration_data, family_of
from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.curves.fitting import Fit
from rapidgen.curves.prediction import ORIENTATION_SPEED
from rapidgen.diagnostics import refusal
from rapidgen.export import description as d
from rapidgen.export.writer import WrittenModule, check_module, write_module

TOOL, WORK_OBJECT = "tFit", "wobjFit"
_APPROACH = 200.0
"""mm/s of the move to the start."""


def module_of(fit: Fit, kinematics: Kinematics, name: str, tool_name: str = "") -> WrittenModule:
    """Return the module of a fit, checked for all releases.

    `tool_name`: a tool that the controller has; empty declares one, whose load is to be completed.
    Raises DiagnosticError: RG750 for names, RG786 if a waypoint has no posture.
    """
    program, moved = fit.program, fit.placement.moved
    tool = tool_name or TOOL
    work_object = "wobj0" if moved == IDENTITY else WORK_OBJECT
    instructions: list[d.Instruction] = [d.Comment(line) for line in summary(fit, kinematics)]
    start = d.JointTarget(*kinematics.map.to_rapid(program.start))
    approach = d.Speed(_APPROACH)
    instructions.append(d.Move("AbsJ", start, approach, d.FINE, tool))
    speed = d.Speed(_floored(1000 * program.speed, 1), degrees(ORIENTATION_SPEED))
    own = frames.invert(moved)
    back = frames.invert(program.tool)
    near = program.start
    for number, waypoint in enumerate(program.waypoints, 1):
        via = None
        if waypoint.via is not None:
            near = _followed(kinematics, frames.compose(waypoint.via, back), near, number)
            via = _target(kinematics, frames.compose(own, waypoint.via), near)
        near = _followed(kinematics, frames.compose(waypoint.pose, back), near, number)
        target = _target(kinematics, frames.compose(own, waypoint.pose), near)
        zone = d.FINE if number == len(program.waypoints) else _zone(waypoint.zone)
        instructions.append(
            d.Move("L" if via is None else "C", target, speed, zone, tool, work_object, via)
        )
    tools = () if tool_name else (_tool(program.tool),)
    objects = () if moved == IDENTITY else (_work_object(moved),)
    routine = d.Routine(name, f"{name}_path", tuple(instructions), tools, objects)
    written = write_module(routine)
    check_module(written)
    return written


def summary(fit: Fit, kinematics: Kinematics) -> list[str]:
    """Return what the prediction says, in lines of a comment."""
    own = fit.prediction
    lines = [
        f"Predicted: {fit.moves} moves, deviation {1000 * own.largest_deviation:.3f} mm and "
        f"{degrees(own.largest_angle):.2f} deg,",
        f"{1000 * own.mean_speed:.1f} mm/s along the curve, standard deviation "
        f"{100 * own.speed_deviation:.1f} %, {own.duration:.2f} s.",
    ]
    family = family_of(kinematics)
    if not family.has_evidence:
        lines.append(f"Configuration data of this kind of arm ({family.name}) are not confirmed.")
    return lines


def _floored(value: float, places: int) -> float:
    factor = 10.0**places
    return floor(value * factor) / factor


def _followed(kinematics: Kinematics, flange: Pose, near: Posture, number: int) -> Posture:
    """Return the posture of a waypoint on the branch of the one before."""
    posture = kinematics.follow(flange, near)
    if posture is None:
        raise refusal(
            "RG786", None, f"waypoint {number} is out of reach", "move the curve closer, or --place"
        )
    return posture


def _target(kinematics: Kinematics, pose: Pose, posture: Posture) -> d.RobTarget:
    data = configuration_data(kinematics, posture)
    place, turn = pose
    return d.RobTarget(tuple(1000 * v for v in place), turn, data.configuration, data.external)


def _zone(radius: float) -> d.Zone:
    """Return zonedata in which only the radius of the TCP limits the corner."""
    size = _floored(1000 * radius, 2)
    return d.Zone(False, (size, 1.5 * size, 1.5 * size, 180.0, 1.5 * size, 180.0))


def _tool(pose: Pose) -> d.ToolData:
    place, turn = pose
    frame = d.Frame(tuple(1000 * v for v in place), turn)
    # The load of tool0: a tool has a load above 0, and the true one is not known here.
    return d.ToolData(TOOL, True, frame, d.Load(0.001, (0.0, 0.0, 0.001)))


def _work_object(pose: Pose) -> d.WorkObjectData:
    place, turn = pose
    user = d.Frame(tuple(1000 * v for v in place), turn)
    return d.WorkObjectData(WORK_OBJECT, False, user, d.Frame())
