"""Legs: one move instruction each, placed on the path; joint ways."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf
from typing import Protocol

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.config.model import GroupConfig
from rapidgen.motion.moves import (
    SHORTEST,
    JointMove,
    Measure,
    Move,
    MoveFrames,
    largest,
    nominal_time,
    timed,
)
from rapidgen.motion.pieces import AxisLimits, Piece, joint_line
from rapidgen.motion.sampling import spaced

_PARTS = 8
"""Parts of a joint move, where the accelerations depend on the posture."""
_CHORDS = 4
"""Straight parts that stand for the TCP's way in a joint move."""


class Geometry(Protocol):
    """The way of one move in its own nominal time, 0 to `duration`."""

    duration: float
    measure: Measure
    limits: AxisLimits
    strength: float
    """Acceleration that the axes allow, in ways per s^2."""
    programmed: float
    """Path speed that is as programmed: 1, unless the way is stretched."""

    def stretch(self, factor: float) -> None:
        """Let the way have `factor` times its nominal time, at another programmed path speed."""

    @property
    def target(self) -> Posture:
        """Where it ends."""

    @property
    def tcp(self) -> float:
        """m that the TCP goes in a nominal s."""

    def pieces(self, begin: float, start: float, end: float) -> list[Piece]:
        """The path pieces from `start` to `end` of a leg that begins at `begin`."""

    def posture(self, time: float) -> Posture:
        """Axis values at a nominal time of the way."""


@dataclass(slots=True, eq=False)
class Leg:
    """One move on the path. Places are nominal s along the whole path."""

    move: Move
    way: Geometry
    begin: float
    end: float
    left: float = field(default=0.0)
    """Place at which the robot has left this leg: behind the corner at its end."""
    released: bool = False
    """The program may go on."""
    committed: bool = False
    """No successor came in time: the point is a stop."""
    late: bool = False
    """Committed because the program asked for the next move too late."""
    finished: bool = False
    """Reached (a stop point) or passed."""
    cleared: bool = False
    """Taken off the path before it was finished."""
    began: float | None = None
    """Scheduler time (s) of its beginning, when that was from a standstill."""
    passed_at: float | None = None
    """Scheduler time (s) at which its end was passed."""

    @property
    def stops(self) -> bool:
        """Whether the robot stands at the end."""
        return self.move.zone.fine or self.committed


class JointPath:
    """All axes together on a straight line in joint space."""

    __slots__ = (
        "_constant",
        "_peak",
        "duration",
        "limits",
        "measure",
        "origin",
        "programmed",
        "rates",
        "strength",
        "target",
    )

    def __init__(
        self,
        origin: Posture,
        target: Posture,
        duration: float,
        measure: tuple[Measure, float],
        limits: AxisLimits,
        strength: float,
        constant: Sequence[float] | None,
    ) -> None:
        self.strength = strength
        self._constant = constant
        """Accelerations of the axes that hold for all of the way, if there are such."""
        self.origin = origin
        self.target = target
        self.duration = duration
        self.programmed = 1.0
        self.measure, self._peak = measure
        self.limits = limits
        self.rates = tuple([(b - a) / duration for a, b in zip(origin, target, strict=True)])

    def stretch(self, factor: float) -> None:
        """See Geometry."""
        self.duration *= factor
        self.programmed *= factor
        self.rates = tuple([r / factor for r in self.rates])

    @property
    def tcp(self) -> float:
        """m that the TCP goes in a nominal s."""
        return self._peak / self.duration

    def posture(self, time: float) -> Posture:
        """Axis values at a nominal time of the way."""
        return tuple([q + r * time for q, r in zip(self.origin, self.rates, strict=True)])

    def pieces(self, begin: float, start: float, end: float) -> list[Piece]:
        """Straight pieces: one, unless the accelerations differ along the way."""
        line = begin, self.origin, self.rates
        if self._constant is not None:
            constant = self._constant, self.programmed
            return [joint_line(start, end, line, self.limits, self.tcp, *constant)]
        return [
            joint_line(*ends, line, self.limits, self.tcp, None, self.programmed)
            for ends in pairwise(spaced(start, end, _PARTS))
        ]


def joint_way(
    origin: Posture,
    move: JointMove,
    measure: tuple[Measure, float],
    limits: AxisLimits,
    *,
    from_rest: bool,
) -> JointPath:
    """The way of a joint move. `\\T` includes the ramps at ends where the robot stands."""
    deltas = [b - a for a, b in zip(origin, move.target, strict=True)]
    fastest = max(abs(d) / v for d, v in zip(deltas, limits.speeds, strict=True))
    shares = spaced(0.0, 1.0, _PARTS) if limits.vary else [0.0]
    rows = [
        limits.accelerations(tuple([q + d * share for q, d in zip(origin, deltas, strict=True)]))
        for share in shares
    ]
    least = [min(column) for column in zip(*rows, strict=True)]
    strongest = min((a / abs(d) for d, a in zip(deltas, least, strict=True) if d), default=inf)
    constant: Sequence[float] | None = least
    if move.time is None:
        duration = max(fastest, nominal_time(measure[0], move.speed), SHORTEST)
        constant = None if limits.vary else least
    else:
        # With one acceleration all along, the time of a way is a formula.
        rests = from_rest + move.zone.fine
        total = move.time - rests * limits.ramp / 2
        duration = timed(total, fastest, strongest, rests / 2)
    return JointPath(origin, move.target, duration, measure, limits, strongest, constant)


def lever_measure(
    group: GroupConfig, origin: Posture, target: Posture, lever: float
) -> tuple[Measure, float]:
    """How far a joint move goes when the robot has no geometry, twice: evenly on the way.

    Each robot axis swings the TCP on an arm of `lever` m; the largest swing counts.
    """
    robot, turns, linear, rotary = [0.0], [0.0], [0.0], [0.0]
    for joint, a, b in zip(group.joints, origin, target, strict=True):
        if joint.axis.startswith("rax"):
            robot.append((b - a) * lever if joint.kind == "revolute" else b - a)
            if joint.kind == "revolute":
                turns.append(b - a)
        elif joint.kind == "revolute":
            rotary.append(b - a)
        else:
            linear.append(b - a)
    path = largest(robot)
    return Measure(path, largest(turns), largest(linear), largest(rotary)), path


def joint_measure(
    kinematics: Kinematics, carrier: MoveFrames, origin: Posture, target: Posture
) -> tuple[Measure, float]:
    """How far a joint move goes, and the largest way of the TCP per share of the move.

    The TCP's way is that of its chords, extrapolated from halves to quarters (its error falls
    with the fourth power of their length).
    """
    poses = []
    for k in range(_CHORDS + 1):
        fraction = k / _CHORDS
        posture = tuple([a + (b - a) * fraction for a, b in zip(origin, target, strict=True)])
        poses.append(carrier.at(posture).pose(kinematics.forward(posture)))
    chords = [frames.distance(a[0], b[0]) for a, b in pairwise(poses)]
    coarse = sum(frames.distance(a[0], b[0]) for a, b in pairwise(poses[::2]))
    fine = sum(chords)
    path = fine + (fine - coarse) / 3
    turn = sum(frames.angle_between(a[1], b[1]) for a, b in pairwise(poses))
    linear, rotary = [0.0], [0.0]
    for joint, a, b in zip(kinematics.group.joints, origin, target, strict=True):
        if joint.axis.startswith("eax"):
            (rotary if joint.kind == "revolute" else linear).append(b - a)
    peak = max(chords) * _CHORDS * path / fine if fine > 0 else 0.0
    return Measure(path, turn, largest(linear), largest(rotary)), peak
