"""Joint map: URDF values, controller values, RAPID's degrees and mm.

controller = sign * URDF + offset for each joint; on coupled robots (parallel rod) axis 3 then gets
k * axis 2 added, because ABB counts it from the horizontal (abb_driver's `J23_coupled`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from rapidgen.config.model import GroupConfig, Joint, KeptAxis

ABSENT = 9e9
"""RAPID's value of an external axis that is not connected."""
_DEG = 180.0 / math.pi
_ROBOT_AXES = tuple(f"rax_{i}" for i in range(1, 7))
_EXTERNAL_AXES = tuple(f"eax_{letter}" for letter in "abcdef")


@dataclass(frozen=True)
class JointMap:
    """Conversions between the three forms.

    All sequences are in wire order (`joints`).
    """

    joints: tuple[Joint, ...]
    coupling: float = 0.0
    kept: tuple[KeptAxis, ...] = ()

    @classmethod
    def of(cls, group: GroupConfig) -> "JointMap":
        """Return the map of one motion group."""
        return cls(group.joints, group.coupling, group.kept)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return URDF joint names."""
        return tuple(joint.name for joint in self.joints)

    @cached_property
    def two_sided(self) -> bool:
        """True if two postures of a pose may have the same confdata.

        A SCARA's arm reaches it from either side, and no public source gives its cfx.
        """
        kinds = {joint.axis: joint.kind for joint in self.joints}
        return [kinds.get(axis) for axis in _ROBOT_AXES[:3]] == [
            "revolute",
            "revolute",
            "prismatic",
        ]

    @cached_property
    def _coupled(self) -> tuple[int, int] | None:
        """Return the indices of axis 2 and axis 3 if they are coupled."""
        if not self.coupling:
            return None
        axes = [joint.axis for joint in self.joints]
        return axes.index("rax_2"), axes.index("rax_3")

    @cached_property
    def _slots(self) -> tuple[tuple[int, float], ...]:
        """Return each joint's slot and RAPID units per SI unit.

        Slots 0 to 5 are in robax, 6 to 11 in extax.
        """
        order = _ROBOT_AXES + _EXTERNAL_AXES
        return tuple(
            (order.index(joint.axis), _DEG if joint.kind == "revolute" else 1000.0)
            for joint in self.joints
        )

    @cached_property
    def _upright(self) -> bool:
        """True if all axes turn as their joints do, from the same zero.

        This holds for most robots.
        """
        return all(j.sign == 1 and j.offset == 0 for j in self.joints)

    def to_controller(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Return controller axis values of URDF joint values."""
        if self._upright and len(urdf) == len(self.joints):
            values = list(urdf)
        else:
            values = [j.sign * v + j.offset for j, v in zip(self.joints, urdf, strict=True)]
        if self._coupled is not None:
            second, third = self._coupled
            values[third] += self.coupling * values[second]
        return tuple(values)

    def to_urdf(self, controller: Sequence[float]) -> tuple[float, ...]:
        """Return URDF joint values of controller axis values."""
        values = list(controller)
        if self._coupled is not None:
            second, third = self._coupled
            values[third] -= self.coupling * values[second]
        if self._upright and len(values) == len(self.joints):
            return tuple(values)
        return tuple(j.sign * (v - j.offset) for j, v in zip(self.joints, values, strict=True))

    def rates_to_controller(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Convert velocities or accelerations: `to_controller` without offsets."""
        values = [j.sign * v for j, v in zip(self.joints, urdf, strict=True)]
        if self._coupled is not None:
            second, third = self._coupled
            values[third] += self.coupling * values[second]
        return tuple(values)

    def rates_to_urdf(self, controller: Sequence[float]) -> tuple[float, ...]:
        """Convert velocities or accelerations: `to_urdf` without offsets."""
        values = list(controller)
        if self._coupled is not None:
            second, third = self._coupled
            values[third] -= self.coupling * values[second]
        return tuple(j.sign * v for j, v in zip(self.joints, values, strict=True))

    def to_rapid(self, controller: Sequence[float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return `robax` and `extax` in deg and mm; absent axes are 9E9."""
        slots = [0.0] * 6 + [ABSENT] * 6
        for axis in self.kept:
            slots[_ROBOT_AXES.index(axis.axis)] = axis.value * _DEG
        for (slot, unit), value in zip(self._slots, controller, strict=True):
            slots[slot] = value * unit
        return tuple(slots[:6]), tuple(slots[6:])

    def from_rapid(
        self, robax: Sequence[float], extax: Sequence[float], default: Sequence[float] | None = None
    ) -> tuple[float, ...]:
        """Return controller values of `robax` and `extax`.

        An external axis of this group that is given as 9E9 takes its value of `default`; ValueError
        names the axis when there is no default.
        """
        slots = (*robax, *extax)
        values = []
        for i, (slot, unit) in enumerate(self._slots):
            value = slots[slot]
            if slot >= 6 and value > ABSENT / 2:
                if default is None:
                    raise ValueError(self.joints[i].axis)
                values.append(default[i])
            else:
                values.append(value / unit)
        return tuple(values)

    def unit_of(self, index: int) -> tuple[str, float]:
        """Return RAPID's unit of a joint and its size in rad or m."""
        return ("deg" if self.joints[index].kind == "revolute" else "mm"), self._slots[index][1]
