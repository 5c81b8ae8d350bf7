"""Client connections to a bench's controller, as bytes."""

from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

from rapidgen.config.model import GroupConfig
from rapidgen.controller.controller import VirtualController
from rapidgen.machine.network.interface import Endpoint, NetworkFault
from rapidgen.verification.messages import (
    JOINT_TRAJ_PT,
    MAX_JOINTS,
    RawComm,
    RawContent,
    RawFrame,
    RawSpecial,
    RawTrajectoryPoint,
    Splitter,
    decode,
    encode,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Point, Position

C = TypeVar("C")


class LinkBench(Protocol):
    """The bench of a connection: its controller, its clock and its record of downloads."""

    controller: VirtualController
    group: GroupConfig
    commanded: list[tuple[float, list[Point]]]

    @property
    def now(self) -> float: ...

    def run(self, seconds: float) -> None: ...

    def until(self, condition: Callable[[], bool], seconds: float, what: str) -> None: ...


class RawLink:
    """One client connection, as bytes and frames.

    Frames are read as they arrive, with their time.

    `reading` False: a client that never reads.
    """

    def __init__(
        self, bench: LinkBench, port: int, *, reading: bool = True, address: str = "127.0.0.1"
    ) -> None:
        self._bench = bench
        self._network = bench.controller.network
        self._splitter = Splitter()
        self.frames: list[tuple[float, RawFrame]] = []
        self.sent = 0
        self.lost = False
        self._taken = 0
        self._sent_splitter: Splitter | None = Splitter()
        self._trajectory: list[Point] = []
        self.endpoint: Endpoint = self._network.connect(address, port)
        if reading:
            self.read_on()
        bench.until(lambda: self.endpoint.connected, 5, f"port {port} accepts a connection")

    def read_on(self) -> None:
        """Start to read, including all bytes that arrived so far."""
        self.endpoint.changed.add(self._receive)
        if self.endpoint.connected:
            self._receive()

    def stop_reading(self) -> None:
        """Stop reading; later bytes stay in the network."""
        self.endpoint.changed.remove(self._receive)

    def send(self, data: bytes) -> None:
        """Write all of `data`; wait while the controller's buffer is full."""
        while data and not self.lost:
            try:
                accepted = self._network.send(self.endpoint, data)
            except NetworkFault:
                self.lost = True
                return
            self.sent += accepted
            self._listen(data[:accepted])
            data = data[accepted:]
            if data:
                self._bench.run(0.01)

    def at_once(self, data: bytes) -> None:
        """Write a few bytes without advancing time.

        For use at a statement of the driver.
        """
        if not self.lost:
            try:
                self.sent += self._network.send(self.endpoint, data)
            except NetworkFault:
                self.lost = True

    def _listen(self, data: bytes) -> None:
        """Record a well-formed download for the plots."""
        if self._sent_splitter is None:
            return
        try:
            for frame in self._sent_splitter.feed(data):
                if frame.number == JOINT_TRAJ_PT:
                    content = decode(frame)
                    if isinstance(content, RawTrajectoryPoint):
                        self._keep(content)
        except CheckFailed:
            self._sent_splitter = None

    def _keep(self, point: RawTrajectoryPoint) -> None:
        if point.sequence == RawSpecial.BEGIN:
            self._trajectory = []
        joints = tuple(point.joints[: len(self._bench.group.joints)])
        self._trajectory.append((joints, point.duration))
        if point.sequence == RawSpecial.END:
            self._bench.commanded.append((self._bench.now, self._trajectory))
            self._trajectory = []

    def read(self) -> list[RawFrame]:
        """Return the frames since the last call."""
        result = [frame for _, frame in self.frames[self._taken :]]
        self._taken = len(self.frames)
        return result

    def forget(self) -> None:
        """Discard the frames so far."""
        self.frames.clear()
        self._taken = 0

    def _receive(self) -> None:
        while not self.lost:
            try:
                data = self._network.receive(self.endpoint, 65_536)
            except NetworkFault:
                self.lost = True
                return
            if data is None:
                return
            if not data:
                self.lost = True
                return
            now = self._bench.now
            self.frames += [(now, frame) for frame in self._splitter.feed(data)]

    def expect_reply(self, seconds: float, what: str) -> RawFrame:
        """Return the next unread frame within `seconds`."""
        self._bench.until(lambda: len(self.frames) > self._taken, seconds, what)
        self._taken += 1
        return self.frames[self._taken - 1][1]

    def expect(self, kind: type[C], seconds: float, what: str) -> C:
        """Return the next unread message of a type; skip others before it."""
        failures: list[C] = []

        def arrived() -> bool:
            while not failures and len(self.frames) > self._taken:
                self._taken += 1
                content = decode(self.frames[self._taken - 1][1])
                if isinstance(content, kind):
                    failures.append(content)
            return bool(failures)

        self._bench.until(arrived, seconds, what)
        return failures[0]

    def messages_of(self, kind: type[C], since: float = 0.0) -> list[tuple[float, C]]:
        """Return all messages of a type since `since`, with times."""
        result = [(when, decode(frame)) for when, frame in self.frames if when >= since]
        return [(when, content) for when, content in result if isinstance(content, kind)]

    def ask(self, content: RawContent, seconds: float = 2) -> RawContent:
        """Send a request and return the reply."""
        data = encode(content, RawComm.REQUEST)
        self.send(data)
        number = int.from_bytes(data[4:8], "little")
        return self.reply(number, seconds)

    def reply(self, number: int, seconds: float = 2, what: str = "") -> RawContent:
        """Return the next reply of a type; skip what comes before it."""
        failures: list[RawFrame] = []

        def arrived() -> bool:
            while not failures and len(self.frames) > self._taken:
                self._taken += 1
                frame = self.frames[self._taken - 1][1]
                if (frame.number, frame.comm) == (number, RawComm.REPLY):
                    failures.append(frame)
            return bool(failures)

        self._bench.until(arrived, seconds, what or f"a reply of type {number} arrives")
        return decode(failures[0])

    def stop(self, seconds: float = 2, what: str = "STOP is answered") -> RawContent:
        """Send STOP and return the reply."""
        self.send(STOP)
        return self.reply(JOINT_TRAJ_PT, seconds, what)

    def wait_disconnected(self, seconds: float, what: str) -> None:
        """Wait for the controller to end the connection."""
        self._bench.until(lambda: self.lost, seconds, what)

    def close(self, *, abort: bool = False, then: float | None = None) -> None:
        """Close the connection (FIN), or reset it (RST), and wait `then` s."""
        self._network.close(self.endpoint, abort=abort)
        self.lost = True
        if then is not None:
            self._bench.run(then)


def point_frame(
    number: int, count: int, joints: Position, duration: float, comm: RawComm = RawComm.TOPIC
) -> bytes:
    """Return point `number` (from 0) of `count`.

    Sequence numbers as in the ROS-Industrial node.
    """
    if number == 0:
        sequence = int(RawSpecial.BEGIN)
    elif number == count - 1:
        sequence = int(RawSpecial.END)
    else:
        sequence = number
    return raw_point(sequence, joints, duration, comm)


def raw_point(
    sequence: int, joints: Sequence[float], duration: float, comm: RawComm = RawComm.TOPIC
) -> bytes:
    """Return a point with any sequence number."""
    padded = (*joints, *[0.0] * (MAX_JOINTS - len(joints)))
    return encode(RawTrajectoryPoint(sequence, padded, 0.0, duration), comm)


STOP = raw_point(int(RawSpecial.STOP), (), 0.0, RawComm.REQUEST)
