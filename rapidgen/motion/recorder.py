"""Recording motion: commanded and measured axes, TCP and pointers, sampled when asked for.

While it runs a recorder only keeps each new motion (a few a move); samples are computed from
the formulas afterwards, at any period.
"""

import csv
import io
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from rapidgen._reading import open_foreign, read_foreign
from rapidgen.axes import frames
from rapidgen.axes.kinematics import Posture
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import Move, Place
from rapidgen.motion.path_events import times_of_events

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

_ACTUAL = "actual_"
_TCP = ["x", "y", "z", "q1", "q2", "q3", "q4"]
_POINTERS = ["program_pointer", "motion_pointer"]
_LARGEST_HEADER = 100_000
_LARGEST = 500_000_000
"""Bytes of a table: more than an hour of a motion."""
PERIOD = 0.004
"""s between samples: that of the controller's own motion interface."""


@dataclass(frozen=True, slots=True)
class Mark:
    """Something that happens at a time of a recording, s from the controller's start."""

    time: float
    text: str
    """Location in the program."""
    kind: Literal["stop", "late", "event"]
    """A stop point; a corner that became a stop (50024); an event of TriggIO and its relatives."""


@dataclass(frozen=True, slots=True)
class Recording:
    """Samples of one group. Rows are samples; units rad and m, s from the controller's start."""

    joints: tuple[str, ...]
    time: "npt.NDArray[np.float64]"
    commanded: "npt.NDArray[np.float64]"
    actual: "npt.NDArray[np.float64]"
    tcp: "npt.NDArray[np.float64] | None"
    """x y z q1 q2 q3 q4 of the commanded TCP in the world; None without geometry."""
    program_pointer: tuple[str, ...]
    """The move instruction that the program had reached, empty before the first."""
    motion_pointer: tuple[str, ...]
    """The move instruction that the robot was executing."""
    corner: tuple[bool, ...] = ()
    """Whether the robot was in the corner of a fly-by point; empty if that is not known."""
    marks: tuple[Mark, ...] = ()

    def write_csv(self, path: Path | str) -> None:
        """One row a sample, with a header; `read_recording` and `rapidgen plot` read it."""
        header = ["time", *self.joints, *(f"{_ACTUAL}{name}" for name in self.joints)]
        if self.tcp is not None:
            header += _TCP
        header += _POINTERS
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(header)
            for i, time in enumerate(self.time):
                row = [f"{time:.6f}", *_digits(self.commanded[i]), *_digits(self.actual[i])]
                if self.tcp is not None:
                    row += _digits(self.tcp[i])
                writer.writerow([*row, self.program_pointer[i], self.motion_pointer[i]])


def is_recording(path: Path) -> bool:
    """Whether a file begins as `Recording.write_csv` does. Raises OSError."""
    with open_foreign(path) as file:
        header = file.readline(_LARGEST_HEADER).rstrip(b"\r\n")
    return header.endswith(("," + ",".join(_POINTERS)).encode())


def read_recording(path: Path) -> Recording:
    """What `Recording.write_csv` wrote. OSError; ValueError: something else."""
    import numpy as np  # slow to import, and needed for arrays only

    text = read_foreign(path, _LARGEST).decode()
    try:
        header, *rows = csv.reader(io.StringIO(text, newline=""))
    except csv.Error as fault:
        raise ValueError(str(fault)) from None
    joints = tuple(n.removeprefix(_ACTUAL) for n in header if n.startswith(_ACTUAL))
    count = len(joints)
    expected = ["time", *joints, *(f"{_ACTUAL}{name}" for name in joints)]
    tcp = header[len(expected) : -2] == _TCP
    if header != [*expected, *(_TCP if tcp else ()), *_POINTERS]:
        raise ValueError("the header is not that of a recording")
    if any(len(row) != len(header) for row in rows):
        raise ValueError("a row has not as many values as the header")
    values = np.array([row[:-2] for row in rows], dtype=np.float64).reshape(len(rows), -1)
    return Recording(
        joints=joints,
        time=values[:, 0],
        commanded=values[:, 1 : 1 + count],
        actual=values[:, 1 + count : 1 + 2 * count],
        tcp=values[:, 1 + 2 * count :] if tcp else None,
        program_pointer=tuple(row[-2] for row in rows),
        motion_pointer=tuple(row[-1] for row in rows),
    )


class Recorder:
    """Watches one group from its making until `stop()`."""

    def __init__(self, scheduler: Scheduler, group: MotionGroup) -> None:
        self._scheduler = scheduler
        self._group = group
        self._start = scheduler.now
        self._end: int | None = None
        self._motions: list[Motion] = [group.motion]
        self._moves: list[tuple[int, Move]] = []
        group.observers.append(self._moved)
        group.listeners.append(self._heard)

    def _moved(self, motion: Motion) -> None:
        self._motions.append(motion)

    def _heard(self, move: Move) -> None:
        self._moves.append((self._scheduler.now, move))

    def stop(self) -> None:
        """End the recording; harmless when it has ended."""
        if self._end is None:
            self._end = self._scheduler.now
            self._group.observers.remove(self._moved)
            self._group.listeners.remove(self._heard)

    def postures(self, times: Sequence[int]) -> list[tuple[Posture, Posture]]:
        """Commanded and actual axes (rad, m) at times (ns) that are not forgotten."""
        lag = round(self._group.settings.servo_lag * S)
        result = []
        for time in times:
            motion = self._at(time)
            late = max(self._start, time - lag)
            actual = self._at(late).posture(late) if lag else motion.posture(time)
            result.append((motion.reference(time), actual))
        return result

    def commanded(self, times: Sequence[int]) -> list[Posture]:
        """Commanded axes (rad, m) at times (ns) that are not forgotten, at half the cost."""
        return [self._at(time).reference(time) for time in times]

    def forget(self, before: int) -> None:
        """Drop motions that only concern earlier times."""
        lag = round(self._group.settings.servo_lag * S)
        index = bisect_right(self._motions, before - lag, key=_since) - 1
        del self._motions[: max(0, index)]
        self._moves.clear()

    def moving(self) -> float:
        """Return how long the robot has moved, s."""
        return sum(high - low for low, high in self._intervals()) / S

    def _intervals(self) -> list[tuple[int, int]]:
        """Return intervals of movement, ns."""
        end = self._scheduler.now if self._end is None else self._end
        result: list[tuple[int, int]] = []
        for i, motion in enumerate(self._motions):
            later = self._motions[i + 1].since if i + 1 < len(self._motions) else end
            low, high = max(self._start, motion.since), min(motion.end, later, end)
            if high <= low:
                continue
            if result and result[-1][1] == low:
                low = result.pop()[0]
            result.append((low, high))
        return result

    def _times(self, step: int, standing: bool) -> Sequence[int]:
        end = self._scheduler.now if self._end is None else self._end
        if standing:
            return range(self._start, end + 1, step)
        times = {self._start, end}
        for low, high in self._intervals():
            times.update(range(low, high, step))
            times.add(high)
        return sorted(times)

    def sample_times(self, period: float) -> Sequence[int]:
        """Return times (ns) every `period` s of movement, and the ends of standstills."""
        return self._times(max(1, round(period * S)), standing=False)

    def place(self, time: int) -> Place | None:
        """Return the place of the move that the robot executes at a time (ns)."""
        move = self._at(time).move(time)
        return move.place() if move is not None and move.place is not None else None

    def recording(self, period: float = PERIOD, *, standing: bool = True) -> Recording:
        """Samples every `period` s from the start until now or the end.

        Without `standing`, a standstill has samples at its ends only.
        """
        import numpy as np  # slow to import, and needed for arrays only

        times = self._times(max(1, round(period * S)), standing)
        lag = round(self._group.settings.servo_lag * S)
        motions = [self._at(time) for time in times]
        commanded = [m.reference(t) for m, t in zip(motions, times, strict=True)]
        actual = [m.posture(t) for m, t in zip(motions, times, strict=True)]
        if lag:
            delayed = [max(self._start, t - lag) for t in times]
            actual = [self._at(t).posture(t) for t in delayed]
        moves = [m.move(t) for m, t in zip(motions, times, strict=True)]
        tcp = None
        kinematics = self._group.kinematics
        if kinematics is not None:
            rows = []
            # Without a move under way there is no tool: use that of the last or first move.
            carrying = next((move for move in moves if move is not None), None)
            for posture, move in zip(commanded, moves, strict=True):
                pose = kinematics.forward(posture)
                carrying = move or carrying
                if carrying is not None and not carrying.carrier.stationary:
                    pose = frames.compose(pose, carrying.carrier.tool)
                rows.append((*pose[0], *pose[1]))
            tcp = np.array(rows, dtype=np.float64)
        starts = [time for time, _ in self._moves]
        pointers = [bisect_right(starts, time) - 1 for time in times]
        return Recording(
            joints=tuple(joint.name for joint in self._group.config.joints),
            time=np.array([t / S for t in times]),
            commanded=np.array(commanded, dtype=np.float64),
            actual=np.array(actual, dtype=np.float64),
            tcp=tcp,
            program_pointer=tuple(_names(self._moves[i][1] if i >= 0 else None for i in pointers)),
            motion_pointer=tuple(_names(moves)),
            corner=tuple(m.in_corner(t) for m, t in zip(motions, times, strict=True)),
            marks=tuple(self._marks()),
        )

    def _marks(self) -> Iterator[Mark]:
        """Iterate over stops and events on the path, each at the motion that reaches it."""
        end = self._scheduler.now if self._end is None else self._end
        for i, motion in enumerate(self._motions):
            later = self._motions[i + 1].since if i + 1 < len(self._motions) else end + 1
            for leg in motion.legs:
                happened: list[tuple[float, Literal["stop", "late", "event"]]] = [
                    (when, "event") for when in times_of_events(leg, motion)
                ]
                if leg.stops and leg.end <= motion.law.place:
                    kind: Literal["stop", "late"] = "stop" if leg.move.zone.fine else "late"
                    happened.append((motion.time_at(leg.end), kind))
                for when, kind_of in happened:
                    if motion.since <= round(when * S) < later:
                        place = leg.move.place
                        yield Mark(when, str(place() or "") if place is not None else "", kind_of)

    def _at(self, time: int) -> Motion:
        index = bisect_right(self._motions, time, key=_since) - 1
        return self._motions[max(0, index)]


def _since(motion: Motion) -> int:
    return motion.since


def _names(moves: Iterable[Move | None]) -> list[str]:
    known: dict[Callable[[], object], str] = {}
    result = []
    for move in moves:
        where = move.place if move is not None else None
        if where is None:
            result.append("")
            continue
        if where not in known:
            known[where] = str(where() or "")
        result.append(known[where])
    return result


def _digits(values: "npt.NDArray[np.float64]") -> list[str]:
    return [f"{value:.9f}" for value in values]
