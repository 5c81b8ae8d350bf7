"""Signals and settings of programs: set on the path or at rest, waited for, reset."""

import math
import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from rapidgen.config.model import ExposedSignal
from rapidgen.motion.moves import Singularities
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawModal, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Position
from rapidgen.verification.program_steps import (
    CornersMade,
    Ended,
    Go,
    No,
    Program,
    Reached,
    instruction,
    right,
)
from rapidgen.verification.raw_programs import (
    RawMove,
    computes,
    kinds_with_marks,
    orders,
    reached,
)
from rapidgen.verification.steps import (
    Elsewhere,
    Moving,
    Pass,
    Rest,
    Run,
    SetSignal,
    SignalIs,
    Standing,
    Step,
    Stop,
    generated,
)
from rapidgen.verification.suite.program_moves import joint_move, to_pose
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

ABSJ, MOVE_J = RawInstruction.MOVE_ABSJ, RawInstruction.MOVE_J
MOVE_L, MOVE_C = RawInstruction.MOVE_L, RawInstruction.MOVE_C
SET, WAIT_SIGNAL, SETTINGS = RawInstruction.SET, RawInstruction.WAIT_SIGNAL, RawInstruction.SETTINGS
NO_SIGNAL, READ_ONLY, BAD_VALUE = RawReason.NO_SIGNAL, RawReason.READ_ONLY, RawReason.BAD_VALUE
START, END, TIME = 0.0, 1.0, 2.0
"""Where a signal is set: m after the start, m before the end, s before it."""
_AWAY = 0.003
"""m and s by which a signal may be late or early."""
_IMPOSSIBLE = {"DO": (2.0, 0.5, -1.0), "GO": (-1.0, 0.5)}
"""Values that a signal of a type cannot have."""


def _written(signal: ExposedSignal) -> bool:
    """True if programs may set it."""
    return signal.access == "write" and signal.kind[1] == "O"


# -- on the path -------------------------------------------------------------------------------


@case("program-signals", "signals are set on the way of a move, at its distances and times")
@generated
def _signals(bench: Bench) -> Iterator[Step]:
    """Set each writable signal on a line and a joint move; reject others."""
    first, *_, last = orders(bench, 4, random.Random(21))
    yield Go([first])
    written = [n for n, signal in enumerate(bench.config.signals) if _written(signal)]
    if not written or not computes(bench):
        marked = replace(first, marks=((0.0, 1.0, START, 0.01),))
        yield Program([marked], No((*RawReason,)), "no signal is set on a path here")
        return
    there = replace(last, speed=0.1)
    back = replace(there, joints=first.joints)
    middle = [(a + b) / 2 for a, b in zip(first.joints, last.joints, strict=True)]
    (x, y, z), turned = reached(bench, tuple(middle))
    via = ((x, y, z + 0.01), turned)

    def made(move: RawMove, kind: RawInstruction) -> RawMove:
        """Return the move of another kind, to the same place."""
        if kind is ABSJ:
            return joint_move(move, move.zone)
        return replace(to_pose(bench, move, kind), via=via if kind is MOVE_C else None)

    # A circle that is not level turns the tool out of a SCARA's reach.
    level = bench.motion_group.map.two_sided
    kinds = [k for k in kinds_with_marks(bench) if k is not MOVE_C or not level]
    for kind in kinds:
        for number in written:
            yield _SetOnTheWay(made(there, kind), first.joints, number)
            yield _SetOnTheWay(made(back, kind), there.joints, number)
    for kind in kinds:
        if kind is not ABSJ:
            yield from (
                Go([joint_move(first, first.zone)], then=0.5),
                _Eight(made(there, kind), written[0]),
            )
    line, output = made(back, MOVE_L), float(written[0])
    for reason, marks in _wrong_marks(bench, output):
        yield Program([replace(line, marks=marks)], No(reason), f"signals {marks}")
    far = ((output, 1.0, START, 10.0), (output, 1.0, END, 0.0))
    yield right([replace(line, marks=far)])
    words = instruction(RawInstruction.WAIT, 1, output, 1, START, 0.01, 0.5)
    words[0] |= RawModal.SIGNALS
    yield Program([words], No(RawReason.NO_INSTRUCTION), "a signal on the path of a wait")
    for move in (made(there, MOVE_J), first):
        if move.kind not in kinds:
            marked = replace(move, marks=((output, 1.0, START, 0.01),))
            yield Program([marked], No(RawReason.NO_INSTRUCTION), "on the path of a joint move")
    yield Rest(0.5)


@contextmanager
def _noted(bench: Bench, number: int) -> Iterator[list[tuple[float, float, Position]]]:
    """Yield the changes of an exposed signal: value, time, position of the robot."""
    signal = bench.controller.io[bench.config.signals[number].name]
    bench.controller.io.set(signal, 0)
    seen: list[tuple[float, float, Position]] = []

    def note() -> None:
        seen.append((signal.value, bench.now, tuple(bench.motion_group.commanded())))

    signal.changed.add(note)
    yield seen
    signal.changed.remove(note)


class _SetOnTheWay:
    """Set one signal at three places of a move from `start`."""

    def __init__(self, move: RawMove, start: Position, number: int) -> None:
        self._move, self._start, self._number = move, start, number

    def play(self, run: Run) -> None:
        """Compare the places on a line, and the time before the end."""
        bench, number = run.bench, float(self._number)
        places = ((START, 0.01), (END, 0.015), (TIME, 0.05))
        marks = [(number, float(v), *at) for v, at in zip((1, 0, 1), places, strict=True)]
        with _noted(bench, self._number) as seen:
            Go([replace(self._move, marks=tuple(marks))]).play(run)
            finished = bench.track[-1][0]
        if [value for value, _, _ in seen] != [1, 0, 1]:
            raise CheckFailed(f"signal {number} was to be 1, 0, 1 on the way, and was {seen}")
        (_, _, on), (_, _, off), (_, when, _) = seen
        ends = bench.tcp(self._start), bench.tcp(self._move.joints)
        far = (math.dist(ends[0], bench.tcp(on)), math.dist(ends[1], bench.tcp(off)))
        straight = self._move.kind is MOVE_L
        if straight and max(abs(far[0] - 0.01), abs(far[1] - 0.015)) > _AWAY:
            raise CheckFailed(f"it was set {far} m from the ends, not 0.01 and 0.015")
        if not 0 < finished - when < 0.3:
            raise CheckFailed(f"it was set {finished - when:.3f} s before the end, not 0.05")


class _Eight:
    """Set as many signals as one move allows, on four moves in sequence."""

    def __init__(self, move: RawMove, number: int) -> None:
        self._move, self._number = move, number

    def play(self, run: Run) -> None:
        """Move there and back."""
        bench, n = run.bench, float(self._number)
        marks = tuple((n, float((i + 1) % 2), START, 0.001 + 0.002 * i) for i in range(8))
        back = replace(self._move, joints=bench.position, pose=reached(bench, bench.position))
        # One message holds three circles.
        moves = (self._move, back) * (1 if self._move.via is not None else 2)
        with _noted(bench, self._number) as seen:
            Program([replace(move, marks=marks) for move in moves]).play(run)
            Ended(None, state=RawTrajectoryState.DONE, within=60).play(run)
        if [value for value, _, _ in seen] != [1, 0] * 4 * len(moves):
            raise CheckFailed(f"it was to change 8 times on each move, and was {seen}")


def _wrong_marks(
    bench: Bench, number: float
) -> Iterator[tuple[RawReason, tuple[tuple[float, ...], ...]]]:
    """Yield invalid signals and places on a path."""
    exposed = bench.config.signals
    for absent in (float(len(exposed)), -1.0):
        yield NO_SIGNAL, ((absent, 1.0, START, 0.01),)
    for place in ((START, -0.001), (START, 10.001), (3.0, 0.01), (0.5, 0.01)):
        yield BAD_VALUE, ((number, 1.0, *place),)
    yield BAD_VALUE, ((number, 1.0, START, 0.01),) * 9
    for index, signal in enumerate(exposed):
        if not _written(signal):
            yield READ_ONLY, ((float(index), 1.0, START, 0.01),)
            continue
        for value in _IMPOSSIBLE.get(signal.kind, ()):
            yield BAD_VALUE, ((float(index), value, START, 0.01),)


# -- at rest -----------------------------------------------------------------------------------


@case("program-sets", "a program sets signals and waits for them at rest")
@generated
def _sets(bench: Bench) -> Iterator[Step]:
    """Set a signal after a stop point; wait; time-out; STOP ends the wait."""
    exposed = bench.config.signals
    target = replace(orders(bench, 2, random.Random(22))[0], zone=0.01)
    for reason, items in _wrong_instructions(exposed):
        yield Program([items], No(reason), f"{items[0]} {items[1:]}")
    for index, signal in enumerate(exposed):
        if _written(signal):
            yield from (SetSignal(signal.name, 0), Program([target, instruction(SET, index, 1.0)]))
            yield from (Reached(target.joints), Pass(0.5), SignalIs(signal.name, 1))
    for index, signal in enumerate(exposed):
        if signal.kind[0] == "A":
            continue
        if signal.name in bench.controller.signals:
            now = float(bench.controller.signals[signal.name])
            yield Program([target, instruction(WAIT_SIGNAL, index, now, 0.0)])
            yield Reached(target.joints)
        if signal.kind[1] == "I":
            yield from _wait(bench, index, signal.name)
    if exposed:
        yield CornersMade()


def _wrong_instructions(
    exposed: Sequence[ExposedSignal],
) -> Iterator[tuple[RawReason, list[int]]]:
    """Yield instructions about signals that are rejected."""
    for index, signal in enumerate(exposed):
        impossible = _IMPOSSIBLE.get(signal.kind, ())
        if not _written(signal):
            yield READ_ONLY, instruction(SET, index, 1.0)
        else:
            yield from ((BAD_VALUE, instruction(SET, index, value)) for value in impossible)
        if signal.kind[0] == "A":
            yield BAD_VALUE, instruction(WAIT_SIGNAL, index, 1.0, 1.0)
            continue
        for value in (*impossible, -1.0):
            yield BAD_VALUE, instruction(WAIT_SIGNAL, index, value, 1.0)
        for seconds in (-1.0, 2001.0):
            yield BAD_VALUE, instruction(WAIT_SIGNAL, index, 1.0, seconds)
    if exposed:
        yield NO_SIGNAL, instruction(SET, len(exposed), 1.0)
        yield NO_SIGNAL, instruction(WAIT_SIGNAL, len(exposed), 1.0, 1.0)


def _wait(bench: Bench, index: int, name: str) -> Iterator[Step]:
    """Yield waits for a signal: it comes, it does not come, STOP comes."""
    target = joint_move(orders(bench, 2, random.Random(23))[1])
    away = replace(target, joints=orders(bench, 1, random.Random(0))[0].joints)
    waits = instruction(WAIT_SIGNAL, index, 1.0, 100.0)
    yield from (SetSignal(name, 0), Program([waits, target]), Rest(1), SetSignal(name, 1))
    yield from (Reached(target.joints), SetSignal(name, 0))
    yield Program([instruction(WAIT_SIGNAL, index, 1.0, 0.5), target])
    yield from (Rest(2), Ended(RawReason.WAITED, 0))
    yield from (Program([waits, away]), Pass(0.5), Stop(), SetSignal(name, 1), Rest(2))
    yield Ended(RawReason.STOPPED)


@case("program-without-signals", "a signal that the controller does not have ends its program")
@generated
def _without(bench: Bench) -> Iterator[Step]:
    """Use signals that do not exist: failures; the others work."""
    exposed = bench.config.signals
    if not exposed:
        raise NotApplicable("no signal is exposed")
    for index, signal in enumerate(exposed):
        signals = tuple(s for s in bench.system.signals if s.name != signal.name)
        yield Elsewhere(replace(bench.system, signals=signals), _one_without(index, signal))


def _one_without(index: int, signal: ExposedSignal) -> Callable[[Bench], Iterator[Step]]:
    """Return the steps on a controller that does not have this signal."""

    def steps(bench: Bench) -> Iterator[Step]:
        first, second, *_ = orders(bench, 4, random.Random(26))
        fails = (Rest(1), Ended(NO_SIGNAL, 0))
        yield Go([first])
        if _written(signal):
            yield from (Program([instruction(SET, index, 1.0)]), *fails)
            if computes(bench):
                line = to_pose(bench, second, MOVE_L)
                marks = ((float(index), 1.0, START, 0.01),)
                yield from (Program([replace(line, marks=marks)]), *fails)
        if signal.kind[0] != "A":
            yield from (Program([instruction(WAIT_SIGNAL, index, 1.0, 5.0), second]), *fails)
        for number, other in enumerate(bench.config.signals):
            if number == index:
                continue
            if other.kind[0] != "A":
                now = float(bench.controller.signals[other.name])
                yield from (Program([instruction(WAIT_SIGNAL, number, now, 0.5)]), Pass(0.5))
                yield Ended(None, state=RawTrajectoryState.DONE)
            if other.access == "write":
                yield from (Program([instruction(SET, number, 1.0)]), Pass(0.5))
                yield SignalIs(other.name, 1)

    return steps


# -- settings ----------------------------------------------------------------------------------


@case("program-settings", "singularities and configurations are allowed on request alone")
@generated
def _settings(bench: Bench) -> Iterator[Step]:
    """Apply settings from the instruction to the program's end.

    The program ends normally, or by a stop.
    """
    modal = bench.motion_group.modal
    if bench.motion_group.kinematics is None:
        yield Program([instruction(SETTINGS, 0.0)], No(RawReason.NO_INSTRUCTION))
        return
    target = joint_move(orders(bench, 2, random.Random(27))[1])
    for value in (4.0, -1.0, 0.5):
        yield Program([instruction(SETTINGS, value)], No(BAD_VALUE))
    for bits in (None, *range(4)):
        start = replace(target, joints=bench.position)
        # As a user routine may have left them.
        modal.check_joint = modal.check_linear = False
        modal.singularities = Singularities.WRIST
        before = [] if bits is None else [instruction(SETTINGS, bits)]
        yield from (Program([*before, target]), Moving(), _Allowed(bits or 0))
        yield Stop() if bits == 3 else Reached(target.joints)
        yield from (Standing(10), Pass(0.5), _Allowed(0))
        target = start


class _Allowed:
    """Singularities (1) and changes of configuration (2) are allowed; ConfJ is on."""

    def __init__(self, bits: int) -> None:
        self._bits = bits

    def play(self, run: Run) -> None:
        """Compare the settings of the motion task."""
        modal = run.bench.motion_group.modal
        now = (modal.singularities is Singularities.WRIST) + 2 * (not modal.check_linear)
        if now != self._bits or not modal.check_joint:
            raise CheckFailed(
                f"settings {self._bits} are right, {now} apply, ConfJ {modal.check_joint}"
            )
