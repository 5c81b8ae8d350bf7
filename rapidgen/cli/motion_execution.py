"""Confirmation, progress and interruption of a motion from the shell."""

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

from rapidgen.cli.target_text import Units, named_text
from rapidgen.cli.terminal import LINE_PERIOD, is_quiet

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.progress import Progress, TaskID

    from rapidgen.client import Execution, Result, Robot, Trajectory
    from rapidgen.client.core.checks import TransferMode


def permitted(robot: "Robot", to: str, *, yes: bool, real_robot: str) -> bool:
    """True if the motion needs confirmation; never for the simulator.

    Raises as `need_confirmation`.
    """
    from rapidgen.client.permission import need_confirmation
    from rapidgen.client.sim_address import SIMULATOR

    if to == SIMULATOR:
        return False
    return need_confirmation(robot.address, yes=yes, real_robot=real_robot)


def confirm_at(robot: "Robot") -> None:
    """Ask for confirmation. Raises NotReady RG641 without a terminal, typer.Abort for a no."""
    from rapidgen.client import NotReady

    if not sys.stdin.isatty():
        raise NotReady.because(
            "RG641",
            "confirmation required, no terminal: nothing was sent",
            "confirm with --yes",
            exit_code=2,
        )
    typer.confirm(f"Move the robot at {robot.address}?", abort=True, err=True)


def execute_motion(
    robot: "Robot", trajectory: "Trajectory", mode: "TransferMode", units: Units
) -> "Result":
    """Execute a trajectory; Ctrl-C stops the robot and prints its position and progress.

    Raises as `Robot.execute` and `Execution.result`, KeyboardInterrupt.
    """
    with report_interruption(robot, units) as in_progress:
        execution = robot.execute(trajectory, mode=mode)
        in_progress.append(execution)
        return follow(execution)


@contextmanager
def report_interruption(robot: "Robot", units: Units) -> "Iterator[list[Execution]]":
    """Print position and progress if Ctrl-C stops a motion.

    The block appends the execution to the list once it has started. Raises StopFailed if the
    robot does not stop.
    """
    in_progress: list[Execution] = []
    try:
        yield in_progress
    except KeyboardInterrupt:
        reached = ""
        for execution in in_progress:
            progress = execution.progress
            reached = f", {progress.reached} of {progress.total} points reached"
        # A second STOP is harmless; this one waits until the robot has stopped.
        state = robot.stop()
        where = named_text(units, robot.group, (state or robot.state).joints)
        typer.echo(f"\nCtrl-C: stopped at {where}{reached}", err=True)
        raise


def follow(execution: "Execution") -> "Result":
    """Wait for the end of a motion: a progress bar on a terminal, else lines.

    Raises as `Execution.result`; Ctrl-C stops the robot.
    """
    if not sys.stderr.isatty():
        return _follow_in_lines(execution)
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from rapidgen.client import RobotTimeout

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("moving", total=1.0)
        while not execution.is_over:
            try:
                execution.result(timeout=0.1)
            except RobotTimeout:
                if execution.is_over:
                    raise
            _show(bar, task, execution)
        _show(bar, task, execution)
    return execution.result()


def _follow_in_lines(execution: "Execution") -> "Result":
    from rapidgen.client import RobotTimeout

    while True:
        try:
            return execution.result(timeout=LINE_PERIOD)
        except RobotTimeout:
            if execution.is_over:
                raise
        progress = execution.progress
        if not is_quiet():
            state = progress.state.name.lower()
            sys.stderr.write(f"{state}: {progress.reached} of {progress.total} points\n")


def _show(bar: "Progress", task: "TaskID", execution: "Execution") -> None:
    progress = execution.progress
    bar.update(task, completed=progress.fraction, description=progress.state.name.lower())
