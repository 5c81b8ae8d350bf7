"""The independent layouts and the specification agree."""

import random

import pytest

from rapidgen.verification import batches
from rapidgen.verification import messages as own
from rapidgen.verification.raw_connection import STOP, point_frame
from rapidgen.wire import simple_message as wire
from rapidgen.wire.simple_message import messages as known
from rapidgen.wire.simple_message import numpy_codec, spec

ENUMS = (
    *("Comm", "ReplyCode", "TriState", "Mode", "Feature", "StreamFlag"),
    *("Instruction", "Modal"),
)


def some(layout, chance):
    """Values for a layout that every field can hold."""
    failures = []
    for field in layout.split():
        count = int(field[:-1] or 1)
        if field[-1] == "s":
            failures.append("".join(chance.choice("0123456789abcdef") for _ in range(count)))
            continue
        values = [
            chance.randrange(1000) if field[-1] == "i" else chance.randrange(64) / 8
            for _ in range(count)
        ]
        failures.append(values[0] if count == 1 else tuple(values))
    return failures


@pytest.mark.parametrize(
    ("number", "code", "kind", "layout"), own._LAYOUTS, ids=lambda v: getattr(v, "__name__", v)
)
def test_each_layout_is_that_of_the_specification(number, code, kind, layout):
    mine = kind._make(some(layout, random.Random(number)))
    (row,) = (row for row in known.MESSAGES if row.number == number)
    declared = [r.kind for r in row.replies if r.code == code and r.fields] if code else [row.kind]
    theirs = declared[0]._make(mine)
    assert kind._fields == type(theirs)._fields
    frames = wire.FrameSplitter()
    if code:
        frames.feed(wire.encode_reply(number, theirs))
    else:
        frames.feed(wire.encode(theirs))
        if "s" not in layout:
            assert own.encode(mine) == wire.encode(theirs)
    assert own.decode(own.RawFrame._make(frames.next())) == mine


@pytest.mark.parametrize("name", [*ENUMS, "TrajectoryState", "Reason"])
def test_numbers_are_those_of_the_specification(name):
    for member in getattr(own, f"Raw{name}"):
        assert getattr(spec, name)[member.name] == member


def test_texts_and_sizes_are():
    assert own.text_of(own.RawReason.CAPACITY) == spec.Reason.CAPACITY.text
    for joints in range(1, 11):
        assert batches.batch_points(joints) == known.batch_points(joints)
    assert (own.MAX_JOINTS, own.INDEX_WRAP, own.PROTOCOL_VERSION, own.LONGEST) == (
        spec.MAX_JOINTS,
        spec.INDEX_WRAP,
        spec.PROTOCOL_VERSION,
        spec.MAX_LENGTH,
    )
    assert len(STOP) == own.POINT_BYTES == 4 + known.JOINT_TRAJ_PT.length
    assert own.split_error_code(204) == (4, 2)


def test_a_download_is_that_of_the_client():
    rows = [[0.1 * n] * 6 for n in range(5)]
    mine = b"".join(point_frame(n, 5, tuple(row), 0.5 * n) for n, row in enumerate(rows))
    theirs = numpy_codec.encode_trajectory(rows, [0.5 * n for n in range(5)], request_end=False)
    assert mine == theirs


@pytest.mark.parametrize("joints", [4, 6, 7, 8])
def test_a_batch_is_that_of_the_client(joints):
    points = [(tuple(0.1 * n - 0.01 * j for j in range(joints)), 0.1 * n) for n in range(9)]
    (theirs,) = numpy_codec.encode_points(
        7, 3, [d for _, d in points], [p for p, _ in points], flags=spec.StreamFlag.BEGIN
    )
    assert batches.points_frame(7, 3, points, own.RawStreamFlag.BEGIN) == theirs
    with pytest.raises(ValueError, match="does not fit"):
        batches.points_frame(7, 0, [((2200.0,) * joints, 1.0)])
