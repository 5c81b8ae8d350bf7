"""Trajectories to bytes by numpy: a million points a second. Import it where it is needed."""

from typing import Any

import numpy as np
import numpy.typing as npt

from rapidgen.protocol import spec
from rapidgen.protocol.spec import Comm, ReplyCode, Sequence, Wire

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
