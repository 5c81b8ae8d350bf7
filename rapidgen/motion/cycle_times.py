"""Duration of every move, what limits it, and when the robot stands.

The recorder evaluates each motion when the next one replaces it, so it keeps a few figures a move
and no samples. Times of the robot are those at which it passes the middle of a corner or stands.
The planned motion is ahead of the robot by the smoothing (`smoothing.py`): its phases say what
limits a move; what a move takes longer than its phases belongs to the stops at its ends.
"""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass, field
from math import inf

from rapidgen.axes import frames
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion.active_limits import (
    FINE_POINT,
    GUIDED,
    RETURN,
    STOP,
    Ceilings,
    active_limit,
    stop_cause,
)
from rapidgen.motion.braking import GuidedStep
from rapidgen.motion.drive import MANUAL_REDUCED
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.legs import Leg
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import FINE, MoveFrames, Zone
from rapidgen.motion.path import piece_at

_PERIOD = 0.02
"""s between the samples of the TCP's speed in a move."""
_NONE = 1e-9
"""s that count as no time."""


@dataclass(slots=True)
class MoveTime:
    """What one executed move took; s from the controller's start, m, m/s."""

    place: object | None
    """Location in the program."""
    zone: Zone
    programmed: float
    """TCP speed."""
    start: float
    end: float = 0.0
    duration: float = 0.0
    """Time of movement; stops within the move are not part of it."""
    length: float = 0.0
    """Path of the TCP."""
    fastest: float = 0.0
    """Largest TCP speed."""
    limits: dict[str, float] = field(default_factory=dict)
    """Limit and the time during which it was active."""
    stop: str = ""
    """Why the robot stands at the end; empty if it does not."""

    def add(self, limit: str, seconds: float) -> None:
        """Count time for a limit."""
        self.limits[limit] = self.limits.get(limit, 0.0) + seconds

    @property
    def limit(self) -> str:
        """The limit that was active the longest."""
        return max(self.limits, key=self.limits.__getitem__, default="")


class CycleTimes:
    """Moves and standstills of one group from its making on; `finish` at the end."""

    def __init__(self, scheduler: Scheduler, group: MotionGroup) -> None:
        self.group = group
        self.start = scheduler.now / S
        self.end = self.start
        self.moves: list[MoveTime] = []
        """In the order in which they ended."""
        self.standing: list[tuple[float, float]] = []
        """Intervals in which the robot stands, s."""
        self._scheduler = scheduler
        self._open: dict[Leg, MoveTime] = {}
        self._done: set[Leg] = set()
        """Legs that the robot has passed and that are still on the path."""
        self._stood = 0.0
        self._motion = group.motion
        self._ceilings = self._now()
        self._carrier: MoveFrames | None = None
        self._sampled = self.start
        """s of the last sample of the TCP."""
        self._point: frames.Vector = (0.0, 0.0, 0.0)
        self._shares: list[tuple[MoveTime, float]] = []
        """Moves since the last sample, with their seconds."""
        self._stop = FINE_POINT
        """Why the robot stands at the beginning of the next leg; empty if it does not."""
        group.observers.append(self._replaced)

    def finish(self) -> None:
        """Evaluate the motion up to now and end; harmless when it has ended."""
        if self._replaced not in self.group.observers:
            return
        self.group.observers.remove(self._replaced)
        self.end = self._scheduler.now / S
        self._evaluate(self._motion, self._scheduler.now)
        for leg in list(self._open):
            self._close(leg, "")

    def stood(self, now: int) -> float:
        """Return how long the robot has stood up to a time (ns) of the present motion, s."""
        begin = max(self._motion.end, self._motion.since) / S
        return self._stood + max(0.0, now / S - begin)

    def _now(self) -> Ceilings:
        group = self.group
        tcp = group.modal.point_limit if group.speed_limited else inf
        reduced = MANUAL_REDUCED if group.reduced else inf
        return Ceilings(group.override * group.refresh, min(tcp, reduced))

    def _replaced(self, motion: Motion) -> None:
        self._evaluate(self._motion, motion.since)
        for leg in set(self._open).difference(motion.legs):
            self._close(leg, STOP)  # taken off the path, or put aside with it
        self._done.intersection_update(motion.legs)
        self._motion = motion
        self._ceilings = self._now()

    # -- one motion, from its beginning until another one replaced it --------------------------

    def _evaluate(self, motion: Motion, until: int) -> None:
        end = min(until, motion.end)
        if end > motion.since and motion.legs:
            passed = self._follow(motion, motion.since / S, end / S)
            self._find_limits(motion, end)
            for leg in passed:
                self._done.add(leg)
                self._close(leg, stop_cause(leg))
        elif end > motion.since:
            self._add_unprogrammed(motion, end)
        begin = max(motion.end, motion.since) / S
        if until / S > begin:
            self._stood += until / S - begin
            if self.standing and self.standing[-1][1] >= begin - _NONE:
                begin = self.standing.pop()[0]
            self.standing.append((begin, until / S))

    def _follow(self, motion: Motion, begin: float, end: float) -> list[Leg]:
        """Divide an interval of movement among the legs; return those that were passed."""
        result = []
        for leg in motion.legs:
            if leg in self._done:
                continue
            passed = inf
            if leg.end <= motion.law.place + _NONE and motion.coast is None:
                passed = motion.time_at(leg.end)
            high = min(end, max(begin, passed))
            if high > begin or passed <= end:
                self._sample(motion, leg, begin, high)
                begin = high
            if passed > end + _NONE:
                break
            result.append(leg)
        return result

    def _timing(self, leg: Leg, begin: float) -> MoveTime:
        if leg not in self._open:
            move = leg.move
            place = move.place() if move.place is not None else None
            self._open[leg] = MoveTime(place, move.zone, move.speed.tcp, begin, begin)
        return self._open[leg]

    def _sample(self, motion: Motion, leg: Leg, begin: float, end: float) -> None:
        """Add the time and the TCP's path between two times."""
        timing = self._timing(leg, begin)
        if not timing.duration:
            timing.start = begin
        timing.duration += end - begin
        timing.end = end
        if self.group.kinematics is None:
            return
        carrier = leg.move.carrier
        if carrier != self._carrier or begin > self._sampled + _PERIOD + _NONE:
            self._measure(motion, begin)
            self._carrier = carrier
            self._sampled, self._point = begin, self._tcp(motion, begin)
        # Samples have a fixed distance in time: a dense path costs no more than a long move.
        while self._sampled + _PERIOD < end:
            self._shares.append((timing, self._sampled + _PERIOD - begin))
            begin = self._sampled + _PERIOD
            self._measure(motion, begin)
        self._shares.append((timing, end - begin))
        if round(end * S) >= motion.end:
            self._measure(motion, end)

    def _measure(self, motion: Motion, time: float) -> None:
        """Sample the TCP, and divide its path since the last sample among the moves."""
        elapsed = sum(seconds for _, seconds in self._shares)
        if elapsed > _NONE:
            point = self._tcp(motion, time)
            speed = frames.distance(self._point, point) / elapsed
            for timing, seconds in self._shares:
                timing.length += speed * seconds
                timing.fastest = max(timing.fastest, speed)
            self._point = point
        self._shares.clear()
        self._sampled = time

    def _tcp(self, motion: Motion, time: float) -> frames.Vector:
        kinematics, carrier = self.group.geometry(), self._carrier
        pose = kinematics.forward(motion.posture(round(time * S)))
        if carrier is None or carrier.stationary:
            return pose[0]
        return frames.compose(pose, carrier.tool)[0]

    def _find_limits(self, motion: Motion, until: int) -> None:
        """Count the phases of the planned motion for the legs."""
        law, joints, legs = motion.law, self.group.config.joints, motion.legs
        times, places, speeds, accelerations = law.phases
        begin, end = (motion.since - motion.start) / S, (until - motion.start) / S
        if motion.coast is not None:
            limit = GUIDED if isinstance(motion.coast, GuidedStep) else STOP
            self._timing(legs[0], motion.since / S).add(limit, end - begin)
            return
        braking = law.place < legs[-1].end - _NONE
        for i in range(max(0, bisect_right(times, begin) - 1), bisect_left(times, end)):
            low = max(begin, times[i])
            high = min(end, times[i + 1] if i + 1 < len(times) else law.duration)
            if high - low < _NONE:
                continue
            t, a = (low + high) / 2 - times[i], accelerations[i]
            state = places[i] + (speeds[i] + a * t / 2) * t, speeds[i] + a * t, a
            leg = _leg_at(legs, state[0])
            if leg in self._done:
                continue
            piece = piece_at(motion.pieces, state[0] - _NONE)
            if piece.end <= legs[0].begin + _NONE:
                limit = RETURN
            elif braking and a < 0.0:
                limit = STOP
            else:
                limit = active_limit(piece, leg, state, joints, self._ceilings)
            self._timing(leg, motion.since / S).add(limit, high - low)

    def _add_unprogrammed(self, motion: Motion, until: int) -> None:
        """Count movement without a move on the path; steps of one motion are one row."""
        limit = GUIDED if isinstance(motion.coast, GuidedStep) else STOP
        begin, end = motion.since / S, until / S
        last = self.moves[-1] if self.moves else None
        if last is None or limit not in last.limits or last.end < begin - _NONE:
            last = MoveTime(None, FINE, inf, begin)
            self.moves.append(last)
        last.end = end
        last.duration += end - begin
        last.add(limit, end - begin)

    def _close(self, leg: Leg, stop: str) -> None:
        """Let the limits of an ended leg add up to its duration."""
        timing = self._open.pop(leg)
        timing.stop = stop
        counted = sum(timing.limits.values())
        rest = timing.duration - counted
        cause = STOP if STOP in timing.limits else timing.stop or self._stop
        if rest > 0.0 and cause:
            timing.add(cause, rest)
        elif counted > 0.0:
            share = timing.duration / counted
            timing.limits = {limit: share * s for limit, s in timing.limits.items()}
        self._stop = timing.stop
        self.moves.append(timing)


def _leg_at(legs: tuple[Leg, ...], place: float) -> Leg:
    index = bisect_left(legs, place - _NONE, key=lambda leg: leg.end)
    return legs[min(index, len(legs) - 1)]
