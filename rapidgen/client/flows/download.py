"""Trajectories and their ends, as generators run by both clients (see `effects`)."""

from collections.abc import Callable

from rapidgen.client.core.download import Download
from rapidgen.client.core.motion import CommandedMotion, Result
from rapidgen.client.core.request_port import PendingReply
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import RobotError, RobotTimeout, fault
from rapidgen.client.flows.connect import alive
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow, Send, Wait
from rapidgen.client.flows.stop import PER_POINT, stop_and_leave
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message.bulk import FRAME_BYTES, encode_trajectory
from rapidgen.wire.simple_message.messages import JOINT_TRAJ_PT
from rapidgen.wire.simple_message.spec import Port, TrajectoryState


def execute(core: Core, trajectory: Trajectory) -> Flow[Download]:
    """Check, send, and wait until the controller took it; only then it moves."""
    yield from ready(core)
    run, data = prepare(core, trajectory)
    try:
        yield from send_points(core, run, data)
        yield from finish(core, run, data)
    except INTERRUPTIONS:
        yield from stop_and_leave(core)
        raise
    except RobotError as error:
        run.failed(error)
        raise
    return run


def ready(core: Core) -> Flow[None]:
    """Connected, and no reason why the robot could not move, or none that passes soon."""
    yield from alive(core, to_move=True)
    yield Wait(lambda: not core.hindrances() or not core.state_open, core.timeouts.ready)


def prepare(core: Core, trajectory: Trajectory) -> tuple[Download, bytes]:
    """Everything before the first byte. Raises InvalidTrajectory, NotReady, ConnectionLost."""
    if not core.ports[Port.MOTION].is_open:
        raise core.disconnected()
    core.ready()
    plan = core.plan(trajectory, "download")
    data = encode_trajectory(plan.wire, plan.durations)
    return core.begin(plan), data


def send_points(core: Core, run: Download, data: bytes) -> Flow[None]:
    """Send all but the end frame: nothing moves yet."""
    yield Send(Port.MOTION, data[:-FRAME_BYTES], core.timeouts.send, run=run)


def finish(core: Core, run: Download, data: bytes) -> Flow[None]:
    """Send the end frame and wait for the controller's word."""
    pending = yield from send_end(core, run, data)
    yield from accepted(core, run, pending)


def send_end(core: Core, run: Download, data: bytes) -> Flow[PendingReply]:
    """Send the end frame: the controller may begin to move."""
    pending = core.ports[Port.MOTION].request(JOINT_TRAJ_PT.number)
    yield Send(Port.MOTION, data[-FRAME_BYTES:], core.timeouts.send, run=run)
    return pending


def accepted(core: Core, run: Download, pending: PendingReply) -> Flow[None]:
    """Wait for the controller's word on the whole trajectory."""
    patience = core.timeouts.reply + PER_POINT * len(run.plan.wire)
    yield Wait(lambda: pending.reply is not None or run.is_over, patience)
    if pending.reply is not None:
        core.answered(run, pending.reply)
    if run.error is not None:
        raise run.error
    if pending.reply is None:
        raise RobotTimeout(
            fault(
                "RG603",
                f"the controller did not answer within {patience:.1f} s whether it took the "
                "trajectory",
                "a STOP was sent; look at the robot",
            ),
            **core.evidence(),
        )


def result(core: Core, run: CommandedMotion, timeout: float | None) -> Flow[Result]:
    """Wait for the end of a motion; without a time-out for as long as it gets on."""
    try:
        yield from patiently(core, run, lambda: run.is_over, timeout)
    except INTERRUPTIONS:
        yield from stop_and_leave(core)
        raise
    if run.error is not None:
        raise run.error
    if run.result is None:
        waited = patience(core, run) if timeout is None else timeout
        raise RobotTimeout(
            fault(
                "RG603",
                f"the motion did not end within {waited:.1f} s; it goes on",
                "wait longer with result(timeout), or stop()",
            ),
            **core.evidence(),
        )
    return run.result


def patience(core: Core, run: CommandedMotion) -> float:
    """Seconds without a sign of getting on after which nobody waits any longer."""
    return 4 * run.longest / core.override + 30


def patiently(
    core: Core, run: CommandedMotion, condition: Callable[[], bool], timeout: float | None = None
) -> Flow[None]:
    """Wait until the condition holds, or `timeout` s; without, for as long as the motion gets on
    or is paused."""
    if timeout is not None:
        yield Wait(condition, timeout)
        return
    while True:
        mark = run.mark

        def stirs(mark: tuple[object, ...] = mark) -> bool:
            return condition() or run.mark != mark

        yield Wait(stirs, patience(core, run))
        if condition():
            return
        if run.mark == mark and run.progress.state is not TrajectoryState.PAUSED:
            return
