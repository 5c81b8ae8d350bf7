"""A scripted controller on real sockets, correct or faulty.

Not a model of ABB's controller (that is rapidgen.controller): it plays points by time and answers
as the script says. Bytes are made by `struct` here, not by rapidgen's codec.
"""

import contextlib
import socket
import struct
import threading
import time
from dataclasses import dataclass, field

from fake_stream import HEAD, StreamModel, frame

POINT = struct.Struct("<i10fff")


def joint_frame(joints):
    return frame(10, 1, 0, struct.pack("<i10f", 0, *joints, *[0.0] * (10 - len(joints))))


def status_frame(**values):
    still = {"drives": 1, "e_stopped": 0, "error_code": 0, "in_error": 0, "in_motion": 0}
    fields = {**still, "mode": 2, "possible": 1, **values}
    return frame(13, 1, 0, struct.pack("<7i", *fields.values()))


@dataclass
class Script:
    """Behaviour of the controller. Times in s."""

    joints: int = 6
    rapidgen: bool = True
    mapping: str = ""
    protocol: int = 4
    capacity: int = 1000
    state_period: float = 0.01
    speed: float = 1.0
    """Played so many times faster than asked."""
    chop: int = 0
    """Send state bytes in pieces of this size."""
    merge: int = 1
    """Send so many states in one segment."""
    answer_end: bool = True
    end_delay: float = 0.0
    refuse: tuple[int, int, int] | None = None
    bare_failure: bool = False
    answer_stop: bool = True
    stop_code: int = 1
    moves: bool = True
    ends_at: float = 1.0
    """Share of the trajectory after which it fails (reason 44)."""
    coasts: bool = False
    """Never stands after STOP."""
    read_bytes: int = 65536
    read_pause: float = 0.0
    status: dict = field(default_factory=dict)
    raw_state: bytes | None = None
    """Sent once instead of states, then closed."""
    silent_after: float = float("inf")
    """No state after so many s of motion."""
    control: bool = False
    control_hears_stop: bool = True
    foreign_control: bool = False
    """The control port is another driver's."""
    stream: StreamModel | None = None
    """Takes points while it moves; needs `speed` of its own."""
    feedback: bool = False
    """Tells it with each state, from a clock of 0.02 s a state."""
    hello: bytes | None = None
    """Answered in the place of what fits."""
    raw_control: bytes = b""
    """Sent on the control port before anything else."""


def hello_reply(script, control_port, *, foreign=False):
    """The HELLO reply; `foreign`: another driver than on the other ports."""
    if script.protocol != 4:
        return frame(1300, 3, 2, struct.pack("<i", script.protocol))
    stream = script.stream
    features = 1 | 16 | 32 | (2 if script.control else 0) | (4 if stream else 0)
    limits = [3.0] * script.joints + [0.0] * (10 - script.joints)
    build_id = b"ba9876543210" if foreign else b"0123456789ab"
    data = struct.pack("<4i12s12s", 4, 0, 1, 0, build_id, script.mapping.encode())
    data += struct.pack("<4i", features, script.capacity, script.joints, 0)
    data += struct.pack("<4f", script.state_period, 0.1, 0.00873, 0.005)
    data += struct.pack("<30f", *[-v for v in limits], *limits, *[4.0] * 10)
    report = (
        (stream.ring, stream.preload, stream.batch, len(stream.signals)) if stream else (0,) * 4
    )
    data += struct.pack("<iifii", control_port if script.control else 0, *report)
    return frame(1300, 3, 1, data)


def pieces(buffer):
    """The whole frames at the beginning of a buffer, and what is left of it."""
    result = []
    while len(buffer) >= 4 and len(buffer) >= 4 + (n := struct.unpack("<i", buffer[:4])[0]):
        result.append(buffer[: 4 + n])
        buffer = buffer[4 + n :]
    return result, buffer


class FakeController:
    """Listens on three ports of loopback; `points` and `stops` are what came in."""

    def __init__(self, script=None, **options):
        self.script = script or Script(**options)
        self.lock = threading.Lock()
        self.position = [0.0] * self.script.joints
        self.points = []
        self.frames = []
        self.stops = []
        self.hellos = 0
        self.connections = 0
        self.trajectory = 0
        self.progress = [0, 0, 0, 0, 0, 0, -1, 0]
        self.extra = b""
        """Sent once after the next state to a client that sent HELLO."""
        self.repeated = b""
        """Sent after each state to a client that sent HELLO."""
        self._plan = None
        self._started = 0.0
        self._moving = False
        self._ended = threading.Event()
        self._clients = set()
        self._servers = {name: self._listen() for name in ("motion", "state", "control")}
        self.ports = {name: server.getsockname()[1] for name, server in self._servers.items()}
        self._threads = [
            threading.Thread(target=self._accept, args=(name,), daemon=True)
            for name in self._servers
        ]
        for thread in self._threads:
            thread.start()

    @property
    def address(self):
        control = self.ports["control"] if self.script.control else 0
        return f"127.0.0.1:{self.ports['motion']},{self.ports['state']},{control}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._ended.set()
        for server in self._servers.values():
            with contextlib.suppress(OSError):
                server.shutdown(socket.SHUT_RDWR)
            server.close()
        self.drop()
        for thread in list(self._threads):
            thread.join(5)

    def drop(self, only=None):
        """Close what is connected, as a controller that restarts."""
        with self.lock:
            clients = [c for c in self._clients if only is None or c[0] == only]
        for _, client in clients:
            with contextlib.suppress(OSError):
                client.shutdown(socket.SHUT_RDWR)

    @staticmethod
    def _listen():
        server = socket.create_server(("127.0.0.1", 0))
        server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        return server

    def _accept(self, name):
        while not self._ended.is_set():
            try:
                client, _ = self._servers[name].accept()
            except OSError:
                return
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.connections += 1
            with self.lock:
                self._clients.add((name, client))
            serve = {"state": self._state, "motion": self._motion, "control": self._control}[name]
            thread = threading.Thread(target=self._guarded, args=(serve, name, client), daemon=True)
            self._threads.append(thread)
            thread.start()

    def _guarded(self, serve, name, client):
        try:
            serve(client)
        except OSError:
            pass
        finally:
            with self.lock:
                self._clients.discard((name, client))
            client.close()

    # The motion port

    def _motion(self, client):
        buffer = b""
        while data := client.recv(self.script.read_bytes):
            buffer += data
            if self.script.read_pause:
                self._ended.wait(self.script.read_pause)
            result, buffer = pieces(buffer)
            for piece in result:
                self._take(client, piece)

    def _take(self, client, piece):
        _, number, comm, _ = HEAD.unpack_from(piece)
        if number == 1302:
            with self.lock:
                self.script.stream.advance(time.monotonic())
                reply = self.script.stream.points(piece)
            client.sendall(reply)
            return
        values = POINT.unpack_from(piece, 16)
        sequence = values[0]
        self.frames.append((number, comm, sequence))
        if sequence == -4:
            self.stops.append(time.monotonic())
            self._halt()
            if self.script.answer_stop and comm == 2:
                client.sendall(frame(11, 3, self.script.stop_code))
            return
        with self.lock:
            if sequence == -1:
                self.points = []
                self.trajectory += 1
                self.progress = [self.trajectory, 1, 0, 0, 0, 0, -1, 0]
            self.points.append((values[1 : 1 + self.script.joints], values[12]))
            self.progress[2] = len(self.points)
        if sequence == -3 and comm == 2:
            self._ended.wait(self.script.end_delay)
            if self.script.refuse:
                with self.lock:
                    self.progress[1] = 4
                    self.progress[5:8] = self.script.refuse
                client.sendall(frame(11, 3, 2, struct.pack("<3i", *self.script.refuse)))
                return
            if self.script.bare_failure:
                client.sendall(frame(11, 3, 2))
                return
            self._start()
            if self.script.answer_end:
                number = struct.pack("<i", self.trajectory) if self.script.rapidgen else b""
                client.sendall(frame(11, 3, 1, number))

    def _start(self):
        with self.lock:
            if not self.script.moves:
                return
            times = [0.0]
            for _, duration in self.points[1:]:
                times.append(times[-1] + duration / self.script.speed)
            self._plan = (times, [list(point) for point, _ in self.points])
            self._started = time.monotonic()
            self._moving = True
            self.progress[1] = 2

    def _halt(self):
        with self.lock:
            if self.script.stream is not None:
                self.script.stream.halt(6, 40)
            if self._moving:
                self.progress[1] = 6
                self.progress[5] = 40
            if not self.script.coasts:
                self._moving = False

    def _advance(self):
        if not self._moving or self._plan is None:
            return
        times, points = self._plan
        elapsed = time.monotonic() - self._started
        if elapsed >= times[-1] * self.script.ends_at:
            elapsed = times[-1] * self.script.ends_at
            self._moving = False
            failed = self.script.ends_at < 1
            self.progress[1] = 5 if failed else 3
            if failed:
                self.progress[5:8] = (44, len([t for t in times if t <= elapsed]), 0)
        passed = len([t for t in times if t <= elapsed])
        self.progress[3] = self.progress[4] = passed
        if passed == len(times):
            self.position = points[-1]
            return
        before, after = points[passed - 1], points[passed]
        fraction = (elapsed - times[passed - 1]) / (times[passed] - times[passed - 1])
        self.position = [a + fraction * (b - a) for a, b in zip(before, after, strict=True)]

    # The control port

    def _control(self, client):
        if self.script.raw_control:
            client.sendall(self.script.raw_control)
        buffer = b""
        while data := client.recv(4096):
            buffer += data
            result, buffer = pieces(buffer)
            for piece in result:
                number = HEAD.unpack_from(piece)[1]
                if number == 1300:
                    client.sendall(self._hello(self.script.foreign_control))
                elif number == 11:
                    if self.script.control_hears_stop:
                        self._take(client, piece)
                        self._tell_stop(client)
                elif self.script.stream is not None:
                    with self.lock:
                        self.script.stream.advance(time.monotonic())
                        reply = self.script.stream.control(number, piece[16:])
                    client.sendall(reply)
        if self.script.stream is not None:
            with self.lock:
                self.script.stream.control_lost()

    def _tell_stop(self, client):
        stream = self.script.stream
        if stream is not None and stream.trajectory:
            with self.lock:
                answer = stream.control(11, b"")
            # The reply to STOP was sent already.
            client.sendall(answer[len(frame(11, 3, 1)) :])

    # The state port

    def _state(self, client):
        script = self.script
        if script.raw_state is not None:
            client.sendall(script.raw_state)
            return
        subscribed = False
        report = 0
        client.setblocking(False)
        received = b""
        pending = []
        while not self._ended.is_set():
            with contextlib.suppress(BlockingIOError):
                data = client.recv(4096)
                if not data:
                    return
                received += data
            out = b""
            if len(received) >= 36:
                received = received[36:]
                self.hellos += 1
                if script.rapidgen:
                    out += self._hello()
                    subscribed = True
            with self.lock:
                self._advance()
                moving, progress = (
                    self._moving,
                    frame(1301, 1, 0, struct.pack("<8i", *self.progress)),
                )
                if script.stream is not None:
                    script.stream.advance(time.monotonic())
                    if script.stream.trajectory:
                        self.position = list(script.stream.position)
                        moving, progress = script.stream.is_moving, script.stream.progress()
                out += joint_frame(self.position)
                out += status_frame(**{"in_motion": int(moving), **script.status})
                if subscribed:
                    out += progress + self.extra + self.repeated
                    self.extra = b""
                if subscribed and script.feedback:
                    report += 1
                    pad = [0.0] * (10 - script.joints)
                    values = [*self.position, *pad, *[0.0] * 20]
                    out += frame(15, 1, 0, struct.pack("<2if30f", 0, 7, report * 0.02, *values))
                moving_for = time.monotonic() - self._started if self._moving else 0.0
            if moving_for < script.silent_after:
                pending.append(out)
            if len(pending) >= script.merge:
                self._send(client, b"".join(pending))
                pending = []
            self._ended.wait(script.state_period)

    def _send(self, client, data):
        client.setblocking(True)
        size = self.script.chop or len(data) or 1
        for at in range(0, len(data), size):
            client.sendall(data[at : at + size])
        client.setblocking(False)

    def _hello(self, foreign=False):
        if self.script.hello is not None:
            return self.script.hello
        return hello_reply(self.script, self.ports["control"], foreign=foreign)
