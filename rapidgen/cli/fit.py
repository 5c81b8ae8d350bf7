"""The command `fit`: a dense curve as few moves."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.axes.frames import Pose
    from rapidgen.curves.curve import Curve
    from rapidgen.curves.fitting import Fit, Fitter, Requirement
    from rapidgen.curves.placement import Placement, Placer

_REACHED = 0.95
"""Share of the programmed speed that the TCP has to reach on the curve."""
_MOST_TOLERANCE, _MOST_SPEED, _MOST_MOVES = 50.0, 10_000.0, 1000


def fit(
    curve: Annotated[
        Path,
        typer.Argument(
            help="CSV of x,y,z,nx,ny,nz (normals) or x,y,z,q1,q2,q3,q4 (poses).", metavar="CURVE"
        ),
    ],
    robot: Annotated[
        str,
        typer.Option("--robot", help="Shipped robot, variant or configuration.", metavar="NAME"),
    ],
    tolerance: Annotated[
        float, typer.Option(help="Largest distance of the path from the curve, mm.", metavar="MM")
    ] = 0.5,
    angle: Annotated[
        float, typer.Option(help="Largest error of the tool axis, deg.", metavar="DEG")
    ] = 3.0,
    speed: Annotated[
        float | None,
        typer.Option(help="TCP speed in mm/s; without it the highest possible.", metavar="MM/S"),
    ] = None,
    uniformity: Annotated[
        float,
        typer.Option(help="Largest standard deviation of the speed, %.", metavar="PERCENT"),
    ] = 5.0,
    moves: Annotated[
        int, typer.Option(help="Largest number of moves.", min=3, max=_MOST_MOVES, metavar="N")
    ] = 60,
    tool: Annotated[
        str,
        typer.Option(help="TCP in the flange: mm, quaternion.", metavar="X,Y,Z,Q1,Q2,Q3,Q4"),
    ] = "",
    tool_name: Annotated[
        str, typer.Option(help="Tool that the controller has already.", metavar="NAME")
    ] = "",
    normals: Annotated[
        Literal["surface", "tool"],
        typer.Option(help="Normals point out of the surface, or like the tool's z axis."),
    ] = "surface",
    unit: Annotated[Literal["mm", "m", "in"], typer.Option(help="Unit of the positions.")] = "mm",
    place: Annotated[
        bool, typer.Option("--place", help="Choose the place of the curve as well.")
    ] = False,
    seed: Annotated[int, typer.Option(help="Seed of --place.", metavar="N")] = 0,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="RAPID module.", metavar="NAME.mod")
    ] = None,
    as_json: options.AsJson = False,
) -> int:
    """Fit a dense curve by few moves within a tolerance.

    The predicted path, corners included, stays within the tolerance. The rotation about the tool
    axis is chosen for reach and speed, unless the file gives poses. Nothing moves.

    rapidgen fit blade.csv --robot irb6640 --normals tool --tolerance 0.5 --speed 300 -o blade.mod

    rapidgen fit part.csv --robot irb4600 --place
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.axes.kinematics import Kinematics
    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.controller.mechanics import robots_named
    from rapidgen.curves.curve import read_curve
    from rapidgen.curves.fitting import Fitter, Requirement
    from rapidgen.curves.module import module_of, summary
    from rapidgen.curves.placement import Placer

    _positive(tolerance, "--tolerance", _MOST_TOLERANCE)
    _positive(angle, "--angle", 180.0)
    _positive(uniformity, "--uniformity", 100.0)
    if speed is not None:
        _positive(speed, "--speed", _MOST_SPEED)
    frame = _tool(tool)
    if output is not None:
        if output.suffix.casefold() not in (".mod", ".modx"):
            raise typer.BadParameter("a module's file ends in .mod", param_hint="--output")
        check_files_writable([output])
    group = robots_named(robot)[0]
    kinematics = Kinematics.of(group)
    if kinematics is None:
        raise refusal(
            "RG787", None, f"the geometry of {robot} is unknown", "give a configuration with a URDF"
        )
    read = read_curve(curve, unit, inward=normals == "surface")
    placer = Placer(kinematics, frame)
    placement = placer.place(read, seed) if place else placer.best(read)
    if placement is None:
        raise _out_of_reach(placer, read, curve, place=place)
    wanted = Requirement(tolerance / 1000, math.radians(angle), uniformity / 100, moves)
    fitter = Fitter(group, frame, placement)
    found = fitter.fit_fastest(wanted) if speed is None else fitter.fit(speed / 1000, wanted)
    if found is None or not found.keeps(wanted):
        raise _not_kept(found, wanted, fitter, speed, moves)
    reached = 1000 * found.prediction.mean_speed
    if speed is not None and reached < _REACHED * speed:
        raise refusal(
            "RG785",
            None,
            f"the axes allow {reached:.0f} mm/s on the curve, not {speed:g}",
            f"use `--speed {math.floor(reached)}` or `--place`",
            exit_code=1,
        )
    name = output.stem if output is not None else "fit"
    module = module_of(found, kinematics, name, tool_name)
    if output is not None:
        write_whole(output, module.text.encode("latin-1"))
    if as_json:
        typer.echo(json.dumps(_figures(found, placement)))
        return 0
    typer.echo("\n".join(summary(found, kinematics)))
    if place:
        x, y, z = (1000 * v for v in placement.moved[0])
        turn = ", ".join(f"{v:.6f}" for v in placement.moved[1])
        typer.echo(f"place of the curve: {x:.1f}, {y:.1f}, {z:.1f} mm, [{turn}]")
    typer.echo(f"{output}: written" if output is not None else "use -o NAME.mod for the module")
    return 0


def _positive(value: float, name: str, most: float) -> None:
    if not 0.0 < value <= most:
        raise typer.BadParameter(f"must be above 0 and at most {most:g}", param_hint=name)


def _tool(text: str) -> "Pose":
    """Return the TCP in the flange in m."""
    from rapidgen.axes import frames

    if not text:
        return frames.IDENTITY
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) == 3:
        values += [1.0, 0.0, 0.0, 0.0]
    if len(values) != 7 or not all(map(math.isfinite, values)):
        raise typer.BadParameter("give X,Y,Z or X,Y,Z,Q1,Q2,Q3,Q4", param_hint="--tool")
    x, y, z, q1, q2, q3, q4 = values
    if abs(math.hypot(q1, q2, q3, q4) - 1) > 0.01:
        raise typer.BadParameter("the quaternion's length is not 1", param_hint="--tool")
    return (x / 1000, y / 1000, z / 1000), frames.normalise((q1, q2, q3, q4))


def _out_of_reach(placer: "Placer", curve: "Curve", path: Path, *, place: bool) -> Exception:
    from rapidgen.diagnostics import Span

    at = Span(str(path), 1, 1)
    if place:
        return refusal(
            "RG784", at, "the arm follows the curve in no place", "use a larger robot, or split it"
        )
    share = placer.reached(curve)
    if share < 1.0:
        message = f"the arm reaches {share:.0%} of the curve".replace("%", " %")
    else:
        message = "the arm reaches all points, but not without another configuration"
    return refusal("RG784", at, message, "move the curve or use `--place`; check `--normals`")


def _not_kept(
    found: "Fit | None",
    wanted: "Requirement",
    fitter: "Fitter",
    speed: float | None,
    moves: int,
) -> Exception:
    if found is None:
        return refusal(
            "RG785",
            None,
            f"no program of the curve is possible: {fitter.fault}",
            "use `--place`, or a lower `--speed`",
            exit_code=1,
        )
    own = found.prediction
    return refusal(
        "RG785",
        None,
        f"the best of at most {moves} moves misses the requirement: "
        f"{1000 * own.largest_deviation:.2f} mm, {math.degrees(own.largest_angle):.1f} deg, "
        f"speed ± {100 * own.speed_deviation:.1f} %",
        "allow more `--moves`, a larger `--tolerance`"
        + (f", or less `--speed` than {speed:g}" if speed else ""),
        exit_code=1,
    )


def _figures(fit: "Fit", placement: "Placement") -> dict[str, object]:
    own = fit.prediction
    return {
        "moves": fit.moves,
        "circles": sum(1 for w in fit.program.waypoints if w.via is not None),
        "deviation": 1000 * own.largest_deviation,
        "angle": math.degrees(own.largest_angle),
        "programmed_speed": 1000 * fit.program.speed,
        "mean_speed": 1000 * own.mean_speed,
        "speed_deviation": own.speed_deviation,
        "duration": own.duration,
        "place": [1000 * v for v in placement.moved[0]] + list(placement.moved[1]),
    }
