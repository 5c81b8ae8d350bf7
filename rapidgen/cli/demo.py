"""The command `demo`: build, boot, move and report, without a robot."""

import json
import math
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from rapidgen.client import Execution, Result, Robot, Trajectory
    from rapidgen.client.recording import JointRecording
    from rapidgen.config.model import GroupConfig

    Process = subprocess.Popen[str]

_READY_TIMEOUT = 10.0
"""Seconds in which the robot must be ready to move."""
_PROGRESS_PERIOD = 2.0
"""Seconds between two lines of progress."""
_UNATTENDED = 30.0
"""Seconds of further motion where no terminal can end it."""


class _SimulatorEnded(Exception):
    """The simulator ended before it was ready; it has reported the reason."""


def demo(
    config: Annotated[
        str, typer.Argument(help="Configuration or shipped name.", metavar="CONFIG")
    ] = "irb120",
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", help="Folder for the driver and the plots.", metavar="FOLDER"
        ),
    ] = Path("demo_out"),
    view: Annotated[
        bool, typer.Option(help="Show the robot in the browser, where the page is installed.")
    ] = True,
) -> int:
    """Build a driver, simulate it, move the robot and report.

    With the page the robot goes on moving until Ctrl-C, or for 30 s where there is no terminal.
    """
    from rapidgen.client import Robot, Timeouts
    from rapidgen.config import load_config
    from rapidgen.generate import build, write
    from rapidgen.wire.simple_message.spec import TriState

    _say(f"build    the driver of {config}: RAPID modules and controller configuration")
    model = load_config(config)
    folder = output / model.name
    driver = build(model)
    write(driver, folder)
    _say(f"         {folder}: {len(driver.files)} files, build {driver.build_id}")
    lacking = _lacking_for_page() if view else ""
    if lacking:
        _say(f"page     not shown: {lacking}")
    _say("boot     a virtual controller, which executes these files")
    group = model.groups[0]
    try:
        with _simulator(folder, view=view and not lacking) as (process, ready):
            address, page = ready["address"][group.name], ready.get("view", "")
            _say(f"         RobotWare {model.robotware[0]}, at {address}")
            if page:
                _say(f"page     {page}")
            _say("connect  a Python client, as to a robot")
            # A busy computer delays the controller, so the timeouts are long.
            patient = Timeouts(hello=10.0, ready=10.0, silence=15.0, heartbeat=15.0)
            # Feedback has time stamps of the controller's clock; those of reception are late then.
            with Robot(
                model, address=address, group=group.name, feedback=True, timeouts=patient
            ) as robot:
                robot.wait_until(
                    lambda s: s.status.motion_possible is TriState.TRUE, _READY_TIMEOUT
                )
                trajectory = _trajectory(robot)
                _say(f"         rapidgen {robot.driver.version}, {robot.state.status}")
                _say(f"move     {len(trajectory)} points in {trajectory.duration:.0f} s")
                with robot.recording() as recording:
                    result = _followed(robot, robot.execute(trajectory))
                robot.wait_until(lambda s: not s.is_moving, _READY_TIMEOUT)
                _report(robot, trajectory, recording, result)
                _draw(output, trajectory, recording, group)
                _next(model.name, output)
                if page:
                    _show_page(robot, trajectory, page, process)
    except _SimulatorEnded:
        return 1
    return 0


def _lacking_for_page() -> str:
    """Return how to get what the page lacks; empty if it can be served."""
    from rapidgen.viewer.plotting import ASSETS

    if find_spec("aiohttp") is None or find_spec("websockets") is None:
        return "pip install 'rapidgen[web]'"
    return "" if (ASSETS / "index.html").is_file() else "in a checkout, `make page` builds it"


@contextmanager
def _simulator(folder: Path, *, view: bool) -> Iterator[tuple["Process", dict[str, Any]]]:
    """Run `rapidgen sim FOLDER`; yield its process and the object of its line `ready`.

    Raises _SimulatorEnded.
    """
    words = [sys.executable, "-m", "rapidgen.cli", "sim", str(folder), "--ports", "auto"]
    with tempfile.TemporaryFile("w+") as log:
        process = subprocess.Popen(
            [*words, *(["--view"] if view else [])],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=log,
            text=True,
            # Ctrl-C reaches the client alone: its STOP needs a controller that answers.
            start_new_session=True,
        )
        try:
            assert process.stdout is not None
            for line in process.stdout:
                if line.startswith("ready "):
                    break
            else:
                process.wait()
                log.seek(0)
                sys.stderr.write(log.read())
                raise _SimulatorEnded
            yield process, json.loads(line.removeprefix("ready "))
        finally:
            process.send_signal(signal.SIGTERM)
            process.communicate()


def _show_page(robot: "Robot", trajectory: "Trajectory", page: str, process: "Process") -> None:
    """Repeat the motion until Ctrl-C, or for a while without a terminal.

    After a stop, such as one in the page, the robot stands until the end.
    """
    from rapidgen.client import RobotError

    attended = sys.stdin is not None and sys.stdin.isatty()
    end = math.inf if attended else time.monotonic() + _UNATTENDED
    _say(
        "\nThe robot goes on moving "
        + ("until Ctrl-C" if attended else f"for {_UNATTENDED:.0f} s")
        + f". Open the page in a browser:\n\n  {page}\n"
    )
    try:
        try:
            while time.monotonic() < end:
                robot.execute(trajectory).result()
        except RobotError as fault:
            _say(f"The robot no longer moves: {fault.diagnostics[0].message}")
            with suppress(subprocess.TimeoutExpired):
                process.wait(None if attended else max(0.0, end - time.monotonic()))
    except KeyboardInterrupt:
        _say("\nended by Ctrl-C")


def _say(text: str) -> None:
    sys.stderr.write(text + "\n")
    sys.stderr.flush()


def _followed(robot: "Robot", execution: "Execution") -> "Result":
    """Wait for the end of a motion; print its progress."""
    from rapidgen.client import RobotTimeout

    while True:
        try:
            return execution.result(timeout=_PROGRESS_PERIOD)
        except RobotTimeout:
            if execution.is_over:
                raise
            joints = ", ".join(f"{math.degrees(value):.0f}" for value in robot.state.joints)
            _say(f"         {execution.progress.fraction:4.0%}, joints at {joints} degrees")


def _next(name: str, output: Path) -> None:
    command = "rapidgen" if which("rapidgen") else sys.argv[0]
    _say(
        f"next:    look at the pictures and at {output / name}/README.md, then\n"
        f"           {command} new cell.yaml --robot irb120     your own configuration\n"
        f"           {command} sim cell.yaml &                  its driver, running\n"
        f"           {command} move cell.yaml --joints 10,0,0,0,30,0 --to sim\n"
        "         README.md and docs/use/client.md describe the next steps"
    )


def _trajectory(robot: "Robot") -> "Trajectory":
    """A wave of every joint from the current position and back, within the limits."""
    import numpy as np

    from rapidgen.client import Trajectory

    group = robot.group
    current = np.array(robot.state.joints)
    times = np.arange(0, 6.01, 0.2)
    swing = np.sin(np.pi * times / times[-1])
    amplitude = np.array([min(0.5, 0.25 * (j.upper - j.lower)) for j in group.joints])
    side = np.where(
        [h + r < j.upper for h, r, j in zip(current, amplitude, group.joints, strict=True)], 1, -1
    )
    waves = [np.sin(2 * np.pi * times / times[-1] * (1 + i % 3)) for i in range(len(current))]
    offsets = np.stack([0.5 * (1 + w) * swing for w in waves], axis=1)
    return Trajectory(times, current + side * amplitude * offsets, group.names)


def _report(
    robot: "Robot",
    trajectory: "Trajectory",
    recording: "JointRecording",
    result: "Result",
) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table("joint", "commanded", "reached", "difference", box=None)
    for name, requested, stood in zip(
        robot.group.names, trajectory.positions[-1], robot.state.joints, strict=True
    ):
        table.add_row(name, f"{requested:.4f}", f"{stood:.4f}", f"{abs(requested - stood):.4f}")
    console = Console(highlight=False)
    console.print(table)
    times = recording.times
    rate = (len(times) - 1) / times[-1] if len(times) > 1 else 0.0
    console.print(
        f"{result.points} points, planned {result.planned_seconds:.2f} s, took "
        f"{result.seconds:.2f} s; {len(times)} states at {rate:.1f} per second (rad, m)"
    )


def _draw(
    output: Path, trajectory: "Trajectory", recording: "JointRecording", group: "GroupConfig"
) -> None:
    _say("plot     commanded and executed joints")
    from rapidgen.viewer import plot
    from rapidgen.viewer.plotting import files_of

    title = f"{group.model or group.name}: commanded and executed joints"
    made = plot(trajectory, recording, title=title)
    written = [str(made.save(path)) for path in files_of(output / "demo")]
    _say(f"         {' and '.join(written)}")
