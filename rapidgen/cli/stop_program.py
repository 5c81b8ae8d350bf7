"""`rapidgen stop-program`: stops the program of a controller, over Robot Web Services."""

from typing import Annotated

import typer

from rapidgen.cli import options


def stop_program(
    host: options.WebServices,
    everything: Annotated[
        bool, typer.Option("--all", help="Background tasks, too; a driver serves no more then.")
    ] = False,
    motors_off: Annotated[bool, typer.Option("--motors-off", help="Motors off, too.")] = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Stop the program of a controller.

    The robot stops on its path. Not a safety function. (`rapidgen stop` asks the driver.)
    """
    from rapidgen.cli.rws_session import controller

    with controller(host, user, secrets, fingerprint) as result:
        result.stop(everything=everything)
        if motors_off:
            result.motors(False)
        typer.echo(f"{host}: program stopped")
    return 0
