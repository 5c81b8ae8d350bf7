"""`rapidgen pose`: where the tool is, or would be."""

from typing import Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import Units, joints_of, joints_text, pose_text, read_figures


def pose(
    config: options.Config,
    joints: Annotated[
        str,
        typer.Option(help="Where it would be there; no robot is asked.", metavar="J1,J2,..."),
    ] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Show where the tool is in the work object, and the joints; as `move` takes them.

    X,Y,Z in mm and the quaternion Q1,Q2,Q3,Q4; joints in deg and mm.

    rapidgen pose cell.yaml --to sim
    """
    import json

    from rapidgen.client import Robot

    units = Units(rad)
    robot = Robot(config, address=to or None, group=group, watch=True)
    if joints:
        from rapidgen.client.connect_target import resolve

        _, known = resolve(config, robot.address, group)
        assert known is not None
        at = joints_of(read_figures(joints), units, known, [0.0] * len(known.names))
        where = known.poses.pose(known.map.to_controller(at))
    else:
        with robot:
            known, at = robot.group, robot.state.joints
            where = robot.pose_of(at)
    if as_json:
        text = {"position": where[0], "orientation": where[1]}
        typer.echo(json.dumps({**text, "joints": dict(zip(known.names, at, strict=True))}))
        return 0
    typer.echo(f"pose    {pose_text(units, where)}  ({units.length[0]}, quaternion)")
    typer.echo(f"joints  {joints_text(units, known, at)}  ({units.said})")
    return 0
