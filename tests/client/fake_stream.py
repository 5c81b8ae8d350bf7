"""Streaming and control side of a scripted driver, with given time.

Written from docs/develop/protocol.md with `struct` and plain integers, not with our codec. Its
`faults` say what it does wrong.
"""

import struct
from dataclasses import dataclass, field

HEAD = struct.Struct("<4i")
MODULUS = 2**31 - 19
WRAP = 2**23
RECEIVING, MOVING, DONE, REFUSED, FAILED, STOPPED, STARVED, PAUSED = range(1, 9)
STOP_REASON, CLIENT_LOST = 40, 42


def frame(number, comm, reply, data=b""):
    return HEAD.pack(12 + len(data), number, comm, reply) + data


@dataclass
class StreamModel:
    """A ring of points that are executed one after another by time.

    `point_fault` is (index, reason, joint) of a point that it does not accept, `start_fault` a
    reason for which no stream begins; `lose_reply` and `bad_reply` are numbers of batches.
    """

    joints: int = 6
    ring: int = 128
    preload: float = 0.5
    batch: int = 30
    speed: float = 1.0
    """Plays so many times faster than asked."""
    point_fault: tuple[int, int, int] | None = None
    start_fault: int = 0
    lose_replies_from: int = 10**9
    bad_reply_from: int = 10**9
    signals: dict[int, float] = field(default_factory=lambda: {0: 0.0, 1: 5.0})
    refuse_control: int = 0
    stop_over_control_only: bool = False

    def __post_init__(self):
        self.position = [0.0] * self.joints
        self.trajectory = 0
        self.stream = 0
        self.state = 0
        self.reason, self.point, self.joint = 0, -1, 0
        self.accepted = self.planned = self.reached = 0
        self.queue = []
        self.batches = 0
        self.sizes = []
        self.executed = []
        self.keep = True
        """True if `executed` collects."""
        self.most_waiting = 0
        self.ended = self.cut = self.going = False
        self.segment = None
        self.clock = 0.0
        self.override = 1.0
        self.heartbeat_until = None
        self.heartbeats = []
        self.paused = False

    # Points

    def points(self, data):
        """One POINTS message; the reply."""
        self.batches += 1
        words = struct.unpack(f"<{(len(data) - 16) // 4}i", data[16:])
        stream, flags, first, count = struct.unpack_from("<4i", data, 16)
        check = 0
        for word in words[:-1]:
            check = (2 * check + word + 2**31) % MODULUS
        width = 1 + self.joints
        if flags & 1 and self.start_fault:
            self.stream, self.cut = stream, True
            return self._refused(stream, self.start_fault, -1, 0)
        if flags & 1:
            self._begin(stream)
        if stream != self.stream or self.cut:
            return self._refused(stream, self.reason or STOP_REASON, self.point, self.joint)
        free = self.ring - (self.accepted - self.planned)
        fault = 0
        if words[-1] != check:
            fault = 16
        elif len(data) != 16 + 16 + 4 * (count * width) + 4:
            fault = 12
        elif first != self.accepted % WRAP:
            fault = 2
        elif count > free:
            fault = 15
        if fault:
            self._cut(fault, self.accepted, 0)
            return self._refused(stream, fault, self.accepted % WRAP, 0)
        self.sizes.append(count)
        for n in range(count):
            values = [v / 1e6 for v in words[4 + n * width : 4 + (n + 1) * width]]
            if self.point_fault and self.accepted == self.point_fault[0]:
                self._cut(self.point_fault[1], self.accepted, self.point_fault[2])
                return self._refused(stream, *self._fault())
            self.queue.append((values[0], values[1:]))
            self.accepted += 1
        self.most_waiting = max(self.most_waiting, self.accepted - self.planned)
        if flags & 2:
            self.ended = True
        if flags & 4:
            self.going = True
        self._start_if_enough()
        if self.batches >= self.lose_replies_from:
            return b""
        if self.batches >= self.bad_reply_from:
            return frame(1302, 3, 1)
        free = self.ring - (self.accepted - self.planned)
        counts = [self.accepted % WRAP, free, self.planned % WRAP, self.reached % WRAP, self.state]
        return frame(1302, 3, 1, struct.pack("<7i", stream, self.trajectory, *counts))

    def _begin(self, stream):
        self.trajectory += 1
        self.stream = stream
        self.state = RECEIVING
        self.reason, self.point, self.joint = 0, -1, 0
        self.accepted = self.planned = self.reached = 0
        self.queue, self.executed = [], []
        self.ended = self.cut = self.going = self.paused = False
        self.segment = None
        self.override = 1.0

    def _fault(self):
        return self.reason, self.point % WRAP if self.point >= 0 else -1, self.joint

    def _refused(self, stream, reason, point, joint):
        data = (stream, self.trajectory, self.accepted % WRAP, reason, point, joint)
        return frame(1302, 3, 2, struct.pack("<6i", *data))

    def _cut(self, reason, point, joint):
        self.cut = self.going = True
        self.reason, self.point, self.joint = reason, point, joint

    def _start_if_enough(self):
        buffered = sum(duration for duration, _ in self.queue)
        full = self.accepted - self.planned >= self.ring
        # The end may come when all points are executed: then nothing waits, and it is over.
        if self.ended or (self.queue and (buffered >= self.preload or full)):
            self.going = True

    # Time

    def advance(self, now):
        """Let the robot move until `now`, s."""
        self.clock, passed = now, (now - self.clock) * self.speed * self.override
        if self.heartbeat_until is not None and now > self.heartbeat_until:
            self.heartbeat_until = None
            self.halt(FAILED, CLIENT_LOST)
        if self.state not in (RECEIVING, MOVING, STARVED) or self.paused or not self.going:
            return
        while passed > 0:
            if self.segment is None and not self._next():
                return
            left, duration, start, goal = self.segment
            step = min(left, passed)
            left, passed = left - step, passed - step
            fraction = 1 - left / duration
            self.position = [a + fraction * (b - a) for a, b in zip(start, goal, strict=True)]
            self.segment = (left, duration, start, goal)
            if left <= 0:
                self.reached += 1
                self.position = goal
                if self.keep:
                    self.executed.append((duration, goal))
                self.segment = None
        if self.segment is None:
            self._next()

    def _next(self):
        if not self.queue:
            if self.cut:
                self.state = FAILED
            elif self.ended:
                self.state = DONE
            else:
                self.state = STARVED
                self.going = False
            return False
        duration, goal = self.queue.pop(0)
        self.planned += 1
        self.state = MOVING
        self.segment = (duration, duration, self.position, goal)
        return True

    @property
    def is_moving(self):
        return self.segment is not None and self.state == MOVING

    def halt(self, state, reason):
        """Stop at once; the path is gone."""
        if self.state in (RECEIVING, MOVING, STARVED, PAUSED):
            self.state, self.reason = state, reason
            self.cut = True
        self.queue, self.segment, self.paused = [], None, False

    def progress(self):
        counts = [self.accepted % WRAP, self.planned % WRAP, self.reached % WRAP]
        state = PAUSED if self.paused else self.state
        report = (*counts, *self._fault())
        return frame(1301, 1, 0, struct.pack("<8i", self.trajectory, state, *report))

    # The control port

    def control(self, number, data):
        """A request on the control port; what goes out."""
        if number == 11:
            self.halt(STOPPED, STOP_REASON)
            joints = self.position + [0.0] * (10 - self.joints)
            report = struct.pack(
                "<3i10f", self.trajectory, self.reached % WRAP, STOP_REASON, *joints
            )
            return frame(11, 3, 1) + frame(1303, 1, 0, report)
        if self.refuse_control:
            return frame(number, 3, 2, struct.pack("<i", self.refuse_control))
        if number == 1304:
            self.paused = bool(struct.unpack("<i", data)[0])
            return frame(1304, 3, 1)
        if number == 1305:
            self.override = struct.unpack("<f", data)[0] / 100
            return frame(1305, 3, 1)
        if number == 1306:
            (timeout,) = struct.unpack("<f", data)
            self.heartbeats.append(timeout)
            self.heartbeat_until = self.clock + timeout if timeout else None
            return frame(1306, 3, 1, struct.pack("<2i", self.trajectory, self.state))
        if number == 1307:
            index, write, value = struct.unpack("<2if", data)
            if index not in self.signals:
                return frame(1307, 3, 2, struct.pack("<i", 17))
            if write:
                self.signals[index] = value
            return frame(1307, 3, 1, struct.pack("<if", index, self.signals[index]))
        return b""

    def control_lost(self):
        """The control connection broke."""
        if self.heartbeat_until is not None:
            self.heartbeat_until = None
            self.halt(FAILED, CLIENT_LOST)
