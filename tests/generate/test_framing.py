"""Messages cut out of a stream of bytes, and what breaks it."""

import struct

import pytest

from tests.generate.bench import POINT, trajectory
from tests.generate.driving import FIVE, SECONDS, move_well


@pytest.mark.parametrize("length", [-1, 0, 11, 1021, 2**31 - 1, -(2**31), 63, 65])
def test_a_broken_length_drops_the_client_and_nobody_else(bench, length):
    """R2, R3: abb_driver's task halts on such bytes."""
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", length, 11, 1, 0) + bytes(60))
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    assert b.healthy()
    move_well(b)


@pytest.mark.parametrize("data", [b"\xff\xff\xff\xff", b"\x00\x00\x00\x80", b"\xff\x00\x00\x10"])
def test_four_wrong_bytes_are_enough(bench, data):
    b = bench()
    client = b.client()
    client.send(data)
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    move_well(b)


def test_an_unknown_message_is_skipped(bench):
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", 12 + 996, 999, 1, 0) + bytes(996))
    client.send(struct.pack("<4i", 16, 20, 2, 0) + bytes(4))
    assert client.wait_frame() == struct.pack("<4i", 12, 20, 3, 2)
    move_well(b, client)


def test_ping_is_answered(bench):
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", 12, 1, 2, 0))
    assert client.wait_frame() == struct.pack("<4i", 12, 1, 3, 1)


@pytest.mark.parametrize("comm", [0, 3, 7])
def test_a_point_that_is_neither_topic_nor_request(bench, comm):
    b = bench()
    client = b.client()
    client.send(POINT.pack(64, 11, comm, 0, -1, *[0.0] * 12))
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    move_well(b)


def test_random_bytes_never_move_the_robot(bench):
    import random

    b = bench()
    rng = random.Random(7)
    good = b"".join(trajectory(FIVE, SECONDS))
    for _ in range(60):
        client = b.client()
        data = bytearray(good)
        for _ in range(rng.randint(1, 4)):
            at = rng.randrange(0, 20)
            data[at] = rng.randrange(256)
        client.send(bytes(data[: rng.randrange(1, len(data) - 68)]))
        b.vc.run_for(0.05)
        client.close()
        b.vc.run_for(0.05)
        assert b.joints() == (0.0,) * 6
        assert b.healthy()
    move_well(b)
