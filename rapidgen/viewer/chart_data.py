"""Data of a plot: charts of curves over one time, in degrees and mm."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rapidgen.client.core.group import Group
from rapidgen.client.recording import JointRecording
from rapidgen.client.trajectory import Array, Trajectory
from rapidgen.motion.recorder import Recording

Plottable = Trajectory | JointRecording | Recording
MOVES = "moves reached (program) and active (robot)"
_MOST = 600
"""Points of a joint's curve.

More are reduced to the minimum and maximum of each piece.
"""
_SEARCHED = 0.5
"""s around the acceptance of a motion within which its start is searched."""
_NEAR = 0.5
"""A limit is drawn within this share of the curves' height from them."""
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
class Chart:
    """Curves of one unit."""

    title: str
    unit: str
    curves: tuple[Curve, ...]
    least_height: float = 0.0
    """Smallest height of a chart, so that noise is not enlarged."""

    @property
    def heading(self) -> str:
        """Title with unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title


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
    """Return joints, the tool, and the active moves of program and robot."""
    times = recording.time - recording.time[:1]
    order = _order(recording)
    for label, joints, moves in (
        ("commanded", recording.commanded, recording.program_pointer),
        ("actual", recording.actual, recording.motion_pointer),
    ):
        columns = [joints, np.array([[order[move]] for move in moves], dtype=np.float64)]
        names = [*recording.joints, MOVES]
        if label == "commanded" and recording.tcp is not None:
            columns.append(recording.tcp[:, :3])
            names += ["x", "y", "z"]
        yield JointCurves(label, tuple(names), times, np.hstack(columns))


def _order(recording: Recording) -> dict[str, int]:
    """Order moves by the time at which they were reached.

    One that the program reached and left between two samples follows the one that the robot had
    executed before it.
    """
    reached = list(dict.fromkeys(recording.program_pointer))
    known = set(reached)
    before = ""
    for move in recording.motion_pointer:
        if move not in known:
            known.add(move)
            reached.insert(reached.index(before) + 1 if before in known else 0, move)
        before = move
    return {move: number for number, move in enumerate(reached)}


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
    if name == MOVES:
        return "", 1.0
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
        if first is None or second is None or name == MOVES:
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
