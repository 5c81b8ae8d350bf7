"""Streams step by step, as generators run by both clients (see `effects`)."""

from collections.abc import Callable

import numpy.typing as npt

from rapidgen.client.core.checks import CheckedPoints, piece
from rapidgen.client.core.download import Download
from rapidgen.client.core.feed import Feed
from rapidgen.client.core.motion import Result, Way
from rapidgen.client.core.robot import Core
from rapidgen.client.core.stream import PointStream
from rapidgen.client.errors import InvalidTrajectory, NotSupported, RobotTimeout, fault
from rapidgen.client.flows import download as flows
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow
from rapidgen.client.flows.stop import stop_and_leave
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.messages import batch_points
from rapidgen.wire.simple_message.spec import MAX_JOINTS, Port

_AHEAD = 2
"""Batches that wait in the client for room at the controller before an append waits."""


def execute(core: Core, trajectory: Trajectory, way: Way | None) -> Flow[Download | PointStream]:
    """A trajectory by stream or by download; None: the way that fits."""
    yield from flows.ready(core)
    if (way or core.way_for(trajectory)) == "download":
        return (yield from flows.execute(core, trajectory))
    _can_stream(core)
    run, _ = _begin(core, trajectory)
    run.end()
    run.trajectory = trajectory.reordered(core.known_group.names)
    yield from _taken(core, run)
    return run


def append(core: Core, feed: Feed, times: npt.ArrayLike, positions: npt.ArrayLike) -> Flow[None]:
    """Check points and send them as far as there is room; waits while too many wait for it."""
    points = Trajectory(times, positions, feed.names)  # type: ignore[arg-type]
    if feed.is_ended:
        raise InvalidTrajectory(fault("RG624", "this stream has ended", "begin another one"))
    if not len(points):
        return
    if feed.way is None:
        yield from flows.ready(core)
        if not feed.may_download:
            _can_stream(core)
    if feed.way == "download" or (feed.way is None and not core.can_stream):
        _keep(core, feed, points)
        return
    run = feed.run
    if run is None:
        feed.run, checked = _begin(core, points)
        feed.way, feed.last = "stream", checked.last
        yield from _taken(core, feed.run)
        yield from _going_on(core, feed.run)
        return
    assert isinstance(run, PointStream)
    yield from _going_on(core, run)
    checked = piece(points, core.known_group, before=run.last, start=None)
    run.put(checked)
    feed.last = checked.last
    yield from _going_on(core, run)


def batch_size(core: Core) -> int:
    """Points that go well together."""
    hello = core.state_port.driver.hello
    return hello.batch if hello is not None and hello.batch > 0 else batch_points(MAX_JOINTS)


def _can_stream(core: Core) -> None:
    if not core.can_stream:
        raise NotSupported(
            fault(
                "RG624",
                "the driver does not take points while the robot moves",
                "send the trajectory as a whole, or build and deploy a driver that streams",
            )
        )


def _begin(core: Core, points: Trajectory) -> tuple[PointStream, CheckedPoints]:
    """The first points of a stream. Raises InvalidTrajectory, NotReady, ConnectionLost."""
    if not core.ports[Port.MOTION].is_open:
        raise core.disconnected()
    core.ready()
    checked = piece(points, core.known_group, before=None, start=core.start)
    run = core.begin_stream()
    run.warnings = checked.warnings
    run.put(checked)
    return run, checked


def _keep(core: Core, feed: Feed, points: Trajectory) -> None:
    """For a driver that does not stream: checked now, sent at the end."""
    if feed.total + len(points) > core.capacity:
        raise InvalidTrajectory(
            fault(
                "RG617",
                f"{feed.total + len(points)} points, and this driver, which does not stream, "
                f"holds {core.capacity}",
                "build and deploy a driver that streams",
            )
        )
    if feed.last is None:
        core.state_port.note("the driver does not stream: points are kept until the end")
    start = core.start if feed.last is None else None
    feed.last = piece(points, core.known_group, before=feed.last, start=start).last
    feed.way = "download"
    feed.keep(points)


def _taken(core: Core, run: PointStream) -> Flow[None]:
    """Until the controller took the first points, or refused them."""
    yield from _until(core, run, lambda: run.number is not None)


def _going_on(core: Core, run: PointStream) -> Flow[None]:
    """Until there is not too much that waits; after a refusal until the motion has ended."""

    def goes_on() -> bool:
        return run.refusal is None and run.backlog <= _AHEAD * run.batch

    yield from _until(core, run, goes_on)


def _until(core: Core, run: PointStream, condition: Callable[[], bool]) -> Flow[None]:
    """Until the condition holds; the error of a stream that is over is raised."""
    try:
        yield from flows.patiently(core, run, lambda: run.is_over or condition())
    except INTERRUPTIONS:
        yield from stop_and_leave(core)
        raise
    if not (run.is_over or condition()):
        waited = flows.patience(core, run)
        run.failed(
            RobotTimeout(
                fault(
                    "RG603",
                    f"the controller has not taken points for {waited:.1f} s",
                    "a STOP was sent; look at the robot",
                ),
                **core.evidence(),
            )
        )
    if run.error is not None:
        raise run.error


def flush(core: Core, feed: Feed) -> Flow[None]:
    """The robot shall start with what there is. Nothing to do where all goes at the end."""
    if isinstance(feed.run, PointStream):
        feed.run.flush()
        yield from _going_on(core, feed.run)


def end(core: Core, feed: Feed) -> Flow[None]:
    """Nothing follows; where points were kept they are sent now."""
    if not feed.total:
        raise InvalidTrajectory(
            fault("RG619", "the stream has no points", "append at least one point")
        )
    if feed.is_ended:
        return
    if isinstance(feed.run, PointStream):
        feed.run.end()
    else:
        feed.run = yield from flows.execute(core, feed.whole())
    feed.is_ended = True


def finish(core: Core, feed: Feed, timeout: float | None) -> Flow[Result]:
    """End it, and wait until the robot has executed everything."""
    yield from end(core, feed)
    if feed.run is None:
        raise InvalidTrajectory(fault("RG619", "the stream was not begun"))
    return (yield from flows.result(core, feed.run, timeout))
