"""The command `demo`: build, boot, move and report, without a robot."""

import math
import sys
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rapidgen.client import Execution, Result, Robot, Trajectory
    from rapidgen.client.recording import JointRecording
    from rapidgen.config.model import GroupConfig

_READY_TIMEOUT = 10.0
"""Seconds in which the driver's servers must listen."""
_PROGRESS_PERIOD = 2.0
"""Seconds between two lines of progress."""


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
) -> int:
    """Build a driver, simulate it, move the robot and report."""
    from rapidgen.client import Robot, Timeouts
    from rapidgen.config import load_config
    from rapidgen.controller import VirtualController
    from rapidgen.generate import build, write
    from rapidgen.wire.simple_message.spec import TriState

    _say(f"build    the driver of {config}: RAPID modules and controller configuration")
    model = load_config(config)
    folder = output / model.name
    driver = build(model)
    write(driver, folder)
    _say(f"         {folder}: {len(driver.files)} files, build {driver.build_id}")
    _say("boot     a virtual controller, which executes these files")
    with VirtualController.from_folder(folder, clock="real", ports="auto") as controller:
        group = model.groups[0]
        controller.start()
        address = controller.address(group.name, timeout=_READY_TIMEOUT)
        tasks = len(controller.tasks)
        _say(f"         {tasks} tasks, RobotWare {model.robotware[0]}, at {address}")
        _say("connect  a Python client, as to a robot")
        # Time stamps of the controller's clock: those of reception are late on a busy computer.
        # There the controller is late too, so the timeouts are long.
        patient = Timeouts(hello=10.0, ready=10.0, silence=15.0, heartbeat=15.0)
        with Robot(
            model, address=address, group=group.name, feedback=True, timeouts=patient
        ) as robot:
            robot.wait_until(lambda s: s.status.motion_possible is TriState.TRUE, _READY_TIMEOUT)
            trajectory = _trajectory(robot)
            _say(f"         rapidgen {robot.driver.version}, {robot.state.status}")
            _say(f"move     {len(trajectory)} points in {trajectory.duration:.0f} s")
            with robot.recording() as recording:
                result = _followed(robot, robot.execute(trajectory))
            reached = controller.call(controller.motion.group(group.name).positions)
            _report(robot, trajectory, recording, result, reached)
    _draw(output, trajectory, recording, group)
    _next(model.name, output)
    return 0


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
    reached: tuple[float, ...],
) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table("joint", "commanded", "reached", "difference", box=None)
    final = robot.group.from_wire(reached)
    for name, requested, stood in zip(
        robot.group.names, trajectory.positions[-1], final, strict=True
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
