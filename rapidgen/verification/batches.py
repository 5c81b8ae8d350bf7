"""Batches of points and of instructions as the proof speaks them, with their checksums."""

import struct
from collections.abc import Sequence

from rapidgen.verification.messages import INDEX_WRAP, LONGEST, POINTS, RawComm, framed
from rapidgen.verification.position_checks import Point

_MODULUS = 2**31 - 19


def batch_points(joint_count: int) -> int:
    """Points that fit into one POINTS: 35 for six axes."""
    return (LONGEST - 12 - 20) // (4 * (1 + joint_count))


def points_frame(
    stream: int, first: int, points: Sequence[Point], flags: int = 0, comm: int = RawComm.REQUEST
) -> bytes:
    """A batch of a stream."""
    words = [word for point in points for word in words_of(point)]
    return words_frame(stream, first % INDEX_WRAP, len(points), words, flags, comm)


def words_of(point: Point) -> list[int]:
    """The words of a point: s, rad and m in millionths."""
    joints, duration = point
    return millionths((duration, *joints))


def millionths(values: Sequence[float]) -> list[int]:
    """Words for s, rad, m and numbers without a unit."""
    numbers = [round(value * 1e6) for value in values]
    if not all(abs(number) < 2**31 for number in numbers):
        raise ValueError(f"{values} does not fit into a batch")
    return numbers


def words_frame(
    stream: int,
    first: int,
    count: int,
    words: Sequence[int],
    flags: int = 0,
    comm: int = RawComm.REQUEST,
    number: int = POINTS,
) -> bytes:
    """A batch of any words, that says to have `count` points; its checksum is right."""
    whole = [stream, flags, first, count, *words]
    return framed(number, struct.pack(f"<{len(whole) + 1}i", *whole, checksum(whole)), comm)


def checksum(words: Sequence[int]) -> int:
    """What stands behind these words of a batch, of its head and of all that follows."""
    found = 0
    for word in words:
        found = (2 * found + word + 2**31) % _MODULUS
    return found


def words_to(wanted: int, words: Sequence[int], count: int) -> list[int]:
    """`count` words behind which the checksum is the one that is wanted."""
    zeros = [0] * (count - 1)
    return [*zeros, (wanted - checksum([*words, *zeros, 0])) % _MODULUS]
