"""Messages to the operator: event log warnings, never pendant lines.

A burst of TPWrite blocks the next one for more than 75 s (41617, a virtual controller of RobotWare
6.15): no task that reads or executes STOP may write there.
"""

from rapidgen.machine.event_log import Event, EventType
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawReason, text_of
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP, RawLink, point_frame, raw_point
from rapidgen.verification.testbench import Bench

case = SuiteGroup("telling")


class _Pendant:
    """Warnings of the driver; a line on the pendant fails the check."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._lines: list[str] = []
        bench.controller.operator.subscribe(lambda _task, text: self._lines.append(text))
        self._last = bench.last_event

    def take(self) -> list[Event]:
        """Return the events since the last call."""
        if self._lines:
            raise CheckFailed(f"the driver writes on the pendant: {self._lines}")
        events = [
            e
            for e in self._bench.controller.log.since(self._last)
            if e.type is not EventType.INFO and e.title.startswith("ROS")
        ]
        self._last = self._bench.last_event
        return events

    def says(self, reason: RawReason, point: int, joint: int, *, after: str) -> None:
        """Check one warning: reason text, and place if there is one."""
        events, text = self.take(), text_of(reason)
        place = f"Point {point}. " if point >= 0 else ""
        place += f"Joint {joint}. " if joint else ""
        if len(events) != 1 or events[0].type is not EventType.WARNING:
            raise CheckFailed(f"{after}: the event log has {[str(e) for e in events]}")
        log_entries = " ".join(events[0].texts)
        if (
            text not in log_entries
            or place.strip() not in log_entries
            or ("Joint" in log_entries) != bool(joint)
        ):
            raise CheckFailed(
                f"{after}: the event log says {log_entries!r}, wanted {text!r} and {place!r}"
            )


def _send_wrong(bench: Bench, link: RawLink, index: int, *, joint: int = 0) -> None:
    points = [(p, 30.0) for p, _ in bench.wave(5)]
    joints = list(points[index][0])
    joints[joint] = bench.group.joints[joint].upper + 0.5
    points[index] = (tuple(joints), 30.0)
    link.send(bench.download(points))


@case("said", "a refusal is one warning with point and joint, and no line on the pendant", "R19")
def _refusals_are_logged(bench: Bench) -> None:
    pendant, link = _Pendant(bench), bench.motion()
    last = len(bench.position) - 1
    for index, joint in ((2, 0), (3, last)):
        _send_wrong(bench, link, index, joint=joint)
        bench.run(1.5)
        pendant.says(RawReason.JOINT_LIMIT, index, joint + 1, after=f"joint {joint + 1} is too far")
    points = bench.wave(5)
    frames = [point_frame(n, 5, *point) for n, point in enumerate(points)]
    link.send(b"".join((*frames[:2], *frames[3:])))
    bench.run(1.5)
    pendant.says(RawReason.SEQUENCE_GAP, 2, 0, after="point 2 is missing")
    link.send(frames[3])
    bench.run(1.5)
    pendant.says(RawReason.NO_START, 0, 0, after="a point came alone")
    link.send(frames[0] + frames[1])
    link.close(then=1.5)
    pendant.says(RawReason.INCOMPLETE, 2, 0, after="the client left after two points")


@case("framing-said", "broken framing is logged")
def _framing_is_logged(bench: Bench) -> None:
    pendant = _Pendant(bench)
    link = bench.motion()
    link.send(b"\xff" * 4)
    bench.run(1.5)
    pendant.says(RawReason.FRAMING, -1, 0, after="a length out of bounds")
    link = bench.motion()
    link.send(raw_point(-1, bench.position, 1.0) + b"\xff" * 4)
    bench.run(1.5)
    pendant.says(RawReason.FRAMING, 1, 0, after="a length out of bounds after a point")
    link = bench.motion()
    link.send(b"\x0c\0\0\0\x14\0\0\0\x01\0\0\0\0\0\0\0")
    bench.run(1.5)
    pendant.says(RawReason.UNKNOWN_MESSAGE, -1, 0, after="a message of another type")


@case("rationed", "many refusals are few warnings", "R19")
def _lines_are_rationed(bench: Bench) -> None:
    pendant, link = _Pendant(bench), bench.motion()
    for _ in range(8):
        _send_wrong(bench, link, 1)
        bench.run(0.1)
    events = pendant.take()
    if len(events) != 1:
        raise CheckFailed(f"eight refusals in 0.8 s: {len(events)} events")
    bench.run(1.5)
    if pendant.take():
        raise CheckFailed("events come later than what they tell")
    for more in ("7 similar ones.", ""):
        _send_wrong(bench, link, 1)
        bench.run(1.5)
        events = pendant.take()
        log_entries = str(events[0]) if events else ""
        if len(events) != 1 or ((more or "more like") in log_entries) != bool(more):
            raise CheckFailed(
                f"after eight refusals at once the next one is reported as {log_entries!r}"
            )


@case("quiet", "correct behaviour is not logged", "R19")
def _peace_is_quiet(bench: Bench) -> None:
    """Check that work, and clients that come and go, log nothing."""
    pendant = _Pendant(bench)
    for _ in range(3):
        link, state = bench.motion(), bench.state()
        bench.assert_moves_through(link, bench.wave(4))
        bench.start_motion(link, bench.wave(8))
        link.send(STOP)
        bench.wait_until_standing(5)
        bench.run(0.5)
        # The motion ends some time before the robot has settled there.
        bench.run(2 * bench.setting.motion.settle)
        link.close()
        state.close(abort=True, then=1.2)
    events = pendant.take()
    if events:
        raise CheckFailed(f"nothing was wrong, yet the operator reads {[str(e) for e in events]}")
