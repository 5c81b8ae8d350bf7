"""POINTS: numpy against the codec, against arithmetic written by hand, and against damage."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from rapidgen.wire.simple_message import ContentError, FrameSplitter, decode, encode, messages, spec
from rapidgen.wire.simple_message.bulk import checksums, decode_batches, encode_points
from rapidgen.wire.simple_message.packing import pair_of, word_of
from rapidgen.wire.simple_message.spec import Comm, StreamFlag

# By hand: stream 3, BEGIN, first 0, one point of 0.1 s to joints 1e-6 and -1e-6.
WORDS = [
    3 + (1 << 32),
    0 + (1 << 32),
    (100_000 + 2**25 << 26) + 2**25 + 1,
    (2**25 - 1 << 26) + 2**25,
]
HAND = bytes.fromhex("34000000 16050000 02000000 00000000") + struct.pack("<4Q", *WORDS)


def horner(words):
    """The checksum as docs/develop/protocol.md has it."""
    check = 0
    for word in words:
        check = (2 * check + word) % (2**51 - 129)
    return check


def test_bytes_by_hand():
    (frame,) = encode_points(3, 0, [0.1], [[1e-6, -1e-6]], flags=StreamFlag.BEGIN)
    assert frame == HAND + struct.pack("<Q", horner(WORDS))
    (batch,) = decode_batches([frame], 2)
    assert batch[:3] == (3, 1, 0)
    assert batch.durations.tolist() == [0.1]
    assert batch.joints.tolist() == [[1e-6, -1e-6]]
    content = decode(_frame(frame))
    assert content == messages.Points(3, 1, 0, 1, (0.1, 1e-6, -1e-6, 0.0), horner(WORDS))
    assert encode(content, Comm.REQUEST) == frame


def _frame(data):
    splitter = FrameSplitter()
    splitter.feed(data)
    return splitter.next()


@pytest.mark.parametrize(("axes", "most"), [(1, 123), (6, 30), (7, 30), (8, 24), (10, 20)])
def test_as_many_as_fit(axes, most):
    assert messages.batch_points(axes) == most
    frames = encode_points(1, 0, np.ones(most + 1), np.zeros((most + 1, axes)))
    assert [len(frame) for frame in frames] == [
        4 + messages.points_length(most, axes),
        4 + messages.points_length(1, axes),
    ]
    assert len(frames[0]) <= spec.MAX_MESSAGE_BYTES < 4 + messages.points_length(most + 1, axes)


STEPS = st.integers(1 - spec.PAIR_ZERO, spec.PAIR_ZERO - 1)


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
def test_what_goes_in_comes_out(run):
    stream, first, steps, batch, flags = run
    values = steps / spec.PAIR_SCALE
    frames = encode_points(stream, first, values[:, 0], values[:, 1:], flags=flags, batch=batch)
    assert len(frames) == max(1, -(-len(steps) // batch))
    found = decode_batches(frames, values.shape[1] - 1)
    assert np.concatenate([b.durations for b in found]).tolist() == values[:, 0].tolist()
    assert np.concatenate([b.joints for b in found]).tolist() == values[:, 1:].tolist()
    firsts = [(first + n * batch) % spec.INDEX_WRAP for n in range(len(frames))]
    assert [b.first for b in found] == firsts
    assert {b.stream for b in found} == {stream}
    assert found[0].flags & StreamFlag.BEGIN == flags & StreamFlag.BEGIN
    assert found[-1].flags | flags & StreamFlag.BEGIN == flags
    for frame, batch_of in zip(frames, found, strict=True):
        words = struct.unpack(f"<{(len(frame) - 16) // 8}Q", frame[16:])
        assert words[-1] == horner(words[:-1])
        content = decode(_frame(frame))
        assert content.points == len(batch_of.durations)
        assert encode(content, Comm.REQUEST) == frame


@given(hnp.arrays(np.uint64, st.tuples(st.integers(1, 3), st.integers(1, 127))))
def test_checksums_of_any_words(words):
    assert checksums(words) == [horner(row) for row in words.tolist()]


@given(st.integers(0, 2**52 - 1))
def test_pairs(word):
    first, second = pair_of(word)
    if word >> 26 and word & (2**26 - 1):
        assert word_of(first, second) == word
    else:
        with pytest.raises(ContentError):
            word_of(first, second)


@pytest.mark.parametrize("value", [33.554432, -33.554432, float("nan"), float("inf")])
def test_what_no_pair_holds(value):
    with pytest.raises(ContentError):
        encode_points(1, 0, [0.1], [[0.0, value]])
    with pytest.raises(ContentError):
        encode_points(1, 0, [value], [[0.0, 0.0]])
    with pytest.raises(ContentError):
        word_of(value, 0.0)
    with pytest.raises(ContentError):
        pair_of(2**52)


FRAME = encode_points(9, 60, np.full(12, 0.25), np.linspace(-1, 1, 72).reshape(12, 6))[0]


@given(st.integers(128, 8 * len(FRAME) - 1))
def test_no_bit_may_be_wrong(bit):
    damaged = bytearray(FRAME)
    damaged[bit // 8] ^= 1 << bit % 8
    with pytest.raises(ContentError):
        decode_batches([bytes(damaged)], 6)


@given(st.integers(0, 46), st.integers(1, 5))
def test_no_words_may_be_moved(place, width):
    words = [FRAME[at : at + 8] for at in range(32, len(FRAME) - 8, 8)]
    moved = words[:]
    moved[place : place + width + 1] = reversed(moved[place : place + width + 1])
    if moved != words:
        with pytest.raises(ContentError):
            decode_batches([FRAME[:32] + b"".join(moved) + FRAME[-8:]], 6)


@given(st.binary(max_size=1100), st.integers(1, 10))
def test_random_bytes_are_no_points(data, axes):
    with pytest.raises(ContentError):
        decode_batches([data], axes)


@given(st.data())
def test_random_data_behind_a_good_head(data):
    body = data.draw(st.binary(max_size=1000))
    frame = struct.pack("<4i", 12 + len(body), 1302, 2, 0) + body
    for read in (lambda: decode_batches([frame], 6), lambda: decode(_frame(frame))):
        try:
            read()
        except ContentError:
            continue


def test_padding_and_counts():
    (frame,) = encode_points(1, 0, [0.1], [[0.1] * 7])
    with pytest.raises(ContentError, match="not zero"):
        decode_batches([frame], 6)
    with pytest.raises(ContentError, match="no POINTS of 8"):
        decode_batches([frame], 8)
    words = list(struct.unpack("<7Q", frame[16:]))
    words[1] += 1 << 32
    words[-1] = horner(words[:-1])
    with pytest.raises(ContentError, match="count"):
        decode_batches([frame[:16] + struct.pack("<7Q", *words)], 7)
    for arguments in (
        ([0.1], [[0.0] * 11]),
        ([0.1], [[]]),
    ):
        with pytest.raises(ValueError, match="joints"):
            encode_points(1, 0, *arguments)
    with pytest.raises(ValueError, match="do not fit"):
        encode_points(1, 0, [0.1] * 31, [[0.0] * 6] * 31, batch=31)
