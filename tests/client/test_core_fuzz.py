"""The client's core with arbitrary bytes of a controller, in any order.

No I/O, no clock. Invariants: only RobotError is raised; points are sent in order, each once, never
more than there is space for, and none after a stop or an end; a STOP is due when no states arrive.
"""

import struct
from collections import deque

import numpy as np
from hypothesis import Phase as Stage
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from rapidgen.client.core.checks import check_trajectory
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import Phase
from rapidgen.client.core.robot import Core, Timeouts
from rapidgen.client.core.stream import PointStream
from rapidgen.client.errors import ConnectionLost, ProtocolError, RobotTimeout
from rapidgen.client.trajectory import Trajectory
from rapidgen.wire.simple_message import (
    ContentError,
    FrameSplitter,
    decode,
    encode,
    encode_reply,
    messages,
)
from rapidgen.wire.simple_message.numpy_codec import decode_batches
from rapidgen.wire.simple_message.spec import Comm, Feature, Port, StreamFlag, TrajectoryState

RING = 40
PAD = (0.0,) * 4
HELLO = messages.HelloReply(
    2, (0, 1, 0), "0" * 12, "", int(Feature(63)), 1000, 6, 0, 0.1, 0.1, 0.01, 0.01,
    (-3.0,) * 10, (3.0,) * 10, (4.0,) * 10, 11001, RING, 0.5, 30, 2,
)  # fmt: skip
STATE = encode(messages.JointPosition(0, (0.0,) * 10)) + encode(
    messages.StatusReport(1, 0, 0, 0, 0, 2, 1)
)
NUMBER = st.one_of(st.integers(-2, 200), st.integers(-(2**31), 2**31 - 1))
WORDS = st.lists(NUMBER, max_size=20)
TYPES = st.sampled_from([1, 10, 11, 13, 15, 99, 1300, 1301, 1302, 1303, 1304, 1306, 1307, 1308])


def any_frame(draw):
    data = b"".join(struct.pack("<i", word) for word in draw(WORDS))
    head = struct.pack("<3i", draw(TYPES), draw(st.integers(0, 4)), draw(st.integers(0, 3)))
    return struct.pack("<i", 12 + len(data)) + head + data


def decodes(frame):
    splitter = FrameSplitter()
    splitter.feed(frame)
    try:
        decode(splitter.next())
    except ContentError:
        return False
    return True


class CoreMachine(RuleBasedStateMachine):
    """A core with three open connections."""

    @initialize()
    def connect(self):
        self.now = 0.0
        self.core = Core(None, Timeouts(), lambda: self.now)
        for port in (Port.STATE, Port.MOTION, Port.CONTROL):
            self.core.opened(port)
        self.core.use(Group.from_hello(HELLO))
        assert self.core.received(Port.STATE, encode_reply(1300, HELLO) + STATE)
        self.time = 0.0
        self.sent = 0
        self.free = RING
        self.ended = self.cut = False
        self.waiting = deque()
        """(stream, points sent) of each batch that has no reply yet."""
        self.stops = 0

    @property
    def run(self):
        return self.core.motion

    def owner(self):
        """Do the same as both clients after each change."""
        for port in self.core.unmonitored_stops():
            assert self.core.ports[port].is_open
            self.stops += 1
        for port in (Port.CONTROL, Port.MOTION):
            while (frame := self.core.due(port)) is not None:
                if port is Port.MOTION:
                    self.goes_out(frame)

    def goes_out(self, frame):
        (batch,) = decode_batches([frame], 6)
        assert not self.run.is_over
        assert not self.run.stopping
        assert not self.ended
        assert not self.cut
        assert batch.stream == self.run.stream
        assert bool(batch.flags & StreamFlag.BEGIN) is (self.sent == 0)
        assert batch.first == self.sent
        assert len(batch.durations) <= 30
        self.sent += len(batch.durations)
        self.waiting.append((batch.stream, self.sent))
        self.ended = bool(batch.flags & StreamFlag.END)
        assert self.sent <= self.free
        if self.ended:
            assert self.sent == self.run.total

    def check(self, points, before):
        start = (0.0,) * 10 if before is None else None
        group, limits = self.core.known_group, self.core.limits
        return check_trajectory(points, group, limits, "stream", start=start, before=before)

    @rule(count=st.integers(1, 100))
    def append(self, count):
        times = self.time + 0.1 * np.arange(count)
        points = Trajectory(times, np.zeros((count, 6)))
        if self.run is None or self.run.is_over:
            self.core.motion = None
            times = 0.1 * np.arange(count)
            points = Trajectory(times, np.zeros((count, 6)))
            checked = self.check(points, None)
            self.core.begin(checked)
            self.sent, self.free, self.ended, self.cut = 0, RING, False, False
        elif self.run.is_ended:
            return
        else:
            checked = self.check(points, self.last)
            self.run.add(checked)
        self.last = checked.last
        self.time = float(times[-1]) + 0.1
        self.owner()

    @precondition(lambda self: self.run is not None)
    @rule(end=st.booleans())
    def flush_or_end(self, end):
        self.run.end() if end else self.run.flush()
        self.owner()

    @precondition(lambda self: self.waiting)
    @rule(free=st.integers(0, 64), state=st.sampled_from([1, 2, 7, 8]))
    def acknowledged(self, free, state):
        stream, end = self.waiting.popleft()
        report = messages.PointsAccepted(stream, 1, end, free, 0, 0, state)
        if stream == self.run.stream:
            self.free = max(self.free, end + free)
        self.take(Port.MOTION, encode_reply(1302, report))

    @precondition(lambda self: self.waiting)
    @rule(reason=NUMBER, point=NUMBER, joint=NUMBER, accepted=NUMBER)
    def refused(self, reason, point, joint, accepted):
        stream, _ = self.waiting.popleft()
        report = messages.PointsRefused(stream, 1, accepted, reason, point, joint)
        self.cut |= self.core.ports[Port.MOTION].is_open and stream == self.run.stream
        self.take(Port.MOTION, encode_reply(1302, report))

    @precondition(lambda self: self.run is not None)
    @rule(
        counts=st.tuples(NUMBER, NUMBER, NUMBER),
        state=st.one_of(st.sampled_from([1, 2, 7, 8] * 5 + [3, 4, 5, 6]), NUMBER),
        fault=st.tuples(NUMBER, NUMBER, NUMBER),
    )
    def progress(self, counts, state, fault):
        report = messages.ProgressReport(1, int(state), *counts, *fault)
        # PROGRESS of points passed to the planner frees space for others
        self.free = max(self.free, self.sent + RING)
        self.take(Port.STATE, encode(report) * 2)

    # One rule for all that may end a motion: most stories shall get far.

    @rule(
        what=st.sampled_from(["strange", "strange", "garbage", "stop", "silence"]), data=st.data()
    )
    def something_bad(self, what, data):
        port = data.draw(st.sampled_from([Port.MOTION, Port.CONTROL, Port.STATE]))
        if what == "strange":
            self.strange(port, any_frame(data.draw))
        elif what == "garbage":
            self.garbage(port, data.draw(st.binary(max_size=90)))
        elif what == "silence":
            self.time_passes(data.draw(st.sampled_from([0.6, 2.5, 6.0])))
        elif self.run is not None:
            self.core.request_stop(Port.MOTION)
            self.owner()
            assert not self.run.has_due

    def strange(self, port, frame):
        _, number, comm, _ = struct.unpack_from("<4i", frame)
        if port is Port.MOTION and number == 1302:
            if comm == Comm.REPLY and self.waiting and decodes(frame):
                self.waiting.popleft()
            if comm == Comm.REPLY and len(frame) == 44:
                self.free = 10**12
        if port is Port.STATE and number == 1301:
            self.free = max(self.free, self.sent + RING)
        self.take(port, frame)

    def garbage(self, port, data):
        self.take(port, data)
        # what is half received would make garbage of all that follows
        if port is Port.STATE:
            self.core.state_port._splitter = FrameSplitter()
        else:
            self.core.ports[port].splitter = FrameSplitter()

    def take(self, port, data):
        is_open = self.core.state_open if port is Port.STATE else self.core.ports[port].is_open
        if is_open:
            self.core.received(port, data)
        self.owner()

    def time_passes(self, seconds):
        self.now += seconds
        self.core.poll()
        self.owner()

    @rule(seconds=st.sampled_from([0.05, 0.3]))
    def states_come(self, seconds):
        self.take(Port.STATE, STATE)
        self.time_passes(seconds)

    @rule()
    def connect_again(self):
        for port in (Port.STATE, Port.MOTION, Port.CONTROL):
            is_open = self.core.state_open if port is Port.STATE else self.core.ports[port].is_open
            if not is_open:
                self.core.opened(port)
                if port is Port.MOTION:
                    self.waiting.clear()
                if port is Port.STATE:
                    self.core.received(port, encode_reply(1300, HELLO) + STATE)
                self.owner()

    @invariant()
    def reports_are_consistent(self):
        run = self.run if hasattr(self, "core") else None
        if run is None:
            return
        assert isinstance(run, PointStream)
        progress = run.progress
        assert 0 <= progress.reached <= progress.planned <= self.sent <= progress.total
        assert progress.received <= self.sent
        assert isinstance(progress.state, TrajectoryState)
        assert 0 <= progress.fraction <= 1
        if run.phase is Phase.OVER:
            assert (run.result is None) is not (run.error is None)
            unmonitored = ConnectionLost | RobotTimeout | ProtocolError
            if isinstance(run.error, unmonitored):
                assert self.core.unmonitored_stops() == []
        assert len(self.core.state_port.messages) <= 32
        assert len(self.core.state_port.events) <= 64


TestCore = CoreMachine.TestCase
TestCore.settings = settings(
    max_examples=80,
    stateful_step_count=50,
    # Shrinking a failing example takes minutes.
    phases=(Stage.explicit, Stage.generate),
)
