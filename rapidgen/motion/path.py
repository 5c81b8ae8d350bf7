"""The path of one robot: legs and pieces in order, extended at its end, cut at a stop.

Pure bookkeeping of places; when anything happens is the business of `execution.py`.
"""

from bisect import bisect_left
from collections import deque
from collections.abc import Callable

from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.motion.corners import corner, stretch
from rapidgen.motion.legs import Geometry, Leg
from rapidgen.motion.moves import Move
from rapidgen.motion.pieces import AxisLimits, Piece, joint_line
from rapidgen.motion.speed_profile import Plan

WayMaker = Callable[[Posture, Move, bool], Geometry]
"""(from, move, from rest) -> geometry of the move."""
PlanFinder = Callable[[tuple[Piece, ...]], Plan | None]
"""The plan over pieces from the robot's present state; None when there is none."""
_SHRINK = (1.0, 0.5, 0.25, 0.1, 0.03)
REGAIN_SPEED = 0.1
"""Share of the axes' speed at which the robot returns to its path."""
NOTHING_M = 1e-9
"""rad or m of an axis below which a move goes nowhere."""


class Path:
    """Pieces from the one that the robot is on, and the legs that it has not finished."""

    __slots__ = ("_back", "_left", "end", "legs", "pieces", "tail", "target")

    def __init__(self, posture: Posture) -> None:
        self.pieces: tuple[Piece, ...] = ()
        self.legs: deque[Leg] = deque()
        self.tail: Leg | None = None
        """The last leg while its end may still become a corner."""
        self.end = 0.0
        self.target = posture
        """Where the path ends."""
        self._back: Piece | None = None
        """The way back to the path, when it is the first piece."""
        self._left: tuple[Posture, Posture] | None = None
        """Where the robot stands, and where on a path that was cleared it would have to be."""

    def extend(
        self,
        move: Move,
        make: WayMaker,
        plan: PlanFinder,
        limits: AxisLimits,
        fixed: float,
        kinematics: Kinematics | None = None,
    ) -> tuple[Leg, bool]:
        """Append a move. Nothing before the place `fixed` changes.

        The corner at the tail takes the programmed zone; where the robot is too fast for it
        the zone shrinks, and as the last resort the point becomes a stop. Returns the leg and
        whether that happened (a corner path failure).
        """
        tail = self.tail
        if tail is not None and not tail.stops:
            path = make(self.target, move, False)
            if tail.move.time is None and move.time is None:
                stretch(tail, path)
            for size in _SHRINK:
                bend = corner(tail, path, size * limits.corner, limits, kinematics)
                if bend is None:
                    break
                start, end, between = bend
                if start < fixed:
                    continue
                leg = Leg(move, path, tail.end, tail.end + path.duration)
                for piece in between:
                    piece.corner = True
                before = self._until(start)
                after = limits.slow(path.pieces(leg.begin, end, leg.end))
                pieces = (*before, *limits.slow(between), *after)
                if plan(pieces) is None:
                    continue
                tail.left = end
                self._take(leg, pieces)
                return leg, False
        failed = tail is not None and not tail.stops
        if tail is not None and failed:
            tail.committed = True
        leg, pieces = self._from_rest(move, make, limits)
        self._take(leg, pieces)
        return leg, failed

    def _from_rest(
        self, move: Move, make: WayMaker, limits: AxisLimits
    ) -> tuple[Leg, tuple[Piece, ...]]:
        path = make(self.target, move, True)
        leg = Leg(move, path, self.end, self.end + path.duration)
        before = self.pieces
        if before:
            last = before[-1]
            before = (*before[:-1], last.until(last.end, stop=True))
        return leg, (*before, *limits.slow(path.pieces(leg.begin, leg.begin, leg.end)))

    def _take(self, leg: Leg, pieces: tuple[Piece, ...]) -> None:
        leg.left = leg.end
        self.pieces = pieces
        self.legs.append(leg)
        self.tail = leg
        self.end = leg.end
        self.target = leg.way.target

    def _until(self, place: float) -> tuple[Piece, ...]:
        pieces = self.pieces
        count = bisect_left(pieces, place, key=_start)
        if count and pieces[count - 1].end > place:
            return (*pieces[: count - 1], pieces[count - 1].until(place))
        return pieces[:count]

    def passed(self, place: float) -> list[Leg]:
        """Legs that the robot has left or whose stop point it has reached; they are taken off."""
        done = []
        while self.legs and place >= self.legs[0].left - 1e-9:
            leg = self.legs[0]
            if leg is self.tail and not leg.stops:
                break  # its end is only passed once it is known what follows
            done.append(self.legs.popleft())
        return done

    def prune(self, place: float) -> None:
        """Forget pieces behind the robot."""
        first = 0
        while first < len(self.pieces) - 1 and self.pieces[first].end <= place:
            first += 1
        if first:
            self.pieces = self.pieces[first:]

    def cut(self, place: float) -> list[Leg]:
        """Let the path end at `place`; returns the legs that are lost."""
        if self._back is not None:
            self._left = self.way_back(place)
            self._back = None
        lost = list(self.legs)
        self.legs.clear()
        self.tail = None
        if place < self.end:
            self.target = self.at(place)
        self.pieces = self._until(place)
        if self.pieces:
            last = self.pieces[-1]
            self.pieces = (*self.pieces[:-1], last.until(last.end, stop=True))
        self.end = place
        return lost

    def distance_to_path(self, current: Posture, place: float, limits: AxisLimits) -> float:
        """Put a joint line from `current` to the path's `place` before it; returns where it begins.

        `place` itself when the robot is there. An earlier way back is forgotten.
        """
        if self.pieces and self.pieces[0] is self._back:
            place = self._back.end
            self.pieces = self.pieces[1:]
        self._back = None
        self.prune(place)
        target = self.at(place)
        reach = max(abs(b - a) / v for a, b, v in zip(current, target, limits.speeds, strict=True))
        if reach < NOTHING_M or not self.pieces:
            return place
        duration = reach / REGAIN_SPEED
        rates = tuple([(b - a) / duration for a, b in zip(current, target, strict=True)])
        start = place - duration
        back = joint_line(start, place, (start, current, rates), limits, 0.0)
        self._back = back.until(place, stop=True)
        self.pieces = (self._back, self.pieces[0].since(place), *self.pieces[1:])
        return start

    def way_back(self, place: float) -> tuple[Posture, Posture] | None:
        """Begin and end of the way back to the path; None when the robot's place is not on it."""
        back = self._back
        if back is None or place >= back.end:
            return None
        return back.at(back.start), back.at(back.end)

    def left_at(self, there: Posture) -> None:
        """The robot stands at the end of this path, off one that was cleared, at `there`."""
        self._left = self.target, there

    def end_and_rest_positions(self, place: float) -> tuple[Posture, Posture] | None:
        """Where the robot stands, and where a path ends that was cleared while it was off that.

        None once it has moved on, or was never off.
        """
        return self._left if place <= self.end and not self.legs else None

    def forget(self) -> None:
        """Drop the distance to a path that was cleared."""
        self._left = None

    def at(self, place: float) -> Posture:
        """Axis values at a place."""
        return posture_at(self.pieces, place, self.target)


def _start(piece: Piece) -> float:
    return piece.start


def posture_at(pieces: tuple[Piece, ...], place: float, remaining: Posture) -> Posture:
    """Axis values at a place of these pieces; `remaining` where there is no piece."""
    return piece_at(pieces, place).at(place) if pieces else remaining


def piece_at(pieces: tuple[Piece, ...], place: float) -> Piece:
    """Return the piece that contains a place, or the last one."""
    low, high = 0, len(pieces) - 1
    while low < high:
        middle = (low + high) // 2
        if pieces[middle].end < place:
            low = middle + 1
        else:
            high = middle
    return pieces[low]
