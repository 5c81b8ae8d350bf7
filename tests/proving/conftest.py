"""A bench that nothing has run on."""

import pytest

from rapidgen.proving.bench import Bench
from tests.proving.made_up import CONFIG, SYSTEM


@pytest.fixture
def bench():
    made = Bench(CONFIG, SYSTEM)
    yield made
    made.close()
