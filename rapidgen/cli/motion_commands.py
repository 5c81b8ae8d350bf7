"""A motion from the shell: who permits it, what is told while it goes on and when it is cut."""

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

from rapidgen.cli.motion_progress import follow
from rapidgen.cli.target_text import Units, named_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rapidgen.client import Execution, Result, Robot, Trajectory
    from rapidgen.client.core.checks import Way


def permitted(robot: "Robot", to: str, *, yes: bool, real_robot: str) -> bool:
    """Whether somebody must still be asked: not about a simulator. Raises as
    `need_confirmation`."""
    from rapidgen.client.permission import need_confirmation
    from rapidgen.client.sim_address import SIMULATOR

    if to == SIMULATOR:
        return False
    return need_confirmation(robot.address, yes=yes, real_robot=real_robot)


def confirm_at(robot: "Robot") -> None:
    """Ask. Raises NotReady (RG641) where nobody can answer, typer.Abort for a no."""
    from rapidgen.client import NotReady

    if not sys.stdin.isatty():
        raise NotReady.because(
            "RG641", "nobody is here to be asked: nothing was sent", "--yes answers", exit_code=2
        )
    typer.confirm(f"Move the robot at {robot.address}?", abort=True, err=True)


def execute_motion(robot: "Robot", trajectory: "Trajectory", path: "Way", units: Units) -> "Result":
    """Execute a trajectory. Ctrl-C stops the robot, and tells where it stands and how far it came.

    Raises as `Robot.execute` and `Execution.result`, KeyboardInterrupt.
    """
    with report_interruption(robot, units) as in_progress:
        execution = robot.execute(trajectory, way=path)
        in_progress.append(execution)
        return follow(execution)


@contextmanager
def report_interruption(robot: "Robot", units: Units) -> "Iterator[list[Execution]]":
    """Around a motion, which goes into the list once it is under way: Ctrl-C, which stops the
    robot, is told with where it stands and how far it came. Raises StopFailed where it does not."""
    in_progress: list[Execution] = []
    try:
        yield in_progress
    except KeyboardInterrupt:
        far = ""
        for execution in in_progress:
            progress = execution.progress
            far = f", {progress.reached} of {progress.total} points reached"
        # Again, and until it stands: a STOP more does no harm.
        state = robot.stop()
        where = named_text(units, robot.group, (state or robot.state).joints)
        typer.echo(f"\nCtrl-C: the robot stands at {where}{far}", err=True)
        raise
