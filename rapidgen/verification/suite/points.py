"""Points as requests: each reply reports the state of the trajectory."""

import math
from collections.abc import Sequence

from rapidgen.config.model import Joint
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import Instruction, wrapped
from rapidgen.verification.messages import RawComm, RawReason, RawSpecial, RawTrajectoryState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Position, changed, small_unit
from rapidgen.verification.raw_connection import RawLink, raw_point
from rapidgen.verification.suite.motion_task import datum
from rapidgen.verification.testbench import Bench

case = SuiteGroup("taking")

_BEGIN, _END = int(RawSpecial.BEGIN), int(RawSpecial.END)
_TAKEN = messages.RawAcknowledged()
_LONGEST = 3600.0
_SLOW = 60.0
"""s of a segment that no axis is too slow for."""


class Table:
    """Points and their expected replies, sent in one piece."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.link = bench.motion()
        self.watcher = bench.watcher()
        self.number = bench.progress(self.watcher).trajectory
        """Number of the newest trajectory according to the rows."""
        self._rows: list[tuple[bytes, messages.RawContent, str]] = []

    def row(
        self, sequence: int, joints: Sequence[float], seconds: float, expected: messages.RawContent
    ) -> None:
        """Add a point. A trajectory starts with -1."""
        if sequence == _BEGIN:
            self.number += 1
        frame = raw_point(sequence, joints, seconds, RawComm.REQUEST)
        displayed = ", ".join(f"{value:.9g}" for value in joints)
        self._rows.append((frame, expected, f"point {sequence} ({displayed}) in {seconds:.9g} s"))

    def accepted(self, joints: Sequence[float], seconds: float) -> None:
        """Add an end frame that hands over the trajectory."""
        self.row(_END, joints, seconds, messages.RawAccepted(self.number))

    def ask(self) -> None:
        """Send the rows; check the replies."""
        self.link.send(b"".join(frame for frame, _, _ in self._rows))
        for _, expected, what in self._rows:
            reply = messages.decode(self.link.expect_reply(5, f"{what} is answered"))
            if type(reply) is not type(expected) or reply != expected:
                raise CheckFailed(f"{what}: wanted {expected}, the reply is {reply}")
        self._rows.clear()

    def stop(self, link: RawLink | None = None) -> None:
        """Send STOP, here or over another connection, and check the reply."""
        reply = (link or self.link).stop()
        if not isinstance(reply, messages.RawAcknowledged):
            raise CheckFailed(f"STOP is answered by {reply}")

    def shows(self, state: RawTrajectoryState, received: int, reply: messages.RawRefused) -> None:
        """Check that PROGRESS reports this of the newest trajectory."""
        self.bench.run(2 * self.bench.config.state_period)
        seen = self.bench.progress(self.watcher)
        if (seen.trajectory, seen.state, seen.received, *seen[5:]) != (
            self.number,
            state,
            received,
            *reply,
        ):
            raise CheckFailed(
                f"trajectory {self.number}, {state.name} with {received} points and {reply}: "
                f"PROGRESS says {seen}"
            )


_NOTHING = messages.RawRefused(0, -1, 0)
"""PROGRESS values of a trajectory without a fault."""


def fast_ends(joint: Joint, seconds: float, share: float) -> tuple[float, float] | None:
    """Return two places of an axis near zero for a share of its speed.

    Their distance is `share` of what the axis can do in `seconds`.
    """
    path = share * seconds * joint.speed
    margin = 2 * small_unit(joint)
    low = max(joint.lower + margin, min(-path / 2, joint.upper - margin - path))
    return (low, low + path) if low + path <= joint.upper - margin else None


@case("each-value", "each value of a point at its bounds and beyond", "R10, R11")
def _each_value(bench: Bench) -> None:
    """Check limits, speeds and NaN of each joint alone; ignore padding."""
    table, current = Table(bench), bench.position
    policy = bench.config.trajectory
    seconds = max(0.1, policy.min_segment)
    fault = policy.too_fast == "refuse"
    for axis, joint in enumerate(bench.group.joints):
        unit = small_unit(joint)
        for value, reason in (
            (joint.lower - 0.0012 * unit, RawReason.JOINT_LIMIT),
            (joint.upper + 0.0012 * unit, RawReason.JOINT_LIMIT),
            (1e6, RawReason.JOINT_LIMIT),
            (math.nan, RawReason.NOT_FINITE),
            (math.inf, RawReason.NOT_FINITE),
            (-math.inf, RawReason.NOT_FINITE),
        ):
            wrong = messages.RawRefused(reason, 0, axis + 1)
            table.row(_BEGIN, changed(current, axis, value), _SLOW, wrong)
            table.row(1, current, _SLOW, wrong)
        table.row(_BEGIN, changed(current, axis, joint.lower), _SLOW, _TAKEN)
        table.row(1, changed(current, axis, joint.upper), _SLOW, _TAKEN)
        table.row(2, changed(current, axis, joint.lower), _SLOW, _TAKEN)
        # The robot need not reach a first point in its time.
        for value in (joint.upper, joint.lower):
            table.row(_BEGIN, changed(current, axis, value), 0.0, _TAKEN)
        for share in (0.999, 1.01):
            ends = fast_ends(joint, seconds, share)
            if ends is None:
                continue
            places = [changed(current, axis, value) for value in ends]
            if 1.1 * bench.tcp_seconds(places[0], places[1]) > seconds:
                continue
            wrong = messages.RawRefused(RawReason.TOO_FAST, 2, axis + 1)
            for one, other in (places, places[::-1]):
                table.row(_BEGIN, one, seconds, _TAKEN)
                table.row(1, one, seconds, _TAKEN)
                table.row(2, other, seconds, wrong if share > 1 and fault else _TAKEN)
                if share < 1:
                    table.row(3, one, seconds, _TAKEN)
        table.ask()
    missing = len(current)
    for axis in range(missing, messages.MAX_JOINTS):
        zeros = (*current, *[0.0] * (axis - missing))
        for value in (0.5, 1e-45, math.nan):
            wrong = messages.RawRefused(RawReason.BAD_PADDING, 1, axis + 1)
            table.row(_BEGIN, current, _SLOW, _TAKEN)
            table.row(1, (*zeros, value), _SLOW, wrong)
        table.row(_BEGIN, (*zeros, -0.0), _SLOW, _TAKEN)
    # The first fault counts.
    first, last = bench.group.joints[0], bench.group.joints[-1]
    both = (first.upper + 1, *current[1:-1], last.upper + 1)
    table.row(_BEGIN, both, _SLOW, messages.RawRefused(RawReason.JOINT_LIMIT, 0, 1))
    table.row(_BEGIN, both, math.nan, messages.RawRefused(RawReason.NOT_FINITE, 0, 0))
    table.row(_BEGIN, current, _SLOW, _TAKEN)
    table.ask()
    bench.assert_at_rest(0.1, "no trajectory was sent whole")
    _rounded(bench, table)


def _rounded(bench: Bench, table: Table) -> None:
    """Round two places outside all limits to the same limits."""
    for side in (-1, 1):
        one, two = (
            tuple(
                (joint.lower if side < 0 else joint.upper) + side * off * small_unit(joint)
                for joint in bench.group.joints
            )
            for off in (0.0002, 0.0001)
        )
        table.row(_BEGIN, one, _LONGEST, _TAKEN)
        # Segments without length need no time.
        table.row(1, two, bench.config.trajectory.min_segment or 0.001, _TAKEN)
        table.ask()
        bench.assert_at_rest(0.1, "no trajectory was sent whole")


@case("each-duration", "durations at their bounds and beyond", "R10")
def _each_duration(bench: Bench) -> None:
    """Check durations of the first, a middle and the last point."""
    table, current = Table(bench), bench.position
    policy = bench.config.trajectory
    wrong: tuple[tuple[float, RawReason], ...] = (
        (-1e-3, RawReason.BAD_DURATION),
        (_LONGEST + 0.5, RawReason.BAD_DURATION),
        (1e9, RawReason.BAD_DURATION),
        (-1e9, RawReason.BAD_DURATION),
        (math.nan, RawReason.NOT_FINITE),
        (math.inf, RawReason.NOT_FINITE),
        (-math.inf, RawReason.NOT_FINITE),
        (2e9, RawReason.NOT_FINITE),
    )
    for seconds, reason in wrong:
        table.row(_BEGIN, current, seconds, messages.RawRefused(reason, 0, 0))
        table.row(_BEGIN, current, 0.0, _TAKEN)
        table.row(1, current, seconds, messages.RawRefused(reason, 1, 0))
    for seconds in (0.0, -0.0, 1e-3, 0.9, 1.0, _LONGEST):
        table.row(_BEGIN, current, seconds, _TAKEN)
    for seconds in (0.0, -0.0):
        table.row(1, current, 1.0, _TAKEN)
        table.row(2, current, seconds, messages.RawRefused(RawReason.BAD_DURATION, 2, 0))
        table.row(_BEGIN, current, 1.0, _TAKEN)
    for number, seconds in enumerate((_LONGEST, 1.0, max(0.9, policy.min_segment)), 1):
        table.row(number, current, seconds, _TAKEN)
    table.row(4, current, policy.min_segment, _TAKEN)
    shorter = 0.999 * policy.min_segment
    if policy.min_segment > 0.005:
        short = messages.RawRefused(RawReason.SEGMENT_TOO_SHORT, 5, 0)
        table.row(5, current, shorter, short if policy.too_fast == "refuse" else _TAKEN)
        # The last segment has no successor that must be planned in time.
        table.row(_BEGIN, current, shorter, _TAKEN)
        table.row(1, current, 1.0, _TAKEN)
        table.accepted(current, shorter / 2)
    table.ask()
    table.stop()
    bench.assert_at_rest(0.2, "it was asked to stay where it is")


@case("each-number", "numbers of points, STOP among them, and what is skipped", "C4")
def _each_number(bench: Bench) -> None:
    """Check sequence numbers: in and out of order, STOP, after a rejection."""
    table, current = Table(bench), bench.position

    def row(sequence: int, expected: messages.RawContent, joints: Position = current) -> None:
        table.row(sequence, joints, _SLOW, expected)

    alone = messages.RawRefused(RawReason.NO_START, 0, 0)
    far = changed(current, 0, bench.group.joints[0].upper + 1)
    beyond = messages.RawRefused(RawReason.JOINT_LIMIT, 0, 1)

    def without_a_start(sequence: int) -> None:
        table.number += 1
        row(sequence, alone)

    without_a_start(5)
    for sequence in (6, 0, _END):
        row(sequence, alone)
    # After the end of a rejected trajectory, the driver skips nothing more.
    without_a_start(_END)
    without_a_start(1)
    for taken in (1, 2, 3):
        gap = messages.RawRefused(RawReason.SEQUENCE_GAP, taken, 0)
        for wrong in (taken - 1, taken + 1, -2, -5):
            row(_BEGIN, _TAKEN)
            for sequence in range(1, taken):
                row(sequence, _TAKEN)
            for sequence in (wrong, taken, _END):
                row(sequence, gap)
    without_a_start(1)
    row(_BEGIN, _TAKEN)
    row(_END, messages.RawRefused(RawReason.JOINT_LIMIT, 1, 1), far)
    without_a_start(2)
    row(_BEGIN, beyond, far)
    row(_END, beyond)
    without_a_start(1)
    # A new start counts in every state.
    row(_BEGIN, beyond, far)
    row(_BEGIN, _TAKEN)
    row(_BEGIN, _TAKEN)
    row(1, _TAKEN)
    table.ask()
    table.shows(RawTrajectoryState.RECEIVING, 2, _NOTHING)
    table.stop()
    table.shows(RawTrajectoryState.STOPPED, 2, messages.RawRefused(RawReason.STOPPED, -1, 0))
    without_a_start(2)
    row(_BEGIN, beyond, far)
    table.ask()
    table.shows(RawTrajectoryState.REFUSED, 0, beyond)
    table.stop()
    without_a_start(1)
    row(_BEGIN, _TAKEN)
    row(1, messages.RawRefused(RawReason.JOINT_LIMIT, 1, 1), far)
    table.ask()
    table.shows(RawTrajectoryState.REFUSED, 1, messages.RawRefused(RawReason.JOINT_LIMIT, 1, 1))
    row(_BEGIN, _TAKEN)
    table.ask()
    table.shows(RawTrajectoryState.RECEIVING, 1, _NOTHING)
    _full(bench, table)
    _of_other_builds(bench, table)
    for sequence in (_BEGIN, 1):
        row(sequence, _TAKEN)
    table.accepted(current, _SLOW)
    # After the hand-over there is no next point.
    without_a_start(3)
    table.ask()
    table.stop()
    # Points of one client, rejected or not, do not count for the next one.
    for joints, expected in ((current, _TAKEN), (far, beyond)):
        row(_BEGIN, expected, joints)
        table.ask()
        table.link.close()
        table.link = bench.motion()
        without_a_start(1)
        row(_END, alone)
        table.ask()
    bench.assert_at_rest(0.2, "it was asked to stay where it is")


def _full(bench: Bench, table: Table) -> None:
    """Send exactly the capacity of points, and one more."""
    current, capacity = bench.position, bench.config.trajectory.capacity
    for last in (capacity, _END):
        table.row(_BEGIN, current, _SLOW, _TAKEN)
        table.ask()
        # Simulate the other points: sending a thousand equal points adds nothing.
        server = bench.controller.task(bench.task("ROS_motionServer"))
        server["ROS_motionServer:ROS_point_count"] = capacity - 1
        full = messages.RawRefused(RawReason.CAPACITY, capacity, 0)
        table.row(capacity - 1, current, _SLOW, _TAKEN)
        table.row(last, current, _SLOW, full)
        if last == _END:
            table.number += 1
            full = messages.RawRefused(RawReason.NO_START, 0, 0)
        table.row(1, current, _SLOW, full)
        table.ask()


def _of_other_builds(bench: Bench, table: Table) -> None:
    """Reject each start while any task shows another build.

    The build comes before every other reason.
    """
    task = bench.controller.task(bench.task("ROS_motionServer"))
    name = datum(bench, "ros_task_build_state")
    mixed = messages.RawRefused(RawReason.BUILD_MISMATCH, -1, 0)
    own, task[name] = task[name], "000000000000"
    for sequence in (_BEGIN, 1, 1, _END, _BEGIN):
        table.row(sequence, bench.position, math.nan, mixed)
    table.ask()
    table.shows(RawTrajectoryState.REFUSED, 0, mixed)
    task[name] = own


@case(
    "point-reads",
    "a point of a download is read with few instructions",
)
def _few_reads(bench: Bench) -> None:
    """Count the reads of each point that comes alone, as a topic or as a request."""
    number, joints = 0, len(bench.group.joints)

    def counted(as_before: Instruction) -> Instruction:
        def counting(*arguments: object) -> object:
            nonlocal number
            number += 1
            return as_before(*arguments)

        return counting

    absent = messages.MAX_JOINTS - joints
    # The header of four words, sequence number, duration, joints and those that are zero.
    expected = 6 + joints + absent
    points, link, since = bench.wave(12, duration=0.5), bench.motion(), bench.now
    link.send(raw_point(_BEGIN, *points[0]))
    bench.run(0.1)
    wrapped(bench.rapid_task("ROS_motionServer"), "UnpackRawBytes", counted)
    for sequence, point in enumerate(points[1:-1], 1):
        comm, number = RawComm.REQUEST if sequence % 4 == 0 else RawComm.TOPIC, 0
        link.send(raw_point(sequence, *point, comm))
        bench.run(0.1)
        if number != expected:
            raise CheckFailed(f"point {sequence}, {comm.name}: {number} reads, not {expected}")
        if comm is RawComm.REQUEST and messages.decode(link.expect_reply(0.1, "it")) != _TAKEN:
            raise CheckFailed(f"point {sequence} as a request is not confirmed")
    link.send(raw_point(_END, *points[-1]))
    bench.arrives(points, since, 20)


@case("one-more", "lines for refusals that come at once", "R19")
def _one_more(bench: Bench) -> None:
    """Log at most one warning a second; the next one counts the others."""
    table, joints = Table(bench), bench.group.joints
    lines: list[str] = []
    bench.controller.operator.subscribe(lambda _task, text: lines.append(text))
    for at_once, axis, more in (
        (2, 0, ""),
        (1, len(joints) - 1, "1 similar ones."),
        (3, None, ""),
        (1, 0, "2 similar ones."),
    ):
        before = bench.last_event
        sequence, reason, place = int(RawSpecial.END), RawReason.NO_START, ""
        joint, expected = 0, bench.position
        if axis is not None:
            sequence, reason, joint = _BEGIN, RawReason.JOINT_LIMIT, axis + 1
            place = f"Joint {joint}."
            expected = changed(expected, axis, joints[axis].upper + 1)
        # The driver has nothing to skip.
        table.stop()
        for _ in range(at_once):
            table.row(sequence, expected, _SLOW, messages.RawRefused(reason, 0, joint))
        table.ask()
        bench.run(1.05)
        log_entries = [" ".join(e.texts).split() for e in bench.controller.log.since(before)]
        text = messages.text_of(reason)
        if log_entries != [f"{text} Point 0. {place} {more}".split()]:
            raise CheckFailed(
                f"{at_once} refusals for {reason.name}, the event log says {log_entries}"
            )
        if lines:
            raise CheckFailed(f"{at_once} refusals for {reason.name}, the pendant says {lines}")
