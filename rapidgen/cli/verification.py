"""The commands `test` and `probe`: assumptions about controllers."""

from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import Bars
from rapidgen.diagnostics import DiagnosticError, error, refusal, suggest

if TYPE_CHECKING:
    from collections.abc import Callable

    from rapidgen.config.layers import Overrides
    from rapidgen.config.model import RobotConfig
    from rapidgen.controller.controller import VirtualController
    from rapidgen.verification.model import SuiteResult
    from rapidgen.verification.suite_runner import DriverUnderTest
    from rapidgen.verification.worker_pool import WorkerPool


def test(
    config: options.Config,
    seeds: Annotated[
        int, typer.Option(help="Number of random schedules to explore.", min=0, metavar="N")
    ] = 100,
    programs: Annotated[
        int,
        typer.Option(
            help="Number of random motion programs, compared with RAPID.", min=0, metavar="N"
        ),
    ] = 0,
    jobs: Annotated[
        int | None,
        typer.Option(help="Number of processes; default: one per core.", min=1, metavar="N"),
    ] = None,
    case: Annotated[
        list[str] | None, typer.Option(help="Test case to run; repeatable.", metavar="NAME")
    ] = None,
    list_cases: Annotated[
        bool, typer.Option("--list", help="Only list the test cases by group.")
    ] = False,
    durations: Annotated[
        int, typer.Option(help="Number of slowest cases to list.", min=0, metavar="N")
    ] = 0,
    quick: Annotated[
        bool, typer.Option("--quick", help="Test only the default of each assumption.")
    ] = False,
    strength: Annotated[
        int,
        typer.Option(
            help="Number of assumptions that are combined in all ways.", min=1, max=3, metavar="N"
        ),
    ] = 2,
    assume: Annotated[
        list[str] | None,
        typer.Option(help="Setting to test; repeatable.", metavar="SWITCH=VALUE,..."),
    ] = None,
    replay: Annotated[
        str | None,
        typer.Option(
            help="Schedule or program to repeat exactly; its log goes to stdout.", metavar="NAME"
        ),
    ] = None,
    trace: Annotated[
        Path | None,
        typer.Option(help="With --replay: file for every executed statement.", metavar="FILE"),
    ] = None,
    record: Annotated[
        Path | None,
        typer.Option(help="With --replay: recording for `rapidgen view`.", metavar="FILE.mcap"),
    ] = None,
    uncovered: Annotated[
        bool, typer.Option("--uncovered", help="List the RAPID lines that no case reaches.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="JSON object on stdout.")] = False,
    junit: Annotated[Path | None, typer.Option(help="JUnit XML report.", metavar="FILE")] = None,
    html: Annotated[
        Path | None, typer.Option(help="HTML report with plots.", metavar="FILE")
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(help="Dask scheduler whose workers run the tests.", metavar="ADDRESS"),
    ] = None,
    results: Annotated[
        Path | None,
        typer.Option(help="File to which each result is written at once.", metavar="FILE"),
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue an interrupted run from --results FILE.")
    ] = False,
    budget: Annotated[
        str | None,
        typer.Option(
            help="Time after which no test is started: 90s, 30min, 2h.", metavar="DURATION"
        ),
    ] = None,
    stop_on_failure: Annotated[
        bool, typer.Option("--stop-on-failure", help="Stop at the first failure.")
    ] = False,
    overrides: options.Overrides = None,
    backup: Annotated[
        Path | None,
        typer.Option(
            help="Backup of the controller for which the driver is built.",
            metavar="FOLDER",
        ),
    ] = None,
) -> int:
    """Test the generated driver on the virtual controller.

    Runs test cases, stops and faults in many schedules. Assumptions about real controllers are
    also inverted, any two of them together. The exit code is 1 if a test fails.
    """
    import json

    from rapidgen.config import load_config
    from rapidgen.verification.campaign import Limits
    from rapidgen.verification.report import as_json as report_as_json
    from rapidgen.verification.report import write_html, write_junit
    from rapidgen.verification.settings import assumed
    from rapidgen.verification.suite_runner import run_suite
    from rapidgen.verification.worker_pool import WorkersLost

    model = load_config(config, overrides=overrides or ())
    if backup is not None:
        model = _fitted(model, backup)
    if list_cases:
        return _list(as_json)
    if replay is not None:
        begin = _recorder(model, Path(config), overrides or (), record) if record else None
        return _replay(model, replay, trace, begin)
    _check_names(case or [])
    assuming = [text for given in assume or () for text in given.split(",")]
    assumed(assuming)
    limits = Limits(_seconds(budget), stop_on_failure)
    if resume and results is None:
        raise _no_results_to_resume()
    for path in (junit, html, results):
        _check_writable(path)
    try:
        with Bars() as progress:
            report = run_suite(
                model,
                seeds=seeds,
                programs=programs,
                jobs=jobs,
                hire=None if cluster is None else _of_cluster(cluster),
                only=case or (),
                strength=0 if quick else strength,
                assuming=assuming,
                progress=progress,
                limits=limits,
                results=results,
                resume=resume,
            )
    except WorkersLost as lost:
        help = "use fewer --jobs; save results with --results FILE, and continue with --resume"
        raise refusal("RG809", None, str(lost), help) from lost
    if case and not report.tried and not report.broken_off and not report.left:
        raise _not_applicable(report)
    if junit is not None:
        write_junit(report, junit)
    if html is not None:
        write_html(report, html)
    if as_json:
        typer.echo(json.dumps(report_as_json(report), indent=1))
    else:
        _show(report, uncovered, durations, _command(config, overrides, backup))
    if report.broken_off:
        if as_json:
            # The report says it already: a second object would make invalid JSON.
            return 130
        raise KeyboardInterrupt
    return 0 if report.passed else 1


def _not_applicable(report: "SuiteResult") -> DiagnosticError:
    """Return the error for requested cases that do not apply to this driver."""
    names = ", ".join(dict.fromkeys(f"'{o.case}'" for o in report.outcomes))
    whys = ", ".join(dict.fromkeys(o.untried for o in report.outcomes))
    help = "select another case (`--list`), or a driver that supports it"
    return refusal("RG811", None, f"{names} cannot be tested: {whys}", help)


def _fitted(model: "RobotConfig", backup: Path) -> "RobotConfig":
    """Fit the driver to a cell's names, release and main; the cell's programs do not run."""
    from rapidgen.generate import build
    from rapidgen.generate.existing_controller import fit, read_cell

    cell = read_cell(backup)
    fitted = fit(model, cell)
    build(fitted, cell)
    return fitted


def _check_names(names: list[str]) -> None:
    from rapidgen.verification.suite import CASES

    known = [case.name for case in CASES]
    wrong = [name for name in names if name not in known]
    if wrong:
        raise DiagnosticError(
            error(
                "RG801",
                None,
                f"unknown test case '{name}'",
                suggest(name, known) or "`rapidgen test CONFIG --list` shows the cases",
            )
            for name in wrong
        )


def _check_writable(path: Path | None) -> None:
    """Check before a long run that its report can be written."""
    from rapidgen._atomic_write import check_writable

    if path is None:
        return
    try:
        check_writable(path)
    except OSError as fault:
        raise refusal(
            "RG803",
            None,
            f"{path} cannot be written: {fault.strerror}",
            "use a file in an existing folder with write permission",
        ) from fault


def _of_cluster(address: str) -> "Callable[[DriverUnderTest], WorkerPool]":
    from rapidgen.verification.cluster import Cluster

    return lambda driver: Cluster(address, driver, lambda text: typer.echo(text, err=True))


def _command(config: str, overrides: list[str] | None, backup: Path | None) -> str:
    """Return the shell command that tests the same driver again."""
    import shlex

    words = ["rapidgen", "test", config]
    words += [word for text in overrides or () for word in ("--set", text)]
    words += ["--backup", str(backup)] if backup is not None else []
    return shlex.join(words)


_UNITS = {"s": 1, "min": 60, "h": 3600, "d": 86400}


def _seconds(budget: str | None) -> float:
    import math
    import re

    if budget is None:
        return math.inf
    text = re.fullmatch(r"(\d+(?:\.\d+)?) ?(s|min|h|d)", budget)
    if text is None:
        help = f"write a number and one of {', '.join(_UNITS)}: --budget 30min"
        raise refusal("RG806", None, f"'{budget}' is not a duration", help)
    return float(text[1]) * _UNITS[text[2]]


def _no_results_to_resume() -> DiagnosticError:
    help = "name the file with the results: --results FILE --resume"
    return refusal("RG805", None, "--resume needs --results", help)


def _list(as_json: bool) -> int:
    """List the test cases by group."""
    import json

    from rapidgen.verification.suite import CASES

    if as_json:
        rows = [{"case": c.name, "group": c.group, "title": c.title} for c in CASES]
        typer.echo(json.dumps(rows, indent=1))
        return 0
    width = max(len(case.name) for case in CASES)
    for group in dict.fromkeys(case.group for case in CASES):
        typer.echo(f"{group}:")
        for case in CASES:
            if case.group == group:
                typer.echo(f"  {case.name:<{width}}  {case.title}")
    return 0


def _show(report: "SuiteResult", uncovered: bool, durations: int, command: str) -> None:
    from rich.console import Console
    from rich.table import Table

    from rapidgen.verification.model import is_program
    from rapidgen.verification.report import complaint, met, missed, slowest, untried

    console = Console(highlight=False)
    table = Table("group", "passed", "of", "answers", box=None)
    groups = dict.fromkeys(o.group for o in report.tried)
    for group in groups:
        own = [o for o in report.tried if o.group == group]
        answers = sorted({a.strip() for o in own for a in o.answers.split(",") if a})
        table.add_row(group, str(sum(o.passed for o in own)), str(len(own)), " ".join(answers))
    if report.schedules:
        held = report.schedules - sum(not is_program(f.schedule) for f in report.findings)
        table.add_row("schedules", str(held), str(report.schedules), "R1 R5 R7 R12")
    if report.programs:
        held = report.programs - sum(is_program(f.schedule) for f in report.findings)
        table.add_row("programs", str(held), str(report.programs), "")
    reached, of = report.covered
    if of:
        table.add_row("lines of RAPID", str(reached), str(of), f"{reached / of:.1%} covered")
    console.print(table)
    if why := untried(report):
        console.print(f"not applicable: {why}", markup=False)
    if uncovered:
        for path, lines in missed(report):
            console.print(f"not reached: {path}: {lines}", markup=False, soft_wrap=True)
    for case, seconds, times in slowest(report, durations):
        console.print(f"{seconds:8.2f} s  {case} ({times} times)", markup=False)
    for outcome in report.outcomes:
        if not outcome.passed:
            console.print(f"failed: {complaint(outcome)}", markup=False)
    for finding in report.findings:
        console.print(f"failed: {finding.detail}", markup=False)
        again = f"{command} --replay {finding.schedule} --record replay.mcap"
        console.print(f"  {again}", markup=False, soft_wrap=True)
    if report.curve:
        console.print(met(report), markup=False)
    verdict = "passed" if report.passed else "failed"
    if report.left:
        verdict += f", {report.left} not tried"
    if report.broken_off:
        verdict = "interrupted"
    console.print(
        f"{report.name} (build {report.build_id}): {verdict}, in {report.elapsed:.0f} s. "
        "Tested on the virtual controller only.",
        markup=False,
    )


def _recorder(
    config: "RobotConfig", file: Path, overrides: "Overrides", path: Path
) -> "Callable[[VirtualController], Callable[[], None]]":
    """Return a function that begins a recording with the robots' appearance."""
    from rapidgen.viewer.appearance import appearance
    from rapidgen.viewer.recording.writer import record

    _check_writable(path)
    described = {group.name: file for group in config.groups} if file.is_file() else {}
    return partial(record, path=path, look=appearance(config.groups, described, overrides))


def _replay(
    config: "RobotConfig",
    name: str,
    trace: Path | None,
    begin: "Callable[[VirtualController], Callable[[], None]] | None",
) -> int:
    from rapidgen.verification.model import is_program, title
    from rapidgen.verification.suite_runner import replay

    _check_writable(trace)
    with trace.open("w", encoding="utf-8") if trace else nullcontext() as log:
        explored = replay(config, name, log, begin)
    typer.echo(explored.plan)
    if explored.finding is None:
        verdict = "same motion as in RAPID" if is_program(name) else "invariant not violated"
        typer.echo(f"{title(name)}: {verdict}")
        return 0
    typer.echo("\n".join(explored.finding.log))
    typer.echo(f"{title(name)}: {explored.finding.detail}")
    return 1


def probe(
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="File to write; default: stdout.", metavar="FILE"),
    ] = None,
    moving: Annotated[
        bool,
        typer.Option("--moving", help="Test motion: THE ROBOT TURNS ITS AXIS 6."),
    ] = False,
) -> int:
    """Write a RAPID module that tests a controller's behaviour.

    Load it alone into a NORMAL task and start it. Each line on the pendant is an assumption that
    `rapidgen run --assume` takes. It sets no output and does not move the robot. The module of
    --moving turns axis 6 by 10 degrees, after a confirmation on the pendant.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen._data import data_folder

    name = "ROS_probe_motion.mod" if moving else "ROS_probe.mod"
    text = (data_folder("templates") / name).read_text(encoding="latin-1")
    if output is None:
        typer.echo(text, nl=False)
        return 0
    try:
        write_whole(output, text.encode("latin-1"))
    except OSError as fault:
        raise refusal(
            "RG802",
            None,
            f"{output} cannot be written: {fault.strerror}",
            "use a file in an existing folder with write permission",
        ) from fault
    typer.echo(f"{output}: load it alone into a NORMAL task, PP to main, Start", err=True)
    return 0
