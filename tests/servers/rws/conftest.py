import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from served import Caller, make_application, make_runner

from rapidgen.wire.rws.bodies import Generation


@pytest.fixture
def one(tmp_path):
    """A session of RWS 1.0 on the virtual clock."""
    with make_runner(tmp_path) as runner:
        yield Caller(make_application(runner))


@pytest.fixture
def two(tmp_path):
    """A session of RWS 2.0."""
    with make_runner(tmp_path, Generation.TWO) as runner:
        yield Caller(make_application(runner, Generation.TWO))


@pytest.fixture
def eight(tmp_path):
    """A session of RobotWare 8."""
    with make_runner(tmp_path, Generation.EIGHT) as runner:
        yield Caller(make_application(runner, Generation.EIGHT))
