"""`rapidgen io`: signals over Robot Web Services, or those that a driver exposes."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import plain_number


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
    as_json: options.AsJson = False,
) -> int:
    """Show signals of a driver or a controller, or set one.

    Over a driver: those that its configuration exposes. Its control port serves one client, the
    newest: while the robot moves, asking is refused. Over web services a write is asked about,
    unless the controller is a virtual one, and read back.

    rapidgen io cell.yaml gripper 1 --to sim
    """
    requested = _number(value) if value else None
    if "://" in target:
        read = _over_web_services(target, name, requested, yes, user, secrets, fingerprint)
    else:
        read = _over_driver(target, name, requested, to, group)
    if as_json:
        typer.echo(json.dumps([asdict(signal) for signal in read]))
        return 0
    width = max((len(signal.name) for signal in read), default=0)
    for signal in read:
        note = "  simulated" if signal.simulated else ""
        typer.echo(f"{signal.name:<{width}}  {signal.type:<2}  {_shown(signal.value)}{note}")
    if not read:
        typer.echo(f"{target} has no signals: `signals:` of a configuration exposes them", err=True)
    return 0


@dataclass(frozen=True, slots=True)
class _Read:
    """A signal as it is shown."""

    name: str
    type: str
    value: float
    simulated: bool = False


def _number(text: str) -> float:
    try:
        return plain_number(text)
    except ValueError as fault:
        raise typer.BadParameter(f"'{text}' is no value of a signal") from fault


def _shown(value: float) -> str:
    """A group's number with all its digits, an analog value with six."""
    return f"{value:.0f}" if float(value).is_integer() else f"{value:g}"


def _over_web_services(
    host: str,
    name: str,
    value: float | None,
    yes: bool,
    user: str,
    secrets: Path | None,
    fingerprint: str,
) -> list[_Read]:
    from rapidgen.cli.plan_execution import confirm_plan
    from rapidgen.cli.rws_session import controller

    with controller(host, user, secrets, fingerprint) as result:
        if value is not None:
            if not result.identity().is_virtual:
                confirm_plan(f"set {name} to {_shown(value)} at {host}?", yes=yes)
            signals = [result.set_signal(name, value)]
        else:
            signals = [result.signal(name)] if name else list(result.signals())
    return [_Read(s.path, s.type, s.value, s.simulated) for s in signals]


def _over_driver(config: str, name: str, value: float | None, to: str, group: str) -> list[_Read]:
    from rapidgen.client import NotReady, Robot
    from rapidgen.config import load_config, shipped_names
    from rapidgen.diagnostics import refusal

    if not config.endswith((".yaml", ".yml")) and config not in shipped_names():
        raise refusal(
            "RG607",
            None,
            f"'{config}' is no configuration and no shipped name",
            f"for the signals of a controller: rws://{config}",
        )
    kinds = {signal.name: signal.kind for signal in load_config(config).signals}
    names = [name] if name else list(kinds)
    if not names:
        return []
    with Robot(config, address=to or None, group=group, watch=True) as watcher:
        if watcher.state.is_moving:
            raise NotReady.because(
                "RG622",
                "the robot moves: who moves it would lose the connection, and the robot would stop",
                "ask again when it stands",
            )
    with Robot(config, address=to or None, group=group) as robot:
        return [
            _Read(
                one,
                kinds.get(one, ""),
                robot.read_signal(one) if value is None else robot.write_signal(one, value),
            )
            for one in names
        ]
