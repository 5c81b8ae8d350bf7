"""A trajectory against a robot: every fault at once, before a byte is sent.

The result is a CheckedTrajectory, for one that is there as a whole, or CheckedPoints of one that
comes in pieces: the axis values and durations that go onto the wire.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
import numpy.typing as npt

from rapidgen.axes.limits import ROUNDING
from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidTrajectory
from rapidgen.client.trajectory import Array, Trajectory
from rapidgen.diagnostics import Diagnostic, Severity, Span, error, suggest
from rapidgen.wire.simple_message.spec import PAIR_LIMIT, PAIR_SCALE

Way = Literal["download", "stream"]
"""download: sent whole before anything moves; stream: sent while the robot moves."""
_SPEED_ROUNDING = 1 + 1e-4
"""float32 positions and durations may ask for this much more than was meant."""
_TIME_ROUNDING = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class CheckedTrajectory:
    """What is sent: `wire` (m, k) axis values and `durations` (m,) s, m >= 2.

    A single point is there twice, as simple_message wants it.
    """

    trajectory: Trajectory
    wire: Array
    durations: Array
    warnings: tuple[Diagnostic, ...]
    way: ClassVar[Way] = "download"

    @property
    def total(self) -> float:
        """Seconds that the controller is asked to take."""
        return float(self.durations.sum())


@dataclass(frozen=True, slots=True, eq=False)
class LastPoint:
    """What the next points go on from: how many there were; time s and axis values (k,)."""

    points: int
    time: float
    wire: Array


@dataclass(frozen=True, slots=True, eq=False)
class CheckedPoints:
    """Points of a stream: `wire` (n, k) axis values and `durations` (n,) s, on the steps of 1e-6
    that the wire has, inside the limits."""

    trajectory: Trajectory
    wire: Array
    durations: Array
    last: LastPoint
    warnings: tuple[Diagnostic, ...]
    way: ClassVar[Way] = "stream"


def check_trajectory(
    trajectory: Trajectory,
    group: Group,
    *,
    start: Sequence[float] | None = None,
    capacity: int | None = None,
    goes_to_single: bool = False,
) -> CheckedTrajectory:
    """Check everything; `start` are the ten axis values of where the robot stands.

    A single point without a time of its own is taken only where the driver goes to such a
    point at approach speed (`goes_to_single`: a rapidgen driver does).
    Raises InvalidTrajectory with all faults.
    """
    limit = group.policy.capacity if capacity is None else capacity
    ordered = _fitting(trajectory, group, _capacity(trajectory, limit))
    times = ordered.times
    first = float(times[0]) if times[0] > 0 else group.policy.min_segment
    with np.errstate(invalid="ignore", over="ignore"):
        wire = group.to_wire(ordered.positions)
        durations = np.concatenate([[first], np.diff(times)])
        found = _content(ordered, group, wire, durations, start, None)
        if len(wire) > 1 or not (times[0] > 0 or goes_to_single):
            found += _start(ordered, group, wire, start)
    if len(wire) == 1:
        wire = np.repeat(wire, 2, axis=0)
        # A rapidgen driver goes by the second frame's duration, abb_driver takes both.
        durations = np.array([first, first if goes_to_single else group.policy.min_segment])
    _raise_errors(found)
    return CheckedTrajectory(ordered, wire, durations, tuple(found))


def check_points(
    trajectory: Trajectory, group: Group, *, before: LastPoint | None, start: Sequence[float] | None
) -> CheckedPoints:
    """Check points that go on from `before`; without one they are the first of a stream, and
    the robot stands at `start` (ten axis values). Times count from the stream's beginning.

    Raises InvalidTrajectory with all faults; points have their numbers in the stream.
    """
    ordered = _fitting(trajectory, group, [])
    times = ordered.times
    first = float(times[0]) if times[0] > 0 else group.policy.min_segment
    since = times[0] - first if before is None else before.time
    with np.errstate(invalid="ignore", over="ignore"):
        wire = group.to_wire(ordered.positions)
        durations = np.diff(times, prepend=since)
        found = _content(ordered, group, wire, durations, start, before)
        if before is None:
            found += _start(ordered, group, wire, start)
        found += _fits(ordered, wire, durations, before)
    _raise_errors(found)
    points = len(ordered) + (before.points if before else 0)
    return _points(ordered, group, wire, durations, since, points, tuple(found))


def to_stream(
    checked: CheckedTrajectory, group: Group, capacity: int
) -> CheckedTrajectory | CheckedPoints:
    """The same as points of a stream, where the wire's pairs can hold every value of it.

    Raises InvalidTrajectory where they cannot and a driver holds no more than `capacity` points.
    """
    ordered, durations = checked.trajectory, checked.durations
    if max(np.abs(checked.wire).max(), durations.max()) > PAIR_LIMIT:
        _raise_errors(_capacity(ordered, capacity))
        return checked
    since = ordered.times[0] - durations[0]
    return _points(ordered, group, checked.wire, durations, since, len(ordered), checked.warnings)


def _points(
    ordered: Trajectory,
    group: Group,
    wire: Array,
    durations: Array,
    since: float,
    points: int,
    warnings: tuple[Diagnostic, ...],
) -> CheckedPoints:
    times = ordered.times
    # Times are put on the grid, not durations: nothing adds up over a long stream.
    steps = np.diff(np.rint(times * PAIR_SCALE), prepend=np.rint(since * PAIR_SCALE))
    least = np.rint(np.minimum(durations, group.policy.min_segment) * PAIR_SCALE)
    wire = on_the_grid(wire, group)
    last = LastPoint(points, float(times[-1]), wire[-1])
    return CheckedPoints(ordered, wire, np.maximum(steps, least) / PAIR_SCALE, last, warnings)


def on_the_grid(wire: Array, group: Group) -> Array:
    """Axis values (n, k) in steps of the wire's pairs, none of them outside the limits."""
    with np.errstate(invalid="ignore"):
        low = np.ceil(np.array([joint.lower for joint in group.joints]) * PAIR_SCALE)
        high = np.floor(np.array([joint.upper for joint in group.joints]) * PAIR_SCALE)
    steps: Array = np.clip(np.rint(wire * PAIR_SCALE), low, high) / PAIR_SCALE
    return steps


def _fitting(trajectory: Trajectory, group: Group, found: list[Diagnostic]) -> Trajectory:
    """The trajectory with the robot's columns: without them nothing else can be asked."""
    found = found + _names(trajectory, group)
    if not len(trajectory):
        found.append(_finding("RG619", "the trajectory has no points", "give at least one point"))
    if found:
        raise InvalidTrajectory(found, exit_code=1)
    return trajectory.reordered(group.names)


def _content(
    ordered: Trajectory,
    group: Group,
    wire: Array,
    durations: Array,
    start: Sequence[float] | None,
    before: LastPoint | None,
) -> list[Diagnostic]:
    """What is the same of a whole trajectory and of a piece."""
    origin = before.points if before else 0
    whole = np.isfinite(ordered.positions).all(axis=1) & np.isfinite(ordered.times)
    return [
        *_finite(ordered, group, origin),
        *_times(ordered, before),
        *_limits(ordered, group, wire, whole, origin),
        *_speeds(ordered, group, wire, durations, start, before),
        *_short(ordered, group, durations, origin),
    ]


def _raise_errors(found: list[Diagnostic]) -> None:
    if any(d.severity is Severity.ERROR for d in found):
        raise InvalidTrajectory(found, exit_code=1)


def _finding(
    code: str,
    message: str,
    help: str = "",
    *notes: str,
    at: tuple[Trajectory, int] | None = None,
    severity: Severity = Severity.ERROR,
) -> Diagnostic:
    span = None
    if at is not None and at[0].path and at[0].lines:
        span = Span(at[0].path, at[0].lines[at[1]], 1)
    return error(code, span, message, help, notes=notes, severity=severity)


def _capacity(trajectory: Trajectory, capacity: int) -> list[Diagnostic]:
    count = len(trajectory)
    if count <= capacity:
        return []
    return [
        _finding(
            "RG617",
            f"{count} points, the driver holds {capacity}",
            "`Trajectory.resampled(period)` or `rapidgen move --resample PERIOD` makes fewer; "
            "`trajectory.capacity` in the configuration makes room for more (build and deploy "
            "again)",
        )
    ]


def _names(trajectory: Trajectory, group: Group) -> list[Diagnostic]:
    names, own = trajectory.names, group.names
    if not names:
        columns = trajectory.positions.shape[1]
        if columns == len(own):
            return []
        return [
            _finding(
                "RG611",
                f"{columns} joints, the robot has {len(own)}",
                f"the robot's joints are: {', '.join(own)}",
            )
        ]
    found = [
        _finding("RG611", f"joint '{name}' is there twice")
        for name in sorted({name for name in names if names.count(name) > 1})
    ]
    found += [
        _finding(
            "RG611",
            f"the robot has no joint '{name}'",
            suggest(name, own) or f"the robot's joints are: {', '.join(own)}",
        )
        for name in names
        if name not in own
    ]
    missing = [name for name in own if name not in names]
    if missing:
        found.append(_finding("RG611", f"joints are missing: {', '.join(missing)}"))
    return found


def _finite(trajectory: Trajectory, group: Group, origin: int) -> list[Diagnostic]:
    found = []
    bad = ~np.isfinite(trajectory.positions)
    for column in np.flatnonzero(bad.any(axis=0)).tolist():
        points = np.flatnonzero(bad[:, column])
        value = trajectory.positions[points[0], column]
        found.append(
            _finding(
                "RG613",
                f"{group.names[column]} is {value} at {_named(points, origin)}",
                at=(trajectory, int(points[0])),
            )
        )
    return found


def _times(trajectory: Trajectory, before: LastPoint | None) -> list[Diagnostic]:
    times = trajectory.times
    origin = before.points if before else 0
    if not np.isfinite(times).all():
        points = np.flatnonzero(~np.isfinite(times))
        return [
            _finding(
                "RG613",
                f"the time is {times[points[0]]} at {_named(points, origin)}",
                at=(trajectory, int(points[0])),
            )
        ]
    found = []
    if before is None and times[0] < 0:
        found.append(
            _finding("RG612", f"the first time is {times[0]:g} s", "times count from the start")
        )
    late = np.flatnonzero(np.diff(times) <= 0) + 1
    if before is not None and times[0] <= before.time:
        late = np.concatenate([[0], late])
    if len(late):
        found.append(
            _finding(
                "RG612",
                f"the time does not increase at {_named(late, origin)}",
                "each point needs a later time than the one before",
                at=(trajectory, int(late[0])),
            )
        )
    return found


def _limits(
    trajectory: Trajectory,
    group: Group,
    wire: Array,
    whole: npt.NDArray[np.bool_],
    origin: int,
) -> list[Diagnostic]:
    found = []
    for column, joint in enumerate(group.joints):
        values = wire[:, column]
        inside = (joint.lower - ROUNDING <= values) & (values <= joint.upper + ROUNDING)
        points = np.flatnonzero(~inside & whole)
        if not len(points):
            continue
        unit = "rad" if joint.kind == "revolute" else "m"
        coupled = joint.axis == "rax_3" and bool(group.map.coupling)
        notes = ("axis 3 is coupled: its limits are those of joint 3 and 2 together",)
        worst = int(points[np.argmax(np.abs(values[points] - (joint.lower + joint.upper) / 2))])
        found.append(
            _finding(
                "RG614",
                f"{joint.name} is outside its limits at {_named(points, origin)}",
                f"{joint.axis} has {joint.lower:.4f} to {joint.upper:.4f} {unit}; "
                f"point {worst + origin} has {values[worst]:.4f} {unit}",
                *(notes if coupled else ()),
                at=(trajectory, int(points[0])),
            )
        )
    return found


def _speeds(
    trajectory: Trajectory,
    group: Group,
    wire: Array,
    durations: Array,
    start: Sequence[float] | None,
    before: LastPoint | None,
) -> list[Diagnostic]:
    """Segment speeds; the approach to a first point with a time of its own counts as one."""
    if before is not None:
        came_from = before.wire[None]
    else:
        came_from = wire[:1] if start is None else np.array([start[: wire.shape[1]]])
    steps = np.abs(np.diff(np.concatenate([came_from, wire]), axis=0))
    rates = np.divide(
        steps, durations[:, None], out=np.zeros_like(steps), where=durations[:, None] > 0
    )
    if before is None and trajectory.times[0] <= 0:
        rates[0] = 0.0
    origin = before.points if before else 0
    found = []
    for column, joint in enumerate(group.joints):
        points = np.flatnonzero(rates[:, column] > joint.speed * _SPEED_ROUNDING)
        if not len(points):
            continue
        worst = float(rates[points, column].max())
        unit = "rad/s" if joint.kind == "revolute" else "m/s"
        found.append(
            _finding(
                "RG615",
                f"{joint.name} is too fast on the way to {_named(points, origin)}",
                f"it needs {worst:.3f} {unit}, {joint.axis} has {joint.speed:.3f}; "
                f"`scaled({joint.speed / worst:.2f})` would fit",
                at=(trajectory, int(points[0])),
            )
        )
    return found


def _start(
    trajectory: Trajectory, group: Group, wire: Array, start: Sequence[float] | None
) -> list[Diagnostic]:
    if start is None:
        return []
    away = np.abs(wire[0] - np.array(start[: wire.shape[1]]))
    columns = np.flatnonzero(away > group.start_tolerance + ROUNDING).tolist()
    if not columns:
        return []
    rows = []
    for column in columns:
        joint, tolerance = group.joints[column], group.start_tolerance[column]
        unit = "rad" if joint.kind == "revolute" else "m"
        rows.append(
            f"{joint.name}: the robot's axis stands at {start[column]:.4f} {unit}, the first "
            f"point is {wire[0, column]:.4f}, tolerance {tolerance:.4f}"
        )
    return [
        _finding(
            "RG616",
            "the trajectory does not start where the robot stands",
            "go there first: `trajectory.starting_at(robot.state, seconds)`, or "
            "`rapidgen move --approach SECONDS`",
            *rows,
            at=(trajectory, 0),
        )
    ]


def _short(trajectory: Trajectory, group: Group, durations: Array, origin: int) -> list[Diagnostic]:
    least = group.policy.min_segment
    points = np.flatnonzero((durations < least - _TIME_ROUNDING) & (durations > 0))
    if not len(points):
        return []
    return [
        _finding(
            "RG618",
            f"shorter than the path planner follows: the segment to {_named(points, origin)}",
            f"{durations[points].min():.4f} s, at least {least:g} s: "
            f"`Trajectory.resampled({least:g})`, or `rapidgen move --resample {least:g}`",
            at=(trajectory, int(points[0])),
            severity=Severity.ERROR if group.has_limits else Severity.WARNING,
        )
    ]


def _fits(
    trajectory: Trajectory, wire: Array, durations: Array, before: LastPoint | None
) -> list[Diagnostic]:
    values = np.concatenate([wire, durations[:, None]], axis=1)
    points = np.flatnonzero((np.abs(values) > PAIR_LIMIT).any(axis=1))
    if not len(points):
        return []
    origin = before.points if before else 0
    return [
        _finding(
            "RG623",
            f"a value is too large for a stream at {_named(points, origin)}",
            f"{PAIR_LIMIT:.2f} s, rad or m are the most: "
            "`Trajectory.resampled(10)` divides a long segment",
            at=(trajectory, int(points[0])),
        )
    ]


def _named(points: npt.NDArray[np.intp], origin: int = 0) -> str:
    first = points[0] + origin
    return f"point {first}" if len(points) == 1 else f"point {first} and {len(points) - 1} more"
