"""Single joints, in streams and away from zero; single signals."""

from rapidgen.generate.layout import signal_name
from rapidgen.generate.status import STATUS_SIGNALS
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawReason, RawTriState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, changed, distance, inward
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.stream import BEGIN, END, Streamer, way
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.testbench import Bench

case = SuiteGroup("joints")

_BEYOND = 0.01
"""rad or m outside a limit: more than rounding."""


class _RejectedJoint:
    """One-batch streams, rejected for one joint of one point."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._stream = Streamer(bench)

    def __call__(self, points: list[Point], reason: RawReason, point: int, axis: int) -> None:
        stream = self._stream
        stream.number += 1
        stream.sent = 0
        reply = stream.refuses(reason, f"joint {axis + 1} of point {point}", points, BEGIN | END)
        if (reply.stream, reply.accepted, reply.point, reply.joint) != (
            stream.number,
            point,
            point,
            axis + 1,
        ):
            raise CheckFailed(
                f"{reason.name} of joint {axis + 1}, point {point}: the reply is {reply}"
            )
        self._bench.assert_at_rest(0.2, f"joint {axis + 1} is refused: {reason.name}")

    def limits(self) -> None:
        """Check each joint beyond each of its limits."""
        current = self._bench.position
        for axis, joint in enumerate(self._bench.group.joints):
            for value in (joint.lower - _BEYOND, joint.upper + _BEYOND):
                points = [(current, 1.0), (changed(current, axis, value), 30.0), (current, 30.0)]
                self(points, RawReason.JOINT_LIMIT, 1, axis)

    def close(self) -> None:
        """Close the connection."""
        self._stream.link.close()


@case(
    "stream-joints", "limits, speed and start of each joint of a stream", "R10, R11", needs="stream"
)
def _joints_of_a_stream(bench: Bench) -> None:
    policy, current = bench.config.trajectory, bench.position
    expect_rejected = _RejectedJoint(bench)
    expect_rejected.limits()
    seconds = max(0.2, policy.min_segment)
    for axis, joint in enumerate(bench.group.joints):
        near = bench.start_tolerance(joint)
        if near > 0:
            start = changed(current, axis, inward(joint, current[axis], 1.1 * near))
            expect_rejected([(start, 1.0), (current, 5.0)], RawReason.START_TOO_FAR, 0, axis)
        fast = 1.05 * seconds * joint.speed
        space = max(joint.upper - current[axis], current[axis] - joint.lower)
        if policy.too_fast == "refuse" and bench.group.tcp_speed_limit >= 5 and space > fast:
            target = changed(current, axis, inward(joint, current[axis], fast))
            expect_rejected(
                [(current, 1.0), (target, seconds), (current, 9.0)], RawReason.TOO_FAST, 1, axis
            )
    expect_rejected.close()
    bench.run(1.2)
    # The driver ignores the first point's duration, and the start offset.
    stream = Streamer(bench)
    away = changed(
        current, 0, inward(bench.group.joints[0], current[0], 0.5 * policy.start_tolerance)
    )
    stream.takes("a start within tolerance", [(away, 9.0), (current, 1.0)], BEGIN | END)
    bench.wait_until_moving(1)
    bench.run(2.5)
    if not bench.standing or distance(bench.position, current) > 1e-4:
        raise CheckFailed(
            "the way to the first point of a stream took as long as its duration says"
        )


@case("away-from-zero", "short ways where no joint is near zero", needs="stream")
def _away_from_zero(bench: Bench) -> None:
    """Move from positions without a joint near zero."""
    link = bench.motion()
    target = tuple(0.4 * (j.upper if j.upper > -j.lower else j.lower) for j in bench.group.joints)
    bench.assert_moves_through(link, bench.way_to(target))
    bench.assert_moves_through(link, bench.wave(5, duration=0.15))
    stream, since = Streamer(bench, link), bench.now
    points = way(bench, 12)
    stream.all(points)
    bench.arrives(points, since, 20)


@case("controller-error", "an error of the controller is in STATUS")
def _controller_error(bench: Bench) -> None:
    """Report controller errors, motions and emergency stops while they last."""
    names = {s.function: signal_name(bench.config, bench.group, s) for s in STATUS_SIGNALS}
    state = bench.state()
    # The driver believes a movement that follows a standstill.
    bench.run(halt_timeout(bench))
    for function, field, on, values in (
        ("standing", "in_motion", 0, (0, 1)),
        ("controller_error", "in_error", 1, (1, 0, 1, 0)),
        ("motors_on", "drives_powered", 1, (0, 1)),
        ("emergency_stop", "e_stopped", 1, (1, 0)),
    ):
        for value in values:
            bench.controller.signals[names[function]] = value
            bench.run(2.5 * bench.config.state_period)
            status = bench.status(state)
            if (getattr(status, field), status.error_code) != (int(value == on), 0):
                raise CheckFailed(f"signal {names[function]} is {value}, STATUS says {status}")
        bench.run(0.5)
    if status != bench.status(state) or not status.motion_possible:
        raise CheckFailed(f"all signals are as they were, STATUS says {status}")


@case("one-signal-missing", "each signal missing alone", "R15", background=True)
def _one_signal_missing(bench: Bench) -> None:
    """Remove one signal at a start: it is unknown, the others unchanged."""
    signals, off, on = bench.controller.io.signals, RawTriState.FALSE, RawTriState.TRUE
    bench.run(0.2)
    for missing in STATUS_SIGNALS:
        name = signal_name(bench.config, bench.group, missing).lower()
        signal = signals.pop(name)
        _power_again(bench)
        state, link = bench.watcher(), bench.motion()
        bench.run(0.5)
        _shown(bench, state, "at rest", missing.function, on, off, 1)
        for function, value in (("controller_error", 1), ("standing", 0)):
            _is_seen(bench, state, function, value, seen=function != missing.function)
        bench.assert_moves_through(link, bench.wave(3))
        bench.run(0.5)
        bench.controller.perform("stop")
        bench.run(0.5)
        # Without the program signal, the event routines report the stop.
        _shown(bench, state, "stopped", missing.function, on, off, 0)
        bench.controller.perform("e-stop")
        bench.run(0.5)
        _shown(bench, state, "e-stop", missing.function, off, on, 0)
        bench.assert_at_rest(0.5, "no client asked for anything")
        signals[name] = signal
    _power_again(bench)
    _shown(bench, bench.watcher(), "all signals are back", "", on, off, 1)


def _is_seen(bench: Bench, state: RawLink, function: str, value: int, *, seen: bool) -> None:
    """Check that STATUS shows a signal's value, and its later change."""
    name = next(
        signal_name(bench.config, bench.group, s) for s in STATUS_SIGNALS if s.function == function
    )
    for now in (value, 1 - value):
        if name.lower() in bench.controller.io.signals:
            bench.controller.signals[name] = now
        bench.run(2 * bench.config.state_period)
        status = bench.status(state)
        reply = status.in_error if function == "controller_error" else status.in_motion
        if reply != (seen and now == value):
            raise CheckFailed(f"signal {name} is {now}, STATUS says {status}")


def _power_again(bench: Bench) -> None:
    """Cycle power: tasks repeat the checks of their start."""
    for action in ("power-loss", "pp-to-main"):
        bench.controller.perform(action)
    bench.start_again()
    bench.run(1)


def _shown(
    bench: Bench,
    state: RawLink,
    when: str,
    missing: str,
    powered: int,
    e_stopped: int,
    possible: int,
) -> None:
    status = bench.status(state)
    expected = (
        RawTriState.UNKNOWN if missing == "motors_on" else powered,
        RawTriState.UNKNOWN if missing == "emergency_stop" else e_stopped,
        possible,
    )
    if (status.drives_powered, status.e_stopped, status.motion_possible) != expected:
        raise CheckFailed(f"{when}, without the signal for {missing}, STATUS says {status}")
