"""Iterative search for a group's arm: postures by pose and arm angle."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING

from rapidgen.axes.arm_angle import ArmAngle
from rapidgen.axes.chain import Posture, Step
from rapidgen.axes.frames import Pose
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig

if TYPE_CHECKING:
    from rapidgen.axes.numeric_ik import Search

_TURN = 2 * pi


@dataclass(frozen=True)
class ArmSearch:
    """The arm of a group: its robot axes, and a seventh one if present.

    Results have the turns closest to the start; ranges are ignored.
    """

    group: GroupConfig
    map: JointMap
    steps: tuple[Step, ...]

    def near(self, pose: Pose, start: Posture) -> Posture | None:
        """Return the posture on the branch of a start, with its external axes."""
        values = self.search(start).near(pose, tuple(start[i] for i in self._places))
        return None if values is None else self._posture(self._places, values, start)

    def rounds(self, pose: Pose, start: Posture) -> Iterator[Iterator[Posture]]:
        """Yield postures for a pose, in rounds of starts farther away."""
        for result in self.search(start).rounds(pose, tuple(start[i] for i in self._places)):
            yield (self._posture(self._places, values, start) for values in result)

    def at_arm_angle(self, pose: Pose, angle: float, near: Posture) -> Iterator[Posture]:
        """Yield postures for a pose and an arm angle (rad), from `near`."""
        search = self.search(near, complete=True)
        start = tuple(near[i] for i in self._order)
        for values in self._angle.postures(search, pose, angle, start):
            yield self._posture(self._order, values, near)

    @cached_property
    def seventh(self) -> int:
        """Return the index of the axis between axes 2 and 3, else -1.

        Its robtargets contain the arm angle.
        """
        own = [self.group.joints[i].axis for i in self._own]
        return self._inner[0] if len(self._inner) == 1 and len(own) == 6 else -1

    @cached_property
    def _angle(self) -> ArmAngle:
        # The reference points from an arm towards the middle between two (both home targets of
        # public programs for the IRB 14000); for a single arm along y [mem].
        side = self.steps[0].fixed[0][1]
        return ArmAngle((0.0, -1.0 if side > 0 else 1.0, 0.0))

    def arm_angle(self, posture: Posture) -> float:
        """Return eax_a of a robtarget for a posture with seven axes (rad)."""
        values = tuple(posture[i] for i in self._order)
        return self._angle.of(self.search(posture, complete=True).lines(values)[1])

    def cfx(self, posture: Posture) -> int:
        """Return cfx of a robtarget for a posture with seven axes."""
        values = tuple(posture[i] for i in self._order)
        axes = self.search(posture, complete=True).lines(values)[1]
        by_axis = {joint.axis: v for joint, v in zip(self.group.joints, posture, strict=True)}
        return self._angle.cfx(axes, by_axis["rax_2"], by_axis["rax_5"])

    @cached_property
    def _order(self) -> tuple[int, ...]:
        """Return the indices of the arm's axes in chain order."""
        return tuple(s.joint for s in self.steps if s.joint in (*self._own, *self._inner))

    def search(self, start: Posture, *, complete: bool = False) -> "Search":
        """Return the search of this arm, with the base as in `start`.

        `complete`: with its seventh axis.
        """
        key = complete, tuple(start[i] for i in self._outside)
        if key not in self._searches:
            for old in [k for k in self._searches if k[0] == complete]:
                del self._searches[old]
            places = self._order if complete else (*self._own, *self._inner)
            free = len(places) if complete else len(self._own)
            self._searches[key] = self._make_search(start, places, free)
        return self._searches[key]

    def _make_search(self, start: Posture, places: tuple[int, ...], free: int) -> "Search":
        from rapidgen.axes.numeric_ik import (  # numpy: only without a formula
            Link,
            Search,
            linear,
        )

        weights, constants = linear(self.map.to_urdf, start, places)
        links = []
        for step in self.steps:
            parts = ((step.joint, 1.0),) if step.joint >= 0 else step.follows
            moved = [sum(weights[i][n] * k for i, k in parts) for n in range(len(places))]
            links.append(
                Link(
                    step.fixed,
                    step.axis,
                    step.prismatic,
                    tuple(moved) if parts else (),
                    sum(constants[i] * k for i, k in parts),
                )
            )
        joints = [self.group.joints[place] for place in places]
        return Search(
            tuple(links),
            tuple((joint.lower, joint.upper) for joint in joints),
            tuple(joint.kind == "revolute" for joint in joints),
            free,
        )

    @cached_property
    def _searches(self) -> dict[tuple[bool, tuple[float, ...]], "Search"]:
        return {}

    @cached_property
    def _own(self) -> tuple[int, ...]:
        """Return the indices of the robot axes."""
        return tuple(i for i, j in enumerate(self.group.joints) if j.axis.startswith("rax"))

    @cached_property
    def _inner(self) -> tuple[int, ...]:
        """Return the indices of external axes in the arm: a YuMi arm's seventh."""
        order = [s.joint for s in self.steps if s.joint >= 0]
        own = [order.index(i) for i in self._own if i in order]
        among = range(min(own), max(own)) if own else range(0)
        return tuple(order[n] for n in among if order[n] not in self._own)

    @cached_property
    def _outside(self) -> tuple[int, ...]:
        """Return the indices of the other external axes.

        They carry the arm, or the chain does not name them.
        """
        arm = {*self._own, *self._inner}
        return tuple(i for i in range(len(self.group.joints)) if i not in arm)

    @cached_property
    def _places(self) -> tuple[int, ...]:
        return (*self._own, *self._inner)

    def _posture(
        self, places: tuple[int, ...], values: tuple[float, ...], start: Posture
    ) -> Posture:
        complete = list(start)
        for place, value in zip(places, values, strict=True):
            complete[place] = value
        return tuple(
            v + _TURN * round((n - v) / _TURN) if j.kind == "revolute" else v
            for v, n, j in zip(complete, start, self.group.joints, strict=True)
        )
