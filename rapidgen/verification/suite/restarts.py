"""Data sent while the program is stopped has no effect after Start."""

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.testbench import Bench

case = SuiteGroup("restarts")

_STOPS = ("stop", "e-stop", "motors-off")


@case("sent-meanwhile", "what comes while the program is stopped is nothing on Start", "R7a")
def _sent_meanwhile(bench: Bench) -> None:
    """Send over an open connection, and over one that waits for accept."""
    for action in _STOPS:
        known = bench.motion()
        bench.run(0.5)
        bench.controller.perform(action)
        bench.run(0.5)
        data = bench.download(bench.wave(4))
        known.send(data)
        new = bench.motion()
        new.send(data)
        bench.assert_at_rest(2, f"the controller is in {action}")
        _nothing_comes_of_it(bench)
        known.close()
        new.close()
        _served(bench)


@case("half-sent-before", "a trajectory that a stop divides is none", "R7a")
def _half_sent_before(bench: Bench) -> None:
    """Send the end of a trajectory whose start came before the stop."""
    for action in _STOPS:
        link = bench.motion()
        data = bench.download(bench.wave(20))
        link.send(data[: len(data) // 2])
        bench.run(0.3)
        bench.controller.perform(action)
        bench.run(0.5)
        link.send(data[len(data) // 2 :])
        _nothing_comes_of_it(bench)
        link.close()
        _served(bench)


@case("stopped-while-taken", "a stop at any moment of the hand-over", "R7a")
def _stopped_while_taken(bench: Bench) -> None:
    """Stop while a trajectory is received and handed over."""
    for number in range(12):
        link = bench.motion()
        bench.run(0.3)
        link.at_once(bench.download(bench.wave(12)))
        bench.run(0.002 * number)
        bench.controller.perform("stop")
        bench.wait_until_standing(10)
        bench.run(0.3)
        _nothing_comes_of_it(bench)
        link.close()
    _served(bench)


@case("batches-meanwhile", "batches that come while the program is stopped", "R7a", needs="stream")
def _batches(bench: Bench) -> None:
    """Start or continue a stream while the program is stopped."""
    for number, before in enumerate((0, 8), 1):
        stream = Streamer(bench, number=number)
        points = bench.wave(16)
        if before:
            stream.put(points[:before], BEGIN)
            bench.run(0.5)
        bench.controller.perform("stop")
        bench.wait_until_standing(10)
        bench.run(0.5)
        stream.link.send(stream.frame(points[before:], END if before else BEGIN | END))
        _nothing_comes_of_it(bench)
        stream.link.close()
        _served(bench)


def _nothing_comes_of_it(bench: Bench) -> None:
    bench.run(0.3)
    bench.start_again()
    bench.assert_at_rest(4, "the program was started; what was sent before is nothing")


def _served(bench: Bench) -> None:
    bench.run(1.5)
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(3))
    link.close(then=0.5)
