"""Simulations that are processes of their own."""

import json
import signal
import socket
import subprocess
import sys

import pytest


class Running:
    """A simulation that has said `ready`."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "rapidgen.cli", "sim", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        line = self.process.stdout.readline()
        if not line.startswith("ready "):
            self.process.kill()
            raise AssertionError(line + self.process.communicate()[1])
        self.ready = json.loads(line.removeprefix("ready "))

    def connect(self, port):
        return socket.create_connection((self.ready["host"], port), timeout=60)

    def control(self, **request):
        request = {"token": self.ready["token"], **request}
        with self.connect(self.ready["control"]) as sock, sock.makefile("rw") as file:
            file.write(json.dumps(request) + "\n")
            file.flush()
            return json.loads(file.readline())

    def end(self, number=signal.SIGINT):
        """Interrupt it; (exit code, rest of stdout, stderr)."""
        self.process.send_signal(number)
        out, err = self.process.communicate(timeout=60)
        return self.process.returncode, out, err

    def close(self):
        """End it whatever a test has left; a killed one could not remove its files."""
        self.process.terminate()
        self.process.communicate(timeout=60)


@pytest.fixture
def start():
    """Starts simulations and ends them."""
    running = []

    def begin(*arguments):
        running.append(Running(*arguments))
        return running[-1]

    yield begin
    for one in running:
        one.close()
