"""Each joint by itself: in streams, against a controller's own limits, moved by others."""

from collections.abc import Sequence
from dataclasses import replace

from rapidgen.config.model import Joint, MotionGroup
from rapidgen.generate.layout import STATUS_SIGNALS, signal_name
from rapidgen.protocol import decode, messages
from rapidgen.protocol.spec import Reason, TriState
from rapidgen.proving.bench import HELLO, Bench, Setting, distance
from rapidgen.proving.link import Link, Point, Position, point_frame
from rapidgen.proving.model import Broken, Case
from rapidgen.proving.stream import BEGIN, END, Streamer
from rapidgen.proving.suite.streaming import way

_BEYOND = 0.01
"""rad or m outside a limit: more than rounding."""


def _with(position: Position, axis: int, value: float) -> Position:
    return (*position[:axis], value, *position[axis + 1 :])


def _step(joint: Joint, here: float, size: float) -> float:
    """`size` from `here` to the side with more room."""
    return here + size if joint.upper - here >= here - joint.lower else here - size


class _Blame:
    """Streams of one batch that are refused for one joint of one point."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._stream = Streamer(bench)

    def __call__(self, points: list[Point], reason: Reason, point: int, axis: int) -> None:
        stream = self._stream
        stream.number += 1
        stream.sent = 0
        stream.put(points, BEGIN | END)
        told = stream.refused(reason, f"joint {axis + 1} of point {point}")
        if (told.stream, told.accepted, told.point, told.joint) != (
            stream.number,
            point,
            point,
            axis + 1,
        ):
            raise Broken(f"{reason.name} of joint {axis + 1}, point {point}: the reply is {told}")
        self._bench.stays(0.2, f"joint {axis + 1} is refused: {reason.name}")

    def limits(self, joints: Sequence[Joint] = (), beyond: float = _BEYOND) -> None:
        """Each joint beyond each of its limits, the configuration's where no others are given."""
        here = self._bench.position
        for axis, joint in enumerate(joints or self._bench.group.joints):
            for value in (joint.lower - beyond, joint.upper + beyond):
                points = [(here, 1.0), (_with(here, axis, value), 30.0), (here, 30.0)]
                self(points, Reason.JOINT_LIMIT, 1, axis)

    def close(self) -> None:
        """Leave."""
        self._stream.link.close()


def _joints_of_a_stream(bench: Bench) -> None:
    policy, here = bench.config.trajectory, bench.position
    blame = _Blame(bench)
    blame.limits()
    seconds = max(0.2, policy.min_segment)
    for axis, joint in enumerate(bench.group.joints):
        near = policy.start_tolerance
        if joint.kind != "revolute":
            near = policy.start_tolerance_linear
        if near > 0:
            start = _with(here, axis, _step(joint, here[axis], 1.1 * near))
            blame([(start, 1.0), (here, 5.0)], Reason.START_TOO_FAR, 0, axis)
        fast = 1.05 * seconds * joint.speed
        room = max(joint.upper - here[axis], here[axis] - joint.lower)
        if policy.too_fast == "refuse" and bench.group.tcp_speed_limit >= 5 and room > fast:
            target = _with(here, axis, _step(joint, here[axis], fast))
            blame([(here, 1.0), (target, seconds), (here, 9.0)], Reason.TOO_FAST, 1, axis)
    blame.close()
    bench.run(1.2)
    # The first point's duration is not the client's business, nor how far the start is off.
    stream = Streamer(bench)
    away = _with(here, 0, _step(bench.group.joints[0], here[0], 0.5 * policy.start_tolerance))
    stream.put([(away, 9.0), (here, 1.0)], BEGIN | END)
    stream.accepted("a start within tolerance")
    bench.wait_until_moving(1)
    bench.run(2.5)
    if not bench.standing or distance(bench.position, here) > 1e-4:
        raise Broken("the way to the first point of a stream took as long as its duration says")


def _told_limits(bench: Bench) -> messages.HelloReply:
    told = bench.state().ask(HELLO)
    if not isinstance(told, messages.HelloReply):
        raise Broken(f"HELLO is answered by {told}")
    return told


def _changed(bench: Bench, change: dict[int, Joint]) -> tuple[MotionGroup, ...]:
    """The configuration's groups, some joints of the one that is driven being different."""
    joints = tuple(change.get(n, joint) for n, joint in enumerate(bench.group.joints))
    return tuple(
        replace(g, joints=joints) if g.name == bench.group.name else g for g in bench.config.groups
    )


def _wider_limits(bench: Bench) -> None:
    """Where a controller lets its axes go farther, or does not tell, the configuration counts."""
    joints = bench.group.joints
    wider = {n: replace(j, lower=j.lower - 0.3, upper=j.upper + 0.3) for n, j in enumerate(joints)}
    silent = replace(bench.setting.dialect, axis_limits_told=False)
    for setting in (bench.setting, replace(bench.setting, dialect=silent)):
        other = bench.beside(bench.system, _changed(bench, wider), setting)
        try:
            told = _told_limits(other)
            for axis, joint in enumerate(joints):
                off = abs(told.lower[axis] - joint.lower) + abs(told.upper[axis] - joint.upper)
                if off > 1e-5:
                    raise Broken(f"joint {axis + 1} may go farther, HELLO says {told}")
            blame = _Blame(other)
            blame.limits()
            blame.close()
            _says_wider(other, setting)
        finally:
            other.close()


def _says_wider(bench: Bench, setting: Setting) -> None:
    for axis in range(len(bench.group.joints)):
        said = [e for e in bench.controller.log if f"limits of joint {axis + 1} are" in str(e)]
        wanted = 1 if setting.dialect.axis_limits_told else 0
        if len(said) != wanted or any("are wider" not in str(e) for e in said):
            raise Broken(f"joint {axis + 1} may go farther, the event log says {said}")


def _limits_by_little(bench: Bench) -> None:
    """Limits that differ in their last digits are the same; half a degree is a difference."""
    if not bench.setting.dialect.axis_limits_told:
        return
    for lower, upper, said in (
        (0.0004, -0.0004, ""),
        (-0.0004, 0.0004, ""),
        (0.0, -0.01, "are narrower"),
        (0.01, 0.0, "are narrower"),
        (0.0, 0.01, "are wider"),
        (-0.01, 0.0, "are wider"),
    ):
        joints = bench.group.joints
        others = [replace(j, lower=j.lower + lower, upper=j.upper + upper) for j in joints]
        beside = bench.beside(bench.system, _changed(bench, dict(enumerate(others))))
        try:
            told = _told_limits(beside)
            valid = [
                replace(j, lower=max(j.lower, o.lower), upper=min(j.upper, o.upper))
                for j, o in zip(joints, others, strict=True)
            ]
            for n, joint in enumerate(valid):
                if abs(told.lower[n] - joint.lower) + abs(told.upper[n] - joint.upper) > 1e-5:
                    raise Broken(f"joint {n + 1} may go to {joint.upper}, HELLO says {told}")
                found = [
                    str(e) for e in beside.controller.log if f"limits of joint {n + 1} " in str(e)
                ]
                if len(found) != bool(said) or any(said not in text for text in found):
                    raise Broken(f"limits {lower} and {upper} off, the event log says {found}")
            blame = _Blame(beside)
            blame.limits(valid, _BEYOND / 2)
            blame.close()
        finally:
            beside.close()


def _limits_without_sense(bench: Bench) -> None:
    """Nothing is left of a joint's range: nobody knows what is right, so all is refused."""
    if not bench.setting.dialect.axis_limits_told:
        return
    joint = bench.group.joints[0]
    for lower, upper in (
        (joint.upper + 0.1, joint.upper + 0.2),
        (joint.lower - 0.2, joint.lower - 0.1),
    ):
        odd = replace(joint, lower=lower, upper=upper)
        other = bench.beside(bench.system, _changed(bench, {0: odd}))
        try:
            told = _told_limits(other)
            if told.lower[0] <= told.upper[0]:
                raise Broken(f"nothing is left of the range of joint 1, HELLO says {told}")
            here = bench.position
            for value in (here[0], joint.lower, joint.upper, lower, upper):
                points = [(_with(here, 0, value), 1.0), (_with(here, 0, value), 30.0)]
                _Blame(other)(points, Reason.JOINT_LIMIT, 0, 0)
                other.run(1.5)
            said = [e for e in other.controller.log if "joint 1 make no sense" in str(e)]
            if len(said) != 1:
                raise Broken(f"nothing is left of joint 1, the event log says so {len(said)} times")
        finally:
            other.close()


def _moved_by_others(bench: Bench) -> None:
    """Somebody else moves an axis, and no signal shows it: STATUS does, once."""
    other = bench.beside(replace(bench.system, signals=(), outputs=(), cross=()))
    try:
        link = other.state()
        other.run(1)
        group = other.controller.motion.group(other.group.name)
        for axis, joint in enumerate(other.group.joints):
            unit = 1e-3 if joint.kind == "prismatic" else 0.0174533
            for size, times in ((0.2, 1), (0.03, 0)):
                here = other.position
                group.jump(_with(here, axis, _step(joint, here[axis], size * unit)))
                seen = _in_motion(other, link)
                if seen != times:
                    raise Broken(
                        f"joint {axis + 1} was moved by {size} deg (mm), {seen} STATUS say so"
                    )
    finally:
        other.close()


def _in_motion(bench: Bench, link: Link) -> int:
    before = len(link.frames)
    bench.run(4 * bench.config.state_period)
    told = [decode(frame) for _, frame in link.frames[before:]]
    return sum(1 for t in told if isinstance(t, messages.Status) and t.in_motion == TriState.TRUE)


def _away_from_zero(bench: Bench) -> None:
    """Where no joint is near zero, short ways are short, and nothing else is changed."""
    link = bench.motion()
    there = tuple(0.4 * (j.upper if j.upper > -j.lower else j.lower) for j in bench.group.joints)
    link.send(point_frame(0, 2, there, 9.0) + point_frame(1, 2, there, 9.0))
    bench.wait_until_at(there, 60)
    bench.moves_through(link, bench.wave(5, duration=0.15))
    stream, since = Streamer(bench, link), bench.now
    points = way(bench, 12)
    stream.all(points)
    bench.wait_until_at(points[-1][0], 20)
    bench.followed([bench.track_at(since), *(p for p, _ in points)], since=since)


def _controller_error(bench: Bench) -> None:
    """What the controller calls an error, or a movement, is one, for as long as it does."""
    names = {s.function: signal_name(bench.config, bench.group, s) for s in STATUS_SIGNALS}
    name = names["controller_error"]
    state = bench.state()
    for value in (0, 1):
        bench.controller.signals[names["standing"]] = value
        bench.run(2.5 * bench.config.state_period)
        if bench.status(state).in_motion != 1 - value:
            raise Broken(f"signal {names['standing']} is {value}, STATUS tells another thing")
    for value in (1, 0, 1, 0):
        bench.controller.signals[name] = value
        bench.run(2.5 * bench.config.state_period)
        status = bench.status(state)
        if (status.in_error, status.error_code) != (value, 0):
            raise Broken(f"signal {name} is {value}, STATUS says {status}")


def _one_signal_missing(bench: Bench) -> None:
    """A signal that is not there is unknown; all the others are as they were."""
    for missing in STATUS_SIGNALS:
        name = signal_name(bench.config, bench.group, missing)
        system = replace(
            bench.system,
            signals=tuple(s for s in bench.system.signals if s.name != name),
            outputs=tuple(o for o in bench.system.outputs if o.signal != name),
        )
        other = bench.beside(system)
        try:
            state, link = other.watcher(), other.motion()
            other.run(0.5)
            _shown(other, state, "at rest", missing.function, TriState.TRUE, TriState.FALSE, 1)
            other.moves_through(link, other.wave(3))
            other.run(0.5)
            other.controller.perform("stop")
            other.run(0.5)
            # Without the signal nobody sees that the program was stopped before it is asked.
            possible = 1 if missing.function == "executing" else 0
            off = TriState.FALSE
            _shown(other, state, "stopped", missing.function, TriState.TRUE, off, possible)
            other.controller.perform("e-stop")
            other.run(0.5)
            _shown(other, state, "e-stop", missing.function, TriState.FALSE, TriState.TRUE, 0)
            other.stays(1, "nobody asked for anything")
        finally:
            other.close()


def _shown(
    bench: Bench, state: Link, when: str, missing: str, powered: int, e_stopped: int, possible: int
) -> None:
    status = bench.status(state)
    wanted = (
        TriState.UNKNOWN if missing == "motors_on" else powered,
        TriState.UNKNOWN if missing == "emergency_stop" else e_stopped,
        possible,
    )
    if (status.drives_powered, status.e_stopped, status.motion_possible) != wanted:
        raise Broken(f"{when}, without the signal for {missing}, STATUS says {status}")


CASES = (
    Case("stream-joints", "limits, speed and start of each joint of a stream", "joints",
         _joints_of_a_stream, "R10, R11"),
    Case("wider-limits", "a controller that lets axes go farther, or does not tell", "joints",
         _wider_limits, "R11"),
    Case("limits-by-little", "limits that differ by digits, and by half a degree", "joints",
         _limits_by_little),
    Case("limits-without-sense", "a joint of which no range is left", "joints",
         _limits_without_sense),
    Case("moved-by-others", "movements that no signal shows", "joints", _moved_by_others, "R16"),
    Case("away-from-zero", "short ways where no joint is near zero", "joints", _away_from_zero),
    Case("controller-error", "an error of the controller is in STATUS", "joints",
         _controller_error),
    Case("one-signal-missing", "each signal missing alone", "joints", _one_signal_missing, "R15"),
)  # fmt: skip
