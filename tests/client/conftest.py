import functools
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from both_clients import Blocking, Sync
from fake_controller import FakeController

from rapidgen.client import Timeouts


@pytest.fixture
def fake():
    """Makes scripted controllers that end with the test."""
    made = []

    def make(**options):
        made.append(FakeController(**options))
        return made[-1]

    yield make
    for controller in made:
        controller.close()


@pytest.fixture
def quick():
    """Time-outs for loopback."""
    return Timeouts(
        connect=2, hello=0.3, state=1, ready=0.1, silence=0.4, send=0.5, reply=0.5, stop=0.5
    )


@pytest.fixture(params=[Sync, Blocking], ids=["sync", "async"])
def client(request, quick):
    return functools.partial(request.param, timeouts=quick)
