"""User routines called by programs: arguments, results, errors, ends."""

import math
import random
import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

from rapidgen.axes.frames import IDENTITY
from rapidgen.config.model import UserRoutine
from rapidgen.runtime.builtins.motion.targets import data_of
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    RawFailure,
    RawInstruction,
    RawNotDone,
    RawPointsRefused,
    RawReason,
    RawResult,
    RawResultReply,
    RawSpeed,
    RawTarget,
    RawTargetReply,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.program_steps import (
    TAKEN,
    Ended,
    Go,
    No,
    Program,
    Reached,
    instruction,
)
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import RawMove, computes, orders, reached
from rapidgen.verification.steps import (
    Ask,
    Elsewhere,
    MovesOn,
    Pass,
    Rest,
    Run,
    Step,
    Stop,
    generated,
)
from rapidgen.verification.suite.program_moves import joint_move, to_pose
from rapidgen.verification.testbench import Bench

case = SuiteGroup("own routines", needs="stream")

_MODULE = b"""MODULE cell
    PERS num calls := 0;
    PERS bool undone := FALSE;
    VAR errnum weld_failed := -1;

    PROC weld(INOUT num seam, bool dry, INOUT bool good, INOUT string note)
        calls := calls + 1;
        IF weld_failed = -1 BookErrNo weld_failed;
        IF seam < 0 RAISE weld_failed;
        seam := 2 * seam;
        good := (good = dry);
        note := note + note;
    ERROR
        RAISE;
    ENDPROC

    PROC teach(INOUT robtarget there, INOUT jointtarget place, INOUT jointtarget back)
        VAR jointtarget other;

        there.trans.x := there.trans.x + 250;
        there.robconf := [-1,2,-3,4];
        other := place;
        place := back;
        back := other;
    ENDPROC

    PROC wait_long()
        undone := FALSE;
        WaitTime 8;
        calls := calls + 1;
    UNDO
        undone := TRUE;
    ENDPROC
ENDMODULE
"""
WELD, LONG, ABSENT, TEACH = range(4)
"""Numbers of the routines in the configuration for these cases (tools/cell.yaml)."""
_THESE = {
    "cell:weld": ("num", "bool", "bool", "string"),
    "cell:wait_long": (),
    "nocell:weld": (),
    "cell:teach": ("robtarget", "jointtarget", "jointtarget"),
}
_HALF = math.sqrt(0.5)
_DISPLACEMENTS = (
    ((0.05, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
    ((0.0, 0.0, 0.0), (_HALF, 0.0, 0.0, _HALF)),
)
"""Of a user program: position (m) and orientation of a robtarget's zero."""
_HOLDERS = ("cell", "nocell")


WELD, LONG, ABSENT, TEACH = range(4)
"""Numbers of the routines in the configuration for these cases (tools/cell.yaml)."""
_THESE = {
    "cell:weld": ("num", "bool", "bool", "string"),
    "cell:wait_long": (),
    "nocell:weld": (),
    "cell:teach": ("robtarget", "jointtarget", "jointtarget"),
}
_HALF = math.sqrt(0.5)
_DISPLACEMENTS = (
    ((0.05, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
    ((0.0, 0.0, 0.0), (_HALF, 0.0, 0.0, _HALF)),
)
"""Of a user program: position (m) and orientation of a robtarget's zero."""
_HOLDERS = ("cell", "nocell")
BAD_VALUE, NO_ROUTINE = RawReason.BAD_VALUE, RawReason.NO_ROUTINE
POSE_MISMATCH = RawReason.POSE_MISMATCH


def knows_these(bench: Bench) -> bool:
    """True if the configuration's routines are those of this module."""
    own = {r.call: tuple(p.type for p in r.parameters) for r in bench.group.routines}
    return own == _THESE and list(own) == list(_THESE)


def _has_these(bench: Bench) -> bool:
    """True if it is so, and the motion task has the module."""
    return knows_these(bench) and bench.setting.dialect.installed_modules_exist


def _needs_these(make: Callable[[Bench], Iterator[Step]]) -> Callable[[Bench], None]:
    """Return the function of a case with these steps on a controller that has the module."""

    @generated
    def steps(bench: Bench) -> Iterator[Step]:
        if not _has_these(bench):
            raise NotApplicable("the routines that are tried are not in the configuration")
        yield Elsewhere(_with_modules(bench, _CELL), make)

    return steps


def call(number: int, arguments: Sequence[int] = (), *, seconds: float = 0.0) -> list[int]:
    """Return the words of a call, which may take so long; 0: as long as it takes."""
    return [*instruction(RawInstruction.CALL, number, seconds), *arguments]


def weld_words(seam: float, *, dry: int = 0, good: int = 0, text: str = "ab") -> list[int]:
    """Return words of weld's arguments: a num as float32, two bools, a text."""
    number = struct.unpack("<i", struct.pack("<f", seam))[0]
    letters = text.encode() + bytes(-len(text) % 4)
    return [
        number,
        *millionths([float(dry), float(good), float(len(text))]),
        *struct.unpack(f"<{len(letters) // 4}i", letters),
    ]


def _zeros(bench: Bench, routine: UserRoutine) -> list[int]:
    """Return argument words for any routine: zeros and the robot's position."""
    current = bench.position
    values: dict[str, list[float]] = {
        "num": [0.0],
        "bool": [0.0],
        "string": [0.0],
        "jointtarget": list(current),
    }
    if any(p.type == "robtarget" for p in routine.parameters):
        (x, y, z), turn = reached(bench, current)
        values["robtarget"] = [x, y, z, *turn, *current]
    return [w for p in routine.parameters for w in millionths(values[p.type])]


def _with_modules(bench: Bench, *more: ModuleFile) -> System:
    """Return the system with these additional modules in the motion task."""
    tasks = tuple(
        replace(task, modules=(*task.modules, *more)) if task.name == bench.group.task else task
        for task in bench.system.tasks
    )
    return replace(bench.system, tasks=tasks)


_CELL = ModuleFile("cell", "cell.mod", _MODULE)
_EMPTY = tuple(ModuleFile(n, f"{n}.mod", f"MODULE {n}\nENDMODULE\n".encode()) for n in _HOLDERS)


# -- absent routines ---------------------------------------------------------------------------


@case("routine-absent", "a routine of a module that is not there refuses its program")
@generated
def _absent(bench: Bench) -> Iterator[Step]:
    """Reject absent routines at once with index; without routines, no CALL."""
    if not bench.group.routines:
        yield Program([call(LONG)], No(RawReason.NO_INSTRUCTION), "a driver without routines")
        return
    for number, routine in enumerate(bench.group.routines):
        poses = any(p.type == "robtarget" for p in routine.parameters)
        if ":" in routine.call and not routine.returns and (computes(bench) or not poses):
            yield Program([call(number, _zeros(bench, routine))], No(NO_ROUTINE), routine.call)
    if _has_these(bench):
        yield Elsewhere(_with_modules(bench, _CELL), _wrong_calls)
    elif knows_these(bench):
        # The configuration does not list the module.
        unlisted = Program([call(WELD, weld_words(1.0))], No(NO_ROUTINE))
        yield Elsewhere(_with_modules(bench, _CELL), lambda _: (unlisted,))


def _wrong_calls(_: Bench) -> Iterator[Step]:
    """Yield calls that are rejected where the module is."""
    for number in (ABSENT, 4, -1):
        yield Program([call(number)], No(NO_ROUTINE), f"routine {number}")
    for seconds in (-1.0, 2001.0):
        yield Program([call(LONG, seconds=seconds)], No(BAD_VALUE), f"{seconds} s")
    yield Program([call(WELD, weld_words(1.0, dry=2))], No(BAD_VALUE), "a bool that is 2")
    nan = [2143289344, *weld_words(1.0)[1:]]
    yield Program([call(WELD, nan)], No(RawReason.NOT_FINITE))
    for length in (-1.0, 2.5, 81.0):
        values = [*weld_words(1.0)[:3], *millionths([length]), *[0] * 21]
        yield Program([call(WELD, values)], No(BAD_VALUE), f"a text of {length} characters")
    yield Rest(0.5)


@case("routine-missing", "a procedure that its module does not have ends the program in its turn")
@generated
def _missing(bench: Bench) -> Iterator[Step]:
    """Load no module: earlier instructions run, no other routine is called."""
    if not _has_these(bench):
        raise NotApplicable("the routines that are tried are not in the configuration")
    wait = instruction(RawInstruction.WAIT, 0.1)

    def one_missing(_: Bench) -> Iterator[Step]:
        yield from (Program([wait, call(ABSENT), wait]), Rest(1))
        yield Ended(NO_ROUTINE, 1, RawTrajectoryState.FAILED)
        yield from (Program([call(WELD, weld_words(1.0))]), Result(4, values=(2.0,)))

    def all_missing(other: Bench) -> Iterator[Step]:
        for number, routine in enumerate(other.group.routines):
            if number != TEACH or computes(other):
                yield Program([call(number, _zeros(other, routine))], what=routine.call)
                yield from (Rest(0.5), Ended(NO_ROUTINE, 0))

    yield Elsewhere(_with_modules(bench, _CELL, _EMPTY[1]), one_missing)
    yield Elsewhere(_with_modules(bench, *_EMPTY), all_missing)


# -- results -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Result:
    """RESULT of the newest call: its error, values and the text of a parameter."""

    parameter: int
    text: str | None = None
    values: tuple[float, ...] = ()
    error: bool = False

    def play(self, run: Run) -> None:
        for _ in range(100):
            reply = run.link.ask(RawResult(self.parameter))
            if isinstance(reply, RawResultReply) and reply.trajectory == run.trajectory:
                break
            run.bench.run(0.02)
        if (
            not isinstance(reply, RawResultReply)
            or reply.trajectory != run.trajectory
            or bool(reply.error) is not self.error
            or self.text not in (None, reply.text)
            or reply.values[: len(self.values)] != self.values
        ):
            raise CheckFailed(f"trajectory {run.trajectory}, the reply is {reply}")


@case("routine-results", "a routine's parameters and its error come back")
@_needs_these
def _results(other: Bench) -> Iterator[Step]:
    """Return numbers, texts and errors; the program continues or ends."""
    for seam, dry, good in ((1.5, 0, 0), (2.0**100, 1, 1), (-0.0, 0, 1), (1.5, 1, 0)):
        yield Program([call(WELD, weld_words(seam, dry=dry, good=good))])
        yield Result(4, "abab", (2 * seam, dry, float(dry == good)))
        # Parameters that are no string have no text.
        yield from (Result(parameter, "") for parameter in (1, 9, -1))
    for text in ("", "x" * 40, "12345"):
        yield from (Program([call(WELD, weld_words(1.0, text=text))]), Result(4, 2 * text, (2.0,)))
    yield from (Program([call(WELD, weld_words(-1.0))]), Result(0, "weld_failed", error=True))
    yield from (Pass(0.5), Ended(RawReason.ROUTINE, state=RawTrajectoryState.FAILED))
    yield Routine(calls=8)


@dataclass(frozen=True, slots=True)
class Routine:
    """The routines have ended so often, and the last one was undone or not."""

    calls: int
    undone: bool | None = None

    def play(self, run: Run) -> None:
        data = run.bench.controller.task(run.bench.group.task)
        seen = data["cell:calls"], data["cell:undone"]
        if seen[0] != self.calls or self.undone not in (None, seen[1]):
            raise CheckFailed(f"calls and undone are {seen}")


@case("routine-alone", "nothing else begins while a routine runs", needs="control")
@_needs_these
def _alone(other: Bench) -> Iterator[Step]:
    """Do not interrupt a routine by clients; STOP and time-outs end it.

    UNDO runs.
    """
    yield from (Program([call(LONG)]), Pass(0.5))
    yield Program([call(LONG)], No(RawReason.MOVING, -1), "a program into a routine")
    yield Ask(RawSpeed(50.0), RawNotDone(RawReason.IN_ROUTINE))
    points = other.wave(4)
    yield from (_TurnedAway(other.download(points)), Ended(None, state=RawTrajectoryState.MOVING))
    own = other.controller.task(other.group.task)
    other.until(lambda: own["cell:calls"] == 1, 10, "the routine comes to its end")
    yield from (Pass(0.5), Routine(1, False), Ended(None, state=RawTrajectoryState.DONE), Rest(1))
    for end, seconds in ((Pass(0), 1.0), (Stop(control=True), 0.0)):
        reason = RawReason.OVERTIME if seconds else RawReason.STOPPED
        yield from (Program([call(LONG, seconds=seconds)]), Pass(2), end, Pass(1), Ended(reason))
        yield Routine(1, True)
    # The rejected path is accepted now. At its second corner the state and the control server
    # look for clients at the same time: with random task order it may be a stop.
    yield MovesOn(points=points)
    yield Go(orders(other, 2, random.Random(28)))


@dataclass(frozen=True, slots=True)
class _TurnedAway:
    """Send a download, and the same from a newer client, which is disconnected."""

    download: bytes

    def play(self, run: Run) -> None:
        newer = RawLink(run.bench, run.bench.group.ports.motion)
        for link in (run.link, newer):
            link.send(self.download)
        newer.wait_disconnected(3, "a newer client's motion into a routine")


# -- poses -------------------------------------------------------------------------------------


@case("program-displaced", "a displacement of the customer's own program moves no program of ours")
@generated
def _displaced(bench: Bench) -> Iterator[Step]:
    """Displace before a program and in a routine: it ends before the next pose.

    PDispOn and EOffsOn would lead it to an unchecked position.
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    first, *_, last = orders(bench, 3, random.Random(33))
    joints, modal = joint_move(last), bench.motion_group.modal
    move = replace(to_pose(bench, last, RawInstruction.MOVE_J), zone=None)
    yield Go([first])
    for displacement in _DISPLACEMENTS:
        modal.displacement = displacement
        yield from (_NotExecuted(move), Rest(1))
    yield from (Go([joints], "joints, which no displacement takes elsewhere"), Go([first]))
    modal.displacement = IDENTITY
    yield Go([move], "a program without a displacement")
    if _has_these(bench):
        yield Elsewhere(_with_modules(bench, _CELL), _displaced_by_routine)


@dataclass(frozen=True, slots=True)
class _NotExecuted:
    """Send a move to a displaced pose: it is rejected at once, or fails later."""

    move: RawMove

    def play(self, run: Run) -> None:
        reply = run.client.send([self.move])
        if isinstance(reply, RawPointsRefused):
            No(POSE_MISMATCH).check(reply, run, 0)


def _displaced_by_routine(other: Bench) -> Iterator[Step]:
    """Yield programs during whose call the poses are displaced."""
    modal = other.motion_group.modal
    data = data_of(other.rapid_task("ROS_motion"), other.motion_group)
    line = to_pose(other, orders(other, 4, random.Random(33))[-1], RawInstruction.MOVE_L)
    for displacement in (*_DISPLACEMENTS, None):
        # As the routine may do.
        yield from (Program([call(LONG), line], what=f"{displacement}"), Pass(4))
        if displacement is None:
            data.external_offset = (0.0, 5.0, 0.0, 0.0, 0.0, 0.0)
        else:
            modal.displacement = displacement
        yield from (Rest(7), Ended(POSE_MISMATCH, 1))
        modal.displacement, data.external_offset = IDENTITY, NO_OFFSETS
    yield from (Program([call(LONG), joint_move(line, line.zone)]), Pass(4))
    modal.displacement = _DISPLACEMENTS[0]
    yield Reached(line.joints)


@case("routine-targets", "targets that a routine leaves come back")
@_needs_these
def _targets(other: Bench) -> Iterator[Step]:
    """Report targets with their numbers, in m and rad; none if absent."""
    if not computes(other):
        raise NotApplicable("the driver computes no poses")
    first, second = (move.joints for move in orders(other, 3, random.Random(29))[1:])
    (x, y, z), turn = reached(other, first)
    for away, reply in ((0.1, No(POSE_MISMATCH)), (0.0, TAKEN)):
        values = millionths([x + away, y, z, *turn, *first, *first, *second])
        yield Program([call(TEACH, values)], reply)
    yield Result(0)
    yield _Target(0, 1, ((x + 0.25, y, z), turn, (-1, 2, -3, 4), None))
    for number, joints in ((1, second), (2, first)):
        yield _Target(1, number, ((), (), None, joints))
    for kind, number in ((0, 0), (0, 2), (1, 0), (1, 3), (2, 1), (-1, 1), (1, -1)):
        yield _Target(kind, number)


@dataclass(frozen=True, slots=True)
class _Target:
    """TARGET: a jointtarget (1) or robtarget (0) of the newest call; by default there is none."""

    kind: int
    number: int
    expected: tuple[Sequence[float] | None, ...] = ()
    """Position, orientation, configuration, joints; None: not compared."""

    def play(self, run: Run) -> None:
        reply = run.link.ask(RawTarget(self.kind, self.number))
        if isinstance(reply, RawFailure) and not self.expected:
            return
        if not isinstance(reply, RawTargetReply) or not self.expected:
            raise CheckFailed(f"the reply is {reply}")
        for seen, part in zip(reply[1:], self.expected, strict=True):
            # The wire rounds to millionths; joints are padded with zeros.
            if part is not None and any(
                abs(a - b) >= 1e-5 for a, b in zip_longest(seen, part, fillvalue=0.0)
            ):
                raise CheckFailed(f"the reply is {reply}")
