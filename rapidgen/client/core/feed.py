"""What a caller appends to a stream, before anybody knows how it goes to the robot. Sans-IO."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from rapidgen.client.core.checks import LastPoint
from rapidgen.client.core.download import Download
from rapidgen.client.core.motion import Way
from rapidgen.client.core.state import Progress
from rapidgen.client.core.stream import PointStream
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.spec import TrajectoryState


class Feed:
    """Points in their order. `way` is known from the first ones on."""

    def __init__(self, names: Sequence[str], *, may_download: bool) -> None:
        """`names` are those of the columns, empty: the robot's own order."""
        self.names = tuple(names)
        self.may_download = may_download
        self.way: Way | None = None
        self.run: PointStream | Download | None = None
        self.is_ended = False
        self.last: LastPoint | None = None
        """What the next points go on from."""
        self._kept: list[Trajectory] = []

    def keep(self, points: Trajectory) -> None:
        """Points for a driver that takes only whole trajectories."""
        self._kept.append(points)

    def whole(self) -> Trajectory:
        """All points that were kept."""
        times = np.concatenate([points.times for points in self._kept])
        positions = np.concatenate([points.positions for points in self._kept])
        return Trajectory(times, positions, self.names)

    @property
    def total(self) -> int:
        """Points that were appended."""
        return self.last.points if self.last is not None else 0

    @property
    def progress(self) -> Progress:
        """How far it is, now."""
        if self.run is not None:
            return self.run.progress
        state = TrajectoryState.RECEIVING if self.total else TrajectoryState.NONE
        return Progress(state, self.total)


def batches(
    points: Iterable[tuple[float, Sequence[float]]], size: int
) -> Iterator[tuple[list[float], list[Sequence[float]]]]:
    """Times and joints of points, `size` at a time; nothing is taken ahead."""
    source = iter(points)
    while some := list(islice(source, size)):
        yield [time for time, _ in some], [joints for _, joints in some]
