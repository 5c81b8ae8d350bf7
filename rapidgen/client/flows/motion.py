"""Flows of a motion: from the check of its points to its end.

`execute` is the way of a trajectory: wait until the robot is ready, check the points, make sure
that STOP works, send, wait for the reply.
"""

from collections.abc import Callable
from functools import partial

from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.download import Download
from rapidgen.client.core.motion import CommandedMotion, Result, fix_of
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import State
from rapidgen.client.core.stream import PointStream
from rapidgen.client.errors import NotReady, RobotError
from rapidgen.client.flows.connect import SILENT, alive, reach_control
from rapidgen.client.flows.effects import INTERRUPTIONS, Close, Flow, Send, Wait
from rapidgen.client.flows.stop import PER_POINT, ended, stop
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.messages import HELLO, JOINT_TRAJ_PT
from rapidgen.wire.simple_message.spec import Port, Reason, TrajectoryState


def ready(core: Core) -> Flow[None]:
    """Connect, and wait a moment for blockers of a motion to pass. Raises NotReady."""
    yield from alive(core, to_move=True)
    yield Wait(lambda: not core.blockers() or not core.state_open, core.timeouts.ready)
    core.ready()


def control_answers(core: Core) -> Flow[None]:
    """Make sure that the driver's control port answers. Raises NotReady.

    This is the last step before an order: a new connection there ends the motion of the client
    before.
    """
    yield from reach_control(core)
    control = core.ports[Port.CONTROL]
    if control.is_open and not core.is_control_fresh:
        pending = control.request(HELLO.number)
        yield Send(Port.CONTROL, core.hello(subscribe=False), core.timeouts.send)
        yield Wait(lambda: pending.reply is not None or not control.is_open, core.timeouts.reply)
        if pending.reply is None and control.is_open:
            yield Close(Port.CONTROL)
            core.without_control(SILENT, again=True)
    if core.state_port.driver.control_fault == SILENT:
        raise NotReady.because(
            "RG621",
            f"{SILENT}, so a STOP would not work: nothing was sent",
            fix_of(Reason.TASK_ENDED, ""),
            **core.evidence(),
        )
    core.ready()


def stall_timeout(core: Core, motion: CommandedMotion) -> float:
    """Seconds without progress after which a wait fails."""
    return 4 * motion.longest / core.override + 30


def until(
    core: Core,
    motion: CommandedMotion,
    condition: Callable[[], bool],
    timeout: float | None = None,
) -> Flow[bool]:
    """Wait for the condition or the motion's end; False after `timeout` s.

    Without a time-out it waits while the motion progresses or is paused. An interruption stops the
    robot and is raised when the robot is at rest; a second one is raised at once.
    """

    def holds() -> bool:
        return motion.is_over or condition()

    def has_progressed(marker: tuple[object, ...]) -> bool:
        return holds() or motion.progress_marker != marker

    try:
        if timeout is not None:
            yield Wait(holds, timeout)
            return holds()
        while True:
            marker = motion.progress_marker
            # The mark may have changed back before this flow resumes: the observation of the wait
            # counts.
            progressed = yield Wait(partial(has_progressed, marker), stall_timeout(core, motion))
            if holds():
                return True
            if not progressed and motion.progress.state is not TrajectoryState.PAUSED:
                return False
    except INTERRUPTIONS:
        yield from stop(core)
        raise


def execute(core: Core, trajectory: Trajectory, mode: TransferMode | None) -> Flow[CommandedMotion]:
    """Start a trajectory by stream or download; None: choose."""
    yield from ready(core)
    checked = core.check(trajectory, mode)
    yield from control_answers(core)
    motion = core.begin(checked)
    if isinstance(motion, PointStream):
        motion.trajectory = checked.trajectory
        motion.end()
        yield from stream_accepted(core, motion)
        return motion
    try:
        yield from send_points(core, motion)
        yield from send_end(core, motion)
        yield from download_accepted(core, motion)
    except INTERRUPTIONS:
        yield from stop(core)
        raise
    except RobotError as error:
        motion.failed(error)
        raise (yield from ended(core, motion)) from error.__cause__
    return motion


def send_points(core: Core, motion: Download) -> Flow[None]:
    """Send all points but the last one: the robot does not move yet."""
    yield Send(Port.MOTION, motion.take_points(), core.timeouts.send, motion)


def send_end(core: Core, motion: Download) -> Flow[None]:
    """Send the last point, after which the controller may begin to move."""
    pending = core.ports[Port.MOTION].request(JOINT_TRAJ_PT.number)
    yield Send(Port.MOTION, motion.take_end(pending), core.timeouts.send, motion)


def download_accepted(core: Core, motion: Download) -> Flow[None]:
    """Wait for the controller's reply to a downloaded trajectory."""
    timeout = core.timeouts.reply + PER_POINT * motion.frames
    yield Wait(lambda: motion.is_accepted or motion.is_over, timeout)
    if motion.is_accepted:
        return
    if motion.error is not None:
        raise motion.error
    raise core.state_port.late(
        f"the controller did not answer within {timeout:.1f} s if it accepted the trajectory",
        "a STOP was sent; look at the robot",
    )


def stream_accepted(core: Core, stream: PointStream) -> Flow[None]:
    """Wait until the controller accepts or refuses the first points.

    For a program it is the whole of it. The motion may have ended already: then its result shows
    how.
    """
    yield from streaming(core, stream, lambda: stream.is_accepted)
    if stream.error is not None and (stream.needs_stop or not stream.is_accepted):
        raise (yield from ended(core, stream))


def streaming(core: Core, stream: PointStream, condition: Callable[[], bool]) -> Flow[None]:
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


def result(core: Core, motion: CommandedMotion, timeout: float | None = None) -> Flow[Result]:
    """Wait for the end, by default while the robot progresses or is paused.

    Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time (the
    motion continues). Ctrl-C or cancelling this call stops the robot.
    """
    yield from until(core, motion, lambda: False, timeout)
    if motion.error is not None:
        raise (yield from ended(core, motion))
    if motion.result is None:
        waited = stall_timeout(core, motion) if timeout is None else timeout
        raise core.state_port.late(
            f"the motion did not end within {waited:.1f} s; it continues",
            "wait longer with result(timeout), or stop()",
        )
    return motion.result


def cancel(core: Core, motion: CommandedMotion | None) -> Flow[State | None]:
    """Stop this motion; return the state at rest, or None if it has ended."""
    if motion is None:
        return None
    if not motion.is_over or motion.needs_stop:
        motion.rest = yield from stop(core)
    return motion.rest
