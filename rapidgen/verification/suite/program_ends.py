"""What ends or pauses a program: stops, lost clients and errors of instructions."""

import random
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from rapidgen.verification import messages
from rapidgen.verification.batches import millionths, words_frame
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, wrapped
from rapidgen.verification.messages import (
    PROGRAM,
    RawInstruction,
    RawPause,
    RawReason,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.program_steps import (
    ANY_JOINT,
    Ended,
    Followed,
    Go,
    No,
    Program,
    Reached,
    ReachedItems,
    Reasons,
    Since,
    instruction,
)
from rapidgen.verification.raw_programs import (
    ALL,
    Item,
    RawMove,
    computes,
    kinds_with_marks,
    orders,
    reached,
    words,
)
from rapidgen.verification.steps import (
    Ask,
    Disconnect,
    Fails,
    Moving,
    Operator,
    Pass,
    Reconnect,
    Rest,
    Run,
    SetSignal,
    Standing,
    StartAgain,
    Step,
    Stop,
    Works,
    generated,
)
from rapidgen.verification.suite.program_moves import joint_move, to_pose
from rapidgen.verification.suite.speed import aside
from rapidgen.verification.suite.user_routines import knows_these, weld_words
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

ABSJ, MOVE_L, MOVE_C = RawInstruction.MOVE_ABSJ, RawInstruction.MOVE_L, RawInstruction.MOVE_C
WAIT, WAIT_SIGNAL, SET = RawInstruction.WAIT, RawInstruction.WAIT_SIGNAL, RawInstruction.SET
_ASIDE = 0.12
"""rad and m by which a zone cuts a corner, and a line bends between the joints at its ends."""
_FRAME = (0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0)
_FRAMES: tuple[Item, ...] = (
    instruction(RawInstruction.TOOL, *_FRAME, *_FRAME, 1.0, 0.0, 0.0, 0.0),
    instruction(RawInstruction.WORK_OBJECT, *_FRAME, *_FRAME),
)
_PAUSE, _RESUME = Ask(RawPause(1)), Ask(RawPause(0))


# -- stops and lost clients --------------------------------------------------------------------

_ENDINGS: Final[dict[str, tuple[RawReason, tuple[Step, ...]]]] = {
    "STOP": (RawReason.STOPPED, (Stop(),)),
    "STOP on the control port": (RawReason.STOPPED, (Stop(control=True),)),
    "a cut connection": (RawReason.CLIENT_LOST, (Disconnect(),)),
    "e-stop": (RawReason.EMERGENCY_STOP, (Operator("e-stop"),)),
    "stop": (RawReason.PROGRAM_STOPPED, (Operator("stop"),)),
    "a pause and STOP": (RawReason.STOPPED, (_PAUSE, Standing(3), Stop())),
}


def _end(ending: str, at: int, length: int) -> Iterator[Step]:
    """Yield the steps that end a program of `length` items after the first `at`."""
    reason, action = _ENDINGS[ending]
    yield from (Moving(), ReachedItems(at))
    yield from action
    yield from (Standing(10), Pass(0.5), Ended(reason, range(at, length)))


def _endings(bench: Bench) -> list[str]:
    """Return the reported endings.

    Servers of a driver in commissioning stop with the program.
    """
    unreported = ("e-stop", "stop") if bench.config.commissioning else ()
    return [ending for ending in _ENDINGS if ending not in unreported]


@case(
    "program-prefix",
    "what ends a program leaves a prefix of it, with index and reason",
    once=True,
    needs="control",
)
@generated
def _prefix(bench: Bench) -> Iterator[Step]:
    chance = random.Random(5)
    for ending in _endings(bench):
        for at in range(6):
            program = orders(bench, 7, chance)
            yield from (Since(), Program(program))
            yield from _end(ending, at, 7)
            yield from (Rest(1), StartAgain(), Rest(2))
            if ending != "e-stop":
                yield Followed([move.joints for move in program], _ASIDE)
            yield Reconnect()


@case(
    "program-prefix-kinds",
    "what ends a program leaves a prefix of it, at whatever instruction",
    once=True,
    needs="control",
)
@generated
def _kinds(bench: Bench) -> Iterator[Step]:
    """End programs with all instruction kinds; a signal that the program sets fits its progress."""
    chance = random.Random(6)
    outputs = [s.name for s in bench.config.signals if (s.kind, s.access) == ("DO", "write")]
    for ending in _endings(bench):
        length = 30
        for at in range(1, length):
            program, sets = _all_kinds(bench, chance)
            length = len(program)
            if at > length - 2:
                break  # The last one is reached when all are.
            yield from (SetSignal(name, 0) for name in outputs[:1])
            yield Program(program, what=ending)
            yield from _end(ending, at, length)
            yield from (_SetFits(name, sets) for name in outputs[:1])
            yield from (StartAgain(), Rest(1), Reconnect())


class _SetFits:
    """A signal is set if the instruction that sets it was executed."""

    def __init__(self, name: str, sets: int) -> None:
        self._name, self._sets = name, sets

    def play(self, run: Run) -> None:
        """Compare it with PROGRESS."""
        seen, value = run.bench.progress(run.watcher), run.bench.controller.signals[self._name]
        if value != (seen.reached > self._sets) and not seen.reached <= self._sets < seen.planned:
            raise CheckFailed(f"{self._name}, set by {self._sets}, is {value}, PROGRESS: {seen}")


def _all_kinds(bench: Bench, chance: random.Random) -> tuple[list[Item], int]:
    """Return one instruction of each kind, and the number of the one that sets a signal.

    A move comes first and last.
    """
    first, *some, last = orders(bench, 6, chance)
    items: list[Item] = [first, instruction(WAIT, 0.1)]
    sets = [n for n, s in enumerate(bench.config.signals) if (s.kind, s.access) == ("DO", "write")]
    if computes(bench):
        line = replace(some[0], zone=None)
        before, pose = (reached(bench, move.joints) for move in some[:2])
        # So flat that it does not tilt the tool out of a SCARA's reach.
        circle = replace(some[1], kind=MOVE_C, pose=pose, via=aside(before, pose, 0.05))
        items += [instruction(RawInstruction.SETTINGS, 3.0), *_FRAMES, line, circle]
    for number in sets[:1]:
        items += [instruction(SET, number, 1.0), instruction(WAIT_SIGNAL, number, 1.0, 5.0)]
    items += [some[2], some[3], last]
    return items, len(items) - 5 if sets else len(items)


@case("program-paused", "a paused program goes on where it was", needs="control")
@generated
def _paused(bench: Bench) -> Iterator[Step]:
    program = orders(bench, 4, random.Random(9))
    yield from (Since(), Program(program))
    for at in (0, 1):
        yield from (Moving(), ReachedItems(at), _PAUSE, Standing(3), Rest(1), _RESUME)
    yield from (Reached(program[-1].joints), Followed([o.joints for o in program], _ASIDE))


# -- errors of instructions --------------------------------------------------------------------

_READS = ("UnpackRawBytes", "DnumToNum", "NOrient", "ByteToStr", "VectMagn", "CalcRobT")
_NO_GEOMETRY = ("VectMagn", "CalcRobT")
"""Functions that may fail while a pose is compared with its joints."""


@case("program-reading-fails", "an instruction that cannot be read moves nothing", once=True)
@generated
def _reading_fails(bench: Bench) -> Iterator[Step]:
    """Fail at any word while reading: nothing moves, the next program works."""
    items = _everything(bench)
    reason = RawReason.NO_ROUTINE if knows_these(bench) else RawReason.NO_INSTRUCTION
    last = No(reason, len(items) - 1)
    yield Reconnect(0)
    for name in _READS:
        allowed = (RawReason.CHECKSUM, *((RawReason.NO_GEOMETRY,) * (name in _NO_GEOMETRY)))
        calls = _Calls(bench, name)
        yield from (Program(items, last), Reconnect(1.5))
        for after in range(calls.end()):
            yield Fails("ROS_motionServer", name, after=after)
            yield from (_Unread(items, allowed), Works(), Reconnect(0.3))
    yield from (Standing(1), Rest(1), Go(orders(bench, 2, random.Random(41))))


class _Calls:
    """Counts how often the motion server calls something, until `end`."""

    def __init__(self, bench: Bench, name: str) -> None:
        self._number, self._counting = 0, True

        def counted(as_before: Instruction) -> Instruction:
            def counting(*arguments: object) -> object:
                self._number += self._counting
                return as_before(*arguments)

            return counting

        wrapped(bench.rapid_task("ROS_motionServer"), name, counted)

    def end(self) -> int:
        """Return the number of calls."""
        self._counting = False
        return self._number


class _Unread:
    """Send a program that cannot be read: it is rejected, or the client is disconnected."""

    def __init__(self, items: Sequence[Item], reasons: Reasons) -> None:
        self._items, self._reply = items, No(reasons, joint=ANY_JOINT)

    def play(self, run: Run) -> None:
        """Send it in one message."""
        link, run.client.number = run.link, 1
        values = [*millionths(run.bench.position), *(w for i in self._items for w in words(i))]
        link.send(words_frame(1, 0, len(self._items), values, ALL, number=PROGRAM))
        run.bench.until(lambda: link.lost or bool(link.frames), 4, "an answer comes")
        if not link.lost:
            reply = link.reply(PROGRAM)
            if not isinstance(reply, messages.RawPointsRefused):
                raise CheckFailed(f"the reply is {reply}")
            replace(self._reply, index=reply.point).check(reply._replace(stream=1), run, 0)


def _everything(bench: Bench) -> list[Item]:
    """Return a program of every instruction, the last one invalid."""
    current = bench.position
    move = RawMove(ABSJ, current, None, frames=(0, 0))
    items: list[Item] = [move, instruction(WAIT, 0.1)]
    signals = bench.config.signals
    written = [n for n, s in enumerate(signals) if s.access == "write" and s.kind[1] == "O"]
    waited = [n for n, s in enumerate(signals) if s.kind[0] != "A"]
    if computes(bench):
        pose = reached(bench, current)
        marks = ((float(written[0]), 1.0, 0.0, 0.01),) if written else ()
        end = to_pose(
            bench, replace(move, joints=orders(bench, 2, random.Random(52))[1].joints), MOVE_C
        )
        assert end.pose is not None
        items += [
            instruction(RawInstruction.SETTINGS, 0.0),
            *_FRAMES,
            replace(move, kind=MOVE_L, pose=pose, marks=marks),
            replace(end, marks=marks, via=aside(pose, end.pose)),
        ]
        if marks and ABSJ in kinds_with_marks(bench):
            items.append(replace(move, marks=marks))
    items += [instruction(SET, number, 1.0) for number in written[:1]]
    items += [instruction(WAIT_SIGNAL, number, 1, 1) for number in waited[:1]]
    # The routine's module is missing.
    call = [*instruction(RawInstruction.CALL, 0.0, 0.0), *weld_words(1.0)]
    return [*items, call if knows_these(bench) else [99]]


@case("program-instructions-fail", "an instruction that fails ends its program with its reason")
@generated
def _instructions_fail(bench: Bench) -> Iterator[Step]:
    """Fail an instruction in execution.

    The instruction before it is executed, none after it; the next program works.
    """
    first, second, third = orders(bench, 4, random.Random(42))[1:]
    # All of them start with the same speed, zone and frames.
    place, then = joint_move(first), joint_move(third, third.zone)
    for name, error, reason, item in _failing(bench, first, second):
        yield Fails("ROS_motion", name, error, after=int(name == "MoveAbsJ"))
        yield Program([place, item, then], what=f"{name} fails with {error}")
        yield from (Ended(reason, 1, RawTrajectoryState.FAILED, within=20), Works())
        if name not in _MOVES:
            yield Rest(0.5)
    yield from (Standing(2), Rest(1), Go([first, second]))


_SETS = {"DO": "SetDO", "GO": "SetGO", "AO": "SetAO"}
_WAITS = {"DI": "WaitDI", "DO": "WaitDO", "GI": "WaitGI", "GO": "WaitGO"}
_MOVES = {
    "MoveAbsJ": ABSJ,
    "MoveJ": RawInstruction.MOVE_J,
    "MoveL": MOVE_L,
    "MoveC": MOVE_C,
}


def _failing(
    bench: Bench, current: RawMove, target: RawMove
) -> Iterator[tuple[str, str, RawReason, Item]]:
    """Yield failing instruction, error, reason and item."""
    yield "MoveAbsJ", "ERR_COLL_STOP", RawReason.COLLISION, joint_move(target)
    signals = bench.config.signals
    written = [n for n, s in enumerate(signals) if s.access == "write" and s.kind[1] == "O"]
    for number, signal in enumerate(signals):
        if number in written:
            sets = instruction(SET, number, 1.0)
            yield _SETS[signal.kind], "ERR_NORUNUNIT", RawReason.BAD_VALUE, sets
        if signal.kind in _WAITS:
            waits = instruction(WAIT_SIGNAL, number, 1.0, 1.0)
            yield _WAITS[signal.kind], "ERR_NORUNUNIT", RawReason.NO_SIGNAL, waits
            yield _WAITS[signal.kind], "ERR_WAIT_MAXTIME", RawReason.WAITED, waits
    if not computes(bench):
        return
    pose = reached(bench, target.joints)
    path = aside(reached(bench, current.joints), pose)
    for name, kind in _MOVES.items():
        if kind not in kinds_with_marks(bench) or kind is ABSJ:
            continue
        via = path if kind is MOVE_C else None
        move = replace(target, kind=kind, pose=pose, via=via, zone=None)
        yield name, "ERR_PATH_STOP", RawReason.MOTION_ERROR, move
        for number in written[:1]:
            marked = replace(move, marks=((float(number), 1.0, 0.0, 0.001),))
            yield name.replace("Move", "Trigg"), "ERR_PATH_STOP", RawReason.MOTION_ERROR, marked
            yield "TriggIO", "ERR_NORUNUNIT", RawReason.BAD_VALUE, marked
