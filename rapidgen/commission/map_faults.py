"""Faults of a joint map, found by comparing the driver's values with the controller's own.

Two comparisons: axis values (`compare_axes`), and the flange's pose, which the controller computes
from its own model and rapidgen from the URDF and the joint map (`explain_poses`). The second one
finds a wrong sign, zero or order even where both sides agree on the axis values, because then the
URDF's joints are not those of the robot.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from rapidgen.axes import frames
from rapidgen.axes.chain import Posture
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import MovingFrame
from rapidgen.config.model import GroupConfig, Joint

AXIS_TOLERANCE = {"revolute": math.radians(0.05), "prismatic": 0.0002}
"""rad and m between two readings of a robot at rest."""
POSE_TOLERANCE = 0.002
"""m between two computed poses of the flange: controllers with absolute accuracy correct by mm."""
_LEVER = 0.3
"""m by which a difference in orientation counts as a distance."""
_COARSE = math.radians(2)
_BETTER = 5.0
"""How much closer a hypothesis must be than the configuration to count."""


@dataclass(frozen=True, slots=True)
class MapFault:
    """A fault of the joint map, in words, with the entry that corrects it."""

    joints: tuple[str, ...]
    kind: str
    """`sign`, `zero`, `swapped` or `base`."""
    text: str
    help: str


def figure(joint: Joint, value: float) -> str:
    """Return a value of a joint as text: deg or mm."""
    if joint.kind == "revolute":
        return f"{math.degrees(value):.2f} deg"
    return f"{value * 1000:.2f} mm"


def compare_axes(
    joints: Sequence[Joint], driver: Sequence[float], own: Sequence[float]
) -> list[MapFault]:
    """Compare axis values of the driver with the controller's own, both in wire order."""
    wrong = [
        k for k, joint in enumerate(joints) if abs(driver[k] - own[k]) > AXIS_TOLERANCE[joint.kind]
    ]
    result = []
    for k in wrong:
        joint = joints[k]
        near = AXIS_TOLERANCE[joint.kind]
        other = next((m for m in wrong if m != k and abs(driver[k] - own[m]) <= near), None)
        values = (
            f"the driver reports {figure(joint, driver[k])} for {joint.name} ({joint.axis}), "
            f"the controller {figure(joint, own[k])}"
        )
        if other is not None:
            kind, what = "swapped", f"the value is that of {joints[other].axis}"
        elif abs(driver[k] + own[k]) <= near:
            kind, what = "sign", "the sign differs"
        else:
            difference = figure(joint, driver[k] - own[k])
            kind, what = "zero", f"they differ by {difference}"
        help = "the driver reads other axes than this controller has: build and deploy it again"
        result.append(MapFault((joint.name,), kind, f"{values}: {what}", help))
    return result


def alike(group: GroupConfig, posture: Posture) -> tuple[str, str] | None:
    """Return two joints that turn the flange about the same line in a posture; None if none do.

    Neither an operator nor the flange's pose can distinguish such joints.
    """
    model = MovingFrame.of(group, group.chain)
    moves = []
    for k, joint in enumerate(group.joints):
        if joint.kind == "revolute":
            moved = tuple(v + _COARSE * (n == k) for n, v in enumerate(posture))
            back = tuple(v - _COARSE * (n == k) for n, v in enumerate(posture))
            moves.append((joint.name, model.pose(moved), model.pose(back)))
    for (a, first, _), (b, second, reverse) in combinations(moves, 2):
        if min(_apart(first, second), _apart(first, reverse)) < POSE_TOLERANCE / 2:
            return a, b
    return None


@dataclass(frozen=True, slots=True)
class PoseSample:
    """Axis values in wire order, and the controller's own pose of its flange (tool0) in world."""

    axes: Posture
    flange: Pose


def deviation(group: GroupConfig, samples: Sequence[PoseSample]) -> float:
    """Return the largest deviation of the flange, m, with orientation at a lever of 0.3 m."""
    model = MovingFrame.of(group, group.chain)
    return max(_apart(model.pose(s.axes), s.flange) for s in samples)


def _moved(poses: Sequence[Pose]) -> list[Pose]:
    first = frames.invert(poses[0])
    return [frames.compose(first, pose) for pose in poses]


def _apart(a: Pose, b: Pose) -> float:
    return frames.distance(a[0], b[0]) + _LEVER * frames.angle_between(a[1], b[1])


def explain_poses(group: GroupConfig, samples: Sequence[PoseSample]) -> MapFault | None:
    """Return the fault that explains the poses; None if they fit the configuration.

    One fault is searched for: a sign, two swapped axes, one zero, or a displaced base. Without an
    explanation the fault has no joints.
    """
    present = deviation(group, samples)
    if present <= POSE_TOLERANCE:
        return None
    fitting = [
        (deviation(changed, samples), fault) for changed, fault in _hypotheses(group, samples)
    ]
    best = min(fitting, key=lambda pair: pair[0], default=None)
    if best is not None and best[0] <= POSE_TOLERANCE and best[0] * _BETTER < present:
        return best[1]
    shown = f"{present * 1000:.1f} mm"
    model = MovingFrame.of(group, group.chain)
    own = _moved([s.flange for s in samples])
    computed = _moved([model.pose(s.axes) for s in samples])
    if max(map(_apart, own, computed)) <= POSE_TOLERANCE / 2:
        return MapFault(
            (),
            "base",
            f"the flange is {shown} from where the URDF has it, and moves as the URDF does: "
            "the base frame of the controller differs, or the zero of the first joint",
            "compare the controller's base frame (Control Panel > Configuration > Motion) with "
            "the robot's place in the URDF",
        )
    return MapFault(
        (),
        "model",
        f"the flange is {shown} from where the URDF has it, and no single sign, zero or order "
        "of joints explains it",
        "compare the robot's model and dimensions with the URDF",
    )


def _hypotheses(
    group: GroupConfig, samples: Sequence[PoseSample]
) -> Iterator[tuple[GroupConfig, MapFault]]:
    """Yield changed groups, each with the fault that it would mean."""
    joints = group.joints
    for k, joint in enumerate(joints):
        changed = _with_joint(group, k, replace(joint, sign=-joint.sign))
        yield (
            changed,
            MapFault(
                (joint.name,),
                "sign",
                f"{joint.name} turns against its controller axis {joint.axis}: the sign is wrong",
                f"set `joints: {{{joint.name}: {{sign: {-joint.sign}}}}}`",
            ),
        )
    for a, b in combinations(range(len(joints)), 2):
        first, second = joints[a], joints[b]
        if first.kind != second.kind:
            continue
        # The names change places: wire order is that of the axes.
        changed = _with_joint(group, a, replace(first, name=second.name))
        changed = _with_joint(changed, b, replace(second, name=first.name))
        yield (
            changed,
            MapFault(
                (first.name, second.name),
                "swapped",
                f"{first.name} and {second.name} are swapped: {first.name} is "
                f"{second.axis}, {second.name} is {first.axis}",
                f"set `joints: {{{first.name}: {{axis: {second.axis}}}, "
                f"{second.name}: {{axis: {first.axis}}}}}`",
            ),
        )
    for k, joint in enumerate(joints):
        if joint.kind != "revolute":
            continue
        shift = _best_shift(group, k, samples)
        changed = _with_joint(group, k, replace(joint, offset=joint.offset + shift))
        offset = math.degrees(joint.offset + shift)
        # A base frame that is turned looks the same at the flange.
        base = "" if k else ", or the base frame of the controller is turned"
        yield (
            changed,
            MapFault(
                (joint.name,),
                "zero",
                f"the zero of {joint.name} ({joint.axis}) differs by {figure(joint, shift)}{base}",
                f"set `joints: {{{joint.name}: {{offset: {offset:.2f}}}}}`, or calibrate the axis",
            ),
        )


def _with_joint(group: GroupConfig, index: int, joint: Joint) -> GroupConfig:
    joints = list(group.joints)
    joints[index] = joint
    return replace(group, joints=tuple(joints))


def _best_shift(group: GroupConfig, index: int, samples: Sequence[PoseSample]) -> float:
    """Return the change of a joint's offset that fits best, rad."""
    joint = group.joints[index]

    def cost(shift: float) -> float:
        changed = _with_joint(group, index, replace(joint, offset=joint.offset + shift))
        return deviation(changed, samples[:1])

    count = round(math.pi / _COARSE)
    start = min((k * _COARSE for k in range(-count, count)), key=cost)
    return _refined(cost, start - _COARSE, start + _COARSE)


def _refined(cost: Callable[[float], float], low: float, high: float) -> float:
    """Return the minimum of a function with one minimum, by thirds."""
    while high - low > 1e-6:
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if cost(a) < cost(b) else (a, high)
    return (low + high) / 2
