"""Ten simulated hours of an idle driver with a state client.

    python benchmarks/endurance.py [--robot NAME] [--hours H]

Measures memory and speed. The generated driver of a shipped robot on the virtual clock, network in
memory. The client reads and discards every message. Memory is that of the process (VmRSS) at the
end of each tenth. Limits: 60 MB, and no growth after the first tenth (2 %).
"""

import argparse
import time

from rapidgen.controller import VirtualController

TENTHS = 10
LARGEST = 60.0
GROWTH = 1.02


def resident():
    """Return megabytes of this process."""
    with open("/proc/self/status", encoding="ascii") as status:
        line = next(line for line in status if line.startswith("VmRSS:"))
    return int(line.split()[1]) / 1024


class Reader:
    """Reads a connection in memory whenever data arrives."""

    def __init__(self, controller, port):
        self.network = controller.network
        self.endpoint = self.network.connect("127.0.0.1", port)
        self.bytes = 0
        self.endpoint.changed.add(self.read)

    def read(self):
        while not self.endpoint.closed and (data := self.network.receive(self.endpoint, 65_536)):
            self.bytes += len(data)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="irb120")
    parser.add_argument("--hours", type=float, default=10.0)
    options = parser.parse_args()
    seconds = options.hours * 3600
    with VirtualController.from_config(options.robot) as controller:
        controller.run_for(5)
        reader = Reader(controller, controller.motion.group("rob1").config.ports.state)
        used, started = [], time.process_time()
        for _ in range(TENTHS):
            controller.run_for(seconds / TENTHS)
            used.append(resident())
        spent = time.process_time() - started
        states = {task.name: task.state for task in controller.tasks.values()}
    print(
        f"{options.hours:g} h: {reader.bytes:,} bytes of state, {seconds / spent:,.0f} x real time"
    )
    print("MB: " + " ".join(f"{value:.1f}" for value in used))
    print("tasks: " + ", ".join(f"{name} {state}" for name, state in states.items()))
    grown = used[-1] > used[0] * GROWTH
    raise SystemExit(1 if grown or max(used) > LARGEST or not reader.bytes else 0)


if __name__ == "__main__":
    main()
