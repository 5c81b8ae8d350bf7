"""Moves of a program that is stepped: a step backward over one takes the robot to where it began.

Source: S4 datasys 2-SearchL-6 and 2-TriggL: backward, a move instruction just carries out the
movement, without supervision and without events. Where a move began is known of those that were
stepped forward; what was executed otherwise in between makes all of them unknown.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from rapidgen.axes.kinematics import Posture
from rapidgen.motion.group import MotionGroup, MotionWaiter
from rapidgen.motion.moves import FINE, CartesianMove, JointMove, Move
from rapidgen.runtime.errors import Location
from rapidgen.runtime.motion_faults import planned

MOST = 1000
"""Moves that are remembered."""
_AT = 1e-5
"""rad or m: as near as the robot has to stand to where a move ended."""


@dataclass(frozen=True, slots=True)
class _Driven:
    move: Move
    origin: Posture
    end: Posture


class StepHistory:
    """The moves of the steps of one task, the latest last."""

    def __init__(self, group: MotionGroup) -> None:
        self._group = group
        self._driven: list[_Driven] = []
        self._begun: list[tuple[Move, Posture]] = []
        self._listens = False

    def begin(self) -> None:
        """A step forward begins."""
        self._begun.clear()
        if not self._listens:
            self._group.listeners.append(self._note)
            self._listens = True

    def end(self) -> None:
        """The step has ended, the robot stands."""
        if self._listens:
            self._group.listeners.remove(self._note)
            self._listens = False
        if len(self._begun) == 1:
            ((move, origin),) = self._begun
            self._driven.append(_Driven(move, origin, self._group.positions()))
            del self._driven[:-MOST]

    def forget(self) -> None:
        """Something else than steps was executed, or the program pointer was moved."""
        self._begun.clear()
        self.end()
        self._driven.clear()

    def _note(self, move: Move) -> None:
        self._begun.append((move, self._group.path_target))

    @planned
    def drive(self, task: MotionWaiter, statement: Location, start: Callable[[], None]) -> bool:
        """Drive back over the move of a statement; False: not known, the robot stays.

        The way is that of the move, at its speed, to a stop point. `start` lets robots move.
        """
        current = self._group.positions()
        for k in range(len(self._driven) - 1, -1, -1):
            one = self._driven[k]
            if _same(_place(one.move), statement) and _near(one.end, current):
                break
        else:
            return False
        del self._driven[k:]
        start()
        self._group.move(task, self._reversed(one))
        self._group.wait_standing(task)
        if not _near(self._group.positions(), one.origin):
            self._driven.clear()
        return True

    def _reversed(self, one: _Driven) -> Move:
        move = replace(one.move, zone=FINE, events=(), concurrent=False, dwell=0.0)
        if isinstance(move, JointMove):
            return replace(move, target=one.origin)
        assert isinstance(move, CartesianMove)
        carrier = move.carrier.at(one.origin)
        pose = carrier.pose(self._group.geometry().forward(one.origin))
        return replace(move, target=pose, external=one.origin, wanted=None)


def _place(move: Move) -> Location | None:
    result = move.place() if move.place is not None else None
    return result if isinstance(result, Location) else None


def _same(one: Location | None, other: Location) -> bool:
    return one is not None and (one.module, one.routine, one.span.line, one.span.column) == (
        other.module,
        other.routine,
        other.span.line,
        other.span.column,
    )


def _near(one: Posture, other: Posture) -> bool:
    return all(abs(a - b) <= _AT for a, b in zip(one, other, strict=True))
