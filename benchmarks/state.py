"""Time of the state port on the reference cost model, by message.

    python benchmarks/state.py

Simulated time of one round (all work of one period: measure, pack, send, check the clients) by
clients and by requested features, measured with a period that cannot be kept; for the built-in part
of the cost model x1/4, x1 and x4. Then the deviation of one client's messages from their schedule
while a robot moves and two other clients connect and disconnect. The figures hold for that model;
no controller was measured.
"""

import struct
import sys
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.machine.cost_model import Costs
from rapidgen.verification.messages import STATUS
from rapidgen.verification.settings import Setting
from rapidgen.verification.testbench import Bench
from rapidgen.wire.simple_message import messages, spec

ALL = spec.Feature.PROGRESS | spec.Feature.FEEDBACK
ROWS = (
    ("1 client, JOINT and STATUS", 1, 0),
    ("... and PROGRESS", 1, spec.Feature.PROGRESS),
    ("... and JOINT_FEEDBACK", 1, spec.Feature.FEEDBACK),
    ("... and both", 1, ALL),
    ("2 clients, JOINT and STATUS", 2, 0),
    ("3 clients, JOINT and STATUS", 3, 0),
    ("3 clients, all", 3, ALL),
)


def hello(expected):
    return struct.pack(
        "<9i", 32, messages.HELLO.number, 2, 0, spec.PROTOCOL_VERSION, 0, 1, 0, expected
    )


def rounds_in(bench, clients, seconds):
    """Return messages of the first client.

    All clients are read, so that none blocks.
    """
    result = 0
    for _ in range(round(seconds / 0.02)):
        bench.run(0.02)
        text = [client.read() for client in clients]
        result += sum(frame.number == STATUS for frame in text[0]) if text else 0
    return result


def round_time(config, clients, expected, scale):
    """Return simulated s of a round without a pause between rounds."""
    bench = Bench(config, make_system(config, build(config)), Setting(costs=Costs().scaled(scale)))
    linked = []
    for _ in range(clients):
        linked.append(bench.state())
        rounds_in(bench, linked, 0.5)
        linked[-1].send(hello(expected))
    rounds_in(bench, linked, 0.5)
    in_use = 4 / rounds_in(bench, linked, 4)
    bench.close()
    return in_use


def straying(config, system):
    """Return the largest deviation of a STATUS from its schedule, in periods."""
    bench = Bench(config, system)
    bench.run(0.5)
    steady, motion = bench.state(), bench.motion()
    bench.run(1)
    started = bench.now
    for n in range(20):
        motion.send(bench.download(bench.wave(20)))
        other = bench.state()
        other.send(hello(ALL if n % 2 else 0))
        bench.run(15)
        other.close()
    stamps = [
        when for when, f in steady.frames if when > started and f.number == messages.STATUS.number
    ]
    period = config.state_period
    bench.close()
    return max(abs(when - stamps[0] - i * period) for i, when in enumerate(stamps)) / period


def main():
    config = load_config("irb120")
    eager = replace(config, state_period=0.0001)
    print(f"{'simulated ms a round':32}{'x1/4':>8}{'x1':>8}{'x4':>8}")
    for name, clients, expected in ROWS:
        times = [round_time(eager, clients, expected, scale) for scale in (0.25, 1, 4)]
        print(f"{name:32}" + "".join(f"{1000 * t:8.2f}" for t in times))
    for rate in (10, 50, 100, 250):
        config = replace(config, state_period=1 / rate)
        off = straying(config, make_system(config, build(config)))
        print(f"{rate} Hz: at most {off:.2f} periods off the schedule")


if __name__ == "__main__":
    main()
