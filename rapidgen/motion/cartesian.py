"""Cartesian ways: the TCP on a line or a circle, axes by inverse kinematics."""

from bisect import bisect_right
from collections.abc import Callable, Iterable
from itertools import pairwise
from math import ceil, inf, radians

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Vector
from rapidgen.axes.kinematics import ConfigurationCheck, Kinematics, Posture
from rapidgen.axes.limits import outside
from rapidgen.axes.path_shapes import LARGEST_ARC, Arc, Line, arc_through
from rapidgen.axes.reach_errors import unreached
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.moves import (
    NO_TURN,
    SHORTEST,
    CartesianMove,
    Measure,
    Singularities,
    largest,
    nominal_time,
    timed,
)
from rapidgen.motion.pieces import AxisLimits, Piece
from rapidgen.motion.sampling import cubics, interval_limits, largest_step, spaced
from rapidgen.motion.singularities import put_tcp, wrist_end, wrist_places

_STEP = 0.05
"""rad or m of one axis that an interval of the sampling should not exceed."""
_FEWEST, _USUAL, _MOST = 5, 96, 512
_PERIOD = 0.01
"""Nominal s of an interval, as long as no more than `_USUAL` of them are needed: an interval has
one acceleration, so that few of them make a move too slow."""
_SHORT, _LITTLE = 0.003, 0.02
"""m and rad of a short way. Axes that go straight there miss it by less than `_BENT`, unless the
robot is close to a singularity."""
_BENT = 1e-6
"""rad or m of an axis in the middle of a short way that count as none."""
_STRAIGHT = radians(0.01)
"""rad between the points of a circle, seen from its start, below which it is driven as a line.

ABB's manual asks for 1 degree. RobotStudio drives points on a line, and a real IRB 6640 arcs down
to 0.16 degrees (logs of hehonglu123/ABB_Primitive_Study)."""
_ENDS = [0.0, 1.0]
_APART = 1e-4
"""m between the points of a circle, at least."""
_JUMP = 0.6
"""rad between the finest nodes that no axis can follow: a singularity."""


class CartesianPath:
    """The way of a CartesianMove over its nominal time."""

    __slots__ = (
        "_ceilings",
        "_curves",
        "_external",
        "_kinematics",
        "_nodes",
        "_places",
        "_shares",
        "_turns",
        "_wrist",
        "carrier",
        "duration",
        "limits",
        "measure",
        "programmed",
        "rates",
        "shape",
        "strength",
        "target",
    )

    def __init__(
        self,
        origin: Posture,
        flange: Pose,
        move: CartesianMove,
        kinematics: Kinematics,
        limits: AxisLimits,
        *,
        from_rest: bool,
        check: ConfigurationCheck,
    ) -> None:
        """`flange` is that of `origin`."""
        self._kinematics = kinematics
        self.carrier = move.carrier
        self.limits = limits
        self._places = external_places(kinematics)
        self.shape = _shape(move.carrier.at(origin).pose(flange), move)
        self._external = (origin, move.external)
        self.measure = Measure(
            self.shape.length, self.shape.angle, *_external_measure(kinematics, origin, move)
        )
        self._wrist: tuple[Posture, Posture] | None = None
        if move.singularities is not Singularities.OFF:
            self._wrist = origin, wrist_end(kinematics, move, origin, check)
        self._turns = self.measure.angle > NO_TURN
        self.programmed = 1.0
        programmed = nominal_time(self.measure, move.speed) if move.time is None else move.time
        self.rates: Posture | None = None
        """Rates of the axes where they go straight, by nominal s."""
        rests = from_rest + move.zone.fine
        bend = self._short(origin)
        if bend is not None:
            self._find_duration(move, programmed, rests)
            self._set_straight(bend)
        else:
            self._set_sampled(origin, move, programmed, rests)
        self.target = self._nodes[-1]

    def _set_sampled(
        self, origin: Posture, move: CartesianMove, programmed: float, rests: int
    ) -> None:
        """Sample the way as closely as its limits ask for."""
        count = min(_USUAL, max(_FEWEST, ceil(programmed / _PERIOD)))
        while True:
            self._shares, self._nodes = self._sample(origin, count)
            least = self._find_duration(move, programmed, rests)
            count = len(self._nodes) - 1
            spacing = self.duration / count
            self._ceilings, close = interval_limits(self._nodes, spacing, self.limits)
            # The speed that the axes reach counts here, whatever is programmed.
            wanted = min(_USUAL, ceil(least / _PERIOD))
            if (close and count >= wanted) or 2 * count > _MOST:
                break
            count = max(wanted, count if close else 2 * count)
        self._curves = cubics(self._nodes, spacing, 0.0)

    def _find_duration(self, move: CartesianMove, programmed: float, rests: int) -> float:
        """Set the nominal time; returns the smallest at full axis speed."""
        least, fastest, self.strength = self._bounds()
        self.duration = max(programmed, SHORTEST)
        if move.time is not None:
            total = move.time - rests * self.limits.ramp / 2
            self.duration = timed(total, fastest, self.strength, rests / 2)
        return least

    def _short(self, origin: Posture) -> Posture | None:
        """Second differences of the axes over both halves of a short way that is straight.

        Then its nodes are its ends. None: it has to be sampled.
        """
        if self._wrist is not None or self.measure.tcp > _SHORT or self.measure.angle > _LITTLE:
            return None
        middle = self._solve(0.5, origin)
        end = self._solve(1.0, middle)
        bend = tuple([abs(a - 2 * b + c) for a, b, c in zip(origin, middle, end, strict=True)])
        if max(bend) > 2 * _BENT:
            return None
        check_range(self._kinematics, (end,))
        self._shares, self._nodes = _ENDS, [origin, end]
        return bend

    def _set_straight(self, bend: Posture) -> None:
        """Let the axes go straight, with the limits of the way that they replace."""
        first, last = self._nodes
        duration, half = self.duration, self.duration / 2
        rates = tuple([(b - a) / duration for a, b in zip(first, last, strict=True)])
        curved = tuple([c / (half * half) for c in bend])
        most = tuple([abs(r) + c * half for r, c in zip(rates, curved, strict=True)])
        self.rates = rates
        self._ceilings = [self.limits.of_curve(most, curved, first)]
        self._curves = [line_from(first, rates)]

    def stretch(self, factor: float) -> None:
        """See Geometry."""
        self.duration *= factor
        self.programmed *= factor
        if self.rates is not None:
            self.rates = tuple([rate / factor for rate in self.rates])

    @property
    def tcp(self) -> float:
        """m that the TCP goes in a nominal s."""
        return self.measure.tcp / self.duration

    def posture(self, time: float) -> Posture:
        """Axis values at a nominal time of the way."""
        fraction = time / self.duration
        return self._solve(fraction, self._guess(fraction))

    def pose(self, time: float) -> Pose:
        """TCP in the object. Times may lie outside the way."""
        return self._pose(time / self.duration)

    @property
    def orientation(self) -> frames.Quaternion | None:
        """The orientation when it is the same all along."""
        return None if self._turns else self.shape.start[1]

    def velocity(self, time: float) -> frames.Vector:
        """TCP in the object, m per nominal s."""
        return frames.scale(self.shape.tangent(time / self.duration), 1 / self.duration)

    def external(self, time: float) -> Posture:
        """All axes by linear interpolation: right for the external ones."""
        fraction = time / self.duration
        return self._linear(fraction)

    def pieces(self, begin: float, start: float, end: float) -> list[Piece]:
        """One piece for each interval of the sampling that lies between start and end."""
        count = len(self._nodes) - 1
        spacing = self.duration / count

        factor = self.programmed
        result: list[Piece] = []
        for k in range(count):
            left, right = begin + k * spacing, begin + (k + 1) * spacing
            if k == count - 1:
                right = begin + self.duration
            low, high = max(left, start), min(right, end)
            speed, shares = self._ceilings[k]
            if factor != 1.0:
                speed *= factor
                shares = tuple([(r / factor, c / (factor * factor)) for r, c in shares])
            if high - low > 1e-12:
                at = _later(self._curves[k], begin, factor)
                own = speed, shares
                straight = self.rates is not None
                result.append(
                    Piece(low, high, at, own, self.tcp, straight=straight, programmed=factor)
                )
        if result:
            result[0].start, result[-1].end = start, end
        return result

    # -- inverse kinematics along the way -----------------------------------------------------

    def _sample(self, origin: Posture, count: int) -> tuple[list[float], list[Posture]]:
        """Nodes at `count` equal shares, or at more of them where the steps were too long."""
        while True:
            shares = spaced(0.0, 1.0, count)
            nodes = [origin]
            for fraction in shares[1:]:
                nodes.append(self._solve(fraction, nodes[-1]))
            step = largest_step(nodes)
            if step <= _STEP:
                break
            if count >= _MOST:
                if step > _JUMP:
                    raise MotionFault(FaultReason.SINGULARITY)
                break
            count = min(_MOST, max(2 * count, min(4 * count, ceil(count * step / _STEP))))
        check_range(self._kinematics, nodes)
        return shares, nodes

    def _pose(self, fraction: float) -> Pose:
        shape = self.shape
        return (
            shape.position(fraction),
            shape.orientation(fraction) if self._turns else shape.start[1],
        )

    def _solve(self, fraction: float, near: Posture) -> Posture:
        pose = self._pose(fraction)
        if self._places:
            near = with_external(near, self._linear(fraction), self._places)
        if self._wrist is not None:
            return self._solve_wrist(fraction, near)
        result = self._kinematics.follow(self.carrier.at(near).flange(pose), near)
        if result is None:
            _, why = unreached(self._kinematics, self.carrier.at(near).flange(pose), near)
            raise MotionFault(FaultReason.OUT_OF_REACH, why)
        return result

    def _solve_wrist(self, fraction: float, near: Posture) -> Posture:
        """Wrist axes on their straight way, the main axes put the TCP on its own."""
        assert self._wrist is not None
        wrist, (first, last) = wrist_places(self._kinematics), self._wrist
        values = list(near)
        for i in wrist:
            values[i] = first[i] + (last[i] - first[i]) * fraction
        result = put_tcp(
            self._kinematics, self.carrier, self.shape.position(fraction), tuple(values)
        )
        if result is None:
            raise MotionFault(FaultReason.OUT_OF_REACH_WITH_WRIST)
        return result

    @property
    def joins_poses(self) -> bool:
        """Whether a corner may be made from poses: the orientation is that of the shape."""
        return self._wrist is None

    @property
    def orientation_error(self) -> float:
        """Largest angle between planned and programmed orientation, rad; only SingArea has one."""
        if self._wrist is None:
            return 0.0
        return max(
            frames.angle_between(
                self.carrier.at(node).pose(self._kinematics.forward(node))[1],
                self.shape.orientation(share),
            )
            for share, node in zip(self._shares, self._nodes, strict=True)
        )

    def _linear(self, fraction: float) -> Posture:
        first, last = self._external
        return tuple([a + (b - a) * fraction for a, b in zip(first, last, strict=True)])

    def _guess(self, fraction: float) -> Posture:
        shares = self._shares
        k = min(max(0, bisect_right(shares, fraction) - 1), len(shares) - 2)
        part = (fraction - shares[k]) / (shares[k + 1] - shares[k])
        part = min(1.0, max(0.0, part))
        return tuple(
            [a + (b - a) * part for a, b in zip(self._nodes[k], self._nodes[k + 1], strict=True)]
        )

    def _bounds(self) -> tuple[float, float, float]:
        """Nominal time at full axis speed where that is largest and where it is smallest, and the
        way's acceleration in shares per s^2."""
        limits, spacing = self.limits, 1.0 / (len(self._nodes) - 1)
        least, fastest, most = inf, SHORTEST, 0.0
        for a, b in pairwise(self._nodes):
            slowest = 0.0
            for x, y, v, acc in zip(a, b, limits.speeds, limits.accelerations(a), strict=True):
                rate = abs(y - x) / spacing
                slowest = max(slowest, rate / v)
                most = max(most, rate / acc)
            least, fastest = min(least, slowest), max(fastest, slowest)
        return least, fastest, 1 / most if most else inf


def _later(
    curve: Callable[[float], Posture], begin: float, factor: float
) -> Callable[[float], Posture]:
    """Return a curve of a way by places of a path, on which the way begins at `begin`."""
    if factor == 1.0:
        return lambda place: curve(place - begin)
    return lambda place: curve((place - begin) / factor)


def line_from(start: Posture, rates: Posture) -> Callable[[float], Posture]:
    """Return axis values by nominal s where all axes are linear."""
    return lambda time: tuple([q + r * time for q, r in zip(start, rates, strict=True)])


def check_range(kinematics: Kinematics, nodes: Iterable[Posture]) -> None:
    """MotionFault: a posture outside of the axis ranges."""
    for node in nodes:
        faults = outside(kinematics.group.joints, node)
        if faults:
            raise MotionFault(FaultReason.OUT_OF_RANGE, faults[0])


def external_places(kinematics: Kinematics) -> tuple[int, ...]:
    """Where the external axes are in wire order."""
    joints = kinematics.group.joints
    return tuple(i for i, joint in enumerate(joints) if joint.axis.startswith("eax"))


def with_external(posture: Posture, external: Posture, places: tuple[int, ...]) -> Posture:
    """A posture with the external axes of another one."""
    values = list(posture)
    for place in places:
        values[place] = external[place]
    return tuple(values)


def _shape(start: Pose, move: CartesianMove) -> Line | Arc:
    if move.via is None:
        return Line(start, move.target)
    arc = arc_through(start, move.via, move.target, move.circle, _STRAIGHT)
    if arc is None:
        if not _lies_between(start[0], move.via[0], move.target[0]):
            raise MotionFault(FaultReason.NO_CIRCLE)
        return Line(start, move.target)
    if arc.sweep > LARGEST_ARC:
        raise MotionFault(FaultReason.CIRCLE_TOO_LONG)
    return arc


def _lies_between(start: Vector, via: Vector, end: Vector) -> bool:
    """True if the point of a circle is on the line from start to end, 0.1 mm from both."""
    way, part = frames.subtract(end, start), frames.subtract(via, start)
    length = frames.norm(way)
    if length < 2 * _APART:
        return False
    along = frames.dot(part, way) / length
    return _APART <= along <= length - _APART


def _external_measure(
    kinematics: Kinematics, origin: Posture, move: CartesianMove
) -> tuple[float, float]:
    linear, rotary = [0.0], [0.0]
    for joint, a, b in zip(kinematics.group.joints, origin, move.external, strict=True):
        if joint.axis.startswith("eax"):
            (rotary if joint.kind == "revolute" else linear).append(b - a)
    return largest(linear), largest(rotary)
