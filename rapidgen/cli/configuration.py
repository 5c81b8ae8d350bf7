"""The commands `robots`, `new`, `schema` and `explain`."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.diagnostics import DiagnosticError, refusal, render, suggest


def robots(
    text: Annotated[
        list[str] | None,
        typer.Argument(
            help="Words to search for; or `show NAME` for the data of one robot.",
            metavar="WORD",
        ),
    ] = None,
    known: Annotated[
        bool, typer.Option("--all", help="Also list the variants that `new` recognises.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="JSON array on stdout.")] = False,
) -> None:
    """List the shipped robot models.

    `robots show NAME` prints axes, reach and sources.
    """
    from rapidgen.config.registry import shipped_headings
    from rapidgen.diagnostics import refusal

    if text and text[0] == "show":
        from rapidgen.config.catalogue import variant_named, variant_text

        for variant in variant_named(" ".join(text[1:])):
            typer.echo(variant_text(variant))
        return
    requested = [word.casefold() for word in text or ()]
    if as_json:
        import json

        from rapidgen.config.catalogue import shipped_models

        typer.echo(json.dumps([model.as_json() for model in shipped_models()], indent=2))
        return
    rows = [
        (name, f"{description} ({', '.join(f'RW{g}' for g in generations)})")
        for name, (description, generations) in shipped_headings().items()
    ]
    if known or requested:
        from rapidgen.config.variant_library import variants
        from rapidgen.config.variant_model import missing_figures, model_name

        for variant in (v for v in variants() if not v.model):
            missing = missing_figures(variant)
            name = "-" if missing else model_name(variant)
            rows.append((name, f"ABB {variant.name}" + _missing_text(missing)))
    width = max(len(name) for name, _ in rows)
    lines = [f"{name:<{width}}  {row}" for name, row in rows]
    displayed = [line for line in lines if all(word in line.casefold() for word in requested)]
    if not displayed:
        message = f"no robot matches {' and '.join(text or ())}"
        raise refusal("RG009", None, message, "`rapidgen robots --all` lists all known robots")
    for line in displayed:
        typer.echo(line)


def _missing_text(missing: list[str]) -> str:
    """Text behind the name of a variant that has no complete data."""
    return f" (recognised only; lacks {'; '.join(missing)})" if missing else ""


def new(
    file: Annotated[Path, typer.Argument(help="Configuration to write.", metavar="FILE.yaml")],
    robot: Annotated[
        str | None, typer.Option("--robot", help="Shipped model or known variant.", metavar="NAME")
    ] = None,
    urdf: Annotated[
        Path | None, typer.Option("--urdf", help="URDF or xacro file.", metavar="FILE")
    ] = None,
    package_path: Annotated[
        list[Path] | None,
        typer.Option(
            "--package-path", help="Folder with ROS packages, for $(find ...).", metavar="FOLDER"
        ),
    ] = None,
    macro: Annotated[
        str | None,
        typer.Option(
            "--macro", help="Macro to call, if the file only defines macros.", metavar="NAME"
        ),
    ] = None,
    arg: Annotated[
        list[str] | None, typer.Option("--arg", help="Argument of xacro.", metavar="NAME=VALUE")
    ] = None,
    macro_arg: Annotated[
        list[str] | None,
        typer.Option("--macro-arg", help="Argument of the macro.", metavar="NAME=VALUE"),
    ] = None,
    joint: Annotated[
        list[str] | None,
        typer.Option(
            "--joint", help="Axis of a joint: rax_1 to rax_6, eax_a to eax_f.", metavar="NAME=AXIS"
        ),
    ] = None,
    track: Annotated[
        list[str] | None,
        typer.Option("--track", help="Axis of a joint that carries the arm.", metavar="NAME=AXIS"),
    ] = None,
    ignore: Annotated[
        list[str] | None,
        typer.Option("--ignore", help="Joint that the controller does not move.", metavar="NAME"),
    ] = None,
    hold_axis: Annotated[
        list[str] | None,
        typer.Option(
            "--hold-axis", help="Robot axis without a joint, held in place.", metavar="AXIS"
        ),
    ] = None,
    tip: Annotated[
        list[str] | None,
        typer.Option(
            "--tip", help="Last link of an arm; repeatable, one group each.", metavar="LINK"
        ),
    ] = None,
    coupling: Annotated[
        float | None,
        typer.Option(
            "--coupling", help="1: a rod couples axes 2 and 3; 0: no coupling.", metavar="0|1"
        ),
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option("--speed", help="Speed of axes without one, deg/s or mm/s.", metavar="SPEED"),
    ] = None,
    range_: Annotated[
        list[str] | None,
        typer.Option(
            "--range",
            help="Range of a joint, deg or mm; without NAME: of all turning joints without one.",
            metavar="[NAME=]LOWER..UPPER",
        ),
    ] = None,
    controller: Annotated[
        str,
        typer.Option(
            "--controller",
            help="irc5, irc5_compact or omnicore; default: the robot's, else irc5.",
            metavar="TYPE",
        ),
    ] = "",
    robotware: Annotated[
        str,
        typer.Option(
            "--robotware",
            help="RobotWare version; default: the robot's, else 6.15 or 7.10.",
            metavar="VERSION",
        ),
    ] = "",
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Write a commented configuration that checks and builds.

    Values that the description does not contain are marked with ???.
    """
    from rapidgen.cli import terminal
    from rapidgen.cli.wizard import ask_open, ask_source
    from rapidgen.config.draft import DescriptionChoices
    from rapidgen.config.scaffold import assignments, from_model, from_urdf, ranges, write_new

    if robot is None and urdf is None and terminal.is_terminal():
        robot, urdf = ask_source()
    if file.suffix not in (".yaml", ".yml"):
        raise refusal(
            "RG020",
            None,
            f"{file} does not have the suffix of a configuration",
            f"use {file.with_suffix('.yaml')}",
        )
    if (robot is None) == (urdf is None):
        raise refusal(
            "RG020",
            None,
            "give either --robot NAME or --urdf PATH",
            "`rapidgen robots` lists the shipped models",
        )
    if robot is not None:
        text = from_model(
            robot, DescriptionChoices(speed=speed, controller=controller, robotware=robotware)
        )
    else:
        description = urdf
        assert description is not None
        choices = DescriptionChoices(
            joints=assignments([*(joint or ()), *(track or ())]),
            ignore=tuple(ignore or ()),
            tips=tuple(tip or ()),
            held_axes=tuple(hold_axis or ()),
            coupling=coupling,
            speed=speed,
            ranges=ranges(range_ or ()),
            controller=controller,
            robotware=robotware,
        )

        def make(answers: DescriptionChoices) -> str:
            return from_urdf(
                description,
                folder=file.parent,
                package_paths=package_path or (),
                macro=macro,
                arguments=assignments(arg or ()),
                macro_arguments=assignments(macro_arg or ()),
                answers=answers,
            )

        if terminal.is_terminal():
            choices = ask_open(make, choices)
        text = make(choices)
    try:
        notes = write_new(file, text, package_paths=package_path or (), force=force)
    except DiagnosticError as fault:
        # The file was written, unless it existed before (RG020).
        if file.exists() and all(d.code != "RG020" for d in fault.diagnostics):
            typer.echo(f"wrote {file}, which is incomplete:", err=True)
        raise
    for note in notes:
        typer.echo(render([note]), err=True, nl=False)
    typer.echo(f"wrote {file}; next: rapidgen build {shlex.quote(str(file))}", err=True)


def schema(
    cell: Annotated[
        bool, typer.Option("--cell", help="Schema of a cell description (`run --cell FILE`).")
    ] = False,
    project: Annotated[
        bool, typer.Option("--project", help="Schema of the project file, rapidgen.toml.")
    ] = False,
) -> None:
    """Print the JSON schema of the configuration file."""
    import json

    from rapidgen.config.schema_reference import cell_schema, json_schema
    from rapidgen.system.project import project_schema

    if cell and project:
        raise typer.BadParameter("use either --cell or --project")
    made = cell_schema() if cell else project_schema() if project else json_schema()
    typer.echo(json.dumps(made, indent=2, ensure_ascii=False))


def fit_shapes(
    source: Annotated[
        Path,
        typer.Argument(
            help="URDF or xacro file, or the folder of a ROS package.", metavar="URDF|PACKAGE"
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="New folder; default: NAME_shapes.", metavar="FOLDER"),
    ] = None,
    parts: Annotated[
        int, typer.Option(help="Convex parts of a link at most.", min=1, max=32, metavar="N")
    ] = 8,
) -> None:
    """Fit convex collision shapes to the meshes of a robot.

    Writes a URDF with the parts as <collision>, which `shapes:` of a cell file accepts. Prints how
    far the parts, and a single hull, are outside of each mesh (over), and how far the mesh is
    outside of the parts (under), in mm.
    """
    import sys

    from rapidgen._extras import named
    from rapidgen.collision.fitted_urdf import (
        FittedLink,
        find_description,
        fit_description,
        summary,
        write_fitted,
    )
    from rapidgen.config.urdf.visual_trees import tree_of_file

    if not source.exists():
        raise refusal(
            "RG001",
            None,
            f"cannot read {source}: No such file or directory",
            "name a URDF or xacro file, or the folder of a ROS package",
        )
    path = find_description(source)
    folder = output if output is not None else Path(f"{path.stem}_shapes")
    if folder.exists():
        raise refusal("RG836", None, f"{folder} exists already", "choose another --output")

    def report(link: FittedLink) -> None:
        count = len(link.fit.parts) if link.fit is not None else 0
        sys.stderr.write(f"{link.name}: {count} parts\n")

    tree = tree_of_file(path)
    with named():
        links = fit_description(tree, parts, report)
    written = write_fitted(tree.graph, links, folder)
    typer.echo(summary({link.name: link.fit for link in links if link.fit is not None}), nl=False)
    typer.echo(str(written))


def explain(
    code: Annotated[
        str,
        typer.Argument(
            help="Code (RG012) or event number (50024); `all` and `events` list them.",
            metavar="CODE",
        ),
    ],
) -> None:
    """Explain a diagnostic code or an event number.

    A diagnostic has a bad and a good example, a controller's event its causes and remedy.
    """
    if code == "events" or code.isdecimal():
        _event(code)
        return
    from rapidgen.diagnostics.pages import codes, page, title

    if code == "all":
        for known in codes():
            typer.echo(f"{known}  {title(known)}")
        return
    requested = code.upper()
    if requested not in codes():
        raise refusal(
            "RG902",
            None,
            f"unknown diagnostic code '{code}'",
            (suggest(requested, codes()) if requested.startswith("RG") else "")
            or "`rapidgen explain all` lists all codes",
        )
    typer.echo(page(requested), nl=False)


def _event(code: str) -> None:
    from rapidgen.cli.event_texts import explained, listed
    from rapidgen.machine.event_table import KINDS

    if code == "events":
        for line in listed():
            typer.echo(line)
        return
    kind = KINDS.get(int(code)) if len(code) < 9 else None
    if kind is None:
        raise refusal(
            "RG902",
            None,
            f"unknown event number {code}",
            "`rapidgen explain events` lists the known events",
        )
    typer.echo(explained(kind), nl=False)
