"""`rapidgen stop`: STOP to all motion groups of a robot, at once.

The first STOP is on its way before this is imported: `quick_stop`.
"""

from typing import Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import Units, named_text


def stop(
    config: options.ConfigOrHost,
    to: options.RobotAddress = "",
    group: Annotated[str, typer.Option(help="Only this motion group.")] = "",
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Stop the robot: every motion group, or one. Not a safety function."""
    from rapidgen.client import Cell, Robot, Timeouts
    from rapidgen.client.connect_target import groups_of

    names = [group] if group else groups_of(config)
    quick = Timeouts(connect=2, stop=2)
    cell = Cell({n: Robot(config, address=to or None, group=n, timeouts=quick) for n in names})
    try:
        # STOP goes to all groups before anybody looks where they stand.
        cell.stop()
    finally:
        cell.close()
    text = {}
    for name in names:
        with Robot(config, address=to or None, group=name, watch=True) as watcher:
            state = watcher.wait_until(lambda s: not s.is_moving, timeout=5)
            text[name] = state.by_name
            if not as_json:
                label = f"{name}: " if name else ""
                where = named_text(Units(rad), watcher.group, state.joints)
                typer.echo(f"{label}stopped at {where}")
    if as_json:
        import json

        typer.echo(json.dumps({"stopped": True, "groups": text}))
    return 0
