"""From a move to its way, with what holds now: geometry, settings, tool, limits of the axes.

Range, geometry and configuration are checked here, before motion.
"""

from collections.abc import Sequence
from math import inf

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose, Vector, compose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.axes.limits import outside
from rapidgen.config.model import GroupConfig
from rapidgen.motion.accelerations import of_posture
from rapidgen.motion.cartesian import CartesianPath
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.legs import Geometry, joint_measure, joint_way, lever_measure
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.moves import NO_WAY, CartesianMove, JointMove, Move
from rapidgen.motion.path import NOTHING_M, WayMaker
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.settings import MotionSettings


class Planner:
    """What the moves of one group are planned with."""

    __slots__ = (
        "_accelerations",
        "_flange",
        "config",
        "kinematics",
        "modal",
        "settings",
        "speed_limited",
        "tool",
    )

    def __init__(self, config: GroupConfig, settings: MotionSettings) -> None:
        self.config = config
        self.settings = settings
        self.kinematics = Kinematics.of(config)
        """None: the model has no geometry, so the robot moves in joints only."""
        self._accelerations = of_posture(config)
        self._flange: tuple[Posture, Pose] | None = None
        """The posture whose flange was asked for last, and that flange."""
        self.modal = ModalSettings()
        self.tool: Pose = IDENTITY
        """The active TCP in the flange."""
        self.speed_limited = False
        """Whether the limits of SpeedLimAxis and SpeedLimCheckPoint hold (input LimitSpeed)."""

    def geometry(self) -> Kinematics:
        """The kinematics. MotionFault NO_GEOMETRY: the model has none."""
        if self.kinematics is None:
            raise MotionFault(FaultReason.NO_GEOMETRY, self.config.name)
        return self.kinematics

    def flange(self, posture: Posture) -> Pose:
        """The flange of a posture. A move asks for that of its start more than once."""
        known = self._flange
        if known is None or known[0] is not posture:
            known = self._flange = posture, self.geometry().forward(posture)
        return known[1]

    @property
    def ramp(self) -> float:
        """s in which acceleration builds up."""
        return self.settings.ramp_time * self.modal.acceleration / self.modal.ramp

    def limits(self, ramp: float) -> AxisLimits:
        """What the axes may do now: AccSet, PathAccLim, WorldAccLim, SpeedLimAxis."""
        modal = self.modal
        slower = modal.axis_limits if self.speed_limited else {}
        world = None
        if modal.world_acceleration < inf and self.kinematics is not None:
            own, tool = self.kinematics, self.tool

            def tcp(posture: Posture) -> Vector:
                return compose(own.forward(posture), tool)[0]

            world = tcp, modal.world_acceleration
        joints, share, by_posture = self.config.joints, modal.acceleration, self._accelerations
        at = by_posture
        if by_posture is not None and share != 1.0:
            full = by_posture

            def at(posture: Posture) -> Sequence[float]:
                return [a * share for a in full(posture)]

        return AxisLimits(
            [min(j.speed, slower.get(j.axis, inf)) for j in joints],
            [j.acceleration * share for j in joints],
            self.settings.corner_share,
            modal.path_acceleration,
            ramp,
            world,
            at,
            self.settings.corner_size,
            self.settings.shortest_corner,
        )

    def check_range(self, move: Move) -> None:
        """MotionFault: a joint target outside the axis ranges."""
        if not isinstance(move, JointMove):
            return
        faults = outside(self.config.joints, move.target)
        if faults:
            raise MotionFault(FaultReason.OUT_OF_RANGE, faults[0])

    def has_zero_length(self, move: Move, ends: Posture) -> bool:
        """Whether a move asks for the place where the path ends anyhow."""
        if isinstance(move, JointMove):
            return all(abs(a - b) < NOTHING_M for a, b in zip(move.target, ends, strict=True))
        assert isinstance(move, CartesianMove)
        if move.via is not None:
            return False
        position, orientation = move.carrier.at(ends).pose(self.flange(ends))
        return (
            frames.distance(position, move.target[0]) < NO_WAY
            and frames.angle_between(orientation, move.target[1]) < NO_WAY
            and all(
                abs(a - b) < NOTHING_M
                for joint, a, b in zip(self.config.joints, move.external, ends, strict=True)
                if joint.axis.startswith("eax")
            )
        )

    def apart(self, one: Posture, other: Posture) -> tuple[float, float]:
        """How far two postures are from each other: m and rad of the TCP."""
        if self.kinematics is None:
            measure, _ = lever_measure(self.config, one, other, self.settings.lever)
            return measure.tcp, measure.angle
        current, target = (compose(self.kinematics.forward(p), self.tool) for p in (one, other))
        return frames.distance(current[0], target[0]), frames.angle_between(current[1], target[1])

    def way_maker(self, limits: AxisLimits) -> WayMaker:
        """What makes the ways of moves under these limits. It raises MotionFault."""

        def make(origin: Posture, move: Move, from_rest: bool) -> Geometry:
            if isinstance(move, CartesianMove):
                return self._cartesian(origin, move, limits, from_rest=from_rest)
            assert isinstance(move, JointMove)
            if self.kinematics is None:
                measure = lever_measure(self.config, origin, move.target, self.settings.lever)
            else:
                measure = joint_measure(self.kinematics, move.carrier, origin, move.target)
            return joint_way(origin, move, measure, limits, from_rest=from_rest)

        return make

    def _cartesian(
        self, origin: Posture, move: CartesianMove, limits: AxisLimits, *, from_rest: bool
    ) -> CartesianPath:
        own, check = self.geometry(), self.settings.configuration_check
        flange = self.flange(origin)
        path = CartesianPath(origin, flange, move, own, limits, from_rest=from_rest, check=check)
        if move.wanted is not None and not own.matches(path.target, move.wanted, check):
            reached = own.configuration(path.target)
            raise MotionFault(FaultReason.CONFIGURATION, list(reached), list(move.wanted))
        return path
