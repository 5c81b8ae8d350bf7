"""Sessions of the driver in real time: `rapidgen sim`, `robot.egm`, and datagrams over UDP."""

import contextlib
import json
import math
import socket
import subprocess
import sys
import time

import pytest

from rapidgen.client import Robot
from rapidgen.config import load_config

pytestmark = pytest.mark.long


@contextlib.contextmanager
def simulated(name):
    """Yield a robot that is connected to a virtual controller of its own."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    path = f"robots/examples/{name}.yaml"
    # What a loaded machine delays is no loss; the driver's own limit stays in force.
    changes = [f"egm.port={port}", "egm.timeout=1"]
    words = [word for change in changes for word in ("--set", change)]
    process = subprocess.Popen(
        [sys.executable, "-m", "rapidgen.cli", "sim", path, "--ports", "auto", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        ready = json.loads(process.stdout.readline().removeprefix("ready "))
        config = load_config(path, overrides=changes)
        with Robot(config, address=ready["address"]["rob1"]) as robot:
            yield robot
    finally:
        process.terminate()
        process.wait()
        process.stdout.close()


def follow_sine(session, seconds):
    """Send a sine of the first joint; return the joints where it began."""
    start, begin = session.state.joints, time.monotonic()
    while (past := time.monotonic() - begin) < seconds:
        first = start[0] + 0.05 * math.sin(2 * math.pi * past / 3)
        session.send((first, *start[1:]))
        session.next_state(30)
    return start


@pytest.mark.parametrize("name", ["irb120_egm-rw6", "crb15000_egm-rw7"])
def test_sessions_last_until_their_end_or_a_stop(name):
    with simulated(name) as robot:
        for _ in range(2):
            with robot.egm(timeout=10) as session:
                start = follow_sine(session, 3)
                session.send(start)
                while math.dist(session.state.joints, start) > 1e-3:
                    session.next_state(30)
            with robot.egm(timeout=10) as session:
                follow_sine(session, 1)
                robot.stop()
                session._wait(lambda state: state.ended, 30, "STOP has not ended the session")
                assert "STOPPED" in session.state.ended
                assert not session.state.guided
