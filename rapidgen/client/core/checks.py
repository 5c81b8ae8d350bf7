"""Validation of a trajectory against a robot, before a byte is sent.

The rules:

1. The trajectory has at least one point, at most as many as the driver holds, and exactly the
   robot's joints. Its columns are put into the robot's order. The other rules need these columns,
   so a fault here ends the check; otherwise all rules report all faults together.
2. Positions and times are finite, and times increase.
3. Axis values are within the limits. Coupled axes are checked after the conversion to the
   controller's axes.
4. Speeds are within the limits. The move to a first point with a time greater than 0 counts as a
   segment from the robot's position.
5. Segments are at least `min_segment` long: the path planner cannot follow shorter ones.
6. The first point is within `start_tolerance` of the robot's position. A single point with a time,
   or for a driver that approaches it at its own speed, need not be.
7. Values of a stream fit into the wire's fixed-point numbers. Positions are rounded inside the
   limits, and times instead of durations, whose rounding errors would add up.

`check_trajectory` applies them all. Its result, CheckedPoints, holds the axis values and durations
that go onto the wire; nothing after it checks or converts points again.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from rapidgen.axes.limits import ROUNDING
from rapidgen.client.core.group import Group
from rapidgen.client.errors import InvalidTrajectory, NotSupported
from rapidgen.client.program import Program
from rapidgen.client.trajectory import Array, Trajectory
from rapidgen.diagnostics import Diagnostic, Severity, Span, error
from rapidgen.wire.simple_message.spec import FIXED_LIMIT, FIXED_SCALE, LONGEST_SEGMENT

TransferMode = Literal["download", "stream"]
"""`download`: sent before the motion; `stream`: sent during the motion."""
_SPEED_ROUNDING = 1 + 1e-4
"""Relative tolerance of speeds computed from float32 values."""
_TIME_ROUNDING = 1e-6
_NUMBERS = "give each point a time and a value of each joint; leave out incomplete points"


@dataclass(frozen=True, slots=True)
class DriverLimits:
    """Trajectories that a driver accepts."""

    capacity: int
    """Points of one download."""
    ring: int | None = None
    """Points of the ring buffer; None: the driver does not stream."""
    goes_to_single: bool = False
    """True if it approaches a single point without a time at its own speed."""

    def require_streaming(self) -> None:
        """Raise NotSupported if the driver accepts no points during a motion."""
        if self.ring is None:
            raise NotSupported.because(
                "RG624",
                "the driver does not take points while the robot moves",
                "send the trajectory as a whole, or build and deploy a driver that streams",
            )


@dataclass(frozen=True, slots=True, eq=False)
class LastPoint:
    """Last point of a stream, which the next points continue.

    Its number of points so far, time in s and axis values (k,).
    """

    points: int
    time: float
    wire: Array


@dataclass(frozen=True, slots=True, eq=False)
class CheckedPoints:
    """Points to send: `wire` (m, k) axis values and `durations` (m,) s.

    A download has m >= 2: a single point is sent twice, as simple_message requires. The values of a
    stream lie on the wire's grid of 1e-6, inside the limits.
    """

    mode: TransferMode
    trajectory: Trajectory
    wire: Array
    durations: Array
    last: LastPoint
    warnings: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _CheckInput:
    """Input of the checks: axis values (n, k) and durations (n,) s.

    `start` are the ten axis values of the current position, `before` the last point so far.
    """

    ordered: Trajectory
    group: Group
    wire: Array
    durations: Array
    start: Sequence[float] | None
    before: LastPoint | None = None

    @property
    def origin(self) -> int:
        """Number of the first point."""
        return self.before.points if self.before else 0

    def finding(
        self,
        code: str,
        message: str,
        points: npt.NDArray[np.intp],
        figures: str = "",
        help: str = "",
        *notes: str,
    ) -> Diagnostic:
        """Return an error at the first of these points.

        `message` is followed by the points, then by `figures`.
        """
        first, others = points[0] + self.origin, len(points) - 1
        named = f"point {first} and {others} more" if others else f"point {first}"
        report = f"{message} {named}: {figures}" if figures else f"{message} {named}"
        return _finding(code, report, help, *notes, at=(self.ordered, int(points[0])))


def check_trajectory(
    trajectory: Trajectory,
    group: Group,
    limits: DriverLimits | None = None,
    mode: TransferMode | None = None,
    *,
    start: Sequence[float] | None = None,
    before: LastPoint | None = None,
    is_open: bool = False,
) -> CheckedPoints:
    """Check a trajectory that starts at the ten axis values `start`.

    Without a `mode` it is streamed if it exceeds the driver's ring buffer, so that motion need not
    wait for the last point; then a value that is too large for a stream makes it a download.
    `is_open`: more points may follow. Points that continue `before` have their numbers and times in
    its stream. Raises InvalidTrajectory with all faults, NotSupported for a stream to a driver that
    does not stream, ValueError for an unknown mode.
    """
    limits = limits or DriverLimits(group.policy.capacity)
    _require_arguments(trajectory, mode)
    if mode == "stream":
        limits.require_streaming()
    count = len(trajectory.times)
    exceeds_ring = limits.ring is not None and count > limits.ring
    streams = mode == "stream" or (mode is None and exceeds_ring)
    too_many = [_too_many(count, limits.capacity)] if count > limits.capacity else []
    ordered = _in_robot_order(trajectory, group, [] if streams else too_many)
    times = ordered.times
    since = times[0] - group.policy.min_segment if before is None else before.time
    if before is None and times[0] > 0:
        since = 0.0
    with np.errstate(invalid="ignore", over="ignore"):
        wire = group.to_wire(ordered.positions)
        durations = np.diff(times, prepend=since)
        points = _CheckInput(ordered, group, wire, durations, start, before)
        findings = [f for rule in (_finite, _times, _limits, _speeds, _short) for f in rule(points)]
        is_single = len(wire) == 1 and not (streams or is_open)
        if before is None and not (is_single and (times[0] > 0 or limits.goes_to_single)):
            findings += _start(points)
        too_large = _too_large_for_stream(points) if streams else []
    if mode == "stream":
        findings += too_large
    elif too_large:
        streams = False
        findings += too_many
    if any(finding.severity is Severity.ERROR for finding in findings):
        raise InvalidTrajectory(findings, exit_code=1)
    if streams:
        wire, durations = quantised(wire, group), _quantised_durations(points, since)
    last = LastPoint(count + points.origin, float(times[-1]), wire[-1])
    if is_single:
        wire = np.repeat(wire, 2, axis=0)
        # A rapidgen driver uses the second frame's duration, abb_driver uses both.
        least = durations[0] if limits.goes_to_single else group.policy.min_segment
        durations = np.array([durations[0], least])
    chosen: TransferMode = "stream" if streams else "download"
    return CheckedPoints(chosen, ordered, wire, durations, last, tuple(findings))


def _require_arguments(trajectory: object, mode: object) -> None:
    """Raise InvalidTrajectory for another type, ValueError for an unknown mode."""
    require_mode(mode)
    if isinstance(trajectory, Trajectory):
        return
    match trajectory:
        case str() | PathLike():
            help = "a file is read by `Trajectory.from_csv(path)` or `from_json(path)`"
        case Mapping():
            help = "a ROS message as a dict is read by `Trajectory.from_ros(message)`"
        case Program():
            help = "`robot.run(program)` executes a program"
        case _:
            help = "`Trajectory.from_points(points, seconds=1)` makes one of points"
    raise InvalidTrajectory.because(
        "RG611", f"expected a Trajectory, got {type(trajectory).__name__}", help, exit_code=2
    )


def require_mode(value: object) -> None:
    """Raise ValueError for an unknown mode, instead of choosing one."""
    if value is not None and value not in get_args(TransferMode):
        raise ValueError(f"a mode is 'download', 'stream' or None, not {value!r}")


def _quantised_durations(points: _CheckInput, since: float) -> Array:
    """Round the durations to the wire's steps."""
    # Times are rounded, not durations: rounding errors would add up over a long stream.
    times = np.rint(points.ordered.times * FIXED_SCALE)
    steps = np.diff(times, prepend=np.rint(since * FIXED_SCALE))
    # Rounding must not shorten a segment below the minimum that the planner follows.
    minimum = points.group.policy.min_segment
    least = np.rint(np.minimum(points.durations, minimum) * FIXED_SCALE)
    durations: Array = np.maximum(steps, least) / FIXED_SCALE
    return durations


def quantised(wire: Array, group: Group) -> Array:
    """Round axis values (n, k) to the wire's steps, inside the limits."""
    with np.errstate(invalid="ignore"):
        # Rounded inwards: one step beyond a limit would be refused.
        low = np.ceil(np.array([joint.lower for joint in group.joints]) * FIXED_SCALE)
        high = np.floor(np.array([joint.upper for joint in group.joints]) * FIXED_SCALE)
    steps: Array = np.clip(np.rint(wire * FIXED_SCALE), low, high) / FIXED_SCALE
    return steps


def _in_robot_order(trajectory: Trajectory, group: Group, findings: list[Diagnostic]) -> Trajectory:
    """Return the trajectory in the robot's columns; later checks need them."""
    findings = findings + group.name_faults(trajectory.names, trajectory.positions.shape[1])
    if not len(trajectory.times):
        findings.append(
            _finding("RG619", "the trajectory has no points", "give at least one point")
        )
    if findings:
        raise InvalidTrajectory(findings, exit_code=1)
    return trajectory.reordered(group.names)


def _finding(
    code: str,
    message: str,
    help: str = "",
    *notes: str,
    at: tuple[Trajectory, int] | None = None,
) -> Diagnostic:
    span = None
    if at is not None and at[0].path and at[0].lines:
        span = Span(at[0].path, at[0].lines[at[1]], 1)
    return error(code, span, message, help, notes=notes)


def _too_many(count: int, capacity: int) -> Diagnostic:
    return _finding(
        "RG617",
        f"{count} points, the driver holds {capacity}",
        "`Trajectory.resampled(period)` or `rapidgen move --resample PERIOD` makes fewer; "
        "a larger `trajectory.capacity` in the configuration accepts more (build and deploy again)",
    )


def _finite(requested: _CheckInput) -> Iterator[Diagnostic]:
    bad = ~np.isfinite(requested.ordered.positions)
    for column in np.flatnonzero(bad.any(axis=0)).tolist():
        points = np.flatnonzero(bad[:, column])
        value = requested.ordered.positions[points[0], column]
        message = f"{requested.group.names[column]} is {value} at"
        yield requested.finding("RG613", message, points, "", _NUMBERS)


def _times(requested: _CheckInput) -> Iterator[Diagnostic]:
    times, before = requested.ordered.times, requested.before
    unknown = np.flatnonzero(~np.isfinite(times))
    if len(unknown):
        yield requested.finding(
            "RG613", f"the time is {times[unknown[0]]} at", unknown, "", _NUMBERS
        )
        return
    if before is None and times[0] < 0:
        yield _finding("RG612", f"the first time is {times[0]:g} s", "times count from the start")
    late = np.flatnonzero(np.diff(times) <= 0) + 1
    if before is not None and times[0] <= before.time:
        late = np.concatenate([[0], late])
    if len(late):
        first = int(late[0])
        earlier = times[first - 1] if first or before is None else before.time
        figures = f"{times[first]:g} s after {earlier:g} s"
        help = "each point needs a later time than the one before"
        yield requested.finding("RG612", "the time does not increase at", late, figures, help)
    long = np.flatnonzero(requested.durations > LONGEST_SEGMENT)
    if len(long):
        figures = f"{requested.durations[long[0]]:g} s, at most {LONGEST_SEGMENT:g} s"
        help = "times are in s; to wait longer, send two trajectories"
        yield requested.finding("RG612", "too much time before", long, figures, help)


def _limits(requested: _CheckInput) -> Iterator[Diagnostic]:
    ordered = requested.ordered
    complete = np.isfinite(ordered.positions).all(axis=1) & np.isfinite(ordered.times)
    for column, joint in enumerate(requested.group.joints):
        values = requested.wire[:, column]
        inside = (joint.lower - ROUNDING <= values) & (values <= joint.upper + ROUNDING)
        points = np.flatnonzero(~inside & complete)
        if not len(points):
            continue
        unit = "rad" if joint.kind == "revolute" else "m"
        coupled = joint.axis == "rax_3" and bool(requested.group.map.coupling)
        notes = ("axis 3 is coupled: its limits are those of joint 3 and 2 together",)
        worst = int(points[np.argmax(np.abs(values[points] - (joint.lower + joint.upper) / 2))])
        help = "keep the points inside the limits"
        if unit == "rad" and abs(values[worst]) > 2 * np.pi:
            help += "; they are in rad, and this looks like degrees"
        yield requested.finding(
            "RG614",
            f"{joint.name} is outside its limits at",
            points,
            f"{joint.axis} would be at {values[worst]:.4f} {unit} "
            f"(point {worst + requested.origin}), "
            f"and has {joint.lower:.4f} to {joint.upper:.4f} {unit}",
            help,
            *(notes if coupled else ()),
        )


def _speeds(requested: _CheckInput) -> Iterator[Diagnostic]:
    """Check the speeds of all segments.

    The approach to a first point with a time of its own counts as a segment.
    """
    wire, start, before = requested.wire, requested.start, requested.before
    if before is not None:
        came_from = before.wire[None]
    else:
        came_from = wire[:1] if start is None else np.array([start[: wire.shape[1]]])
    steps = np.abs(np.diff(np.concatenate([came_from, wire]), axis=0))
    seconds = requested.durations[:, None]
    rates = np.divide(steps, seconds, out=np.zeros_like(steps), where=seconds > 0)
    if before is None and requested.ordered.times[0] <= 0:
        # This first point is the position of the robot: `_start` checks its distance.
        rates[0] = 0.0
    for column, joint in enumerate(requested.group.joints):
        # A segment from or to a value that is not finite has no speed, and no scale helps.
        fast = rates[:, column] > joint.speed * _SPEED_ROUNDING
        points = np.flatnonzero(fast & np.isfinite(steps[:, column]))
        if not len(points):
            continue
        worst = float(rates[points, column].max())
        unit = "rad/s" if joint.kind == "revolute" else "m/s"
        yield requested.finding(
            "RG615",
            f"{joint.name} is too fast on the segment to",
            points,
            f"{joint.axis} would need {worst:.3f} {unit}, and has {joint.speed:.3f} {unit}",
            f"`scaled({0.99 * joint.speed / worst:.3g})` would fit; in the shell, a `--speed` that "
            "much lower",
        )


def _start(requested: _CheckInput) -> Iterator[Diagnostic]:
    group, wire, start = requested.group, requested.wire, requested.start
    if start is None:
        return
    away = np.abs(wire[0] - np.array(start[: wire.shape[1]]))
    columns = np.flatnonzero(away > group.start_tolerance + ROUNDING).tolist()
    if not columns:
        return
    rows = []
    for column in columns:
        joint, tolerance = group.joints[column], group.start_tolerance[column]
        unit = "rad" if joint.kind == "revolute" else "m"
        rows.append(
            f"{joint.name}: the robot's axis is at {start[column]:.4f} {unit}, the first "
            f"point is {wire[0, column]:.4f}, tolerance {tolerance:.4f}"
        )
    far = max(columns, key=lambda column: away[column] / group.start_tolerance[column])
    others = f", and {len(columns) - 1} more joints" if len(columns) > 1 else ""
    unit = "rad" if group.joints[far].kind == "revolute" else "m"
    yield _finding(
        "RG616",
        "the trajectory does not start at the robot's position: "
        f"{group.names[far]} is {away[far]:.4f} {unit} away, "
        f"{group.start_tolerance[far]:.4f} {unit} is tolerated{others}",
        "go there first: `trajectory.starting_at(robot.state, seconds)`, or "
        "`rapidgen move --approach SECONDS`",
        *rows,
        at=(requested.ordered, 0),
    )


def _short(requested: _CheckInput) -> list[Diagnostic]:
    least, durations = requested.group.policy.min_segment, requested.durations
    points = np.flatnonzero((durations < least - _TIME_ROUNDING) & (durations > 0))
    if not len(points):
        return []
    result = requested.finding(
        "RG618",
        "shorter than the path planner follows: the segment to",
        points,
        f"{durations[points].min():.4f} s, at least {least:g} s",
        f"`Trajectory.resampled({least:g})`, or `rapidgen move --resample {least:g}`",
    )
    return [result if requested.group.has_limits else replace(result, severity=Severity.WARNING)]


def _too_large_for_stream(requested: _CheckInput) -> list[Diagnostic]:
    values = np.concatenate([requested.wire, requested.durations[:, None]], axis=1)
    points = np.flatnonzero((np.abs(values) > FIXED_LIMIT).any(axis=1))
    if not len(points):
        return []
    figures = f"{np.abs(values[points]).max():.2f}, at most {FIXED_LIMIT:.2f} s, rad or m"
    help = "`Trajectory.resampled(10)` divides a long segment"
    return [
        requested.finding("RG623", "a value is too large for a stream at", points, figures, help)
    ]
