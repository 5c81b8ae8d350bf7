"""Encode trajectories with numpy: a million points a second.

Import it only where needed.
"""

from collections.abc import Sequence as Rows
from itertools import groupby
from struct import Struct
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rapidgen.wire.simple_message import messages, spec
from rapidgen.wire.simple_message.declaration import Wire
from rapidgen.wire.simple_message.frames import ContentError
from rapidgen.wire.simple_message.spec import (
    CHECKSUM_MODULUS,
    CHECKSUM_OFFSET,
    FIXED_LIMIT,
    FIXED_SCALE,
    INDEX_WRAP,
    Comm,
    ReplyCode,
    Sequence,
    StreamFlag,
)

Words = npt.NDArray[np.int32]

_TYPES = {Wire.INT32: "<i4", Wire.FLOAT32: "<f4"}
FRAME_BYTES = spec.PREFIX_BYTES + messages.JOINT_TRAJ_PT.length


def _frame_type() -> "np.dtype[np.void]":  # cannot be subscripted in NumPy 1.21
    head = [(name, "<i4", ()) for name in ("length", "number", "comm", "reply")]
    fields = [
        (f.name, _TYPES[f.type], (f.count,) if f.count > 1 else ())
        for f in messages.JOINT_TRAJ_PT.fields
    ]
    return np.dtype([*head, *fields])


POINT_FRAME = _frame_type()
"""One JOINT_TRAJ_PT frame as a structured numpy type, without gaps."""


def encode_trajectory(
    joints: npt.ArrayLike, durations: npt.ArrayLike, *, request_end: bool = True
) -> bytes:
    """Return all frames of a trajectory.

    The first has the number -1, the last -3, 1, 2, 3, ... between. `joints` is (n, k) controller
    axis values, rad or m, n >= 2, k <= 10; `durations` (n,) s. With `request_end` the end frame is
    a request, which the driver answers; a topic otherwise.
    """
    positions = np.asarray(joints, dtype=np.float64)
    count, axes = positions.shape
    if count < 2 or axes > spec.MAX_JOINTS:
        raise ValueError(f"{count} points of {axes} joints")
    frames = np.zeros(count, dtype=POINT_FRAME)
    frames["length"] = messages.JOINT_TRAJ_PT.length
    frames["number"] = messages.JOINT_TRAJ_PT.number
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


def decode_points(data: bytes) -> npt.NDArray[np.void]:
    """Return whole JOINT_TRAJ_PT frames as an array of POINT_FRAME.

    For sinks and recordings.
    """
    return np.frombuffer(data, dtype=POINT_FRAME)


_WORD = np.dtype("<i4")
_BATCH_HEAD = Struct("<8i")
_CHECKSUM = Struct("<i")
_POINTS, _PROGRAM = messages.POINTS.number, messages.PROGRAM.number
_REQUEST, _TOPIC, _NONE = int(Comm.REQUEST), int(Comm.TOPIC), int(ReplyCode.NONE)
_HEAD = (spec.PREFIX_BYTES + spec.HEADER_BYTES) // _WORD.itemsize
"""Words before the data."""
_VALUES = _HEAD + 4
"""Words before the values: stream, flags, first and points are part of the checksum."""
# 2^k modulo the checksum's modulus, for every word position of a message, in halves whose products
# with a word of 32 bits can be summed in 64.
_HALF = 16
_POWERS = np.array(
    [pow(2, k, CHECKSUM_MODULUS) for k in reversed(range(spec.MAX_MESSAGE_BYTES // 4))],
    dtype=np.int64,
)
_POWERS_HIGH, _POWERS_LOW = _POWERS >> _HALF, _POWERS & ((1 << _HALF) - 1)


class Batch(NamedTuple):
    """Content of one POINTS frame.

    `durations` (n,) s, `joints` (n, k) rad or m.
    """

    stream: int
    flags: int
    first: int
    durations: npt.NDArray[np.float64]
    joints: npt.NDArray[np.float64]


def checksums(words: Words) -> list[int]:
    """Return the checksum of each row of (n, m) words, m <= 256.

    It is linear, the sum of (word i + 2^31) * 2^(m-1-i), and so two sums of products of 32 and at
    most 16 bits, 256 of them: none reaches 2^57, and everything is exact in 64 bits.
    """
    shifted = words.astype(np.int64) + CHECKSUM_OFFSET
    width = words.shape[1]
    high = (shifted @ _POWERS_HIGH[-width:]) % CHECKSUM_MODULUS
    low = shifted @ _POWERS_LOW[-width:]
    result: list[int] = (((high << _HALF) + low) % CHECKSUM_MODULUS).tolist()
    return result


def pack_points(durations: npt.ArrayLike, joints: npt.ArrayLike) -> Words:
    """Return (n, 1 + k) words of n points.

    `durations` (n,) s, `joints` (n, k) rad or m, k <= 10. Raises ContentError for values that a
    fixed-point number cannot hold.
    """
    values = np.asarray(joints, dtype=np.float64)
    count, axes = values.shape
    if not 1 <= axes <= spec.MAX_JOINTS:
        raise ValueError(f"points of {axes} joints")
    numbers = np.zeros((count, messages.point_values(axes)))
    numbers[:, 0] = durations
    numbers[:, 1:] = values
    # Written so that NaN does not pass.
    if not np.all(np.abs(numbers) <= FIXED_LIMIT):
        raise ContentError(f"values beyond {FIXED_LIMIT}, or none at all")
    words: Words = np.rint(numbers * FIXED_SCALE).astype(_WORD)
    return words


def points_frame(
    stream: int, first: int, words: Words, *, flags: int = 0, request: bool = True
) -> bytes:
    """Return points `first`, `first` + 1, ... as one POINTS frame."""
    return _sealed([_unsealed(stream, first, words, flags, request)])[0]


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
    """Return points `first`, `first` + 1, ... of a stream as POINTS frames.

    One frame for no point. As `pack_points`; `batch` is the number of points in a frame, by default
    as many as fit. BEGIN goes to the first frame, END and FLUSH to the last.
    """
    words = pack_points(durations, joints)
    size = messages.batch_points(words.shape[1] - 1) if batch is None else batch
    starts = range(0, len(words), size) if len(words) else range(1)
    every = [0] * len(starts)
    every[0] |= flags & StreamFlag.BEGIN
    every[-1] |= flags & ~StreamFlag.BEGIN
    return _sealed(
        [
            _unsealed(stream, first + at, words[at : at + size], own, request)
            for at, own in zip(starts, every, strict=True)
        ]
    )


def _unsealed(stream: int, first: int, words: Words, flags: int, request: bool) -> bytes:
    """Return a POINTS frame without its checksum."""
    comm = _REQUEST if request else _TOPIC
    return _batch(_POINTS, comm, (stream, flags, first % INDEX_WRAP, len(words)), words)


def program_frame(
    program: int, first: int, instructions: Rows[Rows[int]], *, flags: int = 0
) -> bytes:
    """Return instructions `first`, `first` + 1, ... as one PROGRAM frame.

    With BEGIN the first of them has the program's start position before its own words.
    """
    words = np.array([word for one in instructions for word in one], dtype=_WORD)
    head = (program, flags, first % INDEX_WRAP, len(instructions))
    return _sealed([_batch(_PROGRAM, _REQUEST, head, words)])[0]


def _batch(number: int, comm: int, head: tuple[int, int, int, int], words: Words) -> bytes:
    """Return a batch without its checksum.

    `head` holds stream, flags, first and count.
    """
    length = messages.POINTS.length + words.nbytes
    if length > spec.MAX_LENGTH:
        raise ValueError(f"{head[-1]} points or instructions do not fit in one message")
    return _BATCH_HEAD.pack(length, number, comm, _NONE, *head) + words.tobytes()


def _sealed(frames: Rows[bytes]) -> list[bytes]:
    """Return frames with their checksums.

    Only the last one may have another length.
    """
    result = []
    for same in (frames[:-1], frames[-1:]):
        if same:
            words = np.frombuffer(b"".join(same), dtype=_WORD).reshape(len(same), -1)
            pairs = zip(same, checksums(words[:, _HEAD:]), strict=True)
            result += [frame + _CHECKSUM.pack(checksum) for frame, checksum in pairs]
    return result


def decode_batches(data: Rows[bytes], axes: int) -> list[Batch]:
    """Decode POINTS frames of a robot with `axes` joints, each whole.

    Raises ContentError for one that a driver would reject as a whole: another type or length, a
    wrong checksum.
    """
    result: list[Batch] = []
    for length, same in groupby(data, len):
        block = list(same)
        if length < _WORD.itemsize * (_VALUES + 1) or length % _WORD.itemsize:
            raise ContentError(f"a frame of {length} bytes is no POINTS")
        frames = np.frombuffer(b"".join(block), dtype=_WORD).reshape(len(block), -1)
        result += _batches(frames, axes)
    return result


def _batches(frames: Words, axes: int) -> list[Batch]:
    width = messages.point_values(axes)
    count, remaining = divmod(frames.shape[1] - _VALUES - 1, width)
    length = messages.points_length(count, axes)
    if remaining or np.any(frames[:, :2] != (length, messages.POINTS.number)):
        raise ContentError(f"no POINTS of {axes} joints")
    if np.any(frames[:, _VALUES - 1] != count):
        raise ContentError("the count does not fit the length")
    if frames[:, -1].tolist() != checksums(frames[:, _HEAD:-1]):
        raise ContentError("the checksum is wrong")
    numbers = frames[:, _VALUES:-1].reshape(len(frames), count, width) / FIXED_SCALE
    heads = frames[:, _HEAD : _VALUES - 1].tolist()
    return [
        Batch(stream, flags, first, points[:, 0], points[:, 1:])
        for (stream, flags, first), points in zip(heads, numbers, strict=True)
    ]
