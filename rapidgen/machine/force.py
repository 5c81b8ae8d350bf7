"""Force sensors at robots' hands, as far as a file tells what they measure: nothing is touched.

Readings come in turn, and the last one stays. They are what is left when the load of the tool is
taken off, which has to be told first (FCCalib).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

Reading = tuple[float, ...]
"""Force x, y, z (N), torque about x, y, z (Nm)."""


@dataclass(frozen=True, slots=True)
class Measured:
    """What is told of a sensor; `readings` None: nothing is."""

    readings: Sequence[Reading] | None = None
    mass: float = 0.0
    """Of the load that is found at the hand, kg."""
    center: tuple[float, ...] = (0.0, 0.0, 0.0)
    """Where its centre is, mm."""


@dataclass(slots=True)
class ForceSensor:
    """The sensor of one robot."""

    measured: Measured
    calibrated: bool = False
    controls: bool = False
    """Whether force control is active."""
    pressing: bool = False
    """Whether it is on a path with a process force."""
    taken: int = 0

    def read(self) -> Reading:
        """The next reading."""
        rows = self.measured.readings or ()
        result = rows[min(self.taken, len(rows) - 1)]
        self.taken += 1
        return result


@dataclass(slots=True)
class ForceSensors:
    """One for each robot, all with the same description."""

    measured: Measured = field(default_factory=Measured)
    by_group: dict[str, ForceSensor] = field(default_factory=dict)

    def of(self, group: str) -> ForceSensor:
        """That of a motion group."""
        return self.by_group.setdefault(group, ForceSensor(self.measured))
