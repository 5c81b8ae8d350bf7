"""The commands `commission` and `report`: the first moves of a robot, and their results."""

import asyncio
import sys
from contextlib import AsyncExitStack
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen._atomic_write import write_whole
from rapidgen.cli import options
from rapidgen.cli.terminal import is_quiet

if TYPE_CHECKING:
    from collections.abc import Callable

    from rapidgen.client.address import Address
    from rapidgen.commission import Checklist, Commissioning, Operator, Question
    from rapidgen.config.model import GroupConfig, RobotConfig

_FILES = ("checklist.html", "checklist.md", "checklist.json")
_SIGNS = {"ok": "ok", "assumed": "assumed", "skipped": "skipped", "fail": "FAIL"}


def commission(
    config: options.Config,
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.YesOnLoopback = False,
    move_real_robot: options.RealRobot = "",
    answers: Annotated[
        Path | None,
        typer.Option(help="Answers by question in YAML, for a simulator only.", metavar="FILE"),
    ] = None,
    rws: Annotated[
        str,
        typer.Option(
            "--rws",
            help="Robot Web Services for comparison: HOST, rws://, rwss:// or `sim`.",
            metavar="HOST|sim",
        ),
    ] = "",
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="Folder for checklist.html, .md and .json.", metavar="FOLDER"
        ),
    ] = None,
    skip_emergency: Annotated[
        bool, typer.Option("--skip-emergency", help="Do not try the emergency stop.")
    ] = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="The checklist as JSON.")] = False,
) -> int:
    """Try a robot for the first time (THE ROBOT MOVES).

    In manual mode with reduced speed, with an operator at the pendant: identity, zero and direction
    of each joint, STOP, a lost connection, the emergency stop. Announces every move and asks; the
    first doubt ends it. Ctrl-C stops the robot. Not a safety function.

    rapidgen commission cell.yaml --to 192.168.125.1 --move-real-robot 192.168.125.1 -o first-hour
    """
    from rapidgen.cli.motion_execution import permitted
    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.client import Robot
    from rapidgen.client.sim_address import SIMULATOR
    from rapidgen.config import load_config

    if output is not None:
        output.mkdir(parents=True, exist_ok=True)
        check_files_writable([output / name for name in _FILES])
    loaded = load_config(config)
    robot = Robot(config, address=to or None, group=group)
    # The operator's first answer is the confirmation on this computer.
    permitted(robot, to, yes=yes, real_robot=move_real_robot)
    simulated = to == SIMULATOR
    operator = _operator(answers, yes=yes and simulated, simulated=simulated)
    own = next(g for g in loaded.groups if g.name == robot.group.name)
    job = _job(config, loaded, own, robot.address, operator, simulated=simulated)
    # A prepared answer presses no button.
    emergency = not (skip_emergency or (yes and simulated and answers is None))
    job.settings = replace(job.settings, emergency=emergency)
    job.changed = _progress()
    try:
        asyncio.run(_run(job, rws, user, secrets, fingerprint))
    finally:
        if output is not None and job.checklist.steps:
            _write(output, job.checklist)
    if as_json:
        typer.echo(job.checklist.to_json(), nl=False)
    elif output is None:
        from rapidgen.commission.checklist_text import markdown

        typer.echo(markdown(job.checklist), nl=False)
    return 0 if job.checklist.end == "complete" else 1


def _job(
    name: str,
    config: "RobotConfig",
    group: "GroupConfig",
    address: "Address",
    operator: "Operator",
    *,
    simulated: bool,
) -> "Commissioning":
    from rapidgen import __version__
    from rapidgen.client import AsyncRobot
    from rapidgen.commission import Checklist, Commissioning
    from rapidgen.deploy.command_run import desired_set

    def connect(watch: bool) -> AsyncRobot:
        return AsyncRobot(config, address=address, group=group.name, watch=watch)

    checklist = Checklist(
        robot=config.name,
        model=group.model,
        group=group.name,
        target=str(address),
        date=datetime.now().astimezone().isoformat(timespec="seconds"),
        version=__version__,
        simulated=simulated,
    )
    return Commissioning(group, connect, operator, checklist, desired_set(name).build_id)


async def _run(
    job: "Commissioning", web: str, user: str, secrets: Path | None, fingerprint: str
) -> None:
    from rapidgen.commission import run

    async with AsyncExitStack() as stack:
        if web:
            from rapidgen.cli.rws_session import login
            from rapidgen.client.rws import AsyncController
            from rapidgen.commission.controller_view import WebServicesView

            # A password may be prompted for: before anything is connected.
            controller = AsyncController(**login(web, user, secrets, fingerprint))
            await stack.enter_async_context(controller)
            job.view = WebServicesView(controller, job.config)
        await run(job)


def _write(folder: Path, checklist: "Checklist") -> None:
    from rapidgen.commission.checklist_text import html, markdown

    texts = (html(checklist), markdown(checklist), checklist.to_json())
    for name, text in zip(_FILES, texts, strict=True):
        write_whole(folder / name, text.encode("utf-8"))
    typer.echo(f"{folder}: {', '.join(_FILES)}", err=True)


# -- the operator -------------------------------------------------------------------------------


def _operator(answers: Path | None, *, yes: bool, simulated: bool) -> "Operator":
    """Return the source of answers. Raises DiagnosticError RG641, RG684."""
    from rapidgen.client import NotReady
    from rapidgen.commission.operator import PreparedAnswers, read_answers
    from rapidgen.diagnostics import refusal

    if answers is not None:
        if not simulated:
            raise refusal(
                "RG684",
                None,
                "prepared answers cannot stand for the operator of a robot",
                "leave --answers away; it belongs to `--to sim`",
            )
        return read_answers(answers)
    if yes:
        return PreparedAnswers({}, otherwise="yes")
    if not sys.stdin.isatty():
        raise NotReady.because(
            "RG641",
            "an operator has to answer, no terminal: nothing was sent",
            "run it on a terminal; on the simulator, --yes or --answers FILE",
            exit_code=2,
        )
    return TerminalOperator()


class TerminalOperator:
    """An operator at this terminal."""

    assumed = False

    def announce(self, text: str) -> None:
        """Show what comes next."""
        typer.echo(f"\n{text}", err=True)

    async def ask(self, question: "Question") -> str:
        """Ask until the answer is one of the choices. Raises DiagnosticError RG689 at the end."""
        import termios

        from rapidgen.diagnostics import refusal

        # What was typed before the question is no answer to it: it would permit a move that
        # was not announced yet.
        termios.tcflush(sys.stdin.fileno(), termios.TCIFLUSH)
        while True:
            typer.echo(f"{question.text} [{'/'.join(question.choices)}] ", err=True, nl=False)
            line = await _line()
            if not line:
                raise refusal(
                    "RG689", None, "the terminal has ended without an answer", "begin anew"
                )
            answer = line.strip().lower()
            chosen = [c for c in question.choices if answer and c.lower().startswith(answer)]
            exact = [c for c in question.choices if c.lower() == answer]
            if len(exact or chosen) == 1:
                return (exact or chosen)[0]


async def _line() -> str:
    """Read a line of the terminal while the connections are served; empty at its end."""
    loop = asyncio.get_running_loop()
    arrived: asyncio.Future[None] = loop.create_future()

    def readable() -> None:
        if not arrived.done():
            arrived.set_result(None)

    loop.add_reader(sys.stdin.fileno(), readable)
    try:
        await arrived
    finally:
        loop.remove_reader(sys.stdin.fileno())
    # A terminal gives whole lines, so this does not block.
    return sys.stdin.readline()


def _progress() -> "Callable[[Checklist], None]":
    """Return a function that shows each new step on stderr."""
    shown = 0

    def show(checklist: "Checklist") -> None:
        nonlocal shown
        for step in checklist.steps[shown:]:
            if is_quiet() and step.verdict != "fail":
                continue
            typer.echo(f"{_SIGNS[step.verdict]:<8} {step.title}: {step.found}", err=True)
            if step.code:
                typer.echo(f"{'':<8} {step.code}: {step.help}", err=True)
        shown = len(checklist.steps)

    return show


# -- the report ---------------------------------------------------------------------------------


def report(
    checklists: Annotated[
        list[Path] | None,
        typer.Option(
            "--checklist", help="checklist.json of `commission`; repeatable.", metavar="FILE"
        ),
    ] = None,
    logs: Annotated[
        list[Path] | None,
        typer.Option("--log", help="Saved event log; repeatable.", metavar="FILE"),
    ] = None,
    results: Annotated[
        list[Path] | None,
        typer.Option(
            "--result", help="Output of `move --json`: durations; repeatable.", metavar="FILE"
        ),
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Bundle to write.", metavar="FILE.zip")
    ] = Path("rapidgen-report.zip"),
    yes: options.Yes = False,
) -> int:
    """Write an anonymised bundle for the developers of rapidgen.

    Contains versions, results of commissioning, durations and event numbers. Host names, users,
    paths, serial numbers, program texts and free texts are left out; names become hashes. Shows
    everything before it writes, and sends nothing.

    rapidgen report --checklist first-hour/checklist.json --log log.txt
    """
    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.commission.report import bundle, zipped

    if not (checklists or logs or results):
        raise typer.BadParameter("nothing to report: --checklist, --log or --result FILE")
    check_files_writable([output])
    files = bundle(checklists or (), logs or (), results or ())
    for name, text in files.items():
        typer.echo(f"-- {name}\n{text}", err=True, nl=False)
    if not yes:
        if not sys.stdin.isatty():
            from rapidgen.client import NotReady

            raise NotReady.because(
                "RG641",
                "confirmation required, no terminal: nothing was written",
                "read what is above, then confirm with --yes",
                exit_code=2,
            )
        typer.confirm(f"Write this to {output}?", abort=True, err=True)
    write_whole(output, zipped(files))
    typer.echo(f"{output}: {len(files)} files; nothing was sent")
    return 0
