"""Recorded joint messages, as arrays and as CSV.

The CSV has `time,<joint names>` in s and rad (m).
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rapidgen._compat import Self
from rapidgen.client.core.group import Group
from rapidgen.client.core.state import Feedback, State
from rapidgen.client.core.state_port import Sample
from rapidgen.client.trajectory import Array, Trajectory

if TYPE_CHECKING:
    import pandas


class JointRecording:
    """All joint messages since its start; times in s from the first one.

    With `feedback=True` of the client these are the controller's own times (`by_controller`), else
    those of reception, which the network and this machine delay.
    """

    def __init__(self, group: Group) -> None:
        self.group = group
        self.by_controller = False
        self._samples: list[Sample] = []
        self._taken: list[float] = []

    def add(self, sample: Sample) -> None:
        """Record one joint message; only feedback if the driver sends it."""
        if sample.stamp is not None and not self.by_controller:
            self.by_controller = True
            self._samples.clear()
        if sample.stamp is not None or not self.by_controller:
            self._samples.append(sample)

    def accepted(self, time: float) -> None:
        """Record the client's time at which the controller accepted a motion."""
        self._taken.append(time)

    @property
    def begins(self) -> tuple[float, ...]:
        """Start times of the recorded motions, s as `times`.

        They are derived from the client's clock and the message before, so their accuracy is that
        of the message period.
        """
        result = []
        for time in self._taken:
            before = [sample for sample in self._samples if sample.time <= time][-1:]
            result += [self._at(s) - self._at(self._samples[0]) + time - s.time for s in before]
        return tuple(result)

    @staticmethod
    def _at(sample: Sample) -> float:
        return sample.time if sample.stamp is None else sample.stamp

    def __len__(self) -> int:
        return len(self._samples)

    def __repr__(self) -> str:
        return f"<JointRecording {self.trajectory()}>"

    def _repr_html_(self) -> str:
        return self.trajectory()._repr_html_()

    @property
    def times(self) -> Array:
        """(n,) s from the first message."""
        stamps = np.array([self._at(sample) for sample in self._samples], dtype=np.float64)
        return stamps - stamps[:1]

    @property
    def positions(self) -> Array:
        """(n, k) rad or m, URDF order."""
        rows = [self.group.from_wire(sample.joints) for sample in self._samples]
        return np.array(rows, dtype=np.float64).reshape(len(rows), len(self.group.names))

    def trajectory(self) -> Trajectory:
        """The recording as a trajectory.

        Of messages with the same time the last is used: it holds the most recent position.
        """
        times = self.times
        keep = np.diff(times, append=np.inf) > 0
        return Trajectory(times[keep], self.positions[keep], self.group.names)

    def to_csv(self, path: Path) -> None:
        """Write `time,<joint names>`. Raises OSError."""
        self.trajectory().to_csv(path)

    def to_dataframe(self) -> "pandas.DataFrame":
        """Return a pandas DataFrame, as `Trajectory.to_dataframe`."""
        return self.trajectory().to_dataframe()


class CsvWriter:
    """Writer of states or feedback to a CSV file. Raises OSError.

    The first line gives the units in a comment; then follow `time,<joint names>`, s from the first.
    """

    def __init__(self, path: Path, group: Group) -> None:
        self.count = 0
        self._began = 0.0
        self._newest: tuple[float, tuple[float, ...]] | None = None
        """Row that is not written yet: the next one may have the same time."""
        units = ["rad" if joint.kind == "revolute" else "m" for joint in group.joints]
        pairs = [f"{name} {unit}" for name, unit in zip(group.names, units, strict=True)]
        self._file = path.open("w", encoding="utf-8", newline="")
        self._file.write(f"# time s, {', '.join(pairs)}\n")
        self._file.write(",".join(["time", *group.names]) + "\n")

    def write(self, state: State | Feedback) -> None:
        """Write one row; of rows with the same time only the last."""
        newest = self._newest
        if newest is None:
            self._began = state.time
        time = state.time - self._began
        if newest is not None and time < newest[0]:
            return
        if newest is None or time > newest[0]:
            self._flush()
            self.count += 1
        self._newest = time, state.joints

    def _flush(self) -> None:
        if self._newest is not None:
            time, joints = self._newest
            self._file.write(",".join([f"{time:.6f}", *(f"{v:.9g}" for v in joints)]) + "\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._flush()
        finally:
            self._file.close()
