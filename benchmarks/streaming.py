"""Streams of points on the reference cost model, beside abb_driver's modules where they are.

    python benchmarks/streaming.py [FOLDER with abb_driver's six modules] [--points N]

Simulated time for one more point through every check, for the built-in part of the cost model times
1/4, 1 and 4; socket calls of the motion server for a point; time to first motion beside that of the
same points sent whole; STOP on its own connection under full load; and a stream of 100,000 points:
whether the robot ever rests, and memory. Ratios of algorithms in our cost and motion model; no
controller was measured.
"""

import argparse
import gc
import resource
import struct
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.machine.costs import Costs
from rapidgen.wire.simple_message.bulk import encode_points
from rapidgen.wire.simple_message.spec import StreamFlag
from tests.foreign.abb_driver import read_system
from tests.generate.bench import STOP, Bench, Client, trajectory

BATCH = 30
RING = 127
SOCKETS = {"ros_receive", "ros_send", "ros_peek", "ros_accept"}


def wave(count: int, *, duration: float = 0.1, start: int = 0) -> tuple[npt.NDArray, npt.NDArray]:
    """Durations and joints of a slow wave from zero that never ends."""
    steps = np.arange(start, start + count)[:, None]
    joints = 0.3 * np.sin(steps * (0.01 + 0.002 * np.arange(6)))
    durations = np.full(count, duration)
    if start == 0:
        durations[0] = 0.0
    return durations, joints


def batches(count: int, *, flags: int = StreamFlag.BEGIN, duration: float = 0.1) -> list[bytes]:
    return encode_points(7, 0, *wave(count, duration=duration), flags=flags)


def reply(client: Client) -> tuple[int, ...]:
    """Data of the next acknowledgement."""
    frame = client.wait_frame(timeout=10)
    assert frame is not None
    assert struct.unpack_from("<3i", frame, 4) == (1302, 3, 1), "refused"
    return struct.unpack_from("<7i", frame, 16)


def per_point(config: RobotConfig, scale: float, *, foreign: Path | None = None) -> float:
    """Simulated s for one more point, nothing moving meanwhile."""
    costs = Costs().scaled(scale)
    if foreign is None:
        policy = replace(config.trajectory, ring=512, preload=10, min_segment=0.01)
        bench = Bench(replace(config, trajectory=policy), costs=costs)
        frames = batches(300, duration=0.02)
        client = bench.client()
        client.send(frames[0])
        reply(client)
        start = bench.vc.now
        client.send(b"".join(frames[1:9]))
        for _ in range(8):
            reply(client)
        taken = (bench.vc.now - start) / (8 * BATCH)
        bench.stop()
        return taken
    ends = []
    for count in (20, 90):
        bench = Bench(config, system=read_system(foreign), costs=costs)
        client = bench.client()
        _, joints = wave(count + 1)
        start = bench.vc.now
        client.send(b"".join(trajectory(joints.tolist(), [0.2] * len(joints))[:count]) + STOP)
        assert client.wait_frame(timeout=30)
        ends.append(bench.vc.now - start)
        bench.stop()
    return (ends[1] - ends[0]) / 70


def socket_calls(config: RobotConfig, count: int = 1200) -> float:
    """Socket calls of the motion server for a point, the robot following."""
    bench = Bench(config, tracing=True)
    calls = [0]

    def traced(task, routine, node):
        if task.name == "T_ROS_RECV" and routine.name.lower() in SOCKETS:
            calls[0] += node is routine.node.body[0]

    client = bench.client()
    bench.vc.run_for(0.5)
    bench.vc.tracers.append(traced)
    for _ in feed(bench, client, count):
        bench.vc.run_for(0.5)
    bench.stop()
    return calls[0] / count


def feed(bench: Bench, client: Client, count: int) -> Iterator[int]:
    """Send a stream in full batches as there is room; yields while there is none."""
    first, allowed = 0, RING
    while first < count:
        size = min(BATCH, count - first)
        if first + size > allowed:
            yield first
            allowed = bench.pers("ROS_planned", "T_ROB1") + RING
            continue
        flags = (StreamFlag.BEGIN if first == 0 else 0) | (
            StreamFlag.END if first + size == count else 0
        )
        durations, joints = wave(size, start=first)
        client.send(encode_points(7, first, durations, joints, flags=flags)[0])
        _, _, accepted, _, planned, _, _ = reply(client)
        assert accepted == first + size
        first += size
        allowed = planned + RING
    while bench.pers("ROS_done") != 1:
        yield first


def first_motion(config: RobotConfig, count: int, seed: int) -> float:
    """s until the robot moves, for a stream of `count` points."""
    bench = Bench(config, seed=seed)
    client = bench.client()
    bench.vc.run_for(1 + 0.013 * seed)
    start = bench.vc.now
    client.send(batches(count)[0])
    assert bench.vc.run_until(lambda: not bench.group.is_standing, timeout=10)
    taken = bench.vc.now - start
    bench.stop()
    return taken


def first_motion_of_a_download(config: RobotConfig, count: int) -> float:
    bench = Bench(config)
    client = bench.client()
    bench.vc.run_for(1)
    start = bench.vc.now
    _, joints = wave(count)
    client.send(b"".join(trajectory(joints.tolist(), [10.0] + [0.1] * (count - 1))))
    assert bench.vc.run_until(lambda: not bench.group.is_standing, timeout=60)
    taken = bench.vc.now - start
    bench.stop()
    return taken


def stopping(config: RobotConfig, seed: int) -> float:
    """s from the delivery of STOP to the robot being told, the reader and the state server busy."""
    bench = Bench(replace(config, state_period=0.02), seed=seed)
    client, own = bench.client(), bench.client(config.groups[0].ports.control)
    for _ in range(3):
        watcher = bench.state_client()
        watcher.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 1 + 16 + 32))
    frames = batches(1500)
    client.send(frames[0])
    reply(client)
    bench.vc.run_for(1.1 + 0.0137 * seed)
    client.network.send(client.endpoint, b"".join(frames[1:]))
    bench.vc.run_for(0.004 + 0.0031 * seed)
    own.network.send(own.endpoint, STOP)
    start = bench.vc.now
    assert bench.vc.run_until(lambda: bench.group.stop_reasons != (), timeout=2)
    taken = bench.vc.now - start
    bench.stop()
    return taken


def endless(config: RobotConfig, count: int) -> None:
    """A long stream: rests of the robot, memory, and what it took."""
    bench = Bench(config)
    client = bench.client()
    rests, moving = [0], [False]

    def changed():
        if moving[0] and bench.group.is_standing:
            rests[0] += 1
        moving[0] = not bench.group.is_standing

    bench.group.changed.add(changed)
    began, thirds, start = time.process_time(), [], bench.vc.now
    for first in feed(bench, client, count):
        bench.vc.run_for(1.0)
        if first * 3 // count > len(thirds):
            gc.collect()
            thirds.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    taken = bench.vc.now - start
    asked = 0.1 * (count - 1)
    gc.collect()
    thirds.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    print(
        f"{count} points: {taken:.1f} s for {asked:.1f} s asked, {rests[0] - 1} rests before the "
        f"end, memory {' '.join(f'{m:.0f}' for m in thirds)} MB, complaints "
        f"{sum(e.type.name != 'INFO' for e in bench.vc.log)}, "
        f"{time.process_time() - began:.0f} s of CPU"
    )
    bench.stop()


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("foreign", nargs="?", type=Path)
    parser.add_argument("--points", type=int, default=100_000)
    options = parser.parse_args()
    config = load_config("irb120")
    for scale in (0.25, 1.0, 4.0):
        own = per_point(config, scale)
        line = f"a point, built-ins x {scale:g}: {own * 1e3:.3f} ms"
        if options.foreign:
            other = replace(config, trajectory=replace(config.trajectory, capacity=100))
            theirs = per_point(other, scale, foreign=options.foreign)
            line += f", abb_driver's {theirs * 1e3:.3f} ms: {own / theirs:.2f} x"
        print(line)
    print(f"socket calls of the motion server for a point: {socket_calls(config):.3f}")
    stream = sorted(first_motion(config, 1000, seed) for seed in range(15))
    short = sorted(first_motion(config, 60, seed) for seed in range(15))
    whole = first_motion_of_a_download(config, 1000)
    print(
        f"first motion of 1,000 points: {stream[7] * 1e3:.0f} ms (worst {stream[-1] * 1e3:.0f}), "
        f"sent whole {whole * 1e3:.0f} ms: 1/{whole / stream[7]:.0f}; of 60 points "
        f"{short[7] * 1e3:.0f} ms"
    )
    found = sorted(stopping(config, seed) for seed in range(30))
    print(f"STOP on its own connection: {found[15] * 1e3:.1f} ms, worst {found[-1] * 1e3:.1f} ms")
    endless(config, options.points)


if __name__ == "__main__":
    main()
