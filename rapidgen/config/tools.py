"""Tools, work objects and frames in SI units; user routines."""

import math

from rapidgen.config import model, schema
from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.plausibility import Arm, frame_doubt, load_doubts
from rapidgen.diagnostics import Severity

_MOST_PARAMETERS = 8


def _unit_quaternion(
    values: list[float], path: KeyPath, report: DraftFindings
) -> tuple[float, float, float, float]:
    norm = math.sqrt(sum(v * v for v in values))
    if abs(norm - 1) > 1e-3:
        report.error(
            "RG014",
            f"{values} is not a unit quaternion (its length is {norm:.4g})",
            path,
            help="q1 is the scalar; [1, 0, 0, 0] turns nothing",
        )
        return (1.0, 0.0, 0.0, 0.0)
    exact = abs(norm - 1) < 1e-12
    q1, q2, q3, q4 = (v if exact else v / norm for v in values)
    return (q1, q2, q3, q4)


def _metres(values: list[float]) -> tuple[float, float, float]:
    x, y, z = (v / 1000 for v in values)
    return (x, y, z)


def placement_of(
    frame: schema.FrameKeys, path: KeyPath, report: DraftFindings, arm: Arm, *, tool: bool = False
) -> model.Placement:
    """Return a frame in m; of a `tool` it begins at the flange.

    RG071: implausible for that arm.
    """
    position = _metres(frame.position)
    doubt = frame_doubt(position, arm, tool=tool)
    if doubt:
        impossible, message, help = doubt
        severity = Severity.ERROR if impossible else Severity.WARNING
        report.add("RG071", severity, message, (*path, "position"), help=help)
    return model.Placement(
        position,
        _unit_quaternion(frame.orientation, (*path, "orientation"), report),
    )


def tool_of(tool: schema.ToolKeys, path: KeyPath, report: DraftFindings, arm: Arm) -> model.Tool:
    """Return the tool of the moves."""
    load = tool.load
    is_named = not report.is_faulty((*path, "name"))
    if is_named and tool.name == "tool0" and tool != schema.ToolKeys():
        report.error(
            "RG014",
            "tool0 is the controller's own and cannot be described",
            path,
            help="give the tool another `name:`",
            key=True,
        )
    elif tool.name != "tool0" and tool.declared == "here" and load.mass <= 0:
        report.error(
            "RG014",
            f"tool '{tool.name}' weighs nothing",
            (*path, "load", "mass"),
            help="a controller refuses to move with a tool without mass: add `load: {mass: ...}`",
        )
    return model.Tool(
        tool.name,
        tool.declared == "elsewhere",
        tool.held,
        placement_of(tool.frame, (*path, "frame"), report, arm, tool=tool.held),
        load_of(load, (*path, "load"), report, arm),
    )


def load_of(load: schema.LoadKeys, path: KeyPath, report: DraftFindings, arm: Arm) -> model.Load:
    """Return a load.

    RG070: implausible, or for that arm.
    """
    x, y, z = load.inertia
    centre = _metres(load.centre)
    for doubt in load_doubts(load.mass, centre, (x, y, z), arm):
        severity = Severity.ERROR if doubt.impossible else Severity.WARNING
        report.add("RG070", severity, doubt.message, (*path, doubt.part), help=doubt.help)
    return model.Load(
        load.mass,
        centre,
        _unit_quaternion(load.axes, (*path, "axes"), report),
        (x, y, z),
    )


def work_object_of(
    value: schema.WorkObjectKeys, path: KeyPath, report: DraftFindings, arm: Arm
) -> model.WorkObject:
    """Return the work object of the moves."""
    is_named = not report.is_faulty((*path, "name"))
    if is_named and value.name == "wobj0" and value != schema.WorkObjectKeys():
        report.error(
            "RG014",
            "wobj0 is the controller's own and cannot be described",
            path,
            help="give the work object another `name:`",
            key=True,
        )
    return model.WorkObject(
        value.name,
        value.declared == "elsewhere",
        value.held,
        placement_of(value.user_frame, (*path, "user_frame"), report, arm, tool=value.held),
        placement_of(value.object_frame, (*path, "object_frame"), report, arm, tool=value.held),
    )


def routine_of(
    name: str,
    value: schema.RoutineKeys,
    path: KeyPath,
    report: DraftFindings,
    has_chain: bool,
) -> model.UserRoutine:
    """Return a user routine that a program may call."""
    for number, parameter in enumerate(value.parameters):
        if parameter.type == "robtarget" and not has_chain:
            report.error(
                "RG014",
                f"the joints are unknown that reach '{parameter.name}'",
                (*path, "parameters", number, "type"),
                help="a robtarget needs the group's `chain`; a jointtarget does not",
            )
    if value.returns and len(value.parameters) == _MOST_PARAMETERS:
        report.error(
            "RG014",
            f"function '{name}' has {_MOST_PARAMETERS} parameters",
            (*path, "parameters"),
            help=f"at most {_MOST_PARAMETERS - 1}: its value comes after them",
        )
    if value.returns:
        report.add(
            "RG069",
            Severity.WARNING,
            f"function '{value.call}' is linked to the driver: where it is missing, or has other "
            "parameters, the motion task has a reference error and does not run",
            (*path, "returns"),
            help="a procedure with an INOUT parameter is found when it is called",
        )
    parameters = tuple(
        model.RoutineParameter(p.name, p.type, p.mode == "inout") for p in value.parameters
    )
    return model.UserRoutine(name, value.call, parameters, value.returns)


def data_of(
    keys: schema.GroupKeys, path: KeyPath, report: DraftFindings
) -> tuple[model.UserDatum, ...]:
    """Return the data that clients may read and write.

    The control server accesses a datum by its name without the module, which must be unique in the
    task.
    """
    if keys.data and keys.ports.control == 0:
        report.error(
            "RG014",
            "`data` needs the control port",
            (*path, "data"),
            help="leave out `ports: {control: 0}`, or this",
        )
    result: dict[str, str] = {}
    for name in keys.data:
        plain = name.partition(":")[2].casefold()
        if plain in result:
            report.error(
                "RG014",
                f"'{name}' and '{result[plain]}' are one name to RAPID",
                (*path, "data", name),
                help="data of two modules of a task are global under two names only",
                key=True,
            )
        result[plain] = name
    return tuple(model.UserDatum(name, d.type, d.access) for name, d in keys.data.items())
