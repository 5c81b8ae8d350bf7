"""Cell file: surroundings of a program that its modules do not declare.

One YAML file with the terms of a robot's configuration: robots by task, signals, tools, work
objects, loads, and devices. A device is a set of signals that react to signals. Units are RAPID's:
deg, mm, kg. `controller.surroundings` applies the file to a controller.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Literal

from rapidgen.config import vectors
from rapidgen.config.assemble import display_path, keys_of
from rapidgen.config.draft import DraftFindings
from rapidgen.config.draft import Path as KeyPath
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
from rapidgen.config.zones import ZoneKeys, check_zones
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
        Rule("Position of its base; RAPID coordinates stay in the robot's own world."),
    ] = None
    shapes: Annotated[
        str,
        Rule(
            "Shapes of its links for collision checks: `urdf` (of its configuration), `none`, or a "
            "URDF file with the same kinematics, in this file's folder or below."
        ),
    ] = "urdf"
    mounted: Annotated[
        list[Identifier] | None,
        Rule("Tools at its flange for collision checks; default: all with shapes, of one robot."),
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
class RoundKeys(StrictModel):
    """Size of a cylinder or a capsule."""

    radius: Annotated[float, Rule("mm", gt=0)]
    length: Annotated[float, Rule("mm along z; of a capsule between its ends' centres.", gt=0)]


@dataclass(frozen=True)
class ShapeKeys(StrictModel):
    """A shape: exactly one of box, cylinder, capsule, sphere, half_space and mesh."""

    box: Annotated[Vector | None, Rule("Lengths x, y, z in mm, about its middle.")] = None
    cylinder: Annotated[RoundKeys | None, Rule("About its middle, along z.")] = None
    capsule: Annotated[RoundKeys | None, Rule("About its middle, along z.")] = None
    sphere: Annotated[float | None, Rule("Radius in mm.", gt=0)] = None
    half_space: Annotated[
        Vector | None, Rule("Normal of a plane through its frame; solid behind it.")
    ] = None
    mesh: Annotated[str, Rule("STL, DAE or OBJ in this file's folder or below.")] = ""
    unit: Annotated[
        Literal["mm", "cm", "m", "in"] | None,
        Rule("Unit of the mesh; required for collision checks, which use its convex hull."),
    ] = None
    scale: Annotated[
        float | None,
        Rule("Metres of one unit of the mesh, instead of `unit`; 0.001 for mm.", gt=0, le=1000),
    ] = None
    frame: Annotated[FrameKeys, Rule("Position.")] = field(default_factory=FrameKeys)


@dataclass(frozen=True)
class ThingKeys(ShapeKeys):
    """An object of the cell. The page draws meshes; collision checks use all of them."""

    on: Annotated[
        str,
        Rule(
            "What it is fixed to: a positioner's mechanical unit (its frame is the user frame), or "
            "a robot's link, such as a cable package; default: the world."
        ),
    ] = ""
    points: Annotated[
        list[Vector] | None,
        Rule(
            "Instead of `frame`: three points in mm, touched with a robot: origin, a point on x, "
            "a point beside x towards y.",
            min_length=3,
            max_length=3,
        ),
    ] = None


@dataclass(frozen=True)
class CellToolKeys(ToolDataKeys):
    """A tool of the cell."""

    shapes: Annotated[
        list[ShapeKeys], Rule("Shapes for collision checks, in the frame of the flange.")
    ] = field(default_factory=list)


@dataclass(frozen=True)
class AllowedKeys(StrictModel):
    """A pair that may touch."""

    allowed: Annotated[str, Rule("Reason.", min_length=1)]


@dataclass(frozen=True)
class CollisionKeys(StrictModel):
    """Clearances of collision checks, which are no safety function."""

    clearance: Annotated[
        float, Rule("mm between a robot, with its tools, and everything else.", ge=0)
    ] = 10.0
    self_clearance: Annotated[float, Rule("mm between parts of one robot.", ge=0)] = 5.0
    pairs: Annotated[
        dict[str, float | AllowedKeys],
        Rule("`NAME - NAME`: clearance in mm, or `{allowed: REASON}`."),
    ] = field(default_factory=dict)
    time_tolerance: Annotated[
        float | None,
        Rule(
            "Seconds by which one robot may be early or late against another; 0: they share a "
            "clock; default: the larger one of 1 s and 10 % of the duration.",
            ge=0,
        ),
    ] = None
    srdf: Annotated[
        str, Rule("SRDF in this file's folder or below; its disabled pairs are allowed.")
    ] = ""


@dataclass(frozen=True)
class AttachKeys(StrictModel):
    """A part that a gripper can hold."""

    part: Annotated[Identifier, Rule("An object of `things`.")]
    to: Annotated[
        str, Rule("A tool with shapes; `GROUP/TOOL` in a cell of several robots.", min_length=1)
    ]
    when: Annotated[
        dict[Identifier, float],
        Rule(
            "Signal: value. A program on the virtual controller holds the part while all of them "
            "have these values; without signals, only Python attaches it."
        ),
    ] = field(default_factory=dict)
    reach: Annotated[float, Rule("Largest distance in mm of part and tool at the grip.", ge=0)] = (
        20.0
    )


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
        dict[Identifier, CellToolKeys], Rule("tooldata that no module declares, by name.")
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
    things: Annotated[dict[Identifier, ThingKeys], Rule("Objects around robots, by name.")] = field(
        default_factory=dict
    )
    collision: Annotated[
        CollisionKeys | None, Rule("Clearances; with this key, `run` checks for collisions.")
    ] = None
    zones: Annotated[dict[Identifier, ZoneKeys], Rule("Zones of collision checks, by name.")] = (
        field(default_factory=dict)
    )
    attach: Annotated[
        list[AttachKeys], Rule("Parts that grippers can hold, for collision checks.")
    ] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class CellShape:
    """A shape of the cell in SI units.

    `size`: whole x, y, z of a box; radius and length; radius; normal of a half-space; empty for a
    `mesh`, the file name as written, of which one unit is `scale` m (0: not given).
    """

    kind: Literal["box", "cylinder", "capsule", "sphere", "half_space", "mesh"]
    size: tuple[float, ...]
    frame: Placement
    mesh: str = ""
    scale: float = 0.0


@dataclass(frozen=True, slots=True)
class Thing:
    """An object in the cell."""

    name: str
    shape: CellShape
    on: str = ""
    """Mechanical unit or link that it moves with; empty: the world."""

    @property
    def mesh(self) -> str:
        """Return the mesh's file name as written; empty without one."""
        return self.shape.mesh

    @property
    def frame(self) -> Placement:
        """Return its position."""
        return self.shape.frame

    @property
    def scale(self) -> float:
        """Return the metres of one unit of the mesh; 1 if it is not given."""
        return self.shape.scale or 1.0


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
    """Positions of the robots, by task."""
    tool_shapes: Mapping[str, tuple[CellShape, ...]] = field(default_factory=dict)
    """Shapes of tools at the flange, by name."""
    collision: CollisionKeys | None = None
    zones: Mapping[str, ZoneKeys] = field(default_factory=dict)
    attach: Sequence[AttachKeys] = ()
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
        tuple(_thing(name, thing, report, arm) for name, thing in keys.things.items()),
        {
            task: placement_of(robot.base, ("robots", task, "base"), report, arm)
            for task, robot in keys.robots.items()
            if robot.base is not None
        },
        {
            name: tuple(
                _shape(shape, ("tools", name, "shapes", i), report, arm, shape.frame)
                for i, shape in enumerate(tool.shapes)
            )
            for name, tool in keys.tools.items()
            if tool.shapes
        },
        keys.collision,
        keys.zones,
        tuple(keys.attach),
    )
    _check_force(keys, report, arm)
    check_zones(keys.zones, report)
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


_KINDS = ("box", "cylinder", "capsule", "sphere", "half_space", "mesh")
_UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254}


def _thing(name: str, keys: ThingKeys, report: DraftFindings, arm: Arm) -> Thing:
    """Return an object at its frame or its three points (RG832)."""
    path: KeyPath = ("things", name)
    frame = keys.frame
    if keys.points is not None:
        if frame != FrameKeys():
            report.error("RG832", f"{name} has both a frame and points", path, help="keep one")
        pose = frame_of_points(*keys.points)
        if pose is None:
            report.error(
                "RG832",
                f"the points of {name} are on a line, or equal",
                (*path, "points"),
                help="touch the origin, a point on x, and a point beside x towards y",
            )
        else:
            frame = pose
    return Thing(name, _shape(keys, path, report, arm, frame), keys.on)


def frame_of_points(
    origin: Sequence[float], on_x: Sequence[float], near_y: Sequence[float]
) -> FrameKeys | None:
    """Return the frame of three touched points, as DefFrame does; None if they are on a line."""
    o, a, b = ((p[0], p[1], p[2]) for p in (origin, on_x, near_y))
    x = vectors.subtract(a, o)
    z = vectors.cross(x, vectors.subtract(b, o))
    if vectors.norm(z) <= 1e-6 * max(vectors.norm(x) ** 2, 1e-9):
        return None
    x, z = vectors.unit(x), vectors.unit(z)
    return FrameKeys(list(o), list(vectors.quaternion(x, vectors.cross(z, x), z)))


def _shape(
    keys: ShapeKeys, path: KeyPath, report: DraftFindings, arm: Arm, frame: FrameKeys
) -> CellShape:
    """Return a shape in SI units (RG832)."""
    given = [kind for kind in _KINDS if getattr(keys, kind) not in (None, "")]
    placed = placement_of(frame, (*path, "frame"), report, arm)
    if len(given) != 1:
        named = " and ".join(given) or "no shape"
        report.error(
            "RG832", f"{path[1]} has {named}", path, help=f"give one of {', '.join(_KINDS)}"
        )
        return CellShape("sphere", (0.0,), placed)
    if keys.box is not None:
        size = tuple(value / 1000 for value in keys.box)
        if min(size) <= 0:
            report.error("RG832", f"{path[1]}: a box has lengths above 0", (*path, "box"))
        return CellShape("box", size, placed)
    if keys.half_space is not None:
        if not any(keys.half_space):
            report.error(
                "RG832", f"{path[1]}: a normal of length 0", (*path, "half_space"), help="[0, 0, 1]"
            )
        return CellShape("half_space", tuple(keys.half_space), placed)
    if keys.sphere is not None:
        return CellShape("sphere", (keys.sphere / 1000,), placed)
    if keys.cylinder is not None:
        return CellShape("cylinder", _round(keys.cylinder), placed)
    if keys.capsule is not None:
        return CellShape("capsule", _round(keys.capsule), placed)
    if keys.unit is not None and keys.scale is not None:
        report.error("RG832", f"{path[1]} has both unit and scale", path, help="keep unit")
    scale = _UNITS[keys.unit] if keys.unit is not None else (keys.scale or 0.0)
    return CellShape("mesh", (), placed, keys.mesh, scale)


def _round(keys: RoundKeys) -> tuple[float, float]:
    return keys.radius / 1000, keys.length / 1000


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
