"""Flows before a motion and until its end."""

from collections.abc import Callable
from functools import partial

from rapidgen.client.core.motion import CommandedMotion, Result, fix_of
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import NotReady
from rapidgen.client.flows.connect import SILENT, alive, reach_control
from rapidgen.client.flows.effects import INTERRUPTIONS, Close, Flow, Send, Wait
from rapidgen.client.flows.stop import ended, stop
from rapidgen.wire.simple_message.messages import HELLO
from rapidgen.wire.simple_message.spec import Port, Reason, TrajectoryState


def ready(core: Core) -> Flow[None]:
    """Connect, and wait a moment for blockers of a motion to pass."""
    yield from alive(core, to_move=True)
    yield Wait(lambda: not core.blockers() or not core.state_open, core.timeouts.ready)


def armed(core: Core) -> Flow[None]:
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

    def stirs(marker: tuple[object, ...]) -> bool:
        return holds() or motion.mark != marker

    try:
        if timeout is not None:
            yield Wait(holds, timeout)
            return holds()
        while True:
            marker = motion.mark
            # The mark may have changed back before this flow resumes: the observation of the wait
            # counts.
            stirred = yield Wait(partial(stirs, marker), stall_timeout(core, motion))
            if holds():
                return True
            if not stirred and motion.progress.state is not TrajectoryState.PAUSED:
                return False
    except INTERRUPTIONS:
        yield from stop(core)
        raise


def wait_for_result(core: Core, motion: CommandedMotion, timeout: float | None) -> Flow[Result]:
    """Wait for the end of a motion, and raise its error."""
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
