"""Connections that come, go, hang and take each other's place."""

from rapidgen.proving import messages
from rapidgen.proving.behaviour import Theme
from rapidgen.proving.bench import Bench
from rapidgen.proving.link import STOP, RawLink, raw_point
from rapidgen.proving.messages import PING, RawComm, RawReason, decode, encode
from rapidgen.proving.model import Broken
from rapidgen.proving.stream import BEGIN, END, Streamer
from rapidgen.proving.track import SETTLED, Point, distance

case = Theme("links")


@case("leaves-in-download", "a client that leaves in its download moves nothing")
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
    link.send(raw_point(5, bench.position, 1.0, RawComm.REQUEST))
    told = decode(link.expect_reply(2, "a point without a start is answered"))
    if not isinstance(told, messages.RawRefused) or told.reason != RawReason.NO_START:
        raise Broken(f"a point without a start is answered by {told}")
    link.close(then=0.2)


@case("leaves-moving", "the robot does not go on for a client that has left")
def _leaves_while_moving(bench: Bench) -> None:
    for abort in (False, True):
        points = bench.wave(20)
        link = bench.motion()
        bench.sets_off(link, points, 0.5)
        link.close(abort=abort)
        bench.wait_until_standing(5)
        if distance(bench.position, points[-1][0]) < 1e-4:
            raise Broken("the robot went on to the end for a client that had left")
        bench.stays(2, "its client is gone")
        _moves(bench)


def _moves(bench: Bench) -> None:
    link = bench.motion()
    bench.moves_through(link, bench.wave(3, duration=0.2))
    link.close(then=0.2)


@case("idle-client", "an idle client is never timed out")
def _idle_client(bench: Bench) -> None:
    link = bench.motion()
    bench.stays(900, "nobody asked for anything")
    bench.moves_through(link, bench.wave(4))


@case("newest-takes-over", "the newest client is served", "R12")
def _newest_takes_over(bench: Bench) -> None:
    old = bench.motion()
    bench.moves_through(old, bench.wave(3))
    new = bench.motion()
    bench.run(5)
    bench.moves_through(new, bench.wave(3))


@case("dead-peer", "a peer that died without a word blocks nobody", "R12")
def _dead_peer(bench: Bench) -> None:
    old = bench.motion()
    bench.moves_through(old, bench.wave(3))
    # It never says another word, not even an end: the old link stays half-open.
    for _ in range(3):
        fresh = bench.motion()
        bench.run(5)
        bench.moves_through(fresh, bench.wave(3))


@case("state-comes-back", "a state client that comes back is served", "R13")
def _state_client_comes_back(bench: Bench) -> None:
    for abort in (False, True, False):
        link = bench.state()
        bench.status(link)
        link.close(abort=abort, then=0.5)
    link = bench.state()
    bench.status(link, 5)


@case("come-and-go", "many short connections")
def _many_come_and_go(bench: Bench) -> None:
    for _ in range(40):
        link = bench.motion()
        bench.run(0.03)
        link.close(then=0.03)
    _moves(bench)


def _pings(bench: Bench, link: RawLink, seconds: float = 0.1, *, slowly: bool = False) -> None:
    """PING and its reply; `slowly`: in single bytes."""
    data = encode(messages.RawPing(), RawComm.REQUEST)
    for byte in data[:-1] if slowly else b"":
        link.send(bytes([byte]))
        bench.run(0.012)
    link.send(data[-1:] if slowly else data)
    if not isinstance(link.reply(PING, seconds), messages.RawAcknowledged):
        raise Broken("PING is not confirmed")


def _silent(bench: Bench, old: RawLink, what: str, points: list[Point]) -> RawLink:
    """A newer client waits until the one before has been silent for a second, whatever moves."""
    place, stream = bench.position, Streamer(bench, old)
    if "stream" in what:
        stream.put(points, BEGIN)
    elif points:
        old.send(bench.download(points))
        bench.wait_until_moving(2)
    if what == "stopped stream":
        old.send(STOP)
    new = bench.motion()
    for slowly in (True, False):
        bench.run(0.75)
        _pings(bench, old, slowly=slowly)
    if what == "stream":
        # Its batches may come far apart, until it has ended, although it moves on.
        bench.run(2.5)
        stream.takes("a slow last point", [(place, 6.0)], END)
        points = [(place, 6.0)]
        bench.run(0.8)
        _pings(bench, old)
    last = bench.now
    bench.run(0.8)
    if what in ("fed", "download", "stream") and bench.standing:
        raise Broken(f"{what}: the robot does not move, though its client is there")
    old.wait_until_lost(3, f"a silent client gives way: {what}")
    if not 0.9 < bench.now - last < 1.4:
        raise Broken(f"{what}: a client gave way after {bench.now - last:.2f} s of silence")
    bench.wait_until_standing(3)
    if points and distance(bench.position, points[-1][0]) < SETTLED:
        raise Broken(f"{what}: the robot went on for a client that gave way")
    _pings(bench, new, 0.3)
    bench.stays(0.3, f"the client before gave way: {what}")
    return new


@case("silent-at-rest", "a newer client waits for a second of silence", "R12", needs="stream")
def _silent_at_rest(bench: Bench) -> None:
    old = bench.motion()
    for _ in range(2):
        _pings(bench, old)
        old = _silent(bench, old, "nothing", [])


@case(
    "silent-while-fed", "a client that is silent while its trajectory is fed", "R12", needs="stream"
)
def _silent_while_fed(bench: Bench) -> None:
    policy = bench.config.trajectory
    # Slow points: the last few do not find room in the ring for seconds.
    count = min(policy.ring + 5, policy.capacity)
    _silent(bench, bench.motion(), "fed", bench.wave(count, duration=1.5, size=0.1))


@case(
    "silent-while-moving",
    "a client that is silent while its trajectory or stream moves",
    "R12",
    needs="stream",
)
def _silent_while_moving(bench: Bench) -> None:
    """Over the other socket of the server, too."""
    place, old = bench.position, bench.motion()
    for what, count in (("stream", 4), ("download", 15), ("stopped stream", 4)):
        old = _silent(bench, old, what, bench.wave(count))
        bench.moves_through(old, bench.way_to(place))


@case("server-breaks", "a server socket that breaks is opened again")
def _server_breaks(bench: Bench) -> None:
    """A server socket that breaks is opened again."""
    network, ports = bench.controller.network, bench.group.ports
    bench.run(1)
    for module, port in (
        ("ROS_motionServer", ports.motion),
        ("ROS_control", ports.control),
        ("ROS_stateServer", ports.state),
    ):
        if not port:
            continue
        for _ in range(2):
            server = bench.controller.task(bench.task(module))[f"{module}:server"]
            network.close(server.endpoint)
            bench.run(1.2)
            link = bench.state() if port == ports.state else bench.motion()
            if port == ports.state:
                bench.status(link)
            elif port == ports.motion:
                _pings(bench, link, 0.3)
            else:
                _pings(bench, bench.control(), 0.3)
            link.close(then=0.2)
