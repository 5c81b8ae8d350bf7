"""Invalid first messages on every port: the next client is served."""

import random
from collections.abc import Callable

from rapidgen.verification import messages
from rapidgen.verification.boundary import drawn
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawAcknowledged
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import RawLink, raw_point
from rapidgen.verification.suite.framing import malformed
from rapidgen.verification.testbench import Bench

case = SuiteGroup("framing")

ROUNDS = 40
"""Random first messages in one run; `campaign` allows more."""
_FOREIGN = (
    b"GET / HTTP/1.1\r\nHost: 192.168.125.1:11000\r\n\r\n",
    b"SSH-2.0-OpenSSH_9.6\r\n",
    bytes.fromhex("16030100c8010000c40303") + bytes(range(200)),
    b"\xff" * 8,
    b"\x7f" * 64,
    b"\x00" * 300,
)
_KINDS = (
    *(messages.HELLO, messages.POINTS, messages.PAUSE, messages.SPEED, messages.HEARTBEAT),
    *(messages.SIGNAL, messages.JOINT_TRAJ_PT, messages.PING, messages.STOPPED),
)
_Serve = Callable[[Bench], None]


def _replying(bench: Bench) -> bytes:
    """Return a point with the reply code -1."""
    return raw_point(-1, bench.position, 1.0)[:12] + b"\xff" * 4 + bytes(52)


def _headed(chance: random.Random) -> bytes:
    """Return a known message type with random data, often of valid length."""
    number = chance.choice(_KINDS)
    size = chance.choice((0, 4, 12, 20, 24, 52, chance.randrange(0, 200)))
    data = b"".join(chance.choice((bytes(4), b"\xff" * 4, chance.randbytes(4))) for _ in range(50))
    return messages.framed(number, data[:size], chance.choice((1, 2, 2, 3)))


def _motion(bench: Bench) -> None:
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(3, duration=0.2))
    link.close(then=0.1)


def _state(bench: Bench) -> None:
    link = bench.watcher()
    bench.progress(link)
    link.close(then=0.1)


def _control(bench: Bench) -> None:
    link = bench.control()
    if not isinstance(link.ask(messages.RawPing()), RawAcknowledged):
        raise CheckFailed("PING on the control port is not confirmed")
    link.close(then=0.1)


def _doors(bench: Bench) -> dict[str, tuple[Callable[[], RawLink], _Serve]]:
    """Return the driver's ports, with connect and check functions."""
    result: dict[str, tuple[Callable[[], RawLink], _Serve]] = {
        "motion": (bench.motion, _motion),
        "state": (bench.state, _state),
    }
    if bench.group.ports.control:
        result["control"] = (bench.control, _control)
    return result


def _opens(bench: Bench, port: str, data: bytes, chance: random.Random) -> None:
    connect, serve = _doors(bench)[port]
    link = connect()
    link.send(data)
    bench.assert_at_rest(0.3, f"on the {port} port: {data.hex()}")
    link.close(abort=chance.random() < 0.3, then=0.1)
    try:
        bench.assert_healthy()
        serve(bench)
    except CheckFailed as error:
        raise CheckFailed(f"after {data.hex()} on the {port} port: {error}") from error
    bench.forget()


@case("foreign-openings", "who speaks another protocol ends no task, on any port", "R3")
def _others(bench: Bench) -> None:
    chance = random.Random(bench.setting.seed)
    for port in _doors(bench):
        for data in (*_FOREIGN, _replying(bench)):
            _opens(bench, port, data, chance)


@case("hostile-openings", "random messages on every port end no task", "R3")
def campaign(bench: Bench, rounds: int = ROUNDS, boundary: float = 0.0) -> None:
    """Send random, malformed and noise messages, each followed by a check.

    `boundary`: share of messages of which half of the fields have boundary values.
    """
    chance = random.Random(bench.setting.seed)
    for _ in range(rounds):
        port = chance.choice(list(_doors(bench)))
        if boundary and chance.random() < boundary:
            _opens(bench, port, drawn(bench.config, chance), chance)
            continue
        data = _headed(chance) if chance.random() < 0.5 else malformed(bench, chance)
        _opens(bench, port, data, chance)
