"""Trajectories by numpy equal the frames that the codec makes one by one."""

import numpy as np
import pytest

from rapidgen.wire.simple_message import encode
from rapidgen.wire.simple_message.messages import TrajectoryPoint
from rapidgen.wire.simple_message.numpy_codec import decode_points, encode_trajectory
from rapidgen.wire.simple_message.spec import Comm


@pytest.mark.parametrize(("count", "axes"), [(2, 6), (3, 10), (50, 1)])
def test_equals_the_codec(count, axes):
    random = np.random.default_rng(count)
    joints = random.normal(size=(count, axes))
    durations = random.uniform(0.1, 1.0, count)
    sequences = [-1, *range(1, count - 1), -3]
    expected = b""
    for i, sequence in enumerate(sequences):
        padded = tuple(joints[i]) + (0.0,) * (10 - axes)
        point = TrajectoryPoint(sequence, padded, 0.0, durations[i])
        expected += encode(point, Comm.REQUEST if sequence == -3 else Comm.TOPIC)
    assert encode_trajectory(joints, durations) == expected
    topics = encode_trajectory(joints, durations, request_end=False)
    assert decode_points(topics)["comm"].tolist() == [Comm.TOPIC] * count


def test_decode_points():
    data = encode_trajectory([[0.5, 1.0], [0.25, 2.0]], [0.1, 0.5])
    points = decode_points(data)
    assert points["sequence"].tolist() == [-1, -3]
    assert points["joints"][:, :2].tolist() == [[0.5, 1.0], [0.25, 2.0]]


@pytest.mark.parametrize("shape", [(1, 6), (2, 11)])
def test_shapes_that_do_not_fit(shape):
    with pytest.raises(ValueError, match="joints"):
        encode_trajectory(np.zeros(shape), np.ones(shape[0]))
