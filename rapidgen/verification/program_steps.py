"""Steps of motion programs, as data.

An item of a program is a `RawMove`, or the words of another instruction: `words_of_instruction`
makes them, a faulty one is any list of integers. A program begins at the robot's position, unless a
step gives another one.

Each reply is compared: number of the program, reason, instruction and joint, or the number of
accepted instructions. A trajectory's number in a reply must be newer than all before.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Final, TypeAlias

from rapidgen.motion.moves import Move
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.messages import (
    RawInstruction,
    RawReason,
    RawStreamFlag,
    RawTrajectoryState,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Position
from rapidgen.verification.raw_programs import ALL, Item, RawMove
from rapidgen.verification.steps import Run
from rapidgen.verification.stream import NONE
from rapidgen.verification.testbench import CORNER_FAILURE, Bench

ANY_INDEX: Final = -2
"""Index in a rejection: not compared."""
ANY_JOINT: Final = -1
Reasons: TypeAlias = RawReason | tuple[RawReason, ...]


def instruction(kind: RawInstruction, *operands: float) -> list[int]:
    """Return the words of an instruction other than a move; operands in s, rad, m."""
    return [int(kind), *millionths(operands)]


# -- replies -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Taken:
    """Reply that accepts all instructions so far; `count`: so many."""

    count: int | None = None

    def check(self, reply: messages.RawContent, run: Run, count: int) -> None:
        """Compare the reply to a program of which `count` instructions were sent."""
        count = count if self.count is None else self.count
        if not isinstance(reply, messages.RawPointsAccepted) or reply[:3] != (
            run.client.number,
            run.of_stream,
            count,
        ):
            raise CheckFailed(
                f"{count} instructions of trajectory {run.of_stream} are right, "
                f"the reply is {reply}"
            )


@dataclass(frozen=True, slots=True)
class No:
    """Reply that rejects a program for one of these reasons, at an instruction and joint."""

    reason: Reasons
    index: int = 0
    joint: int = 0

    def check(self, reply: messages.RawContent, run: Run, count: int) -> None:
        """Compare the reply to a program; `count` does not matter."""
        if not isinstance(reply, messages.RawPointsRefused):
            raise CheckFailed(f"the reply is {reply}")
        point = reply.point if self.index == ANY_INDEX else self.index
        joint = reply.joint if self.joint == ANY_JOINT else self.joint
        expected = reply._replace(stream=run.client.number, point=point, joint=joint)
        reasons = self.reason if isinstance(self.reason, tuple) else (self.reason,)
        if reply != expected or reply.reason not in reasons:
            raise CheckFailed(f"{expected} for one of {reasons} is right, the reply is {reply}")


ProgramReply: TypeAlias = Taken | No
TAKEN: Final = Taken()


# -- programs ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Program:
    """Send a new program."""

    items: Sequence[Item] = field(repr=False)
    reply: ProgramReply = TAKEN
    what: str = ""
    flags: RawStreamFlag = ALL
    start: Position | None = field(default=None, repr=False)

    def play(self, run: Run) -> None:
        reply = run.client.send(self.items, self.flags, self.start)
        _note_trajectory(run, reply)
        self.reply.check(reply, run, len(self.items))


def right(items: Sequence[Item], what: str = "") -> Program:
    """Return a program that is right up to a wrong instruction after these: nothing moves."""
    return Program([*items, [99]], No(RawReason.NO_INSTRUCTION, len(items)), what)


@dataclass(frozen=True, slots=True)
class More:
    """Send a further batch of the present program, in one message."""

    items: Sequence[Item] = field(repr=False)
    first: int
    reply: ProgramReply = TAKEN
    flags: RawStreamFlag = NONE

    def play(self, run: Run) -> None:
        reply = run.client.batch(self.items, self.flags, self.first)
        self.reply.check(reply, run, self.first + len(self.items))


def _note_trajectory(run: Run, reply: messages.RawContent) -> None:
    """Note the number of a program's trajectory; it must be a new one."""
    number = getattr(reply, "trajectory", 0)
    if number:
        if number <= run.trajectory:
            raise CheckFailed(f"trajectory {run.trajectory} is known, the reply is {reply}")
        run.trajectory = run.of_stream = number


@dataclass(frozen=True, slots=True)
class Go:
    """Send a program, which must be executed to its last move."""

    moves: Sequence[RawMove] = field(repr=False)
    what: str = ""
    then: float = 0.0
    """s to wait after it."""

    def play(self, run: Run) -> None:
        Program(self.moves).play(run)
        run.bench.wait_until_at(self.moves[-1].joints, 90)
        run.bench.run(self.then)


# -- the robot ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Since:
    """The path that `Followed` and `StoodAt` check begins now."""

    def play(self, run: Run) -> None:
        run.since = run.bench.now


@dataclass(frozen=True, slots=True)
class Reached:
    """The robot reaches a position, and stands there."""

    joints: Position = field(repr=False)
    within: float = 60

    def play(self, run: Run) -> None:
        run.bench.wait_until_at(self.joints, self.within)


@dataclass(frozen=True, slots=True)
class Followed:
    """The robot was on the path through these positions since `Since`."""

    path: Sequence[Position] = field(repr=False)
    corner: float = 0.1
    """rad and m that a zone cuts off."""

    def play(self, run: Run) -> None:
        path = [run.bench.track_at(run.since), *self.path]
        run.bench.followed(path, since=run.since, corner=self.corner)


@dataclass(frozen=True, slots=True)
class StoodAt:
    """The robot stopped at a position since `Since`, without a zone."""

    joints: Position = field(repr=False)

    def play(self, run: Run) -> None:
        track = [seen for when, seen in run.bench.track if when >= run.since]
        if not any(
            all(abs(a - b) < 1e-4 for a, b in zip(seen, self.joints, strict=True)) for seen in track
        ):
            raise CheckFailed("the robot did not stop there")


@dataclass(frozen=True, slots=True)
class Stops:
    """Send a program; each of its moves is a stop point (1) or is passed (0)."""

    items: Sequence[Item] = field(repr=False)
    stops: Sequence[int]

    def play(self, run: Run) -> None:
        bench = run.bench
        with ordered_moves(bench) as moves:
            Program(self.items).play(run)
            bench.until(lambda: len(moves) == len(self.stops), 90, "all moves are ordered")
            bench.wait_until_standing(30)
        seen = [int(move.zone.fine) for move in moves]
        if seen != list(self.stops):
            raise CheckFailed(f"stops at {seen}")
        bench.run(0.5)


@contextmanager
def ordered_moves(bench: Bench) -> Iterator[list[Move]]:
    """Yield the list of ordered moves of the bench's group."""
    moves: list[Move] = []
    listeners = bench.motion_group.listeners
    listeners.append(moves.append)
    yield moves
    listeners.remove(moves.append)


# -- what is observed --------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Ended:
    """PROGRESS of the newest trajectory: why it has ended, and how many items were executed.

    None: not compared. PROGRESS is read once, or for `within` s.
    """

    reason: RawReason | None
    reached: int | range | None = None
    state: RawTrajectoryState | tuple[RawTrajectoryState, ...] | None = None
    within: float = 0

    def play(self, run: Run) -> None:
        until = run.bench.now + self.within
        while not self._fits(seen := run.bench.progress(run.watcher), run.trajectory):
            if run.bench.now >= until:
                raise CheckFailed(f"trajectory {run.trajectory}, PROGRESS says {seen}")

    def _fits(self, seen: messages.RawProgress, trajectory: int) -> bool:
        reached = (self.reached,) if isinstance(self.reached, int) else self.reached
        states = self.state if isinstance(self.state, tuple) else (self.state,)
        return (
            seen.trajectory == trajectory
            and self.reason in (None, seen.reason)
            and (reached is None or seen.reached in reached)
            and (self.state is None or seen.state in states)
        )


@dataclass(frozen=True, slots=True)
class ReachedItems:
    """PROGRESS reports that so many items of the newest program are executed."""

    count: int

    def play(self, run: Run) -> None:
        for _ in range(600):
            seen = run.bench.progress(run.watcher)
            if seen.trajectory == run.trajectory and seen.reached >= self.count:
                return
        raise CheckFailed(f"{self.count} instructions are not executed, PROGRESS says {seen}")


@dataclass(frozen=True, slots=True)
class CornersMade:
    """No corner lacked its next move: where the robot must stop, a stop point was ordered."""

    def play(self, run: Run) -> None:
        failed = [event for event in run.bench.controller.log if event.code == CORNER_FAILURE]
        if failed:
            raise CheckFailed(f"the robot was to stop where it passes: {failed[0]}")
