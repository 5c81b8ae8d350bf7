"""Flows of a job: a whole trajectory, or points during the motion."""

from collections.abc import Callable
from typing import cast

import numpy as np
import numpy.typing as npt

from rapidgen.client.core.checks import CheckedTrajectory, TransferMode, check_points
from rapidgen.client.core.job import Job
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import State
from rapidgen.client.core.stream import PointStream
from rapidgen.client.errors import InvalidTrajectory
from rapidgen.client.flows.download import download
from rapidgen.client.flows.effects import Flow
from rapidgen.client.flows.motion import armed, ready, stall_timeout, until, wait_for_result
from rapidgen.client.flows.stop import ended, stop
from rapidgen.client.trajectory import Trajectory

_AHEAD = 2
"""Batches waiting in the client for space at the controller."""


def execute(core: Core, trajectory: Trajectory, mode: TransferMode | None) -> Flow[Job]:
    """Execute a trajectory by stream or download; None: choose."""
    yield from ready(core)
    core.ready()
    checked = core.check(trajectory, mode)
    yield from armed(core)
    if isinstance(checked, CheckedTrajectory):
        return (yield from download(core, checked))
    job = Job(core)
    stream = job.begin(checked)
    stream.trajectory = checked.trajectory
    stream.end()
    job.is_ended = True
    yield from taken(core, stream)
    return job


def append(job: Job, times: npt.ArrayLike, positions: npt.ArrayLike) -> Flow[None]:
    """Add points: `times` (n,) s from the start, `positions` (n, k).

    Or add one point, its time and its joints (k,). Waits while the controller has no space. Raises
    InvalidTrajectory (nothing of these was sent), NotReady, TrajectoryRefused, MotionFailed,
    MotionStopped, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or cancelling this call stops
    the robot.
    """
    core = job.core
    if not np.iterable(times):
        times, positions = cast("npt.ArrayLike", [times]), cast("npt.ArrayLike", [positions])
    points = Trajectory(times, positions, job.names)
    if job.is_ended:
        raise InvalidTrajectory.because("RG624", "this stream has ended", "begin another one")
    if not len(points):
        return
    if job.mode is None:
        yield from ready(core)
        if not job.may_download:
            core.require_streaming()
    if job.mode == "download" or (job.mode is None and not core.can_stream):
        _keep(job, points)
        return
    stream = job.stream
    if stream is None:
        core.ready()
        checked = check_points(points, core.known_group, before=None, start=core.start)
        yield from armed(core)
        stream = job.begin(checked)
        yield from taken(core, stream)
    else:
        yield from _going_on(core, stream)
        checked = check_points(points, core.known_group, before=job.last, start=None)
        core.go_on(stream, checked)
        job.last = checked.last
    yield from _going_on(core, stream)


def _keep(job: Job, points: Trajectory) -> None:
    """Collect points for a driver that does not stream.

    They are checked now and sent at the end.
    """
    core, total = job.core, job.total + len(points)
    if total > core.capacity:
        raise InvalidTrajectory.because(
            "RG617",
            f"{total} points, and this driver, which does not stream, holds {core.capacity}",
            "build and deploy a driver that streams",
        )
    if job.last is None:
        core.state_port.note("the driver does not stream: points are collected until the end")
    start = core.start if job.last is None else None
    job.keep(check_points(points, core.known_group, before=job.last, start=start))


def flush(job: Job) -> Flow[None]:
    """Start the robot with the points sent so far. Raises as `append`."""
    if job.stream is not None:
        job.stream.flush()
        yield from _going_on(job.core, job.stream)


def end(job: Job) -> Flow[None]:
    """End the stream: the last point is a stop point. Raises as `append`."""
    if job.is_ended:
        return
    if not job.total:
        raise InvalidTrajectory.because(
            "RG619", "the stream has no points", "append at least one point"
        )
    if job.stream is not None:
        job.stream.end()
        job.is_ended = True
    else:
        complete = yield from execute(job.core, job.whole(), "download")
        job.motion, job.is_ended = complete.motion, True


def result(job: Job, timeout: float | None = None) -> Flow[Result]:
    """Wait for the end, by default while the robot progresses or is paused.

    Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time (the
    motion continues). Ctrl-C or cancelling this call stops the robot. A stream ends with it: all
    points are executed first.
    """
    yield from end(job)
    assert job.motion is not None
    return (yield from wait_for_result(job.core, job.motion, timeout))


def cancel(job: Job) -> Flow[State | None]:
    """Stop this motion; return the state at rest, or None if it has ended."""
    motion = job.motion
    if motion is not None and (not motion.is_over or motion.needs_stop):
        job.stopped = yield from stop(job.core)
    return job.stopped


def taken(core: Core, stream: PointStream) -> Flow[None]:
    """Wait until the controller accepts or refuses the first points.

    For a program it is the whole of it. The motion may have ended already: then its result shows
    how.
    """
    yield from _until(core, stream, lambda: stream.is_taken)
    if stream.error is not None and (stream.needs_stop or not stream.is_taken):
        raise (yield from ended(core, stream))


def _going_on(core: Core, stream: PointStream) -> Flow[None]:
    """Wait until the queue is short enough, or after a refusal for the end."""
    ahead = _AHEAD * stream.batch
    yield from _until(core, stream, lambda: stream.refusal is None and stream.backlog <= ahead)
    if stream.error is not None:
        raise (yield from ended(core, stream))


def _until(core: Core, stream: PointStream, condition: Callable[[], bool]) -> Flow[None]:
    """Wait for the condition or the end of the stream.

    Fails if the stream makes no progress.
    """
    if not (yield from until(core, stream, condition)):
        stream.failed(
            core.state_port.late(
                f"the controller has not accepted points for {stall_timeout(core, stream):.1f} s",
                "a STOP was sent; look at the robot",
            )
        )
