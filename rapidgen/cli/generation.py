"""The commands `build`, `ros2` and `ros1`: what a configuration generates."""

import math
import sys
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import Diagnostic, refusal, render

if TYPE_CHECKING:
    from rapidgen.config.model import RobotConfig
    from rapidgen.generate import Change, Output


def build(
    config: options.Config,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="Output folder; default: rapid_out/NAME.", metavar="FOLDER"
        ),
    ] = None,
    overrides: options.Overrides = None,
    backup: options.BuildBackup = None,
    package_path: Annotated[
        list[Path] | None,
        typer.Option(help="Folder with ROS packages, for $(find ...) in xacro.", metavar="FOLDER"),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Do not write; exit with 1 if the folder differs.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Do not write; show the changes.")] = False,
    list_files: Annotated[
        bool, typer.Option("--list", help="Do not write; list the files.")
    ] = False,
) -> int:
    """Generate the driver for one controller.

    The folder is replaced as a whole. After an error it is unchanged.
    """
    from rapidgen.config import load_config
    from rapidgen.generate import build as generate
    from rapidgen.generate import compare, write

    model = load_config(config, overrides=overrides or (), package_paths=package_path or ())
    _tell(model.diagnostics)
    cell = None
    if backup is not None:
        from rapidgen.generate.existing_controller import fit, read_cell

        cell = read_cell(backup)
        # RG710 is about modules, which do not matter for cfg.
        _tell(tuple(note for note in cell.notes if note.code != "RG710"))
        model = fit(model, cell)
        typer.echo(_fitted(backup, model), err=True)
    files = generate(model, cell)
    folder = output if output is not None else Path("rapid_out") / model.name
    if list_files:
        for file in files.files:
            typer.echo(file.path)
        return 0
    if diff or check:
        changes = compare(files, folder)
        if diff:
            typer.echo(_diff(changes), nl=False)
        if check and changes:
            _differs(folder, changes)
        return 1 if changes else 0
    write(files, folder)
    typer.echo(_summary(files, folder), err=True)
    return 0


def _tell(diagnostics: tuple[Diagnostic, ...]) -> None:
    typer.echo(render(diagnostics, colour=use_colour()), err=True, nl=False)


def _fitted(backup: Path, model: "RobotConfig") -> str:
    """Text about the data that were read from a backup."""
    groups = ", ".join(f"{g.task} moves {g.mechanical_unit}" for g in model.groups)
    main = "" if model.call_main else "; the user's main calls ROS_run"
    return f"for {backup}: RobotWare {model.robotware[0]}.{model.robotware[1]:02d}, {groups}{main}"


def _summary(output: "Output", folder: Path) -> str:
    return f"{folder}: {len(output.files)} files, build {output.build_id}"


def _differs(folder: Path, changes: "list[Change]") -> None:
    paths = ", ".join(change.path for change in changes[:5])
    more = f" and {len(changes) - 5} more" if len(changes) > 5 else ""
    raise refusal(
        "RG104",
        None,
        f"{folder} differs from the output of the configuration: {paths}{more}",
        "show the differences with --diff, then build",
        exit_code=1,
    )


def _diff(changes: "list[Change]") -> str:
    from difflib import unified_diff

    out: list[str] = []
    for change in changes:
        old, new = (
            (data or b"").decode("latin-1").splitlines(keepends=True)
            for data in (change.old, change.new)
        )
        before = f"a/{change.path}" if change.old is not None else "/dev/null"
        after = f"b/{change.path}" if change.new is not None else "/dev/null"
        out += unified_diff(old, new, before, after)
    return "".join(line if line.endswith("\n") else line + "\n" for line in out)


def ros2(
    config: Annotated[
        list[str],
        typer.Argument(
            help="Configuration files or shipped names; several share one MoveIt set-up.",
            metavar="CONFIG",
        ),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder of the packages.", metavar="FOLDER")
    ],
    base_pose: Annotated[
        list[str] | None,
        typer.Option(
            help="Base of each of several robots in the world: X,Y,Z[,ROLL,PITCH,YAW], m and rad.",
            metavar="POSE",
        ),
    ] = None,
    cell: Annotated[
        Path | None,
        typer.Option(
            help="Cell file: MoveIt's scene, links of tools, and a check of goals.", metavar="FILE"
        ),
    ] = None,
    fit_shapes: Annotated[
        bool,
        typer.Option("--fit-shapes", help="Fit convex parts to the meshes, for collisions."),
    ] = False,
    overrides: options.Overrides = None,
) -> None:
    """Write ROS 2 packages with launch files, URDF and MoveIt.

    FOLDER gets three, called as it: NAME_description, NAME_bringup, NAME_moveit_config. The node
    is `python -m rapidgen.ros`. MoveIt plans for several robots together, each with its own
    controller; give --base-pose once for each of them. The description has the meshes of the
    configuration's `urdf:`.
    """
    from rapidgen.config import load_config, shipped_names
    from rapidgen.config.model import RobotConfig
    from rapidgen.ros.package import (
        JOINT_STATES_RATE,
        CellMember,
        PackageOptions,
        ros2_cell,
        ros2_packages,
        write,
    )

    places = [_base_pose(text) for text in base_pose or ()]
    if len(places) != (len(config) if len(config) > 1 else 0):
        message = "give it once for each robot" if len(config) > 1 else "only for several robots"
        raise typer.BadParameter(message, param_hint="--base-pose")
    over = tuple(overrides or ())
    models = [load_config(one, overrides=over) for one in config]
    (default,) = [one.default for one in fields(RobotConfig) if one.name == "state_period"]
    is_default = all(model.state_period == default for model in models)
    if is_default and not any(one.startswith("state.rate") for one in over):
        over = (*over, f"state.rate={JOINT_STATES_RATE}")
        models = [load_config(one, overrides=over) for one in config]
    sources = [one if one in shipped_names() else str(Path(one).resolve()) for one in config]
    found: list[Diagnostic] = []
    more = PackageOptions(cell, fit_shapes, found.append)
    if len(models) == 1:
        files = ros2_packages(models[0], sources[0], output.resolve().name, over, more)
    else:
        members = [
            CellMember(*one, overrides=over) for one in zip(models, sources, places, strict=True)
        ]
        files = ros2_cell(members, output.resolve().name, more)
    write(files, output)
    sys.stderr.write(render(found))
    typer.echo(f"{len(files)} files in {output}")
    if is_default:
        typer.echo(
            f"joint_states: {JOINT_STATES_RATE} Hz if the driver is built with "
            f"`--set state.rate={JOINT_STATES_RATE}`, as the simulator's is; else 10 Hz"
        )


def _base_pose(text: str) -> tuple[float, ...]:
    """Read a pose in m and rad. Raises BadParameter."""
    try:
        result = tuple(float(number) for number in text.split(","))
    except ValueError:
        result = ()
    if len(result) not in (3, 6) or not all(map(math.isfinite, result)):
        raise typer.BadParameter(
            f"'{text}' is not X,Y,Z or X,Y,Z,ROLL,PITCH,YAW in m and rad", param_hint="--base-pose"
        )
    return (*result, 0.0, 0.0, 0.0)[:6]


def ros1(
    config: options.Config,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder of the package.", metavar="FOLDER")
    ],
    overrides: options.Overrides = None,
) -> None:
    """Write a catkin package for the ROS-Industrial nodes.

    It contains a launch file, parameters, and a watcher that cancels a goal if the driver reports
    an error. The ROS-Industrial nodes are unmodified.
    """
    from rapidgen.config import load_config, shipped_names
    from rapidgen.ros.package import ros1_package, write

    model = load_config(config, overrides=overrides or ())
    source = config if config in shipped_names() else str(Path(config).resolve())
    files = ros1_package(model, source, output.resolve().name)
    write(files, output)
    typer.echo(f"{len(files)} files in {output}")
