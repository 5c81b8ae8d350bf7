"""A motion program: checked, sent, taken."""

from rapidgen.client.core.checks import Way
from rapidgen.client.core.job import Job
from rapidgen.client.core.robot import Core
from rapidgen.client.flows.effects import Flow
from rapidgen.client.flows.job import taken
from rapidgen.client.flows.motion import ready
from rapidgen.client.program import Program


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
