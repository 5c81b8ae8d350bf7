"""Deployment: unchanged plan, 50 controllers against one, campaigns.

    python benchmarks/deploy.py            figures, as ratios within one run
    python benchmarks/deploy.py --cuts     every cut of every case, 10,000 garbled FTP answers,
                                           5,000 garbled SFTP answers and 5,000 damaged SSH lines

The controllers are SFTP and FTP servers of this process on loopback, with a proxy that delays every
packet by 25 ms each way.
"""

import contextlib
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from queue import Queue

from rapidgen.deploy import Access, connect, make_plan, parse_target
from rapidgen.deploy.command_run import FleetJob, apply_all, desired_set, plan_all
from rapidgen.servers import serve_ftp

PASSWORD = "benchmark"
COUNT = 50
EACH_WAY = 0.025


class Slow:
    """A proxy before an FTP server that delays all lines by `EACH_WAY`."""

    def __init__(self, port: int) -> None:
        self.target_port = port
        self.port = self._listen(port, control=True)

    def _listen(self, after: int, *, control: bool) -> int:
        listener = socket.create_server(("127.0.0.1", 0))

        def accept() -> None:
            while True:
                client, _ = listener.accept()
                server = socket.create_connection(("127.0.0.1", after))
                for sock in (client, server):
                    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self._pipe(client, server, control=False)
                self._pipe(server, client, control=control)
                if not control:
                    listener.close()
                    return

        threading.Thread(target=accept, daemon=True).start()
        return int(listener.getsockname()[1])

    def _pipe(self, source: socket.socket, sink: socket.socket, *, control: bool) -> None:
        line: Queue[tuple[float, bytes]] = Queue()

        def read() -> None:
            block = b"x"
            while block:
                try:
                    block = source.recv(65536)
                except OSError:
                    block = b""
                line.put(
                    (time.monotonic() + EACH_WAY, self._rewritten(block) if control else block)
                )

        def write() -> None:
            while True:
                when, block = line.get()
                time.sleep(max(0.0, when - time.monotonic()))
                with contextlib.suppress(OSError):
                    if not block:
                        sink.shutdown(socket.SHUT_WR)
                        return
                    sink.sendall(block)

        for work in (read, write):
            threading.Thread(target=work, daemon=True).start()

    def _rewritten(self, block: bytes) -> bytes:
        head, marker, remaining = block.partition(b"227 ")
        if not marker:
            return block
        numbers = remaining[remaining.index(b"(") + 1 : remaining.index(b")")].split(b",")
        port = self._listen(int(numbers[4]) * 256 + int(numbers[5]), control=False)
        text = f"(127,0,0,1,{port // 256},{port % 256})".encode()
        return head + marker + b"passive " + text + b".\r\n"


def figures() -> None:
    """Print the figures."""
    os.environ["RAPIDGEN_PASSWORD"] = PASSWORD
    desired = desired_set("irb120")
    with tempfile.TemporaryDirectory() as name, contextlib.ExitStack() as stack:
        urls, slow = [], []
        for number in range(COUNT + 1):
            home = Path(name) / str(number)
            home.mkdir()
            service = serve_ftp(home, password=PASSWORD)
            stack.callback(service.close)
            urls.append(f"ftp://Default%20User@127.0.0.1:{service.port}")
            slow.append(f"ftp://Default%20User@127.0.0.1:{Slow(service.port).port}")
        access = Access()

        def deploy(chosen: list[str]) -> float:
            targets = tuple(parse_target(url) for url in chosen)
            job = FleetJob("deploy", targets, access, lambda _: desired, parallel=COUNT)
            start = time.perf_counter()
            outcomes = apply_all(job, plan_all(job), lambda line: None)
            assert all(outcome.word == "done" for outcome in outcomes), outcomes
            return time.perf_counter() - start

        one = deploy(slow[:1])
        many = deploy(slow[1:])
        print(f"deploy, one controller, 50 ms added round trip   {one:6.1f} s")
        print(f"deploy, {COUNT} controllers, --parallel {COUNT}            {many:6.1f} s")
        print(f"ratio (at most 5)                                {many / one:6.2f}")
        transport = connect(parse_target(urls[0]), access)
        times = []
        for _ in range(5):
            start = time.perf_counter()
            assert make_plan(transport, desired).is_empty
            times.append(time.perf_counter() - start)
        transport.close()
        print(f"plan of an unchanged controller (at most 1 s)    {sorted(times)[2]:6.3f} s")


def campaign() -> int:
    """Run every cut of every case over every transport, and garbled answers."""
    command = [sys.executable, "-m", "pytest", "-q", "tests/deploy", "--timeout", "3600"]
    return subprocess.run(command, env={**os.environ, "RAPIDGEN_LONG": "1"}, check=False).returncode


if __name__ == "__main__":
    if "--cuts" in sys.argv:
        sys.exit(campaign())
    figures()
