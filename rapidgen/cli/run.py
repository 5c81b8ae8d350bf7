"""The command `run`: execute RAPID on the virtual clock."""

import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import is_quiet, letters
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error, refusal, render

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.collisions import CollisionWatch
    from rapidgen.controller.controller import VirtualController
    from rapidgen.runtime.errors import FatalError


_LONGEST = 1e9
"""Largest --max-time, simulated seconds: 31 years."""
_MOST_WARNINGS = 20
"""Warnings of the event log that are printed, the most frequent ones."""
_CALLERS = 10
"""Number of calls of an error's stack that are shown."""


def run(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help="Modules (.mod .sys .modx .sysx .pgf), folder, generated folder or ABB backup.",
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
        typer.Option("--cycle", help="Run main once or repeatedly."),
    ] = "once",
    max_time: Annotated[
        float, typer.Option("--max-time", metavar="SECONDS", help="Limit of simulated time.")
    ] = 3600.0,
    max_statements: Annotated[
        int, typer.Option("--max-statements", help="Limit of statements in all tasks.", metavar="N")
    ] = 1_000_000_000,
    max_memory: Annotated[
        int, typer.Option("--max-memory", metavar="MB", help="Limit of memory.")
    ] = 2048,
    seed: Annotated[
        int, typer.Option("--seed", help="Seed of all random decisions.", metavar="N")
    ] = 0,
    schedule: Annotated[
        Literal["round-robin", "random", "pers"],
        typer.Option("--schedule", help="Task switching; pers: at every PERS access."),
    ] = "round-robin",
    assume: Annotated[
        str,
        typer.Option(
            "--assume", metavar="SWITCH=VALUE,...", help="Assumptions about the controller."
        ),
    ] = "",
    answers: Annotated[
        Path | None,
        typer.Option(
            "--answers", help="Operator's answers: `rapidgen explain RG420`.", metavar="FILE.yaml"
        ),
    ] = None,
    trace: Annotated[
        bool, typer.Option("--trace", help="Print every statement on stderr.")
    ] = False,
    profile: Annotated[
        str,
        typer.Option(
            "--profile", metavar="[=FILE.json]", help="Time by line, on stderr or as JSON."
        ),
    ] = "",
    coverage: options.Coverage = None,
    plot: options.Plot = None,
    record: Annotated[
        Path | None,
        typer.Option("--record", help="Recording for `rapidgen view`.", metavar="NAME.mcap"),
    ] = None,
    cycle_report: Annotated[
        list[Path] | None,
        typer.Option(
            "--cycle-report",
            metavar="FILE.html|FILE.json",
            help="Time and limits of moves, lines and routines; repeatable.",
        ),
    ] = None,
    compare: Annotated[
        Path | None,
        typer.Option(
            "--compare",
            metavar="FILE.json",
            help="Earlier cycle report to compare with.",
        ),
    ] = None,
    collisions: Annotated[
        Literal["error", "warn", "off"] | None,
        typer.Option(
            "--collisions",
            help="Check the planned path in the cell; default: error if the cell file has "
            "`collision:`.",
            show_default=False,
        ),
    ] = None,
    backup: options.TargetBackup = None,
    check: options.LoadCheck = True,
) -> None:
    """Run RAPID on the virtual clock.

    Rejects programs that a controller would not load, and lists all their errors. Prints one line
    for each TPWrite. Ends when main of every task has returned and the robots have stopped. The
    exit code is 1 after an error in a task, at a deadlock and at a limit of time, statements or
    memory.
    """
    from rapidgen.cli.boot_options import assumptions, inference_report, load_boot_target
    from rapidgen.cli.run_outputs import Observed, Outputs, read_earlier, recording
    from rapidgen.controller.controller import VirtualController
    from rapidgen.machine.operator import read_answers

    _limits(max_time, max_statements)
    if compare is not None and not cycle_report:
        message = "--compare needs --cycle-report"
        raise refusal("RG901", None, message, "add --cycle-report FILE.html")
    requested = Outputs(
        trace,
        profile,
        tuple(coverage or ()),
        tuple(plot or ()),
        cycle=tuple(cycle_report or ()),
        compared=compare.name if compare is not None else "",
        earlier=read_earlier(compare) if compare is not None else (),
        record=record,
    )
    requested.check_files_writable()
    _no_configuration(files)
    result = load_boot_target(
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
            dialect=assumptions(assume),
            answers=read_answers(answers) if answers is not None else None,
            autostart=False,
        ) as controller,
    ):
        controller.operator.subscribe(_print)
        warnings = [d for d in controller.diagnostics if d.severity is not Severity.ERROR]
        sys.stderr.write(render(warnings))
        observed = Observed(controller, requested)
        watch = _watch(controller, result, collisions)
        with recording(controller, record, result):
            controller.start_program()
            wrong = _run(controller, max_time, max_statements, cell)
        if watch is not None:
            wrong += _collisions(watch)
        sys.stderr.write(render(_event_warnings(controller)))
        sys.stderr.write(inference_report(controller.guessed))
        observed.write()
        if observed.duration and not is_quiet():
            sys.stderr.write(f"simulated time: {observed.duration}\n")
    if wrong:
        raise DiagnosticError(wrong, exit_code=1)


def _print(_task: str, text: str) -> None:
    sys.stdout.write(letters(text).replace("\n", " ") + "\n")


def _limits(max_time: float, max_statements: int) -> None:
    """Reject invalid limits."""
    if not 0 < max_time <= _LONGEST or max_statements < 1:
        message = (
            f"--max-time must be above 0 and at most {_LONGEST:g} s, --max-statements at least 1"
        )
        raise refusal("RG901", None, message, "such as --max-time 60")


def _no_configuration(files: list[Path]) -> None:
    """Reject configurations, which only `sim` and `build` accept."""
    from rapidgen.config import shipped_names

    for file in files:
        if file.suffix in (".yaml", ".yml") or (str(file) in shipped_names() and not file.exists()):
            raise refusal(
                "RG901",
                None,
                f"{file} is a configuration, not RAPID",
                f"`rapidgen sim {shlex.quote(str(file))}` boots it; `run` takes the built folder",
            )


def _run(
    controller: "VirtualController", max_time: float, max_statements: int, cell: str
) -> list[Diagnostic]:
    """Run to the end; return the errors."""
    from rapidgen.controller.inference.restarts import run_past_stops

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
                "deadlock: every task waits and no event is scheduled",
                "let another task, or a device in the file of `--cell`, fulfil a condition",
                notes=where,
            )
        )
    elif finished != "finished":
        limit = f"{max_time:g} s" if finished == "time" else f"{max_statements} statements"
        groups = controller.motion.groups.values()
        moving = (f"{g.name}: the robot is moving" for g in groups if not g.is_standing)
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


def _watch(
    controller: "VirtualController",
    booted: "Bootable",
    chosen: Literal["error", "warn", "off"] | None,
) -> "CollisionWatch | None":
    """Return what records the robots for a collision check; None without a check (RG901)."""
    setup = booted.collisions(chosen)
    if setup is None:
        return None
    from rapidgen.controller.collisions import CollisionWatch

    watch = CollisionWatch(controller, setup)
    sys.stderr.write(render(watch.world.diagnostics))
    return watch


def _collisions(watch: "CollisionWatch") -> list[Diagnostic]:
    """Print warnings and what was not checked; return the errors."""
    from rapidgen.cli.collisions import collision_summary

    report = watch.report()
    sys.stderr.write(render(d for d in report.diagnostics if d.severity is not Severity.ERROR))
    sys.stderr.write(collision_summary(report))
    return [d for d in report.diagnostics if d.severity is Severity.ERROR]


def _event_warnings(controller: "VirtualController") -> list[Diagnostic]:
    """Return the warnings of the event log, each place once; handled errors are left out."""
    from collections import Counter

    from rapidgen.machine.event_log import EventType
    from rapidgen.machine.event_table import ERROR_CODES, RAPID_ERROR

    handled = {RAPID_ERROR, *ERROR_CODES.values()}
    failed = {(e.code, e.task) for e in controller.log if e.type is EventType.ERROR}
    counts = Counter(
        (event.code, event.title, event.texts, event.span)
        for event in controller.log
        if event.type is EventType.WARNING
        and event.code not in handled
        and (event.code, event.task) not in failed
    )
    return [
        error(
            "RG409",
            span,
            f"event {code}: {title}" + (f" ({count} times)" if count > 1 else ""),
            f"`rapidgen explain {code}` names causes and remedies",
            notes=tuple(text for text in texts if text),
            severity=Severity.WARNING,
        )
        for (code, title, texts, span), count in counts.most_common(_MOST_WARNINGS)
    ]


def _help(fault: "FatalError", cell: str) -> str:
    """Help for undeclared names, unanswered dialogs and unreachable targets; else empty."""
    from rapidgen.machine.event_table import OUT_OF_REACH
    from rapidgen.runtime.motion_interface import NOT_COMPATIBLE

    if "ERR_REFUNKDAT" in fault.arguments:
        load = "or load the module that declares it"
        if cell:
            return f"add it to the cell description (`rapidgen schema --cell`), {load}"
        return f"use `--cell infer` to infer signals, tools and work objects, {load}"
    if {"ERR_REFUNKPRC", "ERR_REFUNKFUN"} & set(fault.arguments):
        return "load the module that declares it"
    if "ERR_TP_NO_CLIENT" in fault.arguments:
        return (
            "`--answers FILE` answers dialogs (`rapidgen explain RG420`), `--cell infer` tries "
            "their choices"
        )
    if fault.event == OUT_OF_REACH:
        return (
            "check the target, its tool and its work object; select the robot of the program with "
            "`--robot`"
        )
    if fault.event == NOT_COMPATIBLE:
        return (
            "set other initial joint values with `--start`, program the configuration that is "
            "reached, or use ConfL \\Off and ConfJ \\Off"
        )
    return ""


def _fault(task: str, fault: "FatalError", cell: str) -> Diagnostic:
    place = fault.stack[-1] if fault.stack else None
    notes = [f"event {fault.event} in task {task}"]
    notes += [t for t in fault.arguments if t]
    callers = [f"called from {p}" for p in reversed(fault.stack[:-1])]
    notes += callers[:_CALLERS]
    if len(callers) > _CALLERS:
        notes.append(f"and {len(callers) - _CALLERS} earlier calls")
    if place is not None and place.origin is not None:
        notes.append(f"generated from {place.origin[0]}:{place.origin[1]}")
    return error(
        "RG407",
        fault.span or (place.span if place is not None else None),
        fault.title,
        _help(fault, cell),
        notes=tuple(notes),
    )


MB = 2**20


@contextmanager
def at_most(megabytes: int) -> Iterator[None]:
    """Limit the memory of this process while the block runs.

    Raises DiagnosticError RG406 if it is not enough. The limit is RLIMIT_DATA of the operating
    system; Windows has none.
    """
    if megabytes < 1:
        raise refusal(
            "RG901", None, f"--max-memory {megabytes} is not a size", "such as --max-memory 1024"
        )
    from importlib.util import find_spec

    if find_spec("resource") is None:
        yield
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    requested = megabytes * MB
    if hard != resource.RLIM_INFINITY:
        requested = min(requested, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (requested, hard))
    full = False
    try:
        yield
    except MemoryError:
        full = True
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
    if full:
        # Raised here, after the memory has been freed.
        raise DiagnosticError(
            error(
                "RG406",
                None,
                f"the program needs more than {megabytes} MB of memory",
                "raise --max-memory, or look for growing arrays and recursion",
            ),
            exit_code=1,
        )
