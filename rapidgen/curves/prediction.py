"""Predicted path of a program, corners included: its moves in the virtual controller's planner.

`predict` puts all moves on the path of a motion group of its own, without RAPID, and samples the
commanded axes every 4 ms. The samples between the ends of the curve are compared with it:

- the distance of the path from the curve, and of each curve point from the path, so that ends that
  are cut off count;
- the angle between the tool's z axis and the axis of the curve. The rotation about it counts for
  poses only;
- the speed of the TCP: its mean, and its standard deviation as a share of the mean.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.config.model import GroupConfig
from rapidgen.curves.curve import Array, Curve
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.moves import FINE, CartesianMove, MoveFrames, MoveSpeed, Zone
from rapidgen.motion.system import MotionSystem
from rapidgen.system.model import System

PERIOD: Final = 0.004
"""s between samples: that of the controller's own motion interface."""
ORIENTATION_SPEED: Final = math.radians(1000.0)
"""rad/s of the speeddata: no limit, so that the speed of the TCP is what the program says."""
_COARSE: Final = 16
"""Curve steps between those that are compared with all samples."""
_WINDOW: Final = 0.05
"""m, or share of the length, by which progress along path and curve may differ."""
_TIMEOUT: Final = 3600.0


@dataclass(frozen=True, slots=True)
class Waypoint:
    """One move: a line to `pose`, or a circle through `via`. The zone is its radius in m."""

    pose: Pose
    zone: float
    via: Pose | None = None


@dataclass(frozen=True, slots=True)
class CurveProgram:
    """Moves along a curve from a posture; the last one ends in a fine point."""

    start: Posture
    waypoints: tuple[Waypoint, ...]
    speed: float
    """m/s of the TCP."""
    tool: Pose


@dataclass(frozen=True)
class Prediction:
    """What a program does. Rows of arrays are samples, 4 ms apart, leads included."""

    duration: float
    """s from start to standstill."""
    inside: npt.NDArray[np.bool_]
    """Whether a sample is between the ends of the curve."""
    s: Array
    """Arc length of the closest curve point, m; negative or beyond the length on the leads."""
    positions: Array
    tool_axes: Array
    deviation: Array
    """m."""
    angle: Array
    """rad."""
    speeds: Array
    """m/s of the TCP."""
    missed: float
    """m: largest distance of a curve point from the path."""

    @property
    def largest_deviation(self) -> float:
        """Return the largest distance of path and curve, m."""
        return max(float(self.deviation[self.inside].max()), self.missed)

    @property
    def largest_angle(self) -> float:
        """Return the largest error of orientation, rad."""
        return float(self.angle[self.inside].max())

    @property
    def mean_speed(self) -> float:
        """Return the mean speed on the curve, m/s."""
        return float(self.speeds[self.inside].mean())

    @property
    def speed_deviation(self) -> float:
        """Return the standard deviation of the speed as a share of its mean."""
        return float(self.speeds[self.inside].std() / self.mean_speed)


class Predictor:
    """Predicts programs of one group along one curve."""

    def __init__(self, group: GroupConfig, curve: Curve) -> None:
        kinematics = Kinematics.of(group)
        assert kinematics is not None
        self.group, self.kinematics, self.curve = group, kinematics, curve
        self._coarse = curve.positions[::_COARSE]

    def predict(self, program: CurveProgram) -> Prediction | MotionFault:
        """Return what a program does, or why the planner rejects it."""
        postures = self.run(program)
        if isinstance(postures, MotionFault):
            return postures
        return self.compare(postures, program.tool)

    def compare(self, postures: Sequence[Posture], tool: Pose) -> Prediction:
        """Return how postures every 4 ms, of a TCP in the flange, differ from the curve."""
        poses = [frames.compose(self.kinematics.forward(p), tool) for p in postures]
        places = np.array([pose[0] for pose in poses])
        axes = np.array([frames.rotate(pose[1], (0.0, 0.0, 1.0)) for pose in poses])
        return self._compared(places, axes, len(postures) * PERIOD)

    def run(self, program: CurveProgram) -> list[Posture] | MotionFault:
        """Return the commanded postures every 4 ms until standstill."""
        scheduler = Scheduler()
        log = EventLog(scheduler)
        io = IOSystem(scheduler, log, System("fit", ()))
        group = MotionSystem(scheduler, [self.group], log, io).group(self.group.name)
        group.jump(program.start)
        group.planner.tool = program.tool
        carrier = MoveFrames(tool=program.tool)
        speed = MoveSpeed(program.speed, ORIENTATION_SPEED)
        last = len(program.waypoints) - 1
        try:
            for number, waypoint in enumerate(program.waypoints):
                group.enqueue(
                    CartesianMove(
                        target=waypoint.pose,
                        via=waypoint.via,
                        external=program.start,
                        speed=speed,
                        zone=zone_of(waypoint.zone) if number < last else FINE,
                        carrier=carrier,
                    )
                )
        except MotionFault as fault:
            return fault
        postures = [group.commanded()]
        while not group.is_standing and scheduler.now < _TIMEOUT * S:
            scheduler.advance(until=scheduler.now + round(PERIOD * S))
            postures.append(group.commanded())
        return postures

    def _compared(self, places: Array, axes: Array, duration: float) -> Prediction:
        curve = self.curve
        steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        s = self._closest(places, np.concatenate([[0.0], np.cumsum(steps)]))
        inside = (s > 0.0) & (s < curve.length)
        if not inside.any():
            inside[len(inside) // 2] = True
        target, axis, _ = curve.at(s)
        deviation = np.linalg.norm(places - target, axis=1)
        angle = np.arccos(np.clip(np.sum(axes * axis, axis=1), -1.0, 1.0))
        speeds = np.concatenate([steps, steps[-1:]]) / PERIOD
        return Prediction(
            duration,
            inside,
            s,
            places,
            axes,
            deviation,
            angle,
            speeds,
            self._missed(places, s),
        )

    def _closest(self, places: Array, travelled: Array) -> Array:
        """Return arc lengths of the closest curve points, in the order of the path.

        A closed curve is near itself: progress along it must be that along the path.
        """
        curve = self.curve
        ends = travelled[-1] - curve.length
        own = np.arange(len(self._coarse)) * curve.step * _COARSE
        window = max(_WINDOW, _WINDOW * curve.length) + max(ends, 0.0)
        distances = np.linalg.norm(places[:, None, :] - self._coarse[None, :, :], axis=2)
        apart = np.abs(own[None, :] - (travelled - ends / 2)[:, None])
        distances[apart > window] = np.inf
        close = np.argmin(distances, axis=1) * _COARSE
        last = len(curve.positions) - 1
        offsets = np.arange(-_COARSE, _COARSE + 1)
        nodes = np.clip(close[:, None] + offsets[None, :], 0, last)
        near = np.linalg.norm(places[:, None, :] - curve.positions[nodes], axis=2)
        node = nodes[np.arange(len(places)), np.argmin(near, axis=1)]
        # From the closest node along the tangent: negative, or beyond the length, outside the ends.
        along = np.sum((places - curve.positions[node]) * curve.tangents[node], axis=1)
        half = np.where((node == 0) | (node == last), np.inf, curve.step)
        result: Array = node * curve.step + np.clip(along, -half, half)
        return result

    def _missed(self, places: Array, s: Array) -> float:
        """Return the largest distance of an end of the curve from the path."""
        worst = 0.0
        for end, node in ((0.0, 0), (self.curve.length, -1)):
            row = int(np.argmin(np.abs(s - end)))
            near = places[max(row - 2, 0) : row + 3]
            worst = max(worst, _distance_to_path(self.curve.positions[node], near))
        return worst


def _distance_to_path(point: Array, path: Array) -> float:
    one, other = path[:-1], path[1:]
    way = other - one
    square = np.maximum(np.sum(way * way, axis=1), 1e-18)
    part = np.clip(np.sum((point - one) * way, axis=1) / square, 0.0, 1.0)
    return float(np.linalg.norm(one + part[:, None] * way - point, axis=1).min())


def zone_of(radius: float) -> Zone:
    """Return the zone of a fly-by point: only the radius of the TCP limits it."""
    return Zone(
        tcp=radius,
        orientation=1.5 * radius,
        external=1.5 * radius,
        angle=math.pi,
        linear=1.5 * radius,
        rotary=math.pi,
    )
