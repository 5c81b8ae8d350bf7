"""POINTS: numpy against the codec, hand arithmetic and damage."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from rapidgen.wire.simple_message import ContentError, FrameSplitter, decode, encode, messages, spec
from rapidgen.wire.simple_message.numpy_codec import checksums, decode_batches, encode_points
from rapidgen.wire.simple_message.packing import steps_of
from rapidgen.wire.simple_message.spec import Comm, StreamFlag

# By hand: stream 3, BEGIN, first 0, one point of 0.1 s to joints 1e-6 and -1e-6.
WORDS = [3, 1, 0, 1, 100_000, 1, -1]
HAND = bytes.fromhex("2c000000 16050000 02000000 00000000") + struct.pack("<7i", *WORDS)


def horner(words):
    """The checksum as docs/develop/protocol.md has it."""
    check = 0
    for word in words:
        check = (2 * check + word + 2**31) % (2**31 - 19)
    return check


def test_bytes_by_hand():
    (frame,) = encode_points(3, 0, [0.1], [[1e-6, -1e-6]], flags=StreamFlag.BEGIN)
    assert frame == HAND + struct.pack("<i", horner(WORDS))
    (batch,) = decode_batches([frame], 2)
    assert batch[:3] == (3, 1, 0)
    assert batch.durations.tolist() == [0.1]
    assert batch.joints.tolist() == [[1e-6, -1e-6]]
    content = decode(_frame(frame))
    assert content == messages.Points(3, 1, 0, 1, (0.1, 1e-6, -1e-6), horner(WORDS))
    assert encode(content, Comm.REQUEST) == frame


def _frame(data):
    splitter = FrameSplitter()
    splitter.feed(data)
    return splitter.next()


@pytest.mark.parametrize(("axes", "most"), [(1, 123), (6, 35), (7, 30), (8, 27), (10, 22)])
def test_as_many_as_fit(axes, most):
    assert messages.batch_points(axes) == most
    frames = encode_points(1, 0, np.ones(most + 1), np.zeros((most + 1, axes)))
    assert [len(frame) for frame in frames] == [
        4 + messages.points_length(most, axes),
        4 + messages.points_length(1, axes),
    ]
    assert len(frames[0]) <= spec.MAX_MESSAGE_BYTES < 4 + messages.points_length(most + 1, axes)


STEPS = st.integers(1 - 2**31, 2**31 - 1)


@st.composite
def runs(draw):
    """Stream, first, steps of (n, 1 + k) numbers, batch, flags."""
    axes = draw(st.integers(1, 10))
    count = draw(st.integers(0, 90))
    steps = draw(hnp.arrays(np.int64, (count, 1 + axes), elements=STEPS))
    batch = draw(st.integers(1, messages.batch_points(axes)))
    stream = draw(st.integers(1, spec.INDEX_WRAP - 1))
    first = draw(st.integers(0, spec.INDEX_WRAP - 1))
    return stream, first, steps, batch, draw(st.integers(0, 7))


@given(runs())
def test_points_round_trip(run):
    stream, first, steps, batch, flags = run
    values = steps / spec.FIXED_SCALE
    frames = encode_points(stream, first, values[:, 0], values[:, 1:], flags=flags, batch=batch)
    assert len(frames) == max(1, -(-len(steps) // batch))
    result = decode_batches(frames, values.shape[1] - 1)
    assert np.concatenate([b.durations for b in result]).tolist() == values[:, 0].tolist()
    assert np.concatenate([b.joints for b in result]).tolist() == values[:, 1:].tolist()
    firsts = [(first + n * batch) % spec.INDEX_WRAP for n in range(len(frames))]
    assert [b.first for b in result] == firsts
    assert {b.stream for b in result} == {stream}
    assert result[0].flags & StreamFlag.BEGIN == flags & StreamFlag.BEGIN
    assert result[-1].flags | flags & StreamFlag.BEGIN == flags
    for frame, batch_of in zip(frames, result, strict=True):
        words = struct.unpack(f"<{(len(frame) - 16) // 4}i", frame[16:])
        assert words[-1] == horner(words[:-1])
        content = decode(_frame(frame))
        assert content.points == len(batch_of.durations)
        assert encode(content, Comm.REQUEST) == frame


@given(hnp.arrays(np.int32, st.tuples(st.integers(1, 3), st.integers(1, 250))))
def test_checksums_of_any_words(words):
    assert checksums(words) == [horner(row) for row in words.tolist()]


def test_checksum_steps_of_a_driver_are_exact_integers():
    """A point of ten axes at a time, as RAPID adds it up: far below 2^52."""
    words, largest = 1 + 10, 2**32 - 1
    assert 2**words * (spec.CHECKSUM_MODULUS - 1) + (2**words - 1) * largest < 2**44


def test_no_two_places_of_a_message_weigh_the_same():
    weights = {pow(2, place, spec.CHECKSUM_MODULUS) for place in range(256)}
    assert len(weights) == 256


@pytest.mark.parametrize("value", [2147.483648, -2147.483648, float("nan"), float("inf")])
def test_values_beyond_fixed_point_are_refused(value):
    with pytest.raises(ContentError):
        encode_points(1, 0, [0.1], [[0.0, value]])
    with pytest.raises(ContentError):
        encode_points(1, 0, [value], [[0.0, 0.0]])
    with pytest.raises(ContentError):
        steps_of(value)


FRAME = encode_points(9, 60, np.full(12, 0.25), np.linspace(-1, 1, 72).reshape(12, 6))[0]


@given(st.integers(128, 8 * len(FRAME) - 1))
def test_no_bit_may_be_wrong(bit):
    damaged = bytearray(FRAME)
    damaged[bit // 8] ^= 1 << bit % 8
    with pytest.raises(ContentError):
        decode_batches([bytes(damaged)], 6)


@given(st.integers(0, 82), st.integers(1, 5))
def test_no_words_may_be_moved(place, width):
    words = [FRAME[at : at + 4] for at in range(32, len(FRAME) - 4, 4)]
    moved = words[:]
    moved[place : place + width + 1] = reversed(moved[place : place + width + 1])
    if moved != words:
        with pytest.raises(ContentError):
            decode_batches([FRAME[:32] + b"".join(moved) + FRAME[-4:]], 6)


@given(st.binary(max_size=1100), st.integers(1, 10))
def test_random_bytes_are_no_points(data, axes):
    with pytest.raises(ContentError):
        decode_batches([data], axes)


@given(st.data())
def test_random_data_after_a_valid_head(data):
    body = data.draw(st.binary(max_size=1000))
    frame = struct.pack("<4i", 12 + len(body), 1302, 2, 0) + body
    for read in (lambda: decode_batches([frame], 6), lambda: decode(_frame(frame))):
        try:
            read()
        except ContentError:
            continue


def test_joints_and_counts():
    (frame,) = encode_points(1, 0, [0.1], [[0.1] * 7])
    for joints in (6, 8):
        with pytest.raises(ContentError, match=f"no POINTS of {joints}"):
            decode_batches([frame], joints)
    words = list(struct.unpack("<13i", frame[16:]))
    words[3] += 1
    words[-1] = horner(words[:-1])
    with pytest.raises(ContentError, match="count"):
        decode_batches([frame[:16] + struct.pack("<13i", *words)], 7)
    for arguments in (
        ([0.1], [[0.0] * 11]),
        ([0.1], [[]]),
    ):
        with pytest.raises(ValueError, match="joints"):
            encode_points(1, 0, *arguments)
    with pytest.raises(ValueError, match="do not fit"):
        encode_points(1, 0, [0.1] * 36, [[0.0] * 6] * 36, batch=36)
