"""Cell file: surroundings of a program that its modules do not declare.

One YAML file with the terms of a robot's configuration: robots by task, signals, tools, work
objects, loads, and devices. A device is a set of signals that react to signals. Units are RAPID's:
deg, mm, kg. `controller.surroundings` applies the file to a controller.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated

from rapidgen.config.assemble import display_path, keys_of
from rapidgen.config.draft import DraftFindings
from rapidgen.config.model import Load, Placement, Tool, WorkObject
from rapidgen.config.model_cache import shipped_groups
from rapidgen.config.plausibility import Arm, arm_of, is_host, load_doubts
from rapidgen.config.registry import is_path, shipped_names
from rapidgen.config.rules import Rule
from rapidgen.config.schema import (
    FrameKeys,
    Identifier,
    LoadKeys,
    SignalKeys,
    StrictModel,
    ToolDataKeys,
    ToolKeys,
    Vector,
    WorkObjectDataKeys,
    WorkObjectKeys,
)
from rapidgen.config.tools import load_of, placement_of, tool_of, work_object_of
from rapidgen.config.truncation import limit_findings
from rapidgen.config.validate import valid_subset
from rapidgen.config.yaml_tree import read_bytes
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity

GROUP_BITS = 32
"""Bits of a group signal without a size; a group has at most 32 [S4 GO]."""


@dataclass(frozen=True)
class CellRobotKeys(StrictModel):
    """The robot of a motion task."""

    model: Annotated[
        str,
        Rule("A shipped model (`rapidgen robots`), or a configuration in the folder of this file."),
    ] = ""
    mechanical_unit: Annotated[
        Identifier | None, Rule("Name of its mechanical unit; `ROB_1` for the first.")
    ] = None
    external_units: Annotated[
        list[Identifier], Rule("Mechanical units of the external axes.", max_length=6)
    ] = field(default_factory=list)
    start: Annotated[
        list[float],
        Rule("Position when switched on: deg or mm, a value for each axis."),
    ] = field(default_factory=list)
    base: Annotated[
        FrameKeys | None,
        Rule("Position of its base on the page; RAPID coordinates stay in the robot's own world."),
    ] = None


@dataclass(frozen=True)
class CellSignalKeys(SignalKeys):
    """A signal of the cell.

    `access` is the access of a driver's clients; it has no meaning here.
    """

    value: Annotated[float, Rule("Value when the controller is switched on.")] = 0.0
    size: Annotated[int, Rule("Bits of a group signal.", ge=1, le=GROUP_BITS)] = GROUP_BITS


@dataclass(frozen=True)
class ReactionKeys(StrictModel):
    """Reaction of a device: when all of `when` become true, all of `then` follow."""

    when: Annotated[dict[Identifier, float], Rule("Signal: value.", min_length=1)]
    then: Annotated[dict[Identifier, float], Rule("Signal: value.", min_length=1)]
    after: Annotated[float, Rule("Seconds between.", ge=0, le=3600)] = 0.0


@dataclass(frozen=True)
class SeenKeys(StrictModel):
    """A result that a camera's job finds in an image."""

    name: Annotated[str, Rule("Name of the result.")] = ""
    position: Annotated[Vector, Rule("Where it is in the camera's frame, mm.")] = field(
        default_factory=lambda: [0.0, 0.0, 0.0]
    )
    angle: Annotated[float, Rule("Turn about the frame's z, deg.")] = 0.0
    type: Annotated[float, Rule("`type` of the cameratarget.")] = 0.0
    values: Annotated[list[float], Rule("`val1` and on.", max_length=5)] = field(
        default_factory=list
    )
    texts: Annotated[list[str], Rule("`string1` and `string2`.", max_length=2)] = field(
        default_factory=list
    )


@dataclass(frozen=True)
class CameraKeys(StrictModel):
    """A camera of integrated vision.

    It returns configured results; no picture is evaluated.
    """

    images: Annotated[
        list[list[SeenKeys]],
        Rule("The results of each image, in turn; the first one follows the last."),
    ] = field(default_factory=list)
    parameters: Annotated[
        dict[str, float], Rule("What CamGetParameter reads, and CamSetParameter writes, by name.")
    ] = field(default_factory=dict)


@dataclass(frozen=True)
class ForceKeys(StrictModel):
    """The force sensor at each robot's hand.

    It returns configured values; there is no contact simulation.
    """

    readings: Annotated[
        list[Annotated[list[float], Rule("Six numbers.", min_length=6, max_length=6)]],
        Rule(
            "What FCGetForce reads, in turn, and then the last: force x, y, z (N), "
            "torque x, y, z (Nm).",
            min_length=1,
        ),
    ] = field(default_factory=lambda: [[0.0] * 6])
    mass: Annotated[float, Rule("Mass of the load that FCLoadID finds, kg.", ge=0)] = 0.0
    center: Annotated[Vector, Rule("Where its centre is, mm.")] = field(
        default_factory=lambda: [0.0, 0.0, 0.0]
    )


@dataclass(frozen=True)
class ThingKeys(StrictModel):
    """An object that the page draws; there is no collision check."""

    mesh: Annotated[str, Rule("STL, DAE or OBJ in this file's folder or below.")]
    frame: Annotated[FrameKeys, Rule("Position.")] = field(default_factory=FrameKeys)
    scale: Annotated[
        float, Rule("Metres of one unit of the mesh; 0.001 for mm.", gt=0, le=1000)
    ] = 1.0


@dataclass(frozen=True)
class CellKeys(StrictModel):
    """The surroundings of a controller."""

    description: Annotated[str, Rule("For people.")] = ""
    robots: Annotated[dict[Identifier, CellRobotKeys], Rule("Robots by motion task.")] = field(
        default_factory=dict
    )
    signals: Annotated[dict[Identifier, CellSignalKeys], Rule("Signals by name.")] = field(
        default_factory=dict
    )
    tools: Annotated[
        dict[Identifier, ToolDataKeys], Rule("tooldata that no module declares, by name.")
    ] = field(default_factory=dict)
    work_objects: Annotated[
        dict[Identifier, WorkObjectDataKeys], Rule("wobjdata that no module declares, by name.")
    ] = field(default_factory=dict)
    loads: Annotated[
        dict[Identifier, LoadKeys], Rule("loaddata that no module declares, by name.")
    ] = field(default_factory=dict)
    devices: Annotated[
        dict[Identifier, list[ReactionKeys]],
        Rule("What answers the program: a gripper's sensor, a conveyor, a door."),
    ] = field(default_factory=dict)
    cameras: Annotated[dict[Identifier, CameraKeys], Rule("Cameras by name.")] = field(
        default_factory=dict
    )
    force: Annotated[ForceKeys | None, Rule("Force sensors of the robots.")] = None
    egm: Annotated[
        dict[Identifier, str],
        Rule(
            "Partners of externally guided motion: the program's UdpUc device, and where `sim` "
            "sends its datagrams, `HOST:PORT`; others are on 127.0.0.1."
        ),
    ] = field(default_factory=dict)
    things: Annotated[dict[Identifier, ThingKeys], Rule("What the page draws around robots.")] = (
        field(default_factory=dict)
    )


@dataclass(frozen=True, slots=True)
class Thing:
    """A mesh in the cell: scale in m, file name as written."""

    name: str
    mesh: str
    frame: Placement
    scale: float


@dataclass(frozen=True, slots=True)
class CellDescription:
    """A checked cell file.

    Frames and loads in SI units; starts and reactions in RAPID's.
    """

    robots: Mapping[str, CellRobotKeys] = field(default_factory=dict)
    signals: Mapping[str, CellSignalKeys] = field(default_factory=dict)
    tools: tuple[Tool, ...] = ()
    work_objects: tuple[WorkObject, ...] = ()
    loads: Mapping[str, Load] = field(default_factory=dict)
    devices: Mapping[str, Sequence[ReactionKeys]] = field(default_factory=dict)
    cameras: Mapping[str, CameraKeys] = field(default_factory=dict)
    force: ForceKeys | None = None
    egm: Mapping[str, tuple[str, int]] = field(default_factory=dict)
    """IPv4 address and port by device, lower case."""
    folder: Path = Path()
    """Folder of its files."""
    things: tuple[Thing, ...] = ()
    bases: Mapping[str, Placement] = field(default_factory=dict)
    """Positions of the robots in the drawing, by task."""
    diagnostics: tuple[Diagnostic, ...] = field(default=(), compare=False)
    """Warnings found while loading."""


def load_cell(path: Path) -> CellDescription:
    """Read a cell file.

    A `model` that is a file is relative to its folder.

    Raises DiagnosticError (RG001..RG009, RG014, RG070, RG071) with all errors; warnings are in its
    `diagnostics`.
    """
    displayed = display_path(path)
    such = "such as `signals: {doGrip: {kind: DO}}`; `rapidgen schema --cell` has them all"
    root, result = keys_of(read_bytes(path, displayed), displayed, "a cell file", such)
    keys, faults, removed = valid_subset(root, CellKeys)
    report = DraftFindings(root, removed)
    report.found = result + faults
    arm = _arm(keys)
    cell = CellDescription(
        {
            task: replace(robot, model=str(path.parent / robot.model))
            if is_path(robot.model)
            else robot
            for task, robot in keys.robots.items()
        },
        keys.signals,
        tuple(
            tool_of(
                ToolKeys(value.held, value.frame, value.load, name), ("tools", name), report, arm
            )
            for name, value in keys.tools.items()
        ),
        tuple(
            work_object_of(
                WorkObjectKeys(value.held, value.user_frame, value.object_frame, name),
                ("work_objects", name),
                report,
                arm,
            )
            for name, value in keys.work_objects.items()
        ),
        {name: load_of(load, ("loads", name), report, arm) for name, load in keys.loads.items()},
        keys.devices,
        keys.cameras,
        keys.force,
        _partners(keys.egm, report),
        path.parent,
        tuple(
            Thing(
                name,
                thing.mesh,
                placement_of(thing.frame, ("things", name, "frame"), report, arm),
                thing.scale,
            )
            for name, thing in keys.things.items()
        ),
        {
            task: placement_of(robot.base, ("robots", task, "base"), report, arm)
            for task, robot in keys.robots.items()
            if robot.base is not None
        },
    )
    _check_force(keys, report, arm)
    if report.failed:
        raise DiagnosticError(limit_findings(report.found))
    return replace(cell, diagnostics=tuple(limit_findings(report.found)))


def _partners(given: Mapping[str, str], report: DraftFindings) -> dict[str, tuple[str, int]]:
    """Return address and port by device. Reports RG006.

    Names of hosts are not looked up: a file must mean the same on each computer.
    """
    result = {}
    for device, text in given.items():
        host, _, port = text.rpartition(":")
        if is_host(host) and port.isdecimal() and 0 < int(port) < 65_536:
            result[device.lower()] = (host, int(port))
        else:
            report.error(
                "RG006",
                f"'{text}' is not HOST:PORT with an IPv4 address",
                ("egm", device),
                help="such as 127.0.0.1:6510",
            )
    return result


def _arm(keys: CellKeys) -> Arm:
    """Return the largest payload and reach of its shipped robots.

    Tools and work objects of a cell belong to no robot.
    """
    models = [robot.model for robot in keys.robots.values()]
    if not models or not set(models) <= set(shipped_names()):
        return Arm()
    arms = [arm_of(group) for model in models for group in shipped_groups(model)]
    strong = max(arms, key=lambda arm: arm.payload)
    is_known = all(arm.payload for arm in arms)
    return Arm(strong.name, strong.payload if is_known else 0.0, max(arm.reach for arm in arms))


def _check_force(keys: CellKeys, report: DraftFindings, arm: Arm) -> None:
    """Report an implausible load of force sensors (RG070)."""
    if keys.force is None:
        return
    x, y, z = keys.force.center
    centre = (x / 1000, y / 1000, z / 1000)
    for doubt in load_doubts(keys.force.mass, centre, (0.0, 0.0, 0.0), arm):
        severity = Severity.ERROR if doubt.impossible else Severity.WARNING
        key = "mass" if doubt.part == "mass" else "center"
        report.add("RG070", severity, doubt.message, ("force", key), help=doubt.help)
