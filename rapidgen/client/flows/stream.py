"""Flows of a stream: points are added during the motion."""

from typing import cast

import numpy as np
import numpy.typing as npt

from rapidgen.client.core.motion import Result
from rapidgen.client.core.point_source import PointSource
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import State
from rapidgen.client.core.stream import PointStream
from rapidgen.client.errors import InvalidTrajectory
from rapidgen.client.flows import motion
from rapidgen.client.flows.connect import alive
from rapidgen.client.flows.effects import Flow
from rapidgen.client.flows.stop import ended
from rapidgen.client.trajectory import Trajectory

_AHEAD = 2
"""Batches waiting in the client for space at the controller."""


def append(source: PointSource, times: npt.ArrayLike, positions: npt.ArrayLike) -> Flow[None]:
    """Add points; see `Stream.append`."""
    core = source.core
    if not np.iterable(times):
        times, positions = cast("npt.ArrayLike", [times]), cast("npt.ArrayLike", [positions])
    points = Trajectory(times, positions, source.names)
    if source.is_ended:
        raise InvalidTrajectory.because("RG624", "this stream has ended", "begin another one")
    if not len(points):
        return
    if source.mode is None:
        yield from alive(core, to_move=True)
        if not source.may_download:
            core.limits.require_streaming()
    if source.mode == "download" or (source.mode is None and core.limits.ring is None):
        _keep(source, points)
        return
    stream = source.stream
    if stream is None:
        yield from motion.ready(core)
        checked = core.check(points, "stream", is_open=True)
        yield from motion.control_answers(core)
        begun = core.begin(checked)
        assert isinstance(begun, PointStream)
        source.mode, source.motion, source.last = "stream", begun, checked.last
        stream = begun
        yield from motion.stream_accepted(core, stream)
    else:
        yield from _until_short(core, stream)
        checked = core.check(points, "stream", before=source.last, is_open=True)
        stream.add(checked)
        source.last = checked.last
    yield from _until_short(core, stream)


def _keep(source: PointSource, points: Trajectory) -> None:
    """Collect points for a driver that does not stream.

    They are checked now and sent at the end.
    """
    core, total = source.core, source.total + len(points)
    if total > core.limits.capacity:
        raise InvalidTrajectory.because(
            "RG617",
            f"{total} points, and this driver, which does not stream, holds {core.limits.capacity}",
            "build and deploy a driver that streams",
        )
    if source.last is None:
        core.state_port.note("the driver does not stream: points are collected until the end")
    source.keep(core.check(points, "download", before=source.last, is_open=True))


def flush(source: PointSource) -> Flow[None]:
    """Start the robot with the points sent so far."""
    if source.stream is not None:
        source.stream.flush()
        yield from _until_short(source.core, source.stream)


def end(source: PointSource) -> Flow[None]:
    """End the stream: the last point is a stop point."""
    if source.is_ended:
        return
    if not source.total:
        raise InvalidTrajectory.because(
            "RG619", "the stream has no points", "append at least one point"
        )
    if source.stream is not None:
        source.stream.end()
    else:
        source.motion = yield from motion.execute(source.core, source.whole(), "download")
    source.is_ended = True


def result(source: PointSource, timeout: float | None) -> Flow[Result]:
    """End the stream and wait for the end of its motion."""
    yield from end(source)
    assert source.motion is not None
    return (yield from motion.result(source.core, source.motion, timeout))


def cancel(source: PointSource) -> Flow[State | None]:
    """Stop the motion of the stream, if it has begun."""
    return (yield from motion.cancel(source.core, source.motion))


def _until_short(core: Core, stream: PointStream) -> Flow[None]:
    """Wait until the queue is short enough, or after a refusal for the end."""
    ahead = _AHEAD * stream.batch
    yield from motion.streaming(
        core, stream, lambda: stream.refusal is None and stream.backlog <= ahead
    )
    if stream.error is not None:
        raise (yield from ended(core, stream))
