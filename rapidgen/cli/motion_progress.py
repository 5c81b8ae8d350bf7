"""A motion under way: a progress bar on a terminal, a line every 10 s elsewhere."""

import sys
from typing import TYPE_CHECKING

from rapidgen.cli.progress import EVERY
from rapidgen.cli.verbosity import is_quiet

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from rapidgen.client import Execution, Result


def follow(execution: "Execution") -> "Result":
    """Wait for the end of a motion. Raises what `Execution.result` raises; Ctrl-C stops."""
    if not sys.stderr.isatty():
        return _told_in_lines(execution)
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


def _told_in_lines(execution: "Execution") -> "Result":
    from rapidgen.client import RobotTimeout

    while True:
        try:
            return execution.result(timeout=EVERY)
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
