"""Data received before a stop does not move the robot after Start."""

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawComm, RawPing, RawTrajectoryState, encode
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.suite.control import stop
from rapidgen.verification.testbench import Bench

case = SuiteGroup("controller")

_SHORT = 0.002
"""s of a stop that ends before a task that looks ten times a second has seen it."""

_BRAKING = 0.02
"""rad or m that an axis may move while it brakes; the whole trajectory is longer."""


_FILLER = 200 * encode(RawPing(), RawComm.TOPIC)
"""Messages without an effect that the motion server needs some ms to read."""


def _order(bench: Bench, path: str, link: RawLink) -> bytes:
    """Return a whole trajectory, as a download or as a stream."""
    points = bench.wave(6)
    if path == "stream":
        return Streamer(bench, link).frame(points, BEGIN | END)
    return bench.download(points)


def _stopped_shortly(bench: Bench, action: str) -> None:
    bench.controller.perform(action)
    bench.run(_SHORT)
    bench.start_again()


def _ways(bench: Bench) -> tuple[str, ...]:
    return ("download", "stream") if bench.streams else ("download",)


@case("order-before-stop", "an order on the wire just before a short stop", "R7a")
def _order_before_stop(bench: Bench) -> None:
    """Stop before the supervisor looks; a started motion ends where it is.

    Start may set a path in motion for the moment that an event routine needs to clear it.
    """
    for path in _ways(bench):
        for action in ("stop", "e-stop", "motors-off"):
            for ms in (0, 1, 3, 8, 20, 50):
                link = bench.motion()
                bench.run(0.15)
                order = _order(bench, path, link)
                link.send(order)
                bench.run(ms * 1e-3)
                what = f"a {path} {ms} ms before {action}, and Start"
                place = bench.position
                _stopped_shortly(bench, action)
                bench.wait_until_at_rest(3, 2, what)
                if distance(bench.position, place) > _BRAKING:
                    raise CheckFailed(
                        f"{what}: the robot went {distance(bench.position, place):.3f}"
                    )
                link.close(then=1.2)
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@case(
    "part-before-stop",
    "an order of which a part came before a short stop",
    "R7a",
    background=True,
)
def _part_before_stop(bench: Bench) -> None:
    """Cut the data anywhere, also inside a message; then a trajectory works."""
    for path in _ways(bench):
        watcher = bench.watcher()
        for share in (0.0, 0.01, 0.4, 0.99):
            link = bench.motion()
            bench.run(0.15)
            order = _order(bench, path, link)
            cut = max(1, round(share * len(order)))
            link.send(order[:cut])
            bench.run(0.05)
            _stopped_shortly(bench, "stop")
            bench.run(0.3)
            link.send(order[cut:])
            what = f"{cut} of {len(order)} bytes of a {path} before a stop, the others after Start"
            bench.assert_at_rest(2.5, what)
            reply = bench.progress(watcher)
            if reply.state != RawTrajectoryState.REFUSED:
                raise CheckFailed(f"{what}: PROGRESS says {reply}")
            bench.assert_moves_through(link, bench.wave(3))
            link.close(then=1.2)
        watcher.close()


@case("waiting-before-stop", "an order that waits after a silent client", "R7a, R12")
def _waiting_before_stop(bench: Bench) -> None:
    """Stop while the data is received but not read."""
    for path in _ways(bench):
        for action in ("stop", "e-stop"):
            for stopped in (_SHORT, 1.0):
                silent = bench.motion()
                bench.run(0.2)
                order = _order(bench, path, silent)
                waiting = [bench.motion() for _ in range(2)]
                for link in waiting:
                    link.send(order)
                bench.run(0.01)
                bench.controller.perform(action)
                bench.run(stopped)
                bench.start_again()
                bench.assert_at_rest(4, f"a {path} waited after a silent client at {action}")
                silent.close()
                bench.assert_at_rest(
                    3, f"a {path} waited after a client at {action}, which then left"
                )
                for link in waiting:
                    link.close()
                bench.run(1.5)
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@case(
    "unread-before-stop",
    "an order that is unread when STOP comes on the control port",
    "R7a",
    needs="control",
)
def _unread_before_control_stop(bench: Bench) -> None:
    """It is behind other bytes, or behind a silent client; the next order is executed."""
    control = bench.control()
    for path in _ways(bench):
        for ms in (0, 1, 3, 8, 20):
            link = bench.motion()
            bench.run(0.15)
            link.at_once(_FILLER + _order(bench, path, link))
            bench.run(ms * 1e-3)
            place = bench.position
            stop(control)
            what = f"a {path} {ms} ms before STOP on the control port"
            bench.wait_until_at_rest(3, 2, what)
            if distance(bench.position, place) > _BRAKING:
                raise CheckFailed(f"{what}: the robot went {distance(bench.position, place):.3f}")
            link.close(then=1.2)
        silent, link = bench.motion(), bench.motion()
        bench.run(0.2)
        link.send(_order(bench, path, link))
        bench.run(0.01)
        control.send(STOP)
        silent.close()
        bench.assert_at_rest(3, f"a {path} waited behind a silent client at STOP")
        control.expect_reply(1, "STOP is answered")
        stop(control)
        bench.assert_moves_through(link, bench.wave(3))
        stop(control)
        link.close()
        bench.assert_moves_through(bench.motion(), bench.wave(3))
        bench.run(1.2)
