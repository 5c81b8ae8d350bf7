"""Programs on a controller with errors, while read and while executed."""

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from rapidgen.verification import messages
from rapidgen.verification.batches import millionths, words_frame
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, fails, wrapped
from rapidgen.verification.messages import PROGRAM, RawInstruction, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import (
    ALL,
    Programmer,
    RawMove,
    computes,
    kinds_with_marks,
    orders,
    reached,
)
from rapidgen.verification.suite.speed import aside
from rapidgen.verification.suite.user_routines import knows_these, weld_words
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

_READS = ("UnpackRawBytes", "DnumToNum", "NOrient", "ByteToStr", "VectMagn", "CalcRobT")
_NO_GEOMETRY = ("VectMagn", "CalcRobT")
"""Functions that may fail while a pose is compared with its joints."""
_SETS = {"DO": "SetDO", "GO": "SetGO", "AO": "SetAO"}
_WAITS = {"DI": "WaitDI", "DO": "WaitDO", "GI": "WaitGI", "GO": "WaitGO"}


@case("program-reading-fails", "an instruction that cannot be read moves nothing", once=True)
def _reading_fails(bench: Bench) -> None:
    """Fail at any word while reading: nothing moves, the next program works."""
    values, count = _everything(bench)
    for name in _READS:
        for after in range(_calls(bench, name, values, count)):
            link = bench.motion()
            ends = fails(bench, "ROS_motionServer", name, "ERR_OUTOFBND", after=after)
            link.send(words_frame(1, 0, count, values, ALL, number=PROGRAM))
            bench.until(partial(_answered, link), 4, f"{name} has failed; an answer comes")
            ends()
            if not link.lost:
                answer = link.reply(PROGRAM)
                allowed = {RawReason.CHECKSUM}
                if name in _NO_GEOMETRY:
                    allowed.add(RawReason.NO_GEOMETRY)
                if (
                    not isinstance(answer, messages.RawPointsRefused)
                    or answer.reason not in allowed
                ):
                    raise CheckFailed(
                        f"{name} number {after + 1} has failed, the reply is {answer}"
                    )
                link.close()
            bench.run(0.3)
    bench.wait_until_at_rest(1, 1, "no program could be read")
    _serves(bench)


def _answered(link: RawLink) -> bool:
    return link.lost or bool(link.frames)


def _everything(bench: Bench) -> tuple[list[int], int]:
    """Return a program of every instruction, the last one invalid."""
    current = bench.position
    order = RawMove(RawInstruction.MOVE_ABSJ, current, None, frames=(0, 0))
    parts: list[list[int]] = [order.words, [RawInstruction.WAIT, *millionths([0.1])]]
    signals = bench.config.signals
    written = [n for n, s in enumerate(signals) if s.access == "write" and s.kind[1] == "O"]
    waited = [n for n, s in enumerate(signals) if s.kind[0] != "A"]
    if computes(bench):
        turned = [1.0, 0.0, 0.0, 0.0]
        frame = [0.0, 0.0, 0.1, *turned]
        parts += [
            [RawInstruction.SETTINGS, *millionths([0.0])],
            [RawInstruction.TOOL, *millionths([*frame, *frame, 1.0, 0.0, 0.0, 0.0])],
            [RawInstruction.WORK_OBJECT, *millionths([*frame, *frame])],
        ]
        pose = reached(bench, current)
        marks = ((float(written[0]), 1.0, 0.0, 0.01),) if written else ()
        parts.append(replace(order, kind=RawInstruction.MOVE_L, pose=pose, marks=marks).words)
        target = orders(bench, 2, random.Random(52))[1].joints
        circle = replace(order, kind=RawInstruction.MOVE_C, joints=target, marks=marks)
        end = reached(bench, target)
        parts.append(replace(circle, pose=end, via=aside(pose, end)).words)
        if marks and order.kind in kinds_with_marks(bench):
            parts.append(replace(order, marks=marks).words)
    parts += [[RawInstruction.SET, *millionths([float(n), 1.0])] for n in written[:1]]
    parts += [[RawInstruction.WAIT_SIGNAL, *millionths([float(n), 1, 1])] for n in waited[:1]]
    if knows_these(bench):
        # The routine's module is missing.
        parts.append([RawInstruction.CALL, *millionths([0.0, 0.0]), *weld_words(1.0)])
    else:
        parts.append([99])
    return [*millionths(current), *(word for part in parts for word in part)], len(parts)


def _calls(bench: Bench, name: str, values: list[int], count: int) -> int:
    """Return how often the motion server calls something for a program."""
    number = 0

    def counted(as_before: Instruction) -> Instruction:
        def counting(*arguments: object) -> object:
            nonlocal number
            number += 1
            return as_before(*arguments)

        return counting

    wrapped(bench.rapid_task("ROS_motionServer"), name, counted)
    link = bench.motion()
    link.send(words_frame(1, 0, count, values, ALL, number=PROGRAM))
    reason = RawReason.NO_ROUTINE if knows_these(bench) else RawReason.NO_INSTRUCTION
    Programmer(bench, link).refused(link.reply(PROGRAM, 5), reason, count - 1, "the last one")
    link.close(then=1.5)
    return number


_FAILING = {
    "MoveAbsJ": RawInstruction.MOVE_ABSJ,
    "MoveJ": RawInstruction.MOVE_J,
    "MoveL": RawInstruction.MOVE_L,
    "MoveC": RawInstruction.MOVE_C,
}


@case("program-instructions-fail", "an instruction that fails ends its program with its reason")
def _instructions_fail(bench: Bench) -> None:
    """Fail an instruction in execution.

    The instruction before it is executed, none after it; the next program works.
    """
    first, second, third = orders(bench, 4, random.Random(42))[1:]
    client, watcher = Programmer(bench), bench.watcher()
    for name, error, reason, values in _due(bench, first, second):
        end = fails(bench, "ROS_motion", name, error, after=int(name == "MoveAbsJ"))
        place = replace(first, kind=RawInstruction.MOVE_ABSJ, pose=None, zone=None)
        client.number += 1
        then = replace(third, kind=RawInstruction.MOVE_ABSJ, pose=None)
        # All of them start with the same speed, zone and frames.
        own = [*millionths(bench.position), *place.words, *values, *then.words]
        reply = client.say(own, 3, ALL)
        if not isinstance(reply, messages.RawPointsAccepted):
            raise CheckFailed(f"{name} was right, the reply is {reply}")
        for _ in range(200):
            seen = bench.progress(watcher)
            if seen.state == RawTrajectoryState.FAILED and seen.trajectory == reply.trajectory:
                break
        end()
        if (seen.reason, seen.reached) != (reason, 1):
            raise CheckFailed(f"{name} has failed with {error}, PROGRESS says {seen}")
        if name not in _FAILING:
            bench.assert_at_rest(0.5, f"{name} has failed")
    bench.wait_until_at_rest(2, 1, "the programs have ended")
    client.takes("a program after one that failed", [first, second])
    bench.wait_until_at(second.joints, 60)


def _due(
    bench: Bench, current: RawMove, target: RawMove
) -> Iterator[tuple[str, str, RawReason, list[int]]]:
    """Yield failing instruction, error, reason and words."""
    moved = replace(target, zone=None)
    joints = replace(moved, kind=RawInstruction.MOVE_ABSJ, pose=None)
    yield "MoveAbsJ", "ERR_COLL_STOP", RawReason.COLLISION, joints.words
    signals = bench.config.signals
    written = [n for n, s in enumerate(signals) if s.access == "write" and s.kind[1] == "O"]
    for number, signal in enumerate(signals):
        if number in written:
            values = [RawInstruction.SET, *millionths([float(number), 1.0])]
            yield _SETS[signal.kind], "ERR_NORUNUNIT", RawReason.BAD_VALUE, values
        if signal.kind in _WAITS:
            values = [RawInstruction.WAIT_SIGNAL, *millionths([float(number), 1.0, 1.0])]
            yield _WAITS[signal.kind], "ERR_NORUNUNIT", RawReason.NO_SIGNAL, values
            yield _WAITS[signal.kind], "ERR_WAIT_MAXTIME", RawReason.WAITED, values
    if not computes(bench):
        return
    pose = reached(bench, target.joints)
    path = aside(reached(bench, current.joints), pose)
    for name, kind in _FAILING.items():
        if kind not in kinds_with_marks(bench) or kind is RawInstruction.MOVE_ABSJ:
            continue
        via = path if kind is RawInstruction.MOVE_C else None
        order = replace(moved, kind=kind, pose=pose, via=via)
        yield name, "ERR_PATH_STOP", RawReason.MOTION_ERROR, order.words
        for number in written[:1]:
            marked = replace(order, marks=((float(number), 1.0, 0.0, 0.001),)).words
            yield name.replace("Move", "Trigg"), "ERR_PATH_STOP", RawReason.MOTION_ERROR, marked
            yield "TriggIO", "ERR_NORUNUNIT", RawReason.BAD_VALUE, marked


def _serves(bench: Bench) -> None:
    program = orders(bench, 2, random.Random(41))
    client = Programmer(bench)
    client.takes("a program after one that failed", program)
    bench.wait_until_at(program[-1].joints, 60)
    client.link.close(then=1.5)
