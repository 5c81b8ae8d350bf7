"""Data of a plot: charts of curves over one time, in degrees and mm."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from rapidgen.client.core.group import Group
from rapidgen.client.recording import JointRecording
from rapidgen.client.trajectory import Array, Trajectory
from rapidgen.motion.recorder import Recording

if TYPE_CHECKING:
    import numpy.typing as npt

Plottable = Trajectory | JointRecording | Recording
SPEED = "TCP speed"
_MOST = 600
"""Points of a joint's curve.

More are reduced to the minimum and maximum of each piece.
"""
_SEARCHED = 0.5
"""s around the acceptance of a motion within which its start is searched."""
_NEAR = 0.5
"""A limit is drawn within this share of the curves' height from them."""
_STILL = 1e-7
"""rad or m between two samples below which a joint stands."""
_STANDING = 0.01
"""mm/s below which the TCP stands."""
_LEAST_GAP = 0.1
"""s that are left of a standstill, at least."""
_MOST_POINTS, _MOST_NOTES = 4000, 400
_FLAT = 1.0
"""deg, mm: variations of a joint at rest below this are noise."""


@dataclass(frozen=True, slots=True)
class JointCurves:
    """Joints over time, of one origin.

    `times` (n,) s, `positions` (n, k) rad or m.
    """

    label: str
    names: tuple[str, ...]
    times: Array
    positions: Array

    def column(self, name: str) -> Array | None:
        """Return the values of a joint; None if there are none."""
        if name not in self.names or not len(self.times):
            return None
        values: Array = self.positions[:, self.names.index(name)]
        return values


@dataclass(frozen=True, slots=True)
class Curve:
    """`times` (n,) s rising, `values` (n,) in the unit of its chart."""

    label: str
    times: Array
    values: Array
    is_limit: bool = False


@dataclass(frozen=True, slots=True)
class Note:
    """A mark at a time of a chart."""

    time: float
    text: str
    kind: Literal["stop", "late", "event"]


@dataclass(frozen=True, slots=True)
class Chart:
    """Curves of one unit."""

    title: str
    unit: str
    curves: tuple[Curve, ...]
    least_height: float = 0.0
    """Smallest height of a chart, so that noise is not enlarged."""
    spans: tuple[tuple[float, float], ...] = ()
    """Times that are shaded: corners."""
    notes: tuple[Note, ...] = ()

    @property
    def heading(self) -> str:
        """Title with unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title


@dataclass(frozen=True, slots=True)
class PathView:
    """The path of the TCP, seen along one axis of the world: mm."""

    horizontal: str
    vertical: str
    points: Array
    """(n, 2)"""
    corners: tuple[tuple[int, int], ...] = ()
    """First and last point of each corner."""
    stops: Array = field(default_factory=lambda: np.zeros((0, 2)))
    """(k, 2) points at which the robot stands."""


@dataclass(frozen=True, slots=True)
class Cut:
    """A standstill of which only a part is displayed."""

    begin: float
    end: float
    """s of the part that is left out."""


class TimeAxis:
    """Displayed times: those of the data without the cuts."""

    def __init__(self, cuts: Sequence[Cut]) -> None:
        self.cuts = tuple(cuts)

    def displayed(self, times: Array) -> Array:
        """Return displayed times of times of the data."""
        result = np.array(times, dtype=np.float64)
        for cut in self.cuts:
            result -= np.clip(times - cut.begin, 0.0, cut.end - cut.begin)
        return result

    def displayed_one(self, time: float) -> float:
        """Return the displayed time of a time of the data."""
        return float(self.displayed(np.array(time)))

    @property
    def breaks(self) -> list[tuple[float, float]]:
        """Displayed times of the cuts, and the seconds that each leaves out."""
        places = self.displayed(np.array([cut.begin for cut in self.cuts]))
        return [(float(at), cut.end - cut.begin) for at, cut in zip(places, self.cuts, strict=True)]

    def real(self, displayed: float) -> float:
        """Return the time of the data."""
        return displayed + sum(length for at, length in self.breaks if at < displayed)


def idle_cuts(layers: "Sequence[JointCurves]") -> list[Cut]:
    """Return the cuts of standstills that are long compared with the movement.

    A standstill of all layers longer than a quarter of the movement, and than 1 s, keeps a
    twentieth of the movement, half of it on each side.
    """
    moving = _merged(
        [
            (float(layer.times[first]), float(layer.times[last]))
            for layer in layers
            for first, last in _runs(_moves(layer))
        ]
    )
    total = sum(high - low for low, high in moving)
    if not total:
        return []
    ends = [float(layer.times[k]) for layer in layers if len(layer.times) for k in (0, -1)]
    edges = [min(ends), *(time for pair in moving for time in pair), max(ends)]
    keep, cuts = max(_LEAST_GAP, total / 20), []
    for low, high in zip(edges[::2], edges[1::2], strict=True):
        if high - low > max(1.0, total / 4, 2 * keep):
            # Before the first movement only its end is left, behind the last one its beginning.
            left = 0.0 if low == edges[0] else keep / 2
            right = 0.0 if high == edges[-1] else keep / 2
            cuts.append(Cut(low + left, high - right))
    return cuts


def _moves(layer: "JointCurves") -> "npt.NDArray[np.bool_]":
    """Return whether any joint moves between two samples, (n - 1,)."""
    steps = np.max(np.abs(np.diff(layer.positions, axis=0)), axis=1, initial=0.0)
    result: npt.NDArray[np.bool_] = np.asarray(steps > _STILL, dtype=bool)
    return result


def _runs(flags: "npt.NDArray[np.bool_]") -> list[tuple[int, int]]:
    """Return first and last index + 1 of each run of true flags."""
    padded = np.concatenate([[False], flags, [False]]).astype(int)
    edges = np.flatnonzero(np.diff(padded)).reshape(-1, 2)
    return [(int(a), int(b)) for a, b in edges]


def _merged(spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
    result: list[tuple[float, float]] = []
    for low, high in sorted(spans):
        if result and low <= result[-1][1]:
            before = result.pop()
            low, high = before[0], max(high, before[1])
        result.append((low, high))
    return result


def layers_of(displayed: Sequence[Plottable], labels: Sequence[str]) -> list[JointCurves]:
    """Return layers over one time.

    A trajectory shown with a recording of a robot begins when the controller accepted it. If the
    recording has the controller's own time, which no clock of this machine knows exactly, it begins
    where the executed motion fits it best.
    """
    in_use: list[float] = []
    executed: JointCurves | None = None
    result: list[JointCurves] = []
    for thing in displayed:
        if isinstance(thing, JointRecording):
            in_use, executed = list(thing.begins), _joint_curves(thing.trajectory(), "executed")
            result.append(executed)
        elif isinstance(thing, Recording):
            result += _of_simulation(thing)
        else:
            result.append(_joint_curves(thing, "commanded" if len(displayed) > 1 else "joints"))
    begins = iter(in_use)
    fits = any(isinstance(thing, JointRecording) and thing.by_controller for thing in displayed)
    for index, layer in enumerate(result):
        if layer is executed or not in_use or not len(layer.times):
            continue
        begin = next(begins, in_use[-1])
        moved = replace(layer, times=layer.times + begin)
        if fits and executed is not None:
            moved = replace(moved, times=moved.times + _late(moved, executed))
        result[index] = moved
    named = [*labels, *(layer.label for layer in result[len(labels) :])]
    return _distinct_labels(
        [replace(f, label=label) for f, label in zip(result, named, strict=False)]
    )


def _joint_curves(trajectory: Trajectory, label: str) -> JointCurves:
    count = trajectory.positions.shape[1]
    names = trajectory.names or tuple(f"joint_{i + 1}" for i in range(count))
    return JointCurves(label, names, trajectory.times, trajectory.positions)


def _of_simulation(recording: Recording) -> Iterator[JointCurves]:
    """Return joints and the tool; measured joints only where they differ."""
    times = recording.time - recording.time[:1]
    columns, names = [recording.commanded], [*recording.joints]
    if recording.tcp is not None:
        columns.append(recording.tcp[:, :3])
        names += ["x", "y", "z"]
    yield JointCurves("commanded", tuple(names), times, np.hstack(columns))
    if not np.array_equal(recording.commanded, recording.actual):
        yield JointCurves("measured", recording.joints, times, recording.actual)


def motion_charts(recording: Recording) -> tuple[list[Chart], list[PathView]]:
    """Return the TCP speed with corners and events, and the path of the TCP."""
    if recording.tcp is None or len(recording.time) < 2:
        return [], []
    times = recording.time - recording.time[0]
    steps = np.linalg.norm(np.diff(recording.tcp[:, :3], axis=0), axis=1) * 1000
    speeds = steps / np.diff(times)
    # The speed between two samples belongs to the time between them.
    middles = np.concatenate([times[:1], (times[:-1] + times[1:]) / 2, times[-1:]])
    values = np.concatenate([[0.0], speeds, [0.0]])
    corner = np.array(recording.corner, dtype=bool)
    runs = _runs(corner) if len(corner) == len(times) else []
    spans = tuple((float(times[a]), float(times[min(b, len(times) - 1)])) for a, b in runs)
    notes = tuple(
        Note(mark.time - float(recording.time[0]), mark.text, mark.kind) for mark in recording.marks
    )
    curve = Curve("commanded", *_finite(middles, values))
    chart = Chart(SPEED, "mm/s", (curve,), _FLAT, spans, notes if len(notes) <= _MOST_NOTES else ())
    still = np.concatenate([[True], speeds < _STANDING, [True]])
    stops = recording.tcp[still[:-1] | still[1:], :3] * 1000
    views = []
    reach = np.ptp(recording.tcp[:, :2], axis=0)
    for first, second in (("x", "y"), ("x" if reach[0] >= reach[1] else "y", "z")):
        pair = ["xyz".index(first), "xyz".index(second)]
        where, chosen = _thinned(recording.tcp[:, pair] * 1000, runs)
        unique = np.unique(np.round(stops[:, pair], 1), axis=0)
        views.append(PathView(first, second, where, chosen, unique))
    return [chart], views


def _thinned(
    points: Array, runs: list[tuple[int, int]]
) -> tuple[Array, tuple[tuple[int, int], ...]]:
    """Return at most about _MOST_POINTS points, with the corners among them."""
    step = max(1, len(points) // _MOST_POINTS)
    keep = sorted(
        {*range(0, len(points), step), len(points) - 1, *(e for run in runs for e in run)}
    )
    keep = [k for k in keep if k < len(points)]
    place = {k: i for i, k in enumerate(keep)}
    corners = tuple((place[a], place[min(b, len(points) - 1)]) for a, b in runs)
    return points[keep], corners


def _distinct_labels(layers: list[JointCurves]) -> list[JointCurves]:
    seen: dict[str, int] = {}
    text = []
    for layer in layers:
        seen[layer.label] = seen.get(layer.label, 0) + 1
        count = seen[layer.label]
        text.append(layer if count == 1 else replace(layer, label=f"{layer.label} {count}"))
    return text


def _late(commanded: JointCurves, executed: JointCurves) -> float:
    """Return the s by which `commanded` fits `executed` best."""
    names = [name for name in commanded.names if name in executed.names]
    late = np.arange(-_SEARCHED, _SEARCHED, 0.005)
    misses = np.zeros(len(late))
    for name in names:
        requested, done = commanded.column(name), executed.column(name)
        if requested is None or done is None:
            continue
        for i, shift in enumerate(late):
            at = np.interp(commanded.times + shift, executed.times, done)
            misses[i] += float(np.square(at - requested).sum())
    return float(late[int(np.argmin(misses))]) if np.ptp(misses) > 0 else 0.0


def charts_of(
    layers: Sequence[JointCurves], group: Group | None, linear: Sequence[str]
) -> list[Chart]:
    """Return a chart for each joint, then differences of common joints.

    Limits are drawn if a group has them. A difference is the second layer minus the first.
    """
    metres = {"x", "y", "z", *linear}
    if group is not None:
        metres |= {joint.name for joint in group.joints if joint.kind == "prismatic"}
    limits = joint_limits(group) if group is not None else {}
    names = list(dict.fromkeys(name for layer in layers for name in layer.names))
    charts = []
    for name in names:
        unit, factor = _unit(name, metres)
        curves = []
        for layer in layers:
            values = layer.column(name)
            if values is not None:
                curves.append(Curve(layer.label, *_finite(layer.times, values * factor)))
        if name in limits:
            curves += _near_limits(curves, [limit * factor for limit in limits[name]])
        charts.append(Chart(name, unit, tuple(curves), _FLAT))
    return charts + list(_differences(layers, metres))


def joint_limits(group: Group) -> dict[str, tuple[float, float]]:
    """Return limits of joints (rad, m) with an independent axis, by name."""
    joints = group.joints
    low = group.map.to_urdf([joint.lower for joint in joints])
    high = group.map.to_urdf([joint.upper for joint in joints])
    pairs = zip(group.names, low, high, strict=True)
    bounds = {name: (min(pair), max(pair)) for name, *pair in pairs}
    coupled = {joint.name for joint in joints if joint.axis == "rax_3" and group.map.coupling}
    return {
        name: bound
        for name, bound in bounds.items()
        if name not in coupled and np.isfinite(bound).all()
    }


def _unit(name: str, metres: set[str]) -> tuple[str, float]:
    return ("mm", 1000.0) if name in metres else ("deg", 180.0 / np.pi)


def _near_limits(curves: Sequence[Curve], limits: Sequence[float]) -> Iterator[Curve]:
    """Return limits near the curves; others would make the curves flat."""
    values = np.concatenate([curve.values for curve in curves]) if curves else np.zeros(0)
    if not len(values):
        return
    least, most = float(values.min()), float(values.max())
    reach = _NEAR * max(most - least, _FLAT)
    times = np.array([min(c.times[0] for c in curves if len(c.times)), 0.0])
    times[1] = max(c.times[-1] for c in curves if len(c.times))
    for side, limit in zip(("least", "most"), limits, strict=True):
        if least - reach <= limit <= most + reach:
            yield Curve(f"{side} {limit:.1f}", times, np.full(2, limit), is_limit=True)


def _differences(layers: Sequence[JointCurves], metres: set[str]) -> Iterator[Chart]:
    if len(layers) < 2:
        return
    requested, done = layers[:2]
    by_unit: dict[str, list[Curve]] = {}
    for name in requested.names:
        first, second = requested.column(name), done.column(name)
        if first is None or second is None:
            continue
        unit, factor = _unit(name, metres)
        within = (done.times >= requested.times[0]) & (done.times <= requested.times[-1])
        times = done.times[within]
        values = (second[within] - np.interp(times, requested.times, first)) * factor
        by_unit.setdefault(unit, []).append(Curve(name, *_finite(times, values)))
    for unit, curves in by_unit.items():
        yield Chart(f"{done.label} minus {requested.label}", unit, tuple(curves))


def _finite(times: Array, values: Array) -> tuple[Array, Array]:
    """Return about _MOST finite points that draw the same curve.

    Extremes are kept.
    """
    sound = np.isfinite(times) & np.isfinite(values)
    times, values = times[sound], values[sound]
    if len(times) <= _MOST:
        return times, values
    keep = {0, len(times) - 1}
    edges = np.linspace(0, len(times), _MOST // 2 + 1).astype(int)
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        piece = values[start:end]
        keep |= {start + int(np.argmin(piece)), start + int(np.argmax(piece))}
    chosen = np.array(sorted(keep))
    return times[chosen], values[chosen]
