"""A motion under way, with a progress bar on a terminal."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from rapidgen.client import Execution, Result


def follow(execution: "Execution") -> "Result":
    """Wait for the end of a motion. Raises what `Execution.result` raises; Ctrl-C stops."""
    if not sys.stderr.isatty():
        return execution.result()
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


def _show(bar: "Progress", task: "TaskID", execution: "Execution") -> None:
    progress = execution.progress
    bar.update(task, completed=progress.fraction, description=progress.state.name.lower())
