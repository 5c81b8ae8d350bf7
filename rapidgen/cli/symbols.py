"""`rapidgen symbols`: RAPID data of a controller, over Robot Web Services."""

from typing import Annotated, Literal

import typer

from rapidgen.cli import options


def symbols(
    host: options.WebServices,
    name: Annotated[
        str, typer.Argument(help="TASK, TASK/MODULE or TASK/MODULE/NAME; none: all tasks.")
    ] = "",
    value: Annotated[str, typer.Argument(help="RAPID literal to set: 12.5, TRUE, [1,2].")] = "",
    kind: Annotated[
        Literal["per", "var", "con", "any"], typer.Option(help="per, var, con or any.")
    ] = "per",
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="JSON on stdout.")] = False,
) -> int:
    """Show a controller's RAPID data, or set one.

    A write is asked about, unless the controller is a virtual one, and read back.
    """
    import json
    from dataclasses import asdict

    from rapidgen.cli.plan_execution import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller
    from rapidgen.client.rws.values import read

    parts = name.split("/") if name else []
    try:
        literal = read(value) if value else None
    except ValueError as fault:
        raise typer.BadParameter(f"'{value}' is no RAPID literal") from fault
    if value and len(parts) < 2:
        raise typer.BadParameter(f"'{name}' is no datum: TASK/MODULE/NAME")
    with controller(host, user, secrets, fingerprint) as result:
        if literal is not None:
            if not result.identity().is_virtual:
                confirm_plan(f"set {name} to {value} at {host}?", yes=yes)
            ask_pendant(result, "modify", result.panel().mode)
            result.set_symbol(name, literal)
        if len(parts) == 3:
            text = result.symbol_text(name)
            typer.echo(json.dumps({"path": name, "value": text}) if as_json else text)
            return 0
        tasks = parts[:1] or [task.name for task in result.tasks()]
        module = parts[1] if len(parts) == 2 else ""
        all_of = [s for t in tasks for s in result.symbols(t, module=module, kind=kind)]
    if module and not all_of:
        hint = f"`rapidgen symbols {host} {parts[0]} --kind any` lists what there is"
        raise typer.BadParameter(f"no data of kind {kind} in {name}: {hint}")
    if as_json:
        typer.echo(json.dumps([asdict(one) for one in all_of], indent=2))
        return 0
    for one in all_of:
        dims = "{" + ",".join(map(str, one.dims)) + "}" if one.dims else ""
        typer.echo(f"{one.path}  {one.kind}  {one.type}{dims}")
    return 0
