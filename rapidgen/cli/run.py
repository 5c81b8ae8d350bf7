"""`rapidgen run`: execute RAPID on the virtual clock."""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import letters
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error, refusal, render

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController
    from rapidgen.rapid.switches import Switches
    from rapidgen.runtime.errors import FatalError


_LONGEST = 1e9
"""Simulated seconds; 31 years."""
_CALLERS = 10
"""Calls of a fault's stack that are shown."""


def run(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            help="Modules (.mod .sys .modx .sysx .pgf), a folder of them, a generated folder, "
            "or an ABB backup.",
        ),
    ] = [],  # noqa: B006 - typer wants a list here and does not share it
    task: options.Tasks = None,
    robot: options.RobotModel = "",
    robotware: options.Release = "",
    entry: options.Entry = "",
    cell: options.Cell = "",
    start: options.Start = "",
    cycle: Annotated[
        Literal["once", "forever"],
        typer.Option("--cycle", help="Run main once or again and again."),
    ] = "once",
    max_time: Annotated[
        float, typer.Option("--max-time", metavar="S", help="Simulated seconds at most.")
    ] = 3600.0,
    max_statements: Annotated[
        int, typer.Option("--max-statements", help="Statements at most, in all tasks.")
    ] = 1_000_000_000,
    max_memory: Annotated[
        int, typer.Option("--max-memory", metavar="MB", help="Memory at most.")
    ] = 2048,
    seed: Annotated[int, typer.Option("--seed", help="Seed of everything that is drawn.")] = 0,
    schedule: Annotated[
        Literal["round-robin", "random", "pers"],
        typer.Option("--schedule", help="Switching between tasks; pers: at every PERS access."),
    ] = "round-robin",
    assume: Annotated[
        str,
        typer.Option("--assume", metavar="SWITCH=VALUE,...", help="See virtual-controller.md."),
    ] = "",
    answers: Annotated[
        Path | None, typer.Option("--answers", help="YAML with the operator's answers.")
    ] = None,
    trace: Annotated[bool, typer.Option("--trace", help="Every statement, on stderr.")] = False,
    profile: Annotated[
        str,
        typer.Option("--profile", metavar="[=F.json]", help="Time by line, on stderr or as JSON."),
    ] = "",
    coverage: options.Coverage = None,
    plot: options.Plot = None,
    backup: options.Backup = None,
    check: options.LoadCheck = True,
) -> None:
    """Run RAPID on the virtual clock.

    What a controller would not load is refused: all its errors are told, nothing runs. Prints one
    line for each TPWrite. Ends when main of every task has returned and the robots stand; exit
    code 1 when a task stopped with an error, on a deadlock, and at the limits of time, statements
    and memory.
    """
    from rapidgen.cli.boot_options import chosen, inference_report
    from rapidgen.cli.memory_limit import at_most
    from rapidgen.cli.run_outputs import Observed, Outputs
    from rapidgen.controller.controller import VirtualController
    from rapidgen.machine.operator import read_answers

    _limits(max_time, max_statements)
    requested = Outputs(trace, profile, tuple(coverage or ()), tuple(plot or ()))
    requested.refuse_unwritable()
    _no_configuration(files)
    result = chosen(
        list(map(str, files)),
        tasks=task,
        robot=robot,
        robotware=robotware,
        entry=entry,
        cell=cell,
        start=start,
        backup=backup,
        check=check,
    )
    with (
        at_most(max_memory),
        VirtualController.boot(
            result,
            seed=seed,
            cycle=cycle,
            schedule="round-robin" if schedule == "round-robin" else "random",
            switch_at_pers=schedule == "pers",
            tracing=requested.tracing,
            dialect=_assumptions(assume),
            answers=read_answers(answers) if answers is not None else None,
            autostart=False,
        ) as controller,
    ):
        controller.operator.subscribe(_print)
        warnings = [d for d in controller.diagnostics if d.severity is not Severity.ERROR]
        sys.stderr.write(render(warnings))
        observed = Observed(controller, requested)
        controller.start_program()
        wrong = _run(controller, max_time, max_statements, cell)
        sys.stderr.write(inference_report(controller.guessed))
        observed.write()
    if wrong:
        raise DiagnosticError(wrong, exit_code=1)


def _print(_task: str, text: str) -> None:
    sys.stdout.write(letters(text).replace("\n", " ") + "\n")


def _limits(max_time: float, max_statements: int) -> None:
    """Refuse limits that are none."""
    if not 0 < max_time <= _LONGEST or max_statements < 1:
        message = f"--max-time is above 0 and at most {_LONGEST:g} s, --max-statements at least 1"
        raise refusal("RG901", None, message, "such as --max-time 60")


def _no_configuration(files: list[Path]) -> None:
    """Refuse what `sim` and `build` take and `run` does not."""
    from rapidgen.config import shipped_names

    for file in files:
        if file.suffix in (".yaml", ".yml") or (str(file) in shipped_names() and not file.exists()):
            raise refusal(
                "RG901",
                None,
                f"{file} is a configuration, and run takes RAPID",
                f"`rapidgen sim {shlex.quote(str(file))}` boots it; or build it and run the folder",
            )


def _assumptions(text: str) -> "Switches":
    from dataclasses import fields

    from rapidgen.rapid.switches import Switches, parse_switches

    try:
        return parse_switches(text)
    except ValueError as fault:
        names = ", ".join(switch.name for switch in fields(Switches))
        raise refusal(
            "RG901", None, f"--assume: {fault}", f"SWITCH=VALUE; there are {names}"
        ) from fault


def _run(
    controller: "VirtualController", max_time: float, max_statements: int, cell: str
) -> list[Diagnostic]:
    """Run to the end; what went wrong."""
    from rapidgen.controller.runner import run_past_stops

    finished = run_past_stops(controller, max_time=max_time, max_statements=max_statements)
    findings = [
        _fault(task.name, task.fault, cell)
        for task in controller.tasks.values()
        if task.fault is not None
    ]
    where = tuple(controller.where())
    if finished == "deadlock":
        findings.append(
            error(
                "RG405",
                None,
                "deadlock: every task waits and nothing is ahead",
                "let another task, or a device in the file of `--cell`, do what is waited for",
                notes=where,
            )
        )
    elif finished != "finished":
        limit = f"{max_time:g} s" if finished == "time" else f"{max_statements} statements"
        groups = controller.motion.groups.values()
        moving = (f"{g.name}: its robot moves" for g in groups if not g.is_standing)
        findings.append(
            error(
                "RG406",
                None,
                f"still running after {limit}",
                "raise --max-time or --max-statements, or end the program",
                notes=(*where, *moving),
            )
        )
    return findings


def _mend(fault: "FatalError", cell: str) -> str:
    """What to do about a name that nothing declares, a dialog that nobody answers and a place that
    the robot, or this posture, does not reach; of other errors the program knows more."""
    from rapidgen.runtime.motion_interface import NOT_COMPATIBLE

    if "ERR_REFUNKDAT" in fault.arguments:
        declared = "or load the module that declares it"
        if cell:
            return f"say it in the cell's description (`rapidgen schema --cell`), {declared}"
        return (
            f"`--cell infer` makes signals, tools and work objects that programs name, {declared}"
        )
    if {"ERR_REFUNKPRC", "ERR_REFUNKFUN"} & set(fault.arguments):
        return "load the module that declares it"
    if "ERR_TP_NO_CLIENT" in fault.arguments:
        return (
            "`--answers FILE` answers dialogs (`rapidgen explain RG420`), `--cell infer` tries "
            "their choices"
        )
    if {"ERR_OUTSIDE_REACH", "ERR_ROBLIMIT"} & set(fault.arguments):
        return (
            "look at the target, its tool and its work object; `--robot` takes the robot that "
            "the program was written for"
        )
    if fault.event == NOT_COMPATIBLE:
        return (
            "`--start` lets the robot begin elsewhere; a program asks for the configuration that "
            "is reached, or for none with ConfL \\Off and ConfJ \\Off"
        )
    return ""


def _fault(task: str, fault: "FatalError", cell: str) -> Diagnostic:
    place = fault.stack[-1] if fault.stack else None
    notes = [f"event {fault.event} in task {task}"]
    notes += [t for t in fault.arguments if t]
    callers = [f"called from {p}" for p in reversed(fault.stack[:-1])]
    notes += callers[:_CALLERS]
    if len(callers) > _CALLERS:
        notes.append(f"and {len(callers) - _CALLERS} calls before that")
    if place is not None and place.origin is not None:
        notes.append(f"generated from {place.origin[0]}:{place.origin[1]}")
    return error(
        "RG407",
        fault.span or (place.span if place is not None else None),
        fault.title,
        _mend(fault, cell),
        notes=tuple(notes),
    )
