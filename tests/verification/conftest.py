"""A bench that nothing has run on."""

import pytest

from rapidgen.verification.testbench import Bench
from tests.verification.made_up import CONFIG, SYSTEM


@pytest.fixture
def bench():
    made = Bench(CONFIG, SYSTEM)
    yield made
    made.close()
