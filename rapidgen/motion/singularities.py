"""SingArea \\Wrist: the wrist axes go straight in joint space, the TCP stays on its way.

The orientation deviates in between, also away from singularities (S4 datasys 2-SingArea).
"""

from math import pi

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.axes.kinematics import ConfigurationCheck, Kinematics, Posture
from rapidgen.axes.reach_errors import unreached
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.moves import CartesianMove, MoveFrames, Singularities

_ROUNDS = 25
_CLOSE = 1e-9
_STEP = 1e-6


def wrist_places(kinematics: Kinematics) -> tuple[int, ...]:
    """Where axes 4, 5 and 6 are in wire order."""
    return _places(kinematics, ("rax_4", "rax_5", "rax_6"))


def _places(kinematics: Kinematics, expected: tuple[str, ...]) -> tuple[int, ...]:
    axes = [joint.axis for joint in kinematics.group.joints]
    return tuple(axes.index(axis) for axis in expected if axis in axes)


def wrist_end(
    kinematics: Kinematics, move: CartesianMove, origin: Posture, check: ConfigurationCheck
) -> Posture:
    """The posture at the end: in the programmed configuration, or the closest one.

    With \\Wrist a linear move goes to the programmed wrist configuration (S4 datasys 2-ConfL);
    with \\LockAxis4 to the one whose axis 4 is closest to where it is locked, and the little that
    is left is orientation that the target does not get [mem].
    MotionFault: there is none.
    """
    near = tuple(
        e if joint.axis.startswith("eax") else o
        for joint, o, e in zip(kinematics.group.joints, origin, move.external, strict=True)
    )
    flange = move.carrier.at(near).flange(move.target)
    result = kinematics.solutions(flange, near)
    if not result:
        reached, why = unreached(kinematics, flange, near)
        raise MotionFault(
            FaultReason.NO_POSTURE_IN_RANGE if reached else FaultReason.NO_POSTURE, why
        )
    if move.singularities is Singularities.LOCK_AXIS_4:
        return _locked(kinematics, move, near, result)
    if move.wanted is not None:
        return kinematics.fitting(result, move.wanted, check) or result[0]
    return result[0]


def _locked(
    kinematics: Kinematics, move: CartesianMove, near: Posture, result: list[Posture]
) -> Posture:
    (fourth,) = _places(kinematics, ("rax_4",))
    locked = pi * round(near[fourth] / pi)
    closest: Posture = min(result, key=lambda posture: abs(posture[fourth] - locked))
    values = list(closest)
    values[fourth] = locked
    end = put_tcp(kinematics, move.carrier, move.target[0], tuple(values))
    if end is None:
        raise MotionFault(FaultReason.OUT_OF_REACH_WITH_AXIS_4)
    return end


def put_tcp(
    kinematics: Kinematics, carrier: MoveFrames, place: Vector, start: Posture
) -> Posture | None:
    """Turn axes 1 to 3 of a posture until the TCP is at a place in the object; None: no way."""
    main = _places(kinematics, ("rax_1", "rax_2", "rax_3"))
    values = list(start)
    carrier = carrier.at(start)  # external axes stay
    for _ in range(_ROUNDS):
        have = carrier.pose(kinematics.forward(tuple(values)))[0]
        error = frames.subtract(place, have)
        if frames.norm(error) < _CLOSE:
            return tuple(values)
        columns = []
        for i in main:
            values[i] += _STEP
            target = carrier.pose(kinematics.forward(tuple(values)))[0]
            values[i] -= _STEP
            columns.append(frames.scale(frames.subtract(target, have), 1 / _STEP))
        a, b, c = columns
        volume = frames.dot(a, frames.cross(b, c))
        if abs(volume) < 1e-12:
            return None
        steps = (
            frames.dot(error, frames.cross(b, c)) / volume,
            frames.dot(a, frames.cross(error, c)) / volume,
            frames.dot(a, frames.cross(b, error)) / volume,
        )
        longest = max(map(abs, steps))
        factor = min(1.0, 0.3 / longest)
        for i, step in zip(main, steps, strict=True):
            values[i] += step * factor
    return None
