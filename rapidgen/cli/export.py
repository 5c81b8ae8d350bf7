"""The command `export`: RAPID modules from programs, plans and toolpaths."""

import math
import re
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import is_quiet, use_colour
from rapidgen.diagnostics import DiagnosticError, Severity, refusal, render

if TYPE_CHECKING:
    from rapidgen.axes.frames import Pose, Vector
    from rapidgen.client.core.group import Group
    from rapidgen.export.sources import JointPath, SourceOptions, Toolpath
    from rapidgen.export.sources.toolpath import WordAction
    from rapidgen.export.writer import ExportedModule, WriterOptions

_GCODE = (".nc", ".ngc", ".gcode", ".tap", ".cnc", ".g")
_TABLES = (".csv", ".txt", ".json", ".npy", ".npz")
_SHOWN = 20
"""Warnings that are worth reading."""
_LARGEST = 1_000_000
"""Bytes of a prologue, an epilogue or a file of routines."""


def export(
    source: Annotated[
        Path,
        typer.Argument(help="CSV, JSON, numpy, ROS YAML or G-code.", metavar="FILE"),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Module to write.", metavar="NAME.mod")
    ],
    config: Annotated[
        str, typer.Option(help="Configuration file or shipped name.", metavar="CONFIG")
    ],
    group: options.Group = "",
    routine: Annotated[str, typer.Option(help="Name of the routine.", metavar="NAME")] = "main",
    tool: Annotated[str, typer.Option(help="Tool of the configuration.", metavar="NAME")] = "",
    work_object: Annotated[
        str, typer.Option(help="Work object of the configuration.", metavar="NAME")
    ] = "",
    start: Annotated[
        str, typer.Option(help="Joint values before the first move: deg, mm.", metavar="J1,J2,...")
    ] = "",
    units: Annotated[
        Literal["mm", "m", "in"] | None, typer.Option(help="Unit of positions in the file.")
    ] = None,
    angles: Annotated[
        Literal["rad", "deg"] | None, typer.Option(help="Unit of joint angles in the file.")
    ] = None,
    columns: Annotated[
        str, typer.Option(help="Columns of a table without a header.", metavar="NAME,...")
    ] = "",
    origin: Annotated[
        str,
        typer.Option(
            help="Frame of the file in the work object: mm, unit quaternion.",
            metavar="X,Y,Z[,Q1..Q4]",
        ),
    ] = "",
    tool_axis: Annotated[
        str, typer.Option(help="Direction of the tool's z axis in the file.", metavar="X,Y,Z")
    ] = "",
    turn: Annotated[
        float | None, typer.Option(help="Rotation about the tool's z axis.", metavar="DEGREES")
    ] = None,
    speed: Annotated[
        float, typer.Option(help="Speed where the file has none.", metavar="MM/S")
    ] = 100.0,
    rapid: Annotated[float, typer.Option(help="Speed of G0.", metavar="MM/S")] = 250.0,
    word: Annotated[
        list[str] | None,
        typer.Option(
            help="G-code word as signal:NAME[:VALUE], call:NAME or ignore; repeatable.",
            metavar="WORD=ACTION",
        ),
    ] = None,
    offset: Annotated[
        list[str] | None,
        typer.Option(help="Work offset, in mm; repeatable.", metavar="G54=X,Y,Z"),
    ] = None,
    zone: Annotated[
        str, typer.Option(help="Zone between moves: a RAPID name, or mm.", metavar="ZONE")
    ] = "z1",
    targets: Annotated[
        Literal["inline", "named", "arrays"], typer.Option(help="Place of the targets.")
    ] = "inline",
    allow_singularities: Annotated[
        bool, typer.Option("--allow-singularities", help="SingArea \\Wrist: the tool may turn.")
    ] = False,
    allow_configurations: Annotated[
        bool, typer.Option("--allow-configurations", help="ConfL \\Off: any arm configuration.")
    ] = False,
    prologue: Annotated[
        Path | None, typer.Option(help="RAPID statements before the moves.", metavar="FILE")
    ] = None,
    epilogue: Annotated[
        Path | None, typer.Option(help="RAPID statements after the moves.", metavar="FILE")
    ] = None,
    routines: Annotated[
        Path | None, typer.Option(help="RAPID declarations for the module.", metavar="FILE")
    ] = None,
    templates: Annotated[
        Path | None, typer.Option(help="Folder with your module.mod.j2.", metavar="FOLDER")
    ] = None,
    backup: Annotated[
        Path | None, typer.Option(help="Backup of the controller: its names.", metavar="FOLDER")
    ] = None,
    parts: Annotated[
        bool, typer.Option("--parts", help="Split into parts that load while the robot moves.")
    ] = False,
    load_times: Annotated[
        str,
        typer.Option(help="Your controller's times: ms/kB to load, to link.", metavar="LOAD,LINK"),
    ] = "",
    run: Annotated[
        bool, typer.Option("--run/--no-run", help="Run the module on the virtual controller first.")
    ] = True,
) -> None:
    """Write a RAPID module that runs without rapidgen.

    The module is checked for RobotWare 5, 6 and 7 and executed on the virtual controller. It is
    written only if all this succeeds.

    rapidgen export plan.csv --config cell.yaml -o plan.mod
    """
    from rapidgen._atomic_write import check_writable, write_whole
    from rapidgen.client.core.group import Group
    from rapidgen.client.rapid_export import export_program, export_trajectory, robot_of
    from rapidgen.client.toolpath_program import program_of, trajectory_of
    from rapidgen.export.sources import JointPath, SourceOptions
    from rapidgen.export.sources.toolpath import LENGTHS
    from rapidgen.export.writer import WriterOptions

    module = _module_name(output)
    check_writable(output)
    choices = WriterOptions(
        targets,
        _text(prologue),
        _text(epilogue),
        _text(routines),
        templates,
        _taken(backup, module),
    )
    axis = numbers("--tool-axis", tool_axis, 3)
    given = SourceOptions(
        LENGTHS[units] if units else None,
        {"rad": 1.0, "deg": math.pi / 180}[angles] if angles else None,
        _origin(origin),
        (axis[0], axis[1], axis[2]) if axis else None,
        math.radians(turn) if turn is not None else None,
        tuple(name.strip() for name in columns.split(",")) if columns else (),
        _positive("--speed", speed) / 1000,
        _positive("--rapid", rapid) / 1000,
        dict(_word(text) for text in word or ()),
        dict(_offset(text) for text in offset or ()),
    )
    robot, chosen = robot_of(config, group)
    complete = Group.of(robot, chosen)
    header = [f"Source: {source.name}."]
    read = _read(source, given)
    if isinstance(read, JointPath):
        result = export_trajectory(
            trajectory_of(read),
            robot,
            chosen,
            module=module,
            routine=routine,
            zone=_zone(zone),
            options=choices,
            header=header,
        )
    else:
        begin = _start(start, complete)
        program, spans = program_of(
            read,
            complete,
            zone=_zone(zone),
            tool=tool,
            work_object=work_object,
            allow=(allow_singularities, allow_configurations),
        )
        if read.ignored:
            counts = Counter(read.ignored)
            listed = ", ".join(f"{name} ({count})" for name, count in sorted(counts.items()))
            header.append(f"Ignored words: {listed}.")
            sys.stderr.write(f"ignored words: {listed}\n")
        result = export_program(
            program,
            robot,
            chosen,
            module=module,
            routine=routine,
            start=begin,
            options=choices,
            spans=spans,
            header=header,
        )
    shown = [note for note in result.notes if note.severity is not Severity.INFO]
    sys.stderr.write(render(shown[:_SHOWN], colour=use_colour()))
    if len(shown) > _SHOWN:
        sys.stderr.write(f"{len(shown) - _SHOWN} more warnings\n")
    texts = _parts(result, choices, load_times, split_up=parts)
    if run:
        _run(result)
    # The main module comes last: without it nothing loads the parts.
    for name, content in reversed(texts.items()):
        path = output if name == f"{module}.mod" else output.with_name(name)
        write_whole(path, content.encode("latin-1"))
    if not is_quiet():
        sys.stderr.write(f"{output}: {len(result.lines)} instructions\n")


def _parts(
    result: "ExportedModule", options: "WriterOptions", load_times: str, *, split_up: bool
) -> dict[str, str]:
    """Return the texts of all modules, the main one first; report moves per second and parts."""
    from rapidgen.export.parts import LIMITS, LoadTimes, split, unsplit

    times = LoadTimes()
    if load_times:
        load, link = numbers("--load-times", load_times, 2)
        if min(load, link) <= 0:
            raise refusal("RG901", None, f"--load-times {load_times}: above 0", "ms/kB")
        times = LoadTimes(load / 1000, link / 1000, is_estimated=False)
    limits = LIMITS.get(result.config.robotware[0], LIMITS[5])
    described = result.description
    found = split(described, limits, times) if split_up else unsplit(described, times)
    sys.stderr.write(render(found.findings(limits), colour=use_colour()))
    if split_up and not is_quiet():
        sys.stderr.write("".join(f"{line}\n" for line in found.report()))
    if len(found.parts) == 1:
        return {f"{described.module}.mod": result.text}
    return found.files(options)


def _read(source: Path, given: "SourceOptions") -> "Toolpath | JointPath":
    """Read a source by its suffix. Raises DiagnosticError."""
    from rapidgen.export.sources import read_gcode, read_ros, read_table

    suffix = source.suffix.lower()
    if suffix in _GCODE:
        return read_gcode(source, given)
    if suffix in (".yaml", ".yml"):
        return read_ros(source)
    if suffix in _TABLES:
        return read_table(source, given)
    known = ", ".join((*_TABLES, ".yaml", *_GCODE))
    raise refusal("RG901", None, f"{source}: unknown kind of file", f"rename it: {known}")


def _taken(backup: Path | None, module: str) -> frozenset[str]:
    """Return lower-case names of a backup that a new module may not declare again."""
    if backup is None:
        return frozenset()
    from rapidgen.rapid import Dialect
    from rapidgen.rapid.binding import TaskScope
    from rapidgen.rapid.module_trees import tree_of
    from rapidgen.system import read_backup

    system = read_backup(backup)
    names: set[str] = {signal.name.lower() for signal in system.signals}
    for task in system.tasks:
        scope = TaskScope()
        for file in task.modules:
            if file.name.lower() == module.lower():
                message = f"the controller has a module '{file.name}' in {task.name}"
                raise refusal("RG750", None, message, "choose another name with -o")
            names.add(file.name.lower())
            tree = scope.add(tree_of(file, Dialect(system.robotware))).tree
            names |= {
                declaration.name.lower()
                for declaration in tree.declarations
                if hasattr(declaration, "name") and getattr(declaration, "scope", "") != "LOCAL"
            }
    return frozenset(names - {"main"})


def _origin(text: str) -> "Pose":
    from rapidgen.axes.frames import UNIT
    from rapidgen.export.sources.toolpath import unit_quaternion

    if not text:
        return (0.0, 0.0, 0.0), UNIT
    values = numbers("--origin", text, 3, 7)
    x, y, z = (value / 1000 for value in values[:3])
    try:
        turned = unit_quaternion(values[3:]) if len(values) == 7 else UNIT
    except ValueError as fault:
        raise refusal("RG901", None, f"--origin: {fault}", "of length 1") from fault
    return (x, y, z), turned


def _word(text: str) -> "tuple[str, WordAction]":
    from rapidgen.export.sources.toolpath import WordAction

    name, _, action = text.partition("=")
    kind, _, rest = action.partition(":")
    target, _, value = rest.partition(":")
    try:
        number = float(value) if value else None
    except ValueError:
        kind = ""
    if not re.fullmatch(r"[A-Za-z](\d+(\.\d+)?)?", name) or (
        kind not in ("signal", "call", "ignore") or bool(target) == (kind == "ignore")
    ):
        raise refusal(
            "RG901",
            None,
            f"--word {text} is not WORD=ACTION",
            "M3=signal:spindle:1, S=signal:rate, M6=call:change_tool or T=ignore",
        )
    letter, digits = name[0].upper(), name[1:]
    word = f"{letter}{float(digits):g}" if digits else letter
    if kind == "signal":
        return word, WordAction("signal", target, number)
    return word, WordAction("call" if kind == "call" else "ignore", target)


def _offset(text: str) -> "tuple[str, Vector]":
    name, _, values = text.partition("=")
    if name.upper() not in {f"G{n}" for n in range(54, 60)}:
        raise refusal("RG901", None, f"--offset {text}: no work offset", "such as G54=100,0,20")
    x, y, z = (value / 1000 for value in numbers("--offset", values, 3))
    return name.upper(), (x, y, z)


def _start(text: str, group: "Group") -> list[float] | None:
    """Return URDF joints of --start, which has deg and mm in the robot's order."""
    if not text:
        return None
    values = numbers("--start", text, len(group.joints))
    return [
        math.radians(value) if joint.kind == "revolute" else value / 1000
        for value, joint in zip(values, group.joints, strict=True)
    ]


def numbers(option: str, text: str, *counts: int) -> list[float]:
    """Return the numbers of an option. Raises DiagnosticError RG901 for others."""
    if not text:
        return []
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) not in counts or not all(map(math.isfinite, values)):
        needed = " or ".join(map(str, counts))
        raise refusal(
            "RG901", None, f"{option} {text}: not {needed} numbers", "separate them with commas"
        )
    return values


def _positive(option: str, value: float) -> float:
    if not 0 < value < 1e5:
        raise refusal("RG901", None, f"{option} {value:g} is not a speed", "mm/s, above 0")
    return value


def _run(result: "ExportedModule") -> None:
    """Execute a module; report its duration and warnings. Raises DiagnosticError for errors."""
    from rapidgen.controller.module_trial import run_module

    trial, errors = run_module(
        result.module,
        result.group,
        start=result.start_values,
        robotware=result.config.robotware,
        lines=result.lines,
        spans=result.spans,
    )
    sys.stderr.write(render(list(trial.warnings), colour=use_colour()))
    if errors:
        raise DiagnosticError(errors, exit_code=1)
    if not is_quiet():
        inferred = f"; inferred: {', '.join(trial.inferred)}" if trial.inferred else ""
        sys.stderr.write(f"virtual controller: {trial.seconds:.3f} s{inferred}\n")


def _module_name(output: Path) -> str:
    if output.suffix.lower() not in (".mod", ".modx"):
        raise refusal(
            "RG901", None, f"{output} is not a module's file", "such as -o NAME.mod (or .modx)"
        )
    return output.stem


def _zone(text: str) -> str | float:
    """Return a zone as `Program` takes it: a name, or m."""
    try:
        return float(text) / 1000
    except ValueError:
        return text


def _text(path: Path | None) -> str:
    from rapidgen._reading import read_foreign

    if path is None:
        return ""
    try:
        return read_foreign(path, _LARGEST).decode("latin-1")
    except OSError as fault:
        reason = (fault.strerror or str(fault)).lower()
        raise refusal("RG901", None, f"cannot read {path}: {reason}", "name a file") from fault


def execute(
    module: Annotated[Path, typer.Argument(help="Module to execute.", metavar="NAME.mod")],
    to: Annotated[
        str,
        typer.Option(
            help="Controller: HOST[:PORT], rws://HOST or rwss://HOST; sim: the simulator here.",
            metavar="TARGET",
        ),
    ],
    task: Annotated[
        str, typer.Option(help="Motion task, if there are several.", metavar="NAME")
    ] = "",
    routine: Annotated[
        str, typer.Option(help="Procedure; default: main, or the only one.", metavar="NAME")
    ] = "",
    replace_driver: Annotated[
        bool, typer.Option("--replace-driver", help="Stop the driver, if it is active.")
    ] = False,
    speed: Annotated[
        int, typer.Option(min=1, max=100, help="Speed ratio.", metavar="PERCENT")
    ] = 10,
    yes: options.YesOnLoopback = False,
    move_real_robot: options.RealRobot = "",
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
) -> int:
    """Execute a module on a controller (THE ROBOT MOVES).

    Loads the module, runs its routine once at a tenth of the speed and follows it. Ctrl-C stops
    the robot. Afterwards modules, task selection, speed and program pointer are as before.

    rapidgen execute part.mod --to 192.168.125.1 --move-real-robot 192.168.125.1
    """
    from rapidgen._reading import read_foreign
    from rapidgen.cli.deployment import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller
    from rapidgen.client.address import Address
    from rapidgen.client.permission import need_confirmation
    from rapidgen.client.rws.address import parse_address
    from rapidgen.client.sim_address import SIMULATOR, find_web_services
    from rapidgen.deploy.online.module_execution import execute_module, make_execution_plan

    data = read_foreign(module, 256 * _LARGEST)
    text = data.decode("latin-1")
    where, asks = to, False
    if to == SIMULATOR:
        simulator = find_web_services()
        where = simulator.web_services
        fingerprint = fingerprint or simulator.fingerprint
    else:
        at = parse_address(to)
        asks = need_confirmation(Address(at.host, 0, 0), yes=yes, real_robot=move_real_robot)
    with controller(where, user, secrets, fingerprint) as services:
        plan = make_execution_plan(
            services,
            text,
            str(module),
            task=task,
            routine=routine,
            replace_driver=replace_driver,
        )
        typer.echo(f"{services.where}: mode {plan.mode}, state {plan.state}", err=True)
        ratio = speed if plan.mode == "AUTO" else plan.speed
        typer.echo(f"{plan.task}: {plan.module}/{plan.routine} at {ratio} % of the speed", err=True)
        for label, names in (
            ("stopped", plan.running),
            ("unloaded meanwhile", plan.displaced),
            ("left out meanwhile", plan.others),
        ):
            if names:
                typer.echo(f"{label}: {', '.join(names)}", err=True)
        confirm_plan(f"THE ROBOT MOVES: execute {plan.module} at {to}?", yes=not asks)
        ask_pendant(services, "exec", plan.mode)
        events = execute_module(
            services, plan, data, percent=speed, say=lambda line: typer.echo(line, err=True)
        )
        if plan.running:
            typer.echo("the driver's tasks stay stopped until the controller restarts", err=True)
        typer.echo(f"{to}: {plan.module} executed, {len(events)} events")
    return 0
