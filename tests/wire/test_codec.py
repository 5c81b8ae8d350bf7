"""Codec against bytes written by hand, by round trip, and by every prefix."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.wire.simple_message import (
    ContentError,
    Frame,
    FrameSplitter,
    FramingError,
    decode,
    encode,
    encode_reply,
    messages,
    spec,
)
from rapidgen.wire.simple_message.declaration import Field, Wire
from rapidgen.wire.simple_message.packing import Packing
from rapidgen.wire.simple_message.spec import Comm, ReplyCode

# By hand, from the layout that the ROS-Industrial nodes were recorded to speak.
POINT = bytes.fromhex(
    "40000000 0b000000 01000000 00000000"  # length 64, type 11, topic, no reply
    "02000000"  # sequence 2
    "0000803e 0000003e 000000bf 00000000 00000000 0000803f"  # 0.25 0.125 -0.5 0 0 1
    "00000000 00000000 00000000 00000000"
    "00000000"  # velocity
    "0000003f"  # duration 0.5 s
)
STOP = bytes.fromhex("40000000 0b000000 02000000 00000000 fcffffff" + "00000000" * 12)
STOP_REPLY = bytes.fromhex("0c000000 0b000000 03000000 01000000")
JOINT = bytes.fromhex(
    "38000000 0a000000 01000000 00000000 00000000 0000003f" + "00000000" * 8 + "000080bf"
)
STATUS = bytes.fromhex(
    "28000000 0d000000 01000000 00000000"
    "01000000 00000000 cb000000 01000000 ffffffff 02000000 00000000"
)
REFUSED = bytes.fromhex("18000000 0b000000 03000000 02000000 04000000 07000000 02000000")

BY_HAND = {
    "point": (
        POINT,
        messages.TrajectoryPoint(2, (0.25, 0.125, -0.5, 0, 0, 1, 0, 0, 0, 0), 0.0, 0.5),
        Comm.TOPIC,
    ),
    "stop": (STOP, messages.TrajectoryPoint(-4, (0.0,) * 10, 0.0, 0.0), Comm.REQUEST),
    "joint": (JOINT, messages.JointPosition(0, (0.5, *(0.0,) * 8, -1.0)), Comm.TOPIC),
    "status": (STATUS, messages.StatusReport(1, 0, 203, 1, -1, 2, 0), Comm.TOPIC),
}


def frames_of(data: bytes) -> list[Frame]:
    splitter = FrameSplitter()
    splitter.feed(data)
    return list(iter(splitter.next, None))


@pytest.mark.parametrize("name", BY_HAND)
def test_bytes_by_hand(name):
    data, content, comm = BY_HAND[name]
    assert encode(content, comm) == data
    (frame,) = frames_of(data)
    assert frame.comm == comm
    assert decode(frame) == content
    assert type(decode(frame)) is type(content)


def test_replies_by_hand():
    assert encode_reply(11, messages.Acknowledged()) == STOP_REPLY
    assert decode(frames_of(STOP_REPLY)[0]) == messages.Acknowledged()
    assert encode_reply(11, messages.Refused(4, 7, 2)) == REFUSED
    assert decode(frames_of(REFUSED)[0]) == messages.Refused(reason=4, point=7, joint=2)


INT32 = st.integers(-(2**31), 2**31 - 1)
FLOAT32 = st.floats(width=32, allow_nan=False)


STEP = st.integers(1 - 2**31, 2**31 - 1).map(lambda n: n / spec.FIXED_SCALE)


def value_of(field: Field) -> st.SearchStrategy:
    if field.type is Wire.FIXED:
        return st.lists(STEP, max_size=247).map(tuple)
    if field.type is Wire.CHAR:
        return st.text("0123456789abcdef", max_size=field.count)
    scalar = INT32 if field.type is Wire.INT32 else FLOAT32
    return scalar if field.count == 1 else st.tuples(*[scalar] * field.count)


def content_of(kind: type, fields: tuple[Field, ...]) -> st.SearchStrategy:
    return st.tuples(*map(value_of, fields)).map(lambda values: kind(*values))


CONTENT = st.one_of([content_of(m.kind, m.fields) for m in messages.MESSAGES])
REPLY_KINDS = [
    (m.number, r.kind, r.fields) for m in messages.MESSAGES for r in m.replies if r.fields
]
REPLY = st.one_of(
    [st.tuples(st.just(number), content_of(kind, fields)) for number, kind, fields in REPLY_KINDS]
    + [st.just((1304, messages.Acknowledged()))]
    + [st.just((11, messages.Acknowledged())), st.just((11, messages.Failure()))]
)
DATA = st.one_of(
    st.tuples(CONTENT, st.sampled_from([Comm.TOPIC, Comm.REQUEST])).map(
        lambda pair: (encode(*pair), pair[0])
    ),
    REPLY.map(lambda pair: (encode_reply(*pair), pair[1])),
)


@given(DATA)
def test_round_trip(pair):
    data, content = pair
    assert len(data) <= spec.MAX_MESSAGE_BYTES
    (frame,) = frames_of(data)
    assert decode(frame) == content
    assert frame.to_bytes() == data


@given(st.lists(DATA, max_size=6), st.data())
def test_any_split_gives_the_same_frames(pairs, data):
    stream = b"".join(piece for piece, _ in pairs)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=8)))
    splitter = FrameSplitter()
    result = []
    for start, end in zip([0, *cuts], [*cuts, len(stream)], strict=True):
        splitter.feed(stream[start:end])
        result += [decode(frame) for frame in iter(splitter.next, None)]
    assert result == [content for _, content in pairs]
    assert splitter.pending == 0


@pytest.mark.parametrize("data", [POINT, STOP, STOP_REPLY, JOINT, STATUS, REFUSED])
def test_every_prefix_waits_for_the_rest(data):
    for cut in range(len(data)):
        splitter = FrameSplitter()
        splitter.feed(data[:cut])
        assert splitter.next() is None
        assert splitter.pending == cut
        splitter.feed(data[cut:] + STATUS)
        assert splitter.next().to_bytes() == data
        assert splitter.next().to_bytes() == STATUS


@pytest.mark.parametrize("length", [-(2**31), -1, 0, 11, 1021, 2**31 - 1])
def test_length_out_of_bounds_is_known_from_four_bytes(length):
    splitter = FrameSplitter()
    splitter.feed(STATUS + struct.pack("<i", length))
    assert splitter.next().to_bytes() == STATUS
    for _ in range(2):
        with pytest.raises(FramingError, match=str(length)):
            splitter.next()


@pytest.mark.parametrize("length", [12, 1020])
def test_length_at_its_bounds(length):
    data = struct.pack("<4i", length, 77, 1, 0) + bytes(length - 12)
    (frame,) = frames_of(data)
    assert frame.to_bytes() == data


@pytest.mark.parametrize(
    ("frame", "text"),
    [
        (Frame(99, 1, 0, b""), "type 99"),
        (Frame(13, 0, 0, bytes(28)), "comm_type is 0"),
        (Frame(13, 4, 0, bytes(28)), "comm_type is 4"),
        (Frame(13, 1, 1, bytes(28)), "reply_code"),
        (Frame(13, 1, 0, bytes(27)), "STATUS has 27 bytes"),
        (Frame(10, 1, 0, b""), "JOINT_POSITION has 0 bytes"),
        (Frame(11, 3, 0, b""), "reply_code of a reply"),
        (Frame(11, 3, 3, b""), "reply_code of a reply"),
        (Frame(11, 3, 1, bytes(7)), "7 bytes"),
        (Frame(99, 3, 1, b""), "type 99"),
    ],
)
def test_wrong_content(frame, text):
    with pytest.raises(ContentError, match=text):
        decode(frame)


@given(st.binary(max_size=400))
def test_random_bytes_bring_nothing_but_wire_errors(data):
    splitter = FrameSplitter()
    splitter.feed(data)
    try:
        while (frame := splitter.next()) is not None:
            try:
                decode(frame)
            except ContentError:
                continue
    except FramingError:
        return


def test_values_that_do_not_fit():
    with pytest.raises(ContentError):
        encode(messages.ProgressReport(2**31, 0, 0, 0, 0, 0, 0, 0))
    with pytest.raises(ContentError, match="joints"):
        encode(messages.JointPosition(0, (0.0,) * 9))
    with pytest.raises(ContentError):
        encode(messages.JointPosition(0, (1e39, *(0.0,) * 9)))
    layout = Packing([Field(Wire.CHAR, 4)])
    with pytest.raises(ContentError, match="5 bytes"):
        layout.pack(["abcde"])
    with pytest.raises(ContentError):
        layout.pack(["\u20ac"])
    with pytest.raises(ContentError, match="text"):
        layout.pack([3])
    with pytest.raises(ContentError, match="answer"):
        encode_reply(1300, messages.Refused(1, 0, 0))


def test_a_reply_without_data():
    assert encode_reply(1, messages.Acknowledged())[12:] == struct.pack("<i", ReplyCode.SUCCESS)
