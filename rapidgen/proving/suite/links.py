"""Connections that come, go, hang and take each other's place."""

from rapidgen.protocol import decode, messages, spec
from rapidgen.protocol.spec import Reason
from rapidgen.proving.bench import Bench, distance
from rapidgen.proving.link import raw_point
from rapidgen.proving.model import Broken, Case


def _leaves_in_a_download(bench: Bench) -> None:
    for abort in (False, True):
        link = bench.motion()
        link.send(bench.download(bench.wave(8))[: 68 * 5])
        bench.run(0.2)
        link.close(abort=abort)
        bench.stays(3, "its client left in the download")
        _has_no_start(bench)
        _moves(bench)


def _has_no_start(bench: Bench) -> None:
    """Nothing of what one client has sent counts for the next."""
    link = bench.motion()
    link.send(raw_point(5, bench.position, 1.0, spec.Comm.REQUEST))
    told = decode(link.expect_reply(2, "a point without a start is answered"))
    if not isinstance(told, messages.Refused) or told.reason != Reason.NO_START:
        raise Broken(f"a point without a start is answered by {told}")
    link.close()
    bench.run(0.2)


def _leaves_while_moving(bench: Bench) -> None:
    for abort in (False, True):
        points = bench.wave(20)
        link = bench.motion()
        link.send(bench.download(points))
        bench.wait_until_moving()
        bench.run(0.5)
        link.close(abort=abort)
        bench.wait_until_standing(5)
        if distance(bench.position, points[-1][0]) < 1e-4:
            raise Broken("the robot went on to the end for a client that had left")
        bench.stays(2, "its client is gone")
        _moves(bench)


def _moves(bench: Bench) -> None:
    link = bench.motion()
    bench.moves_through(link, bench.wave(3, duration=0.2))
    link.close()
    bench.run(0.2)


def _idle_client(bench: Bench) -> None:
    link = bench.motion()
    bench.stays(900, "nobody asked for anything")
    bench.moves_through(link, bench.wave(4))


def _newest_takes_over(bench: Bench) -> None:
    old = bench.motion()
    bench.moves_through(old, bench.wave(3))
    new = bench.motion()
    bench.run(5)
    bench.moves_through(new, bench.wave(3))


def _dead_peer(bench: Bench) -> None:
    old = bench.motion()
    bench.moves_through(old, bench.wave(3))
    # It never says another word, not even an end: the old link stays half-open.
    for _ in range(3):
        fresh = bench.motion()
        bench.run(5)
        bench.moves_through(fresh, bench.wave(3))


def _state_client_comes_back(bench: Bench) -> None:
    for abort in (False, True, False):
        link = bench.state()
        bench.status(link)
        link.close(abort=abort)
        bench.run(0.5)
    link = bench.state()
    bench.status(link, 5)


def _many_come_and_go(bench: Bench) -> None:
    for _ in range(40):
        link = bench.motion()
        bench.run(0.03)
        link.close()
        bench.run(0.03)
    _moves(bench)


CASES = (
    Case("leaves-in-download", "a client that leaves in its download moves nothing", "links",
         _leaves_in_a_download),
    Case("leaves-moving", "the robot does not go on for a client that has left", "links",
         _leaves_while_moving),
    Case("idle-client", "an idle client is never timed out", "links", _idle_client),
    Case("newest-takes-over", "the newest client is served", "links", _newest_takes_over, "R12"),
    Case("dead-peer", "a peer that died without a word blocks nobody", "links", _dead_peer, "R12"),
    Case("state-comes-back", "a state client that comes back is served", "links",
         _state_client_comes_back, "R13"),
    Case("come-and-go", "many short connections", "links", _many_come_and_go),
)  # fmt: skip
