"""Batches of points and instructions as bytes, with checksums."""

import struct
from collections.abc import Sequence

from rapidgen.verification.messages import INDEX_WRAP, LONGEST, POINTS, RawComm, framed
from rapidgen.verification.position_checks import Point

_MODULUS = 2**31 - 19


def batch_points(joint_count: int) -> int:
    """Return the number of points that fit into one POINTS: 35 for six axes."""
    return (LONGEST - 12 - 20) // (4 * (1 + joint_count))


def points_frame(
    stream: int, first: int, points: Sequence[Point], flags: int = 0, comm: int = RawComm.REQUEST
) -> bytes:
    """Return one batch of a stream as a message."""
    values = [word for point in points for word in words_of(point)]
    return words_frame(stream, first % INDEX_WRAP, len(points), values, flags, comm)


def words_of(point: Point) -> list[int]:
    """Return the words of a point: s, rad and m in millionths."""
    joints, duration = point
    return millionths((duration, *joints))


def millionths(values: Sequence[float]) -> list[int]:
    """Return words for values in s, rad, m or without a unit."""
    numbers = [round(value * 1e6) for value in values]
    if not all(abs(number) < 2**31 for number in numbers):
        raise ValueError(f"{values} does not fit into a batch")
    return numbers


def words_frame(
    stream: int,
    first: int,
    count: int,
    values: Sequence[int],
    flags: int = 0,
    comm: int = RawComm.REQUEST,
    number: int = POINTS,
) -> bytes:
    """Return a batch with any words that claims `count` points.

    The checksum is correct.
    """
    complete = [stream, flags, first, count, *values]
    return framed(
        number, struct.pack(f"<{len(complete) + 1}i", *complete, checksum(complete)), comm
    )


def checksum(values: Sequence[int]) -> int:
    """Return the checksum of a batch's words, head included."""
    result = 0
    for word in values:
        result = (2 * result + word + 2**31) % _MODULUS
    return result


def words_to(expected: int, values: Sequence[int], count: int) -> list[int]:
    """Return `count` words after which the checksum equals `expected`."""
    zeros = [0] * (count - 1)
    return [*zeros, (expected - checksum([*values, *zeros, 0])) % _MODULUS]
