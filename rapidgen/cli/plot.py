"""`rapidgen plot`: commanded against executed joints, and recordings, as PNG and HTML."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.diagnostics import DiagnosticError, Span, error

if TYPE_CHECKING:
    from rapidgen.client import Robot, Trajectory
    from rapidgen.client.recording import JointRecording
    from rapidgen.client.trajectory import Array
    from rapidgen.motion.recorder import Recording
    from rapidgen.view.plot import PlottedCurve

_MOVES = "moves reached (program) and under way (robot)"


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
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Without suffix; default beside the first file."),
    ] = None,
    linear: Annotated[
        list[str] | None, typer.Option(help="A joint that is in m; may be repeated.")
    ] = None,
) -> int:
    """Draw joints over time: FILE.png and FILE.html (which shows values at the pointer).

    Of a recording of a virtual controller: commanded and actual joints, the tool, and how far
    program and robot were in the moves.
    """
    from rapidgen.client.trajectory import Trajectory
    from rapidgen.view.plot import PlottedCurve, write_plot

    metres, counts = list(linear or ()), []
    if executed is None and _is_recording(commanded):
        curves = _curves(_recording(commanded))
        metres += ["x", "y", "z"]
        counts.append(_MOVES)
    else:
        label = "commanded" if executed else commanded.stem
        curves = [PlottedCurve(label, Trajectory.from_csv(commanded))]
    if executed is not None:
        curves.append(PlottedCurve("executed", Trajectory.from_csv(executed)))
    base = out if out is not None else commanded.with_suffix("")
    paths = base.parent / f"{base.name}.png", base.parent / f"{base.name}.html"
    title = " against ".join(str(path.name) for path in (commanded, executed) if path)
    write_plot(*paths, curves, title=title, prismatic=metres, counts=counts)
    for path in paths:
        typer.echo(path)
    return 0


def _is_recording(path: Path) -> bool:
    from rapidgen.motion.recorder import is_recording

    return path.is_file() and is_recording(path)


def draw_recording(found: "Recording", paths: tuple[Path, Path], *, title: str) -> None:
    """Write PNG and HTML of a recording."""
    from rapidgen.view.plot import write_plot

    curves = _curves(found)
    write_plot(*paths, curves, title=title, prismatic=["x", "y", "z"], counts=[_MOVES])


def draw_motion(
    paths: tuple[Path, Path],
    robot: "Robot",
    commanded: "Trajectory",
    executed: "JointRecording | None",
) -> None:
    """Write PNG and HTML of a trajectory and of what became of it."""
    from rapidgen.view.plot import PlottedCurve, write_plot

    curves = [PlottedCurve("commanded", commanded)]
    if executed is not None and len(executed):
        curves.append(PlottedCurve("executed", executed.trajectory()))
    metres = [joint.name for joint in robot.group.joints if joint.kind == "prismatic"]
    write_plot(*paths, curves, title=f"joints at {robot.address}", prismatic=metres)
    typer.echo(f"drew {paths[0]} and {paths[1]}", err=True)


def _recording(path: Path) -> "Recording":
    """A recording. DiagnosticError RG610: it is damaged."""
    from rapidgen.motion.recorder import read_recording

    try:
        return read_recording(path)
    except ValueError as raised:
        mend = "record again with `controller.record()` and `write_csv`"
        raise DiagnosticError(error("RG610", Span(str(path), 1, 1), str(raised), mend)) from None


def _curves(found: "Recording") -> "list[PlottedCurve]":
    import numpy as np

    from rapidgen.client.trajectory import Trajectory
    from rapidgen.view.plot import PlottedCurve

    order: dict[str, int] = {}
    for move in (*found.program_pointer, *found.motion_pointer):
        order.setdefault(move, len(order))

    def curve(
        label: str, joints: "Array", moves: tuple[str, ...], more: "Array | None"
    ) -> PlottedCurve:
        columns = [joints, np.array([[order[move]] for move in moves], dtype=np.float64)]
        names = [*found.joints, _MOVES]
        if more is not None:
            columns.append(more[:, :3])
            names += ["x", "y", "z"]
        positions = np.hstack(columns)
        return PlottedCurve(label, Trajectory(found.time - found.time[0], positions, tuple(names)))

    return [
        curve("commanded", found.commanded, found.program_pointer, found.tcp),
        curve("actual", found.actual, found.motion_pointer, None),
    ]
