"""What a robot does from a moment on: everything that positions depend on."""

from dataclasses import dataclass

from rapidgen.virtual.kernel import S
from rapidgen.virtual.motion.moves import Move, Posture
from rapidgen.virtual.motion.path import posture_at
from rapidgen.virtual.motion.pieces import Piece
from rapidgen.virtual.motion.timelaw import TimeLaw


@dataclass(frozen=True, slots=True)
class Motion:
    """A time law over pieces of path. Times are kernel ns."""

    since: int
    """From when on it holds."""
    start: int
    """When the law began (before `since` where a braking is only continued)."""
    law: TimeLaw
    pieces: tuple[Piece, ...]
    rest: Posture
    """Where it ends."""
    legs: tuple[tuple[float, Move], ...] = ()
    """The moves on the path and where they end."""

    def posture(self, now: int) -> Posture:
        """Axis values at a time."""
        time = (now - self.start) / S
        if time >= self.law.duration:
            return self.rest
        return posture_at(self.pieces, self.law.state(time)[0], self.rest)

    def move(self, now: int) -> Move | None:
        """The move under way at a time, or the last one that was."""
        place, _ = self.law.state((now - self.start) / S)
        for end, move in self.legs:
            if place <= end:
                return move
        return self.legs[-1][1] if self.legs else None
