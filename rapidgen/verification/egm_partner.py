"""Independent partner of externally guided motion, with hand-written bytes.

Source: the field numbers of ABB's egm.proto (package abb.egm). This module uses nothing of the
codec in `wire`, as `messages` does for simple_message. Joints are degrees here.
"""

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from rapidgen.verification.model import CheckFailed

Degrees: TypeAlias = tuple[float, ...]
Fields: TypeAlias = dict[int, list[int | bytes]]
"""Values of a message by field number: whole numbers, or bytes."""

_CORRECTION = 3
"""Message type of answers."""
_VARINT, _DOUBLE, _BYTES, _SINGLE = 0, 1, 2, 5
_RUNNING = 3
"""State of the motion interface while references are executed."""
CYCLE = 0.004


@dataclass(frozen=True, slots=True)
class Frame:
    """What the bench reads of a message of the controller."""

    sequence: int
    joints: Degrees
    """As measured, degrees."""
    running: bool
    """True while references are executed."""


def _varint(value: int) -> bytes:
    result = bytearray()
    while value > 0x7F:
        result.append(value & 0x7F | 0x80)
        value >>= 7
    result.append(value)
    return bytes(result)


def _number(place: int, value: int) -> bytes:
    return _varint(place << 3 | _VARINT) + _varint(value)


def _doubles(place: int, values: Sequence[float]) -> bytes:
    head = _varint(place << 3 | _DOUBLE)
    return b"".join(head + struct.pack("<d", value) for value in values)


def _part(place: int, data: bytes) -> bytes:
    return _varint(place << 3 | _BYTES) + _varint(len(data)) + data


def sensor(sequence: int, joints: Sequence[float] | None, heartbeat: float | None) -> bytes:
    """Return an EgmSensor: joints in degrees, and the heartbeat as the first number for RAPID."""
    data = _part(1, _number(1, sequence) + _number(3, _CORRECTION))
    if joints is not None:
        data += _part(2, _part(1, _doubles(1, joints)))
    if heartbeat is not None:
        data += _part(4, _doubles(2, [float(heartbeat)]))
    return data


def _fields(data: bytes) -> Fields:
    """Split a message into its fields. CheckFailed: it is no message."""
    result: Fields = {}
    at = 0

    def varint() -> int:
        nonlocal at
        value = shift = 0
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if not byte & 0x80:
                return value

    while at < len(data):
        key = varint()
        kind, value = key & 7, b""
        if kind == _VARINT:
            result.setdefault(key >> 3, []).append(varint())
            continue
        size = {_DOUBLE: 8, _SINGLE: 4}.get(kind) or (varint() if kind == _BYTES else -1)
        if size < 0 or at + size > len(data):
            raise CheckFailed("a datagram of the controller is no EgmRobot")
        value, at = data[at : at + size], at + size
        result.setdefault(key >> 3, []).append(value)
    return result


def _inside(fields: Fields, *path: int) -> Fields:
    for place in path:
        value = fields.get(place, [b""])[0]
        if not isinstance(value, bytes):
            raise CheckFailed("a datagram of the controller is no EgmRobot")
        fields = _fields(value)
    return fields


def frame(data: bytes) -> Frame:
    """Read an EgmRobot. CheckFailed: it is none."""
    robot = _fields(data)
    joints = _inside(robot, 2, 1).get(1, [])
    (sequence,) = _inside(robot, 1)[1]
    state = _inside(robot, 5).get(1, [0])[0]
    return Frame(
        int(sequence),
        tuple(struct.unpack("<d", j)[0] for j in joints if isinstance(j, bytes)),
        state == _RUNNING,
    )


@dataclass(slots=True)
class GuidingPartner:
    """A partner in lock-step: it moves one axis to and fro, or holds all.

    It answers each message in the next cycle. `silent`: it answers nothing; `frozen`: its heartbeat
    stands still.
    """

    now: Callable[[], float]
    axis: int = 0
    speed: float = 0.0
    """Degrees/s of `axis`; 0: it holds the position at the beginning."""
    silent: bool = False
    frozen: bool = False
    heartbeats: bool = True
    """It counts its answers; False: it sends `heartbeat`."""
    heartbeat: float | None = None
    frames: list[tuple[float, Frame]] = field(default_factory=list)
    """Messages of the controller with their times."""
    _start: Degrees = ()
    _begun: float = 0.0
    _count: int = 0

    def __call__(self, data: bytes) -> bytes | None:
        """Answer a message of the controller."""
        received = frame(data)
        self.frames.append((self.now(), received))
        if received.sequence == 0 or not received.running:
            self._start, self._begun = received.joints, self.now()
        if self.silent:
            return None
        if not self.frozen:
            self._count += 1
        target = list(self._start)
        target[self.axis] += self.speed * (self.now() - self._begun)
        return sensor(self._count, target, self._count if self.heartbeats else self.heartbeat)

    @property
    def sessions(self) -> int:
        """Return how often the sequence began at 0."""
        return sum(received.sequence == 0 for _, received in self.frames)
