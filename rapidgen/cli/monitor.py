"""`rapidgen monitor`: what a robot says about itself, live."""

import sys
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rich.table import Table

    from rapidgen.client import Robot, State
    from rapidgen.view.live import Watcher


def monitor(
    config: Annotated[str, typer.Argument(help="Configuration file, shipped name or HOST[:M,S].")],
    to: Annotated[
        str,
        typer.Option(help="Where the robot is; default this machine.", metavar="HOST[:M,S]"),
    ] = "",
    group: Annotated[str, typer.Option(help="Motion group, where there are several.")] = "",
    plain: Annotated[bool, typer.Option("--plain", help="One line a state, no table.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object a line.")] = False,
    count: Annotated[
        int, typer.Option(help="End after so many states; 0: with Ctrl-C.", min=0)
    ] = 0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 0.0,
) -> int:
    """Watch a robot: joints against limits, mode, rate, jitter, last event. Ctrl-C ends it.

    A rapidgen driver tells three clients at once. A plain one tells the newest: watching takes
    the connection from a program that moves the robot, which then stops.
    """
    from rapidgen.client import Robot
    from rapidgen.view.live import Watcher

    robot = Robot(config, address=to or None, group=group, watch=True, reconnect=reconnect)
    watcher = Watcher()
    with robot:
        if not (plain or as_json) and sys.stdout.isatty():
            _live(robot, watcher, count)
            return 0
        for number, state in enumerate(robot.states(), 1):
            _take(robot, state, watcher)
            typer.echo(_json(state, watcher) if as_json else _line(state, watcher))
            if number == count:
                break
    return 0


def _take(robot: "Robot", state: "State", watcher: "Watcher") -> None:
    watcher.take(state)
    watcher.tell(robot.events[-1] if robot.events else None)


def _live(robot: "Robot", watcher: "Watcher", count: int) -> None:
    from rich.live import Live

    with Live(refresh_per_second=10) as live:
        for number, state in enumerate(robot.states(), 1):
            _take(robot, state, watcher)
            live.update(_table(robot, state, watcher))
            if number == count:
                return


def _line(state: "State", watcher: "Watcher") -> str:
    from rapidgen.view.live import activity, error_text

    joints = " ".join(f"{value:.4f}" for value in state.joints)
    status = state.status
    words = [
        f"{state.time:.3f}",
        joints,
        f"{state.rate:.1f}/s",
        status.mode.name.lower(),
        activity(state),
        error_text(status),
        watcher.event,
    ]
    return "  ".join(word for word in words if word)


def _json(state: "State", watcher: "Watcher") -> str:
    import json

    status = state.status
    p50, p99 = watcher.jitter()
    return json.dumps(
        {
            "time": state.time,
            "joints": state.by_name,
            "velocity": dict(zip(state.names, state.velocity, strict=True)),
            "rate": state.rate,
            "jitter_p50": p50,
            "jitter_p99": p99,
            "mode": status.mode.name.lower(),
            "drives": status.drives.name.lower(),
            "e_stopped": status.e_stopped.name.lower(),
            "in_motion": status.in_motion.name.lower(),
            "motion_possible": status.motion_possible.name.lower(),
            "in_error": status.in_error.name.lower(),
            "error_code": status.error_code,
            "trajectory": state.trajectory.name.lower() if state.trajectory is not None else None,
            "event": watcher.event,
        }
    )


def _table(robot: "Robot", state: "State", watcher: "Watcher") -> "Table":
    import math

    from rich.table import Table

    from rapidgen.view.live import activity, error_text

    status = state.status
    p50, p99 = watcher.jitter()
    table = Table(
        "joint",
        "value",
        "speed",
        "limits",
        title=f"{robot.address}  {status.mode.name.lower()}  {activity(state)}",
        caption=f"{state.rate:.1f} states/s, jitter p50 {p50 * 1000:.1f} ms, p99 "
        f"{p99 * 1000:.1f} ms, age {state.age * 1000:.0f} ms\n"
        f"{error_text(status) or watcher.event or 'nothing happened yet'}",
    )
    wire = robot.group.map.to_controller(state.joints)
    for index, joint in enumerate(robot.group.joints):
        revolute = joint.kind == "revolute"
        unit, factor = ("deg", 180 / math.pi) if revolute else ("mm", 1000.0)
        table.add_row(
            joint.name,
            f"{state.joints[index] * factor:9.2f} {unit}",
            f"{state.velocity[index] * factor:8.2f} {unit}/s",
            _bar(wire[index], joint.lower, joint.upper),
        )
    return table


def _bar(value: float, lower: float, upper: float, width: int = 31) -> str:
    if not upper > lower or upper - lower == float("inf"):
        return "not known"
    place = round((value - lower) / (upper - lower) * (width - 1))
    if not 0 <= place < width:
        return "outside"
    return "-" * place + "|" + "-" * (width - 1 - place)
