"""Points that a caller adds one after another, and their motion. Sans-IO."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from rapidgen.client.core.checks import CheckedPoints, LastPoint, TransferMode
from rapidgen.client.core.motion import CommandedMotion, progress_text
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import Progress
from rapidgen.client.core.stream import PointStream
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.spec import TrajectoryState


class PointSource:
    """Points in their order.

    The first points determine `mode` and `motion`.
    """

    def __init__(self, core: Core, names: Sequence[str] = (), *, may_download: bool = True) -> None:
        """`names` are those of the columns; empty: the robot's own order."""
        self.core = core
        self.names = tuple(names)
        self.may_download = may_download
        self.mode: TransferMode | None = None
        self.motion: CommandedMotion | None = None
        self.is_ended = False
        """True once no point follows and all have been sent."""
        self.last: LastPoint | None = None
        """Last point, which the next points continue."""
        self._kept: list[Trajectory] = []

    @property
    def stream(self) -> PointStream | None:
        """The motion, if it is streamed."""
        return self.motion if isinstance(self.motion, PointStream) else None

    def keep(self, checked: CheckedPoints) -> None:
        """Collect points for a driver that accepts only whole trajectories."""
        self.mode, self.last = "download", checked.last
        self._kept.append(checked.trajectory)

    def whole(self) -> Trajectory:
        """Return all collected points."""
        times = np.concatenate([points.times for points in self._kept])
        positions = np.concatenate([points.positions for points in self._kept])
        return Trajectory(times, positions, self._kept[0].names)

    @property
    def total(self) -> int:
        """Number of added points."""
        return self.last.points if self.last is not None else 0

    @property
    def is_over(self) -> bool:
        """True if the result is known, good or bad."""
        return self.motion is not None and self.motion.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints at which the robot stopped, as far as known."""
        return self.motion.stopped_position if self.motion is not None else None

    @property
    def progress(self) -> Progress:
        """Current progress."""
        if self.motion is not None:
            return self.motion.progress
        state = TrajectoryState.RECEIVING if self.total else TrajectoryState.NONE
        return Progress(state, self.total)

    def __str__(self) -> str:
        """Describe the progress or the result."""
        return str(self.motion) if self.motion is not None else progress_text(self.progress)


def batches(
    points: Iterable[tuple[float, Sequence[float]]], size: int
) -> Iterator[tuple[list[float], list[Sequence[float]]]]:
    """Yield times and joints of points, `size` at a time, read lazily."""
    source = iter(points)
    while some := list(islice(source, size)):
        yield [time for time, _ in some], [joints for _, joints in some]
