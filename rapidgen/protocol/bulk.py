"""Trajectories to bytes by numpy: a million points a second. Import it where it is needed."""

from collections.abc import Sequence as Rows
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from rapidgen.protocol import spec
from rapidgen.protocol.frames import ContentError
from rapidgen.protocol.spec import (
    CHECKSUM_MODULUS,
    INDEX_WRAP,
    PAIR_BASE,
    PAIR_BITS,
    PAIR_LIMIT,
    PAIR_SCALE,
    PAIR_ZERO,
    Comm,
    ReplyCode,
    Sequence,
    StreamFlag,
    Wire,
)

Words = npt.NDArray[np.uint64]

_TYPES = {Wire.INT32: "<i4", Wire.FLOAT32: "<f4"}
FRAME_BYTES = spec.PREFIX_BYTES + spec.JOINT_TRAJ_PT.length


def _frame_type() -> np.dtype[Any]:
    head: list[Any] = [(name, "<i4") for name in ("length", "number", "comm", "reply")]
    fields: list[Any] = [
        (f.name, _TYPES[f.type], (f.count,)) if f.count > 1 else (f.name, _TYPES[f.type])
        for f in spec.JOINT_TRAJ_PT.fields
    ]
    return np.dtype(head + fields)


POINT_FRAME = _frame_type()
"""One JOINT_TRAJ_PT frame as a structured numpy type, without gaps."""


def encode_trajectory(
    joints: npt.ArrayLike, durations: npt.ArrayLike, *, request_end: bool = True
) -> bytes:
    """All frames of a trajectory: the first -1, the last -3, 1, 2, 3, ... between.

    `joints` is (n, k) controller axis values, rad or m, n >= 2, k <= 10; `durations` (n,) s.
    With `request_end` the end frame is a request, which the driver answers; a topic otherwise.
    """
    positions = np.asarray(joints, dtype=np.float64)
    count, axes = positions.shape
    if count < 2 or axes > spec.MAX_JOINTS:
        raise ValueError(f"{count} points of {axes} joints")
    frames = np.zeros(count, dtype=POINT_FRAME)
    frames["length"] = spec.JOINT_TRAJ_PT.length
    frames["number"] = spec.JOINT_TRAJ_PT.number
    frames["comm"] = Comm.TOPIC
    frames["reply"] = ReplyCode.NONE
    frames["sequence"] = np.arange(count)
    frames["sequence"][0] = Sequence.START_DOWNLOAD
    frames["sequence"][-1] = Sequence.END
    frames["joints"][:, :axes] = positions
    frames["duration"] = durations
    if request_end:
        frames["comm"][-1] = Comm.REQUEST
    return frames.tobytes()


def decode_points(data: bytes) -> npt.NDArray[Any]:
    """Whole JOINT_TRAJ_PT frames as an array of POINT_FRAME: for sinks and recordings."""
    return np.frombuffer(data, dtype=POINT_FRAME)


_WORD = np.dtype("<u8")
_HALF = np.uint64(PAIR_BITS)
_LOW = np.uint64(PAIR_BASE - 1)
_UPPER = np.uint64(32)
_MODULUS = np.uint64(CHECKSUM_MODULUS)
_SQUARE = np.uint64(PAIR_BASE**2 % CHECKSUM_MODULUS)
_HEAD = (spec.PREFIX_BYTES + spec.HEADER_BYTES) // _WORD.itemsize
"""Words before the data."""
_PAIRS = _HEAD + 2
"""Words before the pairs: stream and flags, first and count enter the checksum too."""
# 2^k modulo the checksum's modulus, for every place that a word of a message can have.
_POWERS = np.array(
    [pow(2, k, CHECKSUM_MODULUS) for k in range(spec.MAX_MESSAGE_BYTES // _WORD.itemsize)],
    dtype=np.uint64,
)


class Batch(NamedTuple):
    """What one POINTS frame holds: `durations` (n,) s, `joints` (n, k) rad or m."""

    stream: int
    flags: int
    first: int
    durations: npt.NDArray[np.float64]
    joints: npt.NDArray[np.float64]


def checksums(words: Words) -> Words:
    """The checksum of each row of (n, m) words, m <= 128.

    It is linear, the sum of word i * 2^(m-1-i), and so three sums of products of 26-bit halves.
    None of them reaches 2^60: everything is exact in 64 bits.
    """
    reduced = words % _MODULUS
    powers = _POWERS[: words.shape[1]][::-1]
    high, low = reduced >> _HALF, reduced & _LOW
    power_high, power_low = powers >> _HALF, powers & _LOW
    top = (high @ power_high) % _MODULUS * _SQUARE % _MODULUS
    middle = (high @ power_low + low @ power_high) % _MODULUS
    for _ in range(2):
        middle = (middle << np.uint64(PAIR_BITS // 2)) % _MODULUS
    total: Words = (top + middle + low @ power_low) % _MODULUS
    return total


def encode_points(
    stream: int,
    first: int,
    durations: npt.ArrayLike,
    joints: npt.ArrayLike,
    *,
    flags: int = 0,
    batch: int | None = None,
    request: bool = True,
) -> list[bytes]:
    """Points `first`, `first` + 1, ... of a stream as POINTS frames; a frame also for no point.

    `durations` (n,) s and `joints` (n, k) controller axis values, rad or m, k <= 10; `batch` is
    how many points a frame takes, by default as many as fit. BEGIN goes to the first frame, END
    and FLUSH to the last. Raises ContentError for what a pair cannot hold.
    """
    values = np.asarray(joints, dtype=np.float64)
    count, axes = values.shape
    if not 1 <= axes <= spec.MAX_JOINTS:
        raise ValueError(f"points of {axes} joints")
    most = spec.batch_points(axes)
    size = most if batch is None else batch
    if not 1 <= size <= most:
        raise ValueError(f"{size} points in one message: at most {most}")
    words = _words(np.asarray(durations, dtype=np.float64), values)
    whole = count - count % size
    blocks = []
    if whole:
        blocks.append(_frames(stream, first, words[:whole], size, axes, request))
    if whole < count or not count:
        rest = _frames(stream, first + whole, words[whole:], count - whole, axes, request)
        blocks.append(rest)
    blocks[0][0, _HEAD] |= np.uint64(flags & StreamFlag.BEGIN) << _UPPER
    blocks[-1][-1, _HEAD] |= np.uint64(flags & ~StreamFlag.BEGIN) << _UPPER
    for block in blocks:
        block[:, -1] = checksums(block[:, _HEAD:-1])
    return [frame.tobytes() for block in blocks for frame in block]


def _words(durations: npt.NDArray[np.float64], joints: npt.NDArray[np.float64]) -> Words:
    """(n, pairs) words of n points."""
    count, axes = joints.shape
    numbers = np.zeros((count, 2 * spec.point_pairs(axes)))
    numbers[:, 0] = durations
    numbers[:, 1 : 1 + axes] = joints
    # Written so that NaN does not pass.
    if not np.all(np.abs(numbers) <= PAIR_LIMIT):
        raise ContentError(f"values beyond {PAIR_LIMIT}, or none at all")
    steps = (np.rint(numbers * PAIR_SCALE) + PAIR_ZERO).astype(np.uint64)
    words: Words = steps[:, ::2] << _HALF | steps[:, 1::2]
    return words


def _frames(stream: int, first: int, words: Words, size: int, axes: int, request: bool) -> Words:
    """Frames of `size` points each, (n, words of a frame), without flags and checksum."""
    count = len(words) // size if size else 1
    width = size * words.shape[1]
    frames = np.zeros((count, _PAIRS + width + 1), dtype=_WORD)
    comm = Comm.REQUEST if request else Comm.TOPIC
    indices = (first + size * np.arange(count, dtype=np.int64)) % INDEX_WRAP
    frames[:, 0] = spec.points_length(size, axes) | spec.POINTS.number << 32
    frames[:, 1] = comm | ReplyCode.NONE << 32
    frames[:, _HEAD] = stream
    frames[:, _HEAD + 1] = indices.astype(np.uint64) | np.uint64(size << 32)
    frames[:, _PAIRS:-1] = words.reshape(count, width)
    return frames


def decode_batches(data: Rows[bytes], axes: int) -> list[Batch]:
    """POINTS frames of a robot with `axes` joints, one or many, each whole.

    Raises ContentError for one that a driver would refuse as a whole: another type or length, a
    wrong checksum, a word that is no pair, padding that is not zero.
    """
    found: list[Batch] = []
    for length, same in groupby(data, len):
        block = list(same)
        if length < _WORD.itemsize * (_PAIRS + 1) or length % _WORD.itemsize:
            raise ContentError(f"a frame of {length} bytes is no POINTS")
        frames = np.frombuffer(b"".join(block), dtype=_WORD).reshape(len(block), -1)
        found += _batches(frames, axes)
    return found


def _batches(frames: Words, axes: int) -> list[Batch]:
    pairs = spec.point_pairs(axes)
    count, rest = divmod(frames.shape[1] - _PAIRS - 1, pairs)
    length = spec.points_length(count, axes)
    if rest or np.any(frames[:, 0] != (length | spec.POINTS.number << 32)):
        raise ContentError(f"no POINTS of {axes} joints")
    if np.any(frames[:, _HEAD + 1] >> _UPPER != count):
        raise ContentError("the count does not fit the length")
    if np.any(frames[:, -1] != checksums(frames[:, _HEAD:-1])):
        raise ContentError("the checksum is wrong")
    words = frames[:, _PAIRS:-1]
    if np.any(words >> np.uint64(2 * PAIR_BITS)):
        raise ContentError("a word is no pair")
    steps = np.stack([words >> _HALF, words & _LOW], axis=-1).astype(np.int64) - PAIR_ZERO
    steps = steps.reshape(len(frames), count, 2 * pairs)
    if np.any(steps[:, :, 1 + axes :]):
        raise ContentError("a joint that the robot does not have is not zero")
    numbers = steps / PAIR_SCALE
    heads = frames[:, _HEAD : _HEAD + 2].copy().view("<i4").tolist()
    return [
        Batch(stream, flags, first, points[:, 0], points[:, 1 : 1 + axes])
        for (stream, flags, first, _), points in zip(heads, numbers, strict=True)
    ]
