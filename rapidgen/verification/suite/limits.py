"""Axis limits from the controller: narrower, wider, missing, invalid."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rapidgen.config.model import Joint
from rapidgen.machine.event_log import EventType
from rapidgen.system.base.mechanics_cfg import arm_name
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawComm, RawReason, decode
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Position
from rapidgen.verification.raw_connection import RawLink, raw_point
from rapidgen.verification.testbench import HELLO, Bench

case = SuiteGroup("limits")

_LOGGED = {
    "are narrower": (EventType.WARNING, "The limits of the controller are used."),
    "are wider": (EventType.INFO, "The limits of the configuration are used."),
    "make no sense": (EventType.ERROR, "No trajectory is accepted."),
}
_NEAR = 0.002
"""rad or m inside and outside of a limit: more than rounding, less than any difference here."""
_ROUNDING = 5e-6
"""rad or m outside of a limit by rounding: the driver uses the limit."""
_FAR = 1e6
"""rad or m that no axis reaches."""


@dataclass(frozen=True, slots=True)
class _ReportedLimits:
    """The controller's limits of a joint, rad or m; None: not available.

    `log_text`: the driver's text in the event log, empty if there is none.
    """

    lower: float | None
    upper: float | None
    log_text: str = ""

    def left(self, joint: Joint) -> tuple[float, float]:
        """Return the limits in force."""
        if self.lower is None or self.upper is None:
            return joint.lower, joint.upper
        return max(self.lower, joint.lower), min(self.upper, joint.upper)


def _differences(joint: Joint) -> list[_ReportedLimits]:
    """Return limits that differ.

    A hundredth is a difference, less than a thousandth is none.
    """
    low, high, more, less = joint.lower, joint.upper, 0.01, 0.0004
    return [
        _ReportedLimits(low + more, high, "are narrower"),
        _ReportedLimits(low - more, high, "are wider"),
        _ReportedLimits(None, high - more),
        _ReportedLimits(low, high - more, "are narrower"),
        _ReportedLimits(low, high + more, "are wider"),
        _ReportedLimits(low + more, None),
        _ReportedLimits(low + less, high - less),
        _ReportedLimits(low + more, high + more, "are narrower"),
        _ReportedLimits(low - less, high + less),
        _ReportedLimits(low - more, high - more, "are narrower"),
    ]


def _nonsense(joint: Joint, lowest: float, highest: float) -> list[_ReportedLimits]:
    """Return invalid limits.

    Either the range is empty, or its overlap with `lowest` to `highest` is.
    """
    low, high, middle = joint.lower, joint.upper, (joint.lower + joint.upper) / 2
    return [
        _ReportedLimits(*limits, "make no sense")
        for limits in (
            (high + 0.1, high + 0.2),
            (low - 0.2, low - 0.1),
            (middle + 0.1, middle - 0.1),
            (middle, middle),
            (highest, high + 0.1),
            (low - 0.1, lowest),
        )
    ]


def _hello(link: RawLink) -> messages.RawHelloReply:
    reply = link.ask(HELLO)
    link.close()
    if not isinstance(reply, messages.RawHelloReply):
        raise CheckFailed(f"HELLO is answered by {reply}")
    return reply


class _Cell:
    """A controller with changed limits, effective from its next start."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._newest = 0
        self.plain = _hello(bench.state())

    def start(self, reply: Sequence[_ReportedLimits]) -> None:
        """Start with other limits; check that the event log names the differences."""
        bench = self._bench
        for joint, one in zip(bench.group.joints, reply, strict=True):
            arm = bench.controller.cfg.instance("MOC", "ARM", arm_name(bench.group, joint))
            if arm is not None:
                limits = {"lower_joint_bound": one.lower, "upper_joint_bound": one.upper}
                bench.controller.cfg.change("MOC", "ARM", arm, limits)
        self._newest = bench.last_event
        for action in ("power-loss", "pp-to-main", "auto", "motors-on", "start"):
            bench.controller.perform(action)
        bench.run(1)
        for number, (joint, one) in enumerate(zip(bench.group.joints, reply, strict=True), 1):
            self._is_logged(number, joint, one)

    def _is_logged(self, number: int, joint: Joint, reply: _ReportedLimits) -> None:
        title = f"ROS: limits of joint {number} "
        log = self._bench.controller.log.since(self._newest)
        result = [e for e in log if e.title.startswith(title)]
        what = f"joint {number} may move from {reply.lower} to {reply.upper}, of {joint}"
        if not (reply.log_text and self._bench.setting.dialect.axis_limits_readable):
            if result:
                raise CheckFailed(f"{what}: the event log says {result[0]}")
            return
        kind, effect = _LOGGED[reply.log_text]
        if [(e.type, e.title, e.texts[0]) for e in result] != [
            (kind, title + reply.log_text, effect)
        ]:
            raise CheckFailed(f"{what}: the event log says {[str(e) for e in result]}")
        _are(result[0].texts[1], "Configuration", joint, joint.lower, joint.upper)
        _are(result[0].texts[2], "Controller", joint, reply.lower or 0.0, reply.upper or 0.0)

    def in_force(self) -> messages.RawHelloReply:
        """Return HELLO; check that both ports report the same."""
        bench = self._bench
        reply = _hello(bench.state())
        if bench.group.ports.control:
            other = _hello(bench.control())
            if (other.lower, other.upper) != (reply.lower, reply.upper):
                raise CheckFailed(
                    f"the control port tells limits of {other}, the state port {reply}"
                )
        return reply


def _answer(link: RawLink, others: Position, axis: int, value: float) -> messages.RawContent:
    """Return the reply to a point with that value.

    Its trajectory gets no end, so nothing moves.
    """
    link.send(raw_point(-1, (*others[:axis], value, *others[axis + 1 :]), 1.0, RawComm.REQUEST))
    return decode(link.expect_reply(2, "a point is answered"))


def _are(text: str, whose: str, joint: Joint, lower: float, upper: float) -> None:
    """Check that an event log text holds these limits, to two digits."""
    factor, unit = (57.29578, "deg") if joint.kind == "revolute" else (1000.0, "mm")
    reply = re.fullmatch(rf"{whose}: (-?\d+(?:\.\d\d?)?) to (-?\d+(?:\.\d\d?)?) {unit}", text)
    for number, limit in enumerate((factor * lower, factor * upper), 1):
        if reply is None or abs(float(reply[number]) - limit) > 0.0051 + 1e-5 * abs(limit):
            raise CheckFailed(f"a limit of {limit:.3f} {unit} is reported in {text!r}")


@case("limits-as-told", "limits that the controller reports for each joint, or not", "R11")
def _reported_limits(bench: Bench) -> None:
    """Change the limits of each joint in several ways, and restore them."""
    joints, cell = bench.group.joints, _Cell(bench)
    kinds = len(_differences(joints[0]))
    for first in range(0, kinds, len(joints)):
        turn = [_differences(joint)[(first + n) % kinds] for n, joint in enumerate(joints)]
        _counts(bench, cell, turn)
    _counts(
        bench, cell, [_ReportedLimits(j.lower - 0.3, j.upper + 0.3, "are wider") for j in joints]
    )


def _counts(bench: Bench, cell: _Cell, reply: Sequence[_ReportedLimits]) -> None:
    """Check that the limits in force are reported and applied."""
    cell.start(reply)
    hello, link = cell.in_force(), bench.motion()
    silent = not bench.setting.dialect.axis_limits_readable
    left = [
        (joint.lower, joint.upper) if silent else one.left(joint)
        for joint, one in zip(bench.group.joints, reply, strict=True)
    ]
    # An axis may be at its end, where the controller does not let it go further.
    current = tuple(
        min(max(p, low), high) for p, (low, high) in zip(bench.position, left, strict=True)
    )
    for axis, limits in enumerate(left):
        seen = hello.lower[axis], hello.upper[axis]
        if any(abs(t - w) > 1e-6 * max(1.0, abs(w)) for t, w in zip(seen, limits, strict=True)):
            raise CheckFailed(f"joint {axis + 1} may move in {limits}, HELLO says {seen}")
        for limit, inside in ((limits[0], _NEAR), (limits[1], -_NEAR)):
            for value, expected in (
                (limit + inside, messages.RawAcknowledged()),
                (limit - inside, messages.RawRefused(RawReason.JOINT_LIMIT, 0, axis + 1)),
            ):
                answer = _answer(link, current, axis, value)
                if answer != expected:
                    raise CheckFailed(
                        f"joint {axis + 1} is at {value}, the limit {limit}: {answer}"
                    )
    bench.assert_at_rest(0.5, "no trajectory was sent to its end")


@case("limits-without-sense", "a joint of which no range is left")
def _limits_without_sense(bench: Bench) -> None:
    """Make limits invalid: every point of such a joint is rejected."""
    if not bench.setting.dialect.axis_limits_readable:
        raise NotApplicable("the controller does not tell limits of axes")
    joints, cell = bench.group.joints, _Cell(bench)
    for number in range(len(_nonsense(joints[0], 0.0, 0.0))):
        axis = number % len(joints)
        joint = joints[axis]
        odd = _nonsense(joint, cell.plain.lower[axis], cell.plain.upper[axis])[number]
        chosen = [_ReportedLimits(j.lower, j.upper) for j in joints]
        chosen[axis] = odd
        cell.start(chosen)
        hello, link = cell.in_force(), bench.motion()
        if not hello.lower[axis] > _FAR > -_FAR > hello.upper[axis]:
            raise CheckFailed(
                f"nothing is left of the range of joint {axis + 1}, HELLO says {hello}"
            )
        ends = (joint.lower - _ROUNDING, joint.upper + _ROUNDING, odd.lower or 0, odd.upper or 0)
        for value in (bench.position[axis], *ends):
            answer = _answer(link, bench.position, axis, value)
            if answer != messages.RawRefused(RawReason.JOINT_LIMIT, 0, axis + 1):
                raise CheckFailed(
                    f"nothing is left of joint {axis + 1}, it is at {value}: {answer}"
                )
        bench.assert_at_rest(0.5, "a joint has no range")
