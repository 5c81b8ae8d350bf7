"""A motion program: checked, sent, taken."""

from collections.abc import Sequence

from rapidgen.axes.frames import Pose
from rapidgen.client.core.checks import Way
from rapidgen.client.core.job import Job
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Core
from rapidgen.client.flows.effects import Flow
from rapidgen.client.flows.job import result, taken
from rapidgen.client.flows.motion import ready
from rapidgen.client.program import SLOW, Program, SpeedLike


def run(core: Core, program: Program, way: Way | None) -> Flow[Job]:
    """A program whole or by stream; None: whole, where the driver's ring holds it."""
    yield from ready(core)
    core.ready()
    checked, chosen = core.check_program(program, way)
    job = Job(core)
    job.program = program
    job.way, job.is_ended = chosen, True
    job.motion = job.stream = motion = core.begin_program(checked, chosen)
    yield from taken(core, motion)
    return job


def move_to(
    core: Core, joints: Sequence[float], *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Go to joints (rad, m), all axes together, and wait for the end. Raises as `run`."""
    return (yield from _go(core, Program(speed=speed).move_joints(joints), timeout))


def move_linear(
    core: Core, pose: Pose, *, speed: SpeedLike = SLOW, timeout: float | None = None
) -> Flow[Result]:
    """Go to a pose on a line, and wait for the end. Raises as `run`."""
    return (yield from _go(core, Program(speed=speed).move_linear(pose), timeout))


def _go(core: Core, program: Program, timeout: float | None) -> Flow[Result]:
    job = yield from run(core, program, None)
    return (yield from result(job, timeout))
