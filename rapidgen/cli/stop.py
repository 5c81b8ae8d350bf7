"""`rapidgen stop`: STOP to all motion groups of a robot, at once."""

from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options

if TYPE_CHECKING:
    from rapidgen.client import State


def stop(
    config: options.ConfigOrHost,
    to: options.RobotAddress = "",
    group: Annotated[str, typer.Option(help="Only this motion group.")] = "",
) -> int:
    """Stop the robot: every motion group, or one. Not a safety function."""
    from rapidgen.client import Cell, Robot, Timeouts
    from rapidgen.client.target import groups_of

    names = [group] if group else groups_of(config)
    quick = Timeouts(connect=2, stop=2)
    cell = Cell({n: Robot(config, address=to or None, group=n, timeouts=quick) for n in names})
    try:
        # STOP goes to all groups before anybody looks where they stand.
        cell.stop()
    finally:
        cell.close()
    for name in names:
        with Robot(config, address=to or None, group=name, watch=True) as watcher:
            state = watcher.wait_until(lambda s: not s.is_moving, timeout=5)
        label = f"{name}: " if name else ""
        typer.echo(f"{label}stopped at {_joints(state)}")
    return 0


def _joints(state: "State") -> str:
    return ", ".join(f"{name} {value:.4f}" for name, value in state.by_name.items())
