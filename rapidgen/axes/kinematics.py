"""Forward and inverse kinematics of one motion group, from its chain.

Poses are those of the flange (tool0) in the chain's root frame, m; postures are controller
axis values in wire order, rad and m. External axes that carry the robot (a track) move its
base; external axes that the chain does not name have no influence here.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import atan2, floor, hypot, pi
from typing import Literal, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.chain import Posture as Posture
from rapidgen.axes.chain import Step, along, steps_of
from rapidgen.axes.four_axes import BRANCHES as FOUR_BRANCHES
from rapidgen.axes.four_axes import Branch as FourBranch
from rapidgen.axes.four_axes import FourAxes, palletiser, scara
from rapidgen.axes.frames import IDENTITY, Pose, Quaternion, Vector
from rapidgen.axes.limits import ROUNDING
from rapidgen.axes.mapping import JointMap
from rapidgen.axes.searching import ArmSearch
from rapidgen.axes.wrist import BRANCHES, SINGULAR, Angles, WristArm
from rapidgen.config.model import ChainLink, GroupConfig

AxisConfiguration = tuple[int, int, int, int]
"""cf1, cf4, cf6, cfx"""
ConfigurationCheck: TypeAlias = Literal["turn", "quarter"]
"""How far axes 1, 4 and 6 may be from their quarters, see `Kinematics.room`."""
_SCARA = ("rax_1", "rax_2", "rax_3", "rax_4")
_ENOUGH = 8
"""Postures that an iteration looks for."""
_NEAR = 1e-6
_TURN = 2 * pi


@dataclass(frozen=True)
class MovingFrame:
    """The user frame of a unit that carries work objects, in the root of the robot's chain."""

    map: JointMap
    steps: tuple[Step, ...]

    @classmethod
    def of(cls, group: GroupConfig, chain: Sequence[ChainLink]) -> "MovingFrame":
        """The frame at the end of a chain of the group's joints."""
        return cls(JointMap.of(group), steps_of(group, chain))

    def pose(self, posture: Posture) -> Pose:
        """Where it is, for controller axis values in wire order."""
        return along(self.steps, self.map.to_urdf(posture))


@dataclass(frozen=True)
class Kinematics:
    """What a group's chain can compute. Make it with `Kinematics.of`."""

    group: GroupConfig
    map: JointMap
    steps: tuple[Step, ...]

    @classmethod
    def of(cls, group: GroupConfig) -> "Kinematics | None":
        """The kinematics of a group; None when its model has no geometry."""
        if not group.chain:
            return None
        return cls(group, JointMap.of(group), steps_of(group, group.chain))

    # -- forward ----------------------------------------------------------------------------

    def forward(self, posture: Posture) -> Pose:
        """Flange of a posture."""
        values = self.map.to_urdf(posture)
        if self._arm is None:
            return along(self.steps, values)
        arm, first, _, _ = self._arm
        pose = arm.forward(self._robot_angles(values))
        base = along(self.steps[:first], values) if first else None
        return pose if base is None else frames.compose(base, pose)

    # -- inverse ----------------------------------------------------------------------------

    @property
    def is_closed_form(self) -> bool:
        """Whether the inverse is a formula."""
        return self._arm is not None or self._four is not None

    def follow(self, pose: Pose, near: Posture) -> Posture | None:
        """The posture on the same branch as `near`, turns as close to it as can be.

        External axes are those of `near`. None: out of reach, or the robot is on another
        branch there. Ranges are not looked at.
        """
        arm = self._arm
        if self._four is not None:
            four, _, places = self._four
            branch = four.branch([self.map.to_urdf(near)[i] for i in places])
            return self._of_four(pose, near, branch)
        if arm is None:
            return self.arm.near(pose, near)
        values = self.map.to_urdf(near)
        angles = self._robot_angles(values)
        solved = arm[0].solve(self._from_base(pose, values), arm[0].branch(angles), angles[3])
        return None if solved is None else self._as_posture(solved, angles, values)

    def beyond(self, pose: Pose, near: Posture) -> Iterator[Posture]:
        """Postures that reach a pose, ranges apart; external axes as in `near`."""
        if self._four is not None:
            fours = (self._of_four(pose, near, branch) for branch in FOUR_BRANCHES)
            yield from (four for four in fours if four is not None)
        elif self._arm is None:
            for postures in self.arm.rounds(pose, near):
                yield from postures
        else:
            values = self.map.to_urdf(near)
            angles = self._robot_angles(values)
            based = self._from_base(pose, values)
            for branch in BRANCHES:
                solved = self._arm[0].solve(based, branch, angles[3])
                if solved is not None:
                    yield self._as_posture(solved, angles, values)

    def solutions(self, pose: Pose, near: Posture) -> list[Posture]:
        """All postures within the ranges that reach a pose, external axes as in `near`.

        Axes that can turn more than once appear with every turn. Closest to `near` first.
        Without a closed form: what iteration finds from `near` and from other starts, at least
        one if there is any.
        """
        found: list[Posture] = []
        if self.is_closed_form:
            for posture in self.beyond(pose, near):
                found += [p for p in self._turned(posture) if not _known(p, found)]
        else:
            for number, postures in enumerate(self.arm.rounds(pose, near)):
                for posture in postures:
                    found += [p for p in self._turned(posture) if not _known(p, found)]
                    if len(found) >= _ENOUGH:
                        break
                if found and number >= 1:
                    break
        found.sort(key=lambda p: sum(abs(a - b) for a, b in zip(p, near, strict=True)))
        return found

    def _robot_angles(self, values: Posture) -> Angles:
        assert self._arm is not None
        _, _, signs, places = self._arm
        r, s, t, u, v, w = signs
        i, j, k, m, n, o = places
        return (
            r * values[i],
            s * values[j],
            t * values[k],
            u * values[m],
            v * values[n],
            w * values[o],
        )

    def _from_base(self, pose: Pose, values: Posture) -> Pose:
        assert self._arm is not None
        first = self._arm[1]
        if not first:
            return pose
        return frames.compose(frames.invert(along(self.steps[:first], values)), pose)

    def _as_posture(self, solved: Angles, near: Angles, values: Posture) -> Posture:
        """Controller values of solved angles, each on the turn that is closest to `near`."""
        assert self._arm is not None
        _, _, signs, places = self._arm
        urdf = list(values)
        for angle, old, sign, place in zip(solved, near, signs, places, strict=True):
            urdf[place] = sign * (angle + _TURN * round((old - angle) / _TURN))
        return self.map.to_controller(urdf)

    def found(self, pose: Pose, near: Posture) -> Iterator[Posture]:
        """Postures within the ranges that reach a pose, one after the other as they are found."""
        if self.is_closed_form:
            yield from self.solutions(pose, near)
            return
        for postures in self.arm.rounds(pose, near):
            for posture in postures:
                yield from self._turned(posture)

    @cached_property
    def arm(self) -> ArmSearch:
        """What iteration can find, where there is no formula."""
        return ArmSearch(self.group, self.map, self.steps)

    @property
    def seventh(self) -> int:
        """Place of the axis between axes 2 and 3 whose robtargets name the arm angle; else -1."""
        return self.arm.seventh

    def at_arm_angle(self, pose: Pose, angle: float, near: Posture) -> Iterator[Posture]:
        """Postures within the ranges for a pose and an arm angle, as they are found from `near`."""
        joint = self.group.joints[self.seventh]
        found: list[Posture] = []
        for posture in self.arm.at_arm_angle(pose, angle, near):
            for turned in self._turned(posture):
                value = turned[self.seventh]
                fits = joint.lower - ROUNDING <= value <= joint.upper + ROUNDING
                if fits and not _known(turned, found):
                    found.append(turned)
                    yield turned

    def _turned(self, posture: Posture) -> list[Posture]:
        """The posture with every turn of its axes that lies within the ranges."""
        found: list[list[float]] = [[]]
        for value, joint in zip(posture, self.group.joints, strict=True):
            low, high = joint.lower - ROUNDING, joint.upper + ROUNDING
            if joint.kind == "prismatic":
                turns = [value] if low <= value <= high else []
            elif not joint.axis.startswith("rax"):
                turns = [value]
            else:
                first = value - _TURN * floor((value - low) / _TURN)
                turns = []
                while first <= high:
                    turns.append(first)
                    first += _TURN
            found = [[*head, turn] for head in found for turn in turns]
        return [tuple(p) for p in found]

    # -- configuration ----------------------------------------------------------------------

    def configuration(self, posture: Posture) -> AxisConfiguration:
        """confdata of a posture: quarter turns of axes 1, 4 and 6, and cfx.

        cfx (memory of RobotWare): +4 wrist centre behind axis 1, +2 behind the lower arm, +1
        axis 5 negative. It is 0 for robots with a parallel rod, whose arm cannot turn over
        (S4 datasys 1-confdata), and where there is no closed form.
        """
        quarters = []
        for axis in ("rax_1", "rax_4", "rax_6"):
            place = self._axes.get(axis)
            quarters.append(0 if place is None else quarter(posture[place], self._linear[place]))
        x = 0
        if self._arm is not None and self._tells_branches:
            angles = self._robot_angles(self.map.to_urdf(posture))
            back, behind, _ = self._arm[0].branch(angles)
            x = 4 * back + 2 * behind + (posture[self._axes["rax_5"]] < 0)
        return quarters[0], quarters[1], quarters[2], x

    def misfit(self, posture: Posture, wanted: AxisConfiguration) -> float | None:
        """Quarters (m) by which the worst of axes 1, 4 and 6 is outside its own; 0: none is.

        None: another cfx. With axis 5 at zero both its signs fit.
        """
        if self._tells_branches:
            other = self.configuration(posture)[3] ^ wanted[3]
            if other and not (other == 1 and abs(posture[self._axes["rax_5"]]) <= SINGULAR):
                return None
        worst = 0.0
        for axis, cf in zip(("rax_1", "rax_4", "rax_6"), wanted, strict=False):
            place = self._axes.get(axis)
            if place is not None:
                at = posture[place] / (1.0 if self._linear[place] else pi / 2)
                worst = max(worst, cf - at, at - cf - 1)
        return worst

    def room(self, check: ConfigurationCheck) -> float:
        """The largest misfit of a posture that has a configuration.

        0.5 quarters is just what tells a turned wrist from one that is not (S4 overview 5-33);
        where cfx does that, "turn" leaves 1.5, which tells one turn of an axis from the next.
        """
        return 1.5 if check == "turn" and self._tells_branches else 0.5

    def matches(
        self, posture: Posture, wanted: AxisConfiguration, check: ConfigurationCheck = "turn"
    ) -> bool:
        """Whether a posture has a configuration."""
        misfit = self.misfit(posture, wanted)
        return misfit is not None and misfit <= self.room(check) + _NEAR

    def fitting(
        self, postures: Sequence[Posture], wanted: AxisConfiguration, check: ConfigurationCheck
    ) -> Posture | None:
        """Of the postures that have a configuration the best one, the first of equal ones."""
        best, least = None, self.room(check) + _NEAR
        for posture in postures:
            misfit = self.misfit(posture, wanted)
            if misfit is not None and misfit < least:
                best, least = posture, misfit - _NEAR
        return best

    @property
    def _tells_branches(self) -> bool:
        """Whether cfx says on which of the eight branches a posture lies."""
        return self._arm is not None and not self.group.coupling

    @cached_property
    def _axes(self) -> dict[str, int]:
        return {joint.axis: i for i, joint in enumerate(self.group.joints)}

    @cached_property
    def _linear(self) -> tuple[bool, ...]:
        return tuple(joint.kind == "prismatic" for joint in self.group.joints)

    # -- recognising a wrist arm ------------------------------------------------------------

    @cached_property
    def _arm(self) -> tuple[WristArm, int, tuple[int, ...], tuple[int, ...]] | None:
        """The closed form, the number of steps before it, signs and places of its axes."""
        steps = self.steps
        places = [self._axes.get(f"rax_{i}", -1) for i in range(1, 7)]
        if -1 in places or any(self._linear[i] for i in places):
            return None
        order = [s.joint for s in steps if s.joint in places]
        if order != places or any(step.follows for step in steps):
            return None
        first = next(i for i, s in enumerate(steps) if s.joint == places[0])
        if any(s.joint >= 0 and s.joint not in places for s in steps[first:]):
            return None
        points, axes, flange = self._zero_frame(steps[first:])
        return _recognise(points, axes, flange, first, tuple(places))

    @cached_property
    def _four(self) -> tuple[FourAxes, int, tuple[int, ...]] | None:
        """The closed form of an arm with four axes, the number of steps before it, its places."""
        steps = self.steps
        names = tuple(axis for axis in self._axes if axis.startswith("rax"))
        if sorted(names) not in (["rax_1", "rax_2", "rax_3", "rax_6"], sorted(_SCARA)):
            return None
        places = tuple(self._axes[axis] for axis in sorted(names))
        if [s.joint for s in steps if s.joint in places] != list(places):
            return None
        first = next(i for i, s in enumerate(steps) if s.joint == places[0])
        if any(s.joint >= 0 and s.joint not in places for s in steps[first:]):
            return None
        slides = [self._linear[i] for i in places]
        passive = [i for i, s in enumerate(steps) if s.follows]
        points, axes, flange = self._zero_frame(steps[first:])
        if slides == [False, False, True, False] and not passive:
            made: FourAxes | None = scara(points, axes, flange)
        elif not any(slides) and len(passive) == 1:
            step = steps[passive[0]]
            signs = {places[1]: axes[1][1], places[2]: axes[2][1]}
            wrist, kept = IDENTITY, steps[first : passive[0] + 1]
            for before in kept:
                wrist = frames.compose(wrist, before.fixed)
            across = frames.rotate(wrist[1], step.axis)[1]
            # The rods undo what axes 2 and 3 turn.
            if {i: k * across for i, k in step.follows} != {i: -v for i, v in signs.items()}:
                return None
            made = palletiser(points, axes, wrist[0], flange)
        else:
            return None
        return None if made is None else (made, first, places)

    def _of_four(self, pose: Pose, near: Posture, branch: FourBranch) -> Posture | None:
        assert self._four is not None
        arm, first, places = self._four
        values = self.map.to_urdf(near)
        if first:
            pose = frames.compose(frames.invert(along(self.steps[:first], values)), pose)
        solved = arm.solve(pose, branch)
        if solved is None:
            return None
        urdf = list(values)
        for place, value in zip(places, solved, strict=True):
            turns = 0 if self._linear[place] else round((values[place] - value) / _TURN)
            urdf[place] = value + _TURN * turns
        return self.map.to_controller(urdf)

    @staticmethod
    def _zero_frame(steps: tuple[Step, ...]) -> tuple[list[Vector], list[Vector], Pose]:
        """A point and the direction of each axis at zero, and the flange, from the base."""
        pose, points, axes = IDENTITY, [], []
        for step in steps:
            pose = frames.compose(pose, step.fixed)
            if step.joint >= 0:
                points.append(pose[0])
                axes.append(frames.rotate(pose[1], step.axis))
        return points, axes, pose


def _recognise(
    points: list[Vector], axes: list[Vector], flange: Pose, first: int, places: tuple[int, ...]
) -> tuple[WristArm, int, tuple[int, ...], tuple[int, ...]] | None:
    signs = []
    for axis, n in zip(axes, (2, 1, 1, 0, 1, 0), strict=True):
        if abs(abs(axis[n]) - 1.0) > _NEAR:
            return None
        signs.append(1 if axis[n] > 0 else -1)
    if abs(points[0][0]) > _NEAR or abs(points[0][1]) > _NEAR:
        return None
    # Axis 5 is met by axis 4 and axis 6 (both along x) in the wrist centre.
    x5, z5 = points[4][0], points[4][2]
    y4, z4 = points[3][1], points[3][2]
    y6, z6 = points[5][1], points[5][2]
    if max(abs(z4 - z5), abs(z6 - z5), abs(y4 - y6)) > _NEAR:
        return None
    (x2, _, z2), (x3, _, z3) = points[1], points[2]
    centre = (x5, y4, z5)
    back = frames.conjugate(flange[1])
    arm = WristArm(
        shoulder=(x2, z2),
        upper=(hypot(x3 - x2, z3 - z2), atan2(z3 - z2, x3 - x2)),
        fore=(hypot(x5 - x3, z5 - z3), atan2(z5 - z3, x5 - x3)),
        lateral=y4,
        flange=frames.rotate(back, frames.subtract(flange[0], centre)),
        turn=flange[1],
    )
    if min(arm.upper[0], arm.fore[0]) < _NEAR:
        return None
    return arm, first, tuple(signs), places


def quarter(value: float, linear: bool = False) -> int:
    """confdata of one axis: quarter turns, or metres; 0 at 0, -2 at -90 degrees.

    S4 datasys 1-confdata-1 gives trunc(angle / 90 - 1) for negative angles, which differs from
    the floor only at exact negative quarters.
    """
    size = 1.0 if linear else pi / 2
    return int(value / size) if value >= 0 else int(value / size - 1)


def _known(posture: Posture, found: list[Posture]) -> bool:
    return any(
        max(abs(a - b) for a, b in zip(posture, other, strict=True)) < 1e-6 for other in found
    )


def orientation(pose: Pose) -> Quaternion:
    """Orientation of a pose with a scalar part that is not negative."""
    q = pose[1]
    return (-q[0], -q[1], -q[2], -q[3]) if q[0] < 0 else q
