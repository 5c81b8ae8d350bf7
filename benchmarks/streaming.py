"""Streams of points on the reference cost model, and abb_driver's modules.

    python benchmarks/streaming.py [FOLDER with abb_driver's six modules] [--points N]

Simulated time for one more point through every check, for the built-in part of the cost model times
1/4, 1 and 4; socket calls of the motion server for a point; time to first motion compared with the
same points sent whole; STOP on its own connection under full load; and a stream of 100,000 points:
rests of the robot, and memory. Ratios of algorithms in our cost and motion model; no controller was
measured.
"""

import argparse
import gc
import resource
import struct
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.generate import build, make_system
from rapidgen.machine.cost_model import Costs
from rapidgen.system.model import System
from rapidgen.verification.messages import POINT_BYTES, POINTS, RawComm, RawPointsAccepted
from rapidgen.verification.raw_connection import STOP, RawLink, point_frame
from rapidgen.verification.settings import Setting
from rapidgen.verification.testbench import Bench
from rapidgen.wire.simple_message.numpy_codec import encode_points
from rapidgen.wire.simple_message.spec import StreamFlag
from tools.interop.abb_driver import read_system

BATCH = 35
RING = 127
SOCKETS = {"ros_receive", "ros_send", "ros_peek", "ros_accept"}


def wave(count: int, *, duration: float = 0.1, start: int = 0) -> tuple[npt.NDArray, npt.NDArray]:
    """Return durations and joints of an endless slow wave from zero."""
    steps = np.arange(start, start + count)[:, None]
    joints = 0.3 * np.sin(steps * (0.01 + 0.002 * np.arange(6)))
    durations = np.full(count, duration)
    if start == 0:
        durations[0] = 0.0
    return durations, joints


def batches(count: int, *, flags: int = StreamFlag.BEGIN, duration: float = 0.1) -> list[bytes]:
    return encode_points(7, 0, *wave(count, duration=duration), flags=flags)


@cache
def built(config: RobotConfig) -> System:
    return make_system(config, build(config))


def booted(config: RobotConfig, system: System | None = None, **setting) -> Bench:
    """Return a driver that has waited for half a second."""
    bench = Bench(config, system or built(config), Setting(**setting))
    bench.run(0.5)
    return bench


def reply(link: RawLink) -> RawPointsAccepted:
    """Return the next acknowledgement."""
    text = link.reply(POINTS, 10)
    assert isinstance(text, RawPointsAccepted), text
    return text


def download(count: int, duration: float, joints: npt.NDArray) -> bytes:
    """Return points of a wave, the last one a request."""
    rows = [tuple(row) for row in joints.tolist()]
    return b"".join(
        point_frame(n, count, row, duration, RawComm.REQUEST if n == count - 1 else RawComm.TOPIC)
        for n, row in enumerate(rows)
    )


def per_point(config: RobotConfig, scale: float, *, foreign: Path | None = None) -> float:
    """Return simulated s for one more point, at rest."""
    costs = Costs().scaled(scale)
    if foreign is None:
        policy = replace(config.trajectory, ring=512, preload=10, min_segment=0.01)
        bench = booted(replace(config, trajectory=policy), costs=costs)
        frames = batches(9 * BATCH, duration=0.02)
        client = bench.motion()
        client.send(frames[0])
        reply(client)
        start = bench.now
        client.send(b"".join(frames[1:9]))
        for _ in range(8):
            reply(client)
        in_use = (bench.now - start) / (8 * BATCH)
        bench.close()
        return in_use
    ends = []
    for count in (20, 90):
        bench = booted(config, read_system(foreign), costs=costs)
        client = bench.motion()
        _, joints = wave(count + 1)
        start = bench.now
        client.send(download(count + 1, 0.2, joints)[:-POINT_BYTES] + STOP)
        client.expect_reply(30, "STOP is answered")
        ends.append(bench.now - start)
        bench.close()
    return (ends[1] - ends[0]) / 70


def socket_calls(config: RobotConfig, count: int = 1200) -> float:
    """Return socket calls of the motion server for a point, in motion."""
    bench = booted(config, coverage=True)
    calls = [0]

    def traced(task, routine, node):
        if task == "T_ROS_RECV" and routine.name.lower() in SOCKETS:
            calls[0] += node is routine.node.body[0]

    client = bench.motion()
    bench.run(0.5)
    bench.controller.statements.listen(traced)
    for _ in feed(bench, client, count):
        bench.run(0.5)
    bench.close()
    return calls[0] / count


def feed(bench: Bench, client: RawLink, count: int) -> Iterator[int]:
    """Send a stream in full batches as they fit; yield while full."""
    first, allowed = 0, RING
    while first < count:
        size = min(BATCH, count - first)
        if first + size > allowed:
            yield first
            allowed = bench.controller.task("T_ROB1")["ROS_common:ROS_planned"] + RING
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
    while bench.controller.task("T_ROB1")["ROS_common:ROS_done_trajectory"] != 1:
        yield first


def first_motion(config: RobotConfig, count: int, seed: int) -> float:
    """Return s until the robot moves, for a stream of `count` points."""
    bench = booted(config, seed=seed)
    client = bench.motion()
    bench.run(1 + 0.013 * seed)
    start = bench.now
    client.send(batches(count)[0])
    assert bench.controller.run_until(lambda: not bench.motion_group.is_standing, timeout=10)
    in_use = bench.now - start
    bench.close()
    return in_use


def first_motion_of_a_download(config: RobotConfig, count: int) -> float:
    bench = booted(config)
    client = bench.motion()
    bench.run(1)
    start = bench.now
    _, joints = wave(count)
    client.send(download(count, 0.1, joints))
    assert bench.controller.run_until(lambda: not bench.motion_group.is_standing, timeout=60)
    in_use = bench.now - start
    bench.close()
    return in_use


def stopping(config: RobotConfig, seed: int) -> float:
    """Return s from STOP's delivery to the stop order, under load.

    Reader and state server are busy.
    """
    bench = booted(replace(config, state_period=0.02), seed=seed)
    client, own = bench.motion(), bench.control()
    for _ in range(3):
        watcher = bench.state()
        watcher.send(struct.pack("<4i5i", 32, 1300, 2, 0, 3, 0, 1, 0, 1 + 16 + 32))
    frames = batches(1500)
    client.send(frames[0])
    reply(client)
    bench.run(1.1 + 0.0137 * seed)
    client.at_once(b"".join(frames[1:]))
    bench.run(0.004 + 0.0031 * seed)
    own.at_once(STOP)
    start = bench.now
    assert bench.controller.run_until(lambda: bench.motion_group.stop_reasons != (), timeout=2)
    in_use = bench.now - start
    bench.close()
    return in_use


def endless(config: RobotConfig, count: int) -> None:
    """Print rests, memory and time of a long stream."""
    bench = booted(config)
    client = bench.motion()
    rests, moving = [0], [False]

    def changed():
        if moving[0] and bench.motion_group.is_standing:
            rests[0] += 1
        moving[0] = not bench.motion_group.is_standing

    bench.motion_group.changed.add(changed)
    began, thirds, start = time.process_time(), [], bench.now
    for first in feed(bench, client, count):
        bench.run(1.0)
        bench.forget()
        client.forget()
        if first * 3 // count > len(thirds):
            gc.collect()
            thirds.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    in_use = bench.now - start
    requested = 0.1 * (count - 1)
    gc.collect()
    thirds.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    print(
        f"{count} points: {in_use:.1f} s for {requested:.1f} s asked, "
        f"{rests[0] - 1} rests before the "
        f"end, memory {' '.join(f'{m:.0f}' for m in thirds)} MB, complaints "
        f"{sum(e.type.name != 'INFO' for e in bench.controller.log)}, "
        f"{time.process_time() - began:.0f} s of CPU"
    )
    bench.close()


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
    complete = first_motion_of_a_download(config, 1000)
    print(
        f"first motion of 1,000 points: {stream[7] * 1e3:.0f} ms (worst {stream[-1] * 1e3:.0f}), "
        f"sent whole {complete * 1e3:.0f} ms: 1/{complete / stream[7]:.0f}; of 60 points "
        f"{short[7] * 1e3:.0f} ms"
    )
    result = sorted(stopping(config, seed) for seed in range(30))
    print(f"STOP on its own connection: {result[15] * 1e3:.1f} ms, worst {result[-1] * 1e3:.1f} ms")
    endless(config, options.points)


if __name__ == "__main__":
    main()
