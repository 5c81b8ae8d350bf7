"""`rapidgen symbols`: RAPID data of a controller, over Robot Web Services."""

from typing import Annotated

import typer

from rapidgen.cli import options


def symbols(
    host: options.WebServices,
    name: Annotated[
        str, typer.Argument(help="TASK, TASK/MODULE or TASK/MODULE/NAME; none: all tasks.")
    ] = "",
    value: Annotated[str, typer.Argument(help="RAPID literal to set: 12.5, TRUE, [1,2].")] = "",
    kind: Annotated[str, typer.Option(help="per, var, con or any.")] = "per",
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Show a controller's RAPID data, or set one.

    A write is asked about, unless the controller is a virtual one, and read back.
    """
    from rapidgen.cli.carrying_out import make_sure
    from rapidgen.cli.web_services import ask_pendant, controller
    from rapidgen.client.rws.values import read

    parts = name.split("/") if name else []
    try:
        literal = read(value) if value else None
    except ValueError as fault:
        raise typer.BadParameter(f"'{value}' is no RAPID literal") from fault
    with controller(host, user, secrets, fingerprint) as found:
        if literal is not None:
            if not found.identity().is_virtual:
                make_sure(f"set {name} to {value} at {host}?", yes=yes)
            ask_pendant(found, "modify", found.panel().mode)
            found.set_symbol(name, literal)
        if len(parts) == 3:
            typer.echo(found.symbol_text(name))
            return 0
        tasks = parts[:1] or [task.name for task in found.tasks()]
        module = parts[1] if len(parts) == 2 else ""
        for task in tasks:
            for one in found.symbols(task, module=module, kind=kind):
                dims = "{" + ",".join(map(str, one.dims)) + "}" if one.dims else ""
                typer.echo(f"{one.path}  {one.kind}  {one.type}{dims}")
    return 0
