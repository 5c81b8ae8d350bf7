"""Malformed messages."""

import random

from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import POINT_BYTES, RawComm, RawReplyCode
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import raw_point
from rapidgen.verification.testbench import Bench

case = SuiteGroup("framing")

ROUNDS = 60
"""Malformed messages in one run; `campaign` allows more."""


def _word(value: int) -> bytes:
    return (value & 0xFFFFFFFF).to_bytes(4, "little")


def _dropped_and_served(bench: Bench, junk: bytes) -> None:
    link = bench.motion()
    link.send(junk)
    link.wait_disconnected(5, "a client that breaks framing is dropped")
    _good_client(bench)


def _good_client(bench: Bench) -> None:
    link = bench.motion()
    bench.assert_moves_through(link, bench.wave(3, duration=0.2))
    link.close(then=0.1)


@case("wrong-lengths", "a length out of bounds drops the client, the next one is served", "R2, R3")
def _wrong_lengths(bench: Bench) -> None:
    for length in (-1, 0, 11, 1021, 65_536, 2**31 - 1, -(2**31)):
        _dropped_and_served(bench, _word(length))


@case("wrong-size", "a point of another size drops the client", "R3")
def _point_of_wrong_size(bench: Bench) -> None:
    for length in (12, 63, 65, 68):
        body = _word(length) + _word(11) + _word(1) + _word(0) + bytes(length - 12)
        _dropped_and_served(bench, body)


@case("wrong-comm-type", "a comm_type that is none drops the client")
def _wrong_comm_type(bench: Bench) -> None:
    good = bytearray(raw_point(-1, bench.position, 1.0))
    for comm in (0, 3, 7, -1):
        good[8:12] = _word(comm)
        _dropped_and_served(bench, bytes(good))


@case("unknown-types", "messages of other types are passed over", "R3")
def _unknown_types(bench: Bench) -> None:
    link = bench.motion()
    for number in (0, 2, 10, 13, 14, 20, 1399, -5):
        for length in (44, 12, 1020):
            data = _word(length) + _word(number) + _word(1) + _word(0) + bytes(length - 12)
            link.send(data)
            link.send(data[:500])
            bench.run(0.02)
            link.send(data[500:])
    bench.assert_moves_through(link, bench.wave(3))


@case("unknown-request", "a request of another type gets a failure reply")
def _unknown_request(bench: Bench) -> None:
    """Send it whole and in two pieces; a type that a num cannot hold is answered as type 0."""
    link = bench.motion()
    for number, reply in ((20, 20), (65_535, 65_535), (65_536, 0), (2**31 - 1, 0), (-1, 0)):
        data = _word(12) + _word(number) + _word(2) + _word(0)
        for pieces in ((data,), (data[:6], data[6:])):
            for piece in pieces:
                link.send(piece)
                bench.run(0.05)
            frame = link.expect_reply(2, f"a request of type {number} is answered")
            seen = (frame.number, frame.comm, frame.reply)
            if seen != (reply, RawComm.REPLY, RawReplyCode.FAILURE):
                raise CheckFailed(f"a request of type {number} is answered by {frame}")


@case("breaks-in-download", "garbage in a download: nothing moves")
def _breaks_in_a_download(bench: Bench) -> None:
    link = bench.motion()
    link.send(bench.download(bench.wave(6))[: 68 * 3 + 20] + b"\xff" * 64)
    bench.assert_at_rest(3, "the download broke off")
    _good_client(bench)


@case("half-header", "a client that leaves within a message", "R2")
def _half_header_and_end(bench: Bench) -> None:
    for size in (1, 3, 4, 15, 16, 67):
        link = bench.motion()
        link.send(raw_point(-1, bench.position, 1.0)[:size])
        bench.run(0.05)
        link.close(then=0.1)
        _good_client(bench)


@case("damage", "random damage moves nothing and stops no task", "R3")
def campaign(bench: Bench, rounds: int = ROUNDS) -> None:
    """Send malformed frames, each followed by a well-behaved client."""
    chance = random.Random(bench.setting.seed)
    for _ in range(rounds):
        data = malformed(bench, chance)
        link = bench.motion()
        link.send(data)
        bench.assert_at_rest(0.3, f"malformed: {data.hex()}")
        link.close(abort=chance.random() < 0.3, then=0.1)
        _good_client(bench)
        bench.forget()


def malformed(bench: Bench, chance: random.Random) -> bytes:
    """Return a damaged download without end, a wrong header, or noise."""
    kind = chance.randrange(4)
    if kind == 0:
        return chance.randbytes(chance.randrange(1, 300))
    if kind == 1:
        fields = [chance.choice((64, 12, 44, 63, 1020, 1021, chance.randrange(-9, 2000)))]
        fields += [chance.choice((11, 1, 10, 14, chance.randrange(-5, 1400)))]
        fields += [chance.choice((0, 1, 2, 3, 4, chance.randrange(-9, 99)))]
        fields += [chance.choice((0, 1, 2, chance.randrange(-9, 99)))]
        return b"".join(map(_word, fields)) + chance.randbytes(chance.randrange(0, 70))
    data = bytearray(bench.download(bench.wave(4)))
    # The end frame is always lost, so the robot must not move in any case.
    del data[-(POINT_BYTES - 4) - 4 :]
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(data))
        match chance.randrange(3):
            case 0:
                data[at] ^= 1 << chance.randrange(8)
            case 1:
                del data[at : at + chance.randrange(1, 80)]
            case _:
                data[at:at] = chance.randbytes(chance.randrange(1, 40))
        if not data:
            break
    return bytes(data)
