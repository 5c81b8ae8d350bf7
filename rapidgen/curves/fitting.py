"""From a placed curve to few moves: number, waypoints, zones and speed.

Lines whose zones are half of their lengths make a smooth path: at each waypoint the planner
replaces the corner by a parabola that begins and ends in the middle of the lines, so the path is a
quadratic B-spline with the waypoints as control points. Direction and speed never jump, axes do not
brake in corners, and few lines follow a curve that many lines with small zones only approximate.

Control points are not on the curve. They are found by iteration: the path is predicted with all
effects of the controller (size of corners, smoothing in time, axis limits), and each waypoint moves
by what the path misses the curve by next to it, in position and tool axis. The iteration keeps its
best result.

Before and after the curve the program goes on straight (lead), so that the robot is up to speed at
the start and brakes after the end.

- `fit` chooses the smallest number of moves at a speed;
- `fit_fastest` chooses the highest speed at a given uniformity, then the smallest number of moves;
- `equally_spaced` is the comparison: points on the curve at equal distances, small zones.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Final

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Posture
from rapidgen.config.model import GroupConfig
from rapidgen.curves.curve import Array, Curve
from rapidgen.curves.placement import Placement, lead_for
from rapidgen.curves.prediction import (
    CurveProgram,
    Prediction,
    Predictor,
    Waypoint,
)
from rapidgen.motion.fault_reasons import MotionFault

ROUNDS: Final = 8
"""Iterations of the waypoints."""
FEWEST, MOST = 3, 60
"""Moves that are tried by default."""
_RESERVE: Final = 0.98
"""Share of the tolerance that a fit may use: targets are rounded when they are written."""
_GAIN: Final = 0.9
_CALM: Final = 0.6
"""Share of the allowed angle below which orientations are not corrected."""
_HIGHEST: Final = 2.5
"""Speed that is tried first, in units of what the axes allow by the estimate of the placement."""
_SLOWER: Final = 0.85
_SPEEDS: Final = 22
_REFINED: Final = 4
_SHORTEST: Final = 0.002
"""m of the shortest circle."""
_FLATTEST: Final = 20.0
"""m of radius above which a circle is a line."""
_ARC_ZONE: Final = 0.01
"""m of the zone between two circles: they meet without a corner, almost."""
_SHARES: Final = (0.25, 0.33, 0.4, 0.5, 0.7, 1.0)
"""Shares of the allowed number of moves that are tried at a speed."""


@dataclass(frozen=True, slots=True)
class Requirement:
    """What a fit has to keep."""

    tolerance: float
    """m."""
    angle: float
    """rad between the tool axis and that of the curve."""
    uniformity: float = math.inf
    """Standard deviation of the speed as a share of its mean."""
    most_moves: int = MOST


@dataclass(frozen=True)
class Fit:
    """A program with its prediction."""

    program: CurveProgram
    prediction: Prediction
    placement: Placement

    @property
    def moves(self) -> int:
        """Return the number of moves on the curve, lead included."""
        return len(self.program.waypoints)

    def keeps(self, wanted: Requirement) -> bool:
        """True if the prediction is within the requirement."""
        own = self.prediction
        return (
            own.largest_deviation <= wanted.tolerance * _RESERVE
            and own.largest_angle <= wanted.angle * _RESERVE
            and own.speed_deviation <= wanted.uniformity
        )


class Fitter:
    """Fits moves to one placed curve."""

    def __init__(self, group: GroupConfig, tool: Pose, placement: Placement) -> None:
        self.placement, self.tool = placement, tool
        self.curve: Curve = placement.curve
        self.predictor = Predictor(group, self.curve)
        self.fault: MotionFault | None = None
        """Why the last program was rejected."""
        self._back = frames.invert(tool)

    def fit(self, speed: float, wanted: Requirement) -> Fit | None:
        """Return the fit with the fewest moves at a speed, or the best if none is within.

        None: the planner rejects every program.
        """
        best: Fit | None = None
        count = FEWEST
        failed = FEWEST - 1
        while True:
            found = self.with_moves(count, speed, wanted)
            if found is not None and (best is None or _worse(best, found, wanted)):
                best = found
            if (found is not None and found.keeps(wanted)) or count >= wanted.most_moves:
                break
            failed, count = count, min(max(count + 1, round(count * 1.6)), wanted.most_moves)
        if best is None or not best.keeps(wanted):
            return best
        arcs = self.with_arcs(speed, wanted)
        if arcs is not None and arcs.keeps(wanted) and arcs.moves < best.moves:
            best = arcs
        low, high = failed, best.moves
        while high - low > 1:
            middle = (low + high) // 2
            found = self.with_moves(middle, speed, wanted)
            if found is not None and found.keeps(wanted):
                best, high = found, middle
            else:
                low = middle
        return best

    def fit_fastest(self, wanted: Requirement) -> Fit | None:
        """Return the fit of the highest speed, with the fewest moves at 99 % of that speed."""
        best = self._fastest(wanted, lambda speed: self._best_of(speed, wanted))
        if best is None or not best.keeps(wanted):
            return best
        slower = self.fit(0.99 * best.program.speed, wanted)
        return slower if slower is not None and slower.keeps(wanted) else best

    def _best_of(self, speed: float, wanted: Requirement) -> Fit | None:
        """Return the best of some numbers of moves at a speed."""
        best: Fit | None = None
        for share in _SHARES:
            found = self.with_moves(max(FEWEST, round(share * wanted.most_moves)), speed, wanted)
            if found is not None and (best is None or _worse(best, found, wanted)):
                best = found
                if best.keeps(wanted):
                    break
        return best

    def _fastest(self, wanted: Requirement, at: Callable[[float], Fit | None]) -> Fit | None:
        """Return the fit of the highest speed that keeps the requirement.

        Deviations do not grow with the speed alone, so the search goes down from above; a binary
        search would miss speeds that are possible.
        """
        failed = _HIGHEST * self.placement.speed
        best: Fit | None = None
        for _ in range(_SPEEDS):
            best = at(failed)
            if best is not None and best.keeps(wanted):
                break
            failed *= _SLOWER
        if best is None or not best.keeps(wanted):
            return best
        low, high = best.program.speed, best.program.speed / _SLOWER
        for _ in range(_REFINED):
            middle = (low + high) / 2
            found = at(middle)
            if found is not None and found.keeps(wanted):
                best, low = found, middle
            else:
                high = middle
        return best

    def with_moves(self, count: int, speed: float, wanted: Requirement) -> Fit | None:
        """Return the best program of a number of lines at a speed; None: all are rejected."""
        before, after = (min(lead_for(speed), lead) for lead in self.placement.leads)
        s = np.linspace(-before, self.curve.length + after, count + 1)
        poses = self._poses(s)
        start = self._start(poses[0], s[0])
        if start is None:
            return None
        best: Fit | None = None
        for _ in range(ROUNDS):
            program = CurveProgram(start, _half_zones(poses), speed, self.tool)
            result = self.predictor.predict(program)
            if isinstance(result, MotionFault):
                self.fault = result
                break
            found = Fit(program, result, self.placement)
            if best is None or _worse(best, found, wanted):
                best = found
                if found.keeps(wanted):
                    break
            elif result.speed_deviation > 2 * wanted.uniformity:
                break  # Axes at their limits: waypoints cannot help.
            poses = self._corrected(poses, s, result, wanted)
        return best

    def with_arcs(self, speed: float, wanted: Requirement) -> Fit | None:
        """Return circles through points of the curve, between two lines: the leads.

        Each circle is the longest whose middle and quarters are within half of the tolerance.
        """
        before, after = (min(lead_for(speed), lead) for lead in self.placement.leads)
        length = self.curve.length
        ends = [0.0]
        while ends[-1] < length - 1e-9:
            if len(ends) > wanted.most_moves:
                return None
            low, high = 0.0, length - ends[-1]
            if not self._is_arc(ends[-1], ends[-1] + high, wanted):
                for _ in range(12):
                    middle = (low + high) / 2
                    if self._is_arc(ends[-1], ends[-1] + middle, wanted):
                        low = middle
                    else:
                        high = middle
                high = max(low, _SHORTEST)
            ends.append(min(ends[-1] + high, length))
        s = np.array([-before, *ends, length + after])
        poses = self._poses(s)
        middles = self._poses((s[1:-2] + s[2:-1]) / 2)
        start = self._start(poses[0], -before)
        if start is None:
            return None
        lengths = np.diff(s)
        zones = np.minimum(np.minimum(lengths[:-1], lengths[1:]) / 2, _ARC_ZONE)
        vias = [None, *middles, None]
        program = CurveProgram(
            start,
            tuple(
                Waypoint(pose, zone, via)
                for pose, zone, via in zip(poses[1:], [*zones.tolist(), 0.0], vias, strict=True)
            ),
            speed,
            self.tool,
        )
        result = self.predictor.predict(program)
        if isinstance(result, MotionFault):
            self.fault = result
            return None
        return Fit(program, result, self.placement)

    def _is_arc(self, begin: float, end: float, wanted: Requirement) -> bool:
        """True if the circle through ends and middle of a section follows it."""
        s = np.linspace(begin, end, 9)
        places, axes, _ = self.curve.at(s)
        first, middle, last = places[0], places[4], places[8]
        way, half = last - first, middle - first
        across = np.cross(half, way)
        area = float(across @ across)
        turned = float(np.max(np.arccos(np.clip(np.sum(axes * _spread(axes), axis=1), -1.0, 1.0))))
        if turned > wanted.angle / 2:
            return False
        if area < 1e-18:
            return False
        offset = np.cross(float(half @ half) * way - float(way @ way) * half, across) / (-2 * area)
        centre = first - offset
        radius = float(np.linalg.norm(offset))
        normal = across / math.sqrt(area)
        out = (places - centre) @ normal
        level = np.linalg.norm(places - centre - out[:, None] * normal, axis=1)
        apart = np.hypot(out, level - radius)
        # A controller limits a circle to 240 degrees; half a turn is far from that.
        is_short = end - begin < math.pi * radius and radius < _FLATTEST
        return is_short and bool(np.all(apart <= wanted.tolerance / 2))

    def equally_spaced(self, count: int, zone: float, speed: float) -> Fit | None:
        """Return points on the curve at equal distances with zones of one size, as programmed by
        hand: the comparison of benchmarks."""
        before, after = (min(lead_for(speed), lead) for lead in self.placement.leads)
        length = self.curve.length
        s = np.concatenate([[-before], np.linspace(0.0, length, count - 1), [length + after]])
        poses = self._poses(s)
        start = self._start(poses[0], -before)
        if start is None:
            return None
        waypoints = tuple(Waypoint(pose, zone) for pose in poses[1:])
        program = CurveProgram(start, waypoints, speed, self.tool)
        result = self.predictor.predict(program)
        if isinstance(result, MotionFault):
            return None
        return Fit(program, result, self.placement)

    def fastest_equally_spaced(
        self, wanted: Requirement, counts: Sequence[int], zone: float
    ) -> Fit | None:
        """Return the fastest of equally spaced programs that keeps the requirement."""
        best: Fit | None = None
        for count in counts:
            found = self._fastest(wanted, partial(self.equally_spaced, count, zone))
            if found is not None and (best is None or found.program.speed > best.program.speed):
                best = found
        return best

    def _poses(self, s: Array) -> list[Pose]:
        inside = np.clip(s, 0.0, self.curve.length)
        return self.curve.poses(s, self.placement.rotation(inside))

    def _start(self, pose: Pose, s: float) -> Posture | None:
        """Return the posture at the beginning of the lead, on the branch of the curve's start."""
        near = self.placement.start
        for part in np.linspace(0.0, s, 8).tolist():
            flange = frames.compose(self._poses(np.array([part]))[0], self._back)
            found = self.predictor.kinematics.follow(flange, near)
            if found is None:
                return None
            near = found
        return near

    def _corrected(
        self, poses: list[Pose], s: Array, result: Prediction, wanted: Requirement
    ) -> list[Pose]:
        """Return waypoints moved by what the path misses the curve by next to them."""
        order = np.argsort(result.s, kind="stable")
        along = result.s[order]
        target, axis, _ = self.curve.at(along)
        missed = target - result.positions[order]
        has = result.tool_axes[order]
        turned = np.cross(has, axis)
        # Orientations are smooth as they are: they are corrected only where the tolerance needs it.
        turning = _GAIN if result.largest_angle > _CALM * wanted.angle else 0.0
        corrected = []
        for row, pose in enumerate(poses):
            if row in (0, len(poses) - 1):
                corrected.append(pose)
                continue
            move = [float(np.interp(s[row], along, missed[:, k])) for k in range(3)]
            turn = [float(np.interp(s[row], along, turned[:, k])) for k in range(3)]
            place = frames.add(pose[0], (_GAIN * move[0], _GAIN * move[1], _GAIN * move[2]))
            size = math.sqrt(sum(v * v for v in turn))
            orientation = pose[1]
            if turning * size > 1e-9:
                about = frames.about(
                    (turn[0] / size, turn[1] / size, turn[2] / size), turning * size
                )
                orientation = frames.normalise(frames.multiply(about, orientation))
            corrected.append((place, orientation))
        return corrected


def _spread(axes: Array) -> Array:
    """Return axes that turn evenly from the first over the middle to the last of nine."""
    part = np.linspace(0.0, 1.0, 5)[:, None]
    spread = np.concatenate(
        [axes[0] * (1 - part) + axes[4] * part, (axes[4] * (1 - part) + axes[8] * part)[1:]]
    )
    result: Array = spread / np.linalg.norm(spread, axis=1, keepdims=True)
    return result


def _half_zones(poses: Sequence[Pose]) -> tuple[Waypoint, ...]:
    """Return lines whose zones are half of the shorter line at each waypoint."""
    lengths = [frames.distance(a[0], b[0]) for a, b in pairwise(poses)]
    zones = [min(a, b) / 2 for a, b in pairwise(lengths)]
    return tuple(Waypoint(pose, zone) for pose, zone in zip(poses[1:], [*zones, 0.0], strict=True))


def _worse(one: Fit, other: Fit, wanted: Requirement) -> bool:
    """True if `one` is further from the requirement than `other`."""
    return _excess(one, wanted) > _excess(other, wanted)


def _excess(fit: Fit, wanted: Requirement) -> float:
    own = fit.prediction
    shares = [
        own.largest_deviation / wanted.tolerance,
        own.largest_angle / wanted.angle,
        own.speed_deviation / wanted.uniformity if math.isfinite(wanted.uniformity) else 0.0,
    ]
    return max(shares)
