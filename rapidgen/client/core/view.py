"""What the handles of both clients tell without waiting."""

from collections.abc import Sequence

from rapidgen.client.core.feed import Feed
from rapidgen.client.core.motion import CommandedMotion, Way
from rapidgen.client.core.state import State
from rapidgen.client.trajectory import Trajectory
from rapidgen.diagnostics import Diagnostic


class View:
    """A motion as its caller may look at it."""

    def __init__(self, run: CommandedMotion) -> None:
        self._run = run
        self._stopped: State | None = None

    @property
    def trajectory(self) -> Trajectory:
        """What was asked for, in the robot's order of joints."""
        assert self._run.trajectory is not None
        return self._run.trajectory

    @property
    def warnings(self) -> Sequence[Diagnostic]:
        """What the checks noted."""
        return self._run.warnings

    @property
    def planned_seconds(self) -> float:
        """Seconds that the controller was asked to take."""
        return self._run.planned_seconds

    @property
    def way(self) -> Way:
        """`stream`: sent while the robot moves; `download`: sent whole before it moved."""
        return self._run.way

    @property
    def is_over(self) -> bool:
        """Whether the result is there, good or bad."""
        return self._run.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints where the robot stood at the end; None while it moves or when nobody saw it."""
        return stopped_position(self._run, self._stopped)


class StreamView:
    """A stream as its caller may look at it."""

    def __init__(self, feed: Feed) -> None:
        self._feed = feed
        self._stopped: State | None = None

    @property
    def total(self) -> int:
        """Points that were appended."""
        return self._feed.total

    @property
    def time(self) -> float:
        """Time of the last point, s from the beginning of the stream; 0 before the first."""
        return self._feed.last.time if self._feed.last is not None else 0.0

    @property
    def way(self) -> Way | None:
        """`stream`, or `download` where the driver does not stream; None before the first."""
        return self._feed.way

    @property
    def starved(self) -> int:
        """How often the robot stood because the points ran out."""
        return self._feed.run.starved if self._feed.run is not None else 0

    @property
    def is_over(self) -> bool:
        """Whether the result is there, good or bad."""
        return self._feed.run is not None and self._feed.run.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints where the robot stood at the end; None while it moves or when nobody saw it."""
        return stopped_position(self._feed.run, self._stopped) if self._feed.run else None


def stopped_position(run: CommandedMotion, seen: State | None) -> tuple[float, ...] | None:
    """Where the robot stood at the end of a motion, by the best that is known."""
    if run.stood is not None:
        return run.stood
    if run.result is not None:
        return run.result.state.joints
    if seen is not None:
        return seen.joints
    return run.error.states[-1].joints if run.error is not None and run.error.states else None
