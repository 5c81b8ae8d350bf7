"""Before a motion, and until its end."""

from collections.abc import Callable
from functools import partial

from rapidgen.client.core.motion import CommandedMotion, Result
from rapidgen.client.core.robot import Core
from rapidgen.client.flows.connect import alive
from rapidgen.client.flows.effects import INTERRUPTIONS, Flow, Wait
from rapidgen.client.flows.stop import stop
from rapidgen.wire.simple_message.spec import TrajectoryState


def ready(core: Core) -> Flow[None]:
    """Connected, and no reason why the robot could not move, or none that passes soon."""
    yield from alive(core, to_move=True)
    yield Wait(lambda: not core.hindrances() or not core.state_open, core.timeouts.ready)


def patience(core: Core, motion: CommandedMotion) -> float:
    """Seconds without a sign of getting on after which nobody waits any longer."""
    return 4 * motion.longest / core.override + 30


def until(
    core: Core,
    motion: CommandedMotion,
    condition: Callable[[], bool],
    timeout: float | None = None,
) -> Flow[bool]:
    """Whether the condition came to hold, or the motion to its end, within `timeout` s; without
    one, for as long as the motion gets on or is paused. An interruption stops the robot and goes on
    when it stands; a second one does not wait for that."""

    def holds() -> bool:
        return motion.is_over or condition()

    def stirs(mark: tuple[object, ...]) -> bool:
        return holds() or motion.mark != mark

    try:
        if timeout is not None:
            yield Wait(holds, timeout)
            return holds()
        while True:
            mark = motion.mark
            # The mark may be the same again before this goes on: what the wait has seen counts.
            stirred = yield Wait(partial(stirs, mark), patience(core, motion))
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
        raise motion.error
    if motion.result is None:
        waited = patience(core, motion) if timeout is None else timeout
        raise core.state_port.late(
            f"the motion did not end within {waited:.1f} s; it goes on",
            "wait longer with result(timeout), or stop()",
        )
    return motion.result
