"""Connections that open, close, hang and replace each other."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import (
    PING,
    RawComm,
    RawReason,
    RawTrajectoryState,
    decode,
    encode,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, changed, distance
from rapidgen.verification.raw_connection import STOP, RawLink, point_frame, raw_point
from rapidgen.verification.stream import BEGIN, END, FLUSH, Streamer
from rapidgen.verification.testbench import Bench

case = SuiteGroup("links")


@case("leaves-in-download", "a client that leaves in its download moves nothing")
def _leaves_in_a_download(bench: Bench) -> None:
    for abort in (False, True):
        link = bench.motion()
        link.send(bench.download(bench.wave(8))[: 68 * 5])
        bench.run(0.2)
        link.close(abort=abort)
        bench.assert_at_rest(3, "its client left in the download")
        _has_no_start(bench)
        _moves(bench)


def _has_no_start(bench: Bench) -> None:
    """Data of one client does not count for the next one."""
    link = bench.motion()
    link.send(raw_point(5, bench.position, 1.0, RawComm.REQUEST))
    reply = decode(link.expect_reply(2, "a point without a start is answered"))
    if not isinstance(reply, messages.RawRefused) or reply.reason != RawReason.NO_START:
        raise CheckFailed(f"a point without a start is answered by {reply}")
    link.close(then=0.2)


@case("leaves-moving", "the robot does not go on for a client that has left")
def _leaves_while_moving(bench: Bench) -> None:
    for abort in (False, True):
        points = bench.wave(20)
        link = bench.motion()
        bench.start_motion(link, points, 0.5)
        link.close(abort=abort)
        bench.wait_until_standing(5)
        if distance(bench.position, points[-1][0]) < 1e-4:
            raise CheckFailed("the robot went on to the end for a client that had left")
        bench.assert_at_rest(2, "its client is gone")
        _moves(bench)


def _moves(bench: Bench) -> None:
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(3, duration=0.2))
    link.close(then=0.2)


@case("idle-client", "an idle client is never timed out")
def _idle_client(bench: Bench) -> None:
    link = bench.motion()
    bench.assert_at_rest(900, "no client asked for anything")
    bench.assert_moves_through(link, bench.wave(4))


@case("newest-takes-over", "the newest client is served", "R12")
def _newest_takes_over(bench: Bench) -> None:
    old = bench.motion()
    bench.assert_moves_through(old, bench.wave(3))
    new = bench.motion()
    bench.run(5)
    bench.assert_moves_through(new, bench.wave(3))


@case("dead-peer", "a peer that died silently blocks no other client", "R12")
def _dead_peer(bench: Bench) -> None:
    old = bench.motion()
    bench.assert_moves_through(old, bench.wave(3))
    # It sends nothing more, not even a FIN: the old connection stays half-open.
    for _ in range(3):
        fresh = bench.motion()
        bench.run(5)
        bench.assert_moves_through(fresh, bench.wave(3))


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
    """Send PING and read its reply; `slowly`: in single bytes."""
    data = encode(messages.RawPing(), RawComm.REQUEST)
    for byte in data[:-1] if slowly else b"":
        link.send(bytes([byte]))
        bench.run(0.012)
    link.send(data[-1:] if slowly else data)
    if not isinstance(link.reply(PING, seconds), messages.RawAcknowledged):
        raise CheckFailed("PING is not confirmed")


def _gives_way(bench: Bench, old: RawLink, new: RawLink, what: str) -> None:
    """Let a newer client wait until the old one is silent for a second."""
    for slowly in (True, False):
        bench.run(0.75)
        _pings(bench, old, slowly=slowly)
    last = bench.now
    bench.run(0.8)
    old.wait_disconnected(3, f"a silent client gives way: {what}")
    if not 0.9 < bench.now - last < 1.4:
        raise CheckFailed(f"{what}: a client gave way after {bench.now - last:.2f} s of silence")
    _pings(bench, new, 0.3)
    bench.assert_at_rest(0.3, f"the client before gave way: {what}")


@case("silent-at-rest", "a newer client waits for a second of silence", "R12")
def _silent_at_rest(bench: Bench) -> None:
    old = bench.motion()
    for _ in range(2):
        _pings(bench, old)
        new = bench.motion()
        _gives_way(bench, old, new, "nothing moves")
        old = new


def _sets_off(bench: Bench, link: RawLink, what: str) -> list[Point]:
    """Start a long trajectory and return its points."""
    policy = bench.config.trajectory
    if what == "fed":
        # Slow points: the last few do not fit into the ring for a while.
        points = bench.wave(min(policy.ring + 5, policy.capacity), duration=1.0, size=0.1)
    else:
        points = bench.wave(9, duration=0.6)
    if what == "stream":
        Streamer(bench, link).put(points, BEGIN | FLUSH | END)
        bench.wait_until_moving()
    else:
        bench.start_motion(link, points)
    return points


@case("silent-while-moving", "a new connection stops no motion", "R12")
def _silent_while_moving(bench: Bench) -> None:
    """Keep a trajectory with a silent client running.

    Other connections and invalid messages do not stop it.
    """
    for what in ("download", "stream") if bench.streams else ("download",):
        old, since = bench.motion(), bench.now
        points = _sets_off(bench, old, what)
        for log_entries in (
            b"GET / HTTP/1.1\r\nHost: robot\r\n\r\n",
            b"\xff" * 100,
            b"",
            _PING,
            None,
        ):
            new = bench.motion()
            if log_entries is None:
                break
            new.send(log_entries)
            bench.run(0.3)
            if bench.standing:
                raise CheckFailed(
                    f"{what}: a newer client says {log_entries!r}, and the robot stops"
                )
            new.close()
        bench.arrives(points, since, 30)
        # For the driver the motion ends when the controller says so: the axes follow late.
        bench.run(0.2 - bench.setting.motion.servo_lag)
        _gives_way(bench, old, new, what)
        new.close(then=1.3)


_PING = encode(messages.RawPing(), RawComm.REQUEST)


@case("second-stops", "a second client's STOP stops, and its trajectory takes over", "R5, R12")
def _second_stops(bench: Bench) -> None:
    """Send STOP from a second client, byte by byte and after other data.

    The first client may do anything meanwhile.
    """
    old, watcher = bench.motion(), bench.watcher()
    paths = ("download", "stream", "fed") if bench.streams else ("download", "download", "fed")
    for number, what in enumerate(paths):
        _sets_off(bench, old, what)
        bench.run(0.3)
        new = bench.motion()
        bench.run(0.2)
        if number == 1:
            for byte in (_PING + STOP)[:-1]:
                new.send(bytes([byte]))
                bench.run(0.003)
            bench.run(0.3)
            if bench.standing:
                raise CheckFailed("a STOP of which the last byte is missing stops the robot")
            new.send(STOP[-1:])
        else:
            new.send(STOP)
        requested = bench.now
        bench.wait_until_standing(1)
        if bench.now - requested > 0.6 + bench.setting.motion.settle:
            raise CheckFailed(f"{what}: a second client's STOP takes {bench.now - requested:.2f} s")
        if number == 1 and not isinstance(new.reply(PING, 1), messages.RawAcknowledged):
            raise CheckFailed("the PING in front of a second client's STOP is not answered")
        if not isinstance(new.reply(messages.JOINT_TRAJ_PT, 1), messages.RawAcknowledged):
            raise CheckFailed(f"{what}: a second client's STOP is not confirmed")
        bench.assert_at_rest(1, f"{what}: a second client has sent STOP")
        answer = bench.progress(watcher)
        if (answer.state, answer.reason) != (RawTrajectoryState.STOPPED, RawReason.STOPPED):
            raise CheckFailed(f"{what}: a second client has sent STOP, PROGRESS says {answer}")
        bench.assert_moves_through(new, bench.wave(3))
        old = new
    # Its own trajectory replaces the current one, and starts where that has stopped.
    _sets_off(bench, old, "download")
    new, far = bench.motion(), changed(bench.position, 0, bench.position[0] + 0.5)
    new.send(point_frame(0, 2, far, 3.0) + point_frame(1, 2, far, 3.0))
    bench.wait_until_standing(3)
    bench.assert_at_rest(1, "a second client's trajectory begins elsewhere")
    bench.assert_moves_through(new, bench.wave(3))


@case("server-breaks", "a server socket that breaks is opened again")
def _server_breaks(bench: Bench) -> None:
    """Break a server socket: the driver opens it again."""
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
