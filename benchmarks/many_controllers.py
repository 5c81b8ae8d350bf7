"""Many virtual controllers in real time: lateness of state messages.

    python benchmarks/many_controllers.py [--controllers N] [--seconds S]

Each controller is a process of its own (`rapidgen sim irb120 --ports auto`) whose state server is
read here. A message's lateness is its distance from the line i x period that runs below all
arrivals of its connection. Limit: p99 at most 20 ms for 50 controllers on two cores over 60 s.
"""

import argparse
import json
import resource
import selectors
import socket
import statistics
import struct
import subprocess
import sys
import time

SIM = [sys.executable, "-m", "rapidgen.cli", "sim", "irb120", "--ports", "auto"]
JOINT = 10


class Reader:
    """Arrival times of the JOINT messages of one connection."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.socket.setblocking(False)
        self.data = bytearray()
        self.arrivals = []

    def read(self, now):
        self.data += self.socket.recv(65_536)
        while len(self.data) >= 8:
            length, kind = struct.unpack_from("<2i", self.data)
            if len(self.data) < length + 4:
                break
            if kind == JOINT:
                self.arrivals.append(now)
            del self.data[: length + 4]

    def lateness(self):
        """Return milliseconds of each message after the line below all arrivals."""
        times = self.arrivals[5:]
        # Slope of the whole run, between the medians of its two halves.
        half = len(times) // 2
        early, late = times[:half], times[half : 2 * half]
        slope = (statistics.median(late) - statistics.median(early)) / half
        offsets = [t - i * slope for i, t in enumerate(times)]
        base = min(offsets)
        return [(offset - base) * 1000 for offset in offsets]


def start(count):
    """Start the controllers, a few at a time; return (processes, lines)."""
    processes, ready = [], []
    for first in range(0, count, 4):
        batch = [
            subprocess.Popen(SIM, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            for _ in range(min(4, count - first))
        ]
        processes += batch
        for process in batch:
            line = process.stdout.readline()
            if not line.startswith("ready "):
                raise SystemExit("a controller did not come up")
            ready.append(json.loads(line.removeprefix("ready ")))
    return processes, ready


def resident(process):
    """Megabytes of a process."""
    with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
    return 0.0


def measure(ready, seconds):
    """Read all state servers for a while."""
    readers = [Reader(one["ports"]["rob1"]["state"]) for one in ready]
    selector = selectors.DefaultSelector()
    for reader in readers:
        selector.register(reader.socket, selectors.EVENT_READ, reader)
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        for key, _ in selector.select(left):
            key.data.read(time.monotonic())
    for reader in readers:
        reader.socket.close()
    return readers


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--controllers", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    options = parser.parse_args()
    processes, ready = start(options.controllers)
    try:
        readers = measure(ready, options.seconds)
        memory = [resident(process) for process in processes]
    finally:
        for process in processes:
            process.terminate()
        for process in processes:
            process.communicate()
    late = sorted(value for reader in readers for value in reader.lateness())
    counts = [len(reader.arrivals) for reader in readers]
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{options.controllers} controllers, {options.seconds:g} s, {sum(counts)} messages")
    print(f"messages per controller: {min(counts)} to {max(counts)}")
    for name, share in (("median", 0.5), ("p90", 0.9), ("p99", 0.99), ("max", 1.0)):
        print(f"lateness {name:6} {late[min(len(late) - 1, int(share * len(late)))]:7.2f} ms")
    print(f"memory of one: {statistics.median(memory):.0f} MB")
    print(f"CPU of all, start-up included: {used.ru_utime + used.ru_stime:.0f} s")


if __name__ == "__main__":
    main()
