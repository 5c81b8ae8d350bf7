"""`rapidgen plot`: commanded against executed joints, and recordings, as HTML and pictures."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.diagnostics import DiagnosticError, Span, error

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.client import Robot, Trajectory
    from rapidgen.client.recording import JointRecording
    from rapidgen.motion.recorder import Recording


def plot(
    commanded: Annotated[
        Path,
        typer.Argument(
            help="CSV `time,<joint names>` (s, rad, m), or one of `controller.record()`."
        ),
    ],
    executed: Annotated[
        Path | None, typer.Argument(help="A recording of the same, to draw over it.")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="FILE.html, .png or .svg; without suffix .html, and .png where it can.",
        ),
    ] = None,
    robot: Annotated[
        str, typer.Option(help="Configuration or shipped name, whose limits are drawn.")
    ] = "",
    linear: Annotated[
        list[str] | None, typer.Option(help="A joint that is in m; may be repeated.")
    ] = None,
) -> int:
    """Draw joints over time, and how far the second file is from the first.

    Of a recording of a virtual controller: commanded and actual joints, the tool, and how far
    program and robot were in the moves.
    """
    from rapidgen.client.core.group import Group
    from rapidgen.client.trajectory import Trajectory
    from rapidgen.config import load_config
    from rapidgen.viewer import plot as draw
    from rapidgen.viewer.plotting import files_of

    group, metres = None, linear or ()
    if robot:
        config = load_config(robot)
        group = Group.of(config, config.groups[0])
    if executed is None and _is_recording(commanded):
        made = draw(_recording(commanded), title=commanded.name, group=group, linear=metres)
    elif executed is None:
        trajectory = Trajectory.from_csv(commanded)
        title = commanded.name
        made = draw(trajectory, labels=[commanded.stem], title=title, group=group, linear=metres)
    else:
        both = Trajectory.from_csv(commanded), Trajectory.from_csv(executed)
        title = f"{commanded.name} against {executed.name}"
        labels = "commanded", "executed"
        made = draw(*both, labels=labels, title=title, group=group, linear=metres)
    for path in files_of(output if output is not None else commanded.with_suffix("")):
        typer.echo(made.save(path))
    return 0


def _is_recording(path: Path) -> bool:
    from rapidgen.motion.recorder import is_recording

    return path.is_file() and is_recording(path)


def draw_motion(
    files: "Sequence[Path]",
    robot: "Robot",
    commanded: "Trajectory",
    executed: "JointRecording | None",
) -> None:
    """Write a trajectory and what became of it."""
    from rapidgen.viewer import plot as draw

    both = (commanded, executed) if executed is not None and len(executed) else (commanded,)
    made = draw(*both, group=robot.group, title=f"joints at {robot.address}")
    for path in files:
        typer.echo(f"drew {made.save(path)}", err=True)


def _recording(path: Path) -> "Recording":
    """A recording. DiagnosticError RG610: it is damaged."""
    from rapidgen.motion.recorder import read_recording

    try:
        return read_recording(path)
    except ValueError as raised:
        help = "record again with `controller.record()` and `write_csv`"
        raise DiagnosticError(error("RG610", Span(str(path), 1, 1), str(raised), help)) from None
