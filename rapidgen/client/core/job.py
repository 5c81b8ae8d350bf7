"""Points to execute, and the motion that executes them. Sans-IO.

One class for a complete trajectory and for one that arrives point by point; `Execution` and
`Stream` of both clients show it.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from rapidgen.client.core.checks import CheckedPoints, LastPoint, TransferMode
from rapidgen.client.core.download import Download
from rapidgen.client.core.motion import CommandedMotion
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import Progress, State
from rapidgen.client.core.stream import PointStream
from rapidgen.client.program import Program
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.spec import TrajectoryState


class Job:
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
        self.stream: PointStream | None = None
        """The motion, if it is streamed."""
        self.program: Program | None = None
        """Instructions to execute, if the job is a program."""
        self.is_ended = False
        """True once no point follows and all have been sent."""
        self.last: LastPoint | None = None
        """Last point, which the next points continue."""
        self.stopped: State | None = None
        """Position of the robot at rest after a STOP of this job."""
        self._kept: list[Trajectory] = []

    def begin(self, checked: CheckedPoints) -> PointStream:
        """Begin with the first points of a stream."""
        self.mode, self.last = "stream", checked.last
        self.motion = self.stream = stream = self.core.begin_stream(checked)
        return stream

    def take(self, motion: Download) -> None:
        """Take all points of a complete trajectory."""
        self.mode, self.motion, self.is_ended = "download", motion, True

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
    def is_over(self) -> bool:
        """True if the result is known, good or bad."""
        return self.motion is not None and self.motion.is_over

    @property
    def total(self) -> int:
        """Number of added points."""
        return self.last.points if self.last is not None else 0

    @property
    def progress(self) -> Progress:
        """Current progress."""
        if self.motion is not None:
            return self.motion.progress
        state = TrajectoryState.RECEIVING if self.total else TrajectoryState.NONE
        return Progress(state, self.total)

    def __str__(self) -> str:
        """Describe the progress or the result."""
        motion, progress = self.motion, self.progress
        if motion is not None and motion.error is not None:
            return f"ended: {motion.error}"
        if motion is not None and motion.result is not None:
            done = motion.result
            return f"done: {done.points} {motion.noun}s in {done.seconds:.2f} s by {done.mode}"
        reached = "" if progress.reached is None else f"{progress.reached} of "
        noun = motion.noun if motion is not None else "point"
        state = progress.state.name.lower()
        return f"{state}: {reached}{progress.total} {noun}s, {progress.fraction:.0%}"

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints at which the robot stopped, as far as known."""
        motion = self.motion
        if motion is None:
            return None
        if motion.stood is not None:
            return motion.stood
        if motion.result is not None:
            return motion.result.state.joints
        if self.stopped is not None:
            return self.stopped.joints
        return motion.error.states[-1].joints if motion.error and motion.error.states else None


def batches(
    points: Iterable[tuple[float, Sequence[float]]], size: int
) -> Iterator[tuple[list[float], list[Sequence[float]]]]:
    """Yield times and joints of points, `size` at a time, read lazily."""
    source = iter(points)
    while some := list(islice(source, size)):
        yield [time for time, _ in some], [joints for _, joints in some]
