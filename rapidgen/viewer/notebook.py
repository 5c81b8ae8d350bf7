"""Robots in notebooks: a 3D view of their position and the progress of a motion.

`plot` shows curves in a notebook by itself. Both functions also work in a script: the view has a
URL for a browser, and the progress is a line in the terminal.
"""

import threading
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Protocol

from rapidgen.client import Robot
from rapidgen.client.core.motion import Result
from rapidgen.config.model import GroupConfig, Ports

if TYPE_CHECKING:
    from rapidgen.client.core.state import Progress
    from rapidgen.viewer.server import Page

_PERIOD = 0.1
"""s between updates of a progress bar."""


class Motion(Protocol):
    """An accepted trajectory or program: `Execution`, `ProgramRun`."""

    @property
    def progress(self) -> "Progress":
        """Current progress."""
        ...

    def result(self, timeout: float | None = None) -> Result:
        """Wait for the end."""
        ...


@dataclass(frozen=True)
class RobotView:
    """A 3D view of connected robots, read only, until `close()`."""

    page: "Page"
    height: int

    @property
    def url(self) -> str:
        """Address for a browser on this computer."""
        return self.page.url

    def close(self) -> None:
        """End the view; a second call does nothing."""
        self.page.close()

    def _repr_html_(self) -> str:
        return (
            f'<iframe src="{escape(self.url)}" title="3D view" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )


def view(*robots: Robot, height: int = 480) -> RobotView:
    """Show connected robots in 3D below a notebook's cell (`height` in pixels).

    The page is served on loopback, so notebook and browser run on the same computer. Raises
    DiagnosticError RG905 (extra `web`), RG920 and RG921 as `rapidgen view`.
    """
    from rapidgen.viewer.appearance import appearance
    from rapidgen.viewer.robot.observed import ObservedRobots
    from rapidgen.viewer.server import serve_page

    pairs = [(robot, _configuration_of(robot)) for robot in robots]
    look = appearance([config for _, config in pairs], {})
    title = " and ".join(str(robot.address.host) for robot in robots)
    return RobotView(serve_page(ObservedRobots(title, pairs, look), files=look.files), height)


def progress(motion: Motion) -> Result:
    """Wait for the end of a motion with a progress bar; return its result.

    Raises as `motion.result()`.
    """
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), TextColumn("{task.percentage:3.0f} %"), TimeElapsedColumn())
    ended = threading.Event()
    with Progress(*columns) as bar:
        task = bar.add_task("motion", total=1.0)

        def update() -> None:
            while not ended.wait(_PERIOD):
                bar.update(task, completed=motion.progress.fraction)

        thread = threading.Thread(target=update, name="progress of a motion", daemon=True)
        thread.start()
        try:
            result = motion.result()
            bar.update(task, completed=1.0)
        finally:
            ended.set()
            thread.join()
    return result


def _configuration_of(robot: Robot) -> GroupConfig:
    """Return a robot's configuration; what the driver reports of its joints otherwise."""
    config = robot.configuration
    groups = () if config is None else config.groups
    own = next((group for group in groups if group.name == robot.group.name), None)
    return own or GroupConfig(robot.group.name or "robot", "", "", robot.group.map.joints, Ports())
