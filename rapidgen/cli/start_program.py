"""`rapidgen start-program`: the program of a controller, over Robot Web Services."""

from typing import Annotated, Literal

import typer

from rapidgen.cli import options


def start_program(
    host: options.WebServices,
    cycle: Annotated[
        Literal["asis", "once", "forever"],
        typer.Option(help="Whether the program begins again at its end."),
    ] = "asis",
    main: Annotated[
        bool, typer.Option("--main", help="Program pointers of all tasks to main first.")
    ] = False,
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Start the program of a controller. THE ROBOT MAY MOVE.

    Shows mode, speed, selected tasks and their pointers, asks, switches the motors on and starts.
    """
    from rapidgen.cli.plan_execution import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller
    from rapidgen.cli.status import show, state

    with controller(host, user, secrets, fingerprint) as result:
        text = state(result)
        show(text)
        first = " with all program pointers at main" if main else ""
        confirm_plan(f"THE ROBOT MAY MOVE: start the program at {host}{first}?", yes=yes)
        ask_pendant(result, "exec", str(text["mode"]))
        if main:
            result.pp_to_main()
        if text["state"] != "motoron":
            result.motors(True)
        result.start(cycle=cycle)
        typer.echo(f"{host}: the program runs")
    return 0
