"""Period of the virtual controller's EGM frames, and the client's time to answer.

    python benchmarks/egm.py [--seconds N]

A bare loop of 4 ms in a process of its own runs at the same time: its period errors are those of
the machine. Each part has processes of its own, as in use:

- `rapidgen sim` sends frames; a partner answers each at once and notes when it came.
- A loop sends frames to a session of `rapidgen.client.egm` and notes the time until the answer,
  while the session's caller sends targets at 1 kHz.
"""

import argparse
import multiprocessing
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import itertools

from rapidgen.client import egm
from rapidgen.wire.egm.codec import decode_robot, encode_robot, encode_sensor
from rapidgen.wire.egm.values import AxisPositions, RobotMessage, SensorMessage

CYCLE = 0.004
PROGRAM = r"""MODULE m
VAR egmident id;
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=600;
EGMActJoint id \Tool:=tool0 \MaxSpeedDeviation:=60;
EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=600;
ENDPROC
ENDMODULE
"""


def bare(seconds, pipe):
    """Send the period errors of a loop without work."""
    times, due = [], time.monotonic()
    end = due + seconds
    while due < end:
        times.append(time.monotonic())
        due += CYCLE
        time.sleep(max(0.0, due - time.monotonic()))
    pipe.send(errors(times))


def errors(times):
    return [abs(b - a - CYCLE) for a, b in itertools.pairwise(times)]


def percentile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def frames(seconds):
    """Return arrival times and sequence numbers of the frames of `rapidgen sim`."""
    with (
        tempfile.TemporaryDirectory() as folder,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link,
    ):
        link.bind(("127.0.0.1", 0))
        link.settimeout(60)
        path = Path(folder) / "m.mod"
        path.write_text(PROGRAM)
        address = f"PC=127.0.0.1:{link.getsockname()[1]}"
        words = ["sim", str(path), "--robot", "irb120", "--egm", address]
        process = subprocess.Popen(
            [sys.executable, "-m", "rapidgen.cli", *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        answer = encode_sensor(SensorMessage(joints=(5.0, 0.0, 0.0, 0.0, 30.0, 0.0)))
        times, numbers = [], []
        try:
            while not times or times[-1] - times[0] < seconds:
                data, source = link.recvfrom(65_536)
                times.append(time.monotonic())
                link.sendto(answer, source)
                numbers.append(decode_robot(data).sequence)
        finally:
            process.terminate()
            process.wait()
    return times, numbers


def answers(seconds):
    """Return times from a frame to the answer of a session, and frames without exactly one."""
    times, wrong = [], 0
    axes = AxisPositions((0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    with (
        egm.listen("irb120", port=0) as session,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as robot,
    ):
        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe()
        sender = context.Process(
            target=controller, args=(robot, session.port, seconds, axes, theirs)
        )
        sender.start()
        target = list(session.wait_until_guided(60).joints)
        while sender.is_alive() and not ours.poll():
            session.send(target)
            time.sleep(0.001)
        times, wrong = ours.recv()
        sender.join()
    return times, wrong


def controller(robot, port, seconds, axes, pipe):
    robot.bind(("127.0.0.1", 0))
    times, wrong, due = [], 0, time.monotonic()
    for number in range(round(seconds / CYCLE)):
        message = RobotMessage(number, 4 * number, axes, axes, True, "running", True, False)
        data = encode_robot(message, (7, 0))
        robot.setblocking(False)
        try:
            robot.recv(65_536)
            wrong += 1
        except BlockingIOError:
            pass
        robot.settimeout(1)
        begin = time.monotonic()
        robot.sendto(data, ("127.0.0.1", port))
        robot.recv(65_536)
        times.append(time.monotonic() - begin)
        due += CYCLE
        time.sleep(max(0.0, due - time.monotonic()))
    pipe.send((times[50:], wrong))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=30.0)
    seconds = parser.parse_args().seconds
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    process = context.Process(target=bare, args=(seconds, theirs))
    process.start()
    times, numbers = frames(seconds)
    machine = ours.recv()
    process.join()
    periods = errors(times[250:])
    lost = sum(b - a - 1 for a, b in itertools.pairwise(numbers) if b > a)
    late = sum(error > CYCLE for error in periods)
    print(f"bare loop: period error p99 {percentile(machine, 0.99) * 1e3:.2f} ms")
    print(
        f"frames: period error p99 {percentile(periods, 0.99) * 1e3:.2f} ms, "
        f"{lost} lost and {late} late of {len(numbers)}"
    )
    times, wrong = answers(seconds)
    print(
        f"answer: median {statistics.median(times) * 1e3:.2f} ms, "
        f"p99 {percentile(times, 0.99) * 1e3:.2f} ms, {wrong} second answers of {len(times)}"
    )


if __name__ == "__main__":
    main()
