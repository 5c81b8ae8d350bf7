"""Messages between server and page: the schema of the page's TypeScript.

`python -m tests.viewer.page_types` writes page/src/messages.ts from this. Angles are rad, lengths
m, times s; positions and quaternions (q1..q4, q1 the scalar) are lists. A new message belongs to
the union of its direction at the end of this file.
"""

import math
from collections.abc import Mapping
from typing import Annotated, Literal, TypeAlias

from pydantic import Field, TypeAdapter

from rapidgen.viewer import panel_messages as p
from rapidgen.viewer.panel_messages import MessageModel

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Pose(MessageModel):
    """A frame: position m, orientation q1..q4."""

    position: tuple[float, float, float]
    orientation: tuple[float, float, float, float]


# -- to the page: scene ---------------------------------------------------------------------------


class Axis(MessageModel):
    """A joint and its controller axis.

    Limits and speed are the axis' (rad, m).
    """

    name: str
    axis: str
    kind: Literal["revolute", "prismatic"]
    lower: float
    upper: float
    speed: float


class SeenRobot(MessageModel):
    """A robot. `urdf` is its description.

    Meshes are names on this server, empty for missing ones.
    """

    name: str
    task: str
    unit: str
    urdf: str
    flange: str
    """Link of the URDF that carries tools."""
    movable: tuple[str, ...]
    """Joints of the URDF, in the order of `RobotPlace.joints`."""
    axes: tuple[Axis, ...]
    """In wire order, that of `RobotPlace.axes`."""
    has_geometry: bool
    durations: str = ""
    """The text after a simulated duration: its error, and whether it is estimated."""
    base: Pose = Pose(position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))
    """Pose of the drawn root: apart from robots that would overlap."""


class SeenShape(MessageModel):
    """A shape in its owner's frame.

    `size`: x, y, z of a box; radius and length; radius; scale of a mesh.
    """

    kind: Literal["box", "cylinder", "capsule", "sphere", "half_space", "mesh", "hull"]
    """The axis of cylinders and capsules, and the normal of half-spaces, is z."""
    size: tuple[float, ...] = ()
    pose: Pose
    mesh: str = ""
    """Name on this server."""
    corners: tuple[tuple[float, float, float], ...] = ()
    """Vertices of a convex hull."""


class SeenThing(MessageModel):
    """An object or zone of the cell in the world, or a tool at the flange of a robot."""

    name: str
    role: Literal["object", "tool", "keep-in", "keep-out"] = "object"
    robot: str = ""
    """Group that carries the tool."""
    shapes: tuple[SeenShape, ...]


class Scene(MessageModel):
    """The first message of a connection, and after a restart."""

    type: Literal["scene"] = "scene"
    title: str
    kind: Literal["simulation", "robot", "recording"]
    may_command: bool
    """False: no request moves or changes anything."""
    groups: tuple[SeenRobot, ...]
    things: tuple[SeenThing, ...] = ()
    faults: tuple[str, ...] = ()
    """Deviations from the description."""


# -- to the page: changes -------------------------------------------------------------------------


class RobotPlace(MessageModel):
    """Position of a robot.

    `joints` and `commanded` are URDF values, `axes` the controller's.
    """

    joints: tuple[float, ...]
    commanded: tuple[float, ...]
    axes: tuple[float, ...]
    tcp: Pose | None
    """In the world; None: the robot has no geometry."""
    tool: Pose
    """The TCP, in the flange (a stationary tool: in the world)."""
    tool_held: bool
    work_object: Pose
    standing: bool
    blocked: str = ""
    """Reason why the robot cannot be jogged now; empty: it can."""


class Positions(MessageModel):
    """Positions, sent during a motion and once at rest."""

    type: Literal["positions"] = "positions"
    time: float
    groups: tuple[RobotPlace, ...]


class SeenTarget(MessageModel):
    """Target of a move of a program: the TCP, in the world."""

    group: str
    name: str
    """Name of the datum; empty for an inline value."""
    module: str
    line: int
    pose: Pose


class SeenFrame(MessageModel):
    """A declared tool, in the flange, or work object, in the robot's world."""

    group: str
    name: str
    kind: Literal["tool", "work_object"]
    pose: Pose


class Targets(MessageModel):
    """Targets of the moves of the loaded programs, and their tools and work objects."""

    type: Literal["targets"] = "targets"
    targets: tuple[SeenTarget, ...]
    frames: tuple[SeenFrame, ...] = ()


class SeenBody(MessageModel):
    """A body of collision checks. Its shapes are in the frame of its node."""

    name: str
    role: Literal["link", "tool", "object", "part", "zone"]
    node: int
    """Index in `Collisions.nodes`; -1: the world."""
    shapes: tuple[SeenShape, ...]


class CollisionBodies(MessageModel):
    """Bodies of collision checks; sent again after a part is gripped or released."""

    type: Literal["bodies"] = "bodies"
    bodies: tuple[SeenBody, ...]
    unchecked: tuple[str, ...]
    """Sentences on what is not checked."""


class SeenPair(MessageModel):
    """Two bodies that touch or are near each other; m, points in the world."""

    bodies: tuple[str, str]
    distance: float
    """Negative: depth of the overlap."""
    clearance: float
    verdict: Literal["contact", "too near", "near"]
    points: tuple[tuple[float, float, float], tuple[float, float, float]]


class SeenContact(MessageModel):
    """The first contact since the start of the controller; s, m."""

    time: float
    bodies: tuple[str, str]
    point: tuple[float, float, float]
    depth: float
    place: str
    """Move instructions under way; empty: none."""
    joints: Mapping[str, tuple[float, ...]]
    """URDF values of each robot at that time, as in `RobotPlace`."""


class Collisions(MessageModel):
    """Distances of bodies nearer than 100 mm, the nearest first."""

    type: Literal["collisions"] = "collisions"
    nodes: tuple[Pose, ...]
    """Pose of each node in the world."""
    near: tuple[SeenPair, ...]
    first: SeenContact | None


class EditorPlace(MessageModel):
    """Place under the cursor of an editor that debugs this simulation."""

    type: Literal["editor"] = "editor"
    attached: bool
    """True if there is an editor, which can open a line."""
    module: str = ""
    """Empty: no place."""
    line: int = 0
    targets: tuple[SeenTarget, ...] = ()
    """Targets of the moves that the place names."""


class PanelState(MessageModel):
    """State of the pendant's status bar."""

    type: Literal["panel"] = "panel"
    time: float
    mode: Literal["auto", "manual_reduced", "manual_full"] | None
    motors_on: bool | None
    e_stop: bool | None
    """The emergency stop lasts until it is reset."""
    e_stop_pressed: bool | None = None
    """The button of the emergency stop is pressed; None: not known."""
    execution_error: bool
    failed: bool
    running: bool | None
    """A program runs; for a real robot: it can move."""
    connected: bool = True
    tasks: Mapping[str, str]
    """Activity of each task, in a word."""
    override: float | None
    """Speed of programs, 0..1."""
    pace: float | None
    """Simulated seconds in a second; 0: time is stopped."""


class LogEntry(MessageModel):
    """One event with ABB's number."""

    sequence: int
    time: float
    code: int
    kind: Literal["info", "warning", "error"]
    title: str
    texts: tuple[str, ...]
    task: str


class Log(MessageModel):
    """New events, oldest first."""

    type: Literal["log"] = "log"
    entries: tuple[LogEntry, ...]
    fresh: bool = False
    """True if the entries are older than the connection."""


class Screen(MessageModel):
    """Rows of the operator window."""

    type: Literal["screen"] = "screen"
    rows: tuple[str, ...]


class Dialog(MessageModel):
    """An open dialog; without choices a text or number is typed."""

    number: int
    task: str
    dialog: str
    text: str
    choices: tuple[str, ...]


class Dialogs(MessageModel):
    """All open dialogs."""

    type: Literal["dialogs"] = "dialogs"
    waiting: tuple[Dialog, ...]


class ShownSignal(MessageModel):
    """A signal; `largest` is None if it has no maximum."""

    name: str
    kind: Literal["DI", "DO", "GI", "GO", "AI", "AO"]
    device: str
    value: float
    largest: float | None


class AllSignals(MessageModel):
    """All signals."""

    type: Literal["signals"] = "signals"
    signals: tuple[ShownSignal, ...]


class SignalValues(MessageModel):
    """Signals that have changed."""

    type: Literal["values"] = "values"
    values: Mapping[str, float]


class PageReply(MessageModel):
    """The answer to a request; `error` is empty if it was executed."""

    type: Literal["reply"] = "reply"
    id: int
    error: str
    text: str = ""


# -- from the page --------------------------------------------------------------------------------


class PendantAction(MessageModel):
    """A button of the pendant, or an injected fault."""

    do: Literal["act"] = "act"
    action: Literal[
        "e-stop",
        "release-e-stop",
        "reset-e-stop",
        "motors-on",
        "motors-off",
        "start",
        "stop",
        "pp-to-main",
        "power-loss",
    ]


class SetMode(MessageModel):
    """Turn the key."""

    do: Literal["mode"] = "mode"
    mode: Literal["auto", "manual_reduced", "manual_full"]


class SetOverride(MessageModel):
    """Speed of programs, 0..1."""

    do: Literal["override"] = "override"
    value: Annotated[float, Field(ge=0, le=1)]


class SetPace(MessageModel):
    """Simulated seconds in a second.

    The debugger stops the time (Proceed).
    """

    do: Literal["pace"] = "pace"
    value: Annotated[float, Field(ge=0.1, le=100)]


class SetSignal(MessageModel):
    """Set a signal."""

    do: Literal["signal"] = "signal"
    name: str
    value: Finite


class AnswerQuestion(MessageModel):
    """The operator's choice or input."""

    do: Literal["answer"] = "answer"
    number: int
    value: Annotated[str, Field(max_length=200)]


class Jog(MessageModel):
    """Move a robot at rest by its axes in wire order; None: unchanged.

    `relative`: by so much from its position when the request is executed.
    """

    do: Literal["jog"] = "jog"
    group: str
    relative: bool = False
    axes: Annotated[tuple[Finite | None, ...], Field(max_length=12)]


class JogTo(MessageModel):
    """Move a robot at rest to a TCP pose in a frame, on the same branch.

    None: unchanged. `base` is the robot's world.
    """

    do: Literal["jog-to"] = "jog-to"
    group: str
    frame: Literal["base", "work_object"] = "base"
    position: tuple[Finite | None, Finite | None, Finite | None]
    orientation: tuple[Finite, Finite, Finite, Finite] | None


class JogBy(MessageModel):
    """Move the TCP of a robot at rest along and about one axis of a frame, on the same branch.

    The step starts from the robot's position when the request is executed.
    """

    do: Literal["jog-by"] = "jog-by"
    group: str
    frame: Literal["base", "tool", "work_object"]
    axis: Annotated[int, Field(ge=0, le=2)]
    """x, y or z."""
    distance: Annotated[float, Field(ge=-1, le=1)] = 0.0
    angle: Annotated[float, Field(ge=-math.pi, le=math.pi)] = 0.0
    """About the axis through the TCP."""


class Copy(MessageModel):
    """Position of a robot as text for a program, in the reply."""

    do: Literal["copy"] = "copy"
    group: str
    form: Literal["jointtarget", "robtarget", "python"]


class OpenInEditor(MessageModel):
    """Open a line of a module in the editors that debug this simulation."""

    do: Literal["open-in-editor"] = "open-in-editor"
    module: p.Name
    line: p.Line


# -- both ways ------------------------------------------------------------------------------------

ToPage: TypeAlias = (
    Scene
    | Positions
    | Targets
    | CollisionBodies
    | Collisions
    | EditorPlace
    | PanelState
    | Log
    | Screen
    | Dialogs
    | AllSignals
    | SignalValues
    | p.Connections
    | p.Conversation
    | p.LoadedPrograms
    | p.Pointers
    | p.Debugging
    | p.FrameValues
    | p.Covered
    | p.Playback
    | p.UploadedTrajectory
    | PageReply
)
Request: TypeAlias = (
    PendantAction
    | SetMode
    | SetOverride
    | SetPace
    | AnswerQuestion
    | Jog
    | JogTo
    | JogBy
    | Copy
    | SetSignal
    | OpenInEditor
    | p.ResetConnection
    | p.InjectFault
    | p.Listen
    | p.ReadSource
    | p.ReadOrigin
    | p.SetBreakpoint
    | p.RemoveBreakpoint
    | p.DebugCommand
    | p.RunTo
    | p.RunFor
    | p.StopOnErrors
    | p.SelectFrame
    | p.Evaluate
    | p.Assign
    | p.SetWatch
    | p.CountLines
    | p.Seek
    | p.Play
    | p.ReadCurves
    | p.UploadTrajectory
    | p.RunTrajectory
    | p.RemoveTrajectory
)
Answer: TypeAlias = p.SourceOrigin
"""JSON type of a reply's text."""


class PageRequest(MessageModel):
    """A request and the number of its reply."""

    id: int
    request: Annotated[Request, Field(discriminator="do")]


TO_PAGE: TypeAdapter[ToPage] = TypeAdapter(Annotated[ToPage, Field(discriminator="type")])
