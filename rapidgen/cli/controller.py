"""The commands over Robot Web Services: `status`, `log`, `io` and others."""

import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import plain_number, target_first
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from rapidgen.client.rws import Controller
    from rapidgen.client.rws.model import SymbolInfo


Every = Annotated[
    float | None,
    typer.Option(
        help="Repeat until Ctrl-C; JSON is then one line each time.",
        min=0.2,
        max=3600,
        metavar="SECONDS",
    ),
]


def status(
    host: options.WebServices = "",
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="JSON object on stdout.")] = False,
    modules: Annotated[
        bool, typer.Option("--modules", help="Also the modules of each task.")
    ] = False,
    every: Every = None,
) -> int:
    """Show the mode, motors, speed and tasks of a controller.

    Uses Robot Web Services of RobotWare 6, 7 or 8 and detects the version. Reads only.
    """

    from rapidgen.cli.rws_session import controller

    (host,) = target_first(to, host)
    with controller(host, user, secrets, fingerprint) as result:
        for _ in _looks(every):
            text = controller_state(result, modules=modules)
            if as_json:
                typer.echo(json.dumps(text, indent=None if every else 2))
            else:
                show_state(text)
    return 0


def _looks(every: float | None) -> "Iterator[None]":
    """Yield once, or again and again with so many s between."""
    yield
    while every:
        time.sleep(every)
        yield


def controller_state(result: "Controller", *, modules: bool = False) -> dict[str, object]:
    """Return the state: nine requests and one for each task, with login and logout.

    `modules`: also the modules of each task, with one more request for each task.
    """
    who, panel, execution = result.identity(), result.panel(), result.execution()
    tasks: list[dict[str, object]] = []
    for task in result.tasks():
        at = result.pointer(task.name)
        place = f"{at.module}/{at.routine}:{at.row}" if at.module else ""
        text = {"name": task.name, "type": task.kind, "execution": task.execution}
        tasks.append({**text, "selected": task.active, "pointer": place})
        if modules:
            loaded = result.modules(task.name)
            tasks[-1]["modules"] = [{"name": m.name, "system": m.is_system} for m in loaded]
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
    """Fixes for stopped background tasks, which neither Start nor PP to Main starts."""
    stopped = [
        str(task["name"])
        for task in tasks
        if task["type"] != "normal" and task["execution"] != "started"
    ]
    if not stopped:
        return []
    names = ", ".join(stopped)
    driver = (
        "; until then, the driver does not move the robot" if any(map(_is_driver, stopped)) else ""
    )
    return [
        f"{names}: not running. A warm start (menu > Restart) restarts background tasks"
        f"{driver}; the event log contains the reason: `rapidgen log`"
    ]


def _is_driver(task: str) -> bool:
    """True if a task has the name of a generated driver's background task."""
    return task.upper().startswith("T_ROS_")


def show_state(text: dict[str, object]) -> None:
    """Print the state as text."""
    kind = "virtual controller" if text["virtual"] else "controller"
    typer.echo(f"{text['name']} at {text['host']}: {kind}, RobotWare {text['robotware']}")
    program = "running" if text["running"] else "stopped"
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
        for module in task.get("modules", ()):
            kind = "  system module" if module["system"] else ""
            typer.echo(f"    {module['name']}{kind}")
    fixes = text["fixes"]
    assert isinstance(fixes, list)
    for fix in fixes:
        typer.echo(f"! {fix}")


_FOLLOW_COUNT = 10_000
"""Maximum number of entries that --follow reads at a time; no burst has more."""


def log(
    host: Annotated[
        str,
        typer.Argument(
            help="Controller (HOST[:PORT], rws://HOST, rwss://HOST) or saved event log.",
            metavar="HOST|FILE",
        ),
    ] = "",
    follow: Annotated[
        bool,
        typer.Option("--follow", "-f", help="Show new entries until Ctrl-C, also after restarts."),
    ] = False,
    count: Annotated[
        int, typer.Option(help="Number of existing entries.", min=0, metavar="N")
    ] = 20,
    domain: Annotated[
        int, typer.Option(help="Domain of the entries; 0: all.", min=0, max=99, metavar="N")
    ] = 0,
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object per line.")] = False,
) -> int:
    """Show and explain the event log of a controller.

    The oldest entry is first. Ctrl-C ends `--follow`. A saved log is shown with an explanation of
    each event, and a summary of its errors and warnings.
    """
    (host,) = target_first(to, host)
    if "://" not in host and ("/" in host or Path(host).is_file()):
        if follow:
            raise refusal(
                "RG901", None, "--follow needs a controller", "use HOST, or leave out --follow"
            )
        return _saved(Path(host), count, domain, as_json)
    from dataclasses import asdict

    from rapidgen.cli.rws_session import controller
    from rapidgen.client.errors import ConnectionFailed, ConnectionLost
    from rapidgen.client.rws.model import LogEvent

    with controller(host, user, secrets, fingerprint) as result:
        last: LogEvent | None = None
        events = result.log(domain=domain, count=count)
        while True:
            for event in events:
                typer.echo(json.dumps(asdict(event)) if as_json else event)
                last = event
            if not follow:
                return 0
            time.sleep(1.0)
            try:
                events = result.log(
                    domain=domain, after=last.number if last else 0, count=_FOLLOW_COUNT
                )
            except (ConnectionFailed, ConnectionLost):
                result.wait_ready()
                # Numbers may restart at 1: the last entry is recognised by all its fields.
                events = result.log(domain=domain, count=_FOLLOW_COUNT)
                if last in events:
                    events = events[events.index(last) + 1 :]


def _saved(path: Path, count: int, domain: int, as_json: bool) -> int:
    from dataclasses import asdict

    from rapidgen.cli.event_texts import saved_event, summary
    from rapidgen.machine.saved_log import read_saved_log

    result = read_saved_log(path)
    events = [e for e in result.events if domain in (0, e.code // 10_000)]
    events.sort(key=lambda event: event.sequence)
    for event in events[-count:] if count else ():
        typer.echo(json.dumps(asdict(event)) if as_json else saved_event(event))
    if not as_json:
        typer.echo()
        for line in summary(result):
            typer.echo(line)
    return 0


def start_program(
    host: options.WebServices = "",
    cycle: Annotated[
        Literal["asis", "once", "forever"],
        typer.Option(help="Number of cycles of the program; asis: as set on the controller."),
    ] = "asis",
    main: Annotated[
        bool, typer.Option("--main", help="First set the program pointers of all tasks to main.")
    ] = False,
    yes: options.Yes = False,
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Start the program of a controller (THE ROBOT MAY MOVE).

    Shows mode, speed, selected tasks and their pointers, asks for confirmation, switches the
    motors on and starts.
    """
    from rapidgen.cli.deployment import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller

    (host,) = target_first(to, host)
    with controller(host, user, secrets, fingerprint) as result:
        text = controller_state(result)
        show_state(text)
        first = " with all program pointers at main" if main else ""
        confirm_plan(f"THE ROBOT MAY MOVE: start the program at {host}{first}?", yes=yes)
        ask_pendant(result, "exec", str(text["mode"]))
        if main:
            result.pp_to_main()
        if text["state"] != "motoron":
            result.motors(True)
        result.start(cycle=cycle)
        typer.echo(f"{host}: program started")
    return 0


def stop_program(
    host: options.WebServices = "",
    everything: Annotated[
        bool,
        typer.Option("--all", help="Also stop background tasks; a driver then serves no clients."),
    ] = False,
    motors_off: Annotated[
        bool, typer.Option("--motors-off", help="Also switch the motors off.")
    ] = False,
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Stop the program of a controller.

    The robot stops on its path. Not a safety function. `rapidgen stop` stops a robot through
    its driver.
    """
    from rapidgen.cli.rws_session import controller

    (host,) = target_first(to, host)
    with controller(host, user, secrets, fingerprint) as result:
        result.stop(everything=everything)
        if motors_off:
            result.motors(False)
        typer.echo(f"{host}: program stopped")
    return 0


def io(
    target: Annotated[
        str,
        typer.Argument(
            help="Controller (rws://HOST, rwss://HOST) or configuration of a driver.",
            metavar="HOST|CONFIG",
        ),
    ],
    name: Annotated[
        str, typer.Argument(help="Name of the signal; default: all.", metavar="SIGNAL")
    ] = "",
    value: Annotated[str, typer.Argument(help="Value to set.", metavar="VALUE")] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: options.AsJson = False,
) -> int:
    """Show or set signals of a driver or a controller.

    A driver has the signals that its configuration exposes. Its control port serves one client,
    the newest; the request is rejected while the robot moves. Over Robot Web Services, a write
    needs confirmation, unless the controller is virtual, and is read back.

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
        typer.echo(f"{target} has no signals: list them under `signals:`", err=True)
    return 0


@dataclass(frozen=True, slots=True)
class _Read:
    """A signal to be shown."""

    name: str
    type: str
    value: float
    simulated: bool = False


def _number(text: str) -> float:
    try:
        return plain_number(text)
    except ValueError as fault:
        raise typer.BadParameter(f"'{text}' is not a signal value") from fault


def _shown(value: float) -> str:
    """Format a group signal with all digits, an analog signal with six."""
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
    from rapidgen.cli.deployment import confirm_plan
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
            f"'{config}' is not a configuration or shipped name",
            f"use rws://{config} for the signals of a controller",
        )
    kinds = {signal.name: signal.kind for signal in load_config(config).signals}
    names = [name] if name else list(kinds)
    if not names:
        return []
    with Robot(config, address=to or None, group=group, watch=True) as watcher:
        if watcher.state.is_moving:
            raise NotReady.because(
                "RG622",
                "the robot is moving: the client that moves it would lose its connection",
                "repeat the command when the robot has stopped",
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


def symbols(
    host: options.WebServices = "",
    name: Annotated[
        str,
        typer.Argument(
            help="TASK, TASK/MODULE or TASK/MODULE/NAME; default: all tasks.", metavar="PATH"
        ),
    ] = "",
    value: Annotated[
        str, typer.Argument(help="RAPID literal to set: 12.5, TRUE, [1,2].", metavar="VALUE")
    ] = "",
    kind: Annotated[
        Literal["per", "var", "con", "any"],
        typer.Option(help="Persistents, variables, constants or all data."),
    ] = "per",
    source: Annotated[
        bool, typer.Option("--source", help="Source text of TASK/MODULE instead of its data.")
    ] = False,
    values: Annotated[
        bool, typer.Option("--values", help="Also the values of the data of TASK/MODULE.")
    ] = False,
    every: Every = None,
    yes: options.Yes = False,
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="JSON on stdout.")] = False,
) -> int:
    """Show or set RAPID data of a controller.

    With `--source` the source text of a module is shown instead. A write needs
    confirmation, unless the controller is virtual, and is read back.
    """

    from rapidgen.cli.deployment import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller
    from rapidgen.client.rws.values import read

    host, name, value = target_first(to, host, name, value)
    parts = name.split("/") if name else []
    try:
        literal = read(value) if value else None
    except ValueError as fault:
        raise typer.BadParameter(f"'{value}' is not a RAPID literal") from fault
    if value and len(parts) < 2:
        raise typer.BadParameter(f"'{name}' is not TASK/MODULE/NAME")
    if (source or values) and (value or len(parts) != 2):
        raise typer.BadParameter("--source and --values take TASK/MODULE and no value")
    if every and not values:
        raise typer.BadParameter("--every repeats --values")
    with controller(host, user, secrets, fingerprint) as result:
        if literal is not None:
            if not result.identity().is_virtual:
                confirm_plan(f"set {name} to {value} at {host}?", yes=yes)
            ask_pendant(result, "modify", result.panel().mode)
            result.set_symbol(name, literal)
        if source:
            text = result.module_text(*parts)
            typer.echo(json.dumps({"path": name, "source": text}) if as_json else text)
            return 0
        if len(parts) == 3:
            text = result.symbol_text(name)
            typer.echo(json.dumps({"path": name, "value": text}) if as_json else text)
            return 0
        tasks = parts[:1] or [task.name for task in result.tasks()]
        module = parts[1] if len(parts) == 2 else ""
        all_of = [s for t in tasks for s in result.symbols(t, module=module, kind=kind)]
        if module and not all_of:
            hint = f"`rapidgen symbols {host} {parts[0]} --kind any` lists all data"
            raise typer.BadParameter(f"no data of kind {kind} in {name}: {hint}")
        for _ in _looks(every):
            read_values = {s.path: _value(result, s.path) for s in all_of} if values else None
            if as_json:
                indent = None if every else 2
                typer.echo(json.dumps(_symbol_entries(all_of, read_values), indent=indent))
            else:
                _show_symbols(all_of, read_values)
    return 0


def _symbol_entries(
    symbols: "Sequence[SymbolInfo]", values: "Mapping[str, str | None] | None"
) -> list[dict[str, object]]:
    """Return data as JSON, with values if there are any."""
    if values is None:
        return [asdict(one) for one in symbols]
    return [{**asdict(one), "value": values[one.path]} for one in symbols]


def _show_symbols(
    symbols: "Sequence[SymbolInfo]", values: "Mapping[str, str | None] | None"
) -> None:
    for one in symbols:
        dims = "{" + ",".join(map(str, one.dims)) + "}" if one.dims else ""
        text = f"  {values[one.path] or '?'}" if values is not None else ""
        typer.echo(f"{one.path}  {one.kind}  {one.type}{dims}{text}")


def _value(result: "Controller", path: str) -> str | None:
    """Return a datum as a RAPID literal; None if the controller does not give it."""
    from rapidgen.client.rws.errors import NotConfirmed, RwsError

    try:
        return result.symbol_text(path)
    except (NotConfirmed, RwsError):
        # One datum that is too large or of a type without values does not hide the others.
        return None


def backup(
    output: Annotated[
        Path, typer.Option("--output", "-o", help="New folder on this computer.", metavar="FOLDER")
    ],
    host: options.WebServices = "",
    keep: Annotated[
        bool, typer.Option("--keep", help="Also leave the backup on the controller.")
    ] = False,
    to: options.ToController = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Download a backup of a controller.

    The controller writes the backup. rapidgen downloads its files and deletes it from the
    controller. `rapidgen sim` reads the folder.
    """
    import shutil
    from datetime import datetime

    from rapidgen.cli.rws_session import controller

    (host,) = target_first(to, host)
    if output.exists():
        raise refusal("RG660", None, f"{output} exists", "use a new folder")
    with controller(host, user, secrets, fingerprint) as result:
        place = result.backup(f"rapidgen_{datetime.now():%Y%m%d_%H%M%S}")
        # An interrupted download leaves no folder that looks like a backup.
        part = output.with_name(f"{output.name}.part")
        part.mkdir(parents=True)
        try:
            count = _fetch(result, place, part)
            part.rename(output)
        finally:
            shutil.rmtree(part, ignore_errors=True)
        if not keep:
            result.delete_file(place)
    typer.echo(f"{output}: {count} files")
    return 0


def _fetch(result: "Controller", place: str, folder: Path) -> int:
    """Download the files below a place; return their number.

    Raises DiagnosticError RG653 for a name that leads out of the folder.
    """
    count = 0
    for entry in result.list_files(place):
        if Path(entry.name).name != entry.name or entry.name in ("", ".", ".."):
            raise refusal(
                "RG653", None, f"the controller lists a file with the invalid name {entry.name!r}"
            )
        if entry.is_folder:
            (folder / entry.name).mkdir()
            count += _fetch(result, f"{place}/{entry.name}", folder / entry.name)
        else:
            (folder / entry.name).write_bytes(result.read_file(f"{place}/{entry.name}"))
            count += 1
    return count
