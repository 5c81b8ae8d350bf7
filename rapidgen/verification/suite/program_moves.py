"""Moves of programs as the motion task orders them: zones and speeds."""

import math
import random
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, replace

from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.motion.moves import Move
from rapidgen.runtime.builtins.motion.targets import data_of
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import at_call
from rapidgen.verification.messages import RawInstruction, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.raw_programs import ALL, Programmer, RawMove, computes, orders, reached
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.suite.program_frames import Other, object_of, says, tool_of
from rapidgen.verification.suite.speed import aside, asks_as_it_begins
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

_ABSJ = RawInstruction.MOVE_ABSJ


@contextmanager
def _ordered(bench: Bench) -> Iterator[list[Move]]:
    """Yield the list of ordered moves of the first group."""
    moves: list[Move] = []
    listeners = bench.motion_group.listeners
    listeners.append(moves.append)
    yield moves
    listeners.remove(moves.append)


def _by_joints(order: RawMove, frames: tuple[int, int]) -> RawMove:
    return replace(order, kind=_ABSJ, pose=None, zone=0.002, frames=frames)


def _stand_still(bench: Bench, client: Programmer) -> list[RawMove]:
    """Return moves nearby; move the robot to the first one."""
    result = orders(bench, 9, random.Random(61))
    client.takes("a program", result[:1])
    bench.wait_until_at(result[0].joints, 60)
    return result


@case("program-zones", "a move is passed through its zone unless something needs a stop")
def _zones(bench: Bench) -> None:
    """Check zones of circles and lines, and stop points before waits and tools."""
    client = Programmer(bench)
    path = _stand_still(bench, client)
    one, two, *others = (_by_joints(order, (0, 0)) for order in path[1:])
    wait = RawInstruction.WAIT, [0.1]
    _stop_at(client, [one, two, replace(one, zone=None), two, wait, one], [0, 0, 1, 1, 1])
    if computes(bench) and len(bench.group.joints) >= 6:
        first, second = reached(bench, others[0].joints), reached(bench, others[1].joints)
        line = replace(others[0], kind=RawInstruction.MOVE_L, pose=first)
        circle = replace(
            others[1], kind=RawInstruction.MOVE_C, pose=second, via=aside(first, second)
        )
        _stop_at(client, [two, line, circle, one, two], [0, 0, 0, 0, 1])
    if bench.motion_group.kinematics is not None:
        tool = len((bench.group.tool, *bench.group.tools))
        wobj = len((bench.group.work_object, *bench.group.work_objects))
        # An object of its own once, a tool of its own twice.
        own = [replace(one, frames=f) for f in ((0, wobj), (tool, wobj), (tool, wobj))]
        given = tool_of(0.05, 2.0), object_of(0.1)
        _stop_at(client, [*given, one, two, *own, one], [0, 1, 1, 0, 1, 1])
        _stop_at(client, [*given, one, own[1]], [1, 1])
    if computes(bench):
        # The configured frames apply again.
        pose = replace(orders(bench, 1, random.Random(61))[0], kind=RawInstruction.MOVE_J)
        client.takes("a pose", [replace(pose, pose=reached(bench, pose.joints))])
        bench.wait_until_at(pose.joints, 60)


def _stop_at(client: Programmer, program: Sequence[RawMove | Other], stops: list[int]) -> None:
    """Send a program; check which of its moves are stop points."""
    bench = client.bench
    with _ordered(bench) as moves:
        reply = says(client, *program)
        if not isinstance(reply, messages.RawPointsAccepted):
            raise CheckFailed(f"the instructions are right, the reply is {reply}")
        bench.until(lambda: len(moves) == len(stops), 90, "all moves are ordered")
        bench.wait_until_standing(30)
    if [int(move.zone.fine) for move in moves] != stops:
        raise CheckFailed(f"stops at {[int(move.zone.fine) for move in moves]}, wanted at {stops}")
    bench.run(0.5)


@case("program-operands", "each speed and each radius of a zone is looked at by itself")
def _operands(bench: Bench) -> None:
    """Reject invalid operands with reason and index; accept the extremes."""
    client, start = Programmer(bench), millionths(bench.position)
    order = RawMove(RawInstruction.MOVE_ABSJ, bench.position, None)
    speeds, zones = range(1, 5), range(6, 12)
    slowest, widest = [1], millionths([1.0])
    for place, wrong, reason in (
        *((n, value, RawReason.BAD_SPEED) for n in speeds for value in (0, -1, 2**31 - 1)),
        *((n, value, RawReason.BAD_ZONE) for n in zones for value in (-1, 2**31 - 1)),
        *((5, value, RawReason.BAD_ZONE) for value in (-1, 1, *millionths([2.0]))),
    ):
        values = order.words
        values[place] = wrong
        client.number += 1
        reply = client.say([*start, *order.words, *values], 2, ALL)
        client.refused(reply, reason, 1, f"word {place} of a move is {wrong}")
    # The next instruction is invalid.
    for places, value in ((speeds, slowest), (zones, [0]), (zones[:3], widest)):
        for place in places:
            values = order.words
            values[place : place + 1] = value
            client.number += 1
            reply = client.say([*start, *values, 99], 2, ALL)
            client.refused(reply, RawReason.NO_INSTRUCTION, 1, f"word {place} of a move is {value}")
    bench.assert_at_rest(0.5, "no program was right")


@case("program-speeds", "a slower program is slower in each of its speeds", needs="control")
def _speeds(bench: Bench) -> None:
    """Scale all speeds by the same share: TCP, rotation, external axes."""
    client, control = Programmer(bench), bench.control()
    program = [_by_joints(order, (0, 0)) for order in _stand_still(bench, client)[1:4]]
    for percent in (100.0, 40.0):
        if percent < 100:
            asks_as_it_begins(bench, control, percent)
        with _ordered(bench) as moves:
            client.takes("a program", program)
            bench.wait_until_moving()
            bench.wait_until_at(program[-1].joints, 90)
        for order, move in zip(program, moves, strict=True):
            expected = [percent / 100 * value for value in order.speeds]
            for one, other in zip(astuple(move.speed), expected, strict=True):
                if abs(one - other) > 0.002 * other:
                    raise CheckFailed(
                        f"at SPEED {percent:g} {expected} is wanted, not {move.speed}"
                    )
        bench.run(0.5)


_SLIGHTLY = math.sin(0.0005), math.cos(0.0005)
_DISPLACED: tuple[Pose, ...] = (
    ((5e-5, 0.0, 0.0), IDENTITY[1]),
    (IDENTITY[0], (_SLIGHTLY[1], _SLIGHTLY[0], 0.0, 0.0)),
    (IDENTITY[0], (_SLIGHTLY[1], 0.0, _SLIGHTLY[0], 0.0)),
    (IDENTITY[0], (_SLIGHTLY[1], 0.0, 0.0, _SLIGHTLY[0])),
    IDENTITY,
)
"""0.05 mm, a milliradian about each axis; the last one with an offset of external axes."""


@case("program-displaced-late", "a displacement after the program was accepted")
def _displaced_late(bench: Bench) -> None:
    """Displace the program late: the first pose ends it without motion.

    Even a small displacement counts. Joint targets are not affected.
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    client, watcher, modal = Programmer(bench), bench.watcher(), bench.motion_group.modal
    data = data_of(bench.rapid_task("ROS_motion"), bench.motion_group)
    _, one, *_ = _stand_still(bench, client)
    joints = replace(one, kind=_ABSJ, pose=None, zone=None)
    line = replace(joints, kind=RawInstruction.MOVE_J, pose=reached(bench, one.joints))
    for displacement in _DISPLACED:

        def displace(to: Pose = displacement) -> None:
            modal.displacement = to
            if to == IDENTITY:
                data.external_offset = (0.0, 5.0, 0.0, 0.0, 0.0, 0.0)

        # While the motion task prepares the program.
        at_call(bench, "ROS_motion", "ConfJ", 1, displace)
        number = client.takes("a pose", [line])
        bench.assert_at_rest(halt_timeout(bench), f"poses are displaced by {displacement}")
        reply = bench.progress(watcher)
        if (
            reply[:2] != (number, RawTrajectoryState.FAILED)
            or reply.reason != RawReason.POSE_MISMATCH
        ):
            raise CheckFailed(f"poses are displaced by {displacement}, PROGRESS says {reply}")
        if displacement is _DISPLACED[0]:
            client.takes("joints, which no displacement takes elsewhere", [joints])
            bench.wait_until_at(joints.joints, 60)
            bench.run(halt_timeout(bench))
            back = replace(joints, joints=_stand_joints(bench))
            client.takes("the way back", [back])
            bench.wait_until_at(back.joints, 60)
            bench.run(halt_timeout(bench))
        modal.displacement, data.external_offset = IDENTITY, NO_OFFSETS
    client.takes("a pose that is displaced no more", [line])
    bench.wait_until_at(line.joints, 60)
    bench.run(halt_timeout(bench))
    if (reply := bench.progress(watcher)).state != RawTrajectoryState.DONE:
        raise CheckFailed(f"a pose is displaced no more, PROGRESS says {reply}")


def _stand_joints(bench: Bench) -> tuple[float, ...]:
    return orders(bench, 1, random.Random(61))[0].joints
