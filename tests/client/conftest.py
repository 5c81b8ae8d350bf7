import sys
import threading
import time
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from both_clients import Blocking
from fake_controller import FakeController

from rapidgen.client import Robot, Timeouts

PATIENT = Timeouts(
    connect=20, hello=20, state=20, ready=0.1, silence=20, send=20, reply=20, stop=20, heartbeat=200
)
"""However much else this machine has to do; nothing of it is waited for where all goes well."""


@pytest.fixture
def fake():
    """Makes scripted controllers that end with the test."""
    made = []

    def make(**options):
        made.append(FakeController(**options))
        return made[-1]

    make.made = made
    yield make
    for controller in made:
        controller.close()


@pytest.fixture
def patient(fake):
    """Time-outs; `hasty` are those that a test waits for."""

    def make(**hasty):
        # Only who does not answer HELLO is waited for.
        is_plain = any(not controller.script.rapidgen for controller in fake.made)
        return replace(PATIENT, **{"hello": 0.3 if is_plain else 20, **hasty})

    return make


@pytest.fixture(params=[Robot, Blocking], ids=["sync", "async"])
def client(request, patient):
    """Makes a client of either kind; `hasty` are time-outs that the test waits for."""

    def make(*arguments, hasty=None, **options):
        return request.param(*arguments, timeouts=patient(**(hasty or {})), **options)

    return make


@pytest.fixture
def connected(fake, client):
    """A client of either kind at a controller of this script, and the controller."""

    @contextmanager
    def connect(*, hasty=None, reconnect=0.0, **script):
        controller = fake(**script)
        with client(controller.address, hasty=hasty, reconnect=reconnect) as robot:
            yield robot, controller

    return connect


@pytest.fixture
def comes():
    """Looks again until it holds: things that another thread does."""

    def look(condition):
        end, event = time.monotonic() + 60, threading.Event()
        while not condition():
            if time.monotonic() > end:
                return False
            event.wait(0.005)
        return True

    return look
