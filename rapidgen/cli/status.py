"""`rapidgen status`: what a controller says about itself, over Robot Web Services."""

from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rapidgen.client.rws import Controller


def status(
    host: options.WebServices,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> int:
    """Show a controller: mode, motors, speed, tasks, pointers.

    Robot Web Services of RobotWare 6, 7 or 8; which of them is found out. Reads only.
    """
    import json

    from rapidgen.cli.rws_session import controller

    with controller(host, user, secrets, fingerprint) as result:
        text = state(result)
    if as_json:
        typer.echo(json.dumps(text, indent=2))
    else:
        show(text)
    return 0


def state(result: "Controller") -> dict[str, object]:
    """What there is to tell: nine requests and one for each task, with login and logout."""
    who, panel, execution = result.identity(), result.panel(), result.execution()
    tasks = []
    for task in result.tasks():
        at = result.pointer(task.name)
        place = f"{at.module}/{at.routine}:{at.row}" if at.module else ""
        text = {"name": task.name, "type": task.kind, "execution": task.execution}
        tasks.append({**text, "selected": task.active, "pointer": place})
    return {
        "host": result.where,
        "name": who.name,
        "id": who.id,
        "robotware": who.robotware,
        "virtual": who.is_virtual,
        "state": panel.state,
        "mode": panel.mode,
        "speed": panel.speed,
        "running": execution.running,
        "cycle": execution.cycle,
        "tasks": tasks,
        "fixes": _fixes(tasks),
    }


def _fixes(tasks: "Sequence[Mapping[str, object]]") -> list[str]:
    """What to do about background tasks that stand: neither Start nor PP to Main starts them."""
    standing = [
        str(task["name"])
        for task in tasks
        if task["type"] != "normal" and task["execution"] != "started"
    ]
    if not standing:
        return []
    names = ", ".join(standing)
    driver = "; the driver moves nothing until then" if any(map(_is_driver, standing)) else ""
    return [
        f"{names}: does not run. A warm start (menu > Restart) begins background tasks again"
        f"{driver}; the event log says why it ended: `rapidgen log`"
    ]


def _is_driver(task: str) -> bool:
    """Whether a task has a name that generated drivers give their background tasks."""
    return task.upper().startswith("T_ROS_")


def show(text: dict[str, object]) -> None:
    """The same for people, on stdout."""
    kind = "virtual controller" if text["virtual"] else "controller"
    typer.echo(f"{text['name']} at {text['host']}: {kind}, RobotWare {text['robotware']}")
    program = "runs" if text["running"] else "stands"
    typer.echo(
        f"{text['mode']}, {text['state']}, speed {text['speed']} %, program {program}"
        f" ({text['cycle']})"
    )
    tasks = text["tasks"]
    assert isinstance(tasks, list)
    width = max((len(task["name"]) for task in tasks), default=0)
    for task in tasks:
        marker = "*" if task["selected"] else " "
        typer.echo(
            f"{marker} {task['name']:<{width}}  {task['type']:<11} {task['execution']:<13}"
            f" {task['pointer']}".rstrip()
        )
    fixes = text["fixes"]
    assert isinstance(fixes, list)
    for fix in fixes:
        typer.echo(f"! {fix}")
