"""Rotation about the tool axis, configuration and place of a curve.

The tool may turn freely about its axis when a curve gives normals. The rotation is a constant plus
a constant rate, on top of a frame that turns no more than the axis does, so it is as smooth as the
normals. Among all rotations and configurations the one is chosen with the largest speed that the
whole curve allows: at every sample the axis speeds and accelerations bound it,

    v <= speed_j / |dq_j/ds|,    v^2 <= acceleration_j / |d2q_j/ds2|

near a singularity dq/ds grows without bound and near the end of the reach d2q/ds2 does, so that
both are avoided. Axes keep a margin to their ranges.

`place` moves the curve as a rigid body in the robot's workspace for the same aim: random
places, and the best ones improved by smaller and smaller steps (seeded, so that a result can be
repeated).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.curves.curve import Array, Curve
from rapidgen.motion.accelerations import of_posture

MARGIN: Final = math.radians(3.0)
"""rad, or m/20, that axes keep from the ends of their ranges."""
SAMPLES: Final = 60
_COARSE_SAMPLES: Final = 24
_ROTATIONS: Final = 24
_RATES: Final = (-0.5, 0.0, 0.5)
"""Turns of the tool about its axis over the whole curve that are tried, in units of pi."""
_LEAD_TIME, _LEAD_ACCELERATION = 0.12, 2.5
_LEAD_STEP: Final = 0.05
_LEAD_STEPS: Final = 12
_PLACES: Final = 400
_IMPROVED: Final = 6
_STEPS: Final = 40


@dataclass(frozen=True)
class Placement:
    """A curve that the robot can follow."""

    curve: Curve
    moved: Pose
    """How the curve was moved; the identity without `place`."""
    constant: float
    """Rotation about the tool axis at the start, rad."""
    rate: float
    """rad/m."""
    start: Posture
    """Posture at the start of the curve."""
    speed: float
    """Speed that the axes and the leads allow on the whole curve, m/s."""
    leads: tuple[float, float]
    """Straight ways before and after the curve that the arm reaches, m."""

    def rotation(self, s: Array) -> Array:
        """Return the rotation about the tool axis at arc lengths, rad."""
        result: Array = self.constant + self.rate * s
        return result


def lead_for(speed: float) -> float:
    """Return the straight way in which a robot gets up to a speed, m: estimated."""
    return speed * _LEAD_TIME + speed * speed / (2 * _LEAD_ACCELERATION)


def speed_after(lead: float) -> float:
    """Return the speed that a robot has after a straight way, m/s."""
    time = _LEAD_ACCELERATION * _LEAD_TIME
    return math.sqrt(time * time + 2 * _LEAD_ACCELERATION * lead) - time


class Placer:
    """Finds postures along curves for one arm and tool."""

    def __init__(self, kinematics: Kinematics, tool: Pose) -> None:
        self.kinematics = kinematics
        self._back = frames.invert(tool)
        joints = kinematics.group.joints
        self._speeds = np.array([joint.speed for joint in joints])
        self._accelerations = of_posture(kinematics.group)
        self._usual = np.array([joint.acceleration for joint in joints])
        margins = [MARGIN if joint.kind == "revolute" else MARGIN / 20 for joint in joints]
        moved = [joint.axis.startswith("rax") for joint in joints]
        self._low = [
            joint.lower + m if rax else -math.inf
            for joint, m, rax in zip(joints, margins, moved, strict=True)
        ]
        self._high = [
            joint.upper - m if rax else math.inf
            for joint, m, rax in zip(joints, margins, moved, strict=True)
        ]
        self._home = usual_start(kinematics.group)
        self.furthest: tuple[float, float] = (0.0, 0.0)
        """Arc length that the best rejected candidate reached, and its distance from the base."""

    def postures(self, poses: Sequence[Pose], start: Posture) -> list[Posture] | None:
        """Return postures along flange poses on the branch of a start; None: not all the way."""
        result = [start]
        for pose in poses[1:]:
            posture = self.kinematics.follow(pose, result[-1])
            if posture is None or not self._inside(posture):
                return None
            result.append(posture)
        return result

    def speed(self, postures: Sequence[Posture], step: float) -> float:
        """Return the largest uniform speed along postures at equal steps of the path, m/s."""
        q = np.array(postures)
        first = np.abs(np.gradient(q, step, axis=0))
        second = np.abs(np.diff(q, 2, axis=0)) / step**2
        limits = self._usual[None, :]
        if self._accelerations is not None:
            limits = np.array([self._accelerations(tuple(row)) for row in q[1:-1].tolist()])
        by_speed = float(np.min(self._speeds / np.maximum(first.max(axis=0), 1e-9)))
        by_acceleration = float(np.sqrt(np.min(limits / np.maximum(second, 1e-9))))
        return min(by_speed, by_acceleration)

    def leads(
        self, curve: Curve, rotations: tuple[float, float], postures: Sequence[Posture]
    ) -> tuple[float, float]:
        """Return the straight ways before and after the curve that the arm reaches, m."""
        result = []
        for end, away, turn, near in (
            (0.0, -_LEAD_STEP, rotations[0], postures[0]),
            (curve.length, _LEAD_STEP, rotations[1], postures[-1]),
        ):
            s: Array = end + away * np.arange(1.0, _LEAD_STEPS + 1.0)
            reached = 0
            for pose in curve.poses(s, np.full(len(s), turn)):
                posture = self.kinematics.follow(frames.compose(pose, self._back), near)
                if posture is None or not self._inside(posture):
                    break
                near, reached = posture, reached + 1
            result.append(reached * _LEAD_STEP)
        return result[0], result[1]

    def candidates(
        self, curve: Curve, samples: int, rotations: Sequence[tuple[float, float]]
    ) -> Iterator[tuple[float, float, float, Posture]]:
        """Yield speed, rotation, rate and first posture of what follows the whole curve."""
        s = np.linspace(0.0, curve.length, samples)
        step = curve.length / (samples - 1)
        for constant, rate in rotations:
            poses = [
                frames.compose(pose, self._back) for pose in curve.poses(s, constant + rate * s)
            ]
            for start in self._starts(poses[0]):
                postures = self.postures(poses, start)
                if postures is not None:
                    ends = constant, constant + rate * curve.length
                    leads = self.leads(curve, ends, postures)
                    speed = min(self.speed(postures, step), speed_after(min(leads)))
                    yield speed, constant, rate, start

    def reached(self, curve: Curve) -> float:
        """Return the share of curve points that the arm reaches in some rotation, 0 to 1."""
        s = np.linspace(0.0, curve.length, _COARSE_SAMPLES)
        found = np.zeros(len(s), dtype=bool)
        for turn in self._turns(curve, 8):
            for row, pose in enumerate(curve.poses(s, np.full(len(s), turn))):
                if not found[row]:
                    found[row] = any(self._starts(frames.compose(pose, self._back)))
        return float(found.mean())

    def best(self, curve: Curve) -> Placement | None:
        """Return the best rotation and configuration; None: none follows the whole curve."""
        rates = [0.0]
        if not curve.is_pose:
            rates = [k * math.pi / curve.length for k in _RATES]
        grid = [(turn, rate) for turn in self._turns(curve, _ROTATIONS) for rate in rates]
        found = sorted(
            self.candidates(curve, _COARSE_SAMPLES, grid), key=lambda c: c[0], reverse=True
        )[:_IMPROVED]
        result: Placement | None = None
        for _, constant, rate, start in found:
            improved = self._improved(curve, constant, rate, start)
            if improved is not None and (result is None or improved.speed > result.speed):
                result = improved
        return result

    def place(self, curve: Curve, seed: int = 0) -> Placement | None:
        """Return the best place, rotation and configuration in the robot's workspace."""
        random = np.random.default_rng(seed)
        centre = (curve.positions.min(axis=0) + curve.positions.max(axis=0)) / 2
        reach = self._reach()
        turns = self._turns(curve, 6)
        pool: list[tuple[float, Pose]] = []
        for _ in range(_PLACES):
            distance = reach * random.uniform(0.35, 0.95)
            height = reach * random.uniform(-0.2, 0.7)
            bearing = random.uniform(-0.5, 0.5)
            level = math.sqrt(max(distance**2 - height**2, 0.01))
            at = (level * math.cos(bearing), level * math.sin(bearing), height)
            pose = _about(centre, at, _any_turn(random))
            pool.append((self._value(curve.placed(pose), turns), pose))
        pool.sort(key=lambda entry: entry[0], reverse=True)
        best: Placement | None = None
        for value, pose in pool[:_IMPROVED]:
            if value <= 0.0:
                break
            size = 0.3
            for _ in range(_STEPS):
                moved = _shifted(pose, random, size * reach * 0.3, size, centre)
                other = self._value(curve.placed(moved), turns)
                if other > value:
                    value, pose = other, moved
                else:
                    size *= 0.93
            placement = self.best(curve.placed(pose))
            if placement is not None and (best is None or placement.speed > best.speed):
                best = replace(placement, moved=pose)
        return best

    def _value(self, curve: Curve, turns: Sequence[float]) -> float:
        grid = [(turn, 0.0) for turn in turns]
        found = self.candidates(curve, _COARSE_SAMPLES, grid)
        return max((candidate[0] for candidate in found), default=0.0)

    def _improved(
        self, curve: Curve, constant: float, rate: float, start: Posture
    ) -> Placement | None:
        """Return the best rotation near one, on finer samples."""
        s = np.linspace(0.0, curve.length, SAMPLES)
        step = curve.length / (SAMPLES - 1)
        best: Placement | None = None
        turn, turning = math.pi / _ROTATIONS, 0.25 * math.pi / curve.length
        if curve.is_pose:
            turn = turning = 0.0
        for _ in range(6):
            around = [(i * turn, k * turning) for i in (-1, 0, 1) for k in (-1, 0, 1)]
            for shift, more in around if turn else [(0.0, 0.0)]:
                one, two = constant + shift, rate + more
                poses = [frames.compose(pose, self._back) for pose in curve.poses(s, one + two * s)]
                first = self.kinematics.follow(poses[0], best.start if best else start)
                postures = None
                if first is not None and self._inside(first):
                    postures = self.postures(poses, first)
                if postures is not None:
                    leads = self.leads(curve, (one, one + two * curve.length), postures)
                    value = min(self.speed(postures, step), speed_after(min(leads)))
                    if best is None or value > best.speed:
                        best = Placement(
                            curve, frames.IDENTITY, one, two, postures[0], value, leads
                        )
            if best is None:
                return None
            constant, rate = best.constant, best.rate
            turn, turning = turn / 2, turning / 2
        return best

    def _turns(self, curve: Curve, count: int) -> list[float]:
        if curve.is_pose:
            return [0.0]
        return [2 * math.pi * k / count for k in range(count)]

    def _starts(self, flange: Pose) -> list[Posture]:
        return [p for p in self.kinematics.solutions(flange, self._home) if self._inside(p)]

    def _inside(self, posture: Posture) -> bool:
        return all(
            low <= value <= high
            for low, value, high in zip(self._low, posture, self._high, strict=True)
        )

    def _reach(self) -> float:
        """Return a distance from the base that the arm reaches, m."""
        place = self.kinematics.forward(self._home)[0]
        return max(math.hypot(*place), 0.3)


def _about(centre: Array, at: tuple[float, float, float], turn: frames.Quaternion) -> Pose:
    """Return the pose that turns a curve about its centre and moves the centre to a place."""
    x, y, z = frames.rotate(turn, tuple(centre.tolist()))
    return (at[0] - x, at[1] - y, at[2] - z), turn


def _any_turn(random: np.random.Generator) -> frames.Quaternion:
    w, x, y, z = random.normal(size=4).tolist()
    return frames.normalise((w, x, y, z))


def _shifted(
    pose: Pose, random: np.random.Generator, distance: float, angle: float, centre: Array
) -> Pose:
    x, y, z = random.normal(size=3).tolist()
    turn = frames.multiply(frames.about(frames.unit((x, y, z)), random.normal() * angle), pose[1])
    at = frames.add(pose[0], frames.rotate(pose[1], tuple(centre.tolist())))
    dx, dy, dz = (random.normal(size=3) * distance).tolist()
    return _about(centre, frames.add(at, (dx, dy, dz)), frames.normalise(turn))
