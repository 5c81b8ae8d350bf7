"""Joint messages kept: as arrays, and as CSV `time,<joint names>` in s and rad (m)."""

from pathlib import Path

import numpy as np

from rapidgen.client.group import Group
from rapidgen.client.tracker import Sample
from rapidgen.client.trajectory import Array, Trajectory


class Recording:
    """Every joint message since it began; times count from the first one kept, s."""

    def __init__(self, group: Group) -> None:
        self.group = group
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> None:
        """Keep one."""
        self._samples.append(sample)

    def __len__(self) -> int:
        return len(self._samples)

    @property
    def began(self) -> float:
        """The client's clock at the first message; 0 without one."""
        return self._samples[0].time if self._samples else 0.0

    @property
    def times(self) -> Array:
        """(n,) s from the first message."""
        return np.array([sample.time - self.began for sample in self._samples], dtype=np.float64)

    @property
    def positions(self) -> Array:
        """(n, k) rad or m, URDF order."""
        rows = [self.group.from_wire(sample.joints) for sample in self._samples]
        return np.array(rows, dtype=np.float64).reshape(len(rows), len(self.group.names))

    def trajectory(self) -> Trajectory:
        """What was recorded, as a trajectory. Messages that came together are one point."""
        times = self.times
        keep = np.concatenate([[True], np.diff(times) > 0]) if len(times) else np.zeros(0, bool)
        return Trajectory(times[keep], self.positions[keep], self.group.names)

    def to_csv(self, path: Path) -> None:
        """Write `time,<joint names>`. Raises OSError."""
        self.trajectory().to_csv(path)
