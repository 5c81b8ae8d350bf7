"""Messages between server and page about a dropped trajectory."""

from typing import Annotated, Literal

from pydantic import Field

from rapidgen.viewer.message_base import MessageModel


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
    steps: int = 1
    """Places of `way` from a point to the next."""
    findings: tuple[TrajectoryFinding, ...] = ()
    state: Literal["refused", "checked", "running", "done", "failed"] = "checked"
    told: str = ""
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
