import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from served import Caller, make_cabinet, make_desk

from rapidgen.wire.rws.bodies import Generation


@pytest.fixture
def one(tmp_path):
    """A session of RWS 1.0 on the virtual clock."""
    with make_cabinet(tmp_path) as cabinet:
        yield Caller(make_desk(cabinet))


@pytest.fixture
def two(tmp_path):
    """A session of RWS 2.0."""
    with make_cabinet(tmp_path, Generation.TWO) as cabinet:
        yield Caller(make_desk(cabinet, Generation.TWO))


@pytest.fixture
def eight(tmp_path):
    """A session of RobotWare 8."""
    with make_cabinet(tmp_path, Generation.EIGHT) as cabinet:
        yield Caller(make_desk(cabinet, Generation.EIGHT))
