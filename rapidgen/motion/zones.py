"""World zones: volumes and joint spaces that are watched while the robot moves.

A motion is known in advance, so nothing is polled: each zone looks ahead on the motion for the next
moment at which something changes, in steps as long as its distance from the border allows, and
asks the scheduler for that moment. [manual 3HAC050917] WZDOSet, WZLimSup.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from math import hypot
from typing import Protocol

from rapidgen.axes.frames import Vector, compose, distance
from rapidgen.axes.kinematics import Posture
from rapidgen.machine.scheduler import MS, S, Scheduler, Timer
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.motion import Motion
from rapidgen.motion.path import posture_at
from rapidgen.motion.speed_profile import brake

_FASTEST_TCP = 10.0
"""m/s that no TCP exceeds, for moves whose speed in space is not known."""
_SHORTEST_STEP = 2 * MS
_CLOSE = 1_000
"""ns to which a crossing is found."""


class Shape(Protocol):
    """A volume in the world (m) or a joint space (rad, m)."""

    def depth(self, point: Sequence[float]) -> float:
        """How far outside a point is, at least; negative: inside."""


@dataclass(frozen=True, slots=True)
class BoxVolume:
    """Sides parallel to the world's."""

    low: Vector
    high: Vector

    def depth(self, point: Sequence[float]) -> float:
        """See Shape."""
        return max(
            max(low - x, x - high) for x, low, high in zip(point, self.low, self.high, strict=True)
        )


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Parallel to the world's z; `centre` is the middle of one end, a negative height goes down."""

    centre: Vector
    radius: float
    height: float

    def depth(self, point: Sequence[float]) -> float:
        """See Shape."""
        x, y, z = (a - b for a, b in zip(point, self.centre, strict=True))
        low, high = min(0.0, self.height), max(0.0, self.height)
        return max(hypot(x, y) - self.radius, low - z, z - high)


@dataclass(frozen=True, slots=True)
class Ball:
    """Around a point."""

    centre: Vector
    radius: float

    def depth(self, point: Sequence[float]) -> float:
        """See Shape."""
        x, y, z = point
        return distance((x, y, z), self.centre) - self.radius


@dataclass(frozen=True, slots=True)
class JointSpace:
    """Ranges of axes, in wire order; infinite where an axis is not supervised."""

    low: Posture
    high: Posture

    def depth(self, point: Sequence[float]) -> float:
        """See Shape: inside are all supervised axes, outside is any of them."""
        return max(
            max(low - q, q - high) for q, low, high in zip(point, self.low, self.high, strict=True)
        )


@dataclass(frozen=True, slots=True)
class WorldZone:
    """A shape, or (`outside`) all that is not in it."""

    shape: Shape
    outside: bool = False

    def depth(self, point: Sequence[float]) -> float:
        """How far from being in the zone a point is, at least; negative: in it."""
        result = self.shape.depth(point)
        return -result if self.outside else result


class ZoneWatch:
    """One zone that is watched for one robot: `enter(True)` when it is reached, else False."""

    def __init__(
        self,
        scheduler: Scheduler,
        group: MotionGroup,
        zone: WorldZone,
        act: Callable[[bool], None],
        *,
        ahead: bool,
    ) -> None:
        """`ahead`: already where the robot could no longer stop before the zone."""
        self._scheduler = scheduler
        self._group = group
        self._zone = zone
        self._act = act
        self._ahead = ahead
        self._timer: Timer | None = None
        self.inside = False

    def start(self) -> None:
        """Watch from now on, and report the present state."""
        self._group.observers.append(self._moved)
        self.inside = self._depth(self._group.motion, self._scheduler.now) <= 0.0
        self._act(self.inside)
        self._moved(self._group.motion)

    def stop(self) -> None:
        """Watch no more."""
        self._group.observers.remove(self._moved)
        if self._timer is not None:
            self._timer.cancel()

    def _moved(self, _motion: Motion) -> None:
        """Examine a new motion after the event that began it."""
        self._expect((self._scheduler.now, self._look))

    def _expect(self, due: tuple[int, Callable[[], None]] | None) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None if due is None else self._scheduler.at(*due)

    def _look(self) -> None:
        """What holds at the beginning of a motion; inside the zone it is reported each time."""
        self._expect(None)
        inside = self._depth(self._group.motion, self._scheduler.now) <= 0.0
        if inside or self.inside:
            self._tell(inside)
        else:
            self._expect(self._next(self._group.motion))

    def _tell(self, inside: bool) -> None:
        motion, self.inside = self._group.motion, inside
        self._act(inside)
        if self._group.motion is motion:  # else acting has begun another one
            self._expect(self._next(motion))

    def _next(self, motion: Motion) -> tuple[int, Callable[[], None]] | None:
        """The next moment at which the robot changes sides, and its report."""
        before = self._scheduler.now
        fastest, depth = self._fastest(motion), self._depth(motion, before)
        while before < motion.end:
            step = max(_SHORTEST_STEP, int(abs(depth) / fastest * S))
            then = min(before + step, motion.end)
            depth = self._depth(motion, then)
            if (depth <= 0.0) is not self.inside:
                return self._crossing(motion, before, then), partial(self._tell, not self.inside)
            before = then
        return None

    def _crossing(self, motion: Motion, before: int, then: int) -> int:
        """The last moment on this side: a robot that stops then stays on it."""
        while then - before > _CLOSE:
            middle = (before + then) // 2
            if (self._depth(motion, middle) <= 0.0) is self.inside:
                before = middle
            else:
                then = middle
        return before

    def _fastest(self, motion: Motion) -> float:
        """What the depth changes by in a s, at most. Stopping short adds as much again."""
        if isinstance(self._zone.shape, JointSpace):
            result = max(joint.speed for joint in self._group.config.joints)
        else:
            paths = [piece.tcp * piece.programmed for piece in motion.pieces]
            known = motion.coast is None and all(paths)
            result = max(paths, default=_FASTEST_TCP) if known else _FASTEST_TCP
        return 2 * result if self._ahead else result

    def _depth(self, motion: Motion, now: int) -> float:
        depth = self._zone.depth(self._point(motion, now, motion.posture(now)))
        if not self._ahead or now >= motion.end or motion.coast is not None:
            return depth
        stops = posture_at(motion.pieces, _standstill(motion, now), motion.rest)
        return min(depth, self._zone.depth(self._point(motion, now, stops)))

    def _point(self, motion: Motion, now: int, posture: Posture) -> Sequence[float]:
        if isinstance(self._zone.shape, JointSpace):
            return posture
        move = motion.move(now)
        if move is not None and move.carrier.stationary:
            return move.carrier.tool[0]
        tool = self._group.planner.tool if move is None else move.carrier.tool
        return compose(self._group.geometry().forward(posture), tool)[0]


def _standstill(motion: Motion, now: int) -> float:
    """Where on the path the robot would stand if it began to brake now."""
    return brake(motion.pieces, *motion.planned(now)).place


@dataclass(slots=True)
class _Entry:
    group: MotionGroup
    watch: ZoneWatch
    stationary: bool
    enabled: bool = True


class WorldZones:
    """All zones of one controller, by number from 1."""

    def __init__(self, scheduler: Scheduler, groups: Iterable[MotionGroup]) -> None:
        self._scheduler = scheduler
        self._zones: dict[int, _Entry] = {}
        for group in groups:
            group.on_reset.append(partial(self._drop_temporary, group))

    def __len__(self) -> int:
        return len(self._zones)

    def __contains__(self, number: int) -> bool:
        return number in self._zones

    def add(
        self,
        group: MotionGroup,
        zone: WorldZone,
        act: Callable[[bool], None],
        *,
        ahead: bool,
        stationary: bool,
        expected: int = 0,
    ) -> int:
        """Watch a zone for a robot; its number, the wanted one if that is free."""
        number = expected if expected > 0 and expected not in self._zones else 1
        while number in self._zones:
            number += 1
        watch = ZoneWatch(self._scheduler, group, zone, act, ahead=ahead)
        watch.start()
        self._zones[number] = _Entry(group, watch, stationary)
        return number

    def is_stationary(self, number: int) -> bool:
        """Whether a zone stays as it is until the next warm start."""
        return number in self._zones and self._zones[number].stationary

    def enable(self, number: int, on: bool) -> None:
        """Watch again, or for the time being not. KeyError: there is no such zone."""
        entry = self._zones[number]
        if on is not entry.enabled:
            entry.enabled = on
            (entry.watch.start if on else entry.watch.stop)()

    def drop(self, number: int) -> None:
        """Forget a zone, if there is such a one."""
        entry = self._zones.pop(number, None)
        if entry is not None and entry.enabled:
            entry.watch.stop()

    def _drop_temporary(self, group: MotionGroup) -> None:
        """PP to main: the temporary zones of a robot are gone."""
        for number, entry in list(self._zones.items()):
            if entry.group is group and not entry.stationary:
                self.drop(number)

    def drop_all(self) -> None:
        """A warm start: event routines of POWER ON define the stationary ones anew."""
        for number in list(self._zones):
            self.drop(number)
