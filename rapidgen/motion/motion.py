"""What a robot does from a moment on: everything that positions depend on."""

from dataclasses import dataclass, field
from math import ceil

from rapidgen.axes.kinematics import Posture
from rapidgen.machine.scheduler import S
from rapidgen.motion import smoothing
from rapidgen.motion.braking import AxisMotion, GuidedStep
from rapidgen.motion.legs import Leg
from rapidgen.motion.moves import Move
from rapidgen.motion.path import piece_at, posture_at
from rapidgen.motion.pieces import Piece
from rapidgen.motion.speed_profile import SpeedProfile


@dataclass(frozen=True, slots=True)
class Motion:
    """A speed profile over pieces of path. Times are scheduler ns.

    The profile is what was planned; the robot follows the mean of that motion over the last
    `ramp` s.
    """

    since: int
    """From when on it holds."""
    start: int
    """When the law began (before `since` where a braking is only continued)."""
    law: SpeedProfile
    pieces: tuple[Piece, ...]
    rest: Posture
    """Where it ends."""
    legs: tuple[Leg, ...] = ()
    """The moves on the path that are not finished when it begins."""
    ramp: float = 0.0
    """s over which the motion is smoothed (`smoothing.py`)."""

    coast: AxisMotion | None = None
    """The axes' own way to rest when the brakes stop them; the profile then ends where on the
    path the robot should have stopped."""

    end: int = field(init=False)
    """When it stands still: asked for at every event."""

    def __post_init__(self) -> None:
        end = self.start
        if self.law.phases[0]:
            end += ceil((self.law.duration + self.ramp) * S)
        object.__setattr__(self, "end", end if self.coast is None else max(end, self.coast.end))

    def planned(self, now: int) -> tuple[float, float]:
        """Place and speed of the law at a time: from there on it may be planned anew."""
        return self.law.state((now - self.start) / S)

    def place(self, now: int) -> float:
        """Where the robot is on the path at a time."""
        return smoothing.state(self.law, (now - self.start) / S, self.ramp)[0]

    def behind(self, now: int) -> float:
        """Where on the path the mean begins that the robot follows at a time."""
        return self.law.state((now - self.start) / S - self.ramp)[0]

    def time_at(self, place: float) -> float:
        """When the robot reaches a place, scheduler s; the standstill for places not reached."""
        return self.start / S + smoothing.time_at(self.law, place, self.ramp)

    def posture(self, now: int) -> Posture:
        """Axis values at a time."""
        if now >= self.end:
            return self.rest
        if self.coast is not None:
            return self.coast.posture(now)
        time = (now - self.start) / S
        if self.ramp <= 0.0 or not self.pieces:
            return posture_at(self.pieces, self.law.state(time)[0], self.rest)
        return smoothing.posture(self.law, self.pieces, self.rest, time, self.ramp)

    def reference(self, now: int) -> Posture:
        """Axis values that are ordered at a time; under guidance those of the partner."""
        step = self.coast
        # Another step follows within a cycle, or guidance has ended.
        if isinstance(step, GuidedStep) and now - step.since <= 2 * step.length:
            return self.posture(now) if step.reference is None else step.reference
        return self.posture(now)

    def in_corner(self, now: int) -> bool:
        """True if the place on the path is in the corner of a fly-by point."""
        if not self.pieces or now >= self.end or self.coast is not None:
            return False
        return piece_at(self.pieces, self.place(now)).corner

    def move(self, now: int) -> Move | None:
        """The move under way at a time, or the last one that was."""
        place = self.place(now)
        for leg in self.legs:
            if place <= leg.end:
                return leg.move
        return self.legs[-1].move if self.legs else None
