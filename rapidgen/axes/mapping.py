"""The joint map: URDF joint values, controller axis values, RAPID's degrees and millimetres.

controller = sign * URDF + offset for each joint; on coupled robots (parallel rod) axis 3 then
gets k * axis 2 added, because ABB counts it from the horizontal (abb_driver's `J23_coupled`).
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
    """Both ways between the three forms.

    All sequences are in wire order (`joints`).
    """

    joints: tuple[Joint, ...]
    coupling: float = 0.0
    kept: tuple[KeptAxis, ...] = ()

    @classmethod
    def of(cls, group: GroupConfig) -> "JointMap":
        """The map of one motion group."""
        return cls(group.joints, group.coupling, group.kept)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """URDF joint names."""
        return tuple(joint.name for joint in self.joints)

    @cached_property
    def two_sided(self) -> bool:
        """Whether confdata may not tell two postures of a pose apart: a SCARA's arm comes to it
        from either side, and no public source says what its cfx means."""
        kinds = {joint.axis: joint.kind for joint in self.joints}
        return [kinds.get(axis) for axis in _ROBOT_AXES[:3]] == [
            "revolute",
            "revolute",
            "prismatic",
        ]

    @cached_property
    def _coupled(self) -> tuple[int, int] | None:
        """Places of axis 2 and axis 3 when they are coupled."""
        if not self.coupling:
            return None
        axes = [joint.axis for joint in self.joints]
        return axes.index("rax_2"), axes.index("rax_3")

    @cached_property
    def _slots(self) -> tuple[tuple[int, float], ...]:
        """Per joint: slot 0..5 in robax or 6..11 in extax, and RAPID units per SI unit."""
        order = _ROBOT_AXES + _EXTERNAL_AXES
        return tuple(
            (order.index(joint.axis), _DEG if joint.kind == "revolute" else 1000.0)
            for joint in self.joints
        )

    @cached_property
    def _upright(self) -> bool:
        """Whether all axes turn as their joints do, from the same zero: most robots' do."""
        return all(j.sign == 1 and j.offset == 0 for j in self.joints)

    def to_controller(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Controller axis values of URDF joint values."""
        if self._upright and len(urdf) == len(self.joints):
            values = list(urdf)
        else:
            values = [j.sign * v + j.offset for j, v in zip(self.joints, urdf, strict=True)]
        if self._coupled is not None:
            second, third = self._coupled
            values[third] += self.coupling * values[second]
        return tuple(values)

    def to_urdf(self, controller: Sequence[float]) -> tuple[float, ...]:
        """URDF joint values of controller axis values."""
        values = list(controller)
        if self._coupled is not None:
            second, third = self._coupled
            values[third] -= self.coupling * values[second]
        if self._upright and len(values) == len(self.joints):
            return tuple(values)
        return tuple(j.sign * (v - j.offset) for j, v in zip(self.joints, values, strict=True))

    def rates_to_controller(self, urdf: Sequence[float]) -> tuple[float, ...]:
        """Velocities or accelerations: as `to_controller`, without the offsets."""
        values = [j.sign * v for j, v in zip(self.joints, urdf, strict=True)]
        if self._coupled is not None:
            second, third = self._coupled
            values[third] += self.coupling * values[second]
        return tuple(values)

    def rates_to_urdf(self, controller: Sequence[float]) -> tuple[float, ...]:
        """Velocities or accelerations: as `to_urdf`, without the offsets."""
        values = list(controller)
        if self._coupled is not None:
            second, third = self._coupled
            values[third] -= self.coupling * values[second]
        return tuple(j.sign * v for j, v in zip(self.joints, values, strict=True))

    def to_rapid(self, controller: Sequence[float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """`robax` and `extax` in deg and mm; external axes without a joint are 9E9."""
        slots = [0.0] * 6 + [ABSENT] * 6
        for axis in self.kept:
            slots[_ROBOT_AXES.index(axis.axis)] = axis.value * _DEG
        for (slot, unit), value in zip(self._slots, controller, strict=True):
            slots[slot] = value * unit
        return tuple(slots[:6]), tuple(slots[6:])

    def from_rapid(
        self, robax: Sequence[float], extax: Sequence[float], default: Sequence[float] | None = None
    ) -> tuple[float, ...]:
        """Controller values of `robax` and `extax`.

        An external axis of this group that is given as 9E9 takes its value of `default`;
        ValueError names the axis when there is no default.
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
        """RAPID's unit of a joint and how many of it are one rad or m."""
        return ("deg" if self.joints[index].kind == "revolute" else "mm"), self._slots[index][1]
