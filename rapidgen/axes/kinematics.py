"""Forward and inverse kinematics of one motion group, from its chain.

Poses are those of the flange (tool0) in the chain's root frame, m; postures are controller axis
values in wire order, rad and m. External axes that carry the robot (a track) move its base;
external axes that the chain does not name have no influence.

Rules of the inverse:

- The chain at zero decides the method once: formulas for four axes (`four_axes`), for six axes with
  a spherical wrist (`spherical_wrist`), a scalar equation for an offset wrist (`offset_wrist`),
  else iteration (`posture_search`, `numeric_ik`). Names and signs do not matter
  (`solver_selection`).
- A formula works in URDF angles of the arm alone. This module removes the base motion of external
  axes before, and applies signs, offsets and the coupling of axis 3 after.
- A formula returns one value within +-pi for each branch. Each axis then gets every full turn
  within its range.
- `follow` stays on the branch of its start posture and ignores ranges, because a controller stops
  at a limit instead of changing the branch. `solutions` returns all branches within the ranges.
- External axes are never solved for: they keep the values of the start posture.
- Configurations (confdata) select a branch after solving. They never guide a formula.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import floor, pi
from typing import TYPE_CHECKING, Literal, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.chain import Posture as Posture
from rapidgen.axes.chain import Step, along, steps_of
from rapidgen.axes.four_axes import BRANCHES as FOUR_BRANCHES
from rapidgen.axes.four_axes import Branch as FourBranch
from rapidgen.axes.four_axes import Scara
from rapidgen.axes.frames import Pose, Quaternion
from rapidgen.axes.limits import ROUNDING
from rapidgen.axes.mapping import JointMap
from rapidgen.axes.posture_search import ArmSearch
from rapidgen.axes.solver_selection import Four, SixAxes, four_axes, six_axes
from rapidgen.axes.spherical_wrist import BRANCHES, SINGULAR, Angles
from rapidgen.config.model import ChainLink, GroupConfig

if TYPE_CHECKING:
    from rapidgen.axes.offset_wrist import OffsetWrist

AxisConfiguration = tuple[int, int, int, int]
"""cf1, cf4, cf6, cfx"""
ArmKind: TypeAlias = Literal["serial", "parallel rod", "seven axes", "palletiser", "SCARA", "other"]
"""Families of arms with one rule of configuration data each, see `axes.configuration`."""
ConfigurationCheck: TypeAlias = Literal["turn", "quarter"]
"""Allowed distance of axes 1, 4 and 6 from their quarters, see `Kinematics.room`."""
_ENOUGH = 8
"""Maximum number of postures of an iteration."""
_LONGER = 2
"""Additional rounds to find a configuration: two find all of an IRB 5400."""
_NEAR = 1e-6
_TURN = 2 * pi


@dataclass(frozen=True)
class MovingFrame:
    """The user frame of a unit with work objects, in the robot's root frame."""

    map: JointMap
    steps: tuple[Step, ...]

    @classmethod
    def of(cls, group: GroupConfig, chain: Sequence[ChainLink]) -> "MovingFrame":
        """Return the frame at the end of a chain of the group's joints."""
        return cls(JointMap.of(group), steps_of(group, chain))

    def pose(self, posture: Posture) -> Pose:
        """Return the frame for controller axis values in wire order."""
        return along(self.steps, self.map.to_urdf(posture))


@dataclass(frozen=True)
class Kinematics:
    """Kinematics of a group's chain. Create it with `Kinematics.of`."""

    group: GroupConfig
    map: JointMap
    steps: tuple[Step, ...]

    @classmethod
    def of(cls, group: GroupConfig) -> "Kinematics | None":
        """Return the kinematics of a group; None without geometry."""
        if not group.chain:
            return None
        return cls(group, JointMap.of(group), steps_of(group, group.chain))

    # -- forward ----------------------------------------------------------------------------

    def forward(self, posture: Posture) -> Pose:
        """Return the flange of a posture."""
        values = self.map.to_urdf(posture)
        result = self._arm
        if result is None:
            return along(self.steps, values)
        pose = result.arm.forward(self._robot_angles(values))
        if not result.first:
            return pose
        return frames.compose(along(self.steps[: result.first], values), pose)

    # -- inverse ----------------------------------------------------------------------------

    @property
    def is_closed_form(self) -> bool:
        """True if the inverse is a formula."""
        return self._arm is not None or self._four is not None

    def follow(self, pose: Pose, start: Posture) -> Posture | None:
        """Return the posture on the branch of `start`, turns as close as possible.

        External axes are those of `start`. None: out of reach, or the robot is on another branch
        there. Ranges are ignored.
        """
        values = self.map.to_urdf(start)
        if self._four is not None:
            four = self._four
            return self._of_four(pose, values, four.arm.branch([values[i] for i in four.places]))
        result = self._wrist
        if result is None:
            return self.arm.near(pose, start)
        angles, based = self._robot_angles(values), self._from_base(pose, values)
        if self._offset is None:
            solved = result.arm.solve(based, result.arm.branch(angles), angles[3])
            return None if solved is None else self._as_posture(solved, angles, values)
        solved = self._offset.near(based, angles)
        # If axis 6 alone cannot reach it, all axes may.
        if solved is None:
            return self.arm.near(pose, start)
        return self._as_posture(solved, angles, values)

    def beyond(self, pose: Pose, start: Posture) -> Iterator[Posture]:
        """Yield postures for a pose, ignoring ranges; external axes of `start`."""
        values = self.map.to_urdf(start)
        if self._four is not None:
            fours = (self._of_four(pose, values, branch) for branch in FOUR_BRANCHES)
            yield from (four for four in fours if four is not None)
            return
        yield from self._formulas(pose, values)
        if self._arm is None:
            for postures in self.arm.rounds(pose, start):
                yield from postures

    def solutions(
        self, pose: Pose, start: Posture, expected: AxisConfiguration | None = None
    ) -> list[Posture]:
        """Return all postures within the ranges that reach a pose.

        External axes are those of `start`. Axes that can turn more than once appear with every
        turn. Closest to `start` first. Without a closed form: the results of iteration from `start`
        and from other starts, at least one if there is any; with `expected` it searches longer for
        one of that configuration.
        """
        values = self.map.to_urdf(start)
        if self._four is not None:
            ways = (self._of_four(pose, values, branch) for branch in FOUR_BRANCHES)
            closed = [posture for posture in ways if posture is not None]
        else:
            closed = list(self._formulas(pose, values))
        result: list[Posture] = []
        for posture in closed:
            result += [p for p in self._turned(posture) if not _known(p, result)]
        if not result and not self.is_closed_form:
            fits = False
            for number, postures in enumerate(self.arm.rounds(pose, start)):
                for posture in postures:
                    new = [p for p in self._turned(posture) if not _known(p, result)]
                    result += new
                    fits = fits or any(
                        expected is None or self.misfit(p, expected) == 0.0 for p in new
                    )
                    if fits and len(result) >= _ENOUGH:
                        break
                if result and number >= (1 if fits else _LONGER):
                    break
        result.sort(key=lambda posture: _apart(posture, start))
        return result

    def _formulas(self, pose: Pose, values: Posture) -> Iterator[Posture]:
        """Yield postures of an arm with six axes on all branches.

        Turns are as close as possible to the URDF values.
        """
        result = self._wrist
        if result is None:
            return
        angles, based = self._robot_angles(values), self._from_base(pose, values)
        if self._offset is not None:
            for solved in self._offset.solutions(based):
                yield self._as_posture(solved, angles, values)
            return
        for branch in BRANCHES:
            one = result.arm.solve(based, branch, angles[3])
            if one is not None:
                yield self._as_posture(one, angles, values)

    def _robot_angles(self, values: Posture) -> Angles:
        assert self._wrist is not None
        r, s, t, u, v, w = self._wrist.signs
        i, j, k, m, n, o = self._wrist.places
        return (
            r * values[i],
            s * values[j],
            t * values[k],
            u * values[m],
            v * values[n],
            w * values[o],
        )

    def _from_base(self, pose: Pose, values: Posture) -> Pose:
        assert self._wrist is not None
        first = self._wrist.first
        if not first:
            return pose
        return frames.within(along(self.steps[:first], values), pose)

    def _as_posture(self, solved: Angles, start: Angles, values: Posture) -> Posture:
        """Return controller values of solved angles, turns closest to `start`."""
        assert self._wrist is not None
        urdf = list(values)
        for angle, old, sign, place in zip(
            solved, start, self._wrist.signs, self._wrist.places, strict=True
        ):
            urdf[place] = sign * (angle + _TURN * round((old - angle) / _TURN))
        return self.map.to_controller(urdf)

    def found(self, pose: Pose, start: Posture) -> Iterator[Posture]:
        """Yield postures within the ranges that reach a pose, as found."""
        if self.is_closed_form or self._offset is not None:
            yield from self.solutions(pose, start)
            return
        for postures in self.arm.rounds(pose, start):
            for posture in postures:
                yield from self._turned(posture)

    @cached_property
    def arm(self) -> ArmSearch:
        """Return the iterative search, for arms without a formula."""
        return ArmSearch(self.group, self.map, self.steps)

    @cached_property
    def seventh(self) -> int:
        """Return the index of the axis between axes 2 and 3, else -1.

        Its robtargets contain the arm angle.
        """
        return self.arm.seventh

    def at_arm_angle(self, pose: Pose, angle: float, start: Posture) -> Iterator[Posture]:
        """Yield postures within the ranges for a pose and an arm angle."""
        place = self.seventh
        joint = self.group.joints[place]
        lower, upper = joint.lower - ROUNDING, joint.upper + ROUNDING
        result: list[Posture] = []
        for posture in self.arm.at_arm_angle(pose, angle, start):
            value = posture[place] - _TURN * floor((posture[place] - lower) / _TURN)
            if value > upper:
                continue
            placed = (*posture[:place], value, *posture[place + 1 :])
            for turned in sorted(self._turned(placed), key=lambda turn: _apart(turn, start)):
                if not _known(turned, result):
                    result.append(turned)
                    yield turned

    def _turned(self, posture: Posture) -> list[Posture]:
        """Return the posture with every turn of its axes within the ranges."""
        result: list[list[float]] = [[]]
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
            result = [[*head, turn] for head in result for turn in turns]
        return [tuple(p) for p in result]

    # -- configuration ----------------------------------------------------------------------

    @cached_property
    def kind(self) -> ArmKind:
        """Return the family of the arm, from its axes and rods, not its name."""
        if self.seventh >= 0:
            return "seven axes"
        if self._four is not None:
            return "SCARA" if isinstance(self._four.arm, Scara) else "palletiser"
        if self._wrist is None:
            return "other"
        return "parallel rod" if self.group.coupling else "serial"

    def configuration(self, posture: Posture) -> AxisConfiguration:
        """Return confdata of a posture: quarters of axes 1, 4 and 6, and cfx.

        cfx: +4 wrist centre (where axes 4 and 5 meet) on the rear side of axis 1, +2 elbow turned
        over, +1 axis 5 negative; 438 targets of public programs have 0, 1, 2, 4 and 5 in this
        sense. It is 0 for robots with a parallel rod, whose arm cannot turn over (S4 datasys
        1-confdata), and without a formula. For an arm with seven axes see `ArmAngle.cfx`; its
        quarters have their multiple of 90 degrees in the middle.
        """
        quarters = []
        early = self._early
        for axis in ("rax_1", "rax_4", "rax_6"):
            place = self._axes.get(axis)
            linear = place is not None and self._linear[place]
            quarters.append(0 if place is None else quarter(posture[place] + early, linear))
        x = 0
        if self.seventh >= 0:
            x = self.arm.cfx(posture)
        elif self._wrist is not None and self._tells_branches:
            angles = self._robot_angles(self.map.to_urdf(posture))
            back, after, _ = self._wrist.arm.branch(angles)
            x = 4 * back + 2 * after + (posture[self._axes["rax_5"]] < 0)
        return quarters[0], quarters[1], quarters[2], x

    def misfit(self, posture: Posture, expected: AxisConfiguration) -> float | None:
        """Return the largest deviation of axes 1, 4 and 6 from their quarters.

        In quarters (m); 0: within. None: another cfx. With axis 5 at zero both its signs fit.
        """
        if self._tells_branches:
            other = self.configuration(posture)[3] ^ expected[3]
            if other and not (other == 1 and abs(posture[self._axes["rax_5"]]) <= SINGULAR):
                return None
        worst, early = 0.0, self._early
        for axis, cf in zip(("rax_1", "rax_4", "rax_6"), expected, strict=False):
            place = self._axes.get(axis)
            if place is not None:
                at = (posture[place] + early) / (1.0 if self._linear[place] else pi / 2)
                worst = max(worst, cf - at, at - cf - 1)
        return worst

    def misfit_limit(self, check: ConfigurationCheck) -> float:
        """Return the largest misfit of a posture that has a configuration.

        0.5 quarters just separate a turned wrist from another (S4 overview 5-33); if cfx does that,
        "turn" allows 1.5, which separates one turn of an axis from the next.
        """
        return 1.5 if check == "turn" and self._tells_branches else 0.5

    def matches(
        self, posture: Posture, expected: AxisConfiguration, check: ConfigurationCheck = "turn"
    ) -> bool:
        """True if a posture has a configuration."""
        misfit = self.misfit(posture, expected)
        return misfit is not None and misfit <= self.misfit_limit(check) + _NEAR

    def fitting(
        self, postures: Sequence[Posture], expected: AxisConfiguration, check: ConfigurationCheck
    ) -> Posture | None:
        """Return the best posture of a configuration, or None.

        Of equal ones the first.
        """
        best, least = None, self.misfit_limit(check) + _NEAR
        for posture in postures:
            misfit = self.misfit(posture, expected)
            if misfit is not None and misfit < least:
                best, least = posture, misfit - _NEAR
        return best

    @property
    def _tells_branches(self) -> bool:
        """True if cfx identifies the branch of a posture, one of eight."""
        return self.seventh >= 0 or (self._wrist is not None and not self.group.coupling)

    @cached_property
    def _early(self) -> float:
        """Return rad by which quarters of axes 1, 4 and 6 begin early.

        Relative to their multiple of 90 degrees.
        """
        return pi / 4 if self.seventh >= 0 else 0.0

    @cached_property
    def _axes(self) -> dict[str, int]:
        return {joint.axis: i for i, joint in enumerate(self.group.joints)}

    @cached_property
    def _linear(self) -> tuple[bool, ...]:
        return tuple(joint.kind == "prismatic" for joint in self.group.joints)

    # -- recognising a wrist arm ------------------------------------------------------------

    @cached_property
    def _arm(self) -> SixAxes | None:
        """Return the closed form of an arm with a spherical wrist."""
        result = self._wrist
        return None if result is None or any(result.offset) else result

    @cached_property
    def _offset(self) -> "OffsetWrist | None":
        """Return the solver of an arm whose axis 6 misses axes 4 and 5."""
        result = self._wrist
        if result is None or not any(result.offset):
            return None
        from rapidgen.axes.offset_wrist import OffsetWrist  # numpy: only without a formula

        return OffsetWrist(result.arm, result.offset)

    @cached_property
    def _wrist(self) -> SixAxes | None:
        return six_axes(self.steps, self._axes, self._linear)

    @cached_property
    def _four(self) -> Four | None:
        return four_axes(self.steps, self._axes, self._linear)

    def _of_four(self, pose: Pose, values: Posture, branch: FourBranch) -> Posture | None:
        assert self._four is not None
        arm, first, places = self._four.arm, self._four.first, self._four.places
        if first:
            pose = frames.within(along(self.steps[:first], values), pose)
        solved = arm.solve(pose, branch)
        if solved is None:
            return None
        urdf = list(values)
        for place, value in zip(places, solved, strict=True):
            turns = 0 if self._linear[place] else round((values[place] - value) / _TURN)
            urdf[place] = value + _TURN * turns
        return self.map.to_controller(urdf)


def quarter(value: float, linear: bool = False) -> int:
    """Return confdata of one axis: quarter turns or metres.

    0 at 0, -2 at -90 degrees. S4 datasys 1-confdata-1 gives trunc(angle / 90 - 1) for negative
    angles, which differs from the floor only at exact negative quarters.
    """
    size = 1.0 if linear else pi / 2
    return int(value / size) if value >= 0 else int(value / size - 1)


def _apart(posture: Posture, other: Posture) -> float:
    return sum(abs(a - b) for a, b in zip(posture, other, strict=True))


def _known(posture: Posture, result: list[Posture]) -> bool:
    return any(
        max(abs(a - b) for a, b in zip(posture, other, strict=True)) < 1e-6 for other in result
    )


def orientation(pose: Pose) -> Quaternion:
    """Return the orientation of a pose with a scalar part >= 0."""
    q = pose[1]
    return (-q[0], -q[1], -q[2], -q[3]) if q[0] < 0 else q
