"""Measure the client over loopback, with sinks in a separate process.

python benchmarks/client.py [--quick]
"""

import asyncio
import contextlib
import dataclasses
import multiprocessing
import os
import resource
import selectors
import socket
import statistics
import struct
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import numpy as np

import rapidgen
from rapidgen.client import AsyncRobot, MotionStopped, Robot, RobotError, Timeouts, Trajectory
from rapidgen.client.address import Address
from rapidgen.client.core.group import Group
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.flows.effects import Send
from rapidgen.client.sync_runner import Connection
from rapidgen.wire.simple_message.numpy_codec import (
    FRAME_BYTES,
    decode_batches,
    encode_points,
    encode_trajectory,
)
from rapidgen.wire.simple_message.spec import PROTOCOL_VERSION, Port, Sequence

HEAD = struct.Struct("<4i")
JOINT = HEAD.pack(56, 10, 1, 0) + struct.pack("<i10f", 0, *[0.0] * 10)
STATUS = HEAD.pack(40, 13, 1, 0) + struct.pack("<7i", 1, 0, 0, 0, 0, 2, 1)
REPLY = HEAD.pack(12, 11, 3, 1)
HELLO_BYTES = 36
HELLO = struct.pack("<2i", 1300, 2)
RING = 512
BEAT = HEAD.pack(16, 1306, 2, 0)


def hello(features):
    limits = [3.0] * 6 + [0.0] * 4
    data = struct.pack("<4i12s12s4i4f", PROTOCOL_VERSION, 0, 1, 0, b"0" * 12, b"", features,
                       10**9, 6, 0, 0.02, 0.1, 0.01, 0.005)  # fmt: skip
    data += struct.pack("<30f", *[-v for v in limits], *limits, *[9.0] * 10)
    data += struct.pack("<iifii", 1 if features & 2 else 0, RING, 0.5, 30, 0)
    return HEAD.pack(12 + len(data), 1300, 3, 1) + data


def progress(number, state):
    return HEAD.pack(44, 1301, 1, 0) + struct.pack("<8i", number, state, 0, 0, 0, 0, -1, 0)


class Sink:
    """Ports of one robot: sends states, discards points, answers STOP and end."""

    def __init__(self, *, period, bytes_per_second=0.0, features=1, stamps=None):
        self.period, self.rate, self.features = period, bytes_per_second, features
        self.stamps = stamps
        self.servers = [socket.create_server(("127.0.0.1", 0)) for _ in range(3)]
        self.ports = [server.getsockname()[1] for server in self.servers]
        self.number, self.state = 0, 0

    def start(self):
        motion, control, state = self.servers
        for server, serve in ((motion, self.motion), (control, self.control), (state, self.tell)):
            threading.Thread(target=self.accept, args=(server, serve), daemon=True).start()

    @staticmethod
    def accept(server, serve):
        def served(client):
            # A client that disconnects is no error.
            with contextlib.suppress(OSError):
                serve(client)

        while True:
            client, _ = server.accept()
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            threading.Thread(target=served, args=(client,), daemon=True).start()

    def motion(self, client):
        if self.features & 4:
            self.points(client)
            return
        rest = b""
        while data := client.recv(1 << 16 if self.rate else 1 << 20):
            if self.rate:
                time.sleep(len(data) / self.rate)
            rest += data
            whole = len(rest) // FRAME_BYTES * FRAME_BYTES
            sequences = np.frombuffer(rest[:whole], "<i4").reshape(-1, FRAME_BYTES // 4)[:, 4]
            rest = rest[whole:]
            for sequence in sequences[sequences < 0].tolist():
                if sequence == Sequence.END:
                    self.number += 1
                    self.state = 3
                    client.sendall(HEAD.pack(16, 11, 3, 1) + struct.pack("<i", self.number))
                elif sequence == Sequence.STOP:
                    client.sendall(REPLY)

    def points(self, client):
        """Execute points immediately, as a driver: all batches are accepted."""
        buffer, accepted = b"", 0
        self.number, self.state = self.number + 1, 2
        while data := client.recv(1 << 20):
            buffer += data
            replies = b""
            while len(buffer) >= 4 and len(buffer) >= 4 + (n := HEAD.unpack(buffer[:16])[0]):
                stream, flags, first, count = struct.unpack_from("<4i", buffer, 16)
                buffer = buffer[4 + n :]
                accepted = first + count
                self.state = 3 if flags & 2 else 2
                done = (stream, self.number, accepted, RING, accepted, accepted, self.state)
                replies += HEAD.pack(40, 1302, 3, 1) + struct.pack("<7i", *done)
            client.sendall(replies)

    def control(self, client):
        client.recv(HELLO_BYTES)
        client.sendall(hello(self.features))
        while data := client.recv(4096):
            now = time.monotonic_ns()
            # Heartbeats and HELLO arrive besides STOP: they are answered, and not counted.
            for beat in range(data.count(BEAT)):
                client.sendall(HEAD.pack(20, 1306, 3, 1) + struct.pack("<2i", beat, 2))
            for _ in range(data.count(HELLO)):
                client.sendall(hello(self.features))
            for _ in range(data.count(STOP_FRAME)):
                self.stamps.put(now)
                client.sendall(REPLY)

    def tell(self, client):
        client.recv(HELLO_BYTES)
        client.sendall(hello(self.features))
        while True:
            try:
                client.sendall(JOINT + STATUS + progress(self.number, self.state))
            except OSError:
                return
            time.sleep(self.period)


def serve_sink(pipe, options, stamps):
    sink = Sink(**options, stamps=stamps)
    sink.start()
    pipe.send(sink.ports)
    pipe.recv()


class Running:
    """A sink in a process of its own."""

    def __init__(self, target=serve_sink, **options):
        context = multiprocessing.get_context("spawn")
        self.pipe, other = context.Pipe()
        self.stamps = context.SimpleQueue()
        self.process = context.Process(target=target, args=(other, options, self.stamps))
        self.process.start()
        self.ports = self.pipe.recv()

    def address(self):
        motion, control, state = self.ports
        return Address("127.0.0.1", motion, state, control)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.join()


def robot_at(running, **options):
    robot = Robot(str(running.address()), timeouts=Timeouts(send=30, reply=60, **options))
    return robot


def still(count):
    return Trajectory(np.arange(count) * 0.1, np.zeros((count, 6)))


def encoding(count):
    joints, durations = np.random.default_rng(1).normal(size=(count, 6)), np.full(count, 0.1)
    best = min(_timed(lambda: encode_trajectory(joints, durations)) for _ in range(5))
    print(f"encode alone                {count / best:14,.0f} points/s   (>= 1,000,000)")


def points(count):
    """Measure POINTS by numpy, both directions, in bulk and singly."""
    joints = np.random.default_rng(1).uniform(-3, 3, size=(count, 6))
    durations = np.full(count, 0.1)
    frames = encode_points(1, 0, durations, joints)
    best = min(_timed(lambda: encode_points(1, 0, durations, joints)) for _ in range(5))
    print(f"POINTS, encode              {count / best:14,.0f} points/s   (>= 1,000,000)")
    best = min(_timed(lambda: decode_batches(frames, 6)) for _ in range(5))
    print(f"POINTS, decode and check    {count / best:14,.0f} points/s   (>= 1,000,000)")
    few = frames[: min(len(frames), 1000)]
    one = [(durations[i : i + 30], joints[i : i + 30]) for i in range(0, 30 * len(few), 30)]
    best = min(_timed(lambda: [encode_points(1, 0, *some) for some in one]) for _ in range(5))
    print(f"POINTS, one message a call  {30 * len(few) / best:14,.0f} points/s")


def streaming(count, rounds):
    """Measure points that are checked, encoded, sent and acknowledged.

    The sink executes immediately.
    """
    times, joints = np.arange(count) * 0.1, np.zeros((count, 6))
    rates = []
    for _ in range(rounds):
        with Running(period=0.02, features=5) as sink, robot_at(sink) as robot:
            stream = robot.stream()
            started = time.perf_counter()
            for at in range(0, count, 3000):
                stream.append(times[at : at + 3000], joints[at : at + 3000])
            stream.end()
            robot.wait_until(lambda s, stream=stream: stream.is_over, 60)
            rates.append(count / (time.perf_counter() - started))
            stream.result()
    print(f"stream, with replies        {statistics.median(rates):14,.0f} points/s")


def _timed(function):
    started = time.perf_counter()
    function()
    return time.perf_counter() - started


def sending(count, rounds):
    with Running(period=0.02) as sink, robot_at(sink) as robot:
        trajectory = still(count)
        rates = []
        for _ in range(rounds):
            started = time.perf_counter()
            execution = robot.execute(trajectory)
            rates.append(count / (time.perf_counter() - started))
            execution.result()
    print(f"check, encode, send, reply  {statistics.median(rates):14,.0f} points/s   (>= 150,000)")


def decoding(count):
    state_port = StatePort(time.monotonic)
    state_port.use(Group.unknown([f"joint_{i}" for i in range(6)]))
    data = (JOINT + STATUS) * 20
    rounds = count // 40
    best = min(_timed(lambda: [state_port.feed(data) for _ in range(rounds)]) for _ in range(3))
    print(f"decode, merged segments     {rounds * 40 / best:14,.0f} messages/s (>= 200,000)")
    pair = JOINT + STATUS
    best = min(_timed(lambda: [state_port.feed(pair) for _ in range(rounds)]) for _ in range(3))
    print(f"decode, two a segment       {rounds * 2 / best:14,.0f} messages/s")


def stopping(stops):
    """Measure the time from the call of stop() to STOP at the sink.

    Another thread sends a trajectory to a controller that reads 50 MB/s, so that its buffers
    are full.
    """
    with Running(period=0.02, bytes_per_second=5e7, features=3) as sink, robot_at(sink) as robot:
        finished = threading.Event()
        trajectory = still(100_000)

        def load():
            while not finished.is_set():
                try:
                    robot.execute(trajectory)
                except RobotError:
                    # Stopped, or the one before was sent as a whole and is not stopped yet.
                    time.sleep(0.001)

        loader = threading.Thread(target=load, daemon=True)
        loader.start()
        latencies = []
        pauses = np.random.default_rng(1).uniform(0.02, 0.05, stops)
        for pause in pauses.tolist():
            while robot._core.motion is None or robot._core.motion.is_over:
                time.sleep(0.001)
            time.sleep(pause)
            started = time.monotonic_ns()
            robot.stop()
            latencies.append((sink.stamps.get() - started) / 1e6)
        finished.set()
        while loader.is_alive():
            robot.stop()
            loader.join(0.1)
    result = np.percentile(latencies, [50, 99, 100])
    print(
        f"stop, under load            p50 {result[0]:.3f} ms, p99 {result[1]:.3f} ms, "
        f"worst {result[2]:.3f} ms over {stops} (p99 <= 1 ms)"
    )


def connecting(rounds):
    """Measure connections of all ports, with HELLO and the first state, and their end."""
    with Running(period=0.02, features=3) as sink:
        started = time.perf_counter()
        for _ in range(rounds):
            with robot_at(sink):
                pass
        rate = rounds / (time.perf_counter() - started)
    print(f"connect and close           {rate:14,.1f} robots/s")


def importing(rounds):
    """Measure the CPU time of `import rapidgen.client` in a new process."""

    def seconds(code):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, "-c", code], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    bare = statistics.median(seconds("import numpy") for _ in range(rounds))
    whole = statistics.median(seconds("import rapidgen.client") for _ in range(rounds))
    print(f"import                      {1000 * (whole - bare):14,.0f} ms, besides numpy")


def frames_before_stop(rounds):
    """Count frames between stop() and STOP on the standard port.

    At most the one in progress.
    """

    def send(connection, data, motion):
        with contextlib.suppress(MotionStopped):
            connection.send(Send(Port.MOTION, data, 5.0, motion))

    worst = 0
    for _ in range(rounds):
        server = socket.create_server(("127.0.0.1", 0))
        connection = Connection(Address("127.0.0.1", server.getsockname()[1]), Port.MOTION, 1)
        peer, _ = server.accept()
        motion = SimpleNamespace(stopping=False)
        data = encode_trajectory(np.zeros((300_000, 6)), np.full(300_000, 0.1))
        sender = threading.Thread(target=send, args=(connection, data, motion))
        sender.start()
        peer.recv(1000)
        time.sleep(0.01)
        # The bytes in the kernel were sent before.
        before = _written(connection, peer)
        motion.stopping = True
        connection.offer_after(STOP_FRAME)
        stop = threading.Thread(target=connection.finish, args=(5.0,))
        stop.start()
        received = bytearray()
        while not received.endswith(STOP_FRAME):
            received += peer.recv(1 << 20)
        sender.join()
        stop.join()
        worst = max(worst, (len(received) - FRAME_BYTES - before) / FRAME_BYTES)
        connection.close()
        peer.close()
        server.close()
    print(f"stop, standard port         {worst:.2f} frames between stop() and STOP (<= 1)")


def _written(connection, peer):
    """Return bytes in the scheduler, of both ends, once the sender blocks."""
    import fcntl
    import termios

    def pending(sock, request):
        return struct.unpack("i", fcntl.ioctl(sock, request, b"\0" * 4))[0]

    while True:
        first = pending(connection.socket, termios.TIOCOUTQ) + pending(peer, termios.FIONREAD)
        time.sleep(0.02)
        again = pending(connection.socket, termios.TIOCOUTQ) + pending(peer, termios.FIONREAD)
        if first == again:
            return first


def serve_many(pipe, options, _):
    """Serve state ports of many robots at one rate, from one thread."""
    servers = [socket.create_server(("127.0.0.1", 0)) for _ in range(options["robots"])]
    pipe.send([server.getsockname()[1] for server in servers])
    selector = selectors.DefaultSelector()
    for server in servers:
        selector.register(server, selectors.EVENT_READ)
    clients = []
    due = time.monotonic()
    while True:
        for key, _ in selector.select(max(0, due - time.monotonic())):
            client, _ = key.fileobj.accept()
            client.sendall(hello(1))
            clients.append(client)
        if time.monotonic() >= due:
            for client in clients:
                client.sendall(JOINT + STATUS + progress(1, 3))
            due += options["period"]


def watching(robots, seconds):

    async def watch(ports):
        watched = [AsyncRobot(f"127.0.0.1:{port},{port}", watch=True) for port in ports]
        for robot in watched:
            await robot.connect()
        cpu, wall = time.process_time(), time.monotonic()
        before = [robot.state.number for robot in watched]
        await asyncio.sleep(seconds)
        used = (time.process_time() - cpu) / (time.monotonic() - wall)
        rate = sum(r.state.number - b for r, b in zip(watched, before, strict=True)) / seconds
        for robot in watched:
            await robot.close()
        return used, rate / len(ports)

    with Running(serve_many, robots=robots, period=0.02) as server:
        used, rate = asyncio.run(watch(server.ports))
    print(
        f"{robots} robots watched         {rate:.1f} states/s each, {used:.0%} of a core (<= 60 %)"
    )


def stages():
    """Count what a trajectory passes between execute() and its last byte on the socket.

    A stop is a function of the package that gets its points as an argument (trajectory, array,
    bytes, or data with one of these). A return is a call in a file that the points had left.
    """
    package = os.path.dirname(rapidgen.__file__)
    calls = []
    sent = 0

    def holds_points(value):
        if isinstance(value, Trajectory | np.ndarray | bytes | memoryview):
            return True
        if not dataclasses.is_dataclass(value) or isinstance(value, type):
            return False
        names = [field.name for field in dataclasses.fields(value)]
        kinds = Trajectory | np.ndarray | bytes
        return any(isinstance(getattr(value, name, None), kinds) for name in names)

    def profile(frame, event, argument):
        nonlocal sent
        code = frame.f_code
        if event == "c_call" and getattr(argument, "__name__", "") == "send":
            sent = len(calls)
        if event != "call" or not code.co_filename.startswith(package):
            return
        arguments = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        holds = any(holds_points(frame.f_locals.get(name)) for name in arguments)
        calls.append((code.co_filename, code.co_name, code.co_firstlineno, holds))

    with Running(period=0.02, features=3) as sink, robot_at(sink) as robot:
        trajectory = still(4)
        robot.execute(trajectory).result()
        sys.setprofile(profile)
        execution = robot.execute(trajectory)
        sys.setprofile(None)
        execution.result()

    def count(title, some):
        files = [file for file, *_ in some]
        visits = [
            file for file, before in zip(files, [None, *files], strict=False) if file != before
        ]
        print(
            f"{title:27s} {len(some):5d} calls, {len(set(some))} functions, "
            f"{len(set(files))} files, {len(visits) - len(set(files))} returns to a file"
        )

    count("execute to socket, all", calls[:sent])
    count("execute to socket, points", [call for call in calls[:sent] if call[-1]])


def memory(points):
    """Measure resident memory over trajectories of 100,000 points."""
    with Running(period=0.02) as sink, robot_at(sink) as robot:
        trajectory = still(100_000)
        marks = []
        for _ in range(points // 100_000):
            robot.execute(trajectory).result()
            with open("/proc/self/statm") as file:
                marks.append(int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 2**20)
    third = len(marks) // 3
    growth = statistics.median(marks[-third:]) - statistics.median(marks[third : 2 * third])
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"memory over {points:,} points  {growth:+.1f} MB in the last third, peak {peak:.0f} MB")


def main():
    quick = "--quick" in sys.argv
    encoding(200_000)
    points(200_000)
    decoding(100_000)
    streaming(60_000, 1 if quick else 3)
    sending(100_000, 3 if quick else 10)
    frames_before_stop(2 if quick else 10)
    stopping(200 if quick else 1000)
    connecting(50 if quick else 300)
    importing(5 if quick else 15)
    stages()
    watching(100, 2 if quick else 10)
    memory(1_500_000 if quick else 10_000_000)


if __name__ == "__main__":
    main()
