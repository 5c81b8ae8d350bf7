"""`rapidgen jog`: joints, or the tool, a little from where they are."""

import math
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import Figures, Units, figure, named_of, named_text, read_figures

if TYPE_CHECKING:
    from rapidgen.client import Robot

_PLACE = "JOINT=STEP"
_SLOW = 0.05
"""m/s of the tool where nobody says more."""


def jog(
    config: options.Config,
    by: Annotated[
        list[str],
        typer.Argument(
            help="How far: joint_1=5 joint_3=-2, or z=20 x=-5 in the work object.",
            metavar="JOINT=STEP...",
        ),
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.YesHere = False,
    move_real_robot: options.RealRobot = "",
    speed: Annotated[
        float, typer.Option(help="mm/s of the tool (m/s with --rad).", metavar="V")
    ] = 0.0,
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Move joints or the tool a little from where they are: at most 11.4 deg or 100 mm.

    Ctrl-C stops. x, y and z move the tool on a line in the work object, without turning it. The
    controller stops the robot when it does not hear of this command for 0.2 s. Needs the
    driver's control port.

    rapidgen jog cell.yaml joint_1=5 joint_3=-2 --to sim
    rapidgen jog cell.yaml z=20 --to sim
    """
    from rapidgen.cli.motion_commands import confirm_at, permitted, report_interruption
    from rapidgen.client import Robot

    units = Units(rad)
    if speed < 0 or not math.isfinite(speed):
        raise typer.BadParameter(f"must be above 0, not {speed}", param_hint="--speed")
    requested = _read(by)
    robot = Robot(config, address=to or None, group=group)
    must_ask = permitted(robot, to, yes=yes, real_robot=move_real_robot)
    with robot:
        steps = _steps(robot, units, requested)
        if must_ask:
            confirm_at(robot)
        with report_interruption(robot, units):
            result = robot.jog(speed=speed / units.length[1] or _SLOW, **steps)
        if as_json:
            import json

            typer.echo(json.dumps({"seconds": result.seconds, "joints": result.state.by_name}))
        else:
            typer.echo(f"at {named_text(units, robot.group, result.state.joints)}")
    return 0


def _read(by: list[str]) -> Figures:
    if not all("=" in step for step in by):
        raise typer.BadParameter(
            "write JOINT=STEP, such as joint_1=5, or x=5, y=5, z=5", param_hint=_PLACE
        )
    return read_figures(",".join(by), _PLACE)


def _steps(robot: "Robot", units: Units, requested: Figures) -> dict[str, float]:
    """Steps in rad and m by joint or direction. Raises typer.BadParameter."""
    from rapidgen.client.flows.program import DIRECTIONS, LONGEST_JOG

    kinds = {joint.name: joint.kind for joint in robot.group.joints}
    if not set(requested.names) & set(kinds) and set(requested.names) <= set(DIRECTIONS):
        kinds = {name: "prismatic" for name in DIRECTIONS}
    nothing = [0.0] * len(kinds)
    result = named_of(requested, units, kinds, nothing, _PLACE)
    steps = {}
    for name, step in zip(kinds, result, strict=True):
        most = LONGEST_JOG[kinds[name]]
        if abs(step) > most:
            unit, factor, _ = units.joint(kinds[name])
            raise typer.BadParameter(
                f"{name} by {figure(step, factor)} {unit} is too far: at most "
                f"{figure(most, factor)} {unit} at a time; `rapidgen move` goes farther",
                param_hint=_PLACE,
            )
        if step:
            steps[name] = step
    return steps
