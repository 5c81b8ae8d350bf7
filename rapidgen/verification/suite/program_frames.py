"""Tools and work objects of programs: configured ones and own values."""

import random
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.config.model import Placement
from rapidgen.runtime.values import Value
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawReason
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Position
from rapidgen.verification.raw_programs import ALL, Programmer, RawMove, computes, orders
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

TOOL, WORK_OBJECT = RawInstruction.TOOL, RawInstruction.WORK_OBJECT
Other: TypeAlias = tuple[RawInstruction, Sequence[float]]
"""An instruction other than a move: kind and operands."""
MOVES = (RawInstruction.MOVE_L, RawInstruction.MOVE_J)
_NEAR = 1e-3
"""Tolerance in mm, kg and quaternion parts for equal values."""


@case("program-tools", "a program moves other tools in other work objects")
def _tools(bench: Bench) -> None:
    """Use each configured tool.

    A pose of another tool is rejected. The right pose is reached, with a stop point before its
    first move.
    """
    client = Programmer(bench)
    first, *more = orders(bench, 6, random.Random(24))
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    tools = (bench.group.tool, *bench.group.tools)
    objects = (bench.group.work_object, *bench.group.work_objects)
    reply = client.send([replace(first, frames=(len(tools), 0))])
    client.refused(reply, RawReason.NO_FRAME, 0, "a tool too many")
    reply = client.send([replace(first, frames=(len(tools) + 1, 0))])
    client.refused(reply, RawReason.NO_FRAME, 0, "two tools too many")
    reply = client.send([replace(first, frames=(0, len(objects)))])
    client.refused(reply, RawReason.NO_FRAME, 0, "a work object too many")
    reply = client.send([replace(first, frames=(0, len(objects) + 1))])
    client.refused(reply, RawReason.NO_FRAME, 0, "two work objects too many")
    if not computes(bench) or (len(tools), len(objects)) == (1, 1):
        return
    for tool in range(len(tools)):
        for wobj in range(len(objects)):
            frame = tools[tool].frame, objects[wobj].user_frame
            own = [
                replace(o, pose=_seen(bench, o.joints, *frame), kind=MOVES[0], frames=(tool, wobj))
                for o in more[:3]
            ]
            if (tool, wobj) != (0, 0):
                other = replace(own[0], frames=(0, 0))
                client.refused(
                    client.send([other]), RawReason.POSE_MISMATCH, 0, f"tool {tool}, object {wobj}"
                )
            start, since = bench.position, bench.now
            client.takes(f"tool {tool} in work object {wobj}", [*more[3:4], *own])
            # The motion ends where it started.
            bench.wait_until_moving()
            bench.wait_until_at(own[-1].joints, 60)
            joints = [start, more[3].joints, *(o.joints for o in own)]
            bench.followed(joints, since=since, corner=0.1)
            if (tool, wobj) != (0, 0):
                _stood_at(bench, more[3].joints, since)


def _stood_at(bench: Bench, joints: Position, since: float) -> None:
    """Check that the robot stopped there, without a zone."""
    track = [seen for when, seen in bench.track if when >= since]
    if not any(all(abs(a - b) < 1e-4 for a, b in zip(p, joints, strict=True)) for p in track):
        raise CheckFailed("the robot did not stop before another tool or work object")


def _seen(bench: Bench, joints: Position, tool: Placement, wobj: Placement) -> Pose:
    """Return the pose of joints, in m, with other frames."""
    geometry = bench.motion_group.kinematics
    assert geometry is not None
    flange = geometry.forward(joints)
    tip = frames.compose(flange, (tool.position, tool.orientation))
    pose = frames.compose(frames.invert((wobj.position, wobj.orientation)), tip)
    (x, y, z), q = pose
    return (round(x, 6), round(y, 6), round(z, 6)), (
        round(q[0], 6),
        round(q[1], 6),
        round(q[2], 6),
        round(q[3], 6),
    )


@case("program-own-frames", "a program gives a tool and a work object by values")
def _own(bench: Bench) -> None:
    """Use own frames only for later poses, never during an earlier move."""
    client = Programmer(bench)
    tools = len((bench.group.tool, *bench.group.tools))
    objects = len((bench.group.work_object, *bench.group.work_objects))
    first, second, third = orders(bench, 4, random.Random(31))[1:]
    right = _tool(0.05, 2.0), _object(0.1)
    if bench.motion_group.kinematics is None:
        for kind, values in zip((TOOL, WORK_OBJECT), right, strict=True):
            client.refused(says(client, (kind, values)), RawReason.NO_INSTRUCTION, 0, kind.name)
        return
    for kind, values in _wrong():
        reply = says(client, (kind, values))
        client.refused(reply, RawReason.BAD_VALUE, 0, f"{kind.name} {values}")
    for kind, values in _largest():
        if not isinstance(says(client, (kind, values)), messages.RawPointsAccepted):
            raise CheckFailed(f"{kind.name} {values} is refused")
        bench.run(0.5)
    own, their = (tools, 0), (0, objects)
    at_rest = replace(first, kind=RawInstruction.MOVE_ABSJ, pose=None, joints=bench.position)
    for order in (replace(at_rest, frames=own), replace(at_rest, frames=their)):
        client.refused(says(client, order), RawReason.NO_FRAME, 0, "values that no program gave")
    reply = says(client, (TOOL, right[0]), replace(at_rest, frames=their))
    client.refused(reply, RawReason.NO_FRAME, 1, "a tool is no work object")
    if not computes(bench):
        return
    before, after = _tool(0.05, 2.0), _tool(-0.02, 0.25)
    place = placement_of(right[1])
    path = [
        replace(
            order,
            kind=MOVES[0],
            zone=0.01,
            frames=(tools, objects),
            pose=_seen(bench, order.joints, placement_of(values), place),
        )
        for order, values in ((first, before), (second, before), (third, after))
    ]
    reply = says(client, (TOOL, after), (WORK_OBJECT, right[1]), path[0])
    client.refused(reply, RawReason.POSE_MISMATCH, 2, "a pose of another tool")
    # To where the robot cannot continue on a line.
    client.takes("a program", [replace(at_rest, joints=first.joints)])
    bench.wait_until_at(first.joints, 60)
    start, since = bench.position, bench.now
    reply = says(
        client, (TOOL, before), (WORK_OBJECT, right[1]), path[0], path[1], (TOOL, after), path[2]
    )
    if not isinstance(reply, messages.RawPointsAccepted):
        raise CheckFailed(f"tools by values are answered by {reply}")
    bench.wait_until_moving()
    _is(bench, before, "of the moves under way")
    bench.wait_until_at(third.joints, 60)
    _is(bench, after, "of the last move")
    joints = [start, *(order.joints for order in (second, third))]
    bench.followed(joints, since=since, corner=0.1)
    _stood_at(bench, second.joints, since)
    client.refused(
        says(client, replace(path[2], frames=(tools, objects))),
        RawReason.NO_FRAME,
        0,
        "values of a program that is over",
    )


def says(client: Programmer, *orders: RawMove | Other) -> messages.RawContent:
    """Send a program of moves and instructions; return the reply."""
    client.number += 1
    values = millionths(client.bench.position)
    for order in orders:
        values += (
            order.words if isinstance(order, RawMove) else [int(order[0]), *millionths(order[1])]
        )
    return client.say(values, len(orders), ALL)


def tool_of(away: float, mass: float) -> Other:
    """Return TOOL with the values of these cases."""
    return TOOL, _tool(away, mass)


def object_of(away: float) -> Other:
    """Return WORK_OBJECT with the values of these cases."""
    return WORK_OBJECT, _object(away)


def _tool(away: float, mass: float) -> list[float]:
    """Return operands of TOOL at a distance, turned by half a turn."""
    return [0.01, 0.0, away, 0.0, 1.0, 0.0, 0.0, 0.0, 0.01, away, 0, 1, 0, 0, mass, 0.1, 0.2, 0.3]


def _object(away: float) -> list[float]:
    """Return operands of WORK_OBJECT.

    The object frame is at a distance from the turned user frame.
    """
    return [away, 0.02, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, away, 1.0, 0.0, 0.0, 0.0]


def _wrong() -> list[tuple[RawInstruction, list[float]]]:
    """Return operands with one invalid value."""
    tool, wobj = _tool(0.05, 2.0), _object(0.1)
    result = [(TOOL, [*tool[:at], value, *tool[at + 1 :]]) for at, value in _WRONG]
    return result + [(WORK_OBJECT, [*wobj[:at], 101.0, *wobj[at + 1 :]]) for at in (0, 7)]


def _largest() -> list[tuple[RawInstruction, list[float]]]:
    """Return operands at the allowed maximum."""
    turned = [1.0, 0.0, 0.0, 0.0]
    far, deep = [100.0, 0.0, 0.0, *turned], [0.0, -100.0, 0.0, *turned]
    return [
        (TOOL, [*far, *deep, 2000.0, 2000.0, 2000.0, 2000.0]),
        (TOOL, [*deep, *far, 1e-6, 0.0, 0.0, 0.0]),
        (WORK_OBJECT, [*far, *deep]),
    ]


_WRONG = (
    *((at, 101.0) for at in (0, 1, 2, 7, 8, 9)),
    *((at, 2.0) for at in (4, 11)),
    *((14, mass) for mass in (0.0, -1.0, 2001.0)),
    *((at, value) for at in (15, 16, 17) for value in (-0.1, 2001.0)),
)
"""Invalid TOOL operands: frames too far, quaternions too long, masses, moments."""


def placement_of(values: Sequence[float]) -> Placement:
    """Return the frame of operands; two frames are multiplied."""
    (x, y, z, *turn), second = values[:7], values[7:]
    (a, b, c, d) = turn
    pose: Pose = (x, y, z), (a, b, c, d)
    if len(second) == 7:
        (x, y, z, a, b, c, d) = second
        pose = frames.compose(pose, ((x, y, z), (a, b, c, d)))
    return Placement(*pose)


def _is(bench: Bench, values: Sequence[float], what: str) -> None:
    """Check that the motion task has this tool."""
    tool: Value = bench.controller.task(bench.group.task)["ROS_execution:ROS_own_tool"]
    frame, load = tool.tframe, tool.tload
    moments = load.ix, load.iy, load.iz
    has = (frame.trans.z, frame.rot.q2, load.cog.z, load.aom.q2, load.mass, *moments)
    expected = (1000 * values[2], values[4], 1000 * values[9], values[11], *values[14:])
    if not all(abs(a - b) < _NEAR for a, b in zip(has, expected, strict=True)):
        raise CheckFailed(f"{what} the tool is {has}, not {expected}")
