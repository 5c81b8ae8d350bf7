"""`rapidgen io`: signals over Robot Web Services, or those that a driver exposes."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def io(
    target: Annotated[
        str,
        typer.Argument(
            help="rws://HOST or rwss://HOST, or a configuration: its driver.", metavar="HOST|CONFIG"
        ),
    ],
    name: Annotated[str, typer.Argument(help="Signal; none: all of them.")] = "",
    value: Annotated[str, typer.Argument(help="Value to set.")] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Show a controller's signals, or set one.

    Over web services a write is asked about, unless the controller is a virtual one, and read
    back. Over a driver: the signals that its configuration exposes.
    """
    wanted = _number(value) if value else None
    if "://" in target:
        return _over_web_services(target, name, wanted, yes, user, secrets, fingerprint)
    return _over_driver(target, name, wanted, to, group)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as fault:
        raise typer.BadParameter(f"'{text}' is no value of a signal") from fault


def _over_web_services(
    host: str,
    name: str,
    value: float | None,
    yes: bool,
    user: str,
    secrets: Path | None,
    fingerprint: str,
) -> int:
    from rapidgen.cli.carrying_out import make_sure
    from rapidgen.cli.web_services import controller

    with controller(host, user, secrets, fingerprint) as found:
        if value is not None:
            if not found.identity().is_virtual:
                make_sure(f"set {name} to {value:g} at {host}?", yes=yes)
            signals = [found.set_signal(name, value)]
        else:
            signals = [found.signal(name)] if name else list(found.signals())
    width = max((len(signal.path) for signal in signals), default=0)
    for signal in signals:
        note = "  simulated" if signal.simulated else ""
        typer.echo(f"{signal.path:<{width}}  {signal.type:<2}  {signal.value:g}{note}")
    return 0


def _over_driver(config: str, name: str, value: float | None, to: str, group: str) -> int:
    from rapidgen.client import Robot
    from rapidgen.config import load_config

    names = [name] if name else [signal.name for signal in load_config(config).signals]
    with Robot(config, address=to or None, group=group, watch=True) as robot:
        for one in names:
            now = robot.read_signal(one) if value is None else robot.write_signal(one, value)
            typer.echo(f"{one}  {now:g}")
    return 0
