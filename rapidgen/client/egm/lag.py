"""How far a robot is behind what is sent to it.

The lag is the delay by which the measured positions repeat the references best, in the sense of
least squares over the last seconds. It needs no model of the controller: filter, dead time and
network are part of it. With references that carry their speed, as this client sends them, a gain
does not add to the lag of a smooth motion.
"""

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from rapidgen.client.egm.exchange import EgmState

WINDOW = 1_000
"""Frames that are kept: 4 s."""
MOST = 0.3
"""s, the longest lag that is looked for."""
_STEP = 0.004
_LEAST = 1e-3
"""rad or m by which a reference must move; a standing robot shows no lag."""
_FEWEST = 150
"""Frames."""

Array: TypeAlias = npt.NDArray[np.float64]
_Row: TypeAlias = tuple[float, tuple[float, ...], tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class Lag:
    """A measured lag."""

    seconds: float
    residual: float
    """p99 of the distance between a measured position and the delayed reference, rad or m."""


class LagMeter:
    """Keeps the last states of a session."""

    def __init__(self) -> None:
        self._rows: deque[_Row] = deque(maxlen=WINDOW)

    def add(self, state: "EgmState") -> None:
        """Take a state; one without guidance begins anew."""
        if not state.guided or (self._rows and state.controller_time < self._rows[-1][0]):
            self._rows.clear()
        if not state.guided:
            return
        row: _Row
        if state.reference_pose is not None and state.pose is not None:
            row = (state.controller_time, state.reference_pose[0], state.pose[0])
        else:
            row = (state.controller_time, state.reference, state.joints)
        if self._rows and len(self._rows[-1][1]) != len(row[1]):
            self._rows.clear()
        self._rows.append(row)

    def lag(self) -> Lag | None:
        """Return the lag; None: too few states, or the references stood."""
        rows = list(self._rows)
        if len(rows) < _FEWEST:
            return None
        times, references, measured = (
            np.array(part, dtype=float) for part in zip(*rows, strict=True)
        )
        return estimate(times, references, measured)


def estimate(times: Array, references: Array, measured: Array) -> Lag | None:
    """Return the lag of recorded positions.

    Args:
        times: (n,) s on the clock of the controller, increasing.
        references, measured: (n, k) rad or m.

    Returns:
        None: the references stood, or the record is shorter than `MOST` and 0.1 s.
    """
    late = times >= times[0] + MOST
    span = references.max(axis=0) - references.min(axis=0)
    if span.max() < _LEAST or late.sum() < 25:
        return None
    # Axes that stand add nothing.
    moving = span >= _LEAST
    references, measured = references[:, moving], measured[late][:, moving]
    at = times[late]

    def differences(delay: float) -> Array:
        delayed: Array = np.stack(
            [np.interp(at - delay, times, column) for column in references.T], axis=1
        )
        return np.subtract(measured, delayed)

    delays = np.arange(0.0, MOST + _STEP / 2, _STEP)
    errors = np.array([np.square(differences(delay)).sum() for delay in delays])
    best = int(errors.argmin())
    delay = float(delays[best])
    if 0 < best < len(delays) - 1:
        # The lowest point of the parabola through three delays.
        before, lowest, after = errors[best - 1 : best + 2]
        curve = before - 2 * lowest + after
        if curve > 0:
            delay += float(0.5 * (before - after) / curve) * _STEP
    worst = np.abs(differences(delay)).max(axis=1)
    return Lag(delay, float(np.percentile(worst, 99)))
