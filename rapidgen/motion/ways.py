"""From a move to its way: range, geometry and configuration are checked here, before motion."""

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import ConfigurationCheck, Kinematics
from rapidgen.axes.limits import outside
from rapidgen.config.model import GroupConfig
from rapidgen.motion import events
from rapidgen.motion.cartesian import CartesianWay
from rapidgen.motion.legs import Geometry, joint_measure, joint_way, lever_measure
from rapidgen.motion.moves import NO_WAY, CartesianMove, JointMove, Move, Posture
from rapidgen.motion.path import NOTHING_M, WayMaker
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.settings import MotionSettings
from rapidgen.runtime.errors import FatalError, RapidError


def require(config: GroupConfig, kinematics: Kinematics | None) -> Kinematics:
    """The kinematics of a group. FatalError: its model has no geometry."""
    if kinematics is None:
        raise FatalError(
            events.NO_GEOMETRY,
            "No geometry",
            f"{config.name}: the configuration has no chain, so the robot moves in joints only",
        )
    return kinematics


def check_range(config: GroupConfig, settings: MotionSettings, move: Move) -> None:
    """ERR_ROBLIMIT or FatalError 50027: a joint target outside the axis ranges."""
    if not isinstance(move, JointMove):
        return
    faults = outside(config.joints, move.target)
    if not faults:
        return
    if settings.range_error == "fatal":
        raise FatalError(events.OUT_OF_RANGE, "Joint out of range", str(faults[0]))
    raise RapidError("ERR_ROBLIMIT", str(faults[0]))


def goes_nowhere(
    config: GroupConfig, kinematics: Kinematics | None, move: Move, ends: Posture
) -> bool:
    """Whether a move asks for the place where the path ends anyhow."""
    if isinstance(move, JointMove):
        return all(abs(a - b) < NOTHING_M for a, b in zip(move.target, ends, strict=True))
    assert isinstance(move, CartesianMove)
    own = require(config, kinematics)
    if move.via is not None:
        return False
    position, orientation = move.carrier.at(ends).pose(own.forward(ends))
    return (
        frames.distance(position, move.target[0]) < NO_WAY
        and frames.angle_between(orientation, move.target[1]) < NO_WAY
        and all(
            abs(a - b) < NOTHING_M
            for joint, a, b in zip(config.joints, move.external, ends, strict=True)
            if joint.axis.startswith("eax")
        )
    )


def apart(
    config: GroupConfig,
    kinematics: Kinematics | None,
    settings: MotionSettings,
    postures: tuple[Posture, Posture],
    tool: Pose,
) -> tuple[float, float]:
    """How far two postures are from each other: m and rad of the TCP."""
    if kinematics is None:
        measure, _ = lever_measure(config, *postures, settings.lever)
        return measure.tcp, measure.angle
    here, there = (frames.compose(kinematics.forward(posture), tool) for posture in postures)
    return frames.distance(here[0], there[0]), frames.angle_between(here[1], there[1])


def make(
    config: GroupConfig,
    kinematics: Kinematics | None,
    settings: MotionSettings,
    limits: AxisLimits,
) -> WayMaker:
    """What makes the ways of one group's moves.

    ERR_OUTSIDE_REACH, ERR_ROBLIMIT: not along this way; FatalError: singularity, circle,
    configuration, no geometry.
    """

    def way(origin: Posture, move: Move, from_rest: bool) -> Geometry:
        if isinstance(move, CartesianMove):
            own = require(config, kinematics)
            check = settings.configuration_check
            found = CartesianWay(origin, move, own, limits, from_rest=from_rest, check=check)
            _check_configuration(own, move, found.target, check)
            return found
        assert isinstance(move, JointMove)
        if kinematics is None:
            measure = lever_measure(config, origin, move.target, settings.lever)
        else:
            measure = joint_measure(kinematics, move.carrier, origin, move.target)
        return joint_way(origin, move, measure, limits, from_rest=from_rest)

    return way


def _check_configuration(
    kinematics: Kinematics, move: CartesianMove, target: Posture, check: ConfigurationCheck
) -> None:
    if move.wanted is None or kinematics.matches(target, move.wanted, check):
        return
    reached = kinematics.configuration(target)
    raise FatalError(
        events.NOT_COMPATIBLE,
        "Position not compatible",
        f"the way ends in configuration {list(reached)}, programmed is {list(move.wanted)}",
    )
