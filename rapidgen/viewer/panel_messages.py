"""Messages between server and page of single panels.

Programs and recordings, the network, dropped trajectories.
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field


class MessageModel(BaseModel):
    """Base of the parts of messages."""

    model_config = ConfigDict(frozen=True, extra="forbid")


Name = Annotated[str, Field(max_length=200)]
Text = Annotated[str, Field(max_length=1000)]
Line = Annotated[int, Field(ge=1, le=1_000_000)]


class LoadedModules(MessageModel):
    """Modules of a task. A text that two tasks share has one number."""

    task: str
    modules: dict[str, int]
    """Numbers of their texts, by name."""


class LoadedPrograms(MessageModel):
    """Loaded programs; their texts are requested by ReadSource."""

    type: Literal["loaded"] = "loaded"
    tasks: tuple[LoadedModules, ...]


class SourceOrigin(MessageModel):
    """Answer to ReadOrigin: template and line of each generated line."""

    lines: tuple[tuple[int, str, int], ...]
    templates: dict[str, str]
    """Texts of templates by name; none if they are of another version."""


class SeenPlace(MessageModel):
    """Position in a program.

    `made` is the template's line of a generated one.
    """

    module: str
    routine: str
    line: int
    made: str = ""
    level: Literal["program", "trap", "event"] = "program"


class TaskPosition(MessageModel):
    """A task: its call stack, outermost first, and its robot's move."""

    name: str
    state: str
    stack: tuple[SeenPlace, ...]
    motion: SeenPlace | None


class Pointers(MessageModel):
    """Program pointers and motion pointers."""

    type: Literal["pointers"] = "pointers"
    time: float
    tasks: tuple[TaskPosition, ...]


class SeenBreakpoint(MessageModel):
    """A breakpoint and its line.

    0: no line, `doubt` says why.
    """

    number: int
    task: str
    module: str
    line: int
    condition: str
    hits: str
    log: str
    count: int
    doubt: str


class SeenHalt(MessageModel):
    """Reason why all tasks are paused."""

    reason: Literal["breakpoint", "step", "cursor", "error", "pause", "time"]
    task: str
    place: SeenPlace | None
    text: str
    time: float
    """The controller's time, s."""


class Debugging(MessageModel):
    """Breakpoints, the pause, lines of log points, the latest last."""

    type: Literal["debugging"] = "debugging"
    halt: SeenHalt | None
    breakpoints: tuple[SeenBreakpoint, ...]
    errors: Literal["never", "unhandled", "all"]
    output: tuple[str, ...]


class SeenValue(MessageModel):
    """A value in RAPID's spelling."""

    name: str
    kind: str
    text: str
    settable: bool


class FrameValues(MessageModel):
    """Values of the selected routine, and the watch list."""

    type: Literal["held"] = "held"
    task: str
    level: int
    """Index in the call stack, 0 the outermost; -1: no routine."""
    variables: tuple[SeenValue, ...]
    watch: tuple[SeenValue, ...]


class Covered(MessageModel):
    """Number of executions of the lines of a text that begin a statement."""

    type: Literal["covered"] = "covered"
    source: int
    lines: dict[int, int]


# -- from the page --------------------------------------------------------------------------------


class ReadSource(MessageModel):
    """The reply's text is a source."""

    do: Literal["source"] = "source"
    number: int


class ReadOrigin(MessageModel):
    """The reply's text is a SourceOrigin, of a source by its number."""

    do: Literal["origin"] = "origin"
    number: int


class SetBreakpoint(MessageModel):
    """Set a new breakpoint, or change one; the reply's text is its number."""

    do: Literal["break"] = "break"
    number: int = 0
    """0: a new one."""
    module: Name
    line: Line
    task: Name = ""
    condition: Text = ""
    hits: Name = ""
    log: Text = ""


class RemoveBreakpoint(MessageModel):
    """Remove a breakpoint."""

    do: Literal["unbreak"] = "unbreak"
    number: int


class DebugCommand(MessageModel):
    """Pause, resume or step a task."""

    do: Literal["drive"] = "drive"
    how: Literal["pause", "resume", "in", "over", "out"]
    task: Name = ""


class RunTo(MessageModel):
    """Run to a line."""

    do: Literal["run-to"] = "run-to"
    task: Name
    module: Name
    line: Line


class RunFor(MessageModel):
    """Run for so many seconds of the controller's time."""

    do: Literal["run-for"] = "run-for"
    seconds: Annotated[float, Field(gt=0, le=3600)]


class StopOnErrors(MessageModel):
    """Errors at which all tasks pause."""

    do: Literal["errors"] = "errors"
    errors: Literal["never", "unhandled", "all"]


class SelectFrame(MessageModel):
    """Show values of a routine of a call stack; -1: the innermost."""

    do: Literal["look"] = "look"
    task: Name
    level: Annotated[int, Field(ge=-1, le=10_000)] = -1


class Evaluate(MessageModel):
    """The reply's text is the value of an expression in the selected frame."""

    do: Literal["evaluate"] = "evaluate"
    expression: Text


class Assign(MessageModel):
    """Set a datum, an element or a component in the selected frame."""

    do: Literal["assign"] = "assign"
    target: Text
    value: Text


class SetWatch(MessageModel):
    """The watch list."""

    do: Literal["watch"] = "watch"
    expressions: Annotated[tuple[Text, ...], Field(max_length=50)]


class CountLines(MessageModel):
    """Start or stop counting executions of lines."""

    do: Literal["cover"] = "cover"
    on: bool


# -- recordings -----------------------------------------------------------------------------------


class Playback(MessageModel):
    """State of the playback; times in s. `rate` 0: paused."""

    type: Literal["playback"] = "playback"
    begin: float
    end: float
    time: float
    rate: float
    fault: str
    """Missing or unreadable parts."""


class Seek(MessageModel):
    """Go to a moment."""

    do: Literal["seek"] = "seek"
    time: Annotated[float, Field(allow_inf_nan=False)]


class Play(MessageModel):
    """Play at so many seconds in a second; 0 pauses."""

    do: Literal["play"] = "play"
    rate: Annotated[float, Field(ge=0, le=100)]


class ReadCurves(MessageModel):
    """The reply's text is PlotData (JSON) of a robot's axes or of a signal."""

    do: Literal["curves"] = "curves"
    robot: Name = ""
    signal: Name = ""
    begin: Annotated[float, Field(allow_inf_nan=False)]
    end: Annotated[float, Field(allow_inf_nan=False)]


Ailment = Literal["well", "delay", "split", "slow", "silent", "half-open"]


class ShownSocket(MessageModel):
    """A socket of a task. Addresses are empty if there are none."""

    number: int
    task: str
    status: str
    local: str
    peer: str
    ailment: Ailment = "well"


class Connections(MessageModel):
    """All sockets in use."""

    type: Literal["connections"] = "connections"
    sockets: tuple[ShownSocket, ...]


class SocketLogLine(MessageModel):
    """A frame of simple_message, or other bytes.

    `way` is seen from the program.
    """

    time: float
    way: Literal["open", "in", "out", "close"]
    task: str
    local: str
    peer: str
    name: str
    """Name of the message; empty: no frame."""
    text: str
    fault: bool = False
    """True if the bytes are not a valid frame."""


class Conversation(MessageModel):
    """Data of sockets, oldest first; only while a viewer listens."""

    type: Literal["conversation"] = "conversation"
    listening: bool
    lines: tuple[SocketLogLine, ...]
    missed: int = 0
    """Number of earlier lines that were dropped."""
    fresh: bool = False
    """True if the lines are older than the request."""


# -- from the page --------------------------------------------------------------------------------


class ResetConnection(MessageModel):
    """Cut a connection: the task's socket and its peer are reset."""

    do: Literal["cut"] = "cut"
    number: int


class InjectFault(MessageModel):
    """Make a connection slow, silent and so on from now on."""

    do: Literal["inject-fault"] = "inject-fault"
    number: int
    ailment: Ailment


class Listen(MessageModel):
    """Start or stop sending the data of sockets."""

    do: Literal["listen"] = "listen"
    on: bool


class TrajectoryFinding(MessageModel):
    """An error or warning.

    `point` counts from 0, None: no single point.
    """

    code: str
    severity: str
    message: str
    help: str
    line: int | None
    point: int | None


class UploadedTrajectory(MessageModel):
    """A checked trajectory; the file's name is empty without a file."""

    type: Literal["trajectory"] = "trajectory"
    group: str = ""
    file: str = ""
    seconds: float = 0.0
    points: int = 0
    way: tuple[tuple[float, float, float], ...] = ()
    """The TCP, m in the world, at every point and between.

    Empty without geometry.
    """
    pace: tuple[float, ...] = ()
    """TCP speed from the place before to each of `way`, m/s."""
    clearance: tuple[float, ...] = ()
    """m: least distance of bodies at each place, at most 0.1; empty: not checked."""
    steps: int = 1
    """Places of `way` from a point to the next."""
    findings: tuple[TrajectoryFinding, ...] = ()
    state: Literal["refused", "checked", "running", "done", "failed"] = "checked"
    detail: str = ""
    """Reason of a failure."""


class UploadTrajectory(MessageModel):
    """Check a file's text for a robot; the robot does not move."""

    do: Literal["drop"] = "drop"
    group: str
    file: Annotated[str, Field(max_length=200)]
    text: Annotated[str, Field(max_length=900_000)]


class RunTrajectory(MessageModel):
    """Execute what was checked, through the simulator's driver."""

    do: Literal["run"] = "run"


class RemoveTrajectory(MessageModel):
    """Take it off the page."""

    do: Literal["forget"] = "forget"
